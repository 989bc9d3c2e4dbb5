//! `penstemon inspect SKETCH`: what the analysis understood, as JSON.

use super::common::{self, Setup, SetupOptions};
use super::depth_pictures;
use crate::anatomy::conventions::ReadStrokes;
use crate::anatomy::{Anatomy, Attachment, FlatBlade, Part};
use crate::plant::{Plant, Provenance};
use crate::sketch::{Maker, PlacedPlant, Remark, SeedOf, StrokeId, Warning};
use crate::{anatomy, depth};
use glam::Vec2;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;

/// Most strokes of a reading that a message names.
const NAMED: usize = 12;

/// Arguments of `inspect`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The drawing: .penstemon or .svg.
    pub sketch: PathBuf,
    /// Write what the network of learned depth sees of the drawing and what it answers, as PNG pictures of 16 bits, into a folder.
    #[arg(long, value_name = "DIR")]
    pub depth: Option<PathBuf>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub options: SetupOptions,
}

/// What the analysis understood of a drawing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Every stroke, in drawing order.
    pub strokes: Vec<StrokeReport>,
    /// Flowers.
    pub flowers: Vec<FlowerReport>,
    /// What outlines were filled with.
    pub generated: Generated,
    /// Strokes that were read together, or that are several parts; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub readings: Vec<ReadingReport>,
    /// Plants beside the drawn one; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub plants: Vec<PlantReport>,
}

/// One stroke.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StrokeReport {
    /// The stroke's id.
    pub id: StrokeId,
    /// What it is.
    pub part: Part,
    /// Index of the flower it belongs to.
    pub flower: Option<usize>,
    /// Stroke of the branch that carries it.
    pub parent: Option<StrokeId>,
    /// Level in the branch hierarchy; branches only.
    pub level: Option<u32>,
    /// Where it is attached, canvas pixels; its first point where it has no root.
    pub root: Option<[f32; 2]>,
    /// Its far end, canvas pixels.
    pub tip: Option<[f32; 2]>,
    /// How sure the classification is, 0 to 1.
    pub confidence: f32,
}

/// Strokes that were read together, or one that is several parts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReadingReport {
    /// What they were read as.
    pub reading: &'static str,
    /// The strokes, in drawing order.
    pub strokes: Vec<StrokeId>,
    /// How many parts they became, by what these are; none where they are no part of the plant.
    pub parts: BTreeMap<&'static str, usize>,
}

/// One flower.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FlowerReport {
    /// Strokes of its petals.
    pub petals: Vec<StrokeId>,
    /// Mean of the petals' roots, canvas pixels.
    pub center: [f32; 2],
    /// Unit direction of the flower: x right, y up, z toward the viewer.
    pub axis: [f32; 3],
    /// Angle between axis and petals, degrees.
    pub opening_deg: f32,
    /// Height of the petals' cone, canvas pixels.
    pub cone_height: f32,
}

/// What outlines were filled with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Generated {
    /// Twigs.
    pub branches: usize,
    /// Leaves.
    pub leaves: usize,
}

/// One plant beside the drawn one, as its file says it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlantReport {
    /// What makes it.
    pub maker: &'static str,
    /// Its species.
    pub species: String,
    /// Its seed.
    pub seed: u64,
    /// Age in years; none for the species' own.
    pub age: Option<f32>,
    /// Where it stands, canvas pixels.
    pub foot: [f32; 2],
    /// Height of its wood, canvas pixels; none for its own height in metres.
    pub height: Option<f32>,
}

impl PlantReport {
    fn new(plant: &PlacedPlant) -> Self {
        let PlacedPlant { maker, foot, height } = plant;
        let Maker::Growth(SeedOf { species, seed, age }) = maker;
        let (maker, foot) = (maker.name(), foot.to_array());
        Self { maker, species: species.clone(), seed: *seed, age: *age, foot, height: *height }
    }
}

/// Runs `inspect`.
///
/// # Errors
/// A drawing that cannot be read.
pub fn run(args: &Args) -> anyhow::Result<ExitCode> {
    let setup = Setup::open(&args.sketch, &args.options)?;
    let anatomy = anatomy::analyse(&setup.sketch, &setup.params.anatomy);
    let (plant, provenance) = depth::recover(&anatomy, setup.sketch.seed, &setup.params.depth);
    for read in &anatomy.readings {
        tracing::warn!("{}: {}: {}", args.sketch.display(), named(&read.strokes), read.reading);
    }
    let is_reading = |warning: &&Warning| matches!(warning.remark, Remark::ReadAs(_));
    for warning in anatomy.warnings.iter().filter(|warning| !is_reading(warning)) {
        tracing::warn!("{}: {warning}", args.sketch.display());
    }
    if let Some(folder) = &args.depth {
        depth_pictures::write(folder, &setup, &anatomy)?;
    }
    common::print(&serde_json::to_string_pretty(&report(&setup.sketch, &anatomy, (&plant, &provenance)))?)?;
    Ok(ExitCode::SUCCESS)
}

