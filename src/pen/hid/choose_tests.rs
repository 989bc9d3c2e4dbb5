//! Tests of choosing how a device is read.

use super::*;
use crate::pen::hid::made_up as tablets;
use crate::pen::hid::simulated::SimulatedDevice;
use crate::pen::hid::strings::descriptor as string;
use crate::pen::hid::{Bus, HidEvent, RawPen, StringsKept};
use glam::DVec2;

fn without_strings() -> Box<dyn DeviceStrings> {
    Box::new(KnownStrings::none(StringsKept::Unanswered))
}

fn with_strings<const N: usize>(strings: [(u8, Vec<u8>); N]) -> Box<dyn DeviceStrings> {
    Box::new(KnownStrings { strings: strings.into(), ..KnownStrings::none(StringsKept::Unanswered) })
}

/// The pens of a report.
fn pens(choice: &mut Choice, report: &[u8]) -> Vec<RawPen> {
    let mut pens = Vec::new();
    choice.decoder.decode(report, &mut |event| {
        if let HidEvent::Pen(pen) = event {
            pens.push(pen);
        }
    });
    pens
}

/// A node of the maker's own page with one input report of so many bytes besides its id.
fn vendor_descriptor(id: u8, bytes: u8) -> Vec<u8> {
    let head = [0x06, 0x0A, 0xFF, 0x09, 0x01, 0xA1, 0x01, 0x85, id, 0x75, 0x08, 0x95, bytes, 0x81, 0x02];
    [&head[..], &[0x95, 0x07, 0x91, 0x02, 0xC0]].concat()
}

#[test]
fn a_tablet_of_the_table_is_known_woken_and_read() {
    // Adesso Cybertablet K8: known by its numbers and lengths alone.
    let info = DeviceInfo { vendor_id: 0x28BD, product_id: 0x0910, ..DeviceInfo::default() };
    let mut choice = choose_decoder(&info, &vendor_descriptor(2, 9)).unwrap().expect("it is in the table");
    assert!(choice.way.contains("K8"), "{}", choice.way);
    assert_eq!(choice.abilities.pressure_levels, 8192);
    let device = SimulatedDevice::new(info, &vendor_descriptor(2, 9));
    choice.wake(&mut device.open()).unwrap();
    assert_eq!(device.written().0, [[0x02, 0xB0, 0x04, 0, 0, 0, 0, 0]]);
    // In range and touching at the middle of 20320 × 11430 steps, half pressed.
    let report = [0x02, 0xA1, 0xB0, 0x27, 0x53, 0x16, 0x00, 0x10, 0, 0];
    let pens = pens(&mut choice, &report);
    assert!(pens[0].touches && pens[0].position.distance(DVec2::splat(0.5)) < 1e-3);
    assert!((pens[0].pressure.unwrap() - 0.5).abs() < 1e-3);
}

#[test]
fn keys_on_a_node_of_their_own_are_read_without_a_pen() {
    // Graphire 4: its keys stand on a node with reports of 64 bytes.
    let info = DeviceInfo { vendor_id: 0x056A, product_id: 0x0015, ..DeviceInfo::default() };
    let mut choice = choose_decoder(&info, &vendor_descriptor(2, 63)).unwrap().expect("it is in the table");
    assert!(choice.abilities.is_pad && choice.silence.is_none() && choice.doubt.is_none());
    let mut events = Vec::new();
    let report = [&[2, 0, 0, 0x0A][..], &[0; 60]].concat();
    choice.decoder.decode(&report, &mut |event| events.push(event));
    assert_eq!(events, [HidEvent::Keys(10)]);
    // One that describes itself.
    let choice = choose_decoder(&DeviceInfo::default(), tablets::WACOM_PAD).unwrap().unwrap();
    assert!(choice.abilities.is_pad && choice.wake_up.is_none());
}

/// A table of two tablets with the same numbers, of which nothing else is known, and one that its strings tell.
fn doubtful() -> Table {
    let tablet = |name: &str, steps: u16, node: &str| {
        format!(
            "[[maker.tablet]]\nname = \"{name}\"\narea-mm = [100, 50]\nfamily = \"uclogic\"\n\
             steps = {{ x = {steps}, y = 5000, pressure = 2047 }}\nnodes = [{{ usb = \"256c:{node} }}]\n"
        )
    };
    let tablets = [
        tablet("Small", 5000, "0001\""),
        tablet("Large", 10000, "0001\""),
        tablet("Sure", 5000, "0002\""),
        tablet("Told", 5000, "0003\", strings = { 201 = 'T' }"),
    ];
    Table::from_toml(&format!("[[maker]]\nname = \"Maker\"\n{}", tablets.concat())).unwrap()
}

