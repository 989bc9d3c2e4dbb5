//! Plants that people drew, whole, as sketches: `tests/data/strokes` and `strokes_added`, whose READMEs name origin and
//! licence, and icons.
//!
//! The drawings are split by a hash of class and index, so that no taste decides: half of the first are looked at while the
//! program is made, a quarter is looked at since it was judged once unseen, the rest is held back to judge the program. Of
//! those that were added later half are looked at since they were judged once unseen, half are held back. Icons that were
//! added later are split alike.

#![allow(dead_code, reason = "tests and examples take what they need")]

use penstemon::checksum::fnv1a;
use penstemon::sketch::{self, Sketch};
use serde::Deserialize;
use std::fs;
use std::io::{self, Error};
use std::path::{Path, PathBuf};

/// The classes, each a file.
pub(crate) const CLASSES: [&str; 11] = [
    "broccoli",
    "bush",
    "cactus",
    "flower",
    "garden",
    "grass",
    "house_plant",
    "leaf",
    "mushroom",
    "palm_tree",
    "tree",
];

/// Drawings of the quarter held back that were opened by mistake: they came a second time among those added later.
const OPENED_BY_MISTAKE: [(&str, usize); 17] = [
    ("broccoli", 10),
    ("bush", 10),
    ("cactus", 1),
    ("cactus", 5),
    ("cactus", 7),
    ("cactus", 14),
    ("flower", 4),
    ("flower", 12),
    ("grass", 5),
    ("leaf", 7),
    ("leaf", 15),
    ("leaf", 19),
    ("palm_tree", 1),
    ("tree", 4),
    ("tree", 11),
    ("tree", 18),
    ("tree", 24),
];

/// What a drawing is used for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Share {
    /// A half: looked at, labelled and run.
    Development,
    /// A quarter: held back until the first judgement, looked at and run since, not labelled.
    Opened,
    /// A quarter: neither looked at nor run but to judge.
    HeldBack,
    /// A half of those added later: looked at and run since they were judged unseen, not labelled.
    Added,
    /// The other half of those: neither looked at nor run but to judge.
    AddedHeldBack,
}

impl Share {
    /// The share of one of the first drawings.
    fn of(class: &str, index: usize) -> Self {
        match mixed(&format!("{class}/{index}")) & 3 {
            0 | 2 => Self::Development,
            1 => Self::Opened,
            _ if OPENED_BY_MISTAKE.contains(&(class, index)) => Self::Opened,
            _ => Self::HeldBack,
        }
    }

    /// The share of a drawing that was added later.
    fn of_added(class: &str, number: usize) -> Self {
        if mixed(&format!("{class}/added/{number}")) & 1 == 0 { Self::Added } else { Self::AddedHeldBack }
    }
}

/// A hash of a name: FNV-1a hardly mixes its last bytes.
fn mixed(name: &str) -> u32 {
    mix(fnv1a(name))
}

/// A number of which all bits depend on all of another: the rounds that end MurmurHash3.
pub(crate) fn mix(mut hash: u32) -> u32 {
    hash = (hash ^ hash >> 16).wrapping_mul(0x85eb_ca6b);
    hash = (hash ^ hash >> 13).wrapping_mul(0xc2b2_ae35);
    hash ^ hash >> 16
}

/// A drawing by a person.
pub(crate) struct Drawing {
    /// What the person was asked to draw; an icon's set.
    pub(crate) class: String,
    /// Its place in the file of the class; its number there with a plus before it, where it was added later; the icon's name.
    pub(crate) name: String,
    /// The strokes.
    pub(crate) sketch: Sketch,
}

#[derive(Deserialize)]
struct Recorded {
    /// Its number where that is not its place in the file.
    number: Option<usize>,
    strokes: Vec<Vec<[f32; 2]>>,
}

/// The drawings of a share, by class and index.
///
/// # Errors
/// A file that cannot be read or holds something else.
pub(crate) fn drawings(share: Share) -> io::Result<Vec<Drawing>> {
    let is_added = matches!(share, Share::Added | Share::AddedHeldBack);
    let (folder, sign) = if is_added { ("strokes_added", "+") } else { ("strokes", "") };
    let share_of = if is_added { Share::of_added } else { Share::of };
    let mut all = Vec::new();
    for class in CLASSES {
        let text = fs::read_to_string(data(folder).join(class).with_extension("json"))?;
        let recorded: Vec<Recorded> = serde_json::from_str(&text)?;
        for (place, drawing) in recorded.iter().enumerate() {
            let number = drawing.number.unwrap_or(place);
            if share_of(class, number) == share {
                let (class, name) = (class.to_owned(), format!("{sign}{number}"));
                all.push(Drawing { class, name, sketch: sketch_of(&drawing.strokes)? });
            }
        }
    }
    Ok(all)
}

/// The icons, by name.
///
/// # Errors
/// A file that cannot be read or holds something else.
pub(crate) fn icons() -> io::Result<Vec<Drawing>> {
    named(&data("icons"), |name| name.ends_with(".svg"))
}

/// The icons that were added later, of one half: those that may be looked at, or those that are held back. By name.
///
/// # Errors
/// A file that cannot be read or holds something else.
pub(crate) fn icons_added(held_back: bool) -> io::Result<Vec<Drawing>> {
    let is_held_back = |name: &str| mixed(&format!("icons/added/{name}")) & 1 == 1;
    named(&data("icons_added"), |name| name.ends_with(".svg") && is_held_back(name) == held_back)
}

/// The sketches that ship with the program and are drawn as people draw, by name.
///
/// # Errors
/// A file that cannot be read or holds something else.
pub(crate) fn freehand_sketches() -> io::Result<Vec<Drawing>> {
    named(&Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches"), |name| {
        name.starts_with("freehand_")
    })
}

/// The sketches of a folder whose files are named by set and name.
fn named(folder: &Path, is_one: impl Fn(&str) -> bool) -> io::Result<Vec<Drawing>> {
    let entries = fs::read_dir(folder)?.map(|entry| Ok(entry?.path()));
    let mut files = entries.collect::<io::Result<Vec<PathBuf>>>()?;
    files.retain(|path| path.file_name().is_some_and(|name| is_one(&name.to_string_lossy())));
    files.sort();
    let drawing = |file: &PathBuf| {
        let (sketch, _) = sketch::read(file).map_err(Error::other)?;
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        let (class, name) = name.split_once('_').ok_or_else(|| Error::other("a sketch without a set"))?;
        Ok(Drawing { class: class.to_owned(), name: name.to_owned(), sketch })
    };
    files.iter().map(drawing).collect()
}

fn data(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(folder)
}

/// Strokes without tools on a sheet just as large as they are, as a file would bring them.
fn sketch_of(strokes: &[Vec<[f32; 2]>]) -> io::Result<Sketch> {
    let strokes: Vec<_> = strokes.iter().map(|points| serde_json::json!({ "points": points })).collect();
    let file = serde_json::json!({ "format": "penstemon-sketch", "version": 1, "strokes": strokes });
    let (sketch, _) = sketch::from_bytes(file.to_string().as_bytes(), "drawing").map_err(Error::other)?;
    Ok(sketch)
}
