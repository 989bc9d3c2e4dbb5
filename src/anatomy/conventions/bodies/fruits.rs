//! Fruits: round outlines that hang from stalks, as cherries do, and round outlines in the crown of a tree.
//!
//! A fruit is a round outline; where the stalk comes in it may have a notch. Its stalk is a line that ends at its upper part or a
//! little inside and comes from above. Several on stalks that begin near one another are a bunch; a stem that comes from below carries a
//! flower. A fruit becomes a body of revolution, the stalk a branch that begins at its upper end; leaves stay with their own
//! conventions. In a crown round outlines are fruits if several are alike, much smaller than that, and by themselves ([`in_crown`]).
//!
//! Limits: fruits that are no balls; a single fruit.

use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::{Hypothesis, Made, Solid, SolidKind};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::f32::consts::{FRAC_PI_4, PI};

/// Largest opening of a fruit's outline, narrower over wider side, and the least and largest share of the ellipse in its bounds that
/// its hull fills.
const OPEN: f32 = 0.45;
const NARROW: f32 = 0.72;
const FILL: (f32, f32) = (0.88, 1.12);
/// How far from a fruit's outline a stalk ends at most and how far up it comes from at least, as shares of the fruit's size; and the
/// part of the fruit, from above, where it ends.
const STALK: (f32, f32) = (0.3, 0.4);
const UPPER: f32 = 0.55;
/// Fewest fruits of a bunch, and most; how far apart stalks begin at most, as a share of the longest, or come to another's way.
const BUNCH: (usize, usize) = (2, 24);
const TOGETHER: f32 = 0.25;
/// Log-odds of a bunch, and more for each fruit.
const SCORE: (f32, f32) = (4.0, 0.3);
/// Largest fruit in a crown and smallest, as shares of the crown's larger side.
const IN_CROWN: (f32, f32) = (0.03, 0.22);
/// How far other lines are from one at least, as a share of its size, and most of the largest in the smallest: loops of foliage touch.
const FREE: f32 = 0.06;
const ALIKE: f32 = 1.8;
/// Rows of a fruit's outline.
const ROWS: usize = 12;

/// Proposes a bunch of fruits for each group of lines.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    out.extend(page.groups.iter().chain(&page.wide_groups).filter_map(|group| bunch(page, group)));
}

/// A fruit on its stalk.
struct Hanging {
    fruit: usize,
    stalk: usize,
    /// The stalk from its upper end to the fruit.
    way: Vec<Vec2>,
}

fn bunch(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let fruits: Vec<usize> = group.iter().copied().filter(|i| is_round(&page.lines[*i])).collect();
    if !(BUNCH.0..=BUNCH.1).contains(&fruits.len()) {
        return None;
    }
    let hanging =
        fruits.iter().map(|fruit| hanging(page, group, *fruit)).collect::<Option<Vec<Hanging>>>()?;
    let longest = hanging.iter().map(|it| polyline::length(&it.way)).fold(0.0, f32::max);
    let begins_together = |a: &Hanging| {
        let near = |b: &Hanging| polyline::nearest(&b.way, a.way[0]).map_or(f32::INFINITY, |(gap, _)| gap);
        let others = hanging.iter().filter(|b| b.fruit != a.fruit);
        others.map(near).fold(f32::INFINITY, f32::min) < TOGETHER * longest
    };
    if hanging.iter().filter(|it| begins_together(it)).count() + 1 < hanging.len() {
        return None;
    }
    let mut uses: Vec<usize> = hanging.iter().flat_map(|it| [it.fruit, it.stalk]).collect();
    uses.sort_unstable();
    uses.dedup();
    let solids = hanging.iter().map(|it| solid(&page.lines[it.fruit])).collect();
    let score = (SCORE.0 + SCORE.1 * hanging.len() as f32) * page.weight(page.diagonal);
    let parts = hanging.into_iter().map(|it| Made::new(Tool::Branch, it.way)).collect();
    Some(Hypothesis { uses, score, parts, solids, reading: Reading::Fruit, habit: None })
}

/// A fruit with the stalk that ends at it, if there is one that comes from above and none from below.
fn hanging(page: &Page, group: &[usize], fruit: usize) -> Option<Hanging> {
    let ball = &page.lines[fruit];
    let size = ball.size().max_element();
    let is_at = |p: Vec2| {
        let gap = polyline::nearest(&ball.points, p).map_or(f32::INFINITY, |(gap, _)| gap);
        gap < STALK.0 * size && p.y < ball.bounds.0.y + UPPER * ball.size().y
    };
    let from_above = |i: &usize| -> Option<Hanging> {
        let line = &page.lines[*i];
        let ends = [&line.points[0], &line.points[line.points.len() - 1]];
        let is_line = *i != fruit && line.openness > 0.5 && !is_round(line);
        if !is_line {
            return None;
        }
        // One line may be the stalks of two: its highest place is where they part.
        let top = (0..line.points.len()).min_by(|a, b| line.points[*a].y.total_cmp(&line.points[*b].y))?;
        let ways = [line.points[..=top].to_vec(), line.points[top..].iter().rev().copied().collect()];
        let (_, mut way) = ends.iter().zip(ways).find(|(end, way)| is_at(***end) && way.len() > 2)?;
        way.reverse();
        let is_long = ball.bounds.0.y - way[0].y > STALK.1 * size;
        is_long.then_some(Hanging { fruit, stalk: *i, way })
    };
    group.iter().find_map(from_above)
}

