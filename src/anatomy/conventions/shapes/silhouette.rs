//! What lines enclose together, on a grid: nobody's lines meet exactly, so gaps of a few cells count as closed.
//!
//! Lines are drawn into a grid of square cells and thickened; what can be reached from outside around the thick lines, thickened
//! back by as much, is outside, the rest is the silhouette (a morphological closing). Its contour runs between inner and
//! outer cells. Cost: the number of cells, [`LONG_SIDE`]² at most, whatever the lines.

use super::cells::{Cells, STEPS};
use crate::anatomy::conventions::page::even;
use crate::geom::polyline;
use glam::{IVec2, Vec2};
use std::collections::HashSet;

/// Cells along the longer side.
const LONG_SIDE: f32 = 112.0;
/// Half cells in which a line may still be met that a way begins on.
const OWN_LINE: usize = 6;

/// Cells inside lines.
#[derive(Clone, Debug)]
pub(crate) struct Silhouette {
    low: Vec2,
    cell: f32,
    size: IVec2,
    /// Cells left free on every side, more than lines are thickened.
    margin: i32,
    ink: Cells,
    inside: Cells,
    /// The largest connected part of the inside.
    largest: Cells,
}

impl Silhouette {
    /// The area that lines enclose, gaps of up to `bridge` cells closed; of no lines there is one cell at most.
    pub(crate) fn new<'a>(lines: impl Iterator<Item = &'a [Vec2]> + Clone, bridge: i32) -> Self {
        let points = lines.clone().flatten();
        let (low, high) = polyline::bounds(points.copied());
        let (low, high) = if low.cmple(high).all() { (low, high) } else { (Vec2::ZERO, Vec2::ZERO) };
        let cell = ((high - low).max_element() / LONG_SIDE).max(f32::MIN_POSITIVE);
        let thick = (bridge + 1) / 2;
        let margin = thick + 2;
        let size = ((high - low) / cell).ceil().as_ivec2() + 2 * margin + 1;
        let (ink, inside, largest) = (Cells::none(size), Cells::none(size), Cells::none(size));
        let mut it = Self { low, cell, size, margin, ink, inside, largest };
        lines.for_each(|line| it.draw(line));
        it.fill(thick);
        it
    }

    fn draw(&mut self, line: &[Vec2]) {
        for pair in line.windows(2) {
            let steps = (2.0 * pair[0].distance(pair[1]) / self.cell).ceil().max(1.0) as usize;
            for k in 0..=steps {
                let at = self.cell_at(pair[0].lerp(pair[1], k as f32 / steps as f32));
                self.ink.insert(at);
            }
        }
    }

    fn fill(&mut self, thick: i32) {
        let wall = STEPS * thick as u16;
        // The margin is wider than lines are thickened, so the first cell is outside.
        let outside = self.ink.widened(wall).others().connected(IVec2::ZERO);
        self.inside = outside.widened(wall).others().or(&self.ink);
        self.largest = self.inside.largest_part();
    }

    fn cell_at(&self, p: Vec2) -> IVec2 {
        (((p - self.low) / self.cell).floor().as_ivec2() + self.margin).clamp(IVec2::ZERO, self.size - 1)
    }

    fn number(&self, at: IVec2) -> usize {
        (at.y * self.size.x + at.x) as usize
    }

    /// Middle of a cell, pixels.
    fn place(&self, at: IVec2) -> Vec2 {
        self.low + ((at - self.margin).as_vec2() + 0.5) * self.cell
    }

    /// How far it is from a place on a line along a direction of length 1 to the next line; none where that is beyond `most`.
    pub(crate) fn way_to_ink(&self, from: Vec2, along: Vec2, most: f32) -> Option<f32> {
        // The line itself is some cells wide.
        let steps = (2.0 * most / self.cell) as usize;
        let way = |step: usize| 0.5 * self.cell * step as f32;
        (OWN_LINE..steps).map(way).find(|way| self.ink.contains(self.cell_at(from + along * *way)))
    }

    /// Side of a cell, pixels.
    pub(crate) fn cell(&self) -> f32 {
        self.cell
    }

    /// Area of the silhouette, pixels².
    pub(crate) fn area(&self) -> f32 {
        self.inside.count() as f32 * self.cell * self.cell
    }

    /// Radius of the largest circle in it, about, pixels.
    pub(crate) fn inscribed_radius(&self) -> f32 {
        self.depths().into_iter().fold(0.0, f32::max) * self.cell
    }

    /// The same area without what is narrower than twice `half` cells (a morphological opening).
    pub(crate) fn without_thin_parts(mut self, half: f32) -> Self {
        let steps = half * f32::from(STEPS);
        let core = self.inside.clone().others().widened(steps as u16).others();
        self.inside = core.widened(steps.ceil() as u16).and(&self.inside);
        self.largest = self.inside.largest_part();
        self
    }

    /// Distance of each cell from the outside, cells; 0 outside.
    pub(crate) fn depths(&self) -> Vec<f32> {
        self.inside.depths().into_iter().map(|depth| f32::from(depth) / f32::from(STEPS)).collect()
    }

    /// The eight neighbours of a cell and their distances, cells.
    pub(crate) fn around(&self, i: usize) -> impl Iterator<Item = (usize, f32)> + use<'_> {
        let at = self.place_of(i);
        let offsets = (-1..=1).flat_map(|x| (-1..=1).map(move |y| IVec2::new(x, y)));
        offsets
            .filter(|offset| *offset != IVec2::ZERO)
            .filter_map(move |offset| Some((self.number_at(at + offset)?, offset.as_vec2().length())))
    }

    /// Column and row of a cell.
    pub(crate) fn place_of(&self, i: usize) -> IVec2 {
        IVec2::new(i as i32 % self.size.x, i as i32 / self.size.x)
    }

    /// The cell at a column and row; none outside of the grid.
    pub(crate) fn number_at(&self, at: IVec2) -> Option<usize> {
        (at.cmpge(IVec2::ZERO).all() && at.cmplt(self.size).all()).then(|| self.number(at))
    }

    /// Middle of a cell, pixels.
    pub(crate) fn middle(&self, i: usize) -> Vec2 {
        self.place(self.place_of(i))
    }

    /// Share of these places that lies in the largest connected area.
    pub(crate) fn share_inside<'a>(&self, places: impl Iterator<Item = &'a Vec2>) -> f32 {
        let (mut inside, mut all) = (0, 0);
        for place in places {
            all += 1;
            inside += usize::from(self.largest.contains(self.cell_at(*place)));
        }
        inside as f32 / all.max(1) as f32
    }

    /// Share of the area that lies in circles, given by their middles and radii in pixels.
    pub(crate) fn share_within<'a>(&self, circles: impl Iterator<Item = &'a (Vec2, f32)>) -> f32 {
        let mut within = Cells::none(self.size);
        for &(middle, radius) in circles {
            let (at, reach) = (self.cell_at(middle), radius / self.cell);
            let around = reach.ceil() as i32;
            for offset in (-around..=around).flat_map(|x| (-around..=around).map(move |y| IVec2::new(x, y))) {
                if offset.as_vec2().length() <= reach {
                    within.insert(at + offset);
                }
            }
        }
        within.and(&self.inside).count() as f32 / self.inside.count().max(1) as f32
    }

    /// Contour of the largest connected area, first point not repeated; empty where nothing is enclosed.
    pub(crate) fn contour(&self) -> Vec<Vec2> {
        let is_in = |at: IVec2| self.largest.contains(at);
        let Some(start) = self.largest.first() else { return Vec::new() };
        // Along the corners of cells with the area on the right hand, from the upper left corner of the topmost cell.
        let (mut at, mut heading) = (start, IVec2::X);
        let mut contour = Vec::new();
        loop {
            contour.push(self.place(at) - 0.5 * self.cell);
            at += heading;
            let right = IVec2::new(-heading.y, heading.x);
            let cell_ahead = |side: IVec2| at + (heading + side - 1) / 2;
            if !is_in(cell_ahead(right)) {
                heading = right;
            } else if is_in(cell_ahead(-right)) {
                heading = -right;
            }
            if (at == start && heading == IVec2::X) || contour.len() > 4 * self.largest.of_grid() {
                return contour;
            }
        }
    }
}

