//! The plants of the training set: habits, those held back, and a plant of an age as leaves and wood.
//!
//! Habits are the species that grow, and others made from them by `habit.…` parameters. Every plant has, besides its seed, branching
//! angles, lift and internodes of its own within some percent. All ages of a plant come from one simulation.

use anyhow::Result;
use glam::Vec3;
use penstemon::growth::{self, Limits, Simulation};
use penstemon::pipeline;
use penstemon::plant::{OrganPart, Role, Shape};
use penstemon::random::{mix, unit};
use penstemon::species::Species;

/// Habits made from a species: name, species, assignments.
const ALTERED: [(&str, &str, &[&str]); 7] = [
    ("spreading oak", "oak", &["habit.branching=75", "habit.lift_branch=-0.05"]),
    ("weeping birch", "birch", &["habit.lift_twig=-0.5"]),
    ("upright maple", "maple", &["habit.branching=28", "habit.lift_branch=0.5"]),
    ("level ash", "ash", &["habit.level=0.6"]),
    ("many-stemmed hazel", "hazel", &["habit.stems=7", "habit.stem_lean=35"]),
    ("broad pine", "pine", &["habit.branching=80", "habit.seeking=0.5"]),
    ("round apple", "apple", &["habit.branching=65", "habit.wander=0.4"]),
];
/// Habits of which no plant is ever trained on.
pub(crate) const HELD_BACK: [&str; 4] = ["walnut", "cypress", "rowan", "spreading oak"];
/// Ages at which a plant is looked at, as shares of the habit's own.
const AGES: [f32; 4] = [0.45, 0.65, 0.85, 1.0];
/// Most internodes of a plant: enough for its form.
const INTERNODES: usize = 40_000;

/// How a plant grows.
pub(crate) struct Kind {
    /// What it is called.
    pub(crate) name: String,
    species: Species,
    assignments: Vec<String>,
}

impl Kind {
    /// All habits, sorted by name: those of species first.
    pub(crate) fn all() -> Result<Vec<Self>> {
        let own = Species::growing().into_iter().map(|name| (name, name, &[][..]));
        let kind = |(name, species, assignments): (&str, &str, &[&str])| {
            let assignments = assignments.iter().map(|&text| text.to_owned()).collect();
            Ok(Self { name: name.to_owned(), species: Species::built_in(species)?, assignments })
        };
        own.chain(ALTERED).map(kind).collect()
    }

    /// Whether it is held back.
    pub(crate) fn is_held_back(&self) -> bool {
        HELD_BACK.contains(&self.name.as_str())
    }

    /// The species that it is of.
    pub(crate) fn species(&self) -> &str {
        &self.species.name
    }

    /// Grows a plant and hands on what it is at each of its ages.
    pub(crate) fn grow(&self, seed: u64, mut each: impl FnMut(Tree)) -> Result<()> {
        let params = pipeline::params_of_species(&self.species, &self.assignments)?;
        let mut habit = params.habit;
        let other = |name: u64, by: f32| 1.0 + by * (2.0 * unit(mix(seed, name)) - 1.0);
        habit.branching = habit.branching.times(other(1, 0.15));
        habit.internode *= other(2, 0.1);
        habit.lift_branch = habit.lift_branch.times(other(3, 0.3));
        let limits =
            Limits { internodes: INTERNODES, leaves: INTERNODES, ..Limits::of_internodes(INTERNODES) };
        let mut simulation = Simulation::new(&habit, seed, limits);
        for share in AGES {
            let age = (habit.age as f32 * share).round().max(2.0);
            simulation.grow_to(age as u16, &|| false);
            each(Tree::of(&simulation, age));
        }
        Ok(())
    }
}

/// A line of wood in space.
pub(crate) struct Wood {
    /// Its points, base first.
    pub(crate) points: Vec<Vec3>,
    /// Radius at its base.
    pub(crate) radius: f32,
    /// Branching order.
    pub(crate) level: u32,
}

/// A plant as leaves and wood, its foot at the origin.
pub(crate) struct Tree {
    /// Base and tip of every leaf.
    pub(crate) leaves: Vec<[Vec3; 2]>,
    /// All branches.
    pub(crate) wood: Vec<Wood>,
}

impl Tree {
    fn of(simulation: &Simulation, age: f32) -> Self {
        let plant = growth::plant_at(simulation, age).plant;
        let foot = plant.branches.first().map_or(Vec3::ZERO, |branch| branch.points[0]);
        let leaf = |organ: &penstemon::plant::Organ| match &organ.shape {
            Shape::Blade(blade) if organ.role == Role::of(OrganPart::Leaf) => Some([
                blade.base - foot,
                blade.base + blade.v * plant.templates[blade.template].length() - foot,
            ]),
            _ => None,
        };
        let wood = plant.branches.iter().map(|branch| Wood {
            points: branch.points.iter().map(|p| *p - foot).collect(),
            radius: branch.radii[0],
            level: branch.level,
        });
        Self { leaves: plant.organs.iter().filter_map(leaf).collect(), wood: wood.collect() }
    }
}
