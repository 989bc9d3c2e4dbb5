//! The picture of a plant's shoots: a column for each, the wide side in the upper row and the narrow one in the lower.
//!
//! Each is drawn by parallel projection from the meshes of its organs and twigs, twice as large as it becomes, with a depth for
//! every pixel, and each pixel of the result is the mean of four: its alpha says how much of it is covered. Colours are those of
//! the materials, a little lighter where a surface faces the light above and in front, and where it lies in front of others; their
//! mean stays. What nothing covers has the mean colour, so that smaller copies of the picture have no dark margins.

use super::clusters::Cluster;
use super::frame::{Frame, Side};
use super::mesh_params;
use crate::model;
use crate::picture::{
    Picture,
    decode::{self, Rgba},
};
use crate::plant::{FinishedPlant, Material, Texture};
use crate::species::builtin_texture;
use crate::srgb::{linear_from_srgb, srgb_from_linear};
use glam::{Vec2, Vec3, Vec4};
use rayon::prelude::*;
use std::sync::OnceLock;

/// Pixels that are drawn for one, to each side.
const FINER: usize = 2;
/// Where light comes from, seen on the card, and what the side away from it has of it.
const LIGHT: Vec3 = Vec3::new(0.3, 0.55, 0.78);
const IN_SHADE: f32 = 0.55;
/// What the hindmost has of the light of the foremost.
const BEHIND: f32 = 0.6;

/// The pictures of shoots in one.
pub(super) struct Atlas {
    pub(super) picture: Picture,
    columns: usize,
}

impl Atlas {
    /// Draws some of the clusters, each so many pixels wide and high. `None` where nothing of them is seen.
    pub(super) fn draw(
        plant: &FinishedPlant,
        framed: &[(Cluster, Frame)],
        shown: &[usize],
        pixels: u32,
    ) -> Option<Self> {
        let surfaces = Surfaces::new(plant);
        let side = pixels as usize;
        let cells = |shoot: &usize| {
            let (cluster, frame) = &framed[*shoot];
            let triangles = surfaces.triangles(plant, cluster);
            let corners =
                triangles.iter().flat_map(|triangle| triangle.corners.iter().map(|corner| corner.at));
            let frame = frame.around_points(corners).unwrap_or(*frame);
            Side::ALL.map(|of| drawn(&triangles, frame.card(of), side))
        };
        let cells: Vec<[Vec<Vec4>; 2]> = shown.par_iter().map(cells).collect();
        let picture = joined(&cells, side)?.to_png().ok()?;
        Some(Self { picture: Picture::new(picture).ok()?, columns: shown.len() })
    }

    /// The part of the picture that shows a shoot from a side.
    pub(super) fn window(&self, shoot: usize, side: Side) -> [Vec2; 2] {
        let column = shoot as f32 / self.columns as f32;
        let low = Vec2::new(column, if side == Side::Wide { 0.5 } else { 0.0 });
        [low, low + Vec2::new(1.0 / self.columns as f32, 0.5)]
    }
}

/// A corner with its place in the world, its normal and its place in the material's picture.
#[derive(Clone, Copy)]
struct Corner {
    at: Vec3,
    normal: Vec3,
    uv: Vec2,
}

/// A triangle and its material.
struct Triangle<'a> {
    corners: [Corner; 3],
    surface: &'a Surface,
}

/// A material's colour and picture.
struct Surface {
    diffuse: Vec3,
    texture: Option<Rgba>,
    linear: [f32; 256],
}

impl Surface {
    fn new(material: &Material) -> Self {
        let linear = std::array::from_fn(|encoded| linear_from_srgb(encoded as f32 / 255.0));
        let texture = material.texture.as_ref().and_then(|texture| match texture {
            Texture::BuiltIn(name) => decode::decode(builtin_texture(name)?).ok(),
            Texture::File(path) => Picture::read_with_pixels(path).ok().map(|(_, pixels)| pixels),
            Texture::Own(picture) => picture.pixels().ok(),
        });
        Self { diffuse: material.diffuse.into(), texture, linear }
    }

    /// Colour at a place in linear light, and whether there is anything.
    fn colour(&self, uv: Vec2) -> Option<Vec3> {
        let Some(Rgba { width, height, pixels }) = &self.texture else { return Some(self.diffuse) };
        let texel =
            |share: f32, count: u32| ((share.rem_euclid(1.0) * count as f32) as u32).min(count - 1) as usize;
        let at = 4 * (texel(1.0 - uv.y, *height) * *width as usize + texel(uv.x, *width));
        let [r, g, b, a] = [0, 1, 2, 3].map(|k| pixels[at + k]);
        (a > 127).then(|| self.diffuse * Vec3::from([r, g, b].map(|c| self.linear[usize::from(c)])))
    }
}

