//! Strokes drawn over one another, as one line: restated whole, or feathered, each beginning beside the end of the one before.
//!
//! Pairs of lines that share places are tried in the order of the drawing. A line most of which runs along another restates it,
//! and both become their mean. A line whose beginning runs along the other's end goes on from there, the one blending into the other.
//! Limits: where more than [`CROWD`] lines share a spot it is hatched, and no pairs are looked for. Cost: linear in the points of
//! the drawing, and in those of the lines of each pair.

use super::overlap::{Near, Overlap, REACH, SAME};
use crate::anatomy::conventions::page::{Page, even};
use crate::geom::{polyline, simple_loop};
use glam::Vec2;

/// Most lines in one spot among which pairs are looked for.
const CROWD: usize = 8;
/// Least share of a line that runs along the one it restates.
const RESTATED: f32 = 0.85;
/// Least part of the shorter line that runs along the other if it goes on from there, and least of the drawing's diagonal.
const BLEND: (f32, f32) = (0.12, 0.036);
/// Most points in a row that miss where a line runs along another.
const MISSES: usize = 3;
/// Distance of a closed line's ends, as a share of its length.
const CLOSED: f32 = 0.08;
/// How near a line must be to restate a loop, as a share of the loop's mean width: narrow petals lie closely side by side.
const LOOP: f32 = 0.2;
/// Distances of the ends of a fork, whose branch begins on the other line: the less as a share of the more, and least of the more as a
/// share of the drawing's diagonal.
const FORK: (f32, f32) = (0.2, 0.007);
/// Shortest line that may be restated, as a share of the drawing's diagonal.
const SHORTEST: f32 = 0.06;
/// How often all pairs are tried: three pieces of one line need two rounds.
const ROUNDS: usize = 3;

/// Lines of a page that are one line.
#[derive(Clone, Debug)]
pub(super) struct Bundle {
    /// The lines, ascending.
    pub members: Vec<usize>,
    /// Their mean.
    pub points: Vec<Vec2>,
    /// Whether it is not just one line as it was drawn.
    pub is_changed: bool,
}

/// All lines of a page that may be changed, those that are one line together.
pub(super) fn bundles(page: &Page, may_change: impl Fn(usize) -> bool) -> Vec<Bundle> {
    let is_long = |line: &usize| page.lines[*line].length > SHORTEST * page.diagonal && may_change(*line);
    let mut places: Vec<Option<usize>> = vec![None; page.lines.len()];
    let mut all: Vec<Option<Bundle>> = Vec::new();
    for line in (0..page.lines.len()).filter(is_long) {
        places[line] = Some(all.len());
        let points = page.lines[line].points.clone();
        all.push(Some(Bundle { members: vec![line], points, is_changed: false }));
    }
    let pairs = pairs(page, &places);
    for _ in 0..ROUNDS {
        let mut is_new = false;
        for &(a, b) in &pairs {
            let (Some(a), Some(b)) = (places[a], places[b]) else { continue };
            let (a, b) = (a.min(b), a.max(b));
            let (Some(first), Some(second)) = (&all[a], &all[b]) else { continue };
            if a == b {
                continue;
            }
            if let Some(bundle) = merged(first, second, page.diagonal) {
                bundle.members.iter().for_each(|line| places[*line] = Some(a));
                (all[a], all[b], is_new) = (Some(bundle), None, true);
            }
        }
        if !is_new {
            break;
        }
    }
    all.into_iter().flatten().collect()
}

