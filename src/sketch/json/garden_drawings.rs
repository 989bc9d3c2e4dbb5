//! The `garden_drawings` of a drawing: the plants that its garden has from other drawings, each as a sketch object of its own under
//! the name by which strokes of the garden know it.
//!
//! ```json
//! {"my pine": {"format": "penstemon-sketch", "version": 1, "strokes": [{"tool": "auto", "points": [[0, 0], [0, 90]]}]}}
//! ```

use super::parse::SketchSeed;
use super::progress::Progress;
use super::write;
use crate::quote;
use crate::sketch::draft::Purpose;
use crate::sketch::garden_drawing::GardenDrawing;
use crate::sketch::limits;
use crate::sketch::warnings::Warnings;
use serde::de::{DeserializeSeed, Deserializer, MapAccess, Visitor};
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt;

/// Appends the drawings as an object; each begins on a line of its own.
pub(in crate::sketch) fn push<'a>(out: &mut String, drawings: impl IntoIterator<Item = &'a GardenDrawing>) {
    for (i, drawing) in drawings.into_iter().enumerate() {
        out.push_str(if i == 0 { "{\n" } else { ",\n" });
        out.push_str(&format!("{}: {}", json!(drawing.name()), write(drawing.sketch()).trim_end()));
    }
    out.push_str("\n}");
}

/// Reads the drawings of an object by itself, as the journal has them.
///
/// # Errors
/// The first fault, in words.
pub(in crate::sketch) fn read(bytes: &[u8]) -> Result<BTreeMap<String, GardenDrawing>, String> {
    let progress = Progress::default();
    let mut deserializer = serde_json::Deserializer::from_slice(bytes);
    GardenDrawingsSeed(&progress)
        .deserialize(&mut deserializer)
        .map_err(|error| progress.take_fault().map_or_else(|| error.to_string(), |fault| fault.to_string()))
}

/// Reads drawings by their names.
pub(super) struct GardenDrawingsSeed<'p>(pub(super) &'p Progress);

impl<'de> DeserializeSeed<'de> for GardenDrawingsSeed<'_> {
    type Value = BTreeMap<String, GardenDrawing>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for GardenDrawingsSeed<'_> {
    type Value = BTreeMap<String, GardenDrawing>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object of drawings")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut drawings = BTreeMap::new();
        while let Some(name) = map.next_key::<String>()? {
            if drawings.len() == limits::MAX_GARDEN_DRAWINGS {
                return Err(self.0.malformed(format!(
                    "there are more than {} `garden_drawings`; take out those that no stroke of the garden names",
                    limits::MAX_GARDEN_DRAWINGS
                )));
            }
            let drawing = map.next_value_seed(OneSeed { name: &name, progress: self.0 })?;
            if drawings.insert(name, drawing).is_some() {
                let what = "two `garden_drawings` have the same name; give each its own";
                return Err(self.0.malformed(what));
            }
        }
        Ok(drawings)
    }
}

/// Reads one drawing.
struct OneSeed<'a> {
    name: &'a str,
    progress: &'a Progress,
}

impl<'de> DeserializeSeed<'de> for OneSeed<'_> {
    type Value = GardenDrawing;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<GardenDrawing, D::Error> {
        let Self { name, progress } = self;
        let refuse = |what: String| {
            progress.malformed(format!("the drawing `{}` of the garden: {what}", quote::name(name)))
        };
        // It counts strokes and points of its own.
        let inside = Progress::default();
        let draft = SketchSeed(&inside).deserialize(deserializer);
        let draft = draft.map_err(|error| match inside.take_fault() {
            Some(fault) => refuse(inside.in_item(fault).to_string()),
            None => error,
        })?;
        let sketch = draft.finish(Purpose::Edit, &mut Warnings::default());
        let sketch = sketch.map_err(|(_, fault)| refuse(fault.to_string()))?;
        GardenDrawing::new(name, sketch).map_err(refuse)
    }
}
