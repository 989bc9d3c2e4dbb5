//! Tests of choosing how a device is read.

use super::*;
use crate::pen::hid::simulated::SimulatedDevice;
use crate::pen::hid::{Bus, HidEvent, RawPen, StringsKept};

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
    choice.wake_up.take().expect("it must be woken")(&mut device.open());
    assert_eq!(device.written().0, [[0x02, 0xB0, 0x04, 0, 0, 0, 0, 0]]);
    let mut pens: Vec<RawPen> = Vec::new();
    // In range and touching at the middle of 20320 × 11430 steps, half pressed.
    let report = [0x02, 0xA1, 0xB0, 0x27, 0x53, 0x16, 0x00, 0x10, 0, 0];
    choice.decoder.decode(&report, &mut |event| {
        if let HidEvent::Pen(pen) = event {
            pens.push(pen);
        }
    });
    assert!(pens[0].touches && pens[0].position.distance(DVec2::splat(0.5)) < 1e-3);
    assert!((pens[0].pressure.unwrap() - 0.5).abs() < 1e-3);
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
            Taken::Untold(models) => (format!("one of {models:?}"), None),
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
fn a_tablet_that_only_strings_would_tell_is_refused_until_its_model_is_chosen() {
    let info = |bus| DeviceInfo { vendor_id: 0x256C, product_id: 0x6D, bus, ..DeviceInfo::default() };
    let descriptor = vendor_descriptor(8, 11);
    let refused = |bus| choose_decoder(&info(bus), &descriptor).map(|_| ()).unwrap_err();
    let ChooseError::StringsUnread { models, reason } = refused(Bus::Bluetooth) else { panic!("refused") };
    assert!(models.len() > 1 && reason == StringsKept::Wireless, "{models:?}");
    assert!(matches!(
        refused(Bus::Unknown),
        ChooseError::StringsUnread { reason: StringsKept::Unanswered, .. }
    ));
    let chosen = choose_model(&info(Bus::Unknown), &descriptor, models.last().map(String::as_str));
    let choice = chosen.unwrap().unwrap();
    assert!(choice.way.ends_with(models.last().unwrap()), "{}", choice.way);
    assert_eq!(choice.doubt.map(|doubt| (doubt.models, doubt.is_chosen)), Some((models, true)));
}

#[test]
fn what_neither_describes_itself_nor_is_known_is_no_pen() {
    let info = DeviceInfo { vendor_id: 0x1234, product_id: 0x5678, ..DeviceInfo::default() };
    assert!(choose_decoder(&info, &vendor_descriptor(2, 9)).unwrap().is_none());
    assert!(choose_decoder(&info, &[]).is_err());
}
