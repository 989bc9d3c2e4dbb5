//! Changes of a drawing: what tools and panels hand to the document as one undoable step.

use super::{Stroke, StrokeId};
use std::sync::Arc;

/// What happens to one stroke.
#[derive(Clone, Debug, PartialEq)]
pub enum StrokeChange {
    /// The stroke takes the place of the one with its id; a new one lies on top.
    Put(Arc<Stroke>),
    /// The stroke goes.
    Remove(StrokeId),
}
