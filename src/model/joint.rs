//! Where a branch leaves its parent, and which of the parent's bark it takes there.
//!
//! A branch's skeleton begins inside its parent. What is seen of it begins where a ring around it lies wholly outside of
//! the parent: its exit. The window that is cut into the parent's bark for it (`window`) is as wide as the branch is thick
//! and as long as the branch's slanting section through the bark; `wood` joins its rim to the ring at the exit.
//!
//! A branch is followed along its parent, whichever way that bends: it is out once it has passed through the bark and
//! does not come back soon after. One that leaves by a small angle is bent out of its parent over its first ring, as a
//! collar of real wood is: its window would be a long slit otherwise, and the strip around it would cut into the bark.
//!
//! Limits: a branch that never leaves its parent has no exit and is not seen.

use super::bend::Bend;
use super::spine::{self, Ring, between};
use crate::plant::junction::{COLLAR, Footprint, LEAST_ANGLE_RAD, LEAST_SINE, half_angle};
use glam::Vec3;
use std::ops::Range;

/// Space between the parent's bark and the first ring, as a share of the parent's radius: strips around coarse rings sag.
const CLEAR: f32 = 0.2;
/// Less than this of a branch outside, as a multiple of its radius, is not worth a joint.
const SHORTEST: f32 = 0.5;
/// How far the window reaches beyond the first ring, as a multiple of how far that reaches along the parent.
const OVERHANG: f32 = 1.2;
/// Widest window, as the sine of half its angle around the parent: beyond this the bark falls away from the branch.
const WIDEST: f32 = 0.85;

/// How far off its place a branch may leave, as a share of half its window, before it is led there.
const LED: f32 = 0.1;
/// How far it is led at most, as a multiple of half its window.
const FARTHEST_LED: f32 = 4.0;
/// Length over which it comes back to its own course, as a multiple of the way that it is led.
const AFTER: f32 = 4.0;

/// Where a branch leaves its parent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exit {
    /// The first ring outside.
    pub(super) ring: Ring,
    /// Length of the branch before it, metres along the rings.
    pub(super) arc: f32,
    /// Unit direction from the parent's axis to where the branch comes out, square to that axis.
    pub(super) outward: Vec3,
    /// Unit direction of the parent's axis there.
    pub(super) upward: Vec3,
    /// Length of the parent before the middle of the window, metres along its rings.
    pub(super) at: f32,
    /// Half the window's length along the parent, metres.
    pub(super) half_length: f32,
    /// Half the window's width as an angle around the parent, radians, less than a quarter turn.
    pub(super) half_angle: f32,
}

impl Exit {
    /// The bark that its window takes.
    fn footprint(&self) -> Footprint {
        let Self { at: along, outward, half_length, half_angle, .. } = *self;
        Footprint { along, outward, half_length, half_angle }
    }

    /// Whether two exits are the same in every bit.
    pub(super) fn is(&self, other: &Self) -> bool {
        let bits = |Self { ring, arc, outward, upward, at, half_length, half_angle }: &Self| {
            let directions = [outward, upward].map(|v| v.to_array().map(f32::to_bits));
            (ring.bits(), directions, [arc, at, half_length, half_angle].map(|x| x.to_bits()))
        };
        bits(self) == bits(other)
    }
}

/// Where a branch is watched for coming back into its parent, in radii of the parent beyond its exit.
const WATCH: f32 = 2.0;
/// Longest step of the watch, in radii of the parent; and most steps between two rings.
const STEP: f32 = 0.5;
const MOST_STEPS: f32 = 16.0;
/// Halvings of the step in which the exit lies.
const HALVINGS: u32 = 4;

/// The exit of a branch from its parent; `None` for one that stays inside. The parent's bark is free `from` a length along it
/// but for where others leave. The rings of a parent follow its skeleton only roughly, so the branch's foot is brought back
/// to their axis first. Where it would leave beside the parent's own foot, its end or another branch, it is led from where
/// there is bark for it.
pub(super) fn exit(
    branch: &mut [Ring],
    (parent, parent_arcs): (&[Ring], &[f32]),
    from: f32,
    others: &[Exit],
) -> Option<Exit> {
    let on = Parent { rings: parent, arcs: parent_arcs };
    let exit = on.leave(branch)?;
    let end = parent_arcs[parent_arcs.len() - 1];
    let place = |exit: &Exit| {
        let lowest = (from + exit.half_length).min(from.midpoint(end));
        free_place(exit, (lowest, (end - exit.half_length).max(lowest)), others)
    };
    let led = place(&exit);
    if (led - exit.at).abs() <= LED * exit.half_length {
        return Some(exit);
    }
    let place = |arc: f32| spine::at(parent, parent_arcs, arc).at;
    let way = place(led) - place(exit.at);
    let reach = exit.arc + AFTER * way.length();
    let mut arc = 0.0;
    for i in 0..branch.len() {
        let next = branch.get(i + 1).map_or(0.0, |next| next.at.distance(branch[i].at));
        let left = (1.0 - arc / reach).max(0.0);
        branch[i].at += way * left;
        arc += next;
    }
    let exit = on.leave(branch)?;
    Some(Exit { at: led.clamp(exit.at - exit.half_length, exit.at + exit.half_length), ..exit })
}

