//! Reports of tablets: how many a second are decoded, and how long one takes from its arrival to a pen event in the
//! window's queue. `cargo bench --bench pen`; goals: 2 million reports a second, 100 µs at the 99th percentile.

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

/// Sends reports one by one, 1,000 a second, and measures until the window's thread has the event.
fn delay(_: &mut Criterion) {
    const PAUSE: Duration = Duration::from_millis(1);
    let begin = Instant::now();
    let device = SimulatedDevice::new(DeviceInfo::default(), tablets::PEN_DISPLAY);
    let choice = choose_decoder(device.info(), tablets::PEN_DISPLAY).unwrap().unwrap();
    let (wake, woken) = channel();
    let (outbox, inbox) = queue(move || wake.send(()).unwrap_or_default(), begin);
    let reader = Reader::start(0, Box::new(device.open()), choice, outbox).unwrap();
    let sender = std::thread::spawn(move || {
        let circle = circle();
        let sent = circle.iter().cycle().take(5 * usize::from(REPORTS)).map(|report| {
            std::thread::sleep(PAUSE);
            let now = Instant::now();
            device.send(report);
            now
        });
        let sent: Vec<Instant> = sent.collect();
        device.unplug_at_end();
        sent
    });
    let (mut machine, mut events, mut arrived) =
        (PenMachine::new(window()), Vec::with_capacity(8192), Vec::new());
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
    assert_eq!(sent.len(), arrived.len(), "a report was lost");
    let mut delays: Vec<f64> =
        sent.iter().zip(&arrived).map(|(sent, arrived)| (*arrived - *sent).as_secs_f64() * 1e6).collect();
    delays.sort_by(f64::total_cmp);
    let at = |share: f64| delays[((delays.len() - 1) as f64 * share) as usize];
    let (half, most, all) = (at(0.5), at(0.99), at(1.0));
    println!(
        "report to pen event, {} reports: p50 {half:.1} µs, p99 {most:.1} µs, most {all:.1} µs",
        delays.len()
    );
}

criterion_group!(benches, decoding, events, delay);
criterion_main!(benches);
