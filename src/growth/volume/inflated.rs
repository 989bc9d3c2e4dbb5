//! A drawn outline made round: the volume whose front silhouette is the outline.
//!
//! The half depth h over the drawing is √u with u the solution of Poisson's equation ∇²u = −4, u = 0 on the outline: a
//! circle becomes a sphere, a long strip a somewhat deeper bolster, a thin neck stays thin. The equation is solved on a
//! raster by successive over-relaxation; what counts as inside the outline is decided by the outline itself, so the
//! silhouette is exact whatever the raster. Several outlines are filled even–odd: one inside another is a hole.
//!
//! u − (z/depth)² is 0 on the surface and rises inward, in a sphere by the square of the radius; where it exceeds a share
//! of its largest value the volume may be hollow. Thin parts have no hollow.
//!
//! Source: the idea of inflating a silhouette by a harmonic height is common in sketch modelling; the papers of this
//! program name the volume (001 ch. 3) but take its depth from a network.
//! Limits: details of the depth finer than the raster, [`RASTER`] cells along the longer side, are smoothed.

use crate::geom::inflation;
use crate::geom::region::Region;
use crate::plant::Branch;
use glam::{Vec2, Vec3};

/// Cells along the longer side of the raster.
pub(super) const RASTER: usize = inflation::USUAL_CELLS;

/// A volume inflated from outlines in the plane z = 0.
pub struct Inflated {
    regions: Vec<Region>,
    low: Vec2,
    cell: f32,
    size: [usize; 2],
    /// Squared half depth at the middle of each cell, rows along x.
    squared: Vec<f32>,
    depth: f32,
    deepest: f32,
    /// Value of u − (z/depth)² from which the inside is empty.
    core: f32,
}

impl std::fmt::Debug for Inflated {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Inflated").field("outlines", &self.regions.len()).field("low", &self.low).finish()
    }
}

impl Inflated {
    /// Inflates closed outlines in world metres (x, y); `depth` stretches the result along z, 1 makes circles
    /// spheres. `None` if they enclose nothing.
    pub fn new(outlines: Vec<Vec<Vec2>>, depth: f32) -> Option<Self> {
        let finite = outlines.into_iter().filter(|o| o.len() >= 3 && o.iter().all(|p| p.is_finite()));
        let regions: Vec<Region> = finite.map(Region::new).collect();
        let mut bounds = regions.iter().filter_map(Region::bounds);
        let first = bounds.next()?;
        let (low, high) = bounds.fold(first, |(lo, hi), (l, h)| (lo.min(l), hi.max(h)));
        let extent = high - low;
        if !(extent.min_element() > 0.0 && depth > 0.0 && depth.is_finite()) {
            return None;
        }
        let cell = extent.max_element() / RASTER as f32;
        // A rim of outside cells carries u = 0.
        let size = [extent.x, extent.y].map(|e| (e / cell).ceil() as usize + 2);
        let low = low - cell;
        let mut inflated = Self {
            regions,
            low,
            cell,
            size,
            squared: vec![0.0; size[0] * size[1]],
            depth,
            deepest: 0.0,
            core: f32::INFINITY,
        };
        inflated.solve();
        inflated.deepest = inflated.squared.iter().copied().fold(0.0, f32::max).sqrt() * depth;
        (inflated.deepest > 0.0).then_some(inflated)
    }

    /// The same with an empty core: in a sphere a sphere of this share of its radius, below 1. 0 is solid. Where `wood`
    /// stands in the core alone it stays solid: no bud would perceive the shell.
    pub fn hollowed(mut self, share: f32, wood: &[Branch]) -> Self {
        if share > 0.0 {
            let largest = (self.deepest / self.depth).powi(2);
            self.core = largest * (1.0 - share.min(1.0).powi(2));
            let mut points =
                wood.iter().flat_map(|branch| &branch.points).filter(|p| self.covers(p.truncate()));
            let in_core = |p: &Vec3| self.is_in_core(self.half_depth(p.truncate()), p.z);
            if points.clone().next().is_some() && points.all(in_core) {
                self.core = f32::INFINITY;
            }
        }
        self
    }

