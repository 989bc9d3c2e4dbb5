//! The plants of a garden on the GPU: each form of each individual once, and one table of where the plants stand, which is ordered anew for
//! each camera so that every form has the plants that are to be seen in it next to one another (`crowd_choice.rs`), those inside of the
//! picture first.
//!
//! The others of a form are drawn into shadow maps alone. Nothing is uploaded while the order stays the same.
//!
//! Limits: a table holds as many plants as the device's largest buffer has room for.

use super::RenderError;
use super::corner::Tint;
use super::crowd_choice::{CrowdChoice, Rows};
use super::debug;
use super::drawn::{Drawn, PlacementRow};
use super::gpu::Gpu;
use super::shape::ResidentShape;
use super::sight::Sight;
use crate::garden::stock::Surface;
use crate::garden::{Crowd, Garden};
use crate::model::{Mesh, Model};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// So many rows of the table are copied by one thread at a time.
const AT_ONCE: usize = 4096;

/// A surface of a form.
struct CrowdSurface {
    form: u32,
    material: usize,
    shape: ResidentShape,
    /// Indices of its edges, once they were asked for.
    edges: Option<(wgpu::Buffer, u32)>,
}

/// The plants of a garden on the GPU.
pub(super) struct CrowdDrawData {
    crowd: Crowd,
    choice: CrowdChoice,
    /// Of each plant.
    rows: Vec<PlacementRow>,
    /// The same as they are in the table.
    ordered: Vec<PlacementRow>,
    surfaces: Vec<CrowdSurface>,
    table: wgpu::Buffer,
    /// By form.
    ranges: Vec<Rows>,
}

impl CrowdDrawData {
    /// Uploads a crowd, but for shapes that `known` has. Returns it with the number of bytes.
    ///
    /// # Errors
    /// A crowd that contradicts the model beside it or itself, or is too large for the device.
    pub(super) fn new(
        gpu: &Gpu,
        model: &Model,
        crowd: &Crowd,
        known: Option<&Self>,
    ) -> Result<(Self, u64), RenderError> {
        let Garden { stock, places, .. } = &*crowd.garden;
        let table_bytes = (places.len() * size_of::<PlacementRow>()) as u64;
        if table_bytes > gpu.largest_buffer {
            return Err(RenderError::model("garden", "it has more plants than the graphics card takes"));
        }
        let mut shapes = Shapes::of(known);
        let mut surfaces = Vec::new();
        let mut forms = 0;
        for kind in &stock.kinds {
            for individual in &kind.individuals {
                for form in individual.forms() {
                    for surface in form {
                        let material = crowd.first_material + surface.material;
                        check(&kind.name, surface, material < model.materials.len())?;
                        let tint = debug::tint(surface.kind, 0, &kind.name);
                        let shape = shapes.shape(gpu, &surface.mesh, tint);
                        surfaces.push(CrowdSurface { form: forms, material, shape, edges: None });
                    }
                    forms += 1;
                }
            }
        }
        let choice = CrowdChoice::new(stock, places)?;
        let rows: Vec<PlacementRow> = places.iter().map(PlacementRow::from).collect();
        let table = gpu.buffer("plants", bytemuck::cast_slice(&rows), wgpu::BufferUsages::VERTEX);
        let bytes = shapes.bytes + table.size();
        let ranges = vec![Rows::default(); forms as usize];
        Ok((Self { crowd: crowd.clone(), choice, rows, ordered: Vec::new(), surfaces, table, ranges }, bytes))
    }

    /// Whether these are the plants of that crowd.
    pub(super) fn is_of(&self, crowd: &Crowd) -> bool {
        Arc::ptr_eq(&self.crowd.garden, &crowd.garden) && self.crowd.first_material == crowd.first_material
    }

    /// Chooses for every plant the form in which a camera sees it. Whether any changed.
    pub(super) fn choose(&mut self, gpu: &Gpu, sight: &Sight) -> bool {
        let Some((order, ranges)) = self.choice.choose(sight) else { return false };
        let rows = &self.rows;
        let rows = order.par_iter().with_min_len(AT_ONCE).map(|plant| rows[*plant as usize]);
        rows.collect_into_vec(&mut self.ordered);
        gpu.queue.write_buffer(&self.table, 0, bytemuck::cast_slice(&self.ordered));
        self.ranges = ranges;
        true
    }

    /// All surfaces with their materials and the plants that are to be seen in them.
    pub(super) fn drawn(&self) -> impl Iterator<Item = (usize, Drawn)> {
        self.surfaces.iter().map(|surface| (surface.material, self.faces_of(surface)))
    }

    /// All faces with their tints.
    pub(super) fn faces(&self) -> impl Iterator<Item = (Drawn, &wgpu::Buffer)> {
        self.surfaces.iter().map(|surface| (self.faces_of(surface), &surface.shape.tints))
    }

    /// The edges of all triangles with their tints, uploaded when they are first asked for.
    pub(super) fn edges(&mut self, gpu: &Gpu) -> Vec<(Drawn, wgpu::Buffer)> {
        for surface in &mut self.surfaces {
            surface.edges.get_or_insert_with(|| surface.shape.edges(gpu));
        }
        let of_surface = |surface: &CrowdSurface| {
            let (indices, count) = surface.edges.clone()?;
            let edges = Drawn { indices, range: 0..count, ..self.faces_of(surface) };
            Some((edges, surface.shape.tints.clone()))
        };
        self.surfaces.iter().filter_map(of_surface).collect()
    }

    /// Lets the edges go.
    pub(super) fn forget_edges(&mut self) {
        self.surfaces.iter_mut().for_each(|surface| surface.edges = None);
    }

    /// Whether the picture of a material must repeat.
    pub(super) fn repeats(&self, material: usize) -> bool {
        self.surfaces.iter().any(|surface| surface.material == material && surface.shape.repeats)
    }

    fn faces_of(&self, surface: &CrowdSurface) -> Drawn {
        let Rows { all, in_view } = self.ranges[surface.form as usize].clone();
        Drawn { in_view, ..surface.shape.drawn(self.table.clone(), all) }
    }
}

/// Shapes that are on the GPU, by where their meshes are in memory.
struct Shapes {
    known: BTreeMap<(usize, Tint), ResidentShape>,
    /// How many bytes were uploaded.
    bytes: u64,
}

impl Shapes {
    fn of(crowd: Option<&CrowdDrawData>) -> Self {
        let surfaces = crowd.into_iter().flat_map(|crowd| &crowd.surfaces);
        let known = surfaces.map(|CrowdSurface { shape, .. }| (shape.key(), shape.clone()));
        Self { known: known.collect(), bytes: 0 }
    }

    fn shape(&mut self, gpu: &Gpu, mesh: &Arc<Mesh>, tint: Tint) -> ResidentShape {
        let known = self.known.get(&(Arc::as_ptr(mesh) as usize, tint)).filter(|shape| shape.is(mesh, tint));
        known.cloned().unwrap_or_else(|| {
            let (shape, bytes) = ResidentShape::new(gpu, mesh, tint);
            self.bytes += bytes;
            self.known.insert(shape.key(), shape.clone());
            shape
        })
    }
}

/// Refuses a surface that contradicts itself.
fn check(kind: &str, surface: &Surface, has_material: bool) -> Result<(), RenderError> {
    if !has_material || surface.mesh.check_indices().is_err() {
        return Err(RenderError::model(kind, "an individual refers to what does not exist"));
    }
    Ok(())
}
