//! A minute of a tablet that sends 1,000 reports a second while the window stalls for up to half a second at a time:
//! nothing is lost, the order is kept, and memory stays flat. In true time, through the real reader and its queue.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use penstemon::pen::hid::reader::{Reader, queue};
use penstemon::pen::hid::simulated::SimulatedDevice;
use penstemon::pen::hid::{DeviceInfo, HidEvent, Notice, choose_decoder};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::fs;
use std::time::{Duration, Instant};

#[path = "common/tablets.rs"]
#[allow(dead_code, reason = "shared with other tests")]
mod tablets;

const REPORTS: u32 = 60_000;
const LONGEST_STALL_MS: u64 = 500;
/// Reports after which everything that is ever needed has been allocated.
const WARM: u32 = 10_000;
/// Growth of memory that is an allocator's own affair.
const FLAT_BYTES: u64 = 2 << 20;

/// Memory of this process, in bytes.
fn resident() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
    line.trim().trim_end_matches(" kB").parse::<u64>().unwrap() * 1024
}

#[test]
fn a_minute_of_stalls_loses_nothing_and_keeps_memory_flat() {
    let info = DeviceInfo { path: "sim0".into(), ..DeviceInfo::default() };
    let device = SimulatedDevice::new(info.clone(), tablets::PEN_DISPLAY);
    let choice = choose_decoder(&info, tablets::PEN_DISPLAY).unwrap().unwrap();
    let begin = Instant::now();
    let (outbox, inbox) = queue(|| {}, begin);
    let reader = Reader::start(0, Box::new(device.open()), choice, outbox).unwrap();
    let tablet = std::thread::spawn(move || {
        for serial in 0..REPORTS {
            let due = begin + Duration::from_millis(serial.into());
            std::thread::sleep(due.saturating_duration_since(Instant::now()));
            let switches = tablets::switch::IN_RANGE | tablets::switch::TIP;
            device.send(&tablets::DisplayReport { switches, serial, ..Default::default() }.bytes());
        }
        device.unplug_at_end();
    });
    let mut random = Pcg64Mcg::seed_from_u64(2026);
    let (mut next, mut time_ms, mut warm) = (0, 0.0, None);
    while !reader.is_finished() {
        std::thread::sleep(Duration::from_millis(random.random_range(0..=LONGEST_STALL_MS)));
        inbox.drain(|message| {
            assert!(message.time_ms >= time_ms, "time goes back at report {next}");
            time_ms = message.time_ms;
            if let Notice::Said(HidEvent::Pen(pen)) = message.notice
                && pen.in_range
            {
                assert_eq!(pen.serial, u64::from(next), "a report is lost or out of order");
                next += 1;
            }
        });
        if next >= WARM && warm.is_none() {
            warm = Some(resident());
        }
    }
    tablet.join().unwrap();
    assert_eq!((next, inbox.left_out()), (REPORTS, 0));
    let (before, after) = (warm.unwrap(), resident());
    assert!(after <= before + FLAT_BYTES, "memory grew from {before} to {after} bytes");
}
