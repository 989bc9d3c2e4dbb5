//! What must hold on a real kernel.

use crate::listener::{Listener, PATIENCE};
use crate::reports::{VENDOR_PAGE, desk_report, desk_said, display_report, display_said, k8_report, k8_said};
use crate::tablets::{DESK_TABLET, DisplayReport, MOUSE, PEN_DISPLAY, SILENT_TABLET, switch};
use crate::uhid::{Asked, BLUETOOTH, Identity, USB, VirtualDevice};
use penstemon::pen::hid::reader::queue;
use penstemon::pen::hid::watcher::Roster;
use penstemon::pen::hid::{
    Bus, DeviceId, DeviceInfo, Enumerate, HidEvent, Notice, System, TransportError, choose_model,
};
use std::error::Error;
use std::io::{BufRead, BufReader};
use std::os::unix::fs::PermissionsExt as _;
use std::os::unix::process::CommandExt as _;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

type Outcome<T> = Result<T, Box<dyn Error>>;
/// A check says what it saw.
type Check = fn() -> Outcome<String>;

/// All checks with their names, in the order in which they run.
pub(crate) const ALL: [(&str, Check); 7] = [
    ("a pen display is found by its descriptor, read and unplugged", pen_display),
    ("two tablets are read at once", two_tablets),
    ("a mouse is left alone", mouse),
    ("a tablet of the table is known, woken and read", tablet_of_the_table),
    ("a tablet that sends a mouse until it is woken is woken, and draws before and after", silent_tablet),
    ("a tablet without permission says what to do and is read once it is allowed", permission),
    ("plugging in and out leaves nothing open", many_plugs),
];

/// Reports of a device in one check.
const REPORTS: u32 = 1000;
/// Reports that are sent before they are waited for: fewer than the 64 that the kernel keeps.
const AT_ONCE: u32 = 48;
/// A device must be found as fast.
const FOUND_WITHIN: Duration = Duration::from_secs(1);
/// Times that a device is plugged in and out.
const CYCLES: u32 = 25;
/// Word that starts this program as a user who may not open tablets, and that user's number.
pub(crate) const VISITOR: &str = "visitor";
const NOBODY: u32 = 65534;

const DISPLAY: Identity =
    Identity { name: "Virtual Pen Display", bus: USB, vendor: 0x1209, product: 1, descriptor: PEN_DISPLAY };
const DESK: Identity = Identity {
    name: "Virtual Desk Tablet",
    bus: BLUETOOTH,
    vendor: 0x1209,
    product: 2,
    descriptor: DESK_TABLET,
};

fn ensure(holds: bool, otherwise: impl FnOnce() -> String) -> Outcome<()> {
    if holds { Ok(()) } else { Err(otherwise().into()) }
}

/// Report `number` must be read as what was sent.
fn same<T: PartialEq + std::fmt::Debug>(number: u32, said: &T, sent: &T) -> Outcome<()> {
    ensure(said == sent, || format!("report {number} is {said:?}, not {sent:?}"))
}

/// Sends reports to be read by value and in order; times never go back.
fn read_display(
    device: &mut VirtualDevice,
    listener: &mut Listener,
    id: DeviceId,
    count: u32,
) -> Outcome<()> {
    let mut before_ms = 0.0;
    for first in (0..count).step_by(AT_ONCE as usize) {
        let numbers = first..count.min(first + AT_ONCE);
        for number in numbers.clone() {
            device.send(&display_report(number).bytes())?;
        }
        for number in numbers {
            let (pen, time_ms) = listener.pen(id)?;
            same(number, &display_said(&pen).bytes(), &display_report(number).bytes())?;
            ensure(time_ms >= before_ms, || {
                format!("report {number} came at {time_ms} ms, after {before_ms} ms")
            })?;
            before_ms = time_ms;
        }
    }
    ensure(listener.left_out() == 0, || format!("{} events were left out", listener.left_out()))
}

