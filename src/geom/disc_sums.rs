//! How many points lie in a disc, and where their middle is, without looking at each.
//!
//! A k-d tree whose nodes know the sum of their points: a node wholly inside the disc is counted at once. So a disc over
//! thousands of points in one spot costs no more than one over a few, which a list of neighbours would not allow.
//!
//! Sums are exact: points are rounded to multiples of a `unit` of which a sum of a million fits into a double. So what a
//! disc holds says all about its middle, whatever other points there are and however they lie in the tree.

use glam::{DVec2, Vec2};
use std::ops::Range;

/// Points that are looked at one by one.
const LEAF: usize = 12;

/// Questions from which a tree is worth its making.
const FEW_QUESTIONS: usize = 100;

/// Bits of a coordinate that are summed: more than a float has, and twenty less than a double has.
const BITS: i32 = 32;

/// What the coordinates of points are rounded to: a power of two.
pub fn unit(points: &[Vec2]) -> f64 {
    let most = points.iter().map(|p| p.abs().max_element()).fold(f32::MIN_POSITIVE, f32::max);
    2f64.powi(f64::from(most).log2().ceil() as i32 - BITS)
}

/// Points, ready to be summed over discs.
#[derive(Clone, Debug)]
pub struct DiscSums {
    points: Vec<Point>,
    nodes: Vec<Node>,
}

#[derive(Clone, Copy, Debug)]
struct Point {
    at: Vec2,
    /// The same, rounded to the unit.
    rounded: DVec2,
}

#[derive(Clone, Debug)]
struct Node {
    low: Vec2,
    high: Vec2,
    sum: DVec2,
    held: Range<usize>,
    /// Index of the second child; the first follows the node itself. None for a leaf.
    second: Option<usize>,
}

impl DiscSums {
    /// Takes finite points.
    pub fn new(points: Vec<Vec2>) -> Self {
        Self::for_questions(points, usize::MAX)
    }

    /// The same for about so many questions: for few of them all points stay one leaf, which has the same answers.
    pub fn for_questions(points: Vec<Vec2>, questions: usize) -> Self {
        let unit = unit(&points);
        let point = |at: Vec2| Point { at, rounded: (at.as_dvec2() / unit).round() * unit };
        let nodes = Vec::with_capacity(4 * points.len() / LEAF + 1);
        let mut sums = Self { points: points.into_iter().map(point).collect(), nodes };
        if !sums.points.is_empty() {
            let leaf = if questions < FEW_QUESTIONS { sums.points.len() } else { LEAF };
            sums.grow(0..sums.points.len(), leaf);
        }
        sums
    }

    /// Adds the node of a stretch of points and all below it.
    fn grow(&mut self, held: Range<usize>, leaf: usize) {
        let points = &mut self.points[held.clone()];
        let low = points.iter().map(|p| p.at).fold(Vec2::INFINITY, Vec2::min);
        let high = points.iter().map(|p| p.at).fold(Vec2::NEG_INFINITY, Vec2::max);
        let node = self.nodes.len();
        let sum = points.iter().map(|p| p.rounded).sum();
        self.nodes.push(Node { low, high, sum, held: held.clone(), second: None });
        if points.len() <= leaf {
            return;
        }
        let size = high - low;
        let along = if size.x >= size.y { Vec2::X } else { Vec2::Y };
        let middle = points.len() / 2;
        points.select_nth_unstable_by(middle, |a, b| a.at.dot(along).total_cmp(&b.at.dot(along)));
        let middle = held.start + middle;
        self.grow(held.start..middle, leaf);
        self.nodes[node].second = Some(self.nodes.len());
        self.grow(middle..held.end, leaf);
    }

    /// Middle of the points within `radius` of `center`; `None` where there are none.
    pub fn mean_within(&self, center: Vec2, radius: f32) -> Option<Vec2> {
        let (mut sum, mut count) = (DVec2::ZERO, 0);
        if !self.nodes.is_empty() {
            self.add(0, center, radius * radius, (&mut sum, &mut count));
        }
        (count > 0).then(|| (sum / count as f64).as_vec2())
    }

    fn add(&self, index: usize, center: Vec2, radius2: f32, (sum, count): (&mut DVec2, &mut usize)) {
        let node = &self.nodes[index];
        if center.distance_squared(center.clamp(node.low, node.high)) > radius2 {
            return;
        }
        let farthest = (center - node.low).max(node.high - center);
        if farthest.length_squared() <= radius2 {
            *sum += node.sum;
            *count += node.held.len();
        } else if let Some(second) = node.second {
            self.add(index + 1, center, radius2, (sum, count));
            self.add(second, center, radius2, (sum, count));
        } else {
            for point in &self.points[node.held.clone()] {
                if point.at.distance_squared(center) <= radius2 {
                    *sum += point.rounded;
                    *count += 1;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_a_disc_does_not_hold_does_not_change_its_middle() {
        let at = |k: usize| Vec2::from_angle(k as f32 * 2.4) * (k as f32).sqrt();
        let points: Vec<Vec2> = (0..2_000).map(at).collect();
        assert_eq!(unit(&points[..1_500]), unit(&points));
        let (some, all) = (DiscSums::new(points[..1_500].to_vec()), DiscSums::new(points));
        // The first 1,500 fill a disc of radius 38, the others a ring around it.
        for k in 0..200 {
            let center = at(5 * k);
            let radius = 38.0 - center.length();
            assert_eq!(some.mean_within(center, radius), all.mean_within(center, radius));
        }
    }

    #[test]
    fn nothing_has_no_middle() {
        assert_eq!(DiscSums::new(Vec::new()).mean_within(Vec2::ZERO, 9.0), None);
        assert_eq!(DiscSums::new(vec![Vec2::X]).mean_within(Vec2::ZERO, 0.9), None);
    }

    #[test]
    fn one_spot_is_one_look() {
        let sums = DiscSums::new(vec![Vec2::ONE; 10_000]);
        assert_eq!(sums.mean_within(Vec2::ZERO, 2.0), Some(Vec2::ONE));
    }

    proptest! {
        #[test]
        fn means_agree_with_looking_at_every_point(
            places in prop::collection::vec((-9i8..9, -9i8..9), 0..200),
            (x, y) in (-10.0f32..10.0, -10.0f32..10.0),
            radius in 0.1f32..15.0,
        ) {
            let points: Vec<Vec2> = places.into_iter().map(|(x, y)| Vec2::new(x.into(), y.into())).collect();
            let center = Vec2::new(x, y);
            prop_assume!(points.iter().all(|p| (p.distance(center) - radius).abs() > 1e-4));
            let near: Vec<Vec2> = points.iter().copied().filter(|p| p.distance(center) <= radius).collect();
            let expected = (!near.is_empty()).then(|| near.iter().sum::<Vec2>() / near.len() as f32);
            let few = DiscSums::for_questions(points.clone(), 1).mean_within(center, radius);
            let found = DiscSums::new(points).mean_within(center, radius);
            prop_assert_eq!(few, found);
            prop_assert_eq!(found.is_some(), expected.is_some());
            prop_assert!(found.unwrap_or_default().distance(expected.unwrap_or_default()) < 1e-4);
        }
    }
}
