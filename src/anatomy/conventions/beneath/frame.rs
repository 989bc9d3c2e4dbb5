//! What stands around or beside plants and is none: windows, frames, fences, jars.
//!
//! A window, a frame or a table is put together from straight lines, level and plumb, each of which meets two of the other kind. It
//! is about as wide as high; what is narrow is a trunk with its bark. A fence is a row of upright lines of one height, evenly spaced, that
//! rails cross in their middle. A jar is an outline around all else, in which a level line from side to side carries what
//! stands on it; its neck and lid are above. None of them becomes a part of a plant, whatever they touch.
//!
//! Limits: frames in one stroke are outlines; a jar without earth is one as well; a fence whose pales have no rail is grass.

use crate::anatomy::conventions::Hypothesis;
use crate::anatomy::conventions::page::{Line, Page, median};
use crate::geom::polyline;
use crate::sketch::Reading;
use glam::Vec2;

/// Least chord of a straight line over its length, and greatest part of its chord that it is off level or plumb.
const STRAIGHT: (f32, f32) = (0.97, 0.1);
/// Shortest such line, as a share of the drawing's diagonal, and most of them that are looked at.
const LONG: f32 = 0.05;
const MOST: usize = 60;
/// Distance within which lines meet, as a share of the drawing's diagonal, and fewest that each meets.
const MEET: f32 = 0.03;
const MET: usize = 2;
/// Least size of a frame, as a share of the drawing's diagonal, and least of its narrower side in the wider.
const SIZE: f32 = 0.25;
const BROAD: f32 = 0.4;
/// Greatest height of a rail, as a share of its width, and least chord over its length.
const RAIL: (f32, f32) = (0.2, 0.9);
/// Least height of a pale over its width, fewest pales, greatest difference of their heights from the middle one, as a share, and
/// widest distance between two, in that of most.
const PALE: (f32, usize, f32, f32) = (1.3, 4, 0.35, 2.2);
/// Part of a pale's height, from above and from below, in which no rail is: the ground is at its foot.
const MIDDLE: f32 = 0.12;
/// Least part of a rail's width that its pales stand along.
const ALONG: f32 = 0.6;
/// Of a jar: largest opening of its outline and least of its hull that it fills; how far from it its earth ends at most, as a
/// share of its width; how high above the earth what grows there begins at most, as a share of the jar's height, and fewest
/// such lines; the part of its height, from above, where lines outside are its neck.
const JAR: (f32, f32) = (0.3, 0.8);
const EARTH: (f32, f32, f32, usize) = (0.08, 0.06, 0.2, 2);
const NECK: f32 = 0.12;
/// Log-odds.
const SCORE: f32 = 3.0;

/// Proposes the frame and the fence of a page.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let found = [fence(page), frame(page), jar(page)].into_iter().flatten().next();
    out.extend(found.map(|uses| Hypothesis::apart(uses, SCORE, Reading::Frame)));
}

/// The pales and rails of a fence, ascending.
fn fence(page: &Page) -> Option<Vec<usize>> {
    let lines = || (0..page.lines.len()).filter(|i| !page.is_apart(*i));
    let pales: Vec<usize> = lines().filter(|i| is_pale(&page.lines[*i])).take(MOST).collect();
    if pales.len() < PALE.1 {
        return None;
    }
    let rails = lines().filter(|i| is_rail(&page.lines[*i])).take(MOST);
    let mut best: Vec<usize> = Vec::new();
    let mut crossing: Vec<usize> = Vec::new();
    for rail in rails {
        let own = along(page, rail, &pales);
        if own.len() > best.len() {
            best.clone_from(&own);
        }
        if !own.is_empty() {
            crossing.push(rail);
        }
    }
    if best.is_empty() {
        return None;
    }
    best.extend(crossing);
    best.sort_unstable();
    best.dedup();
    Some(best)
}

fn is_rail(line: &Line) -> bool {
    let size = line.size();
    size.y < RAIL.0 * size.x && line.ends().0.distance(line.ends().1) > RAIL.1 * line.length
}

fn is_pale(line: &Line) -> bool {
    let size = line.size();
    size.y > PALE.0 * size.x && !line.is_scribble()
}

