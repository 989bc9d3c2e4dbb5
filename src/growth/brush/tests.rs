//! Growth in strokes of a brush, in numbers (001 §4.4, fig. 4.7), and what is cut.

use super::*;
use crate::growth::at_age::PlantAtAge;
use crate::growth::brush::paint::tests::share_taken;
use crate::growth::habit::Habit;
use crate::growth::limits::Limits;
use crate::growth::volume::Swept;
use crate::plant::{Branch, FlowerBuds, Origin, Plant, Provenance, Role, WoodPart};
use glam::Vec3;
use std::sync::Arc;

/// A bare trunk of two metres.
fn trunk() -> PlantAtAge {
    let points: Vec<Vec3> = (0..=20).map(|k| Vec3::Y * (0.1 * k as f32)).collect();
    let radii = (0..=20).map(|k| 0.04 - 0.0015 * k as f32).collect();
    let (origin, role) = (Origin::Generated, Role::of(WoodPart::Stem));
    let trunk = Branch { origin, parent: None, level: 0, points, radii, role };
    let plant = Plant { branches: vec![trunk], ..Plant::default() };
    PlantAtAge { plant, buds: FlowerBuds::default() }
}

/// How any tree grows, two metres high.
fn tree() -> Habit {
    let habit = Habit::default();
    habit.scaled(2.0 / habit.height)
}

/// A stroke from the end of the trunk sideways, two metres long.
fn paint(guide: f32, seed: u64) -> Paint {
    let way: Vec<_> = (0..=40).map(|k| (Vec3::new(0.05 * k as f32, 1.9, 0.0), 0.2)).collect();
    let swept = Arc::new(Swept::new(&way, guide).unwrap());
    Paint { swept, obstacles: None, radius: 0.2, density: 1.0, seed }
}

fn painted(paint: &Paint) -> PlantAtAge {
    let mut plant = trunk();
    let how = paint.grow(
        (&mut plant, &Provenance::default()),
        (&mut Memory::default(), 0),
        (&tree(), Limits::default()),
        &|| false,
    );
    assert_eq!(how, Painted::Filled);
    plant
}

/// Of what is new: the mean length of branches as a multiple of the distance of their ends, and the mean angle between these
/// and the stroke, by their length, degrees.
fn straightness(plant: &PlantAtAge) -> (f32, f32) {
    let new = || plant.plant.branches.iter().skip(1);
    let (mut ratios, mut count) = (0.0, 0.0);
    for branch in new().filter(|branch| branch.points.len() >= 5) {
        let arc = crate::geom::polyline::length(&branch.points);
        ratios += arc / branch.points[0].distance(*branch.points.last().unwrap());
        count += 1.0;
    }
    let (mut angles, mut whole) = (0.0, 0.0);
    for branch in new() {
        let chord = *branch.points.last().unwrap() - branch.points[0];
        angles += chord.length() * chord.angle_between(Vec3::X).to_degrees();
        whole += chord.length();
    }
    (ratios / count, angles / whole)
}

#[test]
fn shoots_follow_the_stroke_that_guides_them() {
    let mean = |guide: f32| {
        let all = (0..10).map(|seed| straightness(&painted(&paint(guide, seed))));
        all.fold((0.0, 0.0), |sum, one| (sum.0 + one.0 / 10.0, sum.1 + one.1 / 10.0))
    };
    let (guided, free, against) = (mean(0.8), mean(0.0), mean(-0.8));
    assert!(guided.0 <= 1.15, "arc/chord {}", guided.0);
    assert!(guided.1 < free.1 - 5.0 && free.1 < against.1 - 5.0, "{guided:?} {free:?} {against:?}");
}

#[test]
fn what_is_swept_is_filled_and_nothing_else() {
    let paint = paint(0.8, 3);
    let plant = painted(&paint);
    let (before, after) = (trunk().plant, &plant.plant);
    assert_eq!(after.branches[..1], before.branches, "the wood that was there stays as it is");
    // Wood is moved a little where it is inserted in other wood.
    let way: Vec<_> = paint.swept.balls().iter().map(|ball| (ball.at, 1.06 * ball.radius)).collect();
    let around = Swept::new(&way, 0.0).unwrap();
    for branch in &after.branches[1..] {
        assert!(branch.points[1..].iter().all(|p| around.contains(*p)), "{:?}", branch.points);
        let on = &after.branches[branch.parent.unwrap()];
        let (place, radius) = on.axis_at(branch.points[0]);
        assert!(place.distance(branch.points[0]) < 1e-4);
        assert!(branch.radii.iter().all(|r| *r <= 0.92 * radius + 1e-6));
    }
    let leaves = after.organs.len();
    assert!(after.branches.len() > 60 && leaves > 500, "{} branches, {leaves} leaves", after.branches.len());
    let taken = share_taken(&paint, &trunk(), &tree());
    assert!(taken >= 0.9, "{taken} of the markers are taken");
}

