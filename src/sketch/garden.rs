//! The garden around a drawn plant, as the artist paints it on the ground: beds of plants, paths, and what is cleared again.
//!
//! A garden is a plan seen from above, in metres: x to the right, y toward the viewer, the foot of the drawn plant at the origin, whatever
//! size the drawing has on its sheet. Later strokes lie over earlier ones.
//!
//! Limits: the ground is level; plants of a bed are the drawn one, of built-in species that make themselves, or of other drawings.

use super::brush::DENSITIES;
use super::garden_drawing::GardenDrawing;
use super::{Sketch, limits};
use crate::quote;
use glam::Vec2;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::sync::Arc;

/// Bytes that a number behind a drawing's name takes at most, with the space before it.
const NUMBER_BYTES: usize = 8;

/// Radii that strokes may have, metres.
pub const RADII: RangeInclusive<f32> = 0.01..=500.0;

/// What grows in a bed.
#[derive(Clone, Debug, PartialEq)]
pub enum GardenPlant {
    /// Copies of the drawn plant.
    Drawn,
    /// A built-in species that makes itself.
    Species {
        /// Its name.
        name: String,
        /// Age in years where it grows, from 0 to [`limits::MAX_PLANT_AGE`]; none for the species' own.
        age: Option<f32>,
    },
    /// Plants of another drawing.
    Drawing(GardenDrawing),
}

impl GardenPlant {
    /// Plants of a species in their usual age.
    pub fn species(name: &str) -> Self {
        Self::Species { name: name.to_owned(), age: None }
    }
}

/// What a stroke does to the ground.
#[derive(Clone, Debug, PartialEq)]
pub enum GardenTool {
    /// Plants grow there.
    Plants(GardenPlant),
    /// A path leads there.
    Path,
    /// Neither plants nor paths of earlier strokes stay there.
    Clear,
}

impl GardenTool {
    /// The name used in files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Plants(_) => "plants",
            Self::Path => "path",
            Self::Clear => "clear",
        }
    }
}

/// A sample of a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GardenPoint {
    /// Place on the plan, metres.
    pub at: Vec2,
    /// Pen pressure 0 to 1: plants stand as densely as the pen presses.
    pub pressure: f32,
}

/// One stroke over the ground. A tap with plants is a single plant.
#[derive(Clone, Debug, PartialEq)]
pub struct GardenStroke {
    /// What it does.
    pub tool: GardenTool,
    /// How far it reaches to either side, metres, in [`RADII`].
    pub radius: f32,
    /// How densely plants stand at neutral pressure, in [`DENSITIES`]; 1 has room for each.
    pub density: f32,
    /// Its samples, at least one.
    pub points: Vec<GardenPoint>,
}

/// All strokes of a garden, oldest first; shared, because drawings are copied with every sample of the pen.
pub type GardenStrokes = Arc<[Arc<GardenStroke>]>;

/// The drawings that strokes of a garden plant. One may come again.
pub(super) fn drawings_of(garden: &[Arc<GardenStroke>]) -> impl Iterator<Item = &GardenDrawing> {
    garden.iter().filter_map(|stroke| match &stroke.tool {
        GardenTool::Plants(GardenPlant::Drawing(drawing)) => Some(drawing),
        _ => None,
    })
}

/// The drawings that strokes of a garden plant, each once, by their names.
///
/// # Errors
/// The name that two different ones have.
pub fn named(garden: &[Arc<GardenStroke>]) -> Result<BTreeMap<&str, &GardenDrawing>, &str> {
    let mut all = BTreeMap::new();
    for drawing in drawings_of(garden) {
        if all.insert(drawing.name(), drawing).is_some_and(|known| known != drawing) {
            return Err(drawing.name());
        }
    }
    Ok(all)
}

/// The plant of a drawing that is to come into a garden: under its name, or with a number behind it where another has that name.
///
/// # Errors
/// As [`GardenDrawing::new`].
pub fn for_garden(
    garden: &[Arc<GardenStroke>],
    name: &str,
    sketch: &Sketch,
) -> Result<GardenDrawing, String> {
    // Of a long name the end makes room for the number: cut off, it would tell nothing apart.
    let room = limits::MAX_SPECIES_NAME_BYTES - NUMBER_BYTES;
    let begun = &name[..name.floor_char_boundary(room)];
    let mut drawing = GardenDrawing::new(name, sketch.clone())?;
    let is_free = |drawing: &GardenDrawing| {
        drawings_of(garden).all(|known| known.name() != drawing.name() || known == drawing)
    };
    for number in 2..=garden.len() + 2 {
        if is_free(&drawing) {
            break;
        }
        drawing = GardenDrawing::new(&format!("{begun} {number}"), sketch.clone())?;
    }
    Ok(drawing)
}

