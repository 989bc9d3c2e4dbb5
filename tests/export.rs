//! Files out: what is written reads back, is the same every time, and is whole or not there.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::common::{leafy, provenance, textures, two_specimens};
use glam::Vec3;
use gltf_json as json;
use penstemon::formats::read::{ReadFormat, from_bytes};
use penstemon::formats::write::{
    Encoded, ExportError, FORMATS, InstanceForm, Scene, export, format_of, glb, plant_json,
};
use penstemon::model::quality::{Report, judge, judge_model};
use penstemon::model::{InstancedModel, Mesh, Model, Part, Placement, Vertex};
use penstemon::picture::Picture;
use penstemon::picture::decode::decode;
use penstemon::pipeline::{self, Seed};
use penstemon::plant::{FinishedPlant, Material, Role, Texture, WoodPart};
use penstemon::species::{Species, builtin_texture};
use penstemon::srgb::linear_from_srgb;
use std::borrow::Cow;
use std::fs;
use std::path::Path;
use std::sync::Arc;

pub(crate) fn encoded(file: &str, model: &Model, plant: &FinishedPlant) -> Encoded {
    let path = Path::new(file);
    let stem = path.file_stem().unwrap().to_string_lossy();
    let provenance = provenance();
    let scene = Scene::new(model, (plant, &provenance), &textures, stem).unwrap();
    format_of(path).unwrap().encode(&scene).unwrap()
}

pub(crate) fn judged(format: ReadFormat, bytes: &[u8]) -> Report {
    let mut sum = Report::default();
    for surface in from_bytes(format, bytes).unwrap() {
        assert!(surface.has.normals && surface.has.uvs);
        sum.add(&judge(&surface.mesh, surface.has));
    }
    sum
}

pub(crate) fn document(glb: &[u8]) -> json::Root {
    let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    json::Root::from_slice(&glb[20..20 + length]).unwrap()
}

#[test]
fn the_fixture_is_clean() {
    let report = judge_model(&two_specimens().0);
    assert!(report.is_clean(), "{report:?}");
    assert_eq!(report.components, 8);
}

#[test]
fn both_formats_read_back_as_the_same_surface() {
    let (model, plant) = two_specimens();
    let direct = judge_model(&model);
    let obj = judged(ReadFormat::Obj, &encoded("a.obj", &model, &plant).bytes);
    let glb = judged(ReadFormat::Glb, &encoded("a.glb", &model, &plant).bytes);
    assert_eq!(obj, direct);
    assert_eq!(
        (glb.points, glb.triangles, glb.components),
        (direct.points, direct.triangles, direct.components)
    );
    assert!(glb.is_clean(), "{glb:?}");
}

#[test]
fn the_same_model_gives_the_same_bytes() {
    for format in FORMATS {
        let file = format!("plant.{}", format.extension());
        let (first, second) = (leafy(50), leafy(50));
        let (a, b) = (encoded(&file, &first.0, &first.1), encoded(&file, &second.0, &second.1));
        assert_eq!(a.bytes, b.bytes, "{file}");
        assert_eq!(a.companions, b.companions, "{file}");
    }
}

#[test]
fn obj_lines_are_what_other_programs_expect() {
    let (model, plant) = two_specimens();
    let text = String::from_utf8(encoded("my plant.obj", &model, &plant).bytes).unwrap();
    let count = |keyword: &str| text.lines().filter(|l| l.split(' ').next() == Some(keyword)).count();
    let points: usize = model.parts.iter().map(|part| part.points().count()).sum();
    assert_eq!((count("o"), count("g"), count("usemtl")), (2, 8, 8));
    assert_eq!((count("v"), count("vt"), count("vn")), (points, model.vertex_count(), model.vertex_count()));
    assert_eq!(count("f"), model.triangle_count());
    assert!(text.lines().all(|l| !l.starts_with("usemtl") || l.split(' ').count() == 2));
}

