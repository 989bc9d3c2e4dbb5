//! What a plant grows in: the field that its buds compete for, and its habit fitted into a given volume.

use super::competition::Perception;
use super::envelope::Envelope;
use super::limits::Limits;
use super::markers::Markers;
use super::shadow::Shadow;
use super::species::{Habit, Resource};
use glam::Vec3;

/// Internodes that a crown which is grown into is at least high: drawn crowns need fine wood.
const FINE: f32 = 55.0;
/// Leaves that a crown which is grown into is at least high, and half as many as it is at most.
const LEAFY: f32 = 20.0;

/// What the buds compete for.
#[derive(Clone, Debug)]
pub enum Field {
    /// Light.
    Light(Shadow),
    /// Space.
    Space(Markers),
}

/// The cone in which buds of a habit perceive space.
pub fn perception(habit: &Habit) -> Perception {
    let half = (0.5 * habit.space.angle).to_radians();
    Perception { radius: habit.space.perception * habit.internode, cos_half: half.cos() }
}

pub(super) fn field_for(
    habit: &Habit,
    resource: Resource,
    envelope: &Envelope,
    limits: Limits,
    seed: u64,
) -> Field {
    if resource == Resource::Light {
        return Field::Light(Shadow::new(&habit.light, habit.light.voxel * habit.internode));
    }
    let radius = habit.space.perception * habit.internode;
    let density = habit.space.markers / (4.0 / 3.0 * std::f32::consts::PI * radius.powi(3));
    // A plant that is bound by nothing gets as much space as its species ever fills.
    let high = habit.height;
    let own = Envelope::Ellipsoid { centre: Vec3::Y * high * 0.55, radii: Vec3::new(0.45, 0.5, 0.45) * high };
    let volume = if envelope.bounds().is_some() { envelope } else { &own };
    let cell = radius.max(habit.space.occupancy * habit.internode);
    Field::Space(Markers::strew(volume, density, limits.markers, cell, seed))
}

/// The habit as it fills a volume: internodes and leaves short enough for it, buds that seek its space before they
/// follow the species, nothing shed. Phyllotaxis, angles, wood and leaves stay the species' own.
pub(super) fn fitted(habit: &Habit, envelope: &Envelope) -> Habit {
    let mut habit = habit.clone();
    if let Some((low, high)) = envelope.bounds() {
        let size = (high - low).max_element();
        if size > 0.0 {
            let fine = size / habit.fineness;
            habit.internode = habit.internode.min(fine / FINE);
            habit.leaf.length = habit.leaf.length.clamp(fine / (2.0 * LEAFY), fine / LEAFY);
        }
    }
    (habit.bole, habit.clearance, habit.shed) = (0.0.into(), 0.0.into(), 0.0.into());
    habit.seeking = habit.seeking.at_least(0.9);
    habit.supply = habit.supply.at_least(4.0);
    habit.shoot = habit.shoot.max(8);
    habit.lambda = habit.lambda.at_least(0.5);
    habit.ramification = habit.ramification.at_least(0.9);
    habit.bud_life = habit.bud_life.max(12);
    habit.leaf.per_internode = habit.leaf.per_internode.max(3);
    habit.leaf.at_tip = habit.leaf.at_tip.max(6);
    for lift in [&mut habit.lift, &mut habit.lift_branch, &mut habit.lift_twig] {
        *lift = lift.times(0.25);
    }
    habit
}

/// Where a trunk enters the crown: a low marker near the middle of the lowest ones.
pub(super) fn lowest(markers: &Markers) -> Option<Vec3> {
    let mut low: Vec<Vec3> = markers.free().collect();
    low.sort_unstable_by(|a, b| a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x)).then(a.z.total_cmp(&b.z)));
    low.truncate((low.len() / 50).max(1));
    let middle = low.iter().copied().sum::<Vec3>() / low.len().max(1) as f32;
    let bottom = Vec3::new(middle.x, low.first()?.y, middle.z);
    low.into_iter().min_by(|a, b| a.distance_squared(bottom).total_cmp(&b.distance_squared(bottom)))
}