/// Whether a line is a ball, with a notch where its stalk comes in or without.
fn is_round(line: &Line) -> bool {
    let size = line.size();
    let fill = line.hull_area / (FRAC_PI_4 * size.x * size.y).max(f32::MIN_POSITIVE);
    line.openness < OPEN
        && line.solidity() > 0.7
        && size.min_element() > NARROW * size.max_element()
        && (FILL.0..FILL.1).contains(&fill)
        && !line.is_scribble()
}

/// A ball as wide and high as an outline.
fn solid(line: &Line) -> Solid {
    let (middle, half) = (line.middle(), 0.5 * line.size());
    let row = |k: usize| {
        let angle = PI * k as f32 / ROWS as f32;
        Vec2::new(half.x * angle.sin(), middle.y - half.y * angle.cos())
    };
    Solid { kind: SolidKind::Fruit, axis: middle.x, profile: (0..=ROWS).map(row).collect() }
}

/// The fruits among the lines in a crown.
pub(crate) fn in_crown<'a>(lines: impl Iterator<Item = &'a Line>, crown: &[Vec2]) -> Vec<Solid> {
    let (low, high) = polyline::bounds(crown.iter().copied());
    let whole = (high - low).max_element();
    let is_inside = |line: &Line| line.bounds.0.cmpgt(low).all() && line.bounds.1.cmplt(high).all();
    let is_of_size =
        |line: &Line| (IN_CROWN.0 * whole..IN_CROWN.1 * whole).contains(&line.size().max_element());
    let all: Vec<&Line> = lines.collect();
    let is_free = |line: &Line| {
        let margin = Vec2::splat(FREE * line.size().max_element());
        let (low, high) = (line.bounds.0 - margin, line.bounds.1 + margin);
        let is_near = |p: &Vec2| p.cmpgt(low).all() && p.cmplt(high).all();
        all.iter().filter(|other| other.stroke != line.stroke).all(|other| !other.points.iter().any(is_near))
    };
    let is_fruit = |line: &&Line| is_inside(line) && is_of_size(line) && is_round(line) && is_free(line);
    let fruits: Vec<&Line> = all.iter().copied().filter(is_fruit).collect();
    let sizes = fruits.iter().map(|fruit| fruit.size().max_element());
    let (small, large) = sizes.fold((f32::INFINITY, 0.0_f32), |(a, b), size| (a.min(size), b.max(size)));
    let are_alike = fruits.len() >= BUNCH.0 && large < ALIKE * small;
    if are_alike { fruits.into_iter().map(solid).collect() } else { Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use std::f32::consts::TAU;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    fn ball(x: f32, y: f32) -> Vec<Vec2> {
        (0..=48).map(|k| Vec2::new(x, y) + 30.0 * Vec2::from_angle(TAU * k as f32 / 48.0)).collect()
    }

    #[test]
    fn balls_on_stalks_that_meet_are_cherries_however_the_stalks_are_drawn() {
        let (left, right) =
            (line(&[(0.0, -100.0), (-20.0, -40.0), (-40.0, 0.0)]), line(&[(0.0, -100.0), (40.0, 0.0)]));
        let in_one: Vec<Vec2> = left.iter().rev().chain(&right).copied().collect();
        for stalks in [vec![left, right], vec![in_one]] {
            let found = read(&[vec![ball(-40.0, 30.0), ball(40.0, 30.0)], stalks.clone()].concat());
            let [bunch] = &found[..] else { panic!("{} bunches", found.len()) };
            assert_eq!((bunch.solids.len(), bunch.parts.len(), bunch.uses.len()), (2, 2, 2 + stalks.len()));
            let begins_above = |part: &Made| part.points[0].position.distance(Vec2::new(0.0, -100.0)) < 5.0;
            assert!(bunch.parts.iter().all(begins_above));
            let (low, high) = bunch.solids[0].bounds();
            assert!((high - low - 60.0).abs().max_element() < 2.0);
        }
    }

    #[test]
    fn heads_on_stems_from_below_one_ball_and_two_apart_are_none() {
        let from_below = [line(&[(0.0, 200.0), (-40.0, 60.0)]), line(&[(0.0, 200.0), (40.0, 60.0)])];
        assert!(read(&[vec![ball(-40.0, 30.0), ball(40.0, 30.0)], from_below.to_vec()].concat()).is_empty());
        assert!(read(&[ball(0.0, 30.0), line(&[(0.0, -100.0), (0.0, 0.0)])]).is_empty());
        let apart = [line(&[(-40.0, -100.0), (-40.0, 0.0)]), line(&[(200.0, -100.0), (200.0, 0.0)])];
        assert!(read(&[vec![ball(-40.0, 30.0), ball(200.0, 30.0)], apart.to_vec()].concat()).is_empty());
    }

    #[test]
    fn small_balls_in_a_crown_are_its_fruits() {
        let crown: Vec<Vec2> = ball(0.0, 0.0).iter().map(|p| 10.0 * *p).collect();
        let lines =
            Page::of_lines(&[ball(50.0, 0.0), ball(-90.0, 80.0), line(&[(-200.0, 0.0), (-160.0, 9.0)])])
                .lines;
        assert_eq!(in_crown(lines.iter(), &crown).len(), 2);
        let tight: Vec<Vec2> = crown.iter().map(|p| 0.4 * *p).collect();
        assert!(in_crown(lines.iter(), &tight).is_empty());
    }
}
