//! Flowers on known cones, drawn and recovered; and drawings that are no flower at all.

use super::cone_pose::{ConeParams, FlowerPose, PetalOutline, flower_pose};
use glam::{Vec2, Vec3};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f32::consts::{PI, TAU};

/// Shape of the synthetic petals.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Petal {
    /// Lens on the cone, pointed at both ends.
    Pointed,
    /// Round-ended, widest beyond the middle, on the cone.
    Rounded,
    /// Round-ended with a notch in the tip, on the cone.
    Notched,
    /// Lens in the plane that touches the cone along the midrib.
    FlatPointed,
    /// Round-ended in that plane.
    FlatRounded,
}

const PETALS: [Petal; 5] =
    [Petal::Pointed, Petal::Rounded, Petal::Notched, Petal::FlatPointed, Petal::FlatRounded];

/// A flower and how its petals are spread.
#[derive(Clone, Copy, Debug)]
struct Truth {
    /// World directions.
    axis: Vec3,
    opening: f32,
    center: Vec2,
    slant: f32,
    petals: usize,
    /// Share of the angle between neighbours that a petal fills.
    fullness: f32,
    /// Azimuth of the first petal.
    start: f32,
    samples: usize,
}

impl Truth {
    fn facing(theta_deg: f32, azimuth: f32, opening_deg: f32, petals: usize) -> Self {
        let theta = theta_deg.to_radians();
        let axis = Vec3::new(theta.cos() * azimuth.cos(), theta.cos() * azimuth.sin(), theta.sin());
        let opening = opening_deg.to_radians();
        let (center, slant) = (Vec2::new(400.0, 300.0), 100.0);
        Self { axis, opening, center, slant, petals, fullness: 0.8, start: 0.3, samples: 24 }
    }

    fn random(rng: &mut Pcg64Mcg, petals: usize) -> Self {
        let (theta, azimuth) = (rng.random_range(25.0..80.0), rng.random_range(0.0..TAU));
        Self {
            center: Vec2::new(rng.random_range(0.0..1000.0), rng.random_range(0.0..1000.0)),
            slant: rng.random_range(20.0..400.0),
            fullness: rng.random_range(0.5..1.0),
            start: rng.random_range(0.0..TAU),
            samples: rng.random_range(15..50),
            ..Self::facing(theta, azimuth, rng.random_range(20.0..75.0), petals)
        }
    }

    fn outline(&self, petal: Petal, k: usize, uneven: f32) -> Vec<Vec2> {
        let spacing = TAU / self.petals as f32;
        let azimuth = self.start + (k as f32 + uneven) * spacing;
        let (e1, half) = (self.axis.any_orthonormal_vector(), 0.5 * spacing * self.fullness);
        let e2 = self.axis.cross(e1);
        let side = |phi: f32| {
            self.axis * self.opening.cos() + (e1 * phi.cos() + e2 * phi.sin()) * self.opening.sin()
        };
        let at = |t: f32, sign: f32| {
            let round = (t * (1.0 - t)).sqrt() * (1.2 + 0.8 * t);
            let p = match petal {
                Petal::Pointed => side(azimuth + sign * half * (PI * t).sin()) * t,
                Petal::Rounded => side(azimuth + sign * half * round) * t,
                Petal::Notched => {
                    let notch = 0.12 * (1.0 - (2.0 * round).min(1.0));
                    side(azimuth + sign * half * round) * (t * (1.0 - notch))
                }
                Petal::FlatPointed => {
                    side(azimuth) * t + self.axis.cross(side(azimuth)) * (sign * half * (PI * t).sin())
                }
                Petal::FlatRounded => {
                    side(azimuth) * t + self.axis.cross(side(azimuth)) * (sign * half * round)
                }
            };
            self.center + Vec2::new(p.x, -p.y) * self.slant
        };
        let n = self.samples;
        let up = (0..=n).map(|i| at(i as f32 / n as f32, 1.0));
        up.chain((0..n).rev().map(|i| at(i as f32 / n as f32, -1.0))).collect()
    }

