//! Branches to closed tubes (000 §5.3.3, 002 §6.5).
//!
//! A regular polygon is carried along the skeleton on rotation-minimising frames (`geom::frame`); its number of sides
//! grows with the root of the radius, 8 for an ordinary stem. The base, which is sunk in the parent, is closed flat,
//! the end by a blunt cone. Normals lean with the taper.
//!
//! UV: u runs around with a seam at the back, a whole number of bark pictures, more on thicker branches; v grows with
//! arc length over circumference, so that bark is never stretched. Both leave 0 to 1: bark repeats.
//!
//! Where we depart: the paper turns a fixed front vector about cross products that vanish on straight runs.
//! Limits: a branch that bends more tightly than its own radius may cut into itself; the surface stays closed.

use super::mesh::{Mesh, Vertex};
use super::spine::{self, Ring, SpineScratch};
use crate::geom::frame;
use crate::plant::Branch;
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;

crate::parameters! {
    /// How finely branches and stems are modelled.
    pub struct TubeParams {
        /// How fine wood is: 2 has twice as many sides, and follows its skeleton twice as closely.
        quality: f32 = 1.0, 0.25..=4.0, "";
        /// Sides of an ordinary stem; thinner twigs have fewer, thicker trunks more.
        sides: u32 = 8, 3..=64, "";
        /// Radius of an ordinary stem.
        ordinary_radius: f32 = 0.006, 0.0001..=0.1, "of the plant's size";
        /// Fewest sides, on the thinnest twigs.
        fewest_sides: u32 = 4, 3..=64, "";
        /// Most sides, on the thickest trunks.
        most_sides: u32 = 24, 3..=64, "";
        /// How far the tube may leave the skeleton.
        tolerance: f32 = 0.25, 0.005..=1.0, "of the radius";
        /// Width of the bark picture.
        bark_width: f32 = 0.08, 0.005..=1.0, "of the plant's size";
        /// Branches grow out of one another as one closed surface; otherwise each is a tube of its own.
        joined: bool = true, 0..=1, "";
        /// Length of the cone at a branch's end.
        tip: f32 = 0.7, 0.05..=4.0, "of the radius";
    }
}

/// However thin a branch is, it need not follow its skeleton more closely than this share of the plant's size; nor may
/// it, however thick, leave it by more than the other.
const NEAREST: f32 = 0.0005;
const FARTHEST: f32 = 0.002;
/// Bark shrinks with the branch, but not beyond this share of the radius at its base.
pub(super) const FINEST_BARK: f32 = 0.3;

/// How often a texture repeats on a tube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Tiling {
    /// Bark that repeats this many times around, and along as often as keeps it square.
    Bark(f32),
    /// One picture from base to tip.
    Whole,
}

/// Look of one tube.
#[derive(Clone, Copy, Debug)]
pub(super) struct TubeLook {
    pub(super) sides: u32,
    /// How its texture repeats.
    pub(super) tiling: Tiling,
    /// Length of the end's cone in radii.
    pub(super) tip: f32,
    pub(super) detail: spine::Detail,
}

impl TubeLook {
    /// How often the texture repeats around.
    pub(super) fn repeats(&self) -> f32 {
        if let Tiling::Bark(repeats) = self.tiling { repeats } else { 1.0 }
    }
}

/// Memory that is used again for every tube.
#[derive(Default)]
pub(super) struct TubeScratch {
    spine: SpineScratch,
    rings: Vec<Ring>,
    /// Directions to the sides; kept while tubes have equally many.
    circle: Vec<Vec2>,
}

