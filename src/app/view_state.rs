//! How the plant and the picture under the drawing are shown.

use crate::growth::overlay::Wanted;
use serde::{Deserialize, Serialize};

/// The reference picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceState {
    /// 0 to 1.
    pub opacity: f32,
    /// Whether it stays where it is.
    pub locked: bool,
}

/// How the plant is shown.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ViewState {
    /// The sun.
    pub light: LightChoice,
    /// Finished, as a mesh, or by parts.
    pub shading: Shading,
    /// Without perspective.
    pub orthographic: bool,
    /// On a lawn under the sky, instead of paper.
    pub outdoors: bool,
    /// Turning by itself; a new session begins at rest.
    #[serde(skip)]
    pub turntable: bool,
    /// Seen by somebody who walks on the ground; a new session begins around the plant.
    #[serde(skip)]
    pub walking: bool,
    /// What is seen of growth; a new session begins with nothing.
    #[serde(skip)]
    pub overlay: Wanted,
}

impl Default for ViewState {
    fn default() -> Self {
        let (light, shading) = (LightChoice::default(), Shading::default());
        Self {
            light,
            shading,
            orthographic: true,
            outdoors: false,
            turntable: false,
            walking: false,
            overlay: Wanted::default(),
        }
    }
}

impl ViewState {
    /// Whether the plant is seen outdoors: who walks always sees it so.
    pub fn is_outdoors(&self) -> bool {
        self.outdoors || self.walking
    }

    /// The same with numbers that a light can have.
    pub fn sane(self) -> Self {
        Self { light: self.light.sane(), ..self }
    }
}

/// A step of a walk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stride {
    /// Ahead, or back.
    Ahead(bool),
    /// To the right, or to the left.
    Aside(bool),
    /// Turns to the right, or to the left.
    Turn(bool),
    /// Raises the eye, or lowers it.
    Rise(bool),
}

/// The sun.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct LightChoice {
    /// Direction it comes from, seen from above: degrees, 0 from the viewer, positive to the right, −180 to 180.
    pub azimuth_deg: f32,
    /// Height above the horizon in degrees, 5 to 90.
    pub elevation_deg: f32,
    /// Strength, 1 as designed, 0 to 2.
    pub strength: f32,
    /// Colour, as the temperature of a black body in kelvin; 5500 as designed, 2000 to 12000.
    pub temperature_k: f32,
}

impl Default for LightChoice {
    fn default() -> Self {
        Self { azimuth_deg: -48.0, elevation_deg: 45.0, strength: 1.0, temperature_k: 5500.0 }
    }
}

impl LightChoice {
    /// The same with every number in its range.
    fn sane(self) -> Self {
        let start = Self::default();
        let within = |x: f32, start: f32, (min, max): (f32, f32)| {
            if x.is_finite() { x.clamp(min, max) } else { start }
        };
        Self {
            azimuth_deg: within(self.azimuth_deg, start.azimuth_deg, Self::AZIMUTHS_DEG),
            elevation_deg: within(self.elevation_deg, start.elevation_deg, Self::ELEVATIONS_DEG),
            strength: within(self.strength, start.strength, Self::STRENGTHS),
            temperature_k: within(self.temperature_k, start.temperature_k, (2000.0, 12000.0)),
        }
    }

    /// Least and largest direction.
    pub const AZIMUTHS_DEG: (f32, f32) = (-180.0, 180.0);
    /// Least and largest height.
    pub const ELEVATIONS_DEG: (f32, f32) = (5.0, 90.0);
    /// Least and largest strength.
    pub const STRENGTHS: (f32, f32) = (0.0, 2.0);
}

/// What the plant is shown as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shading {
    /// With materials and light.
    #[default]
    Shaded,
    /// Triangles.
    Wireframe,
    /// Every part in its colour.
    Parts,
}
