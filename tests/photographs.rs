//! Petals, leaves and bark from photographs: from a file to the model, and what cannot be used.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use glam::Vec2;
use penstemon::model::PartKind;
use penstemon::photo::{BladeKind, BladePhoto, PhotoParams};
use penstemon::picture::decode::Rgba;
use penstemon::plant::OrganKind;
use penstemon::sketch::TextureChoice;
use penstemon::species::Species;
use penstemon::{pipeline, sketch};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn penstemon(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_penstemon")).current_dir(folder).args(args).output().unwrap()
}

fn refused(folder: &Path, args: &[&str], words: &str) {
    let output = penstemon(folder, args);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{args:?}: {message}");
    assert!(message.contains(words), "`{words}` is not in: {message}");
    assert!(!message.contains("panicked") && message.trim_end().lines().count() == 1, "{message}");
}

/// An upright leaf, 260 pixels wide and 500 high; its colours are places, its ground white.
fn photograph() -> Rgba {
    let (width, height) = (400u32, 600u32);
    let pixels = (0..width * height).flat_map(|i| {
        let at = Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5);
        let share = (550.0 - at.y) / 500.0;
        let half = 130.0 * (std::f32::consts::PI * share.clamp(0.0, 1.0)).sin();
        let off = at.x - 200.0;
        let covered = (half - off.abs() + 0.5).clamp(0.0, 1.0);
        let [red, green] = [20.0 + 0.5 * at.x, 20.0 + 0.35 * at.y];
        [red, green, 30.0, 255.0].map(|c| (c * covered + 255.0 * (1.0 - covered)) as u8)
    });
    Rgba { width, height, pixels: pixels.collect() }
}

/// A sound picture of so many pixels, in few bytes.
fn hundred_megapixels() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 10_000, 10_000);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::One);
    encoder.write_header().unwrap().write_image_data(&vec![0; 1250 * 10_000]).unwrap();
    bytes
}

fn place_of([r, g]: [u8; 2]) -> Vec2 {
    Vec2::new((f32::from(r) - 20.0) / 0.5, (f32::from(g) - 20.0) / 0.35)
}

#[test]
fn a_photograph_becomes_a_texture_an_outline_and_a_plant() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path();
    fs::write(folder.join("leaf.png"), photograph().to_png().unwrap()).unwrap();
    let args =
        ["photo", "leaf.png", "--kind", "leaf", "-o", "a.png", "-o", "a.svg", "-o", "a.penstemon", "--stats"];
    let made = penstemon(folder, &args);
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let stats: serde_json::Value = serde_json::from_slice(&made.stdout).unwrap();
    assert_eq!((&stats["kind"], &stats["creases"]), (&"leaf".into(), &0.into()));
    assert!((stats["base"][1].as_f64().unwrap() - 550.0).abs() < 6.0, "{stats}");
    assert!((stats["tip"][1].as_f64().unwrap() - 50.0).abs() < 6.0, "{stats}");
    let (traced, _) = sketch::read(&folder.join("a.svg")).unwrap();
    assert_eq!((traced.strokes.len(), traced.strokes[0].tool), (1, sketch::Tool::Leaf));
    let (low, high) = traced.bounds().unwrap();
    assert!((high - low - Vec2::new(260.0, 500.0)).abs().max_element() < 4.0, "{low} {high}");
    let built = penstemon(folder, &["build", "a.penstemon", "-o", "a.glb", "-o", "a.obj"]);
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    assert!(penstemon(folder, &["check", "a.glb"]).status.success());
    // The same again gives the same bytes.
    let first = fs::read(folder.join("a.penstemon")).unwrap();
    assert!(penstemon(folder, &args).status.success());
    assert!(fs::read(folder.join("a.penstemon")).unwrap() == first);
}

