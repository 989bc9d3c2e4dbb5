//! The picture of one shoot, seen from two sides.
//!
//! It is drawn by parallel projection, twice as large as it becomes, with a depth for every pixel, and each pixel of the result is
//! the mean of four: its alpha says how much of it is covered. Colours are those of the materials, a little lighter where a surface
//! faces the light above and in front, and where it lies in front of others; their mean stays. So that what is thin is not lost from
//! afar, alpha is more than that where it changes nothing near by (`coverage`).

use super::coverage;
use super::frame::{Frame, Side};
use super::raster::covered;
use super::sky::Sky;
use super::surfaces::{Corner, Surfaces, Triangle};
use crate::plant::FinishedPlant;
use glam::{USizeVec2, Vec2, Vec3, Vec4};

/// Pixels that are drawn for one, to each side.
const FINER: usize = 2;
/// Least width and height, pixels.
const NARROWEST: f32 = 8.0;
/// Where light comes from, seen on the card, and what the side away from it has of it.
const LIGHT: Vec3 = Vec3::new(0.3, 0.55, 0.78);
const IN_SHADE: f32 = 0.55;
/// What the hindmost has of the light of the foremost.
const BEHIND: f32 = 0.6;

/// How pictures are drawn.
#[derive(Clone, Copy)]
pub(super) struct Drawing {
    /// The longer of width and height of each.
    pub(super) pixels: u32,
    /// How much of a plant each shows, share of its size: the more, the more of the plant's own shade is in the picture.
    pub(super) share: f32,
}

/// A shoot with its pictures.
#[derive(Debug)]
pub(super) struct Painted {
    /// The box that was drawn.
    pub(super) frame: Frame,
    /// By [`Side::ALL`].
    pub(super) cells: [Cell; 2],
}

/// The picture of a shoot from one side.
#[derive(Debug)]
pub(super) struct Cell {
    /// Width and height: as many pixels to the metre in both, so that smaller copies are as small in both as they are seen.
    pub(super) size: USizeVec2,
    /// Rows from the top: linear light, straight alpha.
    pub(super) pixels: Vec<Vec4>,
}

