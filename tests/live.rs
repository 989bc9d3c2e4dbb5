//! Building while a drawing changes: the same plant as from scratch, what has not changed shared, and a stop heeded.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::drawings;
use glam::{Quat, Vec2, Vec3};
use penstemon::anatomy::{self, AnatomyParams};
use penstemon::model::Model;
use penstemon::pipeline::{self, Ages, Built, Cache, Seed};
use penstemon::plant::{GrownId, OrganKind, Origin, Shape, Texture};
use penstemon::sketch::garden::for_garden;
use penstemon::sketch::part_poses::posed;
use penstemon::sketch::petal_shapes::shaped;
use penstemon::sketch::{
    self, Brush, GardenPlant, GardenPoint, GardenStroke, GardenStrokes, GardenTool, Maker, PartName,
    PartPose, PetalShape, PlacedPlant, SeedOf, Sketch, Stroke, Tool,
};
use penstemon::species::Species;
use proptest::prelude::*;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

fn reference(name: &str) -> Sketch {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/sketches/{name}.penstemon"));
    sketch::read(&path).unwrap().0
}

/// Builds with a cache, asking `stop` now and then, and checks the result against a build from scratch.
fn built_with(cache: &mut Cache, sketch: &Sketch, stop: &(dyn Fn() -> bool + Sync)) -> Option<Built> {
    let species = pipeline::species_of(sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(sketch, &species, &[]).unwrap();
    pipeline::build_with(cache, sketch, &species, &params, stop)
}

fn live(cache: &mut Cache, sketch: &Sketch) -> Built {
    built_with(cache, sketch, &|| false).unwrap()
}

fn fresh(sketch: &Sketch) -> Built {
    let species = pipeline::species_of(sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(sketch, &species, &[]).unwrap();
    pipeline::build(sketch, &species, &params)
}

/// How many parts of `after` have the very mesh of a part of `before`.
fn shared(before: &Model, after: &Model) -> usize {
    let is_old = |mesh: &Arc<_>| before.parts.iter().any(|part| Arc::ptr_eq(&part.mesh, mesh));
    after.parts.iter().filter(|part| is_old(&part.mesh)).count()
}

/// A small edit: which one, where, and how far.
fn edit(sketch: &mut Sketch, (what, which, by): (u8, usize, f32)) {
    if (8..11).contains(&what) {
        return edit_plants(&mut sketch.plants, (what, which, by));
    }
    if what >= 16 {
        return edit_garden(sketch, (which, by));
    }
    if what >= 13 {
        return edit_space(sketch, (what, which, by));
    }
    if what >= 11 {
        return edit_petals(sketch, (which, by));
    }
    let count = sketch.strokes.len();
    if count == 0 {
        return;
    }
    let chosen = which % count;
    match what {
        0 => drop(sketch.strokes.remove(chosen)),
        1 => {
            let mut copy = Stroke::clone(&sketch.strokes[chosen]);
            copy.id = 1 + sketch.strokes.iter().map(|s| s.id).max().unwrap();
            copy.points.iter_mut().for_each(|p| p.position += Vec2::splat(by));
            sketch.strokes.push(copy.into());
        }
        2 => {
            let stroke = Arc::make_mut(&mut sketch.strokes[chosen]);
            stroke.points.iter_mut().for_each(|p| p.position.x += by);
        }
        3 => Arc::make_mut(&mut sketch.strokes[chosen]).tool = Tool::ALL[which % Tool::ALL.len()],
        4 => sketch.seed = which as u64,
        5 => drop(sketch.params.insert("model.blade.rows".into(), (which % 9).into())),
        // Of a species that grows, so that drawn wood goes on and its memory is used.
        6 => {
            sketch.species = Some("hazel".into());
            sketch.params.insert("growth.years".into(), (which % 4).into());
        }
        _ => sketch.strokes.swap(chosen, 0),
    }
}

/// A small edit of the plants beside the drawn one: one more, another place or age, one less.
fn edit_plants(plants: &mut Vec<PlacedPlant>, (what, which, by): (u8, usize, f32)) {
    let species = ["hazel", "birch", "box", "daisy", "no such plant"][which % 5].to_owned();
    let age = Some((which % 7) as f32 * 0.5);
    let height = (which % 3 > 0).then_some(100.0 + by);
    let seed = SeedOf { species, seed: which as u64 % 2, age };
    let plant = PlacedPlant { maker: Maker::Growth(seed), foot: Vec2::new(300.0 + by, 700.0), height };
    match (what, plants.is_empty()) {
        (8, _) | (_, true) => plants.push(plant),
        (9, _) => drop(plants.remove(which % plants.len())),
        _ => {
            let count = plants.len();
            plants[which % count] = plant;
        }
    }
}

/// Paints on the ground around the plant, or takes back what was painted first.
fn edit_garden(sketch: &mut Sketch, (which, by): (usize, f32)) {
    let tool = match which % 7 {
        0 => GardenTool::Path,
        1 => GardenTool::Clear,
        2 => GardenTool::Plants(GardenPlant::species("daisy")),
        3 => GardenTool::Plants(GardenPlant::species("no such plant")),
        4 => {
            let alone = Sketch { garden: GardenStrokes::default(), ..sketch.clone() };
            GardenTool::Plants(GardenPlant::Drawing(for_garden(&sketch.garden, "other", &alone).unwrap()))
        }
        _ => GardenTool::Plants(GardenPlant::Drawn),
    };
    let point = |x: f32, y: f32| GardenPoint { at: Vec2::new(x, y), pressure: 0.5 };
    let points = vec![point(by / 20.0, 0.4), point(by / 20.0, by / 30.0)];
    let new = Arc::new(GardenStroke { tool, radius: 0.3, density: 1.0, points });
    let skipped = usize::from(sketch.garden.len() > 2);
    sketch.garden = sketch.garden.iter().skip(skipped).cloned().chain([new]).collect();
}

/// Moves a control point of the petals that some strokes draw, if they are petals.
fn edit_petals(sketch: &mut Sketch, (which, by): (usize, f32)) {
    let ids: Vec<u64> = sketch.strokes.iter().map(|stroke| stroke.id).collect();
    let of_shape = ids.iter().copied().skip(which % 3).step_by(1 + which % 2);
    let mut offsets = [[Vec3::ZERO; 4]; 4];
    offsets[which % 4][which / 4 % 4] = Vec3::new(0.002, -0.001, 0.01) * by;
    let shape = PetalShape::new(of_shape, offsets);
    if !shape.strokes.is_empty() {
        sketch.petal_shapes = shaped(&sketch.petal_shapes, shape, ids);
    }
}

/// Draws a branch in space or with a brush, or turns or bends one of the branches.
fn edit_space(sketch: &mut Sketch, (what, which, by): (u8, usize, f32)) {
    let Some(chosen) = sketch.strokes.get(which % sketch.strokes.len().max(1)) else { return };
    if what == 13 || what == 15 {
        let mut branch = Stroke::clone(chosen);
        branch.id = 1 + sketch.strokes.iter().map(|s| s.id).max().unwrap();
        branch.tool = match (what, which % 3) {
            (13, _) => Tool::SpaceBranch,
            (_, 0) => Tool::PruningBrush,
            (_, 1) if by > 0.0 => Tool::LightBrush,
            (_, 1) => Tool::FlowerBrush,
            (_, 2) if by > 0.0 => Tool::LeafBrush,
            _ => Tool::GrowthBrush,
        };
        branch.brush = branch.tool.is_brush().then(|| Brush { radius: 5.0 + by.abs(), ..Brush::default() });
        let count = branch.points.len() as f32;
        let depths = branch.points.iter_mut().enumerate();
        depths.for_each(|(k, point)| point.depth = by * k as f32 / count);
        sketch.strokes.push(branch.into());
        return;
    }
    let turn = Quat::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), by / 60.0);
    let still = PartPose::still(PartName::Stroke(chosen.id));
    let pose = match which % 3 {
        0 => PartPose { turn, ..still },
        1 => PartPose { bend: turn, ..still },
        _ => PartPose { shift: Vec3::new(by, 2.0 * by, -by), thickness: 1.2, ..still },
    };
    sketch.part_poses = posed(&sketch.part_poses, pose);
}

