//! The strip of faces between the rim of a window and the first ring of the branch that comes out of it.
//!
//! Both are closed rows of points in the order of their turn, the first of each upward. Of all ways to join them by
//! triangles the one is taken whose edges across have the least squared length altogether, those counting more that lead
//! from one turn to another: found by dynamic programming over the pairs of points, of which there are a few dozen.
//!
//! Limits: a strip may still cut into the bark beside a window that had to be cut elsewhere than under its branch.

use super::mesh::{Mesh, Vertex};
use super::spine::Ring;
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;

/// How much more an edge counts for leading to another turn: for half a turn three times as much.
const ASTRAY: f32 = 8.0;

/// The first ring of a branch in a mesh.
pub(super) struct Around {
    /// Its first vertex; the others follow, and after them the first point's second vertex.
    pub(super) first_vertex: u32,
    pub(super) sides: usize,
    pub(super) ring: Ring,
}

/// Memory that is used again for every strip.
#[derive(Default)]
pub(super) struct StripScratch {
    /// For each pair of a rim's and a ring's point the cost of all edges up to the one between them, and whether the
    /// edge before is the one back along the rim.
    best: Vec<(f32, bool)>,
}

/// Joins a rim, given by its points and their turns, to a ring; bark repeats so often around it.
pub(super) fn join(
    mesh: &mut Mesh,
    rim: &[(u32, f32)],
    around: &Around,
    repeats: f32,
    scratch: &mut StripScratch,
) {
    let first = mesh.vertices.len() as u32;
    push_vertices(mesh, rim, around, repeats);
    weigh(mesh, (first, rim), around, &mut scratch.best);
    let (mut i, mut j) = (rim.len(), around.sides);
    let from = mesh.triangles.len();
    while i + j > 0 {
        let (low, high) = (first + i as u32, around.first_vertex + j as u32);
        if scratch.best[i * (around.sides + 1) + j].1 {
            mesh.triangles.push([low - 1, low, high]);
            i -= 1;
        } else {
            mesh.triangles.push([low, high, high - 1]);
            j -= 1;
        }
    }
    mesh.triangles[from..].reverse();
}

/// Vertices of the rim in the branch's own picture; the first point has one at either end.
fn push_vertices(mesh: &mut Mesh, rim: &[(u32, f32)], around: &Around, repeats: f32) {
    let ring = &around.ring;
    let ends = rim.iter().copied().chain([(rim[0].0, rim[0].1 + 1.0)]);
    mesh.vertices.reserve(rim.len() + 1);
    for (point, turn) in ends {
        let below = mesh.points[point as usize].distance(ring.at);
        let below = (below * below - ring.radius * ring.radius).max(0.0).sqrt();
        let uv = Vec2::new(repeats * turn, -below * repeats / (TAU * ring.radius));
        mesh.vertices.push(Vertex { point, normal: Vec3::ZERO, uv });
    }
}

/// Fills the table of costs, rim by ring.
fn weigh(mesh: &Mesh, (first, rim): (u32, &[(u32, f32)]), around: &Around, best: &mut Vec<(f32, bool)>) {
    let (n, m) = (rim.len(), around.sides);
    let at = |vertex: usize| mesh.points[mesh.vertices[vertex].point as usize];
    best.clear();
    for i in 0..=n {
        let (low, turn) = (at(first as usize + i), if i == n { 1.0 } else { rim[i].1 });
        for j in 0..=m {
            let along_rim = if i > 0 { best[(i - 1) * (m + 1) + j].0 } else { f32::INFINITY };
            let along_ring = if j > 0 { best[i * (m + 1) + j - 1].0 } else { f32::INFINITY };
            let before = if i + j == 0 { 0.0 } else { along_rim.min(along_ring) };
            let off = turn - j as f32 / m as f32;
            let length = low.distance_squared(at(around.first_vertex as usize + j));
            let edge =
                if is_allowed((i, n), (j, m)) { length * (1.0 + ASTRAY * off * off) } else { f32::INFINITY };
            best.push((before + edge, along_rim < along_ring));
        }
    }
}

/// At the first point of either row, which is also its last, only one half of the other row may be joined at either
/// end, so that no edge is there twice.
fn is_allowed((i, n): (usize, usize), (j, m): (usize, usize)) -> bool {
    let of_rim = (i > 0 || 2 * j < m) && (i < n || 2 * j >= m);
    of_rim && (j > 0 || 2 * i < n) && (j < m || 2 * i >= n)
}
