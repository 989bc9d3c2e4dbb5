//! Drawn crowns: plants that fill them as seen from the front, keep what was drawn, and are grown again for little.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use glam::{Vec2, Vec3};
use penstemon::depth;
use penstemon::geom::region::Region;
use penstemon::growth::{Envelope, Habit, Inflated, Limits, Simulation, plant_at};
use penstemon::pipeline::{self, Built, Cache};
use penstemon::plant::{OrganKind, Plant, Shape};
use penstemon::sketch::{Remark, Sketch, Stroke, StrokePoint, Tool};
use std::f32::consts::TAU;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Cells along one side of the raster on which silhouettes are compared.
const CELLS: usize = 160;

type Outlines = Vec<Vec<Vec2>>;

pub(crate) fn ring(count: usize, at: impl Fn(f32) -> Vec2) -> Vec<Vec2> {
    (0..=count).map(|k| at(k as f32 / count as f32 * TAU)).collect()
}

pub(crate) fn circle(centre: Vec2, radius: f32) -> Vec<Vec2> {
    ring(48, |t| centre + Vec2::from_angle(t) * radius)
}

fn mirrored(right: &[(f32, f32)]) -> Vec<Vec2> {
    let left = right.iter().rev().map(|&(x, y)| Vec2::new(-x, y));
    right.iter().map(|&(x, y)| Vec2::new(x, y)).chain(left).collect()
}

fn heart() -> Outlines {
    vec![ring(60, |t| {
        let y = 13.0 * t.cos() - 5.0 * (2.0 * t).cos() - 2.0 * (3.0 * t).cos() - (4.0 * t).cos();
        Vec2::new(16.0 * t.sin().powi(3), y) * 0.15
    })]
}

/// A round body with a stalk much thinner.
fn apple() -> Outlines {
    let corners = [
        (0.0, 0.6),
        (0.9, 0.5),
        (1.9, 1.1),
        (2.3, 2.4),
        (1.9, 3.5),
        (1.0, 3.9),
        (0.3, 3.6),
        (0.3, 4.3),
        (0.55, 4.9),
        (0.1, 5.0),
        (-0.2, 4.3),
        (-0.2, 3.6),
        (-1.0, 3.9),
        (-1.9, 3.5),
        (-2.3, 2.4),
        (-1.9, 1.1),
        (-0.9, 0.5),
    ];
    vec![corners.map(Vec2::from).to_vec()]
}

/// A band that winds up: hedges cut to a spiral look like that from the front.
fn spiral() -> Outlines {
    let turns = 2.0 * TAU;
    let at = |t: f32| {
        let (sin, cos) = (t * turns).sin_cos();
        let wide = 1.5 * (1.0 - 0.5 * t);
        let along = Vec2::new(-sin * turns * wide - 0.75 * cos, 6.0).normalize();
        (Vec2::new(cos * wide, 6.0 * t), along.perp() * (0.42 - 0.15 * t))
    };
    let steps = 120;
    let side = |sign: f32| {
        (0..=steps).map(move |k| {
            let (middle, out) = at(k as f32 / steps as f32);
            middle + out * sign
        })
    };
    vec![side(1.0).chain(side(-1.0).rev()).collect()]
}

fn outlines() -> Vec<(&'static str, Outlines, f32)> {
    let cloud = ring(90, |t| {
        Vec2::new(3.0 * t.cos(), 1.6 * t.sin()) + Vec2::from_angle(t) * 0.4 * (5.0 * t).sin().abs()
    });
    let goblet =
        mirrored(&[(1.2, 0.4), (1.2, 0.8), (0.5, 1.1), (0.5, 2.3), (1.3, 3.0), (1.7, 4.0), (1.6, 5.2)]);
    let head = [(1.0, 2.9), (1.3, 3.5), (1.1, 4.1), (1.0, 5.4), (0.9, 6.2), (0.4, 6.2), (0.25, 4.5)];
    let rabbit = mirrored(&[&[(1.2, 0.6), (1.8, 1.4), (1.6, 2.4)][..], &head[..]].concat());
    vec![
        ("heart", heart(), 0.9),
        ("cloud", vec![cloud], 0.9),
        ("goblet", vec![goblet], 0.9),
        ("rabbit", vec![rabbit], 0.9),
        ("ring", vec![circle(Vec2::ZERO, 2.6), circle(Vec2::ZERO, 1.1)], 0.9),
        ("apple", apple(), 0.9),
        ("spiral", spiral(), 0.85),
    ]
}