#[test]
fn petals_stand_in_a_ring_and_bark_on_a_trunk() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path();
    fs::write(folder.join("p.png"), photograph().to_png().unwrap()).unwrap();
    assert!(penstemon(folder, &["photo", "p.png", "--copies", "7", "-o", "p.penstemon"]).status.success());
    let report = penstemon(folder, &["inspect", "p.penstemon"]);
    let report: serde_json::Value = serde_json::from_slice(&report.stdout).unwrap();
    assert_eq!(report["flowers"][0]["petals"].as_array().map(Vec::len), Some(7), "{report}");
    let bark = penstemon(folder, &["photo", "p.png", "--kind", "bark", "-o", "b.png", "-o", "b.penstemon"]);
    assert!(bark.status.success(), "{}", String::from_utf8_lossy(&bark.stderr));
    assert!(penstemon(folder, &["build", "b.penstemon", "-o", "b.glb"]).status.success());
}

#[test]
fn what_cannot_be_used_is_refused_with_the_reason() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path();
    let write = |name: &str, bytes: &[u8]| fs::write(folder.join(name), bytes).unwrap();
    let whole = photograph().to_png().unwrap();
    write("leaf.png", &whole);
    write("cut.png", &whole[..whole.len() / 2]);
    write("text.png", b"no picture");
    write("dot.png", &Rgba { width: 1, height: 1, pixels: vec![7; 4] }.to_png().unwrap());
    write("grey.png", &Rgba { width: 60, height: 60, pixels: vec![200; 14_400] }.to_png().unwrap());
    write("giant.png", &hundred_megapixels());
    refused(
        folder,
        &["photo", "giant.png", "-o", "o.png"],
        "10000×10000 pixels; each side must be 1 to 8192",
    );
    refused(folder, &["photo", "cut.png", "-o", "o.png"], "damaged");
    refused(folder, &["photo", "text.png", "-o", "o.png"], "neither PNG nor JPEG");
    refused(folder, &["photo", "gone.png", "-o", "o.png"], "cannot be read");
    refused(folder, &["photo", "dot.png", "-o", "o.png"], "1×1 pixels");
    refused(folder, &["photo", "dot.png", "--kind", "bark", "-o", "o.png"], "1×1 pixels");
    refused(folder, &["photo", "grey.png", "-o", "o.png"], "stands out");
    refused(folder, &["photo", "leaf.png", "-o", "o.glb"], ".penstemon");
    refused(folder, &["photo", "leaf.png", "--kind", "bark", "-o", "o.svg"], "no outline");
    refused(folder, &["photo", "leaf.png", "-o", "leaf.png"], "same file");
    refused(
        folder,
        &["photo", "leaf.png", "-o", "o.png", "--base", "9999,3", "--tip", "3,3"],
        "base and tip",
    );
    refused(folder, &["photo", "leaf.png", "-o", "o.png", "--set", "clean.contrsat=1"], "clean.contrast");
    assert_eq!(
        penstemon(folder, &["photo", "leaf.png", "-o", "o.png", "--base", "3,3"]).status.code(),
        Some(2)
    );
    assert!(!folder.join("o.png").exists() && !folder.join("o.svg").exists());
    let listed = penstemon(folder, &["photo", "--params"]);
    assert!(String::from_utf8_lossy(&listed.stdout).contains("cutout.tolerance = 0.003"));
}

