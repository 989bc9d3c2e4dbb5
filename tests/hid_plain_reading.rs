//! Report descriptors read a second time, plainly, by their own fields: every pen decodes to what these say, nothing else is
//! taken for a pen.
//!
//! Read so are made-up tablets, of every width, range, unit and page that the decoder tells apart, and every `*.bin` of the
//! folder named by `PENSTEMON_HID_DESCRIPTORS`, or of `../shared/data/hid` where that is there. Real descriptors are no part
//! of the repository: the collections of them stand under the Open Database License, which theirs would then spread to.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::print_stderr, reason = "figures of what was compared")]

use crate::not_run::not_run;
use crate::virtual_tablets;
use glam::{DVec2, Vec2};
use hidreport::{Field, Report, ReportDescriptor, VariableField};
use penstemon::pen::hid::{Decode, DescriptorDecoder, HidEvent, RawPen, TypedReports};
use std::path::{Path, PathBuf};

/// The fields of a report that stand in a pen's collections, as the descriptor names them.
struct PenReport {
    id: Option<u8>,
    bytes: usize,
    fields: Vec<VariableField>,
}

fn is_pen_collection(field: &VariableField) -> bool {
    let usages: Vec<u32> =
        field.collections.iter().map(|c| c.usages().first().map_or(0, u32::from)).collect();
    let is_tablet = matches!(usages.first(), Some(0x000D_0001 | 0x000D_0002 | 0xFF0D_0001 | 0xFF0D_0002));
    is_tablet && !usages.iter().any(|usage| matches!(usage & 0xFFFF, 0x21 | 0x22))
}

fn find<'a>(fields: &'a [VariableField], usages: &[u32]) -> Option<&'a VariableField> {
    fields.iter().find(|field| usages.contains(&u32::from(field.usage)))
}

const X: [u32; 2] = [0x0001_0030, 0xFF0D_0130];
const Y: [u32; 2] = [0x0001_0031, 0xFF0D_0131];
const TIP: [u32; 2] = [0x000D_0042, 0xFF0D_0042];
const IN_RANGE: [u32; 2] = [0x000D_0032, 0xFF0D_0032];
const PRESSURE: [u32; 2] = [0x000D_0030, 0xFF0D_0030];
const TILT: [[u32; 2]; 2] = [[0x000D_003D, 0xFF0D_003D], [0x000D_003E, 0xFF0D_003E]];

/// Reports with position, tip and pressure of a pen, by a plain reading of the descriptor; `None` where that cannot be had.
fn pen_reports(descriptor: &[u8]) -> Option<Vec<PenReport>> {
    let parsed = ReportDescriptor::try_from(descriptor).ok()?;
    let reports = parsed.input_reports().iter().map(|report| {
        let fields = report.fields().iter().filter_map(|field| match field {
            Field::Variable(field) if is_pen_collection(field) => Some(field.clone()),
            _ => None,
        });
        let (id, bytes) = (report.report_id().map(u8::from), report.size_in_bytes());
        PenReport { id, bytes, fields: fields.collect() }
    });
    Some(reports.filter(|r| [X, Y, TIP, PRESSURE].iter().all(|u| find(&r.fields, u).is_some())).collect())
}

/// Least and greatest number of a field as the descriptor writes them, whatever their size.
fn range(field: &VariableField) -> (i64, i64) {
    let (low, high) = (i32::from(field.logical_minimum), i32::from(field.logical_maximum));
    let mask = (1u64 << field.bits.len().min(32)) - 1;
    let high = if high < low { (high as u64 & mask) as i64 } else { i64::from(high) };
    (i64::from(low), high)
}

fn write_bits(report: &mut [u8], field: &VariableField, shift: usize, value: i64) {
    for (number, bit) in field.bits.clone().enumerate() {
        let (byte, bit) = ((bit + shift) / 8, (bit + shift) % 8);
        let set = value >> number.min(63) & 1 == 1;
        report[byte] = report[byte] & !(1 << bit) | u8::from(set) << bit;
    }
}

