//! A step as one line of JSON, for the journal: which places changed and what lies there after.
//!
//! ```json
//! {"strokes": [{"at": 4, "insert": {"id": 9, "tool": "petal", "points": [[1, 2], [3, 4]]}}, {"at": 0, "remove": true, "id": 2}], "seed": 3}
//! ```
//!
//! What was before is not written: whoever replays has it. Textures and a reference name their pictures by their hash.

use super::corrections::{self, CorrectionList};
use super::garden::{self, GardenText};
use super::parse::StrokeSeed;
use super::part_poses::{self, PartPoseList};
use super::petal_shapes::{self, PetalShapeList};
use super::plants::{self, Plants};
use super::progress::Progress;
use super::write::{push_placement, push_stroke};
use crate::sketch::garden::drawings_of;
use crate::sketch::garden_drawing::GardenDrawing;
use crate::sketch::invariants::check_stroke;
use crate::sketch::settings::Settings;
use crate::sketch::step::{Step, Swap};
use crate::sketch::textures::{self, ChoiceText};
use crate::sketch::{Canvas, Picture, Reference, Sketch, Stroke, StrokeId};
use glam::Vec2;
use serde::de::{DeserializeSeed, Deserializer, Error};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::sync::Arc;

/// What steps name by its hash.
#[derive(Default)]
pub(in crate::sketch) struct Known {
    /// Pictures.
    pub(in crate::sketch) pictures: BTreeMap<u64, Picture>,
    /// Drawings that a garden has plants of.
    pub(in crate::sketch) drawings: BTreeMap<u64, GardenDrawing>,
}

impl Known {
    /// What a sketch has of it.
    pub(in crate::sketch) fn of(sketch: &Sketch) -> Self {
        let mut known = Self::default();
        sketch.pictures().cloned().for_each(|picture| known.add_picture(picture));
        drawings_of(&sketch.garden).cloned().for_each(|drawing| known.add_drawing(drawing));
        known
    }

    pub(in crate::sketch) fn add_picture(&mut self, picture: Picture) {
        self.pictures.insert(picture.hash(), picture);
    }

    pub(in crate::sketch) fn add_drawing(&mut self, drawing: GardenDrawing) {
        self.drawings.insert(drawing.hash(), drawing);
    }
}

/// The step as text.
pub(in crate::sketch) fn write(step: &Step) -> String {
    let mut out = String::with_capacity(64 + 24 * step.samples());
    out.push_str("{\"strokes\": [");
    for (i, Swap { at, before, after }) in step.strokes.iter().enumerate() {
        let (comma, verb) =
            (if i == 0 { "" } else { ", " }, if before.is_some() { "replace" } else { "insert" });
        out.push_str(&format!("{comma}{{\"at\": {at}, "));
        match after {
            Some(stroke) => {
                out.push_str(&format!("\"{verb}\": "));
                push_stroke(&mut out, stroke);
            }
            None => {
                out.push_str("\"remove\": true");
                push_field(&mut out, "id", &before.as_ref().map(|stroke| stroke.id));
            }
        }
        out.push('}');
    }
    out.push(']');
    let Settings {
        canvas,
        species,
        seed,
        params,
        textures,
        reference,
        plants,
        corrections,
        petal_shapes,
        part_poses,
        garden,
    } = &step.after;
    push_field(&mut out, "canvas", canvas);
    push_field(&mut out, "species", species);
    push_field(&mut out, "seed", seed);
    push_field(&mut out, "params", params);
    push_field(&mut out, "textures", &textures.as_ref().map(|textures| textures::named(textures).0));
    push_list(&mut out, "plants", plants.as_deref(), plants::push);
    push_list(&mut out, "corrections", corrections.as_deref(), corrections::push);
    push_list(&mut out, "petal_shapes", petal_shapes.as_deref(), petal_shapes::push);
    push_list(&mut out, "wood_poses", part_poses.as_deref(), part_poses::push);
    let by_hash = |drawing: &GardenDrawing| format!("{:016x}", drawing.hash());
    push_list(&mut out, "garden", garden.as_deref(), |out, stroke| garden::push(out, stroke, by_hash));
    match reference {
        None => {}
        Some(None) => out.push_str(", \"reference\": null"),
        Some(Some(reference)) => {
            out.push_str(", \"reference\": {");
            push_placement(&mut out, reference);
            out.push_str(&format!(", \"picture\": {}}}", reference.picture.hash()));
        }
    }
    out.push('}');
    out
}

