//! Tests of what changes with a plant's age: numbers of its species.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use super::leaf::LeafHabit;
use super::species::Control;
use super::*;
use crate::plant::{OrganKind, Plant, Shape};
use glam::Vec3;

const LIMITS: Limits = Limits { internodes: 60_000, markers: 50_000, voxels: 4 << 20, seconds: 300 };

fn grown(habit: &Habit, age: u16) -> Simulation {
    let mut simulation = Simulation::new(habit, 3, LIMITS);
    assert_eq!(simulation.grow_to(age, &|| false), Outcome::Growing);
    simulation
}

/// A habit whose every number counts: by priorities, with flowers.
fn every_number_counts() -> Habit {
    Habit {
        internode: 0.3,
        shed: 0.02.into(),
        control: Control::Priority,
        flowering: 0.5.into(),
        flower_age: 2.0,
        ..Habit::default()
    }
}

#[test]
fn decisions_of_a_year_follow_the_numbers_of_that_year_and_what_grew_stays() {
    fn field<'a>(habit: &'a mut Habit, name: &str) -> &'a mut Schedule {
        match name {
            "shorter" => &mut habit.shorter,
            "divergence" => &mut habit.divergence,
            "branching_spread" => &mut habit.branching_spread,
            "omega_max" => &mut habit.omega_max,
            "omega_min" => &mut habit.omega_min,
            _ => &mut habit.flower_below,
        }
    }
    for (name, young, old) in [
        ("shorter", 0.9, 0.6),
        ("divergence", 137.5, 90.0),
        ("branching_spread", 8.0, 40.0),
        ("omega_max", 1.0, 0.1),
        ("omega_min", 0.006, 0.4),
        ("flower_below", 1.0, 4.0),
    ] {
        let with = |value: Schedule| {
            let mut habit = every_number_counts();
            *field(&mut habit, name) = value;
            habit
        };
        let text = format!("{name} = [[4, {young}], [6, {old}]]");
        let read: Habit = toml::from_str(&text).unwrap();
        let schedule = field(&mut read.clone(), name).clone();
        assert_eq!([0.0, 4.0, 6.0, 9.0].map(|age| schedule.at(age)), [young, young, old, old], "{name}");
        let mut changing = grown(&with(schedule), 8);
        let constant = |value: f32, age| grown(&with(value.into()), age);
        assert_ne!(changing.tree(), constant(young, 8).tree(), "{name}: later years are others");
        assert_ne!(changing.tree(), constant(old, 8).tree(), "{name}");
        changing.rewind(4);
        assert_eq!(changing.tree(), constant(young, 4).tree(), "{name}: the first years are the same");
    }
}

#[test]
fn leaves_have_the_looks_of_the_age_that_is_shown() {
    let text = "length = [[2, 0.02], [6, 0.1]]\nangle = [[2, 20], [6, 80]]\nwidth = [[2, 0.2], [6, 0.8]]";
    let leaf: LeafHabit = toml::from_str(text).unwrap();
    let habit = Habit { leaf, ..every_number_counts() };
    let simulation = grown(&habit, 8);
    let blades = |age: f32| -> Vec<(Vec3, f32)> {
        let organs = plant_at(&simulation, age).organs.into_iter().filter(|o| o.kind == OrganKind::Leaf);
        organs.map(|o| (o.base(), if let Shape::Blade(b) = o.shape { b.v.length() } else { 0.0 })).collect()
    };
    let longest = |age| blades(age).iter().map(|b| b.1).fold(0.0, f32::max);
    assert!((0.02..=0.025).contains(&longest(2.0)) && (0.1..=0.125).contains(&longest(6.0)));
    assert!((longest(4.0) - longest(2.0).midpoint(longest(6.0))).abs() < 0.005, "{}", longest(4.0));
    assert_eq!(habit.leaf.at(4.0).angle_rad, 50f32.to_radians());
    // Nothing of how the plant grows depends on it.
    let plain = grown(&Habit { leaf: LeafHabit::default(), ..habit }, 8);
    assert_eq!(simulation.tree(), plain.tree());
}

/// How many times as high as wide a plant is, leaves left out.
fn slender(plant: &Plant) -> f32 {
    let points = plant.branches.iter().flat_map(|b| &b.points);
    let (low, high) = points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), p| (l.min(*p), h.max(*p)));
    let size = high - low;
    size.y / size.x.max(size.z)
}

/// A species file of fig. 2.7 of 001 with these values of its apical control and of its branches.
fn fig_2_7(lambda: &str, lift_branch: &str) -> Simulation {
    let text = format!(
        "internode = 0.3\nshed = 0.02\nlambda = {lambda}\nlift_branch = {lift_branch}\n[light]\ndarkening = 0.05\n"
    );
    grown(&toml::from_str(&text).unwrap(), 30)
}

#[test]
fn one_plant_is_a_whip_at_5_and_a_wide_crown_at_30() {
    let plant = fig_2_7("[[0, 0.8], [5, 0.8], [8, 0.42]]", "[[0, 0.5], [5, 0.5], [12, -0.05]]");
    let [always_young, always_old] = [fig_2_7("0.8", "0.5"), fig_2_7("0.42", "-0.05")];
    let at = |simulation: &Simulation, age| slender(&plant_at(simulation, age));
    assert!(at(&plant, 5.0) > 8.0, "a whip: {}", at(&plant, 5.0));
    assert!(at(&plant, 30.0) < 1.2, "a crown as wide as high: {}", at(&plant, 30.0));
    assert!(plant_at(&plant, 30.0).branches.len() > 1000, "a full one");
    assert!(
        at(&always_young, 30.0) > 8.0,
        "what is young for ever gets no crown: {}",
        at(&always_young, 30.0)
    );
    assert!(at(&always_old, 5.0) < 2.0, "what was never young was no whip: {}", at(&always_old, 5.0));
}
