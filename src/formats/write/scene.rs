//! What every exporter is given.

use super::ExportError;
use crate::formats::textures::BuiltInTextures;
use crate::model::{Model, Part};
use crate::plant::FinishedPlant;
use std::borrow::Cow;

/// A sound model and what belongs to it.
pub struct Scene<'a> {
    /// The surfaces; indices in range, numbers finite.
    pub model: &'a Model,
    /// The plant that the model was made from.
    pub plant: &'a FinishedPlant,
    /// The program's own textures.
    pub built_in: &'a BuiltInTextures<'a>,
    /// The output file's name without folder and extension; companion files begin with it.
    pub stem: Cow<'a, str>,
}

impl<'a> Scene<'a> {
    /// Checks the model.
    ///
    /// # Errors
    /// [`ExportError::Unsound`] for a model with indices out of range or numbers that are not finite.
    pub fn new(
        model: &'a Model,
        plant: &'a FinishedPlant,
        built_in: &'a BuiltInTextures<'a>,
        stem: Cow<'a, str>,
    ) -> Result<Self, ExportError> {
        model.check_invariants().map_err(ExportError::Unsound)?;
        Ok(Self { model, plant, built_in, stem })
    }

    /// Parts with a surface, specimen by specimen, otherwise in the model's order.
    ///
    /// # Errors
    /// [`ExportError::Empty`] without any.
    pub fn surfaces(&self) -> Result<Vec<&'a Part>, ExportError> {
        let mut parts: Vec<&Part> =
            self.model.parts.iter().filter(|p| !p.mesh.triangles.is_empty()).collect();
        parts.sort_by_key(|part| part.specimen);
        if parts.is_empty() { Err(ExportError::Empty) } else { Ok(parts) }
    }

    /// For each material of the model whether a part has it.
    pub fn used_materials(&self) -> Vec<bool> {
        let mut used = vec![false; self.model.materials.len()];
        self.model
            .parts
            .iter()
            .flat_map(Part::material_slots)
            .for_each(|(material, _)| used[material] = true);
        used
    }
}

/// Name of a specimen's object or root node.
pub(super) fn specimen_name(specimen: usize) -> String {
    format!("plant_{}", specimen + 1)
}
