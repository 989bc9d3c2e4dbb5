//! The sections of a species file, as they are written and as they are used.
//!
//! Sizes in a flower are shares of its reach, the distance from its centre to the petals' tips, so that a species fits
//! a flower of any size. Every number's range is checked while reading ([`super::ranges`]).

use super::part::Part;
use super::ranges;
use crate::growth::Habit;
use crate::picture::Picture;
use crate::plant::{BladeForm, Material, Texture};
use crate::quote;
use crate::srgb::linear_from_srgb;
use serde::{Deserialize, Deserializer, de};
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
    /// Small flowers among the leaves of a tree.
    pub blossom: Option<BlossomLook>,
    /// Thorns on stems and branches.
    pub thorns: Option<ThornLook>,
    /// What the plant stands in.
    pub pot: Option<PotLook>,
    /// How the plant grows by itself.
    pub growth: Option<Habit>,
    /// Where it is written.
    #[serde(skip)]
    pub written: Written,
    /// The artist's own pictures, which replace every material of a part.
    #[serde(skip)]
    pub(super) pictures: BTreeMap<Part, Picture>,
}

/// Where a species is written, for messages about parameters, which are checked where all of them are known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Written {
    /// Name of the file.
    pub file: String,
    /// The lines of the parameters by their paths.
    pub params: Vec<(String, usize)>,
}

impl Written {
    /// The line of a parameter.
    pub fn line(&self, path: &str) -> usize {
        self.params.iter().find(|(key, _)| quote::name(key) == path).map_or(1, |(_, line)| *line)
    }
}

/// A surface.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MaterialLook {
    /// Colour, multiplied with the texture: `#rrggbb` in the file, linear RGB here.
    #[serde(deserialize_with = "colour")]
    pub color: [f32; 3],
    /// Picture: a file beside the species file, or one of the built-in textures.
    #[serde(deserialize_with = "texture")]
    pub texture: Option<Texture>,
    /// Strength of the highlight, 0 to 1.
    #[serde(deserialize_with = "ranges::share")]
    pub specular: f32,
    /// Sharpness of the highlight, 0 to 1000.
    #[serde(deserialize_with = "ranges::shininess")]
    pub shininess: f32,
    /// Share of light that passes through, 0 to 1.
    #[serde(deserialize_with = "ranges::share")]
    pub translucency: f32,
    /// Whether the picture's alpha cuts the surface out.
    pub cut_out: bool,
    /// Whether both sides are seen.
    pub double_sided: bool,
}

impl Default for MaterialLook {
    fn default() -> Self {
        Self {
            color: [1.0; 3],
            texture: None,
            specular: 0.04,
            shininess: 20.0,
            translucency: 0.0,
            cut_out: false,
            double_sided: false,
        }
    }
}

impl MaterialLook {
    /// The material of that name.
    pub fn material(&self, name: &str) -> Material {
        Material {
            specular: [self.specular; 3],
            shininess: self.shininess,
            translucency: self.translucency,
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

/// Stems and branches.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StemLook {
    /// Material of trunk and stem.
    pub material: String,
    /// Material of young branches; that of the stem if left out.
    pub twig: Option<String>,
    /// Level in the branch hierarchy from which branches are young; 0 is the trunk.
    #[serde(default = "first_order", deserialize_with = "ranges::level")]
    pub twig_level: u32,
    /// Radius at their foot from which branches are old all the same, as a share of the thickest one's.
    #[serde(default = "a_quarter", deserialize_with = "ranges::share")]
    pub twig_thickest: f32,
}

fn first_order() -> u32 {
    1
}

fn a_quarter() -> f32 {
    0.25
}

/// Leaves.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeafLook {
    /// Materials; each leaf takes one at random.
    pub materials: Names,
    /// How leaves bend.
    #[serde(default)]
    pub form: BladeForm,
    /// How much the form differs from leaf to leaf, 0 to 1.
    #[serde(default, deserialize_with = "ranges::share")]
    pub vary: f32,
}

/// One look of a species' flowers.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FlowerLook {
    /// Petals.
    pub petals: PetalLook,
    /// Blades behind the petals.
    pub sepals: Option<SepalLook>,
    /// What carries the petals from behind.
    pub cup: Option<CupLook>,
    /// Heart of the flower.
    pub disc: DiscLook,
    /// Groups of stamens.
    #[serde(default)]
    pub stamens: Vec<ThreadLook>,
    /// Groups of styles.
    #[serde(default)]
    pub pistils: Vec<ThreadLook>,
}

/// Petals.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PetalLook {
    /// Materials; the petals of a flower take them in turn.
    pub materials: Names,
    /// How petals bend.
    #[serde(default)]
    pub form: BladeForm,
    /// How petals of half the longest one's length bend; those between are between.
    pub inner: Option<BladeForm>,
    /// How much the form differs from petal to petal, 0 to 1.
    #[serde(default, deserialize_with = "ranges::share")]
    pub vary: f32,
}

/// Sepals or bracts.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SepalLook {
    /// Material.
    pub material: String,
    /// Number; as many as petals if left out.
    #[serde(default, deserialize_with = "some_count")]
    pub count: Option<u32>,
    /// Length, share of the reach.
    #[serde(deserialize_with = "ranges::reach")]
    pub length: f32,
    /// Width, share of the length.
    #[serde(deserialize_with = "ranges::share")]
    pub width: f32,
    /// Where it is widest: 0 base, 1 tip.
    #[serde(default = "middle", deserialize_with = "ranges::share")]
    pub widest: f32,
    /// Angle between petals and sepals, degrees.
    #[serde(deserialize_with = "ranges::angle_deg")]
    pub gap_deg: f32,
    /// How sepals bend.
    #[serde(default)]
    pub form: BladeForm,
}

