//! Leaves painted on the wood that a brush sweeps.
//!
//! They stand as leaves of the species do, spirally, to the left and the right or in pairs, and are like those that the plant has
//! already, drawn ones too; each is as long as the drawn leaf that is nearest. Each is known by its branch and its place there.

use super::own_leaves::OwnLeaves;
use super::places::{Place, places};
use super::{Furnish, PAINTED_AGE};
use crate::geom::GOLDEN_RAD;
use crate::growth::at_age::{PlantAtAge, wood_names};
use crate::growth::habit::{Arrangement, LeafPose, leaf};
use crate::plant::{
    Blade, BladeForm, Detail, GrownId, Organ, OrganPart, Origin, Provenance, RestSurface, Role, Shape,
    Template, TemplateId, Templates,
};
use crate::random::{Choice, mix};
use glam::Vec3;
use std::f32::consts::{FRAC_PI_2, PI};

/// Steps from leaf to leaf at density 1, in lengths of a leaf.
const STEP: f32 = 0.4;
/// How far from the axis a leaf begins, as a share of the branch's radius.
const FOOT: f32 = 0.7;

impl Furnish<'_> {
    /// Paints leaves; whether there are any.
    pub fn leaves(&self, to: &mut PlantAtAge, provenance: &Provenance) -> bool {
        let own = OwnLeaves::of(&to.plant);
        let habit = &self.habit.leaf;
        let pose = habit.at(PAINTED_AGE);
        let pose = LeafPose { length: own.length.unwrap_or(pose.length), ..pose };
        if pose.length.is_nan() || pose.length <= 0.0 {
            return false;
        }
        let mut templates = Templates::default();
        let outline = leaf::outline(habit.shape, pose.width.min(3.0));
        let template = templates.add(Template::new(outline, Vec::new(), 1.0, Detail::Reduced));
        let places = places(&to.plant, self.swept, STEP * pose.length / self.density);
        let names = wood_names::names_of_wood(&to.plant.branches, provenance);
        let arrangement = habit.arrangement.unwrap_or(self.habit.arrangement);
        let leaves = places.iter().flat_map(|place| {
            let pair = if arrangement == Arrangement::Opposite { 2 } else { 1 };
            let name = mix(mix(Choice::NAME_OF_LEAF.key(self.seed), names[place.branch]), place.step.into());
            (0..pair).map(move |k| (*place, k, mix(name, k)))
        });
        let leaf = |(place, k, name): (Place, u64, u64)| {
            let pose = LeafPose { length: own.length_at(place.at).unwrap_or(pose.length), ..pose };
            let around =
                place.across(turn(arrangement, place.step, k) + 0.4 * Choice::LEAF_AROUND.signed(name));
            Organ {
                role: Role::of(OrganPart::Leaf),
                origin: Origin::Grown(GrownId(name)),
                branch: Some(place.branch),
                flower: None,
                shape: Shape::Blade(blade(&place, around, &pose, (template, name))),
            }
        };
        let mut leaves: Vec<Organ> = leaves.take(self.most).map(leaf).collect();
        let is_any = !leaves.is_empty();
        let templates = own.give_forms(&mut leaves, templates, self.seed);
        to.plant.add_organs(leaves, templates);
        to.plant.drop_unused_templates();
        is_any
    }
}

/// How far about its branch a leaf stands from the plane of the sheet, radians.
fn turn(arrangement: Arrangement, step: u32, k: u64) -> f32 {
    match arrangement {
        Arrangement::Spiral | Arrangement::Whorl => GOLDEN_RAD * step as f32,
        Arrangement::Alternate => PI * (step % 2) as f32,
        Arrangement::Opposite => FRAC_PI_2 * (step % 2) as f32 + PI * k as f32,
    }
}

/// A leaf at a place, to one side of the branch.
fn blade(place: &Place, around: Vec3, pose: &LeafPose, (template, name): (TemplateId, u64)) -> Blade {
    let (sin, cos) = pose.angle_rad.sin_cos();
    let scatter = Vec3::from_array(Choice::LEAF_DIRECTION.signs(name)) * pose.scatter;
    let free = place.way * cos + around * sin - Vec3::Y * pose.droop + scatter;
    let axis = free.try_normalize().unwrap_or(around);
    let face = place.way.lerp(Vec3::Y, pose.face_up);
    let across = axis.cross(face).try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector());
    let length = pose.length * (1.0 + pose.vary * Choice::LEAF_LENGTH.signed(name));
    Blade {
        template,
        base: place.at + around * (FOOT * place.radius),
        u: across * length,
        v: axis * length,
        rest: RestSurface::Plane,
        form: BladeForm::default(),
    }
}
