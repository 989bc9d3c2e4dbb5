//! Plays recordings: as devices that the reader cannot tell from real ones, into an open window, or straight through to
//! pen events.

use super::choice::Choice;
use super::choose::choose_model;
use super::recording::{Recorded, RecordedDevice, Recording};
use super::simulated::{SimulatedBus, SimulatedDevice};
use super::{
    Bus, ChooseError, DeviceInfo, DeviceStrings, Enumerate, HidEvent, KnownStrings, StringsKept, Transport,
    TransportError,
};
use crate::pen::mapping::Rect;
use crate::pen::{Mapping, PenEvent, PenMachine};
use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Milliseconds in a microsecond.
const MS: f64 = 1e-3;

/// A bus with the recording's devices, which end after their last report. Reports come in their own time from `begin`
/// on, or as fast as they are read without.
pub fn bus(recording: &Recording, begin: Option<Instant>) -> SimulatedBus {
    let bus = SimulatedBus::new();
    let devices = recording.devices.iter().enumerate().map(|(number, device)| {
        // Two devices of one recording may have had the same node one after the other.
        let info =
            DeviceInfo { path: format!("replay {number}: {}", device.info.path), ..device.info.clone() };
        SimulatedDevice::new(info, &device.descriptor).with_strings(strings(device))
    });
    let devices: Vec<SimulatedDevice> = devices.collect();
    for entry in &recording.entries {
        let (Some(device), Recorded::Report(report)) = (devices.get(entry.device), &entry.what) else {
            continue;
        };
        match begin {
            Some(begin) => device.send_at(report, begin + Duration::from_micros(entry.time_us)),
            None => device.send(report),
        }
    }
    for device in &devices {
        device.unplug_at_end();
        bus.plug(device);
    }
    bus
}

/// The strings that a recording holds of a device.
fn strings(device: &RecordedDevice) -> KnownStrings {
    let is_wireless = device.info.bus == Bus::Bluetooth;
    let kept = if is_wireless { StringsKept::Wireless } else { StringsKept::NotRecorded };
    KnownStrings { strings: device.strings.clone(), kept }
}

/// A system whose devices are a recording's. None is there before [`Self::begin`]; then each comes once, sends its reports
/// in their own time, and goes for good.
#[derive(Clone, Debug)]
pub struct Stage {
    recording: Arc<Recording>,
    has_begun: Arc<AtomicBool>,
    bus: Option<SimulatedBus>,
    opened: BTreeSet<String>,
}

impl Stage {
    /// Nothing plays yet.
    pub fn new(recording: Recording) -> Self {
        let recording = Arc::new(recording);
        Self { recording, has_begun: Arc::default(), bus: None, opened: BTreeSet::new() }
    }

    /// Lets it play, through every clone that is asked for devices.
    pub fn begin(&self) {
        self.has_begun.store(true, Ordering::Relaxed);
    }
}

impl Enumerate for Stage {
    fn devices(&mut self) -> Result<Vec<DeviceInfo>, TransportError> {
        if !self.has_begun.load(Ordering::Relaxed) {
            return Ok(Vec::new());
        }
        let bus = self.bus.get_or_insert_with(|| bus(&self.recording, Some(Instant::now())));
        let mut devices = bus.devices()?;
        devices.retain(|device| !self.opened.contains(&device.path));
        Ok(devices)
    }

    fn descriptor(&mut self, device: &DeviceInfo) -> Result<Vec<u8>, TransportError> {
        match &mut self.bus {
            Some(bus) => bus.descriptor(device),
            None => Err(TransportError::Gone { path: device.path.clone() }),
        }
    }

    fn strings(&mut self, device: &DeviceInfo) -> Box<dyn DeviceStrings> {
        match &mut self.bus {
            Some(bus) => bus.strings(device),
            None => Box::new(KnownStrings::none(StringsKept::Unanswered)),
        }
    }

    fn open(&mut self, device: &DeviceInfo) -> Result<Box<dyn Transport>, TransportError> {
        self.opened.insert(device.path.clone());
        match &mut self.bus {
            Some(bus) => bus.open(device),
            None => Err(TransportError::Gone { path: device.path.clone() }),
        }
    }
}

/// A recorded device that could not be read, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unread {
    /// Its number.
    pub device: usize,
    /// Why.
    pub reason: String,
}

