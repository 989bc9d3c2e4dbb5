//! Thorns: cones on the bark, scattered by the golden angle, pointing a little down.

use super::looks::ThornLook;
use crate::plant::{Branch, Shape};
use glam::{Quat, Vec2, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

/// Most thorns on one branch.
const MOST: usize = 60;
/// Radius of a thorn's foot, as a share of its length.
const FOOT: f32 = 0.28;
/// How far thorns lean toward the branch's base.
const LEAN: f32 = 0.45;

/// The thorns of one branch.
pub(super) fn thorns(look: &ThornLook, branch: &Branch, rng: &mut Pcg64Mcg) -> Vec<Shape> {
    let mut out = Vec::new();
    let mut angle = rng.random_range(0.0..std::f32::consts::TAU);
    let mut wait = rng.random_range(0.3..1.3_f32);
    for (ends, radii) in branch.points.windows(2).zip(branch.radii.windows(2)) {
        let (from, run) = (ends[0], ends[1] - ends[0]);
        let radius = 0.5 * (radii[0] + radii[1]);
        let Some(along) = run.try_normalize() else { continue };
        let step = look.spacing * radius;
        let mut walked = wait * step;
        while walked < run.length() && out.len() < MOST {
            angle += 2.4;
            out.push(thorn(from + along * walked, along, angle, radius, look.length));
            walked += step * rng.random_range(0.7..1.3_f32);
        }
        wait = (walked - run.length()) / step;
    }
    out
}

fn thorn(at: Vec3, along: Vec3, angle: f32, radius: f32, length: f32) -> Shape {
    let radial = Quat::from_axis_angle(along, angle) * along.any_orthonormal_vector();
    let axis = (radial - along * LEAN).normalize();
    let (length, foot) = (length * radius, (FOOT * length * radius).min(0.9 * radius));
    let profile =
        vec![Vec2::ZERO, Vec2::new(foot, 0.0), Vec2::new(0.35 * foot, 0.5 * length), Vec2::new(0.0, length)];
    Shape::Lathe { base: at + radial * (0.8 * radius), axis, profile }
}
