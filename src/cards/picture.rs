//! The picture of a plant's shoots: a column for each, the wide side in the upper row and the narrow one in the lower.
//!
//! Each is drawn by parallel projection, twice as large as it becomes, with a depth for every pixel, and each pixel of the result is
//! the mean of four: its alpha says how much of it is covered. Colours are those of the materials, a little lighter where a surface
//! faces the light above and in front, and where it lies in front of others; their mean stays. What nothing covers has the mean
//! colour, so that smaller copies of the picture have no dark margins.

use super::clusters::Cluster;
use super::frame::{Frame, Side};
use super::raster::covered;
use super::surfaces::{Corner, Surfaces, Triangle};
use crate::picture::{Picture, decode::Rgba};
use crate::plant::Shape;
use crate::srgb::srgb_from_linear;
use glam::{Vec2, Vec3, Vec4};
use rayon::prelude::*;

/// Pixels that are drawn for one, to each side.
const FINER: usize = 2;
/// Where light comes from, seen on the card, and what the side away from it has of it.
const LIGHT: Vec3 = Vec3::new(0.3, 0.55, 0.78);
const IN_SHADE: f32 = 0.55;
/// What the hindmost has of the light of the foremost.
const BEHIND: f32 = 0.6;

/// How pictures are drawn.
#[derive(Clone, Copy)]
pub(super) struct Drawing {
    /// Width and height of each.
    pub(super) pixels: u32,
    /// How much of a plant each shows, share of its size: the more, the more of the plant's own shade is in the picture.
    pub(super) share: f32,
}

/// The pictures of shoots in one.
pub(super) struct Atlas {
    pub(super) picture: Picture,
    /// The boxes of the shoots that were drawn.
    frames: Vec<Frame>,
}

impl Atlas {
    /// Draws some of the clusters. `None` where nothing of them is seen.
    pub(super) fn draw(
        surfaces: &Surfaces<'_>,
        framed: &[(Cluster, Frame)],
        shown: &[usize],
        drawing: Drawing,
    ) -> Option<Self> {
        let side = drawing.pixels as usize;
        let cells = |shoot: &usize| {
            let (cluster, frame) = &framed[*shoot];
            let triangles = surfaces.triangles(cluster);
            let corners =
                triangles.iter().flat_map(|triangle| triangle.corners.iter().map(|corner| corner.at));
            let frame = frame.around_points(corners).unwrap_or(*frame);
            let seen_from = |of| drawn(&triangles, frame.card(of), side * FINER);
            (frame, Side::ALL.map(|of| coarser(&seen_from(of), drawing)))
        };
        let (frames, cells): (Vec<Frame>, Vec<_>) = shown.par_iter().map(cells).unzip();
        let picture = joined(&cells, side)?.to_png().ok()?;
        Some(Self { picture: Picture::new(picture).ok()?, frames })
    }

    /// The card of a cluster from a side, with the picture of a shoot.
    pub(super) fn card(&self, frame: &Frame, shoot: usize, side: Side) -> Shape {
        let (base, u, v) = frame.of_shape(&self.frames[shoot]).card(side);
        Shape::Card { base, u, v, window: self.window(shoot, side) }
    }

    /// The part of the picture that shows a shoot from a side.
    fn window(&self, shoot: usize, side: Side) -> [Vec2; 2] {
        let column = shoot as f32 / self.frames.len() as f32;
        let low = Vec2::new(column, if side == Side::Wide { 0.5 } else { 0.0 });
        [low, low + Vec2::new(1.0 / self.frames.len() as f32, 0.5)]
    }
}

