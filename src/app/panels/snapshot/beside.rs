//! The plants beside the drawn one, as the panel lists them.

use crate::sketch::PlacedPlant;

/// The plants beside the drawn one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BesideState {
    /// All of them, in the order of the drawing.
    pub plants: Vec<PlantState>,
    /// The selected one, by its place.
    pub selected: Option<usize>,
    /// The sheet in canvas pixels.
    pub sheet: [f32; 2],
}

/// The age of a plant as its slider shows it, years.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AgeState {
    /// The age.
    pub years: f32,
    /// The one that plants of its species have where nobody says otherwise.
    pub own: f32,
    /// The oldest on the slider.
    pub most: f32,
}

/// A plant beside the drawn one.
#[derive(Clone, Debug, PartialEq)]
pub struct PlantState {
    /// What the drawing says of it.
    pub plant: PlacedPlant,
    /// The age at which it is shown, years.
    pub age: f32,
    /// Oldest age on its slider, years.
    pub most_age: f32,
    /// Its height in canvas pixels, once it is known.
    pub height: Option<f32>,
}
