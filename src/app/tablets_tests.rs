//! Tests of tablets that are read directly, on a simulated bus.

use super::*;
use crate::app::tablet_keys::KeyUse;
use crate::pen::PenPhase;
use crate::pen::hid::Table;
use crate::pen::hid::made_up::{DisplayReport, PEN_DISPLAY, VENDOR_PAGE, WACOM_PAD, switch};
use crate::pen::hid::simulated::{SimulatedBus, SimulatedDevice};
use glam::DVec2;
use std::time::Duration;

const REACH: Reach = Reach {
    canvas: Rect { min: DVec2::new(100.0, 0.0), max: DVec2::new(500.0, 400.0) },
    window: Rect { min: DVec2::ZERO, max: DVec2::new(1000.0, 400.0) },
    monitor: None,
    monitors: Vec::new(),
};

/// A window that works with one simulated tablet.
struct Fixture {
    bus: SimulatedBus,
    tablet: SimulatedDevice,
    tablets: Tablets,
    pen: PenSettings,
    models: Models,
    received: Vec<(Origin, PenEvent)>,
}

impl Fixture {
    fn new() -> Self {
        let info = DeviceInfo { path: "sim0".into(), product: "Slate".into(), ..DeviceInfo::default() };
        Self::with(SimulatedDevice::new(info, PEN_DISPLAY))
    }

    fn with(tablet: SimulatedDevice) -> Self {
        let bus = SimulatedBus::new();
        let system = bus.clone();
        let mut tablets = Tablets::new(move |_| Box::new(system.clone()), || {}, Instant::now());
        let mut received = Vec::new();
        tablets.listen(true, &mut received);
        let pen = PenSettings { keeps_aspect: false, ..PenSettings::default() };
        Self { bus, tablet, tablets, pen, models: Models::new(), received }
    }

