//! JSON text to a [`Draft`], in one pass and without intermediate values.

use super::corrections::CorrectionsSeed;
use super::fault;
use super::garden::{GardenSeed, GardenText};
use super::params::GroupSeed;
use super::part_poses::PartPosesSeed;
use super::petal_shapes::PetalShapesSeed;
use super::picture::PicturesSeed;
use super::plants::PlantsSeed;
use super::point::PointsSeed;
use super::progress::{Progress, set_once};
use super::reference::ReferenceSeed;
use crate::quote;
use crate::sketch::brush;
use crate::sketch::draft::{Draft, DraftStroke, Flaw, Purpose};
use crate::sketch::error::Fault;
use crate::sketch::textures::{self, ChoiceText};
use crate::sketch::warnings::Warnings;
use crate::sketch::{
    Brush, Canvas, Corrections, GardenDrawing, PartPoses, PetalShapes, Picture, PlacedPlant, Reference,
    Textures, Tool, limits,
};
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

/// Parses a sketch file of any version up to [`VERSION`](super::VERSION).
///
/// # Errors
/// The first fault, with line and column, and with stroke and point where there is one.
pub(in crate::sketch) fn parse(text: &str) -> Result<Draft, Flaw> {
    let progress = Progress::default();
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let parsed = SketchSeed(&progress).deserialize(&mut deserializer);
    parsed.and_then(|draft| deserializer.end().map(|()| draft)).map_err(|e| fault::flaw(&e, text, &progress))
}

#[derive(Deserialize)]
#[serde(field_identifier, rename_all = "snake_case")]
enum SketchField {
    Format,
    Version,
    Canvas,
    Species,
    Seed,
    Params,
    Textures,
    Reference,
    Pictures,
    Plants,
    Corrections,
    PetalShapes,
    #[serde(rename = "wood_poses")]
    PartPoses,
    Garden,
    GardenDrawings,
    Strokes,
}

/// Reads a sketch object.
pub(super) struct SketchSeed<'p>(pub(super) &'p Progress);

impl<'de> DeserializeSeed<'de> for SketchSeed<'_> {
    type Value = Draft;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Draft, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for SketchSeed<'_> {
    type Value = Draft;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a sketch object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Draft, A::Error> {
        let mut fields = Fields::default();
        while let Some(field) = map.next_key()? {
            fields.read(field, &mut map, self.0)?;
        }
        fields.draft(self.0)
    }
}

/// The fields of a sketch as far as they have been read.
#[derive(Default)]
struct Fields {
    format: Option<String>,
    version: Option<f64>,
    canvas: Option<Option<Canvas>>,
    species: Option<Option<String>>,
    seed: Option<u64>,
    params: Option<Map<String, Value>>,
    textures: Option<BTreeMap<String, ChoiceText>>,
    reference: Option<Option<Reference>>,
    pictures: Option<BTreeMap<String, Picture>>,
    plants: Option<Vec<PlacedPlant>>,
    corrections: Option<Corrections>,
    petal_shapes: Option<PetalShapes>,
    part_poses: Option<PartPoses>,
    garden: Option<GardenText>,
    garden_drawings: Option<BTreeMap<String, GardenDrawing>>,
    strokes: Option<Vec<DraftStroke>>,
}

impl Fields {
    /// Reads the value of a field.
    fn read<'de, A: MapAccess<'de>>(
        &mut self,
        field: SketchField,
        map: &mut A,
        progress: &Progress,
    ) -> Result<(), A::Error> {
        match field {
            SketchField::Format => {
                set_once(&mut self.format, map.next_value::<String>()?, "format")?;
                fault::check_format(self.format.as_deref()).map_err(|fault| progress.refuse(fault))?;
            }
            SketchField::Version => {
                let found = map.next_value()?;
                fault::check_version(found).map_err(|fault| progress.refuse(fault))?;
                set_once(&mut self.version, found, "version")?;
            }
            SketchField::Canvas => set_once(&mut self.canvas, map.next_value::<Option<Canvas>>()?, "canvas")?,
            SketchField::Species => {
                set_once(&mut self.species, map.next_value::<Option<String>>()?, "species")?
            }
            SketchField::Seed => set_once(&mut self.seed, map.next_value()?, "seed")?,
            SketchField::Params => {
                let group = GroupSeed { progress, count: &Cell::new(0), depth: 1 };
                set_once(&mut self.params, map.next_value_seed(group)?, "params")?;
            }
            SketchField::Textures => {
                set_once(&mut self.textures, map.next_value::<BTreeMap<String, ChoiceText>>()?, "textures")?;
            }
            SketchField::Plants => {
                set_once(&mut self.plants, map.next_value_seed(PlantsSeed(progress))?, "plants")?
            }
            SketchField::Corrections => {
                set_once(
                    &mut self.corrections,
                    map.next_value_seed(CorrectionsSeed(progress))?,
                    "corrections",
                )?;
            }
            SketchField::PetalShapes => {
                set_once(
                    &mut self.petal_shapes,
                    map.next_value_seed(PetalShapesSeed(progress))?,
                    "petal_shapes",
                )?;
            }
            SketchField::PartPoses => {
                set_once(&mut self.part_poses, map.next_value_seed(PartPosesSeed(progress))?, "wood_poses")?;
            }
            SketchField::Garden => {
                set_once(&mut self.garden, map.next_value_seed(GardenSeed(progress))?, "garden")?;
            }
            SketchField::GardenDrawings => {
                let drawings = map.next_value_seed(GardenDrawingsSeed(progress))?;
                set_once(&mut self.garden_drawings, drawings, "garden_drawings")?;
            }
            SketchField::Pictures => {
                set_once(&mut self.pictures, map.next_value_seed(PicturesSeed(progress))?, "pictures")?;
            }
            SketchField::Reference => {
                set_once(&mut self.reference, map.next_value_seed(ReferenceSeed(progress))?, "reference")?;
            }
            SketchField::Strokes => {
                set_once(&mut self.strokes, map.next_value_seed(StrokesSeed(progress))?, "strokes")?;
            }
        }
        Ok(())
    }

