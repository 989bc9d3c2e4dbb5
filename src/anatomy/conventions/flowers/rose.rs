//! A rose: a spiral, arcs in a disc, or a few outlines around a small ring, at the upper end of a stem.
//!
//! A spiral winds at least [`TURNS`] around its inner end, always in one direction, and ends farther out than it began; arcs may bend around
//! it, the edges of outer petals. A disc is
//! a round closed line with at least [`ARCS`] lines within that bend around its middle as the edges of petals do, none straight as
//! veins are. One stem line carries either, or both sides of a stem, and nothing else comes near. What a hand only hints at is drawn in full: broad
//! petals in three rings ([`RINGS`]) that fill the head and overlap.
//!
//! Limits: stem and spiral in one stroke are the curled tip of a fern as well, and are left to the classifier.

use super::corolla_on_stem::stem_top;
use crate::anatomy::conventions::page::{self, Line, Page};
use crate::anatomy::conventions::shapes::silhouette::{Silhouette, smooth_contour};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::{
    polyline,
    simple_loop::{self, hull_area},
};
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::f32::consts::{PI, TAU};

/// Least turns of a spiral, and least share of its turning that goes one way.
const TURNS: f32 = 1.6;
const ONE_WAY: f32 = 0.85;
/// Farthest that a spiral's beginning is from its inner end, on the average, as a share of its end's.
const OUTWARD: f32 = 0.6;
/// Fewest arcs in a disc, and how much each turns at least, radians; the same of edges beside them.
const ARCS: usize = 2;
const BENDS: f32 = 0.9;
const EDGE: f32 = 0.45;
/// How far edges reach beyond the head that they lie in at most, as a share of its size.
const OVER: f32 = 0.04;
/// Arcs around a spiral: nearest and farthest from its middle, in its radii, most of the farthest point over the nearest, and least angle
/// about the middle, radians.
const AROUND: (f32, f32, f32, f32) = (0.9, 3.2, 1.9, 0.8);
/// Narrowest head, its width over its height or the other way round.
const ROUND: f32 = 0.6;
/// How near to a head a line counts, in its sizes, and most lines that are looked at.
const NEAR: f32 = 0.15;
const MOST_LINES: usize = 32;
/// Petals of each ring, their reach in radii of the head, and half width as a share of that.
const RINGS: [(usize, f32, f32); 3] = [(6, 1.0, 0.6), (5, 0.72, 0.66), (4, 0.45, 0.7)];
/// Points of each side of a petal.
const SIDE: usize = 16;

/// Fewest lines of a head of several, and most of a group; smallest and largest ring in it, as a share of its size.
const SEVERAL: (usize, usize) = (3, 16);
const RING: (f32, f32) = (0.12, 0.55);
/// The largest spiral in it.
const SPIRAL: f32 = 0.8;
/// Least share of its hull that such a head fills, and of what is drawn that lies in it.
const FULL: (f32, f32) = (0.86, 0.95);
/// How near its stem ends, and how far away that begins at least, as shares of its size; upper part of the stem by which it stands.
const STEM: (f32, f32) = (0.2, 0.35);
const LOWER: f32 = 0.75;
/// How wide gaps are closed, in cells of the silhouette, and points of the outline.
const BRIDGE: i32 = 12;
const POINTS: usize = 120;
/// Of a stem by its two sides: how far apart they come to the head, as a share of its width, and the least length of one, as a share of the
/// other's.
const SIDES: (f32, f32) = (0.35, 0.7);
/// Log-odds of a rose.
const SCORE: f32 = 4.2;

/// Proposes a rose for each spiral or disc on a stem, and for each group of lines that is one together.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let several = page.groups.iter().filter(|group| (SEVERAL.0 + 1..=SEVERAL.1).contains(&group.len()));
    out.extend(several.filter_map(|group| group.iter().find_map(|stem| of_several(page, group, *stem))));
    let is_head = |line: &Line| {
        let size = line.size();
        size.min_element() > ROUND * size.max_element() && (is_spiral(line) || line.is_closed_and_solid())
    };
    let heads: Vec<usize> = (0..page.lines.len()).filter(|i| is_head(&page.lines[*i])).collect();
    let grown = |i: &usize| {
        let line = &page.lines[*i];
        let margin = if is_spiral(line) { AROUND.1 } else { NEAR };
        (line.bounds.0 - margin * line.size(), line.bounds.1 + margin * line.size())
    };
    let boxes: Vec<(Vec2, Vec2)> = heads.iter().map(grown).collect();
    let near = page.lines_at(&boxes);
    out.extend(heads.iter().zip(near).filter_map(|(head, near)| rose(page, *head, &near)));
}

