//! Where the pieces of strokes lie, so that a small place of the canvas is painted with the few that may be seen there.
//!
//! Pieces are taken together in the order in which they are drawn, 64 at a time: a stroke's pieces follow each other, so a
//! block is compact, and a drawing of half a million points has eight thousand. Blocks are brought up to date with the
//! points that changed. Knows no GPU.

use super::InkPoint;
use glam::Vec2;
use std::ops::Range;

/// Pieces of a block.
const BLOCK: usize = 64;
/// From a piece's number to the numbers of the points that it lies between: the first of its four points is a neighbour.
const BEGIN: usize = 1;
const END: usize = 2;

/// Canvas corners, smallest and largest, around the middles of lines.
pub(super) type Bounds = (Vec2, Vec2);

#[derive(Clone, Copy, Debug)]
struct Block {
    bounds: Bounds,
    /// Largest radius of its lines, canvas units.
    radius: f32,
}

/// The blocks of a drawing.
#[derive(Debug, Default)]
pub(super) struct Blocks {
    blocks: Vec<Block>,
}

impl Blocks {
    /// Follows a change of points.
    pub(super) fn update(&mut self, points: &[InkPoint], changed: Range<usize>) {
        let count = points.len().saturating_sub(END).div_ceil(BLOCK);
        self.blocks.resize(count, Block::of(&[]));
        let (first, end) =
            (changed.start.saturating_sub(END) / BLOCK, changed.end.div_ceil(BLOCK).min(count));
        for b in first..end {
            let last = ((b + 1) * BLOCK + END).min(points.len());
            self.blocks[b] = Block::of(&points[b * BLOCK + BEGIN..last]);
        }
    }

    /// Ranges of pieces, of the first `pieces`, that may be seen between two corners of the canvas; lines are `scale` times as
    /// wide as their points say and `edge` canvas units beyond.
    pub(super) fn within(
        &self,
        pieces: usize,
        (low, high): Bounds,
        scale: f32,
        edge: f32,
    ) -> Vec<Range<usize>> {
        let mut ranges: Vec<Range<usize>> = Vec::new();
        for (b, block) in self.blocks.iter().enumerate() {
            let reach = Vec2::splat(block.radius * scale + edge);
            let (from, to) = block.bounds;
            if (from - reach).cmpgt(high).any() || (to + reach).cmplt(low).any() {
                continue;
            }
            let range = b * BLOCK..((b + 1) * BLOCK).min(pieces);
            match ranges.last_mut().filter(|last| last.end == range.start) {
                Some(last) => last.end = range.end,
                None if range.is_empty() => {}
                None => ranges.push(range),
            }
        }
        ranges
    }
}

impl Block {
    /// The block of pieces between these points; gaps between strokes have no place.
    fn of(points: &[InkPoint]) -> Self {
        let nothing = Self { bounds: (Vec2::INFINITY, Vec2::NEG_INFINITY), radius: 0.0 };
        points.iter().filter(|point| point.radius >= 0.0).fold(nothing, |block, point| Self {
            bounds: (block.bounds.0.min(point.position), block.bounds.1.max(point.position)),
            radius: block.radius.max(point.radius),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row of points one unit apart, a gap after every hundred.
    fn row(count: usize) -> Vec<InkPoint> {
        let gap = |i: usize| i.is_multiple_of(100);
        let point = |i: usize| InkPoint {
            position: Vec2::new(i as f32, 0.0),
            radius: if gap(i) { -1.0 } else { 0.5 },
            colour: [0; 4],
        };
        (0..count).map(point).collect()
    }

    fn blocks(points: &[InkPoint]) -> Blocks {
        let mut blocks = Blocks::default();
        blocks.update(points, 0..points.len());
        blocks
    }

    /// The pieces that a place shows, looked at one by one.
    fn seen(points: &[InkPoint], (low, high): Bounds, reach: f32) -> Vec<usize> {
        let is_seen = |i: &usize| {
            let (a, b) = (points[i + BEGIN], points[i + END]);
            let (from, to) = (a.position.min(b.position), a.position.max(b.position));
            let apart = (from - reach).cmpgt(high).any() || (to + reach).cmplt(low).any();
            a.radius >= 0.0 && b.radius >= 0.0 && !apart
        };
        (0..points.len() - 3).filter(is_seen).collect()
    }

    #[test]
    fn every_piece_that_is_seen_is_in_a_range_and_few_others_are() {
        let points = row(5000);
        let (blocks, pieces) = (blocks(&points), points.len() - 3);
        for start in [-10.0, 0.0, 63.0, 64.5, 1000.0, 4990.0] {
            let place = (Vec2::new(start, -1.0), Vec2::new(start + 20.0, 1.0));
            let ranges = blocks.within(pieces, place, 1.0, 0.0);
            let all = seen(&points, place, 0.5);
            assert!(!all.is_empty() && all.iter().all(|i| ranges.iter().any(|range| range.contains(i))));
            assert!(ranges.iter().map(ExactSizeIterator::len).sum::<usize>() <= 3 * BLOCK);
        }
        let beside = (Vec2::new(0.0, 2.0), Vec2::new(5000.0, 3.0));
        assert!(blocks.within(pieces, beside, 1.0, 0.0).is_empty());
        assert_eq!(blocks.within(pieces, beside, 4.0, 0.0).len(), 1, "wide lines reach there");
        assert_eq!(blocks.within(pieces, beside, 1.0, 2.0).len(), 1);
    }

    #[test]
    fn blocks_follow_what_changes() {
        let mut points = row(1000);
        let mut kept = blocks(&points);
        for at in [1, 62, 63, 64, 65, 66, 128, 400, 997, 998] {
            points[at].position.y = 50.0;
            kept.update(&points, at..at + 1);
            let fresh = blocks(&points);
            let place = (Vec2::new(at as f32 - 0.2, 40.0), Vec2::new(at as f32 + 0.2, 60.0));
            let ranges = kept.within(points.len() - 3, place, 1.0, 0.0);
            assert_eq!(ranges, fresh.within(points.len() - 3, place, 1.0, 0.0));
            assert!(seen(&points, place, 0.5).iter().all(|i| ranges.iter().any(|range| range.contains(i))));
        }
        points.truncate(130);
        kept.update(&points, 130..130);
        let everywhere = (Vec2::splat(-1e6), Vec2::splat(1e6));
        let ranges = kept.within(127, everywhere, 1.0, 0.0);
        assert_eq!((ranges.len(), ranges[0].clone()), (1, 0..127));
        kept.update(&[], 0..0);
        assert!(kept.within(0, everywhere, 1.0, 0.0).is_empty());
    }
}
