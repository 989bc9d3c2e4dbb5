//! The garden as a text file: TOML, every key known, every number in range.
//!
//! Files that it names lie beside it. Figures that are left out come from each other: of spacing and density one decides the
//! other, and without both plants keep half a metre.

use super::area::{Outline, Path as GardenPath};
use super::grey_map::{GreyMap, MapError};
use super::ground::Ground;
use super::places::{Kind, Plan, PlanError, Variation};
use super::tiles::TileSet;
use crate::{input, quote};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Largest file that is read, bytes.
pub const MAX_BYTES: u64 = 1 << 20;
/// The distance that plants keep where nothing is said, metres.
const USUAL_SPACING: f32 = 0.5;

crate::parameters! {
    /// A garden as it is written.
    pub struct GardenSpec {
        /// Plants in a square metre where nothing thins them; 0 for as many as keep their spacing.
        density: f32 = 0.0, 0.0..=1e12, "";
        /// Least distance between two plants; 0 for what the density leaves.
        spacing: f32 = 0.0, 0.0..=1e4, "metres";
        /// Individuals of each kind, of which its plants are copies.
        variants: u32 = 16, 1..=256, "";
        /// Colours of the tiles' corners: more of them repeat less.
        colours: u32 = 3, 1..=5, "";
        others:
        /// Decides everything that is left to chance.
        seed: u64 = 1;
        /// The ground that is planted.
        area: Option<Outline> = None;
        /// Picture of where plants stand how densely.
        map: Option<String> = None;
        /// What grows.
        plants: Vec<KindSpec> = Vec::new(), kinds;
        /// Where nothing grows.
        paths: Vec<GardenPath> = Vec::new();
        /// What the ground is like.
        ground: GroundSpec = GroundSpec::default();
        sections:
        /// How plants of one kind differ.
        variation: Variation = Variation::default();
    }
}

crate::parameter_choice! {
    /// What the ground is covered with.
    pub enum Cover {
        /// Bare earth.
        Soil = "soil",
        /// Mown grass from afar.
        Lawn = "lawn",
        /// Nothing: only the plants are there.
        None = "none",
    }
}

crate::parameters! {
    /// The ground as it is written.
    pub struct GroundSpec {
        /// Height where the picture is black.
        low: f32 = 0.0, -10000.0..=10000.0, "metres";
        /// Height where it is white.
        high: f32 = 1.0, -10000.0..=10000.0, "metres";
        others:
        /// Picture of its heights; without one it is level.
        map: Option<String> = None;
        /// What it is covered with.
        cover: Cover = Cover::Soil;
    }
}

crate::parameters! {
    /// A kind of plants as it is written.
    pub struct KindFields {
        /// Its part of the ground, weighed against the other kinds'; 0 for as much as each.
        share: f32 = 0.0, 0.0..=1e6, "";
        /// Least distance between two of it; 0 for the garden's.
        spacing: f32 = 0.0, 0.0..=1e4, "metres";
        /// Individuals of it; 0 for as many as usual in this garden.
        variants: u32 = 0, 0..=256, "";
        /// Seed of the first individual; the others have the next ones.
        seed: u32 = 1, 0..=2_000_000_000, "";
        /// Mean height of the individuals; 0 for their own.
        height: f32 = 0.0, 0.0..=200.0, "metres";
        /// Triangles of an individual; 0 for what the number of plants allows.
        triangles: u32 = 0, 0..=10_000_000, "";
        others:
        /// A species, by name or by its file.
        species: Option<String> = None;
        /// A drawing, by its file.
        drawing: Option<String> = None;
        /// A finished model, by its file.
        model: Option<String> = None;
        /// Age in years of plants that grow.
        age: Option<f32> = None;
        /// Picture of where it grows how densely.
        map: Option<String> = None;
        /// Parameters of its individuals, each as PARAM=VALUE.
        set: Vec<String> = Vec::new();
    }
}

/// What plants of a kind are made from.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Origin {
    /// A species that makes itself.
    Species(String),
    /// A drawing.
    Drawing(String),
    /// A finished model.
    Model(String),
}

