//! Which decoder reads a device.
//!
//! A device whose descriptor describes a pen is read by its descriptor; so are tablets whose reports a kernel driver has
//! rewritten, since it rewrites the descriptor as well. What is left may be a tablet of the table ([`super::table`]): it is
//! known by its numbers, the lengths of its reports and its USB strings, and woken before it is read. Where these leave a
//! doubt, the best guess is taken unless the artist chose a model among those that fit. The table is asked, too, where a
//! tablet describes a pen that keeps silent until it is woken. Tablets of UC-Logic's protocols that are not listed are
//! read by what they say of themselves ([`super::waking`]).

use super::choice::{Choice, Doubt, Known, WakeUp};
use super::report_lengths::{ReportLengths, input_length};
use super::strings::{self, DeviceStrings, KnownStrings};
use super::table::{Certainty, FIRMWARE_NAME, Match, Table};
use super::uclogic::{self, Protocol, Ranges};
use super::wake::Wake;
use super::waking;
use super::{
    Abilities, Bus, ChooseError, Decode, DescriptorDecoder, DeviceInfo, HidEvent, StringsKept, Tablet,
};
use crate::pen::machine::Silence;
use std::collections::BTreeMap;

/// The string whose reading switches express keys of the first protocol from a keyboard's codes to reports.
const KEYS_STRING: u8 = 123;
/// Least bytes of a report that the second protocol's descriptors declare.
const LEAST_REPORT: usize = 8;

/// Models that the artist chose, by the [`identity`](DeviceInfo::identity) of their devices.
pub type Models = BTreeMap<String, String>;

/// The decoder for a device of which no strings are known, `None` for a device that is no pen.
///
/// # Errors
/// A descriptor that cannot be understood, or a tablet that only its USB strings would tell from others.
pub fn choose_decoder(device: &DeviceInfo, descriptor: &[u8]) -> Result<Option<Choice>, ChooseError> {
    let kept = if device.bus == Bus::Bluetooth { StringsKept::Wireless } else { StringsKept::Unanswered };
    choose_model(device, descriptor, Box::new(KnownStrings::none(kept)), None)
}

/// The decoder for a device with these USB strings, of which none is asked for that would wake it; where a doubt is left,
/// the device is read as this model if it may be one.
///
/// # Errors
/// As before, if no model is given that fits.
pub fn choose_model(
    device: &DeviceInfo,
    descriptor: &[u8],
    mut strings: Box<dyn DeviceStrings>,
    model: Option<&str>,
) -> Result<Option<Choice>, ChooseError> {
    let by_itself = DescriptorDecoder::new(descriptor);
    match by_itself {
        Ok(Some(decoder)) => {
            let declared = uclogic::declared(&decoder);
            if declared.is_none() && !decoder.waits_to_be_woken() {
                return Ok(Some(by_descriptor(decoder)));
            }
            // What it says of itself suffices where nothing tells more; the artist may still know its model.
            let (listed, models) = match identify(device, descriptor, &mut *strings, model) {
                Ok(listed) => (listed, Vec::new()),
                Err(ChooseError::StringsUnread { models, .. }) => (None, models),
                Err(_) => (None, Vec::new()),
            };
            let mut choice = match (listed, declared) {
                (Some(Identity::Model(tablet, doubt)), _) => {
                    by_table(tablet, doubt, descriptor, strings, Some(decoder))
                }
                (_, Some(ranges)) => by_protocol(ranges, descriptor, strings, decoder),
                (_, None) => by_descriptor(decoder),
            };
            if choice.doubt.is_none() && !models.is_empty() {
                choice.doubt = Some(Doubt { models, taken: choice.way.clone(), is_chosen: false });
            }
            Ok(Some(choice))
        }
        nothing => match identify(device, descriptor, &mut *strings, model)? {
            Some(Identity::Model(tablet, doubt)) => {
                Ok(Some(by_table(tablet, doubt, descriptor, strings, None)))
            }
            Some(Identity::Firmware(name)) => Ok(Some(by_firmware(name, descriptor, strings))),
            None => match DescriptorDecoder::of_imitation(descriptor) {
                Ok(Some(imitation)) => Ok(Some(by_descriptor(imitation))),
                // Keys beside a pen that another node of the tablet has.
                _ => Ok(nothing.and_then(|_| DescriptorDecoder::of_pad(descriptor))?.map(by_descriptor)),
            },
        },
    }
}

