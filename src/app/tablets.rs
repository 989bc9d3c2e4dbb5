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
    machine: PenMachine,
    battery: Option<u8>,
}

/// All tablets that are read directly.
pub(super) struct Tablets {
    watcher: Option<Watcher>,
    known: BTreeMap<DeviceId, Tablet>,
    /// The window is the one that the artist works in.
    listens: bool,
    /// Why tablets cannot be read, the newest.
    trouble: Option<String>,
    /// Where tablets are looked for.
    system: Box<dyn Fn() -> Box<dyn Enumerate>>,
    wake: Arc<dyn Fn() + Send + Sync>,
    begin: Instant,
    /// Room for the events of one tablet.
    events: Vec<PenEvent>,
}

impl Tablets {
    /// Nothing is read yet. `wake` is called from other threads when there is something to [`Self::take`]; times count
    /// from `begin`.
    pub(super) fn new(
        system: impl Fn() -> Box<dyn Enumerate> + 'static,
        wake: impl Fn() + Send + Sync + 'static,
        begin: Instant,
    ) -> Self {
        let (system, wake) = (Box::new(system), Arc::new(wake));
        Self {
            watcher: None,
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
        if source == PenSource::System {
            self.trouble = None;
            if self.watcher.take().is_some() {
                let now_ms = self.now_ms();
                let ids: Vec<DeviceId> = self.known.keys().copied().collect();
                ids.into_iter().for_each(|id| self.forget(id, now_ms, out));
            }
        } else if self.watcher.is_none() && self.trouble.is_none() {
            let wake = Arc::clone(&self.wake);
            match Watcher::start((self.system)(), move || wake(), self.begin) {
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
            let pen = chosen(&tablet.arrival.info.name());
            tablet.machine.set_mapping(reach.mapping(&pen, &tablet.arrival));
        }
        watcher.inbox().drain(|message| match message.notice {
            Notice::Arrived(arrival) => {
                tracing::debug!("tablet {} is read by {}", arrival.info.name(), arrival.way);
                self.trouble = None;
                let machine = PenMachine::new(reach.mapping(&chosen(&arrival.info.name()), &arrival));
                self.known.insert(message.device, Tablet { arrival, machine, battery: None });
            }
            Notice::Said(event) => self.hear(message.device, event, message.time_ms, out),
            Notice::Refused(why) => self.trouble = Some(why),
            Notice::Gone(_) => self.forget(message.device, message.time_ms, out),
        });
        self.watcher = Some(watcher);
    }

    /// The name of a tablet, with the charge of its pen where that is known.
    pub(super) fn name(&self, id: DeviceId) -> Option<String> {
        self.known.get(&id).map(|tablet| tablet.arrival.info.name())
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
