//! A trunk of two sides, or one line, straight, leaning or bent.
//!
//! A side is a steep stretch of a line that rises from the lowest part of the drawing; where it ends at the end of its line and
//! another line goes on, that is its side, too. Of two neighbours the longest pair is the trunk. Sides are paired by arc length from
//! their feet up; the middle is the trunk's line, half of the distance its drawn width. Where the longer goes on, it does so
//! alone if that is not far, and else that is left over.
//!
//! Limits: of a trunk that was hatched, the inner lines are taken for sides; more than [`MOST_SIDES`] are no trunk.

use super::trunk_foot::{plumb, without_roots};
use crate::anatomy::conventions::Made;
use crate::anatomy::conventions::page::{Line, Page, even};
use crate::anatomy::conventions::shapes::spikes::extremes;
use crate::geom::polyline;
use crate::sketch::Tool;
use glam::Vec2;
use std::collections::BTreeSet;

/// Lowest share of the height in which feet of the sides are.
const FEET: f32 = 0.22;
/// Least length of a side and of a trunk of one line, as shares of the height.
const SIDE: (f32, f32) = (0.25, 0.3);
/// Distance of the sides, as a share of their length: at least, at most.
const APART: (f32, f32) = (0.02, 0.5);
/// Greatest width at the top, in mean widths: what widens upward is a pair of leaves.
const WIDER: f32 = 1.4;
/// How far from the middle lines on the bark reach, in half widths of the trunk.
const BARK: f32 = 1.5;
/// Lean of a side at which it is no more the trunk's, radians.
const LEAN: f32 = 1.2;
/// Gap over which a line goes on, as a share of the height, and most that it turns there, radians.
const GAP: f32 = 0.04;
const STRAIGHT: f32 = 0.7;
/// Distance between the ends of a line that may go on, as a share of the diagonal of its bounds: leaves are closed.
const OPEN: f32 = 0.3;
/// What a side may be longer than the other, as a share of that, and still be the trunk's.
const LONGER: f32 = 0.35;
/// Most sides that are looked at.
const MOST_SIDES: usize = 12;
/// Least length of a steep stretch that is no hook, as a share of the longest of its line.
const STRETCH: f32 = 0.6;
/// Points over which the lean of a side is measured, to each side.
const STEPS: usize = 3;
/// Width from which two sides have parted, in their least width, and heights at which it is measured.
const PARTING: (f32, usize) = (1.7, 60);
/// Points of a trunk.
const POINTS: usize = 32;

/// A point of a line: line, number, place.
type Place = (usize, usize, Vec2);

/// One side of a trunk, from its foot up: a stretch of a line, or of two.
struct Side(Vec<Place>);

/// A trunk.
pub(crate) struct TrunkSides {
    /// Points of the sides, by line and number.
    own: BTreeSet<(usize, usize)>,
    /// Its middle with half widths, from the foot up; widths are 0 for one line.
    middle: Vec<(Vec2, f32)>,
}

impl Side {
    /// The stretches of a line that rise by `prominence` at least, as far as they are steep.
    fn of_line(number: usize, line: &Line, prominence: f32) -> Vec<Self> {
        let heights: Vec<f32> = line.points.iter().map(|p| -p.y).collect();
        let found = extremes(&heights, prominence).0;
        found.windows(2).map(|pair| Self(steep(places(number, line, pair[0], pair[1])))).collect()
    }

    /// The side with the steep beginning of another line that goes on where it ends, in about its direction.
    fn continued(mut self, page: &Page, group: &[usize], gap: f32) -> Self {
        let (own, end, top) = self.0[self.0.len() - 1];
        if end != 0 && end + 1 != page.lines[own].points.len() {
            return self;
        }
        // Where several lines begin are fronds.
        let begins = |i: &&usize| {
            let (first, last) = page.lines[**i].ends();
            **i != own && first.distance(top).min(last.distance(top)) < gap
        };
        if group.iter().filter(begins).count() > 1 {
            return self;
        }
        let before = top - self.0[self.0.len().saturating_sub(1 + 4 * STEPS)].2;
        let next = group.iter().filter(|i| **i != own).find_map(|i| {
            let line = &page.lines[*i];
            let (first, last) = line.ends();
            let numbers = 0..line.points.len();
            let is_turned = last.distance(top) < first.distance(top);
            let order: Vec<usize> = if is_turned { numbers.rev().collect() } else { numbers.collect() };
            let ahead = line.points[order[4 * STEPS]] - line.points[order[0]];
            let goes_on = line.openness > OPEN
                && line.points[order[0]].distance(top) < gap
                && before.angle_to(ahead).abs() < STRAIGHT;
            let rest = || steep(order.iter().map(|k| (*i, *k, line.points[*k])).collect());
            goes_on.then(rest).filter(|rest| rest[0].1 == order[0])
        });
        self.0.extend(next.unwrap_or_default());
        self
    }

