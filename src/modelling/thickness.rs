//! Branches made thicker or thinner by the artist, with all that grows on them.
//!
//! Limits: no branch becomes thicker than what it grows on, and one that was as thick already stays so.

use super::joint::Joint;
use crate::geom::polyline;
use crate::plant::Branch;
use glam::Vec3;

/// Share of its parent's radius that a branch made thicker may have.
pub(super) const NARROWER: f32 = 0.92;

/// How many times as thick a branch becomes along its line.
pub(super) struct Thickened {
    /// Where its points were.
    rest: Vec<Vec3>,
    /// How far from its base each factor begins, metres, and what it is.
    factors: Vec<(f32, f32)>,
}

impl Thickened {
    /// That of a branch on a parent that becomes so many times as thick; none where nothing changes.
    pub(super) fn new(branch: &Branch, on_parent: f32, joints: &[Joint]) -> Option<Self> {
        let own = joints.iter().map(|joint| (joint.arc, joint.pose.thickness));
        let mut factors: Vec<(f32, f32)> = std::iter::once((0.0, on_parent)).chain(own).collect();
        factors.retain(|(_, factor)| *factor != 1.0);
        (!factors.is_empty()).then(|| Self { rest: branch.points.clone(), factors })
    }

    /// How many times as thick it becomes so far from its base.
    fn along(&self, arc: f32) -> f32 {
        self.factors.iter().filter(|(from, _)| *from <= arc).map(|(_, factor)| factor).product()
    }

    /// The same at the place that was nearest to a point.
    pub(super) fn at(&self, point: Vec3) -> f32 {
        self.along(polyline::nearest(&self.rest, point).map_or(0.0, |(_, arc)| arc))
    }
}

/// Makes a branch thicker, at most nearly as thick as its parent.
pub(super) fn thicken(branches: &mut [Branch], index: usize, thickened: &Thickened) {
    let on = branches[index].parent.zip(branches[index].points.first());
    let most = on.map_or(f32::INFINITY, |(parent, base)| NARROWER * branches[parent].axis_at(*base).1);
    let arcs = polyline::arc_lengths(thickened.rest.iter().copied());
    for (radius, arc) in branches[index].radii.iter_mut().zip(arcs) {
        *radius = (*radius * thickened.along(arc)).min(most.max(*radius));
    }
}
