//! How well drawn flowers are recovered, as a table: the figures of `docs/drawings.md`, and bounds to hold them.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use crate::cone_flowers::{self, Hand, Ring, Truth};
use crate::drawings;
use glam::{Quat, Vec2, Vec3};
use penstemon::anatomy::{self, AnatomyParams};
use penstemon::depth::{self, DepthParams};
use penstemon::plant::Plant;
use penstemon::sketch::Tool;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f32::consts::TAU;

/// How well a species knows how its flowers open, degrees.
const KNOWN_DEG: f32 = 8.0;

/// Flowers of each row.
const FLOWERS: usize = 300;

/// What the flowers of a row are.
#[derive(Clone, Copy)]
struct Case {
    /// Angles between axis and drawing, and between axis and petals, degrees.
    elevation: (f32, f32),
    opening: (f32, f32),
    petals: (usize, usize),
    hand: Hand,
    tool: Tool,
    /// How far the stem may leave the axis, degrees; none without a stem.
    stem: Option<f32>,
    /// Whether the species says how its flowers open.
    is_known: bool,
    /// Where petals begin, share of their length.
    foot: f32,
}

const PLAIN: Case = Case {
    elevation: (25.0, 80.0),
    opening: (20.0, 75.0),
    petals: (5, 21),
    hand: Hand { lengths: 0.0, turns: 0.0, noise: 0.005, missing: 0 },
    tool: Tool::Petal,
    stem: None,
    is_known: false,
    foot: 0.0,
};

/// What became of the flowers of a row.
#[derive(Default)]
struct Outcome {
    axis: Vec<f32>,
    opening: Vec<f32>,
    lost: usize,
    leaning: usize,
    hidden: usize,
}

impl Outcome {
    fn of(case: &Case, seed: u64) -> Self {
        let mut rng = Pcg64Mcg::seed_from_u64(seed);
        let mut out = Self::default();
        (0..FLOWERS).for_each(|_| out.add(case, &mut rng));
        out.axis.sort_by(f32::total_cmp);
        out.opening.sort_by(f32::total_cmp);
        out
    }

    fn add(&mut self, case: &Case, rng: &mut Pcg64Mcg) {
        let axis = cone_flowers::axis(rng, case.elevation);
        let opening = rng.random_range(case.opening.0..case.opening.1).to_radians();
        let ring = Ring {
            petals: rng.random_range(case.petals.0..=case.petals.1),
            opening,
            length: 200.0,
            start: rng.random_range(0.0..TAU),
            fullness: rng.random_range(0.6..1.0),
            foot: case.foot,
        };
        let truth =
            Truth { center: Vec2::splat(500.0), axis, rings: vec![ring], shape: rng.random_range(0..3) };
        let petals = truth.drawn(&case.hand, rng);
        let drawn = petals.len();
        let mut strokes: Vec<(Tool, Vec<Vec2>)> = petals.into_iter().map(|p| (case.tool, p)).collect();
        let around = Quat::from_axis_angle(axis, rng.random_range(0.0..TAU)) * axis.any_orthonormal_vector();
        let off = case.stem.unwrap_or(0.0).to_radians().tan() * rng.random_range(0.0..1.0f32);
        let along = (axis + around * off).normalize();
        let arrival = Vec2::new(along.x, -along.y).normalize_or(Vec2::NEG_Y);
        if case.stem.is_some() {
            let foot = truth.center - 700.0 * arrival;
            strokes.push((Tool::Branch, drawings::curve(foot, truth.center - 5.0 * arrival, 0.0)));
        }
        let mut params = DepthParams::default();
        if case.is_known {
            let known = opening.to_degrees() + KNOWN_DEG * cone_flowers::gauss(rng);
            params.cone.opening_prior = known.clamp(10.0, 85.0);
            params.cone.opening_spread = KNOWN_DEG;
        }
        let found = anatomy::analyse(&drawings::sketch(strokes), &AnatomyParams::default());
        let most = found.flowers.iter().map(|flower| flower.petals.len()).max().unwrap_or(0);
        self.lost += usize::from(most < drawn);
        let (plant, _) = depth::recover(&found, 0, &params);
        self.judge(&plant, axis, opening, arrival);
    }

    fn judge(&mut self, plant: &Plant, axis: Vec3, opening: f32, arrival: Vec2) {
        let Some(flower) = plant.flowers.first() else {
            self.axis.push(180.0);
            self.opening.push(180.0);
            return;
        };
        let cone = &flower.cone;
        self.axis.push(cone.axis.angle_between(axis).to_degrees());
        self.opening.push((cone.opening_rad - opening).to_degrees().abs());
        self.leaning += usize::from(Vec2::new(cone.axis.x, -cone.axis.y).dot(arrival) < -0.1);
        // Where petals lie over the stem on the sheet they must not lie behind it.
        if let Some(stem) = flower.branch.map(|branch| &plant.branches[branch]) {
            let over = |p: &&Vec3| {
                let off = (p.truncate() - cone.apex.truncate()).length() / flower.reach;
                (0.3..0.7).contains(&off)
            };
            let behind = |p: &Vec3| cone.depth_near(p.truncate(), p.z) < p.z;
            self.hidden += usize::from(stem.points.iter().filter(over).any(behind));
        }
    }
}

fn percent(count: usize) -> f32 {
    100.0 * count as f32 / FLOWERS as f32
}

/// Most that a row may have: median and 95th percentile of the error of the axis and of the opening, degrees; share of flowers
/// that lose a petal, and of those that lean toward their stem, percent.
struct Bounds {
    axis: [f32; 2],
    opening: [f32; 2],
    lost: f32,
    leaning: f32,
}