    fn points(&self) -> Vec<Vec2> {
        self.0.iter().map(|place| place.2).collect()
    }

    fn foot(&self) -> Vec2 {
        self.0[0].2
    }

    fn length(&self) -> f32 {
        polyline::length(&self.points())
    }
}

/// The points of a line between two numbers, the lower end first.
fn places(number: usize, line: &Line, from: usize, to: usize) -> Vec<Place> {
    let mut all: Vec<Place> = (from..=to).map(|k| (number, k, line.points[k])).collect();
    if line.points[to].y > line.points[from].y {
        all.reverse();
    }
    all
}

/// The lowest stretch of some points that rises steeply, but for hooks of the hand, which are short beside the longest: what follows
/// above may be a crown in one line with the trunk. Never empty.
fn steep(places: Vec<Place>) -> Vec<Place> {
    // Over a few points, so that no single step decides.
    let is_steep = |k: usize| {
        let along = places[(k + STEPS).min(places.len() - 1)].2 - places[k.saturating_sub(STEPS)].2;
        along.x.abs() < LEAN.tan() * -along.y
    };
    let numbers: Vec<usize> = (0..places.len()).collect();
    let runs = numbers.chunk_by(|a, b| is_steep(*a) == is_steep(*b)).filter(|run| is_steep(run[0]));
    let longest = runs.clone().map(<[usize]>::len).max().unwrap_or(0);
    let lowest = runs.clone().find(|run| run.len() as f32 >= STRETCH * longest as f32);
    lowest.map_or_else(|| places[..1].to_vec(), |run| places[run[0]..=run[run.len() - 1]].to_vec())
}

impl TrunkSides {
    /// The sides that rise from the lowest part of a group of lines.
    pub(crate) fn find(page: &Page, group: &[usize]) -> Option<Self> {
        Self::find_within(page, group, APART.1)
    }

    /// The same, with sides so far apart at most, as a share of their length.
    pub(crate) fn find_within(page: &Page, group: &[usize], apart: f32) -> Option<Self> {
        let (sides, height) = sides(page, group)?;
        let pairs = sides
            .windows(2)
            .filter_map(|pair| Some((pair, between(&pair[0].points(), &pair[1].points(), apart)?)));
        let shorter = |pair: &[Side]| pair[0].length().min(pair[1].length());
        if let Some((pair, paired)) = pairs.max_by(|a, b| shorter(a.0).total_cmp(&shorter(b.0))) {
            return Some(Self::of_pair(pair, &paired));
        }
        let longest = sides.into_iter().max_by(|a, b| a.length().total_cmp(&b.length()))?;
        let middle = even(&longest.points(), POINTS).into_iter().map(|p| (p, 0.0)).collect();
        let own = longest.0.iter().map(|p| (p.0, p.1)).collect();
        (longest.length() > SIDE.1 * height).then_some(Self { own, middle })
    }

    /// Two sides that go on into boughs, up to where they part.
    pub(crate) fn find_below_boughs(page: &Page, group: &[usize]) -> Option<Self> {
        let (sides, height) = sides(page, group)?;
        let of_pair = |pair: &[Side]| {
            let parted = below_parting(&pair[0], &pair[1]).filter(|it| it[0].length() > SIDE.0 * height)?;
            let paired = between(&parted[0].points(), &parted[1].points(), APART.1)?;
            Some(Self::of_pair(&parted, &paired))
        };
        sides.windows(2).find_map(of_pair)
    }

    fn of_pair(pair: &[Side], paired: &Paired) -> Self {
        let own =
            pair.iter().zip(paired.own).flat_map(|(side, own)| side.0[..own].iter().map(|p| (p.0, p.1)));
        Self { own: own.collect(), middle: without_roots(&paired.middle) }
    }

