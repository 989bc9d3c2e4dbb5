//! The fleshy body of a cactus: a column, with arms or without, drawn by its outline.
//!
//! Its middle lines ([`medial_axis`](super::medial_axis)) become branches as thick as drawn. What speaks for a body is that all of
//! it is about equally thick and longer than that, and that its ends are blunt: leaves, petals and fronds are pointed, crowns are
//! wider than their trunks and have notches beside those between arms. A column without arms must be open below, or it is a blade.
//!
//! Short strokes on the body are its spines and belong to it. Limits: bodies of flat joints one on another are not understood.

use super::evidence;
use super::medial_axis::{Axis, medial_axes};
use super::page::{Line, Page, notches};
use super::silhouette::{Silhouette, smooth_contour};
use super::{Habit, Hypothesis, Made};
use crate::sketch::{Reading, StrokePoint, Tool};
use glam::Vec2;
use std::f32::consts::PI;

/// Smallest body, as a share of the drawing's diagonal.
const SMALLEST: f32 = 0.2;
/// How wide gaps of the outline are closed, in cells of the silhouette.
const BRIDGE: i32 = 6;
/// Least area of a body, in areas of the largest circle in it.
const LONG: f32 = 1.8;
/// Least share of the area that circles about the middle lines, as large as they fit, cover.
const COVERED: f32 = 0.94;
/// Thinnest body, in cells of the silhouette: what is thinner is a line.
const THINNEST: f32 = 2.5;
/// Least length of all middle lines, in half widths.
const SLENDER: f32 = 5.0;
/// Least length of each, in half widths of its own.
const SLENDER_ARM: f32 = 3.4;
/// Most of the greatest half width in the least, ends left out.
const EVEN: f32 = 2.2;
/// Least climb of a line from its beginning to its tip, as a share of their distance: arms of a cactus turn up.
const RISE: f32 = 0.5;
/// Least half width at a tip, one half width before its end, as a share.
const BLUNT: f32 = 0.6;
/// One tip of so many, and one besides, may be pointed.
const MOSTLY: usize = 2;
/// Shortest arm, in half widths of the trunk there, and shortest that does not rise: what is shorter is a corner at the foot.
const ARM: (f32, f32) = (2.5, 4.0);
/// Least distance of the ends of a column's outline, as a share of its width.
const OPEN: f32 = 0.6;
/// Least share of what is drawn that lies in the body.
const INSIDE: f32 = 0.95;
/// Points of the outline.
const POINTS: usize = 160;
/// Log-odds of a body: where it could be a tree, it is one.
const SCORE: f32 = 2.9;

/// Proposes bodies, one for each group of lines at most.
pub(super) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    out.extend(page.groups.iter().filter_map(|group| body(page, group)));
}

fn body(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let lines: Vec<&Line> = group.iter().map(|i| &page.lines[*i]).collect();
    let empty = (Vec2::INFINITY, Vec2::NEG_INFINITY);
    let (low, high) =
        lines.iter().fold(empty, |all, line| (all.0.min(line.bounds.0), all.1.max(line.bounds.1)));
    if high.distance(low) < SMALLEST * page.diagonal
        || evidence::has_blades(&lines, high - low)
        || !evidence::has_outline(&lines, high - low)
    {
        return None;
    }
    let foot = foot(&lines, (low, high));
    let base = foot.map(|(left, right)| vec![left, right]);
    let drawn = lines.iter().map(|line| line.points.as_slice());
    let silhouette = Silhouette::new(drawn.clone().chain(base.iter().map(Vec::as_slice)), BRIDGE);
    if silhouette.area() < LONG * PI * silhouette.inscribed_radius().powi(2) {
        return None;
    }
    let root = foot.map_or(Vec2::new(0.5 * (low.x + high.x), high.y), |(left, right)| left.midpoint(right));
    let axes = arms(medial_axes(&silhouette, root));
    let outline = smooth_contour(&silhouette.contour(), POINTS, 1);
    let is_smooth = notches(&outline).len() < 2 * axes.len();
    let is_body = is_fleshy(&axes, foot, THINNEST * silhouette.cell())
        && is_smooth
        && silhouette.share_within(axes.iter().flat_map(|axis| &axis.points)) >= COVERED
        && silhouette.share_inside(lines.iter().flat_map(|line| &line.points)) >= INSIDE
        && !evidence::has_flower_centre(&lines, &outline);
    is_body.then(|| Hypothesis {
        uses: page.with_what_is_inside(group, &outline),
        score: SCORE,
        parts: axes.iter().map(branch).collect(),
        solids: Vec::new(),
        reading: Reading::Cactus,
        habit: Some(Habit::Succulent),
    })
}

