//! What the panels show of the plant's levels of detail.

use crate::pipeline::LevelSet;

/// The plant's levels of detail.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LevelsState {
    /// Which levels are shown; none where the plant is shown as it is.
    pub set: Option<LevelSet>,
    /// Each of them, the finest first; empty until they are made.
    pub levels: Vec<LevelState>,
    /// The one on the screen.
    pub shown: usize,
    /// Whether it stays at any distance.
    pub is_held: bool,
    /// How far away the plant is, metres, and how near and far it can be; none without a plant.
    pub distance: Option<(f32, (f32, f32))>,
}

/// A level of detail.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelState {
    /// Its triangles, copies counted.
    pub triangles: usize,
    /// Up to how many metres from the eye it is shown.
    pub up_to: f32,
}
