//! From a sketch to a model: every stage in a row.
//!
//! The one place that knows the order of the stages, and how a species file, a sketch file and the command line lay
//! their parameters over each other. In memory only: reading and writing files are the callers'.

mod growing;

pub use growing::Ages;

use crate::anatomy::{self, Anatomy, AnatomyParams};
use crate::budget::Budget;
use crate::depth::{self, DepthParams};
use crate::growth::habit::CrownHabit;
use crate::growth::overlay::{Spot, Wanted};
use crate::growth::{
    self, Envelope, Field, GrowthParams, Habit, Limits, Memory, Outcome, Schedule, Simulation, bloom,
    drawing, foliage,
};
use crate::model::{self, Model, ModelParams};
use crate::params::{Description, Overrides, ParamError, Parameters as _};
use crate::plant::{FinishedPlant, Plant};
use crate::quote;
use crate::sketch::species_file::{find, is_file, own_name};
use crate::sketch::{Remark, Sketch, Warning};
use crate::species::{self, Applied, Species, SpeciesError};
use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use thiserror::Error;

/// Species of a sketch that names none.
pub const DEFAULT_SPECIES: &str = "plant";

crate::parameter_groups! {
    /// Every parameter of the way from drawing to model.
    pub struct Params {
        /// What strokes mean.
        anatomy: AnatomyParams;
        /// How the flat drawing stands in space.
        depth: DepthParams;
        /// How the drawn plant grows on.
        growth: GrowthParams;
        /// How the plant becomes surfaces.
        model: ModelParams;
        /// How plants of the species grow. A species that does not say it grows like an ordinary tree.
        habit: Habit;
    }
}

/// Every parameter of any species: asked for with each build.
static ANY_SPECIES: LazyLock<Vec<Description>> = LazyLock::new(|| Params::of_any_species().describe());

impl Params {
    /// What a plant of a species has where nobody says otherwise.
    pub fn of_species(species: &Species) -> Self {
        Self { habit: species.growth.clone().unwrap_or_default(), ..Self::default() }
    }

    /// Parameters with every group that a species may have.
    pub fn of_any_species() -> Self {
        let crown = Some(CrownHabit::default());
        Self { habit: Habit { crown, ..Habit::default() }, ..Self::default() }
    }
}

/// Why a sketch cannot be set up for building.
#[derive(Debug, Error)]
pub enum SetupError {
    /// The species cannot be used.
    #[error(transparent)]
    Species(#[from] SpeciesError),
    /// The species does not say how it grows.
    #[error(
        "the species `{name}` does not grow by itself: its file has no section [growth]; those that do are {known}"
    )]
    NoGrowth {
        /// The species.
        name: String,
        /// Built-in species that grow.
        known: String,
    },
    /// A volume without a place for anything.
    #[error("the volume is too thin to grow in; make it thicker")]
    NoRoom,
    /// A parameter of a species cannot be used.
    #[error("the species {file}, line {line}: {fault}")]
    OfSpecies {
        /// Its file.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// What is wrong.
        fault: ParamError,
    },
    /// A parameter cannot be used.
    #[error("{whose}: {fault}")]
    Param {
        /// Who asked for it.
        whose: &'static str,
        /// What is wrong.
        fault: ParamError,
    },
}

/// The species that a sketch names: a file when the name looks like one, relative to `folder`, else a built-in.
///
/// # Errors
/// An unknown name, or a file that cannot be used.
pub fn species_of(sketch: &Sketch, folder: &Path) -> Result<Species, SpeciesError> {
    match species_file(sketch, folder) {
        Some(file) => Species::read(&file),
        None => Species::built_in(sketch.species.as_deref().unwrap_or(DEFAULT_SPECIES)),
    }
}

/// The same; where the species file that the sketch names is missing, the species of a sketch that names none, with a
/// remark.
///
/// # Errors
/// An unknown name, or a file that is there and cannot be used.
pub fn species_or_usual(sketch: &Sketch, folder: &Path) -> Result<(Species, Option<Warning>), SpeciesError> {
    match species_of(sketch, folder) {
        Err(SpeciesError::Unreadable { file, source }) if source.kind() == io::ErrorKind::NotFound => {
            let name = quote::name(own_name(&file.to_string_lossy()));
            let missing = Warning { stroke: None, remark: Remark::SpeciesMissing { name } };
            Ok((Species::built_in(DEFAULT_SPECIES)?, Some(missing)))
        }
        found => Ok((found?, None)),
    }
}

