//! What can be odd about a drawing that is built all the same: every kind with its English words.
//!
//! One list for the readers and the analysis, so that whoever speaks to a drawing's author in another language
//! sees all of it.

use super::{Reading, StrokeId};
use std::fmt;
use thiserror::Error;

/// A remark about an odd drawing that was built all the same.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// The stroke it is about, when it is about one.
    pub stroke: Option<StrokeId>,
    /// What was odd and what was done about it.
    pub remark: Remark,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.stroke {
            Some(id) => write!(f, "stroke {id}: {}", self.remark),
            None => write!(f, "{}", self.remark),
        }
    }
}

/// What was odd and what was done about it.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Remark {
    /// A stroke without samples.
    #[error("stroke {place} of the file has no points and was left out")]
    NoPoints {
        /// Place in the file, from 1.
        place: usize,
    },
    /// Pressures that no pen has.
    #[error("pressure of {} lay outside 0 to 1 and was brought into it", counted(.points, "point"))]
    PressureOutside {
        /// How many samples.
        points: usize,
    },
    /// Tilts that no pen has.
    #[error("tilt of {} lay outside −90 to 90 degrees and was brought into it", counted(.points, "point"))]
    TiltOutside {
        /// How many samples.
        points: usize,
    },
    /// Times outside the range that a file may hold.
    #[error("time of {} lay outside 0 to 1e9 milliseconds and was brought into it", counted(.points, "point"))]
    TimeOutside {
        /// How many samples.
        points: usize,
    },
    /// Elements of an SVG that have no outline.
    #[error(
        "{count} <{element}> left out: only lines and shapes are strokes (Inkscape: Path > Object to Path)"
    )]
    NoLines {
        /// How many.
        count: usize,
        /// Their name.
        element: &'static str,
    },
    /// A transform that cannot be read.
    #[error("{element}: transform passed over: {reason}")]
    Transform {
        /// Whose.
        element: Element,
        /// What is wrong with it.
        reason: String,
    },
    /// A `<use>` that leads nowhere.
    #[error("{element}: what it refers to was not found or refers to itself")]
    LeadsNowhere {
        /// The `<use>`.
        element: Element,
    },
    /// A path that is wrong somewhere.
    #[error("{element}: only its beginning was read: {reason}")]
    CutShort {
        /// The path.
        element: Element,
        /// What is wrong with it.
        reason: String,
    },
    /// Pressures that do not fit the line.
    #[error("{element}: data-pressure passed over: it needs a polyline with one number per point")]
    PressureUnfit {
        /// The line.
        element: Element,
    },
    /// A page size that makes no sense.
    #[error("the page's {attribute} `{value}` cannot be used and was passed over")]
    Page {
        /// What of the page.
        attribute: &'static str,
        /// What it says, as far as it is short.
        value: String,
    },
    /// A texture's picture that is not there.
    #[error(
        "the picture `{name}` is missing, so the species' own texture is shown; choose the picture again, or put it beside \
         the drawing"
    )]
    PictureMissing {
        /// Its file's name, without folders.
        name: String,
        /// The parts that were to show it.
        parts: Vec<String>,
    },
    /// A texture's picture that cannot be shown.
    #[error(
        "a picture for textures is damaged ({reason}) and was left out, so the species' own texture is shown; choose another"
    )]
    PictureDamaged {
        /// What is wrong with it.
        reason: String,
        /// The parts that were to show it.
        parts: Vec<String>,
    },
    /// A species file that is not there.
    #[error(
        "the species file `{name}` is missing, so the plant is one of no species in particular; choose the species again, or \
         put its file beside the drawing"
    )]
    SpeciesMissing {
        /// Its name, without folders.
        name: String,
    },
    /// A dot.
    #[error("is too short to mean anything and was skipped")]
    TooShort,
    /// A petal or leaf without area.
    #[error("encloses nothing and was skipped as a blade")]
    EnclosesNothing,
    /// What a stroke, alone or with others, was read as.
    #[error("{0}")]
    ReadAs(Reading),
    /// A stroke amid petals.
    #[error("is taken for the centre of a flower, which the species draws")]
    FlowerCentre,
    /// A leaf or a petal that no wood is near.
    #[error("is too far from every branch to grow on one; bring it nearer, or draw its stalk")]
    StandsApart,
    /// An outline that could not have all twigs.
    #[error("has fewer twigs than it asks for: the drawing has as many as it may")]
    FewTwigs,
    /// An outline that could not have all leaves or the twigs for them.
    #[error("was filled more thinly: the drawing has as many generated parts as it may")]
    FilledThinly,
    /// An outline for twigs with nothing that could carry them.
    #[error("no branch runs through this outline, so no twig could grow in it")]
    NoBranch,
    /// An outline that its branches fill.
    #[error("leaves no room beside its branches, so no twig could grow in it")]
    NoRoom,
    /// A crown without area.
    #[error("encloses nothing, so nothing can grow in it")]
    EmptyCrown,
    /// A crown too many.
    #[error("was left out: a drawing has at most {most} crowns, the largest")]
    ManyCrowns {
        /// How many there may be.
        most: usize,
    },
    /// A crown for a species that does not say how it grows.
    #[error(
        "the species `{species}` does not say how it grows, so it grew like any tree; those that do are {known}"
    )]
    DoesNotGrow {
        /// The species.
        species: String,
        /// Those that say it.
        known: String,
    },
    /// A brush with no wood near it.
    #[error("reaches no wood, so nothing grew in it; paint nearer to a branch")]
    BrushOutOfReach,
    /// A brush of leaves or flowers on a plant that has as many as it may have.
    #[error("adds nothing: the plant has {most} already, the most that it may have")]
    PaintsNoMore {
        /// How many.
        most: usize,
    },
    /// A flower brush without a flower.
    #[error("paints no flower: none is drawn to be copied, and the species has none by itself")]
    NoFlowerToPaint,
    /// A pruning brush in which nothing is.
    #[error("cuts nothing: no wood, leaf or flower is where it was painted")]
    BrushCutsNothing,
    /// Painted light beside a plant that does not grow.
    #[error("draws nothing toward it: the plant does not grow; draw a crown, or set years of growth")]
    LightsNothing,
    /// Poses of parts that are not there, or that are grafted onto what is not.
    #[error(
        "{} that {} turned, moved, grafted or taken away {} not there, or not what {} grafted onto, at this age or any more: that is without \
         effect",
        counted(.poses, "part"), if *.poses == 1 { "was" } else { "were" }, if *.poses == 1 { "is" } else { "are" },
        if *.poses == 1 { "it was" } else { "they were" }
    )]
    PosesRest {
        /// How many.
        poses: usize,
    },
    /// Growth that had to end early.
    #[error("growth ended at {internodes} internodes, the most that a drawing may have")]
    GrowthCapped {
        /// How many.
        internodes: usize,
    },
    /// Growth that left the space in which light is known.
    #[error("growth ended after {}, because the plant is too large for more", counted(.years, "year"))]
    GrownTooLarge {
        /// How old it is.
        years: u16,
    },
    /// Growth that was too much work.
    #[error("growth ended after {}, because more would take too much computation", counted(.years, "year"))]
    GrowthTooCostly {
        /// How old it is.
        years: u16,
    },
    /// Leaves that are fewer than the wood would carry.
    #[error(
        "the crown is thinner than its species': the drawing has {leaves} leaves, the most that a plant may have"
    )]
    LeavesThinned {
        /// How many there are.
        leaves: usize,
    },
    /// Flowers that are fewer than the species asks for.
    #[error(
        "fewer flowers open than its species asks for: the plant has {flowers}, the most that it may have"
    )]
    BlossomThinned {
        /// How many there may be.
        flowers: usize,
    },
    /// A grammar whose rules cannot be applied with the numbers that it has.
    #[error("the grammar of the inflorescence stopped, so there are no flowers: {fault}")]
    GrammarStopped {
        /// Where and why, and what helps.
        fault: String,
    },
    /// Leaves that a budget turned into pictures.
    #[error(
        "{triangles} triangles are too few for single leaves: foliage became pictures of shoots; leaves stay where the parameter \
         cards.below is 0"
    )]
    FoliageAsCards {
        /// The budget.
        triangles: u64,
    },
    /// A budget that a plant does not come down to.
    #[error(
        "the plant has {triangles} triangles instead of {wanted}: what was drawn and the last flower stay, and are as coarse as they \
         can be"
    )]
    BudgetMissed {
        /// How many it has.
        triangles: usize,
        /// How many were asked for.
        wanted: u64,
    },
    /// Surfaces that are coarser than was asked for.
    #[error(
        "surfaces are coarser than asked for: the plant would have more than {triangles} triangles, the most that a plant may \
         have"
    )]
    Coarser {
        /// How many it may have.
        triangles: u64,
    },
    /// A dot in a crown.
    #[error("a dot inside of a crown makes its foliage sparser there; erase it for a dense crown")]
    ThinsCrown,
    /// Fineness of crowns where there is none.
    #[error(
        "fineness changes only what grows in a crown, and this drawing has none; draw one with the tool crown"
    )]
    FinenessUnused,
    /// A drawing that names no species but looks like some.
    #[error(
        "the drawing names no species; its flowers look like {species}: choose one to give it its surfaces"
    )]
    LooksLike {
        /// Names of species, the likeliest first.
        species: String,
    },
    /// A plant beside the drawn one whose species does not exist or does not grow.
    #[error("no species of this name grows by itself, so the plant was left out; those that do are {known}")]
    NoSuchPlant {
        /// Those that grow.
        known: String,
    },
    /// A plant beside the drawn one that cannot stand where it should.
    #[error(
        "is too small, too large or too far away to stand beside the drawing and was left out; place it nearer or give it \
         another height"
    )]
    PlantOutOfScale,
    /// A bed of a species that does not exist or does not make itself.
    #[error(
        "in the garden no `{species}` grows, for no species of this name grows by itself; those that do are {known}"
    )]
    NoSuchPlantInGarden {
        /// Its name.
        species: String,
        /// Those that grow.
        known: String,
    },
    /// A bed of the drawn plant where none is drawn, or of another drawing that gives none.
    #[error("{}", nothing_to_plant(drawing.as_deref()))]
    NothingToPlant {
        /// The other drawing's name.
        drawing: Option<String>,
    },
    /// A garden of more plants than it may have.
    #[error(
        "the garden has {plants} plants, fewer than were painted: the most that it may have; paint it less densely"
    )]
    GardenThinned {
        /// How many.
        plants: usize,
    },
    /// What was odd about a plant beside the drawn one.
    #[error("plant {place} (`{species}`): {remark}")]
    OfPlant {
        /// Its place in the list of plants, from 1.
        place: usize,
        /// Its species.
        species: String,
        /// What was odd.
        remark: Box<Remark>,
    },
    /// What was too much to be reported.
    #[error("and {} like these", counted(.count, "more remark"))]
    More {
        /// How many remarks.
        count: usize,
    },
}

