//! Tablets that are read directly: what their readers say, made into events of pens in the window.
//!
//! Readers and their watcher run on threads of their own ([`crate::pen::hid`]); the window empties their queue when it is
//! woken. Each tablet has a machine that makes events of its pen's states, with the part of the window that the artist
//! chose for it. Nothing is watched while the artist wants only the system's pens.

use super::pen_settings::{Covers, PenSettings};
use crate::pen::hid::{Arrival, DeviceId, Enumerate, HidEvent, Notice, Watcher};
use crate::pen::machine::PenMachine;
use crate::pen::mapping::{Mapping, Rect};
use crate::pen::{Origin, PenEvent, PenSource};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Instant;

/// Where tablets may reach, in physical pixels of the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    /// The paper.
    pub(super) canvas: Rect,
    /// The window.
    pub(super) window: Rect,
    /// The monitor under it, if the system says where that is.
    pub(super) monitor: Option<Rect>,
}

impl Reach {
    fn mapping(&self, pen: &PenSettings, arrival: &Arrival) -> Mapping {
        let target = match pen.covers {
            Covers::Canvas => self.canvas,
            Covers::Window => self.window,
            Covers::Monitor => self.monitor.unwrap_or(self.window),
        };
        let mapping = Mapping::new(target).left_handed(pen.is_turned);
        match arrival.area_mm.filter(|_| pen.keeps_aspect) {
            Some(area) => mapping.keep_aspect(area),
            None => mapping,
        }
    }
}

/// One tablet that is there.
struct Tablet {
    arrival: Arc<Arrival>,
    name: String,
    machine: PenMachine,
    battery: Option<u8>,
}

/// All tablets that are read directly.
pub(super) struct Tablets {
    watcher: Option<Watcher>,
    /// The artist's choice that holds.
    obeys: Option<PenSource>,
    known: BTreeMap<DeviceId, Tablet>,
    /// The window is the one that the artist works in.
    listens: bool,
    /// Why tablets cannot be read, the newest.
    trouble: Option<String>,
    /// Where tablets are looked for.
    system: Box<dyn Fn(PenSource) -> Box<dyn Enumerate>>,
    wake: Arc<dyn Fn() + Send + Sync>,
    begin: Instant,
    /// Room for the events of one tablet.
    events: Vec<PenEvent>,
}

impl Tablets {
    /// Nothing is read yet. `wake` is called from other threads when there is something to [`Self::take`]; times count
    /// from `begin`.
    pub(super) fn new(
        system: impl Fn(PenSource) -> Box<dyn Enumerate> + 'static,
        wake: impl Fn() + Send + Sync + 'static,
        begin: Instant,
    ) -> Self {
        let (system, wake) = (Box::new(system), Arc::new(wake));
        Self {
            watcher: None,
            obeys: None,
            known: BTreeMap::new(),
            listens: false,
            trouble: None,
            system,
            wake,
            begin,
            events: Vec::new(),
        }
    }

    /// Pens are heard, or are not because the artist works in another window; then they leave.
    pub(super) fn listen(&mut self, listens: bool, out: &mut Vec<(Origin, PenEvent)>) {
        let now_ms = self.now_ms();
        if std::mem::replace(&mut self.listens, listens) && !listens {
            for (id, tablet) in &mut self.known {
                tablet.machine.leave(now_ms, &mut self.events);
                out.extend(self.events.drain(..).map(|event| (Origin::Direct(*id), event)));
            }
        }
    }

    /// Begins or ceases to read tablets, as the artist chose; pens of tablets that are no longer read leave.
    pub(super) fn obey(&mut self, source: PenSource, out: &mut Vec<(Origin, PenEvent)>) {
        if self.obeys.replace(source) == Some(source) {
            return;
        }
        self.trouble = None;
        if self.watcher.take().is_some() {
            let now_ms = self.now_ms();
            let ids: Vec<DeviceId> = self.known.keys().copied().collect();
            ids.into_iter().for_each(|id| self.forget(id, now_ms, out));
        }
        if source != PenSource::System {
            let wake = Arc::clone(&self.wake);
            match Watcher::start((self.system)(source), move || wake(), self.begin) {
                Ok(watcher) => self.watcher = Some(watcher),
                Err(error) => self.trouble = Some(error.to_string()),
            }
        }
    }