impl Origin {
    /// Its name or file, as it is written.
    pub fn name(&self) -> &str {
        let (Self::Species(name) | Self::Drawing(name) | Self::Model(name)) = self;
        name
    }
}

/// A kind of plants, as it is written, of which it is clear what it is made from.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct KindSpec {
    /// What it is made from.
    pub origin: Origin,
    /// Everything else.
    pub fields: KindFields,
}

impl KindSpec {
    /// A kind of which nothing is said but what it is.
    pub fn of(origin: Origin) -> Self {
        Self { origin, fields: KindFields::default() }
    }
}

impl TryFrom<KindFields> for KindSpec {
    type Error = &'static str;

    fn try_from(mut fields: KindFields) -> Result<Self, Self::Error> {
        let origins = [
            fields.species.take().map(Origin::Species),
            fields.drawing.take().map(Origin::Drawing),
            fields.model.take().map(Origin::Model),
        ];
        let mut origins = origins.into_iter().flatten();
        match (origins.next(), origins.next()) {
            (Some(_), Some(_)) => {
                Err("plants are made from one thing; give one of `species`, `drawing` and `model`")
            }
            (None, _) => Err("what grows there? give `species`, `drawing` or `model`"),
            (Some(_), None) if fields.age.is_some_and(|age| !(0.0..=10_000.0).contains(&age)) => {
                Err("`age` is a number of years from 0 to 10000")
            }
            (Some(origin), None) => Ok(Self { origin, fields }),
        }
    }
}

/// Reads the kinds; a message says which of them is wrong, because its place in the text is that of the first.
fn kinds<'de, D: Deserializer<'de>>(source: D) -> Result<Vec<KindSpec>, D::Error> {
    let all = Vec::<KindFields>::deserialize(source)?.into_iter().zip(1..);
    let kind = |(fields, number): (KindFields, usize)| {
        KindSpec::try_from(fields)
            .map_err(|reason| D::Error::custom(format!("[[plants]] number {number}: {reason}")))
    };
    all.map(kind).collect()
}

/// A garden that cannot be laid out.
#[derive(Debug, Error)]
pub enum GardenError {
    /// The file cannot be read.
    #[error("cannot read the garden {}: {source}", .file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// Not TOML, an unknown key, a wrong type or a number out of range.
    #[error("{file}, line {line}, `{text}`: {reason}")]
    Invalid {
        /// The file.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// What stands in that line.
        text: String,
        /// What is wrong with it.
        reason: String,
    },
    /// Nothing says where the garden is.
    #[error("the garden has no area; write area = \"40x25\" in its file, or give --area 40x25: metres")]
    NoArea,
    /// The area is none.
    #[error("the garden's area: {0}")]
    Area(String),
    /// Nothing says what grows.
    #[error("nothing grows in the garden; name species or drawings, or add sections [[plants]] to its file")]
    NoPlants,
    /// A density map or a picture of heights cannot be used.
    #[error("{whose}: {}: {fault}", .file.display())]
    Map {
        /// Whose it is.
        whose: String,
        /// The picture.
        file: PathBuf,
        /// What is wrong with it.
        fault: MapError,
    },
    /// A map keeps everything away.
    #[error("{whose}: {}: the density map is black everywhere, so nothing grows; white is the full density", .file.display())]
    Black {
        /// Whose it is.
        whose: String,
        /// The picture.
        file: PathBuf,
    },
    /// The plants do not stand as they should.
    #[error(transparent)]
    Plan(#[from] PlanError),
}

impl GardenSpec {
    /// Reads a garden's file.
    ///
    /// # Errors
    /// [`GardenError::Unreadable`], [`GardenError::Invalid`].
    pub fn read(path: &Path) -> Result<Self, GardenError> {
        let unreadable = |source| GardenError::Unreadable { file: path.to_owned(), source };
        let bytes = input::read(path, MAX_BYTES).map_err(unreadable)?;
        let text = String::from_utf8(bytes).map_err(|error| unreadable(io::Error::other(error)))?;
        Self::from_toml(&text, &path.display().to_string())
    }

