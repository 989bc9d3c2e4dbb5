//! Fronds about a place: the top of a trunk, or the mouth of a pot.
//!
//! Lines are cut into spikes in two ways, by their distance from the place ([`spikes`](super::super::shapes::spikes)) and at their
//! sharp folds ([`folds`](super::super::shapes::folds)); of each line that cut is taken of which more is fronds.
//!
//! What speaks for fronds and against a crown: they are slender, their tips are sharp ([`SHARP`]), the notches between them go
//! down to near the place ([`DEEP`]), and together they are nearly all that is drawn there. Lobes of crowns and petals are round,
//! and outlines of crowns go far around.

use crate::anatomy::conventions::shapes::folds::folded;
use crate::anatomy::conventions::shapes::spikes::{Spike, joined, spikes};
use crate::anatomy::conventions::trees::trunk_sides::TrunkSides;
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::f32::consts::PI;

/// Widest angle of a tip in the middle of all, and where it is measured, as a share of the shorter flank.
const SHARP: (f32, f32) = (0.5 * PI, 0.12);
/// Greatest distance of the notches beside a frond from the trunk's top, as a share of its tip's.
const DEEP: f32 = 0.65;
/// Least distance of a tip from the trunk's top, as a share of the farthest's.
const SHORTEST: f32 = 0.3;
/// Least change of distance that makes a frond, as a share of its line's farthest.
const PROMINENCE: f32 = 0.1;
/// Half of the mean distance of the two sides of a frond at most, as a share of its length.
const SLENDER: f32 = 0.3;
/// Length of a frond's shorter flank at most, in distances of its tip from the trunk's top: a half circle has 1.6.
const AROUND: f32 = 2.0;
/// Tips of one line, less one, from which on it may be a scribble.
const SCRIBBLE: usize = 5;
/// On a trunk of one line: farthest root of a frond from its top, as a share of its tip's, and how far the trunk reaches below all
/// else, as a share of the whole height.
const AT_TOP: f32 = 0.5;
const FREE: f32 = 0.2;
/// Least length of a line of which it is asked where it begins, as a share of all, and most distance of its ends over its length.
const MAIN: f32 = 0.08;
const CLOSED: f32 = 0.15;
/// How much the flanks of a frond may turn against their bend, radians, and those between sharp folds, which may be serrated.
const ARC: f32 = 1.2;
const SERRATED: f32 = 6.0;
/// How much more of a line folds must make fronds of to be where it is cut.
const FOLDED: f32 = 1.1;
/// Half width of a frond at most, as a share of its length.
const HALF: f32 = 0.2;

/// Fronds about a place.
pub(crate) struct Crown {
    /// Each with the lines that it comes from.
    pub fronds: Vec<(Spike, Vec<usize>)>,
    /// Distance of the farthest point.
    pub reach: f32,
    /// Share of the lines' length that fronds are.
    pub explained: f32,
    /// How far the closed line that is farthest away begins, as a share of its reach.
    pub apart: f32,
}

impl Crown {
    /// What radiates from `top` among some runs of points, each with the number of its line.
    pub(crate) fn about(top: Vec2, runs: &[(Vec<Vec2>, usize)]) -> Self {
        let reach = |points: &[Vec2]| points.iter().map(|p| p.distance(top)).fold(0.0, f32::max);
        let farthest = runs.iter().map(|run| reach(&run.0)).fold(0.0, f32::max);
        let all = runs.iter().flat_map(|(points, line)| {
            cut(points, top, farthest).into_iter().map(|(spike, bent)| (spike, bent, *line))
        });
        let (single, double): (Vec<_>, Vec<_>) = all.partition(|(spike, ..)| spike.flanks.len() == 1);
        let single = single.into_iter().map(|(spike, _, line)| (spike, line)).collect();
        let mut fronds = joined(single, |tip| (tip - top).to_angle());
        fronds.retain(|(spike, _)| is_frond(spike, top, farthest, ARC));
        let double = double.into_iter().filter(|(spike, bent, _)| is_frond(spike, top, farthest, *bent));
        fronds.extend(double.map(|(spike, _, line)| (spike, vec![line])));
        let length = |points: &[Vec2]| polyline::length(points);
        let whole: f32 = runs.iter().map(|run| length(&run.0)).sum();
        let own: f32 = fronds.iter().map(|frond| frond.0.length()).sum();
        let nearest = |points: &[Vec2]| points.iter().map(|p| p.distance(top)).fold(f32::INFINITY, f32::min);
        let is_closed =
            |points: &[Vec2]| points[0].distance(points[points.len() - 1]) < CLOSED * length(points);
        let main = runs.iter().filter(|run| length(&run.0) > MAIN * whole && is_closed(&run.0));
        let apart = main.map(|run| nearest(&run.0) / reach(&run.0)).fold(0.0, f32::max);
        Self { fronds, reach: farthest, explained: own / whole.max(f32::MIN_POSITIVE), apart }
    }

