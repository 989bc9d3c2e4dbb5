//! From places in the space of the plant to samples of a stroke, and back.
//!
//! A stroke in space keeps canvas pixels, and the places of wood as it was drawn: what grows on wood that was turned or bent is
//! kept as if that stood as before, and goes along with it.

use crate::plant::{Motion, WorldFromCanvas};
use crate::sketch::{StrokePoint, limits};
use glam::Vec3;

/// How the samples of a stroke lie in the space of the plant.
#[derive(Clone, Copy, Debug)]
pub(super) struct StrokeFrame {
    pub(super) world: WorldFromCanvas,
    /// What moved the place that the stroke grows on; nothing moves what stands on the ground.
    pub(super) motion: Option<Motion>,
}

impl StrokeFrame {
    /// A place in space as a sample.
    pub(super) fn sample(&self, at: Vec3, pressure: f32, time_ms: f32) -> StrokePoint {
        let at = self.motion.map_or(at, |motion| motion.back(at));
        let depth = at.z / self.world.scale;
        StrokePoint { pressure, time_ms, depth, ..StrokePoint::at(self.world.canvas(at)) }
    }

    /// The sample of a place that follows `last`, if it lies elsewhere and where a drawing can have it.
    pub(super) fn next_sample(
        &self,
        last: Option<&StrokePoint>,
        at: Vec3,
        (pressure, time_ms): (f32, f64),
    ) -> Option<StrokePoint> {
        let new = self.sample(at, pressure, (time_ms as f32).clamp(0.0, limits::MAX_TIME_MS));
        let place = |point: &StrokePoint| point.position.extend(point.depth);
        let is_other = last.is_none_or(|last| place(last) != place(&new));
        // Written so that a place that is no number fails, too.
        let is_near = place(&new).abs().max_element() <= limits::MAX_COORDINATE;
        (is_other && is_near).then_some(new)
    }

    /// Where a sample lies in space, metres.
    pub(super) fn place(&self, point: &StrokePoint) -> Vec3 {
        let at = self.world.point(point.position).with_z(point.depth * self.world.scale);
        self.motion.map_or(at, |motion| motion.point(at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Quat, Vec2};

    #[test]
    fn there_and_back() {
        let world = WorldFromCanvas { scale: 0.001, origin: Vec2::new(300.0, 800.0) };
        let (from, to) = (Vec3::Y, Vec3::new(0.1, 0.9, 0.2));
        let motion = Motion { turn: Quat::from_rotation_x(0.8), from, to, size: 1.0 };
        for motion in [None, Some(motion)] {
            let (frame, at) = (StrokeFrame { world, motion }, Vec3::new(0.2, 0.5, -0.3));
            let sample = frame.sample(at, 0.4, 7.0);
            assert!(frame.place(&sample).distance(at) < 1e-6);
            assert_eq!((sample.pressure, sample.time_ms), (0.4, 7.0));
        }
    }
}
