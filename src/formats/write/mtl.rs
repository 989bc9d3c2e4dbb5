//! Materials for OBJ: the MTL file.
//!
//! Blinn-Phong as the plant has it: `Ka Kd Ks Ns`, `illum 2`; for programs that know microfacets only, `Pr`, the roughness
//! that glTF gets too. A picture is `map_Kd`, with the material's colour in it already (`tint.rs`), and again `map_d` where
//! its alpha cuts the surface out; a relief is a normal map, `norm`, and `map_Bump` for programs that look there for one, as Blender.
//! Paths are relative to the folder that holds OBJ, MTL and pictures. Translucency and
//! two-sidedness have no place in MTL and are left out: its `Tf` means glass.

use super::Scene;
use super::image_files::{ImageFile, ImageFiles};
use super::names::distinct_words;
use super::tint::Tinted;
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
    tinted: &Tinted,
    picture_files: &[String],
) -> Vec<u8> {
    let mut out = String::new();
    let materials = scene.model.materials.iter().zip(words).zip(scene.used_materials());
    for (i, ((material, word), used)) in materials.enumerate() {
        if used {
            let picture = tinted.pictures.of_material[i].map(|p| picture_files[p].as_str());
            let relief = tinted.pictures.relief_of_material[i].map(|p| picture_files[p].as_str());
            let material = beside_picture(material, tinted.diffuse[i]);
            write_material(&mut out, &material, word, [picture, relief]);
        }
    }
    out.into_bytes()
}

/// The material with what is left of its colour beside its picture. Ambient light is multiplied with the picture too.
fn beside_picture(material: &Material, diffuse: [f32; 3]) -> Material {
    let mut left = Material { diffuse, ..material.clone() };
    for ((ambient, before), after) in left.ambient.iter_mut().zip(material.diffuse).zip(diffuse) {
        *ambient = if before > 0.0 { (*ambient * after / before).min(1.0) } else { *ambient };
    }
    left
}

fn write_material(out: &mut String, material: &Material, word: &str, [picture, relief]: [Option<&str>; 2]) {
    let colour = |[r, g, b]: [f32; 3]| format!("{r} {g} {b}");
    // Writing to a string cannot fail.
    let _ = writeln!(out, "newmtl {word}");
    let _ = writeln!(out, "Ka {}", colour(material.ambient));
    let _ = writeln!(out, "Kd {}", colour(material.diffuse));
    let _ = writeln!(out, "Ks {}", colour(material.specular));
    let _ = writeln!(out, "Ns {}\nPr {}\nd 1\nillum 2", material.shininess, material.roughness());
    if let Some(picture) = picture {
        let _ = writeln!(out, "map_Kd {picture}");
        if material.cut_out {
            let _ = writeln!(out, "map_d {picture}");
        }
    }
    if let Some(relief) = relief {
        let _ = writeln!(out, "norm {relief}\nmap_Bump {relief}");
    }
    out.push('\n');
}

/// File names for the pictures, beginning with the model's own, so that no user's file is overwritten by chance.
pub(super) fn picture_files(stem: &str, pictures: &ImageFiles) -> Vec<String> {
    let words = distinct_words(pictures.all.iter().map(|picture| picture.stem.as_str()));
    let name =
        |(word, picture): (&String, &ImageFile)| format!("{stem}_{word}.{}", picture.format.extension());
    words.iter().zip(&pictures.all).map(name).collect()
}