    /// One blade for each frond, all from one root, with the trunk if there is one.
    pub(crate) fn hypothesis(&self, root: Vec2, trunk: Option<&TrunkSides>) -> Hypothesis {
        let blades = self.fronds.iter().map(|frond| Made::new(Tool::Leaf, frond.0.blade(root, HALF)));
        let trunk_lines = trunk.into_iter().flat_map(TrunkSides::lines);
        let mut uses: Vec<usize> =
            self.fronds.iter().flat_map(|frond| frond.1.clone()).chain(trunk_lines).collect();
        uses.sort_unstable();
        uses.dedup();
        Hypothesis {
            uses,
            score: 3.0 + 0.3 * self.fronds.len().min(6) as f32,
            parts: trunk.map(TrunkSides::branch).into_iter().chain(blades).collect(),
            solids: Vec::new(),
            reading: Reading::Fronds,
            habit: trunk.map(|_| Habit::Palm),
        }
    }

    /// Whether the tips of fronds with two sides are sharp.
    pub(crate) fn is_sharp(&self) -> bool {
        let mut angles: Vec<f32> = self.fronds.iter().filter_map(|frond| frond.0.angle(SHARP.1)).collect();
        let middle = angles.len() / 2;
        angles.is_empty() || *angles.select_nth_unstable_by(middle, f32::total_cmp).1 < SHARP.0
    }

    /// Whether all fronds begin at the top of a trunk of one line, and nothing else is near its foot: twigs leave a stem here and
    /// there, and the last arc of a cloud ends beside the others.
    pub(crate) fn sits_on(&self, trunk: &TrunkSides, rest: &[(Vec<Vec2>, usize)]) -> bool {
        let low = rest.iter().flat_map(|run| &run.0).map(|p| p.y).fold(f32::NEG_INFINITY, f32::max);
        let high = rest.iter().flat_map(|run| &run.0).map(|p| p.y).fold(trunk.top().y, f32::min);
        let begins =
            |spike: &Spike| spike.foot().distance(trunk.top()) < AT_TOP * spike.tip().distance(trunk.top());
        let is_free = trunk.foot().y - low > FREE * (trunk.foot().y - high);
        is_free && self.fronds.iter().all(|frond| begins(&frond.0))
    }

    /// Whether most fronds have two sides or hang.
    pub(crate) fn has_blades(&self) -> bool {
        let is_blade = |spike: &Spike| spike.flanks.len() == 2 || hangs(spike);
        2 * self.fronds.iter().filter(|frond| is_blade(&frond.0)).count() > self.fronds.len()
    }
}

/// The spikes of a run of points about `top`, and how much their flanks may turn against their bend. The farthest of all points
/// is so far away.
fn cut(points: &[Vec2], top: Vec2, farthest: f32) -> Vec<(Spike, f32)> {
    let own = points.iter().map(|p| p.distance(top)).fold(0.0, f32::max);
    let in_order = |all: Vec<Spike>| if goes_on(&all, top) { all } else { Vec::new() };
    let by_distance = in_order(spikes(points, |p| p.distance(top), PROMINENCE * own));
    let by_distance: Vec<Spike> =
        by_distance.into_iter().map(|spike| spike.hanging(points, top, DEEP)).collect();
    let folded = in_order(folded(points, top));
    let length = |all: &[Spike], bent: f32| -> f32 {
        all.iter().filter(|spike| is_frond(spike, top, farthest, bent)).map(Spike::length).sum()
    };
    // What a line folds back at has two sides; its ends alone are found by distance as well.
    let is_round = folded.iter().any(|spike| spike.flanks.len() == 2);
    let is_better = is_round && length(&folded, SERRATED) > FOLDED * length(&by_distance, ARC);
    let (all, bent) = if is_better { (folded, SERRATED) } else { (by_distance, ARC) };
    all.into_iter().map(|spike| (spike, bent)).collect()
}

/// Whether a spike is a frond of a trunk that ends at `top`, the farthest point being so far away; its flanks may turn so much
/// against their bend.
fn is_frond(spike: &Spike, top: Vec2, farthest: f32, bent: f32) -> bool {
    let far = spike.tip().distance(top);
    far > SHORTEST * farthest
        && spike.foot().distance(top) < DEEP * far
        && spike.is_slender(SLENDER, bent)
        && !goes_around(spike, far)
}

/// Whether the tips in one line follow each other around the trunk's top, as no scribble's do.
fn goes_on(spikes: &[Spike], top: Vec2) -> bool {
    let steps: Vec<f32> =
        spikes.windows(2).map(|pair| (pair[0].tip() - top).angle_to(pair[1].tip() - top)).collect();
    let left = steps.iter().filter(|step| **step > 0.0).count();
    steps.len() < SCRIBBLE || 10 * left.max(steps.len() - left) >= 7 * steps.len()
}

/// Whether a spike winds so much that its tip, so far from the trunk, is no frond's: the outline of a crown.
fn goes_around(spike: &Spike, far: f32) -> bool {
    let lengths = spike.flanks.iter().map(|flank| polyline::length(flank));
    lengths.fold(f32::INFINITY, f32::min) > AROUND * far
}

/// Whether the tip is well below the highest point.
pub(crate) fn hangs(spike: &Spike) -> bool {
    let highest = spike.flanks.iter().flatten().map(|p| p.y).fold(f32::INFINITY, f32::min);
    spike.tip().y > highest + 0.15 * spike.reach()
}