    /// Whether a point of the drawing lies inside the outlines.
    pub fn covers(&self, p: Vec2) -> bool {
        self.regions.iter().filter(|r| r.contains(p)).count() % 2 == 1
    }

    /// Edges of its outlines that are asked about one point, at most.
    pub fn edges_beside_a_point(&self) -> u64 {
        self.regions.iter().map(|region| region.edges_beside_a_point() as u64).sum()
    }

    /// Half depth over a point of the drawing.
    pub fn half_depth(&self, p: Vec2) -> f32 {
        let q = (p - self.low) / self.cell - 0.5;
        let [w, h] = self.size;
        let x = (q.x.max(0.0) as usize).min(w - 2);
        let y = (q.y.max(0.0) as usize).min(h - 2);
        let (fx, fy) = ((q.x - x as f32).clamp(0.0, 1.0), (q.y - y as f32).clamp(0.0, 1.0));
        let u = |x: usize, y: usize| self.squared[y * w + x];
        let row = |y: usize| u(x, y) * (1.0 - fx) + u(x + 1, y) * fx;
        (row(y) * (1.0 - fy) + row(y + 1) * fy).max(0.0).sqrt() * self.depth
    }

    /// Whether a point lies inside the volume.
    pub fn contains(&self, p: Vec3) -> bool {
        let half = self.half_depth(p.truncate());
        p.is_finite() && p.z.abs() <= half && !self.is_in_core(half, p.z) && self.covers(p.truncate())
    }

    fn is_in_core(&self, half_depth: f32, z: f32) -> bool {
        half_depth * half_depth - z * z > self.core * self.depth * self.depth
    }

    /// Largest half depth.
    pub fn deepest(&self) -> f32 {
        self.deepest
    }

    /// Cubic metres, by the raster.
    pub fn volume(&self) -> f32 {
        let wood = self.squared.iter().map(|u| u.sqrt() - (u - self.core).max(0.0).sqrt());
        2.0 * self.depth * self.cell * self.cell * wood.sum::<f32>()
    }

    /// Smallest and largest corner.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let high = self.low + Vec2::new(self.size[0] as f32, self.size[1] as f32) * self.cell;
        (self.low.extend(-self.deepest), high.extend(self.deepest))
    }

    /// The separate parts of the outlines, by the cells of the raster. Necks of a few cells separate, too: no shoot finds
    /// its way through them.
    pub fn islands(&self) -> Islands {
        let [w, h] = self.size;
        let mut of_cell = vec![NO_ISLAND; w * h];
        let (mut count, mut open) = (0, Vec::new());
        let least = (NECK * self.cell).min(0.3 * self.deepest / self.depth).powi(2);
        for first in 0..w * h {
            if self.squared[first] <= least || of_cell[first] != NO_ISLAND {
                continue;
            }
            open.push(first);
            of_cell[first] = count;
            while let Some(i) = open.pop() {
                // The rim is outside, so every inside cell has eight neighbours.
                for near in [i - w - 1, i - w, i - w + 1, i - 1, i + 1, i + w - 1, i + w, i + w + 1] {
                    if self.squared[near] > least && of_cell[near] == NO_ISLAND {
                        of_cell[near] = count;
                        open.push(near);
                    }
                }
            }
            count += 1;
        }
        Islands { count: count as usize, of_cell }
    }

    fn solve(&mut self) {
        let [w, h] = self.size;
        let middle = |x: usize, y: usize| self.low + (Vec2::new(x as f32, y as f32) + 0.5) * self.cell;
        let cells = (0..w * h).filter(|i| self.covers(middle(i % w, i / w)));
        self.squared = inflation::squared_half_depth(self.size, self.cell, cells);
    }
}

/// Half depth in cells up to which a neck separates: a strip of four to five cells is as deep.
const NECK: f32 = 3.2;
/// No part of the outlines.
const NO_ISLAND: u32 = u32::MAX;

/// The separate parts of an inflated volume.
pub struct Islands {
    /// How many.
    pub count: usize,
    of_cell: Vec<u32>,
}

