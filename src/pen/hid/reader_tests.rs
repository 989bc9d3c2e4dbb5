//! Tests of the reader's thread and its queue, over simulated devices.

use super::*;
use crate::pen::hid::simulated::SimulatedDevice;
use crate::pen::hid::{Abilities, Decode};
use crate::pen::machine::Silence;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::sync::atomic::AtomicUsize;

/// Longest that a test waits for another thread.
const PATIENCE_OF_TESTS: Duration = Duration::from_secs(60);

/// Reads reports of 5 bytes: in range (1), touching as well (2) or not, and the number of the report as the pen's serial.
struct Counter;

impl Decode for Counter {
    fn decode(&mut self, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        if let [in_range, number @ ..] = report
            && let Ok(number) = number.try_into()
        {
            let serial = u64::from(u32::from_le_bytes(number));
            let (in_range, touches) = (*in_range != 0, *in_range == 2);
            sink(HidEvent::Pen(RawPen { in_range, touches, serial, ..RawPen::default() }));
        }
    }
}

fn choice(silence: Option<Silence>) -> Choice {
    Choice {
        decoder: Box::new(Counter),
        wake_up: None,
        way: "counting".into(),
        area_mm: None,
        silence,
        abilities: Abilities::default(),
        doubt: None,
    }
}

fn device() -> SimulatedDevice {
    SimulatedDevice::new(DeviceInfo { path: "sim0".into(), ..Default::default() }, &[])
}

fn report(number: u32) -> [u8; 5] {
    let [a, b, c, d] = number.to_le_bytes();
    [1, a, b, c, d]
}

fn start(device: &SimulatedDevice, silence: Option<Silence>, outbox: Outbox) -> Reader {
    Reader::start(7, Box::new(device.open()), choice(silence), outbox).unwrap()
}

/// Everything that is said until the device is gone.
fn until_gone(inbox: &Inbox) -> Vec<Message> {
    let (mut all, begin) = (Vec::new(), Instant::now());
    while !all.last().is_some_and(|m: &Message| matches!(m.notice, Notice::Gone(_))) {
        assert!(begin.elapsed() < PATIENCE_OF_TESTS, "the reader never ended");
        inbox.drain(|message| all.push(message));
        std::thread::yield_now();
    }
    all
}

fn pens(messages: &[Message]) -> Vec<RawPen> {
    let pen = |message: &Message| match message.notice {
        Notice::Said(HidEvent::Pen(pen)) => Some(pen),
        _ => None,
    };
    messages.iter().filter_map(pen).collect()
}

#[test]
fn a_device_arrives_speaks_and_goes_and_its_pen_leaves_first() {
    let (outbox, inbox) = queue(|| {}, Instant::now());
    let device = device();
    device.send(&report(1));
    device.send(&report(2));
    device.unplug_at_end();
    let reader = start(&device, None, outbox);
    let all = until_gone(&inbox);
    assert!(matches!(&all[0].notice, Notice::Arrived(a) if a.way == "counting" && a.info.path == "sim0"));
    assert!(matches!(&all[4].notice, Notice::Gone(TransportError::Gone { .. })), "{all:?}");
    assert_eq!(pens(&all).iter().map(|pen| pen.in_range).collect::<Vec<_>>(), [true, true, false]);
    assert!(all.is_sorted_by(|a, b| a.time_ms <= b.time_ms) && all.iter().all(|m| m.device == 7));
    drop(reader);
    assert_eq!(device.handles(), 0);
}

#[test]
fn a_silent_pen_leaves_where_only_silence_says_so() {
    let (outbox, inbox) = queue(|| {}, Instant::now());
    let device = device();
    let reader = start(&device, Some(Silence::KNOWN), outbox);
    device.send(&report(1));
    let mut all = Vec::new();
    let begin = Instant::now();
    while pens(&all).len() < 2 && begin.elapsed() < PATIENCE_OF_TESTS {
        inbox.drain(|message| all.push(message));
        std::thread::yield_now();
    }
    let pens = pens(&all);
    assert!(pens[0].in_range && !pens[1].in_range);
    assert!(all[2].time_ms - all[1].time_ms >= Silence::KNOWN.after_ms);
    assert!(!reader.is_finished());
}

