//! A trunk with a crown, in any number of strokes: crown and trunk in one line, two lines for a trunk, a box, a scribble.
//!
//! Lines that touch are looked at row by row from below. A trunk is a narrow stretch, [`NECK`] of the widest row at most, above
//! which the drawing grows wide: it ends where its width has gone [`SHOULDER`] of the way from its narrowest to the crown's. Its
//! centre line runs in the middle of its two sides and keeps their distance as the drawn width. The crown is what the lines above
//! enclose, gaps closed.
//!
//! What speaks for a crown is that it encloses an area much wider than the trunk ([`WIDER`]); arms of a cactus do not, nor do
//! the fronds of a palm. A single line below an outline is a stem, and that a flower: see [`corolla`](super::corolla).
//!
//! Limits: rows are level, so a trunk that leans by more than half a right angle is not found.

use super::page::{Line, Page};
use super::silhouette::{Silhouette, smooth_contour};
use super::{Habit, Hypothesis, Made};
use crate::sketch::{Reading, StrokePoint, Tool};
use glam::Vec2;

/// Rows that a group of lines is divided into.
const ROWS: usize = 120;
/// Widest narrow stretch of a trunk, as a share of the widest row above it.
const NECK: f32 = 0.62;
/// How far the width goes from the trunk's to the crown's where the trunk ends.
const SHOULDER: f32 = 0.35;
/// Narrowest trunk of two sides, as a share of the height.
const NARROWEST: f32 = 0.025;
/// Shortest and longest trunk, as shares of the height.
const TRUNK: (f32, f32) = (0.12, 0.85);
/// Least radius of the largest circle in a crown, in half widths of its trunk.
const WIDER: f32 = 1.6;
/// Least share of its convex hull that a crown fills.
const SOLID: f32 = 0.6;
/// How far up in the crown the trunk goes on, as a share of the crown's height, and its width there, as a share.
const INTO_CROWN: (f32, f32) = (0.45, 0.35);
/// Points of a crown's outline.
const OUTLINE: usize = 160;

/// Proposes trees, one for each group of lines at most.
pub fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    out.extend(page.groups.iter().chain(&page.wide_groups).filter_map(|group| tree(page, group)));
}

fn tree(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let lines: Vec<&Line> = group.iter().map(|i| &page.lines[*i]).collect();
    let rows = Rows::new(&lines)?;
    let trunk = rows.trunk()?;
    let above: Vec<Vec<Vec2>> = lines.iter().flat_map(|line| above(&line.points, trunk.top)).collect();
    let sill = vec![Vec2::new(trunk.left, trunk.top), Vec2::new(trunk.right, trunk.top)];
    let all = above.iter().chain([&sill]).map(Vec::as_slice);
    let silhouette = Silhouette::new(all, 10);
    let outline = smooth_contour(&silhouette.contour(), OUTLINE, 2);
    let hull_area = hull_area(&outline);
    let half = trunk.median_half();
    if silhouette.inscribed_radius() < WIDER * half || silhouette.area() < SOLID * hull_area {
        return None;
    }
    let score = 3.0;
    let parts = vec![trunk.centre_line(&outline), Made::new(Tool::Crown, outline)];
    Some(Hypothesis {
        uses: group.to_vec(),
        score,
        parts,
        reading: Reading::Tree,
        habit: Some(Habit::Tree),
    })
}

fn hull_area(outline: &[Vec2]) -> f32 {
    let hull = crate::geom::convex_hull::convex_hull(outline, |p| *p);
    crate::geom::simple_loop::signed_area(hull.iter().copied()).abs()
}

/// The stretches of a line above a height.
fn above(points: &[Vec2], height: f32) -> Vec<Vec<Vec2>> {
    points.chunk_by(|a, b| (a.y <= height) == (b.y <= height)).filter(|run| run[0].y <= height).map(<[Vec2]>::to_vec).collect()
}

/// Leftmost and rightmost ink of each row, from below.
struct Rows {
    /// Lower edge of the lowest row, and height of a row, pixels.
    foot: f32,
    step: f32,
    ends: Vec<(f32, f32)>,
}

/// A trunk, row by row from below: the middle and half the distance of its sides.
struct Trunk {
    rows: Vec<(Vec2, f32)>,
    top: f32,
    left: f32,
    right: f32,
}

