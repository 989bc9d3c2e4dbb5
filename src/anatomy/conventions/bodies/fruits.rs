//! Fruits: round outlines that hang from stalks, as cherries do; those in crowns are found by [`balls`].
//!
//! A fruit is a round outline; where the stalk comes in it may have a notch. Its stalk is a line that ends at its upper part or a
//! little inside and comes from above. Several on stalks that begin near one another, or each on a long line, are a bunch; a stem that
//! comes from below carries a flower. A fruit becomes a body of revolution, the stalk a branch that begins at its upper end; leaves stay with their own
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
/// How far a short stalk comes from above at least, as a share of the fruit's size; how near to a twig it begins, in shares of that,
/// and least length of the twig, in sizes of the fruit. Least of the smallest such fruit in the largest.
const ON_TWIG: (f32, f32, f32) = (0.15, 0.75, 1.5);
const ALIKE: f32 = 0.5;
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
    /// How far above the fruit it begins, in sizes of that.
    rise: f32,
}

fn bunch(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let fruits: Vec<usize> = group.iter().copied().filter(|i| balls::is_round(&page.lines[*i])).collect();
    if !(BUNCH.0..=BUNCH.1).contains(&fruits.len()) {
        return None;
    }
    let hanging =
        fruits.iter().map(|fruit| hanging(page, group, *fruit)).collect::<Option<Vec<Hanging>>>()?;
    if !(begin_together(&hanging) || hang_on_twigs(page, group, &hanging)) {
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

/// Whether all stalks but one begin near another or on its way, and are long.
fn begin_together(hanging: &[Hanging]) -> bool {
    let longest = hanging.iter().map(|it| polyline::length(&it.way)).fold(0.0, f32::max);
    let begins_together = |a: &&Hanging| {
        let near = |b: &Hanging| polyline::nearest(&b.way, a.way[0]).map_or(f32::INFINITY, |(gap, _)| gap);
        let others = hanging.iter().filter(|b| b.fruit != a.fruit);
        others.map(near).fold(f32::INFINITY, f32::min) < TOGETHER * longest
    };
    hanging.iter().all(|it| it.rise > STALK.1)
        && hanging.iter().filter(begins_together).count() + 1 >= hanging.len()
}

/// Whether fruits are alike and every stalk begins at a line that is long beside them and no stalk.
fn hang_on_twigs(page: &Page, group: &[usize], hanging: &[Hanging]) -> bool {
    let size = |it: &Hanging| page.lines[it.fruit].size().max_element();
    let sizes = || hanging.iter().map(size);
    let (small, large) = (sizes().fold(f32::INFINITY, f32::min), sizes().fold(0.0, f32::max));
    let is_stalk = |line: usize| hanging.iter().any(|it| it.stalk == line || it.fruit == line);
    let hangs = |it: &Hanging| {
        let is_twig = |i: &usize| {
            let line = &page.lines[*i];
            let gap = polyline::nearest(&line.points, it.way[0]).map_or(f32::INFINITY, |(gap, _)| gap);
            !is_stalk(*i)
                && line.openness > 0.5
                && line.length > ON_TWIG.2 * size(it)
                && gap < ON_TWIG.1 * size(it)
        };
        it.rise > ON_TWIG.0 && group.iter().any(is_twig)
    };
    small > ALIKE * large && hanging.iter().all(hangs)
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
        let rise = (ball.bounds.0.y - way[0].y) / size;
        (rise > ON_TWIG.0).then_some(Hanging { fruit, stalk: *i, way, rise })
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

    #[test]
    fn balls_on_short_stalks_along_a_twig_are_its_fruits() {
        let twig = line(&[(-150.0, 20.0), (150.0, -20.0)]);
        let stalk = |x: f32| line(&[(x, 6.0), (x, 30.0)]);
        let of = |balls: [f32; 2]| {
            let hanging = balls.into_iter().flat_map(|x| [stalk(x), ball(x, 58.0)]);
            read(&std::iter::once(twig.clone()).chain(hanging).collect::<Vec<_>>())
        };
        assert_eq!(of([-60.0, 60.0])[0].uses, [1, 2, 3, 4], "the twig stays");
        assert!(of([-60.0, 300.0]).is_empty(), "one does not hang on it");
    }
}
