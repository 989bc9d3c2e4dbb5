//! `penstemon tablets`: which pen devices there are, how each is read, and why one is not.

use super::common;
use crate::pen::hid::{
    Abilities, ChooseError, DeviceInfo, Doubt, Enumerate, HidEvent, Inbox, Notice, RawPen, Refusal, System,
    Watcher, choose_model,
};
use serde_json::{Value, json};
use std::process::ExitCode;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// Pages of first collections that tablets have: digitizers, and those of makers.
const DIGITIZER_PAGE: u16 = 0x0D;
const FIRST_VENDOR_PAGE: u16 = 0xFF00;
/// What is said of a device that has the page of a tablet and is none.
const NO_PEN: &str =
    "it does not describe a pen; `penstemon pen record FILE --device …` makes a recording to send in";

/// Arguments of `tablets`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Then show what pens say, until Ctrl+C.
    #[arg(long)]
    pub watch: bool,
    /// Print JSON, one object a line.
    #[arg(long)]
    pub json: bool,
    /// End watching after so many seconds.
    #[arg(long, value_name = "SECONDS", requires = "watch")]
    pub seconds: Option<u64>,
}

/// A device and how it is read.
struct Found {
    info: DeviceInfo,
    /// How it is read; otherwise why not.
    state: Result<Reading, Unread>,
}

/// How a device is read.
struct Reading {
    way: String,
    abilities: Abilities,
    area_mm: Option<[f64; 2]>,
    doubt: Option<Doubt>,
}

/// Why a device is not read, and which models it may be.
struct Unread {
    reason: String,
    models: Vec<String>,
}

impl From<Refusal> for Unread {
    fn from(why: Refusal) -> Self {
        Self { reason: why.to_string(), models: why.models().to_vec() }
    }
}