#[test]
fn obj_positions_lose_nothing() {
    let (model, plant) = two_specimens();
    let obj = encoded("a.obj", &model, &plant).bytes;
    let mut lines = std::str::from_utf8(&obj).unwrap().lines().filter_map(|l| l.strip_prefix("v "));
    for point in model.parts.iter().flat_map(Part::points) {
        let read: Vec<f32> = lines.next().unwrap().split(' ').map(|n| n.parse().unwrap()).collect();
        assert_eq!(read, point.to_array());
    }
}

#[test]
fn mtl_names_materials_and_pictures_that_exist() {
    let (model, plant) = two_specimens();
    let obj = encoded("my plant#2.obj", &model, &plant);
    let text = std::str::from_utf8(&obj.bytes).unwrap();
    let files: Vec<&str> = obj.companions.iter().map(|(name, _)| name.as_str()).collect();
    assert!(files.iter().all(|f| !f.contains([' ', '#'])), "{files:?}");
    let (mtl_file, mtl) = obj.companions.last().unwrap();
    assert!(text.contains(&format!("\nmtllib {mtl_file}\n")));
    let mtl = std::str::from_utf8(mtl).unwrap();
    for word in text.lines().filter_map(|l| l.strip_prefix("usemtl ")) {
        assert!(mtl.contains(&format!("newmtl {word}\n")), "{word}");
    }
    let pictures: Vec<&str> = mtl.lines().filter_map(|l| l.strip_prefix("map_Kd ")).collect();
    assert_eq!(pictures.len(), 3);
    assert!(pictures.iter().all(|p| files.contains(p)), "{pictures:?} in {files:?}");
    assert_eq!(mtl.matches("map_d ").count(), 1);
    assert!(mtl.contains("newmtl 叶\n") && !mtl.contains("newmtl unused"));
    assert!(
        ["\nKa ", "\nKd ", "\nKs ", "\nNs ", "\nPr ", "\nillum 2"]
            .iter()
            .all(|key| mtl.matches(key).count() == 3)
    );
}

#[test]
fn a_grown_plant_is_wood_and_leaves() {
    let species = Species::built_in("oak").unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    let grown = pipeline::build(&Seed { number: 1, age: Some(3.0), ..Seed::default() }, &species, &params);
    let written = |file: &str| {
        let built_in = |name: &str| builtin_texture(name).map(Cow::Borrowed);
        let scene =
            Scene::new(&grown.model, (&grown.plant, &grown.provenance), &built_in, Cow::Borrowed("oak"))
                .unwrap();
        format_of(Path::new(file)).unwrap().encode(&scene).unwrap().bytes
    };
    let obj = String::from_utf8(written("oak.obj")).unwrap();
    let groups: Vec<&str> = obj.lines().filter_map(|line| line.strip_prefix("g ")).collect();
    assert_eq!(groups, ["wood", "leaves"]);
    let root = document(&written("oak.glb"));
    let names = |names: Vec<Option<&String>>| {
        let mut names: Vec<String> = names.into_iter().flatten().cloned().collect();
        names.sort();
        names
    };
    let with_mesh = root.nodes.iter().filter(|node| node.mesh.is_some());
    assert_eq!(names(with_mesh.map(|node| node.name.as_ref()).collect()), ["leaves", "wood"]);
    assert_eq!(names(root.meshes.iter().map(|mesh| mesh.name.as_ref()).collect()), ["leaves", "wood"]);
}

