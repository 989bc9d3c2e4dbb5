//! Which parts a plant has: parents, specimens and what each is made from, before any mesh exists.
//!
//! Wood comes first: branches that grow on one another are one part, whatever barks they have, or each is one of its own.
//! Then organs, in the order in which the first of each part stands. An organ that was drawn is a part. Those that nobody
//! drew are gathered by kind, with a list for each material: over the whole plant or, where the petals of their flower were
//! drawn, within that flower, so that it can still be turned by itself. Filaments are always gathered, at least within their
//! flower, and their heads apart from them.
//!
//! A specimen is one plant of the drawing: a trunk with all it carries and the pot it stands in, a flower without a
//! stem. Leaves scattered about without a branch are one specimen together.

use super::PartKind;
use super::copies::Copies;
use super::limbs::WoodBranch;
use super::params::ModelParams;
use super::part_names::{PartNames, numbered};
use super::piece::{Piece, Scope, pieces};
use crate::plant::{FinishedPlant, Organ, OrganKind, Plant, Shape};
use glam::Vec3;
use smol_str::{SmolStr, format_smolstr};
use std::collections::BTreeMap;
use std::sync::Arc;

/// What a part's mesh is made from.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Source {
    /// One surface of these branches.
    Wood(Vec<WoodBranch<usize>>),
    /// A piece of the organ of this index, which is a part by itself.
    Organ((usize, Piece)),
    /// Pieces of the organs of these indices, a list for each of the part's materials.
    Organs(Vec<Vec<(usize, Piece)>>),
}

/// A part without its mesh.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plan {
    pub(super) name: SmolStr,
    pub(super) kind: PartKind,
    pub(super) parent: Option<usize>,
    pub(super) specimen: usize,
    pub(super) pivot: Vec3,
    pub(super) material: usize,
    pub(super) more_materials: Vec<usize>,
    pub(super) source: Source,
    /// Organs that are copies of few shapes, once they are taken out of the source.
    pub(super) copies: Option<Arc<Copies>>,
}

impl Plan {
    /// The part's slot for a material; a new one if it has none.
    fn slot(&mut self, material: usize) -> usize {
        let mut known = std::iter::once(&self.material).chain(&self.more_materials);
        known.position(|known| *known == material).unwrap_or_else(|| {
            self.more_materials.push(material);
            self.more_materials.len()
        })
    }
}

/// Plans all parts of a plant, parents first.
pub(super) fn plan(plant: &FinishedPlant, params: &ModelParams) -> Vec<Plan> {
    let specimens = Specimens::new(plant);
    let mut plans: Vec<Plan> = Vec::with_capacity(plant.branches.len() + plant.organs.len());
    let part_of = if params.tube.joined {
        plan_wood(plant, &specimens, &mut plans)
    } else {
        plan_branches(plant, &specimens, &mut plans)
    };
    let mut organs = OrganPlans {
        plant,
        gathered: params.blade.gathered,
        drawn_flowers: drawn_flowers(plant),
        specimens,
        part_of,
        plans,
        names: PartNames::default(),
        known: BTreeMap::new(),
    };
    (0..plant.organs.len()).for_each(|organ| organs.add(organ));
    organs.plans
}

/// For each flower whether any of it was drawn.
fn drawn_flowers(plant: &Plant) -> Vec<bool> {
    let mut drawn = vec![false; plant.flowers.len()];
    for organ in plant.organs.iter().filter(|organ| organ.origin.is_drawn()) {
        if let Some(flower) = organ.flower {
            drawn[flower] = true;
        }
    }
    drawn
}

/// Parts in the making, the wood's first.
struct OrganPlans<'a> {
    plant: &'a FinishedPlant,
    /// Whether what nobody drew is gathered.
    gathered: bool,
    drawn_flowers: Vec<bool>,
    specimens: Specimens,
    /// The part of each branch.
    part_of: Vec<usize>,
    plans: Vec<Plan>,
    names: PartNames,
    /// Parts of organs that may become more.
    known: BTreeMap<(Scope, OrganKind, Piece), usize>,
}