/// Turns, bends, thickens, moves or cuts off a branch, leaf or flower that grew in the last plant.
fn pose_grown(sketch: &mut Sketch, (_, which, by): (u8, usize, f32), last: &Built) {
    let branches = last.plant.branches.iter().map(|branch| branch.origin);
    let organs = last.plant.organs.iter().map(|organ| organ.origin);
    let flowers = last.plant.flowers.iter().map(|flower| flower.origin);
    let grown = branches.chain(organs).chain(flowers).filter_map(|origin| match origin {
        Origin::Grown(GrownId(name)) => Some(PartName::Grown(name)),
        _ => None,
    });
    let grown: Vec<PartName> = grown.collect();
    let Some(wood) = grown.get(which % grown.len().max(1)) else { return };
    let (turn, still) = (Quat::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), by / 60.0), PartPose::still(*wood));
    let pose = match which % 5 {
        0 => PartPose { turn, ..still },
        1 => PartPose { bend: turn, ..still },
        2 => PartPose { thickness: 1.5, ..still },
        3 => PartPose { shift: Vec3::new(by, by, 0.0), turn, ..still },
        _ => PartPose { is_cut: true, ..still },
    };
    sketch.part_poses = posed(&sketch.part_poses, pose);
}

/// A build with a cache gives what one from scratch gives; only the cache knows how old its plant has been before.
fn assert_same(live: &Built, fresh: &Built) {
    let ages = |built: &Built| built.growth.map(|ages| Ages { oldest: 0.0, ..ages });
    assert_eq!(live.anatomy, fresh.anatomy);
    assert_eq!(live.remarks, fresh.remarks);
    assert_eq!(ages(live), ages(fresh));
    assert_eq!(live.plant, fresh.plant);
    assert_eq!(live.model, fresh.model);
    assert_eq!(live.garden, fresh.garden);
    assert_eq!(*pipeline::seen(live).model, *pipeline::seen(fresh).model);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn edits_give_the_plant_that_a_fresh_build_gives(
        seed: u64,
        edits in prop::collection::vec((0u8..17, 0usize..1000, -80.0f32..80.0), 1..8),
    ) {
        let mut cache = Cache::default();
        let mut sketch = drawings::scribble(seed, 12);
        let mut last = fresh(&sketch);
        assert_same(&live(&mut cache, &sketch), &last);
        for change in edits {
            edit(&mut sketch, change);
            pose_grown(&mut sketch, change, &last);
            last = fresh(&sketch);
            assert_same(&live(&mut cache, &sketch), &last);
        }
    }

    #[test]
    fn a_seed_at_any_age_after_any_other_gives_the_plant_that_a_fresh_build_gives(
        steps in prop::collection::vec((0usize..3, 1u64..3, 0.0f32..5.0), 1..6),
    ) {
        let mut cache = Cache::default();
        for (species, number, age) in steps {
            let species = Species::built_in(["hazel", "birch", "box"][species]).unwrap();
            let params = pipeline::params_of_species(&species, &[]).unwrap();
            let seed = Seed { number, age: Some(age), ..Seed::default() };
            let live = pipeline::build_with(&mut cache, &seed, &species, &params, &|| false).unwrap();
            assert_same(&live, &pipeline::build(&seed, &species, &params));
        }
    }
}

