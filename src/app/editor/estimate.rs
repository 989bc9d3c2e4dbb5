//! The size of an export, estimated before it is made.
//!
//! Of a model the triangles of the chosen parts and the pictures of their materials count; of a drawing its samples. How
//! large a picture of the plant becomes depends on what is on it, and levels of detail on their cards: nobody knows before.

use crate::app::panels::snapshot::{ExportChoice, ExportFormat};
use crate::app::texture_files::built_in_texture;
use crate::garden::Garden;
use crate::model::{Model, PartKind};
use crate::plant::Texture;
use crate::sketch::Sketch;
use std::collections::HashSet;

/// Bytes per triangle of a GLB and of an OBJ file, as measured on the sample drawings.
const BYTES_PER_TRIANGLE: (u64, u64) = (50, 120);
/// Bytes per copy of a shape in a GLB file, as measured on the sample trees.
const BYTES_PER_COPY: u64 = 200;
/// Bytes per sample of an SVG file, as measured on the sample drawings.
const BYTES_PER_SAMPLE: u64 = 24;

/// Bytes of all files of an export together; `None` where nobody knows.
pub(super) fn bytes(
    choice: &ExportChoice,
    (model, garden): (&Model, Option<&Garden>),
    sketch: &Sketch,
) -> Option<u64> {
    let garden = garden.filter(|_| choice.garden);
    match choice.format {
        ExportFormat::Png => None,
        ExportFormat::Glb if choice.levels.is_some() => None,
        ExportFormat::Svg => {
            let samples: usize = sketch.strokes.iter().map(|stroke| stroke.points.len()).sum();
            Some(samples as u64 * BYTES_PER_SAMPLE)
        }
        ExportFormat::Glb => {
            let of_plant = surfaces(choice, model, (BYTES_PER_TRIANGLE.0, choice.copies));
            Some(of_plant + garden.map_or(0, |garden| of_garden(garden, (BYTES_PER_TRIANGLE.0, true))))
        }
        ExportFormat::Obj => {
            let of_plant = surfaces(choice, model, (BYTES_PER_TRIANGLE.1, false));
            Some(of_plant + garden.map_or(0, |garden| of_garden(garden, (BYTES_PER_TRIANGLE.1, false))))
        }
    }
}

/// Bytes of a garden without its textures, most of which are the program's own and small.
fn of_garden(garden: &Garden, (per_triangle, keeps_copies): (u64, bool)) -> u64 {
    match keeps_copies {
        true => {
            garden.stock.triangle_count() as u64 * per_triangle + garden.places.len() as u64 * BYTES_PER_COPY
        }
        false => garden.triangle_count() as u64 * per_triangle,
    }
}

fn surfaces(choice: &ExportChoice, model: &Model, (per_triangle, keeps_copies): (u64, bool)) -> u64 {
    let (mut triangles, mut copies) = (0, 0);
    let mut used = vec![false; model.materials.len()];
    for part in model.parts.iter().filter(|part| is_wanted(choice, part.kind)) {
        match part.copies.as_ref().filter(|_| keeps_copies) {
            Some(kept) => {
                let of_shapes: usize = kept.shapes.iter().map(|shape| shape.triangles.len()).sum();
                triangles += (part.mesh.triangles.len() + of_shapes) as u64;
                copies += kept.placements.len() as u64;
            }
            None => triangles += part.triangle_count() as u64,
        }
        for material in part.materials() {
            if let Some(used) = used.get_mut(material) {
                *used = true;
            }
        }
    }
    let materials = model.materials.iter().zip(used).filter(|(_, used)| *used && choice.textures);
    // Several materials may show one picture.
    let mut counted = HashSet::new();
    let textures = materials.filter_map(|(m, _)| m.texture.as_ref()).filter(|t| counted.insert(*t));
    triangles * per_triangle + copies * BYTES_PER_COPY + textures.map(size).sum::<u64>()
}

/// Whether a part goes into an export.
pub(super) fn is_wanted(choice: &ExportChoice, kind: PartKind) -> bool {
    match kind {
        PartKind::Wood => choice.branches,
        PartKind::Organ(organ) => choice.has(organ),
        PartKind::Ground => true,
    }
}

/// Bytes of a picture; a file that cannot be had is reported by the export itself.
fn size(texture: &Texture) -> u64 {
    match texture {
        Texture::BuiltIn(name) => built_in_texture(name).map_or(0, |bytes| bytes.len() as u64),
        Texture::File(path) => std::fs::metadata(path).map_or(0, |file| file.len()),
        Texture::Own(picture) => picture.bytes().len() as u64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{pipeline, sketch};
    use std::path::Path;

    /// What an export really takes, all its files together.
    fn real(choice: &ExportChoice, built: &crate::pipeline::Built, sketch: &Sketch) -> u64 {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plant").with_extension(choice.format.extension());
        if choice.format == ExportFormat::Svg {
            return sketch::svg::write(sketch).len() as u64;
        }
        let model = super::super::export::chosen_parts(&built.model, choice);
        let plant = (&built.plant, &built.provenance);
        let form = super::super::export::form_of_copies(choice);
        let sources = crate::input::Sources::default();
        let (paths, textures) = ([path], &built_in_texture);
        crate::formats::write::export_all(&paths, &model, plant, textures, form, &sources).unwrap();
        std::fs::read_dir(folder.path()).unwrap().map(|file| file.unwrap().metadata().unwrap().len()).sum()
    }

    #[test]
    fn estimates_are_near_what_is_written() {
        for (name, copies) in
            [("daisy", false), ("hepatica_blue", false), ("bouquet", false), ("tree_round", true)]
        {
            let path = format!("{}/assets/sketches/{name}.penstemon", env!("CARGO_MANIFEST_DIR"));
            let (sketch, _) = sketch::read(path.as_ref()).unwrap();
            let species = pipeline::species_of(&sketch, Path::new("")).unwrap();
            let built = pipeline::build(&sketch, &species, &pipeline::Params::default());
            for format in [ExportFormat::Glb, ExportFormat::Obj, ExportFormat::Svg] {
                for (textures, branches, leaves) in
                    [(true, true, true), (false, true, true), (true, false, copies)]
                {
                    let choice = ExportChoice {
                        format,
                        textures,
                        branches,
                        leaves,
                        copies,
                        ..ExportChoice::default()
                    };
                    let guess = bytes(&choice, (&built.model, None), &sketch).unwrap();
                    let real = real(&choice, &built, &sketch);
                    let ratio = guess as f64 / real as f64;
                    assert!((0.6..1.6).contains(&ratio), "{name} {choice:?}: {guess} for {real}");
                }
            }
        }
    }
}