#[test]
fn bark_has_its_grooves_in_every_format() {
    let species = Species::built_in("oak").unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    let grown = pipeline::build(&Seed { number: 1, age: Some(8.0), ..Seed::default() }, &species, &params);
    let built_in = |name: &str| builtin_texture(name).map(Cow::Borrowed);
    let scene =
        Scene::new(&grown.model, (&grown.plant, &grown.provenance), &built_in, Cow::Borrowed("oak")).unwrap();
    let encode = |file: &str| format_of(Path::new(file)).unwrap().encode(&scene).unwrap();
    let obj = encode("oak.obj");
    let mtl = std::str::from_utf8(&obj.companions.last().unwrap().1).unwrap();
    let named = |key: &str| mtl.lines().filter_map(|line| line.strip_prefix(key)).collect::<Vec<&str>>();
    let [map] = named("norm ")[..] else { panic!("one material has grooves:\n{mtl}") };
    assert_eq!(named("map_Bump "), [map]);
    let (_, of_obj) = obj.companions.iter().find(|(name, _)| name == map).unwrap();
    let glb = encode("oak.glb").bytes;
    let root = document(&glb);
    let with_map: Vec<&json::Material> =
        root.materials.iter().filter(|material| material.normal_texture.is_some()).collect();
    let [bark] = with_map[..] else { panic!("one material has grooves: {with_map:?}") };
    assert_eq!(bark.name.as_deref(), Some("bark"));
    let texture = &root.textures[bark.normal_texture.as_ref().unwrap().index.value()];
    let image = &root.images[texture.source.value()];
    let view = &root.buffer_views[image.buffer_view.unwrap().value()];
    assert!(image.name.as_ref().unwrap().ends_with("_normal"));
    // The body of a GLB is its last bytes.
    let body = glb.len() - root.buffers[0].byte_length.0 as usize;
    let bytes = &glb[body + view.byte_offset.unwrap().0 as usize..][..view.byte_length.0 as usize];
    assert!(bytes == &of_obj[..]);
    let wood = root.meshes.iter().find(|mesh| mesh.name.as_deref() == Some("wood")).unwrap();
    let semantic = json::validation::Checked::Valid(json::mesh::Semantic::Tangents);
    let of_material = |name: &str| {
        let named = |it: &&json::mesh::Primitive| {
            root.materials[it.material.unwrap().value()].name.as_deref() == Some(name)
        };
        wood.primitives.iter().find(named).unwrap().attributes.get(&semantic)
    };
    assert!(of_material("twig").is_none());
    let accessor = &root.accessors[of_material("bark").unwrap().value()];
    let view = &root.buffer_views[accessor.buffer_view.unwrap().value()];
    let start = body + view.byte_offset.unwrap().0 as usize + accessor.byte_offset.unwrap().0 as usize;
    let numbers = glb[start..][..16 * accessor.count.0 as usize].as_chunks::<4>().0;
    let numbers: Vec<f32> = numbers.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
    for &[x, y, z, w] in numbers.as_chunks::<4>().0 {
        assert!((Vec3::new(x, y, z).length() - 1.0).abs() < 1e-4 && w.abs() == 1.0, "{x} {y} {z} {w}");
    }
    let normals = decode(bytes).unwrap();
    let leans = |pixel: &&[u8; 4]| pixel[0].abs_diff(128) > 20;
    let leaning = normals.pixels.as_chunks::<4>().0.iter().filter(leans).count();
    assert!(10 * leaning > normals.pixels.len() / 4, "{leaning} pixels of grooves");
}

/// Bytes of a model's meshes and of the places of copies.
fn bytes_of(model: &Model) -> usize {
    let mesh = |mesh: &Mesh| {
        12 * mesh.points.len() + size_of::<Vertex>() * mesh.vertices.len() + 12 * mesh.triangles.len()
    };
    let copies = model.parts.iter().filter_map(|part| part.copies.as_ref());
    let of_copies = copies.map(|copies| {
        copies.shapes.iter().map(|shape| mesh(shape)).sum::<usize>()
            + size_of::<Placement>() * copies.placements.len()
    });
    model.parts.iter().map(|part| mesh(&part.mesh)).sum::<usize>() + of_copies.sum::<usize>()
}

#[test]
fn an_old_ash_of_copies_takes_a_third_of_what_its_triangles_take() {
    let species = Species::built_in("ash").unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    let ash = pipeline::build(&Seed { number: 1, age: Some(14.0), ..Seed::default() }, &species, &params);
    let flat = ash.model.flattened();
    assert!(flat.triangle_count() > 400_000);
    let [of_copies, of_triangles] = [&ash.model, &flat].map(bytes_of);
    assert!(3 * of_copies <= of_triangles, "{of_copies} bytes in memory, {of_triangles} as triangles");
    let built_in = |name: &str| builtin_texture(name).map(Cow::Borrowed);
    let scene =
        |model| Scene::new(model, (&ash.plant, &ash.provenance), &built_in, Cow::Borrowed("ash")).unwrap();
    let glb = |scene: Scene<'_>| format_of(Path::new("ash.glb")).unwrap().encode(&scene).unwrap().bytes.len();
    let whole = glb(scene(&ash.model));
    let instanced = InstancedModel::from(&ash.model);
    for form in [InstanceForm::Nodes, InstanceForm::Gpu] {
        let bytes = glb(scene(&instanced.model).with_instances(&instanced.groups, form).unwrap());
        assert!(3 * bytes <= whole, "{bytes} bytes of GLB as {form:?}, {whole} as triangles");
    }
}

