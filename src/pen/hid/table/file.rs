//! The table's file: makers, their tablets, the nodes of each, and named ways of waking.
//!
//! What a tablet says holds for its nodes unless they say otherwise. Everything that could only be noticed with the
//! hardware at hand is refused here: ranges of nothing, unknown names, expressions that do not compile, two nodes of one
//! tablet that no device could be told apart by.

use super::tablet::{StringRule, Table, Tablet};
use crate::pen::hid::families::Family;
use crate::pen::hid::wake::Wake;
use glam::DVec2;
use regex::bytes::{Regex, RegexBuilder};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};

/// Largest active area, in millimetres: none is larger than a drawing table.
const LARGEST_MM: f64 = 2000.0;
/// Longest HID report, in bytes.
const LONGEST_REPORT: usize = 4096;
/// Greatest raw coordinate of any layout: 24 bits.
const GREATEST_STEP: u32 = 0xFF_FFFF;
/// Greatest raw pressure of any layout: 16 bits.
const GREATEST_PRESSURE: u32 = 0xFFFF;
const MOST_BUTTONS: u8 = 3;
/// Keys are bits of a `u32`.
const MOST_KEYS: u8 = 32;
/// Not woken, though its tablet is.
const NOT_WOKEN: &str = "none";

/// What is wrong with a table of tablets.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// The text is no table at all.
    #[error("the table of tablets cannot be read: {0}")]
    Toml(String),
    /// One tablet is wrong.
    #[error("tablet \"{tablet}\": {problem}")]
    Tablet {
        /// Maker and model.
        tablet: String,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// One way of waking is wrong.
    #[error("wake sequence \"{name}\": {problem}")]
    Wake {
        /// Its name.
        name: String,
        /// What is wrong, and what would be right.
        problem: String,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct TableFile {
    #[serde(default)]
    self_describing: Vec<String>,
    #[serde(default)]
    wake: BTreeMap<String, WakeFile>,
    maker: Vec<MakerFile>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct WakeFile {
    #[serde(default)]
    strings: Vec<u8>,
    #[serde(default)]
    features: Vec<String>,
    #[serde(default)]
    pause_ms: u64,
    #[serde(default)]
    outputs: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MakerFile {
    name: String,
    tablet: Vec<TabletFile>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct TabletFile {
    name: String,
    area_mm: [f64; 2],
    steps: StepsFile,
    touch: Option<[u32; 2]>,
    buttons: Option<u8>,
    keys: Option<u8>,
    tilt: Option<bool>,
    family: Family,
    wake: Option<String>,
    nodes: Vec<NodeFile>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StepsFile {
    x: u32,
    y: u32,
    pressure: u32,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct NodeFile {
    usb: String,
    input: Option<usize>,
    output: Option<usize>,
    interface: Option<u8>,
    #[serde(default)]
    strings: BTreeMap<String, String>,
    #[serde(default)]
    other_than: BTreeMap<String, String>,
    family: Option<Family>,
    wake: Option<String>,
    #[serde(default)]
    shifted: bool,
    #[serde(default)]
    bluetooth: bool,
    #[serde(default)]
    keys_only: bool,
    doubtful: Option<String>,
}

pub(super) fn read(text: &str) -> Result<Table, TableError> {
    let file: TableFile = toml::from_str(text).map_err(|error| TableError::Toml(error.to_string()))?;
    let mut wakes = BTreeMap::new();
    for (name, wake) in file.wake {
        let read = wake_of(wake).map_err(|problem| TableError::Wake { name: name.clone(), problem })?;
        wakes.insert(name, read);
    }
    let mut names = BTreeSet::new();
    let mut tablets = Vec::new();
    for maker in &file.maker {
        for tablet in &maker.tablet {
            let name = format!("{} {}", maker.name, tablet.name);
            let nodes = nodes_of(&name, tablet, &wakes)
                .and_then(
                    |nodes| if names.insert(name.clone()) { Ok(nodes) } else { Err("is there twice".into()) },
                )
                .map_err(|problem| TableError::Tablet { tablet: name, problem })?;
            tablets.extend(nodes);
        }
    }
    let self_describing: Option<Vec<u16>> = file.self_describing.iter().map(|id| number(id)).collect();
    let wrong =
        || TableError::Toml("self-describing takes four lower-case hexadecimal digits for each maker".into());
    Ok(Table { tablets, self_describing: self_describing.ok_or_else(wrong)? })
}

fn wake_of(file: WakeFile) -> Result<Wake, String> {
    let reports = |texts: &[String]| texts.iter().map(|text| hex_report(text)).collect::<Result<Vec<_>, _>>();
    Ok(Wake {
        features: reports(&file.features)?,
        outputs: reports(&file.outputs)?,
        strings: file.strings,
        pause_ms: file.pause_ms,
    })
}

fn hex_report(text: &str) -> Result<Vec<u8>, String> {
    let bytes: Result<Vec<u8>, _> = text.split(' ').map(|byte| u8::from_str_radix(byte, 16)).collect();
    match bytes {
        Ok(bytes) if bytes.len() <= LONGEST_REPORT => Ok(bytes),
        _ => Err(format!("\"{text}\" is no report: write its bytes in hexadecimal with spaces between")),
    }
}

fn nodes_of(name: &str, file: &TabletFile, wakes: &BTreeMap<String, Wake>) -> Result<Vec<Tablet>, String> {
    check(file)?;
    let mut marks = BTreeSet::new();
    let mut tablets = Vec::new();
    for node in &file.nodes {
        let mark = (&node.usb, node.input, node.output, node.interface, &node.strings, &node.other_than);
        if !marks.insert(mark) {
            return Err(format!("two nodes are known by the same marks: {}", node.usb));
        }
        tablets.push(node_of(name, file, node, wakes)?);
    }
    Ok(tablets)
}

fn check(file: &TabletFile) -> Result<(), String> {
    let steps = [file.steps.x, file.steps.y];
    if !file.area_mm.iter().all(|side| (f64::MIN_POSITIVE..=LARGEST_MM).contains(side)) {
        return Err(format!("area-mm {:?} is no size between 0 and {LARGEST_MM} mm", file.area_mm));
    }
    if !steps.iter().chain(file.touch.iter().flatten()).all(|step| (1..=GREATEST_STEP).contains(step)) {
        return Err(format!("steps and touch must be from 1 to {GREATEST_STEP}"));
    }
    if !(1..=GREATEST_PRESSURE).contains(&file.steps.pressure) {
        return Err(format!("pressure {} is not from 1 to {GREATEST_PRESSURE}", file.steps.pressure));
    }
    if file.buttons.is_some_and(|count| count > MOST_BUTTONS)
        || file.keys.is_some_and(|count| count > MOST_KEYS)
    {
        return Err(format!("at most {MOST_BUTTONS} buttons and {MOST_KEYS} keys can be told apart"));
    }
    if file.nodes.iter().all(|node| node.keys_only) {
        return Err("no node carries the pen".into());
    }
    Ok(())
}

fn node_of(
    name: &str,
    file: &TabletFile,
    node: &NodeFile,
    wakes: &BTreeMap<String, Wake>,
) -> Result<Tablet, String> {
    let [vendor, product] = ids(&node.usb)?;
    let family = node.family.unwrap_or(file.family);
    if family.is_keys_only() && !node.keys_only {
        return Err(format!("{} has a family without a pen: set keys-only or correct the family", node.usb));
    }
    let lengths = [node.input, node.output];
    if lengths.iter().flatten().any(|length| *length > LONGEST_REPORT) || node.input == Some(0) {
        return Err(format!("{} has a report length that is not from 1 to {LONGEST_REPORT}", node.usb));
    }
    let inherited = if node.keys_only { &None } else { &file.wake };
    let wake = match node.wake.as_ref().or(inherited.as_ref()) {
        Some(wake) if wake != NOT_WOKEN => {
            wakes.get(wake).cloned().ok_or_else(|| format!("there is no wake sequence \"{wake}\""))?
        }
        _ => Wake::default(),
    };
    let mut strings = rules(&node.strings, true)?;
    strings.extend(rules(&node.other_than, false)?);
    Ok(Tablet {
        name: name.to_owned(),
        vendor,
        product,
        area_mm: DVec2::from_array(file.area_mm),
        steps: [file.steps.x, file.steps.y],
        pressure: file.steps.pressure,
        touch: file.touch,
        buttons: file.buttons.unwrap_or(2),
        keys: file.keys.unwrap_or(0),
        tilts: file.tilt.unwrap_or(true),
        family,
        shifted: node.shifted,
        bluetooth: node.bluetooth,
        keys_only: node.keys_only,
        input_length: node.input,
        output_length: node.output,
        interface: node.interface,
        strings,
        wake,
        doubtful: node.doubtful.clone(),
    })
}

/// Four lower-case hexadecimal digits.
fn number(id: &str) -> Option<u16> {
    let is_id = id.len() == 4 && id.bytes().all(|c| matches!(c, b'0'..=b'9' | b'a'..=b'f'));
    if is_id { u16::from_str_radix(id, 16).ok() } else { None }
}

fn ids(text: &str) -> Result<[u16; 2], String> {
    let numbers =
        text.split_once(':').and_then(|(vendor, product)| Some([number(vendor)?, number(product)?]));
    numbers.ok_or_else(|| {
        format!("usb \"{text}\" is not four lower-case hexadecimal digits, a colon, and four more")
    })
}

fn rules(strings: &BTreeMap<String, String>, must_match: bool) -> Result<Vec<StringRule>, String> {
    let rule = |(index, pattern): (&String, &String)| {
        let index = index.parse().ok().filter(|index| *index > 0);
        let index = index.ok_or_else(|| "strings have indices from 1 to 255".to_owned())?;
        Ok(StringRule { index, pattern: expression(pattern)?, must_match })
    };
    strings.iter().map(rule).collect()
}

/// Classes like `\d` mean ASCII: that is what firmwares speak.
fn expression(pattern: &str) -> Result<Regex, String> {
    RegexBuilder::new(pattern)
        .unicode(false)
        .build()
        .map_err(|error| format!("'{pattern}' is no expression: {error}"))
}
