//! Copies of one shape on the GPU: its corners and triangles once, and a table of where the copies stand.
//!
//! All copies of a shape in one material are drawn in one call. A table holds as many copies as the device's largest buffer
//! has room for, which is more leaves than a plant may have.

use super::RenderError;
use super::corner::Tint;
use super::drawn::{Drawn, PlacementRow};
use super::gpu::Gpu;
use super::shape::ResidentShape;
use crate::model::{Copies, Mesh, Model, Part, Placement};
use glam::Vec3;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Copies of one shape in one material of a part: the part's index, and the numbers of the copies among the part's.
pub(super) struct Group<'a> {
    pub(super) part: usize,
    pub(super) material: usize,
    pub(super) shape: &'a Arc<Mesh>,
    pub(super) placements: Vec<&'a Placement>,
}

/// All copies of a model in groups.
pub(super) fn groups(model: &Model) -> Vec<Group<'_>> {
    let mut groups = Vec::new();
    let parts = model.parts.iter().enumerate();
    for (part, one, copies) in parts.filter_map(|(i, part)| Some((i, part, part.copies.as_deref()?))) {
        let mut of_part: BTreeMap<(u32, u32), Vec<&Placement>> = BTreeMap::new();
        for placement in &copies.placements {
            of_part.entry((placement.slot, placement.shape)).or_default().push(placement);
        }
        groups.extend(of_part.into_iter().filter_map(|((slot, shape), placements)| {
            let (material, shape) = (one.material_of_slot(slot), copies.shapes.get(shape as usize)?);
            Some(Group { part, material, shape, placements })
        }));
    }
    groups
}

/// Refuses copies that contradict themselves.
///
/// # Errors
/// What is wrong with them.
pub(super) fn check(part: &Part, copies: &Copies) -> Result<(), RenderError> {
    let sound = copies.check_invariants(1 + part.more_materials.len());
    sound.map_err(|_| RenderError::model(&part.name, "its copies refer to what does not exist"))
}

/// A group on the GPU.
pub(super) struct ResidentCopies {
    pub(super) material: usize,
    pub(super) shape: ResidentShape,
    /// Where they stand, as it was uploaded.
    placements: Vec<Placement>,
    pub(super) drawn: Drawn,
    pub(super) bounds: (Vec3, Vec3),
}

impl ResidentCopies {
    /// Uploads a group. Returns it with the number of bytes.
    pub(super) fn new(gpu: &Gpu, group: &Group<'_>, tint: Tint) -> (Self, u64) {
        let (shape, bytes) = ResidentShape::new(gpu, group.shape, tint);
        let rows = rows(group);
        let table = gpu.buffer("placements", bytemuck::cast_slice(&rows), wgpu::BufferUsages::VERTEX);
        let bytes = bytes + table.size();
        let copies = Self {
            material: group.material,
            drawn: shape.drawn(table, 0..rows.len() as u32),
            shape,
            placements: group.placements.iter().copied().copied().collect(),
            bounds: bounds(group),
        };
        (copies, bytes)
    }

    /// Whether it shows copies of this shape in this material, with this tint.
    pub(super) fn is_of(&self, group: &Group<'_>, tint: Tint) -> bool {
        self.material == group.material && self.shape.is(group.shape, tint)
    }

    /// Puts the copies where those of a group of the same shape stand. Returns the number of bytes that were uploaded, none
    /// if they stood there.
    pub(super) fn place(&mut self, gpu: &Gpu, group: &Group<'_>) -> u64 {
        if self.placements.iter().eq(group.placements.iter().copied()) {
            return 0;
        }
        let rows = rows(group);
        self.placements = group.placements.iter().copied().copied().collect();
        self.bounds = bounds(group);
        let table = gpu.buffer("placements", bytemuck::cast_slice(&rows), wgpu::BufferUsages::VERTEX);
        self.drawn = self.shape.drawn(table, 0..rows.len() as u32);
        self.drawn.placements.size()
    }

    /// The edges of the shape's triangles, in place of the triangles.
    pub(super) fn edges(&self, gpu: &Gpu) -> Drawn {
        let (indices, count) = self.shape.edges(gpu);
        Drawn { indices, range: 0..count, ..self.drawn.clone() }
    }
}

fn rows(group: &Group<'_>) -> Vec<PlacementRow> {
    group.placements.iter().map(|placement| PlacementRow::from(*placement)).collect()
}

fn bounds(group: &Group<'_>) -> (Vec3, Vec3) {
    let places = group.placements.iter().flat_map(|placement| placement.places(&group.shape.points));
    places.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)))
}
