//! Petals that the others of a flower hide in the drawing (003, layers).
//!
//! The petals of a whorl stand in equal turns about the axis. Where a turn is a multiple of the usual one, as many petals as
//! are missing there get copies of the petal before the gap: its outline is unrolled off the cone, and laid onto the cone again
//! further around, as a Bézier patch.
//!
//! Limits: at most [`HIDDEN`] petals of a whorl, so that flowers drawn from one side stay as they are.

use super::whorls::HIDDEN;
use crate::plant::{
    BezierPatch, Blade, BladeForm, Cone, Detail, ResolvedBlade, RestSurface, Sheet, Template,
};
use glam::{Quat, Vec2, Vec3};
use std::f32::consts::TAU;
use std::sync::Arc;

/// A petal with a template that no plant has yet.
pub(super) type MadePetal = Blade<Arc<Template>>;

/// Turns that are missing one petal or more, in usual ones.
const WIDE: f32 = 1.6;
/// How far a turn may be from a multiple of the usual one, in usual ones.
const CLEAR: f32 = 0.35;

/// Copies of a whorl's petals where others are hidden; `petals` are its blades on `cone`, world metres.
pub(super) fn hidden(petals: &[ResolvedBlade<'_>], cone: &Cone) -> Vec<MadePetal> {
    let mut around: Vec<(f32, usize)> = petals.iter().map(|petal| azimuth(petal, cone)).zip(0..).collect();
    around.sort_by(|a, b| a.0.total_cmp(&b.0));
    let turn = |k: usize| {
        let next = around[(k + 1) % around.len()].0;
        (next - around[k].0).rem_euclid(TAU)
    };
    let turns: Vec<f32> = (0..around.len()).map(turn).collect();
    let mut sorted = turns.clone();
    sorted.sort_by(f32::total_cmp);
    let Some(&usual) = sorted.get((sorted.len() - 1) / 2).filter(|usual| **usual > 0.1) else {
        return Vec::new();
    };
    let missing = |turn: f32| {
        let share = turn / usual;
        let is_multiple = share > WIDE && (share - share.round()).abs() < CLEAR;
        if is_multiple { share.round() as usize - 1 } else { 0 }
    };
    let all: usize = turns.iter().map(|turn| missing(*turn)).sum();
    if all > HIDDEN {
        return Vec::new();
    }
    let gaps = turns.iter().zip(&around).filter(|(turn, _)| missing(**turn) > 0);
    let copies = gaps.flat_map(|(turn, (_, before))| {
        let count = missing(*turn);
        let unrolled = Unrolled::of(&petals[*before], cone);
        (1..=count).map(move |k| unrolled.laid(cone, turn * k as f32 / (count + 1) as f32))
    });
    copies.collect()
}

/// Azimuth of a petal about the axis, radians: that of the middle of its outline.
fn azimuth(petal: &ResolvedBlade<'_>, cone: &Cone) -> f32 {
    let from_apex = petal.template.outline().iter().map(|uv| petal.at_rest(*uv) - cone.apex);
    around(cone, from_apex.sum())
}

/// Azimuth about the axis of a place that is counted from the apex, radians.
fn around(cone: &Cone, from_apex: Vec3) -> f32 {
    let first = cone.axis.any_orthonormal_vector();
    from_apex.dot(cone.axis.cross(first)).atan2(from_apex.dot(first))
}

/// A petal's outline unrolled off its cone: distance from the apex, and azimuth from the petal's.
struct Unrolled {
    /// Azimuth of the petal.
    at: f32,
    points: Vec<(f32, f32)>,
    curl: Vec<f32>,
    /// Distance of its base from the apex.
    foot: f32,
    length: f32,
}

impl Unrolled {
    fn of(petal: &ResolvedBlade<'_>, cone: &Cone) -> Self {
        let at = azimuth(petal, cone);
        let place = |uv: &Vec2| {
            let from_apex = petal.at_rest(*uv) - cone.apex;
            let off = around(cone, from_apex) - at;
            (from_apex.length(), (off + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU)
        };
        let points: Vec<(f32, f32)> = petal.template.outline().iter().map(place).collect();
        let foot = points.iter().map(|point| point.0).fold(f32::INFINITY, f32::min);
        let far = points.iter().map(|point| point.0).fold(0.0, f32::max);
        Self {
            at,
            points,
            curl: petal.template.curl().to_vec(),
            foot,
            length: (far - foot).max(f32::MIN_POSITIVE),
        }
    }

    /// The petal on the same cone, so far around it.
    fn laid(&self, cone: &Cone, turn: f32) -> MadePetal {
        let (sin, cos) = cone.opening_rad.sin_cos();
        let first = cone.axis.any_orthonormal_vector();
        let out = |azimuth: f32| Quat::from_axis_angle(cone.axis, self.at + turn + azimuth) * first;
        let side = |azimuth: f32| cone.axis * cos + out(azimuth) * sin;
        let (v, face) = (side(0.0), cone.axis * sin - out(0.0) * cos);
        let (u, base) = (v.cross(face), cone.apex + v * self.foot);
        // An angle in the unrolled sheet is an azimuth times the sine of the opening; seen from the face azimuths grow leftward.
        let outline: Vec<Vec2> = self
            .points
            .iter()
            .map(|(reach, azimuth)| {
                let (across, along) = (azimuth * sin).sin_cos();
                Vec2::new(-reach * across, reach * along - self.foot)
            })
            .collect();
        let surface = |uv: Vec2| {
            let place = Vec2::new(uv.x, uv.y + self.foot);
            let on_cone = cone.apex + side(-place.x.atan2(place.y) / sin) * place.length() - base;
            Vec3::new(on_cone.dot(u), on_cone.dot(v), on_cone.dot(face))
        };
        let patch = BezierPatch::fit(&self.sheet(&outline), surface);
        Blade {
            template: Arc::new(Template::new(outline, self.curl.clone(), self.length, Detail::Full)),
            base,
            u,
            v,
            rest: RestSurface::Patch(Arc::new(patch)),
            form: BladeForm::default(),
        }
    }

    /// A sheet about as wide as the outline.
    fn sheet(&self, outline: &[Vec2]) -> Sheet {
        let (low, high) =
            outline.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), p| (a.min(p.y), b.max(p.y)));
        let half = outline.iter().map(|p| p.x.abs()).fold(0.0, f32::max);
        Sheet::around((low, high), |_| half)
    }
}
