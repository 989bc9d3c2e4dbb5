//! Where growth leads in a drawn crown: from the drawn wood along the crown's arms to its rim (001 §3.3, eq. 3.6).
//!
//! Ways through the crown's raster are shortest by Dijkstra's rule, where a step through a thin part costs more than one through the
//! middle of a thick one, so that they follow the middle of arms. A way begins at the drawn wood, at what it is away from the lowest
//! of it; without any at the crown's lowest cell. The direction at a cell is the one in which ways become longer, smoothed over its
//! neighbours. In depth it leads away from the volume's middle, the more the nearer to its front or back.
//!
//! Where we depart: the thesis makes a skeleton of bins of path length and turns one field about the root, which jumps at the drawing's
//! plane and looks the same from all sides; ways have directions everywhere, and the volume's own depth gives the third.

use glam::{Vec2, Vec3};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::f32::consts::SQRT_2;

/// Share of the distance from the lowest wood that a way along the wood counts.
const ALONG_WOOD: f32 = 0.7;
/// How much a step costs more where the crown is thin, against where it is thickest.
const THIN: f32 = 2.0;
/// Times that directions are smoothed.
const SMOOTH: usize = 3;
/// How strongly directions lead away from the volume's middle at its front and back.
const OUTWARD: f32 = 0.7;

/// A raster of cells: how many to the right and up, and the half depth in each, 0 outside.
pub(super) struct Cells<'a> {
    pub(super) size: [usize; 2],
    pub(super) half_depth: &'a [f32],
}

/// Directions in the drawing's plane, a unit vector or zero for each cell.
#[derive(Clone, Debug)]
pub(super) struct Guide {
    ways: Vec<Vec2>,
}

impl Guide {
    /// The ways from cells at which drawn wood stands, given with the places of that wood in cells.
    pub(super) fn new(cells: &Cells<'_>, wood: &[(usize, Vec2)]) -> Self {
        let length = lengths(cells, wood);
        let mut ways = slopes(cells, &length);
        for _ in 0..SMOOTH {
            ways = smoothed(cells, &ways);
        }
        Self { ways }
    }

    /// The direction in a cell, at a depth from −1, the volume's back, to 1.
    pub(super) fn way(&self, cell: usize, depth: f32) -> Vec3 {
        let way = self.ways.get(cell).copied().unwrap_or(Vec2::ZERO);
        if way == Vec2::ZERO { Vec3::ZERO } else { way.extend(OUTWARD * depth.clamp(-1.0, 1.0)).normalize() }
    }
}

/// Ways that are being followed, the shortest first.
struct Ways<'a> {
    cells: &'a Cells<'a>,
    /// The length to each cell that was reached, in cells of the thickest part; infinite elsewhere.
    length: Vec<f32>,
    /// Lengths as their bits, whose order is theirs, and cells.
    open: BinaryHeap<Reverse<(u32, usize)>>,
}

impl Ways<'_> {
    fn reach(&mut self, cell: usize, length: f32) {
        if self.cells.half_depth[cell] > 0.0 && length < self.length[cell] {
            self.length[cell] = length;
            self.open.push(Reverse((length.to_bits(), cell)));
        }
    }

    /// Follows them to every cell that hangs together with those reached.
    fn follow(&mut self, deepest: f32) {
        let [w, _] = self.cells.size;
        while let Some(Reverse((bits, cell))) = self.open.pop() {
            let so_far = f32::from_bits(bits);
            if so_far > self.length[cell] {
                continue;
            }
            let step = 1.0 + THIN * (1.0 - self.cells.half_depth[cell] / deepest);
            // Cells of the rim are outside, so those inside have eight neighbours.
            for near in [cell - 1, cell + 1, cell - w, cell + w] {
                self.reach(near, so_far + step);
            }
            for near in [cell - w - 1, cell - w + 1, cell + w - 1, cell + w + 1] {
                self.reach(near, so_far + step * SQRT_2);
            }
        }
    }
}

/// The length of the shortest way to each cell. Parts that no wood reaches begin at their lowest cell.
fn lengths(cells: &Cells<'_>, wood: &[(usize, Vec2)]) -> Vec<f32> {
    let length = vec![f32::INFINITY; cells.half_depth.len()];
    let mut ways = Ways { cells, length, open: BinaryHeap::new() };
    let lowest = wood.iter().map(|(_, p)| *p).min_by(|a, b| a.y.total_cmp(&b.y)).unwrap_or_default();
    for (cell, p) in wood {
        ways.reach(*cell, ALONG_WOOD * p.distance(lowest));
    }
    let deepest = cells.half_depth.iter().copied().fold(f32::MIN_POSITIVE, f32::max);
    ways.follow(deepest);
    // Rows go up, so of each part the first cell is a lowest one.
    for cell in 0..cells.half_depth.len() {
        if ways.length[cell].is_infinite() {
            ways.reach(cell, 0.0);
            ways.follow(deepest);
        }
    }
    ways.length
}

/// Where lengths rise, as unit vectors.
fn slopes(cells: &Cells<'_>, length: &[f32]) -> Vec<Vec2> {
    let [w, _] = cells.size;
    let slope = |cell: usize| {
        if cells.half_depth[cell] <= 0.0 {
            return Vec2::ZERO;
        }
        let here = length[cell];
        let to = |near: usize| if length[near].is_finite() { length[near] } else { here };
        Vec2::new(to(cell + 1) - to(cell - 1), to(cell + w) - to(cell - w)).normalize_or_zero()
    };
    (0..length.len()).map(slope).collect()
}

/// Each direction as the mean of those around.
fn smoothed(cells: &Cells<'_>, ways: &[Vec2]) -> Vec<Vec2> {
    let [w, _] = cells.size;
    let mean = |cell: usize| {
        if cells.half_depth[cell] <= 0.0 {
            return Vec2::ZERO;
        }
        let rows = [cell - w, cell, cell + w];
        rows.iter().flat_map(|row| &ways[row - 1..=row + 1]).sum::<Vec2>().normalize_or_zero()
    };
    (0..ways.len()).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An L of cells: up, then to the right.
    fn bent() -> (usize, Vec<f32>) {
        let side = 40;
        let inside = |x: usize, y: usize| {
            (4..10).contains(&x) && (2..36).contains(&y) || (4..36).contains(&x) && (30..36).contains(&y)
        };
        (side, (0..side * side).map(|i| if inside(i % side, i / side) { 1.0 } else { 0.0 }).collect())
    }

    #[test]
    fn ways_follow_the_arms_of_a_crown() {
        let (side, half) = bent();
        let cells = Cells { size: [side, side], half_depth: &half };
        let guide = Guide::new(&cells, &[(2 * side + 7, Vec2::new(7.0, 2.0))]);
        let (up, right) = (guide.way(15 * side + 7, 0.0), guide.way(33 * side + 25, 0.0));
        assert!(up.y > 0.9 && right.x > 0.9, "{up} {right}");
        assert_eq!(guide.way(15 * side + 25, 0.0), Vec3::ZERO, "outside");
        assert!(guide.way(15 * side + 7, 1.0).z > 0.4 && guide.way(15 * side + 7, -1.0).z < -0.4);
    }

    #[test]
    fn a_part_without_wood_is_led_up_from_its_foot() {
        let (side, half) = bent();
        let cells = Cells { size: [side, side], half_depth: &half };
        let guide = Guide::new(&cells, &[]);
        assert!(guide.way(15 * side + 7, 0.0).y > 0.9);
    }
}
