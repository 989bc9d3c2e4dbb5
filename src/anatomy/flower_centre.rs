//! The centre of a flower, drawn as a circle.
//!
//! A petal reaches away from the point where petals meet; the flower's centre is a round shape around that point. So a blade
//! is a flower's centre when it is nearly a circle and its centre of area lies near that point. Limits: one drawn as a filled
//! scribble is one long stroke and may be taken for a branch.

use super::FlatBlade;
use crate::geom::simple_loop;
use glam::Vec2;

/// Farthest distance between the circle's centre of area and the point where petals meet, as a share of the circle's extent. A
/// petal that starts there has about half.
const OFF_CENTER: f32 = 0.3;

/// Least share of the circle over its extent that it fills.
const ROUND: f32 = 0.6;

/// How near a blade's outline is to a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roundness {
    /// Its centre of area.
    middle: Vec2,
    /// The largest circle around that, across.
    extent: f32,
    /// Radius of the circle with its area, pixels.
    radius: f32,
}

impl Roundness {
    /// That of a blade.
    pub fn of(blade: &FlatBlade) -> Self {
        let middle = centroid(blade);
        let extent = 2.0 * blade.outline.iter().map(|s| s.position.distance(middle)).fold(0.0, f32::max);
        Self { middle, extent, radius: radius(blade) }
    }

    /// Whether the blade is a circle around `center` instead of reaching away from it.
    pub fn is_centre(&self, center: Vec2) -> bool {
        let around_center = self.middle.distance(center) < OFF_CENTER * self.extent;
        around_center && self.radius.powi(2) > ROUND * (0.5 * self.extent).powi(2)
    }

    /// Radius of the circle with the blade's area, pixels.
    pub fn radius(&self) -> f32 {
        self.radius
    }
}

fn radius(blade: &FlatBlade) -> f32 {
    (simple_loop::signed_area(blade.outline.iter().map(|s| s.position)).abs() / std::f32::consts::PI).sqrt()
}

/// Centre of area of the outline; the root where it has none.
fn centroid(blade: &FlatBlade) -> Vec2 {
    let outline = &blade.outline;
    let next = outline.iter().cycle().skip(1);
    let (sum, area) = outline.iter().zip(next).fold((Vec2::ZERO, 0.0), |(sum, area), (a, b)| {
        let (a, b) = (a.position - blade.root, b.position - blade.root);
        let twice = a.perp_dot(b);
        (sum + (a + b) * twice, area + twice)
    });
    if area == 0.0 { blade.root } else { blade.root + sum / (3.0 * area) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::Sample;

    fn ellipse(center: Vec2, radii: Vec2) -> FlatBlade {
        let around = (0..40).map(|k| center + Vec2::from_angle(k as f32 * 0.157) * radii);
        let outline: std::sync::Arc<[Sample]> = around.map(Sample::neutral).collect();
        let root = outline[0].position;
        FlatBlade {
            stroke: Some(1),
            outline,
            root,
            tip: 2.0 * center - root,
            copy_of: None,
            attachment: None,
        }
    }

    #[test]
    fn a_circle_around_the_centre_is_a_centre() {
        let circle = ellipse(Vec2::new(3.0, -2.0), Vec2::splat(20.0));
        assert!(Roundness::of(&circle).is_centre(Vec2::ZERO));
        assert!((Roundness::of(&circle).radius() - 20.0).abs() < 0.2);
    }

    #[test]
    fn a_petal_that_starts_at_the_centre_is_none() {
        let petal = ellipse(Vec2::new(-50.0, 0.0), Vec2::new(50.0, 20.0));
        assert!(!Roundness::of(&petal).is_centre(Vec2::ZERO));
    }
}
