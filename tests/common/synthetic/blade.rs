//! Outlines of petals and leaves, root at the origin, tip near (0, 1).
//!
//! Most families are a width profile along the axis, walked up one side and down the other; [`ends`] then leaves a gap
//! at the root or overshoots it. Petals that are left wide open (gap up to [`WIDEST_GAP`] of the stroke's length) have
//! their own families.

use super::Family;
use glam::Vec2;
use penstemon::geom::polyline;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use std::f32::consts::{PI, TAU};

/// Largest distance between the ends of a petal left open, as a share of the stroke's length.
pub(crate) const WIDEST_GAP: f32 = 0.35;

/// Every family, each with the same share of the blades.
pub(crate) const FAMILIES: &[Family] = &[
    ("willow leaf", willow),
    ("ovate leaf", ovate),
    ("round petal", round_petal),
    ("daisy petal", daisy_petal),
    ("heart-shaped petal", heart),
    ("oak leaf", oak),
    ("maple leaf", maple),
    ("serrated leaf", serrated),
    ("petal open as a U", open_u),
    ("petal open as a V", open_v),
    ("leaf with its stalk", stalked),
    ("leaf with its midrib", midribbed),
    ("corolla in one stroke", corolla),
];

const STEPS: usize = 120;

/// Up one side and down the other: half-widths of both sides at t from root (0) to tip (1), axis bent sideways.
fn outline(bend: f32, half_width: impl Fn(f32) -> f32) -> Vec<Vec2> {
    let side = |i: usize, sign: f32| {
        let t = (1.0 - (PI * i as f32 / STEPS as f32).cos()) / 2.0;
        Vec2::new(bend * t * t + sign * half_width(t), t)
    };
    (0..=STEPS).map(|i| side(i, -1.0)).chain((0..STEPS).rev().map(|i| side(i, 1.0))).collect()
}

/// Profile of a closed blade: `width` at its widest, which lies at `peak` of the axis; `blunt` below 1 rounds both ends.
fn profile(width: f32, peak: f32, blunt: f32) -> impl Fn(f32) -> f32 {
    let skew = 0.5_f32.ln() / peak.ln();
    move |t| width / 2.0 * (PI * t.powf(skew)).sin().max(0.0).powf(blunt)
}

/// The outline with what hands do at its ends: left open, met, or drawn past each other.
fn ends(mut line: Vec<Vec2>, rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    match rng.random_range(0..3) {
        0 => {
            let cut = |rng: &mut Pcg64Mcg| (line.len() as f32 * rng.random_range(0.0..0.08)) as usize;
            let (front, back) = (cut(rng), line.len() - cut(rng));
            line[front..back].to_vec()
        }
        1 => {
            let past = (line.len() as f32 * rng.random_range(0.01..0.1)) as usize;
            line.extend_from_within(1..past.max(2));
            line
        }
        _ => {
            let tail = Vec2::new(rng.random_range(-0.08..0.08), rng.random_range(-0.12..0.02));
            line.push(tail);
            line
        }
    }
}

fn simple(rng: &mut Pcg64Mcg, width: (f32, f32), blunt: (f32, f32)) -> Vec<Vec2> {
    let shape = profile(
        rng.random_range(width.0..width.1),
        rng.random_range(0.3..0.65),
        rng.random_range(blunt.0..blunt.1),
    );
    outline(rng.random_range(-0.35..0.35), shape)
}

fn willow(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let line = simple(rng, (0.06, 0.22), (0.7, 1.4));
    ends(line, rng)
}

fn ovate(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let line = simple(rng, (0.22, 0.8), (0.6, 1.4));
    ends(line, rng)
}

fn round_petal(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let line = simple(rng, (0.7, 1.3), (0.4, 0.8));
    ends(line, rng)
}

fn daisy_petal(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let line = simple(rng, (0.1, 0.35), (0.3, 0.6));
    ends(line, rng)
}

fn heart(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let (notch, reach) = (rng.random_range(0.05..0.35), rng.random_range(0.1..0.3));
    let shape = profile(rng.random_range(0.6..1.2), rng.random_range(0.55..0.75), rng.random_range(0.5..1.0));
    let mut line = outline(rng.random_range(-0.2..0.2), shape);
    for p in &mut line {
        p.y -= notch * (-(p.x / reach).powi(2)).exp() * p.y.powi(3);
    }
    ends(line, rng)
}

