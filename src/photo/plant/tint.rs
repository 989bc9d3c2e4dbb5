//! Colours of a plant on a photograph, and textures of a species that have them.
//!
//! The colour of foliage is the median of its pixels in Lab, channel by channel, so that gaps of sky and single blossoms do not count;
//! beside it stand the medians of its dark and of its light quarter. Bark is the median of the trunk below the crown. A species'
//! texture is moved in Lab until its own median is that colour; veins and spots stay. Foliage shades itself, and does so again in the
//! picture of the model, so the lightness aimed at is halfway between the median and the light quarter.
//!
//! Limits: light is part of the colour: a plant photographed at sunset is red.

use super::super::error::PhotoError;
use super::super::lab::{Lab, lab_from_linear, srgb_of};
use super::super::raster::Raster;
use crate::picture::Picture;
use crate::picture::decode::{Rgba, decode};
use crate::plant::Texture;
use crate::sketch::{TextureChoice, Textures};
use crate::species::{Species, builtin_texture};
use crate::srgb::linear_from_srgb;
use glam::Vec3;

/// Pixels of a trunk from which its bark has a colour.
const LEAST: usize = 24;
/// Opacity from which a texture's pixel has a colour.
const OPAQUE: u8 = 128;

/// Colours of a plant, sRGB.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlantColours {
    /// The median of its foliage.
    pub leaf: [u8; 3],
    /// The median of the darkest quarter of it.
    pub leaf_dark: [u8; 3],
    /// The median of the lightest quarter of it.
    pub leaf_light: [u8; 3],
    /// The median of its trunk, if enough of it is seen.
    pub bark: Option<[u8; 3]>,
}

/// Colours of what these masks show; `None` where there is no foliage.
pub(super) fn colours(
    lab: &Raster<Lab>,
    foliage: &Raster<bool>,
    trunk: &Raster<bool>,
) -> Option<PlantColours> {
    let mut leaves = under(lab, foliage);
    leaves.sort_by(|a, b| a.x.total_cmp(&b.x));
    let quarter = leaves.len() / 4;
    let leaf = median(&leaves)?;
    let wood = under(lab, trunk);
    let bark = if wood.len() >= LEAST { median(&wood) } else { None };
    Some(PlantColours {
        leaf: srgb_of(leaf),
        leaf_dark: srgb_of(median(&leaves[..quarter]).unwrap_or(leaf)),
        leaf_light: srgb_of(median(&leaves[leaves.len() - quarter..]).unwrap_or(leaf)),
        bark: bark.map(srgb_of),
    })
}

fn under(lab: &Raster<Lab>, mask: &Raster<bool>) -> Vec<Lab> {
    lab.cells().iter().zip(mask.cells()).filter(|(_, is_in)| **is_in).map(|(colour, _)| *colour).collect()
}

/// The median of each channel; `None` of none.
fn median(colours: &[Lab]) -> Option<Lab> {
    let channel =
        |c: usize| super::super::background::quantile(colours.iter().map(|colour| colour[c]).collect(), 0.5);
    (!colours.is_empty()).then(|| Vec3::new(channel(0), channel(1), channel(2)))
}

impl PlantColours {
    /// What a leaf's texture has in the middle.
    fn leaf_lab(&self) -> Lab {
        let [leaf, light] = [self.leaf, self.leaf_light].map(lab_of_srgb);
        Vec3::new(leaf.x.midpoint(light.x), leaf.y, leaf.z)
    }
}

fn lab_of_srgb(colour: [u8; 3]) -> Lab {
    lab_from_linear(Vec3::from(colour.map(|c| linear_from_srgb(f32::from(c) / 255.0))))
}

/// The textures of a species' leaves and bark in a plant's colours, by kind of part, as drawings keep them. A species without a picture for
/// them gets an even one.
///
/// # Errors
/// A texture that cannot be encoded.
pub fn tinted_textures(species: &Species, colours: &PlantColours) -> Result<Textures, PhotoError> {
    let leaf = species.leaf.materials.0.first().map_or("", String::as_str);
    let parts = [
        ("leaf", leaf, Some(colours.leaf_lab())),
        ("branch", &species.stem.material, colours.bark.map(lab_of_srgb)),
    ];
    let mut textures = Textures::new();
    for (part, material, target) in parts {
        let Some(target) = target else { continue };
        let look = species.materials.get(material);
        let picture = look.and_then(|look| pixels_of(look.texture.as_ref()?));
        let tint = look.map_or([1.0; 3], |look| look.color);
        let texture = match picture {
            Some(picture) => moved(&picture, tint, target),
            None => even(target),
        };
        textures.insert(part.to_owned(), TextureChoice::Own(super::super::picture_of(&texture)?));
    }
    Ok(textures)
}

