//! A drawn outline made round: the volume whose front silhouette is the outline.
//!
//! The half depth h over the drawing is √u with u the solution of Poisson's equation ∇²u = −4, u = 0 on the outline: a
//! circle becomes a sphere, a long strip a somewhat deeper bolster, a thin neck stays thin. The equation is solved on a
//! raster by successive over-relaxation; what counts as inside the outline is decided by the outline itself, so the
//! silhouette is exact whatever the raster. Outlines that overlap are one; one inside another is a hole.
//!
//! u − (z/depth)² is 0 on the surface and rises inward, in a sphere by the square of the radius; where it exceeds a share
//! of its largest value the volume may be hollow. Thin parts have no hollow.
//!
//! Growth is led along the volume's arms where that is wanted ([`guide`](super::guide)).
//!
//! Where a network tells how deep the crown of such a plant is, its depth takes the place of the inflated one by as much as it is to be
//! believed (001 ch. 3), and the middle strays from the drawing's plane in slow waves of the size that it tells.
//!
//! Source: the idea of inflating a silhouette by a harmonic height is common in sketch modelling.
//! Limits: details of the depth finer than the raster, [`RASTER`] cells along the longer side, are smoothed.

use super::guide::{Cells, Guide};
use crate::geom::inflation;
use crate::geom::outlined_area::OutlinedArea;
use crate::geom::region::Region;
use crate::learned_depth::WorldDepth;
use crate::plant::Branch;
use crate::random::Choice;
use glam::{Vec2, Vec3};

/// Cells along the longer side of the raster.
pub(super) const RASTER: usize = inflation::USUAL_CELLS;

/// A volume inflated from outlines in the plane z = 0.
pub struct Inflated {
    area: OutlinedArea,
    low: Vec2,
    cell: f32,
    size: [usize; 2],
    /// Squared half depth at the middle of each cell, rows along x.
    squared: Vec<f32>,
    /// Depth of the volume's middle there; empty where that is the drawing's plane.
    middle: Vec<f32>,
    depth: f32,
    deepest: f32,
    /// Value of u − (z/depth)² from which the inside is empty.
    core: f32,
    /// Where growth is led, and how strongly.
    guide: Option<(Guide, f32)>,
    /// Middles and radii of places where it is sparse.
    thin_spots: Vec<(Vec2, f32)>,
}

/// Share of the space in a thin spot that growth finds.
const SPARSE: f32 = 0.3;

impl std::fmt::Debug for Inflated {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Inflated")
            .field("outlines", &self.area.regions().count())
            .field("low", &self.low)
            .finish()
    }
}

impl Inflated {
    /// Inflates closed outlines in world metres (x, y); `depth` stretches the result along z, 1 makes circles
    /// spheres. `None` if they enclose nothing.
    pub fn new(outlines: Vec<Vec<Vec2>>, depth: f32) -> Option<Self> {
        let finite = outlines.into_iter().filter(|o| o.len() >= 3 && o.iter().all(|p| p.is_finite()));
        let area = OutlinedArea::new(finite);
        let mut bounds = area.regions().filter_map(Region::bounds);
        let first = bounds.next()?;
        let (low, high) = bounds.fold(first, |(lo, hi), (l, h)| (lo.min(l), hi.max(h)));
        let extent = high - low;
        if !(extent.min_element() > 0.0 && depth > 0.0 && depth.is_finite()) {
            return None;
        }
        let cell = extent.max_element() / RASTER as f32;
        // A rim of outside cells carries u = 0.
        // Rounding must not add a row to the side that is a whole number of cells by definition.
        let size = [extent.x, extent.y].map(|e| (e / cell - 0.01).ceil() as usize + 2);
        let low = low - cell;
        let mut inflated = Self {
            area,
            low,
            cell,
            size,
            squared: vec![0.0; size[0] * size[1]],
            middle: Vec::new(),
            depth,
            deepest: 0.0,
            core: f32::INFINITY,
            guide: None,
            thin_spots: Vec::new(),
        };
        inflated.solve();
        inflated.deepest = inflated.deepest_cell();
        (inflated.deepest > 0.0).then_some(inflated)
    }