fn push_field(out: &mut String, name: &str, value: &Option<impl Serialize>) {
    if let Some(value) = value {
        out.push_str(&format!(", \"{name}\": {}", json!(value)));
    }
}

fn push_list<T>(out: &mut String, name: &str, items: Option<&[T]>, push: impl Fn(&mut String, &T)) {
    let Some(items) = items else { return };
    out.push_str(&format!(", \"{name}\": ["));
    for (i, item) in items.iter().enumerate() {
        out.push_str(if i == 0 { "" } else { ", " });
        push(out, item);
    }
    out.push(']');
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StepText {
    #[serde(default)]
    strokes: Vec<SwapText>,
    canvas: Option<Canvas>,
    #[serde(default, deserialize_with = "given")]
    species: Option<Option<String>>,
    seed: Option<u64>,
    params: Option<Map<String, Value>>,
    textures: Option<BTreeMap<String, ChoiceText>>,
    plants: Option<Plants>,
    corrections: Option<CorrectionList>,
    petal_shapes: Option<PetalShapeList>,
    #[serde(rename = "wood_poses")]
    part_poses: Option<PartPoseList>,
    garden: Option<GardenText>,
    #[serde(default, deserialize_with = "given")]
    reference: Option<Option<ReferenceText>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SwapText {
    at: usize,
    insert: Option<StrokeText>,
    replace: Option<StrokeText>,
    #[serde(default)]
    remove: bool,
    /// Of the stroke that is removed; steps of old journals do not say it.
    id: Option<StrokeId>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ReferenceText {
    center: [f32; 2],
    width: f32,
    rotation_deg: f32,
    opacity: f32,
    locked: bool,
    visible: bool,
    picture: u64,
}

/// Tells `null` from a field that is not there.
fn given<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

struct StrokeText(Arc<Stroke>);

impl<'de> Deserialize<'de> for StrokeText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let draft = StrokeSeed(&Progress::default()).deserialize(deserializer)?;
        let id = draft.id.ok_or_else(|| D::Error::missing_field("id"))?;
        let stroke = Stroke { id, tool: draft.tool, points: draft.points, brush: draft.brush };
        check_stroke(&stroke).map_err(D::Error::custom)?;
        Ok(Self(Arc::new(stroke)))
    }
}

/// How a step finds the strokes that it changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::sketch) enum Fit {
    /// By their places: the sketch is the one that the step was made for.
    Exact,
    /// By their names: steps before this one are missing. What is to be removed and has no name stays.
    ByName,
}

/// Carries out the step that `text` holds.
///
/// # Errors
/// Text that is no step or does not fit the sketch, in words; the sketch is as it was then.
pub(in crate::sketch) fn replay(
    text: &[u8],
    sketch: &mut Sketch,
    known: &Known,
    fit: Fit,
) -> Result<(), String> {
    let text: StepText = serde_json::from_slice(text).map_err(|e| e.to_string())?;
    let reference = match text.reference {
        None => None,
        Some(None) => Some(None),
        Some(Some(reference)) => Some(Some(Arc::new(found_reference(reference, &known.pictures)?))),
    };
    let picture = |name: &str| known.pictures.get(&u64::from_str_radix(name, 16).ok()?).cloned();
    let textures = text.textures.map(|choices| textures::resolved(choices, picture)).transpose()?;
    let drawing = |name: &str| known.drawings.get(&u64::from_str_radix(name, 16).ok()?).cloned();
    let garden = text.garden.map(|garden| garden.resolved(drawing)).transpose()?;
    let mut done = Step::default();
    for swap in text.strokes {
        let swap = match fit {
            Fit::Exact => Some(swap),
            Fit::ByName => swap.by_name(&sketch.strokes),
        };
        let Some(swap) = swap else { continue };
        let fits = carry_out(swap, &mut sketch.strokes).map(|swap| done.strokes.push(swap));
        if fits.is_none() {
            done.reversed().carry_out(sketch);
            return Err("it changes a stroke that is not there".to_owned());
        }
    }
    let StepText { canvas, species, seed, params, plants, corrections, petal_shapes, part_poses, .. } = text;
    let (plants, corrections) = (plants.map(|plants| plants.0), corrections.map(|list| list.0));
    let (petal_shapes, part_poses) = (petal_shapes.map(|list| list.0), part_poses.map(|list| list.0));
    let settings = Settings {
        canvas,
        species,
        seed,
        params,
        textures,
        reference,
        plants,
        corrections,
        petal_shapes,
        part_poses,
        garden,
    };
    settings.carry_out(sketch);
    Ok(())
}

