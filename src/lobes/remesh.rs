//! Even triangles on a surface: incremental remeshing.
//!
//! The length of an edge is to be ℓ, the diagonal of the surface's box by [`Remesh::fineness`]. Five rounds: edges longer than 4/3 ℓ are split in
//! their middle; edges shorter than 4/5 ℓ are collapsed, never so that one becomes longer than 4/3 ℓ or a face turns over;
//! edges are turned where that brings the four vertices around nearer to six neighbours; vertices move to the middle of
//! their neighbours in the plane of the surface; and they are put back onto the surface as it was.
//! Edges at which the surface bends by more than [`Remesh::crease_deg`] are creases: they are not turned, their vertices move along
//! them only, and ends and corners of creases stay. Creases shorter than a few ℓ are none.
//!
//! Source: 001 §5.2.1 names Botsch & Kobbelt 2004. Limits: where walls are thinner than ℓ a vertex may be put back onto the wrong one; a
//! surface that would thereby cross itself more than it did stays as it was made, see `lobes/untangle.rs`.

use super::corner_table::CornerTable;
use super::surface::Surface;
use crate::geom::face_tree::FaceTree;
use glam::Vec3;
use rayon::prelude::*;

/// How surfaces are remeshed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Remesh {
    /// Edges along the diagonal of the surface's box.
    pub fineness: f32,
    /// Angle between two faces above which their edge is a crease, degrees.
    pub crease_deg: f32,
    /// Rounds.
    pub rounds: usize,
}

impl Default for Remesh {
    fn default() -> Self {
        Self { fineness: 40.0, crease_deg: 60.0, rounds: 5 }
    }
}

/// Longest and shortest edge, in ℓ.
const BOUNDS: (f32, f32) = (4.0 / 3.0, 4.0 / 5.0);
/// How often vertices move in each round.
const SMOOTHINGS: usize = 3;
/// Length of a crease, in ℓ, below which it is an unevenness.
const SHORT_CREASE: f32 = 4.0;
/// Most faces of a remeshed surface.
const MOST_FACES: usize = 400_000;
/// Least cosine between a face and what it becomes.
const TURNED: f32 = 0.2;

/// Length of the edges that a surface gets.
pub fn edge_length(surface: &Surface, params: &Remesh) -> f32 {
    let (low, high) = surface.bounds();
    (high - low).length() / params.fineness
}

/// The surface with even triangles; `None` where it is not closed, has no extent, or would need too many faces.
pub fn remesh(surface: &Surface, params: &Remesh) -> Option<Surface> {
    let length = edge_length(surface, params);
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    let mut table = CornerTable::new(surface)?;
    let faces = surface.face_tree();
    find_creases(&mut table, params.crease_deg.to_radians().cos(), SHORT_CREASE * length);
    for _ in 0..params.rounds {
        split_long(&mut table, (length * BOUNDS.0).powi(2))?;
        collapse_short(&mut table, length);
        even_valences(&mut table);
        smooth(&mut table, &faces);
    }
    Some(table.surface())
}

/// Marks the edges at which the surface bends more than by the angle of a cosine, where they hang together for a length.
fn find_creases(table: &mut CornerTable, limit: f32, least: f32) {
    let bends = |table: &CornerTable, h: u32| {
        let [a, b] = [h, table.twin(h)].map(|h| table.area(h / 3).normalize_or_zero());
        a.dot(b) < limit
    };
    let sharp: Vec<bool> = (0..table.half_edges()).map(|h| bends(table, h)).collect();
    let mut seen = vec![false; sharp.len()];
    for first in 0..table.half_edges() {
        if !sharp[first as usize] || seen[first as usize] {
            continue;
        }
        let (mut chain, mut next, mut whole) = (vec![first], 0, 0.0);
        seen[first as usize] = true;
        while next < chain.len() {
            let h = chain[next];
            whole += 0.5 * table.squared(h).sqrt();
            let beside = table.around(table.to(h)).chain([table.twin(h)]);
            for near in beside.filter(|near| sharp[*near as usize]) {
                if !std::mem::replace(&mut seen[near as usize], true) {
                    chain.push(near);
                }
            }
            next += 1;
        }
        if whole >= least {
            chain.iter().for_each(|h| table.mark_crease(*h));
        }
    }
}