    /// The same as deep as a network tells, by a `share` of what it is to be believed; `seed` decides to which side its middle
    /// strays where.
    pub fn learned(mut self, known: &WorldDepth, share: f32, seed: u64) -> Self {
        let share = share.clamp(0.0, 1.0) * known.belief();
        if share <= 0.0 {
            return self;
        }
        let inside: Vec<usize> = (0..self.squared.len()).filter(|i| self.squared[*i] > 0.0).collect();
        let phases = Choice::LUMPS.units(seed).map(|unit| unit * std::f32::consts::TAU);
        let longer = self.size[0].max(self.size[1]) as f32 * self.cell;
        let deepest = self.deepest / self.depth;
        self.middle = vec![0.0; self.squared.len()];
        for i in inside {
            let p = self.middle_of(i);
            let half = self.squared[i].sqrt();
            let least = half * (1.0 - THINNER * half / deepest);
            let half = (half + share * (known.half_depth(p) - half)).max(least);
            self.squared[i] = half * half;
            let q = (p - self.low) / longer;
            let waves = WAVES.iter().zip(phases).map(|((x, y), phase)| (x * q.x + y * q.y + phase).sin());
            let middle = STRAY * share * known.stray(p) * waves.sum::<f32>();
            self.middle[i] = middle.clamp(-IN_PLANE * half, IN_PLANE * half) * self.depth;
        }
        self.deepest = self.deepest_cell();
        self
    }

    fn deepest_cell(&self) -> f32 {
        self.squared.iter().copied().fold(0.0, f32::max).sqrt() * self.depth
    }

    /// The middle of a cell.
    fn middle_of(&self, i: usize) -> Vec2 {
        let [w, _] = self.size;
        self.low + (Vec2::new((i % w) as f32, (i / w) as f32) + 0.5) * self.cell
    }

    /// The same with an empty core: in a sphere a sphere of this share of its radius, below 1. 0 is solid. Where `wood`
    /// stands in the core alone it stays solid: no bud would perceive the shell.
    pub fn hollowed(mut self, share: f32, wood: &[Branch]) -> Self {
        if share > 0.0 {
            let largest = (self.deepest / self.depth).powi(2);
            self.core = largest * (1.0 - share.min(1.0).powi(2));
            let mut points =
                wood.iter().flat_map(|branch| &branch.points).filter(|p| self.covers(p.truncate()));
            let in_core = |p: &Vec3| {
                let over = p.truncate();
                self.is_in_core(self.half_depth(over), p.z - self.middle_depth(over))
            };
            if points.clone().next().is_some() && points.all(in_core) {
                self.core = f32::INFINITY;
            }
        }
        self
    }

    /// The same with growth led along its arms, from the wood that is in it, by a `weight` against where buds find space; 0 leads
    /// nothing.
    pub fn guided(mut self, weight: f32, wood: &[Branch]) -> Self {
        if weight > 0.0 {
            let half_depth: Vec<f32> = self.squared.iter().map(|u| u.sqrt()).collect();
            let points = wood.iter().flat_map(|branch| &branch.points).map(|p| p.truncate());
            let in_cells = |p: Vec2| (self.cell_at(p), (p - self.low) / self.cell);
            let places: Vec<(usize, Vec2)> = points.filter(|p| self.covers(*p)).map(in_cells).collect();
            self.guide =
                Some((Guide::new(&Cells { size: self.size, half_depth: &half_depth }, &places), weight));
        }
        self
    }

    /// The same, sparse around the middles of spots, given with their radii.
    pub fn thinned(mut self, spots: &[(Vec2, f32)]) -> Self {
        self.thin_spots = spots.to_vec();
        self
    }

    /// Share of the space at a place that growth finds, 0 to 1.
    pub fn density(&self, p: Vec3) -> f32 {
        let is_thin = |(middle, radius): &(Vec2, f32)| p.truncate().distance(*middle) < *radius;
        if self.thin_spots.iter().any(is_thin) { SPARSE } else { 1.0 }
    }

