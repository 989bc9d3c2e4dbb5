//! Foliage as cards and levels of detail, as pictures and as files: a plant keeps its silhouette and its colour, and a GLB file holds
//! all levels but shows one.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use penstemon::formats::read;
use penstemon::formats::textures::fetch;
use penstemon::formats::write::{self, Surfaces};
use penstemon::input::Sources;
use penstemon::model::capsules::{Capsule, capsules};
use penstemon::model::{Levels, Model, Part, PartKind};
use penstemon::pipeline::{self, Bloom, Built, Level, Params, Seed};
use penstemon::plant::{Organ, OrganKind, Texture};
use penstemon::render::{Background, Direction, PictureOptions, Projection, Renderer, View};
use penstemon::sketch::Remark;
use penstemon::species::{Species, builtin_texture};
use serde_json::Value;
use std::borrow::Cow;
use std::error::Error;
use std::path::Path;

/// Width and height of pictures, pixels: of what is small, and of the plant that it stands for, of which nothing thin is lost.
const SMALL: u32 = 240;
const LARGE: u32 = 480;

fn texture(texture: &Texture) -> Result<Cow<'static, [u8]>, Box<dyn Error + Send + Sync>> {
    Ok(fetch(texture, &|name| builtin_texture(name).map(Cow::Borrowed))?)
}

fn grown(name: &str, age: f32, assignments: &[&str]) -> (Built, Params) {
    let species = Species::built_in(name).unwrap();
    let assignments: Vec<String> = assignments.iter().map(|&text| text.to_owned()).collect();
    let params = pipeline::params_of_species(&species, &assignments).unwrap();
    let seed = Seed { number: 1, age: Some(age), ..Seed::default() };
    (pipeline::build(&seed, &species, &params), params)
}

/// Share of a picture that a model covers, framed for another, and the mean colour of that, 0 to 255.
fn seen(
    renderer: &mut Renderer,
    (model, framed_for): (&Model, &Model),
    direction: Direction,
    side: u32,
) -> (f32, [f32; 3]) {
    let framed_for = renderer.upload(framed_for, &texture).unwrap();
    let mut model = renderer.upload(model, &texture).unwrap().framed_as(&framed_for);
    let view = View { direction, projection: Projection::Orthographic, turn_deg: 0.0 };
    let options = PictureOptions { width: side, height: side, background: Background::Transparent };
    let picture = renderer.pictures(&mut model, &[view], &options).next().unwrap().unwrap();
    let (mut covered, mut sum) = (0.0, [0.0; 3]);
    for &[r, g, b, a] in picture.pixels().as_chunks::<4>().0 {
        let share = f32::from(a) / 255.0;
        covered += share;
        sum.iter_mut().zip([r, g, b]).for_each(|(sum, value)| *sum += share * f32::from(value));
    }
    (covered / (side * side) as f32, sum.map(|sum| sum / covered))
}

/// Compares two models from two sides.
fn assert_alike(
    renderer: &mut Renderer,
    what: &str,
    (whole, few): (&Model, &Model),
    (area, colour): (f32, f32),
) {
    for direction in [Direction::Front, Direction::Side] {
        let (of_whole, light) = seen(renderer, (whole, whole), direction, LARGE);
        let (of_few, other) = seen(renderer, (few, whole), direction, SMALL);
        let share = of_few / of_whole;
        assert!((1.0 - area..=1.0 + area).contains(&share), "{what}: {share} of the silhouette");
        let off = light.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(off < colour, "{what}: colours {light:?} became {other:?}");
    }
}

/// Triangles of what is no wood.
fn foliage(model: &Model) -> usize {
    let is_foliage = |part: &&Part| part.kind != PartKind::Wood;
    model.parts.iter().filter(is_foliage).map(Part::triangle_count).sum()
}

