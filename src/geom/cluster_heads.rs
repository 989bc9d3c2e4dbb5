//! Which points are one cluster, from where they climbed to: each joins the first earlier cluster whose first point, its head,
//! has a mode near enough; else it heads a cluster of its own.
//!
//! Whom a point joins depends on the heads before it and near it, and on no others. So from one set of points to the next only
//! those are asked again near which a point came, went, moved, or began or ceased to head a cluster, one after the other in
//! their order. Each of these costs a look at all points; where they are many, all are named anew through an R-tree.

use crate::kept::Window;
use glam::Vec2;
use rstar::{RTree, primitives::GeomWithData};
use std::collections::BTreeSet;

/// Most points that are asked one by one.
const MOST_ASKED: usize = 96;

/// The cluster of every point by the number of its head.
#[derive(Debug, Default)]
pub(super) struct Heads {
    modes: Vec<(Vec2, f32)>,
    merge: f32,
    head: Vec<usize>,
}

/// Whether two modes, each with its bandwidth, are one cluster.
fn are_near(a: (Vec2, f32), b: (Vec2, f32), merge: f32) -> bool {
    let reach = merge * a.1.min(b.1);
    a.0.distance_squared(b.0) <= reach * reach
}

impl Heads {
    /// Takes in a new set of modes with their bandwidths; outside of the window they belong to the same points as in the last
    /// one.
    pub(super) fn follow(&mut self, window: Window, modes: &[Vec2], bandwidth: &[f32], merge: f32) {
        let modes: Vec<(Vec2, f32)> = modes.iter().copied().zip(bandwidth.iter().copied()).collect();
        let old = std::mem::replace(self, Self { modes, merge, head: Vec::new() });
        let is_related = merge == old.merge && !old.head.is_empty();
        self.head = is_related.then(|| self.followed(&old, window)).flatten().unwrap_or_else(|| self.anew());
    }

    /// Cluster number of every point, counted from 0 in order of first appearance.
    pub(super) fn labels(&self) -> Vec<usize> {
        let mut labels = Vec::with_capacity(self.head.len());
        let mut clusters = 0;
        for (i, &head) in self.head.iter().enumerate() {
            labels.push(if head == i { clusters } else { labels[head] });
            clusters += usize::from(head == i);
        }
        labels
    }

    /// The head of every point.
    fn anew(&self) -> Vec<usize> {
        let mut heads: RTree<GeomWithData<[f32; 2], usize>> = RTree::new();
        let mut head = Vec::with_capacity(self.modes.len());
        for (i, &(mode, reach)) in self.modes.iter().enumerate() {
            let near = heads
                .locate_within_distance(mode.to_array(), (self.merge * reach).powi(2))
                .map(|head| head.data)
                .filter(|head| are_near((mode, reach), self.modes[*head], self.merge))
                .min();
            head.push(near.unwrap_or_else(|| {
                heads.insert(GeomWithData::new(mode.to_array(), i));
                i
            }));
        }
        head
    }

    /// The same from those of another set; `None` where too much is different.
    fn followed(&self, old: &Self, Window { begin, end }: Window) -> Option<Vec<usize>> {
        let (old_end, new_end) = (old.modes.len() - end, self.modes.len() - end);
        let old_of =
            |i: usize| (i < begin || i >= new_end).then(|| if i < begin { i } else { i - new_end + old_end });
        let is_same = |i: usize| old_of(i).is_some_and(|old_i| old.modes[old_i] == self.modes[i]);
        let changed: Vec<usize> = (0..self.modes.len()).filter(|i| !is_same(*i)).collect();
        let unchanged_now = |old_i: usize| {
            let i = if old_i < begin { old_i } else { (old_i + new_end).checked_sub(old_end)? };
            ((old_i < begin || old_i >= old_end) && is_same(i)).then_some(i)
        };
        let gone: Vec<usize> =
            (0..old.modes.len()).filter(|i| old.head[*i] == *i && unchanged_now(*i).is_none()).collect();
        if changed.len() + gone.len() > MOST_ASKED {
            return None;
        }
        let near =
            |to: (Vec2, f32)| (0..self.modes.len()).filter(move |i| are_near(self.modes[*i], to, self.merge));
        let mut asked: BTreeSet<usize> = changed.into_iter().collect();
        gone.iter().for_each(|i| asked.extend(near(old.modes[*i])));
        // Heads that are gone are those of points that will be asked.
        let taken = |i: usize| old_of(i).and_then(|i| unchanged_now(old.head[i])).unwrap_or(usize::MAX);
        let mut head: Vec<usize> = (0..self.modes.len()).map(taken).collect();
        let mut count = 0;
        while let Some(i) = asked.pop_first() {
            count += 1;
            if count > MOST_ASKED {
                return None;
            }
            let before =
                (0..i).find(|j| head[*j] == *j && are_near(self.modes[i], self.modes[*j], self.merge));
            let (was, is) = (is_same(i) && head[i] == i, before.is_none());
            head[i] = before.unwrap_or(i);
            if was != is {
                asked.extend(near(self.modes[i]).filter(|j| *j > i));
            }
        }
        Some(head)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn heads_that_are_followed_are_those_that_are_named_anew(
            places in prop::collection::vec((-12i8..12, -12i8..12, 1u8..12), 1..60),
            changes in prop::collection::vec((0usize..60, 0usize..60, 0u8..3), 1..12),
        ) {
            let mode = |&(x, y, h): &(i8, i8, u8)| (Vec2::new(x.into(), y.into()), 0.4 * f32::from(h));
            let mut heads = Heads::default();
            let mut held = places.clone();
            let mut last: Vec<(i8, i8, u8)> = Vec::new();
            for (at, other, what) in changes {
                let at = at % held.len().max(1);
                match what {
                    0 => held.insert(at, places[other % places.len()]),
                    1 if !held.is_empty() => drop(held.remove(at)),
                    // Moves without a trace in the window, as modes do.
                    _ if !held.is_empty() => held[at].0 = (held[at].0 + 1).min(12),
                    _ => {}
                }
                let (modes, reach): (Vec<Vec2>, Vec<f32>) = held.iter().map(mode).unzip();
                let window = Window::between(&last, &held, |a, b| (a.1, a.2) == (b.1, b.2));
                heads.follow(window, &modes, &reach, 0.7);
                prop_assert_eq!(&heads.head, &heads.anew());
                last = held.clone();
            }
        }
    }
}