/// Runs `tablets`.
///
/// # Errors
/// A system that does not list its devices.
pub fn run(args: &Args) -> anyhow::Result<ExitCode> {
    let found = look(&mut System::new())?;
    if found.is_empty() && !args.json {
        common::print("no pen device was found; plug a tablet in, or see what `--watch` finds when you do")?;
    }
    for found in &found {
        common::print(&if args.json { found.json().to_string() } else { found.text() })?;
    }
    if args.watch {
        watch(Box::new(System::new()), args)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Devices that are pens, or may be.
fn look(system: &mut dyn Enumerate) -> anyhow::Result<Vec<Found>> {
    let found = system.devices()?.into_iter().filter_map(|info| {
        let may_be = info.usage.0 == DIGITIZER_PAGE || info.usage.0 >= FIRST_VENDOR_PAGE;
        let state = match read(system, &info) {
            Ok(Some(reading)) => Ok(reading),
            Ok(None) if may_be => Err(Unread { reason: NO_PEN.to_owned(), models: Vec::new() }),
            Ok(None) => return None,
            Err(Refusal::Choose(ChooseError::Descriptor(_))) if !may_be => return None,
            Err(why) => Err(why.into()),
        };
        Some(Found { info, state })
    });
    Ok(found.collect())
}

/// How the program reads a device; `None` for one that is no pen.
fn read(system: &mut dyn Enumerate, info: &DeviceInfo) -> Result<Option<Reading>, Refusal> {
    let descriptor = system.descriptor(info)?;
    let Some(choice) = choose_model(info, &descriptor, system.strings(info), None)? else { return Ok(None) };
    system.open(info)?;
    Ok(Some(Reading {
        way: choice.way,
        abilities: choice.abilities,
        area_mm: choice.area_mm.map(|area| area.to_array()),
        doubt: choice.doubt,
    }))
}

impl Found {
    fn text(&self) -> String {
        let info = &self.info;
        let mut text = format!(
            "{}  {:04x}:{:04x}  {}  {}",
            info.path,
            info.vendor_id,
            info.product_id,
            info.bus.name(),
            info.name()
        );
        match &self.state {
            Ok(Reading { way, abilities, area_mm, doubt }) => {
                text += &format!("\n    read by {way}: {}", abilities_text(abilities));
                if let Some([width, height]) = area_mm {
                    text += &format!(", {width:.0} × {height:.0} mm");
                }
                if let Some(doubt) = doubt {
                    text += &format!("\n    {}", doubt_text(doubt));
                }
            }
            Err(Unread { reason, models }) => {
                text += &format!("\n    not read: {reason}");
                if models.len() > 1 {
                    text += &format!("\n    it may be {}", models.join(", "));
                }
            }
        }
        text
    }

    fn json(&self) -> Value {
        let info = &self.info;
        let mut object = json!({
            "path": info.path,
            "vendor": format!("{:04x}", info.vendor_id),
            "product": format!("{:04x}", info.product_id),
            "bus": info.bus.name(),
            "name": info.name(),
            "read": self.state.is_ok(),
        });
        let more = match &self.state {
            Ok(Reading { way, abilities: a, area_mm, doubt }) => json!({
                "guess": doubt.is_some(), "models": doubt.as_ref().map_or(&[][..], |doubt| &doubt.models),
                "way": way, "area_mm": area_mm, "pressure_levels": a.pressure_levels, "tilt": a.tilt, "twist": a.twist,
                "distance": a.distance, "eraser": a.eraser, "barrel_buttons": a.barrel_buttons,
                "serial": a.serial, "battery": a.battery, "touch": a.touch,
            }),
            Err(Unread { reason, models }) => json!({ "reason": reason, "models": models }),
        };
        if let (Value::Object(object), Value::Object(more)) = (&mut object, more) {
            object.extend(more);
        }
        object
    }
}

/// That a model is a guess, and which others it may be.
fn doubt_text(doubt: &Doubt) -> String {
    let others: Vec<&str> = doubt.models.iter().map(String::as_str).filter(|m| *m != doubt.taken).collect();
    match &others[..] {
        [] => "this is a guess: its firmware is another than the one that is known".to_owned(),
        others => format!(
            "this is a guess: it may also be {}; “Pen and tablet” in the window lets you choose",
            others.join(", ")
        ),
    }
}

fn abilities_text(abilities: &Abilities) -> String {
    if abilities.is_pad {
        return "keys, rings or strips, and no pen".to_owned();
    }
    let mut parts = vec![match abilities.pressure_levels {
        0 => "no pressure".to_owned(),
        levels => format!("{levels} levels of pressure"),
    }];
    let flags = [
        (abilities.tilt, "tilt"),
        (abilities.twist, "twist"),
        (abilities.distance, "distance"),
        (abilities.eraser, "eraser"),
        (abilities.battery, "battery"),
        (abilities.touch, "touch"),
    ];
    parts.extend(flags.into_iter().filter(|(has, _)| *has).map(|(_, name)| name.to_owned()));
    parts.push(match abilities.barrel_buttons {
        1 => "1 barrel button".to_owned(),
        count => format!("{count} barrel buttons"),
    });
    parts.join(", ")
}

fn watch(system: Box<dyn Enumerate>, args: &Args) -> anyhow::Result<()> {
    let (wake, woken) = channel();
    let begin = Instant::now();
    let watcher = Watcher::start(
        system,
        move || {
            // Nobody listens any more when the watch has ended.
            let _ = wake.send(());
        },
        begin,
    )?;
    let end = args.seconds.map(|seconds| begin + Duration::from_secs(seconds));
    loop {
        let left = end.map_or(Duration::from_secs(3600), |end| end.saturating_duration_since(Instant::now()));
        if left.is_zero() {
            return Ok(());
        }
        match woken.recv_timeout(left) {
            Ok(()) => show(watcher.inbox(), args.json)?,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        }
    }
}

fn show(inbox: &Inbox, as_json: bool) -> anyhow::Result<()> {
    let mut lines = Vec::new();
    inbox.drain(|message| {
        let (device, time_ms) = (message.device, message.time_ms);
        let line =
            if as_json { notice_json(&message.notice) } else { Value::from(notice_text(&message.notice)) };
        lines.push(match line {
            Value::Object(mut object) => {
                object.insert("device".into(), device.into());
                object.insert("time_ms".into(), time_ms.into());
                Value::Object(object).to_string()
            }
            Value::String(text) => format!("{time_ms:>10.1} ms  #{device}  {text}"),
            _ => String::new(),
        });
    });
    if lines.is_empty() { Ok(()) } else { common::print(&lines.join("\n")) }
}

fn notice_text(notice: &Notice) -> String {
    match notice {
        Notice::Arrived(arrival) => {
            let doubt = arrival.doubt.as_ref().map(|doubt| format!("; {}", doubt_text(doubt)));
            format!("{} is read by {}{}", arrival.info.name(), arrival.way, doubt.unwrap_or_default())
        }
        Notice::Refused(refused) => refused.to_string(),
        Notice::Settled(path) => format!("nothing is wrong with {path} any more"),
        Notice::Gone(reason) => reason.to_string(),
        Notice::Said(HidEvent::Pen(pen)) if !pen.in_range => "the pen left".to_owned(),
        Notice::Said(HidEvent::Pen(pen)) => pen_text(pen),
        Notice::Said(HidEvent::Keys(keys)) => format!("keys {keys:b}"),
        Notice::Said(HidEvent::Dial { number, notches }) => format!("dial {number} turned by {notches}"),
        Notice::Said(HidEvent::Ring { number, place: Some(place), places }) => {
            format!("ring {number} touched at {place} of {places}")
        }
        Notice::Said(HidEvent::Ring { number, place: None, .. }) => format!("ring {number} not touched"),
        Notice::Said(HidEvent::Strip { number, place: Some(place), places }) => {
            format!("strip {number} touched at {place} of {places}")
        }
        Notice::Said(HidEvent::Strip { number, place: None, .. }) => format!("strip {number} not touched"),
        Notice::Said(HidEvent::Battery(percent)) => format!("battery {percent} %"),
        Notice::Said(HidEvent::Touch { finger, touches, position }) => {
            let state = if *touches { "touches" } else { "lifted" };
            format!("finger {finger} {state} {:.4} {:.4}", position.x, position.y)
        }
    }
}

fn pen_text(pen: &RawPen) -> String {
    let tool = if pen.eraser { "eraser" } else { "pen" };
    let state = if pen.touches { "touches" } else { "hovers" };
    let held = pen.barrel.iter().zip(1..).filter(|(held, _)| **held);
    let held: String = held.map(|(_, number)| format!(" button {number}")).collect();
    format!(
        "{tool} {state} {:.4} {:.4}  pressure {:.4}  tilt {:.1}° {:.1}°  twist {:.1}°{held}",
        pen.position.x,
        pen.position.y,
        pen.pressure.unwrap_or(0.0),
        pen.tilt_deg.x,
        pen.tilt_deg.y,
        pen.twist_deg
    )
}

fn notice_json(notice: &Notice) -> Value {
    match notice {
        Notice::Arrived(arrival) => {
            json!({ "event": "arrived", "name": arrival.info.name(), "way": arrival.way })
        }
        Notice::Refused(refused) => json!({ "event": "refused", "reason": refused.to_string() }),
        Notice::Settled(path) => json!({ "event": "settled", "path": &**path }),
        Notice::Gone(reason) => json!({ "event": "gone", "reason": reason.to_string() }),
        Notice::Said(HidEvent::Pen(pen)) => json!({
            "event": "pen", "in_range": pen.in_range, "touches": pen.touches, "eraser": pen.eraser,
            "barrel": pen.barrel, "position": pen.position.to_array(), "pressure": pen.pressure,
            "tilt_deg": pen.tilt_deg.to_array(), "twist_deg": pen.twist_deg, "distance": pen.distance,
            "serial": pen.serial,
        }),
        Notice::Said(HidEvent::Keys(keys)) => json!({ "event": "keys", "held": keys }),
        Notice::Said(HidEvent::Dial { number, notches }) => {
            json!({ "event": "dial", "number": number, "notches": notches })
        }
        Notice::Said(HidEvent::Ring { number, place, places }) => {
            json!({ "event": "ring", "number": number, "place": place, "places": places })
        }
        Notice::Said(HidEvent::Strip { number, place, places }) => {
            json!({ "event": "strip", "number": number, "place": place, "places": places })
        }
        Notice::Said(HidEvent::Battery(percent)) => json!({ "event": "battery", "percent": percent }),
        Notice::Said(HidEvent::Touch { finger, touches, position }) => {
            json!({ "event": "touch", "finger": finger, "touches": touches, "position": position.to_array() })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pen::hid::made_up as tablets;
    use crate::pen::hid::simulated::{SimulatedBus, SimulatedDevice};

    #[test]
    fn devices_say_how_they_are_read_or_why_not() {
        let mut bus = SimulatedBus::new();
        let devices =
            [("a", 0x0D, tablets::PEN_DISPLAY), ("b", 0x01, tablets::MOUSE), ("c", 0xFF00, &[0x06, 0, 0xFF])];
        for (path, page, descriptor) in devices.into_iter().chain([("d", 0x0D, tablets::DESK_TABLET)]) {
            // The rules let the user open all tablets of this maker.
            let info =
                DeviceInfo { path: path.into(), vendor_id: 0x256C, usage: (page, 1), ..Default::default() };
            bus.plug(&SimulatedDevice::new(info, descriptor));
        }
        bus.forbid("d", true);
        let found = look(&mut bus).unwrap();
        let texts: Vec<String> = found.iter().map(Found::text).collect();
        assert_eq!(texts.len(), 3, "a mouse is no tablet");
        assert!(
            texts[0].contains("4096 levels of pressure, tilt, twist, eraser")
                && texts[0].contains("295 × 166 mm")
        );
        assert!(texts[1].contains("pen record FILE"));
        assert!(texts[2].contains("./run.sh --install-udev"));
        assert_eq!(found[0].json()["read"], true);
    }

    #[test]
    fn a_guess_is_reported_and_so_are_the_models_of_a_tablet_that_is_not_read() {
        // Report 2 of eleven bytes; writes 63, another length than the table has for 28bd:0936.
        let longer: &[u8] = &[
            0x06, 0x0A, 0xFF, 0x09, 0x01, 0xA1, 0x01, 0x85, 0x02, 0x75, 0x08, 0x95, 0x0B, 0x81, 0x02, 0x95,
            0x3F, 0x91, 0x02, 0xC0,
        ];
        let mut bus = SimulatedBus::new();
        for (path, ids, descriptor) in
            [("a", (0x28BD, 0x936), longer), ("b", (0x256C, 0x6D), tablets::VENDOR_PAGE)]
        {
            let (vendor_id, product_id) = ids;
            let info = DeviceInfo { path: path.into(), vendor_id, product_id, ..Default::default() };
            bus.plug(&SimulatedDevice::new(info, descriptor));
        }
        let found = look(&mut bus).unwrap();
        let texts: Vec<String> = found.iter().map(Found::text).collect();
        assert!(
            texts[0].contains("as XP-Pen Deco M") && texts[0].contains("this is a guess"),
            "{}",
            texts[0]
        );
        assert_eq!((&found[0].json()["guess"], &found[0].json()["read"]), (&json!(true), &json!(true)));
        assert!(
            texts[1].contains("not read: it may be ") && texts[1].contains("USB strings"),
            "{}",
            texts[1]
        );
        assert!(found[1].json()["models"].as_array().unwrap().len() > 10);
        let models = ["A 1", "A 2", "A 3"].map(str::to_owned).to_vec();
        let doubt = Doubt { models, taken: "A 2".into(), is_chosen: false };
        assert!(doubt_text(&doubt).contains("it may also be A 1, A 3;"));
    }
}
