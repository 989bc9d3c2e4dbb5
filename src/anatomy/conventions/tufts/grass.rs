//! Blades of grass: a zigzag, or lines side by side that stand on one level.
//!
//! A zigzag is found by its [`teeth`](crate::anatomy::conventions::shapes::teeth). Lines side by side are upright and their feet at about
//! one level; arcs that lean to a common tip are one blade. On a hill that was drawn they may stand at any height. Every spike becomes one
//! blade, as wide as it was drawn up to [`HALF`], and its root is led down to the lowest foot, on which all stand.
//!
//! What speaks against grass: something that stands below it, which would be a trunk, a stem or a pot, and an outline
//! around it. A blade may be drawn as a narrow closed loop beside others.
//!
//! Limits: grass that lies is not found; nor is the upper edge of a lawn that has too few tips for a zigzag.

use crate::anatomy::conventions::page::{self, Line, Page, median};
use crate::anatomy::conventions::shapes::spikes::{Spike, joined};
use crate::anatomy::conventions::shapes::teeth::{is_upright, upright_spikes, zigzag};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::polyline;
use crate::geom::region::Region;
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::collections::BTreeSet;

/// Least size of an outline around a zigzag, in its sizes, and least share of the zigzag's points in it.
const AROUND: (f32, f32) = (0.8, 0.7);
/// How far what carries a zigzag goes on below it, and its least height, in heights of the zigzag.
const BELOW: f32 = 0.35;
/// Least width of what closes the outline of a lawn, in its heights, and how far it may be from the zigzag's width and ends, as a
/// share of that: a pot is higher.
const LAWN: (f32, f32) = (2.2, 0.2);
/// Share of the length of all strokes that stands side by side.
const MOST_OF_ALL: f32 = 0.8;
/// Most zigzags that are looked at.
const MOST_ZIGZAGS: usize = 200;
/// Fewest lines and blades side by side.
const LINES: usize = 3;
const BLADES: usize = 4;
/// Half width of a blade at most, as a share of its length.
const HALF: f32 = 0.09;
/// The same where the sides do not come apart toward the foot: not a tooth between others, but a blade as it is.
const ARCH: f32 = 0.25;
/// Least chord of a line that leans, over its length, and least rise, as a share of its chord.
const LEANING: (f32, f32) = (0.75, 0.25);
/// How far from their ground the feet of blades may be, as a share of the middle length of the blades, the steepest ground, and least
/// width of a row by whose feet it is known, in lengths of its blades.
const LEVEL: f32 = 0.4;
const STEEP: f32 = 0.2;
const LONG_ROW: f32 = 4.0;
/// How far the lowest one or two lines begin below all others, as a share of the height of all, where these are at least so
/// many: a trunk's.
const TRUNK: (f32, usize) = (0.2, 4);
/// Least width of an arch over lines that hang from it, as a share of theirs, how far below it they begin at most, as a share
/// of its width, and how many do at least.
const ARCH_OVER: (f32, f32, f32) = (0.8, 0.16, 0.6);
/// Height from which a line is no blade beside others, in heights of the one in the middle of all.
const GIANT: f32 = 3.5;
/// Least width of a hill's line over its length, and how near to its lowest place both ends are, in its heights.
const HILL: (f32, f32) = (0.75, 0.3);
/// Greatest height of a line that may be the ground, as a share of its width.
const GROUND: f32 = 0.22;

/// Proposes one hypothesis for each zigzag, and one for all lines that stand side by side.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let zigzags = (0..page.lines.len()).filter_map(|i| Some((i, zigzag(&page.lines[i])?)));
    // Each of them is held against all lines, so their number is limited.
    let stand = |(i, _): &(usize, Vec<Spike>)| !stands_on_something(page, *i) && !is_inside_another(page, *i);
    out.extend(zigzags.take(MOST_ZIGZAGS).filter(stand).map(|(i, teeth)| {
        let score = 2.0 + 0.25 * teeth.len().min(12) as f32;
        let uses = [Some(i), lawn_below(page, i)].into_iter().flatten().collect::<BTreeSet<_>>();
        grass(
            uses.into_iter().collect(),
            score,
            &teeth.into_iter().map(|tooth| (tooth, HALF)).collect::<Vec<_>>(),
            0.0,
        )
    }));
    out.extend(side_by_side(page));
}

