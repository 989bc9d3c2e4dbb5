//! A flower without a drawn centre: a lobed outline at the upper end of a single stem line.
//!
//! The outline is one stroke, open or closed, with at least three lobes: around its middle, as in a flower seen from the
//! front, or, if it has none there, from where the stem meets it, as in a tulip seen from the side ([`cup`] where they stand close). What carries it is one line
//! that begins at the outline or within and ends below.
//! Two lines that stand close together are the sides of a slender stem; a trunk is broader and shorter. An outline without a stem
//! is a flower if it is cut deep all around and its lobes are alike.
//! Lines within say that it is something else, a leaf with its veins or a crown with twigs; a dot may stand there.
//!
//! A crown on a trunk that is a single line has shallow lobes, and a trunk shorter than itself.
//!
//! Limits: a crown with deep lobes on a long line is read as a flower, too: nothing tells them apart.

use super::cup;
use crate::anatomy::conventions::page::{Line, Page, even};
use crate::anatomy::conventions::shapes::lobes::{self, Focus};
use crate::anatomy::conventions::shapes::stem_tail;
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::{polyline, simple_loop};
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::borrow::Cow;
use std::f32::consts::TAU;

/// Fewest lobes.
const FEWEST: usize = 3;
/// Least chord of a stem over its length, and least rise over its run.
const STRAIGHT: f32 = 0.85;
const UPRIGHT: f32 = 1.5;
/// How far from an outline's bounds a stem may end, as a share of their diagonal, and the least part of a stem below: of its
/// length, and of the outline's height, for trunks are shorter than their crowns.
const TOUCH: f32 = 0.1;
const BELOW: (f32, f32) = (0.3, 0.45);
/// Least size of an outline, as a share of its stem's length.
const HEAD: f32 = 0.12;
/// Longest line in a scribble-free outline, over the root of its hull's area: a circle has 3.5.
const WIGGLY: f32 = 9.0;
/// Least share of the bounds that the outline's hull fills, and of the hull that the outline fills.
const FULL: (f32, f32) = (0.5, 0.4);
/// Longest line that may stand within, as a share of the outline's diagonal.
const DOT: f32 = 0.3;
/// Of the rim of a bowl: how near to the outline its ends are, as a share of its diagonal; how far apart, as a share of its width; how far it
/// sags at least, as a share of its height; and its greatest length over what it spans and its height.
const RIM: (f32, f32, f32, f32) = (0.06, 0.3, 0.1, 1.6);
/// Distance from an outline within which loops begin and end that are petals around it, as a share of its diagonal.
const FEET: f32 = 0.4;
/// Distance within which a line in an outline begins at the stem, as a share of the outline's diagonal.
const TWIG: f32 = 0.03;
/// Farthest notches from the middle on the average, as a share of their petals' reach: those of a crown are shallow.
const DEEP: f32 = 0.85;
/// What notches in the middle itself speak for a flower, over those as far from it as they may be.
const CUT: f32 = 2.6;
/// Most that petals of a line lie over one another, as the angle that they fill each by itself over that of all.
const OVERLAP: f32 = 1.35;
/// Smallest petal, as a share of the largest one's area.
const SMALLEST: f32 = 0.04;
/// Least angle that petals fill around the middle of a corolla.
const AROUND: f32 = 0.75 * TAU;
/// Widest stem of two sides, as a share of the head, and least length over its width; points of each side.
const SIDES: (f32, f32) = (0.4, 5.0);
const SIDE_POINTS: usize = 24;
/// Of a flower without a stem: fewest petals, farthest notches, largest opening, least size of a petal over the mean one's, and
/// widest gap over the mean one.
const STAR: (usize, f32, f32, f32, f32) = (4, 0.7, 0.15, 0.7, 1.4);
/// Most lines that are looked at near an outline.
const MOST_LINES: usize = 64;

/// Proposes a corolla for each outline that stands on a stem of its own.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let heads: Vec<Head> = (0..page.lines.len()).filter_map(|i| Head::new(page, i)).collect();
    let grown = |head: &Head| {
        let margin = Vec2::splat(TOUCH * head.line.size().length());
        (head.line.bounds.0 - margin, head.line.bounds.1 + margin)
    };
    let boxes: Vec<(Vec2, Vec2)> = heads.iter().map(grown).collect();
    let near = page.lines_at(&boxes);
    out.extend(heads.iter().zip(near).filter_map(|(head, near)| corolla(page, head, &near)));
}

