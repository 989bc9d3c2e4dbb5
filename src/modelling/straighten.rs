//! The line of a branch drawn out straight by the artist.
//!
//! Each piece of the line turns toward the straight way from where that begins to the end, by a share that the pose says. So the
//! base stays and the length does, and the end moves outward. What grows on the branch turns with its place.

use super::joint::Joint;
use crate::geom::polyline;
use glam::{Quat, Vec3};

/// What each piece of a line is turned by, the line being that of a branch before it is turned and bent.
pub(super) fn straightening(line: &[Vec3], arcs: &[f32], joints: &[Joint]) -> Vec<Quat> {
    let mut turns = vec![Quat::IDENTITY; line.len().saturating_sub(1)];
    let mut pieces: Vec<Vec3> = line.windows(2).map(|ends| ends[1] - ends[0]).collect();
    for joint in joints.iter().filter(|joint| joint.pose.straight > 0.0) {
        let (first, _) = polyline::locate(arcs, joint.arc);
        let beyond = first.min(pieces.len())..;
        let Some(way) = pieces[beyond.clone()].iter().sum::<Vec3>().try_normalize() else { continue };
        for (piece, turn) in pieces[beyond.clone()].iter_mut().zip(&mut turns[beyond]) {
            let Some(from) = piece.try_normalize() else { continue };
            let by = Quat::IDENTITY.slerp(Quat::from_rotation_arc(from, way), joint.pose.straight);
            *piece = by * *piece;
            *turn = by * *turn;
        }
    }
    turns
}

/// What the points of a line are turned by, of which the pieces are: the mean of both beside each.
pub(super) fn turns_at_points(pieces: &[Quat]) -> Vec<Quat> {
    let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else { return vec![Quat::IDENTITY] };
    let between = pieces.windows(2).map(|beside| beside[0].slerp(beside[1], 0.5));
    std::iter::once(*first).chain(between).chain([*last]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::{PartName, PartPose};

    /// A zigzag upward.
    fn zigzag() -> Vec<Vec3> {
        (0..=8).map(|k| Vec3::new(if k % 2 == 0 { 0.0 } else { 0.05 }, 0.1 * k as f32, 0.0)).collect()
    }

    fn straightened(line: &[Vec3], arc: f32, straight: f32) -> Vec<Vec3> {
        let pose = PartPose { straight, ..PartPose::still(PartName::Stroke(1)) };
        let arcs = polyline::arc_lengths(line.iter().copied());
        let turns = straightening(line, &arcs, &[Joint { arc, pose }]);
        assert_eq!(turns_at_points(&turns).len(), line.len());
        let mut last = line[0];
        let pieces = line.windows(2).zip(turns).map(|(ends, turn)| {
            last += turn * (ends[1] - ends[0]);
            last
        });
        std::iter::once(line[0]).chain(pieces).collect()
    }

    #[test]
    fn a_line_becomes_straight_with_its_length_and_its_way() {
        let line = zigzag();
        let straight = straightened(&line, 0.0, 1.0);
        let length = polyline::length(&line);
        assert!(straight[8].distance(Vec3::Y * length) < 1e-5, "{}", straight[8]);
        assert!(straight.iter().all(|point| point.x.abs() < 1e-5));
        let half = straightened(&line, 0.0, 0.5);
        assert!((polyline::length(&half) - length).abs() < 1e-5);
        assert!(half[8].y > line[8].y + 0.01 && half[8].y < straight[8].y - 0.001);
        assert_eq!(straightened(&line, 0.0, 0.0), line);
    }

    #[test]
    fn from_a_place_on_what_is_below_stays() {
        let line = zigzag();
        let arc = polyline::length(&line[..5]);
        let upper = straightened(&line, arc + 1e-4, 1.0);
        assert_eq!(upper[..5], line[..5]);
        assert!(upper[8].y > line[8].y + 0.01);
    }
}