/// A touching report with every range field at this share of its range, and what it should say.
fn synthesise(pen: &PenReport, share: f64) -> (Vec<u8>, RawPen) {
    let shift = if pen.id.is_some() { 0 } else { 8 };
    let mut report = vec![0; pen.bytes + shift / 8];
    report[0] = pen.id.unwrap_or(0);
    let number_at = |field: &VariableField| {
        let (low, high) = range(field);
        low + ((high - low) as f64 * share).round() as i64
    };
    let exact = |field: &VariableField| {
        let (low, high) = range(field);
        (number_at(field) - low) as f64 / (high - low) as f64
    };
    let mut expected = RawPen { in_range: true, touches: true, ..RawPen::default() };
    for usages in [TIP, IN_RANGE] {
        find(&pen.fields, &usages).inspect(|field| write_bits(&mut report, field, shift, 1));
    }
    for usages in [X, Y, PRESSURE, TILT[0], TILT[1]] {
        find(&pen.fields, &usages).inspect(|field| write_bits(&mut report, field, shift, number_at(field)));
    }
    let share_of = |usages: &[u32]| exact(find(&pen.fields, usages).unwrap());
    expected.position = DVec2::new(share_of(&X), share_of(&Y));
    expected.pressure = Some(share_of(&PRESSURE) as f32);
    let tilt = TILT.map(|usages| {
        find(&pen.fields, &usages).map_or(0.0, |field| {
            // Units that are angles are taken as the descriptor says it; everything else is whole degrees.
            let number = number_at(field) as f64;
            let degrees = match (field.unit.map_or(0, u32::from), range(field)) {
                (0x14, (0, 18_000)) => (number - 9_000.0) / 100.0,
                (0x14, (_, 9_000)) => number / 100.0,
                _ => number,
            };
            degrees.clamp(-90.0, 90.0) as f32
        })
    });
    expected.tilt_deg = Vec2::from(tilt);
    (report, expected)
}

/// Figures of many descriptors.
#[derive(Debug, Default)]
struct Compared {
    read: usize,
    pens: usize,
    with_size: usize,
    with_tilt: usize,
    reports: usize,
    wrong: Vec<String>,
}

impl Compared {
    fn add(&mut self, name: &str, descriptor: &[u8]) {
        let decoder = DescriptorDecoder::new(descriptor);
        self.read += usize::from(decoder.is_ok());
        let (Ok(decoder), Some(expected)) = (decoder, pen_reports(descriptor)) else {
            eprintln!("not compared: {name}");
            return;
        };
        match (&decoder, expected.is_empty()) {
            (None, false) => self.wrong.push(format!("{name}: a pen was not seen")),
            (Some(_), true) => self.wrong.push(format!("{name}: taken for a pen")),
            _ => {}
        }
        let Some(mut decoder) = decoder else { return };
        self.pens += 1;
        self.with_size += usize::from(decoder.area_mm().is_some());
        self.with_tilt += usize::from(decoder.abilities().tilt);
        for (pen, share) in expected.iter().flat_map(|pen| [0.0, 0.5, 1.0].map(|share| (pen, share))) {
            let (report, expected) = synthesise(pen, share);
            self.reports += 1;
            if TypedReports::of(descriptor).holds(&report) {
                self.wrong.push(format!("{name}: {report:02x?} is taken for something typed"));
            }
            let mut said = None;
            decoder.decode(&report, &mut |event| {
                if let HidEvent::Pen(pen) = event {
                    said.get_or_insert(pen);
                }
            });
            if !said.is_some_and(|pen| is_close(&pen, &expected)) {
                self.wrong.push(format!("{name}: {report:02x?} became {said:?}, not {expected:?}"));
            }
        }
    }

    fn assert_right(&self) {
        assert!(self.wrong.is_empty(), "{} wrong:\n{}", self.wrong.len(), self.wrong.join("\n"));
    }
}

