//! Changes of a drawing: what tools and panels hand to the document as one undoable step.

use super::{Canvas, Reference, Stroke, StrokeId, Textures};
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
    /// The new sheet.
    pub canvas: Option<Canvas>,
    /// The new species; `Some(None)` leaves the choice to the program.
    pub species: Option<Option<String>>,
    /// The new seed.
    pub seed: Option<u64>,
    /// All parameters that are not at their defaults.
    pub params: Option<Map<String, Value>>,
    /// All textures that the artist chose.
    pub textures: Option<Textures>,
    /// The new picture under the drawing, or how it lies now; `Some(None)` takes it away.
    pub reference: Option<Option<Arc<Reference>>>,
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
        Self { species: Some(species), ..Self::default() }
    }

    /// Another seed.
    pub fn seed(seed: u64) -> Self {
        Self { seed: Some(seed), ..Self::default() }
    }

    /// Other parameters, all of them.
    pub fn params(params: Map<String, Value>) -> Self {
        Self { params: Some(params), ..Self::default() }
    }

    /// Other textures, all of them.
    pub fn textures(textures: Textures) -> Self {
        Self { textures: Some(textures), ..Self::default() }
    }

    /// Another picture under the drawing, or the same lying otherwise, or none.
    pub fn reference(reference: Option<Reference>) -> Self {
        Self { reference: Some(reference.map(Arc::new)), ..Self::default() }
    }
}
