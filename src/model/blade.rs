//! Blades to closed meshes: two faces and a rim (000 §5.1, §5.2).
//!
//! The flat triangulation is put on its rest surface, raised by its relief along the rest surface's normals, and
//! doubled: both faces lie half the thickness from that middle surface along its own smooth normals, a little closer
//! at the margin. A band of faces joins their margins. The rim shares the points of the faces but has vertices of its
//! own, so that faces shade smoothly up to a crisp edge. Small blades that are many have no rim: both faces meet in one
//! sharp margin (`sharp`), and the mesh is closed all the same.
//!
//! Where we depart: the paper copies the surface along the flower's axis, which leaves no thickness on steep petals.
//! On a cone the face of a petal is its inner side, toward the flower's axis, whichever side the viewer sees.
//!
//! UV: by `blade_uv`; the back has the same picture.
//!
//! Limits: thickness is at most a fifth of the mean width. A blade of less than a ten-thousandth of its distance from
//! the origin has no mesh, for its faces would drown in the rounding of its coordinates.

use super::blade_uv::BladeUv;
use super::flat::{BladeMeshParams, FlatBlade};
use super::mesh::{Mesh, Vertex};
use super::relief::Relief;
use super::shapes::{CopyShape, THINNEST};
use crate::plant::{Cone, ResolvedBlade, RestSurface};
use glam::{Vec2, Vec3};

/// Lowest part of a blade that is twisted more, share of its length, and how much more at the foot: the petals of a flower come
/// so near to one another there that their thickness would fill what is between them.
const FOOT: f32 = 0.5;
const AT_FOOT: f32 = 2.0;

/// How far a sharp margin lies toward the face, in half thicknesses: two leaves that stand at one place would otherwise have a
/// point in common.
const ASIDE: f32 = 0.25;

/// Memory that is used again for every blade.
#[derive(Default)]
pub(super) struct BladeScratch {
    middle: Vec<Vec3>,
    normals: Vec<Vec3>,
}

/// The mesh of a blade whose outline has been triangulated; `None` for one too small or too collapsed to be seen.
pub(super) fn mesh(
    blade: &ResolvedBlade<'_>,
    flat: &FlatBlade,
    params: &BladeMeshParams,
    scratch: &mut BladeScratch,
) -> Option<Mesh> {
    let facing = blade.u.cross(blade.v).try_normalize()?;
    let size = flat.size * blade.v.length().max(blade.u.length());
    let far = blade.base.abs().max_element() + size;
    if size < 1e-4 * far || !far.is_finite() {
        return None;
    }
    put_on_rest(blade, flat, facing, scratch);
    raise(blade, &Relief::new(blade, flat, params), flat, facing, scratch);
    smooth_normals(&flat.triangles, &scratch.middle, facing, &mut scratch.normals);
    let half = half_thickness(blade, flat, size).max(THINNEST * far);
    let mut mesh = if flat.is_sharp {
        meeting(flat, scratch, half)
    } else {
        let mut mesh = doubled(flat, scratch, half, half * params.margin_thickness);
        add_rim(flat, scratch, &mut mesh);
        mesh
    };
    mesh.split_disagreeing_corners();
    Some(mesh)
}

/// The shape that copies of a blade have in common; the blade stands at the origin, u along x and v along y.
pub(super) fn shape(
    blade: &ResolvedBlade<'_>,
    flat: &FlatBlade,
    params: &BladeMeshParams,
    scratch: &mut BladeScratch,
) -> Option<CopyShape> {
    let mesh = mesh(blade, flat, params, scratch)?;
    Some(CopyShape::blade(mesh, flat, half_thickness(blade, flat, flat.size)))
}

/// Half the thickness in the middle of a blade that is `size` metres large.
fn half_thickness(blade: &ResolvedBlade<'_>, flat: &FlatBlade, size: f32) -> f32 {
    let mean_width = 2.0 * flat.area / flat.perimeter * size;
    0.5 * (blade.form.thickness * blade.template.length() * blade.v.length()).min(0.2 * mean_width)
}

