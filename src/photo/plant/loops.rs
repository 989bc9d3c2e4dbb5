//! The outlines of a mask: outer loops and holes, as polygons.
//!
//! The mask is blurred by a binomial kernel, which takes the staircase of pixels away, and followed along ½. A loop is a hole
//! where it lies in an odd number of others. Loops are simplified by Douglas and Peucker's method.
//!
//! Limits: what is thinner than about two pixels of the grid is lost.

use super::super::contour;
use super::super::raster::Raster;
use crate::geom::simple_loop::{area, crossings_at};
use glam::Vec2;

/// Times that the mask is blurred by ¼, ½, ¼ along both axes.
const BLURS: usize = 2;

/// A closed line in pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// Its corners; the first is not repeated.
    pub points: Vec<Vec2>,
    /// Whether it is the rim of a hole.
    pub is_hole: bool,
}

/// The loops of a mask that enclose at least `least` pixels, the largest first; `tolerance` is how far a loop may leave its contour,
/// pixels.
pub(super) fn loops(mask: &Raster<bool>, least: f32, tolerance: f32) -> Vec<Loop> {
    let mut contours: Vec<(f32, Vec<Vec2>)> =
        contour::all(&blurred(mask)).into_iter().map(|line| (area(&line), line)).collect();
    contours.retain(|(area, line)| *area >= least && line.len() > 3);
    contours.sort_by(|a, b| b.0.total_cmp(&a.0));
    let lines: Vec<&Vec<Vec2>> = contours.iter().map(|(_, line)| line).collect();
    let depth = |k: usize| lines[..k].iter().filter(|outer| contains(outer, lines[k][0])).count();
    let simple = |line: &[Vec2]| contour::simplified(line, &[0, line.len() / 2], tolerance);
    (0..lines.len())
        .map(|k| Loop { points: simple(lines[k]), is_hole: depth(k) % 2 == 1 })
        .filter(|line| line.points.len() > 3)
        .collect()
}

/// Whether a place lies within a closed line.
fn contains(line: &[Vec2], at: Vec2) -> bool {
    crossings_at(line, at.y).filter(|x| *x > at.x).count() % 2 == 1
}

fn blurred(mask: &Raster<bool>) -> Raster<f32> {
    let mut field = mask.map(|is_in| f32::from(u8::from(*is_in)));
    for _ in 0..BLURS {
        field = blurred_along_rows(&blurred_along_rows(&field).turned()).turned();
    }
    field
}

/// A row after the other; beyond its ends is nothing.
fn blurred_along_rows(field: &Raster<f32>) -> Raster<f32> {
    let width = field.width();
    let at = |row: &[f32], x: usize| {
        let left = x.checked_sub(1).map_or(row[x], |left| row[left]);
        let right = row.get(x + 1).copied().unwrap_or(row[x]);
        0.25 * left + 0.5 * row[x] + 0.25 * right
    };
    let rows = field.cells().chunks_exact(width);
    Raster::new(width, rows.flat_map(|row| (0..width).map(move |x| at(row, x))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::UVec2;

    #[test]
    fn a_ring_has_an_outer_loop_and_a_hole_with_an_island() {
        let mut mask = Raster::filled(UVec2::splat(120), false);
        for i in 0..mask.cells().len() {
            let away = mask.middle(i).distance(Vec2::splat(60.0));
            mask.cells_mut()[i] = (30.0..50.0).contains(&away) || away < 12.0;
        }
        let found = loops(&mask, 20.0, 0.5);
        assert_eq!(found.iter().map(|line| line.is_hole).collect::<Vec<_>>(), [false, true, false]);
        for (line, radius) in found.iter().zip([50.0, 30.0, 12.0]) {
            assert!(line.points.iter().all(|p| (p.distance(Vec2::splat(60.0)) - radius).abs() < 0.8));
            assert!((area(&line.points) / (std::f32::consts::PI * radius * radius) - 1.0).abs() < 0.06);
        }
        assert_eq!(loops(&mask, 1000.0, 0.5).len(), 2);
    }

    #[test]
    fn what_leaves_the_picture_ends_at_its_edge() {
        let found = loops(&Raster::filled(UVec2::new(9, 7), true), 4.0, 0.1);
        assert!(found.len() == 1 && (area(&found[0].points) - 63.0).abs() < 1.0);
    }
}
