//! The garden around the plant, as the card over the view shows it.

use super::AgeState;
use crate::app::garden_brush::GardenBrush;
use crate::sketch::GardenDrawing;

/// How the garden is being painted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GardenState {
    /// Whether the view has a ground: something was built, be it nothing.
    pub any: bool,
    /// Whether the tool is in hand.
    pub on: bool,
    /// How its brush is set.
    pub brush: GardenBrush,
    /// Radius that its brush has where the artist says nothing, metres.
    pub usual_radius: f32,
    /// The age of what the brush plants; none of what has none.
    pub age: Option<AgeState>,
    /// The drawings that are planted, and the one that the brush has.
    pub drawings: Vec<GardenDrawing>,
    /// Plants that stand in the garden; none where there is no garden.
    pub plants: Option<usize>,
}
