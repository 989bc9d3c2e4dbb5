//! Strokes of brushes in drawings: what they grow and cut, in sound meshes, from any file.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::in_space::{built, in_space};
use glam::{Vec3, vec2};
use penstemon::modelling::PartNames;
use penstemon::pipeline::{self, Built};
use penstemon::plant::{Branch, Organ, Origin};
use penstemon::sketch::{self, Brush, PartPose, Remark, Sketch, Stroke, StrokePoint, Tool};
use std::path::Path;
use std::sync::Arc;

/// A straight stroke of a brush, canvas pixels and depth.
fn stroke(id: u64, tool: Tool, from: [f32; 3], to: [f32; 3], radius: f32) -> Arc<Stroke> {
    let point = |k: usize| {
        let at = |axis: usize| from[axis] + (to[axis] - from[axis]) * k as f32 / 20.0;
        StrokePoint { depth: at(2), ..StrokePoint::at(vec2(at(0), at(1))) }
    };
    let brush = Some(Brush { radius, guide: 1.5, ..Brush::default() });
    Arc::new(Stroke { id, tool, points: (0..=20).map(point).collect(), brush })
}

/// The drawing, with a stroke that hangs down from its second bough.
fn hung() -> Sketch {
    let mut sketch = in_space();
    sketch.species = Some("maple".to_owned());
    sketch.strokes.push(stroke(40, Tool::GrowthBrush, [689.7, 686.8, 266.9], [700.0, 860.0, 270.0], 40.0));
    sketch
}

fn leaves(built: &Built) -> usize {
    built.plant.organs.len()
}

#[test]
fn growth_hangs_where_it_was_painted_and_the_rest_stays() {
    let sketch = hung();
    let (bare, hung) =
        (built(&Sketch { strokes: sketch.strokes[..17].to_vec(), ..sketch.clone() }), built(&sketch));
    assert_eq!(hung.remarks, []);
    let was = bare.plant.branches.len();
    assert!(hung.plant.branches[..was] == bare.plant.branches[..], "the plant's own wood stays as it is");
    assert!(leaves(&hung) > leaves(&bare) + 200, "{} leaves", leaves(&hung));
    let new = &hung.plant.branches[was..];
    let chords = new.iter().map(|branch| *branch.points.last().unwrap() - branch.points[0]);
    let (down, whole) = chords.fold((0.0, 0.0), |sum, chord| (sum.0 + chord.y, sum.1 + chord.length()));
    assert!(down < -0.6 * whole, "shoots go down by {} of their length", -down / whole);
    // The wood of the plant is one: brushes leave no part of it in the air.
    for (b, branch) in hung.plant.branches.iter().enumerate().skip(1) {
        assert!(branch.parent.is_some_and(|parent| parent < b), "branch {b}");
    }
}

#[test]
fn what_is_cut_is_gone_and_the_stroke_that_cuts_nothing_says_so() {
    let mut sketch = hung();
    let before = built(&sketch);
    sketch.strokes.push(stroke(41, Tool::PruningBrush, [640.0, 800.0, 268.0], [740.0, 800.0, 268.0], 45.0));
    let after = built(&sketch);
    assert_eq!(after.remarks, []);
    assert!(leaves(&after) < leaves(&before) && after.plant.branches.len() < before.plant.branches.len());
    let world = after.provenance.world_from_canvas;
    let low = |built: &Built| {
        let near = |p: &&glam::Vec3| p.z > 230.0 * world.scale;
        built.plant.branches.iter().flat_map(|b| &b.points).filter(near).map(|p| p.y).fold(f32::MAX, f32::min)
    };
    assert!(low(&after) > low(&before) + 40.0 * world.scale, "what hung below the cut went with it");
    sketch.strokes.push(stroke(42, Tool::PruningBrush, [20.0, 20.0, 0.0], [40.0, 20.0, 0.0], 10.0));
    let again = built(&sketch);
    let remarks: Vec<_> = again.remarks.iter().map(|w| (w.stroke, w.remark.clone())).collect();
    assert_eq!(remarks, [(Some(42), Remark::BrushCutsNothing)]);
    assert_eq!(again.plant, after.plant);
}

#[test]
fn brushes_work_on_grown_crowns_on_flowers_and_on_species_that_do_not_grow() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches");
    let names = [
        "tree_round",
        "balloon_flower",
        "freehand_apple_tree",
        "daisy",
        "freehand_cactus",
        "freehand_mushroom",
    ];
    for name in names {
        let file = path.join(format!("{name}.penstemon"));
        let (mut sketch, _) = sketch::read(&file).unwrap();
        let (low, high) = sketch.bounds().unwrap();
        let size = high - low;
        let before = built(&sketch);
        let at = |x: f32, y: f32| [low.x + x * size.x, low.y + y * size.y, 0.0];
        let radius = 0.08 * size.max_element();
        sketch.strokes.push(stroke(9001, Tool::GrowthBrush, at(0.5, 0.5), at(1.1, 0.4), radius));
        let grown = built(&sketch);
        assert!(leaves(&grown) >= leaves(&before), "{name}");
        sketch.strokes.push(stroke(9002, Tool::PruningBrush, at(0.2, 0.2), at(0.8, 0.2), radius));
        let cut = built(&sketch);
        let has_flowers = |built: &Built| built.plant.flowers.len();
        assert!(has_flowers(&cut) <= has_flowers(&grown), "{name}");
    }
}

