//! Domes, ellipsoids and lathed bodies: closed surfaces of revolution.
//!
//! All are one sweep of a profile about an axis. Its ends lie on the axis and become poles; where the profile turns
//! sharply (a pot's rim, a dome's lower edge) each side keeps its own normals.
//!
//! UV: around and along the profile, 0 to 1; a dome is seen from above, `½ + ½·(x, y)/radius`, so that the picture of
//! a daisy's disc fits.

use super::copies::Placement;
use super::fineness::{Fineness, SolidParams, widest};
use super::mesh::{Mesh, Vertex};
use crate::geom::{frame, polyline};
use glam::{Vec2, Vec3};
use std::f32::consts::{FRAC_PI_2, PI, TAU};

/// Profiles that turn by more than the angle of this cosine have a crease.
const CREASE: f32 = 0.75;

/// Where a body of revolution stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stand {
    /// The axis at height 0, metres.
    pub(super) base: Vec3,
    /// Unit direction of the axis.
    pub(super) axis: Vec3,
}

/// How the coordinates of a texture are laid onto a body of revolution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Projection {
    /// Around the axis and along the profile.
    Cylindrical,
    /// From above, along the axis.
    Planar,
}

impl Stand {
    /// Where the head of a filament along these points stands: at its end, in its direction.
    pub(super) fn of_head(points: &[Vec3]) -> Option<Self> {
        let [.., before, end] = *points else { return None };
        Some(Self { base: end, axis: (end - before).try_normalize().unwrap_or(Vec3::Y) })
    }

    /// The placement of an upright body of radius 1 that becomes one of this radius here.
    pub(super) fn placement(self, radius: f32) -> Placement {
        // Upright, the hidden side is −z and the side after it −x.
        let across = frame::hidden_side(self.axis).cross(self.axis);
        Placement { shape: 0, slot: 0, base: self.base, u: across * radius, v: self.axis * radius }
    }
}

/// The height of a body in its radii: what bodies have in common that differ only in size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Proportion(u32);

impl Proportion {
    /// That of a body of a radius and a height; `None` for one that has none to speak of.
    pub(super) fn of(radius: f32, height: f32) -> Option<Self> {
        let share = height / radius;
        (share.is_finite() && share > 0.0).then_some(Self(share.to_bits()))
    }

    /// The height in radii.
    pub(super) fn height(self) -> f32 {
        f32::from_bits(self.0)
    }
}

/// Steps in which proportions of a profile are distinguished, in its largest radius.
const PROPORTION: f32 = 1.0 / 8192.0;

/// A profile in its largest radius, in steps of [`PROPORTION`]: what lathed bodies have in common that differ only in size.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Proportions(Vec<[i32; 2]>);

impl Proportions {
    /// Those of a profile; `None` for one that has no size to speak of.
    pub(super) fn of(profile: &[Vec2]) -> Option<Self> {
        let scale = (PROPORTION * widest(profile)).recip();
        let is_sound = scale.is_finite() && profile.iter().all(|point| (*point * scale).is_finite());
        is_sound.then(|| {
            Self(profile.iter().map(|point| (*point * scale).round().as_ivec2().to_array()).collect())
        })
    }

    /// The profile in its largest radius.
    pub(super) fn profile(&self) -> Vec<Vec2> {
        self.0.iter().map(|[r, h]| Vec2::new(*r as f32, *h as f32) * PROPORTION).collect()
    }
}

/// A half ellipsoid of radius 1, upright at the origin and closed underneath.
pub(super) fn dome(proportion: Proportion, fineness: Fineness, params: &SolidParams) -> Mesh {
    let (rows, size) = (fineness.dome_rows(params), Vec2::new(1.0, proportion.height()));
    let arc = (0..=rows).map(|i| Vec2::from_angle(FRAC_PI_2 * i as f32 / rows as f32) * size);
    let profile: Vec<Vec2> = std::iter::once(Vec2::ZERO).chain(arc).collect();
    revolved(&profile, fineness.sides(params), Projection::Planar)
}

/// An ellipsoid of radius 1 around the origin, its axis upright; the proportion is that of its half length.
pub(super) fn head(proportion: Proportion, fineness: Fineness, params: &SolidParams) -> Mesh {
    let [sides, rows] = fineness.head(params);
    let size = Vec2::new(1.0, proportion.height());
    let arc = (0..=rows).map(|i| Vec2::from_angle(PI * i as f32 / rows as f32 - FRAC_PI_2) * size);
    let mut mesh = Mesh::default();
    revolve(&mut mesh, &arc.collect::<Vec<_>>(), sides, Projection::Cylindrical);
    mesh
}

/// A lathed body of these proportions, its largest radius 1, upright at the origin. A profile holds (radius, height)
/// along the outside and back along the inside.
pub(super) fn lathe(proportions: &Proportions, fineness: Fineness, params: &SolidParams) -> Mesh {
    revolved(&fineness.profile(proportions.profile()), fineness.sides(params), Projection::Cylindrical)
}

