//! Outlines of crowns in the world: the same mapping as everything drawn, in the plane z = 0.

use crate::anatomy::{Anatomy, ThinSpot};
use crate::geom::{polyline, region::Region};
use crate::plant::WorldFromCanvas;
use glam::Vec2;

/// The crowns of a drawing as closed outlines, (x, y) in metres, in drawing order.
pub fn crowns(anatomy: &Anatomy, world: &WorldFromCanvas) -> Vec<Vec<Vec2>> {
    let place = |p: &Vec2| world.point(*p).truncate();
    anatomy.crowns.iter().map(|crown| crown.outline.iter().map(place).collect()).collect()
}

/// Where crowns are sparse: middles and radii in the same plane, metres.
pub fn thin_spots(anatomy: &Anatomy, world: &WorldFromCanvas) -> Vec<(Vec2, f32)> {
    let place = |spot: &ThinSpot| (world.point(spot.middle).truncate(), spot.radius * world.scale);
    anatomy.thin_spots.iter().map(place).collect()
}

/// Where the trunk of crowns without any drawn branch stands, canvas pixels: below the middle of what is lowest, by
/// `trunk` times the crowns' height. `None` without crowns.
pub fn foot(anatomy: &Anatomy, trunk: f32) -> Option<Vec2> {
    let points = || anatomy.crowns.iter().flat_map(|crown| &crown.outline);
    let low = points().map(|p| p.y).fold(f32::NEG_INFINITY, f32::max);
    let high = points().map(|p| p.y).fold(f32::INFINITY, f32::min);
    let height = low - high;
    let near = points().filter(|p| p.y >= low - LOWEST * height);
    let (count, sum) = near.fold((0, 0.0), |(count, sum), p| (count + 1, sum + p.x));
    (count > 0).then(|| Vec2::new(sum / count as f32, low + trunk * height))
}

/// How far in front of the drawing the surface of the crown is in which a place lies, canvas pixels: that of a round body of the
/// crown's outline. `None` outside of crowns.
pub(super) fn front(anatomy: &Anatomy, place: Vec2) -> Option<f32> {
    let crown = anatomy.crowns.iter().find(|crown| Region::new(crown.outline.clone()).contains(place))?;
    let mut ring = crown.outline.clone();
    ring.extend(crown.outline.first());
    let (low, high) = polyline::bounds(ring.iter().copied());
    let radius = 0.5 * (high - low).min_element();
    let edge = polyline::nearest(&ring, place).map_or(0.0, |(gap, _)| gap).min(radius);
    Some((radius * radius - (radius - edge).powi(2)).max(0.0).sqrt())
}

/// Share of the crowns' height that counts as lowest.
const LOWEST: f32 = 0.02;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::FlatCrown;

    #[test]
    fn the_foot_stands_below_what_is_lowest() {
        let outline = [(0.0, 100.0), (50.0, 300.0), (100.0, 100.0)].map(Vec2::from).to_vec();
        let crowns = vec![FlatCrown { stroke: 1, outline }];
        let anatomy = Anatomy { crowns, ..Anatomy::default() };
        assert_eq!(foot(&anatomy, 0.25), Some(Vec2::new(50.0, 350.0)));
        assert_eq!(foot(&Anatomy::default(), 0.25), None);
        let world = WorldFromCanvas { scale: 0.01, origin: Vec2::new(50.0, 350.0) };
        let lifted = crowns_of(&anatomy, &world);
        assert!(lifted[0][1].distance(Vec2::new(0.0, 0.5)) < 1e-6, "{lifted:?}");
    }

    #[test]
    fn the_front_is_as_deep_as_the_crown_is_wide_around_a_place() {
        let round = |k: usize| 100.0 * Vec2::from_angle(std::f32::consts::TAU * k as f32 / 60.0);
        let crowns = vec![FlatCrown { stroke: 1, outline: (0..60).map(round).collect() }];
        let anatomy = Anatomy { crowns, ..Anatomy::default() };
        let at = |x: f32| front(&anatomy, Vec2::new(x, 0.0));
        assert!(at(0.0).is_some_and(|depth| (depth - 100.0).abs() < 1.0));
        assert!(at(80.0).is_some_and(|depth| (depth - 60.0).abs() < 2.0));
        assert!(at(120.0).is_none());
    }

    fn crowns_of(anatomy: &Anatomy, world: &WorldFromCanvas) -> Vec<Vec<Vec2>> {
        super::crowns(anatomy, world)
    }
}
