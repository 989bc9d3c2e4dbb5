//! How much light of an open sky falls on a plant's surfaces, in the plant's own shade.
//!
//! A picture of a whole plant is lit as one upright surface. What its leaves and petals have more of it, because they face the sky, or
//! less, because others are above them, is in the picture: a share of the light that the upright surface has. The sky is a few directions,
//! evenly over its height; from each the plant is drawn as depths, and what lies behind these is in the shade.
//!
//! The sun may be in any of the higher directions behind the viewer.
//!
//! Limits: light through leaves is the same share for all; which side of the plant the sun shines on is left to the card.

use super::raster::covered;
use super::surfaces::{Corner, Triangle};
use crate::geom::hemisphere::direction;
use glam::{Mat3, USizeVec2, Vec2, Vec3};

/// Directions of the sky.
const DIRECTIONS: usize = 16;
/// Width and height of the depths, pixels.
const SIZE: usize = 192;
/// Depths that differ by less than this share of the plant's size are of one surface.
const NEAR: f32 = 0.008;
/// Light of the sky on level ground, of a sun that stands somewhere behind the viewer and higher than so (its sine), and from all sides.
const SKY: f32 = 0.6;
const SUN: f32 = 1.1;
const LOWEST_SUN: f32 = 0.5;
const EVERYWHERE: f32 = 0.1;
/// Light that arrives on the other side, share of it that is seen through a surface.
const THROUGH: f32 = 0.35;
/// Shares of the light at most, so that no colour is lost.
const MOST: f32 = 2.5;

/// The light of the sky on a plant.
pub(super) struct Sky {
    directions: Vec<Depths>,
}

/// A plant as depths from one direction.
struct Depths {
    /// Rows are right, up and toward the sky.
    sky_from_world: Mat3,
    low: Vec2,
    /// Pixels of a metre.
    scale: f32,
    near: f32,
    /// The greatest along the direction, by pixel.
    depths: Vec<f32>,
}

impl Sky {
    /// The light on some triangles.
    pub(super) fn over(triangles: &[Triangle<'_>]) -> Self {
        Self {
            directions: (0..DIRECTIONS).map(|i| Depths::from(direction(i, DIRECTIONS), triangles)).collect(),
        }
    }

    /// How much light a surface has, as a share of what an upright one has before which nothing stands. `normal` is that of the side that
    /// is seen, `facing` that of the upright surface.
    pub(super) fn light(&self, at: Vec3, normal: Vec3, facing: Vec3) -> f32 {
        let arriving = |normal: Vec3, toward: Vec3| {
            let cosine = normal.dot(toward);
            if cosine > 0.0 { cosine } else { -THROUGH * cosine }
        };
        let (mut sky, mut open_sky, mut sun, mut open_sun) = (0.0, 0.0, 0.0, 0.0);
        let (mut level, mut suns) = (0.0, f32::MIN_POSITIVE);
        for direction in &self.directions {
            let toward = direction.sky_from_world.row(2);
            let sees = f32::from(u8::from(direction.sees(at)));
            let may_be_sun = toward.y > LOWEST_SUN && facing.dot(toward) > 0.0;
            sky += sees * arriving(normal, toward);
            open_sky += arriving(facing, toward);
            if may_be_sun {
                sun += sees * arriving(normal, toward);
                open_sun += arriving(facing, toward);
                suns += 1.0;
            }
            level += toward.y;
        }
        let light = |sky: f32, sun: f32| SKY * sky / level + SUN * sun / suns + EVERYWHERE;
        (light(sky, sun) / light(open_sky, open_sun)).min(MOST)
    }
}

impl Depths {
    fn from(toward: Vec3, triangles: &[Triangle<'_>]) -> Self {
        let (right, up) = toward.any_orthonormal_pair();
        let sky_from_world = Mat3::from_cols(right, up, toward).transpose();
        let corners = triangles.iter().flat_map(|triangle| &triangle.corners);
        let seen = corners.map(|corner| sky_from_world * corner.at);
        let (low, high) =
            seen.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let extent = (high - low).max_element().max(f32::MIN_POSITIVE);
        let mut depths = Self {
            sky_from_world,
            low: low.truncate(),
            scale: (SIZE - 1) as f32 / extent,
            near: NEAR * extent,
            depths: vec![f32::NEG_INFINITY; SIZE * SIZE],
        };
        triangles.iter().for_each(|triangle| depths.draw(triangle));
        depths
    }

    fn draw(&mut self, triangle: &Triangle<'_>) {
        let places = triangle.corners.each_ref().map(|corner| self.place(corner.at));
        let along = Vec3::from(places.map(|place| place.z));
        let [a, b, c] = triangle.corners.each_ref().map(|Corner { uv, .. }| *uv);
        covered(places.map(Vec3::truncate), USizeVec2::splat(SIZE), |pixel, shares| {
            let depth = along.dot(shares);
            let is_there = || triangle.surface.colour(a * shares.x + b * shares.y + c * shares.z).is_some();
            if depth > self.depths[pixel] && is_there() {
                self.depths[pixel] = depth;
            }
        });
    }

    /// Pixels, and metres toward the sky.
    fn place(&self, at: Vec3) -> Vec3 {
        let seen = self.sky_from_world * at;
        ((seen.truncate() - self.low) * self.scale).extend(seen.z)
    }

    /// Whether nothing is between a place and the sky.
    fn sees(&self, at: Vec3) -> bool {
        let place = self.place(at);
        let pixel = place.truncate().clamp(Vec2::ZERO, Vec2::splat((SIZE - 1) as f32)).as_usizevec2();
        self.depths[pixel.y * SIZE + pixel.x] <= place.z + self.near
    }
}
