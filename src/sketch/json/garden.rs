//! The `garden` of a drawing: strokes that the artist painted on the ground, one on each line.
//!
//! ```json
//! {"tool": "plants", "species": "rose", "radius": 0.6, "density": 1, "points": [[0.5, 1.2, 0.5], [1.5, 1.3, 0.7]]}
//! {"tool": "plants", "species": "oak", "age": 12, "radius": 4, "points": [[-9, -5, 0.5]]}
//! {"tool": "plants", "drawing": "my pine", "radius": 2, "points": [[7, -3, 0.5]]}
//! {"tool": "path", "radius": 0.4, "points": [[-3, 2, 0.5], [3, 2.5, 0.5]]}
//! ```
//!
//! Points are metres to the right of the drawn plant and toward the viewer, and the pen's pressure. Without a species plants are copies
//! of the drawn one. A drawing is named as `garden_drawings` has it.

use super::number::push_number;
use super::progress::Progress;
use crate::quote;
use crate::sketch::error::Fault;
use crate::sketch::garden::{GardenPlant, GardenPoint, GardenStroke, GardenStrokes, GardenTool, check};
use crate::sketch::garden_drawing::GardenDrawing;
use crate::sketch::limits;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, SeqAccess, Visitor};
use serde_json::json;
use std::fmt;
use std::sync::Arc;

/// Appends a stroke as JSON, with the name under which its drawing is kept.
pub(super) fn push(out: &mut String, stroke: &Arc<GardenStroke>, name: impl Fn(&GardenDrawing) -> String) {
    out.push_str(&format!("{{\"tool\": \"{}\"", stroke.tool.name()));
    match &stroke.tool {
        GardenTool::Plants(GardenPlant::Species { name, age }) => {
            out.push_str(&format!(", \"species\": {}", json!(name)));
            if let Some(age) = age {
                out.push_str(", \"age\": ");
                push_number(out, *age);
            }
        }
        GardenTool::Plants(GardenPlant::Drawing(drawing)) => {
            out.push_str(&format!(", \"drawing\": {}", json!(name(drawing))));
        }
        GardenTool::Plants(GardenPlant::Drawn) | GardenTool::Path | GardenTool::Clear => {}
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

/// The strokes as they are written: drawings are known by name, and may stand behind them in the file.
#[derive(Default)]
pub(super) struct GardenText(Vec<StrokeText>);

impl GardenText {
    /// The strokes, with the drawings that `find` knows by name.
    ///
    /// # Errors
    /// The first stroke that cannot be, in words.
    pub(super) fn resolved(
        self,
        find: impl Fn(&str) -> Option<GardenDrawing>,
    ) -> Result<GardenStrokes, String> {
        let numbered = |(text, number): (StrokeText, usize)| {
            text.stroke(&find).map(Arc::new).map_err(|what| format!("garden stroke {number}: {what}"))
        };
        let strokes: Vec<_> = self.0.into_iter().zip(1..).map(numbered).collect::<Result<_, _>>()?;
        check(&strokes)?;
        Ok(strokes.into())
    }
}

/// Reads the list.
pub(super) struct GardenSeed<'p>(pub(super) &'p Progress);

impl<'de> DeserializeSeed<'de> for GardenSeed<'_> {
    type Value = GardenText;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for GardenSeed<'_> {
    type Value = GardenText;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of strokes of a garden")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut strokes = Vec::new();
        while let Some(stroke) = seq.next_element()? {
            if strokes.len() == limits::MAX_GARDEN_STROKES {
                let (what, limit) = ("strokes of a garden", limits::MAX_GARDEN_STROKES);
                return Err(self.0.refuse(Fault::TooMany { what, limit }));
            }
            strokes.push(stroke);
        }
        Ok(GardenText(strokes))
    }
}

// The garden of a step in the journal.
impl<'de> Deserialize<'de> for GardenText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        GardenSeed(&Progress::default()).deserialize(deserializer)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StrokeText {
    tool: String,
    species: Option<String>,
    age: Option<f32>,
    drawing: Option<String>,
    radius: f32,
    density: Option<f32>,
    points: Vec<[f32; 3]>,
}

impl StrokeText {
    /// The stroke, or what is wrong with its tool.
    fn stroke(self, find: impl Fn(&str) -> Option<GardenDrawing>) -> Result<GardenStroke, String> {
        let Self { tool, species, age, drawing, radius, density, points } = self;
        let tool = match (tool.as_str(), (species, age, drawing)) {
            ("plants", of) => GardenTool::Plants(plant(of, find)?),
            ("path", (None, None, None)) => GardenTool::Path,
            ("clear", (None, None, None)) => GardenTool::Clear,
            ("path" | "clear", _) => {
                return Err(
                    "only `plants` are of a `species` or `drawing` and have an `age`; leave them out"
                        .to_owned(),
                );
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

/// What grows in a bed, from its species, its age and its drawing.
fn plant(
    of: (Option<String>, Option<f32>, Option<String>),
    find: impl Fn(&str) -> Option<GardenDrawing>,
) -> Result<GardenPlant, String> {
    match of {
        (None, None, None) => Ok(GardenPlant::Drawn),
        (Some(name), age, None) => Ok(GardenPlant::Species { name, age }),
        (None, None, Some(name)) => find(&name).map(GardenPlant::Drawing).ok_or_else(|| {
            format!(
                "the drawing `{}` is not among the `garden_drawings`; restore the file from a backup, or remove the stroke",
                quote::name(&name)
            )
        }),
        (None, Some(_), _) => Err("only plants of a `species` have an `age`; leave it out".to_owned()),
        (Some(_), _, Some(_)) => Err("plants are of a `species` or of a `drawing`; leave one out".to_owned()),
    }
}
