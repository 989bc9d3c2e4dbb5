//! Faces of a mesh that pass through other faces of it: how many there are.
//!
//! What counts as crossing, and the limits of it, are those of [`crate::geom::crossing`].

use super::Mesh;
use crate::geom::crossing::crossing;

/// Number of faces that cross another; `None` where counting them would take too many steps. Faces with points that do not
/// exist or are not finite are left out.
pub fn crossing_faces(mesh: &Mesh) -> Option<usize> {
    Some(crossing(&mesh.points, &faces(mesh))?.into_iter().filter(|crosses| *crosses).count())
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