fn is_close(pen: &RawPen, expected: &RawPen) -> bool {
    let pressure = pen.pressure.zip(expected.pressure).is_some_and(|(a, b)| (a - b).abs() < 1e-6);
    pen.in_range
        && pen.touches
        && pressure
        && pen.position.abs_diff_eq(expected.position, 1e-9)
        && pen.tilt_deg.abs_diff_eq(expected.tilt_deg, 1e-3)
}

/// How a made-up tablet writes its tilt.
#[derive(Clone, Copy, Debug)]
enum Tilt {
    None,
    /// Whole degrees in 8 bits, without a unit.
    Degrees,
    /// Hundredths of a degree about an upright pen.
    Signed,
    /// The same, counted from 0 for a pen that lies on one side.
    Unsigned,
}

/// A tablet with a tip, a place, pressure, and what else pens may have.
#[derive(Clone, Copy, Debug)]
struct Made {
    /// On Wacom's own page.
    wacom: bool,
    /// A report id.
    id: Option<u8>,
    /// Bits of each axis and its greatest number.
    axes: (u8, u32),
    pressure: (u8, u32),
    /// Whether the axes have a length.
    sized: bool,
    in_range: bool,
    tilt: Tilt,
}

impl Made {
    /// All that differ in one thing or more.
    fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for wacom in [false, true] {
            for id in [None, Some(7)] {
                for axes in [(16, 10_000), (16, 32_767), (16, 65_535), (24, 1_000_000), (32, 200_000)] {
                    for pressure in [(8, 255), (16, 1023), (16, 8191), (16, 65_535)] {
                        for tilt in [Tilt::None, Tilt::Degrees, Tilt::Signed, Tilt::Unsigned] {
                            for (sized, in_range) in [(true, true), (false, true), (true, false)] {
                                all.push(Self { wacom, id, axes, pressure, sized, in_range, tilt });
                            }
                        }
                    }
                }
            }
        }
        all
    }

    /// Its report descriptor, item by item as the HID specification 1.11 has them.
    fn descriptor(&self) -> Vec<u8> {
        let digitizer: &[u8] = if self.wacom { &[0x06, 0x0D, 0xFF] } else { &[0x05, 0x0D] };
        let mut out = [digitizer, &[0x09, if self.wacom { 0x01 } else { 0x02 }, 0xA1, 0x01]].concat();
        out.extend(self.id.iter().flat_map(|id| [0x85, *id]));
        out.extend([0x09, 0x20, 0xA1, 0x00]);
        // Switches, filled up to a byte.
        let switches: &[u8] = if self.in_range { &[0x42, 0x32] } else { &[0x42] };
        out.extend(switches.iter().flat_map(|usage| [0x09, *usage]));
        let count = switches.len() as u8;
        out.extend([
            0x15,
            0x00,
            0x25,
            0x01,
            0x75,
            0x01,
            0x95,
            count,
            0x81,
            0x02,
            0x95,
            8 - count,
            0x81,
            0x03,
        ]);
        out.extend([0x95, 0x01]);
        if !self.wacom {
            out.extend([0x05, 0x01]);
        }
        // Hundredths of a millimetre, 200 mm by 200 mm.
        out.extend(if self.sized { [0x65, 0x11, 0x55, 0x0D] } else { [0x65, 0x00, 0x55, 0x00] });
        let length: u16 = if self.sized { 20_000 } else { 0 };
        out.extend([0x35, 0x00, 0x46]);
        out.extend(length.to_le_bytes());
        for axis in [0x30, 0x31] {
            out.extend(if self.wacom { vec![0x0A, axis, 0x01] } else { vec![0x09, axis] });
            out.extend(Self::number(self.axes));
        }
        out.extend([0x65, 0x00, 0x55, 0x00, 0x35, 0x00, 0x45, 0x00]);
        out.extend(digitizer);
        out.extend([0x09, 0x30]);
        out.extend(Self::number(self.pressure));
        out.extend(self.tilt_items());
        out.extend([0xC0, 0xC0]);
        out
    }

    /// A field from 0 to a number. One that fills its bits is written in as few bytes, where it reads as -1.
    fn number((bits, most): (u8, u32)) -> Vec<u8> {
        let mut out = vec![0x15, 0x00];
        match most {
            0xFF => out.extend([0x25, 0xFF]),
            ..=0xFFFF => out.extend([0x26, most as u8, (most >> 8) as u8]),
            _ => {
                out.push(0x27);
                out.extend(most.to_le_bytes());
            }
        }
        out.extend([0x75, bits, 0x81, 0x02]);
        out
    }

    fn tilt_items(&self) -> Vec<u8> {
        let (range, bits): (&[u8], u8) = match self.tilt {
            Tilt::None => return Vec::new(),
            Tilt::Degrees => (&[0x15, 0xC4, 0x25, 0x3C], 8),
            Tilt::Signed => (
                &[
                    0x65, 0x14, 0x55, 0x0E, 0x36, 0xD8, 0xDC, 0x46, 0x28, 0x23, 0x16, 0xD8, 0xDC, 0x26, 0x28,
                    0x23,
                ],
                16,
            ),
            Tilt::Unsigned => (
                &[0x65, 0x14, 0x55, 0x0E, 0x36, 0xD8, 0xDC, 0x46, 0x28, 0x23, 0x15, 0x00, 0x26, 0x50, 0x46],
                16,
            ),
        };
        [range, &[0x75, bits, 0x09, 0x3D, 0x81, 0x02, 0x09, 0x3E, 0x81, 0x02]].concat()
    }
}

