//! The centre of a flower: its receptacle (disc and cup) with stamens, styles and sepals.

use super::filaments::filaments;
use super::full::{FullSeat, stamens_left};
use super::looks::{Along, CupLook, FlowerLook};
use super::seat::Seat;
use super::sepals::sepals;
use crate::plant::{Organ, OrganPart, Origin, Plant, Role, Shape, Templates};
use glam::{Vec2, Vec3};
use rand_pcg::Pcg64Mcg;

/// Filaments that all flowers of a plant have together, at most; each flower has three at least.
const MOST_FILAMENTS: usize = 1500;
/// From this number on flowers are so small in the picture that sepals and cup are left out.
const MANY_FLOWERS: usize = 60;
/// How much wider a cup along the stem is than the stem.
const AROUND_STEM: f32 = 1.15;
/// How deep the receptacle of a full flower reaches behind its outermost petals, in its radii.
const DEPTH: f32 = 0.6;
/// Its width where petals begin, as a share of where these do: they end at it, and do not pass through it.
const WITHIN: f32 = 0.92;
/// How far at most a leaning cup moves down the stem, in radii.
const LARGEST_SINK: f32 = 0.6;

/// What is known of a flower's petals.
#[derive(Clone, Copy, Default)]
pub(super) struct Petals {
    /// How many there are.
    pub(super) count: usize,
    /// Length of the longest, metres.
    pub(super) longest: f32,
    /// World position of the first one's tip before it bends.
    pub(super) first_tip: Option<Vec3>,
    /// Where they stand, if they are the layers of a full flower.
    pub(super) full: Option<FullSeat>,
}

/// What is added to flower `flower` of `plant`, which has these petals. The template of its sepals comes behind the others.
pub(super) fn flower_centre(
    plant: &Plant,
    flower: usize,
    petals: &Petals,
    look: &FlowerLook,
    templates: &mut Templates,
    rng: &mut Pcg64Mcg,
) -> Vec<Organ> {
    let pose = &plant.flowers[flower];
    let first_tip = petals.first_tip.unwrap_or(pose.cone.apex);
    let seat = Seat::new(pose, first_tip, look.disc.radius, look.disc.height);
    let (seat, behind) = match &petals.full {
        Some(full) => (seat.inside(full), seat.behind(full)),
        None => (seat, seat),
    };
    let disc = Shape::Dome {
        base: seat.apex + seat.axis * seat.floor,
        axis: seat.axis,
        radius: seat.radius,
        height: seat.height,
    };
    let organ = |part, variant, shape| Organ {
        role: Role { part, look: pose.look as u32, variant },
        origin: Origin::Generated,
        branch: pose.branch,
        flower: Some(flower),
        shape,
    };
    let mut out = vec![organ(OrganPart::Disc, 0, disc)];
    let mut left = (MOST_FILAMENTS / plant.flowers.len()).max(3);
    for (part, groups) in [(OrganPart::Stamen, &look.stamens), (OrganPart::Pistil, &look.pistils)] {
        for (group, variant) in groups.iter().zip(0..) {
            let share = if part == OrganPart::Stamen { stamens_left(look) } else { 1.0 };
            let most = left.min((share * group.count as f32).round() as usize);
            let shapes = filaments(group, &seat, most, rng);
            left -= shapes.len();
            out.extend(shapes.into_iter().map(|shape| organ(part, variant, shape)));
        }
    }
    if plant.flowers.len() >= MANY_FLOWERS {
        return out;
    }
    let stem = stem_end(plant, flower);
    let below = match (&look.cup, &petals.full) {
        (Some(look), _) => cup(look, &behind, stem),
        (None, Some(full)) => body(full, &seat, stem),
        (None, None) => None,
    };
    out.extend(below.map(|shape| organ(OrganPart::Cup, 0, shape)));
    if let Some(sepal_look) = &look.sepals {
        let blades = sepals(sepal_look, &behind, petals.count, &look.petals.form, templates);
        out.extend(blades.into_iter().map(|blade| organ(OrganPart::Sepal, 0, Shape::Blade(blade))));
    }
    out
}

/// Direction and radius of the end of the branch that carries a flower.
fn stem_end(plant: &Plant, flower: usize) -> Option<(Vec3, f32)> {
    let branch = &plant.branches[plant.flowers[flower].branch?];
    let [.., before, last] = branch.points.as_slice() else { return None };
    Some(((last - before).try_normalize()?, *branch.radii.last()?))
}

/// What the layers of a full flower stand on: a solid of revolution that swells from the stem to the outermost petals, whose feet
/// lie on a cone from there up to the disc.
fn body(full: &FullSeat, disc: &Seat, stem: Option<(Vec3, f32)>) -> Option<Shape> {
    let neck = stem.map_or(0.0, |(_, radius)| radius * AROUND_STEM);
    let widest = (WITHIN * full.receptacle.max(full.core)).max(neck);
    let rise = (disc.apex - full.base).dot(disc.axis).max(0.0);
    let depth = DEPTH * widest;
    if widest <= 0.0 {
        return None;
    }
    let below = |r: f32, h: f32| Vec2::new(neck + (widest - neck) * r, depth * h);
    let top = depth + (WITHIN * rise).max(0.02 * depth);
    let profile = vec![
        Vec2::ZERO,
        below(0.0, 0.02),
        below(0.45, 0.2),
        below(0.85, 0.6),
        below(1.0, 1.0),
        Vec2::new((WITHIN * full.core).clamp(0.1 * widest, 0.98 * widest), top),
        Vec2::new(0.0, top),
    ];
    Some(Shape::Lathe { base: full.base - disc.axis * depth, axis: disc.axis, profile })
}

/// Solid of revolution that swells from the stem to the petals.
fn cup(look: &CupLook, seat: &Seat, stem: Option<(Vec3, f32)>) -> Option<Shape> {
    let (direction, stem_radius) = match (look.along, stem) {
        (Along::Stem, Some((direction, radius))) => (direction, radius),
        (_, stem) => (seat.axis, stem.map_or(0.0, |(_, radius)| radius)),
    };
    let length = look.length * seat.reach;
    let neck = stem_radius * AROUND_STEM;
    let radius = (look.radius * seat.reach).max(neck);
    if length <= 0.0 || radius <= 0.0 {
        return None;
    }
    let at = |r: f32, h: f32| Vec2::new(neck + (radius - neck) * r, length * h);
    let profile = vec![
        Vec2::ZERO,
        at(0.12, 0.02),
        at(0.45, 0.15),
        at(0.8, 0.45),
        at(1.0, 0.8),
        at(0.85, 0.94),
        Vec2::new(0.4 * radius, length * 0.99),
        Vec2::new(0.0, length),
    ];
    // the round end of a cup that leans against the axis must not rise above the petals
    let rise = 1.0 - direction.dot(seat.axis).clamp(0.0, 1.0);
    let sunk = radius * rise.min(LARGEST_SINK);
    Some(Shape::Lathe { base: seat.apex - direction * (length + sunk), axis: direction, profile })
}