#[test]
fn a_flower_that_is_shaped_step_by_step_is_the_one_that_a_fresh_build_gives() {
    let mut cache = Cache::default();
    let mut sketch = reference("balloon_flower");
    let drawn = live(&mut cache, &sketch);
    let members = drawn.plant.organs.iter().filter(|organ| organ.flower == Some(0));
    let strokes: Vec<u64> = members.filter_map(|o| drawn.provenance.stroke(o.origin)).collect();
    let ids: Vec<u64> = sketch.strokes.iter().map(|stroke| stroke.id).collect();
    let mut offsets = [[Vec3::ZERO; 4]; 4];
    for height in [0.1, 0.2, -0.3, 0.0] {
        offsets[3] = [Vec3::Z * height; 4];
        let shape = PetalShape::new(strokes.iter().copied(), offsets);
        sketch.petal_shapes = shaped(&sketch.petal_shapes, shape, ids.iter().copied());
        let now = live(&mut cache, &sketch);
        assert_same(&now, &fresh(&sketch));
        assert_eq!(now.plant == drawn.plant, height == 0.0);
        assert!(
            2 * shared(&drawn.model, &now.model) >= drawn.model.parts.len(),
            "the rest is not built again"
        );
    }
    // A petal goes and comes back, and the seed changes meanwhile.
    let first = sketch.strokes.iter().position(|stroke| stroke.id == strokes[0]).unwrap();
    sketch.petal_shapes = [PetalShape::new(strokes.iter().copied(), [[Vec3::Z * 0.1; 4]; 4])].into();
    let petal = sketch.strokes.remove(first);
    assert_same(&live(&mut cache, &sketch), &fresh(&sketch));
    sketch.strokes.insert(first, petal);
    sketch.seed += 1;
    assert_same(&live(&mut cache, &sketch), &fresh(&sketch));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn edits_of_a_meadow_give_the_plant_that_a_fresh_build_gives(
        count in 12usize..60,
        edits in prop::collection::vec((0u8..5, 0usize..1000, -200.0f32..200.0), 1..6),
        samples in prop::collection::vec((0usize..1000, 1usize..50), 1..4),
    ) {
        let mut cache = Cache::default();
        let mut sketch = drawings::meadow(count);
        for change in edits {
            edit(&mut sketch, change);
            assert_same(&live(&mut cache, &sketch), &fresh(&sketch));
        }
        // A stroke under the pen, longer or shorter than it was.
        for (which, points) in samples {
            let Some(drawn) = sketch.strokes.get(which % sketch.strokes.len().max(1)) else { break };
            let mut growing = Stroke::clone(drawn);
            growing.id = 1_000_000;
            growing.points.truncate(points);
            growing.points.iter_mut().for_each(|point| point.position += Vec2::new(9.0, 4.0));
            let mut drawing = sketch.clone();
            drawing.strokes.push(growing.into());
            assert_same(&live(&mut cache, &drawing), &fresh(&drawing));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn samples_in_a_filled_outline_give_the_plant_that_a_fresh_build_gives(
        leaves in 60usize..400,
        strokes in prop::collection::vec((0usize..13, -60.0f32..60.0, 2usize..40), 1..4),
        most_twigs in 20usize..600,
    ) {
        let mut cache = Cache::default();
        let mut sketch = drawings::leafy_tree(leaves);
        sketch.params.insert("anatomy.leaf_twigs.max_twigs".into(), most_twigs.into());
        for (which, by, points) in strokes {
            let mut growing = Stroke::clone(&sketch.strokes[which]);
            growing.id = 1_000_000 + points as u64;
            growing.points.iter_mut().for_each(|point| point.position += Vec2::new(by, 0.3 * by));
            for count in (1..=points).step_by(7) {
                let mut drawing = sketch.clone();
                drawing.strokes.push(Arc::new(Stroke { points: growing.points[..count].to_vec(), ..growing.clone() }));
                assert_same(&live(&mut cache, &drawing), &fresh(&drawing));
            }
            sketch.strokes.push(growing.into());
        }
    }
}

/// A crown of which the foliage is cards.
fn tree_of_cards() -> Sketch {
    let mut sketch = drawings::leafy_tree(200);
    sketch.params.insert("cards.used".into(), true.into());
    sketch.params.insert("cards.pixels".into(), 32.into());
    sketch
}

/// The address of the picture of a plant's cards.
fn cards_picture(built: &Built) -> *const u8 {
    let mut pictures = built.plant.materials().iter().filter_map(|material| match &material.texture {
        Some(Texture::Own(picture)) => Some(picture.bytes().as_ptr()),
        _ => None,
    });
    pictures.next().unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4))]

    #[test]
    fn cards_of_a_drawing_that_changes_are_those_that_a_fresh_build_gives(
        edits in prop::collection::vec((0u8..7, 0usize..1000, -60.0f32..60.0), 1..4),
        (which, points) in (0usize..13, 2usize..30),
        calls in 0usize..3000,
    ) {
        let mut cache = Cache::default();
        let mut sketch = tree_of_cards();
        assert_same(&live(&mut cache, &sketch), &fresh(&sketch));
        let mut growing = Stroke::clone(&sketch.strokes[which]);
        growing.id = 1_000_000;
        growing.points.iter_mut().for_each(|point| point.position += Vec2::new(20.0, 6.0));
        for count in (1..=points).step_by(9) {
            let mut drawing = sketch.clone();
            drawing.strokes.push(Arc::new(Stroke { points: growing.points[..count.min(growing.points.len())].to_vec(), ..growing.clone() }));
            // A build that a newer drawing ends leaves nothing half done behind.
            let asked = AtomicUsize::new(0);
            let _ = built_with(&mut cache, &drawing, &|| asked.fetch_add(1, Ordering::Relaxed) >= calls);
            assert_same(&live(&mut cache, &drawing), &fresh(&drawing));
        }
        for change in edits {
            edit(&mut sketch, change);
            assert_same(&live(&mut cache, &sketch), &fresh(&sketch));
        }
    }
}