    /// Whether it is one line, without a drawn width.
    pub(crate) fn is_line(&self) -> bool {
        self.middle.iter().all(|row| row.1 == 0.0)
    }

    /// The lines of its sides.
    pub(crate) fn lines(&self) -> impl Iterator<Item = usize> {
        self.own.iter().map(|place| place.0)
    }

    /// Middles and half widths from its foot up, pixels.
    pub(crate) fn rows(&self) -> &[(Vec2, f32)] {
        &self.middle
    }

    /// Width in the middle of its length, pixels.
    pub(crate) fn width(&self) -> f32 {
        2.0 * self.middle[POINTS / 2].1
    }

    /// Middle of its lower end.
    pub(crate) fn foot(&self) -> Vec2 {
        self.middle[0].0
    }

    /// Middle of its upper end.
    pub(crate) fn top(&self) -> Vec2 {
        self.middle[self.middle.len() - 1].0
    }

    /// Whether another line lies on its bark, between its sides and below its top: a ring, a knot, a shade.
    pub(crate) fn has_on_it(&self, number: usize, line: &Line) -> bool {
        let lower = &self.middle[..POINTS * 9 / 10];
        let is_on = |p: &Vec2| {
            let away = |row: &&(Vec2, f32)| row.0.distance_squared(*p);
            let near = lower.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
            near.is_some_and(|row| row.0.distance(*p) < BARK * row.1)
        };
        let is_side = self.own.range((number, 0)..=(number, usize::MAX)).next().is_some();
        !is_side && line.points.iter().all(is_on)
    }

    /// The runs of points of a line that are not the trunk's, each with the line's number.
    pub(crate) fn rest_of(&self, number: usize, line: &Line) -> Vec<(Vec<Vec2>, usize)> {
        let is_own = |k: &usize| self.own.contains(&(number, *k));
        let all: Vec<usize> = (0..line.points.len()).collect();
        let runs =
            all.chunk_by(|a, b| is_own(a) == is_own(b)).filter(|run| !is_own(&run[0]) && run.len() > STEPS);
        runs.map(|run| (run.iter().map(|k| line.points[*k]).collect(), number)).collect()
    }

    /// The trunk as a branch, its drawn width as pressure; a single line has none.
    pub(crate) fn branch(&self) -> Made {
        if self.is_line() {
            return Made::new(Tool::Branch, self.middle.iter().map(|row| row.0));
        }
        Made::thick(plumb(self.middle.clone()))
    }
}

/// The sides that rise from the lowest part of a group of lines, from left to right, and the height of the group.
fn sides(page: &Page, group: &[usize]) -> Option<(Vec<Side>, f32)> {
    let low = group.iter().map(|i| page.lines[*i].bounds.1.y).reduce(f32::max)?;
    let high = group.iter().map(|i| page.lines[*i].bounds.0.y).reduce(f32::min)?;
    let height = low - high;
    let of_line = |i: &usize| Side::of_line(*i, &page.lines[*i], 0.1 * height);
    let stands = |side: &Side| side.foot().y > low - FEET * height;
    let mut sides: Vec<Side> = group.iter().flat_map(of_line).filter(stands).collect();
    if sides.len() > MOST_SIDES {
        return None;
    }
    sides = sides.into_iter().map(|side| side.continued(page, group, GAP * height)).collect();
    // What goes on from another side is none by itself.
    let upper: BTreeSet<usize> =
        sides.iter().flat_map(|side| side.0.iter().map(|p| p.0).filter(|i| *i != side.0[0].0)).collect();
    sides.retain(|side| side.length() > SIDE.0 * height && !upper.contains(&side.0[0].0));
    sides.sort_by(|a, b| a.foot().x.total_cmp(&b.foot().x));
    Some((sides, height))
}

