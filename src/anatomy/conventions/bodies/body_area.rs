//! The area of a fleshy body that lines enclose, and what speaks for its being one.
//!
//! People leave outlines unfinished: gaps are closed as little as needed, arms may be single lines, and one stroke that lacks a side
//! from its foot to some tip is closed at the distance that its other sides have from one another
//! ([`half_outline`](super::half_outline)). A column without arms or spines must be open below, or it is a blade.

use super::half_outline;
use super::limbs::Limbs;
use super::spines::Spines;
use crate::anatomy::conventions::page::{self, Line, even, notches, tips};
use crate::anatomy::conventions::shapes::medial_axis::medial_axes;
use crate::anatomy::conventions::shapes::silhouette::{Silhouette, share_along, smooth_contour};
use crate::geom::{
    polyline,
    simple_loop::{self, hull_area},
};
use glam::Vec2;
use std::f32::consts::PI;

/// How wide gaps of the outline are closed, in cells of the silhouette, one after the other.
const BRIDGES: (i32, i32) = (6, 14);
/// Least area that is enclosed, as a share of the whole's bounds.
const ENCLOSED: f32 = 0.12;
/// Least distance of the ends of a line that may be the middle of an arm, as a share of its diagonal, and most such lines.
const SLENDER: f32 = 0.6;
const MOST_LINES: usize = 4;
/// Least distance of the ends of the outline from which such arms come, as a share of its diagonal.
const OPEN_ARCH: f32 = 0.08;
/// Least area of a column and of a body with arms, in areas of the largest circle in it.
const LONG: (f32, f32) = (1.8, 2.1);
/// The same of a column with many spines.
const SQUAT: f32 = 1.2;
/// Least of its convex hull that a column fills, and most that a body with arms does.
const SOLID: (f32, f32) = (0.8, 0.88);
/// Share of the area that circles about the middle lines, as large as they fit, cover of a column and of a body with arms, and
/// log-odds for each share less.
const COVERED: (f32, f32, f32) = (0.945, 0.965, -30.0);
/// Share of the outline that is drawn, of a column and of a body with arms, and log-odds for each share less.
const DRAWN: (f32, f32, f32) = (0.86, 0.93, -15.0);
/// Share of what is drawn, without spines, that is the outline, and log-odds for each share less.
const ON_OUTLINE: (f32, f32) = (0.77, -25.0);
/// How near lines and outline are, in cells of the silhouette.
const NEAR: (f32, f32) = (3.0, 4.0);
/// Notches that a body has without arms and for each, and log-odds for each one more.
const NOTCHES: (usize, usize, f32) = (2, 2, -0.5);
/// Distance of the ends of a column's outline, least and most, as shares of its width.
const OPEN: (f32, f32) = (0.6, 2.2);
/// Least share of what is drawn that lies in the body.
const INSIDE: f32 = 0.95;
/// Stretch and turn of a sharp tip, how many are too many, the part of the height, from below, where they do not count, and log-odds of
/// arms with so many.
const POINTED: ((f32, f32), usize, f32, f32) = ((0.05, 1.5), 3, 0.25, -2.0);
/// How much less area than [`LONG`] a body with arms may have, and log-odds where it has so little.
const SHORT: (f32, f32) = (0.3, -2.0);
/// Stretch and turn of a tip at the top, and how near to the top it is, as a share of the height.
const SHARP: ((f32, f32), f32) = ((0.06, 1.1), 0.06);
/// Lowest part of an outline, as a share of its height.
const LOWEST: f32 = 0.06;
/// Points of the outline.
const POINTS: usize = 160;
/// Points of it where lines near to it are looked for.
const FINE: usize = 600;
/// Log-odds of a column, and more for arms of which the outline was not finished.
const SCORE: (f32, f32) = (2.9, -1.1);

/// A body and how likely it is.
pub(super) struct Body {
    pub limbs: Limbs,
    pub outline: Vec<Vec2>,
    pub score: f32,
}

impl Body {
    /// Log-odds of how much of the outline is drawn, by these lines and what closes them, and how much of the lines is the outline.
    fn of_outline<'a>(
        &self,
        all: impl Iterator<Item = &'a [Vec2]>,
        drawn: impl Iterator<Item = &'a [Vec2]>,
        cell: f32,
    ) -> f32 {
        let least = if self.limbs.arms() == 0 { DRAWN.0 } else { DRAWN.1 };
        let is_drawn = share_along(&self.outline, all, NEAR.0 * cell);
        let drawn: Vec<Vec2> = drawn.flatten().copied().collect();
        let closed: Vec<Vec2> = self.outline.iter().chain(self.outline.first()).copied().collect();
        let outline = even(&closed, FINE);
        let is_outline = share_along(&drawn, [outline.as_slice()].into_iter(), NEAR.1 * cell);
        DRAWN.2 * (least - is_drawn).max(0.0) + ON_OUTLINE.1 * (ON_OUTLINE.0 - is_outline).max(0.0)
    }
}

/// The body that lines enclose; some lines may be arms of which only the middle was drawn.
pub(super) fn with_lines(lines: &[&Line], spines: &Spines) -> Option<Body> {
    let is_slender = |line: &&&Line| line.openness > SLENDER && line.ends().0.y != line.ends().1.y;
    let (arms, outlines): (Vec<&Line>, Vec<&Line>) = lines.iter().partition(is_slender);
    let is_arch = outlines.len() == 1 && outlines[0].openness > OPEN_ARCH;
    if arms.is_empty() || arms.len() > MOST_LINES || !is_arch {
        return enclosed(lines, spines);
    }
    enclosed(lines, spines).or_else(|| {
        let mut body = enclosed(&outlines, spines)?;
        let are_arms = arms.iter().all(|line| body.limbs.add_line(&line.points));
        body.score = body.limbs.log_odds();
        are_arms.then_some(body)
    })
}