/// Strokes as messages name them: all of a few, of many the first and how many more.
fn named(strokes: &[StrokeId]) -> String {
    let names: Vec<String> = strokes.iter().take(NAMED).map(StrokeId::to_string).collect();
    let names = names.join(", ");
    match strokes.len() {
        1 => format!("stroke {names}"),
        count if count <= NAMED => format!("strokes {names} together"),
        count => format!("strokes {names} and {} more together", count - NAMED),
    }
}

/// What is known of a stroke besides its mark.
#[derive(Clone, Copy, Default)]
struct Known {
    flower: Option<usize>,
    parent: Option<StrokeId>,
    level: Option<u32>,
    ends: Option<(Vec2, Vec2)>,
}

/// The report on an analysed drawing and the plant it became.
pub fn report(
    sketch: &crate::sketch::Sketch,
    anatomy: &Anatomy,
    (plant, provenance): (&Plant, &Provenance),
) -> Report {
    let known = known_strokes(anatomy);
    let strokes = anatomy.marks.iter().zip(&sketch.strokes).map(|(mark, stroke)| {
        let known = known.get(&mark.stroke).copied().unwrap_or_default();
        let drawn = stroke.points.first().zip(stroke.points.last()).map(|(a, b)| (a.position, b.position));
        let ends = known.ends.or(drawn);
        StrokeReport {
            id: mark.stroke,
            part: mark.part,
            flower: known.flower,
            parent: known.parent,
            level: known.level,
            root: ends.map(|(root, _)| root.to_array()),
            tip: ends.map(|(_, tip)| tip.to_array()),
            confidence: mark.confidence,
        }
    });
    let scale = provenance.world_from_canvas.scale;
    let flowers = anatomy.flowers.iter().zip(&plant.flowers).map(|(flat, flower)| FlowerReport {
        petals: flat.petals.iter().filter_map(|&p| anatomy.petals[p].stroke).collect(),
        center: flat.center.to_array(),
        axis: flower.cone.axis.to_array(),
        opening_deg: flower.cone.opening_rad.to_degrees(),
        cone_height: flower.cone.height / scale,
    });
    Report {
        strokes: strokes.collect(),
        flowers: flowers.collect(),
        generated: Generated {
            branches: anatomy.branches.iter().filter(|b| b.stroke.is_none()).count(),
            leaves: anatomy.leaves.iter().filter(|l| l.copy_of.is_some()).count(),
        },
        readings: anatomy.readings.iter().map(|read| reading(anatomy, read)).collect(),
        plants: sketch.plants.iter().map(PlantReport::new).collect(),
    }
}

fn reading(anatomy: &Anatomy, read: &ReadStrokes) -> ReadingReport {
    let of_it =
        |stroke: StrokeId| anatomy.pieces.get(&stroke).is_some_and(|piece| piece.strokes == read.strokes);
    let count =
        |strokes: &mut dyn Iterator<Item = Option<StrokeId>>| strokes.flatten().filter(|s| of_it(*s)).count();
    let bodies = anatomy.solids.iter().filter(|drawn| read.strokes.first() == Some(&drawn.stroke)).count();
    let counts = [
        ("branches", count(&mut anatomy.branches.iter().map(|branch| branch.stroke))),
        ("leaves", count(&mut anatomy.leaves.iter().map(|leaf| leaf.stroke))),
        ("petals", count(&mut anatomy.petals.iter().map(|petal| petal.stroke))),
        ("crowns", count(&mut anatomy.crowns.iter().map(|crown| Some(crown.stroke)))),
        ("bodies", bodies),
    ];
    let parts = counts.into_iter().filter(|(_, count)| *count > 0).collect();
    ReadingReport { reading: read.reading.name(), strokes: read.strokes.clone(), parts }
}

fn known_strokes(anatomy: &Anatomy) -> BTreeMap<StrokeId, Known> {
    let parent_of = |place: Option<Attachment>| place.and_then(|p| anatomy.branches[p.branch].stroke);
    let blade = |b: &FlatBlade, place, flower| Known {
        flower,
        parent: parent_of(place),
        level: None,
        ends: Some((b.root, b.tip)),
    };
    let branches = anatomy.branches.iter().filter_map(|b| {
        let ends = b.line.first().zip(b.line.last()).map(|(a, z)| (a.position, z.position));
        let parent = b.parent.and_then(|p| anatomy.branches[p].stroke);
        Some((b.stroke?, Known { flower: None, parent, level: Some(b.level), ends }))
    });
    let leaves = anatomy.leaves.iter().filter_map(|l| Some((l.stroke?, blade(l, l.attachment, None))));
    let petals = anatomy.flowers.iter().enumerate().flat_map(|(index, flower)| {
        let members = flower.petals.iter().map(|&p| &anatomy.petals[p]);
        members.filter_map(move |p| Some((p.stroke?, blade(p, flower.attachment, Some(index)))))
    });
    branches.chain(leaves).chain(petals).collect()
}