    /// The direction in which growth is led at a place; zero where it is not.
    pub fn way(&self, p: Vec3) -> Vec3 {
        let Some((guide, _)) = &self.guide else { return Vec3::ZERO };
        let over = p.truncate();
        let depth = (p.z - self.middle_depth(over)) / self.half_depth(over).max(f32::MIN_POSITIVE);
        guide.way(self.cell_at(over), depth)
    }

    /// The best direction of a bud, which looks for space, brought nearer to where growth is led (001 eq. 3.6, as a mean).
    pub(crate) fn led(&self, at: Vec3, best: Vec3) -> Vec3 {
        match &self.guide {
            Some((_, weight)) if best != Vec3::ZERO => {
                let way = self.way(at);
                if way == Vec3::ZERO { best } else { (best + *weight * way) / (1.0 + weight) }
            }
            _ => best,
        }
    }

    /// The cell that a point of the drawing lies in, of those outside of the raster the nearest.
    fn cell_at(&self, p: Vec2) -> usize {
        let [w, h] = self.size;
        let q = ((p - self.low) / self.cell).max(Vec2::ZERO);
        (q.y as usize).min(h - 1) * w + (q.x as usize).min(w - 1)
    }

    /// Whether a point of the drawing lies inside the outlines.
    pub fn covers(&self, p: Vec2) -> bool {
        self.area.contains(p)
    }

    /// Edges of its outlines that are asked about one point, at most.
    pub fn edges_beside_a_point(&self) -> u64 {
        self.area.regions().map(|region| region.edges_beside_a_point() as u64).sum()
    }

    /// Half depth over a point of the drawing.
    pub fn half_depth(&self, p: Vec2) -> f32 {
        self.between_cells(&self.squared, p).max(0.0).sqrt() * self.depth
    }

    /// Depth of the volume's middle over a point of the drawing.
    pub fn middle_depth(&self, p: Vec2) -> f32 {
        if self.middle.is_empty() { 0.0 } else { self.between_cells(&self.middle, p) }
    }

    /// Between the middles of cells linear.
    fn between_cells(&self, cells: &[f32], p: Vec2) -> f32 {
        let q = (p - self.low) / self.cell - 0.5;
        let [w, h] = self.size;
        let x = (q.x.max(0.0) as usize).min(w - 2);
        let y = (q.y.max(0.0) as usize).min(h - 2);
        let (fx, fy) = ((q.x - x as f32).clamp(0.0, 1.0), (q.y - y as f32).clamp(0.0, 1.0));
        let at = |x: usize, y: usize| cells[y * w + x];
        let row = |y: usize| at(x, y) * (1.0 - fx) + at(x + 1, y) * fx;
        row(y) * (1.0 - fy) + row(y + 1) * fy
    }

    /// Whether a point lies inside the volume.
    pub fn contains(&self, p: Vec3) -> bool {
        let half = self.half_depth(p.truncate());
        let z = p.z - self.middle_depth(p.truncate());
        p.is_finite() && z.abs() <= half && !self.is_in_core(half, z) && self.covers(p.truncate())
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
        let reach = self.middle.iter().fold(0.0, |most: f32, z| most.max(z.abs())) + self.deepest;
        (self.low.extend(-reach), high.extend(reach))
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
        let cells = (0..self.squared.len()).filter(|i| self.covers(self.middle_of(*i)));
        self.squared = inflation::squared_half_depth(self.size, self.cell, cells);
    }
}

/// How much thinner than inflated a network may make a crown at its thickest, as a share; thin parts it may not make thinner, for what is
/// drawn must be filled.
const THINNER: f32 = 0.3;
/// Share of the way that the middle of a single place strays that neighbours have in common.
const STRAY: f32 = 0.35;
/// How far the middle may stray, as a share of the half depth: the drawing's plane, where drawn wood stands, stays inside.
const IN_PLANE: f32 = 0.3;
/// Waves of the middle, radians to the right and upward over the longer side.
const WAVES: [(f32, f32); 3] = [(9.1, 5.3), (-7.7, 11.9), (12.1, -8.9)];
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
        let cells = (0..self.of_cell.len()).filter(|i| self.of_cell[*i] == island as u32);
        cells.map(|i| (volume.middle_of(i), volume.squared[i].sqrt() * volume.depth)).collect()
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