/// Two sides up to where they come apart; nothing if they stay together.
fn below_parting(a: &Side, b: &Side) -> Option<[Side; 2]> {
    let top = |side: &Side| side.0[side.0.len() - 1].2.y;
    let (low, high) = (a.foot().y.min(b.foot().y), top(a).max(top(b)));
    let at = |k: usize| low + (high - low) * k as f32 / (PARTING.1 - 1) as f32;
    let place = |side: &Side, y: f32| side.0.iter().find(|place| place.2.y <= y).map(|place| place.2.x);
    let width = |k: usize| Some((place(b, at(k))? - place(a, at(k))?).abs());
    let widths = (0..PARTING.1).map(width).collect::<Option<Vec<f32>>>()?;
    let narrow = (0..widths.len()).min_by(|a, b| widths[*a].total_cmp(&widths[*b]))?;
    let parting = (narrow..widths.len()).find(|k| widths[*k] > PARTING.0 * widths[narrow])?;
    let below =
        |side: &Side| Side(side.0.iter().copied().take_while(|place| place.2.y > at(parting)).collect());
    let parted = [below(a), below(b)];
    parted.iter().all(|side| side.0.len() > STEPS).then_some(parted)
}

/// Two sides side by side.
struct Paired {
    /// Middle and half distance from their feet up.
    middle: Vec<(Vec2, f32)>,
    /// How many points of each belong to the trunk.
    own: [usize; 2],
}