/// Whether a line begins at the height of a zigzag's feet or among its teeth and goes on below: a trunk, a stem, a pot.
fn stands_on_something(page: &Page, index: usize) -> bool {
    let (low, high) = page.lines[index].bounds;
    let height = high.y - low.y;
    let is_below = |other: &Line| {
        let across = other.bounds.1.x.min(high.x) - other.bounds.0.x.max(low.x);
        let is_lower =
            across >= 0.0 && other.bounds.1.y > high.y + BELOW * height && other.size().y > BELOW * height;
        is_lower && !is_ground(other) && zigzag(other).is_none()
    };
    let lawn = lawn_below(page, index);
    let others = page.lines.iter().enumerate().filter(|(i, _)| *i != index && Some(*i) != lawn);
    others.into_iter().any(|(_, other)| is_below(other))
}

/// The line that goes from one end of a zigzag down and around to the other: the rest of a lawn of which it is the upper edge.
fn lawn_below(page: &Page, index: usize) -> Option<usize> {
    let zigzag = &page.lines[index];
    let (a, b) = zigzag.ends();
    let near = LAWN.1 * zigzag.size().x;
    let closes = |line: &Line| {
        let (c, d) = line.ends();
        let size = line.size();
        size.x > LAWN.0 * size.y
            && (size.x / zigzag.size().x - 1.0).abs() < LAWN.1
            && (a.distance(c).max(b.distance(d)) < near || a.distance(d).max(b.distance(c)) < near)
    };
    (0..page.lines.len()).find(|i| *i != index && closes(&page.lines[*i]))
}

/// Whether a line is level and may be the ground.
fn is_ground(line: &Line) -> bool {
    line.size().y < GROUND * line.size().x
}

/// Whether one of the other lines goes around most of a zigzag, which then is foliage in it.
fn is_inside_another(page: &Page, index: usize) -> bool {
    let zigzag = &page.lines[index];
    let goes_around = |other: &Line| {
        let size = other.size();
        let is_large = size.cmpgt(AROUND.0 * zigzag.size()).all() && other.solidity() > 0.5;
        is_large && {
            let hull = Region::new(other.hull.clone());
            let inside = zigzag.points.iter().filter(|p| hull.contains(**p)).count();
            inside as f32 > AROUND.1 * zigzag.points.len() as f32
        }
    };
    page.lines.iter().enumerate().any(|(i, other)| i != index && goes_around(other))
}

/// All lines that stand side by side, if they are most of the drawing.
pub(super) fn side_by_side(page: &Page) -> Option<Hypothesis> {
    let all = || (0..page.lines.len()).filter(|i| !page.is_apart(*i));
    let upright: Vec<usize> = all().filter(|i| is_upright(&page.lines[*i])).collect();
    let leaning: Vec<usize> = all().filter(|i| is_leaning(&page.lines[*i])).collect();
    let (upright, leaning) = (blades_of(page, &upright), blades_of(page, &leaning));
    upright.into_iter().chain(leaning).max_by(|a, b| a.score.total_cmp(&b.score))
}

/// The blades that some lines are, with the ground on which they stand, if these are most of the drawing.
fn blades_of(page: &Page, upright: &[usize]) -> Option<Hypothesis> {
    let upright = &without_giants(page, upright);
    let teeth: Vec<(usize, Vec<Spike>)> =
        upright.iter().map(|i| (*i, upright_spikes(&page.lines[*i]))).collect();
    let has_one = |i: &usize| teeth.iter().any(|(line, spikes)| line == i && spikes.len() == 1);
    let all = teeth.iter().flat_map(|(i, spikes)| spikes.iter().map(|spike| (spike.clone(), *i)));
    let (single, double): (Vec<_>, Vec<_>) = all.partition(|(spike, _)| spike.flanks.len() == 1);
    let mut blades = joined(single, |tip| tip.x);
    blades.extend(double.into_iter().map(|(spike, line)| (spike, vec![line])));
    if upright.len() < LINES || blades.len() < BLADES || stand_on_trunk(page, upright) || hang(page, upright)
    {
        return None;
    }
    let (ground, height) = ground_of(&blades).or_else(|| foot_of_hill(page, &blades))?;
    let is_at_feet = |line: &Line| line.points.iter().any(|p| ground.above(*p).abs() < LEVEL * height);
    let is_beneath = |line: &Line| (is_ground(line) || is_hill(line)) && is_at_feet(line);
    let mut uses: Vec<usize> = (0..page.lines.len())
        .filter(|i| !page.is_apart(*i) && !upright.contains(i) && is_beneath(&page.lines[*i]))
        .chain(upright.iter().copied())
        .collect();
    if uses.iter().map(|i| page.lines[*i].length).sum::<f32>() < MOST_OF_ALL * page.length {
        return None;
    }
    uses.sort_unstable();
    let half = |spike: &Spike, lines: &[usize]| {
        if spike.is_arch() && lines.iter().all(has_one) { ARCH } else { HALF }
    };
    let spikes: Vec<(Spike, f32)> = blades
        .into_iter()
        .map(|(spike, lines)| {
            let half = half(&spike, &lines);
            (spike, half)
        })
        .collect();
    // Blades beside a zigzag belong to it.
    let score = 1.9 + 0.25 * spikes.len().min(12) as f32 + 0.05 * uses.len() as f32;
    Some(grass(uses, score, &spikes, ground.slope))
}

