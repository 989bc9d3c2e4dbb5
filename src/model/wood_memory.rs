//! The surface of a plant's wood, kept to be made anew only near what changed.
//!
//! Branches are known by every bit of their skeletons and barks, wherever they stand in the list of branches. Limbs that have
//! the same rings as in the last surface and nothing new around them (`wood_changes`) are taken from it; the others are made as
//! a surface of their own (`wood`), and both are joined (`surface`). So the surface is the very one that is made from all.
//!
//! Limits: what is taken is still copied, once for every change. Where most limbs changed, all are made.

use super::limbs::{Earlier, Limbs, WoodBranch};
use super::mesh::Mesh;
use super::surface::{self, Places, Source, Surface, Taken};
use super::tube::TubeLook;
use super::wood::{self, Share, WoodScratch};
use super::wood_changes;
use crate::kept::{NameHasher, Window};
use crate::plant::Branch;
use crate::random::mix;
use glam::Vec3;
use std::collections::HashMap;
use std::hash::BuildHasherDefault;
use std::sync::Arc;

/// The surface that was made last and all that it was made from, but for the looks of its branches.
#[derive(Debug, Default)]
pub(super) struct WoodMemory {
    /// The plant's size, on which looks depend.
    unit: f32,
    skeletons: Skeletons,
    limbs: Limbs,
    mesh: Arc<Mesh>,
    places: Places,
}

impl WoodMemory {
    /// Where the wood stands: what tells it from other wood.
    pub(super) fn foot(&self) -> Option<Vec3> {
        self.skeletons.points.first().copied()
    }

    /// The surface of branches that all grow on the first, whose looks are those of the last surface if the branches and
    /// `unit` are: the very mesh that [`wood::mesh`] makes.
    pub(super) fn mesh(
        &mut self,
        branches: &[WoodBranch<&Branch>],
        look: impl Fn(&Branch) -> TubeLook,
        unit: f32,
        scratch: &mut WoodScratch,
    ) -> Arc<Mesh> {
        if self.unit.to_bits() != unit.to_bits() {
            *self = Self { unit, ..Self::default() };
        }
        let known = self.skeletons.places(branches);
        scratch.limbs.survey(branches, look, Some(Earlier { limbs: &self.limbs, known: &known }));
        let shares = wood_changes::changed(&scratch.limbs, &self.limbs);
        let count = |wanted: Share| shares.iter().filter(|share| **share == wanted).count();
        let Surface { mesh, places } = if count(Share::Left) > count(Share::Whole) {
            let anew = wood::surface(branches, |limb| shares[limb], scratch);
            self.joined(&anew, &shares, &scratch.limbs)
        } else {
            wood::surface(branches, |_| Share::Whole, scratch)
        };
        self.skeletons.replace(branches);
        std::mem::swap(&mut self.limbs, &mut scratch.limbs);
        (self.mesh, self.places) = (Arc::new(mesh), places);
        Arc::clone(&self.mesh)
    }

    /// What was made anew together with all else.
    fn joined(&self, anew: &Surface, shares: &[Share], limbs: &Limbs) -> Surface {
        let new = Source { mesh: &anew.mesh, places: &anew.places, limbs: &limbs.all };
        let old = Source { mesh: &self.mesh, places: &self.places, limbs: &self.limbs.all };
        let taken = |limb: usize| match shares[limb] {
            _ if limbs.all[limb].hidden => None,
            Share::Whole => Some(Taken { from: new, limb }),
            Share::Left | Share::Around => limbs.same[limb].map(|limb| Taken { from: old, limb }),
        };
        let taken: Vec<Option<Taken<'_>>> = (0..shares.len()).map(taken).collect();
        surface::joined(&limbs.all, &taken)
    }
}

/// Branches, to be compared with others.
#[derive(Debug, Default)]
struct Skeletons {
    /// For each branch its bark and the end of its points.
    all: Vec<(usize, usize)>,
    points: Vec<Vec3>,
    radii: Vec<f32>,
}

impl Skeletons {
    fn replace(&mut self, branches: &[WoodBranch<&Branch>]) {
        self.all.clear();
        self.points.clear();
        self.radii.clear();
        for WoodBranch { branch, slot, .. } in branches {
            self.points.extend_from_slice(&branch.points);
            self.radii.extend_from_slice(&branch.radii);
            self.all.push((*slot, self.points.len()));
        }
    }

    /// The bark, points and radii of a branch.
    fn skeleton(&self, index: usize) -> (usize, &[Vec3], &[f32]) {
        let from = index.checked_sub(1).map_or(0, |before| self.all[before].1);
        let (slot, end) = self.all[index];
        (slot, &self.points[from..end], &self.radii[from..end])
    }

    /// For each branch one that is the same in every bit; what carries it does not count.
    fn places(&self, branches: &[WoodBranch<&Branch>]) -> Vec<Option<usize>> {
        let own: Vec<usize> = (0..self.all.len()).collect();
        let is_same = |old: &usize, new: &WoodBranch<&Branch>| is_same(self.skeleton(*old), parts(new));
        let Window { begin, end } = Window::between(&own, branches, is_same);
        let (old_end, new_end) = (own.len() - end, branches.len() - end);
        let by_name: HashMap<u64, usize, BuildHasherDefault<NameHasher>> = match begin < new_end {
            true => (begin..old_end).map(|old| (name(self.skeleton(old)), old)).collect(),
            false => HashMap::default(),
        };
        let place = |(index, branch): (usize, &WoodBranch<&Branch>)| match index {
            index if index < begin => Some(index),
            index if index >= new_end => Some(index - new_end + old_end),
            _ => by_name.get(&name(parts(branch))).copied().filter(|old| is_same(old, branch)),
        };
        branches.iter().enumerate().map(place).collect()
    }
}

fn parts<'a>(branch: &WoodBranch<&'a Branch>) -> (usize, &'a [Vec3], &'a [f32]) {
    (branch.slot, &branch.branch.points, &branch.branch.radii)
}

fn is_same(a: (usize, &[Vec3], &[f32]), b: (usize, &[Vec3], &[f32])) -> bool {
    let bits = |p: &Vec3| p.to_array().map(f32::to_bits);
    (a.0, a.1.len(), a.2.len()) == (b.0, b.1.len(), b.2.len())
        && a.1.iter().zip(b.1).all(|(a, b)| bits(a) == bits(b))
        && a.2.iter().zip(b.2).all(|(a, b)| a.to_bits() == b.to_bits())
}

/// A number that tells nearly all branches apart.
fn name((slot, points, radii): (usize, &[Vec3], &[f32])) -> u64 {
    let words = points.iter().flat_map(Vec3::to_array).chain(radii.iter().copied());
    words.fold(slot as u64, |name, word| mix(name, word.to_bits().into()))
}

#[cfg(test)]
#[path = "wood_memory_tests.rs"]
mod tests;
