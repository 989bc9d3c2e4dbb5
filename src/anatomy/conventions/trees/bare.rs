//! A bare tree, as in winter: a trunk of two sides, or of one line, with boughs and twigs of single lines. The two
//! sides may go on into boughs.
//!
//! What tells it from a palm, a cactus and grass: lines are nearly straight, do not enclose anything, most of them rise, none begins near the
//! ground, and some begin on others, away from the trunk's top. A line with one corner that is not above its ends is a fork: two twigs from there. Each
//! line becomes a branch.
//!
//! Limits: a single line with few twigs is a stem and left to the classifier; boughs that hang, as a fir's, are none.

use super::trunk_sides::TrunkSides;
use crate::anatomy::conventions::page::Page;
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::collections::BTreeSet;

/// Fewest twigs of a bare tree.
const FEWEST: Fewest = Fewest { on_trunk: 3, on_line: 6, away: 2 };
/// The same of lines that are near one another and do not all touch.
const SCATTERED: Fewest = Fewest { on_trunk: 8, on_line: 10, away: 4 };
/// Least height of a twig above the trunk's foot, as a share of the tree's height.
const CLEAR: f32 = 0.15;
/// How far from the trunk's top that is, as a share of the farthest twig's reach.
const AWAY: f32 = 0.22;
/// Least chord of a twig over its length, and share of all that is drawn above the trunk that twigs are.
const STRAIGHT: f32 = 0.86;
const EXPLAINED: f32 = 0.9;
/// Share of the twigs' length that rises, and least rise of a twig over its chord.
const RISING: (f32, f32) = (0.75, 0.1);
/// How far from the trunk's middle a bough of its side begins at most, in half widths of the trunk.
const BESIDE: f32 = 2.2;
/// Most lines that are looked at.
const MOST: usize = 100;
/// Log-odds of a bare tree, and of each twig, up to so many.
const SCORE: (f32, f32, usize) = (5.0, 0.25, 12);

/// Proposes a bare tree for each group of lines.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    if page.is_mostly_free() {
        out.extend(page.groups.iter().filter_map(|group| bare(page, group, FEWEST)));
        out.extend(page.wide_groups.iter().filter_map(|group| bare(page, group, SCATTERED)));
    }
}

fn bare(page: &Page, group: &[usize], fewest: Fewest) -> Option<Hypothesis> {
    if group.len() > MOST {
        return None;
    }
    let found = TrunkSides::find(page, group);
    let trunk = match found {
        Some(trunk) if !trunk.is_line() => trunk,
        _ => TrunkSides::find_below_boughs(page, group).or(found)?,
    };
    let sides: BTreeSet<usize> = trunk.lines().collect();
    let runs = group.iter().flat_map(|line| trunk.rest_of(*line, &page.lines[*line]));
    // What is left of the sides at their feet is the end of the trunk.
    let half = 0.5 * (trunk.foot().y + trunk.top().y);
    let is_above = |(run, line): &(Vec<Vec2>, usize)| !sides.contains(line) || run.iter().all(|p| p.y < half);
    let runs: Vec<Vec<Vec2>> = runs.filter(is_above).map(|(run, _)| run).collect();
    let mut twigs = straight_twigs(&trunk, &runs, fewest)?;
    grow_from_others(&mut twigs, &trunk);
    twigs.iter_mut().for_each(|twig| twig.begin_in(&trunk));
    if !are_of_a_tree(&twigs, trunk.top(), fewest) {
        return None;
    }
    let uses: BTreeSet<usize> = group.iter().copied().chain(sides).collect();
    let score = SCORE.0 + SCORE.1 * twigs.len().min(SCORE.2) as f32;
    let branches = twigs.into_iter().map(|twig| Made::new(Tool::Branch, twig.points));
    Some(Hypothesis {
        uses: uses.into_iter().collect(),
        score,
        parts: [trunk.branch()].into_iter().chain(branches).collect(),
        solids: Vec::new(),
        reading: Reading::BareTree,
        habit: Some(Habit::Tree),
    })
}

/// How many twigs make a bare tree.
#[derive(Clone, Copy)]
struct Fewest {
    /// On a trunk of two sides.
    on_trunk: usize,
    /// On a trunk of one line.
    on_line: usize,
    /// Those among them that begin away from the trunk's top.
    away: usize,
}

/// A bough or a twig.
struct Twig {
    points: Vec<Vec2>,
    /// Whether it begins at the corner of a fork, and so is known to grow from its first point on.
    is_forked: bool,
}

