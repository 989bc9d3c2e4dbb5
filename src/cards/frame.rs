//! Where a cluster's cards lie.
//!
//! Their axis leads from the cluster's foot to the middle of its organs. The first card lies in the plane through that axis in
//! which the cluster is widest, the second square to it.

use super::clusters::{Cluster, extremes};
use crate::plant::Plant;
use glam::{Mat3, Vec2, Vec3};

/// How much larger a card is than what it shows, share of its extent to each side: leaves are bent.
const MARGIN: f32 = 0.04;
/// Least extent to a side, share of the height.
const THINNEST: f32 = 0.02;

/// From which side a card shows its cluster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// As wide as it is.
    Wide,
    /// Square to that.
    Narrow,
}

impl Side {
    /// Both, in the order of their rows in the picture.
    pub(super) const ALL: [Self; 2] = [Self::Wide, Self::Narrow];
}

/// A box around a cluster: x the widest way across, y its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    foot: Vec3,
    /// Columns are unit vectors, right-handed.
    axes: Mat3,
    low: Vec3,
    high: Vec3,
}

impl Frame {
    /// That of a cluster; `None` for one without extent.
    pub(super) fn new(plant: &Plant, cluster: &Cluster) -> Option<Self> {
        let of_organs = cluster.organs.iter().flat_map(|&organ| extremes(plant, &plant.organs[organ]));
        let twigs = cluster.branches.iter().flat_map(|&branch| plant.branches[branch].points.iter().copied());
        let organs: Vec<Vec3> = of_organs.collect();
        let middle = organs.iter().sum::<Vec3>() / organs.len().max(1) as f32;
        let along = (middle - cluster.foot).try_normalize()?;
        let axes = widest(&organs, middle, along);
        Self::around(cluster.foot, axes, organs.iter().copied().chain(twigs))
    }

    /// An upright box around the whole plant; `None` for one without extent.
    pub(super) fn upright(plant: &Plant) -> Option<Self> {
        let wood = plant.branches.iter().flat_map(|branch| branch.points.iter().copied());
        let organs = plant.organs.iter().flat_map(|organ| extremes(plant, organ));
        Self::around(Vec3::ZERO, Mat3::IDENTITY, wood.chain(organs))
    }

    /// The same box for other points.
    pub(super) fn around_points(&self, points: impl Iterator<Item = Vec3>) -> Option<Self> {
        Self::around(self.foot, self.axes, points)
    }

    fn around(foot: Vec3, axes: Mat3, points: impl Iterator<Item = Vec3>) -> Option<Self> {
        let points = points.map(|point| axes.transpose() * (point - foot));
        let (low, high) =
            points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let margin = ((high - low) * MARGIN).max(Vec3::splat(THINNEST * (high.y - low.y)));
        let is_sound = (high - low).is_finite() && high.y - low.y > 0.0;
        is_sound.then_some(Self { foot, axes, low: low - margin, high: high + margin })
    }

    /// Thickness as a share of the width.
    pub(super) fn flatness(&self) -> f32 {
        let extent = self.high - self.low;
        extent.z / extent.x
    }

    /// Middle of the lower edge, width and height of a card, metres.
    pub(super) fn card(&self, side: Side) -> (Vec3, Vec3, Vec3) {
        let (Mat3 { x_axis, y_axis, z_axis }, extent) = (self.axes, self.high - self.low);
        let middle = 0.5 * (self.low + self.high);
        let base = self.foot + self.axes * Vec3::new(middle.x, self.low.y, middle.z);
        match side {
            Side::Wide => (base, x_axis * extent.x, y_axis * extent.y),
            Side::Narrow => (base, z_axis * extent.z, y_axis * extent.y),
        }
    }
}

/// Axes with y along the cluster and x across where the points are spread most.
fn widest(points: &[Vec3], middle: Vec3, along: Vec3) -> Mat3 {
    let (x, z) = along.any_orthonormal_pair();
    let flat = |point: &Vec3| Vec2::new((*point - middle).dot(x), (*point - middle).dot(z));
    let moments =
        points.iter().map(flat).fold(Vec3::ZERO, |sum, p| sum + Vec3::new(p.x * p.x, p.y * p.y, p.x * p.y));
    let turn = Vec2::from_angle(0.5 * (2.0 * moments.z).atan2(moments.x - moments.y));
    let across = (x * turn.x + z * turn.y).normalize();
    Mat3::from_cols(across, along, across.cross(along))
}
