//! The line along which a field is ½: marching squares with linear interpolation (Lorensen and Cline 1987, in the plane).
//!
//! Beyond the picture the field is 0, so every contour is closed. Where two corners of a cell that face each other are inside,
//! the mean of all four says whether they belong together. Of several contours the one that encloses the most is taken.

use super::raster::Raster;
use crate::geom::{simple_loop, simplify};
use glam::Vec2;

/// The value along the contour.
const LEVEL: f32 = 0.5;

/// Sides of a cell: above, right, below, left.
const STEPS: [(isize, isize); 4] = [(0, -1), (1, 0), (0, 1), (-1, 0)];

/// The field with a rim of zeros.
struct Field<'a>(&'a Raster<f32>);

impl Field<'_> {
    /// The value at the middle of a pixel, also beside the picture.
    fn at(&self, x: isize, y: isize) -> f32 {
        let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) else { return 0.0 };
        if x < self.0.width() && y < self.0.height() { self.0[(x, y)] } else { 0.0 }
    }

    fn is_in(&self, x: isize, y: isize) -> bool {
        self.at(x, y) >= LEVEL
    }

    /// The corners of a side of a cell, whose upper left corner is the middle of pixel (x, y).
    fn side((x, y): (isize, isize), side: usize) -> [(isize, isize); 2] {
        match side {
            0 => [(x, y), (x + 1, y)],
            1 => [(x + 1, y), (x + 1, y + 1)],
            2 => [(x, y + 1), (x + 1, y + 1)],
            _ => [(x, y), (x, y + 1)],
        }
    }

    fn crosses(&self, cell: (isize, isize), side: usize) -> bool {
        let [a, b] = Self::side(cell, side);
        self.is_in(a.0, a.1) != self.is_in(b.0, b.1)
    }

    /// Where the contour crosses a side.
    fn crossing(&self, cell: (isize, isize), side: usize) -> Vec2 {
        let [a, b] = Self::side(cell, side);
        let (va, vb) = (self.at(a.0, a.1), self.at(b.0, b.1));
        let middle = |(x, y): (isize, isize)| Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
        middle(a).lerp(middle(b), ((LEVEL - va) / (vb - va)).clamp(0.0, 1.0))
    }

    /// The side by which a contour leaves a cell that it has come into by another.
    fn way_out(&self, cell @ (x, y): (isize, isize), from: usize) -> usize {
        let crossed = |side: &usize| *side != from && self.crosses(cell, *side);
        let mut others = (0..4).filter(crossed);
        let (first, is_saddle) = (others.next(), others.next().is_some());
        if !is_saddle {
            return first.unwrap_or(from);
        }
        let mean = 0.25 * (self.at(x, y) + self.at(x + 1, y) + self.at(x, y + 1) + self.at(x + 1, y + 1));
        // The contour goes around the corners that stand alone: upper left and lower right, or the other two.
        let around_upper_left = self.is_in(x, y) != (mean >= LEVEL);
        if around_upper_left { 3 - from } else { [1, 0, 3, 2][from] }
    }
}

/// The contour that encloses the most; in pixels, clockwise as seen on the screen, first point not repeated. `None` where the
/// field is nowhere ½.
pub(super) fn largest(field: &Raster<f32>) -> Option<Vec<Vec2>> {
    let mut best: Option<(f32, Vec<Vec2>)> = None;
    for contour in all(field) {
        let area = simple_loop::signed_area(contour.iter().copied());
        if best.as_ref().is_none_or(|(most, _)| area.abs() > most.abs()) {
            best = Some((area, contour));
        }
    }
    let (area, mut contour) = best?;
    // In pixels y runs down, so what is positive here turns clockwise on the screen.
    if area < 0.0 {
        contour.reverse();
    }
    Some(contour)
}

/// All contours, in the order of their uppermost rows; in pixels, each around in either sense, first point not repeated.
pub(super) fn all(field: &Raster<f32>) -> Vec<Vec<Vec2>> {
    let (field, width, height) = (Field(field), field.width() as isize, field.height() as isize);
    // Every contour crosses a line between two pixels of a row.
    let index = |(x, y): (isize, isize)| (y * (width + 1) + x + 1) as usize;
    let mut seen = vec![false; ((width + 1) * height) as usize];
    let mut contours = Vec::new();
    for y in 0..height {
        for x in -1..width {
            if !seen[index((x, y))] && field.crosses((x, y), 0) {
                contours.push(walk(&field, (x, y), |at| seen[index(at)] = true));
            }
        }
    }
    contours
}

