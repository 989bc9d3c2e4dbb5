//! A surface dragged by a point of it, as rigidly as possible.
//!
//! What moves is a geodesic disc around the point, by ways along edges; the vertices around it stay, and the point is where the hand
//! is. The energy Σ w_ij |(p'_i − p'_j) − R_i (p_i − p_j)|², with cotangent weights and a rotation for each vertex, is brought down in
//! [`ROUNDS`] rounds: rotations for places, then places for rotations. The places solve one system of equations, which is factored once
//! for a drag.
//!
//! Source: 001 §5.2.2. Its eqs. 5.3 to 5.5 have one soft handle and no anchor: since L of a constant is 0, their optimum is the
//! whole mesh moved along, with energy 0. So the rim is fixed and the handle hard. The system without rotations and
//! with even weights stays as [`Method::Laplacian`], for comparison. As rigid as possible: Sorkine & Alexa 2007; rotations by the
//! iteration of Müller et al. 2016.
//! Limits: distances along edges are longer than on the surface by up to a seventh or so.

use super::surface::Surface;
use crate::geom::cholesky::Cholesky;
use glam::{DMat3, DQuat, DVec3, Vec3};
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Rounds of rotations and places.
pub const ROUNDS: usize = 4;
/// Steps toward the rotation nearest to a matrix.
const TURNS: usize = 12;
/// Least cotangent weight, so that blunt corners leave the system solvable.
const LEAST_WEIGHT: f64 = 1e-3;
/// Share of the farthest distance beyond which vertices stay where the disc would be all of the surface.
const ANCHOR: f32 = 0.9;

/// How places are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// As rigid as possible.
    #[default]
    Rigid,
    /// Laplacian coordinates without rotations (001 eqs. 5.3 to 5.5), rim and handle held.
    Laplacian,
}

/// A neighbour of a vertex that moves or of one beside it.
#[derive(Clone, Copy, Debug)]
struct Beside {
    /// Number among the vertices of the drag.
    of: u32,
    weight: f64,
}

/// A drag that has begun.
#[derive(Clone, Debug)]
pub struct Drag {
    /// Vertices of the surface: those that move first, then the handle, then those that stay.
    vertices: Vec<u32>,
    /// How many of them are unknown.
    free: usize,
    rest: Vec<DVec3>,
    beside: Vec<Vec<Beside>>,
    system: Cholesky,
    method: Method,
    /// Laplacian coordinates of the vertices that move and of the handle.
    delta: Vec<DVec3>,
}

impl Drag {
    /// Takes hold of a vertex; `radius` is that of the disc that moves, metres. `None` where there is nothing that could move.
    pub fn begin(surface: &Surface, handle: u32, radius: f32, method: Method) -> Option<Self> {
        let neighbours = neighbours(surface);
        if handle as usize >= neighbours.len() {
            return None;
        }
        let distance = distances(surface, &neighbours, handle);
        let farthest = distance.iter().copied().filter(|d| d.is_finite()).fold(0.0, f32::max);
        let radius = radius.min(ANCHOR * farthest);
        let is_free = |v: u32| v != handle && distance[v as usize] < radius;
        let mut vertices: Vec<u32> = (0..surface.points.len() as u32).filter(|v| is_free(*v)).collect();
        let free = vertices.len();
        let mut local = vec![u32::MAX; surface.points.len()];
        vertices.iter().zip(0..).for_each(|(v, k)| local[*v as usize] = k);
        vertices.push(handle);
        local[handle as usize] = free as u32;
        // Two rings of what stays: the coordinates of what moves reach as far.
        for _ in 0..2 {
            for k in 0..vertices.len() {
                for (v, _) in &neighbours[vertices[k] as usize] {
                    if local[*v as usize] == u32::MAX {
                        local[*v as usize] = vertices.len() as u32;
                        vertices.push(*v);
                    }
                }
            }
        }
        let rest: Vec<DVec3> = vertices.iter().map(|v| surface.points[*v as usize].as_dvec3()).collect();
        let around = |v: &u32| {
            let inside = neighbours[*v as usize].iter().filter(|(w, _)| local[*w as usize] != u32::MAX);
            let weight =
                |cotangent: f64| if method == Method::Rigid { cotangent.max(LEAST_WEIGHT) } else { 1.0 };
            inside.map(|(w, cot)| Beside { of: local[*w as usize], weight: weight(*cot) }).collect::<Vec<_>>()
        };
        let beside: Vec<Vec<Beside>> = vertices.iter().map(around).collect();
        let system = system(&beside, free, method)?;
        let mut drag = Self { vertices, free, rest, beside, system, method, delta: Vec::new() };
        drag.delta = (0..drag.beside.len()).map(|i| drag.laplacian(i, &drag.rest)).collect();
        (free > 0).then_some(drag)
    }