/// The look of a branch in a plant of the given size in metres.
pub(super) fn look(branch: &Branch, params: &TubeParams, plant_size: f32) -> TubeLook {
    let base = branch.radii.first().copied().unwrap_or(0.0);
    let quality = params.quality;
    let sides = |count: u32, times: f32| ((quality * count as f32 * times).round() as u32).max(3);
    let (fewest, most) =
        (sides(params.fewest_sides, 1.0), sides(params.most_sides.max(params.fewest_sides), 1.0));
    let thickness = base / (params.ordinary_radius * plant_size);
    let around = TAU * base / (params.bark_width * plant_size);
    TubeLook {
        sides: sides(params.sides, thickness.sqrt()).clamp(fewest, most),
        tiling: Tiling::Bark(around.round().clamp(1.0, 8.0)),
        tip: params.tip,
        detail: spine::Detail {
            of_radius: params.tolerance / quality,
            metres: (NEAREST * plant_size / quality, FARTHEST * plant_size / quality),
        },
    }
}

/// The mesh of a branch.
pub(super) fn branch(branch: &Branch, look: TubeLook, scratch: &mut TubeScratch) -> Mesh {
    let mut mesh = Mesh::default();
    append(&mut mesh, branch.points.iter().copied().zip(branch.radii.iter().copied()), look, scratch);
    mesh.split_disagreeing_corners();
    mesh
}

/// Appends a closed tube around a skeleton of at least two points.
pub(super) fn append(
    mesh: &mut Mesh,
    skeleton: impl Iterator<Item = (Vec3, f32)>,
    look: TubeLook,
    scratch: &mut TubeScratch,
) {
    spine::rings(skeleton, look.detail, &mut scratch.spine, &mut scratch.rings);
    if scratch.circle.len() != look.sides as usize {
        scratch.circle.clear();
        scratch.circle.extend((0..look.sides).map(|j| Vec2::from_angle(TAU * j as f32 / look.sides as f32)));
    }
    let (rings, circle) = (&scratch.rings[..], &scratch.circle[..]);
    let (k, count) = (look.sides as usize, rings.len());
    mesh.points.reserve(count * k + 1);
    mesh.vertices.reserve(count * (k + 1) + 2 * k);
    mesh.triangles.reserve(2 * (count - 1) * k + 2 * k - 2);
    let first = (mesh.points.len() as u32, mesh.vertices.len() as u32);
    let end = &rings[count - 1];
    let repeats = look.repeats();
    let v = wall(mesh, rings, circle, repeats);
    base_cap(mesh, first.0, rings[0].tangent, circle);
    tip_cap(mesh, end, look, Vec2::new(repeats, v + repeats * look.tip / TAU));
    if look.tiling == Tiling::Whole {
        let whole = 1.0 / (v + repeats * look.tip / TAU);
        let (walls, rest) = mesh.vertices[first.1 as usize..].split_at_mut(count * (k + 1));
        walls
            .iter_mut()
            .chain(&mut rest[k..])
            .for_each(|vertex| vertex.uv.y = (vertex.uv.y * whole).min(1.0));
    }
    join_rings(mesh, first.1, look.sides, count as u32 - 1);
}

/// Appends points and vertices of all rings and returns the last ring's v.
fn wall(mesh: &mut Mesh, rings: &[Ring], circle: &[Vec2], repeats: f32) -> f32 {
    let k = circle.len() as u32;
    let mut side = frame::hidden_side(rings[0].tangent);
    let mut v = 0.0;
    for (i, ring) in rings.iter().enumerate() {
        let before = &rings[i.saturating_sub(1)];
        let after = &rings[(i + 1).min(rings.len() - 1)];
        if i > 0 {
            side = frame::transport(side, (before.at, before.tangent), (ring.at, ring.tangent));
            let radius = (0.5 * (before.radius + ring.radius)).max(FINEST_BARK * rings[0].radius);
            v += before.at.distance(ring.at) * repeats / (TAU * radius);
        }
        let other = ring.tangent.cross(side);
        let taper = (after.radius - before.radius) / after.at.distance(before.at);
        let upright = 1.0 / (1.0 + taper * taper).sqrt();
        let lean = ring.tangent * (-taper * upright);
        let first = mesh.points.len() as u32;
        let direction = |c: &Vec2| side * c.x + other * c.y;
        mesh.points.extend(circle.iter().map(|c| ring.at + direction(c) * ring.radius));
        mesh.vertices.extend((0..=k).map(|j| {
            let around = if j == k { 0 } else { j };
            let normal = direction(&circle[around as usize]) * upright + lean;
            let uv = Vec2::new(repeats * j as f32 / k as f32, v);
            Vertex { point: first + around, normal, uv }
        }));
    }
    v
}

