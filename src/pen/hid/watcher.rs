//! Finds pen devices as they are plugged in, and reads them until they are unplugged.
//!
//! Twice a second the system is asked which devices there are. New ones whose descriptor or model is a pen's are opened,
//! woken, and read by a thread of their own; a device whose reader has ended may come back under the same path at once. What cannot
//! be opened is tried again, since the rule that allows it may come a moment after the device, and said once. A device
//! whose model the artist chose anew is let go and read again at once. Everything is said through one queue
//! ([`super::reader`]).

use super::choice::Choice;
use super::choose::{Models, choose_model};
use super::reader::{DeviceId, Inbox, Notice, Outbox, Reader, queue};
use super::{ChooseError, DeviceInfo, DeviceStrings, Enumerate, Refusal, Refused, TransportError};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How often the system is asked for devices.
const POLL: Duration = Duration::from_millis(500);
/// Most devices read at once.
const MAX_READERS: usize = 32;

/// Chooses how a device is read, by its descriptor, its USB strings and the model that the artist chose; `None` for one
/// that is no pen.
pub type Choose = dyn FnMut(&DeviceInfo, &[u8], Box<dyn DeviceStrings>, Option<&str>) -> Result<Option<Choice>, ChooseError>
    + Send;

/// What is known of a device that is there.
#[derive(Debug)]
enum Known {
    /// It is read.
    Read(Reader),
    /// It is no pen.
    Other,
    /// It cannot be read.
    Failed,
}

/// The devices that are there. [`Roster::poll`] brings it up to date; [`Watcher`] does so on a thread.
pub struct Roster {
    system: Box<dyn Enumerate>,
    choose: Box<Choose>,
    outbox: Outbox,
    models: Models,
    known: BTreeMap<String, (DeviceInfo, Known)>,
    /// What was said of paths that cannot be read.
    refused: BTreeMap<String, Arc<Refused>>,
    next_id: DeviceId,
}

impl Roster {
    /// A roster that knows no device yet.
    pub fn new(system: Box<dyn Enumerate>, choose: Box<Choose>, outbox: Outbox) -> Self {
        let (models, known, refused) = (Models::new(), BTreeMap::new(), BTreeMap::new());
        Self { system, choose, outbox, models, known, refused, next_id: 0 }
    }

    /// Takes the models that the artist chose. Devices of which another was chosen than before are let go; the next
    /// look finds them again.
    pub fn set_models(&mut self, models: Models) {
        let before = std::mem::replace(&mut self.models, models);
        let models = &self.models;
        self.known.retain(|_, (info, _)| {
            let identity = info.identity();
            before.get(&identity) == models.get(&identity)
        });
    }

    /// Looks which devices came and went.
    ///
    /// # Errors
    /// A system that does not list its devices; those that are read go on being read.
    pub fn poll(&mut self) -> Result<(), TransportError> {
        let found = self.system.devices()?;
        let is_there = |info: &DeviceInfo| found.iter().any(|device| device == info);
        self.known.retain(|_, (info, known)| match known {
            Known::Read(reader) => !reader.is_finished(),
            Known::Other | Known::Failed => is_there(info),
        });
        for device in found {
            let may_pass = || self.refused.get(&device.path).is_none_or(|refused| refused.why.may_pass());
            match self.known.get(&device.path) {
                Some((_, Known::Read(_) | Known::Other)) => continue,
                Some((_, Known::Failed)) if !may_pass() => continue,
                Some((_, Known::Failed)) | None => {}
            }
            let known = self.meet(&device);
            self.known.insert(device.path.clone(), (device, known));
        }
        let (known, outbox, id) = (&self.known, &self.outbox, self.next_id);
        self.refused.retain(|path, _| {
            let is_refused = matches!(known.get(path), Some((_, Known::Failed)));
            if !is_refused {
                outbox.notify(id, Notice::Settled(path.as_str().into()));
            }
            is_refused
        });
        Ok(())
    }

    /// Devices that are read now.
    pub fn readers(&self) -> usize {
        self.known.values().filter(|(_, known)| matches!(known, Known::Read(_))).count()
    }

    fn meet(&mut self, device: &DeviceInfo) -> Known {
        let why = match self.open(device) {
            Ok(Some(reader)) => return Known::Read(reader),
            Ok(None) => return Known::Other,
            Err(why) => why,
        };
        // Unplugged while it was met: that is no refusal, and the next look does not find it.
        if matches!(why, Refusal::Transport(TransportError::Gone { .. })) {
            return Known::Failed;
        }
        let refused = Refused { device: device.clone(), why };
        if self.refused.get(&device.path).is_none_or(|said| **said != refused) {
            tracing::warn!("{refused}");
            let refused = Arc::new(refused);
            self.outbox.notify(self.next_id, Notice::Refused(Arc::clone(&refused)));
            self.refused.insert(device.path.clone(), refused);
        }
        Known::Failed
    }

    fn open(&mut self, device: &DeviceInfo) -> Result<Option<Reader>, Refusal> {
        let descriptor = self.system.descriptor(device)?;
        let model = self.models.get(&device.identity()).map(String::as_str);
        let strings = self.system.strings(device);
        let Some(mut choice) = (self.choose)(device, &descriptor, strings, model)? else {
            return Ok(None);
        };
        if self.readers() >= MAX_READERS {
            return Err(Refusal::TooMany { limit: MAX_READERS });
        }
        let mut transport = self.system.open(device)?;
        choice.wake(&mut *transport)?;
        let id = self.next_id;
        self.next_id += 1;
        Ok(Some(Reader::start(id, transport, choice, self.outbox.clone())?))
    }
}

/// Watches on a thread of its own. Dropping it ends the thread and all readers.
#[derive(Debug)]
pub struct Watcher {
    inbox: Inbox,
    models: Option<Sender<Models>>,
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
        Self::start_with(system, Models::new(), wake, begin)
    }

    /// The same with models that the artist chose.
    ///
    /// # Errors
    /// As before.
    pub fn start_with(
        system: Box<dyn Enumerate>,
        models: Models,
        wake: impl Fn() + Send + Sync + 'static,
        begin: Instant,
    ) -> Result<Self, TransportError> {
        let (outbox, inbox) = queue(wake, begin);
        let mut roster = Roster::new(system, Box::new(choose_model), outbox);
        roster.set_models(models);
        let (sender, orders) = channel();
        let watch = move || {
            let mut reported = None;
            loop {
                let fault = roster.poll().err();
                if let Some(fault) = fault.as_ref().filter(|fault| reported.as_ref() != Some(*fault)) {
                    tracing::warn!("tablets cannot be looked for: {fault}");
                }
                reported = fault;
                match orders.recv_timeout(POLL) {
                    Ok(models) => roster.set_models(models),
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => return,
                }
            }
        };
        let thread = std::thread::Builder::new().name("tablets".into()).spawn(watch);
        let thread = thread
            .map_err(|error| TransportError::System { path: "tablets".into(), message: error.to_string() })?;
        Ok(Self { inbox, models: Some(sender), thread: Some(thread) })
    }

    /// Takes the models that the artist chose; tablets of which another was chosen than before are read anew at once.
    pub fn set_models(&self, models: Models) {
        if let Some(sender) = &self.models {
            // A watcher that has died reads nothing any more.
            let _ = sender.send(models);
        }
    }

    /// Where everything is said.
    pub fn inbox(&self) -> &Inbox {
        &self.inbox
    }
}

impl Drop for Watcher {
    fn drop(&mut self) {
        drop(self.models.take());
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
#[path = "watcher_tests.rs"]
mod tests;