#[test]
fn cards_cover_what_their_leaves_cover() {
    let mut renderer = Renderer::new().unwrap();
    // What is thin, as needles and the leaflets of an ash are, is lost first in small copies of a picture.
    // A spruce's leaves are pictures of twigs already, so that cards save less of them. By the leaf, for how many triangles a leaf
    // has without cards is another matter.
    let trees = [
        ("oak", 20.0, 1.8, 0.12),
        ("spruce", 12.0, 1.28, 0.15),
        ("maple", 14.0, 1.8, 0.12),
        ("ash", 10.0, 0.29, 0.15),
    ];
    for (name, age, most, area) in trees {
        let (leaves, _) = grown(name, age, &[]);
        let (cards, _) = grown(name, age, &["cards.used=true"]);
        let is_leaf = |organ: &&Organ| organ.kind() == OrganKind::Leaf;
        let count = leaves.plant.organs.iter().filter(is_leaf).count();
        let of_a_leaf = foliage(&cards.model) as f32 / count as f32;
        assert!(of_a_leaf < most, "{name}: {of_a_leaf} triangles for a leaf");
        assert_alike(&mut renderer, name, (&leaves.model, &cards.model), (area, 25.0));
    }
}

#[test]
fn plants_with_leaves_and_flowers_keep_both_as_cards() {
    let species = Species::built_in("marigold").unwrap();
    let built = |assignments: &[&str]| {
        let assignments: Vec<String> = assignments.iter().map(|&text| text.to_owned()).collect();
        let params = pipeline::params_of_species(&species, &assignments).unwrap();
        pipeline::build(&Bloom { number: 1 }, &species, &params).model
    };
    let (whole, cards) = (built(&[]), built(&["cards.used=true", "model.budget.triangles=6000"]));
    assert!(cards.triangle_count() * 4 < whole.triangle_count(), "{}", cards.triangle_count());
    let renderer = &mut Renderer::new().unwrap();
    // Orange flowers above green leaves: without either the colour would be that of the other.
    let mut redness = |model: &Model| {
        let (_, [red, green, _]) = seen(renderer, (model, &whole), Direction::Front, LARGE);
        red / green
    };
    let (of_whole, of_cards) = (redness(&whole), redness(&cards));
    assert!((of_cards / of_whole - 1.0).abs() < 0.25, "{of_cards} where the plant has {of_whole}");
}

#[test]
fn small_levels_look_like_the_plant() {
    let mut renderer = Renderer::new().unwrap();
    let (oak, params) = grown("oak", 20.0, &[]);
    let wanted =
        [Level::Triangles(25_000), Level::Triangles(8_000), Level::Triangles(2_000), Level::Billboards];
    let levels = pipeline::levels(&oak.plant, &oak.model, &params, &wanted);
    for (level, area) in levels.iter().zip([0.15, 0.18, 0.25, 0.3]) {
        let what = format!("{} triangles", level.triangle_count());
        assert_alike(&mut renderer, &what, (&oak.model, level), (area, 30.0));
    }
}

/// The document of a GLB file.
fn document(path: &Path) -> Value {
    let bytes = std::fs::read(path).unwrap();
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    serde_json::from_slice(&bytes[20..20 + length]).unwrap()
}

