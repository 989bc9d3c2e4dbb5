//! Bounding volume hierarchy: the pairs of a set of boxes that overlap.
//!
//! Boxes are halved again and again by their middles along the widest axis into a tree; two branches of the tree are
//! compared only where their bounds touch. Near-linear for any mixture of sizes as long as few boxes meet, and as many
//! steps as there are pairs where many do: [`overlapping_within`] ends at a number of steps, the same on any number of threads.

use glam::Vec3;
use std::sync::atomic::{AtomicU64, Ordering};

/// A box: its least and its largest corner.
pub type Bounds = (Vec3, Vec3);

/// Most boxes of a leaf.
const LEAF: usize = 8;
/// Boxes from which halves are worth a thread of their own.
const THREAD: usize = 4096;

/// What `of` makes of every two boxes that touch, the earlier first, in no particular order; nothing if more than `most` pairs of
/// boxes, and of groups of boxes, would have to be compared.
pub fn overlapping_within<T: Send>(
    most: u64,
    boxes: &[Bounds],
    of: impl Fn(usize, usize) -> Option<T> + Sync,
) -> Option<Vec<T>> {
    let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut nodes = Vec::with_capacity(4 * boxes.len() / LEAF + 1);
    if !boxes.is_empty() {
        halve(boxes, &mut order, 0, &mut nodes);
    }
    let search = Search { boxes, order: &order, nodes: &nodes, of: &of, most, steps: AtomicU64::new(0) };
    let mut found = Vec::new();
    if !nodes.is_empty() {
        search.within(0, &mut found);
    }
    (search.steps.into_inner() <= most).then_some(found)
}

/// Some boxes of the order, and where their second half stands; the first half stands right after the node itself.
struct Node {
    bounds: Bounds,
    range: (u32, u32),
    /// The node of the second half; 0 for a leaf.
    second: u32,
}

fn around(a: Bounds, b: Bounds) -> Bounds {
    (a.0.min(b.0), a.1.max(b.1))
}

fn touch(a: &Bounds, b: &Bounds) -> bool {
    a.0.cmple(b.1).all() && b.0.cmple(a.1).all()
}

/// Appends the node of a part of the order, which begins at `first`, and all below it.
fn halve(boxes: &[Bounds], order: &mut [u32], first: u32, nodes: &mut Vec<Node>) {
    let bounds = order.iter().map(|k| boxes[*k as usize]).reduce(around).unwrap_or_default();
    let (place, count) = (nodes.len(), order.len());
    nodes.push(Node { bounds, range: (first, first + count as u32), second: 0 });
    if count <= LEAF {
        return;
    }
    let extent = bounds.1 - bounds.0;
    let axis = (0..3).max_by(|a, b| extent[*a].total_cmp(&extent[*b])).unwrap_or(0);
    let middle = |k: &u32| boxes[*k as usize].0[axis] + boxes[*k as usize].1[axis];
    order.select_nth_unstable_by(count / 2, |a, b| middle(a).total_cmp(&middle(b)));
    let (low, high) = order.split_at_mut(count / 2);
    halve(boxes, low, first, nodes);
    nodes[place].second = nodes.len() as u32;
    halve(boxes, high, first + low.len() as u32, nodes);
}

struct Search<'a, F> {
    boxes: &'a [Bounds],
    order: &'a [u32],
    nodes: &'a [Node],
    of: &'a F,
    /// Steps that may be taken, and those that were.
    most: u64,
    steps: AtomicU64,
}

