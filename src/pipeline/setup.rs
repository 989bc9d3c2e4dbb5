//! What a build is set up with: the species that a sketch names, and its parameters.
//!
//! Parameters lie over each other in layers: defaults, then the species file's, then the sketch's own, then assignments
//! of the command line. What a layer says wrongly is reported with its file and line.

use super::usual_species::{DEFAULT_SPECIES, species_of_habit};
use crate::anatomy::AnatomyParams;
use crate::anatomy::conventions::{self, ConventionParams};
use crate::cards::CardParams;
use crate::depth::DepthParams;
use crate::flower::Layers;
use crate::garden::GardenParams;
use crate::growth::habit::{ClimbHabit, CrownHabit};
use crate::growth::{GrowthParams, Habit, ObstacleParams};
use crate::model::ModelParams;
use crate::params::{Description, Overrides, ParamError, Parameters as _};
use crate::quote;
use crate::rose::RoseHabit;
use crate::sketch::species_file::{find, is_file, own_name};
use crate::sketch::{Remark, Sketch, Warning};
use crate::species::{FlowerParams, SeasonParams, Species, SpeciesError};
use serde_json::{Map, Value};
use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use thiserror::Error;

crate::parameter_groups! {
    /// Every parameter of the way from drawing to model.
    pub struct Params {
        /// What strokes mean.
        anatomy: AnatomyParams;
        /// How the flat drawing stands in space.
        depth: DepthParams;
        /// How the drawn plant grows on.
        growth: GrowthParams;
        /// What stands behind it.
        obstacle: ObstacleParams;
        /// The garden that is painted around it.
        garden: GardenParams;
        /// How the plant becomes surfaces.
        model: ModelParams;
        /// Foliage as pictures on rectangles.
        cards: CardParams;
        /// The flowers of the species.
        flower: FlowerParams;
        /// The time of the year.
        season: SeasonParams;
        /// How roses of the species are built; none where it has another way to grow.
        rose: Option<RoseHabit>;
        /// How plants of the species grow. A species that does not say it grows like an ordinary tree.
        habit: Habit;
    }
}

/// Every parameter of any species: asked for with each build.
static ANY_SPECIES: LazyLock<Vec<Description>> = LazyLock::new(|| Params::of_any_species().describe());

impl Params {
    /// What a plant of a species has where nobody says otherwise.
    pub fn of_species(species: &Species) -> Self {
        let habit = species.growth.clone().unwrap_or_default();
        let season = SeasonParams { time: species.season.time, ..SeasonParams::default() };
        Self {
            habit,
            season,
            flower: FlowerParams::of(species),
            rose: species.rose.clone(),
            ..Self::default()
        }
    }

    /// Parameters with every group that a species may have.
    pub fn of_any_species() -> Self {
        let (crown, climb) = (Some(CrownHabit::default()), Some(ClimbHabit::default()));
        let flower = FlowerParams { layers: Some(Layers::default()), ..FlowerParams::default() };
        let rose = Some(RoseHabit::default());
        Self { habit: Habit { crown, climb, ..Habit::default() }, flower, rose, ..Self::default() }
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
    /// The species has no flower that can be made without a drawing.
    #[error(
        "the species `{name}` has no full flower: its file has no section [flowers.layers]; those that have one are {known}"
    )]
    NoBloom {
        /// The species.
        name: String,
        /// Built-in species with full flowers.
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
        None => Species::built_in(sketch.species.as_deref().unwrap_or_else(|| usual_species(sketch, &[]))),
    }
}

/// The built-in species of a sketch that names none, with these `PATH=VALUE` assignments.
pub fn usual_species(sketch: &Sketch, assignments: &[String]) -> &'static str {
    let params = convention_params(sketch, assignments);
    let memory = &mut conventions::Memory::for_one_build();
    let read = conventions::interpret_with(memory, &sketch.on_sheet(), &sketch.corrections, &params);
    species_of_habit(read.habit)
}

/// How the drawing of a sketch that names no species is read. Wrong parameters are reported where they are used.
pub(super) fn convention_params(sketch: &Sketch, assignments: &[String]) -> ConventionParams {
    if sketch.params.is_empty() && assignments.is_empty() {
        return ConventionParams::default();
    }
    let default = Species::built_in(DEFAULT_SPECIES).ok();
    let params = default.and_then(|species| params_of(sketch, &species, assignments).ok());
    params.map(|params| params.anatomy.conventions).unwrap_or_default()
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
    overrides.merge_what_applies(&renamed(&sketch.params), &ANY_SPECIES).map_err(by("the sketch"))?;
    for assignment in assignments {
        overrides.set_text(assignment).map_err(by("--set"))?;
    }
    overrides.finish().map_err(by("parameters"))
}

impl Params {
    /// The time of the year that all plants of a drawing have; none where each has that of its own species, because nobody said
    /// another than that of the drawn plant's.
    pub(super) fn season_of_all(&self, species: &Species) -> Option<f32> {
        (self.season.time != species.season.time).then_some(self.season.time)
    }
}

/// The parameters of a sketch under their names of today: the time of the year of roses was one of their own.
fn renamed(params: &Map<String, Value>) -> Cow<'_, Map<String, Value>> {
    let Some(time) = params.get("rose").and_then(|rose| rose.get("season")) else {
        return Cow::Borrowed(params);
    };
    let mut renamed = params.clone();
    if let Some(Value::Object(rose)) = renamed.get_mut("rose") {
        rose.remove("season");
    }
    let season = renamed.entry("season").or_insert_with(|| Value::Object(Map::new()));
    if let Value::Object(season) = season {
        season.entry("time").or_insert_with(|| time.clone());
    }
    Cow::Owned(renamed)
}

/// Parameters for a plant without a drawing: defaults, then the species', then `PATH=VALUE` assignments.
///
/// # Errors
/// The first unknown path, wrong type or value out of range, and whose it was.
pub fn params_of_species(species: &Species, assignments: &[String]) -> Result<Params, SetupError> {
    params_of(&Sketch::empty(), species, assignments)
}

/// Whether plants of a species grow by themselves.
///
/// # Errors
/// [`SetupError::NoGrowth`] where they do not.
pub fn check_grows(species: &Species) -> Result<(), SetupError> {
    if species.growth.is_some() || species.rose.is_some() {
        return Ok(());
    }
    let known = Species::growing_or_roses().join(", ");
    Err(SetupError::NoGrowth { name: quote::name(&species.name), known })
}

/// Whether a species has a flower that is made without a drawing.
///
/// # Errors
/// [`SetupError::NoBloom`] where it has none.
pub fn check_blooms(species: &Species) -> Result<(), SetupError> {
    if species.blooms() {
        return Ok(());
    }
    Err(SetupError::NoBloom { name: quote::name(&species.name), known: Species::blooming().join(", ") })
}
