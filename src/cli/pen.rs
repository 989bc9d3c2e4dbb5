//! `penstemon pen record FILE` and `penstemon pen replay FILE`: recordings of tablets.

use super::common;
use crate::pen::hid::recording::{RecordedDevice, RecordingWriter, strings_to_keep};
use crate::pen::hid::typed::{KEYBOARDS, TypedReports};
use crate::pen::hid::{DeviceInfo, Enumerate, Recording, System, Transport, choose_model, replay};
use crate::pen::mapping::Rect;
use crate::pen::{PenEvent, PenTool};
use anyhow::{Context, bail};
use glam::DVec2;
use serde_json::json;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{BufWriter, IsTerminal};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::{Duration, Instant};

/// How long a thread waits for a report before it looks whether anybody still listens.
const PATIENCE: Duration = Duration::from_millis(200);
/// Longest report.
const MAX_REPORT_BYTES: usize = 4096;
/// Reports that wait for the file at most, of all devices together; half a minute of a fast tablet.
const MOST_WAITING: usize = 1 << 15;

/// Arguments of `pen`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// What can be done with recordings.
#[derive(Debug, clap::Subcommand)]
pub enum Verb {
    /// Writes down what tablets send, until Ctrl+C.
    Record(Record),
    /// Prints the pen events of a recording, or draws them in the window.
    Replay(Replay),
}

/// Arguments of `pen record`.
#[derive(Clone, Debug, clap::Args)]
pub struct Record {
    /// The recording to write, a file that is not there yet.
    pub file: PathBuf,
    /// End after so many seconds.
    #[arg(long, value_name = "SECONDS")]
    pub seconds: Option<u64>,
    /// Record this device, known or not; its numbers are in `penstemon tablets` or `lsusb`.
    #[arg(long, value_name = "VENDOR:PRODUCT", value_parser = ids)]
    pub device: Option<(u16, u16)>,
    /// Keep USB strings of the tablets as well: they name model and firmware and hold the tablet's size. Without this,
    /// a person at a terminal is asked.
    #[arg(long)]
    pub strings: bool,
}

/// Arguments of `pen replay`.
#[derive(Debug, clap::Args)]
pub struct Replay {
    /// The recording.
    pub file: PathBuf,
    /// Print JSON, one object a line.
    #[arg(long)]
    pub json: bool,
    /// Window that the tablet draws into, in pixels.
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1920x1080", value_parser = size)]
    pub size: DVec2,
    /// Open the window, on this drawing if one is named, and draw there as the recorded tablets did.
    #[arg(long, value_name = "DRAWING", num_args = 0..=1, conflicts_with_all = ["json", "size"])]
    pub window: Option<Option<PathBuf>>,
}

fn ids(text: &str) -> Result<(u16, u16), String> {
    let number = |text| u16::from_str_radix(text, 16).ok();
    let ids = text.split_once(':').and_then(|(vendor, product)| number(vendor).zip(number(product)));
    ids.ok_or_else(|| "write it as two hexadecimal numbers, for instance 056a:0357".to_owned())
}

fn size(text: &str) -> Result<DVec2, String> {
    let side = |text: &str| text.parse::<u16>().ok().filter(|side| *side > 0).map(f64::from);
    let sides = text.split_once('x').and_then(|(width, height)| side(width).zip(side(height)));
    sides.map(DVec2::from).ok_or_else(|| "write it as 1920x1080, each side up to 65535".to_owned())
}

/// Runs `pen`.
///
/// # Errors
/// A recording that cannot be read or written, or no device to record.
pub fn run(args: &Args) -> anyhow::Result<ExitCode> {
    match &args.verb {
        Verb::Record(args) => {
            let of_file = || args.file.display().to_string();
            spare(&args.file).with_context(of_file)?;
            let keeps_strings = args.strings || agrees()?;
            let args = &Record { strings: keeps_strings, ..args.clone() };
            common::print(&record(&mut System::new(), args).with_context(of_file)?)?;
        }
        Verb::Replay(args) => replay(args)?,
    }
    Ok(ExitCode::SUCCESS)
}