#[test]
fn a_file_of_levels_shows_the_finest_and_names_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("apple.glb");
    let (apple, params) = grown("apple", 8.0, &[]);
    let wanted = [Level::Triangles(20_000), Level::Triangles(4_000), Level::Billboards];
    let models = pipeline::levels(&apple.plant, &apple.model, &params, &wanted);
    let finest = models[0].triangle_count();
    let Levels { model, of_specimen } = Levels::of(models);
    let plant = (&apple.plant, &apple.provenance);
    let built_in = |name: &str| builtin_texture(name).map(Cow::Borrowed);
    let levels = Surfaces { level_of_specimen: &of_specimen, ..(&model).into() };
    let paths = [path.clone()];
    write::export_all(&paths, levels, plant, &built_in, None, &Sources::default()).unwrap();
    let document = document(&path);
    let nodes = document["nodes"].as_array().unwrap();
    let name = |index: &Value| nodes[index.as_u64().unwrap() as usize]["name"].as_str().unwrap();
    let shown = document["scenes"][0]["nodes"].as_array().unwrap();
    assert_eq!(shown.iter().map(name).collect::<Vec<_>>(), ["apple_LOD0"]);
    let first = &nodes[shown[0].as_u64().unwrap() as usize];
    let others = first["extensions"]["MSFT_lod"]["ids"].as_array().unwrap();
    assert_eq!(others.iter().map(name).collect::<Vec<_>>(), ["apple_LOD1", "apple_LOD2"]);
    assert_eq!(first["extras"]["MSFT_screencoverage"].as_array().unwrap().len(), 3);
    assert_eq!(
        document["extensionsUsed"].as_array().unwrap().iter().filter(|name| *name == "MSFT_lod").count(),
        1
    );
    let all: usize = read::read(&path).unwrap().iter().map(|surface| surface.mesh.triangles.len()).sum();
    assert_eq!(all, model.triangle_count(), "every level is judged");
    assert_eq!(read::load(&path).unwrap().model.triangle_count(), finest, "the finest is shown");
}

#[test]
fn capsules_hold_the_thick_wood_beside_the_finest_level() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("oak.glb");
    let (oak, params) = grown("oak", 14.0, &[]);
    let capsules = capsules(&oak.plant);
    assert!((2..=32).contains(&capsules.len()), "{} capsules", capsules.len());
    let trunk = &oak.plant.branches[0];
    let thick = trunk.points.iter().zip(&trunk.radii).filter(|(_, radius)| **radius > 0.3 * trunk.radii[0]);
    for (point, radius) in thick {
        let is_within = |capsule: &Capsule| {
            let [from, to] = capsule.ends;
            let share = ((*point - from).dot(to - from) / from.distance_squared(to)).clamp(0.0, 1.0);
            from.lerp(to, share).distance(*point) <= 1.5 * radius
        };
        assert!(capsules.iter().any(is_within), "{point} is in no capsule");
    }
    let wanted = [Level::Triangles(20_000), Level::Triangles(4_000)];
    let Levels { mut model, of_specimen } =
        Levels::of(pipeline::levels(&oak.plant, &oak.model, &params, &wanted));
    model.add_capsules(&capsules);
    let plant = (&oak.plant, &oak.provenance);
    let built_in = |name: &str| builtin_texture(name).map(Cow::Borrowed);
    let levels = Surfaces { level_of_specimen: &of_specimen, ..(&model).into() };
    write::export_all(std::slice::from_ref(&path), levels, plant, &built_in, None, &Sources::default())
        .unwrap();
    let document = document(&path);
    let nodes = document["nodes"].as_array().unwrap();
    let wood = nodes.iter().find(|node| node["name"] == "wood_LOD0").unwrap();
    let children = wood["children"].as_array().unwrap().iter();
    let names = children.map(|child| nodes[child.as_u64().unwrap() as usize]["name"].as_str().unwrap());
    let of_capsules = names.filter(|name| name.starts_with("UCP_wood_LOD0_")).count();
    assert_eq!(of_capsules, capsules.len());
}

#[test]
fn trees_of_few_triangles_keep_their_crown() {
    let mut renderer = Renderer::new().unwrap();
    for (name, age) in [("oak", 14.0), ("spruce", 10.0)] {
        let (whole, _) = grown(name, age, &[]);
        let (few, _) = grown(name, age, &["model.budget.triangles=3000"]);
        let says = |built: &Built| {
            built.remarks.iter().any(|said| matches!(said.remark, Remark::FoliageAsCards { .. }))
        };
        assert!(says(&few) && !says(&whole));
        assert_alike(&mut renderer, name, (&whole.model, &few.model), (0.3, 30.0));
        let (leaves, _) = grown(name, age, &["model.budget.triangles=3000", "cards.below=0"]);
        assert!(!says(&leaves));
    }
}