    /// The drawing that the fields are, once all have been read.
    fn draft<E: Error>(self, progress: &Progress) -> Result<Draft, E> {
        let Self { format, version, canvas, species, seed, params, textures, .. } = self;
        let Self {
            reference,
            pictures,
            plants,
            corrections,
            petal_shapes,
            part_poses,
            garden,
            garden_drawings,
            ..
        } = self;
        let strokes = self.strokes;
        fault::check_format(format.as_deref()).map_err(|fault| progress.refuse(fault))?;
        if version.is_none() {
            return Err(progress.malformed("the `version` is missing; write \"version\": 1"));
        }
        let strokes =
            strokes.ok_or_else(|| progress.malformed("the sketch has no `strokes`; add a list of them"))?;
        let textures = with_pictures(textures.unwrap_or_default(), &pictures.unwrap_or_default());
        let textures = textures.map_err(|message| progress.malformed(message))?;
        let drawings = garden_drawings.unwrap_or_default();
        let garden = garden.unwrap_or_default().resolved(|name| drawings.get(name).cloned());
        let garden = garden.map_err(|message| progress.malformed(message))?;
        let canvas = canvas.flatten();
        check_canvas(canvas).map_err(|message| progress.malformed(message))?;
        Ok(Draft {
            canvas,
            species: species.flatten(),
            seed: seed.unwrap_or_default(),
            params: params.unwrap_or_default(),
            textures,
            reference: reference.flatten().map(Arc::new),
            plants: plants.unwrap_or_default(),
            corrections: corrections.unwrap_or_default(),
            petal_shapes: petal_shapes.unwrap_or_default(),
            part_poses: part_poses.unwrap_or_default(),
            garden,
            strokes,
        })
    }
}

/// Reads the drawings of an object by itself, as the journal has them.
///
/// # Errors
/// The first fault, in words.
pub(in crate::sketch) fn garden_drawings(bytes: &[u8]) -> Result<BTreeMap<String, GardenDrawing>, String> {
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

/// The textures with the pictures that they name.
fn with_pictures(
    choices: BTreeMap<String, ChoiceText>,
    pictures: &BTreeMap<String, Picture>,
) -> Result<Textures, String> {
    let textures = textures::resolved(choices, |name| pictures.get(name).cloned())?;
    textures::check(&textures)?;
    Ok(textures)
}

fn check_canvas(canvas: Option<Canvas>) -> Result<(), String> {
    let fits = |side: f32| side > 0.0 && side <= limits::MAX_CANVAS_SIDE;
    match canvas {
        Some(Canvas { width, height }) if !fits(width) || !fits(height) => {
            let limit = limits::MAX_CANVAS_SIDE;
            Err(format!(
                "the canvas is {width} by {height}; its sides must lie between 0 and {limit:e}, or leave it out"
            ))
        }
        _ => Ok(()),
    }
}

struct StrokesSeed<'p>(&'p Progress);

impl<'de> DeserializeSeed<'de> for StrokesSeed<'_> {
    type Value = Vec<DraftStroke>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for StrokesSeed<'_> {
    type Value = Vec<DraftStroke>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of strokes")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let progress = self.0;
        let mut strokes = Vec::new();
        progress.stroke.set(1);
        while let Some(stroke) = seq.next_element_seed(StrokeSeed(progress))? {
            if strokes.len() == limits::MAX_STROKES {
                return Err(progress.refuse(Fault::TooMany { what: "strokes", limit: limits::MAX_STROKES }));
            }
            strokes.push(stroke);
            progress.id.set(None);
            progress.stroke.set(strokes.len() + 1);
        }
        progress.stroke.set(0);
        Ok(strokes)
    }
}

#[derive(Deserialize)]
#[serde(field_identifier, rename_all = "snake_case")]
enum StrokeField {
    Id,
    Tool,
    Points,
    Brush,
}

/// Reads one stroke.
pub(super) struct StrokeSeed<'p>(pub(super) &'p Progress);

impl<'de> DeserializeSeed<'de> for StrokeSeed<'_> {
    type Value = DraftStroke;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<DraftStroke, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for StrokeSeed<'_> {
    type Value = DraftStroke;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a stroke object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<DraftStroke, A::Error> {
        let progress = self.0;
        let (mut id, mut tool, mut points, mut brush) = (None, None, None, None);
        while let Some(field) = map.next_key()? {
            match field {
                StrokeField::Id => {
                    set_once(&mut id, map.next_value()?, "id")?;
                    progress.id.set(id);
                }
                StrokeField::Tool => {
                    let name: String = map.next_value()?;
                    let known = Tool::ALL.into_iter().find(|tool| tool.name() == name);
                    let known = known
                        .ok_or_else(|| progress.refuse(Fault::UnknownTool { name: quote::name(&name) }))?;
                    set_once(&mut tool, known, "tool")?;
                }
                StrokeField::Points => {
                    set_once(&mut points, map.next_value_seed(PointsSeed(progress))?, "points")?
                }
                StrokeField::Brush => set_once(&mut brush, map.next_value::<Brush>()?, "brush")?,
            }
        }
        let points = points.ok_or_else(|| A::Error::missing_field("points"))?;
        let tool = tool.unwrap_or_default();
        let brush = brush.or_else(|| tool.is_brush().then(Brush::default));
        brush::check(tool, brush.as_ref()).map_err(|what| progress.malformed(what))?;
        Ok(DraftStroke { id, tool, points, brush })
    }
}