    fn outlines(&self, petal: Petal) -> Vec<Vec<Vec2>> {
        (0..self.petals).map(|k| self.outline(petal, k, 0.0)).collect()
    }
}

fn gauss(rng: &mut Pcg64Mcg) -> f32 {
    let (u, v): (f32, f32) = (rng.random_range(1e-6..1.0), rng.random_range(0.0..TAU));
    (-2.0 * u.ln()).sqrt() * v.cos()
}

fn diagonal(outlines: &[Vec<Vec2>]) -> f32 {
    let all = || outlines.iter().flatten();
    let low = all().fold(Vec2::INFINITY, |a, &b| a.min(b));
    low.distance(all().fold(Vec2::NEG_INFINITY, |a, &b| a.max(b)))
}

fn shake(outlines: &mut [Vec<Vec2>], sigma: f32, rng: &mut Pcg64Mcg) {
    for p in outlines.iter_mut().flatten() {
        *p += Vec2::new(gauss(rng), gauss(rng)) * sigma;
    }
}

fn pose(outlines: &[Vec<Vec2>], params: &ConeParams) -> FlowerPose {
    let petals: Vec<_> = outlines.iter().map(|o| PetalOutline { points: o, root: o[0] }).collect();
    flower_pose(&petals, None, params)
}

fn degrees_off(pose: &FlowerPose, truth: &Truth) -> f32 {
    pose.axis.angle_between(truth.axis).to_degrees()
}

/// Median and 95th percentile of the axis's error in degrees over many random flowers.
fn errors(petal: Petal, noise: f32, flowers: usize) -> (f32, f32) {
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    let mut error = || {
        let count = rng.random_range(5..=21);
        let truth = Truth::random(&mut rng, count);
        let uneven = rng.random_range(0.0..0.1);
        let mut outlines: Vec<_> =
            (0..count).map(|k| truth.outline(petal, k, uneven * gauss(&mut rng))).collect();
        let sigma = noise * diagonal(&outlines);
        shake(&mut outlines, sigma, &mut rng);
        degrees_off(&pose(&outlines, &ConeParams::default()), &truth)
    };
    let mut all: Vec<f32> = (0..flowers).map(|_| error()).collect();
    all.sort_by(f32::total_cmp);
    (all[flowers / 2], all[flowers * 95 / 100])
}

#[test]
fn clean_drawings_give_the_axis_back() {
    for petal in PETALS {
        let (median, p95) = errors(petal, 0.0, 300);
        assert!(median < 0.3 && p95 < 1.5, "{petal:?}: median {median}°, 95th percentile {p95}°");
    }
}

#[test]
fn half_a_percent_of_noise_costs_few_degrees() {
    for petal in PETALS {
        let (median, p95) = errors(petal, 0.005, 300);
        assert!(median < 1.5 && p95 < 6.0, "{petal:?}: median {median}°, 95th percentile {p95}°");
    }
}

#[test]
fn opening_height_tips_and_depths_come_back() {
    let truth = Truth::facing(50.0, 1.2, 35.0, 9);
    let outlines = truth.outlines(Petal::Pointed);
    let pose = pose(&outlines, &ConeParams::default());
    assert!(pose.determined);
    assert!((pose.outermost().opening_rad - truth.opening).abs() < 0.01, "{pose:?}");
    assert!((pose.outermost().slant_px - truth.slant).abs() < 1.0 && pose.residual < 1e-3, "{pose:?}");
    assert!((pose.outermost().height_px - truth.slant * truth.opening.cos()).abs() < 1.0, "{pose:?}");
    for ((tip, depth), outline) in pose.tips.iter().zip(&pose.tip_depths).zip(&outlines) {
        assert!(tip.distance(outline[truth.samples]) < 1.0);
        // Whatever side of the cone the petal is on, tip and depth together lie one slant from the apex.
        let reach = (tip - pose.center).extend(*depth).length();
        assert!((reach - truth.slant).abs() < 0.02 * truth.slant, "{reach}");
    }
}