/// What may be a corolla.
pub(crate) struct Head<'a> {
    /// The line of the page that it is, or is a part of.
    pub number: usize,
    /// Its outline.
    pub line: Cow<'a, Line>,
    /// The stem in one stroke with it.
    pub stem: Option<Line>,
}

impl<'a> Head<'a> {
    /// The head that a line is, if it encloses something and is no scribble.
    pub(crate) fn new(page: &'a Page, number: usize) -> Option<Self> {
        let line = &page.lines[number];
        if let Some((stem, rest)) = stem_tail::cut(line).filter(|(_, rest)| is_head(rest)) {
            return Some(Self { number, line: Cow::Owned(rest), stem: line.part(stem) });
        }
        is_head(line).then_some(Self { number, line: Cow::Borrowed(line), stem: None })
    }
}

/// Whether a line encloses something and is no scribble.
fn is_head(line: &Line) -> bool {
    let size = line.size();
    line.hull_area > FULL.0 * size.x * size.y
        && line.solidity() > FULL.1
        && line.length < WIGGLY * line.hull_area.sqrt()
        && size.min_element() > 0.3 * size.max_element()
}

fn corolla(page: &Page, head: &Head, near: &[usize]) -> Option<Hypothesis> {
    let line = &*head.line;
    if near.len() > MOST_LINES {
        return None;
    }
    let others: Vec<usize> = near.iter().copied().filter(|i| *i != head.number).collect();
    let of_others = others.iter().map(|i| &page.lines[*i]);
    let carries = |stem: &&Line| stem_top(stem, line).is_some();
    let stems: Vec<&Line> = head.stem.iter().chain(of_others).filter(carries).collect();
    let sides = match &stems[..] {
        [] | [_] => None,
        [a, b] => Some(two_sides(a, b, line)?),
        _ => return None,
    };
    let within = within(page, line, &stems, &others)?;
    let (depth, petals) = outlines(line, stems.first().and_then(|stem| stem_top(stem, line)))?;
    // Crowns stand on two lines as a rule, or lie over themselves, whatever their lobes.
    let is_cut = sides.is_none() && overlap(&petals, line.middle()) < OVERLAP;
    let cut = if is_cut { CUT * (DEEP - depth).max(0.0) } else { 0.0 };
    let score = 3.2 + 0.1 * petals.len().min(8) as f32 + cut;
    let petals = petals.into_iter().map(|outline| Made::new(Tool::Petal, outline));
    let own_stem = head.stem.iter().map(|stem| Made::new(Tool::Branch, stem.points.iter().copied()));
    let is_side =
        |i: &usize| sides.is_some() && stems.iter().any(|stem| std::ptr::eq(*stem, &page.lines[*i]));
    let side_lines = others.iter().copied().filter(is_side);
    let mut uses: Vec<usize> = within.into_iter().chain(side_lines).chain([head.number]).collect();
    uses.sort_unstable();
    let parts = petals.chain(own_stem).chain(sides.clone()).collect();
    let (reading, habit) = (Reading::Corolla, Some(Habit::Flower));
    Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading, habit })
}

/// The petals of an outline, on the upper end of its stem if it has one, and how far from their middle the notches between them are.
fn outlines(line: &Line, top: Option<Vec2>) -> Option<(f32, Vec<Vec<Vec2>>)> {
    let front = seen_from_the_front(line);
    let (focus, petals) = match top {
        None => front.filter(|(focus, petals)| is_a_star(line, focus, petals))?,
        Some(top) if front.is_none() => {
            let side = seen_from_the_side(line, top)?;
            if let Some(cup) = cup::petals_of_one(line, top) {
                return Some((DEEP, cup));
            }
            side
        }
        Some(_) => front?,
    };
    let root =
        |stretch: &[Vec2]| focus.place + 0.02 * line.size().length() * lobes::direction(stretch, focus.place);
    let rooted = petals.iter().map(|stretch| lobes::rooted(stretch, root(stretch))).collect();
    Some((if top.is_some() { depth(&petals, &focus) } else { DEEP }, rooted))
}