#[test]
fn bad_brushes_end_in_a_plant_or_in_an_error_that_helps() {
    let mut sketch = hung();
    let before = built(&Sketch { strokes: sketch.strokes[..17].to_vec(), ..sketch.clone() });
    let of = |sketch: &Sketch| built(sketch).remarks.into_iter().map(|w| w.remark).collect::<Vec<_>>();
    // Far from any wood: it reaches nothing, and says so.
    sketch.strokes[17] = stroke(40, Tool::GrowthBrush, [90_000.0, 0.0, 0.0], [90_100.0, 0.0, 0.0], 40.0);
    assert_eq!(of(&sketch), [Remark::BrushOutOfReach]);
    // A dab, and one that presses nothing.
    let dab = Stroke { points: vec![StrokePoint::at(vec2(526.0, 735.0))], ..(*sketch.strokes[17]).clone() };
    sketch.strokes[17] = Arc::new(dab.clone());
    assert!(leaves(&built(&sketch)) > leaves(&before));
    let lightly = StrokePoint { pressure: 0.0, ..dab.points[0] };
    sketch.strokes[17] = Arc::new(Stroke { points: vec![lightly], ..dab.clone() });
    built(&sketch);
    // A brush as thin as a hair, and one as wide as the drawing.
    for (radius, length) in [(1e-3, 300.0), (1e7, 10.0), (900.0, 10.0)] {
        let to = [526.0 + length, 735.0, 0.0];
        sketch.strokes[17] = stroke(40, Tool::GrowthBrush, [526.0, 735.0, 0.0], to, radius);
        built(&sketch);
    }
    // To and fro, a hundred thousand samples.
    let to_and_fro = |k: usize| StrokePoint::at(vec2(526.0 + 80.0 * (k as f32 * 0.1).sin(), 700.0));
    sketch.strokes[17] = Arc::new(Stroke { points: (0..100_000).map(to_and_fro).collect(), ..dab });
    assert!(leaves(&built(&sketch)) > leaves(&before));
    let text = sketch::json::write(&hung());
    for (from, to, says) in [
        ("\"radius\": 40", "\"radius\": 0", "`radius`"),
        ("\"radius\": 40", "\"radius\": -3", "`radius`"),
        ("\"density\": 1", "\"density\": 1000", "`density`"),
        ("\"guide\": 1.5", "\"guide\": 9", "`guide`"),
        ("\"guide\"", "\"gide\"", "gide"),
        ("\"growth_brush\"", "\"branch\"", "leave it out"),
    ] {
        let wrong = text.replace(from, to);
        assert_ne!(wrong, text, "{from}");
        let error = sketch::from_bytes(wrong.as_bytes(), "a.penstemon").unwrap_err().to_string();
        assert!(error.contains(says) && error.contains("a.penstemon"), "{error}");
    }
    // Without a brush it is the usual one.
    let plain = text.replace("\"brush\": {\"radius\": 40, \"density\": 1, \"guide\": 1.5}, ", "");
    assert_ne!(plain, text);
    assert_eq!(
        sketch::from_bytes(plain.as_bytes(), "a.penstemon").unwrap().0.strokes[17].brush,
        Some(Brush::default())
    );
}

#[test]
fn the_drawings_that_the_readme_shows_are_one_piece_of_wood() {
    for name in ["brushed", "brushed_willow"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/fixtures/{name}.penstemon"));
        let sketch = sketch::read(&path).unwrap().0;
        let built = built(&sketch);
        assert_eq!(built.remarks, [], "{name}");
        assert!(leaves(&built) > 1000, "{name}: {} leaves", leaves(&built));
        let bases = built.plant.branches.iter().filter(|branch| branch.parent.is_none()).count();
        assert_eq!(bases, 1, "{name}");
    }
}

