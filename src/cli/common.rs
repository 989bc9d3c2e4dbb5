//! What the building verbs share: opening a sketch, choosing species and parameters, reporting.

use crate::formats::write::{self, InstanceForm, PlantAndProvenance, Surfaces};
use crate::garden::Seen;
use crate::input::Sources;
use crate::model::Levels;
use crate::pipeline::{self, Built, Params};
use crate::sketch::{self, Sketch};
use crate::species::{self, Species};
use anyhow::Context;
use serde_json::{Map, Value, json};
use std::borrow::Cow;
use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Options of every verb that builds a plant from a sketch.
#[derive(Debug, clap::Args)]
pub struct BuildOptions {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub setup: SetupOptions,
    /// Print times, counts and bytes written as one JSON object.
    #[arg(long)]
    pub stats: bool,
}

/// Parameters by their paths, and by names of their own those that are wanted most.
#[derive(Debug, Default, clap::Args)]
pub struct Assignments {
    /// Any parameter by its path, for instance depth.world.height=0.4 or model.tube.sides=5; may be given again. `penstemon
    /// params [SPECIES]` lists them.
    #[arg(long = "set", value_name = "PARAM=VALUE")]
    set: Vec<String>,
    /// How many triangles the plant has, give or take three of a hundred: finer or coarser than usual, with fewer and larger leaves
    /// where it must.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(100..=10_000_000))]
    triangles: Option<u32>,
    /// Generated leaves with a rim, for printing, with faces that meet at the margin, which is usual, or as pictures of leafy shoots.
    #[arg(long, value_name = "FORM")]
    leaves: Option<Leaves>,
    /// Time of the year: a season, or a number from 0, when buds break, to 5, winter.
    #[arg(long, value_name = "TIME", value_parser = season_time)]
    season: Option<f32>,
}

/// The time of the year that a season's name or a number means.
fn season_time(text: &str) -> Result<f32, String> {
    let names = [("spring", 0.6), ("summer", 2.55), ("autumn", 4.0), ("winter", 5.0)];
    let named = names.iter().find(|(name, _)| *name == text).map(|(_, time)| *time);
    let time = named.or_else(|| text.parse().ok()).filter(|time| (0.0..=5.0).contains(time));
    time.ok_or_else(|| "write spring, summer, autumn, winter or a number from 0 to 5".to_owned())
}

/// How generated leaves are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Leaves {
    /// As thick at the margin as printers want it.
    Solid,
    /// Both faces meet at the margin.
    Blade,
    /// Shoots with their leaves as pictures on rectangles, for games and for what is far away.
    Card,
}

impl Assignments {
    /// Parameters by their paths, as `PARAM=VALUE`.
    pub fn of(set: Vec<String>) -> Self {
        Self { set, ..Self::default() }
    }

    /// All of them as `PARAM=VALUE`.
    pub fn all(&self) -> Vec<String> {
        let triangles = self.triangles.map(|triangles| format!("model.budget.triangles={triangles}"));
        let leaves = self.leaves.into_iter().flat_map(|leaves| {
            let is = |form: Leaves| leaves == form;
            [
                format!("model.blade.solid_leaves={}", is(Leaves::Solid)),
                format!("cards.used={}", is(Leaves::Card)),
            ]
        });
        // Who names a form wants that form, however few triangles there are.
        let leaves = leaves.chain(self.leaves.map(|_| "cards.below=0".to_owned()));
        let season = self.season.map(|time| format!("season.time={time}"));
        self.set.iter().cloned().chain(triangles).chain(leaves).chain(season).collect()
    }
}

/// Options of every verb that sets up a sketch for building.
#[derive(Debug, clap::Args)]
pub struct SetupOptions {
    /// Species: a built-in name or a species file; instead of the sketch's own.
    #[arg(long, value_name = "SPECIES")]
    pub species: Option<String>,
    /// Seed of everything random; instead of the sketch's own.
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub assignments: Assignments,
    /// Your own picture for a part, for instance petal=photo.jpg; may be given again.
    #[arg(long = "texture", value_name = "PART=FILE")]
    pub textures: Vec<String>,
}

