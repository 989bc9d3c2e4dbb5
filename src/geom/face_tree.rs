//! Questions to the faces of a surface: which point of them is nearest, and where a straight way passes through one.
//!
//! The faces stand in an R-tree, so a question looks at few of them. Single precision, no exact arithmetic: a way that just
//! touches an edge may pass or not.

use super::ray::Ray;
use glam::Vec3;
use rstar::{AABB, PointDistance, RTree, RTreeObject};

/// Faces that can be asked.
#[derive(Clone, Debug)]
pub struct FaceTree {
    tree: RTree<Face>,
}

/// A face in the tree.
#[derive(Clone, Copy, Debug)]
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

impl FaceTree {
    /// A tree of faces, which may be none.
    pub fn new(faces: impl Iterator<Item = [Vec3; 3]>) -> Self {
        Self { tree: RTree::bulk_load(faces.map(Face).collect()) }
    }

    /// The point of the faces nearest to another, and the face on which it lies; nothing where there is no face.
    pub fn nearest(&self, p: Vec3) -> Option<(Vec3, [Vec3; 3])> {
        self.tree.nearest_neighbor(p.to_array()).map(|face| (on_face(face.0, p), face.0))
    }

    /// Whether the straight way between two points passes through a face.
    pub fn crosses(&self, from: Vec3, to: Vec3) -> bool {
        let Some(direction) = (to - from).try_normalize() else { return false };
        let (ray, length) = (Ray { origin: from, direction }, from.distance(to));
        let beside = AABB::from_corners(from.min(to).to_array(), from.max(to).to_array());
        let mut faces = self.tree.locate_in_envelope_intersecting(beside);
        faces.any(|face| ray.meets(face.0).is_some_and(|at| at <= length))
    }
}

/// The point of a triangle that is nearest to another: on its plane, an edge or a corner, by the signs of the barycentric coordinates.
fn on_face([a, b, c]: [Vec3; 3], p: Vec3) -> Vec3 {
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
    fn faces_are_asked_together() {
        let corner = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(|face| face.map(|k: usize| corner[k]));
        let tree = FaceTree::new(faces.into_iter());
        let (at, face) = tree.nearest(Vec3::new(0.2, 0.1, -3.0)).unwrap();
        assert!(at.distance(Vec3::new(0.2, 0.1, 0.0)) < 1e-6 && face == faces[0]);
        let inside = Vec3::splat(0.2);
        assert!(tree.crosses(inside, Vec3::ONE) && tree.crosses(Vec3::ONE, inside));
        assert!(!tree.crosses(inside, Vec3::splat(0.25)) && !tree.crosses(inside, inside));
        assert!(!tree.crosses(Vec3::new(-1.0, 0.0, -0.5), Vec3::new(2.0, 0.0, -0.5)), "it passes by");
        let none = FaceTree::new(std::iter::empty());
        assert!(none.nearest(Vec3::ONE).is_none() && !none.crosses(Vec3::ZERO, Vec3::ONE));
    }
}
