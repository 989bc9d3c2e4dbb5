//! The middle lines of an area with their distances from its edge: a trunk and its arms.
//!
//! From a root cell the cheapest paths through the area are found, dear near the edge; the path from the farthest cell is the
//! first line, or, once all tips are known, that from the one most straight above the root. Cells within a little more than its distance from the edge count as covered; the farthest cell that is not gives the
//! next line, which ends where it meets an earlier one, until all that is left is short (Sato et al., “TEASAR: tree-structure
//! extraction algorithm”, 2000, in two dimensions). Cost: cells times lines, times a logarithm.

use super::silhouette::Silhouette;
use glam::{IVec2, Vec2};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Most lines.
const MOST: usize = 12;
/// Reach of a line's cover, in distances from the edge, and cells added to it.
const COVER: (f32, f32) = (1.35, 3.0);
/// Distance of circles that cover a line, in their radii.
const APART: f32 = 0.2;
/// Least height of the first line's tip above the root, as a share of the highest tip's.
const HIGH: f32 = 0.6;
/// How much dearer a cell on the edge is than one in the deepest middle.
const EDGE: f32 = 300.0;

/// A middle line from its root to its tip.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Axis {
    /// Places, pixels, and distances from the edge there.
    pub points: Vec<(Vec2, f32)>,
    /// The line on which it begins and the point of it; none for the first.
    pub parent: Option<(usize, usize)>,
}

/// The middle lines of the area of a silhouette from the place nearest to `root`, the first to the tip to which the way is most
/// upright.
pub(crate) fn medial_axes(silhouette: &Silhouette, root: Vec2) -> Vec<Axis> {
    let depth = silhouette.depths();
    let Some(start) = nearest_inside(silhouette, &depth, root) else { return Vec::new() };
    let paths = Paths::from(silhouette, &depth, start);
    let foot = silhouette.place_of(start).y;
    let height = |tip: usize| (foot - silhouette.place_of(tip).y) as f32;
    let (axes, tips) = paths.lines(silhouette, &depth, None);
    let highest = tips.iter().map(|tip| height(*tip)).fold(0.0, f32::max);
    let upright = |tip: &usize| height(*tip) / paths.steps[*tip].max(1.0);
    let high = tips.iter().copied().filter(|tip| height(*tip) > HIGH * highest);
    let main = high.max_by(|a, b| upright(a).total_cmp(&upright(b)));
    match main.filter(|main| *main != tips[0]) {
        Some(main) => paths.lines(silhouette, &depth, Some(main)).0,
        None => axes,
    }
}

fn nearest_inside(silhouette: &Silhouette, depth: &[f32], root: Vec2) -> Option<usize> {
    let away = |i: &usize| silhouette.middle(*i).distance_squared(root);
    (0..depth.len()).filter(|i| depth[*i] > 0.0).min_by(|a, b| away(a).total_cmp(&away(b)))
}

/// Marks the cells within so many cells of a cell.
fn cover(silhouette: &Silhouette, cell: usize, reach: f32, is_covered: &mut [bool]) {
    let middle = silhouette.place_of(cell);
    let around = reach as i32;
    for offset in (-around..=around).flat_map(|x| (-around..=around).map(move |y| IVec2::new(x, y))) {
        if offset.as_vec2().length() <= reach
            && let Some(other) = silhouette.number_at(middle + offset)
        {
            is_covered[other] = true;
        }
    }
}

/// The cheapest ways from one cell to all others of its area.
struct Paths {
    /// Length of the way, cells.
    steps: Vec<f32>,
    before: Vec<Option<usize>>,
    /// All cells that are reached, the farthest first, of equals the last.
    farthest: Vec<usize>,
}

