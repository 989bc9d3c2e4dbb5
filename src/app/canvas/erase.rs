//! The erasers: one removes whole strokes, one only the part it touches.
//!
//! The eraser is a disc that sweeps from sample to sample, so that a fast hand leaves no gaps. The part of a segment under
//! the sweep is an interval, as the sweep is convex; strokes are cut exactly at its ends. Of the pieces the longest keeps
//! the stroke's name, so that what grows from it by its name stays; others get new names. Pieces shorter than half the
//! eraser's radius are crumbs and go. A closed outline that is cut is opened: its end runs on into its beginning.
//!
//! One drag is one change: what was erased shows at once, and is handed over when the eraser is lifted.

use super::stroke_index::{StrokeIndex, segments};
use crate::geom::polyline;
use crate::sketch::change::StrokeChange;
use crate::sketch::{Stroke, StrokeId, StrokePoint};
use glam::DVec2;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Shortest piece that stays, in radii of the eraser.
const CRUMB_RADII: f64 = 0.5;

/// Widest gap between the ends of a closed outline, as a share of its length.
const CLOSED_GAP_SHARE: f64 = 0.02;

/// One drag of an eraser.
#[derive(Debug)]
pub struct Eraser {
    partial: bool,
    /// Canvas pixels.
    radius: f64,
    last: DVec2,
    /// What became of strokes of the drawing and of pieces made on the way.
    changes: BTreeMap<StrokeId, Option<Arc<Stroke>>>,
    /// Names of pieces, which are not in the drawing.
    pieces: BTreeSet<StrokeId>,
}

impl Eraser {
    /// Puts the eraser down at a place of the canvas, with its radius in canvas pixels.
    pub fn begin(partial: bool, place: DVec2, radius: f64) -> Self {
        Self { partial, radius, last: place, changes: BTreeMap::new(), pieces: BTreeSet::new() }
    }

    /// Sweeps on to a place and erases on the way; the index shows the drawing as erased so far and is kept so. Gives
    /// whether anything changed.
    pub fn sweep(
        &mut self,
        place: DVec2,
        index: &mut StrokeIndex,
        new_id: &mut dyn FnMut() -> StrokeId,
    ) -> bool {
        let from = std::mem::replace(&mut self.last, place);
        let mut changed = false;
        for id in index.near_line(from, place, self.radius) {
            let Some(stroke) = index.get(id).map(Arc::clone) else { continue };
            let is_whole = !self.changes.contains_key(&id);
            let sweep = Sweep { from, to: place, radius: self.radius };
            let left = if self.partial { cut(&stroke, is_whole, &sweep) } else { Some(Vec::new()) };
            let Some(left) = left else { continue };
            changed = true;
            self.replace(&stroke, left, index, new_id);
        }
        changed
    }

    fn replace(
        &mut self,
        stroke: &Stroke,
        mut left: Vec<Vec<StrokePoint>>,
        index: &mut StrokeIndex,
        new_id: &mut dyn FnMut() -> StrokeId,
    ) {
        let (id, tool, brush) = (stroke.id, stroke.tool, stroke.brush);
        let longest = (0..left.len()).max_by(|a, b| length(&left[*a]).total_cmp(&length(&left[*b])));
        match longest.map(|place| left.remove(place)) {
            Some(points) => self.put(Arc::new(Stroke { id, tool, points, brush }), index),
            None => {
                self.changes.insert(id, None);
                index.apply(&StrokeChange::Remove(id));
            }
        }
        for points in left {
            let piece = Arc::new(Stroke { id: new_id(), tool, points, brush });
            self.pieces.insert(piece.id);
            self.put(piece, index);
        }
    }

    fn put(&mut self, stroke: Arc<Stroke>, index: &mut StrokeIndex) {
        index.apply(&StrokeChange::Put(Arc::clone(&stroke)));
        self.changes.insert(stroke.id, Some(stroke));
    }

    /// What was erased so far, as one change of the drawing as it was when the eraser came down.
    pub fn changes(&self) -> Vec<StrokeChange> {
        let change = |(id, left): (&StrokeId, &Option<Arc<Stroke>>)| match left {
            Some(stroke) => Some(StrokeChange::Put(Arc::clone(stroke))),
            // A piece that was made and erased again never was in the drawing.
            None if self.pieces.contains(id) => None,
            None => Some(StrokeChange::Remove(*id)),
        };
        self.changes.iter().filter_map(change).collect()
    }

    /// Canvas pixels.
    pub fn radius(&self) -> f64 {
        self.radius
    }
}

fn length(points: &[StrokePoint]) -> f64 {
    let positions: Vec<_> = points.iter().map(|point| point.position).collect();
    polyline::length(&positions).into()
}

/// A disc that moves from one place to another.
#[derive(Clone, Copy)]
struct Sweep {
    from: DVec2,
    to: DVec2,
    radius: f64,
}

