//! The fleshy body of a cactus: a column, with arms or without, drawn by its outline in one stroke or several.
//!
//! What lines enclose ([`body_area`](super::body_area)) has middle lines, which become branches as thick as drawn: those of a column and its
//! [`limbs`](super::limbs). Short strokes on the body and straight ones across its outline are its [`spines`](super::spines) and
//! belong to it, and so do lines inside, its ribs. How likely it is a body is summed up: how much its limbs are arms, how much
//! of the outline is drawn, how few notches it has besides those at its arms, how many spines it has.
//!
//! A body with arms from which twigs go is no cactus but a bare tree whose boughs were drawn by their outlines.
//!
//! Limits: bodies of flat joints one on another are not understood.

use super::body_area::{Body, size_of, with_lines};
use super::spines::{self, Spines};
use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::shapes::teeth::is_row_of_teeth;
use crate::anatomy::conventions::trees::evidence;
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Smallest body, as a share of the drawing's diagonal.
const SMALLEST: f32 = 0.2;
/// Least area of the hulls of all lines as a share of the whole's bounds.
const ENCLOSED: f32 = 0.12;
/// Most lines that draw an outline, with what is inside.
const MOST: usize = 9;
/// Largest flower, as a share of the whole.
const FLOWER: f32 = 0.15;
/// Least length of a line that goes round a tip, in distances of its ends; half a circle has 1.57.
const TIP: f32 = 1.2;
/// Fewest blades of a rosette, largest opening of one, and greatest area over the square of its length: a circle has 0.08.
const ROSETTE: (usize, f32, f32) = (3, 0.25, 0.05);
/// Least log-odds of what may be a body: many things have some of its parts.
const LEAST: f32 = 2.0;
/// Least length of a twig, in half widths of the column, how many twigs on a body with arms make it a tree with thick boughs, and least share
/// of all strokes on it that they are.
const TWIGS: (f32, usize, f32) = (2.4, 2, 0.6);
/// Of an outline with ribs: least height, as a share of the whole's, least distance of its ends, as a share of its width, and the part of its
/// height, from below, where ribs begin; least rise of a rib, as a share of the outline's height and of its own length; and least distance
/// of two at their feet, as a share of the outline's width.
const RIBS: (f32, f32, f32, f32, f32) = (0.7, 0.6, 0.1, 0.5, 0.12);
/// More for each line of an outline but the first, up to so many: what a few leaves would be is seldom a body by chance.
const EACH: (f32, usize) = (0.25, 6);

/// Proposes bodies, one for each group of lines at most.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    out.extend(page.groups.iter().chain(&page.wide_groups).filter_map(|group| body(page, group)));
}

fn body(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let lines: Vec<&Line> = group.iter().map(|i| &page.lines[*i]).collect();
    let size = size_of(&lines);
    if size.length() < SMALLEST * page.diagonal || !may_enclose(&lines, size) {
        return None;
    }
    // Flowers on it stay by themselves.
    let is_flower =
        |line: &Line| line.is_closed_and_solid() && line.size().max_element() < FLOWER * size.max_element();
    let (flowers, group): (Vec<usize>, Vec<usize>) = group.iter().partition(|i| is_flower(&page.lines[**i]));
    let ribs = ribs(page, &group, size);
    let group: Vec<usize> = group.into_iter().filter(|i| !ribs.contains(i)).collect();
    let lines: Vec<&Line> = group.iter().map(|i| &page.lines[*i]).collect();
    let is_grass = lines.iter().any(|line| is_row_of_teeth(line));
    if is_grass || evidence::has_blades(&lines, size) || is_rosette(&lines) {
        return None;
    }
    let found = spines::ways_apart(&lines, size).into_iter().filter_map(|spines| {
        let (body, score) = with_spines(&spines, size)?;
        let twigs = twigs(&spines, &body);
        Some((body, score, twigs))
    });
    let best = found.reduce(|best, other| if other.1 > best.1 { other } else { best });
    let (body, score, twigs) = best.filter(|(_, score, _)| *score > LEAST)?;
    if evidence::has_flower_centre(&lines, &body.outline) {
        return None;
    }
    let mut uses = page.with_what_is_inside(&group, &body.outline);
    uses.retain(|line| !flowers.contains(line));
    uses.extend(ribs);
    uses.sort_unstable();
    uses.dedup();
    let is_tree = body.limbs.arms() > 0 && twigs.len() >= TWIGS.1;
    let (reading, habit) = match is_tree {
        true => (Reading::BareTree, Habit::Tree),
        false => (Reading::Cactus, Habit::Succulent),
    };
    let twigs = twigs.into_iter().filter(|_| is_tree).map(|points| Made::new(Tool::Branch, points));
    let parts = body.limbs.branches().into_iter().chain(twigs).collect();
    Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading, habit: Some(habit) })
}

