//! The `garden` of a drawing: strokes that the artist painted on the ground, one on each line.
//!
//! ```json
//! {"tool": "plants", "species": "rose", "radius": 0.6, "density": 1, "points": [[0.5, 1.2, 0.5], [1.5, 1.3, 0.7]]}
//! {"tool": "path", "radius": 0.4, "points": [[-3, 2, 0.5], [3, 2.5, 0.5]]}
//! ```
//!
//! Points are metres to the right of the drawn plant and toward the viewer, and the pen's pressure. Without a species plants are copies
//! of the drawn one.

use super::number::push_number;
use super::progress::Progress;
use crate::quote;
use crate::sketch::error::Fault;
use crate::sketch::garden::{GardenPoint, GardenStroke, GardenStrokes, GardenTool, check};
use crate::sketch::limits;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, SeqAccess, Visitor};
use serde_json::json;
use std::fmt;
use std::sync::Arc;

/// Appends a stroke as JSON.
pub(super) fn push(out: &mut String, stroke: &Arc<GardenStroke>) {
    out.push_str(&format!("{{\"tool\": \"{}\"", stroke.tool.name()));
    if let GardenTool::Plants(Some(species)) = &stroke.tool {
        out.push_str(&format!(", \"species\": {}", json!(species)));
    }
    out.push_str(", \"radius\": ");
    push_number(out, stroke.radius);
    if stroke.density != 1.0 {
        out.push_str(", \"density\": ");
        push_number(out, stroke.density);
    }
    out.push_str(", \"points\": [");
    for (n, GardenPoint { at, pressure }) in stroke.points.iter().enumerate() {
        out.push_str(if n == 0 { "[" } else { ", [" });
        push_number(out, at.x);
        out.push_str(", ");
        push_number(out, at.y);
        out.push_str(", ");
        push_number(out, *pressure);
        out.push(']');
    }
    out.push_str("]}");
}

/// Reads the list.
pub(super) struct GardenSeed<'p>(pub(super) &'p Progress);

impl<'de> DeserializeSeed<'de> for GardenSeed<'_> {
    type Value = GardenStrokes;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for GardenSeed<'_> {
    type Value = GardenStrokes;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of strokes of a garden")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let progress = self.0;
        let mut strokes = Vec::new();
        while let Some(text) = seq.next_element::<StrokeText>()? {
            if strokes.len() == limits::MAX_GARDEN_STROKES {
                let (what, limit) = ("strokes of a garden", limits::MAX_GARDEN_STROKES);
                return Err(progress.refuse(Fault::TooMany { what, limit }));
            }
            let number = strokes.len() + 1;
            let stroke = text.stroke();
            strokes.push(Arc::new(
                stroke.map_err(|what| progress.malformed(format!("garden stroke {number}: {what}")))?,
            ));
        }
        check(&strokes).map_err(|what| progress.malformed(what))?;
        Ok(strokes.into())
    }
}

/// The garden of a step in the journal.
pub(super) struct GardenList(pub(super) GardenStrokes);

impl<'de> Deserialize<'de> for GardenList {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        GardenSeed(&Progress::default()).deserialize(deserializer).map(Self)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StrokeText {
    tool: String,
    species: Option<String>,
    radius: f32,
    density: Option<f32>,
    points: Vec<[f32; 3]>,
}

impl StrokeText {
    /// The stroke, or what is wrong with its tool.
    fn stroke(self) -> Result<GardenStroke, String> {
        let Self { tool, species, radius, density, points } = self;
        let tool = match (tool.as_str(), species) {
            ("plants", species) => GardenTool::Plants(species),
            ("path", None) => GardenTool::Path,
            ("clear", None) => GardenTool::Clear,
            ("path" | "clear", Some(_)) => {
                return Err("only `plants` are of a `species`; leave it out".to_owned());
            }
            (other, _) => {
                let other = quote::name(other);
                return Err(format!(
                    "no garden is painted with `{other}`; write `plants`, `path` or `clear`"
                ));
            }
        };
        let point = |[x, y, pressure]: [f32; 3]| GardenPoint { at: [x, y].into(), pressure };
        let points = points.into_iter().map(point).collect();
        Ok(GardenStroke { tool, radius, density: density.unwrap_or(1.0), points })
    }
}
