//! How a live view looks: what is shown of the plant, on what, in which light, and how carefully.

use super::{LightParams, studio};
use glam::Vec3;

/// What is shown of the plant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// As it looks: materials, light and shadow.
    #[default]
    Shaded,
    /// Every part in a colour of its own that says what it is.
    PartColours,
    /// The edges of the triangles over the part colours, far sides hidden.
    Wireframe,
}

/// How much time a picture may take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// While something moves: rougher shadows, the sky's shadows renewed a few at a time, and with a software driver fewer
    /// pixels.
    Draft,
    /// As good as a finished picture.
    #[default]
    Full,
}

/// What the plant stands on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Background {
    /// The studio's warm paper, with the plant's shadow on it.
    #[default]
    Paper,
    /// A dark sheet for the dark theme, with the plant's shadow on it.
    Dark,
    /// A lawn as far as one sees, under the sky.
    Outdoors,
    /// Nothing at all.
    Transparent,
}

impl Background {
    /// Linear colours in the middle and in the corners; of the sky those overhead and at the horizon.
    pub(super) fn colours(self) -> (Vec3, Vec3) {
        match self {
            Background::Paper | Background::Transparent => (studio::PAPER_CENTRE, studio::PAPER_EDGE),
            Background::Dark => (studio::DARK_CENTRE, studio::DARK_EDGE),
            Background::Outdoors => (studio::OVERHEAD, studio::HORIZON),
        }
    }
}

/// How a live view looks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Look {
    /// What is shown of the plant.
    pub mode: Mode,
    /// How much time a picture may take.
    pub quality: Quality,
    /// What the plant stands on.
    pub background: Background,
    /// The light on it.
    pub light: LightParams,
}
