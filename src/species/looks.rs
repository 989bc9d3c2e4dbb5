//! The sections of a species file, as they are written and as they are used.
//!
//! Sizes in a flower are shares of its reach, the distance from its centre to the petals' tips, so that a species fits
//! a flower of any size. Every number's range is checked while reading
//! ([`parameters!`](crate::parameters!)).

use super::fruit_look::FruitLook;
use super::inflorescence::Inflorescence;
use crate::flower::Layers;
use crate::growth::Habit;
use crate::leaf::{Compound, LeafOutline, StemLeaves};
use crate::params::{ParamValue as _, Range};
use crate::picture::Picture;
use crate::plant::{BladeForm, Material, PlantPart, Texture};
use crate::quote;
use crate::rose::RoseHabit;
use crate::srgb::linear_from_srgb;
use serde::{Deserialize, Deserializer, Serialize, de};
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// A species: what its plants look like beyond what was drawn.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Species {
    /// Short name, as the artist types it.
    pub name: String,
    /// Botanical name.
    pub latin: String,
    /// Overrides of the pipeline's parameters, a tree along their dotted paths.
    #[serde(default)]
    pub params: Map<String, Value>,
    /// Surfaces by name; the sections below refer to them.
    pub materials: BTreeMap<String, MaterialLook>,
    /// Stems and branches.
    pub stem: StemLook,
    /// Leaves.
    pub leaf: LeafLook,
    /// Looks of the flowers; the drawing's flowers take them in turn.
    #[serde(default)]
    pub flowers: Vec<FlowerLook>,
    /// How one flower stands that is made without a drawing.
    #[serde(default)]
    pub bloom: BloomLook,
    /// How flowers stand together that are made without a drawing; one alone if left out.
    pub inflorescence: Option<Inflorescence>,
    /// How many of them one plant sends up.
    #[serde(default)]
    pub clump: ClumpLook,
    /// Leaves along the stem of a flower or inflorescence that is made without a drawing.
    #[serde(default)]
    pub stem_leaves: StemLeaves,
    /// Small flowers among the leaves of a tree.
    pub blossom: Option<BlossomLook>,
    /// What the year does to leaves.
    #[serde(default)]
    pub season: SeasonLook,
    /// Fruits.
    pub fruit: Option<FruitLook>,
    /// Thorns on stems and branches.
    pub thorns: Option<ThornLook>,
    /// What the plant stands in.
    pub pot: Option<PotLook>,
    /// How the plant grows by itself.
    pub growth: Option<Habit>,
    /// How a rose is built by itself.
    pub rose: Option<RoseHabit>,
    /// Where it is written.
    #[serde(skip)]
    pub written: Written,
    /// The artist's own pictures, which replace every material of a part.
    #[serde(skip)]
    pub(super) pictures: BTreeMap<PlantPart, Picture>,
}

/// Where a species is written, for messages about parameters, which are checked where all of them are known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Written {
    /// Name of the file.
    pub file: String,
    /// The lines of the parameters by their paths.
    pub params: Vec<(String, usize)>,
}

impl Species {
    /// Whether plants of it are made without a drawing: they grow, are roses, or have flowers of their own.
    pub fn makes_itself(&self) -> bool {
        self.growth.is_some() || self.rose.is_some() || self.blooms()
    }

    /// Takes over the flowers of another species with their materials: for flowers drawn on, or beside, a plant that has none. A
    /// material that it has itself stays its own.
    pub fn take_flowers_of(&mut self, other: &Self) {
        self.flowers.clone_from(&other.flowers);
        for (name, look) in &other.materials {
            self.materials.entry(name.clone()).or_insert_with(|| look.clone());
        }
    }

    /// The looks that drawn flowers have in turn; all of them if none is meant for drawn ones.
    pub fn looks_of_drawn(&self) -> Vec<usize> {
        let drawn: Vec<usize> = (0..self.flowers.len()).filter(|k| self.flowers[*k].drawn).collect();
        if drawn.is_empty() { (0..self.flowers.len()).collect() } else { drawn }
    }

    /// The looks of florets: those that drawn flowers may not have, or all of them if there are none such.
    pub fn looks_of_florets(&self) -> Vec<usize> {
        let florets: Vec<usize> = (0..self.flowers.len()).filter(|k| !self.flowers[*k].drawn).collect();
        if florets.is_empty() { (0..self.flowers.len()).collect() } else { florets }
    }

