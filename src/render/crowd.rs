//! The plants of a garden on the GPU: each form of each individual once, and one table of where the plants stand, which is ordered anew for
//! each camera so that every form has the plants that are to be seen in it next to one another, those inside of the picture first.
//!
//! The others of a form are drawn into shadow maps alone. A form is the coarsest whose pixels are as many as the plant is wide
//! ([`Sight`]). The order costs a few nanoseconds per plant, and nothing is uploaded while it stays the same.
//!
//! Limits: a table holds as many plants as the device's largest buffer has room for; forms change at once, without a cross-fade.

use super::RenderError;
use super::corner::Tint;
use super::debug;
use super::drawn::{Drawn, PlacementRow};
use super::gpu::Gpu;
use super::shape::ResidentShape;
use super::sight::Sight;
use crate::garden::stock::{Individual, Surface};
use crate::garden::{Crowd, Garden, Place, Stock};
use crate::model::{Mesh, Model};
use glam::{Quat, Vec3};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// A plant as the choice knows it: its individual, counted through all kinds, and the sphere around it.
struct Plant {
    individual: u32,
    centre: Vec3,
    radius: f32,
    rotation: Quat,
}

/// The forms of an individual, the finest first, those from one side each last.
struct Ladder {
    /// The number of the first among all forms.
    first: u32,
    /// Up to which widths the others do, pixels.
    pixels: Vec<f32>,
    /// Toward the viewer, for those from one side each.
    sides: Vec<Vec3>,
    /// Up to which width these do.
    side_pixels: f32,
}

impl Ladder {
    fn new(first: u32, Individual { coarser, views, .. }: &Individual) -> Self {
        Self {
            first,
            pixels: coarser.iter().map(|form| form.pixels).collect(),
            sides: views.forms.iter().map(|(toward, _)| *toward).collect(),
            side_pixels: views.pixels,
        }
    }

    /// The form for a plant that is so wide, with the viewer in this direction from it.
    fn form(&self, width: f32, toward: impl Fn() -> Vec3) -> u32 {
        let of_all_sides = self.first + self.pixels.partition_point(|pixels| width <= *pixels) as u32;
        if width > self.side_pixels {
            return of_all_sides;
        }
        let toward = toward();
        let sides = self.sides.iter().map(|side| side.dot(toward)).zip(0..);
        let nearest = sides.max_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map_or(of_all_sides, |(_, side)| self.first + 1 + self.pixels.len() as u32 + side)
    }
}

/// A surface of a form.
struct CrowdSurface {
    form: u32,
    material: usize,
    shape: ResidentShape,
    /// Indices of its edges, once they were asked for.
    edges: Option<(wgpu::Buffer, u32)>,
}

/// Where the plants of a form are in the table: all, and those inside of the picture.
#[derive(Clone, Default, PartialEq)]
struct Rows {
    all: Range<u32>,
    in_view: Range<u32>,
}