/// Whether the person at the terminal lets the recording keep USB strings; nobody there does not.
fn agrees() -> anyhow::Result<bool> {
    if !std::io::stdin().is_terminal() || !std::io::stderr().is_terminal() {
        return Ok(false);
    }
    tracing::warn!(
        "keep the tablet's USB strings in the recording, too? They name its model and firmware and hold its size; \
         serial numbers are left out, but rare models may tell whose tablet it is. Type y and Enter to keep them, \
         Enter alone to leave them out."
    );
    let mut answer = String::new();
    std::io::stdin().read_line(&mut answer)?;
    Ok(matches!(answer.trim(), "y" | "Y" | "yes"))
}

/// A recording cannot be made again, so none is written over.
///
/// # Errors
/// There is something of this name.
fn spare(file: &Path) -> anyhow::Result<()> {
    if fs::symlink_metadata(file).is_ok() {
        bail!("there is already something of this name; name a new file, or remove this one first");
    }
    Ok(())
}

/// What a thread says of its device.
struct Received {
    device: usize,
    when: Instant,
    /// `None` when it was unplugged.
    report: Option<Vec<u8>>,
}

/// Records until everything is unplugged or the time is over, and says what was recorded. The file is made when there is
/// something to record.
fn record(system: &mut dyn Enumerate, args: &Record) -> anyhow::Result<String> {
    let begin = Instant::now();
    let end = args.seconds.map(|seconds| begin + Duration::from_secs(seconds));
    let found = found(system, args)?;
    let devices = found.len();
    if devices == 0 {
        bail!("no tablet to record was found; plug it in, or name it with --device VENDOR:PRODUCT");
    }
    let mut writer = RecordingWriter::new(BufWriter::new(File::create_new(&args.file)?))?;
    let (sender, receiver) = sync_channel(MOST_WAITING);
    // Room for reports goes back to the threads, so that none is taken for each.
    let mut spent = Vec::new();
    for (recorded, transport) in found {
        let device = writer.device(&recorded)?;
        let (sender, (back, room)) = (sender.clone(), sync_channel(MOST_WAITING));
        std::thread::spawn(move || listen(device, transport, &sender, &room));
        spent.push(back);
    }
    drop(sender);
    writer.flush()?;
    tracing::warn!("recording {devices} device(s); draw, then press Ctrl+C");
    let mut reports = 0usize;
    loop {
        let left = end.map_or(PATIENCE, |end| end.saturating_duration_since(Instant::now()));
        let first = match receiver.recv_timeout(left) {
            Ok(received) => received,
            Err(RecvTimeoutError::Timeout) if end.is_none() => continue,
            Err(_) => return Ok(format!("{reports} reports of {devices} device(s)")),
        };
        // Whole lines reach the file whenever the tablets pause, so that Ctrl+C leaves a sound recording.
        for received in std::iter::once(first).chain(receiver.try_iter()) {
            let time_us = u64::try_from((received.when - begin).as_micros()).unwrap_or(u64::MAX);
            match received.report {
                Some(report) => {
                    writer.report(time_us, received.device, &report)?;
                    if let Some(back) = spent.get(received.device) {
                        // The room is not needed where its thread has ended.
                        let _ = back.try_send(report);
                    }
                }
                None => writer.gone(time_us, received.device)?,
            }
            reports += 1;
        }
        writer.flush()?;
    }
}

/// The devices to record, and what the recording says of each.
fn found(
    system: &mut dyn Enumerate,
    args: &Record,
) -> anyhow::Result<Vec<(RecordedDevice, Box<dyn Transport>)>> {
    let mut found = Vec::new();
    for info in system.devices()? {
        let Some(transport) = open(system, &info, args.device)? else { continue };
        let descriptor = transport.descriptor().to_vec();
        let strings = match args.strings {
            true => strings_to_keep(&info, &mut *system.strings(&info)),
            false => BTreeMap::new(),
        };
        found.push((RecordedDevice { info, descriptor, strings }, transport));
    }
    Ok(found)
}

/// A device that is to be recorded, open and awake. What is typed is never recorded: neither a node that is a keyboard,
/// nor one that may mix keys with everything else.
fn open(
    system: &mut dyn Enumerate,
    info: &DeviceInfo,
    wanted: Option<(u16, u16)>,
) -> anyhow::Result<Option<Box<dyn Transport>>> {
    let is_named = wanted == Some((info.vendor_id, info.product_id));
    if KEYBOARDS.contains(&info.usage) || (wanted.is_some() && !is_named) {
        return Ok(None);
    }
    let descriptor = system.descriptor(info).unwrap_or_default();
    if TypedReports::of(&descriptor).is_everything() {
        return Ok(None);
    }
    let choice = choose_model(info, &descriptor, system.strings(info), None).ok().flatten();
    if choice.is_none() && !is_named {
        return Ok(None);
    }
    let mut transport = system.open(info)?;
    if let Some(Err(fault)) = choice.map(|mut choice| choice.wake(&mut *transport)) {
        // That is what the recording is for.
        tracing::warn!("{}: {fault}", info.name());
    }
    Ok(Some(transport))
}

