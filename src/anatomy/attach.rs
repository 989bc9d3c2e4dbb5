//! Where leaves and flowers grow: the nearest place on a branch (000 §4.3).
//!
//! A flower crowns the end of its stem, but the hand often stops the stem at the petals' edge: an end may be a whole
//! petal's length away from the centre, any other place on a branch less than half of that. A leaf whose stroke began
//! at its tip is turned round when only its tip touches a branch.

use super::{Attachment, FlatBlade, FlatBranch, FlatFlower, blade_outline};
use crate::geom::{
    polyline,
    region::{Near, SegmentIndex},
};
use glam::Vec2;

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

/// The branches of a drawing, ready to be asked for the nearest place.
pub struct Branches {
    lines: Vec<Vec<Vec2>>,
    arcs: Vec<Vec<f32>>,
    index: SegmentIndex,
}

impl Branches {
    /// Indexes the branches.
    pub fn new(branches: &[FlatBranch]) -> Self {
        let lines: Vec<Vec<Vec2>> =
            branches.iter().map(|b| b.line.iter().map(|s| s.position).collect()).collect();
        let arcs = lines.iter().map(|line| polyline::arc_lengths(line.iter().copied())).collect();
        let index = SegmentIndex::new(lines.iter().map(Vec::as_slice));
        Self { lines, arcs, index }
    }

    fn attachment(&self, near: &Near) -> Attachment {
        let arcs = &self.arcs[near.line];
        let at = arcs[near.segment] + near.share * (arcs[near.segment + 1] - arcs[near.segment]);
        Attachment { branch: near.line, at }
    }

    /// Gives a leaf its place; leaves it without one when no branch is near.
    pub fn attach_leaf(&self, leaf: &mut FlatBlade, params: &AttachParams) {
        let reach = params.leaf_distance * leaf.axis().length();
        // A root farther away than this is turned round wherever the tip is near enough to attach.
        let farthest = reach / TURN_ROUND;
        let (root, tip) = (self.index.nearest(leaf.root, farthest), self.index.nearest(leaf.tip, farthest));
        let distance = |near: &Option<Near>| near.map_or(f32::INFINITY, |n| n.distance);
        let tip_first = distance(&tip) < TURN_ROUND * distance(&root) && distance(&root) > 0.3 * reach;
        if tip_first && distance(&tip) <= reach {
            blade_outline::swap_ends(leaf);
        }
        let nearest = if tip_first { tip } else { root };
        leaf.attachment = nearest.filter(|n| n.distance <= reach).map(|n| self.attachment(&n));
    }

    /// Gives a flower its place, where its petals are `reach` pixels long.
    pub fn attach_flower(&self, flower: &mut FlatFlower, reach: f32, params: &AttachParams) {
        let reach = params.flower_distance * reach;
        let candidates = self.index.within(flower.center, reach);
        let scored = candidates.iter().map(|near| {
            let end = self.lines[near.line].last().map_or(f32::INFINITY, |p| p.distance(flower.center));
            let length = self.arcs[near.line].last().copied().unwrap_or(0.0);
            if end <= END_PREFERENCE * near.distance {
                (end, Attachment { branch: near.line, at: length })
            } else {
                (END_PREFERENCE * near.distance, self.attachment(near))
            }
        });
        let best = scored.min_by(|a, b| a.0.total_cmp(&b.0));
        flower.attachment = best.filter(|(score, _)| *score <= reach).map(|(_, place)| place);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::Sample;

    fn stem() -> Branches {
        let line = (0..=10).map(|k| Sample::neutral(Vec2::new(0.0, 100.0 - 10.0 * k as f32))).collect();
        Branches::new(&[FlatBranch {
            stroke: Some(1),
            key: 1,
            line,
            parent: None,
            attached_at: 0.0,
            level: 0,
        }])
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
        let mut flower = FlatFlower {
            petals: Vec::new(),
            center: Vec2::new(5.0, -18.0),
            heart_radius: None,
            attachment: None,
        };
        stem().attach_flower(&mut flower, 20.0, &AttachParams::default());
        assert_eq!(flower.attachment, Some(Attachment { branch: 0, at: 100.0 }));
    }

    #[test]
    fn a_flower_in_the_middle_of_a_stem_sits_there() {
        let mut flower = FlatFlower {
            petals: Vec::new(),
            center: Vec2::new(1.0, 50.0),
            heart_radius: None,
            attachment: None,
        };
        stem().attach_flower(&mut flower, 20.0, &AttachParams::default());
        assert!((flower.attachment.unwrap().at - 50.0).abs() < 1e-3);
    }
}