/// What is left of a stroke under a sweep; `None` where the sweep does not touch it. Only a stroke that this drag has not
/// cut before can be a closed outline: the ends of a piece may be near each other because of the cut.
fn cut(stroke: &Stroke, is_whole: bool, sweep: &Sweep) -> Option<Vec<Vec<StrokePoint>>> {
    let points = &stroke.points;
    let mut pieces: Vec<Vec<StrokePoint>> = vec![vec![*points.first()?]];
    let mut touched = false;
    for (i, (p, q)) in segments(stroke).enumerate() {
        let (a, b) = (&points[i], points.get(i + 1).unwrap_or(&points[i]));
        let Some((enters, leaves)) = sweep.covers(p, q) else {
            let piece = pieces.last_mut()?;
            if piece.is_empty() {
                piece.push(*a);
            }
            piece.push(*b);
            continue;
        };
        touched = true;
        if enters > 0.0 {
            pieces.last_mut()?.push(between(a, b, enters as f32));
        } else if i == 0 {
            pieces.last_mut()?.clear();
        }
        if leaves < 1.0 {
            pieces.push(vec![between(a, b, leaves as f32), *b]);
        } else {
            pieces.push(Vec::new());
        }
    }
    if !touched {
        return None;
    }
    let is_closed = is_whole && is_closed(points, sweep);
    let keeps_ends =
        pieces.last().is_some_and(|p| !p.is_empty()) && pieces.first().is_some_and(|p| !p.is_empty());
    if is_closed && keeps_ends && pieces.len() > 1 {
        let head = pieces.remove(0);
        join(pieces.last_mut()?, head);
    }
    pieces.retain(|piece| {
        piece.len() > 1 && length(piece) >= CRUMB_RADII * sweep.radius && length(piece) > 0.0
    });
    pieces.iter_mut().for_each(|piece| restart_time(piece));
    Some(pieces)
}

/// Whether a stroke ends where it began, with a seam that is not itself erased.
fn is_closed(points: &[StrokePoint], sweep: &Sweep) -> bool {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return false };
    let gap = f64::from(first.position.distance(last.position));
    gap <= CLOSED_GAP_SHARE * length(points)
        && sweep.covers(last.position.as_dvec2(), first.position.as_dvec2()).is_none()
}

/// Appends the beginning of a closed outline to its end; time runs on.
fn join(tail: &mut Vec<StrokePoint>, head: Vec<StrokePoint>) {
    let end_ms = tail.last().map_or(0.0, |p| p.time_ms);
    let begin_ms = head.first().map_or(0.0, |p| p.time_ms);
    // The seam is one place where the ends meet exactly.
    let meets = tail.last().map(|p| p.position) == head.first().map(|p| p.position);
    let later = head.into_iter().skip(usize::from(meets));
    tail.extend(later.map(|p| StrokePoint { time_ms: end_ms + (p.time_ms - begin_ms), ..p }));
}

fn restart_time(points: &mut [StrokePoint]) {
    let begin_ms = points.first().map_or(0.0, |p| p.time_ms);
    points.iter_mut().for_each(|p| p.time_ms = (p.time_ms - begin_ms).max(0.0));
}

fn between(a: &StrokePoint, b: &StrokePoint, share: f32) -> StrokePoint {
    StrokePoint {
        position: a.position.lerp(b.position, share),
        pressure: (a.pressure + (b.pressure - a.pressure) * share).clamp(0.0, 1.0),
        tilt_deg: a.tilt_deg.lerp(b.tilt_deg, share),
        time_ms: a.time_ms + (b.time_ms - a.time_ms) * share,
        depth: a.depth + (b.depth - a.depth) * share,
    }
}

impl Sweep {
    /// Shares of the segment `p`–`q` between which it lies under the sweep; `None` where it does not.
    fn covers(&self, p: DVec2, q: DVec2) -> Option<(f64, f64)> {
        let Self { from, to, radius } = *self;
        let parts = [in_disc(p, q, from, radius), in_disc(p, q, to, radius), in_band(p, q, from, to, radius)];
        let hull = |x: (f64, f64), y: (f64, f64)| (x.0.min(y.0), x.1.max(y.1));
        parts.into_iter().flatten().reduce(hull)
    }
}

fn in_disc(p: DVec2, q: DVec2, center: DVec2, radius: f64) -> Option<(f64, f64)> {
    let (along, out) = (q - p, p - center);
    let (a, b, c) = (along.length_squared(), out.dot(along), out.length_squared() - radius * radius);
    if a == 0.0 {
        return (c <= 0.0).then_some((0.0, 1.0));
    }
    let root = (b * b - a * c).sqrt();
    within((-b - root) / a, (-b + root) / a)
}

/// The rectangle between the two discs.
fn in_band(p: DVec2, q: DVec2, a: DVec2, b: DVec2, radius: f64) -> Option<(f64, f64)> {
    let length = a.distance(b);
    if length == 0.0 {
        return None;
    }
    let (axis, side) = ((b - a) / length, ((b - a) / length).perp());
    let along = in_slab((p - a).dot(axis), (q - a).dot(axis), 0.0, length)?;
    let across = in_slab((p - a).dot(side), (q - a).dot(side), -radius, radius)?;
    within(along.0.max(across.0), along.1.min(across.1))
}

/// Shares between which a number that goes evenly from `from` to `to` lies in bounds.
fn in_slab(from: f64, to: f64, low: f64, high: f64) -> Option<(f64, f64)> {
    if from == to {
        return (low..=high).contains(&from).then_some((0.0, 1.0));
    }
    let (x, y) = ((low - from) / (to - from), (high - from) / (to - from));
    within(x.min(y), x.max(y))
}

/// The part of an interval between 0 and 1; `None` where there is none, or the bounds are no numbers.
fn within(from: f64, to: f64) -> Option<(f64, f64)> {
    let (from, to) = (from.max(0.0), if to.is_nan() { return None } else { to.min(1.0) });
    (from <= to).then_some((from, to))
}

#[cfg(test)]
#[path = "erase_tests.rs"]
mod tests;
