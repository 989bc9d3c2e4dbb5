//! Where leaves and flowers grow: the nearest place on a branch (000 §4.3).
//!
//! A flower crowns the end of its stem, but the hand often stops the stem at the petals' edge: an end may be a whole
//! petal's length away from the centre, any other place on a branch less than half of that. A leaf whose stroke began
//! at its tip is turned round when only its tip touches a branch.

use super::{Attachment, FlatBlade, FlatFlower, Sample, blade_outline};
use crate::geom::{
    line_changes::LineChanges,
    segment_index::{Line, Near, SegmentIndex},
};
use crate::kept::{Kept, Same, Use};
use glam::Vec2;
use std::sync::Arc;

crate::parameters! {
    /// How far leaves and flowers may be from the branch they grow on.
    pub struct AttachParams {
        /// Farthest gap between a leaf's root and its branch.
        leaf_distance: f32 = 0.5, 0.02..=2.0, "of the leaf's length";
        /// Farthest gap between a flower's centre and the end of its stem.
        flower_distance: f32 = 1.2, 0.05..=3.0, "of the petals' length";
    }
}

/// How much nearer than a stem's end any other place must be to carry a flower.
const END_PREFERENCE: f32 = 2.5;

/// How much nearer than its root a leaf's tip must be to a branch for the leaf to be turned round.
const TURN_ROUND: f32 = 0.3;

/// What is remembered of one drawing's leaves and flowers for the next: where they grow. Only those are looked at again near
/// which a branch came or went.
#[derive(Debug, Default)]
pub struct Attacher {
    lines: Vec<Arc<Line>>,
    leaves: Kept<LeafKey, FlatBlade>,
    flowers: Kept<[u32; 3], Option<Attachment>>,
}

/// A leaf by what decides where it grows: its outline, known by its address, its root and its tip.
#[derive(Debug, PartialEq, Eq, Hash)]
struct LeafKey {
    outline: Same<[Sample]>,
    ends: [u32; 4],
}

impl LeafKey {
    fn of(leaf: &FlatBlade, used: Use) -> Self {
        let ([a, b], [c, d]) = (leaf.root.to_array(), leaf.tip.to_array());
        Self { outline: Same::of(&leaf.outline, used), ends: [a, b, c, d].map(f32::to_bits) }
    }
}

impl Attacher {
    /// For a single drawing, of which nothing is kept by name.
    pub fn for_one_build() -> Self {
        Self { lines: Vec::new(), leaves: Kept::for_one_call(), flowers: Kept::for_one_call() }
    }

    /// Gives leaves and flowers their places on the branches that these lines are.
    pub fn attach(
        &mut self,
        lines: Vec<Arc<Line>>,
        leaves: &mut Vec<FlatBlade>,
        (flowers, petals): (&mut [FlatFlower], &[FlatBlade]),
        params: &AttachParams,
    ) {
        let changes = LineChanges::between(&self.lines, &lines);
        self.renumber(&changes);
        let questions = if changes.is_everything() { 2 * leaves.len() + flowers.len() } else { 0 };
        self.lines.clone_from(&lines);
        let branches = Branches::new(lines, questions);
        let is_as_it_was = |leaf: &FlatBlade, _: &FlatBlade| {
            let farthest = farthest_of(leaf, params);
            !changes.may_matter(leaf.root, farthest) && !changes.may_matter(leaf.tip, farthest)
        };
        let placed = self.leaves.made_where(leaves, LeafKey::of, is_as_it_was, |leaf| {
            let mut leaf = leaf.clone();
            branches.attach_leaf(&mut leaf, params);
            leaf
        });
        *leaves = placed.to_vec();
        let reaches: Vec<(Vec2, f32)> = flowers
            .iter()
            .map(|flower| {
                let lengths = flower.petals.iter().map(|&p| petals[p].axis().length());
                (flower.center, params.flower_distance * lengths.fold(0.0, f32::max))
            })
            .collect();
        let places = self.flowers.made_where(
            &reaches,
            |(center, reach), _| [center.x, center.y, *reach].map(f32::to_bits),
            |(center, reach), _| !changes.may_matter(*center, *reach),
            |(center, reach)| branches.place_of_flower(*center, *reach),
        );
        for (flower, place) in flowers.iter_mut().zip(places) {
            flower.attachment = *place;
        }
    }

    /// Gives branches their new numbers in what is remembered.
    fn renumber(&mut self, changes: &LineChanges) {
        let is_known = |attachment: &mut Option<Attachment>| {
            let Some(place) = attachment else { return true };
            let number = changes.new_number(place.branch);
            place.branch = number.unwrap_or(place.branch);
            number.is_some()
        };
        self.leaves.keep_only(|leaf| is_known(&mut leaf.attachment));
        self.flowers.keep_only(is_known);
    }
}