#[test]
fn every_made_up_pen_decodes_and_nothing_else_does() {
    let mut compared = Compared::default();
    let tablets = Made::all();
    tablets.iter().for_each(|made| compared.add(&format!("{made:?}"), &made.descriptor()));
    let pens = tablets.len() + 3;
    for (name, descriptor) in [
        ("a pen display", virtual_tablets::PEN_DISPLAY),
        ("a desk tablet", virtual_tablets::DESK_TABLET),
        ("Wacom's page", virtual_tablets::WACOM_PAGE),
        ("a touch screen", virtual_tablets::TOUCH_SCREEN),
        ("a mouse", virtual_tablets::MOUSE),
        ("a keyboard", virtual_tablets::KEYBOARD),
    ] {
        compared.add(name, descriptor);
    }
    compared.assert_right();
    assert_eq!((compared.read, compared.pens), (pens + 3, pens));
    let with_tilt = tablets.iter().filter(|made| !matches!(made.tilt, Tilt::None)).count();
    assert_eq!((compared.with_tilt, compared.reports), (with_tilt + 3, 3 * pens));
    assert_eq!(compared.with_size, tablets.iter().filter(|made| made.sized).count() + 3);
}

/// Where the real descriptors are, if they are.
fn folder() -> Option<PathBuf> {
    let named = std::env::var_os("PENSTEMON_HID_DESCRIPTORS").map(PathBuf::from);
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/hid");
    named.or(Some(beside)).filter(|folder| folder.is_dir())
}

fn descriptors(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> = paths.filter(|path| path.extension().is_some_and(|e| e == "bin")).collect();
    paths.sort();
    paths.iter().map(|p| (p.file_name().unwrap().display().to_string(), std::fs::read(p).unwrap())).collect()
}

#[test]
fn every_real_pen_decodes_and_nothing_else_does() {
    let Some(folder) = folder() else {
        let why = "report descriptors of real devices, which may not be copied into this repository; name a folder of them \
                   with PENSTEMON_HID_DESCRIPTORS";
        not_run("every_real_pen_decodes_and_nothing_else_does", why);
        return;
    };
    let mut compared = Compared::default();
    let all = descriptors(&folder);
    all.iter().for_each(|(name, descriptor)| compared.add(name, descriptor));
    eprintln!("{} descriptors: {compared:?}", all.len());
    compared.assert_right();
    assert!(compared.pens > 0, "{} holds no pen", folder.display());
}
