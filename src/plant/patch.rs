//! A bicubic Bézier patch: the surface of one petal, `S(s, t) = Σ Σ B_i(s) B_j(t) P_ij` with cubic Bernstein polynomials
//! (003 §2.2, 004 eq. 5).
//!
//! The outline of a blade stays what it is: its points (u, v) are mapped to (s, t), so that notches, teeth and pointed tips
//! survive, which a bare patch with four corners could not have. t runs along v; s runs across from margin to margin of a
//! sheet about as wide as the petal is there, so that what the control points say is said where the petal is.
//!
//! Where we depart: 003 calls n = m = 4 bicubic; its own formula with 3 is right.
//!
//! Limits: a patch follows a surface only as far as cubics do. An arc of 120° across is met within 1 % of its radius, one of 150° within 3 %.

use glam::{Vec2, Vec3};
use serde::Serialize;
use std::sync::OnceLock;

/// Samples in each direction from which a patch is fitted.
const SAMPLES: usize = 7;

/// A surface over a sheet in a blade's plane.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BezierPatch {
    /// Control points, metres: rows from base to tip, in each from left to right; components along u, along v and toward
    /// the face of the blade.
    control: [[Vec3; 4]; 4],
    /// Smallest v of the sheet and its length, metres, which is positive.
    low: f32,
    length: f32,
    /// Half the width of the sheet along v as a cubic: four Bézier values, metres, positive.
    half_widths: [f32; 4],
}

/// The part of a blade's plane over which a patch lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheet {
    /// Smallest and largest v, metres.
    pub along: (f32, f32),
    /// Bézier values of half the width along v, metres.
    pub half_widths: [f32; 4],
}

impl Sheet {
    /// A sheet about as wide as `half_width` says at each share of the way from foot to tip, and nowhere much narrower than
    /// at its widest place.
    pub fn around(along: (f32, f32), half_width: impl Fn(f32) -> f32) -> Self {
        const NARROWEST: f32 = 0.3;
        let at = |k: usize| half_width(k as f32 / (SAMPLES - 1) as f32);
        let samples: [f32; SAMPLES] = std::array::from_fn(at);
        let widest = samples.iter().copied().fold(0.0, f32::max).max(f32::MIN_POSITIVE);
        let samples = samples.map(|width| Vec3::X * width.max(NARROWEST * widest));
        let half_widths =
            solved(least_squares(), &samples).map(|width| width.x.max(0.5 * NARROWEST * widest));
        Self { along, half_widths }
    }
}

impl BezierPatch {
    /// A patch with these control points over a sheet.
    pub fn new(control: [[Vec3; 4]; 4], sheet: &Sheet) -> Self {
        let (low, high) = sheet.along;
        let length = (high - low).max(f32::MIN_POSITIVE);
        Self { control, low, length, half_widths: sheet.half_widths }
    }

    /// The patch that comes nearest to a surface over a sheet: least squares over 7 × 7 samples in equal steps.
    pub fn fit(sheet: &Sheet, surface: impl Fn(Vec2) -> Vec3) -> Self {
        let inverse = least_squares();
        let at = |k: usize| k as f32 / (SAMPLES - 1) as f32;
        let (low, high) = sheet.along;
        // First along each row of samples, then across the rows.
        let mut rows = [[Vec3::ZERO; 4]; SAMPLES];
        for (j, row) in rows.iter_mut().enumerate() {
            let (v, half) = (low + (high - low) * at(j), cubic(&sheet.half_widths, at(j)));
            let samples: [Vec3; SAMPLES] =
                std::array::from_fn(|i| surface(Vec2::new(half * (2.0 * at(i) - 1.0), v)));
            *row = solved(inverse, &samples);
        }
        let column = |i: usize| -> [Vec3; 4] { solved(inverse, &rows.map(|row| row[i])) };
        let columns: [[Vec3; 4]; 4] = std::array::from_fn(column);
        Self::new(std::array::from_fn(|j| std::array::from_fn(|i| columns[i][j])), sheet)
    }

    /// The patch with its control points moved, along u, along v and toward the face.
    pub fn moved(&self, by: &[[Vec3; 4]; 4]) -> Self {
        let moved = |j: usize| std::array::from_fn(|i| self.control[j][i] + by[j][i]);
        Self { control: std::array::from_fn(moved), ..self.clone() }
    }

    /// The control points.
    pub fn control(&self) -> &[[Vec3; 4]; 4] {
        &self.control
    }

    /// The point over (u, v); beyond the sheet the polynomial goes on by a tenth at most.
    pub fn at(&self, uv: Vec2) -> Vec3 {
        const BEYOND: f32 = 0.1;
        let within = |share: f32| share.clamp(-BEYOND, 1.0 + BEYOND);
        let t = within((uv.y - self.low) / self.length);
        let half = cubic(&self.half_widths, t).max(f32::MIN_POSITIVE);
        let (across, along) = (bernstein(within(0.5 + 0.5 * uv.x / half)), bernstein(t));
        let row =
            |row: &[Vec3; 4]| row.iter().zip(across).map(|(point, weight)| *point * weight).sum::<Vec3>();
        self.control.iter().zip(along).map(|(points, weight)| row(points) * weight).sum()
    }