#[test]
fn a_long_stroke_is_filled_to_its_end() {
    // Eight turns around the trunk, two hundred radii.
    let at = |k: usize| {
        let (sin, cos) = (k as f32 * 0.05).sin_cos();
        (Vec3::new(0.4 * cos, 0.2 + 0.0018 * k as f32, 0.4 * sin), 0.1)
    };
    let way: Vec<_> = (0..1000).map(at).collect();
    let swept = Arc::new(Swept::new(&way, 0.8).unwrap());
    let paint = Paint { swept, obstacles: None, radius: 0.1, density: 1.0, seed: 3 };
    let plant = painted(&paint);
    for (end, _) in [way[0], way[500], way[999]] {
        let leaves = plant.plant.organs.iter().filter(|leaf| leaf.base().distance(end) < 0.1).count();
        assert!(leaves > 10, "{leaves} leaves at {end}");
    }
    let taken = share_taken(&paint, &trunk(), &tree());
    assert!(taken >= 0.9, "{taken} of the markers are taken");
}

#[test]
fn another_stroke_beside_it_leaves_the_first_as_it_was() {
    let (first, second) = (paint(0.8, 3), Paint { seed: 4, ..paint(0.8, 4) });
    let mut memory = Memory::default();
    let (habit, limits) = (tree(), Limits::default());
    let mut plant = trunk();
    first.grow((&mut plant, &Provenance::default()), (&mut memory, 0), (&habit, limits), &|| false);
    let alone = plant.clone();
    second.grow((&mut plant, &Provenance::default()), (&mut memory, 1), (&habit, limits), &|| false);
    assert_eq!(plant.plant.branches[..alone.plant.branches.len()], alone.plant.branches);
    // Again, from memory.
    let mut again = trunk();
    first.grow((&mut again, &Provenance::default()), (&mut memory, 0), (&habit, limits), &|| false);
    second.grow((&mut again, &Provenance::default()), (&mut memory, 1), (&habit, limits), &|| false);
    assert_eq!(plant, again);
}

#[test]
fn a_stroke_in_the_air_is_led_to_and_one_too_far_away_is_not() {
    let at = |x: f32| {
        let way: Vec<_> = (0..=10).map(|k| (Vec3::new(x + 0.03 * k as f32, 1.5, 0.0), 0.15)).collect();
        Paint { swept: Arc::new(Swept::new(&way, 0.8).unwrap()), ..paint(0.8, 1) }
    };
    let near = painted(&at(0.6));
    let lead = &near.plant.branches[1];
    assert_eq!((lead.parent, lead.points[0].x), (Some(0), 0.0));
    assert!(near.plant.branches.len() > 5);
    let (mut far, habit) = (trunk(), tree());
    let how = at(5.0).grow(
        (&mut far, &Provenance::default()),
        (&mut Memory::default(), 0),
        (&habit, Limits::default()),
        &|| false,
    );
    assert_eq!((how, &far), (Painted::OutOfReach, &trunk()));
    let mut none = PlantAtAge { plant: Plant::default(), buds: FlowerBuds::default() };
    let how = at(0.6).grow(
        (&mut none, &Provenance::default()),
        (&mut Memory::default(), 0),
        (&habit, Limits::default()),
        &|| false,
    );
    assert_eq!(how, Painted::OutOfReach);
}

#[test]
fn what_a_pruning_brush_sweeps_is_gone_with_all_that_stood_on_it() {
    let mut plant = painted(&paint(0.8, 3));
    let before = plant.clone();
    let across: Vec<_> = (0..=10).map(|k| (Vec3::new(1.0, 1.4 + 0.1 * k as f32, 0.0), 0.25)).collect();
    let swept = Swept::new(&across, 0.0).unwrap();
    assert!(prune(&mut plant, &swept));
    plant.plant.check_invariants().unwrap();
    assert!(!prune(&mut plant, &swept), "there is nothing left to cut");
    for branch in &plant.plant.branches {
        // Up to where a cut is found by halving.
        let inside = branch.points.iter().filter(|p| swept.contains(**p)).count();
        assert!(inside <= 1, "{:?}", branch.points);
    }
    assert!(plant.plant.organs.iter().all(|organ| !swept.contains(organ.base())));
    let beyond = |plant: &PlantAtAge| plant.plant.branches.iter().filter(|b| b.points[0].x > 1.3).count();
    assert!(beyond(&before) > 10 && beyond(&plant) == 0, "nothing hangs in the air");
    assert_eq!(plant.plant.branches[0], before.plant.branches[0]);
    let beside = Swept::new(&[(Vec3::new(-3.0, 1.0, 0.0), 0.5)], 0.0).unwrap();
    let mut same = before.clone();
    assert!(!prune(&mut same, &beside) && same == before);
}

#[test]
fn a_trunk_that_is_cut_at_its_foot_leaves_nothing() {
    let mut plant = painted(&paint(0.8, 3));
    assert!(prune(&mut plant, &Swept::new(&[(Vec3::ZERO, 0.2)], 0.0).unwrap()));
    assert!(plant.plant.branches.is_empty() && plant.plant.organs.is_empty());
}
