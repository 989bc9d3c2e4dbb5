//! What a plant carries stays above its ground, which is level through its lowest root.
//!
//! Wood that nobody drew and that would dip below is lifted to lie on the ground. A leaf that would, bent as its species bends it, swings up
//! about its base: first until it lies level, its face to the sky, then further until nothing of it is below. It swings no
//! farther than it must. A leaf alone with its stalk keeps the pose in which it was drawn and is raised as a whole.
//!
//! Limits: the hollow, waves and curl of a leaf are known by their largest height only. Petals are left where the drawing
//! has them. A plant in its species' pot has no ground to speak of;
//! one in a drawn pot has the ground below that.

use crate::plant::{Blade, Branch, Organ, OrganKind, Plant, ResolvedBlade, RestSurface, Shape, Template};
use glam::{Mat3, Quat, Vec3};
use rayon::prelude::*;

/// Organs that one thread looks at at a time.
const BATCH: usize = 256;
/// Angles over level to which a leaf swings up one after the other, radians.
const RISES: [f32; 5] = [0.0, 0.3, 0.6, 0.95, 1.3];
/// Steps on the way to each.
const STEPS: u32 = 8;
/// What full pressure of the pen may lift or sink a margin by, as a share of the blade's length.
const CURL: f32 = 0.15;

/// Lifts wood and leaves that would stand below the ground.
pub(super) fn keep_above(plant: &mut Plant) {
    lift_wood(&mut plant.branches);
    if raise_single_leaf(plant) {
        return;
    }
    let templates = &plant.templates;
    plant.organs.par_iter_mut().with_min_len(BATCH).for_each(|organ| {
        let is_leaf = organ.kind() == OrganKind::Leaf;
        match &mut organ.shape {
            Shape::Blade(blade) if is_leaf && blade.rest == RestSurface::Plane => {
                lift_leaf(blade, &templates[blade.template]);
            }
            _ => {}
        }
    });
}

/// Raises a leaf that is all there is, with its stalk, until nothing of it is below; says whether it is alone.
fn raise_single_leaf(plant: &mut Plant) -> bool {
    let is_leaf = |organ: &&mut Organ| organ.kind() == OrganKind::Leaf;
    let mut leaves = plant.organs.iter_mut().filter(is_leaf);
    let (Some(leaf), None) = (leaves.next(), leaves.next()) else { return false };
    let Shape::Blade(blade) = &mut leaf.shape else { return false };
    if blade.rest != RestSurface::Plane || !plant.flowers.is_empty() {
        return false;
    }
    let rise = Vec3::Y * (-lowest(&blade.with_template(&plant.templates[blade.template]))).max(0.0);
    blade.base += rise;
    plant.branches.iter_mut().flat_map(|branch| &mut branch.points).for_each(|point| *point += rise);
    true
}

/// Lifts branches, and the feet of what they carry with them. Drawn wood stays where it was drawn; the ground is as low as
/// that.
fn lift_wood(branches: &mut [Branch]) {
    // Where those that were lifted stood before.
    let mut before: Vec<Option<Vec<Vec3>>> = Vec::with_capacity(branches.len());
    for index in 0..branches.len() {
        let (earlier, others) = branches.split_at_mut(index);
        let branch = &mut others[0];
        let parent = branch.parent.and_then(|p| Some((before[p].as_deref()?, &earlier[p].points)));
        let is_low = branch.points.iter().zip(&branch.radii).any(|(point, radius)| point.y < *radius);
        if branch.origin.is_drawn() || !(is_low || parent.is_some()) {
            before.push(None);
            continue;
        }
        let own = branch.points.clone();
        if let Some((stood, stands)) = parent {
            let lift = lift_at(stood, stands, branch.points[0]);
            branch.points[0] += lift;
        }
        lift_branch(branch);
        before.push((own != branch.points).then_some(own));
    }
}

/// By how much a line of at least two points was lifted where it came nearest to a point.
fn lift_at(stood: &[Vec3], stands: &[Vec3], p: Vec3) -> Vec3 {
    let share = |k: usize| {
        let along = stood[k + 1] - stood[k];
        ((p - stood[k]).dot(along) / along.length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0)
    };
    let off = |k: &usize| p.distance_squared(stood[*k].lerp(stood[k + 1], share(*k)));
    let nearest = (0..stood.len() - 1).min_by(|a, b| off(a).total_cmp(&off(b)));
    nearest.map_or(Vec3::ZERO, |k| (stands[k] - stood[k]).lerp(stands[k + 1] - stood[k + 1], share(k)))
}

/// Lifts what comes after the foot: a trunk begins below the surface of the ground by half its slant, and a branch within
/// what carries it.
fn lift_branch(branch: &mut Branch) {
    let mut is_out = branch.parent.is_some();
    for (point, radius) in branch.points.iter_mut().zip(&branch.radii).skip(1) {
        is_out |= point.y >= *radius;
        if is_out {
            point.y = point.y.max(*radius);
        }
    }
}

fn lift_leaf(blade: &mut Blade, template: &Template) {
    blade.base.y = blade.base.y.max(0.0);
    let below = |blade: &Blade| (-lowest(&blade.with_template(template))).max(0.0);
    if below(blade) == 0.0 {
        return;
    }
    let (u, v) = (blade.u, blade.v);
    let Some(frame) = frame(u, v) else { return };
    let level = Vec3::new(v.x, 0.0, v.z).normalize_or(Vec3::Z);
    let mut from = Quat::IDENTITY;
    for rise in RISES {
        let along = level * rise.cos() + Vec3::Y * rise.sin();
        let facing = Vec3::Y * rise.cos() - level * rise.sin();
        let target = Mat3::from_cols(along.cross(facing), along, facing);
        let to = Quat::from_mat3(&(target * frame.transpose()));
        for step in 1..=STEPS {
            let turn = from.slerp(to, step as f32 / STEPS as f32);
            (blade.u, blade.v) = (turn * u, turn * v);
            if below(blade) == 0.0 {
                return;
            }
        }
        from = to;
    }
    blade.base.y += below(blade);
}

