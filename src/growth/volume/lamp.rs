//! Light that a brush paints: buds near it earn more, and shoots grow toward it; of negative strength it is shade, and they grow away.
//!
//! The thesis names tropisms but no such light (001 §4.4 has brushes for space and for direction). A bud at a distance d from what the ball sweeps, within
//! [`REACH`] radii of it, has the share w = (1 − d/reach)² of the light: what it earns is multiplied by 1 + strength·w, and its best
//! direction gets [`PULL`]·strength·w toward the ball, beside what it finds itself, and less inside of it.
//!
//! Limits: light goes through wood, leaves and walls.

use glam::Vec3;

/// How far it shines beyond what the ball sweeps, in radii of the ball.
const REACH: f32 = 5.0;
/// Weight of its direction beside a bud's own best one, which is at most 1 long.
const PULL: f32 = 2.5;
/// Most places; of more every so many-th is taken.
const MOST: usize = 256;

/// The way of a ball that shines.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    balls: Vec<(Vec3, f32)>,
    strength: f32,
    low: Vec3,
    high: Vec3,
}

impl Lamp {
    /// Light along a way of places with radii, metres. `None` without a place, or where a radius is not above 0.
    pub fn new(way: &[(Vec3, f32)], strength: f32) -> Option<Self> {
        let is_sound = |(at, radius): &(Vec3, f32)| at.is_finite() && radius.is_finite() && *radius > 0.0;
        if way.is_empty() || !way.iter().all(is_sound) || !strength.is_finite() {
            return None;
        }
        let every = way.len().div_ceil(MOST);
        let balls: Vec<(Vec3, f32)> = way.iter().copied().step_by(every).chain(way.last().copied()).collect();
        let shines = |(_, radius): &(Vec3, f32)| (1.0 + REACH) * radius;
        let low = balls.iter().map(|ball| ball.0 - shines(ball)).fold(Vec3::INFINITY, Vec3::min);
        let high = balls.iter().map(|ball| ball.0 + shines(ball)).fold(Vec3::NEG_INFINITY, Vec3::max);
        Some(Self { balls, strength, low, high })
    }

    /// What a bud at a place earns and its best direction, with this light.
    pub(in crate::growth) fn shine(&self, at: Vec3, (earned, best): (f32, Vec3)) -> (f32, Vec3) {
        if !(at.cmpge(self.low).all() && at.cmple(self.high).all()) {
            return (earned, best);
        }
        let lit = |&(middle, radius): &(Vec3, f32)| {
            let beyond = (at.distance(middle) - radius).max(0.0) / (REACH * radius);
            ((1.0 - beyond).max(0.0).powi(2), middle, radius)
        };
        let brightest = self.balls.iter().map(lit).max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((share, middle, radius)) = brightest.filter(|lit| lit.0 > 0.0) else {
            return (earned, best);
        };
        // Less inside of the ball, or all shoots would meet on its way.
        let toward = ((middle - at) / radius).clamp_length_max(1.0) * (PULL * self.strength * share);
        (earned * (1.0 + self.strength * share).max(0.0), best + toward)
    }

    /// Elementary steps for one bud.
    pub(in crate::growth) fn steps(&self) -> u64 {
        4 * self.balls.len() as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_near_earns_more_and_looks_there() {
        let lamp =
            |strength| Lamp::new(&[(Vec3::X * 2.0, 0.5), (Vec3::X * 2.0 + Vec3::Y, 0.5)], strength).unwrap();
        let (earned, best) = lamp(1.0).shine(Vec3::ZERO, (0.5, Vec3::Y * 0.5));
        assert!(earned > 0.55 && best.x > 0.3 && best.y == 0.5, "{earned} {best}");
        let nearer = lamp(1.0).shine(Vec3::X, (0.5, Vec3::Y * 0.5));
        assert!(nearer.0 > earned && nearer.1.x > best.x);
        let (in_shade, away) = lamp(-1.0).shine(Vec3::X, (0.5, Vec3::ZERO));
        assert!((0.0..0.5).contains(&in_shade) && away.x < -0.3);
        let far = Vec3::X * -20.0;
        assert_eq!(lamp(3.0).shine(far, (0.5, Vec3::Y)), (0.5, Vec3::Y));
        assert!(lamp(-3.0).shine(Vec3::X * 2.0, (0.5, Vec3::Y)).0 == 0.0, "nothing grows in its middle");
    }

    #[test]
    fn ways_are_sound_and_of_few_places() {
        assert!(Lamp::new(&[], 1.0).is_none() && Lamp::new(&[(Vec3::ZERO, 0.0)], 1.0).is_none());
        let long: Vec<(Vec3, f32)> = (0..10_000).map(|k| (Vec3::X * k as f32, 1.0)).collect();
        let lamp = Lamp::new(&long, 1.0).unwrap();
        assert!(lamp.balls.len() <= MOST + 1 && lamp.balls.last() == long.last());
    }
}