#[test]
fn a_tree_in_blossom_is_a_few_parts() {
    let species = Species::built_in("cherry").unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    let grown = pipeline::build(&Seed { number: 1, age: Some(12.0), ..Seed::default() }, &species, &params);
    assert!(grown.plant.flowers.len() > 100, "{} flowers", grown.plant.flowers.len());
    let names: Vec<&str> = grown.model.parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["wood", "leaves", "petals", "receptacles", "stamens", "anthers"]);
    let built_in = |name: &str| builtin_texture(name).map(Cow::Borrowed);
    let scene =
        Scene::new(&grown.model, (&grown.plant, &grown.provenance), &built_in, Cow::Borrowed("cherry"))
            .unwrap();
    let root = document(&format_of(Path::new("cherry.glb")).unwrap().encode(&scene).unwrap().bytes);
    assert_eq!(root.nodes.len(), 1 + names.len());
    let draws: usize = root.meshes.iter().map(|mesh| mesh.primitives.len()).sum();
    assert!(draws < 20, "{draws} draws");
}

/// The MTL file of a model, and its pictures by name.
fn materials_beside(obj: &Encoded) -> (String, Vec<(&str, Vec<u8>)>) {
    let ((_, mtl), pictures) = obj.companions.split_last().unwrap();
    let pictures = pictures.iter().map(|(name, bytes)| (name.as_str(), bytes.to_vec()));
    (String::from_utf8(mtl.to_vec()).unwrap(), pictures.collect())
}

#[test]
fn obj_has_the_colour_of_a_material_in_its_picture() {
    let (model, plant) = two_specimens();
    let obj = encoded("a.obj", &model, &plant);
    let (mtl, pictures) = materials_beside(&obj);
    assert_eq!(mtl.matches("\nKd 1 1 1\n").count(), 3, "{mtl}");
    let pixel =
        |name: &str| decode(&pictures.iter().find(|(file, _)| *file == name).unwrap().1).unwrap().pixels;
    let of_material = |word: &str| {
        let after = mtl.split_once(&format!("newmtl {word}\n")).unwrap().1;
        pixel(after.lines().find_map(|line| line.strip_prefix("map_Kd ")).unwrap())
    };
    assert_eq!(of_material("leaf"), [40, 160, 60, 255]);
    let light = |byte: u8| linear_from_srgb(f32::from(byte) / 255.0);
    for (found, (plain, colour)) in of_material("叶").iter().zip([(40, 0.9), (160, 0.2), (60, 0.1)]) {
        assert!((light(*found) - light(plain) * colour).abs() < 2e-3, "{found}");
    }
}

#[test]
fn materials_of_one_colour_and_picture_share_a_file() {
    let (mut model, plant) = two_specimens();
    model.materials[1].diffuse = model.materials[2].diffuse;
    let obj = encoded("a.obj", &model, &plant);
    let (mtl, pictures) = materials_beside(&obj);
    assert_eq!((pictures.len(), mtl.matches("map_Kd ").count()), (2, 3));
}

#[test]
fn obj_and_glb_are_equally_rough() {
    let (model, plant) = two_specimens();
    let (mtl, _) = materials_beside(&encoded("a.obj", &model, &plant));
    let rough = mtl.lines().filter_map(|line| line.strip_prefix("Pr ")).map(|n| n.parse::<f32>().unwrap());
    let root = document(&encoded("a.glb", &model, &plant).bytes);
    let glb = root.materials.iter().map(|m| m.pbr_metallic_roughness.roughness_factor.0);
    assert_eq!(rough.collect::<Vec<_>>(), glb.collect::<Vec<_>>());
}

