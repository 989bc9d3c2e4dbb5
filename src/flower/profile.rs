//! The curves of the rings of a flower, each laid inside of the one before.
//!
//! A curve starts at the foot of the petals and turns as the layer says: evenly from foot to tip, and back where tips
//! roll. It is laid step by step; where a step would come nearer to the curve outside of it than petals need, it is led along
//! that curve instead, and where it would come too near to the axis, along the axis. So a tight flower closes further than its
//! numbers say, and petals never change sides.
//!
//! Limits: at the foot, where petals are narrow, curves may lie closer.

use super::layers::LayerShape;
use crate::plant::ring_curve::{POINTS, RingCurve, STEPS};
use glam::Vec2;

/// Share of the length in which the distance to the curve outside grows to what is needed.
const FREE_FOOT: f32 = 0.25;
/// Where tips begin to roll back, share of the length.
const ROLL_FROM: f32 = 0.5;
/// Share of the way to the axis that may be used.
const TO_AXIS: f32 = 0.4;

/// Points of a curve of (distance from the axis, height), shares of the flower's reach.
pub type Line = [Vec2; POINTS];

/// What a curve is laid from.
#[derive(Clone, Copy, Debug)]
pub struct Lay<'a> {
    /// How its petals stand.
    pub shape: &'a LayerShape,
    /// Where they begin.
    pub foot: Vec2,
    /// Nearest that it may come to the axis.
    pub nearest: f32,
    /// The curve outside of it, the distance between them, and that at the foot.
    pub outside: Option<(&'a Line, f32, f32)>,
}

/// Lays a curve.
pub fn lay(lay: &Lay<'_>) -> Line {
    let (shape, step) = (lay.shape, lay.shape.length / STEPS as f32);
    let foot = lay.outside.map_or(lay.foot, |(outside, _, foot)| pushed(outside, lay.foot, foot));
    let mut points = [Vec2::new(foot.x.max(lay.nearest.min(lay.foot.x)), foot.y); POINTS];
    for k in 1..POINTS {
        let share = (k as f32 - 0.5) / STEPS as f32;
        let from = points[k - 1];
        let mut to = from + Vec2::from_angle(direction(shape, share)) * step;
        if let Some((outside, gap, foot)) = lay.outside {
            let needed = foot + (gap - foot) * (share / FREE_FOOT).min(1.0);
            to = from + (pushed(outside, to, needed) - from).normalize_or(Vec2::Y) * step;
            to = pushed(outside, to, needed);
        }
        let nearest = lay.nearest.min(from.x);
        if to.x < nearest {
            to = Vec2::new(nearest, from.y + (step * step - (nearest - from.x).powi(2)).max(0.0).sqrt());
        }
        if to.distance_squared(from) < 0.25 * step * step {
            // Below the tips of those outside, which leave the axis free.
            to = Vec2::new(nearest, from.y + step);
        }
        points[k] = to;
    }
    points
}

/// The curve of a ring whose petals are `length` long, with the room that the line inside of it leaves, or else the axis.
pub fn curve(line: &Line, length: f32, inside: Option<&Line>) -> RingCurve {
    RingCurve::new(*line, length, |spot| {
        let to_axis = (spot.normal.x < -0.05).then(|| TO_AXIS * spot.at.x / -spot.normal.x);
        let to_inside = inside.map(|inside| distance(inside, spot.at));
        [to_axis, to_inside].into_iter().flatten().reduce(f32::min)
    })
}

/// Direction of a curve at a share of the way, radians from outward.
fn direction(shape: &LayerShape, share: f32) -> f32 {
    let turned = shape.bend_rad * (share.min(1.0) - 0.5);
    let roll = ((share.min(1.0) - ROLL_FROM) / (1.0 - ROLL_FROM)).max(0.0);
    shape.closing_rad + turned - shape.curl_rad * roll * roll
}

/// Distance of a point from a curve between foot and tip.
fn distance(line: &Line, point: Vec2) -> f32 {
    let pieces = line[..=STEPS].windows(2);
    let distances = pieces.map(|ends| point.distance(nearest(ends[0], ends[1], point, 0.0..=1.0)));
    distances.fold(f32::INFINITY, f32::min)
}

/// The point, or where it is less than `gap` inside of a curve the nearest one that is not. The curve counts as if it went on
/// straight at both ends.
fn pushed(line: &Line, point: Vec2, gap: f32) -> Vec2 {
    let mut best = (f32::INFINITY, point, 0.0);
    for (k, ends) in line.windows(2).enumerate() {
        let from = if k == 0 { -1e3 } else { 0.0 };
        let to = if k == POINTS - 2 { 1e3 } else { 1.0 };
        let on = nearest(ends[0], ends[1], point, from..=to);
        let squared = on.distance_squared(point);
        if squared < best.0 {
            let side = (ends[1] - ends[0]).perp().normalize_or(Vec2::Y);
            best = (squared, on + side * gap, (point - on).dot(side));
        }
    }
    if best.2 < gap { best.1 } else { point }
}

/// The point of a piece that is nearest to another; `within` says how far along the piece it may lie.
fn nearest(a: Vec2, b: Vec2, point: Vec2, within: std::ops::RangeInclusive<f32>) -> Vec2 {
    let along = b - a;
    let share = (point - a).dot(along) / along.length_squared().max(f32::MIN_POSITIVE);
    a + along * share.clamp(*within.start(), *within.end())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(closing_deg: f32, bend_deg: f32) -> LayerShape {
        LayerShape {
            closing_rad: closing_deg.to_radians(),
            bend_rad: bend_deg.to_radians(),
            curl_rad: 0.0,
            cup: 0.0,
            length: 1.0,
            open: 1.0,
        }
    }

    fn alone(shape: &LayerShape) -> Line {
        lay(&Lay { shape, foot: Vec2::new(0.1, 0.0), nearest: 0.0, outside: None })
    }

    #[test]
    fn a_free_curve_closes_as_its_layer_says() {
        for closing in [-20.0f32, 0.0, 35.0, 80.0] {
            for bend in [-30.0, 0.0, 60.0] {
                let chord = curve(&alone(&shape(closing, bend)), 1.0, None).chord();
                let off = chord.to_angle().to_degrees() - closing;
                assert!(off.abs() < 0.1, "{off} at {closing}, {bend}");
            }
        }
    }

    #[test]
    fn curves_inside_keep_their_distance() {
        let outer = alone(&shape(70.0, 90.0));
        let inner = shape(20.0, 0.0);
        let foot = Vec2::new(0.08, 0.02);
        let inner = lay(&Lay { shape: &inner, foot, nearest: 0.01, outside: Some((&outer, 0.05, 0.01)) });
        for point in &inner[4..=STEPS] {
            assert!(distance(&outer, *point) > 0.045 && point.x > 0.0, "{point}");
        }
    }

    #[test]
    fn room_is_what_the_next_curve_leaves_or_the_axis() {
        let (outer, inner) = (alone(&shape(0.0, 0.0)), alone(&shape(90.0, 0.0)));
        let outer = curve(&outer, 1.0, Some(&inner));
        assert!(outer.spot(0.9).room > outer.spot(0.3).room);
        assert!((curve(&inner, 1.0, None).spot(0.5).room - 0.04).abs() < 1e-3);
    }
}