/// The looks of a plant, each once something of it is drawn.
struct Surfaces(Vec<OnceLock<Surface>>);

impl Surfaces {
    fn new(plant: &FinishedPlant) -> Self {
        Self(plant.materials().iter().map(|_| OnceLock::new()).collect())
    }

    /// The surface of a cluster.
    fn triangles(&self, plant: &FinishedPlant, cluster: &Cluster) -> Vec<Triangle<'_>> {
        let part = plant.excerpt(&cluster.branches, &cluster.organs);
        let model = model::build(&part, &mesh_params());
        let mut triangles = Vec::new();
        for part in &model.flattened().parts {
            for (material, faces) in part.material_slots() {
                let corner = |vertex: u32| {
                    let vertex = part.mesh.vertices[vertex as usize];
                    Corner {
                        at: part.mesh.points[vertex.point as usize],
                        normal: vertex.normal,
                        uv: vertex.uv,
                    }
                };
                let surface = self.0[material].get_or_init(|| Surface::new(&plant.materials()[material]));
                let triangle = |face: &[u32; 3]| Triangle { corners: face.map(corner), surface };
                triangles.extend(part.mesh.triangles[faces].iter().map(triangle));
            }
        }
        triangles
    }
}

/// Colours of a square in linear light with alpha, rows from the top; transparent where nothing is.
fn drawn(triangles: &[Triangle<'_>], (base, u, v): (Vec3, Vec3, Vec3), side: usize) -> Vec<Vec4> {
    let fine = side * FINER;
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
        covered(places, fine, |pixel, shares| {
            let mixed = |of: [f32; 3]| of.iter().zip(shares).map(|(value, share)| value * share).sum::<f32>();
            let depth = mixed(places.map(|place| place.z));
            if depth <= pixels[pixel].depth {
                return;
            }
            let [a, b, c] = &triangle.corners;
            let uv = a.uv * shares[0] + b.uv * shares[1] + c.uv * shares[2];
            let normal = a.normal * shares[0] + b.normal * shares[1] + c.normal * shares[2];
            if let Some(colour) = triangle.surface.colour(uv) {
                pixels[pixel] = Pixel { depth, colour, light: lit(normal.normalize_or_zero(), depth) };
            }
        });
    }
    coarser(&pixels, side)
}

/// Calls with each pixel whose middle a triangle covers and the shares of its corners there; x and y are in pixels.
fn covered(places: [Vec3; 3], side: usize, mut each: impl FnMut(usize, [f32; 3])) {
    let [a, b, c] = places.map(Vec3::truncate);
    let twice = (b - a).perp_dot(c - a);
    if twice == 0.0 || !twice.is_finite() {
        return;
    }
    let most = Vec2::splat(side as f32);
    let low = a.min(b).min(c).clamp(Vec2::ZERO, most).floor().as_usizevec2();
    let high = a.max(b).max(c).clamp(Vec2::ZERO, most).ceil().as_usizevec2();
    for y in low.y..high.y {
        for x in low.x..high.x {
            let p = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            let shares = [(b - p).perp_dot(c - p), (c - p).perp_dot(a - p), (a - p).perp_dot(b - p)]
                .map(|s| s / twice);
            if shares.iter().all(|share| *share >= 0.0) {
                each(y * side + x, shares);
            }
        }
    }
}

/// What is seen at one place; nothing where there is no light.
#[derive(Clone, Copy)]
struct Pixel {
    depth: f32,
    colour: Vec3,
    light: f32,
}

/// Means of squares of pixels, straight alpha, whose light is 1 in the mean.
fn coarser(pixels: &[Pixel], side: usize) -> Vec<Vec4> {
    let fine = side * FINER;
    let lights = || pixels.iter().map(|pixel| pixel.light).filter(|light| *light > 0.0);
    let mean_light = lights().sum::<f32>() / lights().count().max(1) as f32;
    let seen = |pixel: &Pixel| match pixel.light > 0.0 {
        // No channel beyond white, so that hues stay.
        true => (pixel.colour * (pixel.light / mean_light).min(1.0 / pixel.colour.max_element())).extend(1.0),
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
