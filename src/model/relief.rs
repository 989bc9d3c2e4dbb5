//! Height of a blade over its rest surface: bending, hollow, fold, waves and pen pressure (000 §5.1.2, §5.1.3).
//!
//! Bending is 000 eq. 5.1, `A (x/L)⁴ + B (x/L)²` away from the face; the hollow is the product of eqs. 5.2 and 5.3,
//! with W the distance of the margin on the point's own side. Fold, waves and curl are ours: the fold is a V with a
//! rounded bottom, waves and curl grow with the square of the distance from the midrib and vanish on it.
//!
//! Where we depart: the papers move points along the flower's axis (000) or the petal's plane normal (002); here the
//! height is measured along the rest surface's own normal, so that steep petals bend as well. On narrow blades every
//! part of the relief but the bending is limited by the blade's width, so that a blade of grass does not become a
//! canyon; waves are limited by their length.

use super::flat::{BladeMeshParams, FlatBlade};
use super::sections::Sections;
use crate::plant::ResolvedBlade;
use glam::Vec2;

/// Steepest slope across the blade that hollow, fold and curl may reach.
const STEEPEST: f32 = 1.2;
/// Margins closer to the axis than this share of the widest fade out, so that curl and waves end softly at the tip.
const NARROWEST: f32 = 0.3;
/// Highest wave as a share of its length.
const WAVE_LIMIT: f32 = 0.15;

/// The relief of one blade, in its (u, v) metres.
pub(super) struct Relief<'a> {
    sections: &'a Sections,
    length: f32,
    per_length: f32,
    per_size: f32,
    per_widest: f32,
    quartic: f32,
    quadratic: f32,
    cup: f32,
    fold: f32,
    curl: f32,
    wave: f32,
    waves: f32,
}

impl<'a> Relief<'a> {
    pub(super) fn new(blade: &ResolvedBlade<'_>, flat: &'a FlatBlade, params: &BladeMeshParams) -> Self {
        let form = &blade.form;
        let length = blade.template.length();
        let widest = flat.sections.widest * flat.size;
        let limited = |height: f32, run: f32| height.clamp(-STEEPEST * run, STEEPEST * run);
        let wave_length = flat.perimeter * flat.size / form.ruffle_waves.max(1.0);
        Self {
            sections: &flat.sections,
            length,
            per_length: 1.0 / length,
            per_size: 1.0 / flat.size,
            per_widest: 1.0 / flat.sections.widest,
            quartic: -form.bend_quartic * length,
            quadratic: -form.bend_quadratic * length,
            // The parabolas of eqs. 5.2 and 5.3 have slopes of twice depth over width.
            cup: -4.0 * limited(0.25 * form.cup * length, 0.5 * widest),
            fold: limited(form.fold * length, widest),
            curl: limited(params.curl_height * length, 0.5 * widest),
            wave: (form.ruffle * length).clamp(0.0, WAVE_LIMIT * wave_length),
            waves: form.ruffle_waves,
        }
    }

    /// Metres toward the face at a point of the flat blade.
    pub(super) fn height(&self, p: Vec2) -> f32 {
        let x = (p.y * self.per_length).clamp(0.0, 1.25);
        let v = p.y * self.per_size;
        let off_middle = p.x * self.per_size - self.sections.middle.at(v);
        let side = self.sections.at(v, off_middle >= 0.0);
        let out = off_middle.abs();
        let widest = self.sections.widest;
        let across = (out / side.width.max(f32::MIN_POSITIVE)).min(1.0);
        let soft = (out / side.width.max(NARROWEST * widest)).min(1.0);
        let bend = (self.quartic * x * x + self.quadratic) * x * x;
        let hollow = self.cup * (x * (1.0 - x)).max(0.0) * (1.0 - across * across);
        let curl = self.curl * side.curl * soft * soft;
        let fold = if self.fold == 0.0 { 0.0 } else { self.fold * rounded(out * self.per_widest) };
        let wave = if self.wave == 0.0 { 0.0 } else { self.wave(p, x, soft) };
        bend + hollow + fold + curl + wave
    }

