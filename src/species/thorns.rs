//! Thorns: cones with elliptic feet on the bark, scattered by the golden angle, bent down (004 §2, §3.2.5).
//!
//! They stand closer at the foot of a stem than further up, and none stands on its young end.

use super::looks::ThornLook;
use crate::geom::polyline;
use crate::plant::{Branch, Shape};
use glam::{Quat, Vec2, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

/// Most thorns on one branch.
const MOST: usize = 60;
/// Half the length of a thorn's foot along the stem, as a share of its length, and least and greatest width against that.
const FOOT: f32 = 0.34;
const NARROWER: (f32, f32) = (0.5, 0.8);
/// Angles by which thorns bend toward the branch's base, degrees.
const DOWN_DEG: (f32, f32) = (20.0, 40.0);
/// Share of a branch at its end without thorns.
const YOUNG: f32 = 0.1;
/// How much farther apart thorns stand at the end of a branch than at its foot.
const SPARSER: f32 = 1.6;

/// The thorns of one branch.
pub(super) fn thorns(look: &ThornLook, branch: &Branch, rng: &mut Pcg64Mcg) -> Vec<Shape> {
    let mut out = Vec::new();
    let mut angle = rng.random_range(0.0..std::f32::consts::TAU);
    let mut wait = rng.random_range(0.3..1.3_f32);
    let whole = polyline::length(&branch.points);
    let mut before = 0.0;
    for (ends, radii) in branch.points.windows(2).zip(branch.radii.windows(2)) {
        let (from, run) = (ends[0], ends[1] - ends[0]);
        let radius = 0.5 * (radii[0] + radii[1]);
        let Some(along) = run.try_normalize() else { continue };
        let share = (before + 0.5 * run.length()) / whole;
        let step = look.spacing * radius * (1.0 + (SPARSER - 1.0) * share);
        let mut walked = wait * step;
        while walked < run.length() && before + walked < (1.0 - YOUNG) * whole && out.len() < MOST {
            angle += 2.4;
            out.push(thorn(from + along * walked, along, angle, radius, look.length, rng));
            walked += step * rng.random_range(0.7..1.3_f32);
        }
        wait = ((walked - run.length()) / step).max(0.0);
        before += run.length();
    }
    out
}

fn thorn(at: Vec3, along: Vec3, angle: f32, radius: f32, length: f32, rng: &mut Pcg64Mcg) -> Shape {
    let radial = Quat::from_axis_angle(along, angle) * along.any_orthonormal_vector();
    let length = length * radius * rng.random_range(0.8..1.2_f32);
    let half = (FOOT * length).min(1.6 * radius);
    let foot = Vec2::new(half, (half * rng.random_range(NARROWER.0..NARROWER.1)).min(0.8 * radius));
    let down = rng.random_range(DOWN_DEG.0..DOWN_DEG.1).to_radians();
    let (base, hook) = (at + radial * (0.75 * radius), -along * (length * down.tan()));
    Shape::Spike { base, tip: base + radial * length + hook, side: along, foot, hook }
}