    /// Every number of it in a fixed order.
    pub fn words(&self) -> impl Iterator<Item = f32> + '_ {
        let sheet = [self.low, self.length].into_iter().chain(self.half_widths);
        self.control.iter().flatten().flat_map(|point| point.to_array()).chain(sheet)
    }

    /// Whether all of its numbers are finite.
    pub fn is_finite(&self) -> bool {
        self.words().all(f32::is_finite)
    }
}

/// A cubic by its Bézier values.
fn cubic(values: &[f32; 4], t: f32) -> f32 {
    values.iter().zip(bernstein(t)).map(|(value, weight)| value * weight).sum()
}

/// The cubic Bernstein polynomials at `t`.
fn bernstein(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

/// The control points of the curve that comes nearest to the samples.
fn solved(inverse: &[[f32; SAMPLES]; 4], samples: &[Vec3; SAMPLES]) -> [Vec3; 4] {
    std::array::from_fn(|i| inverse[i].iter().zip(samples).map(|(weight, sample)| *sample * *weight).sum())
}

/// `(BᵀB)⁻¹Bᵀ` for the Bernstein polynomials B at the samples.
fn least_squares() -> &'static [[f32; SAMPLES]; 4] {
    static INVERSE: OnceLock<[[f32; SAMPLES]; 4]> = OnceLock::new();
    INVERSE.get_or_init(|| {
        let rows: [[f64; 4]; SAMPLES] = std::array::from_fn(|k| {
            let t = k as f64 / (SAMPLES - 1) as f64;
            let s = 1.0 - t;
            [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
        });
        let normal: [[f64; 4]; 4] =
            std::array::from_fn(|i| std::array::from_fn(|j| rows.iter().map(|row| row[i] * row[j]).sum()));
        let inverse = glam::DMat4::from_cols_array_2d(&normal).inverse().to_cols_array_2d();
        std::array::from_fn(|i| {
            std::array::from_fn(|k| (0..4).map(|j| inverse[i][j] * rows[k][j]).sum::<f64>() as f32)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHEET: Sheet = Sheet { along: (0.0, 2.0), half_widths: [0.5; 4] };

    fn worst(patch: &BezierPatch, surface: impl Fn(Vec2) -> Vec3) -> f32 {
        let at = |i: i32, j: i32| Vec2::new(i as f32 / 20.0 - 0.5, j as f32 / 10.0);
        let off = |uv: Vec2| patch.at(uv).distance(surface(uv));
        (0..=20).flat_map(|i| (0..=20).map(move |j| at(i, j))).map(off).fold(0.0, f32::max)
    }

    #[test]
    fn what_is_cubic_is_met_exactly() {
        let cubic = |uv: Vec2| {
            let (u, v) = (uv.x, uv.y);
            Vec3::new(u + 0.2 * v * v * u, v - 0.3 * u * u * u, 0.4 * u * u - 0.1 * v * v * v + 0.2 * u * v)
        };
        assert!(worst(&BezierPatch::fit(&SHEET, cubic), cubic) < 1e-5);
    }

    #[test]
    fn rolled_petals_are_met_within_hundredths_of_their_radius() {
        for (across_deg, most) in [(120.0f32, 0.01), (150.0, 0.03)] {
            let radius = 1.0 / across_deg.to_radians();
            let rolled = |uv: Vec2| {
                let angle = uv.x / radius;
                Vec3::new(radius * angle.sin(), uv.y, radius * (1.0 - angle.cos()))
            };
            let off = worst(&BezierPatch::fit(&SHEET, rolled), rolled);
            assert!(off < most * radius, "{off} of {radius}");
        }
    }

    #[test]
    fn corners_are_those_of_the_sheet() {
        let flat = BezierPatch::fit(&SHEET, |uv| uv.extend(0.0));
        assert!(flat.control()[0][0].distance(Vec3::new(-0.5, 0.0, 0.0)) < 1e-5);
        assert!(flat.control()[3][3].distance(Vec3::new(0.5, 2.0, 0.0)) < 1e-5);
        assert!(flat.is_finite());
        assert!(!BezierPatch::fit(&SHEET, |_| Vec3::NAN).is_finite());
    }

    #[test]
    fn a_sheet_is_as_wide_as_its_petal() {
        let petal = |t: f32| 0.4 * (std::f32::consts::PI * t).sin();
        let sheet = Sheet::around((0.0, 1.0), petal);
        assert!((cubic(&sheet.half_widths, 0.5) - 0.4).abs() < 0.05);
        assert!((0.05..0.25).contains(&cubic(&sheet.half_widths, 0.0)));
        let flat = BezierPatch::fit(&sheet, |uv| uv.extend(0.0));
        assert!(flat.at(Vec2::new(0.2, 0.6)).distance(Vec3::new(0.2, 0.6, 0.0)) < 1e-4);
    }

    #[test]
    fn a_moved_control_point_draws_the_surface_after_it() {
        let flat = BezierPatch::fit(&SHEET, |uv| uv.extend(0.0));
        let mut by = [[Vec3::ZERO; 4]; 4];
        by[3] = [Vec3::Z; 4];
        let lifted = flat.moved(&by);
        let heights = [0.0, 1.0, 2.0].map(|v| lifted.at(Vec2::new(0.1, v)).z);
        let expected = [0.0, 0.125, 1.0];
        assert!((0..3).all(|k| (heights[k] - expected[k]).abs() < 1e-5), "{heights:?}");
    }
}