impl SetupOptions {
    /// The options that were given, as they are typed.
    pub fn given(&self) -> Vec<&'static str> {
        let Self { species, seed, assignments, textures } = self;
        let options = [
            ("--species", species.is_some()),
            ("--seed", seed.is_some()),
            ("--set", !assignments.set.is_empty()),
            ("--triangles", assignments.triangles.is_some()),
            ("--leaves", assignments.leaves.is_some()),
            ("--texture", !textures.is_empty()),
        ];
        options.into_iter().filter(|(_, given)| *given).map(|(name, _)| name).collect()
    }
}

/// Reads a sketch, and lists the files that it is made from; warnings go to stderr.
///
/// # Errors
/// A sketch that cannot be used.
pub fn open_sketch(path: &Path) -> anyhow::Result<(Sketch, Sources)> {
    let (mut sketch, warnings) = sketch::read(path)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut sources = Sources::default();
    sources.add(path);
    species::textures::files(&sketch.textures, folder).for_each(|picture| sources.add(&picture));
    let pictures = species::textures::take_in(&mut sketch.textures, folder);
    for warning in warnings.iter().chain(&pictures) {
        tracing::warn!("{}: {warning}", path.display());
    }
    Ok((sketch, sources))
}

/// A sketch with all that is needed to build it.
pub struct Setup {
    /// The drawing.
    pub sketch: Sketch,
    /// Its species.
    pub species: Species,
    /// Its parameters.
    pub params: Params,
    /// The files that all of these come from.
    pub sources: Sources,
}

impl Setup {
    /// Reads a sketch and applies the options; warnings go to stderr.
    ///
    /// # Errors
    /// A sketch, species, parameter or picture that cannot be used.
    pub fn open(path: &Path, options: &SetupOptions) -> anyhow::Result<Self> {
        let (mut sketch, mut sources) = open_sketch(path)?;
        sketch.seed = options.seed.unwrap_or(sketch.seed);
        let mut folder = path.parent().unwrap_or(Path::new(""));
        let mut whose = path.display().to_string();
        if options.species.is_some() {
            sketch.species.clone_from(&options.species);
            (folder, whose) = (Path::new(""), "--species".to_owned());
        }
        if sketch.species.is_none() {
            sketch.species = Some(pipeline::usual_species(&sketch, &options.assignments.all()).to_owned());
        }
        // What the command line names has to be there.
        let mut species = if options.species.is_some() {
            pipeline::species_of(&sketch, folder).context(whose)?
        } else {
            let (species, missing) = pipeline::species_or_usual(&sketch, folder).context(whose)?;
            missing.iter().for_each(|missing| tracing::warn!("{}: {missing}", path.display()));
            species
        };
        pipeline::species_file(&sketch, folder).iter().for_each(|file| sources.add(file));
        for assignment in &options.textures {
            let (part, file) = assignment
                .split_once('=')
                .with_context(|| format!("--texture {assignment}: write it as PART=FILE"))?;
            species.set_texture(part, Path::new(file))?;
            sources.add(Path::new(file));
        }
        species.picture_files().for_each(|picture| sources.add(picture));
        let params = pipeline::params_of(&sketch, &species, &options.assignments.all())
            .with_context(|| path.display().to_string())?;
        Ok(Self { sketch, species, params, sources })
    }

    /// Builds the plant; remarks about odd strokes go to stderr.
    pub fn build(&self, path: &Path) -> Built {
        let built = pipeline::build(&self.sketch, &self.species, &self.params);
        for warning in &built.remarks {
            tracing::warn!("{}: {warning}", path.display());
        }
        for (stage, time) in &built.stages {
            tracing::debug!("{}: {stage} took {:.1} ms", path.display(), time.as_secs_f64() * 1e3);
        }
        built
    }
}

/// How a GLB file has leaves and petals that are copies of one shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Instances {
    /// A node for each, which share a mesh; every program reads it.
    Nodes,
    /// The extension `EXT_mesh_gpu_instancing`, smaller still; not every program reads it.
    Gpu,
}

impl Instances {
    /// As exporters name it.
    pub(super) fn form(self) -> InstanceForm {
        match self {
            Self::Nodes => InstanceForm::Nodes,
            Self::Gpu => InstanceForm::Gpu,
        }
    }
}