impl OrganPlans<'_> {
    /// Puts the pieces of an organ into their parts.
    fn add(&mut self, index: usize) {
        let organ = &self.plant.organs[index];
        let scope = self.scope(index);
        for (piece, role) in pieces(organ) {
            let material = self.plant.material(role);
            if matches!(scope, Scope::Organ(_)) {
                self.begin(index, scope, piece, material);
                continue;
            }
            let known = self.known.get(&(scope, organ.kind(), piece)).copied();
            let part = known.unwrap_or_else(|| self.begin(index, scope, piece, material));
            let plan = &mut self.plans[part];
            let slot = plan.slot(material);
            if let Source::Organs(slots) = &mut plan.source {
                slots.resize(slots.len().max(slot + 1), Vec::new());
                slots[slot].push((index, piece));
            }
        }
    }

    fn scope(&self, index: usize) -> Scope {
        let organ = &self.plant.organs[index];
        let is_filament = matches!(organ.shape, Shape::Filament { .. });
        // A plant has one pot, which is none of its organs.
        let may_be_many = !organ.origin.is_drawn() && organ.kind() != OrganKind::Pot;
        let within_plant = self.gathered && may_be_many;
        match organ.flower {
            Some(flower) if is_filament || within_plant => {
                let opened_by_itself = self.gathered && !self.drawn_flowers[flower];
                if opened_by_itself { Scope::Specimen(self.specimen(organ)) } else { Scope::Flower(flower) }
            }
            None if within_plant => Scope::Specimen(self.specimen(organ)),
            _ => Scope::Organ(index),
        }
    }

    /// The branch that carries an organ, its own or its flower's.
    fn parent_branch(&self, organ: &Organ) -> Option<usize> {
        organ.branch.or_else(|| organ.flower.and_then(|flower| self.plant.flowers[flower].branch))
    }

    fn specimen(&self, organ: &Organ) -> usize {
        match (self.parent_branch(organ), organ.flower) {
            (Some(branch), _) => self.specimens.of_branch[branch],
            (None, Some(flower)) => self.specimens.of_flower[flower],
            (None, None) => self.specimens.of_lone(self.plant, organ),
        }
    }

    /// A part that begins with a piece of this organ. What is gathered over a plant stands where the plant does.
    fn begin(&mut self, index: usize, scope: Scope, piece: Piece, material: usize) -> usize {
        let organ = &self.plant.organs[index];
        let parent = self.parent_branch(organ).map(|branch| self.part_of[branch]);
        let trunk =
            parent.filter(|_| matches!(scope, Scope::Specimen(_))).map(|parent| root(&self.plans, parent));
        let part = self.plans.len();
        let is_single = matches!(scope, Scope::Organ(_));
        self.plans.push(Plan {
            name: self.names.organs(organ, scope, piece),
            kind: PartKind::Organ(organ.kind()),
            parent: trunk.or(parent),
            specimen: self.specimen(organ),
            pivot: trunk.map_or_else(|| organ.base(), |trunk| self.plans[trunk].pivot),
            material,
            more_materials: Vec::new(),
            source: if is_single { Source::Organ((index, piece)) } else { Source::Organs(Vec::new()) },
            copies: None,
        });
        if !is_single {
            self.known.insert((scope, organ.kind(), piece), part);
        }
        part
    }
}

/// The part that carries this one and that nothing carries.
fn root(plans: &[Plan], mut part: usize) -> usize {
    while let Some(parent) = plans[part].parent {
        part = parent;
    }
    part
}

/// One part for every branch; gives the part of each.
fn plan_branches(plant: &FinishedPlant, specimens: &Specimens, plans: &mut Vec<Plan>) -> Vec<usize> {
    let part = |i: usize| wood(plant, specimens, i, plant.branches[i].parent, format_smolstr!("branch_{i}"));
    plans.extend((0..plant.branches.len()).map(part));
    (0..plant.branches.len()).collect()
}

/// One part for all branches that grow on one another; gives the part of each branch.
fn plan_wood(plant: &FinishedPlant, specimens: &Specimens, plans: &mut Vec<Plan>) -> Vec<usize> {
    let mut part_of = Vec::with_capacity(plant.branches.len());
    let mut place_of = Vec::with_capacity(plant.branches.len());
    for (i, branch) in plant.branches.iter().enumerate() {
        let part = branch.parent.map_or(plans.len(), |parent| part_of[parent]);
        part_of.push(part);
        if branch.parent.is_none() {
            plans.push(wood(plant, specimens, i, None, numbered("wood", part)));
            place_of.push(0);
        } else {
            let slot = plans[part].slot(plant.material(branch.role));
            let Source::Wood(limbs) = &mut plans[part].source else { continue };
            place_of.push(limbs.len());
            limbs.push(WoodBranch { branch: i, parent: branch.parent.map(|parent| place_of[parent]), slot });
        }
    }
    part_of
}

fn wood(
    plant: &FinishedPlant,
    specimens: &Specimens,
    i: usize,
    parent: Option<usize>,
    name: SmolStr,
) -> Plan {
    let branch = &plant.branches[i];
    Plan {
        name,
        kind: PartKind::Wood,
        parent,
        specimen: specimens.of_branch[i],
        pivot: branch.points.first().copied().unwrap_or(Vec3::ZERO),
        material: plant.material(branch.role),
        more_materials: Vec::new(),
        source: Source::Wood(vec![WoodBranch { branch: i, parent: None, slot: 0 }]),
        copies: None,
    }
}

/// Numbers of the plants in a drawing: trunks first, then flowers without a stem, then all lone organs together.
struct Specimens {
    of_branch: Vec<usize>,
    of_flower: Vec<usize>,
    lone: usize,
}

impl Specimens {
    fn new(plant: &Plant) -> Self {
        let mut count = 0;
        let mut next = || {
            count += 1;
            count - 1
        };
        let mut of_branch: Vec<usize> = Vec::with_capacity(plant.branches.len());
        for branch in &plant.branches {
            let specimen = branch.parent.map_or_else(&mut next, |p| of_branch[p]);
            of_branch.push(specimen);
        }
        let of_flower =
            plant.flowers.iter().map(|f| f.branch.map_or_else(&mut next, |b| of_branch[b])).collect();
        Self { of_branch, of_flower, lone: count }
    }

    /// The specimen of an organ that neither branch nor flower carries: a pot belongs to the trunk nearest to it.
    fn of_lone(&self, plant: &Plant, organ: &Organ) -> usize {
        if organ.kind() != OrganKind::Pot {
            return self.lone;
        }
        let away =
            |i: usize| plant.branches[i].points.first().map_or(f32::INFINITY, |p| p.distance(organ.base()));
        let trunks = (0..plant.branches.len()).filter(|&i| plant.branches[i].parent.is_none());
        let held = trunks.min_by(|a, b| away(*a).total_cmp(&away(*b)));
        held.map_or(self.lone, |trunk| self.of_branch[trunk])
    }
}