/// How far from its ends a leaf looks for branches: a root farther away than this is turned round wherever the tip is near
/// enough to attach.
fn farthest_of(leaf: &FlatBlade, params: &AttachParams) -> f32 {
    params.leaf_distance * leaf.axis().length() / TURN_ROUND
}

/// The branches of a drawing, ready to be asked for the nearest place.
struct Branches {
    lines: Vec<Arc<Line>>,
    index: SegmentIndex,
}

impl Branches {
    fn new(lines: Vec<Arc<Line>>, questions: usize) -> Self {
        Self { index: SegmentIndex::new(lines.clone(), questions), lines }
    }

    fn attachment(&self, near: &Near) -> Attachment {
        let arcs = &self.lines[near.line].arcs;
        let at = arcs[near.segment] + near.share * (arcs[near.segment + 1] - arcs[near.segment]);
        Attachment { branch: near.line, at }
    }

    /// Gives a leaf its place; leaves it without one when no branch is near.
    fn attach_leaf(&self, leaf: &mut FlatBlade, params: &AttachParams) {
        let (reach, farthest) = (params.leaf_distance * leaf.axis().length(), farthest_of(leaf, params));
        let (root, tip) = (self.index.nearest(leaf.root, farthest), self.index.nearest(leaf.tip, farthest));
        let distance = |near: &Option<Near>| near.map_or(f32::INFINITY, |n| n.distance);
        let tip_first = distance(&tip) < TURN_ROUND * distance(&root) && distance(&root) > 0.3 * reach;
        if tip_first && distance(&tip) <= reach {
            blade_outline::swap_ends(leaf);
        }
        let nearest = if tip_first { tip } else { root };
        leaf.attachment = nearest.filter(|n| n.distance <= reach).map(|n| self.attachment(&n));
    }

    /// The place of a flower whose stem is at most `reach` pixels away.
    fn place_of_flower(&self, center: Vec2, reach: f32) -> Option<Attachment> {
        let candidates = self.index.within(center, reach);
        let scored = candidates.iter().map(|near| {
            let line = &self.lines[near.line];
            let end = line.points.last().map_or(f32::INFINITY, |p| p.distance(center));
            if end <= END_PREFERENCE * near.distance {
                (end, Attachment { branch: near.line, at: line.length() })
            } else {
                (END_PREFERENCE * near.distance, self.attachment(near))
            }
        });
        let best = scored.min_by(|a, b| a.0.total_cmp(&b.0));
        best.filter(|(score, _)| *score <= reach).map(|(_, place)| place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::Sample;

    fn stem() -> Branches {
        let line = (0..=10).map(|k| Vec2::new(0.0, 100.0 - 10.0 * k as f32));
        Branches::new(vec![Arc::new(Line::new(line))], 1)
    }

    fn leaf(root: Vec2, tip: Vec2) -> FlatBlade {
        let side = 0.2 * (tip - root).perp();
        let outline =
            [root, root.midpoint(tip) + side, tip, root.midpoint(tip) - side].map(Sample::neutral).into();
        FlatBlade { stroke: Some(2), outline, root, tip, copy_of: None, attachment: None }
    }

    #[test]
    fn a_leaf_takes_the_nearest_place() {
        let mut leaf = leaf(Vec2::new(3.0, 55.0), Vec2::new(40.0, 40.0));
        stem().attach_leaf(&mut leaf, &AttachParams::default());
        let place = leaf.attachment.unwrap();
        assert!((place.at - 45.0).abs() < 1e-3);
    }

    #[test]
    fn a_leaf_drawn_from_its_tip_is_turned_round() {
        let mut leaf = leaf(Vec2::new(40.0, 40.0), Vec2::new(1.0, 50.0));
        stem().attach_leaf(&mut leaf, &AttachParams::default());
        assert_eq!(leaf.root, Vec2::new(1.0, 50.0));
        assert!(leaf.attachment.is_some());
    }

    #[test]
    fn a_far_leaf_stays_free() {
        let mut leaf = leaf(Vec2::new(300.0, 0.0), Vec2::new(340.0, 0.0));
        stem().attach_leaf(&mut leaf, &AttachParams::default());
        assert_eq!(leaf.attachment, None);
    }

    #[test]
    fn a_flower_takes_the_end_of_a_stem_that_stops_short() {
        let place =
            stem().place_of_flower(Vec2::new(5.0, -18.0), 20.0 * AttachParams::default().flower_distance);
        assert_eq!(place, Some(Attachment { branch: 0, at: 100.0 }));
    }

    #[test]
    fn a_flower_in_the_middle_of_a_stem_sits_there() {
        let place =
            stem().place_of_flower(Vec2::new(1.0, 50.0), 20.0 * AttachParams::default().flower_distance);
        assert!((place.unwrap().at - 50.0).abs() < 1e-3);
    }
}
