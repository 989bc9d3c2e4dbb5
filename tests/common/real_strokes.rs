//! People's drawings and our labels of their strokes.
//!
//! `tests/fixtures/drawings` holds both; its README says where the drawings come from and under which licence.

use glam::Vec2;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;
use std::{fs, io};

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

/// Every labelled stroke.
///
/// # Errors
/// A drawing or the table of labels that cannot be read.
pub(crate) fn load() -> io::Result<Vec<RealStroke>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/drawings");
    let drawings = drawings(&folder)?;
    let table = fs::read_to_string(folder.join("labels.tsv"))?;
    let strokes: Option<Vec<_>> = table.lines().skip(1).map(|row| labelled(row, &drawings)).collect();
    strokes.ok_or_else(|| io::Error::other("a label names a stroke that the drawings do not have"))
}

fn drawings(folder: &Path) -> io::Result<BTreeMap<String, Drawing>> {
    let mut all = BTreeMap::new();
    for name in ["bush", "flower", "leaf", "tree"] {
        let text = fs::read_to_string(folder.join(name).with_extension("json"))?;
        let list: Vec<Drawing> = serde_json::from_str(&text)?;
        all.extend(list.into_iter().map(|d| (d.key_id.clone(), d)));
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
