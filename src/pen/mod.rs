//! The pen: what every pointing device says, in one form.
//!
//! A source turns what its device reports into [`PenEvent`]s; nobody after it asks which device it was. Positions are
//! physical pixels of the window, x right, y down, with the fractions that the device knows; the canvas maps them to the
//! drawing. Every raw sample is an event of its own: a source never merges samples. [`grammar`] says in which order events
//! may come; every source is held against it.

pub mod arbiter;
pub mod calibration;
#[cfg(feature = "program")]
pub mod from_winit;
pub mod grammar;
pub mod hid;
pub mod machine;
pub mod mapping;
pub mod palm_gate;
pub mod pressure;
mod raw_pen;
pub mod ring;
#[cfg(test)]
pub(crate) mod tests;
#[cfg(feature = "program")]
#[cfg_attr(not(target_os = "linux"), path = "x11_absent.rs")]
pub mod x11;

pub use arbiter::{Arbiter, Origin, PenSource};
#[cfg(feature = "program")]
pub use from_winit::{TabletReports, WinitPen};
pub use machine::PenMachine;
pub use mapping::Mapping;
pub use palm_gate::PalmGate;
pub use pressure::PressureCurve;
#[cfg(feature = "program")]
pub use x11::X11Pens;

use glam::{DVec2, Vec2};

/// Farthest from the window's corner that a position may be, in physical pixels; a source drops what lies beyond.
pub const MAX_POSITION_PX: f64 = 1e6;

/// Which end of which thing touches the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PenTool {
    /// The tip of a pen.
    Pen,
    /// The other end of a pen.
    Eraser,
    /// A finger, told apart from other fingers by its number for as long as it touches.
    Finger(u64),
    /// A mouse or a touchpad.
    Mouse,
}

/// Buttons held while a sample was taken; the tip itself is no button.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PenButtons {
    /// Left mouse button, or the tip of the pen in contact.
    pub primary: bool,
    /// Right mouse button, or the lower barrel button of a pen.
    pub secondary: bool,
    /// Middle mouse button, or the upper barrel button of a pen.
    pub middle: bool,
    /// The third barrel button of a pen.
    pub third: bool,
}

/// One raw sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenSample {
    /// Window position in physical pixels.
    pub position: DVec2,
    /// Pressure 0 to 1; [`crate::sketch::StrokePoint::NEUTRAL_PRESSURE`] for devices without, 0 while hovering.
    pub pressure: f32,
    /// Tilt in degrees, −90 to 90: x toward the right, y toward the artist.
    pub tilt_deg: Vec2,
    /// Turn about the pen's own axis in degrees, 0 to 360; 0 for devices without.
    pub twist_deg: f32,
    /// Height over the surface as a share of the range in which the pen is seen, 0 to 1; 0 for devices without.
    pub distance: f32,
    /// What touches.
    pub tool: PenTool,
    /// Buttons held.
    pub buttons: PenButtons,
    /// Milliseconds on a clock that never goes back.
    pub time_ms: f64,
}

/// What happened with the sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PenPhase {
    /// The tool came into range without touching.
    Enter,
    /// It moved in range without touching.
    Hover,
    /// It touched.
    Down,
    /// It moved while touching.
    Move,
    /// It was lifted.
    Up,
    /// It went out of range.
    Leave,
    /// The system took the touch away: what it drew does not count.
    Cancel,
}

/// One event of a pen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenEvent {
    /// What happened.
    pub phase: PenPhase,
    /// Where and how.
    pub sample: PenSample,
}
