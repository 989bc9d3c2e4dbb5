//! What grew from growth points in the last drawing, for the next.
//!
//! Growth points have names that stay while others come and go. What grew from one is taken again if the point is where it was
//! and everything else that it grew by is as it was, which is the business of who asks: see [`Recall::begin`] and the `holds`
//! of [`Recall::get`].

use super::growth_points::GrowthPoint;
use crate::kept::NameHasher;
use std::collections::HashMap;
use std::hash::BuildHasherDefault;

/// Things by the growth points that they grew from.
#[derive(Debug)]
pub struct Recall<T> {
    held: HashMap<u64, Held<T>, BuildHasherDefault<NameHasher>>,
    round: u64,
}

#[derive(Debug)]
struct Held<T> {
    /// Position, direction and side of the point.
    place: [u32; 5],
    thing: T,
    /// The last round that asked for it.
    round: u64,
}

impl<T> Default for Recall<T> {
    fn default() -> Self {
        Self { held: HashMap::default(), round: 0 }
    }
}

impl<T> Recall<T> {
    /// Begins a round; all is forgotten where what things grew by does not hold any more.
    pub fn begin(&mut self, holds: bool) {
        if !holds {
            self.held.clear();
        }
        self.round += 1;
    }

    /// Ends a round: what it did not ask for is forgotten. A round that was stopped is not ended, so that its work is not
    /// lost.
    pub fn finish(&mut self) {
        let round = self.round;
        self.held.retain(|_, held| held.round == round);
    }

    /// What grew from a point, if it still `holds`.
    pub fn get(&mut self, point: &GrowthPoint, holds: impl Fn(&T) -> bool) -> Option<&T> {
        let held = self.held.get_mut(&point.key)?;
        if held.place != place(point) || !holds(&held.thing) {
            return None;
        }
        held.round = self.round;
        Some(&held.thing)
    }

    /// Remembers what grew from a point.
    pub fn keep(&mut self, point: &GrowthPoint, thing: T) {
        self.held.insert(point.key, Held { place: place(point), thing, round: self.round });
    }
}

fn place(point: &GrowthPoint) -> [u32; 5] {
    let GrowthPoint { position, direction, attachment: _, side, key: _ } = point;
    [position.x, position.y, direction.x, direction.y, *side].map(f32::to_bits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    #[test]
    fn what_is_not_asked_for_or_grows_elsewhere_is_forgotten() {
        let point = |key: u64, x: f32| GrowthPoint {
            position: Vec2::new(x, 0.0),
            direction: Vec2::Y,
            attachment: None,
            side: 1.0,
            key,
        };
        let mut recall = Recall::default();
        recall.begin(true);
        (0..4).for_each(|key| recall.keep(&point(key, 0.0), key));
        recall.finish();
        recall.begin(true);
        assert_eq!(recall.get(&point(1, 0.0), |_| true), Some(&1));
        assert_eq!(recall.get(&point(2, 5.0), |_| true), None);
        assert_eq!(recall.get(&point(3, 0.0), |_| false), None);
        recall.finish();
        recall.begin(true);
        assert_eq!(recall.get(&point(0, 0.0), |_| true), None);
        assert_eq!(recall.get(&point(1, 0.0), |_| true), Some(&1));
        recall.begin(false);
        assert_eq!(recall.get(&point(1, 0.0), |_| true), None);
    }
}