/// A device that describes itself.
fn by_descriptor(decoder: DescriptorDecoder) -> Choice {
    let abilities = decoder.abilities();
    let silence = match (decoder.waits_to_be_woken(), abilities.leaves || abilities.is_pad) {
        (true, _) => Some(Silence::LIKELY),
        (false, leaves) => (!leaves).then_some(Silence::KNOWN),
    };
    Choice {
        wake_up: None,
        way: "its report descriptor".to_owned(),
        area_mm: decoder.area_mm(),
        silence,
        abilities,
        decoder: Box::new(decoder),
        doubt: None,
    }
}

/// A tablet that is listed; `described` is what its descriptor says of it besides.
fn by_table(
    tablet: &Tablet,
    doubt: Option<Doubt>,
    descriptor: &[u8],
    strings: Box<dyn DeviceStrings>,
    described: Option<DescriptorDecoder>,
) -> Choice {
    let lengths = ReportLengths::of(descriptor);
    let imitation = described.filter(DescriptorDecoder::waits_to_be_woken);
    let spec = tablet.spec(lengths.input);
    let silence = tablet.silence().or(imitation.as_ref().map(|_| Silence::LIKELY));
    Choice {
        decoder: match waking::reader(&spec, imitation.clone()) {
            pen if !tablet.keys_only => pen,
            keys => Box::new(WithoutPen(keys)),
        },
        way: format!("the table, as {}", tablet.name),
        area_mm: Some(tablet.area_mm),
        silence: silence.filter(|_| !tablet.keys_only),
        abilities: abilities(tablet),
        doubt,
        wake_up: (!tablet.wake.is_empty()).then(|| WakeUp {
            sequence: tablet.wake.clone(),
            lengths,
            strings,
            spec: Some(spec),
            imitation,
            known: Known::Model,
        }),
    }
}

/// Reads a node of keys in a format that has pens, too.
struct WithoutPen(Box<dyn Decode>);

impl Decode for WithoutPen {
    fn decode(&mut self, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        self.0.decode(report, &mut |event| {
            if !matches!(event, HidEvent::Pen(_)) {
                sink(event);
            }
        });
    }
}

/// A tablet that is not listed and declares the first protocol's report.
fn by_protocol(
    ranges: Ranges,
    descriptor: &[u8],
    strings: Box<dyn DeviceStrings>,
    described: DescriptorDecoder,
) -> Choice {
    let lengths = ReportLengths::of(descriptor);
    let spec = ranges.spec(Protocol::First, lengths.input);
    let abilities = Abilities { barrel_buttons: 2, eraser: false, ..described.abilities() };
    let imitation = Some(described).filter(DescriptorDecoder::waits_to_be_woken);
    Choice {
        decoder: waking::reader(&spec, imitation.clone()),
        way: "its report descriptor".to_owned(),
        area_mm: ranges.area_mm,
        silence: Some(Silence::LIKELY),
        abilities,
        doubt: None,
        wake_up: Some(WakeUp {
            sequence: Wake { strings: vec![Protocol::First.string(), KEYS_STRING], ..Wake::default() },
            lengths,
            strings,
            spec: Some(spec),
            imitation,
            known: Known::Descriptor,
        }),
    }
}

/// A tablet that is not listed, of which the name of the firmware tells that it speaks the second protocol.
fn by_firmware(firmware: String, descriptor: &[u8], strings: Box<dyn DeviceStrings>) -> Choice {
    let lengths = ReportLengths::of(descriptor);
    // Ranges of nothing until the tablet has said its own; without, it is not read.
    let unknown = Ranges { steps: [1, 1], pressure: 1, area_mm: None };
    let spec = unknown.spec(Protocol::Second, lengths.input);
    Choice {
        decoder: spec.decoder(),
        way: format!("what its firmware {firmware} says of it"),
        area_mm: None,
        silence: Protocol::Second.silence(),
        abilities: Abilities { tilt: true, barrel_buttons: 2, ..Abilities::default() },
        doubt: None,
        wake_up: Some(WakeUp {
            sequence: Wake { strings: vec![Protocol::Second.string()], ..Wake::default() },
            lengths,
            strings,
            spec: Some(spec),
            imitation: None,
            known: Known::Firmware(firmware),
        }),
    }
}