/// Fills `middle` with rest positions and `normals` with the rest surface's normals on the side of `facing`.
fn put_on_rest(blade: &ResolvedBlade<'_>, flat: &FlatBlade, facing: Vec3, scratch: &mut BladeScratch) {
    scratch.middle.clear();
    scratch.middle.extend(flat.points.iter().map(|p| blade.at_rest(*p)));
    match blade.rest {
        RestSurface::Plane => {
            scratch.normals.clear();
            scratch.normals.resize(flat.points.len(), facing);
        }
        RestSurface::Cone { .. }
        | RestSurface::Shaped { .. }
        | RestSurface::Patch(_)
        | RestSurface::Ring(_) => {
            smooth_normals(&flat.triangles, &scratch.middle, facing, &mut scratch.normals);
        }
    }
}

/// Moves the points of `middle` from the rest surface to the relief's height over it.
fn raise(
    blade: &ResolvedBlade<'_>,
    relief: &Relief<'_>,
    flat: &FlatBlade,
    facing: Vec3,
    scratch: &mut BladeScratch,
) {
    let toward_face = if faces_forward(blade, flat, facing, scratch) { 1.0 } else { -1.0 };
    let size = blade.v.length();
    let twist = blade.form.twist * size;
    let near_foot = |p: &Vec2| (1.0 - p.y / (FOOT * blade.template.length())).clamp(0.0, 1.0);
    for ((point, normal), p) in scratch.middle.iter_mut().zip(&scratch.normals).zip(&flat.points) {
        let across = twist * p.x * (1.0 + AT_FOOT * near_foot(p));
        *point += *normal * (toward_face * relief.height(*p) * size + across);
    }
}

/// Whether the blade's face, which on a cone is the inner side, is the side of `facing`.
fn faces_forward(blade: &ResolvedBlade<'_>, flat: &FlatBlade, facing: Vec3, scratch: &BladeScratch) -> bool {
    let (cone, mean): (&Cone, Vec3) = match &blade.rest {
        RestSurface::Cone { cone, .. } => (cone, scratch.normals.iter().sum()),
        // However far it is rolled in, its face is the side that was on the inside of the cone.
        RestSurface::Shaped { cone, .. } => {
            let unshaped = blade.unshaped();
            let points: Vec<Vec3> = flat.points.iter().map(|p| unshaped.at_rest(*p)).collect();
            let mut normals = Vec::new();
            smooth_normals(&flat.triangles, &points, facing, &mut normals);
            (cone, normals.iter().sum())
        }
        RestSurface::Plane | RestSurface::Patch(_) | RestSurface::Ring(_) => return true,
    };
    let blade = blade.unshaped();
    let from_apex = blade.at_rest(Vec2::new(0.0, 0.5 * blade.template.length())) - cone.apex;
    let away = from_apex.reject_from_normalized(cone.axis);
    let inner = cone.axis * (away.length() * cone.opening_rad.tan()) - away;
    let forward = mean.dot(inner);
    if forward == 0.0 { facing.z >= 0.0 } else { forward > 0.0 }
}

/// Unit normals at the points, faces weighted by their area; `fallback` where they cancel.
fn smooth_normals(triangles: &[[u32; 3]], points: &[Vec3], fallback: Vec3, normals: &mut Vec<Vec3>) {
    normals.clear();
    normals.resize(points.len(), Vec3::ZERO);
    for &[a, b, c] in triangles {
        let (a, b, c) = (a as usize, b as usize, c as usize);
        let cross = (points[b] - points[a]).cross(points[c] - points[a]);
        normals[a] += cross;
        normals[b] += cross;
        normals[c] += cross;
    }
    for normal in normals {
        let squared = normal.length_squared();
        *normal =
            if squared > f32::MIN_POSITIVE { *normal / squared.sqrt() } else { unit_or(*normal, fallback) };
    }
}

/// Tiny faces have cross products whose squares vanish; they still have a direction.
fn unit_or(v: Vec3, fallback: Vec3) -> Vec3 {
    let largest = v.abs().max_element();
    if largest > 0.0 { (v / largest).normalize() } else { fallback }
}