pub(crate) fn stroke(id: u64, tool: Tool, points: Vec<Vec2>) -> Arc<Stroke> {
    Arc::new(Stroke { id, tool, points: points.into_iter().map(StrokePoint::at).collect(), brush: None })
}

/// A drawing of crowns, 700 pixels high, on a trunk of a sixth of that where one is drawn.
pub(crate) fn drawing(species: &str, outlines: &[Vec<Vec2>], with_trunk: bool) -> Sketch {
    let points = || outlines.iter().flatten().copied();
    let (low, high) = (points().reduce(Vec2::min).unwrap(), points().reduce(Vec2::max).unwrap());
    let scale = 700.0 / (high.y - low.y);
    let canvas = |p: Vec2| Vec2::new(500.0 + p.x * scale, 80.0 + (high.y - p.y) * scale);
    let lowest: Vec<f32> = points().filter(|p| p.y < low.y + 0.02 * (high.y - low.y)).map(|p| p.x).collect();
    let foot = canvas(Vec2::new(lowest.iter().sum::<f32>() / lowest.len() as f32, low.y));
    let trunk = (0..=20).map(|k| foot + Vec2::Y * (117.0 - 180.0 * k as f32 / 20.0)).collect();
    let mut strokes: Vec<_> = with_trunk.then(|| stroke(1, Tool::Branch, trunk)).into_iter().collect();
    for (id, outline) in (2..).zip(outlines) {
        strokes.push(stroke(id, Tool::Crown, outline.iter().copied().map(canvas).collect()));
    }
    Sketch { species: Some(species.to_owned()), seed: 4, strokes, ..Sketch::empty() }
}

