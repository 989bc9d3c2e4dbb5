//! Volumes on a grid: the winding numbers of a surface, the depth of an outline, and the surface between inside and outside.
//!
//! *Winding numbers.* Along each upright line of the grid's nodes a surface is met from outside or from inside; the sum of both above
//! a node is its winding number, which for closed surfaces is whole. What is not 0 is inside, so parts that lie over each other
//! are one. The step from inside to outside is smoothed over a cell, so that the surface between is no staircase.
//! *Surface.* Each cube of the grid is six tetrahedra about one diagonal, the same in every cube, and in each the surface where the
//! value passes 0 is one or two triangles. Such a surface is always closed and manifold, without any table of cases.
//!
//! Source: marching tetrahedra are common; winding numbers instead of one question at a time, because 001 has no union of
//! surfaces at all. Limits: what is thinner than a cell may be lost, and edges are rounded by as much.

use super::surface::Surface;
use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

/// Cells along the longest side: half the length of an edge after remeshing, so that no more would be seen of a finer grid.
pub(super) const CELLS: usize = 80;
/// Cells around what is inside.
const RIM: usize = 3;
/// Nearest that the surface comes to a node, as a share of an edge, so that no face vanishes.
const NEAREST: f32 = 0.05;
/// How far lines are moved from nodes, as shares of a cell, so that they meet no edge of a regular surface.
const ASIDE: DVec2 = DVec2::new(0.013_7, 0.009_1);

/// Values at the nodes of a grid, above 0 inside.
pub(super) struct Grid {
    /// Place of the first node.
    pub(super) low: Vec3,
    /// Distance of nodes.
    pub(super) cell: f32,
    /// Nodes along x, y and z.
    pub(super) size: [usize; 3],
    /// Values, x fastest, then y, then z.
    pub(super) values: Vec<f32>,
}

impl Grid {
    /// An empty grid around a box.
    pub(super) fn around(low: Vec3, high: Vec3) -> Self {
        let extent = (high - low).max_element().max(f32::MIN_POSITIVE);
        let cell = extent / CELLS as f32;
        let size = (high - low).to_array().map(|side| (side / cell).ceil() as usize + 1 + 2 * RIM);
        let values = vec![-1.0; size.iter().product()];
        Self { low: low - RIM as f32 * cell, cell, size, values }
    }

    /// Place of a node.
    pub(super) fn place(&self, [x, y, z]: [usize; 3]) -> Vec3 {
        self.low + Vec3::new(x as f32, y as f32, z as f32) * self.cell
    }

