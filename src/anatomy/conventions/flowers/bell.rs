//! Nodding bells: outlines that hang from the end of a stem or of a pedicel that comes down from one.
//!
//! A line ends downward ([`HANGS`]), and from its end one outline hangs, of one line or of several that meet: narrow above, as wide
//! below as anywhere. Leaves that hang end in a tip, fruits are round. The line that carries it, or the one from which that comes, goes down
//! past the bell's edge, which tells it from a plant over its pot. The bell becomes a cup of petals ([`cup`](super::cup)) from the end
//! of its stalk to its edge.
//!
//! Bells without a stalk hang from a place of their stem where the upper ends of two lines meet.
//!
//! Limits: bells that are turned up or to the side; bells without a stalk in one line.

use super::cup;
use crate::anatomy::conventions::page::{Line, Page, bounds};
use crate::anatomy::conventions::shapes::outline::width_at;
use crate::anatomy::conventions::shapes::silhouette::{Silhouette, smooth_contour};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Least share of its way that a stalk goes down at its end, and the part of it that is its end.
const HANGS: f32 = 0.5;
const END: f32 = 0.1;
/// Least distance of the ends of a stalk, as a share of the diagonal of its bounds.
const OPEN: f32 = 0.5;
/// How far from the stalk's end a bell begins at most, how far above it a line of it may reach, and how far lines that meet are apart, as
/// shares of their size.
const AT: f32 = 0.25;
const BACK: f32 = 0.12;
const MEET: f32 = 0.15;
/// Most lines of a bell, and most lines near a stalk's end that are looked at.
const LINES: usize = 6;
const MOST: usize = 60;
/// Height of a bell, as a share of the drawing's diagonal, and its width over its height.
const HEIGHT: (f32, f32) = (0.03, 0.45);
const WIDTH: (f32, f32) = (0.45, 1.7);
/// Where its width is measured above and below, as shares of its height, the most and the least of its greatest width there.
const ABOVE: (f32, f32) = (0.12, 0.8);
const BELOW: (f32, f32) = (0.93, 0.65);
/// How far from its middle the stalk comes in at most, as a share of its width.
const AMID: f32 = 0.3;
/// How near to the upper end of a stalk the stem is from which it comes, as shares of the stalk's length and of the bell's height.
const FROM: (f32, f32) = (1.3, 0.5);
/// Wide gaps of the outline that are closed, in cells of the silhouette, and points of the outline.
const BRIDGE: i32 = 8;
const POINTS: usize = 160;
/// Log-odds of a bell.
const SCORE: f32 = 4.2;

/// Proposes a bell at the end of each line that has one.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let stalks = (0..page.lines.len()).filter(|i| !page.is_apart(*i) && page.lines[*i].openness > OPEN);
    let mut ends: Vec<Stalk> = stalks.flat_map(|i| Stalk::of(page, i)).collect();
    ends.extend(on_stems(page));
    let around = |stalk: &Stalk| {
        let reach = HEIGHT.1 * page.diagonal;
        (stalk.end - Vec2::new(reach, 0.2 * reach), stalk.end + Vec2::splat(reach))
    };
    let near = page.lines_at(&ends.iter().map(around).collect::<Vec<_>>());
    out.extend(ends.iter().zip(near).filter_map(|(stalk, near)| bell(page, stalk, &near)));
}

/// A line that ends downward.
struct Stalk {
    number: usize,
    end: Vec2,
    begin: Vec2,
}

impl Stalk {
    /// Those ends of a line that go down.
    fn of(page: &Page, number: usize) -> impl Iterator<Item = Self> {
        let points = &page.lines[number].points;
        let last = points.len() - 1;
        let part = ((END * last as f32) as usize).max(1);
        let ends = [(points[last], points[last - part], points[0]), (points[0], points[part], points[last])];
        let goes_down = |end: Vec2, before: Vec2| (end - before).normalize_or_zero().y > HANGS;
        ends.into_iter()
            .filter(move |(end, before, _)| goes_down(*end, *before))
            .map(move |(end, _, begin)| Self { number, end, begin })
    }

    /// Whether this line, or one from which it comes, goes down past the edge of a bell of this height.
    fn is_carried_below(&self, page: &Page, edge: f32, height: f32) -> bool {
        let own = &page.lines[self.number];
        let near = (FROM.0 * own.length).max(FROM.1 * height);
        let carries = |line: &Line| {
            line.bounds.1.y > edge
                && polyline::nearest(&line.points, self.begin).is_some_and(|(gap, _)| gap < near)
        };
        own.bounds.1.y > edge
            || page.lines.iter().enumerate().any(|(i, line)| i != self.number && carries(line))
    }
}

