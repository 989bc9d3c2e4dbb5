//! Thorns to closed meshes: a cone on an elliptic foot, scaled differently along and across the stem (004 §3.2.5, fig. 7), and
//! bent toward its tip.

use super::mesh::{Mesh, Vertex};
use crate::plant::Shape;
use glam::Vec2;
use std::f32::consts::TAU;

/// Corners of the foot.
const SIDES: u32 = 6;
/// Where the ring between foot and tip lies, and how wide it is: shares of the length and of the foot.
const RING: (f32, f32) = (0.45, 0.42);
/// Triangles of a spike.
pub(super) const TRIANGLES: u64 = 4 * SIDES as u64;

/// The mesh of a spike; `None` of any other shape, or of a spike without a body.
pub(super) fn mesh(shape: &Shape) -> Option<Mesh> {
    let &Shape::Spike { base, tip, side, foot, hook } = shape else { return None };
    let axis = (tip - hook - base).try_normalize()?;
    let side = side.reject_from_normalized(axis).try_normalize()?;
    let (other, length) = (axis.cross(side), (tip - hook - base).length());
    // On the way from foot to tip it bends as the square of the height.
    let at = |height: f32, across: Vec2| {
        base + axis * (height * length) + hook * (height * height) + side * across.x + other * across.y
    };
    let around = |j: u32| Vec2::from_angle(TAU * (j % SIDES) as f32 / SIDES as f32);
    let mut mesh = Mesh::default();
    mesh.points.push(base);
    for (height, wide) in [(0.0, 1.0), RING] {
        mesh.points.extend((0..SIDES).map(|j| at(height, around(j) * foot * wide)));
    }
    mesh.points.push(tip);
    let outward = |j: f32| {
        let c = Vec2::from_angle(TAU * j / SIDES as f32) / foot;
        (side * c.x + other * c.y + axis / length).normalize_or(axis)
    };
    // Vertices: the underside, two rings with their seam twice, the tip once for each side.
    mesh.vertices.push(Vertex { point: 0, normal: -axis, uv: Vec2::ZERO });
    let under = 1;
    mesh.vertices.extend((0..SIDES).map(|j| Vertex { point: 1 + j, normal: -axis, uv: Vec2::ZERO }));
    let rings = mesh.vertices.len() as u32;
    for (ring, v) in [(0, 0.0), (1, RING.0)] {
        mesh.vertices.extend((0..=SIDES).map(|j| Vertex {
            point: 1 + ring * SIDES + j % SIDES,
            normal: outward(j as f32),
            uv: Vec2::new(j as f32 / SIDES as f32, v),
        }));
    }
    let top = mesh.vertices.len() as u32;
    mesh.vertices.extend((0..SIDES).map(|j| Vertex {
        point: 1 + 2 * SIDES,
        normal: outward(j as f32 + 0.5),
        uv: Vec2::new((j as f32 + 0.5) / SIDES as f32, 1.0),
    }));
    for j in 0..SIDES {
        let (low, high) = (rings + j, rings + SIDES + 1 + j);
        mesh.triangles.push([0, under + (j + 1) % SIDES, under + j]);
        mesh.triangles.push([low, low + 1, high + 1]);
        mesh.triangles.push([low, high + 1, high]);
        mesh.triangles.push([high, high + 1, top + j]);
    }
    mesh.split_disagreeing_corners();
    Some(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn thorn(hook: Vec3) -> Mesh {
        let (base, tip) = (Vec3::new(0.1, 0.2, 0.3), Vec3::new(0.4, 0.3, 0.3));
        mesh(&Shape::Spike { base, tip, side: Vec3::Y, foot: Vec2::new(0.08, 0.04), hook }).unwrap()
    }

    #[test]
    fn it_is_closed_faces_outward_and_has_as_many_faces_as_counted() {
        for hook in [Vec3::ZERO, Vec3::new(0.02, -0.08, 0.0)] {
            let mesh = thorn(hook);
            mesh.check_invariants().unwrap();
            assert_eq!(mesh.triangles.len() as u64, TRIANGLES);
            let volume: f32 =
                mesh.triangles.iter().map(|t| mesh.corners(*t)).map(|[a, b, c]| a.dot(b.cross(c))).sum();
            assert!(volume > 0.0);
        }
    }

    #[test]
    fn its_foot_is_an_ellipse_and_its_tip_where_it_should_be() {
        let mesh = thorn(Vec3::ZERO);
        let base = Vec3::new(0.1, 0.2, 0.3);
        let reach = mesh.points[1..=6].iter().map(|p| p.distance(base));
        let (low, high) = reach.fold((1.0f32, 0.0f32), |(low, high), r| (low.min(r), high.max(r)));
        assert!((high - 0.08).abs() < 1e-4 && low < 0.06, "{low} {high}");
        assert_eq!(mesh.points[13], Vec3::new(0.4, 0.3, 0.3));
    }

    #[test]
    fn without_a_body_there_is_no_mesh() {
        let shape =
            Shape::Spike { base: Vec3::X, tip: Vec3::X, side: Vec3::Y, foot: Vec2::ONE, hook: Vec3::ZERO };
        assert!(mesh(&shape).is_none());
    }
}
