//! An outline cut at its notches toward a centre: each stretch between two of them is a petal or a leaflet.
//!
//! A notch is where a line comes near the centre and leaves it again. Along the line the distance to the centre falls and
//! rises; a notch is the lowest place between a fall and a rise of [`DEPTH`] of the largest distance at least, so the tremor of
//! a hand makes none. The sides of a polygon come near its middle as well, without a bend inward: at a notch the line must lie
//! [`BEND`] of the chord of its surroundings nearer to the centre than that chord does, unless it passes
//! through the centre itself ([`THERE`]). Distances are measured in half sizes of
//! what stands in the centre, so a corolla seen from the side, whose centre is an ellipse, is cut as if seen from above. Crossings
//! do not matter, nor whether the line closes. Cost: linear.
//!
//! Limits: lobes that overhang their neighbours so far that a ray from the centre meets them twice may be cut once too often.

use glam::Vec2;
use std::f32::consts::TAU;

/// Least fall and rise of the distance at a notch, as a share of the largest distance.
const DEPTH: f32 = 0.1;
/// Least depth of a notch below the chord of its surroundings, as a share of the chord: a bend of 23° in all.
const BEND: f32 = 0.1;
/// Distance within which a line is at the centre itself and may go straight on, as a share of the largest distance.
const THERE: f32 = 0.2;
/// How far the surroundings of a notch reach, as a share of the shorter of its two lobes.
const SURROUNDINGS: f32 = 0.15;

/// What lobes stand around.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Focus {
    /// Where they come from.
    pub place: Vec2,
    /// Half width and half height of a distance of 1.
    pub half: Vec2,
}

impl Focus {
    /// A place around which distances are the same in all directions.
    pub(crate) fn round(place: Vec2, radius: f32) -> Self {
        Self { place, half: Vec2::splat(radius.max(f32::MIN_POSITIVE)) }
    }

    /// Distance of a place.
    pub(crate) fn distance(&self, p: Vec2) -> f32 {
        ((p - self.place) / self.half).length()
    }

    /// Largest distance of some places.
    pub(crate) fn reach(&self, points: &[Vec2]) -> f32 {
        points.iter().map(|p| self.distance(*p)).fold(0.0, f32::max)
    }
}

/// The stretches of a line between its notches; of a closed one the stretch over its ends is one, too. Neighbours share the
/// notch between them.
pub(crate) fn cut(points: &[Vec2], focus: &Focus, is_closed: bool) -> Vec<Vec<Vec2>> {
    if points.len() < 3 {
        return Vec::new();
    }
    if !is_closed {
        return stretches(points, &notches(points, focus));
    }
    // Once around from any notch: the ends of the stroke are no notch by themselves.
    let ring = &points[..points.len() - 1];
    let lowest = (0..ring.len()).min_by(|a, b| focus.distance(ring[*a]).total_cmp(&focus.distance(ring[*b])));
    let around = turned(ring, lowest.unwrap_or(0));
    match notches(&around, focus).first() {
        Some(&first) => {
            let around = turned(&around[..ring.len()], first);
            stretches(&around, &notches(&around, focus))
        }
        None => vec![around],
    }
}

/// A ring from one of its points back to it.
fn turned(ring: &[Vec2], from: usize) -> Vec<Vec2> {
    (0..=ring.len()).map(|k| ring[(from + k) % ring.len()]).collect()
}

/// The stretches of a line between some of its inner points.
pub(crate) fn stretches(points: &[Vec2], notches: &[usize]) -> Vec<Vec<Vec2>> {
    let ends = notches.iter().copied().chain([points.len() - 1]);
    let begins = std::iter::once(0).chain(notches.iter().copied());
    begins
        .zip(ends)
        .filter(|(begin, end)| begin + 1 < *end)
        .map(|(begin, end)| points[begin..=end].to_vec())
        .collect()
}