/// Lines that share spots, ascending. Those that only cross share one; that of an end, or one beside it, is enough.
fn pairs(page: &Page, places: &[Option<usize>]) -> Vec<(usize, usize)> {
    let spot = |p: Vec2| (p / (2.0 * REACH.0 * page.diagonal)).floor().as_ivec2().to_array();
    let lines = || page.lines.iter().enumerate().filter(|(i, _)| places[*i].is_some());
    let mut at: Vec<([i32; 2], usize)> = Vec::new();
    for (i, line) in lines() {
        for point in &line.points {
            let there = (spot(*point), i);
            if at.last() != Some(&there) {
                at.push(there);
            }
        }
    }
    at.sort_unstable();
    at.dedup();
    let in_spot = |there: [i32; 2]| {
        let from = at.partition_point(|(other, _)| *other < there);
        let count = at[from..].iter().take(CROWD + 1).take_while(|(other, _)| *other == there).count();
        &at[from..from + if count > CROWD { 0 } else { count }]
    };
    let mut shared: Vec<(usize, usize)> = Vec::new();
    for there in at.chunk_by(|a, b| a.0 == b.0).filter(|there| there.len() <= CROWD) {
        for (k, (_, a)) in there.iter().enumerate() {
            shared.extend(there[k + 1..].iter().map(|(_, b)| (*a, *b)));
        }
    }
    for (a, line) in lines() {
        for [x, y] in [line.ends().0, line.ends().1].map(spot) {
            let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [x + dx, y + dy]));
            let there = around.flat_map(in_spot).map(|(_, b)| *b).filter(|b| *b != a);
            shared.extend(there.flat_map(|b| [(a.min(b), a.max(b)); 2]));
        }
    }
    shared.sort_unstable();
    shared.chunk_by(|a, b| a == b).filter(|same| same.len() > 1).map(|same| same[0]).collect()
}

/// Two lines as one, if they are.
fn merged(a: &Bundle, b: &Bundle, diagonal: f32) -> Option<Bundle> {
    let is_longer = polyline::length(&a.points) >= polyline::length(&b.points);
    let (long, short) = if is_longer { (a, b) } else { (b, a) };
    let reach = (REACH.0 * diagonal).min(REACH.1 * polyline::length(&short.points));
    let reach =
        [long, short].map(|line| width_of_loop(&line.points)).into_iter().flatten().fold(reach, f32::min);
    let may_restate = is_within(&short.points, &long.points, reach);
    if !may_restate && !may_go_on(&long.points, &short.points, reach) {
        return None;
    }
    let overlap = Overlap::new(&short.points, &long.points, reach);
    let is_restated = overlap.share() >= RESTATED;
    let same = if is_restated { SAME.0 } else { SAME.1 };
    if overlap.count() == 0 || !overlap.is_one_line(same * diagonal) {
        return None;
    }
    let points = match is_restated {
        true => Some(mean(long, short, reach)),
        false => continued(&long.points, &short.points, (reach, diagonal)),
    }?;
    let mut members = [a.members.as_slice(), &b.members].concat();
    members.sort_unstable();
    Some(Bundle { members, points, is_changed: true })
}

/// Whether a line lies in the bounds of another, and its ends and its middle near it.
fn is_within(line: &[Vec2], other: &[Vec2], reach: f32) -> bool {
    let [(low, high), (around_low, around_high)] =
        [line, other].map(|line| polyline::bounds(line.iter().copied()));
    let is_in = low.cmpge(around_low - reach).all() && high.cmple(around_high + reach).all();
    let places = [0, line.len() / 4, line.len() / 2, 3 * line.len() / 4, line.len() - 1];
    is_in && places.iter().filter(|k| lies_along(line[**k], other, reach)).count() > 3
}

/// How near a line must be to restate this one, if it is closed: a share of its width.
fn width_of_loop(line: &[Vec2]) -> Option<f32> {
    let length = polyline::length(line);
    let is_closed = line[0].distance(line[line.len() - 1]) < CLOSED * length;
    is_closed.then(|| LOOP * simple_loop::area(line) / (0.5 * length))
}

/// Whether an end of each line lies along the other, and neither is closed.
fn may_go_on(a: &[Vec2], b: &[Vec2], reach: f32) -> bool {
    let is_closed = |line: &[Vec2]| line[0].distance(line[line.len() - 1]) < CLOSED * polyline::length(line);
    let touches = |line: &[Vec2], other: &[Vec2]| {
        lies_along(line[0], other, reach) || lies_along(line[line.len() - 1], other, reach)
    };
    !is_closed(a) && !is_closed(b) && touches(a, b) && touches(b, a)
}