/// Whether petals stand all around the middle of an outline.
pub(crate) fn is_seen_from_the_front(line: &Line) -> bool {
    is_head(line) && seen_from_the_front(line).is_some()
}

/// The petals of an outline on a stem whose upper end is here, where it shows any.
pub(crate) fn petals_on_stem(line: &Line, top: Vec2) -> Option<Vec<Vec<Vec2>>> {
    is_head(line).then(|| outlines(line, Some(top)))?.map(|(_, petals)| petals)
}

/// Angle that petals fill each by itself over that which they fill together.
fn overlap(petals: &[Vec<Vec2>], place: Vec2) -> f32 {
    let single: f32 = petals.iter().map(|petal| lobes::around(std::slice::from_ref(petal), place)).sum();
    single / lobes::around(petals, place).max(f32::MIN_POSITIVE)
}

/// How far from the focus the notches between petals are on the average, as a share of the petals' reach.
fn depth(petals: &[Vec<Vec2>], focus: &Focus) -> f32 {
    petals.iter().map(|petal| lobes::depth(petal, focus)).sum::<f32>() / petals.len().max(1) as f32
}

/// The lines within an outline on a stem; nothing where one of all that are near speaks against a flower.
fn within(page: &Page, head: &Line, stems: &[&Line], others: &[usize]) -> Option<Vec<usize>> {
    let diagonal = head.size().length();
    let is_stem = |i: &usize| stems.iter().any(|stem| std::ptr::eq(&page.lines[*i], *stem));
    let others = || others.iter().copied().filter(|i| !is_stem(i));
    // The other side of a trunk may be one stroke with a frond.
    let foot = stems.iter().map(|stem| stem.bounds.1.y).fold(head.bounds.1.y, f32::max);
    let half = 0.5 * (foot + head.bounds.1.y);
    if others().any(|i| page.lines[i].bounds.1.y > half) {
        return None;
    }
    let (low, high) = head.bounds;
    // Loops that begin and end at an outline are petals around it.
    let margin = Vec2::splat(FEET * diagonal);
    let is_at = |p: Vec2| p.cmpgt(low - margin).all() && p.cmplt(high + margin).all();
    let is_petal = |i: &usize| {
        let (first, last) = page.lines[*i].ends();
        page.lines[*i].size().length() > diagonal && is_at(first) && is_at(last)
    };
    if others().filter(is_petal).count() > 1 {
        return None;
    }
    let is_within = |middle: Vec2| middle.cmpgt(low).all() && middle.cmplt(high).all();
    let within: Vec<usize> = others().filter(|i| is_within(page.lines[*i].middle())).collect();
    let is_twig = |i: &usize| {
        let line = &page.lines[*i];
        let gap =
            |stem: &Line, p: Vec2| polyline::nearest(&stem.points, p).map_or(f32::INFINITY, |(gap, _)| gap);
        let is_at = |stem: &&Line| line.points.iter().any(|p| gap(stem, *p) < TWIG * diagonal);
        line.length > DOT * diagonal && !is_rim(line, head) || stems.iter().any(is_at)
    };
    (!within.iter().any(is_twig)).then_some(within)
}

/// Whether a line sags between two places of the upper half of a head's outline: the rim of a bowl in front.
fn is_rim(line: &Line, head: &Line) -> bool {
    let (first, last) = line.ends();
    let diagonal = head.size().length();
    let is_at = |end: Vec2| {
        let gap = polyline::nearest(&head.points, end).map_or(f32::INFINITY, |(gap, _)| gap);
        end.y < head.middle().y && gap < RIM.0 * diagonal
    };
    let over = Vec2::splat(RIM.0 * diagonal);
    let is_within =
        line.bounds.0.cmpge(head.bounds.0 - over).all() && line.bounds.1.cmple(head.bounds.1).all();
    is_within
        && is_at(first)
        && is_at(last)
        && (first.x - last.x).abs() > RIM.1 * head.size().x
        && line.bounds.1.y > first.y.max(last.y) + RIM.2 * head.size().y
        && line.length < RIM.3 * (first.distance(last) + line.size().y)
}