#[test]
fn glb_says_how_strong_highlights_are_and_what_shines_through() {
    let (model, plant) = two_specimens();
    let root = document(&encoded("a.glb", &model, &plant).bytes);
    let used = ["KHR_materials_diffuse_transmission", "KHR_materials_specular"];
    assert_eq!(
        (root.extensions_used.as_slice(), root.extensions_required.len()),
        (&used.map(String::from)[..], 0)
    );
    let leaf = &root.materials[1];
    let extensions = &leaf.extensions.as_ref().unwrap().others;
    let number = |name: &str, key: &str| extensions[name][key].as_f64().unwrap() as f32;
    let strength = number(used[1], "specularFactor");
    assert!((strength - 0.12 * 8.0 / 32.0 / 0.04).abs() < 1e-6, "{strength}");
    assert_eq!(number(used[0], "diffuseTransmissionFactor"), 0.35);
    let texture = leaf.pbr_metallic_roughness.base_color_texture.as_ref().unwrap().index.value();
    assert_eq!(extensions[used[0]]["diffuseTransmissionColorTexture"]["index"], texture);
}

#[test]
fn glb_nodes_follow_the_branch_tree_with_pivots_at_the_base() {
    let (model, plant) = two_specimens();
    let root = document(&encoded("a.glb", &model, &plant).bytes);
    assert_eq!(root.scenes[0].nodes.len(), 2);
    let mut pivots = vec![glam::Vec3::ZERO; root.nodes.len()];
    let mut names = vec![String::new(); root.nodes.len()];
    let mut open: Vec<usize> = root.scenes[0].nodes.iter().map(|n| n.value()).collect();
    open.iter().for_each(|&i| pivots[i] = root.nodes[i].translation.unwrap_or_default().into());
    while let Some(i) = open.pop() {
        for child in root.nodes[i].children.iter().flatten().map(|c| c.value()) {
            pivots[child] = pivots[i] + glam::Vec3::from(root.nodes[child].translation.unwrap_or_default());
            names[child] = root.nodes[i].name.clone().unwrap();
            open.push(child);
        }
    }
    for part in &model.parts {
        let node = root.nodes.iter().position(|n| n.name.as_deref() == Some(part.name.as_str())).unwrap();
        assert!(pivots[node].abs_diff_eq(part.pivot, 1e-6), "{}", part.name);
        let parent =
            part.parent.map_or(format!("plant_{}", part.specimen + 1), |p| model.parts[p].name.to_string());
        assert_eq!(names[node], parent, "{}", part.name);
    }
}

fn index_types(root: &json::Root) -> Vec<&'static str> {
    use json::accessor::{ComponentType, GenericComponentType};
    use json::validation::Checked::Valid;
    let indices = root.meshes.iter().map(|m| &root.accessors[m.primitives[0].indices.unwrap().value()]);
    let name = |accessor: &json::Accessor| match accessor.component_type {
        Valid(GenericComponentType(ComponentType::U16)) => "U16",
        Valid(GenericComponentType(ComponentType::U32)) => "U32",
        _ => "another",
    };
    indices.map(name).collect()
}

#[test]
fn glb_materials_and_indices_fit() {
    use json::validation::Checked::Valid;
    let (model, plant) = two_specimens();
    let root = document(&encoded("a.glb", &model, &plant).bytes);
    let names: Vec<&str> = root.materials.iter().map(|m| m.name.as_deref().unwrap()).collect();
    assert_eq!(names, ["bark #1 rough", "leaf", "叶"]);
    let leaf = &root.materials[1];
    assert!(leaf.double_sided && leaf.alpha_mode == Valid(json::material::AlphaMode::Mask));
    assert_eq!((root.images.len(), root.textures.len()), (2, 2));
    assert_eq!(index_types(&root), ["U16"; 8]);
}

