//! Middle lines of a fleshy body, a column and its arms: what speaks for them, and the branches that they become.
//!
//! A column is about as thick all the way up, its arms are no thicker than it and as long as they are thick or longer outside of
//! it, they do not hang, and most end blunt. Trees are wider above than below, lobes of crowns and of leaves are shorter than wide,
//! fronds hang and are pointed. A line that rises from a column is an arm as well: one of which only the middle was drawn.

use crate::anatomy::conventions::Made;
use crate::anatomy::conventions::page::even;
use crate::anatomy::conventions::shapes::medial_axis::Axis;
use crate::anatomy::conventions::trees::evidence::ramp;
use glam::Vec2;
use std::f32::consts::PI;

/// Thinnest body, in cells of the silhouette: what is thinner is a line.
const THINNEST: f32 = 2.5;
/// Least length of all middle lines, in half widths of the column.
const SLENDER: f32 = 5.0;
/// Lower part of the column in which its thickness is measured, as a share of its length.
const BELOW: f32 = 0.4;
/// Least of it, in half widths of all of the column.
const FOOT: f32 = 0.85;
/// Least length of an arm outside of the column, in half widths of its own, and least half width, in those of the column: what is
/// shorter is a bend of the outline, what is thinner a spine.
const FREE: f32 = 1.8;
const SPINE: f32 = 0.15;
/// Most of a column's greatest half width in its least, ends left out.
const EVEN: f32 = 3.5;
/// Least height of a column's tip over its foot, as a share of their distance.
const UPRIGHT: f32 = 0.75;
/// Least half width at a tip, one half width before its end, as a share: the tip of a wedge of 65° is pointed.
const BLUNT: f32 = 0.5;
/// Least height of an arm's tip over the foot, as a share of the body's: what ends lower is a corner of the foot.
const LOW: f32 = 0.2;
/// What an arm is measured by, each where it speaks against one and where for it: free length in half widths of its own, which
/// neither lumps have nor leaves on stalks; half width in those of the column; greatest half width in the least, ends left out; height
/// of its tip over its beginning as a share of their distance.
const LONG_ARM: (f32, f32) = (1.6, 3.6);
const STALK: (f32, f32) = (22.0, 12.0);
const THIN_ARM: (f32, f32) = (0.15, 0.45);
const THICK_ARM: (f32, f32) = (1.7, 1.15);
const UNEVEN_ARM: (f32, f32) = (6.0, 2.4);
const HANGING_ARM: (f32, f32) = (-0.4, 0.2);
/// The same of arms above which the column does not go on by so many half widths: those of a fork rise, caps and crowns do not.
const RISING_ARM: (f32, f32) = (0.1, 0.7);
const GOES_ON: f32 = 2.2;
/// What a pointed arm counts, and log-odds of an uneven or pointed column and where all limbs are pointed, not only half of them.
const POINTED_ARM: f32 = 0.8;
const COLUMN: f32 = -0.3;
const POINTED: f32 = -3.0;
/// What an arm counts below which it speaks against a body.
const WEAK: f32 = 0.25;
/// Log-odds of arms: before anything is known of them, of the first that is one, of the rest, and of each that is none.
const ARMS: (f32, f32, f32, f32) = (2.3, 2.5, 0.5, -1.0);
/// A column is wider where arms leave it, by so much of their half width; where it is by this much more, and by this, it is a crown.
const WIDER: (f32, f32, f32) = (0.45, 0.2, 0.7);
/// Lumps of a crown make the column wider where they leave it, and are short: least slenderness of the longest arm for each half
/// width by which the column is wider there, what it has above that where it is a lump and where it is none, and log-odds of lumps.
const LUMPS: (f32, f32, f32) = (3.0, 1.2, 2.0);
const LUMPY: f32 = -4.0;
/// Most of a limb's half width, and least at its beginning, in its median.
const THICKER: f32 = 1.25;
const THINNER: f32 = 0.8;
/// Distance of the middle of a tip's circle from the tip, in its radii: a little more, as both are counted in cells.
const AT_TIP: f32 = 1.15;
/// An arm of which the middle was drawn: least length from the middle of the column, its half width, farthest beginning, in half
/// widths of the column.
const LINE: (f32, f32, f32) = (2.2, 0.6, 1.6);
/// Least height of its tip over its beginning, as a share of their distance.
const RISES: f32 = 0.15;