fn build_with(
    cache: &mut Cache,
    sketch: &Sketch,
    set: &[&str],
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Built> {
    let species = pipeline::species_of(sketch, Path::new("")).unwrap();
    let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
    let params = pipeline::params_of(sketch, &species, &set).unwrap();
    pipeline::build_with(cache, sketch, &species, &params, stop)
}

pub(crate) fn build(sketch: &Sketch, set: &[&str]) -> Built {
    build_with(&mut Cache::default(), sketch, set, &|| false).unwrap()
}

/// How silhouette and drawn crown agree, as shares of the crown's area: intersection over union, and what lies outside.
pub(crate) fn agreement(built: &Built) -> (f32, f32) {
    agreement_with(&built.plant, depth::crowns(&built.anatomy, &built.provenance.world_from_canvas))
}

/// The same of any plant and outlines in its world.
fn agreement_with(plant: &Plant, crowns: Outlines) -> (f32, f32) {
    let regions: Vec<Region> = crowns.into_iter().map(Region::new).collect();
    let bounds = || regions.iter().filter_map(Region::bounds);
    let low = bounds().map(|b| b.0).reduce(Vec2::min).unwrap();
    let high = bounds().map(|b| b.1).reduce(Vec2::max).unwrap();
    let cell = (high - low).max_element() * 1.15 / CELLS as f32;
    let low = low.midpoint(high) - 0.5 * cell * CELLS as f32;
    let covered = silhouette(plant, low, cell);
    let (mut both, mut either, mut wanted, mut outside) = (0, 0, 0, 0);
    for (k, covered) in covered.into_iter().enumerate() {
        let middle = low + (Vec2::new((k % CELLS) as f32, (k / CELLS) as f32) + 0.5) * cell;
        let inside = regions.iter().filter(|r| r.contains(middle)).count() % 2 == 1;
        both += u32::from(covered && inside);
        either += u32::from(covered || inside);
        wanted += u32::from(inside);
        outside += u32::from(covered && !inside);
    }
    (both as f32 / either as f32, outside as f32 / wanted as f32)
}

/// The cells that leaves and branches cover from the front; the trunk is left out.
fn silhouette(plant: &Plant, low: Vec2, cell: f32) -> Vec<bool> {
    let mut covered = vec![false; CELLS * CELLS];
    let place = |p: Vec2| ((p - low) / cell).clamp(Vec2::ZERO, Vec2::splat(CELLS as f32 - 1.0));
    for organ in &plant.organs {
        let Shape::Blade(blade) = &organ.shape else { continue };
        let blade = plant.templates.resolve(blade);
        let outline = blade.template.outline().iter();
        let leaf = Region::new(outline.map(|uv| blade.at_rest(*uv).truncate()).collect());
        let (a, b) = leaf.bounds().unwrap_or_default();
        for y in place(a).y as usize..=place(b).y as usize {
            for x in place(a).x as usize..=place(b).x as usize {
                covered[y * CELLS + x] |= leaf.contains(low + (Vec2::new(x as f32, y as f32) + 0.5) * cell);
            }
        }
    }
    for branch in plant.branches.iter().filter(|b| b.level > 0) {
        for p in &branch.points {
            let at = place(p.truncate());
            covered[at.y as usize * CELLS + at.x as usize] = true;
        }
    }
    covered
}

#[test]
fn a_flower_in_a_crown_is_at_its_front_and_one_on_a_stem_of_its_own_stays_on_that() {
    let mut sketch = drawing("oak", &[circle(Vec2::ZERO, 2.6)], true);
    // The crown's middle is (500, 430), its radius 350 pixels.
    let centre = Vec2::new(560.0, 330.0);
    for k in 0..5_u64 {
        let along = 30.0 * Vec2::from_angle(k as f32 * TAU / 5.0 + 0.3);
        let petal = ring(40, |t| centre + (1.1 - t.cos()) * along + 0.45 * t.sin() * along.perp());
        sketch.strokes.push(stroke(10 + k, Tool::Petal, petal));
    }
    // Pixels in front of the drawing.
    let depth = |sketch: &Sketch| {
        let built = build(sketch, &[]);
        built.plant.flowers[0].cone.apex.z / built.provenance.world_from_canvas.scale
    };
    let front = depth(&sketch);
    assert!((320.0..400.0).contains(&front), "{front}");
    let stem = (0..=20).map(|k| Vec2::new(500.0, 850.0).lerp(centre, k as f32 / 20.0)).collect();
    sketch.strokes.push(stroke(30, Tool::Branch, stem));
    let on_stem = depth(&sketch);
    assert!(on_stem.abs() < 0.5 * front, "{on_stem}");
}

#[test]
fn the_front_of_a_plant_is_the_crown_that_was_drawn() {
    for (name, outlines, least) in outlines() {
        let built = build(&drawing("box", &outlines, true), &[]);
        assert!(built.remarks.is_empty(), "{name}: {:?}", built.remarks);
        let (share, outside) = agreement(&built);
        assert!(share >= least, "{name}: intersection over union {share}");
        assert!(outside <= 0.04, "{name}: {outside} of the crown's area lies outside of it");
        let triangles = built.model.triangle_count();
        assert!(triangles < 1_200_000, "{name}: {triangles} triangles");
    }
}

#[test]
fn a_hollow_crown_looks_the_same_and_is_empty_inside() {
    let round = vec![circle(Vec2::new(0.0, 3.0), 2.0)];
    let [solid, hollow] = ["growth.hollow=0", "growth.hollow=0.75"].map(|set| {
        let sketch = drawing("box", &round, true);
        let built = build(&sketch, &[set]);
        let crown = depth::crowns(&built.anatomy, &built.provenance.world_from_canvas);
        let (low, high) = Region::new(crown[0].clone()).bounds().unwrap();
        let (centre, radius) = (low.midpoint(high).extend(0.0), 0.5 * (high.x - low.x));
        let inside = |organ: &&penstemon::plant::Organ| organ.base().distance(centre) < 0.6 * radius;
        let (share, outside) = agreement(&built);
        assert!(share >= 0.85 && outside <= 0.04, "{set}: {share}, {outside} outside");
        (built.plant.organs.iter().filter(inside).count(), built.plant.organs.len())
    });
    assert!(solid.0 > solid.1 / 20, "{} of {} leaves are inside of a solid crown", solid.0, solid.1);
    assert_eq!(hollow.0, 0, "of {} leaves", hollow.1);
    assert!(hollow.1 > solid.1 / 3 && hollow.1 < solid.1, "{} and {} leaves", hollow.1, solid.1);
}

#[test]
fn a_seedling_fills_the_volume_of_an_outline_and_nothing_else() {
    for (name, outlines, _) in outlines().into_iter().take(5) {
        let lowest = outlines.iter().flatten().map(|p| p.y).fold(f32::INFINITY, f32::min);
        // ObstacleKind a little above the ground.
        let lift = |outline: &Vec<Vec2>| outline.iter().map(|p| *p + Vec2::Y * (0.4 - lowest)).collect();
        let lifted: Outlines = outlines.iter().map(lift).collect();
        let volume = Envelope::Inflated(Arc::new(Inflated::new(lifted.clone(), 1.0).unwrap()));
        let mut simulation = Simulation::in_envelope(&Habit::default(), volume, 4, Limits::default());
        simulation.grow_to(60, &|| false);
        simulation.check_envelope().unwrap();
        let (share, _) = agreement_with(&plant_at(&simulation, 60.0).plant, lifted);
        assert!(share >= 0.85, "{name}: intersection over union {share}");
    }
}

#[test]
fn any_species_that_grows_fills_a_heart_without_a_drawn_trunk() {
    for species in penstemon::species::Species::growing() {
        let built = build(&drawing(species, &heart(), false), &["growth.fineness=0.8"]);
        let (share, outside) = agreement(&built);
        // Needles cover less than leaves.
        assert!(share >= 0.65 && outside <= 0.04, "{species}: {share}, {outside}");
        let foot = built.plant.branches[0].points[0];
        let height = pipeline::params_of(
            &Sketch::empty(),
            &penstemon::species::Species::built_in(species).unwrap(),
            &[],
        );
        let height = height.unwrap().depth.world.height;
        assert!(foot.length() < 0.05 * height, "{species}: the foot stands at {foot}");
        let (low, high) = built.model.bounds().unwrap();
        assert!(
            low.y > -0.02 * height && high.y > height && high.y < 1.3 * height,
            "{species}: {low} {high}"
        );
    }
}

#[test]
fn what_else_is_drawn_stays() {
    let mut sketch = drawing("box", &heart(), true);
    // A leaf at the trunk, a flower of five petals beside the crown on a stem of its own.
    sketch.strokes.push(stroke(20, Tool::Leaf, circle(Vec2::new(530.0, 860.0), 24.0)));
    let centre = Vec2::new(120.0, 700.0);
    for k in 0..5 {
        let out = Vec2::from_angle(k as f32 * TAU / 5.0);
        let petal = ring(30, |t| centre + out * (38.0 - 30.0 * t.cos()) + out.perp() * 14.0 * t.sin());
        sketch.strokes.push(stroke(30 + k, Tool::Petal, petal));
    }
    let stem = (0..=20).map(|k| centre + Vec2::Y * (197.0 * (1.0 - k as f32 / 20.0))).collect();
    sketch.strokes.push(stroke(40, Tool::Branch, stem));
    let built = build(&sketch, &[]);
    built.plant.check_invariants().unwrap();
    let stroke = |origin| built.provenance.stroke(origin);
    let drawn =
        |kind, id| built.plant.organs.iter().any(|o| o.kind() == kind && stroke(o.origin) == Some(id));
    assert!(drawn(OrganKind::Leaf, 20));
    assert!((30..35).all(|id| drawn(OrganKind::Petal, id)));
    assert_eq!(built.plant.flowers.len(), 1);
    let stem = built.plant.flowers[0].branch.unwrap();
    assert_eq!(stroke(built.plant.branches[stem].origin), Some(40), "the stem is as it was drawn");
    let leaf = built.plant.organs.iter().find(|o| stroke(o.origin) == Some(20)).unwrap();
    assert!(leaf.branch.is_some());
    assert!(agreement(&built).0 > 0.85);
}

#[test]
fn drawn_wood_is_seen_where_it_was_drawn() {
    let mut sketch = drawing("oak", &heart(), true);
    let bend = |k: usize| Vec2::new(500.0 - 9.0 * k as f32, 740.0 - 16.0 * k as f32 + 0.4 * (k * k) as f32);
    sketch.strokes.push(stroke(50, Tool::Branch, (0..=20).map(bend).collect()));
    let built = build(&sketch, &[]);
    let world = built.provenance.world_from_canvas;
    let diagonal = built.anatomy.diagonal * world.scale;
    for id in [1, 50] {
        let drawn = sketch.strokes.iter().find(|s| s.id == id).unwrap();
        for point in &drawn.points {
            let at = world.point(point.position).truncate();
            let away = |w: &[Vec3]| {
                let (a, b) = (w[0].truncate(), w[1].truncate());
                let t = ((at - a).dot(b - a) / (b - a).length_squared().max(1e-12)).clamp(0.0, 1.0);
                at.distance(a.lerp(b, t))
            };
            let nearest = built.plant.branches.iter().flat_map(|b| b.points.windows(2)).map(away);
            let nearest = nearest.fold(f32::INFINITY, f32::min);
            assert!(
                nearest < 0.005 * diagonal,
                "stroke {id} at {at}: {} of the diagonal",
                nearest / diagonal
            );
        }
    }
}

#[test]
fn other_years_of_the_same_drawing_begin_no_growth_anew_and_change_no_byte() {
    let sketch = drawing("box", &heart(), true);
    let mut cache = Cache::default();
    let first = build_with(&mut cache, &sketch, &[], &|| false).unwrap();
    let mut oldest = first.growth.unwrap().oldest;
    for years in ["3", "0", "7.5", "12"] {
        let set = format!("growth.years={years}");
        let again = build_with(&mut cache, &sketch, &[&set], &|| false).unwrap();
        let fresh = build(&sketch, &[&set]);
        assert_eq!(again.plant, fresh.plant, "{years} years");
        assert_eq!(again.model, fresh.model, "{years} years");
        let (grown, shown) = (again.growth.unwrap(), years.parse::<f32>().unwrap());
        assert_eq!(grown.shown, shown);
        // What grew before is still known, and goes on only where it is not old enough.
        oldest = shown.ceil().max(oldest);
        assert_eq!(grown.oldest, oldest, "{years} years");
    }
    let grown = |years: &str| {
        build_with(&mut Cache::default(), &sketch, &[years], &|| false).unwrap().plant.organs.len()
    };
    assert!(grown("growth.years=2") < grown("growth.years=5"));
}

#[test]
fn habits_in_the_drawing_are_those_of_the_command_line_and_grow_anew() {
    let mut sketch = drawing("box", &heart(), true);
    let mut cache = Cache::default();
    let own = build_with(&mut cache, &sketch, &["growth.years=4"], &|| false).unwrap();
    let set = build_with(&mut cache, &sketch, &["growth.years=4", "habit.branching=25"], &|| false).unwrap();
    assert!(own.plant != set.plant, "what grew before is not shown again");
    sketch.params = serde_json::json!({"habit": {"branching": 25}}).as_object().unwrap().clone();
    assert_eq!(build(&sketch, &["growth.years=4"]).plant, set.plant);
    sketch.params = serde_json::json!({"habit": {"branching": 250}}).as_object().unwrap().clone();
    let species = pipeline::species_of(&sketch, Path::new("")).unwrap();
    let message = pipeline::params_of(&sketch, &species, &[]).unwrap_err().to_string();
    assert_eq!(message, "the sketch: parameter `habit.branching` is 250, outside 0 to 175");
}

#[test]
fn habits_of_a_crown_rest_in_the_drawing_of_a_species_without_one() {
    let mut sketch = drawing("cypress", &heart(), true);
    sketch.params = serde_json::json!({"habit.crown.height": 7}).as_object().unwrap().clone();
    let params = |sketch: &Sketch| {
        let species = pipeline::species_of(sketch, Path::new("")).unwrap();
        pipeline::params_of(sketch, &species, &[]).map(|params| params.habit.crown.map(|c| c.height))
    };
    assert_eq!(params(&sketch).unwrap(), Some(7.0));
    for other in ["oak", "daisy"] {
        sketch.species = Some(other.to_owned());
        assert_eq!(params(&sketch).unwrap(), None, "{other}");
    }
    sketch.params = serde_json::json!({"habit.crown.height": -7}).as_object().unwrap().clone();
    assert!(params(&sketch).unwrap_err().to_string().contains("outside"), "but it must be in range");
    sketch.params = serde_json::json!({"habit.crown.hight": 7}).as_object().unwrap().clone();
    assert!(params(&sketch).unwrap_err().to_string().contains("habit.crown.hight"), "and known");
}

#[test]
fn growth_heeds_a_stop_and_goes_on_from_there() {
    let sketch = drawing("box", &heart(), true);
    let expected = build(&sketch, &[]);
    for after in [5, 12, 25] {
        let mut cache = Cache::default();
        let asked = AtomicUsize::new(0);
        let stop = || asked.fetch_add(1, Ordering::Relaxed) >= after;
        assert!(build_with(&mut cache, &sketch, &[], &stop).is_none());
        assert!(asked.load(Ordering::Relaxed) <= after + 3, "asked on {asked:?} times");
        let built = build_with(&mut cache, &sketch, &[], &|| false).unwrap();
        assert_eq!(built.plant, expected.plant);
    }
}

#[test]
fn a_species_that_does_not_grow_says_so_and_grows_all_the_same() {
    let built = build(&drawing("daisy", &heart(), true), &[]);
    let message = &built.remarks[0];
    assert!(
        matches!(&message.remark, Remark::DoesNotGrow { species, known } if species == "daisy" && known.contains("oak"))
    );
    assert_eq!(message.stroke, Some(2));
    let (share, _) = agreement(&built);
    assert!(share > 0.7, "{share}");
}

#[test]
fn without_a_crown_nothing_grows_until_years_are_asked_for() {
    let mut sketch = drawing("oak", &heart(), true);
    sketch.strokes.truncate(1);
    let drawn = build(&sketch, &[]);
    assert_eq!((drawn.plant.branches.len(), drawn.growth), (1, None));
    let grown = build(&sketch, &["growth.years=8"]);
    assert!(grown.plant.branches.len() > 10 && grown.plant.organs.len() > 50);
    assert_eq!(grown.growth.unwrap().shown, 8.0);
    sketch.species = Some("cypress".to_owned());
    let size = |years: &str| {
        let points = build(&sketch, &[years]).plant.branches.clone().into_iter().flat_map(|b| b.points);
        let (low, high) = points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)));
        high - low
    };
    assert_eq!(
        build(&sketch, &[]).growth,
        None,
        "a species' own crown is filled only when years are asked for"
    );
    let column = size("growth.years=20");
    assert!(column.y > 2.0 * column.x.max(column.z), "drawn trunks keep their species' crown: {column}");
    let mut beside: Stroke = (*sketch.strokes[0]).clone();
    beside.id = 9;
    beside.points.iter_mut().for_each(|p| p.position.x += 400.0);
    sketch.strokes.push(Arc::new(beside));
    let twins = build(&sketch, &["growth.years=8"]).plant;
    let twins = &twins.branches;
    let on = |trunk: usize| twins.iter().filter(|b| b.parent == Some(trunk)).count();
    let trunks: Vec<usize> = (0..twins.len()).filter(|b| twins[*b].parent.is_none()).collect();
    assert!(trunks.len() == 2 && trunks.iter().all(|t| on(*t) > 3), "both of two trunks branch");
    sketch.strokes.pop();
    sketch.species = Some("daisy".to_owned());
    assert_eq!(build(&sketch, &["growth.years=8"]).growth, None, "daisies do not say how they grow");
}

