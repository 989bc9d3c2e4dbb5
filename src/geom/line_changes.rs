//! What changed in a list of lines, for those who keep answers about the lines near a place.
//!
//! An answer of a [`SegmentIndex`](super::segment_index::SegmentIndex) depends on the lines whose boxes come within its radius,
//! and where several are equally near on their order. So it stands while none of those lines came or went and the others kept
//! their order; only their numbers may be others.

use super::segment_index::Line;
use crate::kept::Window;
use glam::Vec2;
use std::collections::HashMap;
use std::sync::Arc;

/// Most lines that may have come or gone for answers to be kept: each is held against all answers.
const MOST_CHANGES: usize = 128;

/// How one list of lines became another.
#[derive(Debug)]
pub struct LineChanges {
    /// For every line of the new list its number in the old one.
    old: Vec<Option<usize>>,
    /// The other way round.
    new: Vec<Option<usize>>,
    /// Lines that came or went.
    changed: Vec<Arc<Line>>,
    /// Whether answers may be kept at all.
    is_small: bool,
}

impl LineChanges {
    /// Compares two lists, in which the same line is the same by its address.
    pub fn between(old: &[Arc<Line>], new: &[Arc<Line>]) -> Self {
        let Window { begin, end } = Window::between(old, new, Arc::ptr_eq);
        let (old_end, new_end) = (old.len() - end, new.len() - end);
        let numbers: HashMap<*const Line, usize> =
            (begin..old_end).map(|number| (Arc::as_ptr(&old[number]), number)).collect();
        let old_of = |number: usize| match number {
            number if number < begin => Some(number),
            number if number < new_end => numbers.get(&Arc::as_ptr(&new[number])).copied(),
            number => Some(number - new_end + old_end),
        };
        let old_of: Vec<Option<usize>> = (0..new.len()).map(old_of).collect();
        let mut new_of = vec![None; old.len()];
        for (number, old) in old_of.iter().enumerate() {
            if let Some(old) = old {
                new_of[*old] = Some(number);
            }
        }
        let came = (begin..new_end).filter(|number| old_of[*number].is_none()).map(|number| &new[number]);
        let went = (begin..old_end).filter(|number| new_of[*number].is_none()).map(|number| &old[number]);
        let changed: Vec<Arc<Line>> = came.chain(went).cloned().collect();
        let is_in_order = old_of.iter().flatten().is_sorted_by(|a, b| a < b);
        let is_small = is_in_order && changed.len() <= MOST_CHANGES;
        Self { old: old_of, new: new_of, changed, is_small }
    }

    /// The old number of a line; `None` for one that came, and for all where too much changed.
    pub fn old_number(&self, new: usize) -> Option<usize> {
        self.old.get(new).copied().flatten().filter(|_| self.is_small)
    }

    /// The new number of a line; `None` for one that went.
    pub fn new_number(&self, old: usize) -> Option<usize> {
        self.new.get(old).copied().flatten()
    }

    /// Whether an answer about lines within `radius` of a place may be another than it was.
    pub fn may_matter(&self, place: Vec2, radius: f32) -> bool {
        !self.is_small || self.changed.iter().any(|line| line.may_be_within(place, radius))
    }

    /// Whether all answers may be others than they were.
    pub fn is_everything(&self) -> bool {
        !self.is_small
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(x: f32) -> Arc<Line> {
        Arc::new(Line::new([Vec2::new(x, 0.0), Vec2::new(x, 1.0)].into_iter()))
    }

    #[test]
    fn what_comes_and_goes_matters_near_it() {
        let lines: Vec<Arc<Line>> = (0..6).map(|k| line(10.0 * k as f32)).collect();
        let mut new = lines.clone();
        new.remove(1);
        new.insert(3, line(35.0));
        let changes = LineChanges::between(&lines, &new);
        let old: Vec<Option<usize>> = (0..6).map(|k| changes.old_number(k)).collect();
        assert_eq!(old, [Some(0), Some(2), Some(3), None, Some(4), Some(5)]);
        assert_eq!((changes.new_number(1), changes.new_number(4)), (None, Some(4)));
        let matters = |x: f32| changes.may_matter(Vec2::new(x, 0.5), 2.0);
        assert_eq!([0.0, 9.0, 20.0, 34.0, 50.0].map(matters), [false, true, false, true, false]);
        new.swap(0, 1);
        let changes = LineChanges::between(&lines, &new);
        assert!(changes.is_everything() && changes.may_matter(Vec2::ZERO, 0.0));
        assert_eq!(changes.old_number(0), None);
    }
}
