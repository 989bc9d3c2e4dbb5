//! The state of a pen as its tablet reports it, whatever way the report came.

use glam::{DVec2, Vec2};

/// The state of a pen over or on its tablet, as one report gives it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RawPen {
    /// The pen is near enough to be seen; a report without it says that the pen went away, and nothing else of it counts.
    pub in_range: bool,
    /// The tip, or the other end if [`Self::eraser`], touches.
    pub touches: bool,
    /// The eraser end points at the tablet.
    pub eraser: bool,
    /// Barrel buttons held: lower, upper, third.
    pub barrel: [bool; 3],
    /// Share of the active area, 0 to 1: x right, y toward the artist.
    pub position: DVec2,
    /// Share of the greatest pressure, 0 to 1; `None` for devices without.
    pub pressure: Option<f32>,
    /// Lean in degrees, −90 to 90: x toward the right, y toward the artist.
    pub tilt_deg: Vec2,
    /// Turn about the pen's own axis in degrees, 0 to 360 (not included).
    pub twist_deg: f32,
    /// Height over the surface as a share of the range in which the pen is seen, 0 to 1; 0 for devices without.
    pub distance: f32,
    /// The pen's serial number; 0 for devices without.
    pub serial: u64,
}