/// Whether one or two of some lines begin far below all others, which then grow from a trunk.
fn stand_on_trunk(page: &Page, lines: &[usize]) -> bool {
    let mut feet: Vec<f32> = lines.iter().map(|line| page.lines[*line].bounds.1.y).collect();
    let high = lines.iter().map(|line| page.lines[*line].bounds.0.y).fold(f32::INFINITY, f32::min);
    feet.sort_by(|a, b| b.total_cmp(a));
    let parts = |below: usize| {
        feet.len() >= below + TRUNK.1 && feet[below - 1] - feet[below] > TRUNK.0 * (feet[0] - high)
    };
    parts(1) || parts(2)
}

/// Whether most of some lines hang from an arch over all of them: the branches of a willow.
pub(super) fn hang(page: &Page, lines: &[usize]) -> bool {
    let (low, high) = page::bounds(lines.iter().map(|line| &page.lines[*line]));
    let is_arch = |line: &Line| {
        let size = line.size();
        let ends = line.ends();
        size.x > ARCH_OVER.0 * (high.x - low.x)
            && line.bounds.0.y < low.y
            && ends.0.y.min(ends.1.y) > line.bounds.0.y + 0.3 * size.y
            && ends.0.distance(ends.1) > 0.5 * size.x
    };
    let hangs_from = |arch: &Line, line: &Line| {
        let top = line.points.iter().copied().min_by(|a, b| a.y.total_cmp(&b.y));
        top.and_then(|top| polyline::nearest(&arch.points, top))
            .is_some_and(|(gap, _)| gap < ARCH_OVER.1 * arch.size().x)
    };
    let arches = page.lines.iter().enumerate().filter(|(i, line)| !page.is_apart(*i) && is_arch(line));
    arches.into_iter().any(|(_, arch)| {
        let hanging = lines.iter().filter(|line| hangs_from(arch, &page.lines[**line])).count();
        hanging as f32 > ARCH_OVER.2 * lines.len() as f32
    })
}

/// Those of some lines that are not much higher than most: a flower in grass is no blade.
fn without_giants(page: &Page, lines: &[usize]) -> Vec<usize> {
    let height = |line: &usize| page.lines[*line].size().y;
    let mut heights: Vec<f32> = lines.iter().map(height).collect();
    if heights.is_empty() {
        return Vec::new();
    }
    let most = GIANT * median(&mut heights);
    lines.iter().copied().filter(|line| height(line) < most).collect()
}

/// A blade for every tip of these lines, all on one ground.
pub(crate) fn upright_blades(lines: &[&Line]) -> Vec<Made> {
    let spikes: Vec<(Spike, f32)> =
        lines.iter().flat_map(|line| upright_spikes(line)).map(|spike| (spike, HALF)).collect();
    grass(Vec::new(), 0.0, &spikes, 0.0).parts
}

/// Whether a line goes one way, though it leans far.
fn is_leaning(line: &Line) -> bool {
    let way = line.ends().1 - line.ends().0;
    way.length() > LEANING.0 * line.length && way.y.abs() > LEANING.1 * way.length()
}

