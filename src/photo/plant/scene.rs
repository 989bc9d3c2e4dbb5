//! Photographs for tests: trees, painted leaf by leaf before sky and ground, and which of their pixels are plant.

use super::super::raster::Raster;
use crate::picture::decode::Rgba;
use glam::{UVec2, Vec2, Vec3};

/// A stream of numbers from 0 to 1.
pub(super) struct Dice(pub(super) u64);

impl Dice {
    pub(super) fn roll(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }
}

/// A photograph that is painted.
pub(super) struct Scene {
    pub(super) light: Raster<Vec3>,
    pub(super) truth: Raster<bool>,
    dice: Dice,
}

/// Foliage that is light and dark green, and that of autumn.
pub(super) const GREEN: Vec3 = Vec3::new(70.0, 110.0, 45.0);
pub(super) const RED: Vec3 = Vec3::new(165.0, 70.0, 35.0);
const WOOD: Vec3 = Vec3::new(85.0, 65.0, 50.0);

impl Scene {
    /// Sky with clouds above, a meadow or a field below.
    pub(super) fn new(size: UVec2, seed: u64, meadow: bool) -> Self {
        let horizon = 0.8 * size.y as f32;
        let ground = if meadow { Vec3::new(105.0, 135.0, 70.0) } else { Vec3::new(150.0, 125.0, 95.0) };
        let mut light = Raster::filled(size, Vec3::ZERO);
        for i in 0..light.cells().len() {
            let at = light.middle(i);
            let cloud = (0.5 + 0.5 * (at.x / 70.0 + (at.y / 40.0).sin()).sin() * (at.y / 55.0).cos()).powi(3);
            let sky = Vec3::new(120.0, 165.0, 220.0).lerp(Vec3::new(215.0, 225.0, 235.0), at.y / horizon);
            let sky = sky.lerp(Vec3::splat(245.0), 0.7 * cloud);
            light.cells_mut()[i] =
                if at.y < horizon { sky } else { ground * (0.85 + 0.15 * (at.x / 9.0).sin()) };
        }
        Self { light, truth: Raster::filled(size, false), dice: Dice(seed) }
    }

    fn dab(&mut self, at: Vec2, radius: f32, colour: Vec3) {
        let size = self.light.size().as_vec2();
        let low = (at - radius).clamp(Vec2::ZERO, size).as_uvec2();
        let high = (at + radius).ceil().clamp(Vec2::ZERO, size).as_uvec2();
        for y in low.y..high.y {
            for x in low.x..high.x {
                if (Vec2::new(x as f32, y as f32) + 0.5).distance(at) <= radius {
                    let pixel = (x as usize, y as usize);
                    (self.light[pixel], self.truth[pixel]) = (colour, true);
                }
            }
        }
    }

    /// A trunk from its foot to a height, and a crown of leaves in an ellipse that keeps out of a hole.
    pub(super) fn tree(
        &mut self,
        foot: Vec2,
        middle: Vec2,
        half: Vec2,
        hole: Option<(Vec2, f32)>,
        colour: Vec3,
    ) {
        let width = 0.07 * half.x;
        for k in 0..400 {
            let share = k as f32 / 399.0;
            let shade = 0.8 + 0.4 * self.dice.roll();
            self.dab(foot.lerp(middle, share), width * (1.4 - 0.8 * share), WOOD * shade);
        }
        for _ in 0..(half.x * half.y * 0.9) as u32 {
            let angle = std::f32::consts::TAU * self.dice.roll();
            let lobes = 1.0 + 0.08 * (5.0 * angle).sin();
            let off = Vec2::from_angle(angle) * half * (self.dice.roll().sqrt() * lobes);
            let at = middle + off;
            if hole.is_some_and(|(place, radius)| at.distance(place) < radius) {
                continue;
            }
            let lit = 0.75 - 0.35 * (off.x + off.y) / (half.x + half.y) + 0.5 * (self.dice.roll() - 0.5);
            let radius = 1.5 + 2.0 * self.dice.roll();
            self.dab(at, radius, colour * lit.clamp(0.35, 1.5));
        }
    }

    /// The photograph with grain.
    pub(super) fn photograph(&mut self, grain: f32) -> Rgba {
        let dice = &mut self.dice;
        let pixel = |light: &Vec3| {
            let noise = grain * (dice.roll() + dice.roll() + dice.roll() - 1.5);
            let [r, g, b] = (*light + noise).to_array().map(|c| c.clamp(0.0, 255.0) as u8);
            [r, g, b, 255]
        };
        let pixels = self.light.cells().iter().flat_map(pixel).collect();
        Rgba { width: self.light.width() as u32, height: self.light.height() as u32, pixels }
    }

    /// Shared pixels of the truth and of what was found, over those of either.
    pub(super) fn agreement(&self, found: impl Fn(u32, u32) -> bool) -> f32 {
        let (mut both, mut either) = (0u32, 0u32);
        for (i, is_in) in self.truth.cells().iter().enumerate() {
            let found = found((i % self.truth.width()) as u32, (i / self.truth.width()) as u32);
            both += u32::from(*is_in && found);
            either += u32::from(*is_in || found);
        }
        both as f32 / either.max(1) as f32
    }
}
