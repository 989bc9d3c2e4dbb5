//! Pictures of plants without a drawing: each species that grows, or has flowers without a drawing, still looks like its own.
//!
//! Of species that only grow or flower they are those by which they are chosen in the window. Those that are drawn, too, are
//! chosen by drawings; pictures of what they grow are kept with the tests.
//!
//! Every species is grown and drawn anew as its picture was, and compared by silhouette and by mean colour. Where that
//! is meant to change, `THUMBNAILS=write cargo test --release --test app -- every_species_looks` makes the pictures anew,
//! as `scripts/pictures.sh` does.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use glam::Vec3;
use penstemon::formats::textures::fetch;
use penstemon::growth::Obstacles;
use penstemon::model::Model;
use penstemon::picture::decode::decode;
use penstemon::pipeline::{self, Bloom, Seed};
use penstemon::plant::Texture;
use penstemon::render::{Background, Direction, PictureOptions, Projection, Renderer, View};
use penstemon::species::{Species, builtin_texture};
use std::borrow::Cow;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Width and height of a stored picture.
const SIDE: usize = 160;
/// A picture is drawn so many times as wide and high and then made smaller.
const FINER: usize = 3;

/// Least share of the pixels of two silhouettes that both have. No two of the stored pictures reach more than 0.60 (box
/// and hazel), so a picture in the wrong place fails. Drawn anew, with another way of making pictures smaller, a species
/// reaches 0.90 to 0.98 with its own; the rest down to the middle between is left for small changes of its wood.
const ALIKE: f32 = 0.75;
/// Largest difference of the mean colours of two silhouettes, in steps of 255, in any of red, green and blue. Drawn anew
/// a species differs by 6 from its own picture at most, and as much again is left. Between species it is 2 to 103: this
/// finds lost textures and other materials, the silhouette tells species apart.
const COLOUR: f32 = 12.0;

/// Red, green and blue, row by row from the top.
type Pixels = Vec<[f32; 3]>;

/// Species whose picture in the window is that of the drawing of their name.
const DRAWN: [&str; 1] = ["bamboo"];

/// Species that are chosen by a drawing and have flowers without one.
const DRAWN_OR_FLOWERING: [&str; 3] = ["daisy", "rose", "sunflower"];

/// Species that are chosen by their flower.
fn flowering() -> impl Iterator<Item = &'static str> {
    Species::blooming().into_iter().filter(|name| !DRAWN_OR_FLOWERING.contains(name))
}

/// Where the picture of a species is stored: the window's if there is no drawing of it, or if the drawing is its own.
fn path(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let only_grows = root.join(format!("assets/growth/{name}.toml")).exists();
    let in_window = only_grows || DRAWN.contains(&name) || flowering().any(|known| known == name);
    let folder = if in_window { "assets/species-thumbnails" } else { "tests/pictures/grown" };
    root.join(folder).join(format!("{name}.png"))
}

fn texture(texture: &Texture) -> Result<Cow<'static, [u8]>, Box<dyn Error + Send + Sync>> {
    Ok(fetch(texture, &|name| builtin_texture(name).map(Cow::Borrowed))?)
}

/// The picture of a species as it grows now.
fn drawn(renderer: &mut Renderer, name: &str) -> Pixels {
    let species = Species::built_in(name).unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    // What climbs is shown as it grows on a wall, without the wall.
    let climbs = species.growth.as_ref().is_some_and(|habit| habit.climb.is_some());
    let wall = || Obstacles::wall(Vec3::new(8.0, 8.0, 0.2)).moved(Vec3::Z * -0.3);
    let obstacles = climbs.then(|| Arc::new(wall()));
    let grown = pipeline::build(&Seed { number: 1, obstacles, ..Seed::default() }, &species, &params);
    picture(renderer, &grown.model)
}

/// The picture of one flower of a species on a short stem without leaves.
fn in_flower(renderer: &mut Renderer, name: &str) -> Pixels {
    let species = Species::built_in(name).unwrap();
    // A grammar of a species' own may have no peduncle that could be shorter.
    let short = ["flower.inflorescence.peduncle=0.06", "flower.bloom.stem=1.5"];
    let bare = ["flower.clump.stems=1", "flower.leaves.rosette=0", "flower.leaves.nodes=0"];
    let params = |assignments: &[&str]| {
        let assignments = bare.iter().chain(assignments).map(|&assignment| assignment.to_owned());
        pipeline::params_of_species(&species, &assignments.collect::<Vec<_>>())
    };
    let short = &short[usize::from(species.inflorescence.is_none())..][..1];
    let params = params(short).or_else(|_| params(&[])).unwrap();
    picture(renderer, &pipeline::build(&Bloom { number: 1 }, &species, &params).model)
}