    fn node(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.size[1] + y) * self.size[0] + x
    }

    /// The inside of a closed surface, all parts of it together, above `floor`.
    pub(super) fn of_winding(surface: &Surface, floor: f32) -> Self {
        let (low, high) = surface.bounds();
        let mut grid = Self::around(low, high);
        let [w, h, d] = grid.size;
        let lists = grid.faces_of_columns(surface);
        let column = |c: usize| -> Vec<bool> {
            let at = grid.place([c % w, 0, c / w]).as_dvec3();
            let line = DVec2::new(at.x, at.z) + ASIDE * f64::from(grid.cell);
            let mut met: Vec<(f64, i32)> = lists[c]
                .iter()
                .filter_map(|t| meets(surface.corners(surface.triangles[*t as usize]), line))
                .collect();
            met.sort_by(|a, b| b.0.total_cmp(&a.0));
            let mut inside = vec![false; h];
            let (mut passed, mut winding) = (0, 0);
            for y in (0..h).rev() {
                let height = at.y + f64::from(grid.cell) * y as f64;
                while passed < met.len() && met[passed].0 > height {
                    winding += met[passed].1;
                    passed += 1;
                }
                inside[y] = winding != 0 && height >= f64::from(floor);
            }
            inside
        };
        let columns: Vec<Vec<bool>> = (0..w * d).into_par_iter().map(column).collect();
        for (c, column) in columns.iter().enumerate() {
            for (y, inside) in column.iter().enumerate() {
                let node = grid.node([c % w, y, c / w]);
                grid.values[node] = if *inside { 1.0 } else { -1.0 };
            }
        }
        (0..3).for_each(|axis| grid.blur(axis));
        grid
    }

    /// The faces over each upright line of nodes.
    fn faces_of_columns(&self, surface: &Surface) -> Vec<Vec<u32>> {
        let [w, _, d] = self.size;
        let mut lists = vec![Vec::new(); w * d];
        for (t, triangle) in surface.triangles.iter().enumerate() {
            let corners = surface.corners(*triangle).map(|p| (p - self.low) / self.cell);
            let low = corners[0].min(corners[1]).min(corners[2]).floor().max(Vec3::ONE) - 1.0;
            let high = corners[0].max(corners[1]).max(corners[2]).ceil().max(Vec3::ZERO);
            for z in low.z as usize..=(high.z as usize).min(d - 1) {
                for x in low.x as usize..=(high.x as usize).min(w - 1) {
                    lists[z * w + x].push(t as u32);
                }
            }
        }
        lists
    }

    /// Means over three nodes along an axis, the middle one counted twice.
    fn blur(&mut self, axis: usize) {
        let step = [1, self.size[0], self.size[0] * self.size[1]][axis];
        let (stride, count) = (self.size[axis], self.values.len());
        let old = self.values.clone();
        for i in 0..count {
            let at = i / step % stride;
            if at > 0 && at + 1 < stride {
                self.values[i] = 0.25 * (old[i - step] + old[i + step]) + 0.5 * old[i];
            }
        }
    }

    /// The surface between inside and outside; empty where nothing is inside.
    pub(super) fn surface(&self) -> Surface {
        let [w, h, d] = self.size;
        let layer = |z: usize| {
            let mut faces = Vec::new();
            for y in 0..h - 1 {
                for x in 0..w - 1 {
                    self.cube([x, y, z], &mut faces);
                }
            }
            faces
        };
        let faces: Vec<[[u32; 2]; 3]> = (0..d - 1).into_par_iter().flat_map_iter(layer).collect();
        let mut edges: Vec<[u32; 2]> = faces.iter().flatten().copied().collect();
        edges.sort_unstable();
        edges.dedup();
        let points = edges.iter().map(|edge| self.crossing(*edge)).collect();
        // Every edge is among those that were sorted.
        let number = |edge: &[u32; 2]| edges.binary_search(edge).unwrap_or_default() as u32;
        let triangles =
            faces.iter().map(|face| [number(&face[0]), number(&face[1]), number(&face[2])]).collect();
        Surface { points, triangles }
    }

    fn place_of(&self, node: u32) -> Vec3 {
        let (i, [w, h, _]) = (node as usize, self.size);
        self.place([i % w, i / w % h, i / (w * h)])
    }

    /// Where the value passes 0 on an edge from inside to outside or back.
    fn crossing(&self, [a, b]: [u32; 2]) -> Vec3 {
        let (x, y) = (self.values[a as usize], self.values[b as usize]);
        let share = (x / (x - y)).clamp(NEAREST, 1.0 - NEAREST);
        self.place_of(a).lerp(self.place_of(b), share)
    }

    /// The faces in one cube, by the edges of the grid on which their corners lie.
    fn cube(&self, [x, y, z]: [usize; 3], faces: &mut Vec<[[u32; 2]; 3]>) {
        let corner = |k: usize| self.node([x + (k & 1), y + (k >> 1 & 1), z + (k >> 2)]) as u32;
        let nodes: [u32; 8] = std::array::from_fn(corner);
        let inside = nodes.map(|node| self.values[node as usize] > 0.0);
        if inside.iter().all(|i| *i) || !inside.iter().any(|i| *i) {
            return;
        }
        // Ways from the first corner to the last by one axis after the other, all turning the same way.
        const TETRAHEDRA: [[usize; 4]; 6] =
            [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];
        for tetrahedron in TETRAHEDRA {
            self.tetrahedron(tetrahedron.map(|k| nodes[k]), faces);
        }
    }

    fn tetrahedron(&self, nodes: [u32; 4], faces: &mut Vec<[[u32; 2]; 3]>) {
        let is_inside = |k: &usize| self.values[nodes[*k] as usize] > 0.0;
        let inside: Vec<usize> = (0..4).filter(is_inside).collect();
        let outside: Vec<usize> = (0..4).filter(|k| !is_inside(k)).collect();
        let on = |a: usize, b: usize| [nodes[a].min(nodes[b]), nodes[a].max(nodes[b])];
        // The corners in the order inside first turn as the tetrahedron does, or the other way.
        let order: Vec<usize> = inside.iter().chain(&outside).copied().collect();
        let inversions =
            (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j))).filter(|(i, j)| order[*i] > order[*j]);
        let flipped = inversions.count() % 2 == 1;
        let mut add = |face: [[u32; 2]; 3]| {
            let [a, b, c] = face;
            faces.push(if flipped { [a, c, b] } else { face });
        };
        match (inside.as_slice(), outside.as_slice()) {
            (&[a], &[b, c, d]) => add([on(a, b), on(a, c), on(a, d)]),
            (&[a, b, c], &[d]) => add([on(a, d), on(b, d), on(c, d)]),
            (&[a, b], &[c, d]) => {
                add([on(a, c), on(a, d), on(b, d)]);
                add([on(a, c), on(b, d), on(b, c)]);
            }
            _ => {}
        }
    }
}

