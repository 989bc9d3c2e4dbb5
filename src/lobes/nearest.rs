//! The point of a surface that is nearest to another, found in a tree of its faces.

use super::surface::Surface;
use glam::Vec3;
use rstar::{AABB, PointDistance, RTree, RTreeObject};

/// A surface that can be asked.
pub(super) struct Nearest {
    tree: RTree<Face>,
}

/// A face in the tree.
struct Face([Vec3; 3]);

impl RTreeObject for Face {
    type Envelope = AABB<[f32; 3]>;

    fn envelope(&self) -> Self::Envelope {
        let [a, b, c] = self.0;
        AABB::from_corners(a.min(b).min(c).to_array(), a.max(b).max(c).to_array())
    }
}

impl PointDistance for Face {
    fn distance_2(&self, point: &[f32; 3]) -> f32 {
        let p = Vec3::from_array(*point);
        on_face(self.0, p).distance_squared(p)
    }
}

impl Nearest {
    /// The faces of a surface.
    pub(super) fn new(surface: &Surface) -> Self {
        let faces = surface.triangles.iter().map(|t| Face(surface.corners(*t))).collect();
        Self { tree: RTree::bulk_load(faces) }
    }

    /// The nearest point of the surface; the point itself where there is no surface.
    pub(super) fn point(&self, p: Vec3) -> Vec3 {
        self.tree.nearest_neighbor(p.to_array()).map_or(p, |face| on_face(face.0, p))
    }
}

/// The point of a triangle that is nearest to another: on its plane, an edge or a corner, by the signs of the barycentric coordinates.
pub(super) fn on_face([a, b, c]: [Vec3; 3], p: Vec3) -> Vec3 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    let (to_c, to_b) = (d4 - d3, d5 - d6);
    if va <= 0.0 && to_c >= 0.0 && to_b >= 0.0 {
        return b + (c - b) * (to_c / (to_c + to_b));
    }
    let sum = va + vb + vc;
    if sum == 0.0 { a } else { a + ab * (vb / sum) + ac * (vc / sum) }
}

#[cfg(test)]
mod tests {
    use super::super::surface::tests::tetrahedron;
    use super::*;

    #[test]
    fn the_nearest_point_is_on_a_plane_an_edge_or_a_corner() {
        let face = [Vec3::ZERO, Vec3::X, Vec3::Y];
        assert_eq!(on_face(face, Vec3::new(0.2, 0.3, 5.0)), Vec3::new(0.2, 0.3, 0.0));
        assert_eq!(on_face(face, Vec3::new(0.4, -2.0, 1.0)), Vec3::new(0.4, 0.0, 0.0));
        assert_eq!(on_face(face, Vec3::new(3.0, -1.0, 0.0)), Vec3::X);
        assert!(on_face(face, Vec3::new(1.0, 1.0, 1.0)).distance(Vec3::new(0.5, 0.5, 0.0)) < 1e-6);
    }

    #[test]
    fn a_surface_is_asked_as_a_whole() {
        let nearest = Nearest::new(&tetrahedron());
        assert!(nearest.point(Vec3::new(0.2, 0.1, -3.0)).distance(Vec3::new(0.2, 0.1, 0.0)) < 1e-6);
        assert!(Nearest::new(&Surface::default()).point(Vec3::ONE) == Vec3::ONE);
    }
}