#[test]
fn the_artist_chooses_among_models_that_fit() {
    let table = doubtful();
    let taken = |product: u16, model: Option<&str>| {
        let found = table.find(0x256C, product, 12, 0, None, &mut |_| None);
        match take(&found, model) {
            Taken::Pen(tablet, doubt) => (tablet.name.clone(), doubt),
            Taken::NoPen => ("no pen".to_owned(), None),
            Taken::Ambiguous(models) => (format!("one of {models:?}"), None),
            Taken::Keys(tablet) => (format!("keys of {}", tablet.name), None),
        }
    };
    let doubt = |taken: &str, is_chosen: bool| {
        let models = ["Maker Small", "Maker Large"].map(str::to_owned).to_vec();
        (taken.to_owned(), Some(Doubt { models, taken: taken.to_owned(), is_chosen }))
    };
    assert_eq!(taken(1, None), doubt("Maker Small", false));
    assert_eq!(taken(1, Some("Maker Large")), doubt("Maker Large", true));
    assert_eq!(taken(1, Some("Maker Small")), doubt("Maker Small", true));
    assert_eq!(taken(1, Some("Maker Sure")), doubt("Maker Small", false), "what does not fit is not taken");
    assert_eq!(taken(2, Some("Maker Large")), ("Maker Sure".to_owned(), None), "there is nothing to choose");
    assert_eq!(taken(3, None).0, "one of [\"Maker Told\"]");
    assert_eq!(taken(3, Some("Maker Told")).0, "Maker Told", "where strings are not given, too");
    assert_eq!(taken(4, None).0, "no pen");
}

#[test]
fn a_tablet_that_only_strings_would_identify_is_refused_until_its_model_is_chosen() {
    let info = |bus| DeviceInfo { vendor_id: 0x256C, product_id: 0x6D, bus, ..DeviceInfo::default() };
    let descriptor = vendor_descriptor(8, 11);
    let refused = |bus| choose_decoder(&info(bus), &descriptor).map(|_| ()).unwrap_err();
    let ChooseError::StringsUnread { models, reason } = refused(Bus::Bluetooth) else { panic!("refused") };
    assert!(models.len() > 1 && reason == StringsKept::Wireless, "{models:?}");
    assert!(matches!(
        refused(Bus::Unknown),
        ChooseError::StringsUnread { reason: StringsKept::Unanswered, .. }
    ));
    let chosen =
        choose_model(&info(Bus::Unknown), &descriptor, without_strings(), models.last().map(String::as_str));
    let choice = chosen.unwrap().unwrap();
    assert!(choice.way.ends_with(models.last().unwrap()), "{}", choice.way);
    assert_eq!(choice.doubt.map(|doubt| (doubt.models, doubt.is_chosen)), Some((models, true)));
}

/// A tablet that is not listed and keeps silent until string 100 is read.
fn silent(strings: Box<dyn DeviceStrings>) -> Choice {
    let info = DeviceInfo { vendor_id: 0x5543, product_id: 0xFFFF, ..DeviceInfo::default() };
    choose_model(&info, tablets::SILENT_TABLET, strings, None).unwrap().expect("it describes a pen")
}

#[test]
fn a_tablet_that_keeps_silent_until_it_is_woken_draws_before_and_after() {
    let mut choice = silent(without_strings());
    assert_eq!(choice.silence, Some(Silence::LIKELY));
    let device = SimulatedDevice::new(DeviceInfo::default(), tablets::SILENT_TABLET);
    choice.wake(&mut device.open()).expect("it may work all the same");
    // The mouse that it imitates: first and second button, the middle of 2048 × 2048, pressure 1024.
    let drawn = pens(&mut choice, &[9, 3, 0, 4, 0, 4, 0, 4]);
    assert_eq!((drawn[0].touches, drawn[0].barrel), (true, [true, false, false]));
    assert_eq!((drawn[0].position, drawn[0].pressure), (DVec2::splat(0.5), Some(1024.0 / 2047.0)));
    assert!(!pens(&mut choice, &[9, 0, 0, 4, 0, 4, 0, 0])[0].touches);
    // The pen of the woken tablet: touching, the upper button held, the middle of 20000 × 15000, full pressure.
    let drawn = pens(&mut choice, &[7, 0x85, 0x10, 0x27, 0x4C, 0x1D, 0xFF, 0x07]);
    assert_eq!((drawn[0].touches, drawn[0].eraser, drawn[0].barrel), (true, false, [false, true, false]));
    assert_eq!((drawn[0].position, drawn[0].pressure), (DVec2::splat(0.5), Some(1.0)));
}

