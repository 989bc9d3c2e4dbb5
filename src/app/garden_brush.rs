//! The brush that paints a garden on the ground, as the artist sets it.

use crate::sketch::{GardenPlant, GardenTool};

/// What the brush paints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GardenBrushKind {
    /// Plants.
    #[default]
    Plants,
    /// A path.
    Path,
    /// Nothing: it clears.
    Clear,
    /// Nothing: it takes away whole strokes.
    Erase,
}

/// How it is set.
#[derive(Clone, Debug, PartialEq)]
pub struct GardenBrush {
    /// What it paints.
    pub kind: GardenBrushKind,
    /// What it plants.
    pub plant: GardenPlant,
    /// How far it reaches to either side, metres.
    pub radius: f32,
    /// How densely plants stand where the pen is pressed as usual.
    pub density: f32,
}

impl GardenBrush {
    /// Smallest and largest radius on the slider, metres.
    pub const RADII: (f32, f32) = (0.05, 10.0);

    /// What a stroke with it does; none where it draws none.
    pub fn tool(&self) -> Option<GardenTool> {
        let tool = match self.kind {
            GardenBrushKind::Plants => GardenTool::Plants(self.plant.clone()),
            GardenBrushKind::Path => GardenTool::Path,
            GardenBrushKind::Clear => GardenTool::Clear,
            GardenBrushKind::Erase => return None,
        };
        Some(tool)
    }
}

impl Default for GardenBrush {
    fn default() -> Self {
        Self { kind: GardenBrushKind::Plants, plant: GardenPlant::Drawn, radius: 0.4, density: 1.0 }
    }
}
