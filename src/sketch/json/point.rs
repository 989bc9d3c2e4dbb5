//! The points of one stroke: JSON lists of 2, 3, 5, 6 or 7 numbers, straight into [`StrokePoint`]s.

use super::progress::Progress;
use crate::sketch::error::Fault;
use crate::sketch::{StrokePoint, limits};
use glam::vec2;
use serde::de::{Deserialize, DeserializeSeed, Deserializer, Error, SeqAccess, Visitor};
use std::fmt;

/// Reads the `points` of a stroke.
#[derive(Clone, Copy)]
pub(super) struct PointsSeed<'p>(pub(super) &'p Progress);

impl<'de> DeserializeSeed<'de> for PointsSeed<'_> {
    type Value = Vec<StrokePoint>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for PointsSeed<'_> {
    type Value = Vec<StrokePoint>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of points")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let progress = self.0;
        let room = limits::MAX_POINTS.saturating_sub(progress.points_before.get());
        let mut points = Vec::new();
        progress.point.set(1);
        while let Some(Point(point)) = seq.next_element()? {
            if points.len() == room {
                return Err(progress.refuse(Fault::TooMany { what: "points", limit: limits::MAX_POINTS }));
            }
            points.push(point);
            progress.point.set(points.len() + 1);
        }
        progress.point.set(0);
        progress.points_before.set(progress.points_before.get() + points.len());
        points.shrink_to_fit();
        Ok(points)
    }
}

struct Point(StrokePoint);

impl<'de> Deserialize<'de> for Point {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(PointVisitor).map(Point)
    }
}

struct PointVisitor;

impl<'de> Visitor<'de> for PointVisitor {
    type Value = StrokePoint;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a point of 2, 3, 5, 6 or 7 numbers: x, y, pressure, tilt x, tilt y, time, depth")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<StrokePoint, A::Error> {
        let mut numbers = [0.0, 0.0, StrokePoint::NEUTRAL_PRESSURE, 0.0, 0.0, 0.0, 0.0];
        let mut count = 0;
        for slot in &mut numbers {
            let Some(number) = seq.next_element::<f32>()? else { break };
            *slot = number;
            count += 1;
        }
        if !matches!(count, 2 | 3 | 5..=7) {
            return Err(A::Error::invalid_length(count, &self));
        }
        if count == 7 && seq.next_element::<f32>()?.is_some() {
            return Err(A::Error::invalid_length(8, &self));
        }
        let [x, y, pressure, tilt_x, tilt_y, time_ms, depth] = numbers;
        Ok(StrokePoint { position: vec2(x, y), pressure, tilt_deg: vec2(tilt_x, tilt_y), time_ms, depth })
    }
}