    /// Whether it has a flower that is made without a drawing.
    pub fn blooms(&self) -> bool {
        self.inflorescence.is_some() || self.flowers.iter().any(|look| look.layers.is_some())
    }
}

impl Written {
    /// The line of a parameter.
    pub fn line(&self, path: &str) -> usize {
        self.params.iter().find(|(key, _)| quote::name(key) == path).map_or(1, |(_, line)| *line)
    }
}

crate::parameters! {
    /// A surface.
    pub struct MaterialLook {
        /// Strength of the highlight, 0 to 1.
        specular: f32 = 0.04, 0.0..=1.0, "";
        /// Sharpness of the highlight, 0 to 1000.
        shininess: f32 = 20.0, 0.0..=1000.0, "";
        /// Share of light that passes through, 0 to 1.
        translucency: f32 = 0.0, 0.0..=1.0, "";
        /// How much higher light places of the picture are than dark ones, 0 to 0.2.
        relief: f32 = 0.0, 0.0..=0.2, "widths of the picture";
        others:
        /// Colour, multiplied with the texture: `#rrggbb` in the file, linear RGB here.
        color: [f32; 3] = [1.0; 3], read_colour;
        /// Picture: a file beside the species file, or one of the built-in textures.
        texture: Option<Texture> = None, read_texture;
        /// Whether the picture's alpha cuts the surface out.
        cut_out: bool = false;
        /// Whether both sides are seen.
        double_sided: bool = false;
    }
}

impl MaterialLook {
    /// The material of that name.
    pub fn material(&self, name: &str) -> Material {
        Material {
            specular: [self.specular; 3],
            shininess: self.shininess,
            translucency: self.translucency,
            relief: self.relief,
            texture: self.texture.clone(),
            cut_out: self.cut_out,
            double_sided: self.double_sided,
            ..Material::plain(name, self.color)
        }
    }

    /// File name of the built-in texture, if it has one.
    pub fn built_in_texture(&self) -> Option<&str> {
        match &self.texture {
            Some(Texture::BuiltIn(name)) => Some(name),
            _ => None,
        }
    }
}

crate::parameters! {
    /// Stems and branches.
    pub struct StemLook {
        /// Level in the branch hierarchy from which branches are young; 0 is the trunk.
        twig_level: u32 = 1, 0..=20, "";
        /// Branches whose radius at the foot is at least this share of the thickest branch's are not twigs, whatever their level.
        twig_thickest: f32 = 0.25, 0.0..=1.0, "of the thickest branch";
        others:
        /// Material of trunk and stem.
        material: String;
        /// Material of young branches; that of the stem if left out.
        twig: Option<String> = None;
    }
}

crate::parameters! {
    /// Leaves.
    pub struct LeafLook {
        /// How much the form differs from leaf to leaf, 0 to 1.
        vary: f32 = 0.0, 0.0..=1.0, "";
        others:
        /// Materials; each leaf takes one at random.
        materials: Names;
        /// Material of young leaves and of those in autumn; that of the others if left out.
        young: Option<String> = None;
        /// The same in autumn.
        autumn: Option<String> = None;
        /// Materials of leaves whose own outline is shown, for those of all leaves are pictures of whole shoots; the same if left out.
        drawn: Option<Names> = None;
        /// How leaves that nobody drew are divided into leaflets.
        compound: Option<Compound> = None;
        sections:
        /// Outline of leaves that nobody drew, of their leaflets if they have several.
        outline: LeafOutline = LeafOutline::default();
        /// How leaves bend.
        form: BladeForm = BladeForm::default();
    }
}

crate::parameters! {
    /// One look of a species' flowers.
    pub struct FlowerLook {
        others:
        /// Blades behind the petals.
        sepals: Option<SepalLook> = None;
        /// What carries the petals from behind.
        cup: Option<CupLook> = None;
        /// Groups of stamens.
        stamens: Vec<FilamentLook> = Vec::new();
        /// Groups of styles.
        pistils: Vec<FilamentLook> = Vec::new();
        /// Whether drawn flowers may have this look; the looks that they may not have are those of florets.
        drawn: bool = true;
        /// Layers of a full flower, for buds and for flowers of which hardly any petal was drawn.
        layers: Option<Layers> = None;
        sections:
        /// Petals.
        petals: PetalLook;
        /// Middle of the flower.
        disc: DiscLook;
    }
}

