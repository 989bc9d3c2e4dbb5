//! Faces that pass through other faces of the same surface.
//!
//! Two faces that share an edge never count; of two that share a point the edge opposite that point must pass through the
//! other face; all others cross where an edge of one passes through the other. Candidates are faces whose boxes meet.
//!
//! Limits: where so many faces lie over each other that [`STEPS`] do not reach to compare them, there is no answer; faces that
//! lie in one plane do not cross. Single precision in, double precision inside, no exact arithmetic:
//! faces that just touch may count or not.

use super::bvh::{Bounds, overlapping_within};
use glam::{DVec3, Vec3};
use std::sync::atomic::{AtomicBool, Ordering};

/// Comparisons that any surface may take, and more for each of its faces; the faces of a tree take some dozens.
pub const STEPS: (u64, u64) = (50_000_000, 500);

/// Which faces cross another; `None` where finding out would take more than [`STEPS`]. All points of all faces exist and are
/// finite.
pub fn crossing(points: &[Vec3], faces: &[[u32; 3]]) -> Option<Vec<bool>> {
    let boxes: Vec<Bounds> = faces.iter().map(|face| bounds(points, face)).collect();
    let crossing: Vec<AtomicBool> = faces.iter().map(|_| AtomicBool::new(false)).collect();
    let mark = |i: usize, j: usize| -> Option<()> {
        let both = [&crossing[i], &crossing[j]];
        // What is known of both needs no comparison.
        if !both.iter().all(|known| known.load(Ordering::Relaxed)) && cross(points, faces[i], faces[j]) {
            both.iter().for_each(|known| known.store(true, Ordering::Relaxed));
        }
        None
    };
    overlapping_within(STEPS.0 + STEPS.1 * faces.len() as u64, &boxes, mark)?;
    Some(crossing.into_iter().map(AtomicBool::into_inner).collect())
}

fn bounds(points: &[Vec3], face: &[u32; 3]) -> Bounds {
    let [a, b, c] = face.map(|p| points[p as usize]);
    (a.min(b).min(c), a.max(b).max(c))
}

/// Whether an edge of one face passes through the other.
fn cross(points: &[Vec3], a: [u32; 3], b: [u32; 3]) -> bool {
    let shared = a.iter().filter(|p| b.contains(p)).count();
    let at = |p: u32| points[p as usize].as_dvec3();
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