/// A number of things: `1 point`, `2 points`.
fn counted(count: &impl fmt::Display, thing: &str) -> String {
    let count = count.to_string();
    let ending = if count == "1" { "" } else { "s" };
    format!("{count} {thing}{ending}")
}

impl Remark {
    /// Whether the plant lacks something that was drawn for it.
    pub fn is_shortfall(&self) -> bool {
        match self {
            Self::EnclosesNothing
            | Self::FewTwigs
            | Self::FilledThinly
            | Self::NoBranch
            | Self::NoRoom
            | Self::EmptyCrown
            | Self::ManyCrowns { .. }
            | Self::DoesNotGrow { .. }
            | Self::BrushOutOfReach
            | Self::NoFlowerToPaint
            | Self::PaintsNoMore { .. }
            | Self::GrowthCapped { .. }
            | Self::GrownTooLarge { .. }
            | Self::GrowthTooCostly { .. }
            | Self::BlossomThinned { .. }
            | Self::GrammarStopped { .. }
            | Self::LeavesThinned { .. }
            | Self::NoSuchPlant { .. }
            | Self::NoSuchPlantInGarden { .. }
            | Self::NothingToPlant { .. }
            | Self::GardenThinned { .. }
            | Self::PlantOutOfScale
            | Self::FoliageAsCards { .. }
            | Self::BudgetMissed { .. }
            | Self::Coarser { .. } => true,
            Self::OfPlant { remark, .. } => remark.is_shortfall(),
            Self::NoPoints { .. }
            | Self::PressureOutside { .. }
            | Self::TiltOutside { .. }
            | Self::TimeOutside { .. }
            | Self::NoLines { .. }
            | Self::Transform { .. }
            | Self::LeadsNowhere { .. }
            | Self::CutShort { .. }
            | Self::PressureUnfit { .. }
            | Self::Page { .. }
            | Self::PictureMissing { .. }
            | Self::SpeciesMissing { .. }
            | Self::PictureDamaged { .. }
            | Self::TooShort
            | Self::ReadAs(_)
            | Self::FlowerCentre
            | Self::StandsApart
            | Self::ThinsCrown
            | Self::BrushCutsNothing
            | Self::LightsNothing
            | Self::PosesRest { .. }
            | Self::FinenessUnused
            | Self::LooksLike { .. }
            | Self::More { .. } => false,
        }
    }
}

/// What a bed of the drawn plant, or of another drawing, lacks.
fn nothing_to_plant(drawing: Option<&str>) -> String {
    let Some(drawing) = drawing else {
        return "the garden has beds of the drawn plant, but none is drawn: draw one, or choose a species"
            .to_owned();
    };
    format!(
        "the garden has beds of the drawing `{drawing}`, but that gives no plant: open it to see why, or choose another"
    )
}

/// An element of an SVG file, as a remark names it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Element {
    /// Its name.
    pub name: String,
    /// Its id, as far as it is short, where it has one.
    pub id: Option<String>,
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.id {
            Some(id) => write!(f, "<{}> `{id}`", self.name),
            None => write!(f, "a <{}> without id", self.name),
        }
    }
}
