//! The nearest place of a closed outline.
//!
//! Consecutive edges lie near one another, so boxes around stretches of them, halved again and again, are a tree that needs
//! no sorting. A search goes into the nearer half first and leaves out every stretch whose box is farther than what was found:
//! on a hand-drawn outline it looks at a dozen edges. Of edges that are equally near the first found counts, which depends on
//! outline and place alone.

use glam::Vec2;

/// Edges of the shortest stretches.
const STRETCH: usize = 4;

/// How much farther, squared, a box must be than what was found to be left out: more than rounding makes of it.
const MARGIN: f32 = 1.0001;

/// The edges of a closed outline.
#[derive(Debug)]
pub(super) struct Boundary {
    edges: Vec<(Vec2, Vec2)>,
    /// Smallest and largest corner of every stretch: the children of `k` are `2k` and `2k + 1`, the root is 1. Where there is
    /// no edge the box is empty.
    boxes: Vec<(Vec2, Vec2)>,
}

/// The nearest place so far.
struct Found {
    place: Vec2,
    squared: f32,
}

impl Boundary {
    pub(super) fn new(edges: Vec<(Vec2, Vec2)>) -> Self {
        let leaves = edges.len().div_ceil(STRETCH).next_power_of_two();
        let mut boxes = vec![(Vec2::INFINITY, Vec2::NEG_INFINITY); 2 * leaves];
        for (stretch, held) in boxes[leaves..].iter_mut().zip(edges.chunks(STRETCH)) {
            for (a, b) in held {
                *stretch = (stretch.0.min(a.min(*b)), stretch.1.max(a.max(*b)));
            }
        }
        for k in (1..leaves).rev() {
            let (a, b) = (boxes[2 * k], boxes[2 * k + 1]);
            boxes[k] = (a.0.min(b.0), a.1.max(b.1));
        }
        Self { edges, boxes }
    }

    /// The place nearest to `p`; `None` without edges, or for a place that is nowhere.
    pub(super) fn nearest(&self, p: Vec2) -> Option<Vec2> {
        let mut found = Found { place: p, squared: f32::INFINITY };
        self.search(1, p, &mut found);
        found.squared.is_finite().then_some(found.place)
    }

    fn search(&self, stretch: usize, p: Vec2, found: &mut Found) {
        let leaves = self.boxes.len() / 2;
        if stretch >= leaves {
            let first = (stretch - leaves) * STRETCH;
            let held = self.edges.iter().skip(first).take(STRETCH);
            return held.for_each(|edge| found.take_nearer(nearest_on(*edge, p), p));
        }
        let away = |child: usize| {
            let (low, high) = self.boxes[child];
            (low - p).max(p - high).max(Vec2::ZERO).length_squared()
        };
        let (first, second) = (2 * stretch, 2 * stretch + 1);
        let (a, b) = (away(first), away(second));
        let [near, far] = if b < a { [(second, b), (first, a)] } else { [(first, a), (second, b)] };
        for (child, squared) in [near, far] {
            if squared <= MARGIN * found.squared && squared < f32::INFINITY {
                self.search(child, p, found);
            }
        }
    }
}

impl Found {
    fn take_nearer(&mut self, place: Vec2, p: Vec2) {
        let squared = place.distance_squared(p);
        if squared < self.squared {
            *self = Self { place, squared };
        }
    }
}

/// The place of an edge nearest to `p`.
fn nearest_on((a, b): (Vec2, Vec2), p: Vec2) -> Vec2 {
    let along = b - a;
    let share = (p - a).dot(along) / along.length_squared();
    if share <= 0.0 {
        a
    } else if share < 1.0 {
        a + along * share
    } else {
        // Here, too, where the edge has no length.
        b
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn nothing_is_near_nothing() {
        assert_eq!(Boundary::new(Vec::new()).nearest(Vec2::ZERO), None);
        let dot = Boundary::new(vec![(Vec2::ONE, Vec2::ONE)]);
        assert_eq!((dot.nearest(Vec2::ZERO), dot.nearest(Vec2::NAN)), (Some(Vec2::ONE), None));
    }

    proptest! {
        #[test]
        fn halves_agree_with_looking_at_every_edge(
            corners in prop::collection::vec((-9.0f32..9.0, -9.0f32..9.0), 1..60),
            probe in (-20.0f32..20.0, -20.0f32..20.0),
        ) {
            let points: Vec<Vec2> = corners.into_iter().map(Vec2::from).collect();
            let p = Vec2::from(probe);
            let edges: Vec<(Vec2, Vec2)> =
                (0..points.len()).map(|k| (points[k], points[(k + 1) % points.len()])).collect();
            let least = edges.iter().map(|edge| nearest_on(*edge, p).distance_squared(p)).fold(f32::INFINITY, f32::min);
            let nearest = Boundary::new(edges).nearest(p).unwrap();
            prop_assert_eq!(nearest.distance_squared(p), least);
        }
    }
}
