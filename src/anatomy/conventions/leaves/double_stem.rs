//! A stem drawn by its two sides: two lines side by side from top to bottom, with something on their upper ends.
//!
//! Both are steep, about as long, and as far apart everywhere as a stem is thick; nothing lies between them. They become one branch as thick
//! as drawn. A trunk has a crown, which explains more and wins.
//!
//! With lines across it from side to side it is a cane, as bamboo's, and needs nothing on its upper end.
//!
//! Limits: stems that fork; sides of several strokes.

use crate::anatomy::conventions::page::{Line, Page, even};
use crate::anatomy::conventions::{Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::Reading;
use glam::Vec2;

/// Most lines of a page: among many stems two may run side by side by chance.
const MOST: usize = 48;
/// Least length of a side, as a share of the drawing's diagonal, least chord over its length, and least rise over its run.
const LONG: f32 = 0.15;
const CHORD: f32 = 0.85;
const STEEP: f32 = 1.5;
/// Least length of the shorter side, as a share of the longer; least and most distance of both, as shares of that, in the mean, and most
/// anywhere, in means.
const EVEN: f32 = 0.75;
const APART: (f32, f32) = (0.012, 0.14);
const WIDEST: f32 = 2.2;
/// How near to the upper ends something begins that the stem carries, as a share of its length.
const HEAD: f32 = 0.25;
/// Places along the stem.
const POINTS: usize = 24;
/// Log-odds.
const SCORE: f32 = 0.9;
/// Fewest nodes of a cane, and its log-odds: spines of a cactus do not cross it.
const NODES: (usize, f32) = (2, 5.6);
/// Of a node: least and most length, in widths of the stem, greatest cosine between it and the stem, and how far from the stem's middle
/// line its middle is, in widths.
const ACROSS: (f32, f32, f32, f32) = (0.7, 1.9, 0.5, 0.25);

/// Proposes a stem for each two sides.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    if page.lines.len() > MOST || !page.is_mostly_free() {
        return;
    }
    let sides: Vec<Side> =
        (0..page.lines.len()).filter(|i| !page.is_apart(*i)).filter_map(|i| Side::of(page, i)).collect();
    let pairs = (0..sides.len()).flat_map(|a| (a + 1..sides.len()).map(move |b| (a, b)));
    out.extend(pairs.filter_map(|(a, b)| stem(page, &sides[a], &sides[b])));
}

/// A steep line from its lower end up.
struct Side {
    number: usize,
    points: Vec<Vec2>,
    length: f32,
}

impl Side {
    fn of(page: &Page, number: usize) -> Option<Self> {
        let line: &Line = &page.lines[number];
        let (first, last) = line.ends();
        let way = (last - first).abs();
        let is_one =
            line.length > LONG * page.diagonal && way.length() > CHORD * line.length && way.y > STEEP * way.x;
        is_one.then(|| Self { number, points: even(&line.upward(), POINTS), length: line.length })
    }
}

fn stem(page: &Page, a: &Side, b: &Side) -> Option<Hypothesis> {
    let long = a.length.max(b.length);
    let rows: Vec<(Vec2, f32)> =
        a.points.iter().zip(&b.points).map(|(a, b)| (a.midpoint(*b), 0.5 * a.distance(*b))).collect();
    let mean = rows.iter().map(|row| row.1).sum::<f32>() / POINTS as f32;
    let widest = rows.iter().map(|row| row.1).fold(0.0, f32::max);
    let side = |(a, b): (&Vec2, &Vec2)| (b.x - a.x).signum();
    let first = side((&a.points[POINTS / 2], &b.points[POINTS / 2]));
    // Sides that cross at an end are the tremor of a hand.
    let beside = a.points.iter().zip(&b.points).filter(|pair| side(*pair) == first).count();
    let is_stem = a.length.min(b.length) > EVEN * long
        && (APART.0..APART.1).contains(&(2.0 * mean / long))
        && widest < WIDEST * mean
        && 10 * beside >= 9 * POINTS;
    if !is_stem {
        return None;
    }
    let nodes = nodes(page, (a, b), &rows);
    let is_cane = nodes.len() >= NODES.0;
    if !(is_cane || carries(page, (a, b), rows[POINTS - 1].0, long))
        || has_between(page, (a, b), (&rows, &nodes))
    {
        return None;
    }
    let part = Made::thick(rows);
    let mut uses = vec![a.number, b.number];
    uses.extend(nodes.into_iter().filter(|_| is_cane));
    uses.sort_unstable();
    Some(Hypothesis {
        uses,
        score: if is_cane { NODES.1 } else { SCORE } * page.weight(long),
        parts: vec![part],
        solids: Vec::new(),
        reading: Reading::Line,
        habit: None,
    })
}

