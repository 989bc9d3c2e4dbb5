//! Interior points of a blade, in rows across its axis (000 §5.1.1).
//!
//! Each row has a point on the blade's middle line and evenly spaced ones from there to either margin, as many as the row is wide:
//! the paper's `N_u = f(u)`, here proportional. A row that the outline cuts several times (lobes, notches) is filled
//! piece by piece, and points too near to the margin for a well-shaped face are left out.

use super::{outline::MarginPoint, sections::Sections};
use glam::Vec2;

/// How densely a blade is filled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Density {
    /// Rows between base and tip.
    pub(super) rows: u32,
    /// Points between middle line and margin where the blade is widest.
    pub(super) columns: u32,
}

/// A point keeps at least this share of the smaller spacing from the margin.
const CLEARANCE: f32 = 0.3;
/// Columns stand no closer than this share of the rows' distance, and no farther than `SPARSEST` times it.
const DENSEST: f32 = 0.35;
const SPARSEST: f32 = 1.5;

/// Memory that is used again for every blade.
#[derive(Default)]
pub(super) struct InteriorScratch {
    crossings: Vec<(u32, f32)>,
    row_starts: Vec<u32>,
    near: Vec<bool>,
    /// Places of the points on the middle line.
    middle: Vec<usize>,
}

/// The rows of one blade.
struct Rows {
    low: f32,
    step: f32,
    count: u32,
    column_width: f32,
}

impl Rows {
    fn new(sections: &Sections, density: Density) -> Self {
        let step = (sections.high - sections.low) / (density.rows + 1) as f32;
        let finest = (sections.widest / (DENSEST * step)) as u32;
        let coarsest = ((sections.widest / (SPARSEST * step)) as u32).min(3 * density.columns);
        let columns = density.columns.max(coarsest).min(finest);
        let column_width = sections.widest / (columns as f32 + 0.5);
        Self { low: sections.low, step, count: density.rows, column_width }
    }

    fn height(&self, row: u32) -> f32 {
        self.low + self.step * (row + 1) as f32
    }

    /// The rows with heights in `bottom..=top`, as a half-open range.
    fn between(&self, bottom: f32, top: f32) -> std::ops::Range<u32> {
        let first = ((bottom - self.low) / self.step - 1.0).ceil().max(0.0) as u32;
        let end = (((top - self.low) / self.step - 1.0).floor() + 1.0).max(0.0) as u32;
        first..end.min(self.count)
    }

    /// Evenly spaced points strictly between `a` and `b`, `extra` of them beyond what the distance asks for.
    fn fill(&self, row: u32, a: f32, b: f32, out: &mut Vec<Vec2>) {
        let inserted = ((b - a).abs() / self.column_width) as u32;
        for k in 1..=inserted {
            out.push(Vec2::new(a + (b - a) * (k as f32 / (inserted + 1) as f32), self.height(row)));
        }
    }
}

/// Appends the interior points of the outline to `out`; where those on its middle line stand there, from base to tip.
pub(super) fn fill<'a>(
    outline: &[MarginPoint],
    sections: &Sections,
    density: Density,
    scratch: &'a mut InteriorScratch,
    out: &mut Vec<Vec2>,
) -> &'a [usize] {
    scratch.middle.clear();
    let rows = Rows::new(sections, density);
    if rows.step <= f32::MIN_POSITIVE || rows.count == 0 {
        return &[];
    }
    let first = out.len();
    cross_rows(outline, &rows, &mut scratch.crossings);
    scratch.row_starts.clear();
    scratch.row_starts.push(0);
    let mut rest = &scratch.crossings[..];
    for row in 0..rows.count {
        let here = rest.partition_point(|c| c.0 == row);
        for span in rest[..here].chunks_exact(2) {
            let middle = sections.middle.at(rows.height(row));
            scratch.middle.extend(fill_span(&rows, row, middle, (span[0].1, span[1].1), out));
        }
        rest = &rest[here..];
        scratch.row_starts.push((out.len() - first) as u32);
    }
    drop_near_margin(outline, &rows, scratch, first, out);
    &scratch.middle
}

/// Where the outline crosses each row, sorted by row and u; an even number for each row.
fn cross_rows(outline: &[MarginPoint], rows: &Rows, crossings: &mut Vec<(u32, f32)>) {
    crossings.clear();
    let mut from = outline[outline.len() - 1].at;
    for to in outline.iter().map(|m| m.at) {
        let (bottom, top) = if from.y <= to.y { (from, to) } else { (to, from) };
        for row in rows.between(bottom.y - rows.step, top.y + rows.step) {
            let v = rows.height(row);
            // Half-open, so that a row through a corner is crossed once.
            if bottom.y <= v && v < top.y {
                let share = (v - bottom.y) / (top.y - bottom.y);
                crossings.push((row, bottom.x + (top.x - bottom.x) * share));
            }
        }
        from = to;
    }
    crossings.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
}

/// Fills a row between two crossings of the outline; where its point on the middle line stands, if that lies between.
fn fill_span(
    rows: &Rows,
    row: u32,
    middle: f32,
    (left, right): (f32, f32),
    out: &mut Vec<Vec2>,
) -> Option<usize> {
    if left >= middle || right <= middle {
        rows.fill(row, left, right, out);
        return None;
    }
    rows.fill(row, middle, left, out);
    let place = out.len();
    out.push(Vec2::new(middle, rows.height(row)));
    rows.fill(row, middle, right, out);
    Some(place)
}

fn drop_near_margin(
    outline: &[MarginPoint],
    rows: &Rows,
    scratch: &mut InteriorScratch,
    first: usize,
    out: &mut Vec<Vec2>,
) {
    let clearance = CLEARANCE * rows.step.min(rows.column_width);
    scratch.near.clear();
    scratch.near.resize(out.len() - first, false);
    let mut from = outline[outline.len() - 1].at;
    for to in outline.iter().map(|m| m.at) {
        let along = to - from;
        let inverse = 1.0 / along.length_squared().max(f32::MIN_POSITIVE);
        let (left, right) = (from.x.min(to.x) - clearance, from.x.max(to.x) + clearance);
        for row in rows.between(from.y.min(to.y) - clearance, from.y.max(to.y) + clearance) {
            let row = row as usize;
            for k in scratch.row_starts[row] as usize..scratch.row_starts[row + 1] as usize {
                let p = out[first + k];
                if p.x < left || p.x > right {
                    continue;
                }
                let share = ((p - from).dot(along) * inverse).clamp(0.0, 1.0);
                scratch.near[k] |= p.distance_squared(from + along * share) < clearance * clearance;
            }
        }
        from = to;
    }
    let (near, mut seen, mut dropped) = (&scratch.near, 0, 0);
    scratch.middle.retain_mut(|place| {
        let number = *place - first;
        dropped += near[seen..number].iter().filter(|near| **near).count();
        seen = number;
        *place -= dropped;
        !near[number]
    });
    let mut near = std::iter::repeat_n(&false, first).chain(near);
    out.retain(|_| !near.next().copied().unwrap_or(false));
}
