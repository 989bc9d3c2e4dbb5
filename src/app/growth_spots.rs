//! How markers, buds and light of a growing plant are drawn over it in the plant view: their colours.
//!
//! Markers and buds are blue against orange, which everybody tells apart; light runs from dim to bright.

use crate::growth::overlay::{Kind, Spot};
use crate::render;

/// Encoded red, green, blue and opacity.
const FREE: [u8; 4] = [70, 150, 235, 255];
const TAKEN: [u8; 4] = [232, 132, 40, 255];
const ACTIVE: [u8; 4] = [240, 60, 160, 255];
const DORMANT: [u8; 4] = [172, 140, 204, 255];
/// Red, green and blue of light at evenly spaced shares of full light, from none to all.
const LIGHT: [[f32; 3]; 4] =
    [[24.0, 12.0, 110.0], [140.0, 30.0, 150.0], [236.0, 110.0, 70.0], [255.0, 226.0, 60.0]];

/// The spots as they are drawn: a bud with a line to where its shoot is headed.
pub fn drawn(spots: &[Spot]) -> Vec<render::Spot> {
    let one = |&Spot { at, radius, kind }: &Spot| {
        let (line, colour) = match kind {
            Kind::Free => (None, FREE),
            Kind::Taken => (None, TAKEN),
            Kind::Active { way } => (Some(way), ACTIVE),
            Kind::Dormant { way } => (Some(way), DORMANT),
            Kind::Light { exposure } => (None, of_light(exposure)),
        };
        render::Spot { at, radius, line, colour }
    };
    spots.iter().map(one).collect()
}

fn of_light(exposure: f32) -> [u8; 4] {
    let place = exposure.clamp(0.0, 1.0) * (LIGHT.len() - 1) as f32;
    let below = (place as usize).min(LIGHT.len() - 2);
    let at = |k: usize| {
        let (from, to) = (LIGHT[below][k], LIGHT[below + 1][k]);
        (from + (to - from) * (place - below as f32)) as u8
    };
    [at(0), at(1), at(2), 255]
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn a_bud_has_a_line_and_light_is_brighter_than_shade() {
        let spot = |kind| Spot { at: Vec3::X, radius: 0.1, kind };
        let lines = drawn(&[spot(Kind::Free), spot(Kind::Active { way: Vec3::Y })]);
        assert_eq!(lines.iter().map(|one| one.line).collect::<Vec<_>>(), [None, Some(Vec3::Y)]);
        let sum = |exposure| of_light(exposure)[..3].iter().map(|c| u32::from(*c)).sum::<u32>();
        assert!(sum(0.0) < sum(0.5) && sum(0.5) < sum(1.0));
    }
}
