//! Holds the shipped table of tablets, the udev rules made from it, and the promises about both.
//!
//! Blessed by one variable: `INSTA_UPDATE=always cargo test --test files tablets`.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use crate::not_run::not_run;
use penstemon::pen::hid::families::{Family, check_event};
use penstemon::pen::hid::table::{Certainty, Match};
use penstemon::pen::hid::{HidEvent, Table, Tablet};
use penstemon::pen::machine::Silence;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

fn table() -> &'static Table {
    Table::shipped().unwrap()
}

fn rules_path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("udev/70-penstemon.rules")
}

/// Finds with the strings given; others cannot be read.
fn find(usb: &str, input: usize, output: usize, strings: &[(u8, &str)]) -> Match<'static> {
    let (vendor, product) = usb.split_once(':').unwrap();
    let [vendor, product] = [vendor, product].map(|id| u16::from_str_radix(id, 16).unwrap());
    let mut read = |index| strings.iter().find(|(at, _)| *at == index).map(|(_, text)| (*text).to_owned());
    table().find(vendor, product, input, output, None, &mut read)
}

#[test]
fn the_shipped_table_is_sound_and_large() {
    let tablets = table().tablets();
    let names: BTreeSet<&str> = tablets.iter().map(|t| t.name.as_str()).collect();
    let families: BTreeSet<Family> = tablets.iter().filter(|t| !t.keys_only).map(|t| t.family).collect();
    assert!(names.len() >= 320, "{} tablets", names.len());
    assert!(families.len() >= 40, "{} families with a pen", families.len());
    let unused: Vec<_> = Family::ALL.iter().filter(|f| tablets.iter().all(|t| t.family != **f)).collect();
    assert!(unused.is_empty(), "families without a tablet: {unused:?}");
    assert!(names.iter().all(|name| name.trim() == *name && name.contains(' ')), "a name without its maker");
}

#[test]
fn every_tablet_has_plausible_measures() {
    for t in table().tablets() {
        // Steps a millimetre: some firmwares count coarsely, some of small tablets count as if they were large.
        let fineness = [f64::from(t.steps[0]) / t.area_mm.x, f64::from(t.steps[1]) / t.area_mm.y];
        assert!(
            fineness.iter().all(|steps| (5.0..=501.0).contains(steps)),
            "{}: {fineness:?} steps a mm",
            t.name
        );
        assert!((255..=32767).contains(&t.pressure), "{}: pressure {}", t.name, t.pressure);
        let length = t.input_length.unwrap_or(8);
        assert!((8..=1101).contains(&length), "{}: {length} bytes", t.name);
    }
}

#[test]
fn a_circle_on_these_tablets_is_a_circle() {
    for name in ["UGEE M708", "XP-Pen Artist 15.6 Pro"] {
        let t = table().tablets().iter().find(|t| t.name == name).unwrap();
        let [x, y] = [f64::from(t.steps[0]) / t.area_mm.x, f64::from(t.steps[1]) / t.area_mm.y];
        assert!((x / y - 1.0).abs() < 1e-3, "{name}: {x} steps a mm across, {y} along");
    }
}

#[test]
fn every_row_can_be_reached() {
    let mut hidden = Vec::new();
    for t in table().tablets().iter().filter(|t| t.strings.is_empty()) {
        let (input, output) = (t.input_length.unwrap_or(64), t.output_length.unwrap_or(7));
        let found = table().find(t.vendor, t.product, input, output, t.interface, &mut |_| None);
        if !found.tablets.iter().any(|other| other.name == t.name) {
            hidden.push(&t.name);
        }
    }
    assert!(hidden.is_empty(), "never found: {hidden:?}");
}

#[test]
fn known_devices_are_found() {
    let name = |found: Match<'_>| found.best().map(|t| t.name.clone());
    for (usb, input, output, strings, expected) in [
        ("256c:006e", 12, 0, &[(201, "HUION_M165_190325")][..], "Huion GT-220 V2"),
        ("056a:0357", 192, 0, &[], "Wacom PTH-660"),
        ("056a:00b8", 10, 0, &[], "Wacom PTK-440"),
        ("2feb:0006", 13, 9, &[], "Veikk A15 Pro"),
        ("28bd:0905", 12, 10, &[(4, "UG901_BPU1002"), (5, "2019-01-01_x")], "XP-Pen Deco 01 V2"),
        (
            "28bd:0905",
            12,
            10,
            &[(4, "UG901_BPU1002"), (5, "2020-10-23_Release3")],
            "XP-Pen Deco 01 V2 (Variant 2)",
        ),
        ("28bd:0936", 12, 64, &[], "XP-Pen Deco M"),
        ("28bd:094d", 12, 0, &[], "XP-Pen Artist 10 (2nd Gen)"),
        ("056a:03e6", 192, 0, &[], "Wacom Cintiq 16 (DTK-168)"),
        ("28bd:095d", 14, 14, &[], "XP-Pen Artist Ultra 16"),
        ("28bd:097d", 12, 33, &[], "XP-Pen Artist 12 (3rd Gen)"),
        ("256c:006f", 12, 0, &[(201, "GM001_T263_240101")], "Gaomon S620 (16K)"),
        ("28bd:0075", 8, 8, &[(2, "G430")], "XP-Pen Star G430"),
        // Firmwares that declare other lengths than they are listed with.
        ("256c:006e", 8, 0, &[(201, "HUION_T174_170519")], "Huion New 1060 Plus"),
        ("256c:006e", 8, 0, &[(201, "HUION_T153_160607")], "Huion WH1409 (2048)"),
    ] {
        let found = name(find(usb, input, output, strings));
        assert!(found.as_ref().is_some_and(|name| name.starts_with(expected)), "{usb}: {found:?}");
    }
    let unread = find("256c:006d", 12, 0, &[]);
    assert!(unread.unread.contains(&201), "the firmware's name is asked for");
    assert_eq!(find("ffff:ffff", 12, 0, &[]).certainty, Certainty::Unknown);
    let keys = find("056a:00de", 64, 0, &[]);
    assert!(keys.best().is_some_and(|t| t.keys_only && t.name == "Wacom CTH-470"));
}

