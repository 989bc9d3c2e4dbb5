//! One thread per device that drains its node.
//!
//! The kernel keeps 64 reports of a device and silently drops the oldest beyond, so a thread waits on the node, stamps each
//! report with the time at which it arrived, decodes it and puts the events into a queue that the window thread empties
//! when it can. The queue is bounded and its memory taken when it is made: [`QUEUE_LENGTH`] messages, half a minute of
//! a tablet that sends 1,000 reports a second. While it is full, of each further run of events only the newest is kept,
//! so that the pen's state is right again as soon as there is room, and what was left out is counted. Nothing is
//! allocated for a report.

use super::choice::{Choice, Doubt};
use super::refusal::Refused;
use super::{DeviceInfo, HidEvent, RawPen, Transport, TransportError};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, TrySendError, sync_channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Messages that wait for the window thread at most, of all devices together.
pub const QUEUE_LENGTH: usize = 1 << 15;
/// Longest report that is read; HID pens stay below 100 bytes.
const MAX_REPORT_BYTES: usize = 4096;
/// How long a reader waits at a time: how fast it ends when it should.
const PATIENCE: Duration = Duration::from_millis(200);
/// How long a reader waits for room in the queue before it looks again.
const FULL_QUEUE: Duration = Duration::from_millis(2);

/// Number of a device, given when it was plugged in and never given again.
pub type DeviceId = u32;

/// What is said of a device.
#[derive(Clone, Debug)]
pub enum Notice {
    /// A pen device is there and is read.
    Arrived(Arc<Arrival>),
    /// It said something.
    Said(HidEvent),
    /// A device is there and cannot be read.
    Refused(Arc<Refused>),
    /// What was refused at this path is refused no longer: it is read, or it is gone.
    Settled(Arc<str>),
    /// It is not read any more; its pen has left before.
    Gone(TransportError),
}

/// A device that is read.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival {
    /// Who it is.
    pub info: DeviceInfo,
    /// How it is read, for people.
    pub way: String,
    /// Width and height of the active area in millimetres, if known.
    pub area_mm: Option<glam::DVec2>,
    /// What its pen can say.
    pub abilities: super::Abilities,
    /// The models it may be, where that is not sure.
    pub doubt: Option<Doubt>,
}

/// A notice with its device and its time.
#[derive(Clone, Debug)]
pub struct Message {
    /// The device.
    pub device: DeviceId,
    /// When it arrived, in milliseconds since the queue's beginning of time.
    pub time_ms: f64,
    /// What.
    pub notice: Notice,
}

/// The window's end of the queue.
#[derive(Debug)]
pub struct Inbox {
    messages: Receiver<Message>,
    shared: Arc<Shared>,
}

/// The readers' end of the queue.
#[derive(Clone, Debug)]
pub struct Outbox {
    messages: SyncSender<Message>,
    shared: Arc<Shared>,
}

struct Shared {
    wake: Box<dyn Fn() + Send + Sync>,
    /// The window was woken and has not looked since.
    is_woken: AtomicBool,
    left_out: AtomicU64,
    begin: Instant,
}

impl std::fmt::Debug for Shared {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Shared").field("left_out", &self.left_out).finish_non_exhaustive()
    }
}

/// A queue. `wake` is called from readers' threads when there is something new; times count from `begin`.
pub fn queue(wake: impl Fn() + Send + Sync + 'static, begin: Instant) -> (Outbox, Inbox) {
    queue_of(QUEUE_LENGTH, wake, begin)
}

fn queue_of(length: usize, wake: impl Fn() + Send + Sync + 'static, begin: Instant) -> (Outbox, Inbox) {
    let (sender, receiver) = sync_channel(length);
    let (is_woken, left_out) = (AtomicBool::new(false), AtomicU64::new(0));
    let shared = Arc::new(Shared { wake: Box::new(wake), is_woken, left_out, begin });
    (Outbox { messages: sender, shared: shared.clone() }, Inbox { messages: receiver, shared })
}

impl Inbox {
    /// Hands over everything that waits, oldest first.
    pub fn drain(&self, mut take: impl FnMut(Message)) {
        // Looked at before emptying: what comes meanwhile wakes the window once more.
        self.shared.is_woken.store(false, Ordering::SeqCst);
        loop {
            match self.messages.try_recv() {
                Ok(message) => take(message),
                Err(TryRecvError::Empty | TryRecvError::Disconnected) => return,
            }
        }
    }

    /// Events that were left out because the window did not look for too long.
    pub fn left_out(&self) -> u64 {
        self.shared.left_out.load(Ordering::Relaxed)
    }
}

impl Outbox {
    /// Milliseconds since the beginning of time.
    pub fn now_ms(&self) -> f64 {
        self.shared.begin.elapsed().as_secs_f64() * 1e3
    }

    /// Says something of a device that is not read; where there is no room it goes unsaid.
    pub(super) fn notify(&self, device: DeviceId, notice: Notice) {
        let _ = self.try_send(Message { device, time_ms: self.now_ms(), notice });
    }

    fn try_send(&self, message: Message) -> Result<(), TrySendError<Message>> {
        let sent = self.messages.try_send(message);
        // Also when it is full: the window ought to look.
        if !self.shared.is_woken.swap(true, Ordering::SeqCst) {
            (self.shared.wake)();
        }
        sent
    }
}