    /// A garden from text; `name` stands for the file in messages.
    ///
    /// # Errors
    /// [`GardenError::Invalid`].
    pub fn from_toml(text: &str, name: &str) -> Result<Self, GardenError> {
        toml::from_str(text).map_err(|error| {
            let start = error.span().map_or(0, |span| span.start);
            let (line, there) = quote::line_at(text, start);
            let reason = quote::message(error.message());
            GardenError::Invalid { file: name.to_owned(), line, text: there, reason }
        })
    }

    /// The files that it names, from the folder it lies in; built-in species are none.
    pub fn files(&self, folder: &Path) -> Vec<PathBuf> {
        let origins = self.plants.iter().filter_map(|kind| match &kind.origin {
            Origin::Species(name) if !name.ends_with(".toml") => None,
            origin => Some(origin.name()),
        });
        let maps = self.plants.iter().filter_map(|kind| kind.fields.map.as_deref());
        let own = [&self.map, &self.ground.map].into_iter().filter_map(Option::as_deref);
        origins.chain(maps).chain(own).map(|file| folder.join(file)).collect()
    }

    /// What shares that were given sum to, where that is not 1.
    pub fn uneven_shares(&self) -> Option<f32> {
        let shares = || self.plants.iter().map(|kind| kind.fields.share);
        let sum: f32 = shares().sum();
        (shares().all(|share| share > 0.0) && (sum - 1.0).abs() > 0.01).then_some(sum)
    }