/// The column and the arms of a body.
#[derive(Clone, Debug)]
pub(crate) struct Limbs {
    /// The column first.
    axes: Vec<Axis>,
    /// Half width of the column in its lower part, pixels.
    half: f32,
}

impl Limbs {
    /// The limbs among the middle lines of an area whose cells have this size: without corners of the outline. None where they
    /// are not those of a body.
    pub(crate) fn new(axes: Vec<Axis>, cell: f32) -> Option<Self> {
        let column = axes.first()?;
        // Narrow feet are closed or were drawn with care.
        let half = column.half_below().max(FOOT * median_half(column.middle()));
        let foot = column.points.first()?.0.y;
        let top = axes.iter().flat_map(|axis| axis.points.last()).map(|p| p.0.y).fold(foot, f32::min);
        let is_high = |axis: &Axis| axis.points.last().is_some_and(|tip| foot - tip.0.y > LOW * (foot - top));
        let length: f32 = axes.iter().map(Axis::length).sum();
        let is_column =
            half > THINNEST * cell && column.rise() > UPRIGHT && length > SLENDER * half && foot - top > 0.0;
        if !is_column {
            return None;
        }
        let is_arm = |axis: &&Axis| {
            let own = median_half(axis.free());
            is_high(axis) && axis.length() - axis.points[0].1 > FREE * own && own > SPINE * half
        };
        let arms = axes.iter().skip(1).filter(is_arm);
        let axes = [column].into_iter().chain(arms).cloned().collect();
        Some(Self { axes, half })
    }

    /// Log-odds of a body with arms, by its limbs alone.
    pub(crate) fn log_odds(&self) -> f32 {
        let Some((column, arms)) = self.axes.split_first().filter(|(_, arms)| !arms.is_empty()) else {
            return f32::NEG_INFINITY;
        };
        let strengths: Vec<f32> = arms.iter().map(|arm| self.strength(arm)).collect();
        let sum: f32 = strengths.iter().sum();
        let weak = strengths.iter().filter(|strength| **strength < WEAK).count() as f32;
        let widest = |axes: &[Axis]| {
            axes.iter().flat_map(|axis| &axis.points).map(|p| p.1 / self.half).fold(0.0, f32::max)
        };
        let long = arms.iter().map(Axis::slenderness).fold(0.0, f32::max);
        let lumps = 1.0 - ramp(long - LUMPS.0 * (widest(&self.axes) - 1.0).max(0.0), (LUMPS.1, LUMPS.2));
        let thick = arms.iter().map(|arm| median_half(arm.free()) / self.half).fold(0.0, f32::max);
        let crown = ramp(widest(&self.axes[..1]) - 1.0 - WIDER.0 * thick, (WIDER.1, WIDER.2));
        let irregular = [column.evenness() < EVEN, column.is_blunt()].iter().filter(|is_so| !**is_so).count();
        let pointed =
            self.axes.iter().filter(|axis| !axis.is_blunt()).count() as f32 / self.axes.len() as f32;
        ARMS.0
            + ARMS.1 * sum.min(1.0)
            + ARMS.2 * (sum - 1.0).clamp(0.0, 1.0)
            + ARMS.3 * weak
            + LUMPY * lumps.max(crown)
            + POINTED * ramp(pointed, (0.6, 1.0))
            + COLUMN * irregular as f32
    }

    /// How far the column goes on above the beginning of an arm, in half widths.
    fn goes_on_above(&self, arm: &Axis) -> f32 {
        let tip = self.axes[0].points.last().zip(arm.points.first());
        tip.map_or(0.0, |(tip, root)| (root.0.y - tip.0.y) / self.half)
    }

