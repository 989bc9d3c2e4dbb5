//! Stalks of stamens, pistils and thorns.
//!
//! A flower has dozens of them, so that they are never parts of their own: at least those of one flower are gathered, the
//! stalks (`stamens_3`) apart from their heads (`anthers_3`), which are copies of few `shapes`.

use super::fineness::{Fineness, SolidParams};
use super::mesh::Mesh;

use super::spine;
use super::tube::{self, Tiling, TubeLook, TubeScratch};
use crate::plant::Shape;
use glam::{Vec2, Vec3};

/// Stalks are thin: they may leave their skeleton by half their radius, and end round.
const TOLERANCE: f32 = 0.5;
const TIP: f32 = 0.8;
/// How far below its head a stalk ends, in its radii: nobody sees it, and one mesh of both has no point that they share.
const GAP: f32 = 0.1;
/// Share of its last piece by which a stalk is shortened for its head at most.
const MOST_BACK: f32 = 0.9;

/// Appends the stalks of filaments to a mesh, those of very many straight from end to end; shapes that are no filaments add nothing.
pub(super) fn append<'a>(
    mesh: &mut Mesh,
    shapes: impl Iterator<Item = (&'a Shape, Fineness)>,
    params: &SolidParams,
    scratch: &mut TubeScratch,
) {
    let first = mesh.triangles.len();
    let detail = spine::Detail { of_radius: TOLERANCE, metres: (0.0, f32::INFINITY) };
    let look = TubeLook { sides: params.filament_sides.max(3), tiling: Tiling::Whole, tip: TIP, detail };
    for (shape, fineness) in shapes {
        let Shape::Filament { points, radius, head } = shape else { continue };
        let [stalk @ .., end] = points.as_slice() else { continue };
        let stalk = if fineness == Fineness::Quarter { &stalk[..stalk.len().min(1)] } else { stalk };
        let end = below_head(stalk, *end, *radius, *head);
        tube::append(mesh, stalk.iter().chain([&end]).map(|p| (*p, *radius)), look, scratch);
    }
    // Stalks may bend back on themselves.
    mesh.split_disagreeing_corners_in(first..mesh.triangles.len());
}

/// Where a stalk ends: its round end is just below the head, so that neither passes through the other.
fn below_head(stalk: &[Vec3], end: Vec3, radius: f32, head: Vec2) -> Vec3 {
    let Some(before) = stalk.last() else { return end };
    if head.min_element() <= 0.0 {
        return end;
    }
    let most = MOST_BACK * before.distance(end);
    end + (*before - end).clamp_length_max((head.y + (TIP + GAP) * radius).min(most))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stalk_and_its_head_share_no_point() {
        let (radius, head) = (0.125, Vec2::new(0.25, 0.5));
        let end = below_head(&[Vec3::ZERO], Vec3::Y, radius, head);
        let (top, underside) = (end.y + TIP * radius, 1.0 - head.y);
        assert!(top < underside && top > underside - 0.2 * radius, "{top} below {underside}");
    }
}
