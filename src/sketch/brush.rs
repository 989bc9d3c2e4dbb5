//! Brushes of the view of the plant: what a stroke with one says beside its samples.
//!
//! A brush stroke is the way of a ball through the space of the plant. Its radius follows the pen's pressure: a quarter of
//! [`Brush::radius`] without any, all of it at the pressure of a device that has none, twice it with all of the pen's pressure (001 §4.4
//! leaves the ranges open).

use super::{StrokePoint, Tool, limits};
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// The ball that a brush moves, and what it asks of growth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Brush {
    /// Radius at neutral pressure, canvas pixels.
    pub radius: f32,
    /// How densely wood grows in it, [`DENSITIES`]; 1 is as the species grows in a crown of that size.
    pub density: f32,
    /// How strongly shoots follow the stroke, [`GUIDES`]; below 0 they run against it.
    pub guide: f32,
}

/// Densities that a brush may have.
pub const DENSITIES: RangeInclusive<f32> = 0.04..=5.0;
/// Guides that a brush may have.
pub const GUIDES: RangeInclusive<f32> = -3.0..=3.0;
/// Shares of its radius that a brush has without pressure, and with all of it.
const PRESSED: (f32, f32) = (0.25, 2.0);

impl Default for Brush {
    fn default() -> Self {
        Self { radius: 40.0, density: 1.0, guide: 0.8 }
    }
}

impl Brush {
    /// The radius at a pressure from 0 to 1, canvas pixels.
    pub fn radius_at(&self, pressure: f32) -> f32 {
        let neutral = StrokePoint::NEUTRAL_PRESSURE;
        let share = if pressure <= neutral {
            PRESSED.0 + (1.0 - PRESSED.0) * pressure / neutral
        } else {
            1.0 + (PRESSED.1 - 1.0) * (pressure - neutral) / (1.0 - neutral)
        };
        self.radius * share
    }

    /// What is wrong with it, in words.
    fn check(&self) -> Result<(), String> {
        // Written so that what is no number fails, too.
        if !(self.radius > 0.0 && self.radius <= limits::MAX_COORDINATE) {
            let most = limits::MAX_COORDINATE;
            return Err(format!(
                "the brush's `radius` is {}; it lies above 0 and up to {most:e}",
                self.radius
            ));
        }
        for (name, value, range) in [("density", self.density, DENSITIES), ("guide", self.guide, GUIDES)] {
            if !range.contains(&value) {
                let (from, to) = range.into_inner();
                return Err(format!("the brush's `{name}` is {value}; it lies between {from} and {to}"));
            }
        }
        Ok(())
    }
}

/// Checks that strokes of brushes have a brush, and no others.
///
/// # Errors
/// What is wrong, in words.
pub(super) fn check(tool: Tool, brush: Option<&Brush>) -> Result<(), String> {
    match (tool.is_brush(), brush) {
        (true, Some(brush)) => brush.check(),
        (true, None) => Err(format!("a stroke of the tool `{}` needs a `brush`", tool.name())),
        (false, Some(_)) => {
            Err(format!("a stroke of the tool `{}` has no `brush`; leave it out", tool.name()))
        }
        (false, None) => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pressure_widens_it_from_a_quarter_to_twice() {
        let brush = Brush { radius: 8.0, ..Brush::default() };
        assert_eq!([0.0, 0.25, 0.5, 0.75, 1.0].map(|p| brush.radius_at(p)), [2.0, 5.0, 8.0, 12.0, 16.0]);
    }

    #[test]
    fn what_cannot_be_is_named() {
        let check = |brush: Brush| check(Tool::GrowthBrush, Some(&brush));
        let good = Brush::default();
        assert_eq!(check(good), Ok(()));
        for radius in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!(check(Brush { radius, ..good }).unwrap_err().contains("`radius`"));
        }
        assert!(check(Brush { density: 9.0, ..good }).unwrap_err().contains("`density`"));
        assert!(check(Brush { guide: f32::NAN, ..good }).unwrap_err().contains("`guide`"));
        assert!(super::check(Tool::PruningBrush, None).unwrap_err().contains("needs"));
        assert!(super::check(Tool::Leaf, Some(&good)).unwrap_err().contains("leave it out"));
        assert_eq!(super::check(Tool::Leaf, None), Ok(()));
    }
}
