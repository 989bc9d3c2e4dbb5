//! Pens as drivers describe them, and worse.

use super::*;
use proptest::prelude::*;
use x11rb::protocol::xinput::{DeviceClass, DeviceClassDataTouch, DeviceType, TouchMode};

/// Atoms of the labels: their place in [`LABELS`], counted from 100.
pub(crate) fn role_of(atom: u32) -> Option<Role> {
    LABELS.get(atom.checked_sub(100)? as usize).map(|(_, role)| *role)
}

fn atom(label: &str) -> u32 {
    100 + LABELS.iter().position(|(known, _)| *known == label).unwrap() as u32
}

fn fixed(value: f64) -> Fp3232 {
    Fp3232 { integral: value.floor() as i32, frac: (value.rem_euclid(1.0) * 4_294_967_296.0) as u32 }
}

fn axis(number: u16, label: u32, min: f64, max: f64, resolution: u32) -> DeviceClass {
    let [min, max, value] = [min, max, 0.0].map(fixed);
    let mode = ValuatorMode::ABSOLUTE;
    let data = DeviceClassDataValuator { number, label, min, max, value, resolution, mode };
    DeviceClass { len: 11, sourceid: 7, data: DeviceClassData::Valuator(data) }
}

fn device(name: &str, classes: Vec<DeviceClass>) -> XIDeviceInfo {
    let type_ = DeviceType::SLAVE_POINTER;
    XIDeviceInfo { deviceid: 7, type_, attachment: 2, enabled: true, name: name.into(), classes }
}

/// A tablet of 44800 by 29600 steps with tilt in degrees and a wheel.
pub(crate) fn tablet_pen(id: u16, name: &str) -> PenDevice {
    let classes = vec![
        axis(0, atom("Abs X"), 0.0, 44800.0, 200_000),
        axis(1, atom("Abs Y"), 0.0, 29600.0, 200_000),
        axis(2, atom("Abs Pressure"), 0.0, 65536.0, 1),
        axis(3, atom("Abs Tilt X"), -64.0, 63.0, 57),
        axis(4, atom("Abs Tilt Y"), -64.0, 63.0, 57),
        axis(5, atom("Abs Wheel"), -900.0, 899.0, 1),
    ];
    PenDevice { id, ..PenDevice::read(&device(name, classes), DeviceKind::Other, role_of).unwrap() }
}

#[test]
fn values_are_shares_and_degrees_whatever_the_driver_counts_in() {
    let mut pen = tablet_pen(7, "Some Tablet Pen");
    pen.take(&[0b11_1111], &[22400.0, 7400.0, 16384.0, -30.0, 12.0, 450.0].map(fixed));
    let state = pen.state(true, [false; 3]);
    assert_eq!(state.position, DVec2::new(0.5, 0.25));
    assert_eq!(state.pressure, Some(0.25));
    assert_eq!(state.tilt_deg, Vec2::new(-30.0, 12.0));
    assert_eq!(state.twist_deg, 90.0);
}

#[test]
fn an_event_with_some_axes_leaves_the_others_as_they_were() {
    let mut pen = tablet_pen(7, "Some Tablet Pen");
    pen.take(&[0b11_1111], &[22400.0, 7400.0, 16384.0, -30.0, 12.0, 450.0].map(fixed));
    let before = pen.state(true, [false; 3]);
    pen.take(&[0b100], &[fixed(32768.0)]);
    assert_eq!(pen.state(true, [false; 3]), RawPen { pressure: Some(0.5), ..before });
}

#[test]
fn axes_are_found_by_label_and_not_by_number() {
    let classes =
        vec![axis(9, atom("Abs Pressure"), 0.0, 2000.0, 1), axis(40, atom("Abs X"), 100.0, 300.0, 1)];
    let mut pen = PenDevice::read(&device("x", classes), DeviceKind::Other, role_of).unwrap();
    pen.take(&[1 << 9, 1 << 8], &[500.0, 150.0].map(fixed));
    let state = pen.state(false, [false; 3]);
    assert_eq!((state.pressure, state.position.x), (Some(0.25), 0.25));
}

