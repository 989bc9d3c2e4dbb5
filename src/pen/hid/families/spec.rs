//! A family joined with the ranges of one tablet.

use super::{Bytes, Family, RawPen};
use glam::{DVec2, Vec2};

/// Raw pressure above which a pen without a tip switch counts as touching, of [`THRESHOLD_OF`] steps: what the Linux
/// kernel's driver for Wacom tablets takes.
const THRESHOLD: u64 = 10;
const THRESHOLD_OF: u64 = 2047;
/// Twist is reported in fifths of a degree.
const TWIST_STEPS: i32 = 1800;

/// All that decoding needs to know of a tablet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spec {
    /// Layout of the reports.
    pub family: Family,
    /// Greatest raw x and y.
    pub steps: [u32; 2],
    /// Greatest raw pressure.
    pub pressure: u32,
    /// Greatest raw x and y of fingers, on tablets that feel them.
    pub touch: Option<[u32; 2]>,
    /// The pen's lean is measured; false where the layout has room for it but the tablet leaves noise there.
    pub tilts: bool,
    /// One byte too many stands before each report.
    pub shifted: bool,
    /// Report id of the maker's own protocol where waking the tablet decides it; reports with another id are copies for
    /// systems without a driver.
    pub report_id: Option<u8>,
    /// Length in bytes of the node's longest input report, id included; some layouts grow with it.
    pub report_length: usize,
}

impl Spec {
    /// The report speaks the protocol the tablet was woken into, or the node has no report ids.
    pub(super) fn speaks(&self, b: Bytes<'_>) -> bool {
        let id = b.u8(0);
        self.report_id.is_none_or(|expected| id == Some(expected) || id == Some(0))
    }

    /// A pen in range, touching if it is pressed.
    pub(super) fn pen(&self, x: impl Into<u32>, y: impl Into<u32>, pressure: impl Into<u32>) -> RawPen {
        let pressure = pressure.into();
        RawPen {
            in_range: true,
            touches: u64::from(pressure) * THRESHOLD_OF > THRESHOLD * u64::from(self.pressure.max(1)),
            position: DVec2::new(share(x.into(), self.steps[0]), share(y.into(), self.steps[1])),
            pressure: Some(share(pressure, self.pressure) as f32),
            ..RawPen::default()
        }
    }
}

/// Share of a range, 0 to 1.
pub(super) fn share(value: u32, greatest: u32) -> f64 {
    (f64::from(value) / f64::from(greatest.max(1))).min(1.0)
}

/// Lean in degrees from raw degrees, kept within what a pen can do.
pub(super) fn tilt(x_deg: impl Into<f32>, y_deg: impl Into<f32>) -> Vec2 {
    Vec2::new(x_deg.into(), y_deg.into()).clamp(Vec2::splat(-90.0), Vec2::splat(90.0))
}

/// Twist in degrees from fifths of a degree.
pub(super) fn twist(fifths: i32) -> f32 {
    fifths.rem_euclid(TWIST_STEPS) as f32 / 5.0
}
