//! The inside of a closed outline: containment and the nearest point of its boundary, both in logarithmic time.
//!
//! Containment counts crossings of a horizontal ray (even–odd rule) and looks only at the edges of the point's slab;
//! the nearest boundary point comes from an R-tree over the edges. Self-crossing outlines are allowed.

use glam::Vec2;
use rstar::{
    PointDistance, RTree,
    primitives::{GeomWithData, Line},
};

/// A filled outline.
pub struct Region {
    points: Vec<Vec2>,
    edges: RTree<Line<[f32; 2]>>,
    slabs: Vec<Vec<u32>>,
    low: f32,
    slab_height: f32,
}

impl Region {
    /// The region inside a closed outline; the first point is not repeated.
    pub fn new(points: Vec<Vec2>) -> Self {
        let lines = edges(&points).map(|(a, b)| Line::new(a.to_array(), b.to_array())).collect();
        let low = points.iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
        let high = points.iter().map(|p| p.y).fold(f32::NEG_INFINITY, f32::max);
        let count = points.len().max(1);
        let slab_height = ((high - low) / count as f32).max(f32::MIN_POSITIVE);
        let mut slabs = vec![Vec::new(); count];
        let slab = |y: f32| (((y - low) / slab_height) as usize).min(count - 1);
        for (i, (a, b)) in edges(&points).enumerate() {
            for bucket in &mut slabs[slab(a.y.min(b.y))..=slab(a.y.max(b.y))] {
                bucket.push(i as u32);
            }
        }
        Self { edges: RTree::bulk_load(lines), points, slabs, low, slab_height }
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
        if !(p.y >= self.low) {
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

    /// The boundary point nearest to `p` and its distance; `None` for an empty outline.
    pub fn nearest_boundary(&self, p: Vec2) -> Option<(Vec2, f32)> {
        let line = self.edges.nearest_neighbor(p.to_array())?;
        let nearest = Vec2::from_array(line.nearest_point(&p.to_array()));
        Some((nearest, p.distance(nearest)))
    }
}

fn edges(points: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
    (0..points.len()).map(|i| (points[i], points[(i + 1) % points.len()]))
}

/// An index over the segments of many polylines: which lie within a distance of a point.
pub struct SegmentIndex {
    tree: RTree<GeomWithData<Line<[f32; 2]>, (u32, u32)>>,
}

/// A segment near a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// Number of the polyline.
    pub line: usize,
    /// Number of the segment within it.
    pub segment: usize,
    /// Share of the segment before the nearest point.
    pub share: f32,
    /// Distance to the nearest point.
    pub distance: f32,
}

impl SegmentIndex {
    /// Indexes polylines by their number.
    pub fn new<'a>(lines: impl Iterator<Item = &'a [Vec2]>) -> Self {
        let segments = lines.enumerate().flat_map(|(i, line)| {
            line.windows(2).enumerate().map(move |(k, w)| {
                GeomWithData::new(Line::new(w[0].to_array(), w[1].to_array()), (i as u32, k as u32))
            })
        });
        Self { tree: RTree::bulk_load(segments.collect()) }
    }

    /// The nearest place on every polyline with a segment within `radius` of `p`, by polyline number.
    pub fn within(&self, p: Vec2, radius: f32) -> Vec<Near> {
        let mut found: Vec<Near> =
            self.tree.locate_within_distance(p.to_array(), radius * radius).map(|hit| near(hit, p)).collect();
        found.sort_by(|a, b| {
            a.line.cmp(&b.line).then(a.distance.total_cmp(&b.distance)).then(a.segment.cmp(&b.segment))
        });
        found.dedup_by_key(|n| n.line);
        found
    }

    /// The nearest place over all polylines; ties go to the lowest number.
    pub fn nearest(&self, p: Vec2) -> Option<Near> {
        let radius2 = self.tree.nearest_neighbor(p.to_array())?.distance_2(&p.to_array());
        let ties = self.tree.locate_within_distance(p.to_array(), radius2 * (1.0 + 1e-5) + f32::MIN_POSITIVE);
        ties.map(|hit| near(hit, p)).min_by(|a, b| (a.line, a.segment).cmp(&(b.line, b.segment)))
    }
}

fn near(hit: &GeomWithData<Line<[f32; 2]>, (u32, u32)>, p: Vec2) -> Near {
    let (a, b) = (Vec2::from_array(hit.geom().from), Vec2::from_array(hit.geom().to));
    let share = super::polyline::nearest_share(a, b, p, Vec2::dot);
    let (line, segment) = (hit.data.0 as usize, hit.data.1 as usize);
    Near { line, segment, share, distance: p.distance(a.lerp(b, share)) }
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