impl Twig {
    /// A line, or both twigs of a fork from its corner.
    fn of(run: &[Vec2]) -> Vec<Self> {
        let (first, last) = (run[0], run[run.len() - 1]);
        let away = |k: &usize| (last - first).perp_dot(run[*k] - first).abs();
        let corner = (0..run.len()).max_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0);
        let is_low = run[corner].y > first.y.min(last.y) && corner > 0 && corner + 1 < run.len();
        if !is_straight(run) && is_low && is_straight(&run[..=corner]) && is_straight(&run[corner..]) {
            let down: Vec<Vec2> = run[..=corner].iter().rev().copied().collect();
            return [down, run[corner..].to_vec()].map(|points| Self { points, is_forked: true }).into();
        }
        vec![Self { points: run.to_vec(), is_forked: false }]
    }

    fn base(&self) -> Vec2 {
        self.points[0]
    }

    fn length(&self) -> f32 {
        polyline::length(&self.points)
    }

    /// Leads a bough that goes on from a side of the trunk, or begins beside it, to the middle of the trunk.
    fn begin_in(&mut self, trunk: &TrunkSides) {
        let away = |row: &&(Vec2, f32)| row.0.distance_squared(self.base());
        let nearest = trunk.rows().iter().min_by(|a, b| away(a).total_cmp(&away(b))).copied();
        if let Some((middle, half)) = nearest.filter(|row| row.0.distance(self.base()) < BESIDE * row.1)
            && middle.distance(self.base()) > 0.2 * half
        {
            self.points.insert(0, middle);
        }
    }

    fn rises(&self) -> bool {
        let chord = chord(&self.points);
        -chord.y > RISING.1 * chord.length()
    }
}

/// The straight twigs among some lines above a trunk, if they are nearly all of them, enough, and clear of the ground.
fn straight_twigs(trunk: &TrunkSides, runs: &[Vec<Vec2>], fewest: Fewest) -> Option<Vec<Twig>> {
    let twigs: Vec<Twig> =
        runs.iter().flat_map(|run| Twig::of(run)).filter(|twig| is_straight(&twig.points)).collect();
    let drawn: f32 = runs.iter().map(|run| polyline::length(run)).sum();
    let explained: f32 = twigs.iter().map(Twig::length).sum();
    let points = || twigs.iter().flat_map(|twig| &twig.points);
    let (foot, high) = (trunk.foot().y, points().map(|p| p.y).fold(f32::INFINITY, f32::min));
    let is_clear = points().all(|p| foot - p.y > CLEAR * (foot - high));
    let fewest = if trunk.is_line() { fewest.on_line } else { fewest.on_trunk };
    (twigs.len() >= fewest && explained > EXPLAINED * drawn && is_clear).then_some(twigs)
}

/// Turns twigs so that each begins at the end that is nearer to the trunk or to another.
fn grow_from_others(twigs: &mut [Twig], trunk: &TrunkSides) {
    let middle: Vec<Vec2> = trunk.rows().iter().map(|row| row.0).collect();
    let gap = |place: Vec2, own: usize| {
        let others = twigs.iter().enumerate().filter(|(number, _)| *number != own);
        let lines = others.map(|(_, twig)| &twig.points).chain([&middle]);
        let gaps = lines.filter_map(|line| polyline::nearest(line, place));
        gaps.map(|(gap, _)| gap).fold(f32::INFINITY, f32::min)
    };
    let is_turned = |(own, twig): (usize, &Twig)| {
        !twig.is_forked && gap(twig.base(), own) > gap(twig.points[twig.points.len() - 1], own)
    };
    let turned: Vec<bool> = twigs.iter().enumerate().map(is_turned).collect();
    twigs.iter_mut().zip(turned).filter(|(_, turned)| *turned).for_each(|(twig, _)| twig.points.reverse());
}

/// Whether most of some twigs rise, and some begin away from the top of their trunk.
fn are_of_a_tree(twigs: &[Twig], top: Vec2, fewest: Fewest) -> bool {
    let reach = twigs.iter().flat_map(|twig| &twig.points).map(|p| p.distance(top)).fold(0.0, f32::max);
    let begins_away = |twig: &&Twig| twig.base().distance(top) > AWAY * reach;
    let length: f32 = twigs.iter().map(Twig::length).sum();
    let rising: f32 = twigs.iter().filter(|twig| twig.rises()).map(Twig::length).sum();
    twigs.iter().filter(begins_away).count() >= fewest.away && rising > RISING.0 * length
}