/// A thread that reads one device. Dropping it ends the thread.
#[derive(Debug)]
pub struct Reader {
    thread: Option<JoinHandle<()>>,
    stop: Arc<AtomicBool>,
}

impl Reader {
    /// Begins to read a device that is awake; it says [`Notice::Arrived`] first and [`Notice::Gone`] last.
    ///
    /// # Errors
    /// A system that gives no thread.
    pub fn start(
        device: DeviceId,
        transport: Box<dyn Transport>,
        choice: Choice,
        outbox: Outbox,
    ) -> Result<Self, TransportError> {
        let path = transport.info().path.clone();
        let stop = Arc::new(AtomicBool::new(false));
        let drain =
            Drain { device, outbox, waiting: None, stop: stop.clone(), pen: RawPen::default(), seen_ms: 0.0 };
        // Named after its node, for whoever looks at the program's threads.
        let name = path.rsplit(['/', '\0']).next().unwrap_or_default().to_owned();
        let thread = std::thread::Builder::new().name(name);
        let thread = thread.spawn(move || drain.run(transport, choice));
        let thread = thread.map_err(|error| TransportError::System { path, message: error.to_string() })?;
        Ok(Self { thread: Some(thread), stop })
    }

    /// Whether the device is gone and the thread at its end.
    pub fn is_finished(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }
}

impl Drop for Reader {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            // A reader that panicked has said so on stderr; its device is not read any more.
            let _ = thread.join();
        }
    }
}

/// What the thread does.
struct Drain {
    device: DeviceId,
    outbox: Outbox,
    /// The newest of the messages that found no room.
    waiting: Option<Message>,
    stop: Arc<AtomicBool>,
    /// What the pen said last.
    pen: RawPen,
    seen_ms: f64,
}

impl Drain {
    fn run(mut self, mut transport: Box<dyn Transport>, mut choice: Choice) {
        let arrival = Arrival {
            info: transport.info().clone(),
            way: std::mem::take(&mut choice.way),
            area_mm: choice.area_mm,
            abilities: choice.abilities,
            doubt: choice.doubt.take(),
        };
        self.insist(Notice::Arrived(Arc::new(arrival)));
        let mut buffer = [0; MAX_REPORT_BYTES];
        let end = loop {
            if self.stop.load(Ordering::Relaxed) {
                break TransportError::Gone { path: transport.info().path.clone() };
            }
            match transport.read(&mut buffer, self.patience(&choice)) {
                Ok(0) => self.silence(&choice),
                Ok(length) => {
                    let time_ms = self.outbox.now_ms();
                    let report = buffer.get(..length).unwrap_or(&buffer);
                    choice.decoder.decode(report, &mut |event| self.say(event, time_ms));
                }
                Err(error) => break error,
            }
        };
        // Closed before it is said, so that the device can be opened again as soon as it is.
        drop(transport);
        self.pen_leaves();
        self.insist(Notice::Gone(end));
    }

    /// How long to wait for a report.
    fn patience(&self, choice: &Choice) -> Duration {
        if self.waiting.is_some() {
            return FULL_QUEUE;
        }
        match choice.silence {
            Some(silence) if self.pen.in_range => {
                Duration::from_secs_f64(silence.after_ms / 1e3).min(PATIENCE)
            }
            _ => PATIENCE,
        }
    }

    fn silence(&mut self, choice: &Choice) {
        if let Some(silence) = choice.silence.filter(|silence| silence.applies(self.pen.touches))
            && self.outbox.now_ms() - self.seen_ms >= silence.after_ms
        {
            self.pen_leaves();
        }
        if let Some(message) = self.waiting.take() {
            self.offer(message);
        }
    }

    fn pen_leaves(&mut self) {
        if self.pen.in_range {
            let time_ms = self.outbox.now_ms();
            self.say(HidEvent::Pen(RawPen::default()), time_ms);
        }
    }

    fn say(&mut self, event: HidEvent, time_ms: f64) {
        if let HidEvent::Pen(pen) = event {
            self.pen = pen;
            self.seen_ms = time_ms;
        }
        self.offer(Message { device: self.device, time_ms, notice: Notice::Said(event) });
    }

    /// Sends a message, after the one that waits; where there is no room it waits in its place.
    fn offer(&mut self, message: Message) {
        if let Some(waiting) = self.waiting.take()
            && let Err(TrySendError::Full(_)) = self.outbox.try_send(waiting)
        {
            self.outbox.shared.left_out.fetch_add(1, Ordering::Relaxed);
            self.waiting = Some(message);
            return;
        }
        if let Err(TrySendError::Full(message)) = self.outbox.try_send(message) {
            self.waiting = Some(message);
        }
    }

    /// Sends a message that must arrive, waiting for room until the reader is stopped.
    fn insist(&mut self, notice: Notice) {
        let mut last = Message { device: self.device, time_ms: self.outbox.now_ms(), notice };
        let mut first = self.waiting.take();
        loop {
            let (sending, is_last) = match first.take() {
                Some(message) => (message, false),
                None => (last.clone(), true),
            };
            match self.outbox.try_send(sending) {
                Err(TrySendError::Full(message)) if !self.stop.load(Ordering::Relaxed) => {
                    if is_last {
                        last = message
                    } else {
                        first = Some(message)
                    }
                    std::thread::sleep(FULL_QUEUE);
                }
                _ if is_last => return,
                _ => {}
            }
        }
    }
}

#[cfg(test)]
#[path = "reader_tests.rs"]
mod tests;
