//! How far the window of a branch reaches along a parent that bends.
//!
//! On a straight parent it reaches as far as the branch's slanting section through the bark (`joint`). On a bend the same
//! length of bark comes less far out about the branch where it draws together, and where it turns to run along the branch
//! the rim stands beside the first ring: the strip between them folds into faces that pass through each other. So the bark
//! is followed in steps from the middle of the window to either side, and what counts is how far it comes out about the
//! first ring, seen along the branch. A window that is too short is made longer, and one of which the end runs along the
//! branch ends before that.
//!
//! Limits: only the line through the middle of the window is followed. Where bark fans out on the outer side of a bend the window stays as it
//! is: with shorter ones more faces crossed each other. The numbers were found by counting those on the grown plants of
//! `tests/wood.rs`.

use super::spine::{self, Ring};
use crate::plant::junction::{COLLAR, LEAST_SINE};
use glam::Vec3;

/// A window that comes out less far than this, as a share of how far it does on a straight parent, is too short.
const SHORT: f32 = 0.8;
/// Bark that comes out by less than this share of its length runs along the branch.
const ALONG: f32 = 0.3;
/// How far a window comes out at least before its end may be left away, as a share of how far it does on a straight parent.
const ENOUGH: f32 = 0.8;
/// Steps in which the bark is followed over half the length of a window on a straight parent, and most steps.
const STEPS: u32 = 8;
const MOST_STEPS: u32 = 12;

/// Where a branch leaves a parent, and how far its window would reach if that were straight.
pub(super) struct Bend<'a> {
    /// The parent's rings, and its length before each.
    pub(super) parent: (&'a [Ring], &'a [f32]),
    /// The branch's first ring outside.
    pub(super) ring: Ring,
    /// Unit direction from the parent's axis to where the branch comes out, square to that axis.
    pub(super) outward: Vec3,
    /// Unit direction of the parent's axis there.
    pub(super) upward: Vec3,
    /// Length of the parent before the middle of the window, metres.
    pub(super) at: f32,
    /// Half the window's length on a straight parent, metres.
    pub(super) half_length: f32,
}

impl Bend<'_> {
    /// How far the window reaches from its middle to the parent's base and to its end, metres along the parent.
    pub(super) fn half_lengths(&self) -> [f32; 2] {
        let across = self.upward.reject_from_normalized(self.ring.tangent);
        // Seen along a branch that runs along its parent, the window has no length.
        if across.length() < LEAST_SINE {
            return [self.half_length; 2];
        }
        [-1.0, 1.0].map(|way| self.half_length_to(way, across.normalize()))
    }

    /// The same to one side: -1 to the base, 1 to the end. `across` is the window's direction, seen along the branch.
    fn half_length_to(&self, way: f32, across: Vec3) -> f32 {
        let (half, (rings, arcs)) = (self.half_length, self.parent);
        let room = if way < 0.0 { self.at } else { arcs[arcs.len() - 1] - self.at };
        if room < half {
            return half;
        }
        let reached = |length: f32| {
            let row = spine::at(rings, arcs, self.at + way * length);
            let outward = self.outward.reject_from_normalized(row.tangent).normalize_or(self.outward);
            way * (row.at + outward * row.radius - self.ring.at).dot(across)
        };
        let (step, wanted) = (half / STEPS as f32, half * self.upward.dot(across));
        let enough = (ENOUGH * wanted).max(COLLAR * self.ring.radius);
        let runs_along = |from: f32, to: f32| to - from < ALONG * step && from >= enough;
        let whole = reached(half);
        if whole >= SHORT * wanted && !runs_along(reached(half - step), whole) {
            return half;
        }
        let mut from = reached(0.0);
        for k in 0..MOST_STEPS {
            let length = k as f32 * step;
            let to = reached(length + step);
            if from >= wanted || runs_along(from, to) {
                return length;
            }
            if to >= wanted {
                return length + step * ((wanted - from) / (to - from));
            }
            from = to;
        }
        (MOST_STEPS as f32 * step).min(room)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::polyline;

    const RADIUS: f32 = 0.1;
    const HALF: f32 = 0.2;

    /// Half lengths of the window of a branch that leaves the middle of a parent to the right; the parent rises there.
    fn half_lengths(axis: impl Fn(f32) -> Vec3) -> [f32; 2] {
        let places: Vec<Vec3> = (-40..=40).map(|k| axis(0.02 * k as f32)).collect();
        let tangent =
            |k: usize| (places[(k + 1).min(places.len() - 1)] - places[k.saturating_sub(1)]).normalize();
        let ring = |k: usize| Ring { at: places[k], radius: RADIUS, tangent: tangent(k) };
        let rings: Vec<Ring> = (0..places.len()).map(ring).collect();
        let arcs = polyline::arc_lengths(places.iter().copied());
        let ring = Ring { at: Vec3::X * 1.3 * RADIUS, radius: 0.4 * RADIUS, tangent: Vec3::X };
        let (outward, upward, at) = (Vec3::X, Vec3::Y, arcs[40]);
        Bend { parent: (&rings, &arcs), ring, outward, upward, at, half_length: HALF }.half_lengths()
    }

    /// A parent bent to a circle about a centre to the right of its middle.
    fn bent_about(centre: f32) -> [f32; 2] {
        half_lengths(|arc| {
            let (sin, cos) = (arc / centre).sin_cos();
            centre * Vec3::new(1.0 - cos, sin, 0.0)
        })
    }

    #[test]
    fn a_straight_parent_and_the_outer_side_of_a_bend_change_nothing() {
        assert_eq!(half_lengths(|arc| Vec3::Y * arc), [HALF; 2]);
        assert_eq!(bent_about(-0.6), [HALF; 2]);
        assert_eq!(bent_about(2.0), [HALF; 2], "hardly bent");
    }

    #[test]
    fn on_the_inner_side_of_a_bend_the_window_is_longer_until_it_comes_out_as_far() {
        let (axis, bark) = (0.5, 0.5 - RADIUS);
        let expected = axis * (HALF / bark).asin();
        for found in bent_about(axis) {
            assert!((found - expected).abs() < 0.01 * expected && found > 1.2 * HALF, "{found} {expected}");
        }
    }

    #[test]
    fn bark_that_turns_to_run_along_the_branch_is_left_away() {
        // The parent bends to the right, so narrowly that its bark there hardly goes on.
        let (before, radius) = (0.82 * HALF, 1.2 * RADIUS);
        let turned = |arc: f32| {
            let (sin, cos) = ((arc - before).max(0.0) / radius).sin_cos();
            Vec3::new(radius * (1.0 - cos), arc.min(before) + radius * sin, 0.0)
        };
        let [below, above] = half_lengths(turned);
        assert_eq!(below, HALF);
        assert!((0.8 * HALF..0.95 * HALF).contains(&above), "{above}");
    }
}
