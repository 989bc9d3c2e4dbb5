//! Twigs for branch outlines (000 §3.5.1, 002 §4.3).
//!
//! Every branch with a piece inside the outline sprouts twigs at equal distances, alternately to both sides; in the
//! next generation the twigs sprout shorter ones. The papers run the hierarchy analysis again afterwards; here every
//! twig knows the branch and the place it grew from, which is the same forest without guessing.

use super::{
    FlatBranch, Sample,
    growth_points::{GrowthPoint, growth_points},
    vein::{self, Walk},
};
use crate::geom::region::Region;
use glam::Vec2;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

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
        /// Most twigs in a drawing.
        max_twigs: u32 = 20000, 1..=1000000, "";
    }
}

/// One branch outline to fill.
pub struct TwigFill<'a> {
    /// The outline.
    pub region: &'a Region,
    /// The drawing's diagonal, pixels.
    pub diagonal: f32,
    /// Seed of everything random.
    pub seed: u64,
    /// How to fill it.
    pub params: &'a TwigParams,
}

impl TwigFill<'_> {
    /// Adds twigs to the forest; they stand after the branches they grow on.
    pub fn fill(&self, branches: &mut Vec<FlatBranch>) {
        let mut parents = 0..branches.len();
        for generation in 0..self.params.generations {
            let shrink = self.params.shrink.powi(generation as i32);
            let alive = parents.clone().map(|i| (i, &branches[i]));
            let points = growth_points(alive, self.region, self.params.spacing * shrink * self.diagonal);
            let room = (self.params.max_twigs as usize).saturating_sub(branches.len());
            let sprout = |point| self.twig(point, branches, shrink);
            let twigs: Vec<FlatBranch> = points.par_iter().take(room).filter_map(sprout).collect();
            parents = branches.len()..branches.len() + twigs.len();
            branches.extend(twigs);
        }
    }

    /// The twig of one growth point, `None` when there is no room for it.
    fn twig(&self, point: &GrowthPoint, branches: &[FlatBranch], shrink: f32) -> Option<FlatBranch> {
        let params = self.params;
        let mut rng = point_rng(self.seed, point);
        let turn = point.side() * params.departure + params.scatter * rng.random_range(-1.0..1.0f32);
        let first = Vec2::from_angle(turn.to_radians()).rotate(point.direction);
        let vigour = shrink * rng.random_range(0.7..1.0f32);
        let rule = Walk {
            outline_pull: params.outline_pull,
            parent_pull: params.parent_pull,
            memory: params.memory,
            step: params.growth_rate * self.diagonal,
            max_steps: ((params.max_steps as f32 * vigour) as usize).max(2),
            stop_distance: params.stop_distance * self.diagonal,
        };
        let places = vein::walk(self.region, point.position, point.direction, first, &rule);
        let parent = point.attachment.branch;
        (places.len() >= 3).then(|| FlatBranch {
            stroke: None,
            line: places.into_iter().map(Sample::neutral).collect(),
            parent: Some(parent),
            attached_at: point.attachment.at,
            level: branches[parent].level + 1,
        })
    }
}

/// Randomness of one growth point: depends on its place in the forest alone, not on the order of work.
pub(super) fn point_rng(seed: u64, point: &GrowthPoint) -> Pcg64Mcg {
    let place = ((point.attachment.branch as u64) << 24) ^ point.number as u64;
    Pcg64Mcg::seed_from_u64(seed ^ place.wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trunk() -> Vec<FlatBranch> {
        let line = (0..=40).map(|k| Sample::neutral(Vec2::new(0.0, 400.0 - 10.0 * k as f32))).collect();
        vec![FlatBranch { stroke: Some(1), line, parent: None, attached_at: 0.0, level: 0 }]
    }

    fn crown() -> Region {
        let disc = (0..48).map(|k| Vec2::new(0.0, 150.0) + 160.0 * Vec2::from_angle(k as f32 * 0.1309));
        Region::new(disc.collect())
    }

    #[test]
    fn twigs_stay_inside_and_follow_their_parents() {
        let mut branches = trunk();
        TwigFill { region: &crown(), diagonal: 600.0, seed: 7, params: &TwigParams::default() }
            .fill(&mut branches);
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
        let grown = |seed, params: &TwigParams| {
            let mut branches = trunk();
            TwigFill { region: &crown(), diagonal: 600.0, seed, params }.fill(&mut branches);
            branches
        };
        let params = TwigParams::default();
        assert_eq!(grown(3, &params), grown(3, &params));
        assert_ne!(grown(3, &params), grown(4, &params));
        assert!(grown(3, &TwigParams { max_twigs: 5, ..params }).len() <= 5);
    }
}