/// A stem with two sides, its drawn width along it: narrow beside the head that it carries and long beside its width.
fn two_sides(a: &Line, b: &Line, head: &Line) -> Option<Made> {
    let [a, b] = [a, b].map(|line| even(&line.upward(), SIDE_POINTS));
    let widths: Vec<f32> = a.iter().zip(&b).map(|(a, b)| a.distance(*b)).collect();
    let widest = widths.iter().copied().fold(f32::MIN_POSITIVE, f32::max);
    let length = polyline::length(&a).min(polyline::length(&b));
    if widest > SIDES.0 * head.size().min_element() || length < SIDES.1 * widest {
        return None;
    }
    let middles = a.iter().zip(&b).map(|(a, b)| a.midpoint(*b));
    Some(Made::thick(middles.zip(widths.iter().map(|width| 0.5 * width))))
}

/// Whether an outline without a stem is a flower and no crown, cactus or leaf: closed, deeply cut all around, its lobes alike.
fn is_a_star(line: &Line, focus: &Focus, petals: &[Vec<Vec2>]) -> bool {
    let mean = |of: &dyn Fn(&Vec<Vec2>) -> f32| petals.iter().map(of).sum::<f32>() / petals.len() as f32;
    let is_even = |of: &dyn Fn(&Vec<Vec2>) -> f32| {
        let mean = mean(of);
        petals.iter().all(|petal| (STAR.3 * mean..mean / STAR.3).contains(&of(petal)))
    };
    let widest = STAR.4 * TAU / petals.len() as f32;
    line.openness < STAR.2
        && petals.len() >= STAR.0
        && mean(&|petal| lobes::depth(petal, focus)) < STAR.1
        && is_even(&|petal| simple_loop::area(&lobes::rooted(petal, focus.place)).sqrt())
        && lobes::widest_gap(petals, focus.place) < widest
}

/// The upper end of a line that carries an outline.
pub(crate) fn stem_top(stem: &Line, head: &Line) -> Option<Vec2> {
    let (first, last) = stem.ends();
    let (top, foot) = if first.y < last.y { (first, last) } else { (last, first) };
    let run = foot - top;
    let margin = TOUCH * head.size().length();
    let (low, high) = (head.bounds.0 - margin, head.bounds.1 + margin);
    let is_stem = run.length() > STRAIGHT * stem.length && run.y > UPRIGHT * run.x.abs();
    let carries = top.cmpgt(low).all()
        && top.cmplt(high).all()
        && foot.y - head.bounds.1.y > (BELOW.0 * run.y).max(BELOW.1 * head.size().y);
    (is_stem && carries && head.size().max_element() > HEAD * stem.length).then_some(top)
}

/// Petals around the middle of an outline.
fn seen_from_the_front(line: &Line) -> Option<(Focus, Vec<Vec<Vec2>>)> {
    let focus = Focus { place: line.middle(), half: 0.5 * line.size() };
    let petals = petals(line, &focus);
    let is_around = lobes::around(&petals, focus.place) > AROUND;
    let depth = depth(&petals, &focus);
    (petals.len() >= FEWEST && is_around && depth < DEEP).then_some((focus, petals))
}

/// Petals from the top of a stem up.
fn seen_from_the_side(line: &Line, top: Vec2) -> Option<(Focus, Vec<Vec<Vec2>>)> {
    let nearest = line.points.iter().copied().min_by(|a, b| a.distance(top).total_cmp(&b.distance(top)))?;
    let focus = Focus::round(nearest, line.size().length());
    let petals = petals(line, &focus);
    let is_above = line.middle().y < nearest.y - 0.25 * line.size().y;
    (petals.len() >= FEWEST && is_above).then_some((focus, petals))
}

fn petals(line: &Line, focus: &Focus) -> Vec<Vec<Vec2>> {
    let mut petals = lobes::cut(&line.points, focus, line.openness < 0.3);
    let area = |stretch: &[Vec2]| simple_loop::area(&lobes::rooted(stretch, focus.place));
    let largest = petals.iter().map(|stretch| area(stretch)).fold(0.0, f32::max);
    petals.retain(|stretch| area(stretch) > SMALLEST * largest);
    petals
}

#[cfg(test)]
#[path = "corolla_on_stem_tests.rs"]
mod tests;