impl SwapText {
    /// The same change to the stroke of the same name, wherever it lies; a stroke that is not there yet comes near its place.
    /// Nothing for one that is to be removed and is not there, or has no name.
    fn by_name(mut self, strokes: &[Arc<Stroke>]) -> Option<Self> {
        let name = self.insert.as_ref().or(self.replace.as_ref()).map(|stroke| stroke.0.id).or(self.id);
        match name.and_then(|name| strokes.iter().position(|stroke| stroke.id == name)) {
            Some(at) => {
                self.at = at;
                self.replace = self.insert.take().or(self.replace);
            }
            None if self.remove => return None,
            None => {
                self.at = self.at.min(strokes.len());
                self.insert = self.replace.take().or(self.insert);
            }
        }
        Some(self)
    }
}

fn carry_out(text: SwapText, strokes: &mut Vec<Arc<Stroke>>) -> Option<Swap> {
    let SwapText { at, insert, replace, remove, id } = text;
    let (is_new, after) = match (insert, replace, remove) {
        (Some(stroke), None, false) => (true, Some(stroke.0)),
        (None, Some(stroke), false) => (false, Some(stroke.0)),
        (None, None, true) => (false, None),
        _ => return None,
    };
    let before = if is_new { None } else { Some(strokes.get(at)?.clone()) };
    if remove && id.is_some() && id != before.as_ref().map(|stroke| stroke.id) {
        return None;
    }
    let swap = Swap { at, before, after };
    swap.carry_out(strokes).then_some(swap)
}