/// Checks that there are not too many strokes, and that each is possible.
///
/// # Errors
/// What is wrong, in words.
pub(super) fn check(strokes: &[Arc<GardenStroke>]) -> Result<(), String> {
    if strokes.len() > limits::MAX_GARDEN_STROKES {
        return Err(format!("a garden holds at most {} strokes", limits::MAX_GARDEN_STROKES));
    }
    let drawings = named(strokes).map_err(|name| {
        format!("two of its drawings are called `{}`; give each its own name", quote::name(name))
    })?;
    if drawings.len() > limits::MAX_GARDEN_DRAWINGS {
        return Err(format!("a garden holds at most {} other drawings", limits::MAX_GARDEN_DRAWINGS));
    }
    if strokes.iter().map(|stroke| stroke.points.len()).sum::<usize>() > limits::MAX_GARDEN_POINTS {
        return Err(format!(
            "the strokes of a garden have at most {} samples together",
            limits::MAX_GARDEN_POINTS
        ));
    }
    strokes.iter().zip(1..).try_for_each(|(stroke, number): (_, usize)| {
        check_one(stroke).map_err(|what| format!("garden stroke {number}: {what}"))
    })
}

fn check_one(GardenStroke { tool, radius, density, points }: &GardenStroke) -> Result<(), String> {
    if let GardenTool::Plants(GardenPlant::Species { name, age }) = tool {
        if name.is_empty() || name.len() > limits::MAX_SPECIES_NAME_BYTES {
            let name = quote::name(name);
            return Err(format!("`{name}` cannot name a species; write one of the built-in ones"));
        }
        if age.is_some_and(|age| !(0.0..=limits::MAX_PLANT_AGE).contains(&age)) {
            let oldest = limits::MAX_PLANT_AGE;
            return Err(format!("the `age` must be 0 to {oldest} years; leave it out for the usual"));
        }
    }
    // What is no number lies in no range.
    for (name, value, range) in [("radius", *radius, RADII), ("density", *density, DENSITIES)] {
        if !range.contains(&value) {
            let (from, to) = range.into_inner();
            return Err(format!("its `{name}` is {value}; it lies between {from} and {to}"));
        }
    }
    if points.is_empty() {
        return Err("it has no `points`; leave it out".to_owned());
    }
    let farthest = limits::MAX_GARDEN_METRES;
    let is_sound = |point: &GardenPoint| {
        point.at.abs().cmple(Vec2::splat(farthest)).all() && (0.0..=1.0).contains(&point.pressure)
    };
    match points.iter().position(|point| !is_sound(point)) {
        Some(at) => Err(format!(
            "its point {} is none: write metres from -{farthest} to {farthest} and a pressure from 0 to 1",
            at + 1
        )),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stroke(tool: GardenTool) -> GardenStroke {
        let points = vec![GardenPoint { at: Vec2::new(1.0, -2.0), pressure: 0.5 }];
        GardenStroke { tool, radius: 0.5, density: 1.0, points }
    }

    #[test]
    fn what_cannot_be_is_named_with_its_stroke() {
        let good = stroke(GardenTool::Path);
        let refused = |bad: GardenStroke| check(&[Arc::new(good.clone()), Arc::new(bad)]).unwrap_err();
        assert_eq!(check(&[Arc::new(good.clone())]), Ok(()));
        for (bad, part) in [
            (stroke(GardenTool::Plants(GardenPlant::species(""))), "species"),
            (
                stroke(GardenTool::Plants(GardenPlant::Species { name: "oak".into(), age: Some(-1.0) })),
                "`age`",
            ),
            (GardenStroke { radius: f32::NAN, ..good.clone() }, "`radius`"),
            (GardenStroke { density: 9.0, ..good.clone() }, "`density`"),
            (GardenStroke { points: Vec::new(), ..good.clone() }, "points"),
            (
                GardenStroke {
                    points: vec![GardenPoint { at: Vec2::X, pressure: f32::NAN }],
                    ..good.clone()
                },
                "point 1",
            ),
        ] {
            let message = refused(bad);
            assert!(message.starts_with("garden stroke 2: ") && message.contains(part), "{message}");
        }
        let many: Vec<_> = (0..=limits::MAX_GARDEN_STROKES).map(|_| Arc::new(good.clone())).collect();
        assert!(check(&many).unwrap_err().contains("at most"));
    }
}