impl Islands {
    /// The part over a point of the drawing.
    pub fn at(&self, volume: &Inflated, p: Vec2) -> Option<usize> {
        let q = (p - volume.low) / volume.cell;
        let [w, h] = volume.size;
        let inside = q.is_finite() && q.min_element() >= 0.0 && q.x < w as f32 && q.y < h as f32;
        let island = self.of_cell[if inside { q.y as usize * w + q.x as usize } else { return None }];
        (island != NO_ISLAND).then_some(island as usize)
    }

    /// Places inside of a part, each with the half depth there.
    pub fn places(&self, volume: &Inflated, island: usize) -> Vec<(Vec2, f32)> {
        let w = volume.size[0];
        let cells = (0..self.of_cell.len()).filter(|i| self.of_cell[*i] == island as u32);
        let middle = |i: usize| volume.low + (Vec2::new((i % w) as f32, (i / w) as f32) + 0.5) * volume.cell;
        cells.map(|i| (middle(i), volume.squared[i].sqrt() * volume.depth)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Origin, Role, WoodPart};

    fn circle(centre: Vec2, radius: f32) -> Vec<Vec2> {
        (0..64).map(|k| centre + Vec2::from_angle(k as f32 / 64.0 * std::f32::consts::TAU) * radius).collect()
    }

    #[test]
    fn a_circle_becomes_a_sphere() {
        let ball = Inflated::new(vec![circle(Vec2::new(3.0, 5.0), 2.0)], 1.0).unwrap();
        for d in [0.0, 0.5, 1.0, 1.6_f32] {
            let expected = (4.0 - d * d).sqrt();
            let got = ball.half_depth(Vec2::new(3.0 + d, 5.0));
            assert!((got - expected).abs() < 0.08, "{got} instead of {expected} at {d}");
        }
        assert!(ball.contains(Vec3::new(3.0, 5.0, 1.8)) && !ball.contains(Vec3::new(3.0, 5.0, 2.2)));
        assert!(!ball.contains(Vec3::new(5.1, 5.0, 0.0)) && !ball.contains(Vec3::NAN));
    }

    #[test]
    fn a_hollow_sphere_is_a_shell_unless_wood_stands_in_its_core_alone() {
        let ball = || Inflated::new(vec![circle(Vec2::ZERO, 2.0)], 0.5).unwrap();
        let shell = ball().hollowed(0.5, &[]);
        let inside = |x: f32, z: f32| shell.contains(Vec3::new(x, 0.0, z));
        assert!(!inside(0.0, 0.0) && !inside(0.9, 0.0) && !inside(0.0, 0.45), "half as wide and as deep");
        assert!(inside(1.1, 0.0) && inside(0.0, 0.55) && inside(1.9, 0.0) && !inside(0.0, 1.1));
        let volume = shell.volume() / ball().volume();
        assert!((volume - 0.875).abs() < 0.03, "{volume}");
        let wood = |to: f32| Branch {
            origin: Origin::Generated,
            parent: None,
            level: 0,
            points: vec![Vec3::ZERO, Vec3::Y * to],
            radii: vec![0.1; 2],
            role: Role::of(WoodPart::Stem),
        };
        assert!(ball().hollowed(0.5, &[wood(0.5)]).contains(Vec3::ZERO));
        assert!(!ball().hollowed(0.5, &[wood(1.5)]).contains(Vec3::ZERO));
    }

    #[test]
    fn an_outline_inside_another_is_a_hole() {
        let ring = Inflated::new(vec![circle(Vec2::ZERO, 3.0), circle(Vec2::ZERO, 1.0)], 1.0).unwrap();
        assert!(!ring.contains(Vec3::ZERO) && ring.contains(Vec3::X * 2.0));
        let thick = ring.half_depth(Vec2::X * 2.0);
        assert!(thick > 0.8 && thick < 1.6, "{thick}");
    }

    #[test]
    fn what_encloses_nothing_is_no_volume() {
        assert!(Inflated::new(Vec::new(), 1.0).is_none());
        assert!(Inflated::new(vec![vec![Vec2::ZERO, Vec2::X, Vec2::X * 2.0]], 1.0).is_none());
        assert!(Inflated::new(vec![vec![Vec2::ZERO, Vec2::NAN, Vec2::Y]], 1.0).is_none());
        assert!(Inflated::new(vec![circle(Vec2::ZERO, 1.0)], 0.0).is_none());
    }
}
