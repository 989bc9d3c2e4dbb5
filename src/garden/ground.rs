//! How high the ground of a garden is: level, or as a grey picture or a mesh says.

use super::grey_map::GreyMap;
use glam::{Vec2, Vec3};

/// The ground.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ground {
    relief: Option<Relief>,
}

/// Heights over a rectangle.
#[derive(Clone, Debug, PartialEq)]
struct Relief {
    map: GreyMap,
    /// Heights of black and of white, metres.
    range: [f32; 2],
    low: Vec2,
    high: Vec2,
}

impl Ground {
    /// Ground whose heights a picture over this box says, those of black and of white in metres.
    pub fn of_map(map: GreyMap, range: [f32; 2], (low, high): (Vec2, Vec2)) -> Self {
        Self { relief: Some(Relief { map, range, low, high }) }
    }

    /// Whether it is level.
    pub fn is_level(&self) -> bool {
        self.relief.is_none()
    }

    /// Height at a place of the plan, metres.
    pub fn height(&self, p: Vec2) -> f32 {
        self.relief.as_ref().map_or(0.0, |Relief { map, range: [black, white], low, high }| {
            black + (white - black) * map.at((p - low) / (high - low))
        })
    }

    /// The point above a place of the plan.
    pub fn point(&self, p: Vec2) -> Vec3 {
        Vec3::new(p.x, self.height(p), p.y)
    }

    /// The direction that stands upright on it, over a distance in metres: smaller bumps do not count.
    pub fn normal(&self, p: Vec2, over: f32) -> Vec3 {
        if self.is_level() {
            return Vec3::Y;
        }
        let slope = |step: Vec2| (self.height(p + step) - self.height(p - step)) / (2.0 * over);
        let (x, z) = (slope(Vec2::new(over, 0.0)), slope(Vec2::new(0.0, over)));
        Vec3::new(-x, 1.0, -z).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::decode::Rgba;

    #[test]
    fn a_ramp_rises_as_its_range_says() {
        let pixels = [0, 255].iter().flat_map(|&grey| [grey, grey, grey, 255]).collect();
        let map = GreyMap::of(&Rgba { width: 2, height: 1, pixels }).unwrap();
        let ground = Ground::of_map(map, [1.0, 3.0], (Vec2::ZERO, Vec2::new(8.0, 4.0)));
        assert_eq!([1.0, 4.0, 7.0].map(|x| ground.height(Vec2::new(x, 2.0))), [1.0, 2.0, 3.0]);
        // Two metres over the four between the middles of its pixels.
        let normal = ground.normal(Vec2::new(4.0, 2.0), 0.5);
        assert!((normal - Vec3::new(-0.5, 1.0, 0.0).normalize()).length() < 1e-5, "{normal}");
        assert_eq!(Ground::default().normal(Vec2::ZERO, 1.0), Vec3::Y);
    }
}