impl Cell {
    /// Paints triangles onto a card: the middle of its lower edge, its width and its height. With a `sky` they have its light, otherwise
    /// that of a lamp.
    pub(super) fn painted(
        triangles: &[Triangle<'_>],
        sky: Option<&Sky>,
        card: (Vec3, Vec3, Vec3),
        drawing: Drawing,
    ) -> Self {
        let size = Self::size_of(card, drawing.pixels);
        let pixels = coarser(&drawn(triangles, sky, card, size * FINER), size, drawing.share);
        Self { size, pixels }
    }

    /// Without anything on it, for a card of this width and height.
    fn size_of((_, u, v): (Vec3, Vec3, Vec3), longest: u32) -> USizeVec2 {
        let extent = Vec2::new(u.length(), v.length());
        let share = extent / extent.max_element().max(f32::MIN_POSITIVE);
        (share * longest as f32)
            .ceil()
            .clamp(Vec2::splat(NARROWEST), Vec2::splat(longest as f32))
            .as_usizevec2()
    }
}

impl Painted {
    /// Paints a shoot that has about this box. None once `stop` says yes.
    pub(super) fn new(
        surfaces: &Surfaces<'_>,
        (excerpt, frame): (&FinishedPlant, &Frame),
        drawing: Drawing,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Option<Self> {
        let triangles = surfaces.triangles(excerpt, stop)?;
        let corners = triangles.iter().flat_map(|triangle| triangle.corners.iter().map(|corner| corner.at));
        let frame = frame.around_points(corners).unwrap_or(*frame);
        let sky = (drawing.share >= 1.0).then(|| Sky::over(&triangles));
        let seen_from = |side| {
            let mut cell =
                (!stop()).then(|| Cell::painted(&triangles, sky.as_ref(), frame.card(side), drawing))?;
            coverage::keep(&mut cell.pixels, cell.size, drawing.share);
            Some(cell)
        };
        let [wide, narrow] = Side::ALL;
        let (wide, narrow) = rayon::join(|| seen_from(wide), || seen_from(narrow));
        Some(Self { frame, cells: [wide?, narrow?] })
    }
}

/// What is seen in a picture of this width and height, rows from the top.
fn drawn(
    triangles: &[Triangle<'_>],
    sky: Option<&Sky>,
    (base, u, v): (Vec3, Vec3, Vec3),
    size: USizeVec2,
) -> Vec<Pixel> {
    let facing = u.cross(v).normalize_or_zero();
    let axes = (u / u.length_squared(), v / v.length_squared());
    let onto = |corner: &Corner| {
        let from_base = corner.at - base;
        let place = Vec2::new(from_base.dot(axes.0) + 0.5, 1.0 - from_base.dot(axes.1));
        (place * size.as_vec2()).extend(from_base.dot(facing))
    };
    let depths = triangles.iter().flat_map(|triangle| triangle.corners.iter().map(|corner| onto(corner).z));
    let (far, near) =
        depths.fold((f32::INFINITY, f32::NEG_INFINITY), |(far, near), z| (far.min(z), near.max(z)));
    let light = LIGHT.x * u.normalize_or_zero() + LIGHT.y * v.normalize_or_zero() + LIGHT.z * facing;
    let lit = |normal: Vec3, depth: f32, at: Vec3| {
        if let Some(sky) = sky {
            let seen_side = if normal.dot(facing) < 0.0 { -normal } else { normal };
            return sky.light(at, seen_side, facing);
        }
        let faced = IN_SHADE + (1.0 - IN_SHADE) * normal.dot(light).max(0.0);
        faced * (BEHIND + (1.0 - BEHIND) * (depth - far) / (near - far).max(f32::MIN_POSITIVE))
    };
    let mut places = vec![Place::default(); size.element_product()];
    for triangle in triangles {
        let corners = triangle.corners.each_ref().map(onto);
        let depths = Vec3::from(corners.map(|place| place.z));
        let [a, b, c] = &triangle.corners;
        covered(corners.map(Vec3::truncate), size, |pixel, shares| {
            let depth = depths.dot(shares);
            if depth <= places[pixel].depth {
                return;
            }
            let uv = a.uv * shares.x + b.uv * shares.y + c.uv * shares.z;
            let at = a.at * shares.x + b.at * shares.y + c.at * shares.z;
            let normal = a.normal * shares.x + b.normal * shares.y + c.normal * shares.z;
            if let Some(colour) = triangle.surface.colour(uv) {
                places[pixel] = Place { depth, colour, at, normal };
            }
        });
    }
    // Light takes longer than all else, so it is found for what is seen in the end.
    let pixel = |place: &Place| {
        let Place { depth, colour, at, normal } = *place;
        let is_there = depth > f32::NEG_INFINITY;
        Pixel { colour, light: if is_there { lit(normal.normalize_or_zero(), depth, at) } else { 0.0 } }
    };
    places.iter().map(pixel).collect()
}

/// What is foremost at one place.
#[derive(Clone, Copy)]
struct Place {
    depth: f32,
    colour: Vec3,
    at: Vec3,
    normal: Vec3,
}

impl Default for Place {
    fn default() -> Self {
        Self { depth: f32::NEG_INFINITY, colour: Vec3::ZERO, at: Vec3::ZERO, normal: Vec3::ZERO }
    }
}

/// What is seen at one place; nothing where there is no light.
#[derive(Clone, Copy)]
struct Pixel {
    colour: Vec3,
    light: f32,
}

/// Means of squares of pixels in linear light, straight alpha. The light of small pictures is 1 in the mean.
fn coarser(pixels: &[Pixel], size: USizeVec2, share: f32) -> Vec<Vec4> {
    let fine = size.x * FINER;
    let lights = || pixels.iter().map(|pixel| pixel.light).filter(|light| *light > 0.0);
    let mean_light = lights().sum::<f32>() / lights().count().max(1) as f32;
    let usual = mean_light.powf(1.0 - share.clamp(0.0, 1.0).sqrt());
    let seen = |pixel: &Pixel| match pixel.light > 0.0 {
        // No channel beyond white, so that hues stay.
        true => (pixel.colour * (pixel.light / usual).min(1.0 / pixel.colour.max_element())).extend(1.0),
        false => Vec4::ZERO,
    };
    let mean = |i: usize| {
        let (x, y) = (i % size.x * FINER, i / size.x * FINER);
        let of = (0..FINER * FINER).map(|k| &pixels[(y + k / FINER) * fine + x + k % FINER]);
        let sum: Vec4 = of.map(seen).sum();
        let alpha = sum.w / (FINER * FINER) as f32;
        (sum.truncate() / sum.w.max(1.0)).extend(alpha)
    };
    (0..size.element_product()).map(mean).collect()
}
