//! Tablets that are read directly: what their readers say, made into events of pens in the window.
//!
//! Readers and their watcher run on threads of their own ([`crate::pen::hid`]); the window empties their queue when it is
//! woken. Each tablet has a machine that makes events of its pen's states, with the part of the window that the artist
//! chose for it. Nothing is watched while the artist wants only the system's pens.

use super::action::Action;
use super::messages::Localize;
use super::pen_settings::{Covers, PenSettings, TabletDoubt};
use super::tablet_actions::HeldKeys;
use crate::pen::hid::{
    Arrival, DeviceId, DeviceInfo, Enumerate, HidEvent, Message, Models, Notice, Refused, TransportError,
    Watcher,
};
use crate::pen::machine::PenMachine;
use crate::pen::mapping::{Mapping, Rect};
use crate::pen::{Origin, PenEvent, PenSource};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Instant;

/// Where tablets may reach, in physical pixels of the window.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reach {
    /// The paper.
    pub(super) canvas: Rect,
    /// The window.
    pub(super) window: Rect,
    /// The monitor under it, if the system says where that is.
    pub(super) monitor: Option<Rect>,
    /// All monitors of which the system says where they are, from left to right.
    pub(super) monitors: Vec<Rect>,
}

impl Reach {
    /// What a tablet with these settings covers.
    pub(super) fn target(&self, pen: &PenSettings) -> Rect {
        match pen.covers {
            Covers::Canvas => self.canvas,
            Covers::Window => self.window,
            Covers::Monitor => {
                let chosen = pen.monitor.and_then(|number| self.monitors.get(usize::from(number)));
                chosen.copied().or(self.monitor).unwrap_or(self.window)
            }
        }
    }

