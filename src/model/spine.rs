//! Prepares a skeleton for its rings: few points, no kink sharper than a ring can follow.
//!
//! Points that neither the skeleton's course nor its radius needs are dropped (Douglas–Peucker in space and radius),
//! sharp turns get rings close by on either side, and rings that would run into each other inside a bend are left out.
//! The first and the last point always stay.

use crate::geom::simplify;
use glam::Vec3;

/// One ring of a tube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ring {
    /// Centre in metres.
    pub(super) at: Vec3,
    /// Radius in metres, positive.
    pub(super) radius: f32,
    /// Unit direction of the skeleton.
    pub(super) tangent: Vec3,
}

impl Ring {
    /// Every bit of it.
    pub(super) fn bits(&self) -> [u32; 7] {
        let Self { at, radius, tangent } = self;
        [at.x, at.y, at.z, *radius, tangent.x, tangent.y, tangent.z].map(f32::to_bits)
    }

    /// The foot of a trunk stands level on its ground, as long as the trunk leans by less than 45 degrees.
    pub(super) fn levelled(self) -> Self {
        if self.tangent.y > std::f32::consts::FRAC_1_SQRT_2 {
            Self { tangent: Vec3::Y, ..self }
        } else {
            self
        }
    }
}

/// A ring between two.
pub(super) fn between(a: &Ring, b: &Ring, share: f32) -> Ring {
    Ring {
        at: a.at.lerp(b.at, share),
        radius: a.radius + (b.radius - a.radius) * share,
        tangent: a.tangent.lerp(b.tangent, share).try_normalize().unwrap_or(a.tangent),
    }
}

/// The ring at a length along rings, which have these lengths before them.
pub(super) fn at(rings: &[Ring], arcs: &[f32], arc: f32) -> Ring {
    let i = arcs.partition_point(|a| *a <= arc).clamp(1, rings.len() - 1);
    let share = ((arc - arcs[i - 1]) / (arcs[i] - arcs[i - 1])).clamp(0.0, 1.0);
    between(&rings[i - 1], &rings[i], share)
}

/// Memory that is used again for every tube.
#[derive(Debug, Default)]
pub(super) struct SpineScratch {
    spaced: Vec<Ring>,
    kept: Vec<bool>,
    pending: Vec<(usize, usize)>,
    flanked: Vec<Ring>,
}

/// How closely a skeleton is followed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Detail {
    /// Largest distance from the skeleton as a share of the radius there.
    pub(super) of_radius: f32,
    /// The least and the most that the distance is ever limited to, metres.
    pub(super) metres: (f32, f32),
}

/// Neighbouring rings stand at least this share of their radius apart.
const CLOSEST: f32 = 0.1;
/// Turns with a smaller cosine than this get a ring on either side, at this many radii.
const SHARP: f32 = 0.5;
const FLANK: f32 = 1.5;
/// The ring after a turn is this much farther away from it than the one before, as otherwise both would be one where a branch
/// turns back on itself.
const AFTER: f32 = 1.25;

/// Writes the rings of a skeleton of at least two points to `out`: at least two, never at the same place.
pub(super) fn rings(
    skeleton: impl Iterator<Item = (Vec3, f32)>,
    detail: Detail,
    scratch: &mut SpineScratch,
    out: &mut Vec<Ring>,
) {
    space(skeleton, &mut scratch.spaced);
    let spaced = &scratch.spaced;
    scratch.kept.clear();
    scratch.kept.resize(spaced.len(), false);
    simplify::mark((0, spaced.len() - 1), &mut scratch.kept, &mut scratch.pending, |a, b| {
        distance_from_chord(spaced, a, b, detail)
    });
    out.clear();
    out.extend(spaced.iter().zip(&scratch.kept).filter(|(_, kept)| **kept).map(|(ring, _)| *ring));
    flank_turns(out, &mut scratch.flanked);
    set_tangents(out);
    drop_overlapping(out);
    set_tangents(out);
}

/// Copies the skeleton, leaving out points that nearly repeat the one before them.
fn space(skeleton: impl Iterator<Item = (Vec3, f32)>, out: &mut Vec<Ring>) {
    out.clear();
    let mut last = None;
    for (at, radius) in skeleton {
        // Thinner than this drowns in the rounding of the coordinates.
        let radius = radius.max(at.abs().max_element() * 1e-5).max(f32::MIN_POSITIVE * 1e20);
        let ring = Ring { at, radius, tangent: Vec3::Y };
        if out.last().is_none_or(|before: &Ring| before.at.distance(at) >= CLOSEST * radius) {
            out.push(ring);
        }
        last = Some(ring);
    }
    let Some(last) = last else { return };
    while out.len() > 1 && out[out.len() - 1].at.distance(last.at) < CLOSEST * last.radius {
        out.pop();
    }
    let from = out[0];
    if from.at.distance(last.at) >= CLOSEST * last.radius {
        out.push(last);
    } else if out.len() == 1 {
        let along = (last.at - from.at).try_normalize().unwrap_or(Vec3::Y);
        out.push(Ring { at: from.at + along * (CLOSEST * last.radius.max(from.radius)), ..last });
    }
}

/// Distance of a skeleton point from the chord's tube as a multiple of the tolerance.
fn distance_from_chord(
    rings: &[Ring],
    a: usize,
    b: usize,
    detail: Detail,
) -> impl Fn(usize) -> f32 + use<'_> {
    let (from, to) = (rings[a], rings[b]);
    let along = to.at - from.at;
    let inverse = 1.0 / along.length_squared().max(f32::MIN_POSITIVE);
    move |i| {
        let ring = rings[i];
        let share = ((ring.at - from.at).dot(along) * inverse).clamp(0.0, 1.0);
        let off = ring.at.distance(from.at + along * share);
        let thicker = (ring.radius - from.radius - (to.radius - from.radius) * share).abs();
        let (nearest, farthest) = detail.metres;
        let tolerance = (detail.of_radius * ring.radius).min(farthest);
        (off / tolerance.max(nearest)).max(thicker / tolerance)
    }
}