    /// The garden's plan, with the maps that it names.
    ///
    /// # Errors
    /// [`GardenError`].
    pub fn plan(&self, tiles: &TileSet, folder: &Path) -> Result<Plan, GardenError> {
        let area = self.area.as_ref().ok_or(GardenError::NoArea)?.area().map_err(GardenError::Area)?;
        if self.plants.is_empty() {
            return Err(GardenError::NoPlants);
        }
        let spacing = match (self.spacing, self.density) {
            (0.0, 0.0) => USUAL_SPACING,
            (0.0, density) => Plan::spacing_of(tiles, density),
            (spacing, _) => spacing,
        };
        let or = |value: f32, other: f32| if value > 0.0 { value } else { other };
        let kinds = self.plants.iter().map(|KindSpec { origin, fields }| {
            let map = fields.map.as_ref();
            let map = map.map(|map| density_map(origin.name(), &folder.join(map))).transpose()?;
            let variants = if fields.variants > 0 { fields.variants } else { self.variants };
            let share = or(fields.share, 1.0 / self.plants.len() as f32);
            Ok(Kind { share, spacing: or(fields.spacing, spacing), variants, map })
        });
        let ground = match &self.ground.map {
            None => Ground::default(),
            Some(map) => {
                let map = read_map("the ground", &folder.join(map))?;
                Ground::of_map(map, [self.ground.low, self.ground.high], area.bounds())
            }
        };
        let map = self.map.as_ref().map(|map| density_map("the garden", &folder.join(map))).transpose()?;
        Ok(Plan {
            seed: self.seed,
            density: (self.density > 0.0).then_some(self.density),
            map,
            ground,
            paths: self.paths.clone(),
            kinds: kinds.collect::<Result<_, GardenError>>()?,
            variation: self.variation.clone(),
            area,
        })
    }
}

fn read_map(whose: &str, file: &Path) -> Result<GreyMap, GardenError> {
    let map = GreyMap::read(file);
    map.map_err(|fault| GardenError::Map { whose: quote::name(whose), file: file.to_owned(), fault })
}

fn density_map(whose: &str, file: &Path) -> Result<GreyMap, GardenError> {
    let map = read_map(whose, file)?;
    if map.highest() > 0.0 {
        return Ok(map);
    }
    Err(GardenError::Black { whose: quote::name(whose), file: file.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROSES: &str = "area = \"40x25\"\nseed = 3\ndensity = 6\n[[plants]]\nspecies = \"rose\"\nshare = 0.7\n\
                         [[plants]]\nspecies = \"daisy\"\nshare = 0.3\nvariants = 4\n[[paths]]\npoints = [[-20, 0], [20, 0]]\nwidth = 1.2\n";

    fn refused(text: &str) -> String {
        GardenSpec::from_toml(text, "a.toml").unwrap_err().to_string()
    }

    #[test]
    fn a_garden_is_read_and_laid_out() {
        let spec = GardenSpec::from_toml(ROSES, "a.toml").unwrap();
        assert_eq!((spec.seed, spec.plants.len(), spec.uneven_shares()), (3, 2, None));
        let tiles = TileSet::new(spec.colours, 1);
        let plan = spec.plan(&tiles, Path::new("")).unwrap();
        assert_eq!(plan.kinds.iter().map(|kind| kind.variants).collect::<Vec<_>>(), [16, 4]);
        let most = tiles.density() / plan.kinds[0].spacing.powi(2);
        assert!((most - 6.0).abs() < 1e-3, "the spacing has room for just the density: {most}");
    }

    #[test]
    fn mistakes_are_reported_with_line_reason_and_remedy() {
        assert!(refused("area = \"40\"").contains("a.toml, line 1, `area = \"40\"`"));
        assert!(refused("area = \"40\"").contains("40x25"));
        assert!(refused("\nspcing = 1").contains("line 2") && refused("spcing = 1").contains("`spacing`"));
        assert!(refused("spacing = -1").contains("0 to 10000"));
        assert!(refused("colours = 9").contains("1 to 5"));
        let both = "[[plants]]\nspecies = \"rose\"\n[[plants]]\nspecies = \"rose\"\ndrawing = \"a.svg\"";
        let which = refused(both);
        assert!(which.contains("[[plants]] number 2") && which.contains("give one of"), "{which}");
        assert!(refused("[[plants]]\nshare = 1").contains("give `species`, `drawing` or `model`"));
        assert!(refused("[[paths]]\npoints = [[0, 0]]\nwidth = 1").contains("2 to"));
        assert!(refused("area = [[0, 0], [4, 4], [4, 0], [0, 3]]").contains("cross"));
        assert!(refused("area = ").contains("line 1"));
    }

    #[test]
    fn what_is_missing_is_said() {
        let laid_out = |text: &str| {
            let spec = GardenSpec::from_toml(text, "a.toml").unwrap();
            spec.plan(&TileSet::new(1, 1), Path::new("nowhere")).unwrap_err().to_string()
        };
        assert!(laid_out("").contains("--area 40x25"));
        assert!(laid_out("area = \"4x4\"").contains("[[plants]]"));
        let map = "area = \"4x4\"\nmap = \"no.png\"\n[[plants]]\nspecies = \"rose\"";
        assert!(laid_out(map).contains("no.png") && laid_out(map).contains("cannot be read"));
        let shares =
            "[[plants]]\nspecies = \"rose\"\nshare = 0.7\n[[plants]]\nspecies = \"daisy\"\nshare = 0.7";
        assert!((GardenSpec::from_toml(shares, "").unwrap().uneven_shares().unwrap() - 1.4).abs() < 1e-6);
    }

    #[test]
    fn a_damaged_text_ends_in_a_garden_or_in_a_message() {
        let tiles = TileSet::new(1, 1);
        let laid_out = |text: &str| {
            let plan = GardenSpec::from_toml(text, "a.toml")
                .and_then(|spec| spec.plan(&tiles, Path::new("nowhere")));
            plan.is_ok_and(|plan| plan.places(&tiles).is_ok())
        };
        let small = ROSES.replace("40x25", "9x5");
        assert!(laid_out(&small));
        for end in 0..small.len() {
            laid_out(&small[..end]);
        }
        for (digit, other) in
            [("0", "-1"), ("3", "nan"), ("6", "1e30"), ("2", "inf"), ("7", "0"), ("5", "0.0000001")]
        {
            laid_out(&small.replace(digit, other));
        }
    }
}
