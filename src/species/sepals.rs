//! Sepals: small blades on a ring behind the petals, between them where their numbers agree.

use super::looks::SepalLook;
use super::seat::Seat;
use crate::plant::{Blade, BladeForm, Detail, RestSurface, Template, TemplateId, Templates};
use glam::{Vec2, Vec3};
use std::f32::consts::{PI, TAU};

/// Outline points on each side.
const SIDE_POINTS: usize = 6;
/// How far behind the apex sepals begin, as a share of the reach.
const BEHIND: f32 = 0.012;
/// Largest angle between axis and sepals, radians: bent back as far as the stem allows.
const LARGEST_ANGLE: f32 = 0.92 * PI;

/// The sepals of a flower with `petals` petals of form `petal_form`; their template comes behind the others.
pub(super) fn sepals(
    look: &SepalLook,
    seat: &Seat,
    petals: usize,
    petal_form: &BladeForm,
    templates: &mut Templates,
) -> Vec<Blade> {
    let count = look.count.map_or(petals, |count| count as usize);
    let length = look.length * seat.reach;
    if length <= 0.0 || count == 0 {
        return Vec::new();
    }
    let outline = spindle(length, look.width, look.widest);
    let template = templates.add(Template::new(outline, Vec::new(), length, Detail::Reduced));
    // a hollow petal bulges backwards: stay behind the bulge
    let hollow = petal_form.cup.max(0.0).atan() * 0.8;
    let angle = (seat.opening_rad + hollow + look.gap_deg.to_radians()).min(LARGEST_ANGLE);
    let first = PI / count.max(1) as f32;
    let blade = |k: usize| {
        let radial = seat.around(first + TAU * k as f32 / count as f32);
        let v = seat.axis * angle.cos() + radial * angle.sin();
        let face = seat.axis * angle.sin() - radial * angle.cos();
        let base = seat.apex + radial * seat.rim - face * (BEHIND * seat.reach);
        blade_at(base, v, face, look.form, template)
    };
    (0..count).map(blade).collect()
}

/// A flat blade from `base` along `v` that looks toward `face`.
pub(super) fn blade_at(base: Vec3, v: Vec3, face: Vec3, form: BladeForm, template: TemplateId) -> Blade {
    Blade { template, base, u: v.cross(face), v, rest: RestSurface::Plane, form }
}

/// Outline that is pointed at both ends: `width` and `widest` are shares of the length.
fn spindle(length: f32, width: f32, widest: f32) -> Vec<Vec2> {
    let power = 0.5_f32.ln() / widest.clamp(0.1, 0.9).ln();
    let half = |t: f32| 0.5 * width.max(0.02) * (PI * t.powf(power)).sin();
    let at = |k: usize, side: f32| {
        let t = k as f32 / (SIDE_POINTS + 1) as f32;
        Vec2::new(side * half(t), t) * length
    };
    let right = (1..=SIDE_POINTS).map(|k| at(k, 1.0));
    let left = (1..=SIDE_POINTS).rev().map(|k| at(k, -1.0));
    std::iter::once(Vec2::ZERO).chain(right).chain([Vec2::new(0.0, length)]).chain(left).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outline_runs_counter_clockwise_and_is_widest_where_asked() {
        let outline = spindle(2.0, 0.5, 0.3);
        let area: f32 =
            (0..outline.len()).map(|i| outline[i].perp_dot(outline[(i + 1) % outline.len()])).sum();
        assert!(area > 0.0);
        let widest = outline.iter().max_by(|a, b| a.x.total_cmp(&b.x)).unwrap();
        assert!((widest.y / 2.0 - 0.3).abs() < 0.1 && widest.x > 0.45 * 0.5 * 2.0);
    }

    #[test]
    fn u_and_v_span_the_face() {
        let outline = spindle(1.0, 0.3, 0.5);
        let template = Templates::default().add(Template::new(outline, Vec::new(), 1.0, Detail::Reduced));
        let blade = blade_at(Vec3::ZERO, Vec3::Y, Vec3::Z, BladeForm::default(), template);
        assert!((blade.u.cross(blade.v) - Vec3::Z).length() < 1e-6);
    }
}