/// At which height an upright line meets a face, and whether from outside, seen from above: 1, or −1.
fn meets(corners: [Vec3; 3], line: DVec2) -> Option<(f64, i32)> {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let flat = |p: DVec3| DVec2::new(p.x, p.z) - line;
    let [p, q, r] = [a, b, c].map(flat);
    let [u, v, w] = [q.perp_dot(r), r.perp_dot(p), p.perp_dot(q)];
    let area = u + v + w;
    if area == 0.0 || !(u * area >= 0.0 && v * area >= 0.0 && w * area >= 0.0) {
        return None;
    }
    let height = (u * a.y + v * b.y + w * c.y) / area;
    Some((height, if area < 0.0 { 1 } else { -1 }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(middle: Vec3) -> Surface {
        let mut grid = Grid::around(Vec3::splat(-1.0), Vec3::splat(1.0));
        let [w, h, d] = grid.size;
        for i in 0..w * h * d {
            grid.values[i] = 1.0 - grid.place([i % w, i / w % h, i / (w * h)]).length();
        }
        let mut surface = grid.surface();
        surface.points.iter_mut().for_each(|p| *p += middle);
        surface
    }

    #[test]
    fn the_surface_of_a_ball_is_closed_and_faces_outward() {
        let surface = ball(Vec3::ZERO);
        assert_eq!(surface.check_invariants(), Ok(()));
        let expected = 4.0 / 3.0 * std::f64::consts::PI;
        assert!((surface.signed_volume() / expected - 1.0).abs() < 0.01, "{}", surface.signed_volume());
    }

    #[test]
    fn balls_that_cross_are_one_body() {
        let mut both = ball(Vec3::ZERO);
        let other = ball(Vec3::X);
        let first = both.points.len() as u32;
        both.points.extend(&other.points);
        both.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + first)));
        let union = Grid::of_winding(&both, f32::NEG_INFINITY).surface();
        assert_eq!(union.check_invariants(), Ok(()));
        // Two balls less the lens that they share.
        let expected = std::f64::consts::PI * (8.0 / 3.0 - 5.0 / 12.0);
        assert!(
            (union.signed_volume() / expected - 1.0).abs() < 0.03,
            "{} of {expected}",
            union.signed_volume()
        );
        let half = Grid::of_winding(&ball(Vec3::ZERO), 0.0).surface();
        let expected = std::f64::consts::PI * 2.0 / 3.0;
        assert!((half.signed_volume() / expected - 1.0).abs() < 0.05, "{}", half.signed_volume());
        assert!(half.points.iter().all(|p| p.y > -0.03));
    }

    #[test]
    fn nothing_inside_gives_no_surface() {
        assert!(Grid::around(Vec3::ZERO, Vec3::ONE).surface().triangles.is_empty());
    }
}
