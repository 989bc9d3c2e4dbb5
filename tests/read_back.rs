//! Models that were written are read back to be looked at: in their place and colours, and what is missing is said.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::common::{provenance, textures, two_specimens};
use crate::export::{document, encoded, judged};
use glam::{Vec2, Vec3};
use penstemon::formats::read::{Embedded, ReadFormat, load};
use penstemon::formats::textures::fetch;
use penstemon::formats::write::{InstanceForm, Scene, export, format_of};
use penstemon::model::quality::judge_model;
use penstemon::model::{InstancedModel, Model};
use penstemon::picture::decode::decode;
use penstemon::pipeline::{self, Seed};
use penstemon::plant::Material;
use penstemon::species::{Species, builtin_texture};
use penstemon::srgb::linear_from_srgb;
use std::borrow::Cow;
use std::fs;
use std::path::Path;
use std::sync::Arc;

#[test]
fn copies_of_shapes_are_read_back_in_either_form() {
    let species = Species::built_in("oak").unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    let grown = pipeline::build(&Seed { number: 1, age: Some(4.0), ..Seed::default() }, &species, &params);
    let copies = InstancedModel::from(&grown.model);
    let built_in = |name: &str| builtin_texture(name).map(Cow::Borrowed);
    let [nodes, gpu] = [InstanceForm::Nodes, InstanceForm::Gpu].map(|form| {
        let scene =
            Scene::new(&copies.model, (&grown.plant, &grown.provenance), &built_in, Cow::Borrowed("oak"))
                .unwrap();
        let scene = scene.with_instances(&copies.groups, form).unwrap();
        format_of(Path::new("oak.glb")).unwrap().encode(&scene).unwrap().bytes
    });
    let folder = tempfile::tempdir().unwrap();
    let read = |bytes: &[u8]| {
        let path = folder.path().join("oak.glb");
        fs::write(&path, bytes).unwrap();
        load(&path).unwrap()
    };
    let (of_nodes, of_gpu) = (read(&nodes), read(&gpu));
    assert_eq!(of_nodes.model.triangle_count(), grown.model.triangle_count());
    assert!(of_nodes.warnings.is_empty(), "{:?}", of_nodes.warnings);
    assert_eq!(of_gpu.model.triangle_count(), grown.model.triangle_count());
    assert!(of_gpu.warnings.is_empty(), "{:?}", of_gpu.warnings);
    assert_eq!(of_gpu.model.bounds(), of_nodes.model.bounds());
}

/// For each material the colour that is seen: its own times that of the first pixel of its picture.
fn shown_colours(model: &Model, embedded: &Embedded) -> Vec<[f32; 3]> {
    let shown = |material: &Material| {
        let Some(texture) = &material.texture else { return material.diffuse };
        let bytes = match embedded.get(texture) {
            Some(bytes) => bytes.to_vec(),
            None => fetch(texture, &textures).unwrap().into_owned(),
        };
        let pixel = decode(&bytes).unwrap().pixels;
        std::array::from_fn(|k| material.diffuse[k] * linear_from_srgb(f32::from(pixel[k]) / 255.0))
    };
    model.materials.iter().map(shown).collect()
}

/// All corners of a model: where they are and the colour that is seen. Names of materials become words in OBJ.
fn corners(model: &Model, embedded: &Embedded) -> Vec<(Vec3, Vec2, [f32; 3])> {
    let shown = shown_colours(model, embedded);
    let mut corners = Vec::new();
    let slots = model.parts.iter().flat_map(|part| part.material_slots().map(move |slot| (part, slot)));
    for (part, (material, triangles)) in slots {
        for &corner in part.mesh.triangles[triangles].iter().flatten() {
            let vertex = &part.mesh.vertices[corner as usize];
            let point = part.mesh.points[vertex.point as usize];
            corners.push((point, vertex.uv, shown[material]));
        }
    }
    // Formats order parts in their own way; neighbours within rounding must not swap.
    let key = |(p, uv, colour): &(Vec3, Vec2, [f32; 3])| {
        let cell = |x: f32| (x * 1e3).round() as i64;
        (colour.map(|c| (c * 20.0).round() as i64), cell(p.x), cell(p.y), cell(p.z), cell(uv.x), cell(uv.y))
    };
    corners.sort_by_key(key);
    corners
}

/// Whether two colours are the same to what pictures can hold.
fn is_alike(a: [f32; 3], b: [f32; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 2e-3)
}