#[test]
fn start_and_direction_of_the_strokes_do_not_matter() {
    let truth = Truth::facing(40.0, 2.0, 50.0, 6);
    let straight = truth.outlines(Petal::Rounded);
    let roots: Vec<_> = straight.iter().map(|o| o[0]).collect();
    let mut turned = straight.clone();
    for (k, outline) in turned.iter_mut().enumerate() {
        outline.rotate_left(5 * k);
        outline.reverse();
    }
    let petals: Vec<_> =
        turned.iter().zip(&roots).map(|(o, &root)| PetalOutline { points: o, root }).collect();
    let off = flower_pose(&petals, None, &ConeParams::default()).axis.angle_between(truth.axis);
    assert!(off < 0.005, "{off}");
}

#[test]
fn canvas_scale_does_not_matter() {
    let truth = Truth::facing(35.0, 4.0, 60.0, 8);
    let small = pose(&truth.outlines(Petal::Rounded), &ConeParams::default());
    let big: Vec<Vec<_>> = truth
        .outlines(Petal::Rounded)
        .into_iter()
        .map(|o| o.into_iter().map(|p| p * 10.0).collect())
        .collect();
    let big = pose(&big, &ConeParams::default());
    assert!(big.axis.angle_between(small.axis) < 1e-3);
    assert!((big.outermost().slant_px / small.outermost().slant_px - 10.0).abs() < 1e-2);
}

#[test]
fn a_flower_drawn_face_on_opens_by_the_prior() {
    for petals in [3, 5, 12] {
        let outlines = Truth::facing(90.0, 0.0, 30.0, petals).outlines(Petal::Rounded);
        let params = ConeParams { opening_prior: 50.0, ..ConeParams::default() };
        let pose = pose(&outlines, &params);
        assert!(pose.axis.z > 0.99 && !pose.determined, "{pose:?}");
        assert!((pose.outermost().opening_rad.to_degrees() - 50.0).abs() < 2.0, "{pose:?}");
    }
}

#[test]
fn the_pose_does_not_jump_as_a_flower_turns_face_on() {
    let turned = |theta: f32| {
        pose(&Truth::facing(theta, 0.7, 40.0, 8).outlines(Petal::Rounded), &ConeParams::default())
    };
    let mut before = turned(60.0);
    for step in 1..=120 {
        let now = turned(60.0 + 0.25 * step as f32);
        let opened = (now.outermost().opening_rad - before.outermost().opening_rad).to_degrees().abs();
        let turned = now.axis.angle_between(before.axis).to_degrees();
        assert!(opened < 3.0 && turned < 2.0, "step {step}: {opened}° opened, {turned}° turned");
        before = now;
    }
}

#[test]
fn flipped_flowers_face_away_over_the_same_drawing() {
    let outlines = Truth::facing(40.0, 2.0, 50.0, 7).outlines(Petal::Pointed);
    let front = pose(&outlines, &ConeParams::default());
    let back = pose(&outlines, &ConeParams { flip: true, ..ConeParams::default() });
    assert_eq!(back.axis, front.axis * Vec3::new(1.0, 1.0, -1.0));
    assert_eq!(back.tips, front.tips);
    assert!(front.tip_depths.iter().zip(&back.tip_depths).all(|(a, b)| *a == -b));
}

#[test]
fn three_or_four_even_petals_are_enough() {
    for petals in [3, 4] {
        let truth = Truth { fullness: 0.4, ..Truth::facing(45.0, 1.0, 45.0, petals) };
        let pose = pose(&truth.outlines(Petal::Pointed), &ConeParams::default());
        assert!(degrees_off(&pose, &truth) < 15.0, "{petals}: {pose:?}");
        assert!(!pose.determined);
    }
}