/// Inner points of a line at its notches, ascending.
fn notches(points: &[Vec2], focus: &Focus) -> Vec<usize> {
    let distances: Vec<f32> = points.iter().map(|p| focus.distance(*p)).collect();
    let reach = distances.iter().copied().fold(0.0, f32::max);
    let mut found = valleys(&distances);
    // A shallow valley that goes makes its neighbours' lobes longer, so it is asked again until all that remain bend inward.
    loop {
        let last = points.len() - 1;
        let sides = |k: usize| {
            let before = if k == 0 { 0 } else { found[k - 1] };
            (before, found.get(k + 1).copied().unwrap_or(last))
        };
        let is_there = |k: usize| distances[found[k]] < THERE * reach;
        let bend = |k: usize| if is_there(k) { BEND } else { bend(points, sides(k), found[k], focus) };
        let bends: Vec<f32> = (0..found.len()).map(bend).collect();
        let flattest = (0..found.len()).min_by(|a, b| bends[*a].total_cmp(&bends[*b]));
        match flattest {
            Some(k) if bends[k] < BEND => drop(found.remove(k)),
            _ => return found,
        }
    }
}

/// Lowest places between falls and rises of [`DEPTH`].
pub(crate) fn valleys(distances: &[f32]) -> Vec<usize> {
    valleys_between(distances, DEPTH * distances.iter().copied().fold(0.0, f32::max))
}

/// Lowest places between falls and rises of `step`.
pub(crate) fn valleys_between(distances: &[f32], step: f32) -> Vec<usize> {
    let (mut highest, mut lowest, mut falls) = (0.0_f32, 0, false);
    let mut found = Vec::new();
    for (i, &distance) in distances.iter().enumerate() {
        if falls && distance < distances[lowest] {
            lowest = i;
        } else if falls && distance > distances[lowest] + step {
            found.push(lowest);
            (falls, highest) = (false, distance);
        } else if !falls && distance < highest - step {
            (falls, lowest) = (true, i);
        }
        highest = highest.max(distance);
    }
    found
}

/// How much nearer to the focus a place is than the chord of its surroundings, as a share of the chord.
fn bend(points: &[Vec2], (before, after): (usize, usize), at: usize, focus: &Focus) -> f32 {
    let shorter = (at - before).min(after - at);
    let reach = ((shorter as f32 * SURROUNDINGS) as usize).max(1);
    let (a, b) = (points[at - reach], points[at + reach]);
    let middle = a.midpoint(b);
    let inward = (focus.place - middle).normalize_or_zero();
    (points[at] - middle).dot(inward) / a.distance(b).max(f32::MIN_POSITIVE)
}

/// The number of the point that is nearest to a place; 0 of none.
pub(crate) fn nearest(points: &[Vec2], place: Vec2) -> usize {
    let away = |i: &usize| points[*i].distance_squared(place);
    (0..points.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0)
}

/// A closed outline from one of its points around and back to it.
pub(crate) fn around_from(outline: &[Vec2], at: usize) -> Vec<Vec2> {
    let (before, after) = outline.split_at(at);
    after.iter().chain(before).chain(after.first()).copied().collect()
}

/// A stretch as the outline of a petal or leaf: from its root out, around and back.
pub(crate) fn rooted(stretch: &[Vec2], root: Vec2) -> Vec<Vec2> {
    std::iter::once(root).chain(stretch.iter().copied()).chain([root]).collect()
}

/// How far a stretch's ends are from the focus, as a share of its reach.
pub(crate) fn depth(stretch: &[Vec2], focus: &Focus) -> f32 {
    0.5 * (focus.distance(stretch[0]) + focus.distance(stretch[stretch.len() - 1])) / focus.reach(stretch)
}

/// Where a petal points from a place.
pub(crate) fn direction(stretch: &[Vec2], place: Vec2) -> Vec2 {
    (stretch.iter().sum::<Vec2>() / stretch.len() as f32 - place).normalize_or_zero()
}

/// Angle around a place in which there are petals.
pub(crate) fn around(petals: &[Vec<Vec2>], place: Vec2) -> f32 {
    const SECTORS: usize = 72;
    let mut is_filled = [false; SECTORS];
    for p in petals.iter().flatten() {
        let share = (p - place).to_angle().rem_euclid(TAU) / TAU;
        is_filled[((share * SECTORS as f32) as usize).min(SECTORS - 1)] = true;
    }
    is_filled.iter().filter(|filled| **filled).count() as f32 * TAU / SECTORS as f32
}