/// Whether something whose lowest place is in the upper half of a stem is near its upper end.
fn carries(page: &Page, (a, b): (&Side, &Side), top: Vec2, long: f32) -> bool {
    let middle = a.points[POINTS / 2].y;
    let is_head = |line: &Line| {
        let is_high = line.bounds.1.y < middle && line.openness < 0.8;
        is_high && polyline::nearest(&line.points, top).is_some_and(|(gap, _)| gap < HEAD * long)
    };
    let lines = page.lines.iter().enumerate();
    lines.filter(|(i, _)| *i != a.number && *i != b.number).any(|(_, line)| is_head(line))
}

/// The lines across a stem from side to side: nodes of a cane.
fn nodes(page: &Page, (a, b): (&Side, &Side), rows: &[(Vec2, f32)]) -> Vec<usize> {
    let way: Vec<Vec2> = rows.iter().map(|row| row.0).collect();
    let along = (way[POINTS - 1] - way[0]).normalize_or_zero();
    let wide = 2.0 * rows.iter().map(|row| row.1).sum::<f32>() / POINTS as f32;
    let is_node = |line: &Line| {
        let (first, last) = line.ends();
        (ACROSS.0 * wide..ACROSS.1 * wide).contains(&line.length)
            && (last - first).normalize_or_zero().dot(along).abs() < ACROSS.2
            && polyline::nearest(&way, first.midpoint(last)).is_some_and(|(gap, _)| gap < ACROSS.3 * wide)
    };
    let others = (0..page.lines.len()).filter(|i| *i != a.number && *i != b.number);
    others.filter(|i| is_node(&page.lines[*i])).collect()
}

/// Whether another line but nodes runs between both sides.
fn has_between(page: &Page, (a, b): (&Side, &Side), (rows, nodes): (&[(Vec2, f32)], &[usize])) -> bool {
    let way: Vec<Vec2> = rows.iter().map(|row| row.0).collect();
    let widest = rows.iter().map(|row| row.1).fold(0.0, f32::max);
    let is_within = |p: &&Vec2| polyline::nearest(&way, **p).is_some_and(|(gap, _)| gap < 0.8 * widest);
    page.lines.iter().enumerate().any(|(i, line)| {
        let inside = || line.points.iter().filter(is_within).count();
        i != a.number && i != b.number && !nodes.contains(&i) && 2 * inside() > line.points.len()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::{line, read_by};
    use crate::sketch::Tool;

    fn side(x: f32) -> Vec<Vec2> {
        line(&[(x, 0.0), (x + 6.0, -80.0), (x + 2.0, -160.0)])
    }

    fn head() -> Vec<Vec2> {
        (0..=40).map(|k| Vec2::new(8.0, -190.0) + 28.0 * Vec2::from_angle(0.157 * k as f32)).collect()
    }

    #[test]
    fn two_sides_below_a_head_are_one_stem_as_thick_as_drawn() {
        let found = read_by(propose, &[side(0.0), side(10.0), head()]);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].uses, [0, 1]);
        let [stem] = &found[0].parts[..] else { panic!("{} parts", found[0].parts.len()) };
        assert!(stem.tool == Tool::Branch && (stem.half_width.unwrap() - 5.0).abs() < 0.6);
        assert!(stem.points[0].position.distance(Vec2::new(5.0, 0.0)) < 1.0);
    }

    #[test]
    fn two_sides_with_lines_across_are_a_cane_with_its_nodes() {
        let node = |y: f32| line(&[(1.0, y), (16.0, y - 2.0)]);
        let cane = [side(0.0), side(10.0), node(-40.0), node(-90.0)];
        let found = read_by(propose, &cane);
        assert_eq!((found.len(), &found[0].uses[..]), (1, &[0, 1, 2, 3][..]));
        assert!(read_by(propose, &cane[..3]).is_empty(), "one line across");
        let spine = |y: f32| line(&[(12.0, y), (30.0, y - 6.0)]);
        assert!(read_by(propose, &[side(0.0), side(10.0), spine(-40.0), spine(-90.0)]).is_empty());
    }

    #[test]
    fn two_stems_apart_bare_poles_and_sides_with_a_line_between_are_none() {
        assert!(read_by(propose, &[side(0.0), side(60.0), head()]).is_empty());
        assert!(read_by(propose, &[side(0.0), side(10.0)]).is_empty());
        assert!(
            read_by(propose, &[side(0.0), side(5.0), side(10.0), head()]).iter().all(|it| it.uses != [0, 2])
        );
    }
}