/// The species file that a sketch names, if it names one; relative names are looked for from `folder`.
pub fn species_file(sketch: &Sketch, folder: &Path) -> Option<PathBuf> {
    sketch.species.as_deref().filter(|name| is_file(name)).map(|name| find(name, folder))
}

/// Parameters for a sketch: defaults, then the species', then the sketch's own, then `PATH=VALUE` assignments. What the
/// sketch says of a group that its species does not have rests there for another species.
///
/// # Errors
/// The first unknown path, wrong type or value out of range, and whose it was.
pub fn params_of(sketch: &Sketch, species: &Species, assignments: &[String]) -> Result<Params, SetupError> {
    let by = |whose| move |fault| SetupError::Param { whose, fault };
    let mut overrides = Overrides::over(&Params::of_species(species));
    let of_species = |fault: ParamError| {
        let written = &species.written;
        SetupError::OfSpecies { file: written.file.clone(), line: written.line(fault.path()), fault }
    };
    overrides.merge(&species.params).map_err(of_species)?;
    overrides.merge_what_applies(&sketch.params, &ANY_SPECIES).map_err(by("the sketch"))?;
    for assignment in assignments {
        overrides.set_text(assignment).map_err(by("--set"))?;
    }
    overrides.finish().map_err(by("parameters"))
}

