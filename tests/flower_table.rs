//! How well drawn flowers are recovered, as a table: `docs/flowers.md` shows it, and what it promises is held here.

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
    /// Whether the species says how its flowers open, to about 8°.
    is_known: bool,
}

const PLAIN: Case = Case {
    elevation: (25.0, 80.0),
    opening: (20.0, 75.0),
    petals: (5, 21),
    hand: Hand { lengths: 0.0, turns: 0.0, noise: 0.005, missing: 0 },
    tool: Tool::Petal,
    stem: None,
    is_known: false,
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
            let known = opening.to_degrees() + 8.0 * cone_flowers::gauss(rng);
            params.cone.opening_prior = known.clamp(10.0, 85.0);
            KNOWN(&mut params);
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
            self.hidden += usize::from(stem.points.iter().filter(over).any(|p| behind(p)));
        }
    }
}

const KNOWN: fn(&mut DepthParams) = |_| ();

fn percent(count: usize) -> f32 {
    100.0 * count as f32 / FLOWERS as f32
}

#[test]
fn table() {
    let uneven = Hand { lengths: 0.03, ..PLAIN.hand };
    let one_side = Hand { missing: 5, ..PLAIN.hand };
    let natural = Hand { lengths: 0.08, turns: 0.08, ..PLAIN.hand };
    let rows = [
        ("pen shakes by 0.5 %", PLAIN),
        ("lengths vary by 3 %", Case { hand: uneven, ..PLAIN }),
        ("lengths and turns vary by 8 %", Case { hand: natural, ..PLAIN }),
        ("five petals of 8 to 13 missing", Case { hand: one_side, petals: (8, 13), ..PLAIN }),
        ("the same with a stem", Case { hand: one_side, petals: (8, 13), stem: Some(20.0), ..PLAIN }),
        ("face-on, lengths vary by 3 %", Case { hand: uneven, elevation: (75.0, 90.0), ..PLAIN }),
        ("the same, species known", Case { hand: uneven, elevation: (75.0, 90.0), is_known: true, ..PLAIN }),
        ("open, on a stem", Case { hand: natural, opening: (60.0, 82.0), elevation: (20.0, 85.0), petals: (5, 9), stem: Some(40.0), ..PLAIN }),
        ("seen from the side, no tool", Case { elevation: (5.0, 60.0), petals: (5, 13), tool: Tool::Auto, ..PLAIN }),
        ("the same, lengths vary", Case { hand: natural, elevation: (5.0, 60.0), petals: (5, 13), tool: Tool::Auto, ..PLAIN }),
    ];
    for (name, case) in rows {
        let out = Outcome::of(&case, 2026);
        let at = |list: &[f32], share: usize| list[list.len() * share / 100];
        eprintln!("| {name} | {:.1} | {:.1} | {:.1} | {:.1} | lost {:.1} | leaning {:.1} | hidden {:.1} |", at(&out.axis, 50), at(&out.axis, 95), at(&out.opening, 50), at(&out.opening, 95), percent(out.lost), percent(out.leaning), percent(out.hidden));
    }
}
