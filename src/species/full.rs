//! Full flowers of a plant: flower buds open, and flowers of which hardly any petal was drawn get theirs in layers.
//!
//! A flower that was drawn with several petals keeps them. One or two petals say what a petal looks like: the flower gets its
//! layers of such petals. Where a plant has many flowers of one look, they are copies of a few, in few stages of opening.

use super::looks::{FlowerLook, Species};
use crate::flower::{FullFlower, Layers, Pose, full_flower};
use crate::plant::{
    Cone, Detail, Flower, FlowerBud, FlowerBuds, Organ, OrganKind, OrganPart, Origin, Plant, Role, Shape,
    Template, TemplateId,
};
use crate::random::mix;
use glam::Vec3;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Drawn petals up to which a flower gets its layers.
const FEW_DRAWN: usize = 2;
/// Flowers of one look from which on they are copies of one another, and from which on these are of reduced detail.
const MANY: usize = 12;
const VERY_MANY: usize = 60;
/// How many different flowers copies are of.
const DIFFERENT: u64 = 4;
/// Stages of opening that copies have.
const STAGES: f32 = 12.0;

/// What is known of a flower with layers, beside what stands in the plant.
#[derive(Clone, Copy, Debug)]
pub(super) struct FullSeat {
    /// Where its petals begin, metres.
    pub(super) base: Vec3,
    /// Angle between the axis and the outermost petals, radians.
    pub(super) outer_opening_rad: f32,
    /// Distance from the axis within which no petal begins, metres.
    pub(super) core: f32,
    /// Distance from the axis at which the outermost petals begin, metres.
    pub(super) receptacle: f32,
    /// Thickness of the petals, metres.
    pub(super) thickness: f32,
    /// Distance from the centre to the tips in bloom, metres.
    pub(super) reach: f32,
}

/// What a flower that comes from a bud has beside its cone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Opening {
    /// How far it opens of what its look does.
    open: f32,
    /// Across the axis, toward the first petal; none for flowers that were drawn.
    side: Option<Vec3>,
}

/// Makes flowers of a plant's buds where the species has full ones, `most` at most, and discs of those that have no petals. What
/// is known of all flowers of the plant.
pub(super) fn open_buds(
    plant: &mut Plant,
    buds: &FlowerBuds,
    species: &Species,
    most: usize,
) -> Vec<Opening> {
    let mut openings = vec![Opening { open: 1.0, side: None }; plant.flowers.len()];
    if species.flowers.is_empty() || species.blossom.is_some() {
        return openings;
    }
    for bud in buds.buds.iter().take(most) {
        let Some(axis) = bud.v.try_normalize() else { continue };
        let (reach, index) = (bud.v.length(), bud.look % species.flowers.len());
        let look = &species.flowers[index];
        if look.layers.is_none() {
            plant.organs.push(disc(bud, axis, look, index));
            continue;
        }
        let opening_rad = 1.0f32;
        let cone = Cone { apex: bud.base, axis, opening_rad, height: reach * opening_rad.cos() };
        let (origin, branch) = (bud.origin, bud.branch);
        plant.flowers.push(Flower { origin, branch, cone, centre_radius: 0.0, reach, look: index });
        openings.push(Opening { open: bud.open, side: bud.u.cross(bud.v).try_normalize() });
    }
    openings
}

/// A floret without petals.
fn disc(bud: &FlowerBud, axis: Vec3, look: &FlowerLook, index: usize) -> Organ {
    let radius = look.disc.radius.max(1e-3) * bud.v.length();
    Organ {
        role: Role { part: OrganPart::Disc, look: index as u32, variant: 0 },
        origin: bud.origin,
        branch: bud.branch,
        flower: None,
        shape: Shape::Dome { base: bud.base, axis, radius, height: look.disc.height * radius },
    }
}

/// A flower in its own frame, with its templates among those of the plant.
struct Made {
    full: FullFlower,
    templates: Vec<TemplateId>,
}

