//! What a drawing looks like in numbers: where it has lines in which direction, and what its strokes are like.
//!
//! The drawing is scaled so that the longer side of its bounds is 1. The square around it is divided into 8×8, 4×4 and 2×2
//! cells; in each the length of line is counted in six directions, shared out linearly among the cells and directions that are
//! nearest. The root of each count, over the length of all roots of the grid, is a feature: histograms of oriented gradients
//! (Dalal and Triggs 2005) of lines in place of pictures. Eight numbers more say how many strokes there are, how long and how
//! curved, and how many are closed. Cost: linear in the points.

use crate::geom::polyline;
use glam::Vec2;
use std::f32::consts::PI;

/// Cells along a side of each grid.
const GRIDS: [usize; 3] = [8, 4, 2];
/// Directions that are counted apart, over half a turn.
const DIRECTIONS: usize = 6;
/// Numbers that say what strokes are like.
const STROKES: usize = 8;
/// How many features a drawing has.
pub const FEATURES: usize = DIRECTIONS * (8 * 8 + 4 * 4 + 2 * 2) + STROKES;

/// Step along lines at which they are counted, as a share of the drawing's longer side.
const STEP: f32 = 0.01;
/// Step at which their turns are measured.
const TURN_STEP: f32 = 0.03;
/// Turn at a step from which it is a corner, radians.
const CORNER: f32 = 1.2;
/// Gap between a stroke's ends, as a share of its length, below which it is closed.
const CLOSED: f32 = 0.15;

/// The features of a drawing, from its lines; none if it has no extent.
pub fn features<L: AsRef<[Vec2]>>(lines: &[L]) -> Option<Vec<f32>> {
    let (low, high) = polyline::bounds(lines.iter().flat_map(|line| line.as_ref()).copied());
    let size = (high - low).max_element();
    if !(size.is_finite() && size > 0.0) {
        return None;
    }
    let middle = low.midpoint(high);
    let of_square = |p: Vec2| (p - middle) / size + 0.5;
    let scaled: Vec<Vec<Vec2>> =
        lines.iter().map(|line| line.as_ref().iter().copied().map(of_square).collect()).collect();
    let mut all = Vec::with_capacity(FEATURES);
    for cells in GRIDS {
        all.extend(histogram(&scaled, cells));
    }
    all.extend(of_strokes(&scaled, (high - low) / size));
    Some(all)
}

/// Roots of the lengths of line by row, column and direction, as a vector of length 1.
fn histogram(lines: &[Vec<Vec2>], cells: usize) -> Vec<f32> {
    let mut lengths = vec![0.0_f32; cells * cells * DIRECTIONS];
    for pair in lines.iter().flat_map(|line| line.windows(2)) {
        let along = pair[1] - pair[0];
        let length = along.length();
        let direction = along.y.atan2(along.x).rem_euclid(PI) / PI * DIRECTIONS as f32;
        let steps = (length / STEP).floor().max(1.0);
        for step in 0..steps as usize {
            let at = (pair[0] + along * ((step as f32 + 0.5) / steps)) * cells as f32 - 0.5;
            add(&mut lengths, cells, at, direction, length / steps);
        }
    }
    lengths.iter_mut().for_each(|length| *length = length.sqrt());
    let norm = lengths.iter().map(|root| root * root).sum::<f32>().sqrt().max(1e-6);
    lengths.iter_mut().for_each(|root| *root /= norm);
    lengths
}

/// Shares a length of line out among four cells and two directions.
fn add(lengths: &mut [f32], cells: usize, at: Vec2, direction: f32, length: f32) {
    let (cell, part) = (at.floor(), at - at.floor());
    let (first, turned) = (direction.floor(), direction - direction.floor());
    let directions =
        [(first as usize % DIRECTIONS, 1.0 - turned), ((first as usize + 1) % DIRECTIONS, turned)];
    let place = |p: f32| p.clamp(0.0, (cells - 1) as f32) as usize;
    for (x, across) in [(place(cell.x), 1.0 - part.x), (place(cell.x + 1.0), part.x)] {
        for (y, up) in [(place(cell.y), 1.0 - part.y), (place(cell.y + 1.0), part.y)] {
            for (direction, share) in directions {
                lengths[(y * cells + x) * DIRECTIONS + direction] += length * across * up * share;
            }
        }
    }
}

/// What the strokes of a drawing are like, whose width and height are given.
fn of_strokes(lines: &[Vec<Vec2>], size: Vec2) -> [f32; STROKES] {
    let (mut turns, mut corners, mut closed, mut length) = (0.0, 0, 0, 0.0);
    for line in lines {
        let own = polyline::length(line);
        length += own;
        if line.len() < 3 {
            continue;
        }
        closed += usize::from(line[0].distance(line[line.len() - 1]) < CLOSED * own);
        let arcs = polyline::arc_lengths(line.iter().copied());
        let steps = ((own / TURN_STEP) as usize).max(2);
        let at =
            |k: usize| polyline::interpolate(line, polyline::locate(&arcs, own * k as f32 / steps as f32));
        for k in 1..steps {
            let turn = (at(k) - at(k - 1)).angle_to(at(k + 1) - at(k)).abs();
            if turn.is_finite() {
                turns += turn;
                corners += usize::from(turn > CORNER);
            }
        }
    }
    let strokes = lines.len() as f32;
    [
        strokes.ln() / 3.0,
        (length + 1.0).ln() / 3.0,
        (turns + 1.0).ln() / 5.0,
        (corners as f32 + 1.0).ln() / 4.0,
        closed as f32 / strokes,
        (closed as f32 + 1.0).ln() / 3.0,
        size.x,
        size.y,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    fn circle(middle: Vec2, radius: f32) -> Vec<Vec2> {
        (0..=60).map(|k| middle + radius * Vec2::from_angle(TAU * k as f32 / 60.0)).collect()
    }

    #[test]
    fn place_and_size_do_not_matter_and_form_does() {
        let form = |at: Vec2, radius: f32| {
            let stem = (0..=30).map(|k| at + radius * Vec2::new(0.0, 1.0 + 0.1 * k as f32)).collect();
            features(&[circle(at, radius), stem]).unwrap()
        };
        let (a, b) = (form(Vec2::ZERO, 10.0), form(Vec2::new(300.0, -70.0), 55.0));
        let other = features(&[circle(Vec2::ZERO, 10.0)]).unwrap();
        let away = |x: &[f32], y: &[f32]| x.iter().zip(y).map(|(x, y)| (x - y).abs()).fold(0.0, f32::max);
        assert_eq!(a.len(), FEATURES);
        assert!(away(&a, &b) < 1e-3 && away(&a, &other) > 0.1);
    }

    #[test]
    fn a_line_counts_in_its_direction() {
        let level = (0..=10).map(|k| Vec2::new(k as f32, 0.0)).collect();
        let counts = histogram(&[level], 1);
        assert!(counts[0] > 0.99 && counts[3] < 0.01, "{counts:?}");
    }

    #[test]
    fn a_dot_has_none() {
        assert!(features(&[vec![Vec2::ONE; 3]]).is_none() && features::<Vec<Vec2>>(&[]).is_none());
    }
}