/// Hands on what a device sends but what is typed, in `room` that comes back.
fn listen(
    device: usize,
    mut transport: Box<dyn Transport>,
    sender: &SyncSender<Received>,
    room: &Receiver<Vec<u8>>,
) {
    let typed = TypedReports::of(transport.descriptor());
    let mut buffer = [0; MAX_REPORT_BYTES];
    loop {
        let report = match transport.read(&mut buffer, PATIENCE) {
            Ok(0) => continue,
            Ok(length) => buffer.get(..length).unwrap_or_default(),
            Err(_) => {
                let _ = sender.send(Received { device, when: Instant::now(), report: None });
                return;
            }
        };
        let when = Instant::now();
        if typed.holds(report) {
            continue;
        }
        let mut kept = room.try_recv().unwrap_or_default();
        kept.clear();
        kept.extend_from_slice(report);
        if sender.send(Received { device, when, report: Some(kept) }).is_err() {
            return;
        }
    }
}

fn replay(args: &Replay) -> anyhow::Result<()> {
    let recording = Recording::open(&args.file)?;
    if let Some(drawing) = &args.window {
        return crate::app::replay(drawing.clone(), recording);
    }
    let mut lines = Vec::new();
    let target = Rect { min: DVec2::ZERO, max: args.size };
    let unread = replay::play(&recording, target, &mut |device, event| {
        lines.push(if args.json { json_line(device, event) } else { text_line(device, event) });
    });
    for unread in unread {
        tracing::warn!("{}: device {}: {}", args.file.display(), unread.device, unread.reason);
    }
    if lines.is_empty() {
        let reports = recording.entries.len();
        bail!("{}: no pen event came of this recording's {reports} entries", args.file.display());
    }
    common::print(&lines.join("\n"))
}

fn tool_name(tool: PenTool) -> &'static str {
    match tool {
        PenTool::Pen => "pen",
        PenTool::Eraser => "eraser",
        PenTool::Finger(_) => "finger",
        PenTool::Mouse => "mouse",
    }
}

fn text_line(device: usize, event: &PenEvent) -> String {
    let s = &event.sample;
    let phase = format!("{:?}", event.phase).to_lowercase();
    format!(
        "{:>12.3} ms  #{device}  {:<6}  {phase:<6}  {:8.2} {:8.2}  pressure {:.4}  tilt {:.1}° {:.1}°  twist {:.1}°",
        s.time_ms,
        tool_name(s.tool),
        s.position.x,
        s.position.y,
        s.pressure,
        s.tilt_deg.x,
        s.tilt_deg.y,
        s.twist_deg
    )
}