impl Rows {
    fn new(lines: &[&Line]) -> Option<Self> {
        let foot = lines.iter().map(|line| line.bounds.1.y).reduce(f32::max)?;
        let top = lines.iter().map(|line| line.bounds.0.y).reduce(f32::min)?;
        let step = (foot - top) / ROWS as f32;
        if step <= 0.0 {
            return None;
        }
        let mut ends = vec![(f32::INFINITY, f32::NEG_INFINITY); ROWS];
        for pair in lines.iter().flat_map(|line| line.points.windows(2)) {
            let pieces = (2.0 * pair[0].distance(pair[1]) / step).ceil().max(1.0) as usize;
            for k in 0..=pieces {
                let p = pair[0].lerp(pair[1], k as f32 / pieces as f32);
                let row = &mut ends[(((foot - p.y) / step) as usize).min(ROWS - 1)];
                *row = (row.0.min(p.x), row.1.max(p.x));
            }
        }
        Some(Self { foot, step, ends })
    }

    fn width(&self, row: usize) -> f32 {
        (self.ends[row].1 - self.ends[row].0).max(0.0)
    }

    /// Whether both sides of something are drawn in a row, and not only one line.
    fn has_two_sides(&self, row: usize) -> bool {
        self.width(row) > NARROWEST * self.step * ROWS as f32
    }

    fn height_of(&self, row: usize) -> f32 {
        self.foot - (row as f32 + 0.5) * self.step
    }

    /// The narrow stretch below, if the drawing has one.
    fn trunk(&self) -> Option<Trunk> {
        let share = |share: f32| (share * ROWS as f32) as usize;
        let is_drawn = |row: &usize| self.has_two_sides(*row);
        // Sides seldom end at one height; what has one side only, below, is the foot of the longer.
        let foot = (0..share(TRUNK.1)).find(is_drawn)?;
        let neck = (foot + share(0.03)..share(TRUNK.1)).filter(is_drawn).min_by(|a, b| self.width(*a).total_cmp(&self.width(*b)))?;
        let narrow = self.width(neck);
        let wide = (neck..ROWS).map(|row| self.width(row)).fold(0.0, f32::max);
        let height = self.step * ROWS as f32;
        if narrow > NECK * wide {
            return None;
        }
        let most = narrow + SHOULDER * (wide - narrow);
        let top = (neck..ROWS).find(|row| self.width(*row) > most)?;
        let length = top as f32 / ROWS as f32;
        if !(TRUNK.0..=TRUNK.1).contains(&length) {
            return None;
        }
        // Below the neck roots may spread; they are the trunk's as far as they are not wider than the crown is.
        let rows: Vec<(Vec2, f32)> = (0..top)
            .filter(is_drawn)
            .map(|row| {
                let (left, right) = self.ends[row];
                (Vec2::new(0.5 * (left + right), self.height_of(row)), 0.5 * (right - left).min(1.8 * most))
            })
            .collect();
        let is_mostly_two_sided = rows.len() * 10 >= (top - foot) * 8;
        if !is_mostly_two_sided {
            return None;
        }
        let (last, half) = *rows.last()?;
        Some(Trunk { top: self.height_of(top - 1), left: last.x - half, right: last.x + half, rows })
    }
}

impl Trunk {
    fn median_half(&self) -> f32 {
        let mut halves: Vec<f32> = self.rows.iter().map(|row| row.1).collect();
        let middle = halves.len() / 2;
        *halves.select_nth_unstable_by(middle, f32::total_cmp).1
    }

    /// The middle of the trunk, which goes on into the crown, with its width as pressure.
    fn centre_line(&self, crown: &[Vec2]) -> Made {
        let top = crown.iter().map(|p| p.y).fold(self.top, f32::min);
        let mut rows = evened(&self.rows);
        let (last, half) = rows[rows.len() - 1];
        let middle = crown.iter().sum::<Vec2>() / crown.len().max(1) as f32;
        let end = Vec2::new(last.x + 0.5 * (middle.x - last.x), last.y + INTO_CROWN.0 * (top - last.y));
        rows.extend((1..=12).map(|k| {
            let share = k as f32 / 12.0;
            (last.lerp(end, share), half * (1.0 + share * (INTO_CROWN.1 - 1.0)))
        }));
        let widest = rows.iter().map(|row| row.1).fold(f32::MIN_POSITIVE, f32::max);
        let point = |(position, half): (Vec2, f32)| StrokePoint { pressure: half / widest, ..StrokePoint::at(position) };
        Made { tool: Tool::Branch, points: rows.into_iter().map(point).collect(), half_width: Some(widest) }
    }
}

/// Middles and widths without the jitter of single rows: running means over a tenth of the trunk.
fn evened(rows: &[(Vec2, f32)]) -> Vec<(Vec2, f32)> {
    let reach = (rows.len() / 20).max(2);
    (0..rows.len())
        .map(|i| {
            let near = i.min(rows.len() - 1 - i).min(reach);
            let window = &rows[i - near..=i + near];
            let count = window.len() as f32;
            (window.iter().map(|row| row.0).sum::<Vec2>() / count, window.iter().map(|row| row.1).sum::<f32>() / count)
        })
        .collect()
}