/// Everything between a sketch and its model.
#[derive(Clone, Debug)]
pub struct Built {
    /// What the strokes mean.
    pub anatomy: Anatomy,
    /// How old the plant is, where it grew.
    pub growth: Option<Ages>,
    /// The plant in space.
    pub plant: FinishedPlant,
    /// The plant as surfaces.
    pub model: Model,
    /// What growth looks like from inside; empty until [`Cache::look_inside`].
    pub overlay: Vec<Spot>,
    /// Time that each stage took, in order.
    pub stages: Vec<(&'static str, Duration)>,
}

/// What [`build_with`] keeps from one build to the next.
#[derive(Debug, Default)]
pub struct Cache {
    /// Meshes of parts.
    pub model: model::Cache,
    /// The plant that grew last.
    pub growth: Memory,
}

impl Cache {
    /// Adds to what [`build_with`] has just built what is wanted of its growth, at the age that it shows.
    pub fn look_inside(&self, built: &mut Built, wanted: Wanted) {
        if let Some(ages) = built.growth.filter(|_| wanted.any()) {
            built.overlay = self.growth.overlay(ages.shown, wanted);
        }
    }
}

/// Builds a plant. Same input, same output, on any number of threads. A sketch without anything to build gives an
/// empty model.
pub fn build(sketch: &Sketch, species: &Species, params: &Params) -> Built {
    let mut clock = Clock::start();
    let mut anatomy = clock.time("anatomy", || anatomy::analyse(sketch, &params.anatomy));
    growing::remark_fineness(&mut anatomy, species, params);
    let plant = clock.time("depth", || depth::recover(&anatomy, sketch.seed, &params.depth));
    let mut growth = None;
    let plant = if growing::grows(&anatomy, species, params) {
        let (memory, with) = (&mut Memory::default(), (species, params, sketch));
        // Nothing stops it.
        let grown = clock.time("growth", || growing::grow_on(memory, plant, &mut anatomy, with, &|| false));
        let keep = |(plant, ages)| {
            growth = Some(ages);
            plant
        };
        grown.map_or_else(|drawn| drawn, keep)
    } else {
        plant
    };
    let plant = clock.time("species", || finished(plant, &mut anatomy, species, sketch));
    let of_model = of_model(&plant, params, growth.is_some());
    remark_coarser(&mut anatomy, &of_model);
    let model = clock.time("model", || model::build(&plant, &of_model.params));
    Built { anatomy, growth, plant, model, overlay: Vec::new(), stages: clock.stages }
}

/// Builds the very plant that [`build`] gives, again and again while a drawing changes: parts that are the same as when
/// the cache was last used keep their meshes. `stop` is asked between the stages and inside the long ones, from any
/// thread; once it says yes the build ends soon and gives nothing. The cache survives that.
pub fn build_with(
    cache: &mut Cache,
    sketch: &Sketch,
    species: &Species,
    params: &Params,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Built> {
    let stopped = AtomicBool::new(false);
    // The stages count on a yes that stays.
    let stop = || {
        if !stopped.load(Ordering::Relaxed) && stop() {
            stopped.store(true, Ordering::Relaxed);
        }
        stopped.load(Ordering::Relaxed)
    };
    let mut clock = Clock::start();
    let mut anatomy = clock.time("anatomy", || anatomy::analyse_unless(sketch, &params.anatomy, &stop))?;
    growing::remark_fineness(&mut anatomy, species, params);
    let plant = clock.time("depth", || depth::recover(&anatomy, sketch.seed, &params.depth));
    if stop() {
        return None;
    }
    let (plant, growth) = if growing::grows(&anatomy, species, params) {
        let (memory, with) = (&mut cache.growth, (species, params, sketch));
        let grown = clock.time("growth", || growing::grow_on(memory, plant, &mut anatomy, with, &stop));
        grown.ok().map(|(plant, ages)| (plant, Some(ages)))?
    } else {
        cache.growth.clear();
        (plant, None)
    };
    let plant = clock.time("species", || finished(plant, &mut anatomy, species, sketch));
    let of_model = of_model(&plant, params, growth.is_some());
    remark_coarser(&mut anatomy, &of_model);
    let model = clock.time("model", || model::rebuild(&plant, &of_model.params, &mut cache.model, &stop))?;
    Some(Built { anatomy, growth, plant, model, overlay: Vec::new(), stages: clock.stages })
}

/// Everything between a species and a plant that it grew.
#[derive(Clone, Debug)]
pub struct Grown {
    /// The plant with all its ages.
    pub simulation: Simulation,
    /// How growth ended: [`Outcome::Growing`] at the age that was asked for.
    pub outcome: Outcome,
    /// The plant in space.
    pub plant: FinishedPlant,
    /// Whether leaves were left out because there were too many.
    pub is_thinned: bool,
    /// Whether flowers were left out because there were too many.
    pub is_blossom_thinned: bool,
    /// Whether its surfaces are coarser than was asked for, because they had too many triangles.
    pub is_coarser: bool,
    /// The plant as surfaces.
    pub model: Model,
    /// Time that each stage took, in order.
    pub stages: Vec<(&'static str, Duration)>,
}

/// Parameters for a plant without a drawing: defaults, then the species', then `PATH=VALUE` assignments.
///
/// # Errors
/// The first unknown path, wrong type or value out of range, and whose it was.
pub fn params_of_species(species: &Species, assignments: &[String]) -> Result<Params, SetupError> {
    params_of(&Sketch::empty(), species, assignments)
}

/// Grows a plant of a species from a seed; `age` in years, its own if not given. Same input, same output, on any number
/// of threads.
///
/// # Errors
/// A species that does not say how it grows.
pub fn grow(
    species: &Species,
    params: &Params,
    age: Option<f32>,
    seed: u64,
    limits: Limits,
) -> Result<Grown, SetupError> {
    check_grows(species)?;
    let habit = &params.habit;
    let age = age.unwrap_or(habit.age as f32).max(0.0);
    let mut clock = Clock::start();
    let (simulation, outcome) = clock.time("growth", || {
        let mut simulation = Simulation::new(habit, seed, limits);
        let outcome = simulation.grow_to(age.ceil() as u16, &|| false);
        (simulation, outcome)
    });
    Ok(shown((simulation, outcome), species, params, age, clock))
}

/// A plant that has grown, as it is at an age.
fn shown(
    (simulation, outcome): (Simulation, Outcome),
    species: &Species,
    params: &Params,
    age: f32,
    mut clock: Clock,
) -> Grown {
    let Shown { plant, is_thinned, is_blossom_thinned, is_coarser, model } =
        at_age(&simulation, species, params, age, &mut clock);
    let stages = clock.stages;
    Grown { simulation, outcome, plant, is_thinned, is_blossom_thinned, is_coarser, model, stages }
}

/// The same inside a volume; without an age until the volume is full.
///
/// # Errors
/// A species that does not say how it grows, a volume without room.
pub fn grow_inside(
    species: &Species,
    params: &Params,
    volume: Envelope,
    age: Option<f32>,
    seed: u64,
    limits: Limits,
) -> Result<Grown, SetupError> {
    check_grows(species)?;
    let mut clock = Clock::start();
    let (simulation, outcome) = clock.time("growth", || {
        let mut simulation = Simulation::in_envelope(&params.habit, volume, seed, limits);
        let outcome = match age {
            Some(age) => simulation.grow_to(age.ceil() as u16, &|| false),
            None => fill(&mut simulation),
        };
        (simulation, outcome)
    });
    if matches!(simulation.field(), Field::Space(markers) if markers.is_empty()) {
        return Err(SetupError::NoRoom);
    }
    let age = age.unwrap_or(f32::from(simulation.age()));
    Ok(shown((simulation, outcome), species, params, age, clock))
}

/// Grows until the volume is full.
fn fill(simulation: &mut Simulation) -> Outcome {
    let mut outcome = Outcome::Growing;
    while outcome.may_go_on() && drawing::filled_at(simulation.tree(), simulation.age()).is_none() {
        outcome = simulation.step(&|| false);
    }
    // A volume in which no bud finds any more room is full.
    if outcome == Outcome::Finished { Outcome::Growing } else { outcome }
}

fn check_grows(species: &Species) -> Result<(), SetupError> {
    if species.growth.is_some() {
        return Ok(());
    }
    let known = Species::growing().join(", ");
    Err(SetupError::NoGrowth { name: quote::name(&species.name), known })
}

impl Grown {
    /// The plant at an age that it has lived through, in space and as surfaces.
    pub fn at(&self, age: f32, species: &Species, params: &Params) -> (FinishedPlant, Model) {
        let shown = at_age(&self.simulation, species, params, age, &mut Clock::start());
        (shown.plant, shown.model)
    }
}

/// A grown plant at one age.
struct Shown {
    plant: FinishedPlant,
    is_thinned: bool,
    is_blossom_thinned: bool,
    is_coarser: bool,
    model: Model,
}

fn at_age(simulation: &Simulation, species: &Species, params: &Params, age: f32, clock: &mut Clock) -> Shown {
    let plant = clock.time("plant", || growth::plant_at(simulation, age));
    // Before some of the leaves stand as flowers.
    let is_thinned = foliage::is_thinned(&plant.organs);
    let few_buds = bloom::is_thinned(&plant.buds);
    let looks = looks_at(species, &params.habit, age);
    let Applied { plant, is_blossom_thinned: few_open } =
        clock.time("species", || species::apply(plant, &looks, simulation.seed()));
    let is_blossom_thinned = looks.blossom.is_some() && (few_buds || few_open);
    debug_assert_eq!(plant.check_invariants(), Ok(()));
    let OfModel { params, is_coarser } = of_model(&plant, params, true);
    let model = clock.time("model", || model::build(&plant, &params));
    Shown { plant, is_thinned, is_blossom_thinned, is_coarser, model }
}

/// The looks of a plant of an age: where buds decide about flowers, one too young for them has no blossom either.
fn looks_at<'a>(species: &'a Species, habit: &Habit, age: f32) -> Cow<'a, Species> {
    let flowers = |share: &Schedule| share.at(habit.flower_age) > 0.0;
    let decides = flowers(&habit.flowering) || flowers(&habit.flowering_side);
    if species.blossom.is_some() && decides && age < habit.flower_age {
        let mut young = species.clone();
        young.blossom = None;
        return Cow::Owned(young);
    }
    Cow::Borrowed(species)
}

/// Parameters of the model.
struct OfModel<'a> {
    params: Cow<'a, ModelParams>,
    /// Whether they are coarser than was asked for.
    is_coarser: bool,
}