#[test]
fn pictures_of_cards_are_painted_again_only_where_what_they_show_is_another() {
    let (mut cache, mut sketch) = (Cache::default(), tree_of_cards());
    let first = live(&mut cache, &sketch);
    assert_eq!(cache.cards.len(), 6);
    assert_eq!(cards_picture(&first), cards_picture(&live(&mut cache, &sketch)));
    sketch.params.insert("model.tube.sides".into(), 5.into());
    assert_eq!(cards_picture(&first), cards_picture(&live(&mut cache, &sketch)));
    sketch.params.insert("cards.pixels".into(), 40.into());
    let other = live(&mut cache, &sketch);
    assert_ne!(cards_picture(&first), cards_picture(&other));
    assert_same(&other, &fresh(&sketch));
    sketch.params.insert("cards.used".into(), false.into());
    live(&mut cache, &sketch);
    assert!(cache.cards.is_empty());
}

/// Branches that meet in one spot, some of them on whole pixels so that many lie equally near, with leaves and petals among
/// them.
fn crowd(count: usize) -> Sketch {
    let stroke = |k: usize| {
        let (root, out) =
            (Vec2::splat(500.0), Vec2::from_angle(k as f32 * 0.618) * (100.0 + (k % 89) as f32));
        match k % 5 {
            0 => (Tool::Leaf, drawings::blade(root + 0.7 * out, root + out, 0.3)),
            1 => (Tool::Petal, drawings::blade(root + 0.9 * out, root + 1.1 * out, 0.4)),
            2 => (Tool::Branch, drawings::curve(root.round(), (root + out).round(), 0.0)),
            _ => (Tool::Branch, drawings::curve(root + 0.01 * out, root + out, 0.1)),
        }
    };
    drawings::sketch((0..count).map(stroke))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn edits_of_a_crowd_give_the_anatomy_that_a_fresh_analysis_gives(
        count in 150usize..500,
        edits in prop::collection::vec((0u8..8, 0usize..1000, -30.0f32..30.0), 1..8),
    ) {
        let (mut cache, params) = (anatomy::Cache::default(), AnatomyParams::default());
        let mut sketch = crowd(count);
        for (what, which, by) in edits {
            // Half of the edits are by whole pixels, so that more lies equally near.
            edit(&mut sketch, (what % 4, which, if which % 2 == 0 { by.round() } else { by }));
            let live = anatomy::analyse_with(&mut cache, &sketch, &params, &|| false);
            prop_assert_eq!(live, Some(anatomy::analyse(&sketch, &params)));
        }
    }
}