    fn mapping(&self, pen: &PenSettings, arrival: &Arrival) -> Mapping {
        let mapping = Mapping::turned(self.target(pen), pen.turn).calibrated(pen.calibration);
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
    keys: HeldKeys,
}

/// All tablets that are read directly.
pub(super) struct Tablets {
    watcher: Option<Watcher>,
    /// The artist's choice that holds.
    obeys: Option<PenSource>,
    known: BTreeMap<DeviceId, Tablet>,
    /// Names of those that went since the last look; their last events are still to be followed.
    gone: Vec<(DeviceId, String)>,
    /// The window is the one that the artist works in.
    listens: bool,
    /// Why tablets cannot be looked for.
    fault: Option<TransportError>,
    /// Tablets that cannot be read, by their paths.
    refused: BTreeMap<Arc<str>, Arc<Refused>>,
    /// Those of which it is not sure which model they are.
    doubts: Vec<TabletDoubt>,
    /// The models that the artist chose, as the watcher knows them.
    models: Models,
    /// Where tablets are looked for.
    system: Box<dyn Fn(PenSource) -> Box<dyn Enumerate>>,
    wake: Arc<dyn Fn() + Send + Sync>,
    begin: Instant,
    /// Room for the events of one tablet.
    events: Vec<PenEvent>,
    /// Actions of keys and wheels of tablets since the last call.
    actions: Vec<Action>,
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
            gone: Vec::new(),
            listens: false,
            fault: None,
            refused: BTreeMap::new(),
            doubts: Vec::new(),
            models: Models::new(),
            system,
            wake,
            begin,
            events: Vec::new(),
            actions: Vec::new(),
        }
    }

    /// Actions of keys and wheels of tablets since the last call.
    pub(super) fn actions(&mut self) -> Vec<Action> {
        std::mem::take(&mut self.actions)
    }

    /// Pens are followed, or are not because the artist works in another window; then they leave.
    pub(super) fn listen(&mut self, listens: bool, out: &mut Vec<(Origin, PenEvent)>) {
        let now_ms = self.now_ms();
        if std::mem::replace(&mut self.listens, listens) && !listens {
            for (id, tablet) in &mut self.known {
                tablet.machine.leave(now_ms, &mut self.events);
                out.extend(self.events.drain(..).map(|event| (Origin::Direct(*id), event)));
            }
        }
    }

    /// Begins or ceases to read tablets, and reads them as the models that the artist chose; pens of tablets that are no
    /// longer read leave.
    pub(super) fn obey(&mut self, source: PenSource, models: &Models, out: &mut Vec<(Origin, PenEvent)>) {
        self.gone.clear();
        if self.models != *models {
            self.models.clone_from(models);
            if let Some(watcher) = &self.watcher {
                watcher.set_models(models.clone());
            }
        }
        if self.obeys.replace(source) == Some(source) {
            return;
        }
        (self.fault, self.refused) = (None, BTreeMap::new());
        if self.watcher.take().is_some() {
            let now_ms = self.now_ms();
            let ids: Vec<DeviceId> = self.known.keys().copied().collect();
            ids.into_iter().for_each(|id| self.forget(id, now_ms, out));
        }
        self.doubts.clear();
        if source != PenSource::System {
            let wake = Arc::clone(&self.wake);
            match Watcher::start_with((self.system)(source), models.clone(), move || wake(), self.begin) {
                Ok(watcher) => self.watcher = Some(watcher),
                Err(fault) => self.fault = Some(fault),
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
        let mut is_other = false;
        watcher.inbox().drain(|message| {
            is_other |= !matches!(message.notice, Notice::Said(_));
            self.handle_notice(message, reach, &chosen, out);
        });
        if is_other {
            self.doubts = self.find_doubts();
        }
        self.watcher = Some(watcher);
    }

    fn handle_notice(
        &mut self,
        message: Message,
        reach: &Reach,
        chosen: &impl Fn(&str) -> PenSettings,
        out: &mut Vec<(Origin, PenEvent)>,
    ) {
        match message.notice {
            Notice::Arrived(arrival) => {
                tracing::debug!("tablet {} is read by {}", arrival.info.name(), arrival.way);
                let name = arrival.info.name();
                let machine = PenMachine::new(reach.mapping(&chosen(&name), &arrival));
                self.known.insert(
                    message.device,
                    Tablet { arrival, name, machine, battery: None, keys: HeldKeys::default() },
                );
            }
            Notice::Said(event) => self.handle(message.device, event, message.time_ms, chosen, out),
            Notice::Refused(refused) => {
                self.refused.insert(refused.device.path.as_str().into(), refused);
            }
            Notice::Settled(path) => drop(self.refused.remove(&path)),
            Notice::Gone(_) => self.forget(message.device, message.time_ms, out),
        }
    }

    /// The name of a tablet that is there, or was until now.
    pub(super) fn name(&self, id: DeviceId) -> Option<&str> {
        let gone = || self.gone.iter().find(|(gone, _)| *gone == id).map(|(_, name)| name.as_str());
        self.known.get(&id).map(|tablet| tablet.name.as_str()).or_else(gone)
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
    pub(super) fn trouble(&self) -> Option<&dyn Localize> {
        let refused = self.refused.values().find(|refused| !self.reads(&refused.device));
        match &self.fault {
            Some(fault) => Some(fault),
            None => refused.map(|refused| &**refused as &dyn Localize),
        }
    }

    /// Tablets of which it is not sure which model they are.
    pub(super) fn doubts(&self) -> &[TabletDoubt] {
        &self.doubts
    }

    /// Whether some node of this device is read; then its others do not matter.
    fn reads(&self, device: &DeviceInfo) -> bool {
        let identity = device.identity();
        let is_read = |tablet: &Tablet| {
            // Keys alone say nothing of the pen.
            !tablet.arrival.abilities.is_pad && tablet.arrival.info.identity() == identity
        };
        self.known.values().any(is_read)
    }

    fn find_doubts(&self) -> Vec<TabletDoubt> {
        let of_read = self.known.values().filter_map(|tablet| {
            let (info, doubt) = (&tablet.arrival.info, tablet.arrival.doubt.as_ref()?);
            let (models, taken) = (doubt.models.clone(), Some(doubt.taken.clone()));
            Some(TabletDoubt {
                device: info.identity(),
                name: info.name(),
                models,
                taken,
                is_chosen: doubt.is_chosen,
            })
        });
        let refused = self.refused.values().filter(|refused| !self.reads(&refused.device));
        let of_refused = refused.map(|refused| TabletDoubt {
            device: refused.device.identity(),
            name: refused.device.name(),
            models: refused.why.models().to_vec(),
            taken: None,
            is_chosen: false,
        });
        // A refused tablet may be the only model that fits; one that is read so leaves nothing to choose.
        let can_choose = |doubt: &TabletDoubt| doubt.models.len() > usize::from(doubt.taken.is_some());
        let mut doubts: Vec<TabletDoubt> = Vec::new();
        for doubt in of_read.chain(of_refused).filter(can_choose) {
            match doubts.iter_mut().find(|known| known.device == doubt.device) {
                Some(known) => {
                    let new = doubt.models.into_iter().filter(|model| !known.models.contains(model));
                    let new: Vec<String> = new.collect();
                    known.models.extend(new);
                }
                None => doubts.push(doubt),
            }
        }
        doubts
    }

    fn handle(
        &mut self,
        id: DeviceId,
        event: HidEvent,
        time_ms: f64,
        chosen: &impl Fn(&str) -> PenSettings,
        out: &mut Vec<(Origin, PenEvent)>,
    ) {
        let Some(tablet) = self.known.get_mut(&id) else { return };
        match event {
            HidEvent::Battery(percent) => tablet.battery = Some(percent),
            _ if !self.listens => {}
            HidEvent::Pen(raw) => tablet.machine.sample(&raw, time_ms, &mut self.events),
            HidEvent::Keys(_) | HidEvent::Dial { .. } | HidEvent::Ring { .. } | HidEvent::Strip { .. } => {
                tablet.keys.handle(&event, &chosen(&tablet.name).keys, &mut self.actions);
            }
            // The system reports fingers.
            HidEvent::Touch { .. } => {}
        }
        out.extend(self.events.drain(..).map(|event| (Origin::Direct(id), event)));
    }

    fn forget(&mut self, id: DeviceId, time_ms: f64, out: &mut Vec<(Origin, PenEvent)>) {
        if let Some(mut tablet) = self.known.remove(&id) {
            tracing::debug!("tablet {} is gone", tablet.name);
            tablet.machine.leave(time_ms, &mut self.events);
            out.extend(self.events.drain(..).map(|event| (Origin::Direct(id), event)));
            self.gone.push((id, tablet.name));
        }
    }

    fn now_ms(&self) -> f64 {
        self.begin.elapsed().as_secs_f64() * 1e3
    }
}

#[cfg(test)]
#[path = "tablets_tests.rs"]
mod tests;