/// The rose of several lines at an end of a line of their group.
fn of_several(page: &Page, group: &[usize], stem: usize) -> Option<Hypothesis> {
    let line = &page.lines[stem];
    if line.openness < 0.6 {
        return None;
    }
    let way = line.upward();
    let top = way[way.len() - 1];
    // Leaves and thorns along the stem are no part of its head.
    let lower = &way[..((LOWER * way.len() as f32) as usize).max(1)];
    let near = 0.08 * line.size().length();
    let is_beside = |other: &Line| {
        let gaps = other.points.iter().filter_map(|p| polyline::nearest(lower, *p));
        gaps.map(|(gap, _)| gap).fold(f32::INFINITY, f32::min) < near
    };
    let head: Vec<usize> =
        group.iter().copied().filter(|i| *i != stem && !is_beside(&page.lines[*i])).collect();
    let lines: Vec<&Line> = head.iter().map(|i| &page.lines[*i]).collect();
    let (low, high) = page::bounds(lines.iter().copied());
    let size = (high - low).max_element();
    let is_ring = |line: &&Line| {
        let share = line.size().max_element() / size;
        let is_closed = line.is_closed_and_solid() && share < RING.1;
        share > RING.0 && (is_closed || share < SPIRAL && is_spiral(line))
    };
    if head.len() < SEVERAL.0 || lines.iter().filter(|line| is_ring(line)).count() != 1 {
        return None;
    }
    let drawn = || lines.iter().map(|line| line.points.as_slice());
    let silhouette = Silhouette::new(drawn(), BRIDGE);
    let outline = smooth_contour(&silhouette.contour(), POINTS, 1);
    let is_full = simple_loop::area(&outline) > FULL.0 * hull_area(&outline)
        && silhouette.share_inside(drawn().flatten()) > FULL.1;
    let gap = |p: Vec2| polyline::nearest(&outline, p).map_or(f32::INFINITY, |(gap, _)| gap);
    let stands = gap(top) < STEM.0 * size && gap(way[0]) > STEM.1 * size;
    let is_round = (high - low).min_element() > ROUND * size;
    (is_full && stands && is_round).then(|| Hypothesis {
        uses: head,
        score: SCORE,
        parts: petals(low.midpoint(high), 0.5 * (high - low)),
        solids: Vec::new(),
        reading: Reading::Corolla,
        habit: Some(Habit::Flower),
    })
}

fn rose(page: &Page, number: usize, near: &[usize]) -> Option<Hypothesis> {
    let head = &page.lines[number];
    let is_wound = is_spiral(head);
    let is_arc = |i: &usize| is_wound && *i != number && bends_around(&page.lines[*i], head);
    let arcs: Vec<usize> = near.iter().copied().filter(is_arc).collect();
    let edges = || arcs.iter().chain([&number]).map(|i| &page.lines[*i]);
    let (low, high) = page::bounds(edges());
    let margin = NEAR * (high - low);
    let is_near = |i: &usize| {
        let (from, to) = page.lines[*i].bounds;
        from.cmple(high + margin).all() && to.cmpge(low - margin).all() && *i != number && !arcs.contains(i)
    };
    let others: Vec<usize> = near.iter().copied().filter(is_near).collect();
    if others.is_empty() || others.len() > MOST_LINES {
        return None;
    }
    let (stems, within): (Vec<usize>, Vec<usize>) =
        others.iter().partition(|i| edges().any(|edge| stem_top(&page.lines[**i], edge).is_some()));
    let is_inside = |i: &usize| {
        let (line, over) = (&page.lines[*i], OVER * (high - low));
        line.bounds.0.cmpge(low - over).all() && line.bounds.1.cmple(high + over).all()
    };
    let bends = |i: &usize| turning(&page.lines[*i].points).1;
    let has_stem = stems.len() == 1 || are_sides(page, &stems, head);
    let is_alone = has_stem && within.iter().all(|i| is_inside(i) && bends(i) > EDGE);
    let is_rose = is_wound || within.iter().filter(|i| bends(i) > BENDS).count() >= ARCS;
    if !is_alone || !is_rose {
        return None;
    }
    let mut uses: Vec<usize> = within.into_iter().chain(arcs).chain([number]).collect();
    uses.sort_unstable();
    let (reading, habit) = (Reading::Corolla, Some(Habit::Flower));
    Some(Hypothesis {
        uses,
        score: SCORE,
        parts: petals(low.midpoint(high), 0.5 * (high - low)),
        solids: Vec::new(),
        reading,
        habit,
    })
}

