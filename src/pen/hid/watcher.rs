//! Finds pen devices as they are plugged in, and reads them until they are unplugged.
//!
//! Twice a second the system is asked which devices there are. New ones whose descriptor or model is a pen's are opened and
//! read by a thread of their own; a device whose reader has ended may come back under the same path at once. What cannot
//! be opened is tried again, since the rule that allows it may come a moment after the device, and said once. Everything
//! is said through one queue ([`super::reader`]).

use super::choose::{Choice, choose_decoder};
use super::reader::{DeviceId, Inbox, Notice, Outbox, Reader, queue};
use super::{DescriptorError, DeviceInfo, Enumerate, TransportError};
use std::collections::BTreeMap;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How often the system is asked for devices.
const POLL: Duration = Duration::from_millis(500);
/// Most devices read at once.
const MAX_READERS: usize = 32;

/// Chooses how a device is read; `None` for one that is no pen.
pub type Choose = dyn FnMut(&DeviceInfo, &[u8]) -> Result<Option<Choice>, DescriptorError> + Send;

/// What is known of a device that is there.
#[derive(Debug)]
enum Known {
    /// It is read.
    Read(Reader),
    /// It is no pen.
    Other,
    /// It could not be opened; this was said.
    Failed(String),
}

/// The devices that are there. [`Roster::poll`] brings it up to date; [`Watcher`] does so on a thread.
pub struct Roster {
    system: Box<dyn Enumerate>,
    choose: Box<Choose>,
    outbox: Outbox,
    known: BTreeMap<String, (DeviceInfo, Known)>,
    next_id: DeviceId,
}

impl Roster {
    /// A roster that knows no device yet.
    pub fn new(system: Box<dyn Enumerate>, choose: Box<Choose>, outbox: Outbox) -> Self {
        Self { system, choose, outbox, known: BTreeMap::new(), next_id: 0 }
    }

    /// Looks which devices came and went.
    ///
    /// # Errors
    /// A system that does not tell its devices; those that are read go on being read.
    pub fn poll(&mut self) -> Result<(), TransportError> {
        let found = self.system.devices()?;
        let is_there = |info: &DeviceInfo| found.iter().any(|device| device == info);
        self.known.retain(|_, (info, known)| match known {
            Known::Read(reader) => !reader.is_finished(),
            Known::Other | Known::Failed(_) => is_there(info),
        });
        for device in found {
            let said = match self.known.get(&device.path) {
                Some((_, Known::Read(_) | Known::Other)) => continue,
                Some((_, Known::Failed(said))) => Some(said.clone()),
                None => None,
            };
            let known = self.meet(&device, said.as_deref());
            self.known.insert(device.path.clone(), (device, known));
        }
        Ok(())
    }

    /// Devices that are read now.
    pub fn readers(&self) -> usize {
        self.known.values().filter(|(_, known)| matches!(known, Known::Read(_))).count()
    }

    fn meet(&mut self, device: &DeviceInfo, said: Option<&str>) -> Known {
        match self.open(device) {
            Ok(Some(reader)) => Known::Read(reader),
            Ok(None) => Known::Other,
            Err(told) => {
                if said != Some(told.as_str()) {
                    tracing::warn!("{}: {told}", device.name());
                    self.outbox.tell(self.next_id, Notice::Refused(format!("{}: {told}", device.name())));
                }
                Known::Failed(told)
            }
        }
    }

    fn open(&mut self, device: &DeviceInfo) -> Result<Option<Reader>, String> {
        let descriptor = self.system.descriptor(device).map_err(|error| error.to_string())?;
        let Some(choice) = (self.choose)(device, &descriptor).map_err(|error| error.to_string())? else {
            return Ok(None);
        };
        if self.readers() >= MAX_READERS {
            return Err(format!("{MAX_READERS} tablets are read already; unplug one"));
        }
        let transport = self.system.open(device).map_err(|error| error.to_string())?;
        let id = self.next_id;
        self.next_id += 1;
        let reader = Reader::start(id, transport, choice, self.outbox.clone());
        reader.map(Some).map_err(|error| error.to_string())
    }
}

/// Watches on a thread of its own. Dropping it ends the thread and all readers.
#[derive(Debug)]
pub struct Watcher {
    inbox: Inbox,
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Watcher {
    /// Begins to watch. `wake` is called from other threads when there is something to [`Inbox::drain`]; times count
    /// from `begin`.
    ///
    /// # Errors
    /// A system that gives no thread.
    pub fn start(
        system: Box<dyn Enumerate>,
        wake: impl Fn() + Send + Sync + 'static,
        begin: Instant,
    ) -> Result<Self, TransportError> {
        let (outbox, inbox) = queue(wake, begin);
        let mut roster = Roster::new(system, Box::new(choose_decoder), outbox);
        let (stop, stopped) = channel();
        let watch = move || {
            let mut told = None;
            loop {
                let fault = roster.poll().err();
                if let Some(fault) = fault.as_ref().filter(|fault| told.as_ref() != Some(*fault)) {
                    tracing::warn!("tablets cannot be looked for: {fault}");
                }
                told = fault;
                match stopped.recv_timeout(POLL) {
                    Err(RecvTimeoutError::Timeout) => {}
                    _ => return,
                }
            }
        };
        let thread = std::thread::Builder::new().name("tablets".into()).spawn(watch);
        let thread = thread
            .map_err(|error| TransportError::System { path: "tablets".into(), message: error.to_string() })?;
        Ok(Self { inbox, stop: Some(stop), thread: Some(thread) })
    }

    /// Where everything is said.
    pub fn inbox(&self) -> &Inbox {
        &self.inbox
    }
}

impl Drop for Watcher {
    fn drop(&mut self) {
        drop(self.stop.take());
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
#[path = "watcher_tests.rs"]
mod tests;