    /// How many vertices move, the handle counted.
    pub fn moving(&self) -> usize {
        self.free + 1
    }

    /// The vertices that move, with their places when the handle is at `to`.
    pub fn to(&self, to: Vec3) -> Vec<(u32, Vec3)> {
        let mut places = self.rest.clone();
        places[self.free] = to.as_dvec3();
        match self.method {
            Method::Rigid => {
                let mut turns = vec![DQuat::IDENTITY; places.len()];
                for round in 0..ROUNDS {
                    if round > 0 {
                        turns = self.rotations(&places, &turns);
                    }
                    self.rigid_places(&mut places, &turns);
                }
            }
            Method::Laplacian => self.laplacian_places(&mut places),
        }
        let moved = self.vertices[..=self.free].iter().zip(&places);
        moved.map(|(v, p)| (*v, p.as_vec3())).collect()
    }

    /// For each vertex the rotation that brings its edges nearest to what they have become.
    fn rotations(&self, places: &[DVec3], before: &[DQuat]) -> Vec<DQuat> {
        let one = |i: usize| {
            let mut spread = DMat3::ZERO;
            for Beside { of, weight } in &self.beside[i] {
                let (rest, now) = (self.rest[i] - self.rest[*of as usize], places[i] - places[*of as usize]);
                let now = now * *weight;
                spread += DMat3::from_cols(now * rest.x, now * rest.y, now * rest.z);
            }
            nearest_rotation(spread, before[i])
        };
        (0..places.len()).into_par_iter().with_min_len(256).map(one).collect()
    }

    fn rigid_places(&self, places: &mut [DVec3], turns: &[DQuat]) {
        let right = |i: usize| {
            let mut sum = DVec3::ZERO;
            for Beside { of, weight } in &self.beside[i] {
                let (j, edge) = (*of as usize, self.rest[i] - self.rest[*of as usize]);
                sum += (turns[i] * edge + turns[j] * edge) * (0.5 * weight);
                if j >= self.free {
                    sum += places[j] * *weight;
                }
            }
            sum
        };
        let right: Vec<DVec3> = (0..self.free).into_par_iter().with_min_len(256).map(right).collect();
        self.solve(places, &right);
    }

    /// p − the mean of the neighbours.
    fn laplacian(&self, i: usize, places: &[DVec3]) -> DVec3 {
        let count = self.beside[i].len().max(1) as f64;
        places[i] - self.beside[i].iter().map(|b| places[b.of as usize]).sum::<DVec3>() / count
    }

    fn laplacian_places(&self, places: &mut [DVec3]) {
        let mut held = places.to_vec();
        held[..self.free].fill(DVec3::ZERO);
        let mut right = vec![DVec3::ZERO; self.free];
        for i in rows(&self.beside, self.free) {
            // What the held vertices leave of the row.
            let short = self.delta[i] - self.laplacian(i, &held);
            for (j, share) in row(&self.beside, i) {
                if j < self.free {
                    right[j] += short * share;
                }
            }
        }
        self.solve(places, &right);
    }

