//! The fleshy body of a cactus: a column, with arms or without, drawn by its outline in one stroke or several.
//!
//! Its middle lines ([`medial_axis`](super::medial_axis)) become branches as thick as drawn if they are the [`limbs`](super::limbs)
//! of a body. A column without arms must be open below, or it is a blade. Short strokes across the outline or on the body are its spines and belong to it, and so do lines inside, its
//! ribs, and a level line at its foot.
//!
//! People leave outlines unfinished: one that lacks a side from its foot to some tip is closed at the distance that its other sides
//! have from one another ([`half_outline`](super::half_outline)). Limits: bodies of flat joints one on another are not understood.

use super::half_outline;
use super::limbs::Limbs;
use crate::anatomy::conventions::page::{self, Line, Page, notches};
use crate::anatomy::conventions::shapes::medial_axis::medial_axes;
use crate::anatomy::conventions::shapes::silhouette::{Silhouette, smooth_contour};
use crate::anatomy::conventions::trees::evidence;
use crate::anatomy::conventions::{Habit, Hypothesis};
use crate::geom::{convex_hull::convex_hull, simple_loop};
use crate::sketch::Reading;
use glam::Vec2;
use std::f32::consts::PI;

/// Smallest body, as a share of the drawing's diagonal.
const SMALLEST: f32 = 0.2;
/// How wide gaps of the outline are closed, in cells of the silhouette, one after the other.
const BRIDGES: (i32, i32) = (6, 14);
/// Least area of the hulls of all lines, and of what they enclose, as a share of the whole's bounds.
const ENCLOSED: f32 = 0.12;
/// Least distance of the ends of a line that may be the middle of an arm, as a share of its diagonal, and most such lines.
const SLENDER: f32 = 0.6;
const MOST_LINES: usize = 4;
/// Least distance of the ends of the outline from which such arms come, as a share of its diagonal.
const OPEN_ARCH: f32 = 0.08;
/// Most lines that draw an outline, with what is inside.
const MOST: usize = 9;
/// Largest flower, as a share of the whole.
const FLOWER: f32 = 0.15;
/// Least area of a column and of a body with arms, in areas of the largest circle in it.
const LONG: (f32, f32) = (1.8, 2.3);
/// Least of its convex hull that a column fills, and most that a body with arms does.
const SOLID: (f32, f32) = (0.8, 0.87);
/// Least share of the area that circles about the middle lines, as large as they fit, cover.
const COVERED: f32 = 0.935;
/// Distance of the ends of a column's outline, least and most, as shares of its width.
const OPEN: (f32, f32) = (0.6, 2.2);
/// Least share of what is drawn that lies in the body.
const INSIDE: f32 = 0.95;
/// Longest spine, as a share of the whole, and fewest, if they are to be looked at by themselves.
const SPINES: (f32, usize) = (0.16, 2);
/// Lowest part of an outline, as a share of its height.
const LOWEST: f32 = 0.06;
/// Points of the outline.
const POINTS: usize = 160;
/// Log-odds of a column, of a body with arms, where it could be a tree, and of one whose outline was not finished.
const SCORE: (f32, f32, f32) = (2.9, 4.3, 2.6);

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
    let lines: Vec<&Line> = group.iter().map(|i| &page.lines[*i]).collect();
    if evidence::has_blades(&lines, size) {
        return None;
    }
    let outlines = without_spines(&lines);
    if outlines.len() > MOST
        || outlines.iter().any(|line| line.is_scribble() && line.hull_area > ENCLOSED * size.x * size.y)
    {
        return None;
    }
    let (limbs, outline, score) = with_lines(&outlines)?;
    if evidence::has_flower_centre(&lines, &outline) {
        return None;
    }
    let mut uses = page.with_what_is_inside(&group, &outline);
    uses.retain(|line| !flowers.contains(line));
    Some(Hypothesis {
        uses,
        score,
        parts: limbs.branches(),
        solids: Vec::new(),
        reading: Reading::Cactus,
        habit: Some(Habit::Succulent),
    })
}

/// Whether lines may enclose a body together.
fn may_enclose(lines: &[&Line], size: Vec2) -> bool {
    lines.iter().map(|line| line.hull_area).sum::<f32>() > ENCLOSED * size.x * size.y
}

/// The body that lines enclose; some lines may be arms of which only the middle was drawn.
fn with_lines(lines: &[&Line]) -> Option<(Limbs, Vec<Vec2>, f32)> {
    let is_slender = |line: &&&Line| line.openness > SLENDER && line.ends().0.y != line.ends().1.y;
    let (arms, outlines): (Vec<&Line>, Vec<&Line>) = lines.iter().partition(is_slender);
    let is_arch = outlines.len() == 1 && outlines[0].openness > OPEN_ARCH;
    if arms.is_empty() || arms.len() > MOST_LINES || !is_arch {
        return enclosed(lines);
    }
    enclosed(lines).or_else(|| {
        let (mut limbs, outline, _) = enclosed(&outlines)?;
        arms.iter().all(|line| limbs.add_line(&line.points)).then_some((limbs, outline, SCORE.1))
    })
}

