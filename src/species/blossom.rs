//! A tree in blossom: its flower buds open, and some of its leaves stand as small flowers.
//!
//! A tree is drawn with leaf outlines, hundreds of leaves at once; nobody draws its petals. The chosen leaves give
//! their place and direction to a flower of the species' first look, which the rest of [`super::apply()`] treats like
//! any drawn flower. Each is as large as the leaf in whose place it stands, so that flowers open as buds grow.

use super::looks::BlossomLook;
use super::sepals::blade_at;
use crate::plant::{
    BladeForm, Cone, Detail, Flower, FlowerBud, FlowerBuds, Organ, OrganKind, OrganPart, Origin, Plant,
    ResolvedBlade, Role, Shape, Template, TemplateId,
};
use glam::{Quat, Vec2, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use std::f32::consts::TAU;

/// Radius of the flower's centre, as a share of the reach.
const CENTRE: f32 = 0.08;

/// Opens a plant's flower buds and replaces leaves by flowers, whose petals are all copies of one template. Says whether fewer
/// open than the species asks for, because a plant may not have more than `most`.
pub(super) fn blossom(
    plant: &mut Plant,
    buds: &FlowerBuds,
    look: &BlossomLook,
    most: usize,
    rng: &mut Pcg64Mcg,
) -> bool {
    let Some(mean) = mean_leaf_length(plant) else { return false };
    let reach = mean * look.reach;
    let length = reach * (1.0 - CENTRE);
    let outline = notched(length, look);
    let template = plant.templates.add(Template::new(outline, Vec::new(), length, Detail::Reduced));
    let share = affordable_share(plant, look.share, most.saturating_sub(buds.buds.len()));
    let room = (plant.organs.len() as f32 * (1.0 + share * look.petals as f32)) as usize;
    let organs = std::mem::replace(&mut plant.organs, Vec::with_capacity(room));
    let open = |plant: &mut Plant, bud: &FlowerBud, rng: &mut Pcg64Mcg| {
        let size = bud.v.length() / mean;
        let flower = Flower { look: plant.flowers.len(), ..pose(bud, reach * size, look) };
        plant.organs.extend(petals((&flower, size), plant.flowers.len(), look, template, rng));
        plant.flowers.push(flower);
    };
    for organ in organs {
        let opens = is_generated_leaf(&organ) && rng.random_bool(f64::from(share));
        match &organ.shape {
            Shape::Blade(leaf) if opens => {
                let bud = bud_of(&plant.templates.resolve(leaf), &organ);
                open(plant, &bud, rng);
            }
            _ => plant.organs.push(organ),
        }
    }
    buds.buds.iter().for_each(|bud| open(plant, bud, rng));
    plant.drop_unused_templates();
    buds.is_thinned || share < look.share
}

/// The bud in a leaf's place.
fn bud_of(leaf: &ResolvedBlade<'_>, &Organ { origin, branch, .. }: &Organ) -> FlowerBud {
    let v = leaf.v * leaf.template.length();
    FlowerBud { origin, branch, base: leaf.base, u: leaf.u, v, look: 0, open: 1.0 }
}

fn is_generated_leaf(organ: &Organ) -> bool {
    organ.kind() == OrganKind::Leaf && !organ.origin.is_drawn()
}

/// The share of leaves that open: as many as the species asks for, but at most so many leaves.
fn affordable_share(plant: &Plant, wanted: f32, most: usize) -> f32 {
    let leaves = plant.organs.iter().filter(|organ| is_generated_leaf(organ)).count();
    wanted.min(most as f32 / leaves.max(1) as f32)
}

fn length_of(leaf: &ResolvedBlade<'_>) -> f32 {
    leaf.template.length() * leaf.v.length()
}

fn mean_leaf_length(plant: &Plant) -> Option<f32> {
    let length = |organ: &Organ| match &organ.shape {
        Shape::Blade(leaf) if is_generated_leaf(organ) => Some(length_of(&plant.templates.resolve(leaf))),
        _ => None,
    };
    let lengths: Vec<f32> = plant.organs.iter().filter_map(length).collect();
    let mean = lengths.iter().sum::<f32>() / lengths.len().max(1) as f32;
    (mean.is_finite() && mean > 0.0).then_some(mean)
}

/// The flower in a bud's place: it looks between the bud's direction and the side that the bud shows.
fn pose(bud: &FlowerBud, reach: f32, look: &BlossomLook) -> Flower {
    let out = bud.v.normalize_or(Vec3::Y);
    let face = bud.u.cross(bud.v).normalize_or(Vec3::Z);
    let axis = (out + face).normalize_or(Vec3::Y);
    let opening_rad = look.opening_deg.clamp(5.0, 85.0).to_radians();
    let cone =
        Cone { apex: bud.base + out * (0.4 * reach), axis, opening_rad, height: reach * opening_rad.cos() };
    Flower { origin: bud.origin, branch: bud.branch, cone, centre_radius: CENTRE * reach, reach, look: 0 }
}

/// The petals of a flower of a size; their template is that of a flower of size 1.
fn petals<'a>(
    (flower, size): (&'a Flower, f32),
    index: usize,
    look: &BlossomLook,
    template: TemplateId,
    rng: &mut Pcg64Mcg,
) -> impl Iterator<Item = Organ> + 'a {
    let Cone { apex, axis, opening_rad, .. } = flower.cone;
    let turn = rng.random_range(0.0..TAU);
    let count = look.petals;
    let side = axis.any_orthonormal_vector();
    (0..count).map(move |k| {
        let radial = Quat::from_axis_angle(axis, turn + TAU * k as f32 / count as f32) * side;
        let v = axis * opening_rad.cos() + radial * opening_rad.sin();
        let face = axis * opening_rad.sin() - radial * opening_rad.cos();
        let base = apex + v * (CENTRE * flower.reach);
        let blade = blade_at(base, v * size, face, BladeForm::default(), template);
        Organ {
            role: Role::of(OrganPart::Petal),
            origin: Origin::Generated,
            branch: flower.branch,
            flower: Some(index),
            shape: Shape::Blade(blade),
        }
    })
}

/// Petal outline, widest near the tip, with a notch in it.
fn notched(length: f32, look: &BlossomLook) -> Vec<Vec2> {
    let half = 0.5 * look.width.max(0.1);
    let right = [(0.22, 0.1), (0.75, 0.35), (1.0, 0.65), (0.78, 0.9), (0.3, 1.0)];
    let at = |side: f32, (u, v): (f32, f32)| Vec2::new(side * half * u, v) * length;
    let left = right.iter().rev().map(|p| at(-1.0, *p));
    let notch = Vec2::new(0.0, 1.0 - look.notch.min(0.5)) * length;
    std::iter::once(Vec2::ZERO).chain(right.iter().map(|p| at(1.0, *p))).chain([notch]).chain(left).collect()
}
