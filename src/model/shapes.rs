//! What organs are copies of. Blades of one template of reduced detail and one form differ only in where they stand, so that one
//! of them is bent and given thickness, upright at the origin, and the others are placed. So are domes and the heads of
//! filaments, and fruits: those of one proportion differ in place and size, and one of radius 1 is made; and cards with one part of a picture.
//!
//! Limits: only flat blades and those on patches; threads, which all bend in their own way, are no copies. A blade so small, or
//! so far from the origin, that its thickness would drown in the rounding of its coordinates is no copy: `blade` makes it
//! thicker.

use super::copies::Placement;
use super::fineness::{self, Fineness, Finenesses};
use super::flat::FlatBlade;
use super::mesh::Mesh;
use super::solids::{Proportion, Proportions, Stand};
use crate::plant::{Blade, Organ, Plant, ResolvedBlade, RestSurface, Shape, TemplateId};
use glam::{Vec2, Vec3};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Half of a blade's thickness is at least this share of its distance from the origin.
pub(super) const THINNEST: f32 = 4e-6;

/// What organs have in common that are copies of one shape: of blades the template, the form bit by bit, and the address of the
/// patch on which they lie.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    Blade(TemplateId, [u32; 8], Option<usize>),
    Dome(Proportion, Fineness),
    Head(Proportion, Fineness),
    Lathe(Proportions, Fineness),
    Card([u32; 4], bool),
}

/// What a shape is made from.
#[derive(Clone, Debug)]
pub(super) enum Original<'a> {
    /// The first blade that has it, with the place of its template.
    Blade(TemplateId, ResolvedBlade<'a>),
    /// The height of a dome in radii.
    Dome(Proportion, Fineness),
    /// The half length of a head in radii.
    Head(Proportion, Fineness),
    /// The profile of a lathed body in its largest radius.
    Lathe(Proportions, Fineness),
    /// What part of its picture a card shows.
    Card([Vec2; 2], bool),
}

/// The mesh of a shape. That of a blade stands at the origin, u along x and v along y; that of a solid has its axis along y
/// and the radius 1.
#[derive(Clone, Debug)]
pub(super) struct CopyShape {
    pub(super) mesh: Arc<Mesh>,
    /// Extent in its plane and half thickness of a blade.
    sheet: Option<(f32, f32)>,
}

impl CopyShape {
    /// The shape of a blade and half its thickness.
    pub(super) fn blade(mesh: Mesh, flat: &FlatBlade, half: f32) -> Self {
        Self::sheet(mesh, flat.size, half)
    }

    /// A shape of this extent in its plane and this half thickness.
    pub(super) fn sheet(mesh: Mesh, size: f32, half: f32) -> Self {
        Self { mesh: Arc::new(mesh), sheet: Some((size, half)) }
    }

    /// The shape of a solid; `None` if it encloses nothing.
    pub(super) fn solid(mesh: Mesh) -> Option<Self> {
        (!mesh.triangles.is_empty()).then(|| Self { mesh: Arc::new(mesh), sheet: None })
    }

    /// Where the copy stands that an organ of this shape is; `None` for one without area, or for a blade whose faces would be
    /// too near to one another. Shape and slot are 0.
    pub(super) fn placement(&self, shape: &Shape) -> Option<Placement> {
        let placement = match shape {
            Shape::Blade(Blade { base, u, v, .. }) => {
                Placement { shape: 0, slot: 0, base: *base, u: *u, v: *v }
            }
            Shape::Card { base, u, v, .. } => Placement { shape: 0, slot: 0, base: *base, u: *u, v: *v },
            Shape::Dome { base, axis, radius, .. } => Stand { base: *base, axis: *axis }.placement(*radius),
            Shape::Filament { points, head, .. } => Stand::of_head(points)?.placement(head.x),
            Shape::Lathe { base, axis, profile } => {
                Stand { base: *base, axis: *axis }.placement(fineness::widest(profile))
            }
            Shape::Spike { .. } => return None,
        };
        let Placement { base, u, v, .. } = placement;
        u.cross(v).try_normalize()?;
        let is_sound = match self.sheet {
            None => base.is_finite(),
            Some((size, half)) => {
                let (across, along) = (u.length(), v.length());
                let far = base.abs().max_element() + size * across.max(along);
                far.is_finite() && half * along >= THINNEST * far
            }
        };
        is_sound.then_some(placement)
    }
}