#[test]
fn odd_crowns_end_in_a_plant_or_a_remark() {
    let line = vec![(0..20).map(|k| Vec2::new(k as f32, 2.0 * k as f32)).collect::<Vec<_>>()];
    let built = build(&drawing("box", &line, true), &[]);
    assert!(built.remarks.iter().any(|w| w.remark == Remark::EmptyCrown));
    assert_eq!(built.growth, None);
    let scribble = vec![ring(200, |t| Vec2::new((7.0 * t).sin() * 3.0, (5.0 * t).cos() * 2.0 + t))];
    let thin = vec![vec![Vec2::ZERO, Vec2::new(0.02, 0.0), Vec2::new(0.03, 6.0), Vec2::new(0.01, 6.0)]];
    // An eight in one stroke: the two halves turn the other way round.
    let eight = vec![ring(80, |t| Vec2::new((2.0 * t).sin(), 2.0 * t.cos()))];
    let built = build(&drawing("box", &eight, true), &[]);
    assert!(built.remarks.is_empty() && agreement(&built).0 > 0.85, "{}", agreement(&built).0);
    // More crowns than may be: a field of dots.
    let dots: Outlines =
        (0..300).map(|k| circle(Vec2::new((k % 20) as f32, (k / 20) as f32) * 3.0, 1.0)).collect();
    let built = build(&drawing("box", &dots, true), &[]);
    let left_out = |w: &&_| matches!(w, Remark::ManyCrowns { most: 64 });
    assert!(built.remarks.iter().map(|w| &w.remark).filter(left_out).count() > 10);
    assert_eq!(built.anatomy.crowns.len(), 64);
    built.plant.check_invariants().unwrap();
    // The same outline twice: inside is outside everywhere.
    let twice = [heart(), heart()].concat();
    let far = vec![circle(Vec2::ZERO, 1.0), circle(Vec2::new(40.0, 30.0), 1.0)];
    for outlines in [scribble, thin, twice, far] {
        for with_trunk in [true, false] {
            let built = build(&drawing("oak", &outlines, with_trunk), &[]);
            built.plant.check_invariants().unwrap();
        }
    }
}
