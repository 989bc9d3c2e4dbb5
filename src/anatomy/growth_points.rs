//! Where twigs and leaves sprout: places at equal distance along the branches inside an outline (000 §3.5.1, steps 3
//! and 4).

use super::{Attachment, FlatBranch};
use crate::geom::{polyline, region::Region};
use glam::Vec2;

/// A place on a branch from which something grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrowthPoint {
    /// Canvas position, pixels.
    pub position: Vec2,
    /// Unit direction of the branch there.
    pub direction: Vec2,
    /// The branch and the arc length on it.
    pub attachment: Attachment,
    /// Count along the branch, from its base: even and odd ones grow to different sides.
    pub number: usize,
}

impl GrowthPoint {
    /// The side to which it grows: 1 or −1, alternating along the branch.
    pub fn side(&self) -> f32 {
        if self.number.is_multiple_of(2) { 1.0 } else { -1.0 }
    }
}

/// Growth points `spacing` pixels apart on `branches` (each with its index), as far as they lie inside the region.
pub fn growth_points<'a>(
    branches: impl Iterator<Item = (usize, &'a FlatBranch)>,
    region: &Region,
    spacing: f32,
) -> Vec<GrowthPoint> {
    let mut points = Vec::new();
    for (branch, flat) in branches {
        let line: Vec<Vec2> = flat.line.iter().map(|s| s.position).collect();
        let arcs = polyline::arc_lengths(line.iter().copied());
        let length = arcs.last().copied().unwrap_or(0.0);
        let count = (length / spacing) as usize;
        for number in 1..=count {
            let at = (number as f32 * spacing).min(length);
            let place = polyline::locate(&arcs, at);
            let position = polyline::interpolate(&line, place);
            if region.contains(position) {
                let direction = (line[place.0 + 1] - line[place.0]).normalize_or(Vec2::NEG_Y);
                points.push(GrowthPoint {
                    position,
                    direction,
                    attachment: Attachment { branch, at },
                    number,
                });
            }
        }
    }
    points
}