/// Whether middle lines are those of a column with arms: long, evenly thick, turned up and mostly blunt. One without arms is open
/// at its foot.
fn is_fleshy(axes: &[Axis], foot: Option<(Vec2, Vec2)>, thinnest: f32) -> bool {
    let Some(half) = axes.first().map(|trunk| median_half(&trunk.points)) else { return false };
    let length: f32 = axes.iter().map(Axis::length).sum();
    let is_open = foot.is_some_and(|(left, right)| left.distance(right) > OPEN * 2.0 * half);
    let pointed = axes.iter().filter(|axis| !axis.is_blunt()).count();
    half > thinnest
        && length > SLENDER * half
        && axes.iter().all(|axis| axis.is_even() && axis.rises() && axis.is_long())
        && pointed * MOSTLY <= axes.len() + 1
        && (axes.len() > 1 || is_open)
}

/// The two ends of the outline where it is open toward the ground.
fn foot(lines: &[&Line], (low, high): (Vec2, Vec2)) -> Option<(Vec2, Vec2)> {
    let is_low = |p: &Vec2| p.y > high.y - 0.25 * (high.y - low.y);
    let ends: Vec<Vec2> =
        lines.iter().flat_map(|line| [line.ends().0, line.ends().1]).filter(is_low).collect();
    let left = ends.iter().copied().min_by(|a, b| a.x.total_cmp(&b.x))?;
    let right = ends.iter().copied().max_by(|a, b| a.x.total_cmp(&b.x))?;
    (left != right).then_some((left, right))
}

/// Middle lines without those that are no arms but corners of the outline.
fn arms(axes: Vec<Axis>) -> Vec<Axis> {
    let is_arm = |axis: &Axis| {
        let Some((parent, place)) = axis.parent else { return true };
        let on_parent = axes.get(parent).and_then(|p| p.points.get(place)).map_or(0.0, |p| p.1);
        axis.length() > if axis.rises() { ARM.0 } else { ARM.1 } * on_parent
    };
    axes.iter().filter(|axis| is_arm(axis)).cloned().collect()
}

impl Axis {
    fn length(&self) -> f32 {
        self.points.windows(2).map(|w| w[0].0.distance(w[1].0)).sum()
    }

    /// The part that is neither in its parent nor at its tip.
    fn middle(&self) -> &[(Vec2, f32)] {
        let half = median_half(&self.points);
        let away = |p: &(Vec2, f32), end: &(Vec2, f32)| p.0.distance(end.0) > 1.2 * half;
        let (Some(first), Some(last)) = (self.points.first(), self.points.last()) else { return &[] };
        // An arm begins in the middle of its parent.
        let in_parent = if self.parent.is_some() { 1.1 * first.1 } else { 0.0 };
        let begin =
            self.points.iter().position(|p| away(p, first) && p.0.distance(first.0) > in_parent).unwrap_or(0);
        let end = self.points.iter().rposition(|p| away(p, last)).map_or(0, |i| i + 1);
        self.points.get(begin..end).unwrap_or(&[])
    }

    /// Whether it is about equally thick.
    fn is_even(&self) -> bool {
        let mut halves: Vec<f32> = self.middle().iter().map(|p| p.1).collect();
        halves.sort_by(f32::total_cmp);
        let at = |share: f32| halves.get((share * halves.len() as f32) as usize).copied().unwrap_or(0.0);
        !halves.is_empty() && at(0.9) < EVEN * at(0.1)
    }

    /// Whether it is long for its own thickness.
    fn is_long(&self) -> bool {
        self.length() > SLENDER_ARM * median_half(self.middle())
    }

    /// Whether it ends well above its beginning.
    fn rises(&self) -> bool {
        let ends = self.points.first().zip(self.points.last());
        ends.is_some_and(|(first, last)| first.0.y - last.0.y > RISE * first.0.distance(last.0))
    }

    /// Whether it does not thin out toward its tip.
    fn is_blunt(&self) -> bool {
        let half = median_half(self.middle());
        let Some(tip) = self.points.last() else { return false };
        let before = self.points.iter().rev().find(|p| p.0.distance(tip.0) > 0.8 * half);
        before.is_some_and(|p| p.1 > BLUNT * half)
    }
}

fn median_half(points: &[(Vec2, f32)]) -> f32 {
    let mut halves: Vec<f32> = points.iter().map(|p| p.1).collect();
    if halves.is_empty() {
        return 0.0;
    }
    let middle = halves.len() / 2;
    *halves.select_nth_unstable_by(middle, f32::total_cmp).1
}

