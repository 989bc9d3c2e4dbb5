//! Fruits: round outlines that hang from stalks, as cherries do; those in crowns are found by [`balls`].
//!
//! A fruit is a round outline; where the stalk comes in it may have a notch. Its stalk is a line that ends at its upper part or a
//! little inside and comes from above. Several on stalks that begin near one another are a bunch; a stem that comes from below carries a
//! flower. A fruit becomes a body of revolution, the stalk a branch that begins at its upper end; leaves stay with their own
//! conventions.
//!
//! Limits: fruits that are no balls; a single fruit.

use crate::anatomy::conventions::page::Page;
use crate::anatomy::conventions::shapes::balls;
use crate::anatomy::conventions::{Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// How far from a fruit's outline a stalk ends at most and how far up it comes from at least, as shares of the fruit's size; and the
/// part of the fruit, from above, where it ends.
const STALK: (f32, f32) = (0.3, 0.4);
const UPPER: f32 = 0.55;
/// Fewest fruits of a bunch, and most; how far apart stalks begin at most, as a share of the longest, or come to another's way.
const BUNCH: (usize, usize) = (2, 24);
const TOGETHER: f32 = 0.25;
/// Log-odds of a bunch, and more for each fruit.
const SCORE: (f32, f32) = (4.0, 0.3);

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
    let fruits: Vec<usize> = group.iter().copied().filter(|i| balls::is_round(&page.lines[*i])).collect();
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
    let solids = hanging.iter().map(|it| balls::fruit(&page.lines[it.fruit])).collect();
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
        let is_line = *i != fruit && line.openness > 0.5 && !balls::is_round(line);
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
}