/// Whether a line bends around a spiral, at about one distance, and does not belong to it.
fn bends_around(line: &Line, spiral: &Line) -> bool {
    let (middle, radius) = (spiral.middle(), 0.5 * spiral.size().max_element());
    let away = line.points.iter().map(|p| p.distance(middle) / radius);
    let (least, most) = away.fold((f32::INFINITY, 0.0_f32), |(least, most), d| (least.min(d), most.max(d)));
    let swept: f32 = line.points.windows(2).map(|p| (p[0] - middle).angle_to(p[1] - middle)).sum();
    least > AROUND.0
        && most < AROUND.1.min(AROUND.2 * least)
        && swept.abs() > AROUND.3
        && turning(&line.points).1 > BENDS
}

/// Whether two stems are the sides of one: they come to the head side by side and are about as long.
fn are_sides(page: &Page, stems: &[usize], head: &Line) -> bool {
    let [a, b] = stems else { return false };
    let (a, b) = (&page.lines[*a], &page.lines[*b]);
    let tops = stem_top(a, head).zip(stem_top(b, head));
    let is_near = tops.is_some_and(|(a, b)| a.distance(b) < SIDES.0 * head.size().x);
    is_near && a.length.min(b.length) > SIDES.1 * a.length.max(b.length)
}

/// Whether a line winds outward around one of its ends, always in one direction.
fn is_spiral(line: &Line) -> bool {
    let winds = |points: &[Vec2]| {
        let (once, all) = turning(points);
        let third = points.len() / 3;
        let away = |part: &[Vec2]| {
            part.iter().map(|p| p.distance(points[0])).sum::<f32>() / part.len().max(1) as f32
        };
        once > TURNS * TAU
            && once > ONE_WAY * all
            && away(&points[..third]) < OUTWARD * away(&points[2 * third..])
    };
    let reversed: Vec<Vec2> = line.points.iter().rev().copied().collect();
    winds(&line.points) || winds(&reversed)
}

/// How much a line turns in all, both ways counted against each other and together.
fn turning(points: &[Vec2]) -> (f32, f32) {
    // Steps wide enough that the tremor of a hand does not count.
    let step = (points.len() / 40).max(1);
    let coarse: Vec<Vec2> = points.iter().copied().step_by(step).collect();
    let turns = coarse.windows(3).map(|p| (p[1] - p[0]).angle_to(p[2] - p[1]));
    let (once, all) = turns.fold((0.0_f32, 0.0), |(once, all), turn| (once + turn, all + turn.abs()));
    (once.abs(), all)
}