fn oak(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let (lobes, depth) = (rng.random_range(2..6) as f32, rng.random_range(0.15..0.5));
    let shape = profile(rng.random_range(0.3..0.9), rng.random_range(0.4..0.65), rng.random_range(0.5..1.0));
    let line = outline(rng.random_range(-0.2..0.2), |t| {
        shape(t) * (1.0 - depth * (0.5 + 0.5 * (TAU * lobes * t).cos()))
    });
    ends(line, rng)
}

/// A closed curve in polar form about (0, 0.5), starting and ending at the root; `radius` of the turn 0 to 1.
fn polar(stretch: f32, turns: f32, radius: impl Fn(f32) -> f32) -> Vec<Vec2> {
    let at = |i: usize| {
        let turn = turns * i as f32 / (2 * STEPS) as f32;
        Vec2::from_angle(TAU * turn - PI / 2.0) * 0.5 * radius(turn) * Vec2::new(stretch, 1.0)
            + Vec2::new(0.0, 0.5)
    };
    (0..=2 * STEPS).map(at).collect()
}

fn maple(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let (lobes, depth) = (rng.random_range(3..8) as f32, rng.random_range(0.2..0.6));
    let line = polar(rng.random_range(0.6..1.2), 1.0, |turn| {
        1.0 - depth * (PI * lobes * turn).sin().abs().powf(0.6)
    });
    ends(line, rng)
}

fn serrated(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let (teeth, size) = (rng.random_range(5.0..14.0), rng.random_range(0.01..0.05));
    let shape = profile(rng.random_range(0.2..0.8), rng.random_range(0.3..0.6), rng.random_range(0.6..1.2));
    let line = outline(rng.random_range(-0.3..0.3), |t| {
        let within = t * (1.0 - t) * 4.0;
        shape(t) + size * within.sqrt() * (teeth * t).fract()
    });
    ends(line, rng)
}

/// Draws until the gap at the root is one that people leave.
fn open(rng: &mut Pcg64Mcg, shape: impl Fn(&mut Pcg64Mcg) -> Vec<Vec2>) -> Vec<Vec2> {
    loop {
        let line = shape(rng);
        let length = polyline::length(&line);
        if line[0].distance(line[line.len() - 1]) <= WIDEST_GAP * length {
            return line;
        }
    }
}

fn open_u(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    open(rng, |rng| {
        let (gap, bulge, round) =
            (rng.random_range(0.1..0.9), rng.random_range(0.0..0.3), rng.random_range(2.0..5.0));
        outline(rng.random_range(-0.3..0.3), |t: f32| {
            (1.0 - t.powf(round)).max(0.0).sqrt() * (gap / 2.0 + bulge * (PI * t).sin())
        })
    })
}

fn open_v(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    open(rng, |rng| {
        let (gap, bulge, sharp) =
            (rng.random_range(0.08..0.8), rng.random_range(-0.03..0.1), rng.random_range(0.9..1.6));
        outline(rng.random_range(-0.3..0.3), |t: f32| {
            ((1.0 - t.powf(sharp)) * gap / 2.0 + bulge * (PI * t).sin()).max(0.0)
        })
    })
}

fn stalked(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let line = simple(rng, (0.3, 1.0), (0.5, 1.2));
    let stalk = Vec2::new(rng.random_range(-0.1..0.1), -rng.random_range(0.1..0.65));
    [vec![stalk], ends(line, rng)].concat()
}

fn midribbed(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let mut line = simple(rng, (0.2, 0.9), (0.6, 1.3));
    let bend = line[STEPS].x;
    let reach = rng.random_range(0.5..0.95);
    line.extend((1..=20).map(|i| reach * i as f32 / 20.0).map(|t| Vec2::new(bend * t * t, t)));
    line
}

fn corolla(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    open(rng, |rng| {
        let petals = rng.random_range(3..9) as f32;
        let (heart, blunt) = (rng.random_range(0.05..0.7), rng.random_range(0.4..1.0));
        let turns = rng.random_range(0.6..1.03);
        polar(rng.random_range(0.5..1.0), turns, |turn| {
            heart + (1.0 - heart) * (PI * petals * turn).sin().abs().powf(blunt)
        })
    })
}