#[test]
fn large_meshes_get_wide_indices() {
    let (mut model, plant) = two_specimens();
    let mesh = Arc::make_mut(&mut model.parts[0].mesh);
    let vertices = &mut mesh.vertices;
    let filler: Vertex = vertices[0];
    vertices.resize(65_536, filler);
    vertices.push(filler);
    mesh.triangles[0][0] = 65_536;
    let glb = encoded("a.glb", &model, &plant).bytes;
    assert_eq!(judged(ReadFormat::Glb, &glb).triangles, model.triangle_count());
    assert_eq!(index_types(&document(&glb)), ["U32", "U16", "U16", "U16", "U16", "U16", "U16", "U16"]);
}

#[test]
fn plant_json_holds_every_number_of_the_plant() {
    let (_, plant) = two_specimens();
    let bytes = plant_json::to_bytes(&plant, &provenance()).unwrap();
    let value: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
    let materials: Vec<Material> = serde_json::from_value(value["materials"].clone()).unwrap();
    assert_eq!(materials, plant.materials());
    for (read, branch) in value["branches"].as_array().unwrap().iter().zip(&plant.branches) {
        assert_eq!(serde_json::from_value::<Vec<Vec3>>(read["points"].clone()).unwrap(), branch.points);
        assert_eq!(serde_json::from_value::<Vec<f32>>(read["radii"].clone()).unwrap(), branch.radii);
        assert_eq!(read["material"], plant.material(branch.role));
    }
    assert_eq!(value["branches"].as_array().unwrap().len(), plant.branches.len());
    assert_eq!(value["world_from_canvas"]["origin"], serde_json::json!([512.0, 700.0]));
    assert_eq!(value["branches"][0]["stroke"], 7);
    assert!(value["branches"][0]["points"][1][1].is_f64() && value["organs"].is_array());
}

#[test]
fn plant_json_holds_own_pictures_and_no_folders() {
    let (_, plant) = two_specimens();
    let own = Picture::new(&include_bytes!("fixtures/reference/small.png")[..]).unwrap();
    let mut materials = plant.materials().to_vec();
    materials[1].texture = Some(Texture::Own(own));
    materials[2].texture = Some(Texture::File("/home/ada/leaf.png".into()));
    let role = |variant| Role { variant, ..Role::of(WoodPart::Stem.into()) };
    let roles: Vec<Role> = (0..materials.len() as u32).map(role).collect();
    let plant = FinishedPlant::new((*plant).clone(), &roles, |role| materials[role.variant as usize].clone());
    let bytes = plant_json::to_bytes(&plant, &provenance()).unwrap();
    assert!(!String::from_utf8_lossy(&bytes).contains("/home"));
    let value: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
    let mut read: Vec<Material> = serde_json::from_value(value["materials"].clone()).unwrap();
    assert_eq!(read[2].texture, Some(Texture::File("leaf.png".into())));
    read[2].texture.clone_from(&materials[2].texture);
    assert_eq!(read, materials);
}

#[test]
fn own_pictures_are_named_by_the_materials_that_show_them() {
    let (mut model, plant) = two_specimens();
    let own = |bytes: &'static [u8]| Some(Texture::Own(Picture::new(bytes).unwrap()));
    model.materials[1].texture = own(include_bytes!("fixtures/reference/small.png"));
    model.materials[2].texture = own(include_bytes!("fixtures/reference/small.jpg"));
    let obj = encoded("a.obj", &model, &plant);
    let names: Vec<&str> = materials_beside(&obj).1.iter().map(|(name, _)| *name).collect();
    for material in &model.materials[1..=2] {
        assert!(names.iter().any(|name| name.contains(&material.name)), "{names:?}: {}", material.name);
    }
    assert!(!names.iter().any(|name| name.contains("picture")), "{names:?}");
}

