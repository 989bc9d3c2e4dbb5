//! Twigs that carry the leaves of a leaf outline out to its border.
//!
//! The papers let each leaf's vein run from the branch to the outline, so leaves of a wide crown become as long as the
//! crown is. Here leaves keep the size that was drawn, and where the outline is wider than that, thin twigs grow first
//! (002 eq. 2, like those of branch outlines) until no place inside is farther than about a leaf from wood. A grid over
//! the outline remembers where wood is; a twig ends before it runs into another. An outline that hugs its branch gets
//! none.

use super::{
    Attachment, Sample, Stop,
    growth_points::{Forest, GrowthPoint, Thinned},
    recall::Recall,
    vein::{self, Walk},
};
use crate::geom::{polyline, region::Region};
use crate::random::stream;
use crate::sketch::StrokeId;
use glam::Vec2;
use std::cell::Cell;
use std::sync::Arc;

crate::parameters! {
    /// Twigs that carry the leaves of leaf outlines.
    pub struct LeafTwigParams {
        /// Whether wide leaf outlines grow twigs at all.
        enabled: bool = true, 0..=1, "";
        /// Distance between twigs.
        spacing: f32 = 0.55, 0.2..=10.0, "of the leaf's length";
        /// How often twigs sprout twigs.
        generations: u32 = 7, 1..=12, "";
        /// Attraction to the outline (k_p).
        outline_pull: f32 = 0.12, 0.0..=1.0, "";
        /// Attraction along the parent branch (k_b).
        parent_pull: f32 = 0.15, 0.0..=1.0, "";
        /// Direction memory (k_m).
        memory: f32 = 0.8, 0.0..=1.0, "";
        /// Angle between a branch and a twig that leaves it.
        departure: f32 = 50.0, 0.0..=120.0, "degrees";
        /// Random change of that angle, up to.
        scatter: f32 = 20.0, 0.0..=90.0, "degrees";
        /// Most generated twigs in a drawing, those of branch outlines included.
        max_twigs: u32 = 6000, 1..=1000000, "";
    }
}

/// Number of the growth point at a branch's end.
const END: usize = usize::MAX;

/// Step of a twig as a share of the distance between twigs.
const STEP: f32 = 0.4;

/// Distance from the outline at which a twig ends, as a share of the leaf's length: the last leaf reaches it.
const STOP: f32 = 0.45;

/// Most steps of one twig.
const MAX_STEPS: usize = 60;

/// Most cells of the grid along one side.
const MAX_CELLS: usize = 1024;

/// One leaf outline that grows the twigs it needs.
pub struct LeafTwigs<'a> {
    /// The outline's stroke.
    pub outline: StrokeId,
    /// The outline.
    pub region: &'a Region,
    /// Length of its leaves, pixels.
    pub leaf_length: f32,
    /// The drawing's diagonal, pixels.
    pub diagonal: f32,
    /// Seed of everything random.
    pub seed: u64,
    /// How to grow them.
    pub params: &'a LeafTwigParams,
    /// Nothing grows any more once it says yes.
    pub stop: Stop<'a>,
}

impl LeafTwigs<'_> {
    /// Adds twigs to the forest; they stand after the branches they grow on. False where the cap left some out.
    pub fn grow(&self, forest: &mut Forest, known: &mut Ways) -> bool {
        let spacing = (self.params.spacing * self.leaf_length).max(1e-3 * self.diagonal);
        if !self.params.enabled || spacing <= 0.0 {
            return true;
        }
        let mut wood = Wood::new(self.region, spacing);
        let near: Vec<usize> = forest.near(self.region, 0..forest.branches().len()).collect();
        if !forest.may_look_at(near.iter().map(|i| forest.branches()[*i].line.len()).sum()) {
            return false;
        }
        for i in near {
            wood.mark(forest.branches()[i].line.iter().map(|s| s.position));
        }
        let mut parents = 0..forest.branches().len();
        for _ in 0..self.params.generations {
            let mut points = Thinned::new(forest.room(self.params.max_twigs, MAX_STEPS + 1));
            let ends = forest.near(self.region, parents.clone()).filter_map(|i| self.end_of(i, forest));
            ends.for_each(|end| points.add(end, end.key));
            forest.growth_points(parents, (self.outline, self.region), spacing, &mut points);
            let first_new = forest.branches().len();
            for point in points.kept() {
                if (self.stop)() {
                    return false;
                }
                let line = self.twig(point, spacing, &wood, known);
                if line.len() >= 3 {
                    wood.mark(line.iter().map(|s| s.position));
                    forest.sprout(point, line);
                }
            }
            if points.is_thinned() {
                return false;
            }
            parents = first_new..forest.branches().len();
        }
        true
    }

    /// The end of a branch, which grows straight on.
    fn end_of(&self, index: usize, forest: &Forest) -> Option<GrowthPoint> {
        let line = &forest.branches()[index].line;
        let [.., before, end] = &line[..] else { return None };
        let direction = (end.position - before.position).try_normalize()?;
        if !self.region.contains(end.position) {
            return None;
        }
        let at = polyline::arc_lengths(line.iter().map(|s| s.position)).last().copied()?;
        let attachment = Some(Attachment { branch: index, at });
        let key = forest.key(index, END, self.outline);
        Some(GrowthPoint { position: end.position, direction, attachment, side: 0.0, key })
    }

    /// The line of the twig of one growth point, up to where other wood is.
    fn twig(&self, point: &GrowthPoint, spacing: f32, wood: &Wood, known: &mut Ways) -> Arc<[Sample]> {
        let in_wood = |p: Vec2| p.distance(point.position) > spacing && wood.is_at(p);
        let is_free = |way: &Way| {
            way.blocked_at.is_none_or(in_wood) && !way.line.iter().skip(1).any(|s| in_wood(s.position))
        };
        if let Some(way) = known.get(point, is_free) {
            return Arc::clone(&way.line);
        }
        let params = self.params;
        let mut rng = stream(self.seed, "leaf twig", point.key);
        let first = point.heading(params.departure, params.scatter, &mut rng);
        let rule = Walk {
            outline_pull: params.outline_pull,
            parent_pull: params.parent_pull,
            memory: params.memory,
            step: STEP * spacing,
            max_steps: MAX_STEPS,
            stop_distance: STOP * self.leaf_length,
        };
        let blocked_at = Cell::new(None);
        let is_blocked = |p: Vec2| {
            let is_blocked = in_wood(p);
            blocked_at.set(is_blocked.then_some(p));
            is_blocked
        };
        let places = vein::walk(self.region, point.position, (point.direction, first), &rule, is_blocked);
        let line: Arc<[Sample]> = places.into_iter().map(Sample::neutral).collect();
        known.keep(point, Way { line: Arc::clone(&line), blocked_at: blocked_at.get() });
        line
    }
}