/// Creases at a vertex: none, a crease through it, or an end or corner of creases.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    Free,
    Along,
    Corner,
}

fn place(table: &CornerTable, v: u32) -> Place {
    match table.around(v).filter(|h| table.is_crease(*h)).count() {
        0 => Place::Free,
        2 => Place::Along,
        _ => Place::Corner,
    }
}

/// Splits edges in passes, each only where it is the longest of both its faces, so that no face becomes a sliver.
fn split_long(table: &mut CornerTable, most: f32) -> Option<()> {
    loop {
        let is_long = |table: &CornerTable, h: u32| table.lives(h) && table.squared(h) > most;
        let mut long: Vec<(f32, u32)> = (0..table.half_edges())
            .filter(|h| is_long(table, *h) && table.twin(*h) > *h)
            .map(|h| (table.squared(h), h))
            .collect();
        if long.is_empty() {
            return Some(());
        }
        long.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        for (squared, h) in long {
            let is_longest = [h, table.twin(h)].iter().all(|h| table.longest_beside(*h) <= squared);
            if is_longest && table.squared(h) == squared {
                let middle =
                    table.points[table.from(h) as usize].midpoint(table.points[table.to(h) as usize]);
                table.split(h, middle);
            }
        }
        if table.half_edges() as usize > 3 * MOST_FACES {
            return None;
        }
    }
}

/// Collapses edges, shortest first: a free end comes to the other, and two free ends meet in the middle.
fn collapse_short(table: &mut CornerTable, length: f32) {
    let (most, least) = ((BOUNDS.0 * length).powi(2), (BOUNDS.1 * length).powi(2));
    let is_short = |h: &u32| table.lives(*h) && table.squared(*h) < least;
    let mut short: Vec<(f32, u32)> =
        (0..table.half_edges()).filter(is_short).map(|h| (table.squared(h), h)).collect();
    short.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    for (_, h) in short {
        if !table.lives(h) || table.squared(h) >= least {
            continue;
        }
        let [a, b] = [table.from(h), table.to(h)];
        let to = table.points[b as usize];
        let at = match (place(table, a), place(table, b)) {
            (Place::Free, Place::Free) => table.points[a as usize].midpoint(to),
            (Place::Free, _) => to,
            (Place::Along, Place::Along | Place::Corner) if table.is_crease(h) => to,
            _ => continue,
        };
        let keeps =
            keeps_shape(table, [a, b], at, most) && (at == to || keeps_shape(table, [b, a], at, most));
        if keeps && table.may_collapse(h) {
            table.collapse(h);
            table.points[b as usize] = at;
        }
    }
}

/// Whether no edge becomes too long and no face turns over where the first of two neighbours moves to a place and the second is
/// there as well.
fn keeps_shape(table: &CornerTable, [a, b]: [u32; 2], at: Vec3, most: f32) -> bool {
    table.around(a).all(|h| {
        let (c, d) = (table.to(h), table.across(h));
        if c == b || d == b {
            return true;
        }
        let (c, d) = (table.points[c as usize], table.points[d as usize]);
        let (before, after) = (table.area(h / 3), (c - at).cross(d - at));
        c.distance_squared(at) <= most && before.dot(after) > TURNED * before.length() * after.length()
    })
}

fn even_valences(table: &mut CornerTable) {
    for h in 0..table.half_edges() {
        if !table.lives(h) || table.is_crease(h) || table.twin(h) < h {
            continue;
        }
        let t = table.twin(h);
        let vertices = [table.from(h), table.to(h), table.across(h), table.across(t)];
        let valences = vertices.map(|v| table.valence(v) as i32);
        let off = |v: i32| (v - 6).abs();
        let now: i32 = valences.into_iter().map(off).sum();
        let [a, b, c, d] = valences;
        if off(a - 1) + off(b - 1) + off(c + 1) + off(d + 1) < now
            && a > 3
            && b > 3
            && is_convex(table, vertices)
        {
            table.flip(h);
        }
    }
}