/// One device of the recording while it plays.
struct Player {
    choice: Choice,
    machine: PenMachine,
    seen_ms: f64,
    /// How it is read, for people, its reports, and whether any was about a pen.
    way: String,
    reports: usize,
    was_seen: bool,
}

/// Plays a recording into a rectangle of a window and hands every event with its device's number to `sink`. Times are the
/// recording's own. What is left in range at the end leaves. Returns the devices that could not be read, and those whose
/// reports said nothing of a pen.
pub fn play(recording: &Recording, target: Rect, sink: &mut dyn FnMut(usize, &PenEvent)) -> Vec<Unread> {
    let mut unread = Vec::new();
    let mut players: Vec<Option<Player>> = Vec::new();
    for (number, device) in recording.devices.iter().enumerate() {
        let chosen = choose(device);
        let reason = match &chosen {
            Ok(Some(_)) => None,
            Ok(None) => Some("it is no pen that Penstemon knows".to_owned()),
            Err(error) => Some(error.to_string()),
        };
        unread.extend(reason.map(|reason| Unread { device: number, reason }));
        players.push(chosen.ok().flatten().map(|choice| Player::new(choice, target)));
    }
    let (mut events, mut end_ms) = (Vec::new(), 0.0);
    let mut forward = |device: usize, events: &mut Vec<PenEvent>| {
        events.drain(..).for_each(|event| sink(device, &event));
    };
    for entry in &recording.entries {
        let time_ms = entry.time_us as f64 * MS;
        end_ms = time_ms;
        for (number, player) in players.iter_mut().enumerate() {
            if let Some(player) = player {
                player.pass_silence(time_ms, &mut events);
                forward(number, &mut events);
            }
        }
        let Some(Some(player)) = players.get_mut(entry.device) else { continue };
        match &entry.what {
            Recorded::Report(report) => player.report(report, time_ms, &mut events),
            Recorded::Gone => player.machine.leave(time_ms, &mut events),
        }
        forward(entry.device, &mut events);
    }
    for (number, player) in players.iter_mut().enumerate() {
        if let Some(player) = player {
            player.machine.leave(end_ms, &mut events);
            forward(number, &mut events);
        }
    }
    let silent = players.iter().enumerate().filter_map(|(device, player)| {
        let reason = player.as_ref()?.was_it_silent()?;
        Some(Unread { device, reason })
    });
    unread.extend(silent);
    unread
}

/// How a recorded device is read, by what it said of itself when it was woken.
fn choose(device: &RecordedDevice) -> Result<Option<Choice>, ChooseError> {
    let chosen = choose_model(&device.info, &device.descriptor, Box::new(strings(device)), None)?;
    let Some(mut choice) = chosen else { return Ok(None) };
    choice.recall()?;
    Ok(Some(choice))
}

impl Player {
    fn new(mut choice: Choice, target: Rect) -> Self {
        let mapping = Mapping::new(target);
        let mapping = choice.area_mm.map_or(mapping, |area| mapping.keep_aspect(area));
        let way = std::mem::take(&mut choice.way);
        Self { choice, machine: PenMachine::new(mapping), seen_ms: 0.0, way, reports: 0, was_seen: false }
    }

    /// What is to be said of a device that sent reports of which none was about a pen.
    fn was_it_silent(&self) -> Option<String> {
        let Self { reports, way, .. } = self;
        let is_silent = *reports > 0 && !self.was_seen;
        is_silent.then(|| {
            let reports =
                if *reports == 1 { "its 1 report".to_owned() } else { format!("its {reports} reports") };
            format!(
                "none of {reports} is about a pen, read by {way}; no pen was near, or the tablet was not \
                 woken: record anew with the pen on the tablet, and with --strings"
            )
        })
    }

    fn pass_silence(&mut self, now_ms: f64, out: &mut Vec<PenEvent>) {
        if let Some(silence) = self.choice.silence
            && now_ms - self.seen_ms >= silence.after_ms
        {
            self.machine.idle(self.seen_ms + silence.after_ms, silence, out);
        }
    }

    fn report(&mut self, report: &[u8], time_ms: f64, out: &mut Vec<PenEvent>) {
        let machine = &mut self.machine;
        let mut is_pen = false;
        self.reports += 1;
        self.choice.decoder.decode(report, &mut |event| {
            if let HidEvent::Pen(pen) = event {
                is_pen = true;
                machine.sample(&pen, time_ms, out);
            }
        });
        if is_pen {
            (self.seen_ms, self.was_seen) = (time_ms, true);
        }
    }
}
