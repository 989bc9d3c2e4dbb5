//! Organs that are copies of few shapes: the mesh of each shape once, and where its copies stand.
//!
//! A crown of fifty thousand leaves has a dozen shapes. They stay shapes and placements from here to the graphics card and
//! into glTF; whoever needs one surface, as OBJ and the judges of meshes do, asks for [`Model::flattened`].
//!
//! The shape of a blade stands at the origin, base to tip along y, seen from z; that of a solid has its axis along y. A
//! placement takes x, y and z to u, v, and the direction square to both times the length of v.
//!
//! Limits: a copy that is stretched across has its thickness stretched where it is steep.

use super::mesh::{Mesh, Vertex};
use super::{Model, Part};
use glam::{Mat3, Vec3};
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;

/// Copies that one thread takes at a time.
const CHUNK: usize = 2048;

/// Copies of shapes, all of one part.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Copies {
    /// The shapes; shared with other models built with the same [`Cache`](super::Cache).
    pub shapes: Vec<Arc<Mesh>>,
    /// Where copies stand, those of the part's first material first.
    pub placements: Vec<Placement>,
}

/// Where a copy stands, and what it is a copy of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Index into [`Copies::shapes`].
    pub shape: u32,
    /// Which of the part's materials it has: 0 for [`Part::material`], then those of [`Part::more_materials`].
    pub slot: u32,
    /// Where the shape's origin is, metres.
    pub base: Vec3,
    /// Where the shape's x goes.
    pub u: Vec3,
    /// Where the shape's y goes, not parallel to u.
    pub v: Vec3,
}

impl Placement {
    /// The linear part of the map from the shape to the world.
    pub fn world_from_shape(&self) -> Mat3 {
        let facing = self.u.cross(self.v).normalize_or_zero();
        Mat3::from_cols(self.u, self.v, facing * self.v.length())
    }

    /// The world places of points of the shape.
    pub fn places(&self, points: &[Vec3]) -> impl Iterator<Item = Vec3> {
        let (base, world_from_shape) = (self.base, self.world_from_shape());
        points.iter().map(move |point| base + world_from_shape * *point)
    }

    /// Appends the copy to a mesh.
    pub(super) fn append(&self, shape: &Mesh, to: &mut Mesh) {
        let Self { base, u, v, .. } = *self;
        let (across, along) = (u.length(), v.length());
        let world_from_shape = self.world_from_shape();
        let facing = u.cross(v).normalize_or_zero();
        let square = across * along;
        let is_similar = u.dot(v).abs() < 1e-6 * square && (across - along).abs() < 1e-6 * along;
        let cofactors = Mat3::from_cols(v.cross(facing) * along, facing.cross(u) * along, u.cross(v));
        let turn = cofactors * (1.0 / square);
        let turned = |normal: Vec3| if is_similar { turn * normal } else { (turn * normal).normalize() };
        let (point, vertex, face) = (to.points.len() as u32, to.vertices.len() as u32, to.triangles.len());
        to.points.extend(shape.points.iter().map(|p| base + world_from_shape * *p));
        to.vertices.extend(shape.vertices.iter().map(|corner| Vertex {
            point: corner.point + point,
            normal: turned(corner.normal),
            uv: corner.uv,
        }));
        to.triangles.extend(shape.triangles.iter().map(|triangle| triangle.map(|i| i + vertex)));
        if !is_similar {
            // A strong stretch leaves little of a normal's digits.
            to.split_disagreeing_corners_in(face..to.triangles.len());
        }
    }
}

impl Copies {
    /// The copies with their shapes, in order.
    pub fn iter(&self) -> impl Iterator<Item = (&Mesh, &Placement)> {
        let shape = |placement: &Placement| self.shapes.get(placement.shape as usize).map(Arc::as_ref);
        self.placements.iter().filter_map(move |placement| Some((shape(placement)?, placement)))
    }

    /// All copies in one material, appended to a mesh.
    fn append_slot(&self, slot: usize, to: &mut Mesh) {
        let of_slot = self.placements.chunk_by(|a, b| a.slot == b.slot);
        let Some(placements) = of_slot.into_iter().find(|run| run[0].slot as usize == slot) else { return };
        let baked = placements.par_chunks(CHUNK).map(|chunk| {
            let mut mesh = Mesh::default();
            for placement in chunk {
                if let Some(shape) = self.shapes.get(placement.shape as usize) {
                    let before = mesh.counts();
                    placement.append(shape, &mut mesh);
                    if before == [0; 3] {
                        mesh.reserve_more(before, chunk.len() - 1);
                    }
                }
            }
            mesh
        });
        let baked: Vec<Mesh> = baked.collect();
        to.points.reserve(baked.iter().map(|mesh| mesh.points.len()).sum());
        to.vertices.reserve(baked.iter().map(|mesh| mesh.vertices.len()).sum());
        to.triangles.reserve(baked.iter().map(|mesh| mesh.triangles.len()).sum());
        baked.iter().for_each(|mesh| to.append(mesh));
    }

    /// Checks indices and numbers for a part with so many materials.
    ///
    /// # Errors
    /// The first violation, in words.
    pub fn check_invariants(&self, materials: usize) -> Result<(), String> {
        for (i, shape) in self.shapes.iter().enumerate() {
            shape.check_indices().map_err(|what| format!("shape {i}: {what}"))?;
            if !shape.breaks.is_empty() {
                return Err(format!("shape {i} has several materials"));
            }
        }
        if !self.placements.is_sorted_by_key(|placement| placement.slot) {
            return Err("copies are not ordered by their materials".to_owned());
        }
        for (i, Placement { shape, slot, base, u, v }) in self.placements.iter().enumerate() {
            if *shape as usize >= self.shapes.len() || *slot as usize >= materials {
                return Err(format!("copy {i}: shape or material out of range"));
            }
            if ![base, u, v].into_iter().all(|vector| vector.is_finite()) || u.cross(*v) == Vec3::ZERO {
                return Err(format!("copy {i} stands nowhere"));
            }
        }
        Ok(())
    }
}

impl Part {
    /// All of the part as one mesh: what is no copy, then the copies, material by material.
    pub fn flattened_mesh(&self) -> Arc<Mesh> {
        let Some(copies) = &self.copies else { return self.mesh.clone() };
        let Mesh { points, vertices, triangles, breaks } = self.mesh.as_ref();
        let mut flat = Mesh { points: points.clone(), vertices: vertices.clone(), ..Mesh::default() };
        let ends = breaks.iter().map(|&end| end as usize).chain([triangles.len()]);
        let mut from = 0;
        for (slot, end) in ends.enumerate() {
            if slot > 0 {
                flat.breaks.push(flat.triangles.len() as u32);
            }
            flat.triangles.extend_from_slice(&triangles[from..end]);
            copies.append_slot(slot, &mut flat);
            from = end;
        }
        Arc::new(flat)
    }
}

impl Model {
    /// The same surfaces with every copy as triangles of its part; borrowed if there are no copies.
    pub fn flattened(&self) -> Cow<'_, Self> {
        if self.parts.iter().all(|part| part.copies.is_none()) {
            return Cow::Borrowed(self);
        }
        let flat = |part: &Part| match &part.copies {
            Some(_) => Part { mesh: part.flattened_mesh(), copies: None, ..part.clone() },
            None => part.clone(),
        };
        Cow::Owned(Self { parts: self.parts.iter().map(flat).collect(), materials: self.materials.clone() })
    }
}