/// The places of stems where the upper ends of two lines meet, as the ends of stalks.
fn on_stems(page: &Page) -> Vec<Stalk> {
    let upper = |i: usize| {
        let (a, b) = page.lines[i].ends();
        if a.y < b.y { (a, b) } else { (b, a) }
    };
    let is_side = |i: &usize| {
        let (top, foot) = upper(*i);
        !page.is_apart(*i)
            && page.lines[*i].openness > OPEN
            && foot.y - top.y > HEIGHT.0 * page.diagonal
            && foot.y - top.y < HEIGHT.1 * page.diagonal
    };
    let sides: Vec<usize> = (0..page.lines.len()).filter(is_side).collect();
    let around = |i: &usize| {
        let reach = Vec2::splat(MEET * page.lines[*i].length);
        (upper(*i).0 - reach, upper(*i).0 + reach)
    };
    let near = page.lines_at(&sides.iter().map(around).collect::<Vec<_>>());
    let stalk = |(side, near): (&usize, Vec<usize>)| {
        let (top, reach) = (upper(*side).0, MEET * page.lines[*side].length);
        let is_beside = |other: &&usize| {
            let middle = page.lines[**other].middle();
            **other > *side
                && sides.binary_search(other).is_ok()
                && upper(**other).0.distance(top) < reach
                && (middle.x - top.x) * (page.lines[*side].middle().x - top.x) < 0.0
        };
        let other = *near.iter().find(is_beside)?;
        let passes = |stem: &&usize| {
            let line = &page.lines[**stem];
            let (first, last) = line.ends();
            // What ends here is a stalk.
            let goes_on = first.distance(top).min(last.distance(top)) > 2.0 * reach;
            let is_other = **stem != *side && **stem != other && line.openness > OPEN;
            is_other && goes_on && polyline::nearest(&line.points, top).is_some_and(|(gap, _)| gap < reach)
        };
        let end = top.midpoint(upper(other).0);
        near.iter().find(passes).map(|stem| Stalk { number: *stem, end, begin: end })
    };
    sides.iter().zip(near).filter_map(stalk).collect()
}

fn bell(page: &Page, stalk: &Stalk, near: &[usize]) -> Option<Hypothesis> {
    if near.len() > MOST {
        return None;
    }
    let head = head(page, stalk, near)?;
    let (low, high) = bounds(head.iter().map(|i| &page.lines[*i]));
    let (size, height) = (high - low, high.y - stalk.end.y);
    let is_of_form = (HEIGHT.0 * page.diagonal..HEIGHT.1 * page.diagonal).contains(&height)
        && (WIDTH.0..WIDTH.1).contains(&(size.x / height))
        && (low.midpoint(high).x - stalk.end.x).abs() < AMID * size.x;
    if !is_of_form || !stalk.is_carried_below(page, high.y, height) {
        return None;
    }
    let lines = head.iter().map(|i| page.lines[*i].points.as_slice());
    let outline = smooth_contour(&Silhouette::new(lines, BRIDGE).contour(), POINTS, 1);
    let width = |share: f32| width_at(&outline, low.y + share * size.y);
    if width(ABOVE.0) > ABOVE.1 * size.x || width(BELOW.0) < BELOW.1 * size.x {
        return None;
    }
    let tips = edge(&outline, low.y + 0.8 * size.y)?;
    let petals = cup::petals(&outline, stalk.end, &tips)?;
    let parts = petals.into_iter().map(|petal| Made::new(Tool::Petal, petal)).collect();
    let (reading, habit) = (Reading::Corolla, Some(Habit::Flower));
    Some(Hypothesis { uses: head, score: SCORE, parts, solids: Vec::new(), reading, habit })
}

/// The lines that hang from the end of a stalk, and those that join the ends of these, ascending.
fn head(page: &Page, stalk: &Stalk, near: &[usize]) -> Option<Vec<usize>> {
    let hangs = |i: &&usize| {
        let line = &page.lines[**i];
        let size = line.size();
        **i != stalk.number
            && line.bounds.0.y > stalk.end.y - BACK * size.y
            && line.bounds.1.y < stalk.end.y + HEIGHT.1 * page.diagonal
            && polyline::nearest(&line.points, stalk.end).is_some_and(|it| it.0 < AT * size.max_element())
    };
    let hanging: Vec<usize> = near.iter().filter(hangs).copied().collect();
    let ends: Vec<Vec2> = hanging.iter().flat_map(|i| <[Vec2; 2]>::from(page.lines[*i].ends())).collect();
    let joins = |i: &&usize| {
        let line = &page.lines[**i];
        let meets = |p: Vec2| ends.iter().any(|end| end.distance(p) < MEET * line.size().max_element());
        let (first, last) = line.ends();
        let is_below = line.bounds.0.y > stalk.end.y;
        **i != stalk.number && !hanging.contains(i) && is_below && meets(first) && meets(last)
    };
    let mut all: Vec<usize> = near.iter().filter(joins).chain(&hanging).copied().collect();
    all.sort_unstable();
    (!hanging.is_empty() && all.len() <= LINES).then_some(all)
}

