//! Leaves on the stems of a plant that is made without a drawing, where its species says that they bear some.

use crate::leaf::{Compound, StemLeaves};
use crate::plant::{
    Blade, BladeForm, Detail, Organ, OrganPart, Origin, Plant, RestSurface, Role, Shape, Template, TemplateId,
};
use crate::random::mix;
use crate::species::Species;

/// Leaves and leaflets from which on they are of reduced detail.
const MANY_LEAVES: f32 = 60.0;

/// Adds the leaves of all stems from the ground, behind the organs that the plant has. The rosette is that of the first stem.
pub(super) fn grow(plant: &mut Plant, leaves: &StemLeaves, species: &Species, seed: u64) {
    let from_ground = plant.branches.iter().enumerate().filter(|(_, branch)| branch.parent.is_none());
    let poses: Vec<_> = from_ground
        .flat_map(|(index, branch)| {
            let rosette = if index == 0 { leaves.rosette } else { 0 };
            let poses = StemLeaves { rosette, ..leaves.clone() }.poses(
                &branch.points,
                &branch.radii,
                mix(seed, index as u64),
            );
            poses.into_iter().map(move |pose| (index, pose))
        })
        .collect();
    if poses.is_empty() {
        return;
    }
    let template = template(plant, species, poses.len());
    let blades = poses.into_iter().map(|(index, pose)| {
        let (u, v) = (pose.u * pose.length, pose.v * pose.length);
        let (rest, form) = (RestSurface::Plane, BladeForm::default());
        let shape = Shape::Blade(Blade { template, base: pose.base, u, v, rest, form });
        let (role, origin) = (Role::of(OrganPart::Leaf), Origin::Generated);
        Organ { role, origin, branch: Some(index), flower: None, shape }
    });
    plant.organs.extend(blades);
}

/// The outline of a species' leaves, of which a plant has so many.
pub(super) fn template(plant: &mut Plant, species: &Species, leaves: usize) -> TemplateId {
    let leaflets = species.leaf.compound.as_ref().map_or(1.0, Compound::mean_count);
    let is_rich = leaves as f32 * leaflets > MANY_LEAVES;
    let detail = if is_rich { Detail::Reduced } else { Detail::Moderate };
    plant.templates.add(Template::new(species.leaf.outline.points(), Vec::new(), 1.0, detail))
}
