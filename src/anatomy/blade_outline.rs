//! Landmarks of a blade: clean outline, root, tip (000 §3.2).
//!
//! The root is the middle between the stroke's ends. Where the hand overshot and the ends cross and spread, the tails
//! are cut off first, and the crossing is the root; ends that lie close together stay the root even if a narrow base
//! is tangled. Where the sides cross just before the tip, the loop with the tip is kept. A blade seen edge-on is drawn out and back along nearly one line, and its two sides cross many times: its
//! outline is then the hull of the stroke.
//!
//! The tip is the farthest and sharpest place. 000 eq. 3.2 compares slopes (and is misprinted); slopes have no meaning
//! on vertical tangents, so sharpness is the turning angle over a short stretch of outline, and distance is measured
//! against the farthest sample: both are free of scale and direction.

use super::{FlatBlade, Sample, preprocess::turning};
use crate::geom::{convex_hull::convex_hull, simple_loop};
use crate::sketch::StrokeId;
use glam::Vec2;
use std::sync::Arc;

crate::parameters! {
    /// How the tip of a blade is found.
    pub struct TipParams {
        /// Weight of being far from the root.
        distance_weight: f32 = 1.0, 0.0..=10.0, "";
        /// Weight of being sharp; 000 eq. 3.2 takes half of the distance's.
        sharpness_weight: f32 = 0.5, 0.0..=10.0, "";
    }
}

/// Stretch of outline on each side of a place over which its turn is measured, as a share of the samples.
const TURN_SHARE: f32 = 0.05;

/// Share of a stroke's reach that its outline must keep for the rest to be tails.
const KEPT_REACH: f32 = 0.75;

/// A blade from the samples of its stroke; `None` when nothing is enclosed.
pub fn blade(stroke: StrokeId, samples: &[Sample], params: &TipParams) -> Option<FlatBlade> {
    let ends = (samples.first()?.position, samples.last()?.position);
    let open = without_repeated_end(samples);
    let mut root = ends.0.midpoint(ends.1);
    let far = reach(&open, root);
    let is_farthest = |s: &Sample| s.position.distance(root) == far;
    let mut outline =
        simple_loop::make_simple_keeping(open.clone(), |s| s.position, Sample::lerp, is_farthest);
    if outline.first() != samples.first() {
        if reach(&outline, root) < KEPT_REACH * far {
            outline = convex_hull(&open, |s| s.position);
            begin_between(&mut outline, ends);
        } else {
            begin_between(&mut outline, ends);
            let cut = outline.first()?.position;
            if ends.0.distance(ends.1) < root.distance(cut) {
                outline.insert(0, Sample { position: root, ..samples[0] });
            } else {
                root = cut;
            }
        }
    }
    if outline.len() < 3 || simple_loop::signed_area(outline.iter().map(|s| s.position)) == 0.0 {
        return None;
    }
    let tip = outline[tip_index(&outline, root, params)].position;
    Some(FlatBlade {
        stroke: Some(stroke),
        outline: outline.into(),
        root,
        tip,
        copy_of: None,
        attachment: None,
    })
}

/// Distance of the farthest sample from a place.
fn reach(samples: &[Sample], from: Vec2) -> f32 {
    samples.iter().map(|s| s.position.distance(from)).fold(0.0, f32::max)
}

/// The samples of a loop: where the hand returned to its first sample, that one is not repeated.
fn without_repeated_end(samples: &[Sample]) -> Vec<Sample> {
    let start = samples[0].position;
    let span = samples.iter().map(|s| s.position.distance(start)).fold(0.0, f32::max);
    let kept = samples.iter().rposition(|s| s.position.distance(start) > 1e-3 * span).map_or(1, |i| i + 1);
    samples[..kept].to_vec()
}

/// Rotates a loop to begin at the sample nearest to both ends of the stroke.
fn begin_between(outline: &mut [Sample], (first, last): (Vec2, Vec2)) {
    let away = |s: &Sample| s.position.distance(first) + s.position.distance(last);
    let start =
        (0..outline.len()).min_by(|&a, &b| away(&outline[a]).total_cmp(&away(&outline[b]))).unwrap_or(0);
    outline.rotate_left(start);
}

