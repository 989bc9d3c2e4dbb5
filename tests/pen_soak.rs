//! A minute of a tablet that sends 1,000 reports a second while the window stalls for up to half a second at a time:
//! nothing is lost, the order is kept, and memory stays flat. Through the real reader and its queue; time is simulated,
//! counted in reports: a stall of so many milliseconds is as many reports that are read while nobody looks.

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
const LONGEST_STALL_MS: u32 = 500;
/// Longest wait for the reader to read what was sent.
const PATIENCE: Duration = Duration::from_secs(60);
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
    let (outbox, inbox) = queue(|| {}, Instant::now());
    let reader = Reader::start(0, Box::new(device.open()), choice, outbox).unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(2026);
    let (mut sent, mut next, mut time_ms, mut warm) = (0, 0, 0.0, None);
    loop {
        // What it said before its end is looked at after it.
        let is_last = reader.is_finished();
        let stall_ms = random.random_range(0..=LONGEST_STALL_MS).min(REPORTS - sent);
        for serial in sent..sent + stall_ms {
            // The reader drains the device meanwhile.
            let switches = tablets::switch::IN_RANGE | tablets::switch::TIP;
            device.send(&tablets::DisplayReport { switches, serial, ..Default::default() }.bytes());
        }
        sent += stall_ms;
        if sent == REPORTS {
            device.unplug_at_end();
        }
        assert!(device.wait_read(sent as usize, PATIENCE), "the reader stands still at report {next}");
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
        if is_last {
            break;
        }
    }
    assert_eq!((next, inbox.left_out()), (REPORTS, 0));
    let (before, after) = (warm.unwrap(), resident());
    assert!(after <= before + FLAT_BYTES, "memory grew from {before} to {after} bytes");
}
