//! Materials for OBJ: the MTL file.
//!
//! Blinn-Phong as the plant has it: `Ka Kd Ks Ns`, `illum 2`; a picture as `map_Kd`, and again as `map_d` where its
//! alpha cuts the surface out. Paths are relative to the folder that holds OBJ, MTL and pictures. Translucency and
//! two-sidedness have no place in MTL and are left out.

use super::Scene;
use super::names::distinct_words;
use super::pictures::{Picture, Pictures};
use crate::plant::Material;
use std::fmt::Write;

/// The words that OBJ and MTL use for the model's materials, by material index.
pub(super) fn material_words(scene: &Scene<'_>) -> Vec<String> {
    distinct_words(scene.model.materials.iter().map(|material| material.name.as_str()))
}

/// The MTL file for the materials that parts use.
pub(super) fn encode(
    scene: &Scene<'_>,
    words: &[String],
    pictures: &Pictures,
    picture_files: &[String],
) -> Vec<u8> {
    let mut out = String::new();
    let materials = scene.model.materials.iter().zip(words).zip(scene.used_materials());
    for (i, ((material, word), used)) in materials.enumerate() {
        if used {
            let picture = pictures.of_material[i].map(|p| picture_files[p].as_str());
            write_material(&mut out, material, word, picture);
        }
    }
    out.into_bytes()
}

fn write_material(out: &mut String, material: &Material, word: &str, picture: Option<&str>) {
    let colour = |[r, g, b]: [f32; 3]| format!("{r} {g} {b}");
    // Writing to a string cannot fail.
    let _ = writeln!(out, "newmtl {word}");
    let _ = writeln!(out, "Ka {}", colour(material.ambient));
    let _ = writeln!(out, "Kd {}", colour(material.diffuse));
    let _ = writeln!(out, "Ks {}", colour(material.specular));
    let _ = writeln!(out, "Ns {}\nd 1\nillum 2", material.shininess);
    if let Some(picture) = picture {
        let _ = writeln!(out, "map_Kd {picture}");
        if material.cut_out {
            let _ = writeln!(out, "map_d {picture}");
        }
    }
    out.push('\n');
}

/// File names for the pictures, beginning with the model's own, so that no user's file is overwritten by chance.
pub(super) fn picture_files(stem: &str, pictures: &Pictures) -> Vec<String> {
    let words = distinct_words(pictures.all.iter().map(|picture| picture.stem.as_str()));
    let name = |(word, picture): (&String, &Picture)| format!("{stem}_{word}.{}", picture.format.extension());
    words.iter().zip(&pictures.all).map(name).collect()
}