crate::parameters! {
    /// Petals.
    pub struct PetalLook {
        /// How much the form differs from petal to petal, 0 to 1.
        vary: f32 = 0.0, 0.0..=1.0, "";
        others:
        /// Materials; the petals of a flower take them in turn.
        materials: Names;
        /// How petals of half the longest one's length bend; those between are between.
        inner: Option<BladeForm> = None;
        sections:
        /// How petals bend.
        form: BladeForm = BladeForm::default();
    }
}

crate::parameters! {
    /// Sepals or bracts.
    pub struct SepalLook {
        /// Length, share of the reach.
        length: f32, 0.0..=3.0, "of the reach";
        /// Width, share of the length.
        width: f32, 0.0..=1.0, "of the length";
        /// Where it is widest: 0 base, 1 tip.
        widest: f32 = 0.4, 0.0..=1.0, "";
        /// Angle between petals and sepals, degrees.
        gap_deg: f32, 0.0..=180.0, "degrees";
        others:
        /// Material.
        material: String;
        /// Number; as many as petals if left out.
        count: Option<u32> = None, read_count;
        sections:
        /// How sepals bend.
        form: BladeForm = BladeForm::default();
    }
}

/// Which way the cup behind the petals points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Along {
    /// Back along the flower's axis: the calyx of a daisy.
    Axis,
    /// Down the stem: the tube of jasmine.
    Stem,
}

crate::parameters! {
    /// Solid behind the petals: calyx cup, involucre or flower tube.
    pub struct CupLook {
        /// Radius at the petals, share of the reach.
        radius: f32, 0.0..=1.0, "of the reach";
        /// Length, share of the reach.
        length: f32, 0.0..=3.0, "of the reach";
        others:
        /// Material.
        material: String;
        /// Direction.
        along: Along;
    }
}

crate::parameters! {
    /// Disc of the flower: a dome whose texture is seen from above.
    pub struct DiscLook {
        /// Least radius, share of the reach; a drawing with a wider centre widens it.
        radius: f32, 0.0..=1.0, "of the reach";
        /// Height, share of the radius.
        height: f32, 0.01..=20.0, "of the radius";
        others:
        /// Material.
        material: String;
    }
}

/// How the filaments of a group stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Arrangement {
    /// In one ring.
    Whorl,
    /// Over the whole disc by the golden angle.
    Spiral,
    /// Along the axis by the golden angle, as on the column of a mallow.
    Column,
}

crate::parameters! {
    /// A group of stamens or styles.
    pub struct FilamentLook {
        /// Number.
        count: u32, 0..=200, "";
        /// Length, share of the reach.
        length: f32, 0.0..=3.0, "of the reach";
        /// Radius of the filament, share of the reach.
        radius: f32, 0.001..=0.2, "of the reach";
        /// Distance of the ring, or of the outermost filament, from the axis: share of the disc's radius.
        ring: f32 = 0.0, 0.0..=1.0, "of the disc's radius";
        /// Where the innermost filament of a spiral stands: share of the ring's distance from the axis.
        ring_from: f32 = 0.0, 0.0..=0.99, "of the ring";
        /// Height of the lowest filament above the disc, share of the reach.
        rise: f32 = 0.0, 0.0..=3.0, "of the reach";
        /// Length of the column, share of the reach.
        column: f32 = 0.0, 0.0..=3.0, "of the reach";
        /// Angle between the axis and the outermost filament, degrees; never beyond the petals.
        spread_deg: f32 = 0.0, 0.0..=180.0, "degrees";
        /// Bow away from the axis, share of the length; negative toward it.
        bow: f32 = 0.0, -1.0..=1.0, "of the length";
        /// How much length and direction differ from filament to filament, 0 to 1.
        vary: f32 = 0.0, 0.0..=1.0, "";
        others:
        /// Material of the filaments.
        material: String;
        /// Material of their heads; that of the filaments if left out.
        head_material: Option<String> = None;
        /// How they stand.
        arrangement: Arrangement;
        /// Radius and half length of the head, shares of the reach.
        head: [f32; 2] = [0.0; 2], read_head;
    }
}

crate::parameters! {
    /// A flower on its stem, made without a drawing.
    pub struct BloomLook {
        /// Distance from the flower's centre to its tips.
        reach: f32 = 0.05, 0.001..=2.0, "metres";
        /// Length of the stem.
        stem: f32 = 2.6, 0.1..=60.0, "of the reach";
        /// Radius of the stem.
        stem_radius: f32 = 0.045, 0.002..=0.5, "of the reach";
        /// How far the stem bows aside.
        bow: f32 = 0.06, 0.0..=0.5, "of its length";
        /// How far the flower leans toward the viewer.
        lean_deg: f32 = 25.0, 0.0..=120.0, "degrees";
    }
}

