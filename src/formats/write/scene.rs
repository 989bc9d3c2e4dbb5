//! What every exporter is given.

use super::ExportError;
use crate::formats::textures::BuiltInTextures;
use crate::model::{InstanceGroup, Model, Part};
use crate::plant::{FinishedPlant, Provenance};
use std::borrow::Cow;

/// How copies of one shape are written where the format has a way to say so: glTF.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstanceForm {
    /// A node for each copy, which share a mesh: every program reads it.
    Nodes,
    /// One node with a table of poses: the extension `EXT_mesh_gpu_instancing`, which not every program reads.
    Gpu,
}

/// A plant and what only its drawing knows.
pub type PlantAndProvenance<'a> = (&'a FinishedPlant, &'a Provenance);

/// A sound model and what belongs to it.
pub struct Scene<'a> {
    /// The surfaces; indices in range, numbers finite, every copy as triangles but those of `instances`.
    pub model: Cow<'a, Model>,
    /// The plant that the model was made from.
    pub plant: PlantAndProvenance<'a>,
    /// The program's own textures.
    pub built_in: &'a BuiltInTextures<'a>,
    /// Copies of shapes, which stand beside the model's parts, and how they are written.
    pub instances: Option<(&'a [InstanceGroup], InstanceForm)>,
    /// For each plant its level of detail, 0 for the finest; empty where the model has only one.
    pub level_of_specimen: &'a [usize],
    /// The output file's name without folder and extension; companion files begin with it.
    pub stem: Cow<'a, str>,
}

impl<'a> Scene<'a> {
    /// Checks the model and makes triangles of its copies.
    ///
    /// # Errors
    /// [`ExportError::Unsound`] for a model with indices out of range or numbers that are not finite.
    pub fn new(
        model: &'a Model,
        plant: PlantAndProvenance<'a>,
        built_in: &'a BuiltInTextures<'a>,
        stem: Cow<'a, str>,
    ) -> Result<Self, ExportError> {
        model.check_invariants().map_err(ExportError::Unsound)?;
        Ok(Self { model: model.flattened(), plant, built_in, instances: None, level_of_specimen: &[], stem })
    }

    /// The scene with copies of shapes beside its model.
    ///
    /// # Errors
    /// [`ExportError::Unsound`] for a group whose parent, material or mesh is not there.
    pub fn with_instances(
        self,
        groups: &'a [InstanceGroup],
        form: InstanceForm,
    ) -> Result<Self, ExportError> {
        let (parts, materials) = (self.model.parts.len(), self.model.materials.len());
        let is_sound = |shape: &&Part| {
            shape.parent.is_none_or(|parent| parent < parts)
                && shape.material < materials
                && !shape.mesh.triangles.is_empty()
        };
        match groups.iter().map(|group| &group.shape).find(|shape| !is_sound(shape)) {
            Some(shape) => Err(ExportError::Unsound(format!("instances `{}`", shape.name))),
            None => Ok(Self { instances: Some((groups, form)), ..self }),
        }
    }

    /// The groups of copies.
    pub(super) fn groups(&self) -> &'a [InstanceGroup] {
        self.instances.map_or(&[], |(groups, _)| groups)
    }

    /// Parts with a surface, specimen by specimen, otherwise in the model's order.
    ///
    /// # Errors
    /// [`ExportError::Empty`] without any.
    pub fn surfaces(&self) -> Result<Vec<&Part>, ExportError> {
        let mut parts: Vec<&Part> =
            self.model.parts.iter().filter(|p| !p.mesh.triangles.is_empty()).collect();
        parts.sort_by_key(|part| part.specimen);
        if parts.is_empty() && self.groups().is_empty() { Err(ExportError::Empty) } else { Ok(parts) }
    }

    /// For each material of the model whether a part or a copy has it.
    pub fn used_materials(&self) -> Vec<bool> {
        let mut used = vec![false; self.model.materials.len()];
        let parts = self.model.parts.iter().chain(self.groups().iter().map(|group| &group.shape));
        parts.flat_map(Part::materials).for_each(|material| used[material] = true);
        used
    }
}

/// Name of a specimen's object or root node.
pub(super) fn specimen_name(specimen: usize) -> String {
    format!("plant_{}", specimen + 1)
}