    /// How much of an arm something is that leaves the column, from 0 to 1.
    fn strength(&self, arm: &Axis) -> f32 {
        let thick = median_half(arm.free()) / self.half;
        let long = arm.slenderness();
        let goes_on = self.goes_on_above(arm) > GOES_ON;
        ramp(long, LONG_ARM)
            * ramp(long, STALK)
            * ramp(thick, THIN_ARM)
            * ramp(thick, THICK_ARM)
            * ramp(arm.evenness(), UNEVEN_ARM)
            * ramp(arm.rise(), if goes_on { HANGING_ARM } else { RISING_ARM })
            * if arm.is_blunt() { 1.0 } else { POINTED_ARM }
    }

    /// Adds an arm of which only the middle was drawn, if this line is one: it goes on outside of the column and upward.
    pub(crate) fn add_line(&mut self, line: &[Vec2]) -> bool {
        let Some(column) = self.axes.first() else { return false };
        let to_column = |p: Vec2| {
            let nearest = column.points.iter().enumerate();
            nearest.map(|(i, q)| (q.0.distance(p), i)).min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let (first, last) = (line[0], line[line.len() - 1]);
        let Some((at_first, at_last)) = to_column(first).zip(to_column(last)) else { return false };
        let mut points = line.to_vec();
        if at_last.0 < at_first.0 {
            points.reverse();
        }
        let (root, place) = if at_last.0 < at_first.0 { at_last } else { at_first };
        points.insert(0, column.points[place].0);
        let half = LINE.1 * self.half;
        let points = even(&points, points.len()).into_iter().map(|p| (p, half)).collect();
        let arm = Axis { points, parent: Some((0, place)) };
        let is_arm = root < LINE.2 * self.half && arm.length() > LINE.0 * self.half && arm.rise() > RISES;
        if is_arm {
            self.axes.push(arm);
        }
        is_arm
    }

    /// Number of arms.
    pub(crate) fn arms(&self) -> usize {
        self.axes.len() - 1
    }

    /// Half width of the column, pixels.
    pub(crate) fn half(&self) -> f32 {
        self.half
    }

    /// Middles and half widths of all limbs.
    pub(crate) fn circles(&self) -> impl Iterator<Item = &(Vec2, f32)> {
        self.axes.iter().flat_map(|axis| &axis.points)
    }

    /// Branches as thick as the limbs, the column first.
    pub(crate) fn branches(&self) -> Vec<Made> {
        self.axes.iter().map(branch).collect()
    }
}

impl Axis {
    fn length(&self) -> f32 {
        self.points.windows(2).map(|w| w[0].0.distance(w[1].0)).sum()
    }

    /// Length outside of its parent, in half widths of its own there.
    fn slenderness(&self) -> f32 {
        let parent = self.points.first().filter(|_| self.parent.is_some()).map_or(0.0, |first| first.1);
        (self.length() - parent) / median_half(self.free()).max(f32::MIN_POSITIVE)
    }

    /// Half width in the lower part, the very foot left out.
    fn half_below(&self) -> f32 {
        let end = ((BELOW * self.points.len() as f32) as usize).max(1);
        let low = self.points.get(..end).unwrap_or(&self.points);
        let begin = low.iter().position(|p| p.0.distance(low[0].0) > 0.8 * median_half(low)).unwrap_or(0);
        median_half(&low[begin..])
    }

    /// The part outside of its parent.
    fn free(&self) -> &[(Vec2, f32)] {
        let Some(first) = self.points.first().filter(|_| self.parent.is_some()) else { return &self.points };
        let begin = self.points.iter().position(|p| p.0.distance(first.0) > first.1);
        self.points.get(begin.unwrap_or(0)..).unwrap_or(&[])
    }

    /// The part that is neither in its parent nor at its ends.
    fn middle(&self) -> &[(Vec2, f32)] {
        let free = self.free();
        let half = median_half(free);
        let (Some(first), Some(last)) = (free.first(), free.last()) else { return &[] };
        let away = |p: &(Vec2, f32), end: &(Vec2, f32)| p.0.distance(end.0) > end.1.max(half);
        let at_foot = if self.parent.is_some() { 0.0 } else { half };
        let begin = free.iter().position(|p| p.0.distance(first.0) >= at_foot).unwrap_or(0);
        let end = free.iter().rposition(|p| away(p, last)).map_or(0, |i| i + 1);
        free.get(begin..end).unwrap_or(&[])
    }