fn revolved(profile: &[Vec2], sides: u32, projection: Projection) -> Mesh {
    let mut mesh = Mesh::default();
    revolve(&mut mesh, profile, sides, projection);
    mesh.split_disagreeing_corners();
    mesh
}

/// The profile from pole to pole, its inner points off the axis, none repeated, outside to the right.
fn closed_profile(profile: &[Vec2]) -> Vec<Vec2> {
    let size = profile.iter().fold(0.0f32, |m, p| m.max(p.abs().max_element()));
    let off_axis = (1e-3 * size).max(f32::MIN_POSITIVE);
    let mut inner: Vec<Vec2> = Vec::with_capacity(profile.len() + 2);
    for p in profile {
        let p = Vec2::new(p.x.abs(), p.y);
        let repeats = inner.last().is_some_and(|q| q.distance(p) < off_axis);
        if p.x >= off_axis && !repeats {
            inner.push(p);
        }
    }
    let pole = |end: Option<&Vec2>| Vec2::new(0.0, end.map_or(0.0, |p| p.y));
    let mut closed = vec![pole(profile.first())];
    closed.append(&mut inner);
    closed.push(pole(profile.last()));
    if crate::geom::simple_loop::signed_area(closed.iter().copied()) < 0.0 {
        closed.reverse();
    }
    closed
}

/// Normals of a profile point toward the segment before it and the one after it; equal where it is smooth.
fn profile_normals(profile: &[Vec2], i: usize) -> (Vec2, Vec2) {
    let outside = |a: Vec2, b: Vec2| -(b - a).perp().normalize_or_zero();
    let before = (i > 0).then(|| outside(profile[i - 1], profile[i]));
    let after = (i + 1 < profile.len()).then(|| outside(profile[i], profile[i + 1]));
    match (before, after) {
        (Some(b), Some(a)) if b.dot(a) > CREASE => ((a + b).normalize(), (a + b).normalize()),
        (b, a) => (b.or(a).unwrap_or(Vec2::X), a.or(b).unwrap_or(Vec2::X)),
    }
}

/// A profile on its way around the upright axis.
struct Sweep {
    /// Unit directions from the axis to the sides.
    around: Vec<Vec3>,
    sides: u32,
    projection: Projection,
    widest: f32,
}

/// Appends the sweep of a profile around the upright axis, nothing if the profile encloses nothing.
fn revolve(mesh: &mut Mesh, profile: &[Vec2], sides: u32, projection: Projection) {
    let profile = closed_profile(profile);
    let last = profile.len() - 1;
    if last < 2 {
        return;
    }
    let side = frame::hidden_side(Vec3::Y);
    let widest = profile.iter().fold(f32::MIN_POSITIVE, |m, p| m.max(p.x));
    let other = Vec3::Y.cross(side);
    let direction = |c: Vec2| side * c.x + other * c.y;
    let angles = (0..sides).map(|j| TAU * j as f32 / sides as f32);
    let around = angles.map(|angle| direction(Vec2::from_angle(angle))).collect();
    let sweep = Sweep { around, sides, projection, widest };
    let length = polyline::length(&profile);
    let mut first_point = sweep.points(mesh, profile[0]);
    let mut bottom = sweep.row(mesh, profile[0], profile_normals(&profile, 0).1, 0.0, first_point);
    let mut along = 0.0;
    for i in 1..=last {
        along += profile[i - 1].distance(profile[i]) / length;
        first_point = sweep.points(mesh, profile[i]);
        let (below, above) = profile_normals(&profile, i);
        let top = sweep.row(mesh, profile[i], below, along, first_point);
        sweep.join(mesh, (bottom, i == 1), (top, i == last));
        let crease = i < last && below != above;
        bottom = if crease { sweep.row(mesh, profile[i], above, along, first_point) } else { top };
    }
}

impl Sweep {
    /// Appends the points of one profile point, a single one on the axis, and returns the first's index.
    fn points(&self, mesh: &mut Mesh, p: Vec2) -> u32 {
        let first = mesh.points.len() as u32;
        let centre = Vec3::Y * p.y;
        if p.x > 0.0 {
            mesh.points.extend(self.around.iter().map(|direction| centre + *direction * p.x));
        } else {
            mesh.points.push(centre);
        }
        first
    }

    /// Appends the vertices of one profile point: a ring with its seam twice, or a pole once for every side.
    fn row(&self, mesh: &mut Mesh, p: Vec2, normal: Vec2, along: f32, first_point: u32) -> u32 {
        let first = mesh.vertices.len() as u32;
        let pole = p.x <= 0.0;
        let count = if pole { self.sides } else { self.sides + 1 };
        mesh.vertices.extend((0..count).map(|j| {
            let around = (j as f32 + if pole { 0.5 } else { 0.0 }) / self.sides as f32;
            let uv = match self.projection {
                Projection::Cylindrical => Vec2::new(around, along.min(1.0)),
                Projection::Planar => {
                    let c = Vec2::from_angle(TAU * around) * (0.5 * p.x / self.widest);
                    (Vec2::splat(0.5) + c).clamp(Vec2::ZERO, Vec2::ONE)
                }
            };
            let side = j % self.sides;
            let point = if pole { first_point } else { first_point + side };
            // At a pole the sideways parts cancel; one that is only sideways (a spike) has none to keep.
            let outward = if pole { Vec3::ZERO } else { self.around[side as usize] * normal.x };
            let normal = outward + Vec3::Y * normal.y;
            Vertex { point, normal: normal.try_normalize().unwrap_or(Vec3::Y), uv }
        }));
        first
    }