/// The device with these numbers as the system lists it: once, whatever it has.
fn listed(who: &Identity) -> Outcome<DeviceInfo> {
    let mut devices = System::new().devices()?;
    devices.retain(|device| (device.vendor_id, device.product_id) == (who.vendor, who.product));
    ensure(devices.len() == 1, || format!("{} is listed {} times", who.name, devices.len()))?;
    Ok(devices.remove(0))
}

fn pen_display() -> Outcome<String> {
    let mut listener = Listener::start()?;
    let mut slowest = Duration::ZERO;
    for plug in 0..3 {
        let begin = Instant::now();
        let mut device = VirtualDevice::plug(&DISPLAY)?;
        let (id, arrival) = listener.arrival()?;
        slowest = slowest.max(begin.elapsed());
        ensure(id == plug, || format!("the device has number {id}, not {plug}"))?;
        let info = listed(&DISPLAY)?;
        ensure(arrival.info == info && info.bus == Bus::Usb && info.product == DISPLAY.name, || {
            format!("{info:?}")
        })?;
        ensure(info.usage == (0x0D, 0x02), || format!("its first collection is {:04x?}", info.usage))?;
        ensure(arrival.way == "its report descriptor", || arrival.way.clone())?;
        let mut system = System::new();
        ensure(system.descriptor(&info)? == PEN_DISPLAY, || "sysfs tells another descriptor".into())?;
        ensure(system.open(&info)?.descriptor() == PEN_DISPLAY, || {
            "its node tells another descriptor".into()
        })?;
        read_display(&mut device, &mut listener, id, REPORTS)?;
        // Unplugged while it touches.
        device
            .send(&DisplayReport { switches: switch::IN_RANGE | switch::TIP, ..display_report(1) }.bytes())?;
        ensure(listener.pen(id)?.0.touches, || "the pen does not touch".into())?;
        drop(device);
        let (pen, _) = listener.pen(id)?;
        ensure(!pen.in_range && !pen.touches, || format!("the pen should leave, not {pen:?}"))?;
        listener.end(id)?;
    }
    ensure(slowest <= FOUND_WITHIN, || format!("it was found after {slowest:?}"))?;
    Ok(format!("3 × {REPORTS} reports by value and in order; plugged in again, found within {slowest:.0?}"))
}

fn two_tablets() -> Outcome<String> {
    let mut listener = Listener::start()?;
    let mut display = VirtualDevice::plug(&DISPLAY)?;
    let (display_id, _) = listener.arrival()?;
    let mut desk = VirtualDevice::plug(&DESK)?;
    let (desk_id, arrival) = listener.arrival()?;
    ensure(arrival.info.bus == Bus::Bluetooth, || format!("{:?}", arrival.info))?;
    let (mut of_display, mut of_desk) = (0, 0);
    for first in (0..REPORTS).step_by(AT_ONCE as usize) {
        let numbers = first..REPORTS.min(first + AT_ONCE);
        for number in numbers.clone() {
            display.send(&display_report(number).bytes())?;
            desk.send(&desk_report(number))?;
        }
        while of_display < numbers.end || of_desk < numbers.end {
            let message = listener.next(PATIENCE).ok_or("reports are missing")?;
            match message.notice {
                Notice::Said(HidEvent::Pen(pen)) if message.device == display_id => {
                    same(of_display, &display_said(&pen).bytes(), &display_report(of_display).bytes())?;
                    of_display += 1;
                }
                Notice::Said(HidEvent::Pen(pen)) if message.device == desk_id => {
                    same(of_desk, &desk_said(&pen), &desk_report(of_desk))?;
                    of_desk += 1;
                }
                Notice::Said(_) => {}
                other => return Err(format!("pens should speak, not {other:?}").into()),
            }
        }
    }
    Ok(format!("{of_display} reports with ids by cable and {of_desk} without by radio"))
}

