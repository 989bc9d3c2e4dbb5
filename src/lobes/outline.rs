//! A lobe from one closed stroke: its outline made round.
//!
//! The stroke is seen along the direction in which it is thinnest; there the half depth of the lobe follows from Poisson's
//! equation ([`inflation`](crate::geom::inflation)), as for crowns that are drawn on paper. The surface lies where u − z² is 0, with u the squared half
//! depth inside of the outline and as far below 0 outside. The raster's steps along the outline are smoothed away.
//!
//! Limits: how far the stroke bends out of its plane is followed by no more than its mean.

use super::grid::Grid;
use super::stroke::Line;
use super::surface::Surface;
use crate::geom::inflation;
use crate::geom::polyline;
use crate::geom::principal_axes::principal_axes;
use crate::geom::region::Region;
use glam::Vec2;

/// How far, in cells, the raster's depth reaches over the outline, smoothed as it is.
const RIM: f32 = 0.5;

/// The surface of an inflated loop; empty for one that encloses nothing.
pub(super) fn inflated(outline: &Line) -> Surface {
    let (middle, [x, y, across]) = principal_axes(&outline.points);
    let flat: Vec<Vec2> =
        outline.points.iter().map(|p| Vec2::new((p - middle).dot(x), (p - middle).dot(y))).collect();
    let (low, high) = polyline::bounds(flat.iter().copied());
    let region = Region::new(flat);
    let extent = high - low;
    let is_wide = extent.min_element() > 1e-4 * extent.max_element();
    if !is_wide {
        return Surface::default();
    }
    let depth = Depth::new(&region, low, high);
    let deepest = depth.squared.iter().copied().fold(0.0, f32::max).sqrt();
    let mut grid = Grid::around(low.extend(-deepest), high.extend(deepest));
    let [w, h, d] = grid.size;
    for row in 0..h {
        for column in 0..w {
            let at = grid.place([column, row, 0]).truncate();
            let distance = region.nearest_boundary(at).map_or(f32::INFINITY, |(_, distance)| distance);
            let u = if region.contains(at) {
                depth.near_rim(at, distance).max(1e-3 * grid.cell * grid.cell)
            } else {
                // As steep as inside, so that the surface between nodes lies on the outline.
                -2.0 * deepest * distance
            };
            for layer in 0..d {
                let z = grid.place([column, row, layer]).z;
                grid.values[(layer * h + row) * w + column] = u - z * z;
            }
        }
    }
    let mut surface = grid.surface();
    surface.points.iter_mut().for_each(|p| *p = middle + x * p.x + y * p.y + across * p.z);
    surface
}

/// Squared half depth over the outline's plane.
struct Depth {
    low: Vec2,
    cell: f32,
    size: [usize; 2],
    squared: Vec<f32>,
}

impl Depth {
    fn new(region: &Region, low: Vec2, high: Vec2) -> Self {
        let extent = high - low;
        let cell = extent.max_element() / inflation::USUAL_CELLS as f32;
        let size = extent.to_array().map(|side| (side / cell).ceil() as usize + 2);
        let low = low - cell;
        let middle = |i: usize| low + (Vec2::new((i % size[0]) as f32, (i / size[0]) as f32) + 0.5) * cell;
        let inside = (0..size[0] * size[1]).filter(|i| region.contains(middle(*i)));
        let mut depth = Self { low, cell, size, squared: inflation::squared_half_depth(size, cell, inside) };
        for step in [1, size[0], 1, size[0]] {
            depth.blur(step);
        }
        depth
    }

    /// Means over three cells, the middle one counted twice.
    fn blur(&mut self, step: usize) {
        let old = self.squared.clone();
        for i in step..old.len() - step {
            self.squared[i] = 0.25 * (old[i - step] + old[i + step]) + 0.5 * old[i];
        }
    }

    /// The same where the outline is so far away: it falls to 0 at the outline itself instead of at the steps of the raster.
    fn near_rim(&self, p: Vec2, distance: f32) -> f32 {
        self.at(p) * distance / (distance + RIM * self.cell)
    }

    /// Between the middles of four cells.
    fn at(&self, p: Vec2) -> f32 {
        let q = ((p - self.low) / self.cell - 0.5).max(Vec2::ZERO);
        let [w, h] = self.size;
        let (x, y) = ((q.x as usize).min(w - 2), (q.y as usize).min(h - 2));
        let (fx, fy) = ((q.x - x as f32).clamp(0.0, 1.0), (q.y - y as f32).clamp(0.0, 1.0));
        let u = |x: usize, y: usize| self.squared[y * w + x];
        let row = |y: usize| u(x, y) * (1.0 - fx) + u(x + 1, y) * fx;
        row(y) * (1.0 - fy) + row(y + 1) * fy
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use std::f32::consts::TAU;

    #[test]
    fn a_circle_in_space_becomes_a_ball() {
        let (x, y) = (Vec3::new(0.6, 0.0, 0.8), Vec3::Y);
        let at = |k: u32| {
            let (sin, cos) = (k as f32 / 96.0 * TAU).sin_cos();
            Vec3::new(3.0, 2.0, 1.0) + (x * cos + y * sin) * 0.7
        };
        let surface = inflated(&Line { closed: true, points: (0..96).map(at).collect() });
        assert_eq!(surface.check_invariants(), Ok(()));
        let expected = 4.0 / 3.0 * std::f64::consts::PI * 0.7_f64.powi(3);
        assert!((surface.signed_volume() / expected - 1.0).abs() < 0.05, "{}", surface.signed_volume());
        for p in &surface.points {
            assert!((p.distance(Vec3::new(3.0, 2.0, 1.0)) - 0.7).abs() < 0.06, "{p}");
        }
    }

    #[test]
    fn a_line_there_and_back_encloses_nothing() {
        let points = (0..20).map(|k| Vec3::X * (10 - i32::abs(k - 10)) as f32).collect();
        assert!(inflated(&Line { closed: true, points }).triangles.is_empty());
    }
}
