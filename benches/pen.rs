//! Reports of tablets: how many a second are decoded, and how long one takes from its arrival to a pen event in the
//! window's queue. `cargo bench --bench pen`; goals: 2 million reports a second, 100 µs at the 99th percentile.
//!
//! A delay is counted from the moment at which the bytes are given to the transport. It is mostly the system's, which wakes
//! the reader's thread and then the window's, so the same run measures bare channels between as many threads.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    missing_docs,
    reason = "a bench that cannot go on has failed; criterion's macros have no docs; the delays are printed"
)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec2;
use penstemon::pen::hid::reader::{Reader, queue};
use penstemon::pen::hid::simulated::SimulatedDevice;
use penstemon::pen::hid::{Decode, DescriptorDecoder, DeviceInfo, HidEvent, Notice, RawPen, choose_decoder};
use penstemon::pen::mapping::Rect;
use penstemon::pen::{Mapping, PenMachine};
use std::hint::black_box;
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

#[path = "../tests/common/tablets.rs"]
#[allow(dead_code, reason = "shared with tests")]
mod tablets;

/// Reports decoded in one go, as a circle drawn at full rate.
const REPORTS: u16 = 1000;

fn circle() -> Vec<Vec<u8>> {
    let report = |n: u16| {
        let angle = f64::from(n) / f64::from(REPORTS) * std::f64::consts::TAU;
        let place = |along: f64| (16_384.0 + 12_000.0 * along) as u16;
        let switches = tablets::switch::IN_RANGE | tablets::switch::TIP;
        let (x, y) = (place(angle.cos()), place(angle.sin()));
        let tilt = [(angle.cos() * 6000.0) as i16, (angle.sin() * 6000.0) as i16];
        tablets::DisplayReport { switches, x, y, tilt, pressure: n, twist: n, battery: 50, serial: 7 }.bytes()
    };
    (0..REPORTS).map(report).collect()
}

fn window() -> Mapping {
    Mapping::new(Rect { min: DVec2::ZERO, max: DVec2::new(1920.0, 1080.0) })
}

fn decoding(c: &mut Criterion) {
    let mut group = c.benchmark_group("decode");
    group.throughput(Throughput::Elements(u64::from(REPORTS)));
    let wacom = (0..REPORTS).map(|n| {
        let mut report = [0x41; 24];
        report[0] = 16;
        report[2..4].copy_from_slice(&n.to_le_bytes());
        report.to_vec()
    });
    let cases =
        [("pen display", tablets::PEN_DISPLAY, circle()), ("wacom", tablets::WACOM_PAGE, wacom.collect())];
    for (name, descriptor, reports) in cases {
        let mut decoder = DescriptorDecoder::new(descriptor).unwrap().unwrap();
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| {
                for report in &reports {
                    decoder.decode(black_box(report), &mut |event| {
                        black_box(event);
                    });
                }
            });
        });
    }
    group.finish();
}

fn events(c: &mut Criterion) {
    let mut group = c.benchmark_group("pen_events");
    group.throughput(Throughput::Elements(u64::from(REPORTS)));
    let (mut machine, mut out) = (PenMachine::new(window()), Vec::with_capacity(usize::from(REPORTS) * 5));
    let mut time_ms = 0.0;
    group.bench_function("machine", |b| {
        b.iter(|| {
            out.clear();
            for n in 0..REPORTS {
                let position = DVec2::splat(f64::from(n) / f64::from(REPORTS));
                let raw = RawPen { in_range: true, touches: n % 50 != 0, position, ..RawPen::default() };
                time_ms += 1.0;
                machine.sample(black_box(&raw), time_ms, &mut out);
            }
        });
    });
    group.finish();
}

/// Reports of one round, and rounds: the ways take turns, so that all meet the same noise of the machine.
const ROUND: usize = 500;
const ROUNDS: usize = 10;
/// First reports of a round, while threads are new.
const WARM: usize = 20;

/// Hands over one thing a millisecond; the moments at which each was handed over. Sleeping is over before a moment is
/// taken, so that it counts nowhere.
fn paced(mut hand_over: impl FnMut(usize)) -> Vec<Instant> {
    let moments = (0..ROUND).map(|n| {
        std::thread::sleep(Duration::from_millis(1));
        let now = Instant::now();
        hand_over(n);
        now
    });
    moments.collect()
}

/// When the first event of each report was in the queue.
struct InQueue {
    reports: usize,
    moments: Vec<Instant>,
}

impl InQueue {
    /// Takes the moment, unless it was taken for this report.
    fn stamp(&mut self) {
        if self.moments.len() < self.reports {
            self.moments.push(Instant::now());
        }
    }
}

/// Counts reports. The moment is taken when the queue asks for the window to be woken, which comes next after the event;
/// where the window is awake already, when the report is decoded.
struct Stamped {
    decoder: Box<dyn Decode>,
    in_queue: Arc<Mutex<InQueue>>,
}