crate::parameters! {
    /// Flowers or inflorescences from one root, made without a drawing.
    pub struct ClumpLook {
        /// Stems that come out of the ground.
        stems: u32 = 1, 1..=60, "";
        /// Distance of the outermost from the middle at the ground.
        spread: f32 = 0.02, 0.0..=1.0, "metres";
        /// How far the outermost lean outward.
        lean_deg: f32 = 14.0, 0.0..=80.0, "degrees";
        /// How much smaller than the one in the middle others are at most.
        vary: f32 = 0.25, 0.0..=0.9, "";
    }
}

crate::parameters! {
    /// Small flowers in place of some of a tree's leaves or beside them, in the first look of the species' flowers.
    pub struct BlossomLook {
        /// Share of the leaves that are flowers, or have some.
        share: f32, 0.0..=1.0, "";
        /// Flowers that stand together at a leaf's place.
        cluster: u32 = 1, 1..=24, "";
        /// The time of the year when they are over.
        until: f32 = 2.5, 0.3..=5.0, "";
        /// How far out along the leaf they stand at most.
        along: f32 = 0.0, 0.0..=1.0, "of the leaf's length";
        /// Petals of each.
        petals: u32, 0..=200, "";
        /// Distance from centre to tip, share of the leaves' mean length.
        reach: f32, 0.0..=3.0, "of the leaves' mean length";
        /// Width of a petal, share of its length.
        width: f32, 0.0..=1.0, "of the length";
        /// Depth of the notch at the tip, share of the length.
        notch: f32 = 0.0, 0.0..=1.0, "of the length";
        /// Angle between axis and petals, degrees.
        opening_deg: f32, 0.0..=180.0, "degrees";
        others:
        /// Whether leaves stay, with their flowers on the side that faces the sky.
        with_leaves: bool = false;
    }
}

crate::parameters! {
    /// What the year does to leaves.
    pub struct SeasonLook {
        /// Time of the year; the numbers are those of [`super::season`].
        time: f32 = 2.0, 0.0..=5.0, "";
        /// Share of the leaves that stay on the plant in winter, withered.
        keeps: f32 = 0.0, 0.0..=1.0, "of the leaves";
        others:
        /// Whether leaves stay the whole year as they are.
        evergreen: bool = false;
        /// Colours to which leaves turn, each leaf to one of them; those already in their colour name none.
        autumn: Vec<[f32; 3]> = vec![[0.62, 0.38, 0.05], [0.40, 0.20, 0.04]], read_colours;
        /// Colour of leaves that have just unfolded.
        spring: [f32; 3] = [0.30, 0.42, 0.06], read_colour;
        /// Colour of withered leaves.
        withered: [f32; 3] = [0.20, 0.10, 0.035], read_colour;
    }
}

crate::parameters! {
    /// Thorns.
    pub struct ThornLook {
        /// Length, in radii of the branch.
        length: f32, 0.01..=20.0, "radii";
        /// Mean distance along the branch, in radii of the branch.
        spacing: f32, 0.01..=20.0, "radii";
        others:
        /// Material.
        material: String;
    }
}

crate::parameters! {
    /// A pot, its rim a little above the foot of the lowest trunk.
    pub struct PotLook {
        /// Height, share of the plant's height.
        height: f32, 0.0..=1.0, "of the plant's height";
        /// Radius at the rim, share of the pot's height.
        radius: f32, 0.01..=20.0, "of the height";
        others:
        /// Material of the pot.
        material: String;
        /// Material of the earth in it.
        soil: String;
    }
}

impl LeafLook {
    /// Which of several materials young leaves have, and those in autumn.
    pub fn young_variant(&self) -> u32 {
        self.materials.0.len() as u32
    }

    /// The same of those in autumn.
    pub fn autumn_variant(&self) -> u32 {
        self.young_variant() + 1
    }

    /// How many variants there are without those of seasons.
    pub(super) fn usual_variants(&self) -> u32 {
        self.autumn_variant() + 1 + self.drawn.as_ref().map_or(0, |names| names.0.len() as u32)
    }

