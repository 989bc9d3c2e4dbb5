//! What the artist changed of a lobe's surface, laid on again whenever the strokes change.
//!
//! A change is kept for each vertex of the remeshed surface as a shift along two tangents and the normal there. The
//! tangents follow from the normal alone, so that a surface that comes out a little differently carries the change along as it
//! turns.
//!
//! Source: 001 §5.2.2 edits surfaces after strokes; that strokes are edited again after the surface is not considered there.
//! Limits: offsets belong to numbers of vertices. Where an edited stroke changes how many there are, or their order, offsets
//! land elsewhere, those beyond the last are left out, and a remark says how many.

use super::lobe::Offset;
use super::surface::Surface;
use glam::{Mat3, Vec3};

/// Axes of the surface at a point: two tangents and the normal.
pub fn frame(normal: Vec3) -> Mat3 {
    let (one, other) = normal.any_orthonormal_pair();
    Mat3::from_cols(one, other, normal)
}

/// The offsets that bring the vertices of a surface to other places; those that stay have none.
pub fn offsets(surface: &Surface, moved: &[Vec3]) -> Vec<Offset> {
    let frames = surface.normals();
    let vertices = surface.points.iter().zip(moved).zip(&frames).zip(0..);
    let changed = vertices.filter(|(((from, to), _), _)| from != to);
    changed
        .map(|(((from, to), normal), vertex)| Offset { vertex, by: frame(*normal).transpose() * (to - from) })
        .collect()
}

/// Lays offsets on; gives the number of those that have no vertex.
pub fn deform(surface: &mut Surface, offsets: &[Offset]) -> usize {
    let frames = surface.normals();
    let mut lost = 0;
    for Offset { vertex, by } in offsets {
        match (surface.points.get_mut(*vertex as usize), frames.get(*vertex as usize)) {
            (Some(p), Some(normal)) => *p += frame(*normal) * *by,
            _ => lost += 1,
        }
    }
    lost
}

#[cfg(test)]
mod tests {
    use super::super::surface::tests::tetrahedron;
    use super::*;
    use glam::Quat;

    #[test]
    fn offsets_bring_vertices_where_they_were() {
        let surface = tetrahedron();
        let mut moved = surface.points.clone();
        moved[2] += Vec3::new(0.3, -0.1, 0.2);
        let kept = offsets(&surface, &moved);
        assert_eq!(kept.len(), 1);
        let mut again = surface.clone();
        assert_eq!(deform(&mut again, &kept), 0);
        assert!(again.points.iter().zip(&moved).all(|(a, b)| a.distance(*b) < 1e-6));
        let lost = Offset { vertex: 99, by: Vec3::X };
        assert_eq!(deform(&mut again, &[lost]), 1);
    }

    #[test]
    fn what_is_along_the_normal_turns_with_the_surface() {
        let mut surface = tetrahedron();
        let out = Offset { vertex: 3, by: Vec3::Z * 0.5 };
        let turn = Quat::from_rotation_x(0.7);
        let mut turned = surface.clone();
        turned.points.iter_mut().for_each(|p| *p = turn * *p);
        deform(&mut surface, &[out]);
        deform(&mut turned, &[out]);
        assert!((turn * surface.points[3]).distance(turned.points[3]) < 1e-5);
    }
}
