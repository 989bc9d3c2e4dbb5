//! Pictures with a colour multiplied in.
//!
//! OBJ has a colour `Kd` beside its picture `map_Kd`, and MTL's description multiplies them; but many programs, Blender
//! among them, take the picture alone. So each picture is written once for every colour that materials have beside it,
//! with the colour in it, and `Kd` is 1. The product is taken in linear light, as renderers do; alpha stays.
//!
//! Limits: colours are held to 0 to 1, results are PNG. A picture that cannot be decoded stays as it is, and so does the
//! colour of its material.

use super::Scene;
use super::image_files::{ImageFile, ImageFiles};
use crate::picture::PictureFormat;
use crate::picture::decode::{Rgba, decode};
use crate::srgb::{linear_from_srgb, srgb_from_linear};

/// Colour that changes nothing.
const WHITE: [f32; 3] = [1.0; 3];

/// Pictures and, for each material of the model, the colour that remains beside its picture.
pub(super) struct Tinted {
    pub(super) pictures: ImageFiles,
    pub(super) diffuse: Vec<[f32; 3]>,
}

/// Multiplies the materials' colours into their pictures; each picture is there once for each colour, in the order in
/// which materials first want it.
pub(super) fn tinted(scene: &Scene<'_>, plain: ImageFiles) -> Tinted {
    let mut diffuse: Vec<[f32; 3]> = scene.model.materials.iter().map(|material| material.diffuse).collect();
    let of_material = vec![None; plain.of_material.len()];
    let mut pictures = ImageFiles { of_material, ..ImageFiles::default() };
    let mut known: Vec<(usize, [u8; 3])> = Vec::new();
    let mut remaining: Vec<[f32; 3]> = Vec::new();
    for (material, picture) in plain.of_material.iter().enumerate() {
        let Some(picture) = *picture else { continue };
        let colour = diffuse[material];
        let key = (picture, encoded(colour));
        let index = known.iter().position(|known| *known == key).unwrap_or_else(|| {
            let (coloured, left) = coloured(&plain.all[picture], colour);
            pictures.all.push(coloured);
            remaining.push(left);
            known.push(key);
            known.len() - 1
        });
        pictures.of_material[material] = Some(index);
        diffuse[material] = remaining[index];
    }
    // Normal maps, which have no colour, follow as they are.
    let first = plain.relief_of_material.iter().flatten().copied().min().unwrap_or(plain.all.len());
    let moved = pictures.all.len() - first;
    pictures.relief_of_material =
        plain.relief_of_material.iter().map(|index| index.map(|index| index + moved)).collect();
    pictures.all.extend_from_slice(&plain.all[first..]);
    Tinted { pictures, diffuse }
}

/// A colour as pictures hold it.
fn encoded(colour: [f32; 3]) -> [u8; 3] {
    colour.map(|c| (srgb_from_linear(c.clamp(0.0, 1.0)) * 255.0).round() as u8)
}

/// The picture with a colour in it, and the colour that is left to be multiplied.
fn coloured(picture: &ImageFile, colour: [f32; 3]) -> (ImageFile, [f32; 3]) {
    let name = encoded(colour);
    if name == [255; 3] {
        return (picture.clone(), WHITE);
    }
    let Some(bytes) = decode(&picture.bytes).ok().and_then(|pixels| multiplied(pixels, colour)) else {
        return (picture.clone(), colour);
    };
    let [r, g, b] = name;
    let stem = format!("{}_{r:02x}{g:02x}{b:02x}", picture.stem);
    (ImageFile { stem, format: PictureFormat::Png, bytes: bytes.into() }, WHITE)
}

/// The pixels times a colour, as a PNG file.
fn multiplied(mut picture: Rgba, colour: [f32; 3]) -> Option<Vec<u8>> {
    let product = |factor: f32| -> [u8; 256] {
        let times =
            |byte: usize| srgb_from_linear(linear_from_srgb(byte as f32 / 255.0) * factor.clamp(0.0, 1.0));
        std::array::from_fn(|byte| (times(byte) * 255.0).round() as u8)
    };
    let [red, green, blue] = colour.map(product);
    for [r, g, b, _] in picture.pixels.as_chunks_mut::<4>().0 {
        (*r, *g, *b) = (red[usize::from(*r)], green[usize::from(*g)], blue[usize::from(*b)]);
    }
    picture.to_png().ok()
}
