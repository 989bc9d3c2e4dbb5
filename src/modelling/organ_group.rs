//! Organs that are moved as one, and where they stand: a leaf with its leaflets, a flower, a fruit, a petal, a pot.
//!
//! They are found by the name that their organs have: that of a stroke, or of the way of buds that they grew from.

use super::graft::{GraftPlace, GraftPlaces};
use super::part_names::PartNames;
use super::poses::{PartFrame, Posed};
use super::slide::{Place, Slide};
use crate::plant::{Motion, OrganPart, Origin, Plant};
use crate::sketch::{PartName, PartPose};
use glam::{Quat, Vec3};
use std::collections::HashMap;

/// Organs that are moved as one: a leaf with its leaflets, a flower, both with their stalk if a rule made that, a single petal, a pot with its earth.
#[derive(Clone, Debug, PartialEq)]
pub struct OrganGroup {
    /// What it is known by.
    pub name: PartName,
    /// Its organs, at least one but for a flower without any.
    pub organs: Vec<usize>,
    /// The flower that it is, or that it is a petal of.
    pub flower: Option<usize>,
    /// Whether it is a whole flower.
    pub is_flower: bool,
    /// The branch that is its stalk.
    pub stalk: Option<usize>,
    /// The branch that it stands on.
    pub on: Option<usize>,
    /// Where it stands, metres.
    pub base: Vec3,
}

impl OrganGroup {
    /// The groups of a plant whose names are `wanted`, flowers behind all others.
    pub fn all(plant: &Plant, names: &PartNames, wanted: impl Fn(PartName) -> bool) -> Vec<Self> {
        let wanted = |origin: Origin| names.of(origin).filter(|name| wanted(*name));
        let flower = |(index, origin): (usize, Origin)| Some(Self::flower(plant, wanted(origin)?, index));
        let origins = plant.flowers.iter().map(|flower| flower.origin).enumerate();
        let mut flowers: Vec<Option<Self>> = origins.map(flower).collect();
        let mut groups: Vec<Self> = Vec::new();
        let mut place_of: HashMap<PartName, usize> = HashMap::new();
        let mut last = None;
        for (index, organ) in plant.organs.iter().enumerate() {
            if let Some(flower) = organ.flower.and_then(|flower| flowers[flower].as_mut()) {
                flower.organs.push(index);
            }
            // The earth of a pot stands behind it.
            let is_earth = organ.role.part == OrganPart::Soil;
            let place = match wanted(organ.origin) {
                Some(name) => Some(*place_of.entry(name).or_insert_with(|| {
                    groups.push(Self::organ(plant, name, index));
                    groups.len() - 1
                })),
                None => last.filter(|_| is_earth),
            };
            place.into_iter().for_each(|place| groups[place].organs.push(index));
            last = place;
        }
        groups.extend(flowers.into_iter().flatten());
        groups
    }

    fn flower(plant: &Plant, name: PartName, index: usize) -> Self {
        let flower = &plant.flowers[index];
        let of = Self::on_stalk(plant, name, flower.branch, flower.cone.apex);
        Self { flower: Some(index), is_flower: true, ..of }
    }

    /// That of an organ, which is the first of its name.
    fn organ(plant: &Plant, name: PartName, index: usize) -> Self {
        let organ = &plant.organs[index];
        let (flower, base) = (organ.flower, organ.base());
        // A petal stands on its flower alone.
        let branch = organ.branch.filter(|_| flower.is_none());
        Self { flower, ..Self::on_stalk(plant, name, branch, base) }
    }

    /// One that stands there on a branch, or on what carries that if it is its stalk.
    fn on_stalk(plant: &Plant, name: PartName, branch: Option<usize>, base: Vec3) -> Self {
        let stalk = branch.filter(|branch| is_stalk(plant, *branch, base));
        let foot = stalk.and_then(|stalk| plant.branches[stalk].points.first());
        let on = stalk.map_or(branch, |stalk| plant.branches[stalk].parent);
        let base = foot.copied().unwrap_or(base);
        Self { name, organs: Vec::new(), flower: None, is_flower: false, stalk, on, base }
    }

    /// What a new pose of it starts from.
    pub fn frame(&self, plant: &Plant, names: &PartNames, posed: &Posed) -> PartFrame {
        let own = posed.organs.get(&self.name).copied();
        own.unwrap_or_else(|| {
            let turn = self.parent_turn(plant, names, posed);
            PartFrame { stood: self.base, parent_turn: turn, foot: turn }
        })
    }

