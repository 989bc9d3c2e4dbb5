//! The drawing with strokes that are drawn over one another, or go round again, made one line each.

use super::redrawn::Redrawn;
use super::{bundles, rounds};
use crate::anatomy::conventions::page::{Page, even};
use crate::geom::polyline;
use crate::sketch::{Stroke, StrokePoint, Tool};
use glam::Vec2;
use std::sync::Arc;

/// The drawing of a page with strokes that are drawn over one another, or go round again, made one line each; none where there are
/// none. Only those strokes are looked at that may be changed.
pub(crate) fn restated(
    page: &Page,
    strokes: &[Arc<Stroke>],
    may_change: impl Fn(usize) -> bool,
) -> Option<Redrawn> {
    let mut lines: Vec<bundles::Bundle> = bundles::bundles(page, |line| may_change(page.lines[line].stroke));
    for line in &mut lines {
        if let Some(once) = rounds::once(&line.points, page.diagonal) {
            (line.points, line.is_changed) = (once, true);
        }
    }
    lines.retain(|line| line.is_changed);
    if lines.is_empty() {
        return None;
    }
    let line = |bundle: bundles::Bundle| {
        let members: Vec<usize> = bundle.members.iter().map(|line| page.lines[*line].stroke).collect();
        let points = evened(&bundle.points, page.diagonal).into_iter().map(StrokePoint::at).collect();
        let stroke = Stroke { id: strokes[members[0]].id, tool: Tool::Auto, points, brush: None };
        (members, Arc::new(stroke))
    };
    Some(Redrawn::of(strokes, lines.into_iter().map(line).collect()))
}

/// Step between points of a line that is made, as a share of the drawing's diagonal.
const STEP: f32 = 0.006;

/// The same line at even steps.
fn evened(points: &[Vec2], diagonal: f32) -> Vec<Vec2> {
    let length = polyline::length(points);
    even(points, ((length / (STEP * diagonal)) as usize).clamp(16, 1200))
}