/// Whether a place is about as near to a line as one that is restated, by its points.
fn lies_along(place: Vec2, line: &[Vec2], reach: f32) -> bool {
    let step = 0.5 * line[0].distance(line[1]);
    line.iter().any(|p| p.distance_squared(place) < (reach + step) * (reach + step))
}

/// The longer line, drawn toward the shorter where that runs along it, each weighted by its strokes.
fn mean(long: &Bundle, short: &Bundle, reach: f32) -> Vec<Vec2> {
    let weight = short.members.len() as f32 / (long.members.len() + short.members.len()) as f32;
    let to_short = Overlap::new(&long.points, &short.points, reach);
    let toward = |(p, near): (&Vec2, &Option<Near>)| near.map_or(*p, |near| p.lerp(near.place, weight));
    long.points.iter().zip(&to_short.along).map(toward).collect()
}

/// One line and the other that goes on from its end, whichever ends these are.
fn continued(a: &[Vec2], b: &[Vec2], (reach, diagonal): (f32, f32)) -> Option<Vec<Vec2>> {
    if !may_go_on(a, b, reach) {
        return None;
    }
    let reversed = |line: &[Vec2]| line.iter().rev().copied().collect::<Vec<_>>();
    let (back_a, back_b) = (reversed(a), reversed(b));
    let ways = [(a, b), (a, &back_b[..]), (&back_a[..], b), (&back_a[..], &back_b[..])];
    ways.into_iter().find_map(|(a, b)| goes_on(a, b, (reach, diagonal)))
}

/// The first line with the second that goes on from its end.
fn goes_on(a: &[Vec2], b: &[Vec2], (reach, diagonal): (f32, f32)) -> Option<Vec<Vec2>> {
    let (tail, head) = (Overlap::new(a, b, reach), Overlap::new(b, a, reach));
    let (in_a, in_b) = (run(tail.along.iter().rev()), run(head.along.iter()));
    let first = a.len() - in_a;
    let length = polyline::length(&b[..in_b]);
    let least = (BLEND.0 * polyline::length(a).min(polyline::length(b))).max(BLEND.1 * diagonal);
    // Elsewhere they are not beside each other, but where they close an outline.
    let is_all = |overlap: &Overlap, run: usize| overlap.count() <= 2 * run;
    if length < least || !is_all(&tail, in_a) || !is_all(&head, in_b) || in_b == b.len() || in_a == a.len() {
        return None;
    }
    let distance = |near: &Option<Near>, place: Vec2| near.map_or(reach, |near| near.place.distance(place));
    let [of_end, of_beginning] =
        [distance(&tail.along[a.len() - 1], a[a.len() - 1]), distance(&head.along[0], b[0])];
    let (less, more) = (of_end.min(of_beginning), of_end.max(of_beginning));
    if less < FORK.0 * more && more > FORK.1 * diagonal {
        return None;
    }
    let (from, to) = (even(&a[first..], in_b.max(3)), even(&b[..in_b], in_b.max(3)));
    let count = from.len() - 1;
    let blended = from.iter().zip(&to).enumerate().map(|(k, (p, q))| p.lerp(*q, k as f32 / count as f32));
    Some(a[..first].iter().copied().chain(blended).chain(b[in_b..].iter().copied()).collect())
}

/// How many points from one end of a line on run along another, the same way, but for few.
fn run<'a>(along: impl Iterator<Item = &'a Option<Near>>) -> usize {
    let (mut run, mut misses) = (0, 0);
    for (k, near) in along.enumerate() {
        match near.is_some_and(|near| near.is_same_way) {
            true => (run, misses) = (k + 1, 0),
            false => misses += 1,
        }
        if misses > MISSES {
            break;
        }
    }
    run
}
