//! Tests of what changes with a plant's age: numbers of its species, and what the age slider shows.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use super::*;
use crate::budget::Budget;
use crate::growth::at_age::PlantAtAge;
use crate::growth::at_age::chains::Chain;
use crate::growth::at_age::to_plant::with_wood;
use crate::growth::at_age::wood_at_age::{WoodAtAge, wood_at_age};
use crate::growth::habit::Control;
use crate::growth::habit::LeafHabit;
use crate::growth::tree::NONE;
use crate::plant::{Branch, Organ, OrganKind, Plant, Shape};
use glam::Vec3;
use std::collections::BTreeMap;

const LIMITS: Limits = Limits {
    internodes: 60_000,
    markers: 50_000,
    voxels: 4 << 20,
    steps: 2_000_000_000,
    ..Limits::within(&Budget::PLANT)
};

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
        assert!(changing.tree() != constant(young, 8).tree(), "{name}: later years are others");
        assert!(changing.tree() != constant(old, 8).tree(), "{name}: and no years of the old");
        changing.rewind(4);
        assert!(changing.tree() == constant(young, 4).tree(), "{name}: the first years are the same");
    }
}

#[test]
fn leaves_have_the_looks_of_the_age_that_is_shown() {
    let text = "length = [[2, 0.02], [6, 0.1]]\nangle = [[2, 20], [6, 80]]\nwidth = [[2, 0.2], [6, 0.8]]";
    let leaf: LeafHabit = toml::from_str(text).unwrap();
    let habit = Habit { leaf, ..every_number_counts() };
    let simulation = grown(&habit, 8);
    let blades = |age: f32| -> Vec<(Vec3, f32)> {
        let organs =
            plant_at(&simulation, age).plant.organs.into_iter().filter(|o| o.kind() == OrganKind::Leaf);
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

/// How a built-in species grows.
fn of_file(name: &str) -> Habit {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    let path = ["growth", "species"].map(|folder| root.join(format!("{folder}/{name}.toml")));
    let text = path.iter().find_map(|path| std::fs::read_to_string(path).ok()).unwrap();
    text.parse::<toml::Table>().unwrap()["growth"].clone().try_into().unwrap()
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
    let at = |simulation: &Simulation, age| slender(&plant_at(simulation, age).plant);
    assert!(at(&plant, 5.0) > 8.0, "a whip: {}", at(&plant, 5.0));
    assert!(at(&plant, 30.0) < 1.2, "a crown as wide as high: {}", at(&plant, 30.0));
    assert!(plant_at(&plant, 30.0).plant.branches.len() > 1000, "a full one");
    assert!(
        at(&always_young, 30.0) > 8.0,
        "what is young for ever gets no crown: {}",
        at(&always_young, 30.0)
    );
    assert!(at(&always_old, 5.0) < 2.0, "what was never young was no whip: {}", at(&always_old, 5.0));
}

/// A plant between two positions of the age slider.
struct Shown {
    wood: WoodAtAge,
    /// Its branches by the nodes that they run through.
    branches: BTreeMap<Vec<u32>, Branch>,
    /// Bases of leaves and flowers with their lengths, by x.
    blades: Vec<(Vec3, f32)>,
}

impl Shown {
    fn new(simulation: &Simulation, age: f32) -> Self {
        let (PlantAtAge { plant, .. }, WoodAtAge { chains, .. }) =
            with_wood(simulation, simulation.tree(), age, None);
        let nodes = |c: &Chain| chains.nodes[c.range.0 as usize..c.range.1 as usize].to_vec();
        let blade = |o: &Organ| match &o.shape {
            Shape::Blade(b) => Some((b.base, b.v.length())),
            _ => None,
        };
        let mut blades: Vec<(Vec3, f32)> = plant.organs.iter().filter_map(blade).collect();
        blades.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
        Self {
            wood: wood_at_age(simulation, simulation.tree(), age),
            branches: chains.chains.iter().map(nodes).zip(plant.branches).collect(),
            blades,
        }
    }

    fn stands(&self, node: usize) -> bool {
        self.wood.chains.of_node.get(node).is_some_and(|chain| *chain != NONE)
    }

    /// Length of the longest leaf or flower without another in `before` within a distance.
    fn longest_new(&self, before: &Self, near: f32) -> f32 {
        let is_new = |(base, _): &&(Vec3, f32)| {
            let from = before.blades.partition_point(|b| b.0.x < base.x - near);
            let mut beside = before.blades[from..].iter().take_while(|b| b.0.x <= base.x + near);
            !beside.any(|b| b.0.distance(*base) <= near)
        };
        self.blades.iter().filter(is_new).map(|b| b.1).fold(0.0, f32::max)
    }
}

/// The largest distance of a point of one branch from another; and of points that go with each other, where there are as
/// many, the largest difference of their radii.
fn apart(one: &Branch, other: &Branch) -> (f32, f32) {
    let nearest = |p: &Vec3| {
        let on = |w: &[Vec3]| {
            let way = w[1] - w[0];
            let t = (p - w[0]).dot(way) / way.length_squared().max(1e-20);
            p.distance(w[0] + way * t.clamp(0.0, 1.0))
        };
        other.points.windows(2).map(on).fold(f32::INFINITY, f32::min)
    };
    let as_many = one.points.len() == other.points.len();
    let thicker = one.radii.iter().zip(&other.radii).filter(|_| as_many).map(|(r, s)| (r - s).abs());
    (one.points.iter().map(nearest).fold(0.0, f32::max), thicker.fold(0.0, f32::max))
}

/// What changes most from one position of the slider to the next: in internodes, in diameters of the thinnest wood, and
/// in lengths of a leaf.
#[derive(Debug, Default)]
struct Largest {
    moved: f32,
    thicker: f32,
    new_wood: f32,
    new_leaf: f32,
}

#[test]
fn the_age_slider_is_smooth() {
    for name in ["spruce", "birch", "oak", "apple", "cherry", "hazel"] {
        let habit = of_file(name);
        let simulation = grown(&habit, 8);
        let (tree, leaf) = (simulation.tree(), habit.leaf.at(8.0).length);
        let mut most = Largest::default();
        let mut before = Shown::new(&simulation, 7.0);
        let mut come = 0;
        for step in 1..=50u8 {
            let now = Shown::new(&simulation, 7.0 + f32::from(step) / 50.0);
            for i in 0..tree.len() {
                if now.stands(i) && before.stands(i) {
                    let moved = now.wood.at[i].distance(before.wood.at[i]);
                    most.moved = most.moved.max(moved / habit.internode);
                    let thicker = now.wood.diameters[i] - before.wood.diameters[i];
                    most.thicker = most.thicker.max(thicker.abs() / habit.tip);
                } else if now.stands(i) {
                    let long = now.wood.at[i].distance(now.wood.chains.below(i, tree, &now.wood.at));
                    most.new_wood = most.new_wood.max(long / habit.internode);
                    come += 1;
                } else if before.stands(i) {
                    assert_eq!(step, 1, "{name}: node {i} goes within a year");
                }
            }
            for (nodes, branch) in &now.branches {
                let Some(was) = before.branches.get(nodes) else { continue };
                for (moved, thicker) in [apart(branch, was), apart(was, branch)] {
                    most.moved = most.moved.max(moved / habit.internode);
                    most.thicker = most.thicker.max(2.0 * thicker / habit.tip);
                }
            }
            let new_leaf = now.longest_new(&before, 0.15 * habit.internode) / leaf;
            if name == "hazel" && step == 1 {
                // Shoots of the hazel are cut at the beginning of the year, and their new ends have the leaves of an end at
                // once: whole ones, of which the longest are a quarter longer than the rest.
                assert!(new_leaf < 1.26, "{new_leaf}");
            } else {
                most.new_leaf = most.new_leaf.max(new_leaf);
            }
            before = now;
        }
        assert!(come > 10, "{name}");
        // A fiftieth of a year's shoot of some four internodes, and of what the trunk thickens in a year.
        assert!(most.moved < 0.12 && most.thicker < 0.5, "{name}: {most:?}");
        assert!(most.new_wood < 0.05 && most.new_leaf < 0.1, "{name}: {most:?}");
    }
}

#[test]
fn dead_limbs_bear_nothing_and_fall_bit_by_bit() {
    let habit =
        |dead_years| Habit { internode: 0.3, shed: 0.15.into(), tip: 0.008, dead_years, ..Habit::default() };
    let (simulation, gone_at_once) = (grown(&habit(1.0), 14), grown(&habit(0.0), 14));
    let tree = simulation.tree();
    assert_eq!(
        tree.nodes,
        gone_at_once.tree().nodes,
        "the dead take no light and no room while the plant grows"
    );
    let stands = |wood: &WoodAtAge, i: usize| wood.chains.of_node.get(i).is_some_and(|chain| *chain != NONE);
    let mut before = wood_at_age(&simulation, tree, 4.0);
    let (mut dead, mut fell) = (0, 0);
    for year in 5..=14u16 {
        let now = wood_at_age(&simulation, tree, f32::from(year));
        for i in 0..tree.len() {
            dead += usize::from(stands(&now, i) && !tree.lives(i, year));
            if stands(&before, i) && !stands(&now, i) && tree.nodes.died[i] == year {
                fell += 1;
                assert!(now.diameters[i] < 0.01, "year {year}: {} m fell at once", now.diameters[i]);
            }
        }
        before = now;
    }
    assert!(dead > 50 && fell > 50, "{dead} {fell}");
    let [one, other] = [&simulation, &gone_at_once].map(|it| Shown::new(it, 14.0));
    assert!(one.branches.len() > other.branches.len(), "dead branches are there");
    let same = one.blades.iter().filter(|blade| other.blades.contains(blade)).count();
    assert!(one.blades.len() - same < other.blades.len() / 30, "{same} of {}", one.blades.len());
}
