//! What a plant is made from, and what every maker gives.
//!
//! A maker takes one kind of [`Source`] and fills a [`Produced`]; from there on all plants go the same way
//! ([`super::finish`]). To add a maker: a variant of [`Source`], a file beside this one with its `produce`, and its line in
//! [`super::build_with`].

use crate::anatomy::Anatomy;
use crate::growth::habit::Resource;
use crate::growth::{Envelope, Field, Limits, Obstacles, Outcome, Simulation};
use crate::modelling::DrawnWood;
use crate::plant::{Branch, FlowerBuds, Plant, Provenance};
use crate::sketch::{PartPose, Sketch, Warning};
use std::sync::Arc;

/// What a plant is made from.
#[derive(Clone, Copy, Debug)]
pub enum Source<'a> {
    /// A drawing, whose wood may grow on.
    Drawing(&'a Sketch),
    /// A seed of a species that says how it grows.
    Seed(&'a Seed),
    /// One flower of a species that has full ones, on its stem.
    Bloom(&'a Bloom),
}

impl<'a> From<&'a Sketch> for Source<'a> {
    fn from(sketch: &'a Sketch) -> Self {
        Self::Drawing(sketch)
    }
}

impl<'a> From<&'a Seed> for Source<'a> {
    fn from(seed: &'a Seed) -> Self {
        Self::Seed(seed)
    }
}

impl<'a> From<&'a Bloom> for Source<'a> {
    fn from(bloom: &'a Bloom) -> Self {
        Self::Bloom(bloom)
    }
}

/// A flower without a drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bloom {
    /// Decides everything that is left to chance.
    pub number: u64,
}

/// A plant without a drawing.
#[derive(Clone, Debug, Default)]
pub struct Seed {
    /// Decides everything that is left to chance.
    pub number: u64,
    /// Age to show, years, at least 0; none for the species' own, or in a volume for when it is full.
    pub age: Option<f32>,
    /// The volume that it fills; none for the species' own crown, or for the open.
    pub volume: Option<Arc<Envelope>>,
    /// What stands beside it.
    pub obstacles: Option<Arc<Obstacles>>,
    /// Wood that it begins with in a volume, parents before children; without any a trunk rises to the volume.
    pub wood: Vec<Branch>,
    /// Where growth ends whatever is asked for.
    pub limits: Limits,
}

/// What a maker gives: a plant that has no looks yet.
#[derive(Clone, Debug)]
pub struct Produced {
    /// The plant in space.
    pub plant: Plant,
    /// The flower buds on it, which its species may open.
    pub buds: FlowerBuds,
    /// What only its drawing knows of it.
    pub provenance: Provenance,
    /// What was odd about its source, and what the plant lacks.
    pub remarks: Vec<Warning>,
    /// What the strokes of its source mean; empty where it has none.
    pub anatomy: Anatomy,
    /// How old it is, where it grew.
    pub growth: Option<Ages>,
    /// What stands beside it.
    pub obstacles: Option<Arc<Obstacles>>,
    /// Its drawn wood, as it was modelled.
    pub wood: DrawnWood,
    /// Poses of its drawing that are of no branch.
    pub poses: Vec<PartPose>,
    /// What of its species it is old enough for.
    pub may_bear: MayBear,
}

/// What a plant is old enough for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MayBear {
    /// Flowers.
    pub flowers: bool,
    /// Fruits.
    pub fruits: bool,
}

impl MayBear {
    /// Of a plant whose age is not known, as one that was drawn.
    pub const ALL: Self = Self { flowers: true, fruits: true };
}

impl Default for Produced {
    /// No plant, which may bear anything.
    fn default() -> Self {
        Self {
            plant: Plant::default(),
            buds: FlowerBuds::default(),
            provenance: Provenance::default(),
            remarks: Vec::new(),
            anatomy: Anatomy::default(),
            growth: None,
            obstacles: None,
            wood: DrawnWood::default(),
            poses: Vec::new(),
            may_bear: MayBear::ALL,
        }
    }
}

impl Produced {
    /// Whether there is no plant.
    pub(super) fn is_bare(&self) -> bool {
        self.plant.branches.is_empty() && self.plant.organs.is_empty()
    }
}

/// The ages of a plant that grew.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ages {
    /// Age that is shown, years.
    pub shown: f32,
    /// Oldest age that is known of it, years.
    pub oldest: f32,
    /// What its buds compete for.
    pub resource: Resource,
    /// Why it is no older; [`Outcome::Growing`] at the age that was asked for.
    pub outcome: Outcome,
}

impl Ages {
    /// Those of a plant that is shown at an age.
    pub(super) fn new(simulation: &Simulation, shown: f32, outcome: Outcome) -> Self {
        let resource = match simulation.field() {
            Field::Light(_) => Resource::Light,
            Field::Space(_) => Resource::Space,
        };
        Self { shown, oldest: f32::from(simulation.age()), resource, outcome }
    }
}
