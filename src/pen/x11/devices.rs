//! Which devices of an X server are pens, and what their axes mean.
//!
//! Drivers number axes as they like and label them. Numbers are made comparable by the axis's own limits; tilt by its
//! resolution, which X gives in units per radian. An event carries only the axes that changed, so a device keeps the last
//! value of each. Pads, the keys beside a tablet, and its touch surface may carry a pen's axes too and are told apart by the
//! type that the driver gives them; so are erasers, or else by their name.

use crate::pen::hid::RawPen;
use glam::{DVec2, Vec2};
use x11rb::protocol::xinput::{
    self, DeviceClassData, DeviceClassDataValuator, Fp3232, ValuatorMode, XIDeviceInfo,
};

/// Units per radian that stand for one per degree, since X wants a whole number.
const PER_RADIAN_OF_DEGREES: u32 = 57;
/// Angles at the end of an axis of tilt that can be meant; drivers that give another resolution mean something else by it.
const PLAUSIBLE_TILT_DEG: std::ops::RangeInclusive<f64> = 20.0..=90.5;
/// Tilt at the end of an axis whose unit is not known, in degrees, as the drivers of most tablets have it.
const USUAL_TILT_DEG: f64 = 64.0;

/// What an axis measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Across the tablet.
    X,
    /// Down the tablet.
    Y,
    /// Force on the tip.
    Pressure,
    /// Lean to the right.
    TiltX,
    /// Lean toward the artist.
    TiltY,
    /// Turn about the pen's own axis, once around over the axis's length.
    Turn,
    /// Height over the tablet.
    Distance,
}

/// Labels of axes as drivers write them, which are names of atoms.
pub const LABELS: [(&str, Role); 8] = [
    ("Abs X", Role::X),
    ("Abs Y", Role::Y),
    ("Abs Pressure", Role::Pressure),
    ("Abs Tilt X", Role::TiltX),
    ("Abs Tilt Y", Role::TiltY),
    ("Abs Wheel", Role::Turn),
    ("Abs Rotary Z", Role::Turn),
    ("Abs Distance", Role::Distance),
];

/// Axes that only pens have.
const OF_PENS: [Role; 3] = [Role::Pressure, Role::TiltX, Role::TiltY];

/// The type that a driver gives a device, as far as it matters here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DeviceKind {
    /// Something else that is part of a tablet.
    NoPen,
    /// The other end of a pen.
    Eraser,
    /// Anything else; the device's name may say more.
    #[default]
    Other,
}

/// Names of atoms by which drivers give the type.
pub const KINDS: [(&str, DeviceKind); 5] = [
    ("PAD", DeviceKind::NoPen),
    ("TOUCH", DeviceKind::NoPen),
    ("TOUCHPAD", DeviceKind::NoPen),
    ("TOUCHSCREEN", DeviceKind::NoPen),
    ("ERASER", DeviceKind::Eraser),
];

/// One axis and its last value.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Axis {
    number: u16,
    role: Role,
    min: f64,
    max: f64,
    resolution: u32,
    is_absolute: bool,
    value: f64,
}

/// A pen, or one end of it.
#[derive(Clone, Debug, PartialEq)]
pub struct PenDevice {
    /// The server's number for it.
    pub id: u16,
    /// It is the other end of a pen.
    pub eraser: bool,
    axes: Vec<Axis>,
}

impl PenDevice {
    /// What the server says about a device, if that is a pen in use. `role_of` knows the atoms of [`LABELS`].
    pub fn read(
        info: &XIDeviceInfo,
        kind: DeviceKind,
        role_of: impl Fn(u32) -> Option<Role>,
    ) -> Option<Self> {
        let is_used = info.enabled && info.type_ == xinput::DeviceType::SLAVE_POINTER;
        let is_touch = info.classes.iter().any(|class| matches!(class.data, DeviceClassData::Touch(_)));
        if !is_used || is_touch || kind == DeviceKind::NoPen {
            return None;
        }
        let axes: Vec<Axis> = info
            .classes
            .iter()
            .filter_map(|class| match &class.data {
                DeviceClassData::Valuator(axis) => Some(Axis::read(axis, role_of(axis.label)?)),
                _ => None,
            })
            .collect();
        let name = String::from_utf8_lossy(&info.name).to_lowercase();
        let eraser = kind == DeviceKind::Eraser || name.contains("eraser");
        let is_pen = axes.iter().any(|axis| OF_PENS.contains(&axis.role));
        is_pen.then_some(Self { id: info.deviceid, eraser, axes })
    }

    /// Whether an event that carries these axes says where the pen is.
    pub fn is_placed_by(&self, mask: &[u32]) -> bool {
        let places = |role| matches!(role, Role::X | Role::Y);
        let has_place = self.axes.iter().any(|axis| places(axis.role));
        let is_carried = |number| self.axes.iter().any(|axis| axis.number == number && places(axis.role));
        !has_place || numbers_in(mask).any(is_carried)
    }

