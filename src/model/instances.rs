//! Copies by their shapes, as glTF wants them: the mesh of a shape once, and turn, size and place of its copies.
//!
//! The copies of a part become a group for each shape and material. Limits: a pose only turns, moves and scales, so copies
//! that are stretched askew become triangles of their part.

use super::copies::{Copies, Placement};
use super::{Model, Part};
use glam::{Mat3, Quat, Vec3};
use smol_str::format_smolstr;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A model whose copies stand apart from its other parts.
#[derive(Clone, Debug, Default)]
pub struct InstancedModel {
    /// Everything that is no copy; a part of copies alone has a mesh without triangles.
    pub model: Model,
    /// The copies.
    pub groups: Vec<InstanceGroup>,
}

/// Copies of one shape that have one material.
#[derive(Clone, Debug)]
pub struct InstanceGroup {
    /// The shape as a part, named like `leaves_shape_0`: its mesh at the origin, base to tip along y; its pivot where the
    /// copies are attached all together.
    pub shape: Part,
    /// Where the copies stand in the world.
    pub poses: Vec<Pose>,
}

/// Where a copy stands: its shape is scaled, then turned, then moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Where the shape's origin is, metres.
    pub base: Vec3,
    /// How it is turned.
    pub rotation: Quat,
    /// How it is scaled along its own axes, positive.
    pub scale: Vec3,
}

impl Pose {
    /// The pose of a copy; `None` where it is stretched askew or has no size.
    fn of(placement: &Placement) -> Option<Self> {
        let Placement { base, u, v, .. } = *placement;
        let (across, along) = (u.length(), v.length());
        let facing = u.cross(v).try_normalize()?;
        if u.dot(v).abs() > 1e-4 * across * along {
            return None;
        }
        let y = v / along;
        let rotation = Quat::from_mat3(&Mat3::from_cols(y.cross(facing), y, facing)).normalize();
        let scale = Vec3::new(across, along, along);
        (base.is_finite() && scale.is_finite()).then_some(Self { base, rotation, scale })
    }

    /// The world place of a point of the shape.
    pub fn place(&self, point: Vec3) -> Vec3 {
        self.base + self.rotation * (self.scale * point)
    }
}

impl From<&Model> for InstancedModel {
    fn from(model: &Model) -> Self {
        let mut groups = Vec::new();
        let parts = model.parts.iter().map(|part| match &part.copies {
            Some(copies) => without_copies(part, copies, &mut groups),
            None => part.clone(),
        });
        let parts = parts.collect();
        Self { model: Model { parts, materials: model.materials.clone() }, groups }
    }
}

/// The part with those copies only that no pose can be given, as triangles; the others go into groups.
fn without_copies(part: &Part, copies: &Copies, groups: &mut Vec<InstanceGroup>) -> Part {
    let mut poses: BTreeMap<(u32, u32), Vec<Pose>> = BTreeMap::new();
    let mut askew = Vec::new();
    for placement in &copies.placements {
        match Pose::of(placement) {
            Some(pose) => poses.entry((placement.slot, placement.shape)).or_default().push(pose),
            None => askew.push(*placement),
        }
    }
    for (number, ((slot, shape), poses)) in poses.into_iter().enumerate() {
        let Some(mesh) = copies.shapes.get(shape as usize).cloned() else { continue };
        let (name, material) = (format_smolstr!("{}_shape_{number}", part.name), part.material_of_slot(slot));
        let shape = Part { name, material, more_materials: Vec::new(), mesh, copies: None, ..part.clone() };
        groups.push(InstanceGroup { shape, poses });
    }
    let askew = Copies { shapes: copies.shapes.clone(), placements: askew };
    let rest = Part { copies: Some(Arc::new(askew)), ..part.clone() };
    Part { mesh: rest.flattened_mesh(), copies: None, ..rest }
}

#[cfg(test)]
mod tests {
    use super::super::{Cache, ModelParams, Part, build, rebuild};
    use super::InstancedModel;
    use crate::growth::{Limits, PlantAtAge, Simulation, plant_at};
    use crate::plant::Provenance;
    use crate::species::{self, Species};
    use glam::Vec3;

    #[test]
    fn copies_stand_where_the_baked_leaves_are() {
        // The cherry is mostly wood and the threads of stamens.
        for (name, age, most) in [("ash", 8, 0.5), ("cherry", 12, 0.4)] {
            let species = Species::built_in(name).unwrap();
            let mut simulation = Simulation::new(species.growth.as_ref().unwrap(), 1, Limits::default());
            simulation.grow_to(age, &|| false);
            let PlantAtAge { plant, buds } = plant_at(&simulation, f32::from(age));
            let plant = species::apply(plant, &buds, &Provenance::default(), &species, 1).plant;
            let mut params = ModelParams::default();
            params.blade.gathered = true;
            let built = build(&plant, &params);
            assert_eq!(built.check_invariants(), Ok(()), "{name}");
            assert!(
                rebuild(&plant, &params, &mut Cache::default(), &|| false).as_ref() == Some(&built),
                "{name}"
            );
            let (baked, instanced) = (built.flattened(), InstancedModel::from(&built));
            let copies =
                instanced.groups.iter().map(|group| group.poses.len() * group.shape.mesh.triangles.len());
            let seen = instanced.model.triangle_count() + copies.sum::<usize>();
            assert_eq!(seen, baked.triangle_count(), "{name}");
            assert_eq!(built.triangle_count(), baked.triangle_count(), "{name}");
            assert_eq!(built.bounds(), baked.bounds(), "{name}");
            let is_copied =
                |part: &str| instanced.groups.iter().any(|group| group.shape.name.starts_with(part));
            for part in ["petals", "receptacles", "anthers"] {
                assert_eq!(is_copied(part), name == "cherry", "{part} of {name}");
            }
            assert!(is_copied("leaves") && !is_copied("stamens"), "{name}");
            let shapes = instanced.groups.iter().map(|group| group.shape.mesh.triangles.len());
            let kept = (instanced.model.triangle_count() + shapes.sum::<usize>()) as f32;
            assert!(kept < most * baked.triangle_count() as f32, "{name}: {kept} triangles are kept");
            assert_eq!(instanced.model.check_invariants(), Ok(()));
            let of_groups = instanced.groups.iter().flat_map(|group| {
                let points = &group.shape.mesh.points;
                group.poses.iter().flat_map(move |pose| points.iter().map(|point| pose.place(*point)))
            });
            let of_parts = instanced.model.parts.iter().flat_map(Part::points);
            let placed: Vec<Vec3> = of_parts.chain(of_groups).collect();
            let baked: Vec<Vec3> = baked.parts.iter().flat_map(Part::points).collect();
            assert_eq!(placed.len(), baked.len(), "{name}");
            // In another order, so each axis by itself, from one end of the plant to the other.
            for axis in 0..3 {
                let (here, there) = (along(axis, &placed), along(axis, &baked));
                let off = here.iter().zip(&there).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
                assert!(off < 1e-4, "{name}: {off} m off along axis {axis}");
            }
        }
    }

    /// Coordinates of points along an axis, rising.
    fn along(axis: usize, points: &[Vec3]) -> Vec<f32> {
        let mut along: Vec<f32> = points.iter().map(|point| point[axis]).collect();
        along.sort_by(f32::total_cmp);
        along
    }
}