#[test]
fn petals_on_one_side_only_are_a_side_view() {
    // A fan of equally long petals over 140°, upward on the canvas: also half of a circle seen face-on.
    let fan: Vec<Vec<Vec2>> = (0..7)
        .map(|k| {
            let along = Vec2::from_angle((-160.0f32 + 140.0 / 6.0 * k as f32).to_radians());
            let at = |t: f32, sign: f32| along * t * 80.0 + along.perp() * sign * 9.0 * (PI * t).sin();
            let up = (0..20).map(|i| at(i as f32 / 20.0, 1.0));
            up.chain((1..=20).rev().map(|i| at(i as f32 / 20.0, -1.0))).collect()
        })
        .collect();
    let pose = pose(&fan, &ConeParams::default());
    assert!(pose.axis.y > 0.5 && pose.axis.x.abs() < 0.2 && !pose.determined, "{pose:?}");
}

#[test]
fn one_odd_petal_does_little_harm() {
    let truth = Truth::facing(45.0, 3.0, 50.0, 10);
    let mut outlines = truth.outlines(Petal::Rounded);
    let root = outlines[2][0];
    outlines[2].iter_mut().for_each(|p| *p = root + (*p - root) * 1.3);
    let pose = pose(&outlines, &ConeParams::default());
    assert!(degrees_off(&pose, &truth) < 6.0, "{pose:?}");
}

#[test]
fn nothing_drawn_is_a_flower_of_no_size() {
    let pose = flower_pose(&[], None, &ConeParams::default());
    assert_eq!((pose.axis, pose.outermost().slant_px, pose.tips.len()), (Vec3::Z, 0.0, 0));
}

fn check_sane(pose: &FlowerPose, petals: usize) {
    let opening = pose.outermost().opening_rad.to_degrees();
    assert!((7.9..=85.1).contains(&opening), "{pose:?}");
    assert!((pose.axis.length() - 1.0).abs() < 1e-4 && pose.axis.z > 0.0, "{pose:?}");
    assert!(
        pose.outermost().slant_px.is_finite()
            && pose.outermost().height_px.is_finite()
            && pose.residual.is_finite(),
        "{pose:?}"
    );
    assert!(
        pose.outermost().slant_px >= 0.0 && pose.outermost().height_px >= 0.0 && pose.center.is_finite(),
        "{pose:?}"
    );
    assert!(pose.tips.len() == petals && pose.tip_depths.len() == petals, "{pose:?}");
    assert!(
        pose.tip_depths.iter().all(|d| d.is_finite()) && pose.tips.iter().all(|t| t.is_finite()),
        "{pose:?}"
    );
}

proptest! {
    #[test]
    fn scribbles_give_a_sane_pose(
        strokes in prop::collection::vec(prop::collection::vec((-1e3..1e3f32, -1e3..1e3f32), 1..30), 0..25),
        size in prop::sample::select(vec![1e-3f32, 1.0, 1e4]),
    ) {
        let outlines: Vec<Vec<Vec2>> =
            strokes.iter().map(|s| s.iter().map(|&(x, y)| Vec2::new(x, y) * size).collect()).collect();
        check_sane(&pose(&outlines, &ConeParams::default()), outlines.len());
    }

    #[test]
    fn degenerate_strokes_give_a_sane_pose(
        kinds in prop::collection::vec((0..5u8, -100i32..100, -100i32..100), 1..12),
    ) {
        let outline = |&(kind, x, y): &(u8, i32, i32)| {
            let p = Vec2::new(x as f32, y as f32);
            match kind {
                0 => vec![p; 3],
                1 => vec![Vec2::ZERO, p],
                2 => vec![Vec2::ZERO, p, p * 2.0, p],
                3 => vec![Vec2::ZERO, Vec2::new(f32::NAN, 1.0), p],
                _ => vec![Vec2::ZERO, Vec2::new(p.x, 10.0), Vec2::new(p.x, 20.0)],
            }
        };
        let outlines: Vec<_> = kinds.iter().map(outline).collect();
        check_sane(&pose(&outlines, &ConeParams::default()), outlines.len());
    }
}