#[test]
fn what_does_not_change_is_the_very_same() {
    for name in ["daisy", "jasmine", "bouquet", "tree_round"] {
        let (mut cache, sketch) = (Cache::default(), reference(name));
        let first = live(&mut cache, &sketch).model;
        let again = live(&mut cache, &sketch).model;
        assert_eq!(shared(&first, &again), again.parts.len(), "{name}");
        assert!(cache.model.len() <= first.parts.len());
    }
}

#[test]
fn an_unrelated_stroke_leaves_all_other_parts_alone() {
    for name in ["daisy", "hepatica_red", "mallow", "bouquet"] {
        let (mut cache, mut sketch) = (Cache::default(), reference(name));
        let first = live(&mut cache, &sketch);
        // Beside the plant and well inside its bounds, so that neither place nor scale changes.
        let (low, high) = first.anatomy.bounds;
        let root = Vec2::new(low.x + 0.3 * (high.x - low.x), high.y - 0.15 * (high.y - low.y));
        let leaf = drawings::blade(root, root + 0.05 * (high - low) * Vec2::new(0.5, -1.0), 0.3);
        let mut drawn = Stroke::clone(&drawings::sketch([(Tool::Leaf, leaf)]).strokes[0]);
        drawn.id = 1_000_000;
        sketch.strokes.push(drawn.into());
        let second = live(&mut cache, &sketch).model;
        let (same, all) = (shared(&first.model, &second), second.parts.len());
        assert_eq!(same + 1, all, "{name}");
    }
}