/// The picture of a drawing as it is built now.
fn of_drawing(renderer: &mut Renderer, name: &str) -> Pixels {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/sketches/{name}.penstemon"));
    let (sketch, _) = penstemon::sketch::read(&path).unwrap();
    let species = pipeline::species_of(&sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(&sketch, &species, &[]).unwrap();
    picture(renderer, &pipeline::build(&sketch, &species, &params).model)
}

/// A model from the front.
fn picture(renderer: &mut Renderer, model: &Model) -> Pixels {
    let view = View { direction: Direction::Front, projection: Projection::Perspective, turn_deg: 0.0 };
    let side = (SIDE * FINER) as u32;
    let options = PictureOptions { width: side, height: side, background: Background::Paper };
    let picture = renderer.picture(model, &texture, &view, &options).unwrap();
    let mean = |k: usize| {
        let (x, y) = (k % SIDE * FINER, k / SIDE * FINER);
        let mut sum = [0.0; 3];
        for (dx, dy) in (0..FINER * FINER).map(|j| (j % FINER, j / FINER)) {
            let [r, g, b, _] = picture.pixel((x + dx) as u32, (y + dy) as u32).unwrap();
            [r, g, b].iter().zip(&mut sum).for_each(|(c, sum)| *sum += f32::from(*c));
        }
        sum.map(|c| c / (FINER * FINER) as f32)
    };
    (0..SIDE * SIDE).map(mean).collect()
}

fn stored(name: &str) -> Pixels {
    let picture = decode(&std::fs::read(path(name)).unwrap()).unwrap();
    assert_eq!((picture.width as usize, picture.height as usize), (SIDE, SIDE), "{name}");
    picture.pixels.as_chunks::<4>().0.iter().map(|[r, g, b, _]| [*r, *g, *b].map(f32::from)).collect()
}

fn store(name: &str, pixels: &Pixels) {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SIDE as u32, SIDE as u32);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let rgba: Vec<u8> = pixels.iter().flat_map(|c| [c[0] as u8, c[1] as u8, c[2] as u8, 255]).collect();
    encoder.write_header().unwrap().write_image_data(&rgba).unwrap();
    std::fs::write(path(name), bytes).unwrap();
}

/// Where the plant is: what is darker than its shadow or more colourful than paper.
fn silhouette(pixels: &Pixels) -> Vec<bool> {
    let plant = |[r, g, b]: &[f32; 3]| {
        let colourful = r.max(*g).max(*b) - r.min(*g).min(*b) > 45.0;
        colourful || 0.2126 * r + 0.7152 * g + 0.0722 * b < 110.0
    };
    pixels.iter().map(plant).collect()
}

/// How much of two plants' silhouettes is common to both, and by how much their mean colours differ.
fn likeness(one: &Pixels, other: &Pixels) -> (f32, f32) {
    let (here, there) = (silhouette(one), silhouette(other));
    let count =
        |both: &dyn Fn(bool, bool) -> bool| here.iter().zip(&there).filter(|(a, b)| both(**a, **b)).count();
    let mean = |pixels: &Pixels, mask: &[bool], c: usize| {
        let of = pixels.iter().zip(mask).filter(|(_, plant)| **plant).map(|(pixel, _)| pixel[c]);
        of.sum::<f32>() / mask.iter().filter(|plant| **plant).count() as f32
    };
    let apart = (0..3).map(|c| (mean(one, &here, c) - mean(other, &there, c)).abs()).fold(0.0, f32::max);
    (count(&|a, b| a && b) as f32 / count(&|a, b| a || b) as f32, apart)
}

fn is_alike((common, apart): (f32, f32)) -> bool {
    common >= ALIKE && apart <= COLOUR
}

#[test]
fn no_picture_passes_for_another() {
    let all: Vec<(String, Pixels)> =
        Species::growing().into_iter().map(|name| (name.to_owned(), stored(name))).collect();
    assert_eq!(all.len(), 22);
    for (name, pixels) in &all {
        for (other, others) in &all {
            assert_eq!(is_alike(likeness(pixels, others)), name == other, "{name} and {other}");
        }
    }
}

#[test]
fn every_species_looks_like_its_picture() {
    let mut renderer = Renderer::new().unwrap();
    let mut strangers = Vec::new();
    type Maker = fn(&mut Renderer, &str) -> Pixels;
    let grown = Species::growing().into_iter().map(|name| (name, drawn as Maker));
    let of_drawings = DRAWN.into_iter().map(|name| (name, of_drawing as Maker));
    let in_flower = flowering().map(|name| (name, in_flower as Maker));
    for (name, make) in grown.chain(of_drawings).chain(in_flower) {
        let now = make(&mut renderer, name);
        if std::env::var_os("THUMBNAILS").is_some_and(|value| value == "write") {
            store(name, &now);
        }
        let likeness = likeness(&now, &stored(name));
        if !is_alike(likeness) {
            strangers.push(format!("{name}: {:.2} in common, colours {:.0} apart", likeness.0, likeness.1));
        }
    }
    assert!(strangers.is_empty(), "not their own pictures, see the head of this file: {strangers:?}");
}