fn mouse() -> Outcome<String> {
    const LOOKS: Duration = Duration::from_secs(2);
    let mut listener = Listener::start()?;
    let who = Identity { name: "Virtual Mouse", bus: USB, vendor: 0x1209, product: 3, descriptor: MOUSE };
    let mouse = VirtualDevice::plug(&who)?;
    if let Some(message) = listener.next(LOOKS) {
        return Err(format!("nothing should be said, not {message:?}").into());
    }
    let info = listed(&who)?;
    let asked = mouse.asked(Duration::ZERO);
    ensure(asked.is_none(), || format!("nothing should be asked of {}, not {asked:?}", info.path))?;
    Ok("listed, and never opened".to_owned())
}

fn tablet_of_the_table() -> Outcome<String> {
    let who =
        Identity { name: "Virtual K8", bus: USB, vendor: 0x28BD, product: 0x0910, descriptor: VENDOR_PAGE };
    let mut listener = Listener::start()?;
    let mut device = VirtualDevice::plug(&who)?;
    let (id, arrival) = listener.arrival()?;
    ensure(arrival.way.contains("K8"), || format!("it is read by {}", arrival.way))?;
    let asked = [device.asked(PATIENCE), device.asked(PATIENCE)];
    let wake = Asked::Output(vec![0x02, 0xB0, 0x04, 0, 0, 0, 0, 0]);
    ensure(asked == [Some(Asked::Open), Some(wake)], || {
        format!("it should be opened and woken, not {asked:02x?}")
    })?;
    for number in 0..REPORTS {
        device.send(&k8_report(number))?;
        same(number, &k8_said(&listener.pen(id)?.0), &k8_report(number))?;
    }
    // Other tablets are woken by feature reports.
    System::new().open(&arrival.info)?.send_feature(&[0x02, 0x01, 0x5A])?;
    let asked = device.asked(PATIENCE);
    let feature = Asked::Feature(vec![0x02, 0x01, 0x5A]);
    ensure(asked.as_ref() == Some(&feature), || format!("a feature report should come, not {asked:02x?}"))?;
    Ok(format!("read by {}; the wake-up report reached it; {REPORTS} reports by value", arrival.way))
}

/// Genius i405x by its numbers: it describes a pen, sends report 9 of a mouse, and report 16 of the pen once it is woken.
fn silent_tablet() -> Outcome<String> {
    // The kernel hands on only reports that the descriptor declares: here the pen's is 16.
    let mut descriptor = SILENT_TABLET.to_vec();
    descriptor[7] = 0x10;
    let descriptor = descriptor.leak();
    let who = Identity { name: "Virtual i405x", bus: USB, vendor: 0x0458, product: 0x5010, descriptor };
    let mut listener = Listener::start()?;
    let mut device = VirtualDevice::plug(&who)?;
    let (id, arrival) = listener.arrival()?;
    ensure(arrival.way.contains("i405x"), || format!("it is read by {}", arrival.way))?;
    let asked = [device.asked(PATIENCE), device.asked(PATIENCE)];
    let wake = Asked::Feature(vec![0x05, 0x12, 0x10, 0x11, 0x12, 0, 0, 0]);
    ensure(asked == [Some(Asked::Open), Some(wake)], || {
        format!("it should be opened and woken, not {asked:02x?}")
    })?;
    let mut sent = |report: &[u8]| -> Outcome<(bool, Option<f32>)> {
        device.send(report)?;
        let pen = listener.pen(id)?.0;
        Ok((pen.touches, pen.pressure))
    };
    same(0, &sent(&[9, 1, 0, 4, 0, 4, 0xFF, 7])?, &(true, Some(1.0)))?;
    same(1, &sent(&[0x10, 0x81, 0, 4, 0, 4, 0xFF, 3])?, &(true, Some(1.0)))?;
    Ok(format!("read by {}; the wake-up report reached it; mouse and pen draw with pressure", arrival.way))
}