fn join_rings(mesh: &mut Mesh, first_vertex: u32, sides: u32, spans: u32) {
    for span in 0..spans {
        let (low, high) = (first_vertex + span * (sides + 1), first_vertex + (span + 1) * (sides + 1));
        for j in 0..sides {
            mesh.triangles.push([low + j, low + j + 1, high + j + 1]);
            mesh.triangles.push([low + j, high + j + 1, high + j]);
        }
    }
}

/// Closes the first ring with a flat polygon.
fn base_cap(mesh: &mut Mesh, first_point: u32, tangent: Vec3, circle: &[Vec2]) {
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend(circle.iter().enumerate().map(|(j, c)| Vertex {
        point: first_point + j as u32,
        normal: -tangent,
        uv: Vec2::splat(0.5) + *c * 0.5,
    }));
    mesh.triangles.extend((1..circle.len() as u32 - 1).map(|j| [first, first + j + 1, first + j]));
}

/// Closes the last ring, whose vertices are the latest but for the base cap's, with a cone whose point has the v of
/// `uv_end`.
fn tip_cap(mesh: &mut Mesh, ring: &Ring, look: TubeLook, uv_end: Vec2) {
    let k = look.sides;
    let last_ring = mesh.vertices.len() as u32 - k - (k + 1);
    let apex = mesh.points.len() as u32;
    mesh.points.push(ring.at + ring.tangent * (look.tip * ring.radius));
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend((0..k).map(|j| Vertex {
        point: apex,
        normal: ring.tangent,
        uv: Vec2::new((j as f32 + 0.5) / k as f32, 1.0) * uv_end,
    }));
    mesh.triangles.extend((0..k).map(|j| [last_ring + j, last_ring + j + 1, first + j]));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Origin, Role, WoodPart};

    fn stem(points: Vec<Vec3>, radius: f32) -> Mesh {
        let radii = vec![radius; points.len()];
        let stem = Branch {
            origin: Origin::Generated,
            parent: None,
            level: 0,
            points,
            radii,
            role: Role::of(WoodPart::Stem),
        };
        let mesh = branch(&stem, look(&stem, &TubeParams::default(), 1.0), &mut TubeScratch::default());
        mesh.check_invariants().unwrap();
        mesh
    }

    #[test]
    fn sides_grow_with_the_radius_within_limits() {
        // Two rings of sides and the point of the cone.
        let sides = |radius| (stem(vec![Vec3::ZERO, Vec3::Y], radius).points.len() - 1) / 2;
        assert_eq!([0.0001, 0.006, 0.024, 0.5].map(sides), [4, 8, 16, 24]);
    }

    #[test]
    fn a_straight_stem_has_its_radius_and_ends_in_a_cone() {
        let mesh = stem(vec![Vec3::ZERO, Vec3::Z], 0.006);
        for p in &mesh.points[..16] {
            assert!((p.truncate().length() - 0.006).abs() < 1e-6);
        }
        assert!((mesh.points[16].z - 1.0 - 0.7 * 0.006).abs() < 1e-6);
    }

    #[test]
    fn bark_is_as_dense_along_as_around() {
        let mesh = stem(vec![Vec3::ZERO, Vec3::X * 0.5, Vec3::new(1.0, 0.2, 0.0)], 0.03);
        let around = TAU * 0.03;
        let u = mesh.vertices.iter().map(|v| v.uv.x).fold(0.0, f32::max);
        assert_eq!(u, 2.0);
        let second_ring = mesh.vertices.iter().find(|v| v.point == 18).unwrap();
        assert!((second_ring.uv.y / 0.5 - u / around).abs() < 0.1 * u / around, "{}", second_ring.uv.y);
    }
}