/// Puts rings close before and after turns sharper than 60 degrees, so that only the turn itself narrows the tube.
fn flank_turns(rings: &mut Vec<Ring>, flanked: &mut Vec<Ring>) {
    flanked.clear();
    flanked.push(rings[0]);
    for w in rings.windows(3) {
        let legs = [w[0].at - w[1].at, w[2].at - w[1].at];
        let lengths = legs.map(Vec3::length);
        let sharp = -legs[0].dot(legs[1]) < SHARP * lengths[0] * lengths[1];
        let flank = |k: usize| {
            let away = FLANK * if k == 1 { AFTER } else { 1.0 };
            let share = away * w[1].radius / lengths[k].max(f32::MIN_POSITIVE);
            let radius = w[1].radius + (w[2 * k].radius - w[1].radius) * share;
            (sharp && share < 0.45).then(|| Ring { at: w[1].at + legs[k] * share, radius, ..w[1] })
        };
        flanked.extend(flank(0));
        flanked.push(w[1]);
        flanked.extend(flank(1));
    }
    flanked.push(rings[rings.len() - 1]);
    std::mem::swap(rings, flanked);
}

/// Tangents half way between the directions of the segments on both sides.
pub(super) fn set_tangents(rings: &mut [Ring]) {
    let last = rings.len() - 1;
    let mut before = None;
    for i in 0..=last {
        let after = (i < last).then(|| (rings[i + 1].at - rings[i].at).try_normalize()).flatten().or(before);
        let (b, a) = (before.or(after).unwrap_or(Vec3::Y), after.unwrap_or(Vec3::Y));
        rings[i].tangent = (a + b).try_normalize().unwrap_or(b);
        before = after;
    }
}

/// Leaves out rings that would cut through the ring before them: inside a bend, a ring comes nearer by the radius
/// times the turn.
fn drop_overlapping(rings: &mut Vec<Ring>) {
    let clear = |a: &Ring, b: &Ring| {
        let radius = a.radius.max(b.radius);
        a.at.distance(b.at) > radius * (a.tangent.distance(b.tangent) * 0.9).max(CLOSEST * 0.5)
    };
    let Some(end) = rings.pop() else { return };
    let mut kept = 1;
    for i in 1..rings.len() {
        if clear(&rings[kept - 1], &rings[i]) {
            rings[kept] = rings[i];
            kept += 1;
        }
    }
    rings.truncate(kept);
    while rings.len() > 1 && !clear(&rings[rings.len() - 1], &end) {
        rings.pop();
    }
    rings.push(end);
}

#[cfg(test)]
mod tests {
    use super::*;

    const DETAIL: Detail = Detail { of_radius: 0.1, metres: (0.0, 1.0) };

    fn prepared(points: &[Vec3], radius: f32) -> Vec<Ring> {
        let mut out = Vec::new();
        rings(points.iter().map(|p| (*p, radius)), DETAIL, &mut SpineScratch::default(), &mut out);
        out
    }

    #[test]
    fn straight_branches_need_two_rings() {
        let points: Vec<Vec3> = (0..50).map(|k| Vec3::Z * k as f32).collect();
        let out = prepared(&points, 0.5);
        assert_eq!(out.len(), 2);
        assert!(out.iter().all(|r| r.tangent == Vec3::Z));
    }

    #[test]
    fn a_bend_keeps_its_course_within_a_tenth_of_the_radius() {
        let points: Vec<Vec3> =
            (0..=60).map(|k| Vec3::new((k as f32 * 0.05).sin(), k as f32 * 0.05, 0.0)).collect();
        let out = prepared(&points, 0.1);
        assert!(out.len() < 40);
        for p in points {
            let off = out.windows(2).map(|w| {
                let along = w[1].at - w[0].at;
                let share = ((p - w[0].at).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                p.distance(w[0].at + along * share)
            });
            assert!(off.fold(f32::INFINITY, f32::min) <= 0.0101);
        }
    }

    #[test]
    fn a_hairpin_turns_in_steps() {
        let out = prepared(&[Vec3::ZERO, Vec3::Y * 3.0, Vec3::new(0.3, 0.0, 0.0)], 0.05);
        assert_eq!(out.len(), 5);
        assert!(out.windows(2).all(|w| w[0].tangent.dot(w[1].tangent) > -0.2), "{out:?}");
        assert!(out[1].at.distance(Vec3::Y * 3.0) < 0.1);
    }

    #[test]
    fn a_branch_that_turns_back_on_itself_has_no_ring_twice() {
        let along = Vec3::new(0.62963945, -0.44134066, 0.63934296);
        let out = prepared(&[Vec3::ZERO, along, 0.1 * along, 2.0 * along], 1e-4);
        for (i, a) in out.iter().enumerate() {
            assert!(out[i + 1..].iter().all(|b| a.at.distance(b.at) > 1e-5), "{out:?}");
        }
    }

    #[test]
    fn knots_thinner_than_their_radius_shrink_to_a_stub() {
        let points: Vec<Vec3> =
            (0..40).map(|k| Vec3::new((k as f32).sin(), (k as f32).cos(), 0.0) * 0.01).collect();
        let out = prepared(&points, 1.0);
        assert_eq!(out.len(), 2);
        assert!(out[0].at != out[1].at);
    }
}