#[test]
fn a_tablet_that_could_not_be_woken_says_so_where_it_says_how_it_is_read() {
    let mut choice = silent(without_strings());
    let device = SimulatedDevice::new(DeviceInfo::default(), tablets::SILENT_TABLET);
    choice.wake(&mut device.open()).unwrap();
    assert!(choice.way.contains("not fully woken") && choice.way.contains("string 100"), "{}", choice.way);
    let mut woken = silent(with_strings([(100, string("1")), (123, string("2"))]));
    woken.wake(&mut device.open()).unwrap();
    assert_eq!(woken.way, "its report descriptor");
}

#[test]
fn a_silent_tablet_whose_strings_are_not_given_is_read_and_its_model_can_be_chosen() {
    let info = DeviceInfo { vendor_id: 0x256C, product_id: 0x6E, ..DeviceInfo::default() };
    let choice = choose_decoder(&info, tablets::SILENT_TABLET).unwrap().expect("it describes a pen");
    let doubt = choice.doubt.expect("several models fit");
    assert!(doubt.models.len() > 1 && doubt.taken == choice.way && !doubt.is_chosen, "{doubt:?}");
    let model = doubt.models[1].as_str();
    let chosen = choose_model(&info, tablets::SILENT_TABLET, without_strings(), Some(model));
    let chosen = chosen.unwrap().unwrap();
    assert!(chosen.way.ends_with(model) && chosen.doubt.is_some_and(|doubt| doubt.is_chosen));
}

#[test]
fn hover_is_seen_where_in_range_is_turned_about() {
    let mut choice = silent(without_strings());
    let hover = pens(&mut choice, &[7, 0x80, 0x10, 0x27, 0x4C, 0x1D, 0, 0]);
    assert_eq!((hover[0].in_range, hover[0].touches), (true, false));
    assert!(!pens(&mut choice, &[7, 0xC0, 0x10, 0x27, 0x4C, 0x1D, 0, 0])[0].in_range, "it leaves");
    assert_eq!(pens(&mut choice, &[7, 0xE0, 1, 1, 1, 0, 0, 0]), [], "an express key");
}

#[test]
fn a_woken_tablet_is_read_by_what_it_says_of_itself() {
    // 40000 × 30000 of 8191 at 4000 lines an inch, twice what its descriptor says.
    let answer = vec![12, 3, 0x40, 0x9C, 0x30, 0x75, 0, 0, 0xFF, 0x1F, 0xA0, 0x0F];
    let mut choice = silent(with_strings([(100, answer), (123, string("HK On"))]));
    assert!(choice.area_mm.unwrap().abs_diff_eq(DVec2::new(50.8, 38.1), 1e-9), "as its descriptor has it");
    let device = SimulatedDevice::new(DeviceInfo::default(), tablets::SILENT_TABLET);
    choice.wake(&mut device.open()).unwrap();
    assert!(choice.area_mm.unwrap().abs_diff_eq(DVec2::new(254.0, 190.5), 1e-9));
    assert_eq!(choice.abilities.pressure_levels, 8192);
    let drawn = pens(&mut choice, &[7, 0x81, 0x20, 0x4E, 0x98, 0x3A, 0xFF, 0x1F]);
    assert_eq!((drawn[0].position, drawn[0].pressure), (DVec2::splat(0.5), Some(1.0)));
    assert!(pens(&mut choice, &[9, 1, 0, 4, 0, 4, 0, 4])[0].touches, "the mouse stays");
}

#[test]
fn a_listed_tablet_that_keeps_silent_is_woken_by_its_row() {
    // Genius i405x: a feature report wakes it; the table is asked though the descriptor describes a pen.
    let info = DeviceInfo { vendor_id: 0x0458, product_id: 0x5010, ..DeviceInfo::default() };
    let mut choice = choose_decoder(&info, tablets::SILENT_TABLET).unwrap().unwrap();
    assert!(choice.way.contains("Genius"), "{}", choice.way);
    let device = SimulatedDevice::new(info, tablets::SILENT_TABLET);
    choice.wake(&mut device.open()).unwrap();
    assert_eq!(device.written().1, [[0x05, 0x12, 0x10, 0x11, 0x12, 0, 0, 0]]);
    assert_eq!(pens(&mut choice, &[0x10, 0x81, 0, 1, 0, 1, 0xFF, 3]).len(), 1, "awake");
    assert_eq!(pens(&mut choice, &[9, 1, 0, 4, 0, 4, 0, 4]).len(), 1, "not yet");
}