/// Index of the sample that is farthest and sharpest.
fn tip_index(outline: &[Sample], root: Vec2, params: &TipParams) -> usize {
    let n = outline.len();
    let farthest = outline.iter().map(|s| s.position.distance(root)).fold(f32::MIN_POSITIVE, f32::max);
    let reach = ((n as f32 * TURN_SHARE) as usize).clamp(1, n - 1);
    let sides = |i: usize| {
        let here = outline[i].position;
        let before = here - outline[i.saturating_sub(reach)].position;
        (before, outline[(i + reach).min(n - 1)].position - here)
    };
    let sharpness = |i: usize| {
        let (before, after) = sides(i);
        params.sharpness_weight * turning(before, after) / std::f32::consts::PI
    };
    let distance = |i: usize| params.distance_weight * outline[i].position.distance(root) / farthest;
    let span = reach..n.saturating_sub(reach);
    let far = span.clone().max_by(|&a, &b| distance(a).total_cmp(&distance(b)));
    // The arc tangent is dear and seldom needed: what cannot reach the farthest sample's score is passed over.
    let least = far.map_or(f32::NEG_INFINITY, |i| distance(i) + sharpness(i));
    let most_sharpness = |i: usize| {
        let (before, after) = sides(i);
        let (across, along) = (before.perp_dot(after).abs(), before.dot(after));
        // No angle below a right one is larger than its tangent; the margin is for rounding.
        params.sharpness_weight * if along > 0.0 { (across / along * 0.32).min(0.501) } else { 1.001 }
    };
    let mut best = (n / 2, f32::NEG_INFINITY);
    // Of equals the last wins.
    for i in span.rev() {
        let distance = distance(i);
        if distance + params.sharpness_weight <= best.1 || distance + most_sharpness(i) < least {
            continue;
        }
        let score = distance + sharpness(i);
        if score > best.1 {
            best = (i, score);
        }
    }
    best.0
}

/// Turns a blade round whose stroke began at its tip.
pub fn swap_ends(blade: &mut FlatBlade) {
    let tip = blade.tip;
    let at = (0..blade.outline.len())
        .min_by(|&a, &b| {
            let d = |i: usize| blade.outline[i].position.distance_squared(tip);
            d(a).total_cmp(&d(b))
        })
        .unwrap_or(0);
    Arc::make_mut(&mut blade.outline).rotate_left(at);
    std::mem::swap(&mut blade.root, &mut blade.tip);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(points: impl Iterator<Item = Vec2>) -> Vec<Sample> {
        points.map(|position| Sample { position, pressure: 0.5, tilt_deg: Vec2::ZERO }).collect()
    }

    /// A pointed leaf from the origin to (0, 100), `turn` radians away from up.
    fn leaf(turn: f32) -> Vec<Sample> {
        let half = |k: usize| k as f32 / 20.0;
        let right = (0..=20).map(|k| Vec2::new(half(k) * (1.0 - half(k)) * 80.0, half(k) * 100.0));
        let left = (0..20).rev().map(|k| Vec2::new(-half(k) * (1.0 - half(k)) * 80.0, half(k) * 100.0));
        samples(right.chain(left).map(|p| Vec2::from_angle(turn).rotate(p)))
    }

    #[test]
    fn root_and_tip_in_every_direction() {
        for k in 0..8 {
            let turn = k as f32 * 0.8;
            let blade = blade(1, &leaf(turn), &TipParams::default()).unwrap();
            assert!(blade.root.length() < 1e-3);
            assert!(blade.tip.distance(Vec2::from_angle(turn).rotate(Vec2::new(0.0, 100.0))) < 1e-2);
        }
    }

    #[test]
    fn crossing_tails_are_cut_and_the_crossing_is_the_root() {
        let mut tailed = samples([Vec2::new(-6.0, -10.0)].into_iter());
        tailed.extend(leaf(0.0)[1..40].iter().copied());
        tailed.extend(samples([Vec2::new(6.0, -10.0)].into_iter()));
        let blade = blade(1, &tailed, &TipParams::default()).unwrap();
        assert!(blade.root.distance(Vec2::ZERO) < 4.0, "{}", blade.root);
        assert!(blade.outline.iter().all(|s| s.position.y > -6.0));
    }

    #[test]
    fn a_blade_seen_edge_on_keeps_its_root_and_tip() {
        let wobble = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let out = (0..=30).map(|k| Vec2::new(wobble(k), 5.0 * k as f32));
        let back = (0..30).rev().map(|k| Vec2::new(-wobble(k), 5.0 * k as f32));
        let blade = blade(1, &samples(out.chain(back)), &TipParams::default()).unwrap();
        assert!(blade.root.length() < 5.0, "{}", blade.root);
        assert!(blade.tip.y > 140.0, "{}", blade.tip);
    }

    #[test]
    fn swapping_ends_keeps_the_outline() {
        let mut blade = blade(1, &leaf(0.0), &TipParams::default()).unwrap();
        let n = blade.outline.len();
        swap_ends(&mut blade);
        assert_eq!(blade.outline.len(), n);
        assert!(blade.root.y > 99.0 && blade.tip.y < 1.0);
        assert_eq!(blade.outline[0].position, blade.root);
    }

    #[test]
    fn a_straight_stroke_encloses_nothing() {
        let line = samples((0..10).map(|k| Vec2::new(k as f32, 0.0)));
        assert!(blade(1, &line, &TipParams::default()).is_none());
    }
}