/// What is seen in a square, `fine` pixels wide, rows from the top.
fn drawn(triangles: &[Triangle<'_>], (base, u, v): (Vec3, Vec3, Vec3), fine: usize) -> Vec<Pixel> {
    let facing = u.cross(v).normalize_or_zero();
    let axes = (u / u.length_squared(), v / v.length_squared());
    let onto = |corner: &Corner| {
        let from_base = corner.at - base;
        let place = Vec2::new(from_base.dot(axes.0) + 0.5, 1.0 - from_base.dot(axes.1));
        (place * fine as f32).extend(from_base.dot(facing))
    };
    let depths = triangles.iter().flat_map(|triangle| triangle.corners.iter().map(|corner| onto(corner).z));
    let (far, near) =
        depths.fold((f32::INFINITY, f32::NEG_INFINITY), |(far, near), z| (far.min(z), near.max(z)));
    let light = LIGHT.x * u.normalize_or_zero() + LIGHT.y * v.normalize_or_zero() + LIGHT.z * facing;
    let lit = |normal: Vec3, depth: f32| {
        let faced = IN_SHADE + (1.0 - IN_SHADE) * normal.dot(light).max(0.0);
        faced * (BEHIND + (1.0 - BEHIND) * (depth - far) / (near - far).max(f32::MIN_POSITIVE))
    };
    let mut pixels = vec![Pixel { depth: f32::NEG_INFINITY, colour: Vec3::ZERO, light: 0.0 }; fine * fine];
    for triangle in triangles {
        let places = triangle.corners.each_ref().map(onto);
        let depths = Vec3::from(places.map(|place| place.z));
        let [a, b, c] = &triangle.corners;
        covered(places.map(Vec3::truncate), fine, |pixel, shares| {
            let depth = depths.dot(shares);
            if depth <= pixels[pixel].depth {
                return;
            }
            let uv = a.uv * shares.x + b.uv * shares.y + c.uv * shares.z;
            let normal = a.normal * shares.x + b.normal * shares.y + c.normal * shares.z;
            if let Some(colour) = triangle.surface.colour(uv) {
                pixels[pixel] = Pixel { depth, colour, light: lit(normal.normalize_or_zero(), depth) };
            }
        });
    }
    pixels
}

/// What is seen at one place; nothing where there is no light.
#[derive(Clone, Copy)]
struct Pixel {
    depth: f32,
    colour: Vec3,
    light: f32,
}

/// Means of squares of pixels in linear light, straight alpha. The light of small pictures is 1 in the mean.
fn coarser(pixels: &[Pixel], Drawing { pixels: side, share }: Drawing) -> Vec<Vec4> {
    let side = side as usize;
    let fine = side * FINER;
    let lights = || pixels.iter().map(|pixel| pixel.light).filter(|light| *light > 0.0);
    let mean_light = lights().sum::<f32>() / lights().count().max(1) as f32;
    let usual = mean_light.powf(1.0 - share.clamp(0.0, 1.0).sqrt());
    let seen = |pixel: &Pixel| match pixel.light > 0.0 {
        // No channel beyond white, so that hues stay.
        true => (pixel.colour * (pixel.light / usual).min(1.0 / pixel.colour.max_element())).extend(1.0),
        false => Vec4::ZERO,
    };
    let mean = |i: usize| {
        let (x, y) = (i % side * FINER, i / side * FINER);
        let of = (0..FINER * FINER).map(|k| &pixels[(y + k / FINER) * fine + x + k % FINER]);
        let sum: Vec4 = of.map(seen).sum();
        let alpha = sum.w / (FINER * FINER) as f32;
        (sum.truncate() / sum.w.max(1.0)).extend(alpha)
    };
    (0..side * side).map(mean).collect()
}

/// The cells beside and above one another; `None` if all are empty.
fn joined(cells: &[[Vec<Vec4>; 2]], side: usize) -> Option<Rgba> {
    let all = || cells.iter().flatten().flatten();
    let weight: f32 = all().map(|pixel| pixel.w).sum();
    if weight <= 0.0 {
        return None;
    }
    let mean = encoded(all().map(|pixel| pixel.truncate() * pixel.w).sum::<Vec3>() / weight);
    let width = side * cells.len();
    let pixel = |i: usize| {
        let (x, y) = (i % width, i / width);
        let pixel = cells[x / side][y / side][y % side * side + x % side];
        let [r, g, b] = if pixel.w > 0.0 { encoded(pixel.truncate()) } else { mean };
        [r, g, b, (255.0 * pixel.w).round() as u8]
    };
    let pixels = (0..width * 2 * side).into_par_iter().with_min_len(1 << 12).flat_map_iter(pixel).collect();
    Some(Rgba { width: width as u32, height: 2 * side as u32, pixels })
}

fn encoded(colour: Vec3) -> [u8; 3] {
    colour.to_array().map(|c| (255.0 * srgb_from_linear(c.clamp(0.0, 1.0))).round() as u8)
}