#[test]
fn growth_goes_toward_painted_light_and_away_from_shade() {
    let mut sketch = in_space();
    sketch.species = Some("maple".to_owned());
    let species = pipeline::species_of(&sketch, Path::new("")).unwrap();
    let grown = |sketch: &Sketch| {
        let params = pipeline::params_of(sketch, &species, &["growth.years=7".to_owned()]).unwrap();
        pipeline::build(sketch, &species, &params)
    };
    let (low, high) = sketch.bounds().unwrap();
    let (size, middle) = (high - low, 0.5 * (low + high));
    // Beside the tree, to its right, from a third of its height up.
    let beside = low.x + 1.3 * size.x;
    let light = |guide: f32| {
        let (from, to) = ([beside, middle.y + 0.2 * size.y, 0.0], [beside, low.y, 0.0]);
        let mut stroke = Stroke::clone(&stroke(70, Tool::LightBrush, from, to, 0.12 * size.x));
        stroke.brush = stroke.brush.map(|brush| Brush { guide, ..brush });
        let mut lit = sketch.clone();
        lit.strokes.push(stroke.into());
        lit
    };
    // Leaves beside the light, of all.
    let near = |built: &Built| {
        let world = &built.provenance.world_from_canvas;
        let (at, wide) = (world.point_in_space(vec2(beside, middle.y), 0.0).x, 0.3 * size.x * world.scale);
        let all = built.plant.organs.iter().filter(|organ| (organ.base().x - at).abs() < wide);
        all.count() as f32 / built.plant.organs.len() as f32
    };
    let [shade, dark, bright] = [-2.0, 0.0, 2.0].map(|guide| {
        let built = grown(&light(guide));
        assert_eq!(built.remarks, []);
        assert!(leaves(&built) > 300, "{}", leaves(&built));
        near(&built)
    });
    assert!(bright > 1.25 * dark && shade < 0.5 * dark, "{shade} {dark} {bright}");
    assert_eq!(grown(&sketch).plant, grown(&light(0.0)).plant, "no light is none");
    let without_growth = built(&light(2.0));
    let remarks: Vec<_> = without_growth.remarks.iter().map(|w| (w.stroke, w.remark.clone())).collect();
    assert_eq!(remarks, [(Some(70), Remark::LightsNothing)]);
    let text = sketch::json::write(&light(2.0));
    assert!(text.contains("\"version\": 8") && text.contains("light_brush"));
    assert_eq!(sketch::read::from_bytes(text.as_bytes(), "lit.penstemon").unwrap().0, light(2.0));
}

#[test]
fn nothing_is_painted_through_a_wall() {
    let mut sketch = in_space();
    sketch.species = Some("maple".to_owned());
    let bare = built(&sketch);
    // From a bough straight to the back.
    let deep = 400.0;
    let line = stroke(40, Tool::GrowthBrush, [689.7, 686.8, 266.9], [689.7, 686.8, 266.9 - deep], 40.0);
    sketch.strokes.push(line);
    let metres = bare.provenance.world_from_canvas.scale;
    let foot = bare.plant.branches[0].points[0];
    // Its front is in the middle of the stroke.
    let front = (266.9 - 0.5 * deep) * metres;
    let without = built(&sketch);
    for (path, value) in
        [("width", 50.0), ("height", 50.0), ("depth", 0.02), ("behind", f64::from(foot.z - front))]
    {
        sketch.params.insert(format!("obstacle.{path}"), value.into());
    }
    sketch.params.insert("obstacle.kind".to_owned(), "wall".into());
    let with = built(&sketch);
    let of_brush = |built: &Built, low: f32, high: f32| {
        let new = &built.plant.branches[bare.plant.branches.len()..];
        let points = new.iter().flat_map(|branch| &branch.points).map(|point| point.z);
        points
            .chain(built.plant.organs[bare.plant.organs.len()..].iter().map(|organ| organ.base().z))
            .filter(|z| (low..high).contains(z))
            .count()
    };
    let (behind, before) = ((f32::NEG_INFINITY, front - 0.02), (front, f32::INFINITY));
    assert!(of_brush(&without, behind.0, behind.1) > 50, "without a wall it grows on");
    assert_eq!(of_brush(&with, behind.0, behind.1), 0);
    assert!(of_brush(&with, before.0, before.1) > 50, "before the wall it grows");
}

/// A built-in drawing, and a stroke of a brush along its first one, from there to there.
fn along_stem(name: &str, tool: Tool, (from, to): (usize, usize), radius: f32) -> Sketch {
    let file = format!("assets/sketches/{name}.penstemon");
    let mut sketch = sketch::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap().0;
    let stem = sketch.strokes[0].points.clone();
    let place = |share: usize| StrokePoint::at(stem[(stem.len() - 1) * share / 100].position);
    let points = (from..=to).map(place).collect();
    let brush = Some(Brush { radius, ..Brush::default() });
    sketch.strokes.push(Arc::new(Stroke { id: 900, tool, points, brush }));
    sketch
}