impl Paths {
    fn from(silhouette: &Silhouette, depth: &[f32], start: usize) -> Self {
        let deepest = depth.iter().copied().fold(f32::MIN_POSITIVE, f32::max);
        let prices: Vec<f32> =
            depth.iter().map(|depth| 1.0 + EDGE * (1.0 - depth / deepest).powi(6)).collect();
        let mut cost = vec![f32::INFINITY; depth.len()];
        let mut it = Self {
            steps: vec![f32::INFINITY; depth.len()],
            before: vec![None; depth.len()],
            farthest: Vec::new(),
        };
        (cost[start], it.steps[start]) = (0.0, 0.0);
        // Costs as integers, so that they have an order; thousandths are fine enough.
        let mut queue = BinaryHeap::from([(Reverse(0_u64), start)]);
        while let Some((Reverse(known), i)) = queue.pop() {
            if known > (cost[i] * 1e3) as u64 {
                continue;
            }
            for (next, length) in silhouette.around(i) {
                let along = cost[i] + length * prices[next];
                if depth[next] > 0.0 && along < cost[next] {
                    (cost[next], it.steps[next], it.before[next]) = (along, it.steps[i] + length, Some(i));
                    queue.push((Reverse((along * 1e3) as u64), next));
                }
            }
        }
        it.farthest = (0..depth.len()).rev().filter(|i| it.steps[*i].is_finite()).collect();
        it.farthest.sort_by(|a, b| it.steps[*b].total_cmp(&it.steps[*a]));
        it
    }

    /// Lines from their beginnings to their tips, and the cells of these; the first to the tip `main`, or else the farthest.
    fn lines(&self, silhouette: &Silhouette, depth: &[f32], main: Option<usize>) -> (Vec<Axis>, Vec<usize>) {
        let mut owner: Vec<Option<(usize, usize)>> = vec![None; depth.len()];
        let mut is_covered = vec![false; depth.len()];
        let (mut axes, mut tips): (Vec<Axis>, Vec<usize>) = (Vec::new(), Vec::new());
        let mut far = self.farthest.iter().copied();
        while axes.len() < MOST {
            let Some(tip) = main.filter(|_| axes.is_empty()).or_else(|| far.find(|i| !is_covered[*i])) else {
                break;
            };
            let mut cells = vec![tip];
            let mut parent = None;
            while let Some(before) = self.before[cells[cells.len() - 1]] {
                cells.push(before);
                if owner[before].is_some() {
                    parent = owner[before];
                    break;
                }
            }
            cells.reverse();
            for (place, &cell) in cells.iter().enumerate() {
                owner[cell].get_or_insert((axes.len(), place));
                let reach = COVER.0 * depth[cell] + COVER.1;
                // Circles so near to one another cover the same.
                if place % (reach * APART).max(1.0) as usize == 0 || place + 1 == cells.len() {
                    cover(silhouette, cell, reach, &mut is_covered);
                }
            }
            let point = |cell: &usize| (silhouette.middle(*cell), depth[*cell] * silhouette.cell());
            axes.push(Axis { points: cells.iter().map(point).collect(), parent });
            tips.push(tip);
        }
        (axes, tips)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axes(outline: &[(f32, f32)], root: (f32, f32)) -> Vec<Axis> {
        let mut line: Vec<Vec2> = outline.iter().map(|p| Vec2::from(*p)).collect();
        line.push(line[0]);
        medial_axes(&Silhouette::new([line.as_slice()].into_iter(), 2), Vec2::from(root))
    }

    #[test]
    fn the_axis_of_a_column_runs_up_its_middle() {
        let column = axes(&[(0.0, 0.0), (20.0, 0.0), (20.0, 120.0), (0.0, 120.0)], (10.0, 120.0));
        assert_eq!(column.len(), 1);
        for (place, half) in column[0].points.iter().filter(|(place, _)| (20.0..100.0).contains(&place.y)) {
            assert!((place.x - 10.0).abs() < 2.0 && (half - 10.0).abs() < 2.0, "{place} {half}");
        }
    }

    #[test]
    fn an_arm_begins_on_the_trunk() {
        let outline = [
            (0.0, 0.0),
            (20.0, 0.0),
            (20.0, 60.0),
            (40.0, 60.0),
            (40.0, 20.0),
            (60.0, 20.0),
            (60.0, 80.0),
            (20.0, 80.0),
            (20.0, 140.0),
            (0.0, 140.0),
        ];
        let found = axes(&outline, (10.0, 140.0));
        let high = |axis: &&Axis| axis.points[axis.points.len() - 1].0.y < 30.0;
        let (trunk, arm) = (&found[0], found.iter().skip(1).find(high).unwrap());
        assert!(trunk.parent.is_none() && high(&trunk) && arm.parent.is_some());
        assert!((50.0..95.0).contains(&arm.points[0].0.y), "{}", arm.points[0].0);
    }
}