/// Front and back face. The front's points and vertices come first, in the order of the flat blade.
fn doubled(flat: &FlatBlade, scratch: &BladeScratch, half: f32, margin_half: f32) -> Mesh {
    let (count, margin) = (flat.points.len(), flat.margin);
    let mut mesh = Mesh {
        points: Vec::with_capacity(2 * count),
        vertices: Vec::with_capacity(2 * (count + margin)),
        triangles: Vec::with_capacity(2 * (flat.triangles.len() + margin)),
        breaks: Vec::new(),
    };
    let uv = BladeUv::of(flat);
    for side in [1.0, -1.0] {
        let first = mesh.points.len() as u32;
        for (i, (point, normal)) in scratch.middle.iter().zip(&scratch.normals).enumerate() {
            let normal = *normal * side;
            mesh.points.push(*point + normal * if i < margin { margin_half } else { half });
            mesh.vertices.push(Vertex { point: first + i as u32, normal, uv: uv.uv(flat.points[i]) });
        }
    }
    let back = count as u32;
    mesh.triangles.extend_from_slice(&flat.triangles);
    mesh.triangles.extend(flat.triangles.iter().map(|[a, b, c]| [back + a, back + c, back + b]));
    mesh
}

/// Front and back face of a blade whose faces meet at the margin: they have its points in common and normals of their own.
fn meeting(flat: &FlatBlade, scratch: &BladeScratch, half: f32) -> Mesh {
    let (count, margin) = (flat.points.len(), flat.margin);
    let of_points = || scratch.middle.iter().zip(&scratch.normals);
    let aside = ASIDE * half;
    let front = of_points().enumerate().map(|(i, (p, n))| *p + *n * if i < margin { aside } else { half });
    let back = of_points().skip(margin).map(|(p, n)| *p - *n * half);
    let uv = BladeUv::of(flat);
    let vertex = |i: usize, sign: f32| {
        let point = if sign < 0.0 && i >= margin { i + count - margin } else { i };
        Vertex { point: point as u32, normal: scratch.normals[i] * sign, uv: uv.uv(flat.points[i]) }
    };
    let first = count as u32;
    let turned = |[a, b, c]: &[u32; 3]| [first + *a, first + *c, first + *b];
    Mesh {
        points: front.chain(back).collect(),
        vertices: [1.0, -1.0]
            .into_iter()
            .flat_map(|sign| (0..count).map(move |i| (i, sign)))
            .map(|(i, sign)| vertex(i, sign))
            .collect(),
        triangles: flat.triangles.iter().copied().chain(flat.triangles.iter().map(turned)).collect(),
        breaks: Vec::new(),
    }
}