    fn solve(&self, places: &mut [DVec3], right: &[DVec3]) {
        let axes: Vec<Vec<f64>> = (0..3)
            .into_par_iter()
            .map(|axis| self.system.solve(&right.iter().map(|r| r[axis]).collect::<Vec<_>>()))
            .collect();
        for (i, place) in places[..self.free].iter_mut().enumerate() {
            *place = DVec3::new(axes[0][i], axes[1][i], axes[2][i]);
        }
    }
}

/// The vertices whose Laplacian coordinates know of one that moves.
fn rows(beside: &[Vec<Beside>], free: usize) -> impl Iterator<Item = usize> {
    (0..beside.len()).filter(move |i| *i < free || beside[*i].iter().any(|b| (b.of as usize) < free))
}

/// The row of I − D⁻¹A of a vertex.
fn row(beside: &[Vec<Beside>], i: usize) -> impl Iterator<Item = (usize, f64)> {
    let share = -1.0 / beside[i].len().max(1) as f64;
    std::iter::once((i, 1.0)).chain(beside[i].iter().map(move |b| (b.of as usize, share)))
}

fn system(beside: &[Vec<Beside>], free: usize, method: Method) -> Option<Cholesky> {
    let mut entries = Vec::new();
    match method {
        Method::Rigid => {
            for (i, around) in beside.iter().enumerate().take(free) {
                entries.push((i as u32, i as u32, around.iter().map(|b| b.weight).sum()));
                let lower = around.iter().filter(|b| (b.of as usize) < i);
                entries.extend(lower.map(|b| (i as u32, b.of, -b.weight)));
            }
        }
        Method::Laplacian => {
            for i in rows(beside, free) {
                let row: Vec<(usize, f64)> = row(beside, i).filter(|(j, _)| *j < free).collect();
                for (j, x) in &row {
                    let lower = row.iter().filter(|(k, _)| k <= j);
                    entries.extend(lower.map(|(k, y)| (*j as u32, *k as u32, x * y)));
                }
            }
        }
    }
    Cholesky::new(free, &entries)
}

/// The neighbours of every vertex, in the order of their numbers, each with the mean cotangent across the edge.
fn neighbours(surface: &Surface) -> Vec<Vec<(u32, f64)>> {
    let mut edges: Vec<(u32, u32, f64)> = Vec::with_capacity(6 * surface.triangles.len());
    for t in &surface.triangles {
        for k in 0..3 {
            let [a, b, c] = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
            let [p, q, r] = [a, b, c].map(|v| surface.points[v as usize].as_dvec3());
            let (u, v) = (p - r, q - r);
            let cotangent = 0.5 * u.dot(v) / u.cross(v).length().max(f64::MIN_POSITIVE);
            edges.extend([(a, b, cotangent), (b, a, cotangent)]);
        }
    }
    edges.sort_by(|x, y| (x.0, x.1).cmp(&(y.0, y.1)).then(x.2.total_cmp(&y.2)));
    let mut neighbours = vec![Vec::new(); surface.points.len()];
    for same in edges.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
        neighbours[same[0].0 as usize].push((same[0].1, same.iter().map(|e| e.2).sum()));
    }
    neighbours
}

/// Distances from a vertex along edges.
fn distances(surface: &Surface, neighbours: &[Vec<(u32, f64)>], from: u32) -> Vec<f32> {
    let mut distance = vec![f32::INFINITY; surface.points.len()];
    let mut open = BinaryHeap::new();
    distance[from as usize] = 0.0;
    // Distances are not negative, so their bits are in the order of their sizes.
    open.push(Reverse((0u32, from)));
    while let Some(Reverse((bits, v))) = open.pop() {
        let here = f32::from_bits(bits);
        if here > distance[v as usize] {
            continue;
        }
        for (w, _) in &neighbours[v as usize] {
            let there = here + surface.points[v as usize].distance(surface.points[*w as usize]);
            if there < distance[*w as usize] {
                distance[*w as usize] = there;
                open.push(Reverse((there.to_bits(), *w)));
            }
        }
    }
    distance
}

