//! Faces of a mesh that pass through other faces of it.
//!
//! Two faces that share an edge never count; of two that share a point the edge opposite that point must pass through the
//! other face; all others cross where an edge of one passes through the other. Candidates are faces whose boxes meet.
//!
//! Limits: where so many faces lie over each other that [`STEPS`] do not reach to compare them, there is no count; faces that
//! lie in one plane do not cross. Single precision in, double precision inside, no exact arithmetic:
//! faces that just touch may count or not.

use super::Mesh;
use crate::geom::bvh::{Bounds, overlapping_within};
use glam::DVec3;
use std::sync::atomic::{AtomicBool, Ordering};

/// Comparisons that any mesh may take, and more for each of its faces; the faces of a tree take some dozens.
pub const STEPS: (u64, u64) = (50_000_000, 500);

/// Number of faces that cross another; `None` where counting them would take more than [`STEPS`]. Faces with points that do
/// not exist or are not finite are left out.
pub fn crossing_faces(mesh: &Mesh) -> Option<usize> {
    let faces = faces(mesh);
    let boxes: Vec<Bounds> = faces.iter().map(|face| bounds(mesh, face)).collect();
    let crossing: Vec<AtomicBool> = faces.iter().map(|_| AtomicBool::new(false)).collect();
    let mark = |i: usize, j: usize| -> Option<()> {
        let both = [&crossing[i], &crossing[j]];
        // What is known of both needs no comparison.
        if !both.iter().all(|known| known.load(Ordering::Relaxed)) && cross(mesh, faces[i], faces[j]) {
            both.iter().for_each(|known| known.store(true, Ordering::Relaxed));
        }
        None
    };
    overlapping_within(STEPS.0 + STEPS.1 * faces.len() as u64, &boxes, mark)?;
    Some(crossing.into_iter().filter(|crosses| crosses.load(Ordering::Relaxed)).count())
}

/// The faces by their points.
fn faces(mesh: &Mesh) -> Vec<[u32; 3]> {
    let point = |vertex: u32| {
        let point = mesh.vertices.get(vertex as usize)?.point;
        mesh.points.get(point as usize).filter(|p| p.is_finite()).map(|_| point)
    };
    let points = |face: &[u32; 3]| Some([point(face[0])?, point(face[1])?, point(face[2])?]);
    mesh.triangles.iter().filter_map(points).collect()
}

fn bounds(mesh: &Mesh, face: &[u32; 3]) -> Bounds {
    let [a, b, c] = face.map(|p| mesh.points[p as usize]);
    (a.min(b).min(c), a.max(b).max(c))
}

/// Whether an edge of one face passes through the other.
fn cross(mesh: &Mesh, a: [u32; 3], b: [u32; 3]) -> bool {
    let shared = a.iter().filter(|p| b.contains(p)).count();
    let at = |p: u32| mesh.points[p as usize].as_dvec3();
    let pierces = |from: [u32; 3], through: [u32; 3]| {
        let corners = through.map(at);
        let edges = [[from[0], from[1]], [from[1], from[2]], [from[2], from[0]]];
        let apart = edges.iter().filter(|edge| edge.iter().all(|p| !through.contains(p)));
        apart.into_iter().any(|edge| passes(edge.map(at), corners))
    };
    shared < 2 && (pierces(a, b) || pierces(b, a))
}

/// Whether a segment passes through a triangle.
fn passes([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> bool {
    let normal = (b - a).cross(c - a);
    let (before, after) = ((p - a).dot(normal), (q - a).dot(normal));
    if before * after >= 0.0 {
        return false;
    }
    let at = p.lerp(q, before / (before - after));
    let side = |u: DVec3, v: DVec3| (v - u).cross(at - u).dot(normal);
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides.iter().all(|s| *s >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Vertex;
    use glam::{Vec2, Vec3, vec3};

    fn mesh(points: &[Vec3], triangles: &[[u32; 3]]) -> Mesh {
        let vertex = |point| Vertex { point, normal: Vec3::Y, uv: Vec2::ZERO };
        let vertices = (0..points.len() as u32).map(vertex).collect();
        Mesh { points: points.to_vec(), vertices, triangles: triangles.to_vec(), ..Mesh::default() }
    }

    /// A face in the ground, and one that stands on edge at a place along x.
    fn two(x: f32, low: f32) -> Mesh {
        let ground = [vec3(0.0, 0.0, -1.0), vec3(2.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0)];
        let upright = [vec3(x, low, 0.0), vec3(x, 1.0, -0.2), vec3(x, 1.0, 0.2)];
        mesh(&[ground, upright].concat(), &[[0, 1, 2], [3, 4, 5]])
    }

    #[test]
    fn a_face_through_another_counts_and_so_does_the_other() {
        assert_eq!(crossing_faces(&two(0.5, -0.5)), Some(2));
        assert_eq!(crossing_faces(&two(0.5, 0.1)), Some(0), "above");
        assert_eq!(crossing_faces(&two(3.0, -0.5)), Some(0), "beside");
    }

    #[test]
    fn neighbours_cross_only_where_one_folds_through_the_other() {
        let flat = [Vec3::ZERO, Vec3::X, Vec3::Z, vec3(-1.0, 0.0, -1.0), vec3(-1.0, 0.5, 0.0)];
        assert_eq!(crossing_faces(&mesh(&flat, &[[0, 1, 2], [0, 3, 4], [0, 2, 4]])), Some(0));
        let folded = [Vec3::ZERO, Vec3::X, Vec3::Z, vec3(0.4, -0.3, 0.3), vec3(0.4, 0.3, 0.3)];
        assert_eq!(crossing_faces(&mesh(&folded, &[[0, 1, 2], [0, 3, 4]])), Some(2));
    }

    #[test]
    fn broken_meshes_are_no_trouble() {
        let mut broken = two(0.5, -0.5);
        broken.triangles.push([0, 1, 99]);
        broken.points[4].x = f32::NAN;
        assert_eq!(crossing_faces(&broken), Some(0));
        assert_eq!(crossing_faces(&Mesh::default()), Some(0));
    }

    /// Faces around one edge, each through all others where `through` says so.
    fn fan(count: u32, through: f32) -> Mesh {
        let mut points = Vec::new();
        for k in 0..count {
            let (sin, cos) = (k as f32 / count as f32 * std::f32::consts::TAU).sin_cos();
            points.extend([
                vec3(-through * cos, 0.0, -through * sin),
                vec3(cos, 1.0, sin),
                vec3(cos, -1.0, sin),
            ]);
        }
        let triangles: Vec<[u32; 3]> = (0..count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        mesh(&points, &triangles)
    }

    #[test]
    fn where_too_many_faces_meet_there_is_no_count() {
        assert_eq!(crossing_faces(&fan(200, 0.5)), Some(200));
        assert_eq!(crossing_faces(&fan(100_000, 0.5)), None);
        let equal: Vec<[u32; 3]> = vec![[0, 1, 2]; 80_000];
        assert_eq!(crossing_faces(&mesh(&[Vec3::ZERO, Vec3::X, Vec3::Y], &equal)), None);
    }
}