#[test]
fn leaves_are_painted_on_a_stem_like_its_own_and_stay_while_the_stroke_goes_on() {
    let [short, long] = [60, 90].map(|to| along_stem("balloon_flower", Tool::LeafBrush, (10, to), 50.0));
    let bare = Sketch { strokes: short.strokes[..short.strokes.len() - 1].to_vec(), ..short.clone() };
    let of = |sketch: &Sketch| {
        let built = built(sketch);
        assert_eq!(built.remarks, []);
        let grown = built.plant.organs.iter().filter(|organ| matches!(organ.origin, Origin::Grown(_)));
        (grown.map(Organ::base).collect::<Vec<Vec3>>(), built)
    };
    let ((none, before), (few, _), (many, after)) = (of(&bare), of(&short), of(&long));
    assert!(none.is_empty() && few.len() >= 4 && many.len() > few.len(), "{few:?} {many:?}");
    assert!(few.iter().all(|leaf| many.contains(leaf)), "those that are there stay");
    for leaf in many {
        let mut near = after.plant.branches.iter().map(|branch| (branch.axis_at(leaf), branch));
        let holds = |((axis, radius), _): ((Vec3, f32), &Branch)| axis.distance(leaf) <= radius;
        assert!(near.any(holds), "it stands on wood");
    }
    assert_eq!(before.plant.organs[..5], after.plant.organs[..5], "the plant's own stay");
    // One of them is taken away like any other part.
    let names = PartNames::new(&after.provenance);
    let painted = after.plant.organs.iter().find(|organ| matches!(organ.origin, Origin::Grown(_))).unwrap();
    let gone = PartPose { is_cut: true, ..PartPose::still(names.of(painted.origin).unwrap()) };
    let posed = built(&Sketch { part_poses: [gone].into(), ..long.clone() });
    assert_eq!((posed.remarks.len(), posed.plant.organs.len()), (0, after.plant.organs.len() - 1));
    let text = sketch::json::write(&long);
    assert!(text.contains("\"version\": 10") && text.contains("leaf_brush"));
    assert_eq!(sketch::read::from_bytes(text.as_bytes(), "leaves.penstemon").unwrap().0, long);
}

#[test]
fn painted_flowers_are_copies_of_the_drawn_ones_or_of_the_species() {
    let drawn = along_stem("balloon_flower", Tool::FlowerBrush, (5, 60), 60.0);
    let bare = Sketch { strokes: drawn.strokes[..drawn.strokes.len() - 1].to_vec(), ..drawn.clone() };
    let (before, after) = (built(&bare), built(&drawn));
    assert_eq!(after.remarks, []);
    let [was, is] = [&before, &after].map(|built| built.plant.flowers.len());
    assert!(is > was, "{is} flowers");
    // Each as many petals, sepals and stamens as the one that it is a copy of, with its look, on a stalk of its own.
    let organs =
        |flower: usize| after.plant.organs.iter().filter(|organ| organ.flower == Some(flower)).count();
    for (nth, flower) in after.plant.flowers[was..].iter().enumerate() {
        let of = nth % was;
        assert_eq!((organs(was + nth), flower.look), (organs(of), after.plant.flowers[of].look));
        let stalk = &after.plant.branches[flower.branch.unwrap()];
        assert!(stalk.parent.is_some() && stalk.points.last().unwrap().distance(flower.cone.apex) < 1e-5);
    }
    // One that is taken away goes with its stalk.
    let name = PartNames::new(&after.provenance).of(after.plant.flowers[was].origin).unwrap();
    let gone = PartPose { is_cut: true, ..PartPose::still(name) };
    let posed = built(&Sketch { part_poses: [gone].into(), ..drawn.clone() });
    assert_eq!(posed.plant.flowers.len(), is - 1);
    assert_eq!(posed.plant.branches.len(), after.plant.branches.len() - 1);
    // A peony has flowers by itself, a maple none that could be painted.
    let mut wood = in_space();
    wood.part_poses = [].into();
    wood.strokes.push(stroke(40, Tool::FlowerBrush, [600.0, 300.0, 0.0], [700.0, 700.0, 0.0], 300.0));
    wood.species = Some("peony".to_owned());
    let peony = built(&wood);
    assert!(peony.remarks.is_empty() && peony.plant.flowers.len() > 20, "{}", peony.plant.flowers.len());
    wood.species = Some("maple".to_owned());
    let remarks: Vec<_> = built(&wood).remarks.into_iter().map(|warning| warning.remark).collect();
    assert!(remarks.contains(&Remark::NoFlowerToPaint), "{remarks:?}");
    for tool in [Tool::LeafBrush, Tool::FlowerBrush] {
        let mut away = drawn.clone();
        let last = away.strokes.len() - 1;
        away.strokes[last] = stroke(900, tool, [9e4, 0.0, 0.0], [9e4, 9.0, 0.0], 40.0);
        let remarks: Vec<_> = built(&away).remarks.into_iter().map(|warning| warning.remark).collect();
        assert_eq!(remarks, [Remark::BrushOutOfReach]);
    }
}
