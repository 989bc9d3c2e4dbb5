//! All strokes of a drawing in one array, as the GPU draws them in one call.
//!
//! Between two strokes lies a gap: a point with a negative radius. Strokes lie in drawing order; the stroke under the pen
//! is the last one, so that its new points are simply added at the end. [`InkBuffer::take_dirty`] names what must be sent
//! to the GPU: after one more sample, that sample and those before it that a stabiliser still moves, however long the
//! stroke is. Knows no GPU itself.

use super::StrokeCurve;
use crate::sketch::{StrokeId, StrokePoint};
use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// Separate ranges that are remembered; more of them are sent as one.
const MOST_RANGES: usize = 64;
/// Points before a change whose pieces look different.
const NEIGHBOURS: usize = 3;
/// Gaps below this number are never worth moving the strokes together.
const FEW_GAPS: usize = 4096;

/// A point of a line as `stroke.wgsl` reads it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct InkPoint {
    /// Canvas position.
    pub position: Vec2,
    /// Half the line's width in canvas units; negative between strokes.
    pub radius: f32,
    /// Encoded red, green, blue, and opacity.
    pub colour: [u8; 4],
}

impl InkPoint {
    const GAP: Self = Self { position: Vec2::ZERO, radius: -1.0, colour: [0; 4] };

    fn new(point: Vec3, colour: [u8; 4]) -> Self {
        Self { position: point.truncate(), radius: point.z, colour }
    }
}

/// Where a stroke lies. After its points come gaps up to its capacity, and one more.
#[derive(Clone, Debug)]
struct Slot {
    start: usize,
    len: usize,
    capacity: usize,
    colour: [u8; 4],
    /// The line through the samples that stay.
    curve: StrokeCurve,
    /// How many of the points are of that line; those after it are drawn anew when the stroke grows.
    settled: usize,
}

/// The new end of a line: points that take the place of all from the `keep`-th on. Kept, so that a sample allocates nothing.
#[derive(Clone, Debug, Default)]
struct LineEnd {
    keep: usize,
    points: Vec<InkPoint>,
    new: Vec<Vec3>,
}

impl LineEnd {
    /// Begins after the first `keep` points of a line.
    fn begin(&mut self, keep: usize) {
        self.keep = keep;
        self.points.clear();
    }

    fn draw(&mut self, curve: &mut StrokeCurve, samples: &[StrokePoint], colour: [u8; 4]) {
        for sample in samples {
            let replaced = curve.push(sample, &mut self.new);
            let of_these = replaced.min(self.points.len());
            self.points.truncate(self.points.len() - of_these);
            self.keep -= (replaced - of_these).min(self.keep);
            self.points.extend(self.new.drain(..).map(|point| InkPoint::new(point, colour)));
        }
    }

    /// Points of the whole line.
    fn len(&self) -> usize {
        self.keep + self.points.len()
    }
}

/// Where the strokes look different than before.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum InkChange {
    /// Nowhere.
    #[default]
    Nowhere,
    /// Between these corners of the canvas.
    Within(Vec2, Vec2),
    /// Perhaps everywhere.
    Anywhere,
}

impl InkChange {
    fn add(&mut self, point: &InkPoint) {
        if point.radius < 0.0 {
            return;
        }
        let (low, high) = (point.position - point.radius, point.position + point.radius);
        *self = match *self {
            Self::Nowhere => Self::Within(low, high),
            Self::Within(min, max) => Self::Within(min.min(low), max.max(high)),
            Self::Anywhere => Self::Anywhere,
        };
    }
}

/// The strokes of a drawing.
#[derive(Clone, Debug)]
pub struct InkBuffer {
    points: Vec<InkPoint>,
    slots: BTreeMap<StrokeId, Slot>,
    order: Vec<StrokeId>,
    dirty: Vec<Range<usize>>,
    change: InkChange,
    gaps: usize,
    end: LineEnd,
}

impl Default for InkBuffer {
    fn default() -> Self {
        Self {
            points: vec![InkPoint::GAP],
            slots: BTreeMap::new(),
            order: Vec::new(),
            dirty: std::iter::once(0..1).collect(),
            change: InkChange::Anywhere,
            gaps: 0,
            end: LineEnd::default(),
        }
    }
}

impl InkBuffer {
    /// All points in drawing order: a gap, then strokes with gaps between them and a gap at the end.
    pub fn points(&self) -> &[InkPoint] {
        &self.points
    }

    /// Ranges of [`InkBuffer::points`] that changed since the last call.
    pub fn take_dirty(&mut self) -> Vec<Range<usize>> {
        std::mem::take(&mut self.dirty)
    }