/// Writes a plant in several formats, GLB with instances where they are asked for; returns the number of bytes.
///
/// # Errors
/// A file that cannot be written.
pub fn export(
    outs: &[PathBuf],
    (plant, surfaces): (PlantAndProvenance<'_>, Surfaces<'_>),
    instances: Option<Instances>,
    sources: &Sources,
) -> anyhow::Result<usize> {
    let form = instances.map(Instances::form);
    Ok(write::export_all(outs, surfaces, plant, &built_in_texture, form, sources)?)
}

/// Writes the levels of detail of a plant into one GLB file, or several such files; returns the number of bytes.
///
/// # Errors
/// A file that cannot be written.
pub fn export_levels(
    outs: &[PathBuf],
    (plant, levels): (PlantAndProvenance<'_>, &Levels),
    instances: Option<Instances>,
    sources: &Sources,
) -> anyhow::Result<usize> {
    let Levels { model, of_specimen } = levels;
    export(outs, (plant, Surfaces { level_of_specimen: of_specimen, ..model.into() }), instances, sources)
}

/// The program's own textures, for exporters and renderers.
pub fn built_in_texture(name: &str) -> Option<Cow<'static, [u8]>> {
    species::builtin_texture(name).map(Cow::Borrowed)
}

/// Time that each stage took, in order.
pub type Stages = Vec<(&'static str, Duration)>;

/// The `--stats` object; `bytes` is the size of what was written.
pub fn stats<'s>(stages: &Stages, seen: impl Into<Seen<'s>>, bytes: usize) -> Value {
    let [vertices, triangles] = seen.into().counts();
    let ms = |d: Duration| (d.as_secs_f64() * 1e6).round() / 1e3;
    let per_stage: Map<String, Value> =
        stages.iter().map(|&(name, time)| (name.to_owned(), ms(time).into())).collect();
    json!({
        "total_ms": ms(stages.iter().map(|s| s.1).sum()),
        "stages": per_stage,
        "vertices": vertices,
        "triangles": triangles,
        "bytes": bytes,
    })
}

/// Writes text to stdout; a reader that went away is no error.
///
/// # Errors
/// A stdout that cannot be written for another reason.
pub fn print(text: &str) -> anyhow::Result<()> {
    match writeln!(std::io::stdout(), "{text}") {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => Err(e).context("cannot write to stdout"),
        _ => Ok(()),
    }
}

/// `plant.png` becomes `plant-007.png`: one of many files.
pub fn numbered(path: &Path, number: usize) -> PathBuf {
    let mut name = path.file_stem().map(OsString::from).unwrap_or_default();
    name.push(format!("-{number:03}."));
    name.push(path.extension().unwrap_or("png".as_ref()));
    path.with_file_name(name)
}

/// The time of the year at which a year ends.
const WINTER: f32 = 5.0;

/// The time of the year at which frames over a year end: one that was asked for, or else winter.
pub(super) fn last_season(species: &Species, params: &Params) -> f32 {
    let is_asked_for = params.season.time != species.season.time;
    if is_asked_for { params.season.time } else { WINTER }
}

/// A place on a photograph, `X,Y` in pixels.
pub(super) fn place(text: &str) -> Result<glam::Vec2, String> {
    let numbers = text.split_once(',').map(|(x, y)| [x, y].map(|n| n.trim().parse::<f32>()));
    match numbers {
        Some([Ok(x), Ok(y)]) if x.is_finite() && y.is_finite() => Ok(glam::Vec2::new(x, y)),
        _ => Err("write it as X,Y, for instance 320,610.5".to_owned()),
    }
}

/// A number with three decimals.
pub(super) fn rounded(number: f64) -> Value {
    ((number * 1e3).round() / 1e3).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_of_many_files_is_numbered_before_the_ending() {
        assert_eq!(numbered(Path::new("out/plant.png"), 7), Path::new("out/plant-007.png"));
        assert_eq!(numbered(Path::new("plant"), 12), Path::new("plant-012.png"));
    }

    #[test]
    fn places_are_two_numbers() {
        assert_eq!(place("3, 4.5"), Ok(glam::Vec2::new(3.0, 4.5)));
        for text in ["", "3", "3,", "x,4", "nan,2", "1,2,3"] {
            assert!(place(text).is_err(), "{text}");
        }
    }
}