#[test]
fn what_is_painted_on_a_leaf_is_seen_there_on_its_mesh() {
    let picture = photograph();
    let mut params = PhotoParams::for_leaves();
    (params.clean.contrast, params.clean.blur) = (0.0, 0.0);
    let photo = BladePhoto::of_photograph(&picture, None, &params).unwrap();
    let mut drawing = photo.drawing((&picture, &params), BladeKind::Leaf, 1).unwrap();
    let TextureChoice::Own(texture) = &drawing.textures["leaf"] else { panic!("no picture") };
    let texture = texture.pixels().unwrap();
    // Upright in the plane of the paper, so that a place on the model is one on the paper.
    for path in ["depth.leaves.scatter", "depth.leaves.light_seeking"] {
        drawing.params.insert(path.to_owned(), 0.0.into());
    }
    let species = Species::built_in("plant").unwrap();
    let params = pipeline::params_of(&drawing, &species, &[]).unwrap();
    let built = pipeline::build(&drawing, &species, &params);
    let leaf = built.model.parts.iter().find(|part| part.kind == PartKind::Organ(OrganKind::Leaf)).unwrap();
    let stroke = drawing.strokes.iter().find(|stroke| stroke.tool == sketch::Tool::Leaf).unwrap();
    let bounds = |points: &mut dyn Iterator<Item = Vec2>| {
        points.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
    };
    let drawn = bounds(&mut stroke.points.iter().map(|point| point.position));
    let seen = bounds(&mut photo.outline.iter().copied());
    let (mut sum, mut count, mut worst) = (0.0, 0, 0.0f32);
    for vertex in &leaf.mesh.vertices {
        let world = leaf.mesh.points[vertex.point as usize];
        let canvas = built.provenance.world_from_canvas.canvas(world);
        let place = seen.0 + (canvas - drawn.0) / (drawn.1 - drawn.0) * (seen.1 - seen.0);
        let size = Vec2::new(texture.width as f32, texture.height as f32);
        let texel = (Vec2::new(vertex.uv.x, 1.0 - vertex.uv.y) * size).min(size - 1.0).as_uvec2();
        let pixel = 4 * (texel.y * texture.width + texel.x) as usize;
        let painted = place_of([texture.pixels[pixel], texture.pixels[pixel + 1]]);
        let off = painted.distance(place) / 500.0;
        (sum, count, worst) = (sum + off, count + 1, worst.max(off));
    }
    let mean = sum / count as f32;
    assert!(count > 60 && mean < 0.01 && worst < 0.03, "mean {mean}, worst {worst} of {count} vertices");
}

/// A green tree with a brown trunk, 300 × 360 pixels, and whether a pixel of it is plant.
fn tree_photograph() -> (Rgba, Vec<bool>) {
    let (width, height) = (300u32, 360u32);
    let mut truth = Vec::new();
    let pixels = (0..width * height).flat_map(|i| {
        let at = Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5);
        let grain = (i.wrapping_mul(2_654_435_761) >> 27) as f32 - 16.0;
        let is_crown = ((at - Vec2::new(150.0, 130.0)) / Vec2::new(85.0, 95.0)).length() < 1.0;
        let is_trunk = (at.x - 150.0).abs() < 9.0 && (130.0..320.0).contains(&at.y);
        truth.push(is_crown || is_trunk);
        let colour = match (is_crown, is_trunk, at.y < 290.0) {
            (true, ..) => [50.0, 100.0 + 0.3 * (150.0 - at.x), 40.0],
            (_, true, _) => [95.0, 70.0, 55.0],
            (.., true) => [150.0 + 0.2 * at.y, 185.0 + 0.1 * at.y, 235.0],
            _ => [150.0, 140.0, 95.0],
        };
        let [r, g, b] = colour.map(|c| (c + grain) as u8);
        [r, g, b, 255]
    });
    let pixels = pixels.collect();
    (Rgba { width, height, pixels }, truth)
}