    /// Waves run around the blade's middle, fade toward it and toward the base.
    fn wave(&self, p: Vec2, x: f32, soft: f32) -> f32 {
        let from_middle = Vec2::new(p.x, p.y - 0.5 * self.length);
        let out = soft.max((2.0 * x - 1.0).clamp(0.0, 1.0));
        let base = (x / 0.3).min(1.0);
        self.wave * out * out * base * (self.waves * from_middle.x.atan2(-from_middle.y)).sin()
    }
}

/// |x| with a round bottom: 0 at 0, about |x| further out.
fn rounded(x: f32) -> f32 {
    const RADIUS: f32 = 0.12;
    (x * x + RADIUS * RADIUS).sqrt() - RADIUS
}

#[cfg(test)]
mod tests {
    use super::super::flat::{FlatScratch, flatten, waves_of};
    use super::*;
    use crate::plant::{Blade, BladeForm, Detail, RestSurface, Template};
    use glam::Vec3;

    fn oval(curl: f32) -> Template {
        let point = |k: usize| Vec2::from_angle(k as f32 * 0.1047) * Vec2::new(0.3, 0.5) + Vec2::Y * 0.5;
        Template::new((0..60).map(point).collect(), vec![curl; 60], 1.0, Detail::Full)
    }

    fn height(form: BladeForm, curl: f32, at: Vec2) -> f32 {
        let params = BladeMeshParams::default();
        let template = &oval(curl);
        let (base, rest) = (Vec3::ZERO, RestSurface::Plane);
        let blade = Blade { template, base, u: Vec3::X, v: Vec3::Y, rest, form };
        let flat = flatten(template, waves_of(&form), &params, &mut FlatScratch::default()).unwrap();
        Relief::new(&blade, &flat, &params).height(at)
    }

    const STILL: BladeForm = BladeForm {
        twist: 0.0,
        bend_quartic: 0.0,
        bend_quadratic: 0.0,
        cup: 0.0,
        fold: 0.0,
        ruffle: 0.0,
        ruffle_waves: 0.0,
        thickness: 0.01,
    };

    #[test]
    fn bending_follows_equation_5_1_away_from_the_face() {
        let form = BladeForm { bend_quartic: 0.1, bend_quadratic: 0.2, ..STILL };
        assert!((height(form, 0.0, Vec2::Y) + 0.3).abs() < 1e-5);
        assert!((height(form, 0.0, Vec2::Y * 0.5) + 0.1 / 16.0 + 0.2 / 4.0).abs() < 1e-5);
    }

    #[test]
    fn the_hollow_follows_equations_5_2_and_5_3() {
        let form = BladeForm { cup: 0.3, ..STILL };
        assert!((height(form, 0.0, Vec2::new(0.0, 0.5)) + 0.3 / 4.0).abs() < 1e-4);
        assert!((height(form, 0.0, Vec2::new(0.15, 0.5)) + 0.3 / 4.0 * 0.75).abs() < 1e-3);
        assert!(height(form, 0.0, Vec2::new(0.3, 0.5)).abs() < 1e-3);
    }

    #[test]
    fn curl_lifts_the_margin_and_leaves_the_midrib() {
        assert!((height(STILL, 1.0, Vec2::new(0.3, 0.5)) - 0.15).abs() < 2e-3);
        assert!((height(STILL, -1.0, Vec2::new(-0.3, 0.5)) + 0.15).abs() < 2e-3);
        assert_eq!(height(STILL, 1.0, Vec2::new(0.0, 0.5)), 0.0);
    }

    #[test]
    fn a_fold_raises_both_halves() {
        let form = BladeForm { fold: 0.2, ..STILL };
        assert!(height(form, 0.0, Vec2::new(0.2, 0.5)) > 0.1);
        assert!(height(form, 0.0, Vec2::new(-0.2, 0.5)) > 0.1);
        assert_eq!(height(form, 0.0, Vec2::new(0.0, 0.5)), 0.0);
    }

    #[test]
    fn waves_need_the_margin() {
        let form = BladeForm { ruffle: 0.05, ruffle_waves: 10.0, ..STILL };
        let highest = |radius: f32| {
            let at =
                |k: i32| Vec2::new(0.3, 0.5) * radius * Vec2::from_angle(k as f32 * 0.01) + Vec2::Y * 0.5;
            (0..628).map(|k| height(form, 0.0, at(k)).abs()).fold(0.0, f32::max)
        };
        assert!(highest(1.0) > 0.03 && highest(0.0) < 1e-6);
    }
}
