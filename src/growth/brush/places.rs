//! Places along the wood that a brush sweeps, at even steps from the base of each branch: so those that are there stay as a stroke
//! goes on.

use crate::geom::polyline;
use crate::growth::volume::Swept;
use crate::plant::{Origin, Plant};
use glam::Vec3;

/// Most places on one branch.
const MOST: usize = 10_000;
/// Length in steps below which a branch that a rule made is the stalk of a leaf or flower, on which nothing else stands.
const STALK: f32 = 3.0;

/// A place on a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// The branch.
    pub(super) branch: usize,
    /// Number of its step from the base.
    pub(super) step: u32,
    /// On the branch's axis, metres.
    pub(super) at: Vec3,
    /// Direction of the branch there.
    pub(super) way: Vec3,
    /// Radius there, metres.
    pub(super) radius: f32,
}

/// The places that a stroke sweeps; steps are of a length in metres.
pub(super) fn places(plant: &Plant, swept: &Swept, step: f32) -> Vec<Place> {
    let (low, high) = swept.bounds();
    let mut places = Vec::new();
    for (branch, wood) in plant.branches.iter().enumerate() {
        let lowest = wood.points.iter().copied().fold(Vec3::INFINITY, Vec3::min);
        let highest = wood.points.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
        if highest.cmplt(low).any() || lowest.cmpgt(high).any() {
            continue;
        }
        let arcs = polyline::arc_lengths(wood.points.iter().copied());
        let length = arcs.last().copied().unwrap_or(0.0);
        if wood.origin == Origin::Generated && length < STALK * step {
            continue;
        }
        let count = ((length / step) as usize).min(MOST);
        let place = |k: usize| {
            let (i, share) = polyline::locate(&arcs, (k as f32 + 0.5) * step);
            let next = (i + 1).min(wood.points.len() - 1);
            let at = polyline::interpolate(&wood.points, (i, share));
            let way = (wood.points[next] - wood.points[i]).try_normalize()?;
            let radius = wood.radii[i] + (wood.radii[next] - wood.radii[i]) * share;
            swept.contains(at).then_some(Place { branch, step: k as u32, at, way, radius })
        };
        places.extend((0..count).filter_map(place));
    }
    places
}

impl Place {
    /// A direction across the branch, turned about it by an angle, radians, from the one that lies in the plane of the sheet.
    pub(super) fn across(&self, turn: f32) -> Vec3 {
        let side = Vec3::Z.cross(self.way).try_normalize().unwrap_or(Vec3::X);
        glam::Quat::from_axis_angle(self.way, turn) * side
    }
}