fn middle() -> f32 {
    0.4
}

fn some_count<'de, D: Deserializer<'de>>(source: D) -> Result<Option<u32>, D::Error> {
    ranges::count(source).map(Some)
}

/// Which way the cup behind the petals points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Along {
    /// Back along the flower's axis: the calyx of a daisy.
    Axis,
    /// Down the stem: the tube of jasmine.
    Stem,
}

/// Solid behind the petals: calyx cup, involucre or flower tube.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CupLook {
    /// Material.
    pub material: String,
    /// Radius at the petals, share of the reach.
    #[serde(deserialize_with = "ranges::share")]
    pub radius: f32,
    /// Length, share of the reach.
    #[serde(deserialize_with = "ranges::reach")]
    pub length: f32,
    /// Direction.
    pub along: Along,
}

/// Heart of the flower: a dome whose texture is seen from above.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DiscLook {
    /// Material.
    pub material: String,
    /// Least radius, share of the reach; a drawing with a wider heart widens it.
    #[serde(deserialize_with = "ranges::share")]
    pub radius: f32,
    /// Height, share of the radius.
    #[serde(deserialize_with = "ranges::ratio")]
    pub height: f32,
}

/// How the threads of a group stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Arrangement {
    /// In one ring.
    Whorl,
    /// Over the whole disc by the golden angle.
    Spiral,
    /// Along the axis by the golden angle, as on the column of a mallow.
    Column,
}

/// A group of stamens or styles.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThreadLook {
    /// Material of the threads.
    pub material: String,
    /// Material of their heads; that of the threads if left out.
    pub head_material: Option<String>,
    /// Number.
    #[serde(deserialize_with = "ranges::count")]
    pub count: u32,
    /// How they stand.
    pub arrangement: Arrangement,
    /// Length, share of the reach.
    #[serde(deserialize_with = "ranges::reach")]
    pub length: f32,
    /// Radius of the thread, share of the reach.
    #[serde(deserialize_with = "ranges::thin")]
    pub radius: f32,
    /// Radius and half length of the head, shares of the reach.
    #[serde(default, deserialize_with = "ranges::head")]
    pub head: [f32; 2],
    /// Distance of the ring, or of the outermost thread, from the axis: share of the disc's radius.
    #[serde(default, deserialize_with = "ranges::share")]
    pub ring: f32,
    /// Height of the lowest thread above the disc, share of the reach.
    #[serde(default, deserialize_with = "ranges::reach")]
    pub rise: f32,
    /// Length of the column, share of the reach.
    #[serde(default, deserialize_with = "ranges::reach")]
    pub column: f32,
    /// Angle between the axis and the outermost thread, degrees; never beyond the petals.
    #[serde(default, deserialize_with = "ranges::angle_deg")]
    pub spread_deg: f32,
    /// Bow away from the axis, share of the length; negative toward it.
    #[serde(default, deserialize_with = "ranges::bow")]
    pub bow: f32,
    /// How much length and direction differ from thread to thread, 0 to 1.
    #[serde(default, deserialize_with = "ranges::share")]
    pub vary: f32,
}

/// Small flowers in place of some of a tree's leaves, in the first look of the species' flowers.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BlossomLook {
    /// Share of the leaves that are flowers.
    #[serde(deserialize_with = "ranges::share")]
    pub share: f32,
    /// Petals of each.
    #[serde(deserialize_with = "ranges::count")]
    pub petals: u32,
    /// Distance from centre to tip, share of the leaves' mean length.
    #[serde(deserialize_with = "ranges::reach")]
    pub reach: f32,
    /// Width of a petal, share of its length.
    #[serde(deserialize_with = "ranges::share")]
    pub width: f32,
    /// Depth of the notch at the tip, share of the length.
    #[serde(default, deserialize_with = "ranges::share")]
    pub notch: f32,
    /// Angle between axis and petals, degrees.
    #[serde(deserialize_with = "ranges::angle_deg")]
    pub opening_deg: f32,
}

/// Thorns.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThornLook {
    /// Material.
    pub material: String,
    /// Length, in radii of the branch.
    #[serde(deserialize_with = "ranges::ratio")]
    pub length: f32,
    /// Mean distance along the branch, in radii of the branch.
    #[serde(deserialize_with = "ranges::ratio")]
    pub spacing: f32,
}

/// A pot, its rim a little above the foot of the lowest trunk.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PotLook {
    /// Material of the pot.
    pub material: String,
    /// Material of the earth in it.
    pub soil: String,
    /// Height, share of the plant's height.
    #[serde(deserialize_with = "ranges::share")]
    pub height: f32,
    /// Radius at the rim, share of the pot's height.
    #[serde(deserialize_with = "ranges::ratio")]
    pub radius: f32,
}

/// Names of one or more materials; in the file a string or a list of strings.
#[derive(Clone, Debug, PartialEq)]
pub struct Names(pub Vec<String>);

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
fn colour<'de, D: Deserializer<'de>>(source: D) -> Result<[f32; 3], D::Error> {
    let text = String::deserialize(source)?;
    let digits = text.strip_prefix('#').filter(|d| d.len() == 6 && d.is_ascii());
    let number = digits.and_then(|d| u32::from_str_radix(d, 16).ok());
    let number = number
        .ok_or_else(|| de::Error::custom(format!("`{}` is no colour; write #rrggbb", quote::name(&text))))?;
    Ok([16, 8, 0].map(|shift| linear_from_srgb(((number >> shift) & 0xff) as f32 / 255.0)))
}

/// A texture by name; [`super::file`] decides whether it is a file or built in.
fn texture<'de, D: Deserializer<'de>>(source: D) -> Result<Option<Texture>, D::Error> {
    String::deserialize(source).map(|name| Some(Texture::BuiltIn(name)))
}