/// The line on which blades stand.
#[derive(Clone, Copy)]
struct Ground {
    /// Its height where x is 0, and its slope.
    level: f32,
    slope: f32,
}

impl Ground {
    /// How far a place is above it.
    fn above(self, p: Vec2) -> f32 {
        self.level + self.slope * p.x - p.y
    }

    /// That of this slope on which most places are, about.
    fn with_slope(feet: &[Vec2], slope: f32) -> Self {
        Self { level: median(&mut feet.iter().map(|p| p.y - slope * p.x).collect::<Vec<_>>()), slope }
    }
}

/// Whether a line may be a hill: an arch that goes one way and comes down at both ends.
fn is_hill(line: &Line) -> bool {
    let (first, last) = line.ends();
    let low = line.bounds.1.y - HILL.1 * line.size().y;
    (first.x - last.x).abs() > HILL.0 * line.length && first.y > low && last.y > low
}

/// The foot of a hill that was drawn, if all blades stand on it, and their middle length.
fn foot_of_hill(page: &Page, blades: &[(Spike, Vec<usize>)]) -> Option<(Ground, f32)> {
    let height =
        median(&mut blades.iter().map(|blade| blade.0.foot().distance(blade.0.tip())).collect::<Vec<_>>());
    let is_near = |line: &Line, foot: Vec2| {
        polyline::nearest(&line.points, foot).is_some_and(|(gap, _)| gap < LEVEL * height)
    };
    let carries = |line: &&Line| blades.iter().all(|blade| is_near(line, blade.0.foot()));
    let hill = page.lines.iter().filter(|line| is_hill(line)).find(carries)?;
    Some((Ground { level: hill.bounds.1.y, slope: 0.0 }, height))
}

/// The ground on which most blades stand, level or, where that is not so, as the two ends of a long row say, and their middle length;
/// nothing if one stands far below, as a trunk would.
fn ground_of(blades: &[(Spike, Vec<usize>)]) -> Option<(Ground, f32)> {
    let mut feet: Vec<Vec2> = blades.iter().map(|blade| blade.0.foot()).collect();
    let mut lengths: Vec<f32> = blades.iter().map(|blade| blade.0.foot().distance(blade.0.tip())).collect();
    let height = median(&mut lengths);
    feet.sort_by(|a, b| a.x.total_cmp(&b.x));
    let is_ground = |ground: &Ground| {
        let even = feet.iter().filter(|foot| ground.above(**foot).abs() < LEVEL * height).count();
        5 * even >= 4 * feet.len() && feet.iter().all(|foot| -ground.above(*foot) < height)
    };
    let end = (feet.len() / 3).max(1);
    let middle = |part: &[Vec2]| part.iter().sum::<Vec2>() / part.len() as f32;
    let run = middle(&feet[feet.len() - end..]) - middle(&feet[..end]);
    let is_long = feet[feet.len() - 1].x - feet[0].x > LONG_ROW * height && run.y.abs() < STEEP * run.x;
    let slopes = [Some(0.0), is_long.then(|| run.y / run.x)];
    let ground =
        slopes.into_iter().flatten().map(|slope| Ground::with_slope(&feet, slope)).find(is_ground)?;
    Some((ground, height))
}

/// One blade for each spike, all on one ground of this slope, and each no wider than that.
fn grass(uses: Vec<usize>, score: f32, spikes: &[(Spike, f32)], slope: f32) -> Hypothesis {
    let feet = spikes.iter().flat_map(|spike| &spike.0.flanks).map(|flank| flank[flank.len() - 1]);
    let ground = feet.map(|foot| foot.y - slope * foot.x).fold(f32::NEG_INFINITY, f32::max);
    let blade = |(spike, most): &(Spike, f32)| {
        let (low, along) = spike.lower_end();
        let down = (ground + slope * low.x - low.y).max(0.0);
        let aside = (along.x / along.y.max(f32::MIN_POSITIVE)).clamp(-0.5, 0.5) * down;
        Made::new(Tool::Leaf, spike.blade(low + Vec2::new(aside, down), *most))
    };
    let parts = spikes.iter().map(blade).collect();
    Hypothesis { uses, score, parts, solids: Vec::new(), reading: Reading::Grass, habit: Some(Habit::Grass) }
}

#[cfg(test)]
#[path = "grass_tests.rs"]
mod tests;