/// Who a tablet is that does not read by its descriptor alone.
enum Identity {
    /// A listed model.
    Model(&'static Tablet, Option<Doubt>),
    /// A model that is not listed, by its firmware's name.
    Firmware(String),
}

/// Asks the table and the device's strings who it is; `None` for a node without a pen.
fn identify(
    device: &DeviceInfo,
    descriptor: &[u8],
    strings: &mut dyn DeviceStrings,
    model: Option<&str>,
) -> Result<Option<Identity>, ChooseError> {
    let Some(table) = Table::shipped().inspect_err(|error| tracing::error!("{error}")).ok() else {
        return Ok(None);
    };
    if table.knows(device.vendor_id, device.product_id) {
        let lengths = ReportLengths::of(descriptor);
        let found = table.find(
            device.vendor_id,
            device.product_id,
            lengths.input,
            lengths.output,
            device.interface,
            &mut |index| strings::text(&strings.read(index).ok()?),
        );
        match take(&found, model) {
            Taken::Pen(tablet, doubt) if carries(tablet, descriptor, lengths) => {
                return Ok(Some(Identity::Model(tablet, doubt)));
            }
            Taken::Ambiguous(models) => {
                return Err(ChooseError::StringsUnread { models, reason: strings.kept() });
            }
            Taken::Keys(tablet) if carries(tablet, descriptor, lengths) => {
                return Ok(Some(Identity::Model(tablet, None)));
            }
            Taken::Pen(..) | Taken::Keys(_) => return Ok(None),
            Taken::NoPen => {}
        }
    }
    if table.is_self_describing(device.vendor_id) { unlisted(descriptor, strings) } else { Ok(None) }
}

/// Whether a node can carry the reports of a tablet that was found by its firmware's name, whatever the lengths: all nodes
/// of a tablet have the same name.
fn carries(tablet: &Tablet, descriptor: &[u8], lengths: ReportLengths) -> bool {
    let is_as_listed = tablet.input_length.is_none_or(|length| length == lengths.input);
    is_as_listed || tablet.report_id().is_some_and(|id| input_length(descriptor, id).is_some())
}

/// A model of Huion's or its kin's that is not listed: it has the report of the second protocol and names its firmware.
fn unlisted(descriptor: &[u8], strings: &mut dyn DeviceStrings) -> Result<Option<Identity>, ChooseError> {
    let length = input_length(descriptor, Protocol::Second.report_id());
    if length.is_none_or(|length| length < LEAST_REPORT) {
        return Ok(None);
    }
    let firmware = strings.read(FIRMWARE_NAME).ok().and_then(|answer| strings::text(&answer));
    match firmware.map(|name| name.trim_matches(['\0', ' ']).to_owned()) {
        Some(name) if !name.is_empty() => Ok(Some(Identity::Firmware(name))),
        None if strings.kept() == StringsKept::Forbidden => Err(ChooseError::UnlistedForbidden),
        _ => Ok(None),
    }
}

/// What a match comes to.
#[derive(Debug)]
enum Taken<'t> {
    /// It is read as this tablet.
    Pen(&'t Tablet, Option<Doubt>),
    /// It has the keys of this tablet, whose pen has another node.
    Keys(&'t Tablet),
    /// It is no node of a tablet.
    NoPen,
    /// Only its strings would tell which of these it is.
    Ambiguous(Vec<String>),
}

/// The tablet that a device is read as: the one that fits, the one that the artist chose of several, or the best guess.
fn take<'t>(found: &Match<'t>, model: Option<&str>) -> Taken<'t> {
    let pens = || found.tablets.iter().copied().filter(|tablet| !tablet.keys_only);
    let models: Vec<String> = pens().map(|tablet| tablet.name.clone()).collect();
    let chosen = pens().find(|tablet| model == Some(tablet.name.as_str()));
    let best = found.best().filter(|tablet| !tablet.keys_only);
    let keys = || found.best().filter(|tablet| tablet.keys_only).map_or(Taken::NoPen, Taken::Keys);
    match (found.certainty, chosen.or(best)) {
        (Certainty::Sure, _) => best.map_or_else(keys, |tablet| Taken::Pen(tablet, None)),
        (_, Some(tablet)) => {
            let doubt = Doubt { models, taken: tablet.name.clone(), is_chosen: chosen.is_some() };
            Taken::Pen(tablet, Some(doubt))
        }
        (Certainty::StringsUnread, None) if !models.is_empty() => Taken::Ambiguous(models),
        (_, None) => keys(),
    }
}

fn abilities(tablet: &Tablet) -> Abilities {
    if tablet.keys_only {
        return Abilities { is_pad: true, touch: tablet.touch.is_some(), ..Abilities::default() };
    }
    Abilities {
        pressure_levels: u64::from(tablet.pressure) + 1,
        tilt: tablet.tilts,
        barrel_buttons: tablet.buttons,
        leaves: tablet.silence().is_none(),
        touch: tablet.touch.is_some(),
        ..Abilities::default()
    }
}

#[cfg(test)]
#[path = "choose_tests.rs"]
mod tests;
