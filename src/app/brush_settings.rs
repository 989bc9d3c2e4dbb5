//! How the brushes of the view of the plant are set, as the artist chooses it.

use crate::sketch::Brush;

/// Size, density and guide of brushes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrushSettings {
    /// Radius at neutral pressure, as a share of the sheet's height.
    pub size: f32,
    /// How densely wood grows, 1 as ever.
    pub density: f32,
    /// How strongly shoots follow the stroke; below 0 they run against it.
    pub guide: f32,
}

impl BrushSettings {
    /// Smallest and largest radius, shares of the sheet's height.
    pub const SIZES: (f32, f32) = (0.003, 0.4);
}

impl Default for BrushSettings {
    fn default() -> Self {
        let Brush { density, guide, .. } = Brush::default();
        Self { size: 0.06, density, guide }
    }
}
