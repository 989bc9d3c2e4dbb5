//! The window's side: the library's watcher over the system's devices, and patience.

use penstemon::pen::hid::{
    Arrival, DeviceId, HidEvent, Message, Notice, RawPen, System, TransportError, Watcher,
};
use std::collections::VecDeque;
use std::error::Error;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};
use std::time::{Duration, Instant};

/// Longest wait for something that must come.
pub(crate) const PATIENCE: Duration = Duration::from_secs(10);

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Hears all tablets, one message after the other.
pub(crate) struct Listener {
    watcher: Watcher,
    woken: Receiver<()>,
    messages: VecDeque<Message>,
}

impl Listener {
    /// Begins to watch the system.
    pub(crate) fn start() -> Outcome<Self> {
        let (wakes, woken) = sync_channel(1);
        // When it is full, the listener is being woken already.
        let wake = move || {
            let _ = wakes.try_send(());
        };
        let watcher = Watcher::start(Box::new(System::new()), wake, Instant::now())?;
        Ok(Self { watcher, woken, messages: VecDeque::new() })
    }

    /// The next message, if one comes within `patience`.
    pub(crate) fn next(&mut self, patience: Duration) -> Option<Message> {
        let end = Instant::now() + patience;
        loop {
            if let Some(message) = self.messages.pop_front() {
                return Some(message);
            }
            // That a refusal is over comes beside the arrival that ended it, before or after.
            let is_unsettled = |message: &Message| !matches!(message.notice, Notice::Settled(_));
            let messages = &mut self.messages;
            self.watcher.inbox().drain(|message| messages.extend(Some(message).filter(is_unsettled)));
            let left = end.saturating_duration_since(Instant::now());
            if self.messages.is_empty() && self.woken.recv_timeout(left).is_err() {
                return None;
            }
        }
    }

    fn must_come(&mut self, what: &str) -> Outcome<Message> {
        self.next(PATIENCE).ok_or_else(|| format!("{what} did not come in {PATIENCE:?}").into())
    }

    /// A device that is found next.
    pub(crate) fn arrival(&mut self) -> Outcome<(DeviceId, Arc<Arrival>)> {
        let message = self.must_come("a device")?;
        match message.notice {
            Notice::Arrived(arrival) => Ok((message.device, arrival)),
            other => Err(format!("a device should arrive, not {other:?}").into()),
        }
    }

    /// What the pen of a device says next, and when; batteries and fingers are passed over.
    pub(crate) fn pen(&mut self, device: DeviceId) -> Outcome<(RawPen, f64)> {
        loop {
            let message = self.must_come("a report")?;
            match message.notice {
                _ if message.device != device => return Err(format!("not asked for: {message:?}").into()),
                Notice::Said(HidEvent::Pen(pen)) => return Ok((pen, message.time_ms)),
                Notice::Said(_) => {}
                other => return Err(format!("a pen should speak, not {other:?}").into()),
            }
        }
    }

    /// The end of a device whose pen has left.
    pub(crate) fn end(&mut self, device: DeviceId) -> Outcome<()> {
        let message = self.must_come("the end of the device")?;
        match message.notice {
            Notice::Gone(TransportError::Gone { .. }) if message.device == device => Ok(()),
            other => Err(format!("the device should be gone, not {other:?}").into()),
        }
    }

    /// Events that found no room in the queue.
    pub(crate) fn left_out(&self) -> u64 {
        self.watcher.inbox().left_out()
    }
}
