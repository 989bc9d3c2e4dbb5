//! Blades that are copies of one another: bent once, placed many times.
//!
//! Flat blades of one template and one form differ only in where they stand. The first of them is meshed with u and v
//! along x and y; each copy is that mesh under the affine map that takes x, y and z to the blade's u, its v, and the
//! direction that it faces times the length of v. So a crown of fifty thousand leaves is bent a dozen times.
//!
//! Limits: a copy that is stretched across has its thickness stretched where it is steep. A blade so small, or so far
//! from the origin, that its thickness would drown in the rounding of its coordinates is not a copy: `blade` makes it
//! thicker.

use super::blade::THINNEST;
use super::flat::FlatBlade;
use super::instances::Pose;
use super::mesh::{Mesh, Vertex};
use crate::plant::{Blade, Plant, RestSurface, Shape};
use glam::{Mat3, Vec3};
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// Template, length and form of a blade, bit by bit.
type Key = (u32, [u32; 8]);

/// What the blades of a plant are copies of.
pub(super) struct Copies {
    /// For each organ the place of its shape.
    shape_of: Vec<Option<u32>>,
    shapes: Vec<OnceLock<Option<CopiedShape>>>,
}

/// A blade that stands at the origin, u along x and v along y.
pub(super) struct CopiedShape {
    mesh: Mesh,
    /// Extent in its plane and half thickness.
    size: f32,
    half: f32,
}

impl CopiedShape {
    pub(super) fn new(mesh: Mesh, flat: &FlatBlade, half: f32) -> Self {
        Self { mesh, size: flat.size, half }
    }

    /// Whether a copy in the place of the blade has faces that are far enough apart.
    fn is_thick_enough(&self, blade: &Blade) -> bool {
        let (across, along) = (blade.u.length(), blade.v.length());
        let far = blade.base.abs().max_element() + self.size * across.max(along);
        far.is_finite() && self.half * along >= THINNEST * far
    }

    /// Appends a copy to a mesh; whether the blade can be one.
    pub(super) fn append(&self, blade: &Blade, to: &mut Mesh) -> bool {
        let Blade { base, u, v, .. } = *blade;
        let Some(facing) = u.cross(v).try_normalize() else { return false };
        let (across, along) = (u.length(), v.length());
        if !self.is_thick_enough(blade) {
            return false;
        }
        let world_from_shape = Mat3::from_cols(u, v, facing * along);
        let square = across * along;
        let is_similar = u.dot(v).abs() < 1e-6 * square && (across - along).abs() < 1e-6 * along;
        let cofactors = Mat3::from_cols(v.cross(facing) * along, facing.cross(u) * along, u.cross(v));
        let turn = cofactors * (1.0 / square);
        let turned = |normal: Vec3| if is_similar { turn * normal } else { (turn * normal).normalize() };
        let (point, vertex, face) = (to.points.len() as u32, to.vertices.len() as u32, to.triangles.len());
        to.points.extend(self.mesh.points.iter().map(|p| base + world_from_shape * *p));
        to.vertices.extend(self.mesh.vertices.iter().map(|corner| Vertex {
            point: corner.point + point,
            normal: turned(corner.normal),
            uv: corner.uv,
        }));
        to.triangles.extend(self.mesh.triangles.iter().map(|triangle| triangle.map(|i| i + vertex)));
        if !is_similar {
            // A strong stretch leaves little of a normal's digits.
            to.split_disagreeing_corners_from(face);
        }
        true
    }
}

impl Copies {
    pub(super) fn of(plant: &Plant) -> Self {
        let mut known: BTreeMap<Key, u32> = BTreeMap::new();
        let mut shape_of = Vec::with_capacity(plant.organs.len());
        for organ in &plant.organs {
            let key = if let Shape::Blade(blade) = &organ.shape { key(blade) } else { None };
            let next = known.len() as u32;
            shape_of.push(key.map(|key| *known.entry(key).or_insert(next)));
        }
        let shapes = (0..known.len()).map(|_| OnceLock::new()).collect();
        Self { shape_of, shapes }
    }

    /// Appends the blade of an organ as a copy of its shape, which `make` makes if it is the first; whether that was
    /// possible.
    pub(super) fn append(
        &self,
        organ: usize,
        blade: &Blade,
        to: &mut Mesh,
        make: impl FnOnce(&Blade) -> Option<CopiedShape>,
    ) -> bool {
        self.shape(organ, blade, make).is_some_and(|(_, shape)| shape.append(blade, to))
    }

