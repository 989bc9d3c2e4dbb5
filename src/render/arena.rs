//! Places in a buffer: which ranges of a growing array are taken, first fit.
//!
//! Free ranges are kept ordered and merged with their neighbours. Knows nothing of the GPU. Limits: first fit leaves
//! holes; whoever finds [`Arena::is_sparse`] true starts afresh.

use std::collections::BTreeMap;
use std::ops::Range;

/// Share of the used end that may be holes before the arena counts as sparse.
const SPARSE: u32 = 2;
/// Ends below this are never sparse.
const SMALL: u32 = 4096;

/// Taken and free ranges of an array.
#[derive(Clone, Debug, Default)]
pub(super) struct Arena {
    /// Length of each free range below the end, by its start.
    free: BTreeMap<u32, u32>,
    end: u32,
    taken: u32,
}

impl Arena {
    /// Takes a range of `len` places; the array must be at least [`Arena::end`] long afterwards.
    pub(super) fn take(&mut self, len: u32) -> Range<u32> {
        self.taken += len;
        let fit = self.free.iter().find(|(_, free)| **free >= len).map(|(start, free)| (*start, *free));
        if let Some((start, free)) = fit {
            self.free.remove(&start);
            if free > len {
                self.free.insert(start + len, free - len);
            }
            return start..start + len;
        }
        let start = self.end;
        self.end = self.end.saturating_add(len);
        start..self.end
    }

    /// Whether a range of `len` places can be taken without going beyond `end` places in all.
    pub(super) fn has_room(&self, len: u32, end: u32) -> bool {
        self.end.checked_add(len).is_some_and(|after| after <= end)
            || self.free.values().any(|free| *free >= len)
    }

    /// Gives a taken range back.
    pub(super) fn give_back(&mut self, range: &Range<u32>) {
        let (mut start, mut end) = (range.start, range.end);
        self.taken -= end - start;
        if start == end {
            return;
        }
        if let Some((&before, &len)) = self.free.range(..start).next_back()
            && before + len == start
        {
            self.free.remove(&before);
            start = before;
        }
        if let Some(len) = self.free.remove(&end) {
            end += len;
        }
        if end == self.end {
            self.end = start;
        } else {
            self.free.insert(start, end - start);
        }
    }

    /// One past the last taken place.
    pub(super) fn end(&self) -> u32 {
        self.end
    }

    /// Whether more than half of what lies below the end is holes.
    pub(super) fn is_sparse(&self) -> bool {
        self.end > SMALL && self.taken < self.end / SPARSE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_never_overlap_and_holes_are_used_again() {
        let mut arena = Arena::default();
        let a = arena.take(10);
        let b = arena.take(5);
        let c = arena.take(7);
        assert_eq!((a.clone(), b.clone(), c.clone()), (0..10, 10..15, 15..22));
        arena.give_back(&b);
        assert_eq!(arena.take(3), 10..13);
        assert_eq!(arena.take(3), 22..25, "the rest of the hole is too small");
        arena.give_back(&a);
        assert_eq!(arena.take(10), a);
    }

    #[test]
    fn neighbouring_holes_merge_and_the_end_comes_back() {
        let mut arena = Arena::default();
        let ranges: Vec<_> = (0..4).map(|_| arena.take(10)).collect();
        arena.give_back(&ranges[1]);
        arena.give_back(&ranges[2]);
        assert_eq!(arena.free, BTreeMap::from([(10, 20)]));
        arena.give_back(&ranges[3]);
        assert_eq!((arena.end(), arena.free.len()), (10, 0));
        arena.give_back(&ranges[0]);
        assert_eq!(arena.end(), 0);
    }

    #[test]
    fn an_arena_of_holes_is_sparse() {
        let mut arena = Arena::default();
        let ranges: Vec<_> = (0..100).map(|_| arena.take(100)).collect();
        assert!(!arena.is_sparse());
        ranges[..60].iter().for_each(|r| arena.give_back(r));
        assert!(arena.is_sparse());
    }

    #[test]
    fn room_is_a_hole_or_what_is_left_behind_the_end() {
        let mut arena = Arena::default();
        let first = arena.take(10);
        arena.take(10);
        assert!(arena.has_room(5, 25) && !arena.has_room(6, 25) && !arena.has_room(u32::MAX, u32::MAX));
        arena.give_back(&first);
        assert!(arena.has_room(10, 20) && !arena.has_room(11, 20));
    }

    #[test]
    fn empty_ranges_cost_nothing() {
        let mut arena = Arena::default();
        let none = arena.take(0);
        arena.give_back(&none);
        assert_eq!(arena.end(), 0);
    }
}
