//! Branches that grew, turned, bent, made thicker and cut off: the rest of the plant stays, and they are found again at other ages.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::in_space::{built, in_space};
use glam::{Quat, Vec3};
use penstemon::pipeline::Built;
use penstemon::plant::{Branch, GrownId, Origin};
use penstemon::sketch::{Brush, PartName, PartPose, Remark, Sketch, Stroke, StrokePoint, Tool};
use std::collections::HashSet;

/// A trunk on the sheet and sixteen branches in space, on which a species grows for some years.
fn growing(species: &str, years: f64) -> Sketch {
    let mut sketch = in_space();
    (sketch.species, sketch.part_poses) = (Some(species.to_owned()), [].into());
    sketch.params.insert("growth.years".to_owned(), years.into());
    sketch
}

fn posed(sketch: &Sketch, poses: &[PartPose]) -> Sketch {
    Sketch { part_poses: poses.into(), ..sketch.clone() }
}

fn name(branch: &Branch) -> Option<u64> {
    match branch.origin {
        Origin::Grown(GrownId(name)) => Some(name),
        _ => None,
    }
}

/// Whether each branch is another one, by its place, or grows on it, near or far.
fn on(built: &Built, below: usize) -> Vec<bool> {
    let mut on: Vec<bool> = Vec::new();
    for (index, branch) in built.plant.branches.iter().enumerate() {
        on.push(index == below || branch.parent.is_some_and(|parent| on[parent]));
    }
    on
}

/// The grown branch that carries most others.
fn bough(built: &Built) -> usize {
    let branches = &built.plant.branches;
    let mut carried = vec![1; branches.len()];
    for (index, branch) in branches.iter().enumerate().rev() {
        branch.parent.into_iter().for_each(|parent| carried[parent] += carried[index]);
    }
    let grown = (0..branches.len()).filter(|index| name(&branches[*index]).is_some());
    grown.max_by_key(|index| carried[*index]).unwrap()
}

fn still(built: &Built, index: usize) -> PartPose {
    PartPose::still(PartName::Grown(name(&built.plant.branches[index]).unwrap()))
}

#[test]
fn a_bough_turns_with_all_that_is_on_it_and_the_rest_stays_to_the_last_bit() {
    let sketch = growing("maple", 7.0);
    let before = built(&sketch);
    let bough = bough(&before);
    let turn = Quat::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), 0.7);
    let after = built(&posed(&sketch, &[PartPose { turn, ..still(&before, bough) }]));
    assert_eq!(after.remarks, before.remarks);
    assert_eq!(after.plant.branches.len(), before.plant.branches.len());
    let (moves, foot) = (on(&before, bough), before.plant.branches[bough].points[0]);
    assert!(moves.iter().filter(|moves| **moves).count() > 5, "it carries something");
    let turned = |point: &Vec3| foot + turn * (*point - foot);
    for ((was, is), moves) in before.plant.branches.iter().zip(&after.plant.branches).zip(&moves) {
        if !moves {
            assert_eq!(was, is);
            continue;
        }
        let off = was.points.iter().map(turned).zip(&is.points).map(|(a, b)| a.distance(*b));
        assert!(off.fold(0.0, f32::max) < 1e-4);
        assert_eq!(was.radii, is.radii);
    }
    let mut gone_along = 0;
    for (was, is) in before.plant.organs.iter().zip(&after.plant.organs) {
        assert_eq!(was.branch, is.branch);
        if was.branch.is_some_and(|branch| moves[branch]) {
            assert!(turned(&was.base()).distance(is.base()) < 1e-4, "leaves go along");
            gone_along += 1;
        } else {
            assert_eq!(was, is);
        }
    }
    assert!(gone_along > 10, "{gone_along} leaves");
}

#[test]
fn what_is_cut_off_goes_with_all_that_is_on_it() {
    let sketch = growing("maple", 7.0);
    let before = built(&sketch);
    let bough = bough(&before);
    let gone = on(&before, bough);
    let after = built(&posed(&sketch, &[PartPose { is_cut: true, ..still(&before, bough) }]));
    let left: Vec<&Vec<Vec3>> =
        before.plant.branches.iter().zip(&gone).filter(|(_, gone)| !**gone).map(|(b, _)| &b.points).collect();
    assert_eq!(after.plant.branches.iter().map(|branch| &branch.points).collect::<Vec<_>>(), left);
    let stands = before.plant.organs.iter().filter(|organ| organ.branch.is_none_or(|branch| !gone[branch]));
    let stands: Vec<Vec3> = stands.map(|organ| organ.base()).collect();
    assert_eq!(after.plant.organs.iter().map(|organ| organ.base()).collect::<Vec<_>>(), stands);
    assert!(stands.len() + 10 < before.plant.organs.len());
}

