//! The area of several closed outlines: those that overlap are one, and one inside another is a hole in it.
//!
//! An outline is inside another if all of its corners are, but for one in a hundred. What lies in a hole is solid again.
//! Limits: an outline that crosses itself encloses what the even–odd rule says. Cost: the square of the outlines, by their bounds.

use super::region::Region;
use glam::Vec2;

/// Most corners of an outline outside of another in which it lies, as a share.
const OUTSIDE: f32 = 0.01;

/// A filled area.
#[derive(Debug)]
pub struct OutlinedArea {
    /// Each with how many others it lies in, the innermost first.
    regions: Vec<(Region, usize)>,
}

impl OutlinedArea {
    /// The area of closed outlines whose first points are not repeated.
    pub fn new(outlines: impl IntoIterator<Item = Vec<Vec2>>) -> Self {
        let regions: Vec<Region> = outlines.into_iter().map(Region::new).collect();
        let bounds: Vec<Option<(Vec2, Vec2)>> = regions.iter().map(Region::bounds).collect();
        let may_lie_in = |inner: usize, outer: usize| {
            let both = bounds[inner].zip(bounds[outer]);
            both.is_some_and(|(a, b)| {
                let margin = 0.1 * (a.1 - a.0);
                a.0.cmpge(b.0 - margin).all() && a.1.cmple(b.1 + margin).all()
            })
        };
        let lies_in = |inner: usize, outer: usize| {
            if inner == outer || !may_lie_in(inner, outer) {
                return false;
            }
            let (corners, outer) = (regions[inner].outline(), &regions[outer]);
            let outside = corners.iter().filter(|p| !outer.contains(**p)).count();
            outside as f32 <= OUTSIDE * corners.len() as f32
        };
        let depths: Vec<usize> =
            (0..regions.len()).map(|i| (0..regions.len()).filter(|k| lies_in(i, *k)).count()).collect();
        let mut regions: Vec<(Region, usize)> = regions.into_iter().zip(depths).collect();
        regions.sort_by_key(|(_, depth)| std::cmp::Reverse(*depth));
        Self { regions }
    }

    /// The filled outlines.
    pub fn regions(&self) -> impl Iterator<Item = &Region> {
        self.regions.iter().map(|(region, _)| region)
    }

    /// Whether a point lies inside.
    pub fn contains(&self, p: Vec2) -> bool {
        let innermost = self.regions.iter().find(|(region, _)| region.contains(p));
        innermost.is_some_and(|(_, depth)| depth % 2 == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: f32, high: f32) -> Vec<Vec2> {
        [(low, low), (high, low), (high, high), (low, high)].map(Vec2::from).to_vec()
    }

    #[test]
    fn outlines_that_overlap_are_one_area() {
        let both = OutlinedArea::new([square(0.0, 4.0), square(3.0, 7.0)]);
        assert!([1.0, 3.5, 6.0].iter().all(|x| both.contains(Vec2::splat(*x))));
        assert!(!both.contains(Vec2::new(1.0, 6.0)));
    }

    #[test]
    fn one_inside_another_is_a_hole_and_in_that_is_an_island() {
        let rings =
            OutlinedArea::new([square(3.0, 7.0), square(0.0, 10.0), square(4.0, 6.0), square(9.0, 12.0)]);
        let inside = [1.0, 3.5, 5.0, 9.5, 11.0].map(|x| rings.contains(Vec2::splat(x)));
        assert_eq!(inside, [true, false, true, true, true]);
        assert!(!OutlinedArea::new([]).contains(Vec2::ZERO));
    }
}
