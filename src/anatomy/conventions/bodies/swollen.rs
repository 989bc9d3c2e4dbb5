//! What an outline encloses as one branch along a straight axis, as thick everywhere as the outline is wide there.
//!
//! At [`STATIONS`] places from root to tip, denser at both, the outline is cut across the axis; the branch goes through the middles of the
//! cuts. Limits: of an outline that is cut more than twice, what lies between the outer cuts counts as inside.

use crate::anatomy::conventions::Made;
use crate::anatomy::conventions::shapes::outline::ends_at;
use crate::sketch::{StrokePoint, Tool};
use glam::Vec2;
use std::f32::consts::PI;

/// Places along the axis.
const STATIONS: usize = 24;
/// Least half width, as a share of the widest: a branch ends round.
const LEAST: f32 = 0.04;

/// The branch in a closed outline from its root to its tip; nothing where the outline has no width.
pub(super) fn branch(outline: &[Vec2], root: Vec2, tip: Vec2) -> Option<Made> {
    let along = (tip - root).try_normalize()?;
    let station = |k: usize| {
        let share = 0.5 - 0.5 * (PI * (k as f32 + 0.3) / (STATIONS as f32 + 0.6)).cos();
        let place = root.lerp(tip, share);
        let (left, right) = cut(outline, place, along)?;
        Some(Cut { place, aside: 0.5 * (left + right), half: 0.5 * (right - left) })
    };
    let cuts: Vec<Cut> = (0..=STATIONS).filter_map(station).collect();
    let widest = cuts.iter().map(|cut| cut.half).fold(0.0, f32::max);
    let point = |Cut { place, aside, half }: Cut| {
        // What is narrow is an end, where the hand decides which side is longer.
        let middle = place + (half / widest).min(1.0) * aside * along.perp();
        StrokePoint { pressure: (half / widest).max(LEAST), ..StrokePoint::at(middle) }
    };
    let points: Vec<StrokePoint> = cuts.into_iter().map(point).collect();
    (widest > 0.0 && points.len() > 2).then_some(Made {
        tool: Tool::Branch,
        points,
        half_width: Some(widest),
    })
}

/// A cut across the axis.
struct Cut {
    /// Where the axis is.
    place: Vec2,
    /// How far its middle lies aside of that, and half of its length.
    aside: f32,
    half: f32,
}

/// How far a line across the axis goes to either side until it leaves the outline.
fn cut(outline: &[Vec2], place: Vec2, along: Vec2) -> Option<(f32, f32)> {
    let away = |p: Vec2| p - place;
    ends_at(outline, 0.0, |p| away(p).dot(along), |p| away(p).dot(along.perp()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    #[test]
    fn a_circle_is_as_thick_in_its_middle_as_it_is_wide() {
        let circle: Vec<Vec2> = (0..60).map(|k| 50.0 * Vec2::from_angle(TAU * k as f32 / 60.0)).collect();
        let made = branch(&circle, Vec2::new(0.0, 50.0), Vec2::new(0.0, -50.0)).unwrap();
        assert!((made.half_width.unwrap() - 50.0).abs() < 1.0);
        assert!(made.points.iter().all(|p| p.position.x.abs() < 1.0));
        let half = |p: &StrokePoint| 50.0 * p.pressure;
        let round = |p: &StrokePoint| (2500.0 - p.position.y.powi(2)).max(0.0).sqrt();
        assert!(made.points.iter().all(|p| (half(p) - round(p)).abs() < 3.0));
    }

    #[test]
    fn a_line_has_no_width() {
        let line = [Vec2::ZERO, Vec2::new(0.0, 50.0)];
        assert!(branch(&line, line[0], line[1]).is_none());
    }
}
