//! People's drawings and our labels of their strokes.
//!
//! The drawings (Quick, Draw! by Google, CC BY 4.0: flowers, leaves, trees, bushes) are not in this repository; the
//! labels, set by eye, are: `tests/fixtures/real_strokes.tsv`. The folder of drawings is named by the environment variable
//! `PENSTEMON_STROKES`, else it is `../shared/data/strokes` beside the repository.

use glam::Vec2;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// One labelled stroke of a person.
pub(crate) struct RealStroke {
    /// Drawing and number of the stroke in it.
    pub(crate) name: String,
    /// `blade`, `branch` or `neither`.
    pub(crate) label: String,
    /// What it shows, such as `petal` or `texture`.
    pub(crate) kind: String,
    /// `development` (errors were looked at while the synthetic shapes were made) or `held_out`.
    pub(crate) half: String,
    /// Positions as recorded.
    pub(crate) points: Vec<Vec2>,
}

#[derive(Deserialize)]
struct Drawing {
    key_id: String,
    strokes: Vec<Vec<[f32; 2]>>,
}

/// Folder that should hold the drawings.
pub(crate) fn folder() -> PathBuf {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/strokes");
    env::var_os("PENSTEMON_STROKES").map_or_else(beside, PathBuf::from)
}

/// Every labelled stroke whose drawing is there; `None` where the folder is not.
///
/// # Errors
/// A drawing or the table of labels that cannot be read.
pub(crate) fn load() -> io::Result<Option<Vec<RealStroke>>> {
    let folder = folder();
    if !folder.is_dir() {
        return Ok(None);
    }
    let drawings = drawings(&folder)?;
    let table = include_str!("../fixtures/real_strokes.tsv");
    let strokes: Option<Vec<_>> = table.lines().skip(1).map(|row| labelled(row, &drawings)).collect();
    strokes.map(Some).ok_or_else(|| io::Error::other("a label names a stroke that the drawings do not have"))
}

fn drawings(folder: &Path) -> io::Result<BTreeMap<String, Drawing>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|e| e == "json") {
            let list: Vec<Drawing> = serde_json::from_str(&fs::read_to_string(path)?)?;
            all.extend(list.into_iter().map(|d| (d.key_id.clone(), d)));
        }
    }
    Ok(all)
}

fn labelled(row: &str, drawings: &BTreeMap<String, Drawing>) -> Option<RealStroke> {
    let [key, number, label, kind, half] = row.split('\t').collect::<Vec<_>>().try_into().ok()?;
    let stroke = drawings.get(key)?.strokes.get(number.parse::<usize>().ok()?)?;
    Some(RealStroke {
        name: format!("{key}:{number}"),
        label: label.to_owned(),
        kind: kind.to_owned(),
        half: half.to_owned(),
        points: stroke.iter().map(|&p| Vec2::from(p)).collect(),
    })
}