/// The left and the right end of the edge of a bell, which begins at a height, and between them its lowest place.
fn edge(outline: &[Vec2], from: f32) -> Option<[Vec2; 3]> {
    let below = || outline.iter().copied().filter(|p| p.y > from);
    let left = below().min_by(|a, b| a.x.total_cmp(&b.x))?;
    let right = below().max_by(|a, b| a.x.total_cmp(&b.x))?;
    let third = (right.x - left.x) / 3.0;
    let amid = below().filter(|p| p.x > left.x + third && p.x < right.x - third);
    Some([left, amid.max_by(|a, b| a.y.total_cmp(&b.y))?, right])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::{line, read_by};

    /// A stem that rises and bends over, its end above (x, -150).
    fn crook() -> Vec<Vec2> {
        line(&[(0.0, 0.0), (5.0, -150.0), (30.0, -195.0), (60.0, -190.0), (70.0, -150.0)])
    }

    /// The outline of a bell that hangs from a place.
    fn hanging(x: f32, y: f32) -> Vec<Vec2> {
        let corners = [(0.0, 0.0), (-18.0, 12.0), (-24.0, 45.0), (-12.0, 40.0), (0.0, 47.0), (12.0, 40.0)];
        let rest = [(24.0, 45.0), (18.0, 12.0), (0.0, 0.0)];
        line(&corners.into_iter().chain(rest).map(|(a, b)| (x + a, y + b)).collect::<Vec<_>>())
    }

    #[test]
    fn an_outline_under_the_end_of_a_crook_is_a_bell_of_petals_from_there() {
        let found = read_by(propose, &[crook(), hanging(70.0, -148.0)]);
        assert_eq!(found.len(), 1);
        assert_eq!((&found[0].uses[..], found[0].parts.len()), (&[1][..], 5));
        for petal in &found[0].parts {
            let root = petal.points[0].position;
            let lowest = petal.points.iter().map(|p| p.position.y).fold(f32::NEG_INFINITY, f32::max);
            assert!(petal.tool == Tool::Petal && root.distance(Vec2::new(70.0, -150.0)) < 8.0);
            assert!(lowest > -120.0, "they hang");
        }
    }

    #[test]
    fn bells_of_three_lines_on_pedicels_are_each_one() {
        let stem = line(&[(0.0, 0.0), (10.0, -120.0), (60.0, -190.0), (150.0, -200.0)]);
        let bell = |x: f32, y: f32| {
            [
                line(&[(x, y - 16.0), (x + 1.0, y)]),
                line(&[(x, y), (x - 16.0, y + 32.0)]),
                line(&[(x - 16.0, y + 32.0), (x + 16.0, y + 31.0)]),
                line(&[(x + 16.0, y + 31.0), (x, y)]),
            ]
        };
        // The last hangs a little away from the stem.
        let bells = [bell(90.0, -180.0), bell(145.0, -184.0), bell(30.0, -115.0)].concat();
        let lines = [vec![stem], bells].concat();
        let uses: Vec<Vec<usize>> = read_by(propose, &lines).into_iter().map(|it| it.uses).collect();
        assert_eq!(uses, [vec![2, 3, 4], vec![6, 7, 8], vec![10, 11, 12]]);
    }

    #[test]
    fn bells_of_three_lines_hang_from_their_stem_without_a_stalk() {
        let stem = line(&[(0.0, 0.0), (10.0, -120.0), (60.0, -190.0), (150.0, -200.0), (190.0, -170.0)]);
        let bell = |x: f32, y: f32| {
            [
                line(&[(x, y), (x - 16.0, y + 36.0)]),
                line(&[(x - 16.0, y + 36.0), (x + 16.0, y + 35.0)]),
                line(&[(x + 16.0, y + 35.0), (x + 1.0, y)]),
            ]
        };
        let lines = [vec![stem], [bell(80.0, -193.0), bell(135.0, -198.0)].concat()].concat();
        let uses: Vec<Vec<usize>> = read_by(propose, &lines).into_iter().map(|it| it.uses).collect();
        assert_eq!(uses, [vec![1, 2, 3], vec![4, 5, 6]]);
        assert!(read_by(propose, &lines[1..]).is_empty(), "no stem");
    }

    #[test]
    fn leaves_fruits_and_pots_are_none() {
        let leaf = line(&[(70.0, -148.0), (58.0, -125.0), (70.0, -95.0), (82.0, -125.0), (70.0, -148.0)]);
        assert!(read_by(propose, &[crook(), leaf]).is_empty());
        let fruit: Vec<Vec2> = (0..=40)
            .map(|k| std::f32::consts::TAU * k as f32 / 40.0)
            .map(|a| Vec2::new(70.0 + 22.0 * a.sin(), -128.0 - 22.0 * a.cos()))
            .collect();
        assert!(read_by(propose, &[crook(), fruit]).is_empty());
        let stem = line(&[(70.0, -300.0), (70.0, -150.0)]);
        assert!(read_by(propose, &[stem, hanging(70.0, -148.0)]).is_empty(), "nothing goes on below");
    }
}