/// Which organs of a plant have their shape in common.
pub(super) struct ShapesInCommon<'a> {
    /// For each organ the number of its shape; for a filament of that of its head.
    pub(super) of_organ: Vec<Option<u32>>,
    /// What each shape is made from.
    pub(super) originals: Vec<Original<'a>>,
}

impl<'a> ShapesInCommon<'a> {
    pub(super) fn of(plant: &'a Plant, finenesses: &Finenesses) -> Self {
        let mut known: BTreeMap<Key, u32> = BTreeMap::new();
        let mut originals = Vec::new();
        let number = |organ: &'a Organ| {
            let (key, original) = key(plant, organ, finenesses)?;
            Some(*known.entry(key).or_insert_with(|| {
                originals.push(original);
                originals.len() as u32 - 1
            }))
        };
        let of_organ = plant.organs.iter().map(number).collect();
        Self { of_organ, originals }
    }
}

/// The blade as its shape stands.
pub(super) fn upright<'a>(blade: &ResolvedBlade<'a>) -> ResolvedBlade<'a> {
    Blade { base: Vec3::ZERO, u: Vec3::X, v: Vec3::Y, ..blade.clone() }
}

/// What an organ has in common with others of its shape, and what the shape is made from; `None` for one that is no copy.
fn key<'a>(plant: &'a Plant, organ: &Organ, finenesses: &Finenesses) -> Option<(Key, Original<'a>)> {
    match &organ.shape {
        Shape::Blade(blade) => {
            let resolved = plant.templates.resolve(blade);
            let is_copy = resolved.template.detail().is_shared() && !is_on_cone(&blade.rest);
            let form = blade.form.to_row().map(f32::to_bits);
            let patch = match &blade.rest {
                RestSurface::Patch(patch) => Some(Arc::as_ptr(patch).addr()),
                RestSurface::Ring(sheet) => Some(Arc::as_ptr(sheet).addr()),
                RestSurface::Plane | RestSurface::Cone { .. } | RestSurface::Shaped { .. } => None,
            };
            let key = Key::Blade(blade.template, form, patch);
            is_copy.then_some((key, Original::Blade(blade.template, resolved)))
        }
        Shape::Dome { radius, height, .. } => {
            let proportion = Proportion::of(*radius, *height)?;
            let fineness = finenesses.at(organ);
            Some((Key::Dome(proportion, fineness), Original::Dome(proportion, fineness)))
        }
        Shape::Filament { head, .. } => {
            let proportion = Proportion::of(head.x, head.y)?;
            let fineness = finenesses.at(organ);
            Some((Key::Head(proportion, fineness), Original::Head(proportion, fineness)))
        }
        Shape::Card { window: window @ [low, high], is_whole, .. } => {
            let key = [low.x, low.y, high.x, high.y].map(f32::to_bits);
            Some((Key::Card(key, *is_whole), Original::Card(*window, *is_whole)))
        }
        Shape::Lathe { profile, .. } => {
            let (proportions, fineness) = (Proportions::of(profile)?, finenesses.at(organ));
            Some((Key::Lathe(proportions.clone(), fineness), Original::Lathe(proportions, fineness)))
        }
        Shape::Spike { .. } => None,
    }
}

/// Whether a surface lies in the world by itself, so that it is nobody's copy.
fn is_on_cone(rest: &RestSurface) -> bool {
    matches!(rest, RestSurface::Cone { .. } | RestSurface::Shaped { .. })
}

#[cfg(test)]
mod tests {
    use super::super::blade::{self, BladeScratch};
    use super::super::flat::{BladeMeshParams, FlatScratch, flatten};
    use super::*;
    use crate::plant::{BladeForm, Detail, Template, Templates};
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
        let shape = blade::shape(&upright(leaf), &flat, &params, scratch).unwrap();
        let placed = Shape::Blade(leaf.with_template(Templates::default().add(leaf.template.clone())));
        let copy = shape.placement(&placed).map(|placement| {
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