#[test]
fn tilt_in_another_unit_is_reported_in_degrees_too() {
    let tilted = |max: f64, resolution, value: f64| {
        let classes = vec![axis(3, atom("Abs Tilt X"), -max, max, resolution)];
        let mut pen = PenDevice::read(&device("x", classes), DeviceKind::Other, role_of).unwrap();
        pen.take(&[1 << 3], &[fixed(value)]);
        pen.state(false, [false; 3]).tilt_deg.x
    };
    // A thousand units to a radian.
    assert!((tilted(1000.0, 1000, 500.0) - 28.648).abs() < 1e-3);
    // No resolution, and one that cannot be meant: the end of the axis is the usual tilt.
    assert_eq!(tilted(9000.0, 0, 4500.0), 32.0);
    assert_eq!(tilted(64.0, 52_000, -16.0), -16.0);
}

#[test]
fn mice_screens_pads_and_sleeping_pens_are_no_pens() {
    let pressure = || axis(2, atom("Abs Pressure"), 0.0, 100.0, 1);
    let touch = DeviceClassDataTouch { mode: TouchMode::DIRECT, num_touches: 10 };
    let touch = DeviceClass { len: 2, sourceid: 7, data: DeviceClassData::Touch(touch) };
    let read = |info: &XIDeviceInfo, kind| PenDevice::read(info, kind, role_of);
    assert!(read(&device("mouse", vec![axis(0, atom("Abs X"), 0.0, 9.0, 1)]), DeviceKind::Other).is_none());
    assert!(read(&device("screen", vec![pressure(), touch]), DeviceKind::Other).is_none());
    assert!(read(&device("pad", vec![pressure()]), DeviceKind::NoPen).is_none());
    let asleep = XIDeviceInfo { enabled: false, ..device("pen", vec![pressure()]) };
    assert!(read(&asleep, DeviceKind::Other).is_none());
    let pointer = XIDeviceInfo { type_: DeviceType::MASTER_POINTER, ..device("pen", vec![pressure()]) };
    assert!(read(&pointer, DeviceKind::Other).is_none());
}

#[test]
fn an_eraser_is_recognised_by_its_type_or_its_name() {
    let classes = || vec![axis(2, atom("Abs Pressure"), 0.0, 100.0, 1)];
    let is_eraser = |name, kind| PenDevice::read(&device(name, classes()), kind, role_of).unwrap().eraser;
    assert!(is_eraser("x", DeviceKind::Eraser));
    assert!(is_eraser("Wacom Pen Eraser (0x123)", DeviceKind::Other));
    assert!(!is_eraser("Wacom Pen stylus", DeviceKind::Other));
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(f64::from(i32::MIN)),
        Just(f64::from(i32::MAX)),
        -100.0..100.0f64,
        -2e9..2e9f64
    ]
}

/// Pens with axes that no driver would make.
pub(crate) fn any_pen(id: u16) -> impl Strategy<Value = PenDevice> {
    let one = (0..70u16, 0..10usize, any_number(), any_number(), prop_oneof![Just(57u32), any::<u32>()]);
    (prop::collection::vec(one, 1..8), any::<bool>()).prop_map(move |(axes, eraser)| {
        let classes =
            axes.into_iter().map(|(n, role, a, b, r)| axis(n, 100 + role as u32, a, b, r)).collect();
        let info = device(if eraser { "eraser" } else { "pen" }, classes);
        let read = PenDevice::read(&info, DeviceKind::Other, role_of);
        PenDevice { id, ..read.unwrap_or_else(|| tablet_pen(id, "pen")) }
    })
}

/// Axes of an event that need not fit the device.
pub(crate) fn any_axes() -> impl Strategy<Value = (Vec<u32>, Vec<Fp3232>)> {
    let values = prop::collection::vec(any_number().prop_map(fixed), 0..8);
    (prop::collection::vec(any::<u32>(), 0..4), values)
}

proptest! {
    #[test]
    fn whatever_the_numbers_a_state_is_sound(mut pen in any_pen(7), axes in prop::collection::vec(any_axes(), 1..9)) {
        for (mask, values) in axes {
            pen.take(&mask, &values);
            let state = pen.state(true, [false; 3]);
            prop_assert!(state.pressure.is_none_or(|p| (0.0..=1.0).contains(&p)));
            prop_assert!((0.0..=1.0).contains(&state.position.x) && (0.0..=1.0).contains(&state.distance));
            prop_assert!(state.tilt_deg.abs().max_element() <= 90.0);
            prop_assert!((0.0..360.0).contains(&state.twist_deg), "{state:?}");
        }
    }
}