/// Whether the edge between a and b of two faces may become one between c and d without a face turning over.
fn is_convex(table: &CornerTable, [a, b, c, d]: [u32; 4]) -> bool {
    let [a, b, c, d] = [a, b, c, d].map(|v| table.points[v as usize]);
    let old = [(b - a).cross(c - a), (a - b).cross(d - b)];
    let new = [(d - a).cross(c - a), (b - d).cross(c - d)];
    let normal = (old[0] + old[1]).normalize_or_zero();
    new.iter().all(|n| n.dot(normal) > TURNED * n.length() && n.length_squared() > 0.0)
}

/// Moves vertices to the middle of their neighbours, in the plane of the surface, and then back onto the surface that it was.
fn smooth(table: &mut CornerTable, onto: &FaceTree) {
    for last in (0..SMOOTHINGS).map(|k| k + 1 == SMOOTHINGS) {
        let this: &CornerTable = table;
        let onto = last.then_some(onto);
        let vertices = (0..this.points.len() as u32).into_par_iter().with_min_len(256);
        let moved: Vec<Vec3> = vertices.map(|v| relaxed(this, onto, v)).collect();
        table.points = moved;
    }
}

fn relaxed(table: &CornerTable, onto: Option<&FaceTree>, v: u32) -> Vec3 {
    let at = table.points[v as usize];
    if !table.has_vertex(v) {
        return at;
    }
    match place(table, v) {
        Place::Corner => at,
        Place::Along => {
            let mut ends =
                table.around(v).filter(|h| table.is_crease(*h)).map(|h| table.points[table.to(h) as usize]);
            let (Some(one), Some(other)) = (ends.next(), ends.next()) else { return at };
            let way = (other - one).normalize_or_zero();
            at + way * 0.5 * (one.midpoint(other) - at).dot(way)
        }
        Place::Free => {
            let (mut sum, mut normal, mut count) = (Vec3::ZERO, Vec3::ZERO, 0.0);
            for h in table.around(v) {
                sum += table.points[table.to(h) as usize];
                normal += table.area(h / 3);
                count += 1.0;
            }
            let way = sum / count - at;
            let normal = normal.normalize_or_zero();
            let moved = at + way - normal * way.dot(normal);
            onto.and_then(|faces| faces.nearest(moved)).map_or(moved, |(on_it, _)| on_it)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::grid::Grid;
    use super::super::lobe::{Lobe, SpaceStroke};
    use super::super::shape::lofted;
    use super::*;

    /// A coarse, uneven surface between inside and outside of a body.
    fn body(inside: impl Fn(Vec3) -> f32) -> Surface {
        let mut grid = Grid::around(Vec3::splat(-1.0), Vec3::splat(1.0));
        let [w, h, d] = grid.size;
        for i in 0..w * h * d {
            grid.values[i] = inside(grid.place([i % w, i / w % h, i / (w * h)]));
        }
        grid.surface()
    }

    /// Shares of edges between three quarters and 1.35 of ℓ, and of faces whose least angle is 25° or more.
    pub(super) fn evenness(surface: &Surface, length: f32) -> [f32; 2] {
        let (mut even, mut wide) = (0, 0);
        for t in &surface.triangles {
            let [a, b, c] = surface.corners(*t);
            let sides = [a.distance(b), b.distance(c), c.distance(a)];
            even += sides.iter().filter(|s| (0.75..1.35).contains(&(*s / length))).count();
            let angle = |u: Vec3, v: Vec3| u.angle_between(v).to_degrees();
            let least = angle(b - a, c - a).min(angle(a - b, c - b)).min(angle(a - c, b - c));
            wide += usize::from(least >= 25.0);
        }
        let count = surface.triangles.len() as f32;
        [even as f32 / (3.0 * count), wide as f32 / count]
    }

    #[test]
    fn a_ball_gets_even_triangles_and_stays_a_ball() {
        let ball = body(|p| 0.9 - (p * Vec3::new(1.0, 1.3, 1.0)).length());
        // The surface of a grid has small faces at any angle.
        let even = remesh(&ball, &Remesh { crease_deg: 180.0, ..Remesh::default() }).unwrap();
        assert_eq!(even.check_invariants(), Ok(()));
        let [edges, angles] = evenness(&even, edge_length(&ball, &Remesh::default()));
        assert!(edges > 0.95 && angles > 0.98, "{edges} {angles}");
        assert!((even.signed_volume() / ball.signed_volume() - 1.0).abs() < 0.02);
    }

    /// A lobe of nine loops as it is lofted.
    fn lofted_lobe() -> Surface {
        let ring = |k: usize| {
            let (wide, up) = ((k + 1) as f32 * 0.314).sin_cos();
            let at = |i: usize| {
                let (sin, cos) = (i as f32 * 0.0982).sin_cos();
                Vec3::new(wide * cos * 1.2, 2.0 - 0.8 * up, wide * sin)
            };
            SpaceStroke { closed: Some(true), points: (0..64).map(at).collect() }
        };
        let mut surface = lofted(&Lobe { strokes: (0..9).map(ring).collect(), ..Lobe::default() }).unwrap();
        if surface.signed_volume() < 0.0 {
            surface.flip();
        }
        surface
    }

    #[test]
    fn a_lofted_lobe_keeps_its_form() {
        let (raw, params) = (lofted_lobe(), Remesh { fineness: 48.0, ..Remesh::default() });
        let (even, length) = (remesh(&raw, &params).unwrap(), edge_length(&raw, &params));
        assert_eq!(even.check_invariants(), Ok(()));
        let [edges, angles] = evenness(&even, length);
        let volume = even.signed_volume() / raw.signed_volume();
        let farthest = |from: &Surface, to: &Surface| {
            let faces = to.face_tree();
            let far = from.points.iter().map(|p| faces.nearest(*p).unwrap().0.distance(*p));
            far.fold(0.0, f32::max) / length
        };
        let apart = farthest(&raw, &even).max(farthest(&even, &raw));
        assert!(edges >= 0.95 && angles >= 0.98, "{edges} {angles}");
        assert!((volume - 1.0).abs() < 0.02 && apart <= 0.35, "{volume} {apart}");
    }

    #[test]
    fn creases_stay_sharp() {
        let cube = |p: Vec3| 0.8 - p.abs().max_element();
        let sharp = remesh(&cubic(0.8), &Remesh { fineness: 20.0, ..Remesh::default() }).unwrap();
        assert_eq!(sharp.check_invariants(), Ok(()));
        assert!((sharp.signed_volume() - 1.6_f64.powi(3)).abs() < 1e-4, "{}", sharp.signed_volume());
        assert!(sharp.points.iter().all(|p| cube(*p).abs() < 1e-5));
        assert!(sharp.triangles.len() > 500);
    }

    /// A cube of twelve faces.
    fn cubic(half: f32) -> Surface {
        let points =
            (0..8).map(|k| Vec3::new((k & 1) as f32, (k >> 1 & 1) as f32, (k >> 2) as f32) * 2.0 - 1.0);
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        Surface { points: points.map(|p| p * half).collect(), triangles }
    }

    #[test]
    fn what_has_no_extent_or_is_open_is_refused() {
        let spot = Surface { points: vec![Vec3::ONE; 3], triangles: vec![[0, 1, 2], [0, 2, 1]] };
        assert!(remesh(&spot, &Remesh::default()).is_none());
        let mut open = cubic(1.0);
        open.triangles.pop();
        assert!(remesh(&open, &Remesh::default()).is_none());
        assert!(remesh(&cubic(1.0), &Remesh { fineness: 1e5, ..Remesh::default() }).is_none());
    }
}