/// Those of some upright lines that a rail crosses in their middle, if they are the pales of a fence.
fn along(page: &Page, rail: usize, pales: &[usize]) -> Vec<usize> {
    let rail = &page.lines[rail];
    let is_crossed = |pale: &&usize| {
        let (low, high) = page.lines[**pale].bounds;
        let x = low.x.midpoint(high.x);
        let at = rail.points.iter().min_by(|a, b| (a.x - x).abs().total_cmp(&(b.x - x).abs()));
        let inner = MIDDLE * (high.y - low.y);
        let is_there = x > rail.bounds.0.x - (high.x - low.x) && x < rail.bounds.1.x + (high.x - low.x);
        is_there && at.is_some_and(|at| at.y > low.y + inner && at.y < high.y - inner)
    };
    let mut own: Vec<usize> = pales.iter().filter(is_crossed).copied().collect();
    let height = |pale: &usize| page.lines[*pale].size().y;
    let mut heights: Vec<f32> = own.iter().map(height).collect();
    if own.len() < PALE.1 {
        return Vec::new();
    }
    let middle = median(&mut heights);
    let is_even = own.iter().all(|pale| (height(pale) - middle).abs() < PALE.2 * middle);
    let place = |pale: &usize| page.lines[*pale].middle().x;
    own.sort_by(|a, b| place(a).total_cmp(&place(b)));
    let mut gaps: Vec<f32> = own.windows(2).map(|pair| place(&pair[1]) - place(&pair[0])).collect();
    let widest = gaps.iter().copied().fold(0.0, f32::max);
    let is_row = widest < PALE.3 * median(&mut gaps);
    let spread = place(&own[own.len() - 1]) - place(&own[0]);
    if is_even && is_row && spread > ALONG * rail.size().x { own } else { Vec::new() }
}

/// The level and plumb lines that make a frame, ascending.
fn frame(page: &Page) -> Option<Vec<usize>> {
    let lines = (0..page.lines.len()).filter(|i| !page.is_apart(*i));
    let level_or_plumb = lines.filter_map(|i| Some((i, is_level(page, &page.lines[i])?))).take(MOST);
    let mut members: Vec<(usize, bool)> = level_or_plumb.collect();
    let reach = MEET * page.diagonal;
    loop {
        let meets = |(i, is_level): &(usize, bool)| {
            let others = members.iter().filter(|other| other.1 != *is_level);
            others.filter(|other| do_meet(&page.lines[*i], &page.lines[other.0], reach)).count() >= MET
        };
        let left: Vec<(usize, bool)> = members.iter().copied().filter(meets).collect();
        if left.len() == members.len() {
            break;
        }
        members = left;
    }
    // The ground under a trunk is wide, and so are both together.
    let spread = |is_level: bool, place: fn(Vec2) -> f32| {
        let of_kind = members.iter().filter(|member| member.1 == is_level);
        let places = of_kind.map(|member| place(page.lines[member.0].middle()));
        let ends = places.fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        (ends.1 - ends.0).max(0.0)
    };
    let size = Vec2::new(spread(false, |p| p.x), spread(true, |p| p.y));
    let is_frame = members.len() >= 2 * MET
        && size.length() > SIZE * page.diagonal
        && size.min_element() > BROAD * size.max_element();
    is_frame.then(|| members.into_iter().map(|member| member.0).collect())
}

/// The outline of a jar with its neck, ascending, if all else is in it and stands on earth there.
fn jar(page: &Page) -> Option<Vec<usize>> {
    let lines = || (0..page.lines.len()).filter(|i| !page.is_apart(*i));
    let area = |i: &usize| page.lines[*i].hull_area;
    let glass = lines().max_by(|a, b| area(a).total_cmp(&area(b)))?;
    let outline = &page.lines[glass];
    if outline.openness > JAR.0 || outline.solidity() < JAR.1 {
        return None;
    }
    let (low, high) = outline.bounds;
    let size = high - low;
    let gap = |p: Vec2| polyline::nearest(&outline.points, p).map_or(f32::INFINITY, |(gap, _)| gap);
    let is_earth = |i: &usize| {
        let line = &page.lines[*i];
        let (ends, own) = (line.ends(), line.size());
        *i != glass
            && own.y < EARTH.2 * own.x
            && line.middle().y > low.y.midpoint(high.y)
            && gap(ends.0).max(gap(ends.1)) < EARTH.0 * size.x
    };
    // Most outlines have none, and what is in them need not be looked at.
    let earth = lines().find(is_earth)?;
    let inside = page.with_what_is_inside(&[], &outline.hull);
    let is_other = |i: &usize| *i != glass && inside.binary_search(i).is_err();
    let neck: Vec<usize> = lines().filter(is_other).collect();
    let is_neck = |i: &usize| page.lines[*i].bounds.1.y < low.y + NECK * size.y;
    let level = page.lines[earth].middle().y;
    let stands = |i: &&usize| {
        let foot = page.lines[**i].bounds.1.y;
        **i != glass && **i != earth && (foot - level).abs() < EARTH.1 * size.y
    };
    let is_jar = inside.binary_search(&earth).is_ok()
        && neck.iter().all(is_neck)
        && inside.iter().filter(stands).count() >= EARTH.3;
    let mut uses = neck;
    uses.push(glass);
    uses.sort_unstable();
    is_jar.then_some(uses)
}

