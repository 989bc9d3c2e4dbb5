//! Where the parts of one flower sit: the frame and proportions of its centre.
//!
//! Everything stands inside the petals' cone. A ring of radius r touches the cone at height r / tan(opening) above the
//! apex, so a disc of that radius put there covers the petals' roots and is not pierced by them; in a narrow, shut
//! flower the disc shrinks so that it still lies deep between the petals.

use super::full::FullSeat;
use crate::plant::Flower;
use glam::{Quat, Vec3};

/// Largest disc, as a share of the reach and of the rim's radius.
const LARGEST_DISC: (f32, f32) = (0.6, 0.55);
/// How far a disc goes beyond the petals' roots so that it covers them.
const OVERLAP: f32 = 1.08;
/// How far a disc lies above the petals, as a share of its radius, because their margins rise from the cone.
const CLEARANCE: f32 = 0.06;

/// How much of the room between the innermost petals the disc of a full flower fills.
const WITHIN: f32 = 0.85;
/// Where what stands behind full flowers begins: share of the radius on which the outermost petals stand, and thicknesses of a
/// petal behind them.
const BEHIND: f32 = 0.9;
const CLEAR_BEHIND: f32 = 2.0;

/// Frame and proportions of a flower's centre, metres.
#[derive(Clone, Copy)]
pub(super) struct Seat {
    /// Where the petals meet.
    pub(super) apex: Vec3,
    /// Direction in which the flower opens.
    pub(super) axis: Vec3,
    /// Unit vector across the axis, toward the middle of the first petal.
    pub(super) side: Vec3,
    /// Angle between axis and petals, radians.
    pub(super) opening_rad: f32,
    /// Distance from the centre to the petals' tips.
    pub(super) reach: f32,
    /// Radius of the disc.
    pub(super) radius: f32,
    /// Height of the disc's underside above the apex.
    pub(super) floor: f32,
    /// Height of the disc above its underside.
    pub(super) height: f32,
    /// How far from the axis what stands behind the petals begins.
    pub(super) rim: f32,
    /// Whether filaments begin in the disc, not on it.
    pub(super) is_rooted: bool,
}

impl Seat {
    /// The seat of a flower whose first petal points at `first_petal` and whose disc has at least the radius `disc_radius` (share of the reach) and the height
    /// `disc_height` (share of its radius).
    pub(super) fn new(flower: &Flower, first_petal: Vec3, disc_radius: f32, disc_height: f32) -> Self {
        let Flower { cone, centre_radius, reach, .. } = flower;
        let axis = cone.axis.normalize();
        let side = (first_petal - cone.apex).reject_from_normalized(axis).try_normalize();
        let opening_rad = cone.opening_rad.clamp(0.05, 1.55);
        let drawn = if centre_radius.is_finite() { centre_radius * OVERLAP } else { 0.0 };
        let largest = (LARGEST_DISC.0 * reach).min(LARGEST_DISC.1 * reach * opening_rad.sin());
        let radius = drawn.max(disc_radius * reach).min(largest).max(0.01 * reach);
        Self {
            apex: cone.apex,
            axis,
            side: side.unwrap_or_else(|| axis.any_orthonormal_vector()),
            opening_rad,
            reach: *reach,
            radius,
            floor: radius * (1.0 / opening_rad.tan() + CLEARANCE),
            height: radius * disc_height,
            rim: 0.0,
            is_rooted: true,
        }
    }

    /// The seat of what stands inside of the layers of a full flower, whose petals begin around it.
    pub(super) fn inside(&self, full: &FullSeat) -> Self {
        let radius = self.radius.min((WITHIN * full.core).max(0.01 * self.reach));
        let height = self.height * radius / self.radius;
        Self { radius, floor: 0.0, height, is_rooted: false, ..*self }
    }

    /// The seat of what stands behind its outermost petals.
    pub(super) fn behind(&self, full: &FullSeat) -> Self {
        let apex = full.base - self.axis * (CLEAR_BEHIND * full.thickness);
        let (opening_rad, reach, rim) = (full.outer_opening_rad, full.reach, BEHIND * full.receptacle);
        Self { apex, opening_rad, reach, rim, ..*self }
    }

    /// Unit vector across the axis at an angle from the first petal.
    pub(super) fn around(&self, angle_rad: f32) -> Vec3 {
        Quat::from_axis_angle(self.axis, angle_rad) * self.side
    }

    /// Height of the disc's surface above the apex at a distance from the axis.
    pub(super) fn surface(&self, distance: f32) -> f32 {
        let share = (distance / self.radius).clamp(0.0, 1.0);
        self.floor + self.height * (1.0 - share * share).sqrt()
    }
}