impl Decode for Stamped {
    fn decode(&mut self, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        self.in_queue.lock().unwrap().reports += 1;
        self.decoder.decode(report, sink);
        self.in_queue.lock().unwrap().stamp();
    }
}

/// From a report's bytes to its event in the queue, and to the pen event that the woken thread makes of it.
fn reports(queued: &mut Vec<f64>, heard: &mut Vec<f64>) {
    let device = SimulatedDevice::new(DeviceInfo::default(), tablets::PEN_DISPLAY);
    let mut choice = choose_decoder(device.info(), tablets::PEN_DISPLAY).unwrap().unwrap();
    let in_queue = Arc::new(Mutex::new(InQueue { reports: 0, moments: Vec::with_capacity(ROUND) }));
    choice.decoder = Box::new(Stamped { decoder: choice.decoder, in_queue: Arc::clone(&in_queue) });
    let ((wake, woken), stamps) = (channel(), Arc::clone(&in_queue));
    let wakes = move || {
        stamps.lock().unwrap().stamp();
        wake.send(()).unwrap_or_default();
    };
    let (outbox, inbox) = queue(wakes, Instant::now());
    let reader = Reader::start(0, Box::new(device.open()), choice, outbox).unwrap();
    let sender = std::thread::spawn(move || {
        let circle = circle();
        let sent = paced(|n| device.send(&circle[n]));
        device.unplug_at_end();
        sent
    });
    let (mut machine, mut events, mut arrived) =
        (PenMachine::new(window()), Vec::with_capacity(8192), Vec::with_capacity(ROUND));
    let mut is_there = true;
    while is_there && woken.recv_timeout(Duration::from_secs(10)).is_ok() {
        inbox.drain(|message| match message.notice {
            Notice::Said(HidEvent::Pen(pen)) if pen.in_range => {
                machine.sample(&pen, message.time_ms, &mut events);
                arrived.push(Instant::now());
            }
            Notice::Gone(_) => is_there = false,
            _ => {}
        });
    }
    drop(reader);
    let sent = sender.join().unwrap();
    let in_queue = in_queue.lock().unwrap();
    assert_eq!((sent.len(), sent.len()), (arrived.len(), in_queue.moments.len()), "a report was lost");
    delays(&sent, &in_queue.moments, queued);
    delays(&sent, &arrived, heard);
}

/// From one thread to the last of so many others, through bare channels: what the machine itself needs.
fn bare(hand_overs: usize, took: &mut Vec<f64>) {
    let (first, mut receiver) = channel::<usize>();
    for _ in 1..hand_overs {
        let (next, received) = channel();
        let before = std::mem::replace(&mut receiver, received);
        std::thread::spawn(move || before.iter().try_for_each(|n| next.send(n)));
    }
    let sender = std::thread::spawn(move || paced(|n| first.send(n).unwrap()));
    let arrived: Vec<Instant> = receiver.iter().map(|_| Instant::now()).collect();
    delays(&sender.join().unwrap(), &arrived, took);
}

/// Appends how long each took, in microseconds.
fn delays(from: &[Instant], to: &[Instant], out: &mut Vec<f64>) {
    let took = from.iter().zip(to).map(|(from, to)| (*to - *from).as_secs_f64() * 1e6);
    out.extend(took.skip(WARM));
}

/// Delays of reports, 1,000 a second, beside those of bare channels between as many threads in the same run.
fn delay(_: &mut Criterion) {
    let (mut queued, mut heard, mut once, mut twice) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        bare(1, &mut once);
        reports(&mut queued, &mut heard);
        bare(2, &mut twice);
    }
    let bare_once = told("one thread to another, bare channel", &mut once, None);
    told("report to event in the window's queue", &mut queued, Some(bare_once));
    let bare_twice = told("one thread to a third, two bare channels", &mut twice, None);
    told("report to pen event in the woken thread", &mut heard, Some(bare_twice));
}

/// Prints the distribution and returns its middle and 99th percentile; beside what the bare machine needs, if given.
fn told(what: &str, took: &mut [f64], bare: Option<[f64; 2]>) -> [f64; 2] {
    took.sort_by(f64::total_cmp);
    let at = |share: f64| took[((took.len() - 1) as f64 * share) as usize];
    let (half, most, all) = (at(0.5), at(0.99), at(1.0));
    let beside = bare.map(|[bare_half, bare_most]| {
        format!("; {:.2} and {:.2} times the bare channels", half / bare_half, most / bare_most)
    });
    let (count, beside) = (took.len(), beside.unwrap_or_default());
    println!("{what}, {count} times: p50 {half:.1} µs, p99 {most:.1} µs, most {all:.1} µs{beside}");
    [half, most]
}

criterion_group!(benches, decoding, events, delay);
criterion_main!(benches);