/// The body that lines enclose, its outline and how likely it is.
fn enclosed(lines: &[&Line]) -> Option<(Limbs, Vec<Vec2>, f32)> {
    let (foot, size) = (foot(lines), size_of(lines));
    let base = foot.map(|(left, right)| vec![left, right]);
    let drawn = || lines.iter().map(|line| line.points.as_slice());
    let area = |bridge| Silhouette::new(drawn().chain(base.iter().map(Vec::as_slice)), bridge);
    let is_closed = |area: &Silhouette| {
        area.share_inside(drawn().flatten()) >= INSIDE && area.area() > ENCLOSED * size.x * size.y
    };
    let narrow = area(BRIDGES.0);
    // One stroke by itself has no gaps but that at its foot.
    let may_have_gaps = lines.len() > 1;
    let wide = || Some(area(BRIDGES.1)).filter(is_closed);
    let closed = if is_closed(&narrow) { Some(narrow.clone()) } else { may_have_gaps.then(wide).flatten() };
    if let Some((limbs, outline)) = closed.and_then(|area| limbs(&area, foot)) {
        let open = foot.map_or(0.0, |(left, right)| left.distance(right) / (2.0 * limbs.half()));
        let is_open = (OPEN.0..OPEN.1).contains(&open);
        return match limbs.arms() {
            0 => is_open.then_some((limbs, outline, SCORE.0)),
            _ => Some((limbs, outline, SCORE.1)),
        };
    }
    let [line] = lines else { return None };
    let (closed, root) = half_outline::closed(line, &narrow)?;
    let area = Silhouette::new(closed.iter().map(Vec::as_slice), BRIDGES.0);
    let (limbs, outline) = limbs(&area, Some((root, root)))?;
    (limbs.arms() > 0).then_some((limbs, outline, SCORE.2))
}

/// The limbs of an area, if they are those of a body, and its outline.
fn limbs(silhouette: &Silhouette, foot: Option<(Vec2, Vec2)>) -> Option<(Limbs, Vec<Vec2>)> {
    let radius = silhouette.inscribed_radius();
    let long = silhouette.area() / (PI * radius * radius);
    let outline = smooth_contour(&silhouette.contour(), POINTS, 1);
    let solid = simple_loop::area(&outline)
        / simple_loop::area(&convex_hull(&outline, |p| *p)).max(f32::MIN_POSITIVE);
    let notches = notches(&outline).len();
    let may_be_column =
        long > LONG.0 && solid > SOLID.0 && foot.is_some_and(|(a, b)| a.distance(b) > OPEN.0 * radius);
    let may_have_arms = long > LONG.1 && solid < SOLID.1 && notches > 0;
    if !may_be_column && !may_have_arms {
        return None;
    }
    let limbs = Limbs::new(medial_axes(silhouette, root(&outline, foot)?), silhouette.cell())?;
    let is_of_form = if limbs.arms() == 0 { may_be_column } else { may_have_arms };
    let is_smooth = notches <= 2 * (limbs.arms() + 1);
    let is_body = is_of_form && is_smooth && silhouette.share_within(limbs.circles()) >= COVERED;
    is_body.then_some((limbs, outline))
}

/// The middle of the lowest part of an outline, or between the ends of the line where it is open about as wide as that.
fn root(outline: &[Vec2], foot: Option<(Vec2, Vec2)>) -> Option<Vec2> {
    let (top, bottom) =
        outline.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |all, p| (all.0.min(p.y), all.1.max(p.y)));
    let low = outline.iter().filter(|p| p.y > bottom - LOWEST * (bottom - top));
    let (left, right) =
        low.fold((f32::INFINITY, f32::NEG_INFINITY), |all, p| (all.0.min(p.x), all.1.max(p.x)));
    match foot {
        Some((a, b)) if a == b || a.distance(b) > 0.5 * (right - left) => Some(a.midpoint(b)),
        _ => (left <= right).then(|| Vec2::new(0.5 * (left + right), bottom)),
    }
}

fn size_of(lines: &[&Line]) -> Vec2 {
    let (low, high) = page::bounds(lines.iter().copied());
    high - low
}

/// The lines that draw the outline: without short ones, if there are several, and without a level one at the foot.
fn without_spines<'a>(lines: &[&'a Line]) -> Vec<&'a Line> {
    let size = size_of(lines);
    let is_short = |line: &&Line| line.length < SPINES.0 * size.length();
    let lowest = page::bounds(lines.iter().copied()).1.y;
    let is_ground = |line: &Line| {
        let is_level =
            line.size().y < 0.1 * line.size().x && line.ends().0.distance(line.ends().1) > 0.9 * line.length;
        is_level && lowest - line.middle().y < 0.1 * size.y
    };
    let has_spines = lines.iter().filter(|line| is_short(line)).count() >= SPINES.1;
    lines.iter().copied().filter(|line| !(has_spines && is_short(line) || is_ground(line))).collect()
}

/// The two ends of the outline where it is open toward the ground.
fn foot(lines: &[&Line]) -> Option<(Vec2, Vec2)> {
    let (low, high) = page::bounds(lines.iter().copied());
    let is_low = |p: &Vec2| p.y > high.y - 0.25 * (high.y - low.y);
    let ends: Vec<Vec2> =
        lines.iter().flat_map(|line| [line.ends().0, line.ends().1]).filter(is_low).collect();
    let left = ends.iter().copied().min_by(|a, b| a.x.total_cmp(&b.x))?;
    let right = ends.iter().copied().max_by(|a, b| a.x.total_cmp(&b.x))?;
    (left != right).then_some((left, right))
}

#[cfg(test)]
#[path = "body_tests.rs"]
mod tests;