/// Gives flowers their layers of petals. What is known of those that got some.
pub(super) fn add_layers(
    plant: &mut Plant,
    openings: &[Opening],
    species: &Species,
    seed: u64,
) -> Vec<Option<FullSeat>> {
    if species.flowers.iter().all(|look| look.layers.is_none()) {
        return vec![None; plant.flowers.len()];
    }
    let drawn = drawn_petals(plant);
    let mut made: BTreeMap<(usize, u32, u64), Made> = BTreeMap::new();
    let mut of_look = vec![0usize; species.flowers.len()];
    plant.flowers.iter().for_each(|flower| of_look[flower.look] += 1);
    let gets = |index: usize, flower: &Flower| {
        let layers = species.flowers[flower.look].layers.as_ref()?;
        (drawn[index].len() <= FEW_DRAWN).then_some(layers)
    };
    let gets: Vec<Option<&Layers>> =
        plant.flowers.iter().enumerate().map(|(index, flower)| gets(index, flower)).collect();
    replace_drawn(plant, &gets);
    let mut seats = vec![None; plant.flowers.len()];
    for (index, layers) in gets.iter().enumerate() {
        let Some(layers) = layers else { continue };
        let flower = plant.flowers[index].clone();
        let own = own_template(&drawn[index]);
        let is_copy = own.is_none() && of_look[flower.look] >= MANY;
        let number = if is_copy { mix(seed, index as u64) % DIFFERENT } else { index as u64 };
        let open = layers.open * openings[index].open;
        let open = if is_copy { (open * STAGES).round() / STAGES } else { open };
        let key = (flower.look, open.to_bits(), number);
        let Made { full, templates } = made.entry(key).or_insert_with(|| {
            let full = full_flower(&Layers { open, ..(*layers).clone() }, own.as_ref(), mix(seed, number));
            let templates = full.templates.iter().map(|template| {
                let is_small = of_look[flower.look] >= VERY_MANY;
                let template = if is_small { Arc::new(template.reduced()) } else { template.clone() };
                plant.templates.add(template)
            });
            let templates = templates.collect();
            Made { full, templates }
        });
        let pose = pose_of(&flower, openings[index].side);
        let materials = species.flowers[flower.look].petals.materials.0.len();
        let petals = petals(full, templates, &pose, (index, &flower), materials);
        plant.organs.extend(petals);
        seats[index] = Some(seat(&mut plant.flowers[index], layers, full));
    }
    plant.drop_unused_templates();
    seats
}

/// For each flower the templates of its petals.
fn drawn_petals(plant: &Plant) -> Vec<Vec<Arc<Template>>> {
    let mut petals = vec![Vec::new(); plant.flowers.len()];
    for organ in plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Petal) {
        if let (Some(flower), Shape::Blade(blade)) = (organ.flower, &organ.shape) {
            petals[flower].push(plant.templates.shared(blade.template).clone());
        }
    }
    petals
}

/// The longest of the drawn petals, of length 1.
fn own_template(drawn: &[Arc<Template>]) -> Option<Arc<Template>> {
    let longest = drawn.iter().max_by(|a, b| a.length().total_cmp(&b.length()))?;
    let outline = longest.outline().iter().map(|point| *point / longest.length()).collect();
    Some(Arc::new(Template::new(outline, Vec::new(), 1.0, Detail::Moderate)))
}

/// Takes the drawn petals away of flowers that get layers of them.
fn replace_drawn(plant: &mut Plant, gets: &[Option<&Layers>]) {
    plant.organs.retain(|organ| {
        let is_petal = organ.kind() == OrganKind::Petal;
        !(is_petal && organ.flower.is_some_and(|flower| gets[flower].is_some()))
    });
}

/// The pose of a flower whose first petal stands to a side, or else toward the viewer.
fn pose_of(flower: &Flower, side: Option<Vec3>) -> Pose {
    let axis = flower.cone.axis.normalize();
    let toward = side.unwrap_or(Vec3::Z).reject_from_normalized(axis).try_normalize();
    let side = toward.unwrap_or_else(|| axis.any_orthonormal_vector());
    Pose { centre: flower.cone.apex, axis, side, reach: flower.reach }
}

/// The petals of a flower as organs.
fn petals<'a>(
    full: &'a FullFlower,
    templates: &'a [TemplateId],
    pose: &'a Pose,
    (index, flower): (usize, &'a Flower),
    materials: usize,
) -> impl Iterator<Item = Organ> + 'a {
    let last = materials.saturating_sub(1) as f32;
    full.petals.iter().map(move |petal| Organ {
        role: Role {
            part: OrganPart::Petal,
            look: flower.look as u32,
            variant: (petal.inward * last).round() as u32,
        },
        origin: Origin::Generated,
        branch: flower.branch,
        flower: Some(index),
        shape: Shape::Blade(pose.placed(&petal.blade, templates[petal.template])),
    })
}

/// Where the middle of a full flower stands; its cone becomes that of the innermost petals.
fn seat(flower: &mut Flower, layers: &Layers, full: &FullFlower) -> FullSeat {
    let (base, reach) = (flower.cone.apex, flower.reach);
    flower.reach = reach * full.core_size;
    flower.cone.apex += flower.cone.axis * (full.core_height * reach);
    flower.cone.opening_rad = full.inner_opening_rad;
    flower.cone.height = flower.reach * full.inner_opening_rad.cos();
    FullSeat {
        base,
        outer_opening_rad: full.outer_opening_rad,
        core: layers.core * reach,
        receptacle: layers.receptacle * reach,
        thickness: layers.thickness * reach,
        reach,
    }
}

/// How many stamens of a look are left where so many layers of petals stand: stamens became petals (003 §3.2).
pub(super) fn stamens_left(look: &FlowerLook) -> f32 {
    const NONE_LEFT: f32 = 15.0;
    look.layers.as_ref().map_or(1.0, |layers| (1.0 - (layers.count - 1) as f32 / NONE_LEFT).max(0.0))
}