    /// Listens until something is so.
    fn until(&mut self, mut is_so: impl FnMut(&Tablets, &[(Origin, PenEvent)]) -> bool) {
        let begin = Instant::now();
        while !is_so(&self.tablets, &self.received) {
            assert!(begin.elapsed() < Duration::from_secs(60), "it never happened: {:?}", self.received);
            let pen = self.pen;
            self.tablets.take(&REACH, |_| pen, &mut self.received);
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    fn report(&self, switches: u8) {
        let report = DisplayReport { switches, x: 5000, pressure: 2000, ..DisplayReport::default() };
        self.tablet.send(&report.bytes());
    }
}

#[test]
fn a_tablet_draws_where_the_artist_put_it_and_leaves_with_its_cable() {
    let mut fixture = Fixture::new();
    fixture.tablets.obey(PenSource::Auto, &fixture.models, &mut fixture.received);
    fixture.bus.plug(&fixture.tablet);
    fixture.until(|tablets, _| tablets.name(0) == Some("Slate"));
    fixture.report(switch::IN_RANGE | switch::TIP);
    fixture.until(|_, received| received.len() == 2);
    let window = fixture.received[1].1.sample.position;
    fixture.pen.covers = Covers::Canvas;
    fixture.report(switch::IN_RANGE | switch::TIP);
    fixture.until(|_, received| received.len() == 3);
    let canvas = fixture.received[2].1.sample.position;
    assert!((100.0 + window.x * 0.4 - canvas.x).abs() < 1e-6, "{window} {canvas}");
    fixture.bus.unplug("sim0");
    fixture.until(|tablets, _| tablets.known.is_empty());
    assert_eq!(fixture.tablets.name(0), Some("Slate"), "its last events are still to be followed");
    fixture.tablets.obey(PenSource::Auto, &fixture.models, &mut fixture.received);
    assert_eq!(fixture.tablets.name(0), None);
    let phases: Vec<_> = fixture.received.iter().map(|(_, event)| event.phase).collect();
    assert_eq!(phases, [PenPhase::Enter, PenPhase::Down, PenPhase::Move, PenPhase::Up, PenPhase::Leave]);
}

#[test]
fn nothing_is_read_for_the_system_or_for_another_window() {
    let mut fixture = Fixture::new();
    fixture.tablets.obey(PenSource::System, &fixture.models, &mut fixture.received);
    assert!(fixture.tablets.watcher.is_none());
    fixture.bus.plug(&fixture.tablet);
    fixture.tablets.obey(PenSource::Raw, &fixture.models, &mut fixture.received);
    fixture.until(|tablets, _| tablets.name(0).is_some());
    fixture.report(switch::IN_RANGE);
    fixture.until(|_, received| received.len() == 1);
    fixture.tablets.listen(false, &mut fixture.received);
    assert_eq!(fixture.received.last().map(|(_, event)| event.phase), Some(PenPhase::Leave));
    fixture.report(switch::IN_RANGE);
    fixture.tablet.wait_read(2, Duration::from_secs(60));
    fixture.tablets.obey(PenSource::System, &fixture.models, &mut fixture.received);
    assert_eq!((fixture.received.len(), fixture.tablet.handles()), (2, 0));
}

#[test]
fn keys_of_a_tablet_do_what_the_artist_chose() {
    let info = DeviceInfo { path: "sim0".into(), vendor_id: 0x56A, ..DeviceInfo::default() };
    let mut fixture = Fixture::with(SimulatedDevice::new(info, crate::pen::hid::made_up::WACOM_PAGE));
    fixture.tablets.obey(PenSource::Raw, &fixture.models, &mut fixture.received);
    fixture.bus.plug(&fixture.tablet);
    fixture.until(|tablets, _| tablets.name(0).is_some());
    // Report 16 of 24 bytes; its last byte has the key.
    let key = |is_held: u8| [&[16][..], &[0; 22], &[is_held]].concat();
    let press = |fixture: &mut Fixture, reads: usize| {
        fixture.tablet.send(&key(1));
        fixture.tablet.send(&key(0));
        fixture.tablet.wait_read(reads, Duration::from_secs(60));
        let (begin, mut actions) = (Instant::now(), Vec::new());
        while actions.is_empty() && begin.elapsed() < Duration::from_secs(5) {
            let pen = fixture.pen;
            fixture.tablets.take(&REACH, |_| pen, &mut fixture.received);
            actions.extend(fixture.tablets.actions());
        }
        actions
    };
    assert_eq!(press(&mut fixture, 2), [Action::Undo], "the first key, once");
    fixture.pen.keys.keys[0] = KeyUse::Fit;
    assert_eq!(press(&mut fixture, 4), [Action::FitCanvas]);
}

#[test]
fn keys_on_a_node_of_their_own_are_those_of_the_tablet() {
    let node = |path: &str| DeviceInfo {
        path: path.into(),
        vendor_id: 0x56A,
        product: "Slate".into(),
        serial: "7".into(),
        ..DeviceInfo::default()
    };
    let mut fixture = Fixture::with(SimulatedDevice::new(node("sim0"), PEN_DISPLAY));
    let pad = SimulatedDevice::new(node("sim1"), WACOM_PAD);
    fixture.tablets.obey(PenSource::Raw, &fixture.models, &mut fixture.received);
    fixture.bus.forbid("sim0", true);
    fixture.bus.plug(&fixture.tablet);
    fixture.bus.plug(&pad);
    fixture.until(|tablets, _| tablets.known.len() == 1 && tablets.trouble().is_some());
    // A pen that may not be read is not made good by keys that are.
    fixture.bus.forbid("sim0", false);
    fixture.until(|tablets, _| tablets.known.len() == 2 && tablets.trouble().is_none());
    let names: Vec<String> = fixture.tablets.known.values().map(|tablet| tablet.name.clone()).collect();
    assert_eq!(names, ["Slate", "Slate"], "what the artist chose for the pen holds for its keys");
    fixture.report(switch::IN_RANGE | switch::TIP);
    pad.send(&[17, 1, 1, 10, 0, 0]);
    pad.send(&[17, 0, 1, 16, 0, 0]);
    let (begin, mut actions) = (Instant::now(), Vec::new());
    while actions.len() < 2 || fixture.received.len() < 2 {
        assert!(begin.elapsed() < Duration::from_secs(60), "{actions:?} {:?}", fixture.received);
        let pen = fixture.pen;
        fixture.tablets.take(&REACH, |_| pen, &mut fixture.received);
        actions.extend(fixture.tablets.actions());
    }
    assert_eq!(actions, [Action::Undo, Action::Zoom(1)], "the first key, and a notch of the ring");
    assert_eq!(fixture.received[1].1.phase, PenPhase::Down, "the pen draws beside them");
}

#[test]
fn a_tablet_covers_the_monitor_that_was_chosen() {
    let monitors =
        [0.0, 1000.0].map(|x| Rect { min: DVec2::new(x, 0.0), max: DVec2::new(x + 1000.0, 500.0) });
    let reach = Reach { monitor: Some(monitors[0]), monitors: monitors.to_vec(), ..REACH };
    let info = DeviceInfo::default();
    let arrival =
        Arrival { info, way: String::new(), area_mm: None, abilities: Default::default(), doubt: None };
    let corner = |monitor| {
        let pen = PenSettings { covers: Covers::Monitor, monitor, ..PenSettings::default() };
        reach.mapping(&pen, &arrival).position(DVec2::ZERO).unwrap().x
    };
    assert_eq!([None, Some(0), Some(1), Some(7)].map(corner), [0.0, 0.0, 1000.0, 0.0]);
}

#[test]
fn a_tablet_that_may_not_be_read_says_what_to_do() {
    let info = DeviceInfo { path: "sim0".into(), vendor_id: 0x256C, ..DeviceInfo::default() };
    let mut fixture = Fixture::with(SimulatedDevice::new(info, PEN_DISPLAY));
    fixture.bus.forbid("sim0", true);
    fixture.bus.plug(&fixture.tablet);
    fixture.tablets.obey(PenSource::Auto, &fixture.models, &mut fixture.received);
    fixture.until(|tablets, _| tablets.trouble().is_some());
    assert!(fixture.tablets.trouble().unwrap().to_string().contains("./run.sh --install-udev"));
    fixture.bus.forbid("sim0", false);
    fixture.until(|tablets, _| tablets.name(0).is_some() && tablets.trouble().is_none());
}

/// The place in the window at which a tablet in doubt says that its pen hovers, once it is read as a model.
fn hovers_as(fixture: &mut Fixture, model: &str) -> DVec2 {
    fixture.models = [(fixture.tablet.info().identity(), model.to_owned())].into();
    fixture.tablets.obey(PenSource::Raw, &fixture.models, &mut fixture.received);
    let is_taken = |doubt: &TabletDoubt| doubt.taken.as_deref() == Some(model) && doubt.is_chosen;
    fixture.until(|tablets, _| tablets.doubts().iter().any(is_taken) && tablets.trouble().is_none());
    fixture.received.clear();
    // Hovering at 5000, 5000 steps.
    fixture.tablet.send(&[8, 0x80, 0x88, 0x13, 0x88, 0x13, 0, 0, 0, 0, 0, 0]);
    fixture.until(|_, received| received.iter().any(|(_, event)| event.phase == PenPhase::Enter));
    fixture.received[0].1.sample.position
}

#[test]
fn the_artist_chooses_the_model_of_a_tablet_in_doubt() {
    let info = DeviceInfo { path: "sim0".into(), vendor_id: 0x256C, product_id: 0x6D, ..Default::default() };
    let mut fixture = Fixture::with(SimulatedDevice::new(info, VENDOR_PAGE));
    fixture.bus.plug(&fixture.tablet);
    fixture.tablets.obey(PenSource::Raw, &fixture.models, &mut fixture.received);
    fixture.until(|tablets, _| tablets.trouble().is_some() && !tablets.doubts().is_empty());
    let doubt = fixture.tablets.doubts()[0].clone();
    assert_eq!((doubt.device.as_str(), doubt.taken), ("256c:006d tablet 256c:006d", None));
    // Two that differ in their ranges, so that the same report means another place.
    let table = Table::shipped().unwrap();
    let steps = |model: &String| table.tablets().iter().find(|t| t.name == *model).unwrap().steps;
    let first = &doubt.models[0];
    let other = doubt.models.iter().find(|model| steps(model)[0] != steps(first)[0]).unwrap();
    for model in [first, other, first] {
        let place = hovers_as(&mut fixture, model);
        let expected = REACH.window.max.x * 5000.0 / f64::from(steps(model)[0]);
        assert!((place.x - expected).abs() < 1e-6, "{model}: {place}, not {expected}");
    }
    // The watcher is stopped and begins anew, as when the program does.
    fixture.tablets.obey(PenSource::System, &fixture.models, &mut fixture.received);
    assert!(fixture.tablets.doubts().is_empty());
    let place = hovers_as(&mut fixture, &other.clone());
    assert!((place.x - REACH.window.max.x * 5000.0 / f64::from(steps(other)[0])).abs() < 1e-6);
}