    /// The number of the shape of which the blade of an organ is a copy, and where the copy stands; `None` for a blade
    /// that has a mesh of its own.
    pub(super) fn pose(
        &self,
        organ: usize,
        blade: &Blade,
        make: impl FnOnce(&Blade) -> Option<CopiedShape>,
    ) -> Option<(u32, Pose)> {
        let (number, shape) = self.shape(organ, blade, make)?;
        shape.is_thick_enough(blade).then(|| Pose::of(blade)).flatten().map(|pose| (number, pose))
    }

    /// The mesh of a shape that has been made.
    pub(super) fn mesh(&self, shape: u32) -> Option<&Mesh> {
        Some(&self.shapes.get(shape as usize)?.get()?.as_ref()?.mesh)
    }

    fn shape(
        &self,
        organ: usize,
        blade: &Blade,
        make: impl FnOnce(&Blade) -> Option<CopiedShape>,
    ) -> Option<(u32, &CopiedShape)> {
        let number = self.shape_of[organ]?;
        let standing = || Blade { base: Vec3::ZERO, u: Vec3::X, v: Vec3::Y, ..blade.clone() };
        let shape = self.shapes[number as usize].get_or_init(|| make(&standing()));
        shape.as_ref().map(|shape| (number, shape))
    }
}

/// What two blades have in common that are copies of one shape; `None` for one that is no copy.
fn key(blade: &Blade) -> Option<Key> {
    if blade.rest != RestSurface::Plane {
        return None;
    }
    let form = blade.form.to_row();
    let mut words = [blade.length.to_bits(); 8];
    words.iter_mut().zip(form).for_each(|(word, value)| *word = value.to_bits());
    Some((blade.template?, words))
}

#[cfg(test)]
mod tests {
    use super::super::blade::{self, BladeScratch};
    use super::super::flat::{BladeMeshParams, FlatScratch, flatten};
    use super::*;
    use crate::plant::BladeForm;
    use glam::Vec2;

    fn leaf(base: Vec3, u: Vec3, v: Vec3) -> Blade {
        let point = |k: usize| Vec2::from_angle(k as f32 * 0.1047) * Vec2::new(0.3, 0.5) + Vec2::Y * 0.5;
        Blade {
            outline: (0..60).map(point).collect(),
            curl: Vec::new(),
            base,
            u,
            v,
            length: 1.0,
            rest: RestSurface::Plane,
            form: BladeForm { ruffle: 0.05, ruffle_waves: 5.0, ..BladeForm::default() },
            template: Some(0),
        }
    }

    /// The leaf as a copy, and meshed by itself.
    fn both(leaf: &Blade) -> (Option<Mesh>, Option<Mesh>) {
        let (params, scratch) = (BladeMeshParams::default(), &mut BladeScratch::default());
        let flat = flatten(leaf, &params, &mut FlatScratch::default()).unwrap();
        let standing = Blade { base: Vec3::ZERO, u: Vec3::X, v: Vec3::Y, ..leaf.clone() };
        let shape = blade::copied_shape(&standing, &flat, &params, scratch).unwrap();
        let mut copy = Mesh::default();
        let copied = shape.append(leaf, &mut copy);
        (copied.then_some(copy), blade::mesh(leaf, &flat, &params, scratch))
    }

    #[test]
    fn a_copy_is_the_leaf_itself() {
        let v = Vec3::new(0.3, 0.5, -0.4);
        let leaf = leaf(Vec3::new(2.0, 3.0, -1.0), v.cross(Vec3::Z).normalize() * v.length(), v);
        let (copy, own) = both(&leaf);
        let (copy, own) = (copy.unwrap(), own.unwrap());
        copy.check_invariants().unwrap();
        assert_eq!(copy.triangles, own.triangles);
        for (a, b) in copy.points.iter().zip(&own.points) {
            assert!(a.distance(*b) < 1e-5, "{a} instead of {b}");
        }
        for (a, b) in copy.vertices.iter().zip(&own.vertices) {
            assert!(a.normal.distance(b.normal) < 1e-3 && a.uv == b.uv);
        }
    }

    #[test]
    fn a_stretched_copy_is_sound() {
        let (copy, _) = both(&leaf(Vec3::Y, Vec3::X * 0.02, Vec3::new(0.0, 0.05, 0.06)));
        copy.unwrap().check_invariants().unwrap();
    }

    #[test]
    fn what_would_drown_in_rounding_is_no_copy() {
        assert!(both(&leaf(Vec3::X * 500.0, Vec3::Z * 0.1, Vec3::Y * 0.1)).0.is_none());
        assert!(both(&leaf(Vec3::ZERO, Vec3::Y, Vec3::Y)).0.is_none());
        assert!(both(&leaf(Vec3::NAN, Vec3::X, Vec3::Y)).0.is_none());
    }
}