fn pixels_of(texture: &Texture) -> Option<Rgba> {
    match texture {
        Texture::BuiltIn(name) => decode(builtin_texture(name)?).ok(),
        Texture::Own(picture) => picture.pixels().ok(),
        Texture::File(path) => Picture::read_with_pixels(path).ok().map(|(_, pixels)| pixels),
    }
}

/// A small picture of one colour.
fn even(colour: Lab) -> Rgba {
    let [r, g, b] = srgb_of(colour);
    Rgba { width: 8, height: 8, pixels: [r, g, b, 255].repeat(64) }
}

/// A picture, whose colours are multiplied with `tint` (linear RGB), with its median moved to `target`; alpha stays.
fn moved(picture: &Rgba, tint: [f32; 3], target: Lab) -> Rgba {
    let tint = Vec3::from(tint);
    let lab = |[r, g, b, _]: &[u8; 4]| {
        lab_from_linear(Vec3::from([r, g, b].map(|c| linear_from_srgb(f32::from(*c) / 255.0))) * tint)
    };
    let pixels = picture.pixels.as_chunks::<4>().0;
    let opaque: Vec<Lab> = pixels.iter().filter(|pixel| pixel[3] >= OPAQUE).map(lab).collect();
    let by = target - median(&opaque).unwrap_or(target);
    let colour = |pixel: &[u8; 4]| {
        let [r, g, b] = srgb_of(lab(pixel) + by);
        [r, g, b, pixel[3]]
    };
    Rgba { pixels: pixels.iter().flat_map(colour).collect(), ..*picture }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::UVec2;

    #[test]
    fn foliage_is_its_median_with_a_dark_and_a_light_quarter() {
        let size = UVec2::new(100, 10);
        let mut lab = Raster::filled(size, Vec3::new(90.0, 0.0, -30.0));
        let (mut foliage, mut trunk) = (Raster::filled(size, false), Raster::filled(size, false));
        for y in 0..10 {
            for x in 0..80 {
                lab[(x, y)] = Vec3::new(20.0 + 0.5 * x as f32, -25.0, 25.0);
                foliage[(x, y)] = true;
            }
            (80..84).for_each(|x| (lab[(x, y)], trunk[(x, y)]) = (Vec3::new(35.0, 10.0, 15.0), true));
            // Sky between the leaves.
            (84..92).for_each(|x| foliage[(x, y)] = true);
        }
        let colours = colours(&lab, &foliage, &trunk).unwrap();
        let near = |colour: [u8; 3], l, a, b| lab_of_srgb(colour).distance(Vec3::new(l, a, b)) < 5.0;
        assert!(near(colours.leaf, 42.0, -25.0, 25.0), "{colours:?}");
        assert!(near(colours.leaf_dark, 25.0, -25.0, 25.0), "{colours:?}");
        assert!(near(colours.bark.unwrap(), 35.0, 10.0, 15.0), "{colours:?}");
        assert!(super::colours(&lab, &foliage.map(|_| false), &trunk).is_none());
    }

    #[test]
    fn textures_of_a_species_take_the_colours_and_keep_their_alpha() {
        let colours = PlantColours {
            leaf: [150, 60, 40],
            leaf_dark: [90, 30, 20],
            leaf_light: [190, 90, 60],
            bark: None,
        };
        let species = Species::built_in("oak").unwrap();
        let textures = tinted_textures(&species, &colours).unwrap();
        assert_eq!(textures.keys().collect::<Vec<_>>(), ["leaf"]);
        let TextureChoice::Own(picture) = &textures["leaf"] else { panic!("{textures:?}") };
        let pixels = picture.pixels().unwrap();
        let own = species.materials[&species.leaf.materials.0[0]].texture.clone().unwrap();
        let own = pixels_of(&own).unwrap();
        assert!(pixels.pixels.iter().zip(&own.pixels).skip(3).step_by(4).all(|(a, b)| a == b));
        let opaque = pixels.pixels.as_chunks::<4>().0.iter().filter(|pixel| pixel[3] >= OPAQUE);
        let lab: Vec<Lab> = opaque.map(|[r, g, b, _]| lab_of_srgb([*r, *g, *b])).collect();
        assert!(median(&lab).unwrap().distance(colours.leaf_lab()) < 3.0);
        let both = tinted_textures(&species, &PlantColours { bark: Some([90, 80, 70]), ..colours }).unwrap();
        assert_eq!(both.len(), 2);
    }
}
