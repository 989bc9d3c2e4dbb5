//! What blades are copies of: blades of one template of reduced detail and one form differ only in where they stand, so that one of them
//! is bent and given thickness, standing at the origin, and the others are placed.
//!
//! Limits: only flat blades. A blade so small, or so far from the origin, that its thickness would drown in the rounding of
//! its coordinates is no copy: `blade` makes it thicker.

use super::copies::Placement;
use super::flat::FlatBlade;
use super::mesh::Mesh;
use crate::plant::{Blade, Detail, Plant, ResolvedBlade, RestSurface, Shape, TemplateId};
use glam::Vec3;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Half of a blade's thickness is at least this share of its distance from the origin.
pub(super) const THINNEST: f32 = 4e-6;

/// Template of a blade, and its form bit by bit.
type Key = (TemplateId, [u32; 7]);

/// A blade that stands at the origin, u along x and v along y.
#[derive(Clone, Debug)]
pub(super) struct BladeShape {
    pub(super) mesh: Arc<Mesh>,
    /// Extent in its plane and half thickness.
    size: f32,
    half: f32,
}

impl BladeShape {
    pub(super) fn new(mesh: Mesh, flat: &FlatBlade, half: f32) -> Self {
        Self { mesh: Arc::new(mesh), size: flat.size, half }
    }

    /// Where the copy stands that a blade is; `None` for a blade without area, or whose faces would be too near to one
    /// another. Shape and slot are 0.
    pub(super) fn placement<T>(&self, blade: &Blade<T>) -> Option<Placement> {
        let &Blade { base, u, v, .. } = blade;
        u.cross(v).try_normalize()?;
        let (across, along) = (u.length(), v.length());
        let far = base.abs().max_element() + self.size * across.max(along);
        let is_thick_enough = far.is_finite() && self.half * along >= THINNEST * far;
        is_thick_enough.then_some(Placement { shape: 0, slot: 0, base, u, v })
    }
}

/// Which blades of a plant have their shape in common.
pub(super) struct ShapesInCommon<'a> {
    /// For each organ the number of its shape.
    pub(super) of_organ: Vec<Option<u32>>,
    /// For each shape the first blade that has it, with the place of its template.
    pub(super) firsts: Vec<(TemplateId, ResolvedBlade<'a>)>,
}

impl<'a> ShapesInCommon<'a> {
    pub(super) fn of(plant: &'a Plant) -> Self {
        let mut known: BTreeMap<Key, u32> = BTreeMap::new();
        let mut firsts = Vec::new();
        let mut of_organ = Vec::with_capacity(plant.organs.len());
        for organ in &plant.organs {
            let Shape::Blade(blade) = &organ.shape else {
                of_organ.push(None);
                continue;
            };
            of_organ.push(key(plant, blade).map(|key| {
                *known.entry(key).or_insert_with(|| {
                    firsts.push((blade.template, plant.templates.resolve(blade)));
                    firsts.len() as u32 - 1
                })
            }));
        }
        Self { of_organ, firsts }
    }
}

/// The blade as its shape stands.
pub(super) fn standing<'a>(blade: &ResolvedBlade<'a>) -> ResolvedBlade<'a> {
    Blade { base: Vec3::ZERO, u: Vec3::X, v: Vec3::Y, ..*blade }
}

/// What two blades have in common that are copies of one shape; `None` for one that is no copy.
fn key(plant: &Plant, blade: &Blade) -> Option<Key> {
    let is_copy =
        blade.rest == RestSurface::Plane && plant.templates[blade.template].detail() == Detail::Reduced;
    is_copy.then(|| (blade.template, blade.form.to_row().map(f32::to_bits)))
}

#[cfg(test)]
mod tests {
    use super::super::blade::{self, BladeScratch};
    use super::super::flat::{BladeMeshParams, FlatScratch, flatten};
    use super::*;
    use crate::plant::{BladeForm, Template};
    use glam::Vec2;

    fn leaf(base: Vec3, u: Vec3, v: Vec3) -> Blade<Arc<Template>> {
        let point = |k: usize| Vec2::from_angle(k as f32 * 0.1047) * Vec2::new(0.3, 0.5) + Vec2::Y * 0.5;
        let template = Template::new((0..60).map(point).collect(), Vec::new(), 1.0, Detail::Reduced);
        let form = BladeForm { ruffle: 0.05, ruffle_waves: 5.0, ..BladeForm::default() };
        Blade { template: Arc::new(template), base, u, v, rest: RestSurface::Plane, form }
    }

    /// The leaf as a copy, and meshed by itself.
    fn both(leaf: &Blade<Arc<Template>>) -> (Option<Mesh>, Option<Mesh>) {
        let leaf = &leaf.resolved();
        let (params, scratch) = (BladeMeshParams::default(), &mut BladeScratch::default());
        let flat = flatten(leaf.template, None, &params, &mut FlatScratch::default()).unwrap();
        let shape = blade::shape(&standing(leaf), &flat, &params, scratch).unwrap();
        let copy = shape.placement(leaf).map(|placement| {
            let mut copy = Mesh::default();
            placement.append(&shape.mesh, &mut copy);
            copy
        });
        (copy, blade::mesh(leaf, &flat, &params, scratch))
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
