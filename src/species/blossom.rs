//! A tree in blossom: its flower buds open, and some of its leaves stand as small flowers.
//!
//! A tree is drawn with leaf outlines, hundreds of leaves at once; nobody draws its petals. The chosen leaves give
//! their place and direction to a flower of the species' first look, which the rest of [`super::apply()`] treats like
//! any drawn flower. Each is as large as the leaf in whose place it stands, so that flowers open as buds grow. Where a leaf is the
//! picture of a whole shoot, as of an apple, a cluster of flowers stands on it and the leaf stays.

use super::looks::BlossomLook;
use super::sepals::blade_at;
use crate::geom::GOLDEN_RAD;
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
/// Distance of the second flower of a cluster from the first, in reaches; others lie about both as seeds of a sunflower do.
const APART: f32 = 1.15;
/// How far the outermost flowers of a cluster lean outward, as a share of their distance from its middle over their reach.
const LEAN: f32 = 0.4;
/// How high over a leaf that stays its flowers stand, in reaches.
const ABOVE: f32 = 0.45;

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
    let most = most.saturating_sub(buds.buds.len()) / look.cluster as usize;
    let share = affordable_share(plant, look.share, most);
    let room = (plant.organs.len() as f32 * (1.0 + share * (look.petals * look.cluster) as f32)) as usize;
    let organs = std::mem::replace(&mut plant.organs, Vec::with_capacity(room));
    let open = |plant: &mut Plant, bud: &FlowerBud, rng: &mut Pcg64Mcg| {
        let size = bud.v.length() / mean;
        let flower = Flower { look: plant.flowers.len(), ..pose(bud, reach * size, look) };
        plant.organs.extend(petals((&flower, size), plant.flowers.len(), look, template, rng));
        plant.flowers.push(flower);
    };
    for organ in organs {
        let opens = is_generated_leaf(&organ) && rng.random_bool(f64::from(share));
        let bud = match &organ.shape {
            Shape::Blade(leaf) if opens => Some(bud_of(&plant.templates.resolve(leaf), &organ)),
            _ => None,
        };
        if let Some(bud) = &bud {
            // Most stand at the outer end.
            let along =
                if look.along > 0.0 { look.along * rng.random_range(0.0..=1.0_f32).sqrt() } else { 0.0 };
            let flowers = (0..look.cluster).map(|nth| clustered(bud, nth, along, reach, look));
            flowers.for_each(|bud| open(plant, &bud, rng));
        }
        if bud.is_none() || look.with_leaves {
            plant.organs.push(organ);
        }
    }
    buds.buds.iter().for_each(|bud| open(plant, bud, rng));
    plant.drop_unused_templates();
    buds.is_thinned || share < look.share
}

/// The bud of a cluster's `nth` flower, the first of which stands so far along the leaf, in its length.
fn clustered(leaf: &FlowerBud, nth: u32, along: f32, reach: f32, look: &BlossomLook) -> FlowerBud {
    let (across, out) = (leaf.u.normalize_or(Vec3::X), leaf.v.normalize_or(Vec3::Y));
    let face = across.cross(out);
    // Over a leaf that stays the sky is looked at, whichever of its sides that faces.
    let above = if look.with_leaves { ABOVE.copysign(face.y) } else { 0.0 };
    let (distance, angle) = (APART * (nth as f32).sqrt(), GOLDEN_RAD * nth as f32);
    let aside = (across * angle.cos() + out * angle.sin()) * distance;
    let base = leaf.base + leaf.v * along + (aside + face * above) * reach;
    let turn = Quat::from_rotation_arc(out, (out + aside * LEAN).normalize_or(out));
    let u = turn * leaf.u * if above < 0.0 { -1.0 } else { 1.0 };
    FlowerBud { base, u, v: turn * leaf.v, ..*leaf }
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