    /// What the place that it stands on was turned by.
    pub(super) fn parent_turn(&self, plant: &Plant, names: &PartNames, posed: &Posed) -> Quat {
        let flower = self.flower.filter(|_| !self.is_flower).map(|flower| &plant.flowers[flower]);
        let flower_name = flower.and_then(|flower| names.of(flower.origin));
        if let Some(frame) = flower_name.and_then(|name| posed.organs.get(&name)) {
            return frame.foot;
        }
        let on = self.on.or(flower.and_then(|flower| flower.branch));
        // What a rule made stands as what it stands on.
        let below = |branch: &usize| {
            let branch = &plant.branches[*branch];
            branch.parent.filter(|_| branch.origin == Origin::Generated)
        };
        let mut down = std::iter::successors(on, below);
        let motion = down.find_map(|branch| posed.motion_at(&plant.branches[branch], self.base));
        motion.map_or(Quat::IDENTITY, |motion| motion.turn)
    }

    /// Where a pose grafts it; petals stay in their flower, and what stands on the ground stays there.
    pub(super) fn graft(&self, plant: &Plant, places: &GraftPlaces, pose: &PartPose) -> Option<GraftPlace> {
        let stands_on_wood = self.on.is_some() && (self.flower.is_none() || self.is_flower);
        places.find(&plant.branches, pose.graft.filter(|_| stands_on_wood)?)
    }

    /// How its pose moves it, and the frame of that; `graft` is where it stands instead of on its own branch.
    pub(super) fn posed(
        &self,
        plant: &Plant,
        parent_turn: Quat,
        (pose, graft): (&PartPose, Option<&GraftPlace>),
        scale: f32,
    ) -> (Motion, PartFrame) {
        let on = self.on.map(|branch| &plant.branches[branch]);
        let (on, stood, carried) = match graft {
            Some(graft) => {
                let from = on.and_then(|on| Place::nearest(on, self.base));
                let set = Slide::between(from, graft.place, self.base);
                (Some(&plant.branches[graft.branch]), set.to, set.turn * parent_turn)
            }
            None => (on, self.base, parent_turn),
        };
        let slide = Slide::new(on, stood, carried * (pose.shift * scale), scale);
        let foot = (slide.turn * carried * pose.turn).normalize();
        let motion = Motion {
            turn: (foot * parent_turn.inverse()).normalize(),
            from: self.base,
            to: slide.to,
            size: pose.thickness,
        };
        (motion, PartFrame { stood, parent_turn: carried, foot })
    }

    /// Lets it stand on another branch; that may be behind its stalk.
    pub(super) fn stand_on(&self, plant: &mut Plant, branch: usize) {
        if let Some(stalk) = self.stalk {
            plant.branches[stalk].parent = Some(branch);
            plant.branches[stalk].level = plant.branches[branch].level + 1;
            return;
        }
        let organs = self.organs.iter().filter(|_| self.flower.is_none());
        organs.for_each(|organ| plant.organs[*organ].branch = Some(branch));
        if let Some(flower) = self.flower.filter(|_| self.is_flower) {
            plant.flowers[flower].branch = Some(branch);
        }
    }

    pub(super) fn move_by(&self, plant: &mut Plant, motion: &Motion) {
        self.organs.iter().for_each(|organ| plant.organs[*organ].move_by(motion));
        if let Some(flower) = self.flower.filter(|_| self.is_flower) {
            plant.flowers[flower].move_by(motion);
        }
        if let Some(stalk) = self.stalk {
            let stalk = &mut plant.branches[stalk];
            stalk.points.iter_mut().for_each(|point| *point = motion.point(*point));
            stalk.radii.iter_mut().for_each(|radius| *radius *= motion.size);
        }
    }
}

/// Whether a branch is the stalk of the organ that stands there: made for it, and it ends there.
fn is_stalk(plant: &Plant, branch: usize, at: Vec3) -> bool {
    let Some(parent) = plant.branches[branch].parent else { return false };
    let branch = &plant.branches[branch];
    let end = branch.points.last().zip(branch.radii.last());
    let ends_there = end.is_some_and(|(end, radius)| end.distance(at) <= 2.0 * radius);
    branch.origin == Origin::Generated && plant.branches[parent].origin != Origin::Generated && ends_there
}