    /// Where the pen puts the pointer on a desktop of this size; `None` for pens that move it by steps.
    pub fn place_on(&self, desktop: DVec2) -> Option<DVec2> {
        let share = |role| self.axis(role).filter(|axis| axis.is_absolute).and_then(Axis::step_share);
        Some(DVec2::new(share(Role::X)?, share(Role::Y)?) * desktop)
    }

    /// Takes the axes that an event carries: the values of the axes whose bits are set, in their order.
    pub fn take(&mut self, mask: &[u32], values: &[Fp3232]) {
        for (number, value) in numbers_in(mask).zip(values) {
            for axis in self.axes.iter_mut().filter(|axis| axis.number == number) {
                axis.value = number_of(*value);
            }
        }
    }

    /// Keeps the values of the same device as it was known before.
    pub fn keep_values(&mut self, before: &Self) {
        for axis in &mut self.axes {
            if let Some(known) = before.axes.iter().find(|known| known.role == axis.role) {
                axis.value = known.value;
            }
        }
    }

    /// The state of the pen in range, as its axes have it.
    pub fn state(&self, touches: bool, barrel: [bool; 3]) -> RawPen {
        let share = |role| self.axis(role).and_then(Axis::share);
        let tilt = |role| self.axis(role).map_or(0.0, Axis::tilt_deg);
        RawPen {
            in_range: true,
            touches,
            eraser: self.eraser,
            barrel,
            position: DVec2::new(share(Role::X).unwrap_or(0.0), share(Role::Y).unwrap_or(0.0)),
            pressure: share(Role::Pressure).map(|share| share as f32),
            tilt_deg: Vec2::new(tilt(Role::TiltX), tilt(Role::TiltY)),
            twist_deg: self.axis(Role::Turn).map_or(0.0, Axis::turn_deg),
            distance: share(Role::Distance).unwrap_or(0.0) as f32,
            serial: 0,
        }
    }

    fn axis(&self, role: Role) -> Option<&Axis> {
        self.axes.iter().find(|axis| axis.role == role)
    }
}

impl Axis {
    fn read(axis: &DeviceClassDataValuator, role: Role) -> Self {
        let DeviceClassDataValuator { number, min, max, value, resolution, mode, .. } = *axis;
        let [min, max, value] = [min, max, value].map(number_of);
        Self { number, role, min, max, resolution, is_absolute: mode == ValuatorMode::ABSOLUTE, value }
    }

    /// Where on the axis, from 0 at its first step to 1 beyond its last, as the server places the pointer.
    fn step_share(&self) -> Option<f64> {
        let steps = self.max - self.min + 1.0;
        (steps > 1.0).then(|| (self.value - self.min) / steps)
    }

    /// Where on the axis, 0 to 1; `None` for an axis without length.
    fn share(&self) -> Option<f64> {
        let length = self.max - self.min;
        (length > 0.0).then(|| ((self.value - self.min) / length).clamp(0.0, 1.0))
    }

    fn tilt_deg(&self) -> f32 {
        let end = self.min.abs().max(self.max.abs());
        if end == 0.0 {
            return 0.0;
        }
        let per_unit = match self.resolution {
            PER_RADIAN_OF_DEGREES => 1.0,
            // Division by 0 is infinite and so not plausible.
            resolution => f64::from(resolution).recip().to_degrees(),
        };
        let deg = if PLAUSIBLE_TILT_DEG.contains(&(end * per_unit)) {
            self.value * per_unit
        } else {
            self.value / end * USUAL_TILT_DEG
        };
        deg.clamp(-90.0, 90.0) as f32
    }

    /// The axis ends one step before it begins again; 0 is no turn.
    fn turn_deg(&self) -> f32 {
        let length = self.max - self.min + 1.0;
        if length <= 1.0 {
            return 0.0;
        }
        let turn = (360.0 * self.value / length).rem_euclid(360.0) as f32;
        // What is just below a whole turn may round to one.
        if turn < 360.0 { turn } else { 0.0 }
    }
}

/// Numbers of the axes whose bits are set.
fn numbers_in(mask: &[u32]) -> impl Iterator<Item = u16> + '_ {
    let bits = mask.iter().flat_map(|word| (0..32).map(move |bit| word >> bit & 1 == 1));
    (0u16..).zip(bits).filter(|(_, is_set)| *is_set).map(|(number, _)| number)
}

/// A number of 32 bits before and 32 behind the point.
fn number_of(value: Fp3232) -> f64 {
    const ONE: f64 = 4_294_967_296.0;
    f64::from(value.integral) + f64::from(value.frac) / ONE
}

#[cfg(test)]
#[path = "devices_tests.rs"]
pub(crate) mod tests;
