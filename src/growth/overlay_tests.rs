//! What is seen of growth is what growth goes by.

use super::*;
use crate::budget::Budget;
use crate::growth::habit::{Resource, SpaceHabit};
use crate::growth::{Envelope, Habit, Limits};

const LIMITS: Limits = Limits {
    internodes: 20_000,
    markers: 50_000,
    voxels: 4 << 20,
    steps: 2_000_000_000,
    ..Limits::within(&Budget::PLANT)
};
const ALL: Wanted = Wanted { markers: true, buds: true, light: true };
const CENTRE: Vec3 = Vec3::new(0.0, 4.0, 0.0);

fn count(spots: &[Spot], of: impl Fn(&Kind) -> bool) -> usize {
    spots.iter().filter(|spot| of(&spot.kind)).count()
}

/// A plant in a ball, 10 years old.
fn in_a_ball() -> Simulation {
    let space = SpaceHabit { markers: 300.0, ..SpaceHabit::default() };
    let habit = Habit { resource: Resource::Space, space, internode: 0.25, ..Habit::default() };
    let ball = Envelope::Sphere { centre: CENTRE, radius: 2.0 };
    let mut simulation = Simulation::in_envelope(&habit, ball, 5, LIMITS);
    simulation.grow_to(10, &|| false);
    simulation
}

fn in_the_light() -> Simulation {
    let mut simulation = Simulation::new(&Habit::default(), 3, LIMITS);
    simulation.grow_to(10, &|| false);
    simulation
}

#[test]
fn markers_lie_in_the_envelope_and_more_are_taken_every_year() {
    let simulation = in_a_ball();
    let Field::Space(markers) = simulation.field() else { panic!("no markers") };
    let mut before = 0;
    for age in [2.0, 5.0, 10.0] {
        let spots = overlay(&simulation, age, Wanted { markers: true, ..Wanted::default() });
        assert_eq!(spots.len(), markers.len(), "as many as there are at {age}");
        assert!(spots.iter().all(|spot| spot.at.distance(CENTRE) <= 2.0));
        let taken = count(&spots, |kind| *kind == Kind::Taken);
        assert!(taken > before, "{taken} at {age}, {before} before");
        before = taken;
    }
    assert_eq!(before, markers.occupied().count(), "at its own age those that are occupied");
}

#[test]
fn an_age_of_the_past_looks_as_it_did_then() {
    for (simulation, age) in [(in_a_ball(), 4.0), (in_the_light(), 6.0)] {
        let mut then = simulation.clone();
        then.rewind(age as u16);
        let sorted = |simulation: &Simulation| {
            let mut all: Vec<String> =
                overlay(simulation, age, ALL).iter().map(|spot| format!("{spot:?}")).collect();
            all.sort_unstable();
            all
        };
        assert!(sorted(&simulation).len() > 50);
        assert_eq!(sorted(&simulation), sorted(&then));
    }
}

#[test]
fn open_buds_are_shown_where_they_sit() {
    let simulation = in_the_light();
    let spots = overlay(&simulation, 10.0, Wanted { buds: true, ..Wanted::default() });
    let (tree, reach) = (simulation.tree(), simulation.habit().internode * WAY);
    assert_eq!(spots.len(), tree.open.len());
    let (mut young, mut old) = (0, 0);
    for (spot, &bud) in spots.iter().zip(&tree.open) {
        assert_eq!(spot.at, tree.nodes.at[tree.buds.node[bud as usize] as usize]);
        let (Kind::Active { way } | Kind::Dormant { way }) = spot.kind else { panic!("{spot:?} is no bud") };
        assert!((way.length() - reach).abs() < 1e-3 * reach);
        let is_young = tree.buds.born[bud as usize] == 10;
        assert_eq!(matches!(spot.kind, Kind::Active { .. }), is_young);
        if is_young { young += 1 } else { old += 1 }
    }
    assert!(young > 10 && old > 10, "{young} active and {old} dormant");
}

#[test]
fn it_is_darker_in_the_crown_than_at_its_top() {
    let simulation = in_the_light();
    let Field::Light(shadow) = simulation.field() else { panic!("no light") };
    let spots = overlay(&simulation, 10.0, Wanted { light: true, ..Wanted::default() });
    assert!(spots.len() > 100);
    let light = |spot: &Spot| match spot.kind {
        Kind::Light { exposure } => exposure,
        other => panic!("{other:?} is no light"),
    };
    for spot in &spots {
        assert_eq!(light(spot), shadow.exposure(spot.at));
        assert!(shadow.shadow(spot.at) >= 0.99 * SHADE * shadow.full() && spot.at.y > 0.0);
    }
    let top = spots.iter().max_by(|a, b| a.at.y.total_cmp(&b.at.y)).unwrap();
    let darkest = spots.iter().map(light).fold(1.0, f32::min);
    assert!(light(top) > darkest + 0.1, "{} at the top, {darkest} at the darkest", light(top));
}

#[test]
fn nothing_is_computed_that_nobody_wants_and_no_more_than_can_be_seen() {
    let simulation = in_a_ball();
    assert_eq!(overlay(&simulation, 10.0, Wanted::default()), []);
    assert_eq!(overlay(&simulation, 10.0, Wanted { light: true, ..Wanted::default() }), []);
    let ball = Envelope::Sphere { centre: CENTRE, radius: 2.0 };
    let markers = Markers::scatter(&ball, 6000.0, 500_000, 0.5, 7);
    assert!(markers.len() > 3 * MOST);
    let spots = of_markers(&markers, 0);
    assert!(spots.len() <= MOST && spots.len() > MOST / 2, "{}", spots.len());
    let above = spots.iter().filter(|spot| spot.at.y > CENTRE.y).count() as f32;
    assert!((above / spots.len() as f32 - 0.5).abs() < 0.02, "evenly");
}