/// Follows a contour around, from the upper side of a cell; `pass` gets every cell whose upper side it crosses.
fn walk(field: &Field<'_>, start: (isize, isize), mut pass: impl FnMut((isize, isize))) -> Vec<Vec2> {
    let mut contour = Vec::new();
    let (mut cell, mut from) = (start, 0);
    loop {
        contour.push(field.crossing(cell, from));
        if from == 0 {
            pass(cell);
        }
        let out = field.way_out(cell, from);
        if out == 0 {
            pass(cell);
        }
        // A line is crossed once: the walk ends where it began.
        cell = (cell.0 + STEPS[out].0, cell.1 + STEPS[out].1);
        from = (out + 2) % 4;
        if (cell, from) == (start, 0) {
            return contour;
        }
    }
}

/// The closed line with the points that carry its shape (Douglas and Peucker); it passes through the points at `fixed`, of which
/// there are two at least, in rising order.
pub(super) fn simplified(line: &[Vec2], fixed: &[usize], tolerance: f32) -> Vec<Vec2> {
    let count = line.len();
    let mut kept = vec![false; 2 * count];
    let mut pending = Vec::new();
    for (k, &first) in fixed.iter().enumerate() {
        let last = fixed.get(k + 1).copied().unwrap_or(fixed[0] + count);
        simplify::mark((first, last), &mut kept, &mut pending, |a, b| {
            let (from, to) = (line[a % count], line[b % count]);
            let along = to - from;
            let inverse = 1.0 / along.length_squared().max(f32::MIN_POSITIVE);
            move |i| {
                let off = line[i % count] - from;
                off.distance_squared(along * (off.dot(along) * inverse).clamp(0.0, 1.0))
                    / (tolerance * tolerance)
            }
        });
    }
    (fixed[0]..fixed[0] + count).filter(|i| kept[*i]).map(|i| line[i % count]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::UVec2;

    /// A disc's share of every pixel, counted at 16 × 16 places.
    fn disc(size: u32, middle: Vec2, radius: f32) -> Raster<f32> {
        let mut field = Raster::filled(UVec2::splat(size), 0.0);
        for i in 0..field.cells().len() {
            let corner = field.middle(i) - 0.5;
            let at = |k: u32| corner + (Vec2::new((k % 16) as f32, (k / 16) as f32) + 0.5) / 16.0;
            let inside = (0..256).filter(|k| at(*k).distance(middle) < radius).count();
            field.cells_mut()[i] = inside as f32 / 256.0;
        }
        field
    }

    #[test]
    fn a_disc_is_round_to_a_tenth_of_a_pixel() {
        let middle = Vec2::new(40.3, 37.9);
        let contour = largest(&disc(80, middle, 25.4)).unwrap();
        for p in &contour {
            assert!((p.distance(middle) - 25.4).abs() < 0.1, "{p}");
        }
        let area = simple_loop::signed_area(contour.iter().copied());
        assert!((area - std::f32::consts::PI * 25.4 * 25.4).abs() < 5.0);
    }

    #[test]
    fn what_touches_the_edge_is_closed_there() {
        let contour = largest(&disc(40, Vec2::new(5.0, 20.0), 12.0)).unwrap();
        assert!(contour.iter().all(|p| p.x > -0.01 && p.x < 17.1));
        let all = largest(&Raster::filled(UVec2::new(4, 3), 1.0)).unwrap();
        assert!((simple_loop::signed_area(all.into_iter()) - 12.0).abs() < 0.6);
        assert!(largest(&Raster::filled(UVec2::new(4, 3), 0.4)).is_none());
    }

    #[test]
    fn corners_that_face_each_other_are_one_or_two() {
        let field = |between: f32| Raster::new(2, vec![0.9, between, between, 0.9]);
        let area = |between: f32| simple_loop::signed_area(largest(&field(between)).unwrap().into_iter());
        assert!(area(0.45) > 2.0 * area(0.05), "{} {}", area(0.45), area(0.05));
    }

    #[test]
    fn any_field_has_contours_that_end() {
        let mut state = 7u32;
        for size in 1..20 {
            let mut field = Raster::filled(UVec2::new(size, 21 - size), 0.0);
            field.cells_mut().iter_mut().for_each(|cell| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                *cell = (state >> 8) as f32 / (1 << 24) as f32;
            });
            assert!(largest(&field).is_none_or(|contour| contour.len() >= 4));
        }
    }

    #[test]
    fn a_simplified_line_stays_near_and_keeps_what_is_fixed() {
        let circle: Vec<Vec2> = (0..400).map(|k| 50.0 * Vec2::from_angle(k as f32 * 0.015_707_96)).collect();
        let simple = simplified(&circle, &[37, 211], 0.3);
        assert!(simple.len() < 60 && simple[0] == circle[37] && simple.contains(&circle[211]));
        for (a, b) in simple.iter().zip(simple.iter().cycle().skip(1)) {
            assert!(50.0 - a.midpoint(*b).length() < 0.301);
        }
    }
}