#[test]
fn a_bough_is_no_thicker_than_what_carries_it() {
    let sketch = growing("maple", 7.0);
    let before = built(&sketch);
    let bough = bough(&before);
    for (thickness, least) in [(5.0, 1.05), (0.4, 0.0)] {
        let after = built(&posed(&sketch, &[PartPose { thickness, ..still(&before, bough) }]));
        let (was, is) = (&before.plant.branches[bough], &after.plant.branches[bough]);
        let under = after.plant.branches[is.parent.unwrap()].axis_at(is.points[0]).1;
        assert!(is.radii[0] <= under, "{} on {under}", is.radii[0]);
        let tip = is.radii[is.radii.len() - 2] / was.radii[is.radii.len() - 2];
        assert!(tip >= least && tip <= thickness * 1.0001, "{tip} times as thick");
        assert_eq!(was.points, is.points);
    }
}

/// Branches, organs and the greatest radius of what stands on a branch that is called so.
fn carried(built: &Built, called: PartName) -> (usize, usize, f32) {
    let branches = &built.plant.branches;
    let is_it = |branch: &Branch| name(branch).map(PartName::Grown) == Some(called);
    let bough = branches.iter().position(is_it).unwrap();
    let on = on(built, bough);
    let organs = built.plant.organs.iter().filter(|organ| organ.branch.is_some_and(|branch| on[branch]));
    (on.iter().filter(|on| **on).count(), organs.count(), branches[bough].radii[0])
}

#[test]
fn a_younger_bough_has_less_of_everything_and_grows_up_with_its_plant() {
    let sketch = growing("maple", 8.0);
    let before = built(&sketch);
    let still = still(&before, bough(&before));
    let of = |years: f64, younger: u16| {
        let after = built(&posed(&growing("maple", years), &[PartPose { younger, ..still }]));
        assert_eq!(after.remarks, before.remarks, "{younger} years");
        after
    };
    let counts = [0, 1, 3, 100].map(|younger| carried(&of(8.0, younger), still.part));
    assert!(counts.windows(2).all(|pair| pair[0].0 > pair[1].0), "less wood with every year: {counts:?}");
    assert!(counts.windows(2).all(|pair| pair[0].2 > pair[1].2), "and thinner: {counts:?}");
    assert!(counts[0].1 > 2 * counts[2].1 && counts[3].1 > 0, "fewer leaves, but some: {counts:?}");
    // With its plant it grows older, as the bough did at that age.
    let (young, older) = (carried(&of(8.0, 3), still.part), carried(&of(9.0, 3), still.part));
    assert!(older.0 > young.0, "{young:?} {older:?}");
    let then = carried(&built(&growing("maple", 5.0)), still.part);
    // Others have grown on and left it less room than it had then.
    assert!(young.0 <= then.0 && 2 * young.0 > then.0, "{young:?} as {then:?} was");
    // The rest is what it was, but for twigs that find room.
    let whole = |built: &Built| built.plant.branches.len();
    let rest = |built: &Built| whole(built) - carried(built, still.part).0;
    let (now, after) = (rest(&before), rest(&of(8.0, 3)));
    assert!(now.abs_diff(after) * 25 < now, "{now} {after}");
}

#[test]
fn what_grows_on_a_drawn_branch_is_younger_with_it() {
    let sketch = growing("maple", 6.0);
    let before = built(&sketch);
    // The trunk.
    let younger = PartPose { younger: 3, ..PartPose::still(PartName::Stroke(sketch.strokes[0].id)) };
    let after = built(&posed(&sketch, &[younger]));
    assert_eq!(after.remarks, before.remarks);
    let count = |built: &Built| built.plant.branches.len();
    assert!(count(&after) * 2 < count(&before), "all stands on it: {} of {}", count(&after), count(&before));
    let drawn = |built: &Built| built.wood.branches(&built.plant).count();
    assert_eq!(drawn(&after), drawn(&before), "what was drawn stays");
}