/// Share of a contour's points that are nearer than `reach` to some point of these lines, whose points are nearer to one another
/// than that.
pub(crate) fn share_along<'a>(contour: &[Vec2], lines: impl Iterator<Item = &'a [Vec2]>, reach: f32) -> f32 {
    let cell = |p: &Vec2| (p / reach).floor().as_ivec2();
    let drawn: HashSet<IVec2> = lines.flatten().map(cell).collect();
    let is_near = |p: &&Vec2| {
        let at = cell(p);
        (-1..=1).any(|dx| (-1..=1).any(|dy| drawn.contains(&(at + IVec2::new(dx, dy)))))
    };
    contour.iter().filter(is_near).count() as f32 / contour.len().max(1) as f32
}

/// A closed contour evened out: `rounds` of the mean of neighbours, at `count` even points.
pub(crate) fn smooth_contour(contour: &[Vec2], count: usize, rounds: usize) -> Vec<Vec2> {
    let Some(&first) = contour.first() else { return Vec::new() };
    let mut closed = contour.to_vec();
    closed.push(first);
    let mut points = even(&closed, count + 1);
    points.pop();
    for _ in 0..rounds {
        let n = points.len();
        points = (0..n)
            .map(|i| 0.25 * (points[(i + n - 1) % n] + points[(i + 1) % n]) + 0.5 * points[i])
            .collect();
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::simple_loop;
    use std::f32::consts::{PI, TAU};

    fn arc(from: f32, to: f32) -> Vec<Vec2> {
        (0..=100).map(|k| 50.0 * Vec2::from_angle(from + (to - from) * k as f32 / 100.0)).collect()
    }

    fn of(lines: &[Vec<Vec2>], bridge: i32) -> Silhouette {
        Silhouette::new(lines.iter().map(Vec::as_slice), bridge)
    }

    #[test]
    fn a_circle_with_a_gap_is_closed_if_the_gap_is_narrow() {
        let whole = PI * 2500.0;
        let narrow = of(&[arc(0.0, TAU - 0.04)], 4);
        assert!((narrow.area() / whole - 1.0).abs() < 0.06, "{}", narrow.area() / whole);
        let wide = of(&[arc(0.0, TAU - 0.6)], 4);
        assert!(wide.area() < 0.2 * whole);
    }

    #[test]
    fn no_lines_enclose_nothing() {
        let nothing = of(&[], 6);
        assert_eq!((nothing.area(), nothing.inscribed_radius()), (0.0, 0.0));
    }

    #[test]
    fn two_halves_make_one_contour() {
        let contour = of(&[arc(0.1, PI), arc(PI, TAU)], 8).contour();
        let smooth = smooth_contour(&contour, 100, 2);
        let area = simple_loop::area(&smooth);
        assert!((area / (PI * 2500.0) - 1.0).abs() < 0.06, "{area}");
        assert!(simple_loop::is_simple(&smooth));
    }

    #[test]
    fn the_inscribed_circle_of_a_band_is_half_as_wide() {
        let band =
            vec![Vec2::ZERO, Vec2::new(100.0, 0.0), Vec2::new(100.0, 20.0), Vec2::new(0.0, 20.0), Vec2::ZERO];
        let radius = of(&[band], 2).inscribed_radius();
        assert!((7.0..13.0).contains(&radius), "{radius}");
    }
}
