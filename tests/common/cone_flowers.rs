//! Flowers drawn from known cones, in several whorls, as hands draw them: lengths and turns vary, the pen shakes, petals are
//! missing.

#![allow(dead_code, reason = "each user takes some of them")]

use glam::{Quat, Vec2, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use std::f32::consts::{PI, TAU};

/// Petals of one whorl.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ring {
    pub(crate) petals: usize,
    /// Angle between axis and petals, radians.
    pub(crate) opening: f32,
    /// Length of its petals, pixels.
    pub(crate) length: f32,
    /// Azimuth of the first petal, radians.
    pub(crate) start: f32,
    /// Share of the angle between neighbours that a petal fills.
    pub(crate) fullness: f32,
    /// Where petals begin, share of their length.
    pub(crate) foot: f32,
}

/// A flower as it is.
#[derive(Clone, Debug)]
pub(crate) struct Truth {
    pub(crate) center: Vec2,
    /// Unit, world directions.
    pub(crate) axis: Vec3,
    pub(crate) rings: Vec<Ring>,
    /// 0 pointed, 1 rounded, 2 rounded and flat.
    pub(crate) shape: u32,
}

/// How a hand departs from it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Hand {
    /// Standard deviation of lengths, share of the length.
    pub(crate) lengths: f32,
    /// That of turns, share of the angle between neighbours.
    pub(crate) turns: f32,
    /// That of the points, share of the diagonal.
    pub(crate) noise: f32,
    /// Petals of each ring that are left out, from the first.
    pub(crate) missing: usize,
}

/// A number of the standard normal distribution.
pub(crate) fn gauss(rng: &mut Pcg64Mcg) -> f32 {
    let (u, v): (f32, f32) = (rng.random_range(1e-6..1.0), rng.random_range(0.0..TAU));
    (-2.0 * u.ln()).sqrt() * v.cos()
}

/// An axis at an angle between these from the drawing, degrees.
pub(crate) fn axis(rng: &mut Pcg64Mcg, elevation: (f32, f32)) -> Vec3 {
    let rise = rng.random_range(elevation.0..elevation.1).to_radians();
    (Vec2::from_angle(rng.random_range(0.0..TAU)) * rise.cos()).extend(rise.sin())
}

impl Truth {
    /// The petals' outlines, ring by ring, each from its root round to it.
    pub(crate) fn drawn(&self, hand: &Hand, rng: &mut Pcg64Mcg) -> Vec<Vec<Vec2>> {
        let mut petals: Vec<Vec<Vec2>> = Vec::new();
        for ring in &self.rings {
            let sector = TAU / ring.petals as f32;
            for k in hand.missing..ring.petals {
                let azimuth = ring.start + sector * (k as f32 + hand.turns * gauss(rng));
                let size = 1.0 + hand.lengths * gauss(rng);
                petals.push(self.petal(ring, azimuth, size).into_iter().map(|p| self.seen(p)).collect());
            }
        }
        let all = || petals.iter().flatten();
        let low = all().fold(Vec2::INFINITY, |a, p| a.min(*p));
        let sigma = hand.noise * low.distance(all().fold(Vec2::NEG_INFINITY, |a, p| a.max(*p)));
        petals.iter_mut().flatten().for_each(|p| *p += sigma * Vec2::new(gauss(rng), gauss(rng)));
        petals
    }

    /// Where a point is seen that is given from the centre, in world directions.
    pub(crate) fn seen(&self, p: Vec3) -> Vec2 {
        self.center + Vec2::new(p.x, -p.y)
    }

    /// A petal's outline in space, counted from the centre, from its root over its tip in the middle round to its root.
    pub(crate) fn petal(&self, ring: &Ring, azimuth: f32, size: f32) -> Vec<Vec3> {
        let across = self.axis.any_orthonormal_vector();
        let half = 0.5 * (TAU / ring.petals as f32).min(1.2) * ring.fullness;
        let side = |around: f32| {
            let out = Quat::from_axis_angle(self.axis, around) * across;
            self.axis * ring.opening.cos() + out * ring.opening.sin()
        };
        let at = |share: f32, sign: f32| {
            let round = (share * (1.0 - share)).sqrt() * (1.2 + 0.8 * share);
            let along = ring.foot + (1.0 - ring.foot) * share;
            let p = match self.shape {
                0 => side(azimuth + sign * half * (PI * share).sin()) * along,
                1 => side(azimuth + sign * half * round) * along,
                _ => side(azimuth) * along + self.axis.cross(side(azimuth)) * (sign * half * round),
            };
            p * (ring.length * size)
        };
        let there = (0..=30).map(|i| at(i as f32 / 30.0, 1.0));
        there.chain((0..30).rev().map(|i| at(i as f32 / 30.0, -1.0))).collect()
    }
}