    /// Appends what happened since the last time; `chosen` says what the artist chose for a pen of this name.
    pub(super) fn take(
        &mut self,
        reach: &Reach,
        chosen: impl Fn(&str) -> PenSettings,
        out: &mut Vec<(Origin, PenEvent)>,
    ) {
        let Some(watcher) = self.watcher.take() else { return };
        for tablet in self.known.values_mut() {
            let pen = chosen(&tablet.name);
            tablet.machine.set_mapping(reach.mapping(&pen, &tablet.arrival));
        }
        watcher.inbox().drain(|message| match message.notice {
            Notice::Arrived(arrival) => {
                tracing::debug!("tablet {} is read by {}", arrival.info.name(), arrival.way);
                self.trouble = None;
                let name = arrival.info.name();
                let machine = PenMachine::new(reach.mapping(&chosen(&name), &arrival));
                self.known.insert(message.device, Tablet { arrival, name, machine, battery: None });
            }
            Notice::Said(event) => self.hear(message.device, event, message.time_ms, out),
            Notice::Refused(why) => self.trouble = Some(why),
            Notice::Gone(_) => self.forget(message.device, message.time_ms, out),
        });
        self.watcher = Some(watcher);
    }

    /// The name of a tablet.
    pub(super) fn name(&self, id: DeviceId) -> Option<&str> {
        self.known.get(&id).map(|tablet| tablet.name.as_str())
    }

    /// Whether tablets are looked for.
    pub(super) fn are_there(&self) -> bool {
        self.watcher.is_some()
    }

    /// Whether the artist spread one of them over a monitor.
    pub(super) fn cover_monitor(&self, chosen: impl Fn(&str) -> PenSettings) -> bool {
        self.known.values().any(|tablet| chosen(&tablet.name).covers == Covers::Monitor)
    }

    /// The charge of a tablet's pen in percent.
    pub(super) fn battery(&self, id: DeviceId) -> Option<u8> {
        self.known.get(&id)?.battery
    }

    /// Why a tablet cannot be read, and what to do.
    pub(super) fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    fn hear(&mut self, id: DeviceId, event: HidEvent, time_ms: f64, out: &mut Vec<(Origin, PenEvent)>) {
        let Some(tablet) = self.known.get_mut(&id) else { return };
        match event {
            HidEvent::Pen(_) if !self.listens => {}
            HidEvent::Pen(raw) => tablet.machine.sample(&raw, time_ms, &mut self.events),
            HidEvent::Battery(percent) => tablet.battery = Some(percent),
            // The system tells of fingers, and keys of tablets have no use here.
            HidEvent::Touch { .. } | HidEvent::Keys(_) => {}
        }
        out.extend(self.events.drain(..).map(|event| (Origin::Direct(id), event)));
    }

    fn forget(&mut self, id: DeviceId, time_ms: f64, out: &mut Vec<(Origin, PenEvent)>) {
        if let Some(mut tablet) = self.known.remove(&id) {
            tablet.machine.leave(time_ms, &mut self.events);
            out.extend(self.events.drain(..).map(|event| (Origin::Direct(id), event)));
        }
    }