    /// Where the strokes look different than at the last call.
    pub fn take_change(&mut self) -> InkChange {
        std::mem::take(&mut self.change)
    }

    /// Counts everything as changed.
    pub(super) fn touch_all(&mut self) {
        self.dirty = std::iter::once(0..self.points.len()).collect();
    }

    /// Puts a stroke in, on top of all others, or replaces it in its place. `colour` is encoded red, green, blue and
    /// opacity; `width` is the line's width at full pressure in canvas units. A stroke may begin without samples.
    pub fn set(&mut self, id: StrokeId, samples: &[StrokePoint], colour: [u8; 4], width: f32) {
        if !self.slots.contains_key(&id) {
            let (start, curve) = (self.points.len(), StrokeCurve::new(width));
            self.points.push(InkPoint::GAP);
            self.slots.insert(id, Slot { start, len: 0, capacity: 0, colour, curve, settled: 0 });
            self.order.push(id);
        }
        if let Some(slot) = self.slots.get_mut(&id) {
            (slot.colour, slot.curve, slot.settled) = (colour, StrokeCurve::new(width), 0);
        }
        self.grow(id, samples, &[]);
    }

    /// Continues a stroke; `false` when there is none of this name. Samples that a stabiliser still moves are drawn until
    /// the next call, which names them again: `settled` and then `moving` follow on all that was settled before. The cost
    /// is that of these samples.
    pub fn grow(&mut self, id: StrokeId, settled: &[StrokePoint], moving: &[StrokePoint]) -> bool {
        let Some(slot) = self.slots.get_mut(&id) else { return false };
        let mut end = std::mem::take(&mut self.end);
        end.begin(slot.settled);
        end.draw(&mut slot.curve, settled, slot.colour);
        slot.settled = end.len();
        end.draw(&mut slot.curve.clone(), moving, slot.colour);
        self.replace(id, end.keep, &end.points);
        self.end = end;
        true
    }

    /// Gives a stroke another colour.
    pub fn recolour(&mut self, id: StrokeId, colour: [u8; 4]) {
        let Some(slot) = self.slots.get_mut(&id).filter(|slot| slot.colour != colour) else { return };
        slot.colour = colour;
        let range = slot.start..slot.start + slot.len;
        self.points[range.clone()].iter_mut().for_each(|p| p.colour = colour);
        self.see(range.clone());
        self.touch(range);
    }

    /// Takes a stroke out.
    pub fn remove(&mut self, id: StrokeId) {
        let Some(slot) = self.slots.remove(&id) else { return };
        self.order.retain(|other| *other != id);
        let range = slot.start..slot.start + slot.len;
        self.see(range.clone());
        self.points[range.clone()].fill(InkPoint::GAP);
        self.gaps += slot.capacity + 1;
        self.touch(range);
        if self.gaps > FEW_GAPS && 2 * self.gaps > self.points.len() {
            self.close_ranks();
        }
    }

    /// Takes every stroke out.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Draws strokes in this order, the last on top; strokes that are not named come above them as they were.
    pub fn set_order(&mut self, order: &[StrokeId]) {
        let mut placed = BTreeSet::new();
        let all = order.iter().chain(&self.order).copied();
        let order: Vec<StrokeId> =
            all.filter(|id| self.slots.contains_key(id) && placed.insert(*id)).collect();
        if order != self.order {
            self.change = InkChange::Anywhere;
            self.order = order;
            self.close_ranks();
        }
    }

    /// Replaces the points of a stroke from the `keep`-th on.
    fn replace(&mut self, id: StrokeId, keep: usize, points: &[InkPoint]) {
        let end_of_all = self.points.len();
        let Some(slot) = self.slots.get_mut(&id) else { return };
        // A piece looks at its neighbours, so the last one that stays looks different too.
        let (last_kept, old_end) = (slot.start + keep.saturating_sub(NEIGHBOURS), slot.start + slot.len);
        let change = &mut self.change;
        self.points[last_kept..old_end].iter().chain(points).for_each(|point| change.add(point));
        let (first, old_len) = (slot.start + keep, slot.len);
        let len = keep + points.len();
        if slot.start + slot.capacity + 1 == end_of_all {
            self.points.truncate(first);
            self.points.extend_from_slice(points);
            self.points.push(InkPoint::GAP);
            (slot.len, slot.capacity) = (len, len);
            let end = self.points.len();
            self.touch(first..end);
        } else if len <= slot.capacity {
            slot.len = len;
            let end = slot.start + len.max(old_len);
            self.points[first..first + points.len()].copy_from_slice(points);
            self.points[first + points.len()..end.max(first + points.len())].fill(InkPoint::GAP);
            self.touch(first..end);
        } else {
            // Room to grow in place; the others move up.
            let room = 2 * len + 64;
            let at = slot.start;
            let grown: Vec<InkPoint> = self.points[at..at + keep].iter().chain(points).copied().collect();
            slot.len = len;
            let extra = room - slot.capacity;
            let old_end = at + slot.capacity;
            slot.capacity = room;
            self.points.splice(old_end..old_end, std::iter::repeat_n(InkPoint::GAP, extra));
            self.points[at..at + len].copy_from_slice(&grown);
            self.slots.values_mut().filter(|other| other.start > at).for_each(|other| other.start += extra);
            let end = self.points.len();
            self.touch(at..end);
        }
    }

