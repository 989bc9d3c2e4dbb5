//! What must hold for every [`Model`] before anybody may rely on its indices.
//!
//! Cheap enough to run before each export. Whether the surfaces are also clean is for [`quality`](super::quality).

use super::{Mesh, Model};

impl Model {
    /// Checks indices, order of parts and finite numbers.
    ///
    /// # Errors
    /// The first violation, in words, naming the part.
    pub fn check_invariants(&self) -> Result<(), String> {
        for (i, part) in self.parts.iter().enumerate() {
            let here = |what: &str| format!("part {i} `{}`: {what}", part.name);
            if part.parent.is_some_and(|parent| parent >= i) {
                return Err(here("its parent stands after it"));
            }
            let mut materials = std::iter::once(&part.material).chain(&part.more_materials);
            if materials.any(|material| *material >= self.materials.len()) {
                return Err(here("material out of range"));
            }
            if part.more_materials.len() != part.mesh.breaks.len() {
                return Err(here("materials and breaks differ in number"));
            }
            if !part.pivot.is_finite() {
                return Err(here("pivot is not finite"));
            }
            part.mesh.check_indices().map_err(|what| here(&what))?;
            if let Some(copies) = &part.copies {
                copies.check_invariants(1 + part.more_materials.len()).map_err(|what| here(&what))?;
            }
        }
        Ok(())
    }
}

impl Mesh {
    /// Checks that all indices are in range and all numbers finite.
    ///
    /// # Errors
    /// The first violation, in words.
    pub fn check_indices(&self) -> Result<(), String> {
        let (points, vertices) = (self.points.len(), self.vertices.len());
        if let Some(i) = self.points.iter().position(|p| !p.is_finite()) {
            return Err(format!("point {i} is not finite"));
        }
        let sound =
            |v: &super::Vertex| (v.point as usize) < points && v.normal.is_finite() && v.uv.is_finite();
        if let Some(i) = self.vertices.iter().position(|v| !sound(v)) {
            return Err(format!("vertex {i} has a point out of range or a number that is not finite"));
        }
        if let Some(i) = self.triangles.iter().position(|t| t.iter().any(|&v| v as usize >= vertices)) {
            return Err(format!("triangle {i} has a vertex out of range"));
        }
        let ends = [self.triangles.len() as u32];
        if !self.breaks.iter().chain(&ends).is_sorted() {
            return Err("breaks are not in order".to_owned());
        }
        Ok(())
    }
}