/// The way of a twig.
#[derive(Debug)]
pub struct Way {
    line: Arc<[Sample]>,
    /// The place at which other wood ended it.
    blocked_at: Option<Vec2>,
}

/// Ways of twigs from one drawing to the next, all grown in the same outline and in the same way but for the wood that they
/// came upon: a way is taken again where all along it there is no wood, and still some at its end if that ended it.
pub type Ways = Recall<Way>;

/// Cells of a grid over an outline in which there is wood.
struct Wood {
    low: Vec2,
    cell: f32,
    columns: usize,
    rows: usize,
    taken: Vec<bool>,
}

impl Wood {
    /// A grid whose cells are about `spacing` wide; larger where that would be too many.
    fn new(region: &Region, spacing: f32) -> Self {
        let (low, high) = region.bounds().unwrap_or_default();
        let size = (high - low).max(Vec2::ZERO);
        let cell = (0.8 * spacing).max(size.max_element() / (MAX_CELLS - 1) as f32);
        let count = |extent: f32| (extent / cell) as usize + 1;
        let (columns, rows) = (count(size.x), count(size.y));
        Self { low, cell, columns, rows, taken: vec![false; columns * rows] }
    }

    fn index(&self, p: Vec2) -> Option<usize> {
        let at = (p - self.low) / self.cell;
        let inside = at.cmpge(Vec2::ZERO).all() && at.x < self.columns as f32 && at.y < self.rows as f32;
        inside.then(|| at.y as usize * self.columns + at.x as usize)
    }

    fn mark(&mut self, places: impl Iterator<Item = Vec2>) {
        for p in places {
            if let Some(i) = self.index(p) {
                self.taken[i] = true;
            }
        }
    }

    fn is_at(&self, p: Vec2) -> bool {
        self.index(p).is_some_and(|i| self.taken[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::FlatBranch;

    fn stem() -> Vec<FlatBranch> {
        let line = (0..=50).map(|k| Sample::neutral(Vec2::new(0.0, 300.0 - 12.0 * k as f32))).collect();
        vec![FlatBranch {
            stroke: Some(1),
            key: 1,
            line,
            half_width: None,
            parent: None,
            attached_at: 0.0,
            level: 0,
        }]
    }

    fn oval(half_width: f32) -> Region {
        let corner = |k: usize| Vec2::from_angle(k as f32 * 0.1309) * Vec2::new(half_width, 280.0);
        Region::new((0..48).map(corner).collect())
    }

    fn grown(half_width: f32) -> Vec<FlatBranch> {
        let (mut forest, region) = (Forest::new(stem()), oval(half_width));
        let params = &LeafTwigParams::default();
        let twigs = LeafTwigs {
            outline: 9,
            region: &region,
            leaf_length: 30.0,
            diagonal: 600.0,
            seed: 3,
            params,
            stop: &|| false,
        };
        assert!(twigs.grow(&mut forest, &mut Ways::default()));
        forest.into_branches()
    }

    #[test]
    fn a_wide_outline_is_filled_with_wood() {
        let branches = grown(250.0);
        let region = oval(250.0);
        let wood: Vec<Vec2> = branches.iter().flat_map(|b| b.line.iter()).map(|s| s.position).collect();
        let near = |p: Vec2| wood.iter().any(|w| w.distance(p) < 60.0);
        let grid = (-12..=12).flat_map(|x| (-14..=14).map(move |y| 20.0 * Vec2::new(x as f32, y as f32)));
        let inside: Vec<Vec2> = grid.filter(|&p| region.contains(p)).collect();
        let covered = inside.iter().filter(|&&p| near(p)).count();
        assert!(covered * 100 > 93 * inside.len(), "{covered} of {}", inside.len());
        assert!(branches[1..].iter().flat_map(|b| b.line.iter()).all(|s| region.contains(s.position)));
    }

    #[test]
    fn an_outline_that_hugs_its_branch_grows_none() {
        assert_eq!(grown(12.0).len(), 1);
    }

    #[test]
    fn parents_stand_before_their_twigs() {
        let branches = grown(200.0);
        assert!(branches.iter().enumerate().skip(1).all(|(i, b)| b.parent.is_some_and(|p| p < i)));
    }
}
