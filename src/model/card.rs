//! A card: a rectangle with a part of a picture, closed with four triangles.
//!
//! Its front is folded along one diagonal and its back along the other, so that it is a flat tetrahedron: closed and manifold as
//! everything else, without a rim. Normals lean outward from its middle, and light goes over it as over something round. Those of a
//! whole plant's pictures, which cross, lean so far outward and up that both have much the same light.
//!
//! Limits: the picture is seen from behind as through glass.

use super::mesh::{Mesh, Vertex};
use super::shapes::CopyShape;
use glam::{Vec2, Vec3};

/// Triangles of a card.
pub(super) const TRIANGLES: u64 = 4;
/// How far each corner lies before or behind the plane, share of the height.
const HALF: f32 = 0.004;
/// How far normals lean outward at the corners: tangent of the angle.
const LEAN: f32 = 0.7;
/// The same for a card that shows a whole plant: outward at the sides, and upward at the lower and the upper edge, of lengths
/// beside which how far normals point forward is `FORWARD`.
const WHOLE_LEAN: f32 = 0.8;
const UPWARD: [f32; 2] = [0.3, 1.2];
const FORWARD: f32 = 0.35;
/// Corners from the left lower one counter-clockwise, seen from the front, and on which side of the plane each lies.
const CORNERS: [(Vec2, f32); 4] = [
    (Vec2::new(-0.5, 0.0), HALF),
    (Vec2::new(0.5, 0.0), -HALF),
    (Vec2::new(0.5, 1.0), HALF),
    (Vec2::new(-0.5, 1.0), -HALF),
];

/// The shape of all cards with this window: width and height 1, the middle of the lower edge at the origin. A window is the left
/// lower and the right upper corner of a part of the picture.
pub(super) fn shape([low, high]: [Vec2; 2], is_whole: bool) -> CopyShape {
    let vertex = |(i, (at, _)): (usize, &(Vec2, f32)), side: f32| Vertex {
        point: i as u32,
        normal: normal(*at, side, is_whole),
        uv: low + (high - low) * (*at + Vec2::new(0.5, 0.0)),
    };
    let face = |side: f32| CORNERS.iter().enumerate().map(move |corner| vertex(corner, side));
    let mesh = Mesh {
        points: CORNERS.iter().map(|(at, depth)| at.extend(*depth)).collect::<Vec<Vec3>>(),
        vertices: face(1.0).chain(face(-1.0)).collect(),
        triangles: vec![[0, 1, 2], [0, 2, 3], [4, 7, 5], [5, 7, 6]],
        breaks: Vec::new(),
    };
    CopyShape::sheet(mesh, 1.0, HALF)
}

/// The normal at a corner, of the front or of the back, whose `side` is -1.
fn normal(at: Vec2, side: f32, is_whole: bool) -> Vec3 {
    let leaning = if is_whole {
        let [low, high] = UPWARD;
        Vec3::new(2.0 * WHOLE_LEAN * at.x, low + (high - low) * at.y, FORWARD * side)
    } else {
        ((at - Vec2::new(0.0, 0.5)) * 2.0 * LEAN).extend(side)
    };
    leaning.normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_card_is_closed_and_shows_its_window() {
        let window = [Vec2::new(0.25, 0.5), Vec2::new(0.5, 1.0)];
        let mesh = shape(window, false).mesh;
        mesh.check_invariants().unwrap();
        assert_eq!(mesh.triangles.len() as u64, TRIANGLES);
        let (low, high) = (mesh.vertices[0].uv, mesh.vertices[2].uv);
        assert_eq!([low, high], window);
    }
}