/// Closes the gap between the margins of front and back.
fn add_rim(flat: &FlatBlade, scratch: &BladeScratch, mesh: &mut Mesh) {
    let n = flat.margin;
    let back = flat.points.len() as u32;
    let rim = mesh.vertices.len() as u32;
    let outward = |i: usize, j: usize| {
        let edge = scratch.middle[j] - scratch.middle[i];
        unit_or(edge.cross(scratch.normals[i] + scratch.normals[j]), Vec3::ZERO)
    };
    let mut before = outward(n - 1, 0);
    for i in 0..n {
        let next = if i + 1 == n { 0 } else { i + 1 };
        let after = outward(i, next);
        let normal = unit_or(before + after, scratch.normals[i]);
        before = after;
        for side in [0, back] {
            let point = side + i as u32;
            mesh.vertices.push(Vertex { point, normal, uv: mesh.vertices[i].uv });
        }
        let (front_i, front_next) = (rim + 2 * i as u32, rim + 2 * next as u32);
        mesh.triangles.push([front_next, front_i, front_i + 1]);
        mesh.triangles.push([front_next, front_i + 1, front_next + 1]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::flat::{FlatScratch, flatten};
    use super::*;
    use crate::plant::{Blade, BladeForm, Detail, Template};
    use std::sync::Arc;

    const STILL: BladeForm = BladeForm {
        twist: 0.0,
        bend_quartic: 0.0,
        bend_quadratic: 0.0,
        cup: 0.0,
        fold: 0.0,
        ruffle: 0.0,
        ruffle_waves: 0.0,
        thickness: 0.01,
    };

    fn oval(rest: RestSurface, form: BladeForm) -> Blade<Arc<Template>> {
        let point = |k: usize| Vec2::from_angle(k as f32 * 0.1047) * Vec2::new(0.2, 0.5) + Vec2::Y * 0.5;
        let template = Template::new((0..60).map(point).collect(), Vec::new(), 1.0, Detail::Full);
        let base = Vec3::new(0.3, 0.2, -0.1);
        Blade { template: Arc::new(template), base, u: Vec3::X, v: Vec3::Y, rest, form }
    }

    fn built(blade: &Blade<Arc<Template>>) -> (FlatBlade, Mesh) {
        let params = BladeMeshParams::default();
        let flat = flatten(&blade.template, None, &params, &mut FlatScratch::default()).unwrap();
        let mesh = mesh(&blade.resolved(), &flat, &params, &mut BladeScratch::default()).unwrap();
        mesh.check_invariants().unwrap();
        (flat, mesh)
    }

    #[test]
    fn a_still_blade_shows_its_outline_from_the_front() {
        let blade = oval(RestSurface::Plane, STILL);
        let (flat, mesh) = built(&blade);
        for (point, drawn) in mesh.points.iter().zip(&flat.points) {
            assert!((point.truncate() - blade.base.truncate()).distance(*drawn) < 1e-6);
        }
    }

    #[test]
    fn faces_stand_one_thickness_apart_and_closer_at_the_margin() {
        let (flat, mesh) = built(&oval(RestSurface::Plane, STILL));
        let apart = |i: usize| mesh.points[i].distance(mesh.points[i + flat.points.len()]);
        assert!((apart(0) - 0.005).abs() < 1e-5);
        assert!((apart(flat.margin) - 0.01).abs() < 1e-5);
    }

    #[test]
    fn the_picture_fits_from_base_to_tip() {
        let (_, mesh) = built(&oval(RestSurface::Plane, STILL));
        let uvs = || mesh.vertices.iter().map(|v| v.uv);
        let (lo, hi) = uvs().fold((Vec2::ONE, Vec2::ZERO), |(lo, hi), uv| (lo.min(uv), hi.max(uv)));
        assert!(lo.length() < 0.01 && (hi - Vec2::ONE).length() < 0.01);
    }

    #[test]
    fn petals_hollow_away_from_the_flowers_axis() {
        let hollow = BladeForm { cup: 0.4, ..STILL };
        for axis in [Vec3::new(0.0, 0.5, 0.866), Vec3::new(0.0, 0.9, -0.436)] {
            let apex = Vec3::new(0.3, 0.2, -0.1);
            let cone = Cone { apex, axis: axis.normalize(), opening_rad: 0.8, height: 1.0 };
            let rest = RestSurface::Cone { cone, hint: -0.1, sight: Vec3::Z };
            let ((flat, still), (_, bent)) = (built(&oval(rest.clone(), STILL)), built(&oval(rest, hollow)));
            let to_axis = |p: Vec3| (p - apex).reject_from_normalized(cone.axis).length();
            let middle =
                (0..flat.points.len()).find(|i| flat.points[*i].distance(Vec2::Y * 0.5) < 0.01).unwrap();
            assert!(to_axis(bent.points[middle]) > to_axis(still.points[middle]) + 0.01, "axis {axis}");
        }
    }

    #[test]
    fn what_cannot_be_seen_has_no_mesh() {
        let params = BladeMeshParams::default();
        let blade = oval(RestSurface::Plane, STILL);
        let flat = flatten(&blade.template, None, &params, &mut FlatScratch::default()).unwrap();
        for spoilt in [
            Blade { u: Vec3::ZERO, ..blade.clone() },
            Blade { u: Vec3::Y, ..blade.clone() },
            Blade { base: Vec3::X * 1e6, ..blade.clone() },
        ] {
            assert!(mesh(&spoilt.resolved(), &flat, &params, &mut BladeScratch::default()).is_none());
        }
    }
}