/// A branch along a middle line, round at its tip; in its parent it is no thicker than after it.
fn branch(axis: &Axis) -> Made {
    let half = median_half(axis.middle());
    let (mut points, most) = (smooth(&axis.points), 1.15 * half);
    let tip = points.last().map_or(Vec2::ZERO, |p| p.0);
    let end = points.iter().rposition(|p| p.0.distance(tip) > p.1.min(most)).unwrap_or(0);
    points.truncate(end.max(1) + 1);
    let (count, is_trunk) = (points.len(), axis.parent.is_none());
    for (i, point) in points.iter_mut().enumerate() {
        // The first line begins at the edge of the area, where it stands on the ground: as thick as above.
        let least = if i < count / 2 && is_trunk { 0.85 * half } else { 0.0 };
        point.1 = point.1.clamp(least, most.max(least));
    }
    points.extend(cap(points[points.len() - 1], tip));
    let widest = points.iter().map(|p| p.1).fold(f32::MIN_POSITIVE, f32::max);
    let point =
        |(position, half): (Vec2, f32)| StrokePoint { pressure: half / widest, ..StrokePoint::at(position) };
    Made { tool: Tool::Branch, points: points.into_iter().map(point).collect(), half_width: Some(widest) }
}

/// A round end from the middle of its circle toward the tip.
fn cap((middle, half): (Vec2, f32), tip: Vec2) -> impl Iterator<Item = (Vec2, f32)> {
    let along = (tip - middle).normalize_or_zero();
    (1..=8).map(move |k| {
        let angle = 0.47 * PI * k as f32 / 8.0;
        (middle + along * half * angle.sin(), half * angle.cos())
    })
}

/// A middle line without the steps of the grid and without bends that are tighter than it is thick, ends kept.
fn smooth(points: &[(Vec2, f32)]) -> Vec<(Vec2, f32)> {
    let reach = (points.len() / 5).clamp(1, 16);
    (0..points.len())
        .map(|i| {
            let near = i.min(points.len() - 1 - i).min(reach);
            let window = &points[i - near..=i + near];
            let count = window.len() as f32;
            (
                window.iter().map(|p| p.0).sum::<Vec2>() / count,
                window.iter().map(|p| p.1).sum::<f32>() / count,
            )
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::Stroke;
    use std::sync::Arc;

    fn read(lines: &[&[(f32, f32)]]) -> Vec<Hypothesis> {
        let stroke = |(id, line): (usize, &&[(f32, f32)])| {
            let points = line.iter().map(|p| StrokePoint::at(Vec2::from(*p))).collect();
            Arc::new(Stroke { id: id as u64, tool: Tool::Auto, points })
        };
        let strokes: Vec<_> = lines.iter().enumerate().map(stroke).collect();
        let mut out = Vec::new();
        propose(&Page::new(&strokes), &mut out);
        out
    }

    const COLUMN: [(f32, f32); 6] =
        [(-10.0, 60.0), (-10.0, -60.0), (-5.0, -68.0), (5.0, -68.0), (10.0, -60.0), (10.0, 60.0)];

    #[test]
    fn a_column_that_is_open_below_is_a_body_as_thick_as_drawn() {
        let bodies = read(&[&COLUMN]);
        assert_eq!(bodies.len(), 1);
        let [trunk] = &bodies[0].parts[..] else { panic!("{} parts", bodies[0].parts.len()) };
        let middle = trunk.points[trunk.points.len() / 2];
        let half = middle.pressure * trunk.half_width.unwrap();
        assert!((half - 10.0).abs() < 1.5 && middle.position.x.abs() < 1.5, "{half} at {}", middle.position);
    }

    #[test]
    fn arms_are_branches_of_their_own() {
        let outline = [
            (-10.0, 60.0),
            (-10.0, 10.0),
            (-34.0, 10.0),
            (-38.0, 5.0),
            (-38.0, -35.0),
            (-34.0, -40.0),
            (-26.0, -40.0),
            (-22.0, -35.0),
            (-22.0, -8.0),
            (-10.0, -8.0),
            (-10.0, -60.0),
            (-5.0, -68.0),
            (5.0, -68.0),
            (10.0, -60.0),
            (10.0, 60.0),
        ];
        let bodies = read(&[&outline]);
        assert_eq!(bodies.len(), 1);
        assert_eq!(bodies[0].parts.len(), 2);
    }

    #[test]
    fn leaves_and_closed_columns_are_none() {
        let leaf: Vec<(f32, f32)> = (0..=80)
            .map(|k| {
                let t = k as f32 / 40.0;
                let side = if t < 1.0 { 1.0 } else { -1.0 };
                let up = if t < 1.0 { t } else { 2.0 - t };
                (side * 25.0 * (std::f32::consts::PI * up).sin(), -120.0 * up)
            })
            .collect();
        assert!(read(&[&leaf]).is_empty());
        let mut closed = COLUMN.to_vec();
        closed.push(closed[0]);
        assert!(read(&[&closed]).is_empty(), "a blade");
    }
}
