//! Further rings of petals around a corolla, as of a dahlia: closed outlines that stand all around it, one ring after the other.
//!
//! A ring is what touches or nearly touches the petals within it and goes farther out: at least [`FEWEST`] outlines of about one size, with no
//! wide gap between them. Each becomes a petal from the flower's centre.
//!
//! Limits: rings that are not drawn all around; petals of a ring that are open arcs are read with those around the centre.

use crate::anatomy::conventions::page::{Line, Page, median};
use crate::anatomy::conventions::shapes::lobes::{self, Focus};
use crate::geom::simple_loop;
use glam::Vec2;

/// Fewest petals of a ring, most rings, and most lines of a page: all are looked at for each corolla.
const FEWEST: usize = 6;
const MOST: (usize, usize) = (6, 1000);
/// Widest angle between neighbours of a ring, radians.
const GAP: f32 = 1.5;
/// Most gap of a petal's outline, and least share of its hull that it fills.
const CLOSED: (f32, f32) = (0.3, 0.75);
/// Area of a petal, least and most, as a share of the middle one of the ring within.
const AREA: (f32, f32) = (0.3, 3.5);
/// Where a ring begins and ends, as shares of the reach of the one within: its feet at most, its tips at least and at most.
const REACH: (f32, f32, f32) = (1.25, 1.05, 2.2);

/// The petals of further rings around those of a corolla, each with its line, from where it is nearest to the centre and back.
pub(crate) fn around(
    page: &Page,
    focus: &Focus,
    petals: &[Vec<Vec2>],
    uses: &[usize],
) -> Vec<(usize, Vec<Vec2>)> {
    let mut all: Vec<(usize, Vec<Vec2>)> = Vec::new();
    let mut last = Ring::of(petals, focus);
    let most = if page.lines.len() > MOST.1 { 0 } else { MOST.0 };
    for _ in 0..most {
        let is_new =
            |i: &usize| !page.is_apart(*i) && !uses.contains(i) && all.iter().all(|(line, _)| line != i);
        let follows = |i: &usize| last.is_followed_by(&page.lines[*i], focus);
        let lines: Vec<usize> = (0..page.lines.len()).filter(follows).filter(is_new).collect();
        let outlines: Vec<Vec<Vec2>> =
            lines.iter().map(|i| lobes::from_nearest(&page.lines[*i].points, focus)).collect();
        if lines.len() < FEWEST || lobes::widest_gap(&outlines, focus.place) > GAP {
            break;
        }
        last = Ring::of(&outlines, focus);
        all.extend(lines.into_iter().zip(outlines));
    }
    all
}

/// What the next ring is measured by.
struct Ring {
    /// How far its petals reach on the average, in half sizes of the centre.
    reach: f32,
    /// The middle one of their areas, square pixels.
    area: f32,
}

impl Ring {
    /// That of at least one petal.
    fn of(petals: &[Vec<Vec2>], focus: &Focus) -> Self {
        let reach = petals.iter().map(|petal| focus.reach(petal)).sum::<f32>() / petals.len() as f32;
        let mut areas: Vec<f32> = petals.iter().map(|petal| simple_loop::area(petal)).collect();
        Self { reach, area: median(&mut areas) }
    }

    /// Whether a line may be a petal of the ring around this one.
    fn is_followed_by(&self, line: &Line, focus: &Focus) -> bool {
        let far = focus.half * REACH.2 * self.reach;
        let is_near =
            line.bounds.0.cmpgt(focus.place - far).all() && line.bounds.1.cmplt(focus.place + far).all();
        let is_petal = is_near
            && line.openness < CLOSED.0
            && line.solidity() > CLOSED.1
            && (AREA.0..AREA.1).contains(&(line.area / self.area));
        let distances = || line.points.iter().map(|p| focus.distance(*p));
        is_petal
            && distances().fold(f32::INFINITY, f32::min) < REACH.0 * self.reach
            && (REACH.1 * self.reach..REACH.2 * self.reach).contains(&distances().fold(0.0, f32::max))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    /// So many ellipses around the origin, their middles so far out.
    fn ring(count: usize, away: f32, share: f32) -> Vec<Vec<Vec2>> {
        let petal = |k: usize| {
            let along = Vec2::from_angle(share * TAU * k as f32 / count as f32);
            let place = |i: usize| {
                let turn = TAU * i as f32 / 40.0;
                (away + 20.0 * turn.cos()) * along + 12.0 * turn.sin() * along.perp()
            };
            (0..=40).map(place).collect()
        };
        (0..count).map(petal).collect()
    }

    fn found(rings: &[Vec<Vec<Vec2>>]) -> usize {
        let page = Page::of_lines(&rings.concat());
        let uses: Vec<usize> = (0..rings[0].len()).collect();
        around(&page, &Focus::round(Vec2::ZERO, 12.0), &rings[0], &uses).len()
    }

    #[test]
    fn rings_all_around_are_found_one_after_the_other_and_leaves_beside_them_are_none() {
        let inner = ring(8, 35.0, 1.0);
        assert_eq!(found(&[inner.clone(), ring(11, 72.0, 1.0), ring(14, 110.0, 1.0)]), 25);
        assert_eq!(found(&[inner.clone(), ring(11, 110.0, 1.0)]), 0, "nothing between");
        assert_eq!(found(&[inner, ring(6, 72.0, 0.4)]), 0, "on one side");
    }
}