/// Whether a line is straight and level, or straight and plumb; nothing if it is neither.
fn is_level(page: &Page, line: &Line) -> Option<bool> {
    let way = (line.ends().1 - line.ends().0).abs();
    let is_straight = way.length() > STRAIGHT.0 * line.length && line.length > LONG * page.diagonal;
    let off = way.min_element() < STRAIGHT.1 * way.max_element();
    (is_straight && off).then_some(way.x > way.y)
}

/// Whether two lines come near one another.
fn do_meet(a: &Line, b: &Line, reach: f32) -> bool {
    let near = Vec2::splat(reach);
    let do_bounds =
        (a.bounds.0 - near).cmple(b.bounds.1).all() && (b.bounds.0 - near).cmple(a.bounds.1).all();
    do_bounds && a.points.iter().any(|p| polyline::nearest(&b.points, *p).is_some_and(|(gap, _)| gap < reach))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Vec<usize>> {
        crate::anatomy::conventions::read_by(propose, lines).into_iter().map(|frame| frame.uses).collect()
    }

    fn pale(x: f32, top: f32) -> Vec<Vec2> {
        line(&[(x, 0.0), (x, top), (x + 6.0, top - 12.0), (x + 12.0, top), (x + 12.0, 0.0)])
    }

    #[test]
    fn pales_that_a_rail_crosses_are_a_fence() {
        let mut lines: Vec<Vec<Vec2>> = (0..5).map(|k| pale(20.0 * k as f32, -50.0)).collect();
        lines.push(line(&[(-5.0, -35.0), (98.0, -33.0)]));
        lines.push(line(&[(150.0, 0.0), (150.0, -80.0)]));
        assert_eq!(read(&lines), [[0, 1, 2, 3, 4, 5]]);
        assert!(read(&lines[..5]).is_empty(), "without a rail");
        lines[5] = line(&[(-5.0, 0.0), (98.0, 0.0)]);
        assert!(read(&lines).is_empty(), "on the ground");
    }

    #[test]
    fn lines_of_unlike_height_or_distance_are_none() {
        let rail = line(&[(-5.0, -20.0), (98.0, -20.0)]);
        let mut lines: Vec<Vec<Vec2>> =
            (0..5).map(|k| pale(20.0 * k as f32, -30.0 - 25.0 * k as f32)).collect();
        lines.push(rail);
        assert!(read(&lines).is_empty());
    }

    #[test]
    fn a_window_of_level_and_plumb_lines_is_a_frame_and_a_palms_bark_is_none() {
        let window = |width: f32| {
            let level = [0.0, -60.0, -120.0].map(|y| line(&[(0.0, y), (width, y)]));
            let plumb = [0.0, width].map(|x| line(&[(x, 0.0), (x, -120.0)]));
            [&level[..], &plumb[..]].concat()
        };
        let twig = line(&[(40.0, -10.0), (55.0, -40.0), (50.0, -50.0)]);
        let lines = [window(100.0), vec![twig]].concat();
        assert_eq!(read(&lines), [[0, 1, 2, 3, 4]]);
        assert!(read(&window(20.0)).is_empty());
        assert!(read(&lines[1..4]).is_empty());
    }

    #[test]
    fn a_jar_around_plants_that_stand_on_earth_in_it_is_a_frame_and_a_crown_with_a_line_is_none() {
        let jar = line(&[
            (60.0, 0.0),
            (140.0, 0.0),
            (200.0, 80.0),
            (190.0, 220.0),
            (10.0, 220.0),
            (0.0, 80.0),
            (60.0, 0.0),
        ]);
        let lid = line(&[(50.0, -10.0), (150.0, -10.0)]);
        let earth = line(&[(6.0, 160.0), (100.0, 155.0), (194.0, 160.0)]);
        let sprout = |x: f32| line(&[(x, 158.0), (x + 4.0, 90.0)]);
        let all = [jar, lid, earth, sprout(70.0), sprout(120.0)];
        assert_eq!(read(&all), [[0, 1]]);
        assert!(read(&all[..3]).is_empty(), "nothing grows in it");
        assert!(read(&[&all[..2], &all[3..]].concat()).is_empty(), "no earth");
        let stem = line(&[(100.0, 215.0), (100.0, 330.0)]);
        assert!(read(&[&all[..], &[stem]].concat()).is_empty(), "it stands on a trunk");
    }
}