#[test]
fn a_woken_tablet_draws() {
    let tablet = find("256c:006d", 12, 0, &[(201, "HUION_T173_190325")]).best().unwrap();
    assert!(
        tablet.silence() == Some(Silence::KNOWN) && tablet.needs_strings() && tablet.wake.strings == [200]
    );
    let mut decoder = tablet.decoder(12);
    let mut drawn = Vec::new();
    let [x, y] = tablet.steps.map(|steps| (steps / 2) as u16);
    let mut report = vec![8, 0x81];
    for value in [x, y, (tablet.pressure / 2) as u16] {
        report.extend(value.to_le_bytes());
    }
    report.extend([0, 0, 10, 20]);
    decoder.decode(&report, &mut |event| drawn.push(event));
    let [HidEvent::Pen(pen)] = drawn[..] else { panic!("{drawn:?}") };
    check_event(&drawn[0]).unwrap();
    assert!(pen.touches && (pen.position - glam::DVec2::splat(0.5)).length() < 1e-4);
    assert!(pen.pressure.is_some_and(|p| (p - 0.5).abs() < 1e-3));
}

/// Every device can be told from others by what it says of itself; a row that breaks this needs strings.
#[test]
fn no_device_without_strings_stays_ambiguous() {
    let mut ambiguous: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for t in table().tablets().iter().filter(|t| t.strings.is_empty()) {
        let (input, output) = (t.input_length.unwrap_or(64), t.output_length.unwrap_or(7));
        let found = table().find(t.vendor, t.product, input, output, t.interface, &mut |_| None);
        if found.certainty == Certainty::Ambiguous {
            let device = format!("{:04x}:{:04x} of {input} bytes, writes {output}", t.vendor, t.product);
            ambiguous.insert(device, found.tablets.iter().map(|t| t.name.clone()).collect());
        }
    }
    assert!(ambiguous.is_empty(), "{ambiguous:#?}");
}

#[test]
fn udev_rules_are_those_of_the_table() {
    let rules = table().udev_rules();
    if std::env::var("INSTA_UPDATE").is_ok_and(|value| value == "always") {
        std::fs::create_dir_all(rules_path().parent().unwrap()).unwrap();
        std::fs::write(rules_path(), &rules).unwrap();
    }
    let kept = std::fs::read_to_string(rules_path()).unwrap();
    assert!(
        kept == rules,
        "udev/70-penstemon.rules is not what the table says; INSTA_UPDATE=always cargo test --test files tablets writes it"
    );
}

#[test]
fn udev_rules_reach_every_tablet_and_no_kernel_driver() {
    let rules = std::fs::read_to_string(rules_path()).unwrap();
    let rule_of = |t: &Tablet| {
        format!(
            "KERNEL==\"hidraw*\", ATTRS{{idVendor}}==\"{:04x}\", ATTRS{{idProduct}}==\"{:04x}\"",
            t.vendor, t.product
        )
    };
    for tablet in table().tablets() {
        assert!(rules.contains(&rule_of(tablet)), "{}", tablet.name);
        let wireless = format!("KERNELS==\"0005:{:04X}:{:04X}.*\"", tablet.vendor, tablet.product);
        assert!(!tablet.bluetooth || rules.contains(&wireless), "{}", tablet.name);
    }
    for (number, line) in rules.lines().enumerate() {
        let is_rule = line.starts_with("KERNEL==\"hidraw*\"") || line.starts_with("SUBSYSTEM==\"usb\"");
        let frame = line.is_empty() || line.starts_with(['#', 'A', 'L']);
        assert!(frame || is_rule && line.ends_with("TAG+=\"uaccess\""), "line {}: {line}", number + 1);
        assert!(!line.contains("unbind") && !line.contains("RUN"), "line {}: {line}", number + 1);
    }
}

/// systemd's own judge, where it is new enough to have one (254).
#[test]
fn udevadm_accepts_the_rules() {
    let verify = |arguments: &[&str]| Command::new("udevadm").arg("verify").args(arguments).output();
    if !verify(&["--help"]).is_ok_and(|out| out.status.success()) {
        not_run("udevadm_accepts_the_rules", "no udevadm verify (systemd 254)");
        return;
    }
    let judged = verify(&["--no-style", rules_path().to_str().unwrap()]).unwrap();
    assert!(judged.status.success(), "{}", String::from_utf8_lossy(&judged.stderr));
}