#[test]
fn a_pen_that_rests_where_it_touches_stays_where_silence_is_a_guess() {
    const SILENCE: Silence = Silence { after_ms: 20.0, ..Silence::LIKELY };
    let (outbox, inbox) = queue(|| {}, Instant::now());
    let device = device();
    let _reader = start(&device, Some(SILENCE), outbox);
    device.send(&[2, 1, 0, 0, 0]);
    // Silent for five times as long, then it hovers.
    device.send_at(&report(2), Instant::now() + Duration::from_millis(100));
    let (mut all, begin) = (Vec::new(), Instant::now());
    while pens(&all).len() < 3 && begin.elapsed() < PATIENCE_OF_TESTS {
        inbox.drain(|message| all.push(message));
        std::thread::yield_now();
    }
    let said: Vec<_> = pens(&all).iter().map(|pen| (pen.in_range, pen.touches)).collect();
    assert_eq!(said, [(true, true), (true, false), (false, false)], "{all:?}");
}

#[test]
fn nothing_is_lost_while_the_window_stalls() {
    // A tablet of 1,000 reports a second for a minute, faster than time; stalls of up to half a second of it.
    const REPORTS: u32 = 60_000;
    const LONGEST_STALL: u32 = 500;
    let (outbox, inbox) = queue(|| {}, Instant::now());
    let device = device();
    let reader = start(&device, None, outbox);
    let mut random = Pcg64Mcg::seed_from_u64(2026);
    let (mut all, mut sent) = (Vec::with_capacity(REPORTS as usize + 3), 0);
    while sent < REPORTS {
        // The window looks while the reports of the next stall come. The device does not run farther ahead than that:
        // how long the system really keeps this thread waiting must not decide what is lost.
        let stall = random.random_range(1..=LONGEST_STALL).min(REPORTS - sent);
        (sent..sent + stall).for_each(|number| device.send(&report(number)));
        inbox.drain(|message| all.push(message));
        sent += stall;
        assert!(device.wait_read(sent as usize, PATIENCE_OF_TESTS));
    }
    device.unplug_at_end();
    all.extend(until_gone(&inbox));
    drop(reader);
    let numbers: Vec<u64> = pens(&all).iter().filter(|pen| pen.in_range).map(|pen| pen.serial).collect();
    assert!(numbers.iter().copied().eq(0..u64::from(REPORTS)), "{} of {REPORTS} in order", numbers.len());
    assert_eq!(inbox.left_out(), 0);
    assert!(all.is_sorted_by(|a, b| a.time_ms <= b.time_ms));
}

#[test]
fn a_full_queue_keeps_the_newest_and_counts_the_rest() {
    let (outbox, inbox) = queue_of(4, || {}, Instant::now());
    let device = device();
    (0..10).for_each(|number| device.send(&report(number)));
    let reader = start(&device, None, outbox);
    assert!(device.wait_read(10, PATIENCE_OF_TESTS));
    device.unplug();
    let all = until_gone(&inbox);
    let numbers: Vec<u64> = pens(&all).iter().map(|pen| pen.serial).collect();
    // The arrival and three events fit; of the seven others and the leaving, the leaving remains.
    assert_eq!(numbers[..3], [0, 1, 2]);
    assert_eq!(pens(&all).last().map(|pen| pen.in_range), Some(false));
    assert_eq!(inbox.left_out() as usize + pens(&all).len(), 11);
    drop(reader);
    assert_eq!(device.handles(), 0);
}

#[test]
fn the_window_is_woken_once_until_it_looks() {
    let woken = Arc::new(AtomicUsize::new(0));
    let counter = woken.clone();
    let (outbox, inbox) = queue(
        move || {
            counter.fetch_add(1, Ordering::SeqCst);
        },
        Instant::now(),
    );
    let device = device();
    (0..100).for_each(|number| device.send(&report(number)));
    let reader = start(&device, None, outbox);
    assert!(device.wait_read(100, PATIENCE_OF_TESTS));
    assert_eq!(woken.load(Ordering::SeqCst), 1);
    inbox.drain(drop);
    device.unplug();
    until_gone(&inbox);
    assert!(woken.load(Ordering::SeqCst) > 1);
    drop(reader);
}

#[test]
fn a_reader_ends_when_nobody_wants_it() {
    let (outbox, inbox) = queue_of(1, || {}, Instant::now());
    let device = device();
    let reader = start(&device, None, outbox);
    drop(reader);
    assert_eq!(device.handles(), 0, "its queue is full and nobody looks");
    drop(inbox);
}