#[test]
fn a_node_with_nothing_but_the_imitated_mouse_is_read() {
    let info = DeviceInfo { vendor_id: 0x28BD, product_id: 0x0075, ..DeviceInfo::default() };
    let mouse = tablets::imitated_mouse();
    let mut choice = choose_decoder(&info, &mouse).unwrap().expect("it has pressure");
    assert!(pens(&mut choice, &[9, 1, 0, 4, 0, 4, 0, 4])[0].touches);
    assert!(choose_decoder(&info, tablets::MOUSE).unwrap().is_none(), "other mice are mice");
}

/// Huion's New 1060 Plus declares 8 bytes, though its row has the 12 that it sends.
#[test]
fn a_firmware_is_known_by_its_name_whatever_lengths_it_declares() {
    let info = DeviceInfo { vendor_id: 0x256C, product_id: 0x6E, ..DeviceInfo::default() };
    let strings = || with_strings([(201, string("HUION_T174_170519"))]);
    let choice = choose_model(&info, &vendor_descriptor(8, 7), strings(), None).unwrap().unwrap();
    assert!(choice.way.ends_with("Huion New 1060 Plus") && choice.doubt.is_none(), "{}", choice.way);
    let other_node = choose_model(&info, &vendor_descriptor(3, 7), strings(), None).unwrap();
    assert!(other_node.is_none(), "a node without the pen's report");
}

#[test]
fn a_model_that_is_not_listed_is_read_by_its_firmware() {
    let info = DeviceInfo { vendor_id: 0x256C, product_id: 0x6D, ..DeviceInfo::default() };
    // 70000 × 43600 of 16383 at 5080 lines an inch.
    let ranges = vec![18, 3, 0x70, 0x11, 1, 0x50, 0xAA, 0, 0xFF, 0x3F, 0xD8, 0x13, 3, 0, 0, 0, 0, 0];
    let strings = [(200, ranges), (201, string("HUION_T999_300101"))];
    let mut choice =
        choose_model(&info, &vendor_descriptor(8, 11), with_strings(strings), None).unwrap().unwrap();
    assert!(choice.way.contains("HUION_T999_300101"), "{}", choice.way);
    let device = SimulatedDevice::new(info.clone(), &vendor_descriptor(8, 11));
    choice.wake(&mut device.open()).unwrap();
    assert!(choice.area_mm.unwrap().abs_diff_eq(DVec2::new(350.0, 218.0), 1e-9));
    assert_eq!((choice.abilities.pressure_levels, choice.silence), (16384, Some(Silence::KNOWN)));
    // Touching at the middle: 35000 and 21800, full pressure, leaning 10 and -20 degrees on the wire.
    let drawn = pens(&mut choice, &[8, 0x81, 0xB8, 0x88, 0x28, 0x55, 0xFF, 0x3F, 0, 0, 10, 0xEC]);
    assert_eq!((drawn[0].position, drawn[0].pressure), (DVec2::splat(0.5), Some(1.0)));
    assert_eq!(drawn[0].tilt_deg, glam::Vec2::new(10.0, 20.0));
    let mute = with_strings([(201, string("HUION_T999_300101"))]);
    let mut mute = choose_model(&info, &vendor_descriptor(8, 11), mute, None).unwrap().unwrap();
    let why = mute.wake(&mut device.open()).unwrap_err();
    assert!(why.to_string().contains("HUION_T999_300101"), "{why}");
}

#[test]
fn a_model_that_is_not_listed_and_may_not_be_asked_says_what_helps() {
    let info = DeviceInfo { vendor_id: 0x256C, product_id: 0xFFFF, ..DeviceInfo::default() };
    let forbidden = Box::new(KnownStrings::none(StringsKept::Forbidden));
    let refused = choose_model(&info, &vendor_descriptor(8, 11), forbidden, None).map(|_| ());
    assert_eq!(refused, Err(ChooseError::UnlistedForbidden));
    assert!(choose_decoder(&info, &vendor_descriptor(8, 11)).unwrap().is_none());
}

#[test]
fn what_neither_describes_itself_nor_is_known_is_no_pen() {
    let info = DeviceInfo { vendor_id: 0x1234, product_id: 0x5678, ..DeviceInfo::default() };
    assert!(choose_decoder(&info, &vendor_descriptor(2, 9)).unwrap().is_none());
    assert!(choose_decoder(&info, &[]).is_err());
}