fn json_line(device: usize, event: &PenEvent) -> String {
    let s = &event.sample;
    json!({
        "device": device, "phase": format!("{:?}", event.phase).to_lowercase(), "tool": tool_name(s.tool),
        "time_ms": s.time_ms, "position": s.position.to_array(), "pressure": s.pressure,
        "tilt_deg": s.tilt_deg.to_array(), "twist_deg": s.twist_deg, "distance": s.distance,
        "buttons": [s.buttons.primary, s.buttons.secondary, s.buttons.middle, s.buttons.third],
    })
    .to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pen::hid::made_up as tablets;
    use crate::pen::hid::recording::Recorded;
    use crate::pen::hid::simulated::{SimulatedBus, SimulatedDevice};

    fn plug(bus: &SimulatedBus, path: &str, usage: (u16, u16), descriptor: &[u8]) -> SimulatedDevice {
        let info =
            DeviceInfo { path: path.into(), vendor_id: 0x56A, product_id: 1, usage, ..Default::default() };
        let device = SimulatedDevice::new(info, descriptor);
        device.send(&[0, 1, 2]);
        device.unplug_at_end();
        bus.plug(&device);
        device
    }

    fn recorded(bus: &mut SimulatedBus, device: Option<(u16, u16)>) -> anyhow::Result<Recording> {
        let folder = tempfile::tempdir()?;
        let file = folder.path().join("recorded");
        let done = record(bus, &Record { file: file.clone(), seconds: Some(60), device, strings: false });
        assert_eq!(file.exists(), done.is_ok(), "a file is made when there is something to record");
        done.and_then(|_| Ok(Recording::open(&file)?))
    }

    #[test]
    fn nothing_is_written_over() {
        let mut bus = SimulatedBus::new();
        plug(&bus, "pen", (0xD, 2), tablets::DESK_TABLET);
        let file = tempfile::NamedTempFile::new().unwrap();
        fs::write(&file, b"an evening's drawing").unwrap();
        let args = Record { file: file.path().to_owned(), seconds: Some(60), device: None, strings: false };
        assert!(record(&mut bus, &args).is_err());
        assert_eq!(fs::read(&file).unwrap(), b"an evening's drawing");
    }

    #[test]
    fn only_pens_are_recorded_unless_named_and_keyboards_never() {
        let mut bus = SimulatedBus::new();
        plug(&bus, "keyboard", (1, 6), tablets::KEYBOARD);
        let none = recorded(&mut bus, None).unwrap_err().to_string();
        assert!(none.contains("--device"), "{none}");
        let none = recorded(&mut bus, Some((0x56A, 1))).unwrap_err().to_string();
        assert!(none.contains("plug it in"), "{none}");
        plug(&bus, "mouse", (1, 2), tablets::MOUSE);
        plug(&bus, "pen", (0xD, 2), tablets::DESK_TABLET);
        let recording = recorded(&mut bus, None).unwrap();
        assert_eq!(recording.devices.iter().map(|d| d.info.path.as_str()).collect::<Vec<_>>(), ["pen"]);
        assert_eq!(recording.entries.len(), 2, "a report and the end");
    }

    #[test]
    fn a_named_device_is_recorded_whatever_it_is() {
        let mut bus = SimulatedBus::new();
        plug(&bus, "mouse", (1, 2), tablets::MOUSE);
        plug(&bus, "vendor", (0xFF00, 1), &[]);
        let recording = recorded(&mut bus, Some((0x56A, 1))).unwrap();
        assert_eq!((recording.devices.len(), recording.entries.len()), (2, 4));
    }

    #[test]
    fn what_is_typed_on_the_node_of_a_pen_is_not_recorded() {
        let mut bus = SimulatedBus::new();
        let info = DeviceInfo { path: "both".into(), usage: (0x0D, 2), ..Default::default() };
        let device = SimulatedDevice::new(info, &tablets::pen_with_keyboard());
        let pen =
            tablets::DisplayReport { switches: tablets::switch::IN_RANGE, ..Default::default() }.bytes();
        let key = [9, 0, 0, 4, 0, 0, 0, 0, 0];
        [&key[..], &pen, &key, &pen].iter().for_each(|report| device.send(report));
        device.unplug_at_end();
        bus.plug(&device);
        // A node without report ids whose keyboard stands behind its mouse.
        plug(&bus, "receiver", (1, 2), &[tablets::MOUSE, tablets::KEYBOARD].concat());
        for named in [None, Some((0, 0)), Some((0x56A, 1))] {
            let recording = match recorded(&mut bus, named) {
                Ok(recording) => recording,
                Err(_) if named == Some((0x56A, 1)) => continue,
                Err(error) => panic!("{error}"),
            };
            assert_eq!(recording.devices.iter().map(|d| d.info.path.as_str()).collect::<Vec<_>>(), ["both"]);
            let reports = recording.entries.iter().filter_map(|entry| match &entry.what {
                Recorded::Report(report) => Some(report),
                Recorded::Gone => None,
            });
            // Played once; the next time it is gone at once.
            assert!(reports.clone().all(|report| *report == pen), "{:?}", reports.collect::<Vec<_>>());
        }
        assert_eq!(device.reports_read(), 4);
    }

    #[test]
    fn sizes_and_numbers_are_read_or_refused() {
        assert_eq!(size("640x480"), Ok(DVec2::new(640.0, 480.0)));
        assert_eq!(ids("056a:0357"), Ok((0x56A, 0x357)));
        assert!(["", "640", "0x480", "-1x1", "1x1x1"].iter().all(|text| size(text).is_err()));
        assert!(["", "056a", "zz:1", "056a:10000"].iter().all(|text| ids(text).is_err()));
    }
}