fn found_reference(text: ReferenceText, pictures: &BTreeMap<u64, Picture>) -> Result<Reference, String> {
    let ReferenceText { center, width, rotation_deg, opacity, locked, visible, picture } = text;
    let picture = pictures.get(&picture).cloned().ok_or("the reference picture is missing")?;
    let center = Vec2::from(center);
    let reference = Reference { picture, center, width, rotation_deg, opacity, locked, visible };
    reference.check().map_err(|fault| fault.to_string())?;
    Ok(reference)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::{
        Correction, Maker, PetalShape, PlacedPlant, Reading, SeedOf, StrokePoint, Tool, Verdict,
    };
    use glam::Vec3;

    fn stroke(id: u64) -> Arc<Stroke> {
        let points = [[0.5, 1e-7], [3.0, -4.25]].map(|p| StrokePoint::at(p.into())).to_vec();
        Arc::new(Stroke { id, tool: Tool::BranchOutline, points, brush: None })
    }

    #[test]
    fn a_step_and_its_reverse_are_replayed_exactly() {
        let start = Sketch { strokes: vec![stroke(1), stroke(2), stroke(3)], ..Sketch::empty() };
        let swap = |at, before, after| Swap { at, before, after };
        let strokes = vec![
            swap(1, Some(stroke(2)), None),
            swap(0, Some(stroke(1)), Some(stroke(9))),
            swap(2, None, Some(stroke(4))),
        ];
        let maker = Maker::Growth(SeedOf { species: "oak".into(), seed: u64::MAX, age: Some(0.1) });
        let plants = vec![PlacedPlant { maker, foot: Vec2::new(-3.25, 1e6), height: Some(0.3) }];
        let species = Some(Some("a \"b\"".into()));
        let verdicts = [Verdict::Not(Reading::Tree), Verdict::As(Reading::Pot), Verdict::Separate];
        let corrections = Some(verdicts.map(|verdict| Correction::new([3, 1], verdict)).into());
        let offsets = [[Vec3::new(0.1, -1e-7, 2.0); 4]; 4];
        let petal_shapes = Some([PetalShape::new([5, 2], offsets)].into());
        let plants = Some(plants);
        let new =
            Settings { seed: Some(7), species, plants, corrections, petal_shapes, ..Settings::default() };
        let (before, after) = new.against(&start);
        let step = Step { strokes, before, after };
        let mut expected = start.clone();
        step.carry_out(&mut expected);
        let mut replayed = start.clone();
        replay(write(&step).as_bytes(), &mut replayed, &Known::default(), Fit::Exact).unwrap();
        assert_eq!(replayed, expected);
        replay(write(&step.reversed()).as_bytes(), &mut replayed, &Known::default(), Fit::Exact).unwrap();
        assert_eq!(replayed, start);
    }

    #[test]
    fn a_step_after_a_missing_one_finds_its_strokes_by_name() {
        let names = |sketch: &Sketch| sketch.strokes.iter().map(|stroke| stroke.id).collect::<Vec<_>>();
        let swap = |at, before, after| Swap { at, before, after };
        // Made for the strokes 1 to 5, of which 2 is missing.
        let strokes = vec![
            swap(3, Some(stroke(4)), Some(stroke(4))),
            swap(1, Some(stroke(2)), None),
            swap(1, Some(stroke(3)), None),
            swap(4, None, Some(stroke(9))),
            swap(1, None, Some(stroke(2))),
        ];
        let step = write(&Step { strokes, ..Step::default() });
        let mut sketch = Sketch { strokes: [1, 3, 4, 5].map(stroke).to_vec(), ..Sketch::empty() };
        assert!(replay(step.as_bytes(), &mut sketch.clone(), &Known::default(), Fit::Exact).is_err());
        replay(step.as_bytes(), &mut sketch, &Known::default(), Fit::ByName).unwrap();
        assert_eq!(names(&sketch), [1, 2, 4, 5, 9]);
        // Of what has no name nobody knows what it was.
        let nameless = br#"{"strokes": [{"at": 0, "remove": true}], "seed": 5}"#;
        replay(nameless, &mut sketch, &Known::default(), Fit::ByName).unwrap();
        assert_eq!((names(&sketch), sketch.seed), (vec![1, 2, 4, 5, 9], 5));
    }

    #[test]
    fn text_that_does_not_fit_changes_nothing() {
        let start = Sketch { strokes: vec![stroke(1)], ..Sketch::empty() };
        let good = r#"{"at": 0, "remove": true}"#;
        let points = r#""points": [[1, 2], [3, 4]]"#;
        for bad in [
            "{".to_owned(),
            r#"{"strokes": [], "sheet": 1}"#.to_owned(),
            format!(r#"{{"strokes": [{good}, {good}]}}"#),
            format!(r#"{{"strokes": [{good}, {{"at": 5, "insert": {{"id": 2, {points}}}}}]}}"#),
            format!(r#"{{"strokes": [{good}, {{"at": 0}}]}}"#),
            format!(r#"{{"strokes": [{good}, {{"at": 0, "insert": {{{points}}}}}]}}"#),
            format!(r#"{{"strokes": [{good}, {{"at": 0, "insert": {{"id": 2, "points": []}}}}]}}"#),
            format!(r#"{{"strokes": [{good}, {{"at": 0, "insert": {{"id": 2, "points": [[1e9, 0]]}}}}]}}"#),
            r#"{"plants": [{"maker": "growth", "species": "oak", "foot": [0, 1e9]}]}"#.to_owned(),
            r#"{"reference": {"center": [0, 0], "width": 1, "rotation_deg": 0, "opacity": 1, "locked": true, "visible": true, "picture": 3}}"#.to_owned(),
        ] {
            let mut sketch = start.clone();
            assert!(replay(bad.as_bytes(), &mut sketch, &Known::default(), Fit::Exact).is_err(), "{bad}");
            assert_eq!(sketch, start, "{bad}");
        }
    }
}
