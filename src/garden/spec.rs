//! The garden as a text file: TOML, every key known, every number in range.
//!
//! Files that it names lie beside it. Figures that are left out come from each other: of spacing and density one decides the
//! other, and without both plants keep half a metre.

use super::area::{self, Area, Outline, Path as GardenPath};
use super::error::GardenError;
use super::grey_map::GreyMap;
use super::ground::Ground;
use super::ground_mesh;
use super::plan::{Kind, Plan, Stands, Variation};
use super::tiles::TileSet;
use super::walls::{Wall, WallSpec};
use crate::budget::GardenBudget;
use crate::geom::polyline;
use crate::{input, quote};
use glam::Vec2;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use std::io;
use std::path::{Path, PathBuf};

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
        /// Ground that only some plants are spread over.
        beds: Vec<BedSpec> = Vec::new();
        /// Where nothing grows.
        paths: Vec<GardenPath> = Vec::new();
        /// What some plants climb on.
        walls: Vec<WallSpec> = Vec::new();
        /// What the ground is like.
        ground: GroundSpec = GroundSpec::default();
        sections:
        /// How plants of one kind differ.
        variation: Variation = Variation::default();
    }
}

/// A bed as it is written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BedSpec {
    /// What plants call it.
    pub name: String,
    /// Its ground.
    pub outline: Outline,
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
        /// OBJ file of its surface, instead of a picture.
        mesh: Option<String> = None;
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
        /// It stands in straight rows so far apart; 0 for none.
        rows: f32 = 0.0, 0.0..=1e4, "metres";
        /// How its rows are turned against the x axis, toward z.
        rows_angle: f32 = 0.0, -360.0..=360.0, "degrees";
        others:
        /// The bed that it grows in; none for the ground outside of all.
        bed: Option<String> = None;
        /// The wall that it climbs on, before both faces where neither `lines` nor `at` says where.
        wall: Option<String> = None;
        /// Lines along which it stands.
        lines: Vec<Vec<Vec2>> = Vec::new(), checked_lines;
        /// Where single ones of it stand.
        at: Vec<Vec2> = Vec::new();
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

    /// Where its plants stand.
    fn stands(&self) -> Stands {
        let KindFields { rows, rows_angle, lines, at, wall, .. } = &self.fields;
        if wall.is_some() {
            return Stands::Before(at.clone());
        }
        match (&lines[..], &at[..]) {
            ([], []) if *rows > 0.0 => Stands::Rows { apart: *rows, angle: *rows_angle },
            ([], []) => Stands::Spread,
            ([], at) => Stands::At(at.to_vec()),
            (lines, _) => Stands::Along(lines.to_vec()),
        }
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
        let ways = [fields.rows > 0.0, !fields.lines.is_empty(), !fields.at.is_empty()];
        if ways.iter().filter(|is_given| **is_given).count() > 1 {
            return Err("plants stand in one way; give one of `rows`, `lines` and `at`");
        }
        if fields.wall.is_some() && (fields.rows > 0.0 || fields.height > 0.0) {
            return Err("what climbs on a wall grows there; leave out `rows` and `height`, and give `age`");
        }
        match (origins.next(), origins.next()) {
            (Some(Origin::Drawing(_) | Origin::Model(_)), _) if fields.wall.is_some() => Err(
                "only species that grow climb on walls; leave out `wall`, or give a `species`, such as ivy",
            ),
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

fn checked_lines<'de, D: Deserializer<'de>>(source: D) -> Result<Vec<Vec<Vec2>>, D::Error> {
    let lines = Vec::<Vec<Vec2>>::deserialize(source)?;
    lines.iter().try_for_each(|line| area::check_line(line, "a line of plants")).map_err(D::Error::custom)?;
    Ok(lines)
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
        let own = [&self.map, &self.ground.map, &self.ground.mesh].into_iter().filter_map(Option::as_deref);
        let walls = self.walls.iter().filter_map(|wall| wall.mesh.as_deref());
        origins.chain(maps).chain(own).chain(walls).map(|file| folder.join(file)).collect()
    }

    /// What shares that were given sum to in the first bed, or outside of all, where that is not 1.
    pub fn uneven_shares(&self) -> Option<f32> {
        let uneven = |bed: Option<&str>| {
            let shares = || self.spread_over(bed).map(|kind| kind.fields.share);
            let sum: f32 = shares().sum();
            let are_given = shares().count() > 0 && shares().all(|share| share > 0.0);
            (are_given && (sum - 1.0).abs() > 0.01).then_some(sum)
        };
        std::iter::once(None).chain(self.beds.iter().map(|bed| Some(&*bed.name))).find_map(uneven)
    }

    /// The kinds that are spread over a bed, or over the ground outside of all.
    fn spread_over<'a>(&'a self, bed: Option<&'a str>) -> impl Iterator<Item = &'a KindSpec> {
        let is_there = move |kind: &&KindSpec| kind.fields.bed.as_deref() == bed;
        self.plants.iter().filter(is_there).filter(|kind| kind.stands() == Stands::Spread)
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
        let ground = self.ground(&area, folder)?;
        let walls = self.walls(&ground, folder)?;
        let kinds = self.plants.iter().map(|kind| {
            let (name, fields) = (kind.origin.name(), &kind.fields);
            let map = fields.map.as_ref();
            let map = map.map(|map| density_map(name, &folder.join(map))).transpose()?;
            let variants = if fields.variants > 0 { fields.variants } else { self.variants };
            let others = self.spread_over(fields.bed.as_deref()).count();
            let share = or(fields.share, 1.0 / others.max(1) as f32);
            let bed = fields.bed.as_ref().map(|bed| self.bed(name, bed)).transpose()?;
            if let Some(&at) = fields.at.iter().find(|at| !area.contains(**at)) {
                return Err(GardenError::Outside { whose: quote::name(name), at });
            }
            let apart = or(fields.spacing, spacing);
            let (stands, wall) = match &fields.wall {
                None => (kind.stands(), None),
                Some(wall) => {
                    let number = wall_of(&walls, name, wall)?;
                    (feet(kind, &walls[number], apart, &area)?, Some(number))
                }
            };
            Ok(Kind { share, spacing: apart, variants, map, bed, stands, wall })
        });
        let kinds = kinds.collect::<Result<_, GardenError>>()?;
        let map = self.map.as_ref().map(|map| density_map("the garden", &folder.join(map))).transpose()?;
        Ok(Plan {
            seed: self.seed,
            density: (self.density > 0.0).then_some(self.density),
            map,
            ground,
            paths: self.paths.clone(),
            beds: self.areas_of_beds()?,
            kinds,
            walls,
            variation: self.variation.clone(),
            area,
        })
    }
}

impl GardenSpec {
    /// How high the ground is.
    fn ground(&self, area: &Area, folder: &Path) -> Result<Ground, GardenError> {
        let GroundSpec { map, mesh, low, high, .. } = &self.ground;
        let (map, range) = match (map, mesh) {
            (None, None) => return Ok(Ground::default()),
            (Some(_), Some(_)) => return Err(GardenError::TwoGrounds),
            (Some(map), None) => (read_map("the ground", &folder.join(map))?, [*low, *high]),
            (None, Some(mesh)) => {
                let file = folder.join(mesh);
                let fault = |fault| GardenError::GroundMesh { file: file.clone(), fault };
                ground_mesh::read(&file, area).map_err(fault)?
            }
        };
        Ok(Ground::of_map(map, range, area.bounds()))
    }

    /// The walls on their ground.
    fn walls(&self, ground: &Ground, folder: &Path) -> Result<Vec<Wall>, GardenError> {
        let built = |wall: &WallSpec| {
            let fault = |fault| GardenError::Wall { name: quote::name(&wall.name), fault };
            wall.built(ground, folder).map_err(fault)
        };
        self.walls.iter().map(built).collect()
    }

    /// The number of a bed.
    fn bed(&self, whose: &str, name: &str) -> Result<usize, GardenError> {
        let names: Vec<&str> = self.beds.iter().map(|bed| &*bed.name).collect();
        names.iter().position(|bed| *bed == name).ok_or_else(|| GardenError::NoBed {
            whose: quote::name(whose),
            bed: quote::name(name),
            known: known(&names, "; add a section [[beds]] with this name and an outline"),
        })
    }

    /// The grounds of all beds.
    fn areas_of_beds(&self) -> Result<Vec<Area>, GardenError> {
        let is_twice = |(number, bed): &(usize, &BedSpec)| {
            self.beds[..*number].iter().any(|other| other.name == bed.name)
        };
        if let Some((_, bed)) = self.beds.iter().enumerate().find(is_twice) {
            return Err(GardenError::TwoBeds(quote::name(&bed.name)));
        }
        self.beds.iter().map(|bed| bed.outline.area().map_err(GardenError::Area)).collect()
    }
}

/// The number of a wall.
fn wall_of(walls: &[Wall], whose: &str, name: &str) -> Result<usize, GardenError> {
    let names: Vec<&str> = walls.iter().map(|wall| &*wall.name).collect();
    names.iter().position(|wall| *wall == name).ok_or_else(|| GardenError::NoWall {
        whose: quote::name(whose),
        wall: quote::name(name),
        known: known(&names, "; add a section [[walls]] with this name and a line"),
    })
}

/// Which names there are, or what to do where there are none.
fn known(names: &[&str], none: &str) -> String {
    if names.is_empty() { none.to_owned() } else { format!("; there are {}", quote::name(&names.join(", "))) }
}

/// Where the plants of a kind stand before their wall.
fn feet(kind: &KindSpec, wall: &Wall, apart: f32, area: &Area) -> Result<Stands, GardenError> {
    let KindFields { lines, at, .. } = &kind.fields;
    let own = wall
        .line
        .as_ref()
        .filter(|_| lines.is_empty() && at.is_empty())
        .map(|path| 2.0 * polyline::length(path.points()));
    let metres = own.unwrap_or_default() + lines.iter().map(|line| polyline::length(line)).sum::<f32>();
    let plants = metres / apart + at.len() as f32;
    if plants > GardenBudget::GARDEN.variants as f32 {
        return Err(GardenError::TooManyClimbers { whose: quote::name(kind.origin.name()), plants });
    }
    let feet = match (&lines[..], &at[..]) {
        ([], []) if wall.line.is_none() => {
            let (whose, wall) = (quote::name(kind.origin.name()), quote::name(&wall.name));
            return Err(GardenError::NoFeet { whose, wall });
        }
        ([], []) => wall.feet(apart),
        (lines, at) => {
            lines.iter().flat_map(|line| polyline::spaced(line, apart)).chain(at.iter().copied()).collect()
        }
    };
    Ok(Stands::Before(feet.into_iter().filter(|foot| area.contains(*foot)).collect()))
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
    fn beds_rows_lines_and_single_plants_are_read() {
        let text = "area = \"20x10\"\n[[beds]]\nname = \"round\"\noutline = [[1, 1], [4, 1], [4, 4]]\n\
                    [[plants]]\nspecies = \"rose\"\nbed = \"round\"\nrows = 0.8\nrows_angle = 20\n\
                    [[plants]]\nspecies = \"daisy\"\n[[plants]]\nspecies = \"lavender\"\nlines = [[[-5, 0], [5, 0]]]\n\
                    [[plants]]\nspecies = \"oak\"\nat = [[0, 1], [5, -2]]\n";
        let spec = GardenSpec::from_toml(text, "a.toml").unwrap();
        let plan = spec.plan(&TileSet::new(1, 1), Path::new("")).unwrap();
        assert_eq!(plan.kinds[0].bed, Some(0));
        assert_eq!(plan.kinds[0].stands, Stands::Rows { apart: 0.8, angle: 20.0 });
        assert_eq!((&plan.kinds[1].stands, plan.kinds[1].share), (&Stands::Spread, 1.0));
        assert!(matches!(&plan.kinds[2].stands, Stands::Along(lines) if lines[0].len() == 2));
        assert_eq!(plan.kinds[3].stands, Stands::At(vec![Vec2::new(0.0, 1.0), Vec2::new(5.0, -2.0)]));
        let laid_out = |text: &str| {
            let spec = GardenSpec::from_toml(text, "a.toml").unwrap();
            spec.plan(&TileSet::new(1, 1), Path::new("")).unwrap_err().to_string()
        };
        let lost = laid_out(&text.replace("bed = \"round\"", "bed = \"square\""));
        assert_eq!(lost, "rose: there is no bed `square`; there are round");
        assert!(laid_out(&text.replace("[5, -2]", "[15, -2]")).contains("oak: the plant at [15, -2]"));
        let twice = format!("{text}[[beds]]\nname = \"round\"\noutline = \"1x1\"\n");
        assert!(laid_out(&twice).contains("two beds are called `round`"));
        assert!(refused(&format!("{text}rows = 2")).contains("give one of `rows`, `lines` and `at`"));
        assert!(refused(&text.replace("[[-5, 0], [5, 0]]", "[[-5, 0]]")).contains("2 to"));
    }

    #[test]
    fn walls_and_what_climbs_on_them_are_read() {
        let text = "area = \"20x10\"\n[[walls]]\nname = \"north\"\nline = [[-5, -2], [5, -2]]\n\
                    [[plants]]\nspecies = \"ivy\"\nwall = \"north\"\nspacing = 2\n";
        let plan = |text: &str| {
            let spec = GardenSpec::from_toml(text, "a.toml").unwrap();
            spec.plan(&TileSet::new(1, 1), Path::new("nowhere"))
        };
        let laid_out = plan(text).unwrap();
        assert_eq!(laid_out.before_wall_of(0).unwrap().feet.len(), 10);
        let lines = plan(&format!("{text}lines = [[[-4, -1.7], [4, -1.7]]]\n")).unwrap();
        assert_eq!(lines.before_wall_of(0).unwrap().feet.len(), 5);
        let fault = |text: &str| plan(text).unwrap_err().to_string();
        assert_eq!(
            fault(&text.replace("wall = \"north\"", "wall = \"noth\"")),
            "ivy: there is no wall `noth`; there are north"
        );
        let file = text.replace("line = [[-5, -2], [5, -2]]", "mesh = \"house.obj\"");
        assert!(fault(&file).contains("the wall north") && fault(&file).contains("house.obj"));
        assert!(fault(&text.replace("spacing = 2", "spacing = 0.0001")).contains("about 200000 plants"));
        assert!(refused(&format!("{text}height = 2")).contains("leave out `rows` and `height`"));
        let drawing = text.replace("species = \"ivy\"", "drawing = \"a.svg\"");
        assert!(refused(&drawing).contains("only species that grow"));
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