/// Rings of petals that fill a head, by its middle and half its size.
pub(crate) fn petals(middle: Vec2, half: Vec2) -> Vec<Made> {
    let ring = |(number, (count, reach, width)): (usize, (usize, f32, f32))| {
        (0..count).map(move |k| {
            let turn = TAU * (k as f32 / count as f32) + 0.9 * number as f32 + 0.3;
            let (along, across) = (Vec2::from_angle(turn), Vec2::from_angle(turn).perp());
            let side = |i: usize, sign: f32| {
                let t = i as f32 / SIDE as f32;
                let away = (PI * t.powf(1.6)).sin().max(0.0).powf(0.6);
                middle + half * reach * (t * along + sign * width * away * across)
            };
            let out = (0..=SIDE).map(|i| side(i, 1.0));
            Made::new(Tool::Petal, out.chain((0..SIDE).rev().map(|i| side(i, -1.0))).collect::<Vec<_>>())
        })
    };
    RINGS.into_iter().enumerate().flat_map(ring).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// Around the origin so many turns, from one radius to another.
    fn wound(turns: f32, from: f32, to: f32) -> Vec<Vec2> {
        let place = |k: usize| {
            let t = k as f32 / 200.0;
            (from + (to - from) * t) * Vec2::from_angle(turns * TAU * t + 1.0)
        };
        (0..=200).map(place).collect()
    }

    fn arc(height: f32, bow: f32) -> Vec<Vec2> {
        (0..=20)
            .map(|k| PI * k as f32 / 20.0)
            .map(|a| Vec2::new(28.0 * a.cos(), height + bow * a.sin()))
            .collect()
    }

    fn stem() -> Vec<Vec2> {
        vec![Vec2::new(4.0, 220.0), Vec2::new(0.0, 52.0)]
    }

    #[test]
    fn a_spiral_on_both_sides_of_a_stem_is_a_rose() {
        let place = |k: usize| {
            let angle = 0.157 * k as f32;
            0.4 * angle * 3.0 * Vec2::from_angle(angle)
        };
        let spiral: Vec<Vec2> = (0..=140).map(place).collect();
        let side = |x: f32| vec![Vec2::new(x, 150.0), Vec2::new(x, 26.0)];
        let found = read(&[spiral.clone(), side(-4.0), side(5.0)]);
        assert_eq!(found.first().map(|rose| &rose.uses[..]), Some(&[0][..]));
        assert!(read(&[spiral, side(-24.0), side(24.0)]).is_empty(), "two stems");
    }

    #[test]
    fn a_spiral_drawn_either_way_is_a_rose_that_fills_it() {
        let spiral = wound(3.0, 4.0, 50.0);
        for drawn in [spiral.clone(), spiral.into_iter().rev().collect()] {
            let found = read(&[drawn, stem()]);
            let [rose] = &found[..] else { panic!("{} roses", found.len()) };
            assert_eq!((&rose.uses[..], rose.parts.len()), (&[0][..], 15));
            let points = rose.parts.iter().flat_map(|part| &part.points).map(|p| p.position);
            let reach = points.map(Vec2::length).fold(0.0, f32::max);
            assert!((42.0..58.0).contains(&reach), "{reach}");
            assert!(
                rose.parts
                    .iter()
                    .all(|part| part.tool == Tool::Petal && part.points[0].position.length() < 6.0)
            );
        }
    }

    #[test]
    fn arcs_in_a_disc_are_a_rose_but_veins_are_none() {
        let disc = wound(1.0, 50.0, 50.0);
        assert_eq!(read(&[disc.clone(), stem(), arc(-10.0, -18.0), arc(5.0, 20.0)])[0].uses, [0, 2, 3]);
        let edge = [(-40.0, 5.0), (-32.0, 20.0), (-15.0, 30.0)].map(Vec2::from).to_vec();
        let arcs = [arc(-10.0, -18.0), arc(5.0, 20.0)];
        assert_eq!(read(&[vec![disc.clone(), stem(), edge], arcs.to_vec()].concat())[0].uses, [0, 2, 3, 4]);
        let midrib = vec![Vec2::new(0.0, 48.0), Vec2::new(0.0, -40.0)];
        let vein = vec![Vec2::new(0.0, 20.0), Vec2::new(25.0, -10.0)];
        assert!(read(&[disc.clone(), stem(), midrib, vein]).is_empty());
        assert!(read(&[disc, stem()]).is_empty(), "a disc on a line");
    }

    #[test]
    fn without_a_stem_or_with_scribbles_it_is_none() {
        assert!(read(&[wound(3.0, 4.0, 50.0)]).is_empty());
        let scribble: Vec<Vec2> = (0..400)
            .map(|k| 0.05 * k as f32)
            .map(|t| Vec2::new(50.0 * (1.31 * t).cos(), 50.0 * (2.17 * t).sin()))
            .collect();
        assert!(read(&[scribble, stem()]).is_empty());
    }

    #[test]
    fn arcs_that_bend_around_a_spiral_are_its_outer_petals() {
        let spiral = wound(3.0, 4.0, 30.0);
        let around = |from: f32, to: f32, radius: f32| -> Vec<Vec2> {
            (0..=30).map(|k| radius * Vec2::from_angle(from + (to - from) * k as f32 / 30.0)).collect()
        };
        let (left, right, under) = (around(2.2, 4.2, 48.0), around(-1.0, 1.0, 48.0), around(0.5, 2.6, 62.0));
        let stem = vec![Vec2::new(3.0, 260.0), Vec2::new(0.0, 66.0)];
        let found = read(&[spiral.clone(), left, right, under, stem.clone()]);
        let [rose] = &found[..] else { panic!("{} roses", found.len()) };
        assert_eq!(rose.uses, [0, 1, 2, 3]);
        let reach = rose.parts.iter().flat_map(|part| &part.points).map(|p| p.position.length());
        assert!(reach.fold(0.0, f32::max) > 45.0, "as large as its arcs");
        // A line that turns its back to the spiral is no petal of it, but nothing keeps the spiral from being a rose.
        let leaf = vec![Vec2::new(70.0, -30.0), Vec2::new(60.0, 0.0), Vec2::new(70.0, 30.0)];
        assert!(read(&[spiral, leaf, stem]).iter().all(|rose| rose.uses == [0]));
    }
}
