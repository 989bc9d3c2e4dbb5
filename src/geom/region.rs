//! The inside of a closed outline: containment and the nearest point of its boundary.
//!
//! Containment counts crossings of a horizontal ray (even–odd rule) and looks only at the edges of the point's slab: a
//! handful on a hand-drawn outline, all of them at worst. There are fewer slabs the more of them an edge spans, so
//! that the table stays linear in the edges. Self-crossing outlines are allowed.

use super::boundary::Boundary;
use glam::Vec2;

/// Slabs that an edge may lie in, on average.
const SLABS_PER_EDGE: f32 = 6.0;

/// A filled outline.
#[derive(Debug)]
pub struct Region {
    points: Vec<Vec2>,
    boundary: Boundary,
    slabs: Vec<Vec<u32>>,
    low: f32,
    slab_height: f32,
}

impl Region {
    /// The region inside a closed outline; the first point is not repeated.
    pub fn new(points: Vec<Vec2>) -> Self {
        let low = points.iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
        let high = points.iter().map(|p| p.y).fold(f32::NEG_INFINITY, f32::max);
        let climb: f32 = edges(&points).map(|(a, b)| (a.y - b.y).abs()).sum();
        let most = SLABS_PER_EDGE * points.len() as f32 * ((high - low) / climb).min(1.0);
        let count = points.len().min(most as usize).max(1);
        let slab_height = ((high - low) / count as f32).max(f32::MIN_POSITIVE);
        let mut slabs = vec![Vec::new(); count];
        let slab = |y: f32| (((y - low) / slab_height) as usize).min(count - 1);
        for (i, (a, b)) in edges(&points).enumerate() {
            for bucket in &mut slabs[slab(a.y.min(b.y))..=slab(a.y.max(b.y))] {
                bucket.push(i as u32);
            }
        }
        Self { boundary: Boundary::new(edges(&points).collect()), points, slabs, low, slab_height }
    }

    /// The outline.
    pub fn outline(&self) -> &[Vec2] {
        &self.points
    }

    /// Smallest and largest corner; `None` for an empty outline.
    pub fn bounds(&self) -> Option<(Vec2, Vec2)> {
        let first = *self.points.first()?;
        Some(self.points.iter().fold((first, first), |(lo, hi), p| (lo.min(*p), hi.max(*p))))
    }

    /// Whether a point lies inside.
    pub fn contains(&self, p: Vec2) -> bool {
        if p.y.is_nan() || p.y < self.low {
            return false;
        }
        let Some(bucket) = self.slabs.get(((p.y - self.low) / self.slab_height) as usize) else {
            return false;
        };
        let crossings = bucket.iter().filter(|&&i| {
            let a = self.points[i as usize];
            let b = self.points[(i as usize + 1) % self.points.len()];
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
        });
        crossings.count() % 2 == 1
    }

    /// Edges that are asked about one point, at most.
    pub fn edges_beside_a_point(&self) -> usize {
        self.slabs.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// The boundary point nearest to `p` and its distance; `None` for an empty outline.
    pub fn nearest_boundary(&self, p: Vec2) -> Option<(Vec2, f32)> {
        let nearest = self.boundary.nearest(p)?;
        Some((nearest, p.distance(nearest)))
    }
}

fn edges(points: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
    (0..points.len()).map(|i| (points[i], points[(i + 1) % points.len()]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn square() -> Region {
        Region::new(vec![Vec2::ZERO, Vec2::new(4.0, 0.0), Vec2::new(4.0, 4.0), Vec2::new(0.0, 4.0)])
    }

    #[test]
    fn inside_and_outside_of_a_square() {
        let region = square();
        assert!(region.contains(Vec2::new(1.0, 3.9)));
        assert!(!region.contains(Vec2::new(5.0, 2.0)));
        assert!(!region.contains(Vec2::new(2.0, -0.1)));
        assert!(!region.contains(Vec2::NAN));
    }

    #[test]
    fn nearest_boundary_of_a_square() {
        assert_eq!(square().nearest_boundary(Vec2::new(1.0, 2.0)), Some((Vec2::new(0.0, 2.0), 1.0)));
    }

    #[test]
    fn nothing_is_inside_nothing() {
        let region = Region::new(Vec::new());
        assert!(!region.contains(Vec2::ZERO));
        assert_eq!(region.nearest_boundary(Vec2::ZERO), None);
    }

    #[test]
    fn a_zigzag_does_not_fill_every_slab() {
        let n = 2000;
        let tooth = |k: usize| Vec2::new(k as f32, if k.is_multiple_of(2) { 0.0 } else { 100.0 });
        let region = Region::new((0..n).map(tooth).collect());
        assert!(region.slabs.iter().map(Vec::len).sum::<usize>() <= 8 * n);
    }

    proptest! {
        #[test]
        fn slabs_agree_with_testing_every_edge(
            corners in prop::collection::vec((-9.0f32..9.0, -9.0f32..9.0), 3..24),
            probe in (-10.0f32..10.0, -10.0f32..10.0),
        ) {
            let points: Vec<Vec2> = corners.into_iter().map(Vec2::from).collect();
            let p = Vec2::from(probe);
            let crossings = edges(&points)
                .filter(|(a, b)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
                .count();
            prop_assert_eq!(Region::new(points).contains(p), crossings % 2 == 1);
        }
    }
}
