//! What the buds of a plant compete for: light in its shadow grid, or space in a volume filled with markers.

use super::competition::Perception;
use super::markers::Markers;
use super::shadow::Shadow;
use crate::growth::habit::{Habit, Resource};
use crate::growth::limits::Limits;
use crate::growth::volume::Envelope;
use glam::Vec3;

/// What the buds compete for.
#[derive(Clone, Debug)]
pub enum Field {
    /// Light.
    Light(Shadow),
    /// Space.
    Space(Markers),
}

/// The cone in which buds of a habit perceive space.
pub(crate) fn perception(habit: &Habit) -> Perception {
    let half = (0.5 * habit.space.angle).to_radians();
    Perception { radius: habit.space.perception * habit.internode, cos_half: half.cos() }
}

pub(crate) fn field_for(
    habit: &Habit,
    resource: Resource,
    envelope: &Envelope,
    limits: Limits,
    seed: u64,
) -> Field {
    if resource == Resource::Light {
        return Field::Light(Shadow::new(
            &habit.light,
            habit.light.voxel * habit.internode,
            limits.internodes,
        ));
    }
    let radius = habit.space.perception * habit.internode;
    let density = habit.space.markers / (4.0 / 3.0 * std::f32::consts::PI * radius.powi(3));
    let cell = radius.max(habit.space.occupancy * habit.internode);
    if let Envelope::Swept(swept) = envelope {
        return Field::Space(Markers::scatter_in_swept(swept, density, limits.markers, cell, seed));
    }
    // A plant that is bound by nothing gets as much space as its species ever fills.
    let high = habit.height;
    let own = Envelope::Ellipsoid { centre: Vec3::Y * high * 0.55, radii: Vec3::new(0.45, 0.5, 0.45) * high };
    let volume = if envelope.bounds().is_some() { envelope } else { &own };
    Field::Space(Markers::scatter(volume, density, limits.markers, cell, seed))
}

/// Where a trunk enters the crown: a low marker near the middle of the lowest ones.
pub(crate) fn lowest(markers: &Markers) -> Option<Vec3> {
    let mut low: Vec<Vec3> = markers.free().collect();
    low.sort_unstable_by(|a, b| a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x)).then(a.z.total_cmp(&b.z)));
    low.truncate((low.len() / 50).max(1));
    let middle = low.iter().copied().sum::<Vec3>() / low.len().max(1) as f32;
    let bottom = Vec3::new(middle.x, low.first()?.y, middle.z);
    low.into_iter().min_by(|a, b| a.distance_squared(bottom).total_cmp(&b.distance_squared(bottom)))
}
