//! Stamens, pistils and thorns: threads with swollen ends.
//!
//! A flower has dozens of them, so all of one flower's threads that look alike are one part (`stamens_3`) and their
//! heads another (`anthers_3`), or the same part if they share a material.

use super::mesh::Mesh;
use super::solids::{Ellipsoid, SolidParams, Stand};
use super::spine;
use super::tube::{self, Picture, TubeLook, TubeScratch};
use crate::plant::{Organ, Shape};
use glam::Vec3;

/// Threads are thin: they may leave their skeleton by half their radius, and end round.
const TOLERANCE: f32 = 0.5;
const TIP: f32 = 0.8;

/// What of a filament goes into a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Piece {
    /// The thread.
    Thread,
    /// The swollen end.
    Head,
}

/// The mesh of the given pieces of organs; those that are no filaments add nothing.
pub(super) fn mesh<'a>(
    pieces: impl Iterator<Item = (&'a Organ, Piece)>,
    params: &SolidParams,
    scratch: &mut TubeScratch,
) -> Mesh {
    let mut mesh = Mesh::default();
    let mut shaped: Option<Ellipsoid> = None;
    let mut has_threads = false;
    for (organ, piece) in pieces {
        let Shape::Filament { points, radius, head, .. } = &organ.shape else { continue };
        match piece {
            Piece::Thread => {
                let detail = spine::Detail { of_radius: TOLERANCE, metres: (0.0, f32::INFINITY) };
                let look = TubeLook {
                    sides: params.filament_sides.max(3),
                    picture: Picture::Whole,
                    tip: TIP,
                    detail,
                };
                has_threads = true;
                tube::append(&mut mesh, points.iter().map(|p| (*p, *radius)), look, scratch);
            }
            Piece::Head => {
                let [.., before, end] = points[..] else { continue };
                let axis = (end - before).try_normalize().unwrap_or(Vec3::Y);
                // The heads of one flower are mostly equal.
                let ellipsoid = match shaped.take() {
                    Some(same) if same.size() == *head => same,
                    _ => Ellipsoid::new(*head, params),
                };
                shaped.insert(ellipsoid).append(&mut mesh, Stand { base: end, axis });
            }
        }
    }
    // Heads bulge everywhere; threads may bend back on themselves.
    if has_threads {
        mesh.split_disagreeing_corners();
    }
    mesh
}
