//! A model in which many copies of one shape stay copies: the mesh of a shape once, and where its copies stand.
//!
//! [`build`](super::build()) bakes every leaf into one mesh, which any program can show. Here blades of one template, form
//! and material are a group instead: one mesh, and a pose for each blade. A crown of fifty thousand leaves then has a
//! dozen meshes, whatever its size.
//!
//! Limits: what is drawn, solids, filaments and blades on cones stay meshes of their own, as do blades that are stretched
//! askew, for a pose only turns, moves and scales.

use super::{Model, Part};
use crate::plant::Blade;
use glam::{Mat3, Quat, Vec3};

/// A model whose copies stand apart from its other parts.
#[derive(Clone, Debug, Default)]
pub struct InstancedModel {
    /// Everything that is no copy.
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
    /// The pose of a flat blade whose shape stands with u along x and v along y; `None` where it is stretched askew or has
    /// no size.
    pub(super) fn of(blade: &Blade) -> Option<Self> {
        let Blade { base, u, v, .. } = *blade;
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

impl InstancedModel {
    /// Triangles that are seen, every copy counted.
    pub fn triangle_count(&self) -> usize {
        let copies = self.groups.iter().map(|group| group.poses.len() * group.shape.mesh.triangles.len());
        self.model.triangle_count() + copies.sum::<usize>()
    }

    /// Triangles that are kept in memory, those of each shape once.
    pub fn kept_triangle_count(&self) -> usize {
        let shapes = self.groups.iter().map(|group| group.shape.mesh.triangles.len());
        self.model.triangle_count() + shapes.sum::<usize>()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{ModelParams, build, build_instanced};
    use crate::growth::{Limits, Simulation, plant_at};
    use crate::species::{self, Species};
    use glam::Vec3;

    #[test]
    fn copies_stand_where_the_baked_leaves_are() {
        // The cherry is mostly wood and stamens.
        for (name, most) in [("oak", 0.5), ("cherry", 1.0)] {
            let species = Species::built_in(name).unwrap();
            let mut simulation = Simulation::new(species.growth.as_ref().unwrap(), 1, Limits::default());
            simulation.grow_to(6, &|| false);
            let plant =
                species::apply(plant_at(&simulation, 6.0), &crate::plant::Provenance::default(), &species, 1)
                    .plant;
            let mut params = ModelParams::default();
            params.blade.gathered = true;
            let (baked, instanced) = (build(&plant, &params), build_instanced(&plant, &params));
            assert_eq!(instanced.triangle_count(), baked.triangle_count(), "{name}");
            let kept = instanced.kept_triangle_count() as f32;
            assert!(kept < most * baked.triangle_count() as f32, "{name}: {kept} triangles are kept");
            assert_eq!(instanced.model.check_invariants(), Ok(()));
            let leaves = baked.parts.iter().find(|part| part.name == "leaves").unwrap();
            let of_leaves = instanced.groups.iter().filter(|group| group.shape.kind == leaves.kind);
            let placed: Vec<Vec3> = of_leaves
                .flat_map(|group| group.poses.iter().map(move |pose| (group, pose)))
                .flat_map(|(group, pose)| group.shape.mesh.points.iter().map(|p| pose.place(*p)))
                .collect();
            let baked = &leaves.mesh.points;
            assert_eq!(placed.len(), baked.len(), "{name}: all leaves are copies");
            // In another order, so each axis by itself, from one end of the plant to the other.
            for axis in 0..3 {
                let (here, there) = (along(axis, &placed), along(axis, baked));
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