    fn now_ms(&self) -> f64 {
        self.begin.elapsed().as_secs_f64() * 1e3
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pen::PenPhase;
    use crate::pen::hid::DeviceInfo;
    use crate::pen::hid::made_up::{DisplayReport, PEN_DISPLAY, switch};
    use crate::pen::hid::simulated::{SimulatedBus, SimulatedDevice};
    use glam::DVec2;
    use std::time::Duration;

    const REACH: Reach = Reach {
        canvas: Rect { min: DVec2::new(100.0, 0.0), max: DVec2::new(500.0, 400.0) },
        window: Rect { min: DVec2::ZERO, max: DVec2::new(1000.0, 400.0) },
        monitor: None,
    };

    /// A window that works with one simulated tablet.
    struct Desk {
        bus: SimulatedBus,
        tablet: SimulatedDevice,
        tablets: Tablets,
        pen: PenSettings,
        heard: Vec<(Origin, PenEvent)>,
    }

    impl Desk {
        fn new() -> Self {
            let bus = SimulatedBus::new();
            let info = DeviceInfo { path: "sim0".into(), product: "Slate".into(), ..DeviceInfo::default() };
            let tablet = SimulatedDevice::new(info, PEN_DISPLAY);
            let system = bus.clone();
            let mut tablets = Tablets::new(move |_| Box::new(system.clone()), || {}, Instant::now());
            let mut heard = Vec::new();
            tablets.listen(true, &mut heard);
            let pen = PenSettings { keeps_aspect: false, ..PenSettings::default() };
            Self { bus, tablet, tablets, pen, heard }
        }

        /// Listens until something is so.
        fn until(&mut self, mut is_so: impl FnMut(&Tablets, &[(Origin, PenEvent)]) -> bool) {
            let begin = Instant::now();
            while !is_so(&self.tablets, &self.heard) {
                assert!(begin.elapsed() < Duration::from_secs(60), "it never happened: {:?}", self.heard);
                let pen = self.pen;
                self.tablets.take(&REACH, |_| pen, &mut self.heard);
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
        let mut desk = Desk::new();
        desk.tablets.obey(PenSource::Auto, &mut desk.heard);
        desk.bus.plug(&desk.tablet);
        desk.until(|tablets, _| tablets.name(0) == Some("Slate"));
        desk.report(switch::IN_RANGE | switch::TIP);
        desk.until(|_, heard| heard.len() == 2);
        let window = desk.heard[1].1.sample.position;
        desk.pen.covers = Covers::Canvas;
        desk.report(switch::IN_RANGE | switch::TIP);
        desk.until(|_, heard| heard.len() == 3);
        let canvas = desk.heard[2].1.sample.position;
        assert!((100.0 + window.x * 0.4 - canvas.x).abs() < 1e-6, "{window} {canvas}");
        desk.bus.unplug("sim0");
        desk.until(|tablets, _| tablets.name(0).is_none());
        let phases: Vec<_> = desk.heard.iter().map(|(_, event)| event.phase).collect();
        assert_eq!(phases, [PenPhase::Enter, PenPhase::Down, PenPhase::Move, PenPhase::Up, PenPhase::Leave]);
    }

    #[test]
    fn nothing_is_read_for_the_system_or_for_another_window() {
        let mut desk = Desk::new();
        desk.tablets.obey(PenSource::System, &mut desk.heard);
        assert!(desk.tablets.watcher.is_none());
        desk.bus.plug(&desk.tablet);
        desk.tablets.obey(PenSource::Raw, &mut desk.heard);
        desk.until(|tablets, _| tablets.name(0).is_some());
        desk.report(switch::IN_RANGE);
        desk.until(|_, heard| heard.len() == 1);
        desk.tablets.listen(false, &mut desk.heard);
        assert_eq!(desk.heard.last().map(|(_, event)| event.phase), Some(PenPhase::Leave));
        desk.report(switch::IN_RANGE);
        desk.tablet.wait_read(2, Duration::from_secs(60));
        desk.tablets.obey(PenSource::System, &mut desk.heard);
        assert_eq!((desk.heard.len(), desk.tablet.handles()), (2, 0));
    }

    #[test]
    fn a_tablet_that_may_not_be_read_says_what_to_do() {
        let mut desk = Desk::new();
        desk.bus.forbid("sim0", true);
        desk.bus.plug(&desk.tablet);
        desk.tablets.obey(PenSource::Auto, &mut desk.heard);
        desk.until(|tablets, _| tablets.trouble().is_some());
        assert!(desk.tablets.trouble().unwrap().contains("./run.sh --install-udev"));
        desk.bus.forbid("sim0", false);
        desk.until(|tablets, _| tablets.name(0).is_some() && tablets.trouble().is_none());
    }
}