#[test]
fn export_writes_all_files_and_nothing_else() {
    let (model, plant) = two_specimens();
    let folder = tempfile::tempdir().unwrap();
    let size = export(&folder.path().join("plant.obj"), &model, (&plant, &provenance()), &textures).unwrap();
    let names = || {
        let mut names: Vec<_> =
            fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect();
        names.sort();
        names
    };
    let files = names();
    assert_eq!(files.len(), 5, "the model, its materials, three pictures: {files:?}");
    let on_disk: u64 =
        fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().metadata().unwrap().len()).sum();
    assert_eq!(on_disk, size as u64);
    export(&folder.path().join("plant.obj"), &model, (&plant, &provenance()), &textures).unwrap();
    assert_eq!(names(), files);
}

fn refused(path: &Path, model: &Model, plant: &FinishedPlant) -> String {
    export(path, model, (plant, &provenance()), &textures).unwrap_err().to_string()
}

#[test]
fn unwritable_targets_are_one_message_and_no_file() {
    let (model, plant) = two_specimens();
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file"), b"").unwrap();
    fs::create_dir(folder.path().join("folder.obj")).unwrap();
    for (target, reason) in [
        ("nowhere/plant.obj", "there is no folder"),
        ("file/plant.glb", "there is no folder"),
        ("folder.obj", "there is a folder of this name"),
        (
            "plant.fbx",
            "`fbx` is no format that can be written; name the output with one of the extensions obj, glb, json",
        ),
        ("plant", "no extension"),
    ] {
        let message = refused(&folder.path().join(target), &model, &plant);
        assert!(message.contains(reason) && message.contains(target), "{message}");
        assert!(!message.contains('\n'));
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn textures_that_cannot_be_had_are_named_with_their_material() {
    let (model, plant) = two_specimens();
    let folder = tempfile::tempdir().unwrap();
    let text = folder.path().join("notes.png");
    fs::write(&text, b"no picture at all").unwrap();
    for (texture, reason) in [
        (Texture::BuiltIn("rose.png".into()), "no built-in texture `rose.png`"),
        (Texture::File(folder.path().join("gone.png")), "cannot read the picture"),
        (Texture::File(text), "neither PNG nor JPEG"),
    ] {
        for target in ["plant.obj", "plant.glb"] {
            let mut model = model.clone();
            model.materials[1].texture = Some(texture.clone());
            let message = refused(&folder.path().join(target), &model, &plant);
            assert!(message.contains("material `leaf`") && message.contains(reason), "{message}");
            assert!(!folder.path().join(target).exists());
        }
    }
}

#[test]
fn a_users_picture_of_the_same_name_is_not_overwritten() {
    let (mut model, plant) = two_specimens();
    let folder = tempfile::tempdir().unwrap();
    let own = folder.path().join("leaf.png");
    let jpeg = b"\xff\xd8\xff a picture for this test".to_vec();
    fs::write(&own, &jpeg).unwrap();
    model.materials[2].texture = Some(Texture::File(own.clone()));
    export(&folder.path().join("plant.obj"), &model, (&plant, &provenance()), &textures).unwrap();
    assert_eq!(fs::read(&own).unwrap(), jpeg);
    assert_eq!(fs::read(folder.path().join("plant_leaf_2.jpg")).unwrap(), jpeg);
}

#[test]
fn models_that_are_not_sound_or_empty_are_refused() {
    let (model, plant) = two_specimens();
    let message = |model: &Model| match Scene::new(model, (&plant, &provenance()), &textures, "a".into()) {
        Err(error) => error.to_string(),
        Ok(scene) => penstemon::formats::write::Exporter::encode(&glb::Glb, &scene).unwrap_err().to_string(),
    };
    let mut bad = model.clone();
    Arc::make_mut(&mut bad.parts[3].mesh).points[0].x = f32::NAN;
    assert!(message(&bad).contains("part 3 `leaf_3`: point 0 is not finite"));
    bad = model.clone();
    Arc::make_mut(&mut bad.parts[1].mesh).triangles[2][1] = 99_999;
    assert!(message(&bad).contains("triangle 2 has a vertex out of range"));
    assert!(message(&Model::default()).contains("nothing to write"));
    assert!(matches!(format_of(Path::new("x.OBJ")).map(|f| f.extension()), Ok("obj")));
    assert!(matches!(format_of(Path::new("x")), Err(ExportError::UnknownFormat { .. })));
}