fn chord(twig: &[Vec2]) -> Vec2 {
    twig[twig.len() - 1] - twig[0]
}

fn is_straight(twig: &[Vec2]) -> bool {
    chord(twig).length() > STRAIGHT * polyline::length(twig)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    fn sides() -> [Vec<Vec2>; 2] {
        [line(&[(-8.0, 0.0), (-5.0, -90.0)]), line(&[(8.0, 0.0), (5.0, -90.0)])]
    }

    /// Three boughs from the trunk's top.
    fn boughs() -> Vec<Vec<Vec2>> {
        vec![
            line(&[(-5.0, -90.0), (-60.0, -150.0)]),
            line(&[(0.0, -90.0), (2.0, -180.0)]),
            line(&[(5.0, -90.0), (55.0, -155.0)]),
        ]
    }

    #[test]
    fn boughs_with_twigs_on_a_trunk_of_two_sides_are_a_bare_tree() {
        let fork = line(&[(-70.0, -120.0), (-32.0, -118.0), (-30.0, -160.0)]);
        let twig = line(&[(1.0, -130.0), (25.0, -165.0)]);
        let lines: Vec<Vec<Vec2>> = sides().into_iter().chain(boughs()).chain([fork, twig]).collect();
        let found = read(&lines);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].reading, found[0].uses.len()), (Reading::BareTree, 7));
        assert_eq!(found[0].habit, Some(Habit::Tree));
        assert!(found[0].parts.iter().all(|part| part.tool == Tool::Branch));
        assert!(found[0].parts[0].half_width.is_some(), "the trunk is as wide as drawn");
    }

    #[test]
    fn sides_that_go_on_into_boughs_are_a_trunk_and_boughs_that_begin_in_it() {
        let side = |sign: f32| line(&[(8.0 * sign, 0.0), (6.0 * sign, -90.0), (60.0 * sign, -160.0)]);
        let twig = |sign: f32| line(&[(35.0 * sign, -128.0), (75.0 * sign, -140.0)]);
        let bough = line(&[(0.0, -92.0), (3.0, -190.0)]);
        let found = read(&[side(-1.0), side(1.0), twig(-1.0), twig(1.0), bough]);
        assert_eq!(found.first().map(|tree| tree.parts.len()), Some(6));
        let begins =
            |part: &&Made| part.points[0].position.x.abs() < 3.0 && part.points[0].position.y < -60.0;
        assert_eq!(found[0].parts[1..].iter().filter(begins).count(), 3);
    }

    #[test]
    fn a_trunk_of_one_line_has_many_twigs_and_grass_has_no_trunk() {
        let trunk = line(&[(0.0, 0.0), (0.0, -90.0)]);
        let twigs = [(-30.0, -120.0), (1.0, -135.0), (28.0, -122.0)]
            .map(|(x, y)| line(&[(x, y), (1.6 * x + 8.0, y - 40.0)]));
        let lines: Vec<Vec<Vec2>> = [trunk.clone()].into_iter().chain(boughs()).chain(twigs).collect();
        assert_eq!(read(&lines).len(), 1);
        assert!(read(&lines[..6]).is_empty(), "a stem with twigs");
        let blade = |k: i32| line(&[(8.0 * k as f32, 0.0), (8.0 * k as f32 + 12.0 * (k % 2) as f32, -80.0)]);
        assert!(read(&(0..14).map(blade).collect::<Vec<_>>()).is_empty());
    }

    #[test]
    fn lines_from_one_place_arcs_and_outlines_are_none() {
        let palm: Vec<Vec<Vec2>> = sides().into_iter().chain(boughs()).collect();
        assert!(read(&palm).is_empty(), "they may be fronds");
        let hanging = |x: f32| line(&[(0.0, -90.0), (x, -130.0), (2.0 * x, -80.0)]);
        let arcs = sides().into_iter().chain([-50.0, -30.0, 30.0, 50.0].map(hanging)).collect::<Vec<_>>();
        assert!(read(&arcs).is_empty());
        let crown: Vec<Vec2> =
            (0..=40).map(|k| Vec2::from_angle(0.157 * k as f32) * 70.0 - Vec2::Y * 150.0).collect();
        let full: Vec<Vec<Vec2>> = palm.into_iter().chain([crown]).collect();
        assert!(read(&full).is_empty());
    }
}