/// Two sides from their feet up, if they are those of one trunk.
fn between(a: &[Vec2], b: &[Vec2], apart: f32) -> Option<Paired> {
    let lengths = (polyline::length(a), polyline::length(b));
    let (short, long) = if lengths.0 < lengths.1 { (a, b) } else { (b, a) };
    // Where the sides lean, the point of one nearest to the other's end lies lower or higher than its own end.
    let (_, near) = polyline::nearest(long, *short.last()?)?;
    let arc = near.max(lengths.0.min(lengths.1));
    let arcs = polyline::arc_lengths(long.iter().copied());
    let beside = arcs.partition_point(|at| *at <= arc).max(2).min(long.len());
    let length = arc.max(f32::MIN_POSITIVE);
    let is_short = arcs[arcs.len() - 1] - arc < LONGER * length;
    let own_of_long = if is_short { long.len() } else { beside };
    // The longer side goes on alone, with the same distance.
    let aside = short[short.len() - 1] - long[beside - 1];
    let whole: Vec<Vec2> =
        short.iter().copied().chain(long[beside..own_of_long].iter().map(|p| p + aside)).collect();
    let rows = even(&whole, POINTS).into_iter().zip(even(&long[..own_of_long], POINTS));
    let middle: Vec<(Vec2, f32)> = rows.map(|(a, b)| (a.midpoint(b), 0.5 * a.distance(b))).collect();
    let mean = middle.iter().map(|row| row.1).sum::<f32>() / POINTS as f32;
    let overlap = short[0].y.min(long[0].y) - short[short.len() - 1].y.max(long[beside - 1].y);
    let own = if lengths.0 < lengths.1 { [short.len(), own_of_long] } else { [own_of_long, short.len()] };
    let is_trunk = overlap > 0.4 * length
        && (APART.0..apart).contains(&(2.0 * mean / length))
        && middle[POINTS - 1].1 < WIDER * mean;
    is_trunk.then_some(Paired { middle, own })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(lines: &[Vec<Vec2>]) -> Option<(Page, TrunkSides)> {
        let page = Page::of_lines(lines);
        let all: Vec<usize> = (0..page.lines.len()).collect();
        let trunk = TrunkSides::find(&page, &all)?;
        Some((page, trunk))
    }

    fn leaning(x: f32) -> Vec<Vec2> {
        (0..=20).map(|k| Vec2::new(x + 60.0 * (k as f32 / 20.0).powi(2), -5.0 * k as f32)).collect()
    }

    fn crown() -> Vec<Vec2> {
        vec![Vec2::new(20.0, -100.0), Vec2::new(60.0, -130.0), Vec2::new(100.0, -100.0)]
    }

    #[test]
    fn a_bent_trunk_is_as_wide_as_its_sides_are_apart() {
        let (_, trunk) = found(&[leaning(0.0), leaning(12.0), crown()]).unwrap();
        assert!(!trunk.is_line());
        assert!(trunk.foot().distance(Vec2::new(6.0, 0.0)) < 1.0, "{}", trunk.foot());
        assert!(trunk.top().distance(Vec2::new(66.0, -100.0)) < 2.0, "{}", trunk.top());
        let branch = trunk.branch();
        let half = branch.half_width.unwrap() * branch.points[0].pressure;
        assert!((half - 6.0).abs() < 0.6, "{half}");
    }

    #[test]
    fn an_outline_that_goes_up_and_down_has_two_sides() {
        let mut outline = leaning(0.0);
        outline.extend(leaning(12.0).into_iter().rev());
        assert!(found(&[outline, crown()]).is_some_and(|(_, trunk)| !trunk.is_line()));
    }

    #[test]
    fn what_the_longer_side_goes_on_for_is_left_over() {
        let longer = vec![Vec2::new(0.0, 0.0), Vec2::new(0.0, -60.0), Vec2::new(-30.0, -120.0)];
        let shorter = vec![Vec2::new(12.0, 0.0), Vec2::new(12.0, -60.0)];
        let (page, trunk) = found(&[longer, shorter]).unwrap();
        assert!(trunk.top().distance(Vec2::new(6.0, -60.0)) < 3.0, "{}", trunk.top());
        let rest = trunk.rest_of(0, &page.lines[0]);
        assert_eq!(rest.len(), 1);
        assert!(rest[0].0.iter().all(|p| p.y < -55.0));
        assert!(trunk.rest_of(1, &page.lines[1]).is_empty());
    }

    #[test]
    fn two_lines_that_part_are_no_sides_and_one_is_a_trunk_without_width() {
        let fan = |x: f32| vec![Vec2::new(50.0 + 0.1 * x, 0.0), Vec2::new(50.0 + x, -80.0)];
        let (_, trunk) = found(&[fan(-30.0), fan(30.0), crown()]).unwrap();
        assert!(trunk.is_line() && trunk.branch().half_width.is_none());
    }

    #[test]
    fn two_sides_that_go_on_into_boughs_are_a_trunk_up_to_where_they_part() {
        let side = |sign: f32| {
            vec![Vec2::new(8.0 * sign, 0.0), Vec2::new(6.0 * sign, -90.0), Vec2::new(60.0 * sign, -160.0)]
        };
        let page = Page::of_lines(&[side(-1.0), side(1.0)]);
        let trunk = TrunkSides::find_below_boughs(&page, &[0, 1]).unwrap();
        assert!(trunk.top().x.abs() < 2.0 && (-105.0..-85.0).contains(&trunk.top().y), "{}", trunk.top());
        assert!((trunk.width() - 14.0).abs() < 2.0);
        assert!(trunk.rest_of(1, &page.lines[1]).iter().all(|run| run.0.iter().all(|p| p.y < -85.0)));
        let straight = |x: f32| vec![Vec2::new(x, 0.0), Vec2::new(x, -90.0)];
        let page = Page::of_lines(&[straight(-6.0), straight(6.0)]);
        assert!(TrunkSides::find_below_boughs(&page, &[0, 1]).is_none(), "they stay together");
    }

    #[test]
    fn rings_lie_on_the_bark_and_fronds_do_not() {
        let ring = |y: f32| vec![Vec2::new(1.0, y), Vec2::new(6.0, y + 2.0), Vec2::new(11.0, y)];
        let sides = [0.0, 12.0].map(|x| vec![Vec2::new(x, 0.0), Vec2::new(x, -90.0)]);
        let (page, trunk) =
            found(&[ring(-30.0), ring(-60.0), sides[0].clone(), sides[1].clone(), crown()]).unwrap();
        let on_it: Vec<bool> = (0..5).map(|i| trunk.has_on_it(i, &page.lines[i])).collect();
        assert_eq!(on_it, [true, true, false, false, false]);
    }

    #[test]
    fn a_side_may_be_drawn_in_two_strokes() {
        let lower = vec![Vec2::new(0.0, 0.0), Vec2::new(0.0, -30.0)];
        let upper = vec![Vec2::new(0.0, -31.0), Vec2::new(0.0, -90.0)];
        let other = vec![Vec2::new(12.0, 0.0), Vec2::new(12.0, -90.0)];
        let (_, trunk) = found(&[lower, upper, other]).unwrap();
        assert_eq!(trunk.lines().collect::<BTreeSet<_>>(), BTreeSet::from([0, 1, 2]));
        assert!(trunk.foot().y > -2.0 && trunk.top().y < -85.0);
    }
}