/// The place on the parent nearest to that of an exit which other branches leave free; the exit's own where there is none
/// near.
fn free_place(exit: &Exit, (lowest, highest): (f32, f32), others: &[Exit]) -> f32 {
    let own = exit.at.clamp(lowest, highest);
    let print = exit.footprint();
    let others = others.iter().map(Exit::footprint);
    let beside =
        || others.clone().filter(|other| print.angle_to(other) < print.half_angle + other.half_angle);
    let is_free = |at: f32| beside().all(|other| print.is_clear_at(at, &other));
    if is_free(own) {
        return own;
    }
    let next_to = beside().flat_map(|other| print.next_to(&other));
    let free = next_to.filter(|at| (lowest..=highest).contains(at) && is_free(*at));
    let nearest = free.min_by(|a, b| (a - own).abs().total_cmp(&(b - own).abs()));
    nearest.filter(|at| (at - own).abs() <= FARTHEST_LED * exit.half_length).unwrap_or(own)
}

/// A parent's rings and the length before each.
#[derive(Clone, Copy)]
struct Parent<'a> {
    rings: &'a [Ring],
    arcs: &'a [f32],
}

impl Parent<'_> {
    /// The exit of a branch whose foot is near.
    fn leave(self, branch: &mut [Ring]) -> Option<Exit> {
        let bark = self.foot(branch.first()?.at, 0..self.rings.len() - 1);
        branch[0].at = bark.ring.at;
        spine::set_tangents(branch);
        let mut way = Way { on: self, near: bark, exit: None, length: 0.0 };
        way.follow(branch);
        let (ring, arc) = way.exit.filter(|(ring, arc)| way.length - arc >= SHORTEST * ring.radius)?;
        let (ring, foot) = self.lean(ring, &way.near);
        let (across, along) = foot.off_axis(ring.at);
        let axis = foot.ring.tangent;
        let outward = across.try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector());
        let slant = ring.tangent.cross(axis).length();
        let collar = COLLAR * ring.radius;
        // Not shorter than what the first ring overhangs.
        let half_length = (collar / slant.max(LEAST_SINE)).max(OVERHANG * (along.abs() + collar * slant));
        let bend =
            Bend { parent: (self.rings, self.arcs), ring, outward, upward: axis, at: foot.arc, half_length };
        let [below, above] = bend.half_lengths();
        Some(Exit {
            ring,
            arc,
            outward,
            upward: axis,
            at: foot.arc + 0.5 * (above - below),
            half_length: 0.5 * (above + below),
            half_angle: half_angle(collar, foot.ring.radius, WIDEST),
        })
    }

    /// The place nearest to a point on some of the segments.
    fn foot(&self, p: Vec3, segments: Range<usize>) -> Foot {
        let (mut nearest, mut segment, mut share) = (f32::INFINITY, 0, 0.0);
        for i in segments {
            let (a, b) = (self.rings[i].at, self.rings[i + 1].at);
            let along = b - a;
            let here = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            let away = p.distance_squared(a + along * here);
            if away < nearest {
                (nearest, segment, share) = (away, i, here);
            }
        }
        let (a, b) = (&self.rings[segment], &self.rings[segment + 1]);
        let ring = Ring { tangent: (b.at - a.at).normalize(), ..between(a, b, share) };
        let arc = self.arcs[segment] + share * (self.arcs[segment + 1] - self.arcs[segment]);
        Foot { ring, segment, arc, left: self.arcs[self.arcs.len() - 1] - arc }
    }

    /// The first ring of a branch, and the place on the parent from which it comes. One that runs along its parent is bent
    /// out of it by [`LEAST_ANGLE_RAD`] at least, instead of leaving through a slit as long as the bark is thick.
    fn lean(&self, ring: Ring, near: &Foot) -> (Ring, Foot) {
        let beside = self.foot_near(ring.at, near);
        let axis = beside.ring.tangent;
        let (across, _) = beside.off_axis(ring.at);
        let outward = across.normalize_or(axis.any_orthonormal_vector());
        let along = ring.tangent.dot(axis);
        let tangent = if along.abs() < LEAST_ANGLE_RAD.cos() {
            ring.tangent
        } else {
            let sideways = ring.tangent.reject_from_normalized(axis).reject_from_normalized(outward);
            (axis * (along.signum() * LEAST_ANGLE_RAD.cos()) + outward * LEAST_ANGLE_RAD.sin() + sideways)
                .normalize()
        };
        let back = (across.length() - beside.ring.radius).max(0.0) / tangent.dot(outward).max(LEAST_SINE);
        (Ring { tangent, ..ring }, self.foot_near(ring.at - tangent * back, &beside))
    }

    /// The same near a place.
    fn foot_near(&self, p: Vec3, near: &Foot) -> Foot {
        let last = self.rings.len() - 1;
        self.foot(p, near.segment.saturating_sub(NEAR)..(near.segment + NEAR + 1).min(last))
    }
}