fn permission() -> Outcome<String> {
    let _device = VirtualDevice::plug(&DESK)?;
    let begin = Instant::now();
    let info = loop {
        match listed(&DESK) {
            Err(error) if begin.elapsed() > PATIENCE => return Err(error),
            Err(_) => std::thread::sleep(Duration::from_millis(10)),
            Ok(info) => break info,
        }
    };
    let mut visitor = Command::new(std::env::current_exe()?);
    let mut visitor = visitor.arg(VISITOR).uid(NOBODY).gid(NOBODY).stdout(Stdio::piped()).spawn()?;
    let mut lines = BufReader::new(visitor.stdout.take().ok_or("no pipe")?).lines();
    let mut line = || lines.next().unwrap_or_else(|| Ok("nothing".into()));
    let refused = line()?;
    // It is not listed, so a rule of one's own helps.
    let rule = "KERNELS==\"0005:1209:0002.*\"";
    let says = ["Virtual Desk Tablet", info.path.as_str(), "/etc/udev/rules.d", rule];
    let missing = says.iter().find(|part| !refused.contains(**part));
    ensure(missing.is_none(), || format!("{missing:?} is missing in: {refused}"))?;
    std::fs::set_permissions(&info.path, std::fs::Permissions::from_mode(0o666))?;
    let arrived = line()?;
    visitor.wait()?;
    ensure(arrived == "arrived", || format!("it should arrive, not: {arrived}"))?;
    Ok(refused)
}

/// What a user sees who may not open the tablet that is there, and then may.
pub(crate) fn visit() -> Outcome<()> {
    let mut listener = Listener::start()?;
    match listener.next(PATIENCE).ok_or("nothing was said")?.notice {
        Notice::Refused(why) => println!("{why}"),
        other => println!("{other:?}"),
    }
    listener.arrival()?;
    println!("arrived");
    Ok(())
}

/// Files that this process has open, and its threads.
fn holds() -> Outcome<(usize, usize)> {
    let count = |folder: &str| std::fs::read_dir(folder).map(Iterator::count);
    Ok((count("/proc/self/fd")?, count("/proc/self/task")?))
}

fn many_plugs() -> Outcome<String> {
    let (outbox, inbox) = queue(|| {}, Instant::now());
    let mut roster = Roster::new(Box::new(System::new()), Box::new(choose_model), outbox);
    let mut first = None;
    for cycle in 0..CYCLES {
        let mut device = VirtualDevice::plug(&DESK)?;
        let begin = Instant::now();
        let wait_for = |roster: &mut Roster, what: &str, is_it: &dyn Fn(&Notice) -> bool| -> Outcome<()> {
            let mut is_there = false;
            while !is_there {
                ensure(begin.elapsed() < PATIENCE, || format!("cycle {cycle}: {what} did not come"))?;
                roster.poll()?;
                inbox.drain(|message| is_there |= is_it(&message.notice));
            }
            Ok(())
        };
        wait_for(&mut roster, "the device", &|notice| matches!(notice, Notice::Arrived(_)))?;
        device.send(&desk_report(cycle))?;
        wait_for(
            &mut roster,
            "a report",
            &|notice| matches!(notice, Notice::Said(HidEvent::Pen(pen)) if desk_said(pen) == desk_report(cycle)),
        )?;
        drop(device);
        wait_for(&mut roster, "the end", &|notice| {
            matches!(notice, Notice::Gone(TransportError::Gone { .. }))
        })?;
        while roster.readers() > 0 {
            roster.poll()?;
        }
        let before = *first.get_or_insert(holds()?);
        // A thread that was joined is listed for a moment more.
        while holds()? != before {
            let now = holds()?;
            ensure(begin.elapsed() < PATIENCE, || {
                format!("cycle {cycle}: {now:?} files and threads, not {before:?}")
            })?;
        }
    }
    Ok(format!("{CYCLES} times"))
}