/// The body that lines enclose.
fn enclosed(lines: &[&Line], spines: &Spines) -> Option<Body> {
    let (foot, size) = (foot(lines), size_of(lines));
    let base = foot.map(|(left, right)| vec![left, right]);
    let drawn = || lines.iter().map(|line| line.points.as_slice());
    let all = || drawn().chain(base.iter().map(Vec::as_slice));
    let area = |bridge| Silhouette::new(all(), bridge);
    let is_closed = |area: &Silhouette| {
        area.share_inside(drawn().flatten()) >= INSIDE && area.area() > ENCLOSED * size.x * size.y
    };
    let narrow = area(BRIDGES.0);
    // One stroke by itself has no gaps but that at its foot.
    let may_have_gaps = lines.len() > 1;
    let wide = || Some(area(BRIDGES.1)).filter(is_closed);
    let closed = if is_closed(&narrow) { Some(narrow.clone()) } else { may_have_gaps.then(wide).flatten() };
    if let Some(mut body) = closed.and_then(|area| body(&area, foot, spines)) {
        body.score += body.of_outline(all(), drawn(), narrow.cell());
        return Some(body);
    }
    let [line] = lines else { return None };
    let (closed, root) = half_outline::closed(line, &narrow)?;
    let area = Silhouette::new(closed.iter().map(Vec::as_slice), BRIDGES.0);
    let mut body = body(&area, Some((root, root)), spines)?;
    body.score += SCORE.1;
    (body.limbs.arms() > 0).then_some(body)
}

/// The limbs of an area, if they may be those of a body, with its outline and what speaks for it.
fn body(silhouette: &Silhouette, foot: Option<(Vec2, Vec2)>, spines: &Spines) -> Option<Body> {
    let radius = silhouette.inscribed_radius();
    let long = silhouette.area() / (PI * radius * radius);
    let outline = smooth_contour(&silhouette.contour(), POINTS, 1);
    let solid = simple_loop::area(&outline) / hull_area(&outline).max(f32::MIN_POSITIVE);
    let is_open =
        |half: f32| foot.is_some_and(|(a, b)| (OPEN.0..OPEN.1).contains(&(a.distance(b) / (2.0 * half))));
    let least = if spines.are_many() { SQUAT } else { LONG.0 };
    let may_be_column = long > least && solid > SOLID.0;
    let may_have_arms = long > LONG.1 - SHORT.0 && solid < SOLID.1;
    if !may_be_column && !may_have_arms {
        return None;
    }
    let limbs = Limbs::new(medial_axes(silhouette, root(&outline, foot)?), silhouette.cell())?;
    let form = match limbs.arms() {
        0 if pointed(&outline) || !spines.are_many() && has_sharp_top(&outline) => return None,
        0 if may_be_column && (is_open(limbs.half()) || spines.are_many()) => SCORE.0,
        0 => return None,
        _ if may_have_arms => limbs.log_odds(),
        _ => return None,
    };
    let notches = notches(&outline).len().saturating_sub(NOTCHES.0 + NOTCHES.1 * limbs.arms());
    let least = if limbs.arms() == 0 { COVERED.0 } else { COVERED.1 };
    let covered = silhouette.share_within(limbs.circles());
    let mut score = form + NOTCHES.2 * notches as f32 + COVERED.2 * (least - covered).max(0.0);
    if limbs.arms() > 0 {
        score += SHORT.1 * ((LONG.1 - long) / SHORT.0).clamp(0.0, 1.0);
        score += if pointed(&outline) { POINTED.3 } else { 0.0 };
    }
    Some(Body { limbs, outline, score })
}

/// Whether an outline has several sharp tips above its foot, as a lotus has: limbs are round at their ends.
fn pointed(outline: &[Vec2]) -> bool {
    let (low, high) = polyline::bounds(outline.iter().copied());
    let is_high = |tip: &&Vec2| high.y - tip.y > POINTED.2 * (high.y - low.y);
    tips(outline, POINTED.0).iter().filter(is_high).count() >= POINTED.1
}

/// Whether an outline ends in a sharp tip above, as a cypress does and no column.
fn has_sharp_top(outline: &[Vec2]) -> bool {
    let (low, high) = polyline::bounds(outline.iter().copied());
    tips(outline, SHARP.0).iter().any(|tip| tip.y - low.y < SHARP.1 * (high.y - low.y))
}

/// The middle of the lowest part of an outline, or between the ends of the line where it is open about as wide as that.
fn root(outline: &[Vec2], foot: Option<(Vec2, Vec2)>) -> Option<Vec2> {
    let (top, bottom) = polyline::bounds(outline.iter().copied());
    let (top, bottom) = (top.y, bottom.y);
    let low = outline.iter().filter(|p| p.y > bottom - LOWEST * (bottom - top));
    let (left, right) = polyline::bounds(low.copied());
    let (left, right) = (left.x, right.x);
    match foot {
        Some((a, b)) if a == b || a.distance(b) > 0.5 * (right - left) => Some(a.midpoint(b)),
        _ => (left <= right).then(|| Vec2::new(0.5 * (left + right), bottom)),
    }
}

pub(super) fn size_of(lines: &[&Line]) -> Vec2 {
    let (low, high) = page::bounds(lines.iter().copied());
    high - low
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
