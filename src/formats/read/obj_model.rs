//! OBJ with MTL to a model that can be drawn.
//!
//! The geometry comes from `obj_surfaces.rs`, which keeps the faces in the file's order; here each run of faces after a
//! `usemtl` gets its material. MTL has no sidedness: both sides are shown.
//!
//! Limits: of an MTL file `Ka Kd Ks Ns Pr map_Kd map_d`; libraries and pictures beside the OBJ file only, which is where
//! exporters put them.

use super::error::Malformed;
use super::loaded::{Loaded, clay, is_picture};
use super::obj_surfaces;
use crate::formats::textures::fetch;
use crate::model::{Mesh, Vertex};
use crate::plant::{Material, Texture};
use crate::{input, quote};
use std::collections::BTreeMap;
use std::io::{BufReader, Read};
use std::path::Path;

/// Largest MTL file that is read, in bytes.
const MAX_LIBRARY_BYTES: u64 = 16 << 20;

pub(super) fn load(bytes: &[u8], folder: &Path) -> Result<Loaded, Malformed> {
    let mut loaded = Loaded::default();
    let plain = loaded.push_material(clay());
    let uses = Uses::of(bytes);
    let mut materials = BTreeMap::new();
    for library in &uses.libraries {
        let path = folder.join(library);
        loaded.files.push(path.clone());
        if let Err(reason) = load_library(&path, &mut loaded, &mut materials) {
            loaded.warnings.push(format!(
                "material library `{}`: {reason}; its surfaces stay plain",
                quote::name(library)
            ));
        }
    }
    for surface in obj_surfaces::surfaces(bytes)? {
        let mut meshes: BTreeMap<usize, Mesh> = BTreeMap::new();
        for (i, triangle) in surface.mesh.triangles.iter().enumerate() {
            let material = uses.of_triangle(i).and_then(|name| materials.get(name)).unwrap_or(&plain);
            push_triangle(meshes.entry(*material).or_default(), &surface.mesh, triangle);
        }
        for (material, mesh) in meshes {
            loaded.push(loaded.model.materials[material].name.clone(), mesh, material);
        }
    }
    Ok(loaded)
}

/// Copies a triangle with corners of its own.
fn push_triangle(mesh: &mut Mesh, from: &Mesh, triangle: &[u32; 3]) {
    let first = mesh.vertices.len() as u32;
    for &corner in triangle {
        let vertex = &from.vertices[corner as usize];
        let point = mesh.points.len() as u32;
        mesh.points.push(from.points[vertex.point as usize]);
        mesh.vertices.push(Vertex { point, ..*vertex });
    }
    mesh.triangles.push([first, first + 1, first + 2]);
}

/// What an OBJ file says of materials.
#[derive(Default)]
struct Uses {
    libraries: Vec<String>,
    /// The triangle from which on a material is used, counted as polygons are cut into fans.
    runs: Vec<(usize, String)>,
}

impl Uses {
    fn of(bytes: &[u8]) -> Self {
        let mut uses = Self::default();
        let mut triangles = 0;
        for line in bytes.split(|b| *b == b'\n') {
            let (word, rest) =
                line.split_at(line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len()));
            let rest = || String::from_utf8_lossy(rest).trim().to_owned();
            match word {
                b"mtllib" => uses.libraries.push(rest()),
                b"usemtl" => uses.runs.push((triangles, rest())),
                b"f" => triangles += rest().split_whitespace().count().saturating_sub(2),
                _ => {}
            }
        }
        uses
    }

    fn of_triangle(&self, triangle: usize) -> Option<&str> {
        let next = self.runs.partition_point(|(first, _)| *first <= triangle);
        Some(&self.runs.get(next.checked_sub(1)?)?.1)
    }
}

fn load_library(
    path: &Path,
    loaded: &mut Loaded,
    index_of_name: &mut BTreeMap<String, usize>,
) -> Result<(), String> {
    let (file, _) = input::open(path).map_err(|e| e.to_string())?;
    let mut text = BufReader::new(file.take(MAX_LIBRARY_BYTES));
    let (materials, _) = tobj::load_mtl_buf(&mut text).map_err(|e| e.to_string())?;
    let folder = path.parent().unwrap_or(Path::new(""));
    for material in materials {
        loaded.files.extend(pictures(&material).map(|name| folder.join(name)));
        let converted = converted(&material, folder, &mut loaded.warnings);
        let index = loaded.push_material(converted);
        index_of_name.insert(material.name, index);
    }
    Ok(())
}

/// Every picture that a material names.
fn pictures(material: &tobj::Material) -> impl Iterator<Item = &String> {
    let maps = [
        &material.ambient_texture,
        &material.diffuse_texture,
        &material.specular_texture,
        &material.normal_texture,
        &material.shininess_texture,
        &material.dissolve_texture,
    ];
    maps.into_iter().flatten()
}

fn converted(material: &tobj::Material, folder: &Path, warnings: &mut Vec<String>) -> Material {
    let plain = Material::plain(&material.name, material.diffuse.unwrap_or([1.0; 3]));
    let texture = material.diffuse_texture.as_ref().map(|name| Texture::File(folder.join(name)));
    let roughness = material.unknown_param.get("Pr").and_then(|value| value.trim().parse().ok());
    let from_roughness =
        roughness.map(|roughness| plain.clone().with_microfacets(roughness, [0.0; 3]).shininess);
    Material {
        ambient: material.ambient.unwrap_or(plain.ambient),
        specular: material.specular.unwrap_or(plain.specular),
        shininess: material.shininess.or(from_roughness).unwrap_or(plain.shininess),
        cut_out: material.dissolve_texture.is_some(),
        texture: texture.filter(|texture| is_usable(texture, &material.name, warnings)),
        double_sided: true,
        ..plain
    }
}

/// Whether a texture is there and a picture; warns if not.
fn is_usable(texture: &Texture, material: &str, warnings: &mut Vec<String>) -> bool {
    let Texture::File(path) = texture else { return false };
    let reason = match fetch(texture, &|_| None) {
        Ok(bytes) if is_picture(&bytes) => return true,
        Ok(_) => format!("{} is neither PNG nor JPEG", path.display()),
        Err(fault) => fault.to_string(),
    };
    warnings.push(format!("material `{}`: {reason}; it stays plain", quote::name(material)));
    false
}
