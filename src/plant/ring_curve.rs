//! The curve of a ring of petals in the plane through a flower's axis: points from the foot of the petals to their tips and some
//! way further, with the normals there and the room that is free along them.
//!
//! A ring is the surface of revolution of its curve. Lengths are shares of the flower's reach.

use glam::Vec2;
use serde::Serialize;

/// Steps from foot to tip, and further: the outer corners of wide, flat petals reach further from the axis than their tips.
pub const STEPS: usize = 12;
const FURTHER: usize = 4;
/// All points of a curve.
pub const POINTS: usize = STEPS + FURTHER + 1;

/// A curve of (distance from the axis, height).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RingCurve {
    points: Box<[Vec2; POINTS]>,
    /// Unit normals toward the axis and upward.
    normals: Box<[Vec2; POINTS]>,
    /// Room along the normals.
    room: Box<[f32; POINTS]>,
    length: f32,
}

/// A place on a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Distance from the axis and height.
    pub at: Vec2,
    /// Unit normal toward the axis and upward.
    pub normal: Vec2,
    /// Room along the normal.
    pub room: f32,
}

impl RingCurve {
    /// The curve through these points, which are `length` long from foot to tip; `room` says how much is free over each of
    /// them along its normal, none where nothing bounds it.
    pub fn new(points: [Vec2; POINTS], length: f32, room: impl Fn(Spot) -> Option<f32>) -> Self {
        let normal = |k: usize| {
            let along = points[(k + 1).min(POINTS - 1)] - points[k.saturating_sub(1)];
            along.perp().normalize_or(Vec2::Y)
        };
        let normals: [Vec2; POINTS] = std::array::from_fn(normal);
        let most = 10.0 * length.max(1.0);
        let free: [f32; POINTS] = std::array::from_fn(|k| {
            room(Spot { at: points[k], normal: normals[k], room: most })
                .map_or(most, |room| room.clamp(0.0, most))
        });
        // A neighbouring point may have less: what lies between must fit there, too.
        let least = |k: usize| {
            let near = free[k.saturating_sub(1)].min(free[(k + 1).min(POINTS - 1)]);
            free[k].min(0.5 * (free[k] + near))
        };
        let room = Box::new(std::array::from_fn(least));
        Self { points: Box::new(points), normals: Box::new(normals), room, length }
    }

    /// Its points; [`STEPS`] of its steps lead from foot to tip.
    pub fn points(&self) -> &[Vec2; POINTS] {
        &self.points
    }

    /// Length from foot to tip.
    pub fn length(&self) -> f32 {
        self.length
    }

    /// The place at a share of the way from foot to tip; beyond the tip up to a third further.
    pub fn spot(&self, share: f32) -> Spot {
        let place = (share * STEPS as f32).clamp(0.0, (POINTS - 1) as f32 - 1e-3);
        let (k, part) = (place as usize, place.fract());
        Spot {
            at: self.points[k].lerp(self.points[k + 1], part),
            normal: self.normals[k].lerp(self.normals[k + 1], part).normalize_or(Vec2::Y),
            room: self.room[k] + (self.room[k + 1] - self.room[k]) * part,
        }
    }

    /// Direction from foot to tip, unit length.
    pub fn chord(&self) -> Vec2 {
        (self.points[STEPS] - self.points[0]).normalize_or(Vec2::Y)
    }

    /// Every number of it in a fixed order.
    pub fn words(&self) -> impl Iterator<Item = f32> + '_ {
        let places = self.points.iter().chain(self.normals.iter()).flat_map(|point| point.to_array());
        places.chain(self.room.iter().copied()).chain([self.length])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn upright(room: impl Fn(Spot) -> Option<f32>) -> RingCurve {
        RingCurve::new(std::array::from_fn(|k| Vec2::new(0.1, k as f32 / STEPS as f32)), 1.0, room)
    }

    #[test]
    fn places_lie_between_points_and_look_toward_the_axis() {
        let spot = upright(|_| None).spot(0.31);
        assert!(spot.at.distance(Vec2::new(0.1, 0.31)) < 1e-5);
        assert!(spot.normal.distance(-Vec2::X) < 1e-5);
        assert_eq!(upright(|_| None).chord(), Vec2::Y);
    }

    #[test]
    fn narrow_places_narrow_their_neighbours() {
        let curve = upright(|spot| Some(if spot.at.y > 0.49 && spot.at.y < 0.51 { 0.01 } else { 0.2 }));
        let before = curve.spot(5.0 / 12.0).room;
        assert!(curve.spot(0.5).room < 0.011 && before > 0.1 && before < 0.11, "{before}");
    }
}