/// What was generated, in space: every twig's skeleton and every leaf's pose.
fn crown(built: &Built) -> (Vec<Vec<Vec3>>, Vec<[Vec3; 3]>) {
    let twigs = built.plant.branches.iter().filter(|b| !b.origin.is_drawn()).map(|b| b.points.clone());
    let leaves = built.plant.organs.iter().filter(|o| o.kind() == OrganKind::Leaf && !o.origin.is_drawn());
    let poses = leaves.filter_map(|organ| match &organ.shape {
        Shape::Blade(blade) => Some([blade.base, blade.u, blade.v]),
        _ => None,
    });
    (twigs.collect(), poses.collect())
}

#[test]
fn an_unrelated_stroke_leaves_the_crown_as_it_stands_in_space() {
    for name in ["tree_round", "tree_willow"] {
        let (mut cache, mut sketch) = (Cache::default(), reference(name));
        let before = live(&mut cache, &sketch);
        // A herb beside the trunk, above its foot, first in the drawing so that everything else moves up by one.
        let ((low, high), trunk) = (before.anatomy.bounds, before.anatomy.branches[0].line[0].position);
        let size = high - low;
        let foot = trunk + Vec2::new(0.2 * size.x, -0.02 * size.y);
        let stem = drawings::curve(foot, foot - Vec2::new(0.0, 0.08 * size.y), 0.1);
        let mut drawn = Stroke::clone(&drawings::sketch([(Tool::Branch, stem)]).strokes[0]);
        drawn.id = 1_000_000;
        sketch.strokes.insert(0, drawn.into());
        let after = live(&mut cache, &sketch);
        assert_eq!(after.plant.branches.len(), before.plant.branches.len() + 1, "{name}");
        let ((twigs, leaves), (twigs_after, leaves_after)) = (crown(&before), crown(&after));
        assert!(leaves.len() > 500, "{name}: {}", leaves.len());
        assert_eq!(twigs, twigs_after, "{name}");
        assert_eq!(leaves, leaves_after, "{name}");
        assert_eq!(shared(&before.model, &after.model) + 1, after.model.parts.len(), "{name}");
    }
}

#[test]
fn a_stopped_build_gives_nothing_and_the_next_one_is_whole() {
    let (mut cache, sketch) = (Cache::default(), reference("tree_round"));
    let expected = fresh(&sketch).model;
    let mut questions = 1;
    loop {
        let asked = AtomicUsize::new(0);
        // Only one yes: the build must remember it.
        let stop = || asked.fetch_add(1, Ordering::Relaxed) + 1 == questions;
        match built_with(&mut cache, &sketch, &stop) {
            None => questions *= 3,
            Some(built) => {
                assert_eq!(built.model, expected);
                break;
            }
        }
    }
    assert!(questions > 1000, "stop is asked only {questions} times");
}
