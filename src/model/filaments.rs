//! Stamens, pistils and thorns: threads with swollen ends.
//!
//! A flower has dozens of them, so that they are never parts of their own: at least those of one flower are gathered, the
//! threads (`stamens_3`) apart from their heads (`anthers_3`).

use super::mesh::Mesh;
use super::piece::Piece;
use super::solids::{Ellipsoid, SolidParams, Stand};
use super::spine;
use super::tube::{self, Picture, TubeLook, TubeScratch};
use crate::plant::Shape;
use glam::Vec3;

/// Threads are thin: they may leave their skeleton by half their radius, and end round.
const TOLERANCE: f32 = 0.5;
const TIP: f32 = 0.8;

/// Appends pieces of filaments to a mesh; shapes that are no filaments add nothing.
pub(super) fn append<'a>(
    mesh: &mut Mesh,
    pieces: impl Iterator<Item = (&'a Shape, Piece)>,
    params: &SolidParams,
    scratch: &mut TubeScratch,
) {
    let first = mesh.triangles.len();
    let mut shaped: Option<Ellipsoid> = None;
    let mut has_threads = false;
    for (shape, piece) in pieces {
        let Shape::Filament { points, radius, head, .. } = shape else { continue };
        match piece {
            Piece::Body => {
                let detail = spine::Detail { of_radius: TOLERANCE, metres: (0.0, f32::INFINITY) };
                let look = TubeLook {
                    sides: params.filament_sides.max(3),
                    picture: Picture::Whole,
                    tip: TIP,
                    detail,
                };
                has_threads = true;
                tube::append(mesh, points.iter().map(|p| (*p, *radius)), look, scratch);
            }
            Piece::Head => {
                let [.., before, end] = points[..] else { continue };
                let axis = (end - before).try_normalize().unwrap_or(Vec3::Y);
                // The heads of one flower are mostly equal.
                let ellipsoid = match shaped.take() {
                    Some(same) if same.size() == *head => same,
                    _ => Ellipsoid::new(*head, params),
                };
                shaped.insert(ellipsoid).append(mesh, Stand { base: end, axis });
            }
        }
    }
    // Heads bulge everywhere; threads may bend back on themselves.
    if has_threads {
        mesh.split_disagreeing_corners_from(first);
    }
}