/// The rotation nearest to a matrix, from one that is near already.
fn nearest_rotation(matrix: DMat3, start: DQuat) -> DQuat {
    let mut turn = start;
    for _ in 0..TURNS {
        let now = DMat3::from_quat(turn);
        let (mut axis, mut along) = (DVec3::ZERO, 0.0);
        for k in 0..3 {
            axis += now.col(k).cross(matrix.col(k));
            along += now.col(k).dot(matrix.col(k));
        }
        let step = axis / (along.abs() + 1e-12);
        let angle = step.length();
        if angle.is_nan() || angle <= 1e-7 {
            break;
        }
        turn = (DQuat::from_axis_angle(step / angle, angle) * turn).normalize();
    }
    turn
}

#[cfg(test)]
mod tests {
    use super::super::grid::Grid;
    use super::super::remesh::{Remesh, remesh};
    use super::*;

    fn ball() -> Surface {
        let mut grid = Grid::around(Vec3::splat(-1.0), Vec3::splat(1.0));
        let [w, h, d] = grid.size;
        for i in 0..w * h * d {
            grid.values[i] = 1.0 - grid.place([i % w, i / w % h, i / (w * h)]).length();
        }
        let params = Remesh { fineness: 30.0, crease_deg: 180.0, ..Remesh::default() };
        remesh(&grid.surface(), &params).unwrap()
    }

    fn top(surface: &Surface) -> u32 {
        let heights = surface.points.iter().map(|p| p.y);
        heights.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap().0 as u32
    }

    #[test]
    fn the_handle_is_where_the_hand_is_and_what_is_far_stays() {
        let surface = ball();
        let handle = top(&surface);
        let at = surface.points[handle as usize];
        for method in [Method::Rigid, Method::Laplacian] {
            let drag = Drag::begin(&surface, handle, 0.8, method).unwrap();
            let still = drag.to(at);
            assert!(
                still.iter().all(|(v, p)| p.distance(surface.points[*v as usize]) < 1e-4),
                "{method:?}: a drag of nothing"
            );
            let to = at + Vec3::new(0.2, 0.4, 0.0);
            let moved = drag.to(to);
            assert!(moved.contains(&(handle, to)) && moved.len() == drag.moving());
            assert!(moved.iter().all(|(v, p)| p.is_finite() && surface.points[*v as usize].y > 0.2));
            // What is near moves more than what is far.
            let shift = |near: bool| {
                let of =
                    moved.iter().filter(|(v, _)| (surface.points[*v as usize].distance(at) < 0.4) == near);
                let shifts: Vec<f32> = of.map(|(v, p)| p.distance(surface.points[*v as usize])).collect();
                shifts.iter().sum::<f32>() / shifts.len() as f32
            };
            assert!(shift(true) > 2.0 * shift(false), "{method:?}: {} {}", shift(true), shift(false));
        }
    }

    #[test]
    fn a_drag_of_everything_has_an_anchor() {
        let surface = ball();
        let handle = top(&surface);
        let drag = Drag::begin(&surface, handle, 1e3, Method::Rigid).unwrap();
        assert!(drag.moving() < surface.points.len());
        let moved = drag.to(surface.points[handle as usize] * 2.0);
        assert!(moved.iter().all(|(_, p)| p.is_finite()));
    }

    #[test]
    fn nothing_moves_where_the_disc_has_no_vertex() {
        let surface = ball();
        assert!(Drag::begin(&surface, 0, 1e-6, Method::Rigid).is_none());
        assert!(Drag::begin(&surface, u32::MAX, 1.0, Method::Rigid).is_none());
    }

    #[test]
    fn the_nearest_rotation_is_found() {
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -1.0).normalize(), 1.2);
        let found = nearest_rotation(DMat3::from_quat(turn) * 3.0, DQuat::IDENTITY);
        assert!(found.dot(turn).abs() > 1.0 - 1e-6);
        assert!(nearest_rotation(DMat3::ZERO, turn) == turn);
    }
}