/// Segments on either side in which a parent's nearest place is looked for as the branch goes on.
const NEAR: usize = 3;

/// A branch's way out of its parent.
struct Way<'a> {
    on: Parent<'a>,
    /// The place on the parent beside its exit, or near to that.
    near: Foot,
    /// Its first ring outside, and the branch's length before it.
    exit: Option<(Ring, f32)>,
    /// The branch's whole length.
    length: f32,
}

impl Way<'_> {
    fn follow(&mut self, branch: &[Ring]) {
        let mut foot = self.near;
        let mut before = foot.clearance(&branch[0]);
        self.exit = (before >= 0.0).then_some((branch[0], 0.0));
        let mut watched = true;
        for w in branch.windows(2) {
            let run = w[0].at.distance(w[1].at);
            let steps = (run / (STEP * foot.ring.radius)).ceil().clamp(1.0, MOST_STEPS);
            for k in 1..=(if watched { steps as u32 } else { 0 }) {
                let (from, to) = ((k - 1) as f32 / steps, k as f32 / steps);
                let ring = between(&w[0], &w[1], to);
                let next = self.on.foot_near(ring.at, &foot);
                let here = next.clearance(&ring);
                if here < 0.0 {
                    self.exit = None;
                } else if before < 0.0 {
                    self.near = next;
                    let share = self.halved(w, (from, to), &foot);
                    self.exit = Some((between(&w[0], &w[1], share), self.length + share * run));
                }
                (before, foot) = (here, next);
                let beyond = self.exit.map_or(0.0, |(_, arc)| self.length + to * run - arc);
                if beyond > WATCH * foot.ring.radius {
                    watched = false;
                    break;
                }
            }
            self.length += run;
        }
    }

    /// The share of a segment at which the branch is just outside, between an inner and an outer one.
    fn halved(&self, w: &[Ring], (mut inner, mut outer): (f32, f32), foot: &Foot) -> f32 {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inner + outer);
            let ring = between(&w[0], &w[1], middle);
            if self.on.foot_near(ring.at, foot).clearance(&ring) < 0.0 {
                inner = middle;
            } else {
                outer = middle;
            }
        }
        outer
    }
}

/// A place on a parent.
#[derive(Clone, Copy)]
struct Foot {
    /// The parent's ring there; its tangent is the parent's axis.
    ring: Ring,
    segment: usize,
    /// Length of the parent before it and after it, metres along its rings.
    arc: f32,
    left: f32,
}

impl Foot {
    /// A point from here, divided into what lies across the axis and how far along it is.
    fn off_axis(&self, p: Vec3) -> (Vec3, f32) {
        let off = p - self.ring.at;
        let along = off.dot(self.ring.tangent);
        (off - self.ring.tangent * along, along)
    }

    /// How far the innermost point of a ring's collar lies outside of the bark or beyond the parent's end, metres;
    /// negative inside.
    fn clearance(&self, ring: &Ring) -> f32 {
        let (across, along) = self.off_axis(ring.at);
        let collar = COLLAR * ring.radius;
        let away = across.length();
        let facing = ring.tangent.dot(across) / away.max(f32::MIN_POSITIVE);
        let inner = collar * (1.0 - facing * facing).max(0.0).sqrt();
        (away - inner - (1.0 + CLEAR) * self.ring.radius).max(along - self.left - collar)
    }
}
