//! In which order the strokes of a lobe stand along it.
//!
//! Strokes may be drawn in any order (001 §5.2.1): a new loop goes between those two neighbours whose connecting segment its
//! centroid projects onto, nearest first; otherwise before the first or after the last, whichever is nearer. So only the two
//! strips beside it are made anew. Open strokes close the ends: each the end that it is nearer to and that is free.
//!
//! Source: the rule is not described in the paper, which says only that strips follow "the present neighbours".

use super::stroke::Line;
use glam::Vec3;

/// The strokes of a lobe by their numbers, along it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Order {
    /// Loops.
    pub(super) loops: Vec<usize>,
    /// The open strokes that close the first end and the last.
    pub(super) caps: [Option<usize>; 2],
    /// Strokes for which there is no place.
    pub(super) left_out: Vec<usize>,
}

/// Puts strokes in order; where `in_order`, loops already are.
pub(super) fn order(lines: &[Line], in_order: bool) -> Order {
    let mut order = Order::default();
    let loops = (0..lines.len()).filter(|k| lines[*k].closed);
    for new in loops {
        let place = if in_order { order.loops.len() } else { place_of(&order.loops, lines, new) };
        order.loops.insert(place, new);
    }
    let (Some(&first), Some(&last)) = (order.loops.first(), order.loops.last()) else {
        order.left_out = (0..lines.len()).collect();
        return order;
    };
    for open in (0..lines.len()).filter(|k| !lines[*k].closed) {
        let at = lines[open].centroid();
        let at_last = if first == last {
            (at - lines[first].centroid()).dot(lines[first].normal()) > 0.0
        } else {
            at.distance_squared(lines[last].centroid()) < at.distance_squared(lines[first].centroid())
        };
        let wanted = usize::from(at_last);
        match [wanted, 1 - wanted].into_iter().find(|end| order.caps[*end].is_none()) {
            Some(end) => order.caps[end] = Some(open),
            None => order.left_out.push(open),
        }
    }
    order
}

/// Where a new loop belongs among those that are in order.
fn place_of(placed: &[usize], lines: &[Line], new: usize) -> usize {
    let at = lines[new].centroid();
    let centres: Vec<Vec3> = placed.iter().map(|k| lines[*k].centroid()).collect();
    let mut best: Option<(f32, usize)> = None;
    for (k, ends) in centres.windows(2).enumerate() {
        let way = ends[1] - ends[0];
        let share = (at - ends[0]).dot(way) / way.length_squared();
        let distance = at.distance_squared(ends[0] + way * share);
        if (0.0..=1.0).contains(&share) && best.is_none_or(|(nearest, _)| distance < nearest) {
            best = Some((distance, k + 1));
        }
    }
    let (Some(first), Some(last)) = (centres.first(), centres.last()) else { return 0 };
    let nearer_to_first = at.distance_squared(*first) < at.distance_squared(*last);
    best.map_or(if nearer_to_first { 0 } else { placed.len() }, |(_, place)| place)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    fn ring(height: f32) -> Line {
        let at = |k: u32| {
            let (sin, cos) = (k as f32 / 24.0 * TAU).sin_cos();
            Vec3::new(cos, height, sin)
        };
        Line { closed: true, points: (0..24).map(at).collect() }
    }

    fn open(height: f32) -> Line {
        let at = |k: i8| Vec3::new(f32::from(k) * 0.2, height, 0.0);
        Line { closed: false, points: (-3..=3).map(at).collect() }
    }

    #[test]
    fn loops_are_put_between_their_neighbours() {
        let lines = [ring(2.0), ring(0.0), ring(1.0), ring(3.0), ring(-1.0), ring(0.4)];
        let order = order(&lines, false);
        let heights: Vec<f32> = order.loops.iter().map(|k| lines[*k].points[0].y).collect();
        let mut sorted = heights.clone();
        sorted.sort_by(f32::total_cmp);
        let falling: Vec<f32> = sorted.iter().rev().copied().collect();
        assert!(heights == sorted || heights == falling, "{heights:?}");
        assert_eq!(super::order(&lines, true).loops, [0, 1, 2, 3, 4, 5], "what is said counts");
    }

    #[test]
    fn open_strokes_close_the_ends() {
        let lines = [open(4.0), ring(0.0), ring(2.0), open(-1.0), open(5.0)];
        let order = order(&lines, false);
        assert_eq!((order.loops.as_slice(), order.caps), ([1, 2].as_slice(), [Some(3), Some(0)]));
        assert_eq!(order.left_out, [4]);
        let one = super::order(&[ring(0.0), open(1.0), open(-1.0)], false);
        let up = ring(0.0).normal().y > 0.0;
        assert_eq!(one.caps, if up { [Some(2), Some(1)] } else { [Some(1), Some(2)] });
        assert_eq!(super::order(&[open(0.0)], false).left_out, [0]);
    }

    #[test]
    fn loops_in_one_place_are_no_trouble() {
        let order = order(&[ring(0.0), ring(0.0), ring(0.0)], false);
        assert_eq!(order.loops.len(), 3);
    }
}