    /// Variants of the materials among which leaves choose, those whose outline somebody drew or others.
    pub(super) fn variants(&self, is_drawn: bool) -> std::ops::Range<u32> {
        match self.drawn.as_ref().filter(|_| is_drawn) {
            Some(drawn) => self.usual_variants() - drawn.0.len() as u32..self.usual_variants(),
            None => 0..self.young_variant(),
        }
    }

    /// The name of the material of a variant.
    pub(super) fn material(&self, variant: u32) -> &str {
        let own = match variant.checked_sub(self.young_variant()) {
            Some(0) => self.young.as_deref(),
            Some(1) => self.autumn.as_deref(),
            Some(drawn) => self.drawn.as_ref().map(|names| names.nth(drawn - 2)),
            None => None,
        };
        own.unwrap_or_else(|| self.materials.nth(variant))
    }
}

impl FilamentLook {
    /// Material of the filaments.
    pub(super) fn material(&self) -> &str {
        &self.material
    }

    /// Material of their heads.
    pub(super) fn head_material(&self) -> &str {
        self.head_material.as_ref().unwrap_or(&self.material)
    }
}

/// Names of one or more materials; in the file a string or a list of strings.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Names(pub Vec<String>);

impl Names {
    /// The name for a variant; they are taken in turn.
    pub(super) fn nth(&self, variant: u32) -> &str {
        self.0.get(variant as usize % self.0.len().max(1)).map_or("", String::as_str)
    }
}

impl<'de> Deserialize<'de> for Names {
    fn deserialize<D: Deserializer<'de>>(source: D) -> Result<Self, D::Error> {
        struct OneOrMore;
        impl<'de> de::Visitor<'de> for OneOrMore {
            type Value = Names;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("the name of a material or a list of names")
            }

            fn visit_str<E: de::Error>(self, name: &str) -> Result<Names, E> {
                Ok(Names(vec![name.to_owned()]))
            }

            fn visit_seq<A: de::SeqAccess<'de>>(self, mut list: A) -> Result<Names, A::Error> {
                let mut names = Vec::new();
                while let Some(name) = list.next_element()? {
                    names.push(name);
                }
                if names.is_empty() {
                    return Err(de::Error::custom("needs at least one material"));
                }
                Ok(Names(names))
            }
        }
        source.deserialize_any(OneOrMore)
    }
}

/// A colour written as `#rrggbb` (sRGB), as linear RGB.
fn read_colour<'de, D: Deserializer<'de>>(source: D) -> Result<[f32; 3], D::Error> {
    colour_of(&String::deserialize(source)?).map_err(de::Error::custom)
}

/// A list of such colours.
fn read_colours<'de, D: Deserializer<'de>>(source: D) -> Result<Vec<[f32; 3]>, D::Error> {
    let texts = Vec::<String>::deserialize(source)?;
    texts.iter().map(|text| colour_of(text).map_err(de::Error::custom)).collect()
}

fn colour_of(text: &str) -> Result<[f32; 3], String> {
    let digits = text.strip_prefix('#').filter(|d| d.len() == 6 && d.is_ascii());
    let number = digits.and_then(|d| u32::from_str_radix(d, 16).ok());
    let number = number.ok_or_else(|| format!("`{}` is no colour; write #rrggbb", quote::name(text)))?;
    Ok([16, 8, 0].map(|shift| linear_from_srgb(((number >> shift) & 0xff) as f32 / 255.0)))
}

/// A texture by name; [`super::file`] decides whether it is a file or built in.
fn read_texture<'de, D: Deserializer<'de>>(source: D) -> Result<Option<Texture>, D::Error> {
    String::deserialize(source).map(|name| Some(Texture::BuiltIn(name)))
}

/// A number that may be left out.
fn read_count<'de, D: Deserializer<'de>>(source: D) -> Result<Option<u32>, D::Error> {
    u32::read(source, &Range::new("count", 0.0, 200.0)).map(Some)
}

/// Radius and half length of a filament's head, as shares of a flower's reach.
fn read_head<'de, D: Deserializer<'de>>(source: D) -> Result<[f32; 2], D::Error> {
    let head = <[f32; 2]>::deserialize(source)?;
    let range = Range::<f32>::new("head", 0.0, 0.5);
    match head.iter().find(|size| !(range.min as f32..=range.max as f32).contains(*size)) {
        Some(size) => Err(de::Error::custom(range.refusal(size))),
        None => Ok(head),
    }
}
