//! Tangents of a mesh, which normal maps are seen in.
//!
//! The tangent of a vertex is the direction in which u grows on the surface around it, square to its normal: the mean over its triangles, each
//! by its area. The fourth number is 1 where normal, tangent and the direction of growing v are right-handed, and −1 where the picture is mirrored,
//! so that `cross(normal, tangent) × w` points to the picture's top (glTF 2.0, 3.7.2.1).
//!
//! Limits: a vertex on both sides of a mirrored seam has the mean of both.

use crate::model::{Mesh, Vertex};
use glam::{Vec3, Vec4};

/// One tangent for each vertex, of unit length; any square to the normal where the picture has no direction.
pub(super) fn tangents(mesh: &Mesh) -> Vec<Vec4> {
    let mut growing = vec![[Vec3::ZERO; 2]; mesh.vertices.len()];
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|vertex| &mesh.vertices[vertex as usize]);
        let [p, q, r] = [a, b, c].map(|vertex| mesh.points[vertex.point as usize]);
        let ((right, up), (first, second)) = ((q - p, r - p), (b.uv - a.uv, c.uv - a.uv));
        let side = first.perp_dot(second).signum();
        let of_u = side * (right * second.y - up * first.y);
        let of_v = side * (up * first.x - right * second.x);
        for vertex in triangle {
            let [u, v] = &mut growing[*vertex as usize];
            (*u, *v) = (*u + of_u, *v + of_v);
        }
    }
    let tangent = |(vertex, [u, v]): (&Vertex, [Vec3; 2])| {
        let normal = vertex.normal;
        let along = u.reject_from(normal).try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
        let is_mirrored = normal.cross(along).dot(v) < 0.0;
        along.extend(if is_mirrored { -1.0 } else { 1.0 })
    };
    mesh.vertices.iter().zip(growing).map(tangent).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    /// A square in the plane z = 0, seen from +z, whose picture lies as `uv` says.
    fn square(uv: impl Fn(Vec2) -> Vec2) -> Mesh {
        let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        Mesh {
            points: corners.iter().map(|p| p.extend(0.0)).collect(),
            vertices: (0..)
                .zip(corners)
                .map(|(point, p)| Vertex { point, normal: Vec3::Z, uv: uv(p) })
                .collect(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Mesh::default()
        }
    }

    #[test]
    fn tangents_point_to_where_u_grows() {
        let of = |uv: fn(Vec2) -> Vec2| tangents(&square(uv));
        assert!(of(|p| p).iter().all(|t| t.distance(Vec3::X.extend(1.0)) < 1e-5));
        let turned = of(|p| Vec2::new(p.y, -p.x));
        assert!(turned.iter().all(|t| t.distance(Vec3::Y.extend(1.0)) < 1e-5), "{turned:?}");
        let mirrored = of(|p| Vec2::new(-p.x, p.y));
        assert!(mirrored.iter().all(|t| t.distance(Vec3::NEG_X.extend(-1.0)) < 1e-5), "{mirrored:?}");
    }

    #[test]
    fn a_picture_without_direction_gives_unit_vectors_all_the_same() {
        for tangent in tangents(&square(|_| Vec2::ZERO)) {
            let along = tangent.truncate();
            assert!((along.length() - 1.0).abs() < 1e-5 && along.dot(Vec3::Z).abs() < 1e-5);
            assert!(tangent.w.abs() == 1.0);
        }
    }
}