#[test]
fn a_model_that_was_written_is_loaded_in_its_place_and_colours() {
    let folder = tempfile::tempdir().unwrap();
    let (model, plant) = two_specimens();
    for file in ["a.glb", "a.obj"] {
        let path = folder.path().join(file);
        export(&path, &model, (&plant, &provenance()), &textures).unwrap();
        let loaded = load(&path).unwrap();
        assert!(loaded.warnings.is_empty(), "{file}: {:?}", loaded.warnings);
        let (read, written) =
            (corners(&loaded.model, &loaded.embedded), corners(&model, &Embedded::default()));
        for ((p, uv, colour), (point, own_uv, own)) in read.iter().zip(written) {
            let near = p.distance(point) < 2e-3 && uv.distance(own_uv) < 2e-3;
            assert!(
                near && is_alike(*colour, own),
                "{file}: {p} {uv} {colour:?}, not {point} {own_uv} {own:?}"
            );
        }
        assert_eq!(loaded.model.triangle_count(), model.triangle_count());
        let pictured = |model: &Model| {
            model.materials.iter().filter(|m| m.texture.is_some()).cloned().collect::<Vec<Material>>()
        };
        let (read, written) = (pictured(&loaded.model), pictured(&model));
        assert_eq!(read.len(), written.len(), "{file}");
        for (found, material) in read.iter().zip(written) {
            assert_eq!(found.cut_out, material.cut_out, "{file}");
            assert!((found.shininess - material.shininess).abs() < 0.1, "{file}: {}", found.shininess);
            assert!((found.specular[0] - material.specular[0]).abs() < 1e-3, "{file}: {:?}", found.specular);
            assert!(file == "a.obj" || found.translucency == material.translucency, "{file}");
            // Untouched where no colour had to go into it.
            if file == "a.glb" || material.diffuse == [1.0; 3] {
                let texture = found.texture.as_ref().unwrap();
                let bytes = match loaded.embedded.get(texture) {
                    Some(bytes) => bytes.to_vec(),
                    None => fetch(texture, &textures).unwrap().into_owned(),
                };
                assert_eq!(bytes, *fetch(material.texture.as_ref().unwrap(), &textures).unwrap(), "{file}");
            }
        }
    }
}

#[test]
fn a_part_of_two_materials_stays_one_surface_and_keeps_both() {
    let folder = tempfile::tempdir().unwrap();
    let (mut model, plant) = two_specimens();
    let trunk = &mut model.parts[0];
    let half = trunk.mesh.triangles.len() as u32 / 2;
    Arc::make_mut(&mut trunk.mesh).breaks.push(half);
    trunk.more_materials.push(2);
    let direct = judge_model(&model);
    for (format, file) in [(ReadFormat::Obj, "a.obj"), (ReadFormat::Glb, "a.glb")] {
        let report = judged(format, &encoded(file, &model, &plant).bytes);
        assert!(report.is_clean(), "{file}: {report:?}");
        assert_eq!(report.components, direct.components, "{file}");
        let path = folder.path().join(file);
        export(&path, &model, (&plant, &provenance()), &textures).unwrap();
        let loaded = load(&path).unwrap();
        let (read, written) =
            (corners(&loaded.model, &loaded.embedded), corners(&model, &Embedded::default()));
        for ((p, _, colour), (point, _, own)) in read.iter().zip(written) {
            assert!(
                p.distance(point) < 2e-3 && is_alike(*colour, own),
                "{file}: {p} {colour:?}, not {point} {own:?}"
            );
        }
    }
    let trunk = &document(&encoded("a.glb", &model, &plant).bytes).meshes[0];
    assert_eq!(trunk.primitives.len(), 2);
    assert_eq!(trunk.primitives[0].attributes, trunk.primitives[1].attributes, "vertices are there once");
    trunk.primitives[0].material.zip(trunk.primitives[1].material).map(|(a, b)| assert_ne!(a, b)).unwrap();
}

#[test]
fn breaks_that_do_not_fit_are_refused() {
    let (model, plant) = two_specimens();
    let refusal = |breaks: Vec<u32>, more_materials: Vec<usize>| {
        let mut model = model.clone();
        Arc::make_mut(&mut model.parts[0].mesh).breaks = breaks;
        model.parts[0].more_materials = more_materials;
        Scene::new(&model, (&plant, &provenance()), &textures, "a".into())
            .err()
            .map(|error| error.to_string())
    };
    assert!(refusal(vec![4], vec![]).unwrap().contains("materials and breaks"));
    assert!(refusal(vec![4], vec![99]).unwrap().contains("material out of range"));
    assert!(refusal(vec![1 << 20], vec![1]).unwrap().contains("breaks are not in order"));
    assert!(refusal(vec![4], vec![1]).is_none());
}

#[test]
fn a_surface_without_normals_gets_those_of_a_smooth_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tetrahedron.obj");
    fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n").unwrap();
    let loaded = load(&path).unwrap();
    let mesh = &loaded.model.parts[0].mesh;
    for vertex in &mesh.vertices {
        let outward = mesh.points[vertex.point as usize] - Vec3::splat(0.25);
        assert!(vertex.normal.is_normalized() && vertex.normal.dot(outward) > 0.0, "{vertex:?}");
    }
}

#[test]
fn a_missing_picture_or_library_is_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let (model, plant) = two_specimens();
    let path = folder.path().join("a.obj");
    export(&path, &model, (&plant, &provenance()), &textures).unwrap();
    for entry in fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().path()) {
        if entry.extension().is_some_and(|e| e == "png" || e == "jpg") {
            fs::remove_file(entry).unwrap();
        }
    }
    let loaded = load(&path).unwrap();
    assert!(!loaded.warnings.is_empty() && loaded.model.materials.iter().all(|m| m.texture.is_none()));
    fs::remove_file(folder.path().join("a.mtl")).unwrap();
    let loaded = load(&path).unwrap();
    assert!(loaded.warnings[0].contains("a.mtl"), "{:?}", loaded.warnings);
    assert_eq!(loaded.model.triangle_count(), model.triangle_count());
}