/// Directions across, along and out of a blade, unit and square to each other.
fn frame(u: Vec3, v: Vec3) -> Option<Mat3> {
    let (along, facing) = (v.try_normalize()?, u.cross(v).try_normalize()?);
    Some(Mat3::from_cols(along.cross(facing), along, facing))
}

/// Height of the lowest place that a blade may have.
fn lowest(blade: &ResolvedBlade<'_>) -> f32 {
    let (form, template) = (&blade.form, blade.template);
    let size = template.length() * blade.v.length();
    let facing = blade.u.cross(blade.v).normalize_or_zero();
    let width = template.outline().iter().map(|p| p.x.abs()).fold(0.0, f32::max) * blade.u.length();
    let curl = template.curl().iter().fold(0.0, |most: f32, curl| most.max(curl.abs()));
    let uneven = (0.25 * form.cup.abs() * size).min(0.6 * width)
        + (form.fold.abs() * size).min(width) * f32::from(form.fold < 0.0)
        + size * (form.ruffle + CURL * curl + form.thickness);
    let height = |p: &glam::Vec2| {
        let x = (p.y / template.length()).clamp(0.0, 1.25);
        let bent = -(form.bend_quartic * x * x + form.bend_quadratic) * x * x * size;
        (blade.base + blade.u * p.x + blade.v * p.y).y + facing.y * bent
            - facing.y.abs() * uneven * x.min(1.0)
    };
    let heights = template.outline().iter().filter(|p| p.y > 0.1 * template.length()).map(height);
    heights.fold(blade.base.y, f32::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{BladeForm, Detail, OrganPart, Origin, Role, Templates, WoodPart};
    use glam::Vec2;

    fn leaf(base: Vec3, v: Vec3) -> (Blade, Templates) {
        let point = |k: usize| Vec2::from_angle(k as f32 * 0.1047) * Vec2::new(0.2, 0.5) + Vec2::Y * 0.5;
        let mut templates = Templates::default();
        let template = Template::new((0..60).map(point).collect(), Vec::new(), 1.0, Detail::Full);
        let blade = Blade {
            template: templates.add(template),
            base,
            u: v.cross(Vec3::Z).normalize() * v.length(),
            v,
            rest: RestSurface::Plane,
            form: BladeForm::default(),
        };
        (blade, templates)
    }

    #[test]
    fn a_hanging_leaf_comes_to_lie_on_the_ground() {
        let (mut blade, templates) = leaf(Vec3::Y * 0.1, Vec3::new(0.6, -0.6, 0.2));
        let (length, template) = (blade.v.length(), &templates[blade.template]);
        lift_leaf(&mut blade, template);
        assert!(lowest(&templates.resolve(&blade)) >= -1e-6 && (blade.v.length() - length).abs() < 1e-5);
        assert!(blade.v.x > 0.3, "it keeps its side: {}", blade.v);
        assert!(blade.v.y < 0.45 * length, "no farther than it must: {}", blade.v);
    }

    #[test]
    fn leaves_above_the_ground_stay() {
        let (high, templates) = leaf(Vec3::Y, Vec3::new(0.6, -0.6, 0.2));
        let (mut blade, template) = (high.clone(), &templates[high.template]);
        lift_leaf(&mut blade, template);
        assert_eq!(blade, high);
    }

    #[test]
    fn wood_lies_on_the_ground() {
        let points = [0.5, 0.1, -0.3, -0.2].map(|y| Vec3::new(1.0 - y, y, 0.0)).to_vec();
        let mut branch = Branch {
            origin: Origin::Generated,
            parent: Some(0),
            level: 1,
            points,
            radii: vec![0.02; 4],
            role: Role::of(WoodPart::Stem),
        };
        lift_branch(&mut branch);
        assert_eq!(branch.points.iter().map(|p| p.y).collect::<Vec<_>>(), [0.5, 0.1, 0.02, 0.02]);
    }

    #[test]
    fn a_leaf_alone_keeps_its_pose_and_its_stalk() {
        let (blade, templates) = leaf(Vec3::Y * 0.1, Vec3::new(0.6, -0.6, 0.2));
        let stalk = Branch {
            origin: Origin::Generated,
            parent: None,
            level: 0,
            points: vec![blade.base + Vec3::Y, blade.base],
            radii: vec![0.02; 2],
            role: Role::of(WoodPart::Stem),
        };
        let organ = || Organ {
            role: Role::of(OrganPart::Leaf),
            origin: Origin::Generated,
            branch: Some(0),
            flower: None,
            shape: Shape::Blade(blade.clone()),
        };
        let mut alone = Plant { branches: vec![stalk], templates, organs: vec![organ()], ..Plant::default() };
        let mut two = alone.clone();
        two.organs.push(organ());
        keep_above(&mut alone);
        keep_above(&mut two);
        let blades = |plant: &Plant| -> Vec<Blade> { plant.blades().cloned().collect() };
        let own = blades(&alone).remove(0);
        assert_eq!((own.u, own.v), (blade.u, blade.v));
        assert!(lowest(&alone.templates.resolve(&own)) >= -1e-6);
        assert_eq!(alone.branches[0].points[1], own.base);
        assert!(blades(&two)[0].v != blade.v, "leaves of a plant that stands swing up");
    }
}
