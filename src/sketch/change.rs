//! Changes of a drawing: what tools and panels hand to the document as one undoable step.

use super::settings::Settings;
use super::{
    Corrections, GardenStrokes, PartPoses, PetalShapes, PlacedPlant, Reference, Stroke, StrokeId, Textures,
};
use serde_json::{Map, Value};
use std::sync::Arc;

/// What happens to one stroke.
#[derive(Clone, Debug, PartialEq)]
pub enum StrokeChange {
    /// The stroke takes the place of the one with its id; a new one lies on top.
    Put(Arc<Stroke>),
    /// The stroke goes.
    Remove(StrokeId),
}

/// What one step does to a drawing. What is `None` or empty stays as it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Change {
    /// What happens to strokes, in this order.
    pub strokes: Vec<StrokeChange>,
    /// The new settings.
    pub settings: Settings,
}

impl From<Settings> for Change {
    fn from(settings: Settings) -> Self {
        Self { strokes: Vec::new(), settings }
    }
}

impl Change {
    /// One stroke drawn or replaced.
    pub fn put(stroke: impl Into<Arc<Stroke>>) -> Self {
        Self::strokes(vec![StrokeChange::Put(stroke.into())])
    }

    /// Strokes that go together.
    pub fn remove(ids: impl IntoIterator<Item = StrokeId>) -> Self {
        Self::strokes(ids.into_iter().map(StrokeChange::Remove).collect())
    }

    /// Any changes of strokes.
    pub fn strokes(strokes: Vec<StrokeChange>) -> Self {
        Self { strokes, ..Self::default() }
    }

    /// Another species.
    pub fn species(species: Option<String>) -> Self {
        Settings { species: Some(species), ..Settings::default() }.into()
    }

    /// Another seed.
    pub fn seed(seed: u64) -> Self {
        Settings { seed: Some(seed), ..Settings::default() }.into()
    }

    /// Other parameters, all of them.
    pub fn params(params: Map<String, Value>) -> Self {
        Settings { params: Some(params), ..Settings::default() }.into()
    }

    /// Other textures, all of them.
    pub fn textures(textures: Textures) -> Self {
        Settings { textures: Some(textures), ..Settings::default() }.into()
    }

    /// Other plants beside the drawn one, all of them.
    pub fn plants(plants: Vec<PlacedPlant>) -> Self {
        Settings { plants: Some(plants), ..Settings::default() }.into()
    }

    /// Other corrections of how strokes are read together, all of them.
    pub fn corrections(corrections: Corrections) -> Self {
        Settings { corrections: Some(corrections), ..Settings::default() }.into()
    }

    /// Other shapes of petals, all of them.
    pub fn petal_shapes(petal_shapes: PetalShapes) -> Self {
        Settings { petal_shapes: Some(petal_shapes), ..Settings::default() }.into()
    }

    /// Other poses of branches, all of them.
    pub fn part_poses(part_poses: PartPoses) -> Self {
        Settings { part_poses: Some(part_poses), ..Settings::default() }.into()
    }

    /// Another garden around the plant, all of it.
    pub fn garden(garden: GardenStrokes) -> Self {
        Settings { garden: Some(garden), ..Settings::default() }.into()
    }

    /// Another picture under the drawing, or the same lying otherwise, or none.
    pub fn reference(reference: Option<Reference>) -> Self {
        Settings { reference: Some(reference.map(Arc::new)), ..Settings::default() }.into()
    }
}
