//! Twigs for branch outlines (000 §3.5.1, 002 §4.3).
//!
//! Every branch with a piece inside the outline sprouts twigs at equal distances, alternately to both sides; in the
//! next generation the twigs sprout shorter ones. The papers run the hierarchy analysis again afterwards; here every
//! twig knows the branch and the place it grew from, which is the same forest without guessing.

use super::{
    Sample, Stop,
    growth_points::{Forest, GrowthPoint, Thinned},
    recall::Recall,
    vein::{self, Walk},
};
use crate::geom::region::Region;
use crate::random::stream;
use crate::sketch::StrokeId;
use glam::Vec2;
use rand::RngExt;
use rayon::prelude::*;
use std::sync::Arc;

crate::parameters! {
    /// How branch outlines are filled with twigs.
    pub struct TwigParams {
        /// Attraction to the outline (k_p): more leads twigs straight outward.
        outline_pull: f32 = 0.35, 0.0..=1.0, "";
        /// Attraction along the parent branch (k_b): more lets twigs follow it.
        parent_pull: f32 = 0.3, 0.0..=1.0, "";
        /// Direction memory (k_m): more makes twigs straighter.
        memory: f32 = 0.6, 0.0..=1.0, "";
        /// Growth rate: length of one step; larger is straighter.
        growth_rate: f32 = 0.008, 0.001..=0.1, "of the drawing's diagonal";
        /// Distance between twigs along a branch.
        spacing: f32 = 0.035, 0.004..=0.5, "of the drawing's diagonal";
        /// Most steps of one twig.
        max_steps: u32 = 30, 1..=500, "";
        /// Distance from the outline at which a twig ends.
        stop_distance: f32 = 0.008, 0.0..=0.2, "of the drawing's diagonal";
        /// How often twigs sprout twigs.
        generations: u32 = 2, 1..=4, "";
        /// Length and distance of twigs from one generation to the next.
        shrink: f32 = 0.55, 0.1..=1.0, "";
        /// Angle between a branch and a twig that leaves it.
        departure: f32 = 45.0, 0.0..=120.0, "degrees";
        /// Random change of that angle, up to.
        scatter: f32 = 15.0, 0.0..=90.0, "degrees";
        /// Most generated twigs in a drawing.
        max_twigs: u32 = 6000, 1..=1000000, "";
    }
}

/// What came of filling an outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// All that was asked for.
    Full,
    /// Fewer or none, because there are as many as a drawing may have.
    Capped,
    /// Nothing: no branch runs through the outline.
    NoBranch,
    /// Nothing: the outline leaves no room beside its branches.
    NoRoom,
}

/// The lines of twigs from one drawing to the next, all grown in the same outline and in the same way.
pub type Twigs = Recall<Arc<[Sample]>>;

/// One branch outline to fill.
pub struct TwigFill<'a> {
    /// The outline's stroke.
    pub outline: StrokeId,
    /// The outline.
    pub region: &'a Region,
    /// The drawing's diagonal, pixels.
    pub diagonal: f32,
    /// Seed of everything random.
    pub seed: u64,
    /// How to fill it.
    pub params: &'a TwigParams,
    /// Nothing grows any more once it says yes.
    pub stop: Stop<'a>,
}