/// A loop that begins and ends where it is nearest to the centre.
pub(crate) fn from_nearest(points: &[Vec2], focus: &Focus) -> Vec<Vec2> {
    let nearest =
        (0..points.len()).min_by(|a, b| focus.distance(points[*a]).total_cmp(&focus.distance(points[*b])));
    let mut around = points.to_vec();
    around.rotate_left(nearest.unwrap_or(0));
    around
}

/// Widest angle between neighbouring petals' directions.
pub(crate) fn widest_gap(petals: &[Vec<Vec2>], place: Vec2) -> f32 {
    let mut angles: Vec<f32> = petals.iter().map(|petal| direction(petal, place).to_angle()).collect();
    angles.sort_by(f32::total_cmp);
    angles.extend(angles.first().map(|first| first + TAU));
    angles.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f32::max)
}

/// Angle that a line turns around a place, without sign.
pub(crate) fn winding(points: &[Vec2], place: Vec2) -> f32 {
    points.windows(2).map(|pair| (pair[0] - place).angle_to(pair[1] - place)).sum::<f32>().abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::FRAC_PI_2;

    /// A ring of semicircles around the origin.
    fn scallops(count: usize, depth: f32) -> Vec<Vec2> {
        let turn = |k: usize| TAU * k as f32 / 400.0;
        let lobe = |angle: f32| 1.0 + depth * (angle * count as f32 / 2.0).sin().abs();
        (0..=400).map(|k| 50.0 * lobe(turn(k)) * Vec2::from_angle(turn(k) + 0.7)).collect()
    }

    fn count(points: &[Vec2], is_closed: bool) -> usize {
        cut(points, &Focus::round(Vec2::ZERO, 50.0), is_closed).len()
    }

    #[test]
    fn every_scallop_is_a_lobe_and_the_ends_of_the_stroke_are_none() {
        for lobes in [3, 5, 8, 16] {
            let mut ring = scallops(lobes, 0.35);
            assert_eq!(count(&ring, true), lobes);
            ring.pop();
            ring.rotate_left(17);
            ring.push(ring[0]);
            assert_eq!(count(&ring, true), lobes, "begun elsewhere");
        }
    }

    #[test]
    fn polygons_ellipses_and_trembling_circles_have_no_lobes() {
        let corner = |k: usize| 50.0 * Vec2::from_angle(k as f32 * FRAC_PI_2);
        let square: Vec<Vec2> =
            (0..=400).map(|k| corner(k / 100).lerp(corner(k / 100 + 1), (k % 100) as f32 / 100.0)).collect();
        assert_eq!(count(&square, true), 1);
        let ellipse: Vec<Vec2> =
            (0..=200).map(|k| Vec2::new(50.0, 20.0) * Vec2::from_angle(TAU * k as f32 / 200.0)).collect();
        assert_eq!(count(&ellipse, true), 1);
        assert_eq!(count(&scallops(7, 0.06), true), 1);
    }

    #[test]
    fn an_open_line_keeps_its_ends() {
        let open = &scallops(6, 0.4)[..=200];
        let lobes = cut(open, &Focus::round(Vec2::ZERO, 50.0), false);
        assert_eq!(lobes.len(), 3);
        assert_eq!((lobes[0][0], lobes[2].last()), (open[0], open.last()));
        assert_eq!(lobes[0].last(), lobes[1].first());
    }

    #[test]
    fn a_ring_seen_from_the_side_is_cut_by_the_size_of_its_centre() {
        let flat: Vec<Vec2> = scallops(8, 0.35).into_iter().map(|p| p * Vec2::new(1.0, 0.3)).collect();
        let focus = Focus { place: Vec2::ZERO, half: Vec2::new(20.0, 6.0) };
        assert_eq!(cut(&flat, &focus, true).len(), 8);
    }
}