    /// Appends the faces between two rows, either of which may be a pole.
    fn join(&self, mesh: &mut Mesh, (low, low_pole): (u32, bool), (high, high_pole): (u32, bool)) {
        for j in 0..self.sides {
            if !low_pole {
                let top = if high_pole { high + j } else { high + j + 1 };
                mesh.triangles.push([low + j, low + j + 1, top]);
            }
            if !high_pole {
                let top = [high + j + 1, high + j];
                mesh.triangles.push([low + j, top[0], top[1]]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lathed(profile: &[Vec2]) -> Mesh {
        lathe(&Proportions::of(profile).unwrap(), Fineness::Large, &SolidParams::default())
    }

    fn proportion(height: f32) -> Proportion {
        Proportion::of(1.0, height).unwrap()
    }

    #[test]
    fn a_dome_has_its_texture_from_above() {
        let mesh = dome(proportion(0.5), Fineness::Whole, &SolidParams::default());
        mesh.check_invariants().unwrap();
        for vertex in &mesh.vertices {
            let p = mesh.points[vertex.point as usize];
            let from_middle = Vec2::new(p.x, p.z).length();
            assert!((vertex.uv.distance(Vec2::splat(0.5)) * 2.0 - from_middle).abs() < 1e-4);
        }
        let top = mesh.points.iter().map(|p| p.y).fold(0.0, f32::max);
        assert_eq!(top, 0.5);
    }

    #[test]
    fn a_placed_ellipsoid_stands_on_its_axis() {
        let axis = Vec3::new(0.6, -0.48, 0.64);
        let base = Vec3::new(1.0, 2.0, 3.0);
        let mut mesh = Mesh::default();
        let shape = head(proportion(4.0), Fineness::Whole, &SolidParams::default());
        Stand { base, axis }.placement(0.5).append(&shape, &mut mesh);
        mesh.check_invariants().unwrap();
        for p in mesh.points {
            let (along, off) = ((p - base).dot(axis), (p - base).reject_from_normalized(axis).length());
            assert!(((along / 2.0).powi(2) + (off / 0.5).powi(2) - 1.0).abs() < 1e-4);
        }
    }

    #[test]
    fn a_pot_is_hollow_and_its_rim_is_a_crease() {
        let profile =
            [(0.0, 0.0), (0.6, 0.0), (1.0, 1.0), (0.9, 1.0), (0.5, 0.1), (0.0, 0.1)].map(Vec2::from);
        let mesh = lathed(&profile);
        mesh.check_invariants().unwrap();
        let volume: f32 =
            mesh.triangles.iter().map(|t| mesh.corners(*t)).map(|[a, b, c]| a.dot(b.cross(c))).sum();
        assert!((0.3..0.9).contains(&(volume / 6.0)), "{}", volume / 6.0);
        assert!(
            mesh.vertices
                .iter()
                .any(|v| v.normal.distance(Vec3::Y) < 1e-3 && mesh.points[v.point as usize].y == 1.0)
        );
    }

    #[test]
    fn profiles_drawn_the_other_way_round_face_outward_too() {
        let up = [(0.0, 0.0), (1.0, 0.5), (0.0, 1.0)].map(Vec2::from);
        let down = [up[2], up[1], up[0]];
        for profile in [up, down] {
            let mesh = lathed(&profile);
            mesh.check_invariants().unwrap();
            assert!(
                mesh.vertices
                    .iter()
                    .all(|v| v.normal.dot(mesh.points[v.point as usize] - Vec3::Y * 0.5) > 0.0)
            );
        }
    }

    #[test]
    fn a_profile_without_body_has_no_faces() {
        assert!(Proportions::of(&[Vec2::ZERO; 3]).is_none());
    }

    #[test]
    fn bodies_that_differ_in_size_have_proportions_in_common() {
        let profile: Vec<Vec2> =
            (0..9).map(|i| Vec2::from_angle(PI * i as f32 / 8.0 - FRAC_PI_2) * Vec2::new(1.0, 1.3)).collect();
        let of = |size: f32| Proportions::of(&profile.iter().map(|p| *p * size).collect::<Vec<_>>()).unwrap();
        for size in [1e-4, 0.0173, 0.3, 7.1, 4321.0] {
            assert_eq!(of(size), of(1.0));
        }
        for (kept, point) in of(1.0).profile().iter().zip(&profile) {
            assert!(kept.distance(*point) < PROPORTION);
        }
    }
}