#[test]
fn names_stay_at_other_ages_and_under_most_sliders() {
    let ages = [5.0, 6.0, 6.5, 7.0, 8.0].map(|years| growing("maple", years));
    let mut finer = ages[1].clone();
    for (path, value) in [("habit.leaf.length", 0.05), ("habit.tip", 0.003)] {
        finer.params.insert(path.to_owned(), value.into());
    }
    let pairs = ages.windows(2).map(|pair| (&pair[0], &pair[1]));
    for (from, to) in pairs.chain([(&ages[1], &finer)]) {
        let from = built(from);
        // The thickest: of the others one in five is shed, or finds no room any more, from one year to the next.
        let mut boughs: Vec<&Branch> = from.plant.branches.iter().filter(|b| name(b).is_some()).collect();
        boughs.sort_by(|a, b| b.radii[0].total_cmp(&a.radii[0]));
        let thicker = |name| PartPose { thickness: 1.1, ..PartPose::still(PartName::Grown(name)) };
        let poses: Vec<PartPose> = boughs.into_iter().take(100).filter_map(name).map(thicker).collect();
        let remarks = built(&posed(to, &poses)).remarks;
        let rest = remarks.iter().find_map(|warning| match warning.remark {
            Remark::PosesRest { poses } => Some(poses),
            _ => None,
        });
        let (rest, count) = (rest.unwrap_or(0), poses.len());
        assert!(rest as f32 <= 0.15 * count as f32, "{rest} of {count} are not found again");
    }
}

#[test]
fn a_pose_is_kept_through_the_years_and_rests_while_its_branch_is_not_there() {
    let old = built(&growing("maple", 7.0));
    let bough = bough(&old);
    let poses = [PartPose { turn: Quat::from_rotation_x(0.6), ..still(&old, bough) }];
    for years in [6.0, 6.5, 8.0] {
        let sketch = growing("maple", years);
        let (before, after) = (built(&sketch), built(&posed(&sketch, &poses)));
        assert_ne!(after.model, before.model, "after {years} years");
        assert_eq!(after.remarks, before.remarks);
    }
    let sketch = growing("maple", 0.0);
    let (before, after) = (built(&sketch), built(&posed(&sketch, &poses)));
    assert_eq!(after.model, before.model);
    let rest = after.remarks.iter().find(|warning| matches!(warning.remark, Remark::PosesRest { poses: 1 }));
    assert!(rest.is_some(), "{:?}", after.remarks);
}

#[test]
fn brushes_grow_on_posed_wood_and_what_they_grew_is_posed_too() {
    let sketch = growing("maple", 5.0);
    let before = built(&sketch);
    let bough = bough(&before);
    let turn = Quat::from_axis_angle(Vec3::Z, 0.9);
    let pose = PartPose { turn, ..still(&before, bough) };
    let bare = built(&posed(&sketch, &[pose]));
    // Painted downward from the end of the bough as it is turned.
    let end = *bare.plant.branches[bough].points.last().unwrap();
    let world = bare.provenance.world_from_canvas;
    let point = |k: usize| {
        let at = end - Vec3::Y * (0.02 * k as f32);
        StrokePoint { depth: at.z / world.scale, ..StrokePoint::at(world.canvas(at)) }
    };
    let brush = Some(Brush { radius: 0.06 / world.scale, guide: 1.5, ..Brush::default() });
    let points = (0..=10).map(point).collect();
    let mut painted = posed(&sketch, &[pose]);
    painted.strokes.push(Stroke { id: 40, tool: Tool::GrowthBrush, points, brush }.into());
    let with = built(&painted);
    assert_eq!(with.plant.branches[..bare.plant.branches.len()], bare.plant.branches[..]);
    let new = &with.plant.branches[bare.plant.branches.len()..];
    assert!(new.len() > 3, "{} branches in the stroke", new.len());
    let grown: HashSet<u64> = new.iter().filter_map(name).collect();
    assert_eq!(grown.len(), new.len(), "each has a name of its own");
    let index = bare.plant.branches.len();
    painted.part_poses = [pose, PartPose { bend: turn, ..still(&with, index) }].into();
    let bent = built(&painted);
    assert_eq!(bent.plant.branches[..index], with.plant.branches[..index]);
    assert_ne!(bent.plant.branches[index], with.plant.branches[index]);
    assert_eq!(bent.remarks, with.remarks);
}