/// Ribs: several long upright lines side by side in an outline that is open below, as a blade's veins are not.
fn ribs(page: &Page, group: &[usize], size: Vec2) -> Vec<usize> {
    let line = |i: &usize| &page.lines[*i];
    let outline = group.iter().map(line).find(|outline| {
        let (first, last) = outline.ends();
        outline.size().y > RIBS.0 * size.y && (first.x - last.x).abs() > RIBS.1 * outline.size().x
    });
    let Some(outline) = outline else { return Vec::new() };
    let ((low, high), over) = (outline.bounds, Vec2::splat(0.5 * RIBS.2 * outline.size().y));
    let lowest = high.y - RIBS.2 * outline.size().y;
    let is_rib = |i: &&usize| {
        let (first, last) = line(i).ends();
        let is_within =
            (low - over).cmple(line(i).bounds.0).all() && line(i).bounds.1.cmple(high + over).all();
        is_within
            && line(i).openness > 0.8
            && (first.y - last.y).abs() > RIBS.3 * line(i).length.max(outline.size().y)
            && first.y.max(last.y) > lowest
    };
    let ribs: Vec<usize> = group.iter().filter(is_rib).copied().collect();
    let mut feet: Vec<f32> = ribs.iter().map(|i| line(i).upward()[0].x).collect();
    feet.sort_by(f32::total_cmp);
    let are_apart = feet.windows(2).all(|pair| pair[1] - pair[0] > RIBS.4 * outline.size().x);
    if ribs.len() > 1 && are_apart { ribs } else { Vec::new() }
}

/// The lines that leave a body as twigs do, each from the body outward.
fn twigs(spines: &Spines, body: &Body) -> Vec<Vec<Vec2>> {
    let off = |p: Vec2| polyline::nearest(&body.outline, p).map_or(f32::INFINITY, |(gap, _)| gap);
    let outward = |line: &Line| line.beginning_at(off);
    let twigs = spines.twigs(&body.outline, TWIGS.0 * body.limbs.half());
    let are_most = twigs.len() as f32 > TWIGS.2 * spines.count() as f32;
    twigs.into_iter().filter(|_| are_most).map(outward).collect()
}

/// The body that the outlines enclose, and how likely it is with these spines.
fn with_spines(spines: &Spines, size: Vec2) -> Option<(Body, f32)> {
    let outlines = &spines.outlines;
    let is_scribble = |line: &&Line| line.is_scribble() && line.hull_area > ENCLOSED * size.x * size.y;
    if outlines.is_empty() || outlines.len() > MOST || outlines.iter().any(is_scribble) {
        return None;
    }
    // Straight lines that are near one another have no tip: they are stems.
    let turns_back = |line: &&Line| line.length > TIP * line.ends().0.distance(line.ends().1);
    if !outlines.iter().any(turns_back) {
        return None;
    }
    let body = with_lines(outlines, spines)?;
    let lines = EACH.0 * (outlines.len() - 1).min(EACH.1) as f32;
    let score = body.score + lines + spines.log_odds(&body.outline)?;
    Some((body, score))
}

/// Whether most of these lines are outlines of slender blades, each closed by itself.
fn is_rosette(lines: &[&Line]) -> bool {
    let is_blade = |line: &&&Line| {
        line.openness < ROSETTE.1
            && line.solidity() > 0.5
            && line.area < ROSETTE.2 * line.length * line.length
    };
    let blades = lines.iter().filter(is_blade).count();
    blades >= ROSETTE.0 && 2 * blades > lines.len()
}

/// Whether lines may enclose a body together.
fn may_enclose(lines: &[&Line], size: Vec2) -> bool {
    lines.iter().map(|line| line.hull_area).sum::<f32>() > ENCLOSED * size.x * size.y
}

#[cfg(test)]
#[path = "body_tests.rs"]
mod tests;