/// As fine as asked for and within the budget of triangles; the leaves of a plant that grew are too many to be parts of
/// their own.
fn of_model<'a>(plant: &Plant, params: &'a Params, grew: bool) -> OfModel<'a> {
    let mut affordable = model::affordable(plant, &params.model, Budget::PLANT.triangles);
    let is_coarser = matches!(affordable, Cow::Owned(_));
    if grew && !affordable.blade.gathered {
        affordable.to_mut().blade.gathered = true;
    }
    OfModel { params: affordable, is_coarser }
}

fn remark_coarser(anatomy: &mut Anatomy, of_model: &OfModel<'_>) {
    if of_model.is_coarser {
        let triangles = Budget::PLANT.triangles;
        anatomy.warnings.push(Warning { stroke: None, remark: Remark::Coarser { triangles } });
    }
}

fn finished(plant: Plant, anatomy: &mut Anatomy, species: &Species, sketch: &Sketch) -> FinishedPlant {
    let Applied { mut plant, is_blossom_thinned } = species::apply(plant, species, sketch.seed);
    if is_blossom_thinned {
        let flowers = plant.flowers.len();
        anatomy.warnings.push(Warning { stroke: None, remark: Remark::BlossomThinned { flowers } });
    }
    species::textures::lay_over(&mut plant, &sketch.textures);
    debug_assert_eq!(plant.check_invariants(), Ok(()));
    plant
}

/// Measures the stages.
struct Clock {
    stages: Vec<(&'static str, Duration)>,
}

impl Clock {
    fn start() -> Self {
        Self { stages: Vec::with_capacity(4) }
    }

    fn time<T>(&mut self, stage: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let made = work();
        self.stages.push((stage, start.elapsed()));
        made
    }
}