/// The plants of a garden on the GPU.
pub(super) struct CrowdDrawData {
    crowd: Crowd,
    plants: Vec<Plant>,
    rows: Vec<PlacementRow>,
    ladders: Vec<Ladder>,
    surfaces: Vec<CrowdSurface>,
    table: wgpu::Buffer,
    /// For each plant twice the number of its form, and one more where it is outside of the picture.
    chosen: Vec<u32>,
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
        let (mut ladders, mut surfaces) = (Vec::new(), Vec::new());
        let mut forms = 0;
        for kind in &stock.kinds {
            for individual in &kind.individuals {
                ladders.push(Ladder::new(forms, individual));
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
        let (plants, rows) = plants(stock, places)?;
        let table = gpu.buffer("plants", bytemuck::cast_slice(&rows), wgpu::BufferUsages::VERTEX);
        let bytes = shapes.bytes + table.size();
        let (chosen, ranges) = (Vec::new(), vec![Rows::default(); forms as usize]);
        Ok((Self { crowd: crowd.clone(), plants, rows, ladders, surfaces, table, chosen, ranges }, bytes))
    }

    /// Whether these are the plants of that crowd.
    pub(super) fn is_of(&self, crowd: &Crowd) -> bool {
        Arc::ptr_eq(&self.crowd.garden, &crowd.garden) && self.crowd.first_material == crowd.first_material
    }

    /// Chooses for every plant the form in which a camera sees it. Whether any changed.
    pub(super) fn choose(&mut self, gpu: &Gpu, sight: &Sight) -> bool {
        let choice = |plant: &Plant| {
            let Plant { individual, centre, radius, rotation } = *plant;
            let toward = || rotation.inverse() * sight.viewer_from(centre);
            let form = self.ladders[individual as usize].form(sight.width(centre, radius), toward);
            2 * form + u32::from(!sight.sees(centre, radius))
        };
        let chosen: Vec<u32> = self.plants.iter().map(choice).collect();
        if chosen == self.chosen {
            return false;
        }
        let (order, ends) = ordered(&chosen, 2 * self.ranges.len());
        let rows: Vec<PlacementRow> = order.iter().map(|plant| self.rows[*plant as usize]).collect();
        gpu.queue.write_buffer(&self.table, 0, bytemuck::cast_slice(&rows));
        let (ends, _) = ends.as_chunks::<2>();
        let mut begin = 0;
        for (rows, [seen, end]) in self.ranges.iter_mut().zip(ends) {
            *rows = Rows { all: begin..*end, in_view: begin..*seen };
            begin = *end;
        }
        self.chosen = chosen;
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

/// What the choice knows of each plant, and its row of the table.
fn plants(stock: &Stock, places: &[Place]) -> Result<(Vec<Plant>, Vec<PlacementRow>), RenderError> {
    let individuals = stock.kinds.iter().map(|kind| kind.individuals.len());
    let firsts: Vec<usize> =
        individuals.scan(0, |sum, count| Some(std::mem::replace(sum, *sum + count))).collect();
    let spheres: Vec<(Vec3, f32)> =
        stock.kinds.iter().flat_map(|kind| kind.individuals.iter().map(sphere)).collect();
    let of_place = |place: &Place| {
        let individual = firsts.get(place.kind as usize)? + place.variant as usize;
        let (centre, radius) = *spheres.get(individual)?;
        let plant = Plant {
            individual: individual as u32,
            centre: place.point(centre),
            radius: radius * place.scale,
            rotation: place.rotation,
        };
        Some((plant, PlacementRow::from(place)))
    };
    let known = places.iter().filter_map(of_place).collect::<(Vec<_>, Vec<_>)>();
    if known.0.len() < places.len() {
        return Err(RenderError::model("garden", "a plant is a copy of an individual that does not exist"));
    }
    Ok(known)
}

/// A sphere around an individual, around the middle of its box.
fn sphere(individual: &Individual) -> (Vec3, f32) {
    let points = || individual.surfaces.iter().flat_map(|surface| surface.mesh.points.iter().copied());
    let bounds = points().map(|point| (point, point)).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
    let centre = bounds.map_or(Vec3::ZERO, |(low, high)| low.midpoint(high));
    (centre, points().map(|point| point.distance(centre)).fold(0.0, f32::max))
}

/// The numbers of the elements by rising bucket, in their order within each, and where each bucket ends.
fn ordered(bucket_of: &[u32], buckets: usize) -> (Vec<u32>, Vec<u32>) {
    let mut next = vec![0; buckets];
    bucket_of.iter().for_each(|bucket| next[*bucket as usize] += 1);
    let mut begin = 0;
    for count in &mut next {
        begin += std::mem::replace(count, begin);
    }
    let mut order = vec![0; bucket_of.len()];
    for (element, bucket) in (0..).zip(bucket_of) {
        let place = &mut next[*bucket as usize];
        order[*place as usize] = element;
        *place += 1;
    }
    (order, next)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::garden::{Coarser, Views};

    #[test]
    fn the_coarsest_form_that_is_fine_enough_is_chosen() {
        let individual = |coarser: &[f32], sides: &[Vec3]| Individual {
            coarser: coarser.iter().map(|pixels| Coarser { form: Vec::new(), pixels: *pixels }).collect(),
            views: Views { forms: sides.iter().map(|side| (*side, Vec::new())).collect(), pixels: 20.0 },
            ..Individual::default()
        };
        let ladder = Ladder::new(7, &individual(&[200.0, 100.0, 50.0], &[Vec3::X, Vec3::Z, Vec3::Y]));
        let forms =
            [1000.0, 200.5, 200.0, 101.0, 99.0, 51.0, 21.0].map(|width| ladder.form(width, || Vec3::X));
        assert_eq!(forms, [7, 7, 8, 8, 9, 9, 10]);
        let toward = [Vec3::new(0.9, 0.2, 0.1), Vec3::new(0.3, 0.2, 0.7), Vec3::Y, Vec3::NEG_X];
        let sides = toward.map(|toward| ladder.form(3.0, || toward) - 7);
        assert_eq!(sides[..3], [4, 5, 6]);
        assert!((5..=6).contains(&sides[3]), "whichever is not opposite");
        assert_eq!(Ladder::new(3, &individual(&[], &[])).form(1.0, || Vec3::X), 3);
    }

    #[test]
    fn elements_are_ordered_by_their_buckets_and_stay_in_order_within_them() {
        let (order, ends) = ordered(&[2, 0, 2, 4, 0, 2], 5);
        assert_eq!(order, [1, 4, 0, 2, 5, 3]);
        assert_eq!(ends, [2, 2, 5, 5, 6]);
        assert_eq!(ordered(&[], 2), (vec![], vec![0, 0]));
    }
}