impl TwigFill<'_> {
    /// Adds twigs to the forest; they stand after the branches they grow on.
    pub fn fill(&self, forest: &mut Forest, known: &mut Twigs) -> Growth {
        let before = forest.generated();
        let (mut thinned, mut sprouts) = (false, false);
        let mut parents = 0..forest.branches().len();
        for generation in 0..self.params.generations {
            let shrink = self.params.shrink.powi(generation as i32);
            let longest = self.most_steps(shrink) + 1;
            let mut points = Thinned::new(forest.room(self.params.max_twigs, longest));
            let spacing = self.params.spacing * shrink * self.diagonal;
            forest.growth_points(parents, (self.outline, self.region), spacing, &mut points);
            sprouts |= !points.is_empty();
            thinned |= points.is_thinned();
            let first_new = forest.branches().len();
            for (point, line) in points.kept().iter().zip(self.twigs(points.kept(), shrink, known)) {
                if line.len() >= 3 {
                    forest.sprout(point, line);
                }
            }
            parents = first_new..forest.branches().len();
        }
        match (thinned, sprouts) {
            (true, _) => Growth::Capped,
            (_, false) => Growth::NoBranch,
            _ if forest.generated() == before => Growth::NoRoom,
            _ => Growth::Full,
        }
    }

    /// The lines of the twigs of growth points of one generation; nothing for those that do not grow any more.
    fn twigs(&self, points: &[GrowthPoint], shrink: f32, known: &mut Twigs) -> Vec<Arc<[Sample]>> {
        let taken: Vec<Option<Arc<[Sample]>>> =
            points.iter().map(|point| known.get(point, |_| true).cloned()).collect();
        let missing: Vec<&GrowthPoint> =
            points.iter().zip(&taken).filter(|(_, taken)| taken.is_none()).map(|(point, _)| point).collect();
        let grow = |point: &&GrowthPoint| {
            let places = || self.twig(point, shrink).into_iter().map(Sample::neutral).collect();
            (!(self.stop)()).then(places)
        };
        let new: Vec<Option<Arc<[Sample]>>> = missing.par_iter().map(grow).collect();
        for (point, line) in missing.iter().zip(&new) {
            line.iter().for_each(|line| known.keep(point, Arc::clone(line)));
        }
        let mut new = new.into_iter();
        taken.into_iter().map(|taken| taken.or_else(|| new.next().flatten()).unwrap_or_default()).collect()
    }

    /// Most steps of a twig of full vigour.
    fn most_steps(&self, vigour: f32) -> usize {
        ((self.params.max_steps as f32 * vigour) as usize).max(2)
    }

    /// Places of the twig of one growth point.
    fn twig(&self, point: &GrowthPoint, shrink: f32) -> Vec<Vec2> {
        let params = self.params;
        let mut rng = stream(self.seed, "twig", point.key);
        let first = point.heading(params.departure, params.scatter, &mut rng);
        let vigour = shrink * rng.random_range(0.7..1.0f32);
        let rule = Walk {
            outline_pull: params.outline_pull,
            parent_pull: params.parent_pull,
            memory: params.memory,
            step: params.growth_rate * self.diagonal,
            max_steps: self.most_steps(vigour),
            stop_distance: params.stop_distance * self.diagonal,
        };
        vein::walk(self.region, point.position, (point.direction, first), &rule, |_| false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::FlatBranch;

    fn trunk() -> Vec<FlatBranch> {
        let line = (0..=40).map(|k| Sample::neutral(Vec2::new(0.0, 400.0 - 10.0 * k as f32))).collect();
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

    fn crown() -> Region {
        let disc = (0..48).map(|k| Vec2::new(0.0, 150.0) + 160.0 * Vec2::from_angle(k as f32 * 0.1309));
        Region::new(disc.collect())
    }

    fn grown(seed: u64, params: &TwigParams) -> Vec<FlatBranch> {
        let mut forest = Forest::new(trunk());
        TwigFill { outline: 9, region: &crown(), diagonal: 600.0, seed, params, stop: &|| false }
            .fill(&mut forest, &mut Twigs::default());
        forest.into_branches()
    }

    #[test]
    fn twigs_stay_inside_and_follow_their_parents() {
        let branches = grown(7, &TwigParams::default());
        assert!(branches.len() > 20, "{}", branches.len());
        for (i, twig) in branches.iter().enumerate().skip(1) {
            assert!(twig.parent.unwrap() < i);
            assert_eq!(twig.level, branches[twig.parent.unwrap()].level + 1);
            assert!(twig.line.iter().all(|s| crown().contains(s.position)));
        }
        let left = branches[1..].iter().filter(|b| b.line[2].position.x < 0.0).count();
        assert!(left * 3 > branches.len() && left * 3 < 2 * branches.len());
    }

    #[test]
    fn same_seed_same_twigs_and_a_cap() {
        let params = TwigParams::default();
        assert_eq!(grown(3, &params), grown(3, &params));
        assert_ne!(grown(3, &params), grown(4, &params));
        assert!(grown(3, &TwigParams { max_twigs: 5, ..params }).len() <= 6);
    }
}