const fn at_most(axis: [f32; 2], opening: [f32; 2], lost: f32, leaning: f32) -> Bounds {
    Bounds { axis, opening, lost, leaning }
}

fn rows() -> Vec<(&'static str, Case, Bounds)> {
    let uneven = Hand { lengths: 0.03, ..PLAIN.hand };
    let one_side = Hand { missing: 5, ..PLAIN.hand };
    let natural = Hand { lengths: 0.08, turns: 0.08, ..PLAIN.hand };
    let missing = Case { hand: one_side, petals: (10, 21), ..PLAIN };
    let face_on = Case { hand: uneven, elevation: (75.0, 90.0), ..PLAIN };
    let open =
        Case { hand: natural, opening: (60.0, 82.0), elevation: (20.0, 85.0), petals: (5, 9), ..PLAIN };
    let end_on = Case { hand: natural, elevation: (15.0, 70.0), foot: 0.1, ..PLAIN };
    vec![
        ("pen shakes by 0.5 %", PLAIN, at_most([1.0, 4.0], [1.0, 6.0], 0.0, 1.0)),
        ("lengths vary by 3 %", Case { hand: uneven, ..PLAIN }, at_most([2.0, 8.0], [2.0, 10.0], 0.0, 1.0)),
        (
            "lengths and turns vary by 8 %",
            Case { hand: natural, ..PLAIN },
            at_most([4.5, 16.0], [3.5, 19.0], 0.0, 1.0),
        ),
        ("five petals of 10 to 21 missing", missing, at_most([2.0, 10.0], [1.5, 12.0], 0.0, 2.0)),
        (
            "five petals of 8 to 13 missing",
            Case { petals: (8, 13), ..missing },
            at_most([6.0, 100.0], [4.5, 36.0], 0.0, 14.0),
        ),
        (
            "the same with a stem",
            Case { petals: (8, 13), stem: Some(20.0), ..missing },
            at_most([6.0, 90.0], [4.5, 32.0], 0.0, 10.0),
        ),
        ("face-on, lengths vary by 3 %", face_on, at_most([5.5, 18.0], [14.0, 42.0], 0.0, 3.0)),
        (
            "the same, opening known to 8°",
            Case { is_known: true, ..face_on },
            at_most([2.5, 11.0], [6.0, 20.0], 0.0, 2.0),
        ),
        ("open, on a stem", Case { stem: Some(40.0), ..open }, at_most([6.0, 26.0], [3.5, 20.0], 0.0, 5.0)),
        ("petals end-on, roots apart", end_on, at_most([4.5, 18.0], [4.0, 20.0], 1.0, 1.0)),
    ]
}

#[test]
fn flowers_on_known_cones_come_back() {
    eprintln!("| drawing | axis | 95 % | opening | 95 % | petal lost | toward stem | behind stem |");
    let mut broken = Vec::new();
    for (name, case, most) in rows() {
        let out = Outcome::of(&case, 2026);
        let at = |list: &[f32]| [50, 95].map(|share| list[list.len() * share / 100]);
        let (axis, opening) = (at(&out.axis), at(&out.opening));
        let [lost, leaning, hidden] = [out.lost, out.leaning, out.hidden].map(percent);
        eprintln!(
            "| {name} | {:.1} | {:.1} | {:.1} | {:.1} | {lost:.1} | {leaning:.1} | {hidden:.1} |",
            axis[0], axis[1], opening[0], opening[1]
        );
        let found = [axis[0], axis[1], opening[0], opening[1], lost, leaning];
        let most = [most.axis[0], most.axis[1], most.opening[0], most.opening[1], most.lost, most.leaning];
        if found.iter().zip(&most).any(|(found, most)| found > most) {
            broken.push(format!("{name}: {found:?} of at most {most:?}"));
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// Share of flowers that lose a petal, percent, where from `min_petals` on those that gather are a flower.
fn losing_a_petal(min_petals: u32) -> f32 {
    let hand = Hand { lengths: 0.08, turns: 0.08, ..PLAIN.hand };
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    let lost = (0..FLOWERS).filter(|_| {
        let ring = Ring {
            petals: rng.random_range(5..=21),
            opening: rng.random_range(20f32..75.0).to_radians(),
            length: 200.0,
            start: rng.random_range(0.0..TAU),
            fullness: rng.random_range(0.6..1.0),
            foot: rng.random_range(0.05..0.15),
        };
        let axis = cone_flowers::axis(&mut rng, (10.0, 80.0));
        let truth =
            Truth { center: Vec2::splat(500.0), axis, rings: vec![ring], shape: rng.random_range(0..3) };
        let petals = truth.drawn(&hand, &mut rng);
        let drawn = petals.len();
        let mut params = AnatomyParams::default();
        params.flowers.min_petals = min_petals;
        let sketch = drawings::sketch(petals.into_iter().map(|petal| (Tool::Petal, petal)));
        anatomy::analyse(&sketch, &params).flowers.iter().all(|flower| flower.petals.len() < drawn)
    });
    percent(lost.count())
}

#[test]
fn petals_seen_end_on_stay_in_their_flower() {
    // With so many petals asked for no flower is one that short petals could join: each sees as far as it is long.
    let (alone, joined) = (losing_a_petal(50), losing_a_petal(3));
    eprintln!("{alone} % of flowers lose a petal that sees as far as it is long, {joined} % where it joins");
    assert!(alone > 3.0 && joined <= 0.5, "{alone} %, {joined} %");
}