#[test]
fn a_tree_on_a_photograph_becomes_a_drawing_that_grows_into_its_crown() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path();
    let (photograph, truth) = tree_photograph();
    fs::write(folder.join("tree.png"), photograph.to_png().unwrap()).unwrap();
    let args = [
        "photo",
        "tree.png",
        "--kind",
        "plant",
        "-o",
        "t.penstemon",
        "-o",
        "t.png",
        "-o",
        "t.svg",
        "--stats",
    ];
    let made = penstemon(folder, &args);
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let stats: serde_json::Value = serde_json::from_slice(&made.stdout).unwrap();
    assert_eq!((&stats["crowns"], &stats["holes"], &stats["species"]), (&1.into(), &0.into(), &"oak".into()));
    assert!((stats["trunk"]["width"].as_f64().unwrap() - 18.0).abs() < 3.0, "{stats}");
    assert!(stats["colours"]["bark"].is_string(), "{stats}");
    let mask = penstemon::picture::decode::decode(&fs::read(folder.join("t.png")).unwrap()).unwrap();
    let seen = mask.pixels.as_chunks::<4>().0.iter().map(|pixel| pixel[0] > 127);
    let (mut both, mut either) = (0, 0);
    for (seen, is_plant) in seen.zip(&truth) {
        both += u32::from(seen && *is_plant);
        either += u32::from(seen || *is_plant);
    }
    assert!(f64::from(both) > 0.95 * f64::from(either), "{both} of {either}");
    let (drawing, remarks) = sketch::read(&folder.join("t.penstemon")).unwrap();
    assert!(remarks.is_empty() && drawing.reference.is_some() && drawing.textures.len() == 2);
    let tools: Vec<sketch::Tool> = drawing.strokes.iter().map(|stroke| stroke.tool).collect();
    assert_eq!(tools, [sketch::Tool::Crown, sketch::Tool::Branch]);
    let (traced, _) = sketch::read(&folder.join("t.svg")).unwrap();
    assert_eq!(traced.strokes.len(), 2);
    let built = penstemon(folder, &["build", "t.penstemon", "-o", "t.glb", "--set", "growth.fineness=0.5"]);
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    assert!(penstemon(folder, &["check", "t.glb"]).status.success());
    // The same again gives the same bytes.
    let first = fs::read(folder.join("t.penstemon")).unwrap();
    assert!(penstemon(folder, &args).status.success());
    assert!(fs::read(folder.join("t.penstemon")).unwrap() == first);
    // A trunk that is drawn beside the photograph's comes to its middle.
    let drawn = ["--trunk", "143,318 144,270 143,230", "--species", "Birch", "--around", "20,20 280,20"];
    let made = penstemon(folder, &[&args[..], &drawn].concat());
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let stats: serde_json::Value = serde_json::from_slice(&made.stdout).unwrap();
    assert!((stats["trunk"]["foot"][0].as_f64().unwrap() - 150.0).abs() < 3.0, "{stats}");
    assert_eq!(stats["species"], "birch");
}

#[test]
fn photographs_and_marks_that_say_nothing_of_a_plant_are_refused() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path();
    let write = |name: &str, bytes: &[u8]| fs::write(folder.join(name), bytes).unwrap();
    let whole = tree_photograph().0.to_png().unwrap();
    write("tree.png", &whole);
    write("cut.png", &whole[..whole.len() / 2]);
    write("dot.png", &Rgba { width: 1, height: 1, pixels: vec![7; 4] }.to_png().unwrap());
    write("grey.png", &Rgba { width: 60, height: 60, pixels: vec![200; 14_400] }.to_png().unwrap());
    let plant = |name: &'static str, more: &[&'static str], words: &str| {
        refused(folder, &[&["photo", name, "--kind", "plant", "-o", "o.penstemon"], more].concat(), words);
    };
    plant("dot.png", &[], "1×1 pixels");
    plant("grey.png", &[], "draw a loose outline");
    plant("cut.png", &[], "damaged");
    plant("tree.png", &["-o", "o.glb"], ".penstemon a drawing");
    plant("tree.png", &["--outline", "3,3 9,9"], "at least three places");
    plant("tree.png", &["--trunk", "3,3"], "at least two places");
    plant("tree.png", &["--copies", "3"], "--copies");
    plant("tree.png", &["--species", "ook"], "oak");
    plant("tree.png", &["--set", "plant.side=9999"], "64 to 1024");
    refused(folder, &["photo", "tree.png", "-o", "o.png", "--around", "3,3"], "--kind plant");
    let wrong = ["photo", "tree.png", "--kind", "plant", "-o", "o.png", "--plant", "3;3"];
    assert_eq!(penstemon(folder, &wrong).status.code(), Some(2));
    assert!(!folder.join("o.penstemon").exists() && !folder.join("o.png").exists());
    let listed = penstemon(folder, &["photo", "--params"]);
    assert!(String::from_utf8_lossy(&listed.stdout).contains("plant.side = 512"));
}