    /// Its greatest half width in its least, ends left out; great where it has no middle.
    fn evenness(&self) -> f32 {
        let mut halves: Vec<f32> = self.middle().iter().map(|p| p.1).collect();
        halves.sort_by(f32::total_cmp);
        let at = |share: f32| halves.get((share * halves.len() as f32) as usize).copied();
        at(0.9)
            .zip(at(0.1))
            .map_or(f32::INFINITY, |(greatest, least)| greatest / least.max(f32::MIN_POSITIVE))
    }

    /// Height of its tip over its beginning, as a share of their distance.
    fn rise(&self) -> f32 {
        let ends = self.points.first().zip(self.points.last());
        ends.map_or(0.0, |(first, last)| {
            (first.0.y - last.0.y) / first.0.distance(last.0).max(f32::MIN_POSITIVE)
        })
    }

    /// Whether it does not thin out toward its tip.
    fn is_blunt(&self) -> bool {
        let half = median_half(self.middle());
        let Some(tip) = self.points.last() else { return false };
        let before = self.points.iter().rev().find(|p| p.0.distance(tip.0) > half);
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

/// A branch along a middle line, round at its tip; where others leave it and in its parent hardly thicker than elsewhere.
fn branch(axis: &Axis) -> Made {
    let half = median_half(axis.middle());
    let mut points = smooth(in_circles(&axis.points));
    if axis.parent.is_none() {
        points = upright_at_foot(points, half);
    }
    let (count, most) = (points.len(), THICKER * half);
    for (i, point) in points.iter_mut().enumerate() {
        // An arm begins in its parent, as thick as outside of it.
        let least = if i < count / 2 { THINNER * half } else { 0.0 };
        point.1 = point.1.clamp(least, most.max(least));
    }
    points.extend(cap(&points));
    Made::thick(points)
}

/// A column that stands as it goes on above: its middle line begins somewhere on the edge of the area.
fn upright_at_foot(points: Vec<(Vec2, f32)>, half: f32) -> Vec<(Vec2, f32)> {
    let Some(&(foot, _)) = points.first() else { return points };
    // Of a body hardly higher than wide all but the tip is its foot.
    let last = points.len() - 1;
    let at = |reach: f32| points.iter().position(|p| p.0.distance(foot) > reach * half).unwrap_or(last);
    let (low, high) = (at(1.2), at(2.4));
    let ((from, width), along) = (points[low], points[low].0 - points[high].0);
    let down = (foot.y - from.y).max(0.0);
    let lean = (along.x / along.y.max(f32::MIN_POSITIVE)).clamp(-0.5, 0.5);
    let below = (0..=4).map(|k| {
        let share = 1.0 - k as f32 / 5.0;
        (from + share * down * Vec2::new(lean, 1.0), width)
    });
    below.chain(points[low..].iter().copied()).collect()
}

/// A middle line up to the middle of the last circle that fits into its tip: from there it goes straight to the edge, about as far
/// as its distance from it says.
fn in_circles(points: &[(Vec2, f32)]) -> &[(Vec2, f32)] {
    let tip = points.last().map_or(Vec2::ZERO, |p| p.0);
    let end = points.iter().rposition(|p| p.0.distance(tip) > AT_TIP * p.1).unwrap_or(0);
    &points[..=end.max(1).min(points.len() - 1)]
}

/// A round end from the last point on.
fn cap(points: &[(Vec2, f32)]) -> Vec<(Vec2, f32)> {
    let Some(&(middle, half)) = points.last() else { return Vec::new() };
    let before = points.iter().rev().find(|p| p.0.distance(middle) > half).unwrap_or(&points[0]);
    let along = (middle - before.0).normalize_or_zero();
    let at = |k: i32| {
        let angle = 0.47 * PI * k as f32 / 8.0;
        (middle + along * half * angle.sin(), half * angle.cos())
    };
    (1..=8).map(at).collect()
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