impl<F> Search<'_, F> {
    /// Takes so many steps; whether there were that many left. All steps of a search that ends by itself are counted, in
    /// whatever order, so that it ends by itself on any number of threads or on none.
    fn step(&self, count: usize) -> bool {
        let count = count as u64;
        self.steps.fetch_add(count, Ordering::Relaxed).saturating_add(count) <= self.most
    }

    fn boxes_of(&self, node: &Node) -> &[u32] {
        &self.order[node.range.0 as usize..node.range.1 as usize]
    }

    /// Pairs inside one node.
    fn within<T: Send>(&self, node: usize, found: &mut Vec<T>)
    where
        F: Fn(usize, usize) -> Option<T> + Sync,
    {
        let this = &self.nodes[node];
        if this.second == 0 {
            let own = self.boxes_of(this);
            if !self.step(own.len() * own.len() / 2) {
                return;
            }
            for (k, a) in own.iter().enumerate() {
                own[k + 1..].iter().for_each(|b| self.meet(*a, *b, found));
            }
            return;
        }
        let (first, second) = (node + 1, this.second as usize);
        self.both(
            this,
            (|s: &Self, f: &mut Vec<T>| s.within(first, f), |s: &Self, f: &mut Vec<T>| s.within(second, f)),
            found,
        );
        self.between(first, second, found);
    }

    /// Pairs of a box of one node and one of another.
    fn between<T: Send>(&self, a: usize, b: usize, found: &mut Vec<T>)
    where
        F: Fn(usize, usize) -> Option<T> + Sync,
    {
        let (of_a, of_b) = (&self.nodes[a], &self.nodes[b]);
        if !touch(&of_a.bounds, &of_b.bounds) || !self.step(1) {
            return;
        }
        let size = |node: &Node| if node.second == 0 { 0 } else { node.range.1 - node.range.0 };
        if size(of_a).max(size(of_b)) == 0 {
            if !self.step(self.boxes_of(of_a).len() * self.boxes_of(of_b).len()) {
                return;
            }
            for one in self.boxes_of(of_a) {
                self.boxes_of(of_b).iter().for_each(|other| self.meet(*one, *other, found));
            }
            return;
        }
        let (whole, halved) = if size(of_a) > size(of_b) { (b, a) } else { (a, b) };
        let this = &self.nodes[halved];
        let (first, second) = (halved + 1, this.second as usize);
        self.both(
            this,
            (
                |s: &Self, f: &mut Vec<T>| s.between(whole, first, f),
                |s: &Self, f: &mut Vec<T>| s.between(whole, second, f),
            ),
            found,
        );
    }

    /// Searches both halves of a node, at once if it is large.
    fn both<T: Send>(
        &self,
        node: &Node,
        (first, second): (impl FnOnce(&Self, &mut Vec<T>) + Send, impl FnOnce(&Self, &mut Vec<T>) + Send),
        found: &mut Vec<T>,
    ) where
        F: Sync,
    {
        if (node.range.1 - node.range.0) as usize > THREAD {
            let mut more = Vec::new();
            rayon::join(|| first(self, found), || second(self, &mut more));
            found.append(&mut more);
        } else {
            first(self, found);
            second(self, found);
        }
    }

    fn meet<T>(&self, a: u32, b: u32, found: &mut Vec<T>)
    where
        F: Fn(usize, usize) -> Option<T>,
    {
        let (a, b) = (a.min(b) as usize, a.max(b) as usize);
        if touch(&self.boxes[a], &self.boxes[b]) {
            found.extend((self.of)(a, b));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    fn overlapping<T: Send>(boxes: &[Bounds], of: impl Fn(usize, usize) -> Option<T> + Sync) -> Vec<T> {
        overlapping_within(u64::MAX, boxes, of).unwrap()
    }

    #[test]
    fn every_two_boxes_that_touch_are_found_once() {
        let mut random = Pcg64Mcg::seed_from_u64(3);
        for count in [0, 1, 2, 9, 300, 6000] {
            let mut one = |span: f32| {
                let at = Vec3::from_array(std::array::from_fn(|_| random.random_range(0.0..span)));
                // Small ones and a few very large ones.
                let side = if random.random_range(0..50) == 0 { 20.0 } else { 0.4 };
                (at, at + Vec3::from_array(std::array::from_fn(|_| random.random_range(0.0..side))))
            };
            let boxes: Vec<Bounds> = (0..count).map(|_| one(30.0)).collect();
            let mut found = overlapping(&boxes, |a, b| Some((a, b)));
            found.sort_unstable();
            let all = |a: usize| (a + 1..count).map(move |b| (a, b));
            let expected: Vec<_> =
                (0..count).flat_map(all).filter(|(a, b)| touch(&boxes[*a], &boxes[*b])).collect();
            assert!(found == expected, "{count} boxes: {} pairs, not {}", found.len(), expected.len());
        }
    }

    #[test]
    fn a_search_ends_at_its_steps() {
        let boxes = vec![(Vec3::ZERO, Vec3::ONE); 500];
        let steps = |most| overlapping_within(most, &boxes, |_, _| Some(())).map(|found| found.len());
        assert_eq!(steps(200_000), Some(500 * 499 / 2));
        assert_eq!(steps(50_000), None);
        let many = vec![(Vec3::ZERO, Vec3::ONE); 100_000];
        assert!(overlapping_within(1_000_000, &many, |_, _| None::<()>).is_none());
    }

    #[test]
    fn boxes_in_one_spot_end_too() {
        let boxes = vec![(Vec3::ZERO, Vec3::ONE); 500];
        assert_eq!(overlapping(&boxes, |_, _| Some(())).len(), 500 * 499 / 2);
    }
}