    /// Lays all strokes out afresh, in order and without spare gaps.
    fn close_ranks(&mut self) {
        let mut points = Vec::with_capacity(self.points.len());
        points.push(InkPoint::GAP);
        for id in &self.order {
            if let Some(slot) = self.slots.get_mut(id) {
                let start = points.len();
                points.extend_from_slice(&self.points[slot.start..slot.start + slot.len]);
                points.push(InkPoint::GAP);
                (slot.start, slot.capacity) = (start, slot.len);
            }
        }
        self.points = points;
        self.gaps = 0;
        self.touch_all();
    }

    /// Notes that points look different.
    fn see(&mut self, range: Range<usize>) {
        let change = &mut self.change;
        self.points[range].iter().for_each(|point| change.add(point));
    }

    fn touch(&mut self, range: Range<usize>) {
        match self.dirty.last_mut() {
            Some(last) if last.start <= range.end && range.start <= last.end => {
                *last = last.start.min(range.start)..last.end.max(range.end);
            }
            _ if range.is_empty() => {}
            _ => self.dirty.push(range),
        }
        if self.dirty.len() > MOST_RANGES {
            let start = self.dirty.iter().map(|r| r.start).min().unwrap_or(0);
            let end = self.dirty.iter().map(|r| r.end).max().unwrap_or(0);
            self.dirty = std::iter::once(start..end).collect();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::curve::line;
    use super::*;

    const BLACK: [u8; 4] = [0, 0, 0, 255];

    fn wave(count: usize, y: f32) -> Vec<StrokePoint> {
        let at = |i: usize| Vec2::new(9.0 * i as f32, y + 20.0 * (i as f32).sin());
        (0..count).map(|i| StrokePoint::at(at(i))).collect()
    }

    /// The lines between gaps, as positions.
    fn lines(ink: &InkBuffer) -> Vec<Vec<Vec2>> {
        assert!(ink.points[0].radius < 0.0 && ink.points[ink.points.len() - 1].radius < 0.0);
        let split = ink.points.split(|p| p.radius < 0.0).filter(|line| !line.is_empty());
        split.map(|line| line.iter().map(|p| p.position).collect()).collect()
    }

    fn expected(samples: &[StrokePoint]) -> Vec<Vec2> {
        line(samples, 3.0).iter().map(|p| p.truncate()).collect()
    }

    #[test]
    fn sample_by_sample_is_the_same_as_at_once() {
        let samples = wave(40, 0.0);
        let mut at_once = InkBuffer::default();
        at_once.set(7, &samples, BLACK, 3.0);
        let mut grown = InkBuffer::default();
        grown.set(7, &samples[..1], BLACK, 3.0);
        for sample in &samples[1..] {
            assert!(grown.grow(7, std::slice::from_ref(sample), &[]));
        }
        assert_eq!(at_once.points, grown.points);
        assert!(!grown.grow(8, &samples, &[]));
    }

    #[test]
    fn samples_that_still_move_are_drawn_where_they_are_now() {
        let (samples, reach) = (wave(60, 0.0), 16);
        let mut grown = InkBuffer::default();
        grown.set(7, &[], BLACK, 3.0);
        let mut seen = 0;
        for count in 1..=samples.len() {
            // The last samples are elsewhere until they have settled.
            let mut moving = samples[..count].to_vec();
            let settled = count.saturating_sub(reach);
            moving[settled..].iter_mut().for_each(|p| p.position.y += (count - settled) as f32);
            grown.grow(7, &moving[seen..settled], &moving[settled..]);
            seen = settled;
            assert_eq!(lines(&grown), [expected(&moving)], "after {count}");
        }
        grown.grow(7, &samples[seen..], &[]);
        assert_eq!(lines(&grown), [expected(&samples)]);
    }

    #[test]
    fn one_more_sample_costs_one_more_sample() {
        let mut ink = InkBuffer::default();
        for id in 0..500 {
            ink.set(id, &wave(100, id as f32), BLACK, 3.0);
        }
        ink.take_dirty();
        for sample in wave(300, 3.0) {
            ink.grow(499, &[sample], &[]);
            let dirty: usize = ink.take_dirty().iter().map(Range::len).sum();
            assert!(dirty <= 70, "{dirty} of {} points", ink.points.len());
        }
    }

    #[test]
    fn strokes_come_change_and_go_without_touching_others() {
        let mut ink = InkBuffer::default();
        let strokes: Vec<_> = (0..5).map(|i| wave(10 + i, 50.0 * i as f32)).collect();
        for (id, stroke) in (0..).zip(&strokes) {
            ink.set(id, stroke, BLACK, 3.0);
        }
        let all: Vec<_> = strokes.iter().map(|s| expected(s)).collect();
        assert_eq!(lines(&ink), all);
        ink.remove(1);
        ink.set(2, &strokes[2][..4], BLACK, 3.0);
        assert_eq!(lines(&ink), [&all[0], &expected(&strokes[2][..4]), &all[3], &all[4]].map(Clone::clone));
        ink.set(0, &strokes[4], BLACK, 3.0);
        ink.grow(2, &strokes[2][4..], &[]);
        assert_eq!(lines(&ink), [&all[4], &all[2], &all[3], &all[4]].map(Clone::clone));
        ink.set_order(&[4, 2, 99, 4]);
        assert_eq!(lines(&ink), [&all[4], &all[2], &all[4], &all[3]].map(Clone::clone));
        ink.clear();
        assert_eq!(lines(&ink), Vec::<Vec<Vec2>>::new());
    }

    #[test]
    fn what_is_dirty_brings_a_copy_up_to_date() {
        let mut ink = InkBuffer::default();
        let mut copy: Vec<InkPoint> = Vec::new();
        let mut random = 1_u64;
        for step in 0..600 {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let (what, id) = ((random >> 33) % 6, (random >> 40) % 9);
            match what {
                0 | 1 => ink.set(id, &wave(1 + (random >> 50) as usize % 30, id as f32), BLACK, 3.0),
                2 => drop(ink.grow(id, &wave(3, step as f32), &wave(step % 3, 1.0))),
                3 => ink.remove(id),
                4 => ink.recolour(id, [id as u8, step as u8, 0, 255]),
                _ => ink.set_order(&[id, (id + 3) % 9]),
            }
            copy.resize(ink.points.len(), InkPoint::zeroed());
            for range in ink.take_dirty() {
                let range = range.start.min(copy.len())..range.end.min(copy.len());
                copy[range.clone()].copy_from_slice(&ink.points[range]);
            }
            assert_eq!(copy, ink.points, "step {step}");
        }
    }

    #[test]
    fn what_looks_different_is_reported_and_no_more() {
        let mut ink = InkBuffer::default();
        let (long, other) = (wave(400, 0.0), wave(20, 900.0));
        ink.set(1, &other, BLACK, 3.0);
        ink.set(2, &long[..399], BLACK, 3.0);
        assert_eq!(ink.take_change(), InkChange::Anywhere, "at first");
        assert_eq!(ink.take_change(), InkChange::Nowhere);
        ink.grow(2, &long[399..], &[]);
        let InkChange::Within(low, high) = ink.take_change() else { panic!("something changed") };
        let last = long[399].position;
        assert!(low.cmple(last).all() && high.cmpge(last).all() && high.x - low.x < 40.0, "{low} {high}");
        ink.recolour(1, [9; 4]);
        let InkChange::Within(low, high) = ink.take_change() else { panic!("something changed") };
        assert!(low.y > 800.0 && low.x < 0.0 && high.x > 9.0 * 19.0, "{low} {high}");
        ink.set_order(&[2, 1]);
        assert_eq!(ink.take_change(), InkChange::Anywhere);
    }

    #[test]
    fn removing_much_gives_the_room_back() {
        let mut ink = InkBuffer::default();
        for id in 0..200 {
            ink.set(id, &wave(100, 0.0), BLACK, 3.0);
        }
        let full = ink.points.len();
        (0..190).for_each(|id| ink.remove(id));
        assert!(ink.points.len() < full / 4, "{} of {full}", ink.points.len());
        assert_eq!(lines(&ink).len(), 10);
    }
}
