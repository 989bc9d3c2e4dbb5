//! Which parts a plant has: names, carriers, specimens and what each is made from, before any mesh exists.
//!
//! Wood comes first: branches that grow on one another are one part, whatever barks they wear, or each is one of its own.
//! Then organs in their order, a flower's filaments gathered where the first of them stands. Names are unique: `wood`,
//! `wood_1`, `branch_3`, `leaf_12`, `petal_0_4` (flower, then number within the flower), `stamens_0`, `anthers_0`.
//!
//! A specimen is one plant of the drawing: a trunk with all it carries and the pot it stands in, a flower without a
//! stem. Leaves strewn about without a branch are one specimen together.

use super::filaments::Piece;
use super::{ModelParams, PartKind};
use crate::plant::{Organ, OrganKind, Plant, Shape};
use glam::Vec3;
use std::collections::BTreeMap;
use std::fmt::Write;

/// What a part's mesh is made from.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Source {
    /// One surface of these branches.
    Wood(Vec<Limb>),
    /// The blade, dome or lathed body of the organ of this index.
    Organ(usize),
    /// The blades of the organs of these indices, a list for each of the part's materials.
    Blades(Vec<Vec<usize>>),
    /// Pieces of the filaments of these indices.
    Filaments(Vec<(usize, Piece)>),
}

/// A branch of joined wood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Limb {
    /// Its index in the plant.
    pub(super) branch: usize,
    /// The place of the limb that it grows on.
    pub(super) parent: Option<usize>,
    /// Which of the part's materials it wears.
    pub(super) coat: usize,
}

/// A part without its mesh.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plan {
    pub(super) name: String,
    pub(super) kind: PartKind,
    pub(super) parent: Option<usize>,
    pub(super) specimen: usize,
    pub(super) pivot: Vec3,
    pub(super) material: usize,
    pub(super) more_materials: Vec<usize>,
    pub(super) source: Source,
}

impl Plan {
    /// Which of the part's materials this one is; it gets a place among them if it has none.
    fn coat(&mut self, material: usize) -> usize {
        let mut known = std::iter::once(&self.material).chain(&self.more_materials);
        known.position(|known| *known == material).unwrap_or_else(|| {
            self.more_materials.push(material);
            self.more_materials.len()
        })
    }
}

/// Key of a part that gathers filaments: flower or, without one, organ; kind; material.
type Gathering = (Option<usize>, Option<usize>, OrganKind, usize);

/// Plans all parts of a plant, carriers first.
pub(super) fn plan(plant: &Plant, params: &ModelParams) -> Vec<Plan> {
    let specimens = Specimens::new(plant);
    let mut plans: Vec<Plan> = Vec::with_capacity(plant.branches.len() + plant.organs.len());
    let part_of = if params.tube.joined {
        plan_wood(plant, &specimens, &mut plans)
    } else {
        plan_branches(plant, &specimens, &mut plans)
    };
    let mut names = Names::default();
    let mut gathered: BTreeMap<Gathering, usize> = BTreeMap::new();
    let mut foliage: BTreeMap<(usize, OrganKind), usize> = BTreeMap::new();
    for (i, organ) in plant.organs.iter().enumerate() {
        let carrier = carrier(plant, organ);
        let specimen = match (carrier, organ.flower) {
            (Some(branch), _) => specimens.of_branch[branch],
            (None, Some(flower)) => specimens.of_flower[flower],
            (None, None) => specimens.of_lone(plant, organ),
        };
        let template = |name, material, source| Plan {
            name,
            kind: PartKind::Organ(organ.kind),
            parent: carrier.map(|branch| part_of[branch]),
            specimen,
            pivot: organ.base(),
            material,
            more_materials: Vec::new(),
            source,
        };
        if params.blade.gathered && is_copy(organ) {
            let part = *foliage.entry((specimen, organ.kind)).or_insert_with(|| {
                let part = template(names.foliage(organ.kind), organ.material, Source::Blades(Vec::new()));
                let trunk = part.parent.map(|carrier| root(&plans, carrier));
                let pivot = trunk.map_or(part.pivot, |trunk| plans[trunk].pivot);
                plans.push(Plan { parent: trunk, pivot, ..part });
                plans.len() - 1
            });
            let coat = plans[part].coat(organ.material);
            if let Source::Blades(blades) = &mut plans[part].source {
                blades.resize(blades.len().max(coat + 1), Vec::new());
                blades[coat].push(i);
            }
            continue;
        }
        let Shape::Filament { head, head_material, .. } = &organ.shape else {
            plans.push(template(names.single(organ), organ.material, Source::Organ(i)));
            continue;
        };
        let has_head = head.min_element() > 0.0;
        for (piece, material) in [(Piece::Thread, organ.material), (Piece::Head, *head_material)] {
            if piece == Piece::Head && !has_head {
                continue;
            }
            let lone_organ = organ.flower.is_none().then_some(i);
            let part =
                *gathered.entry((organ.flower, lone_organ, organ.kind, material)).or_insert_with(|| {
                    plans.push(template(
                        names.gathered(organ, piece),
                        material,
                        Source::Filaments(Vec::new()),
                    ));
                    plans.len() - 1
                });
            if let Source::Filaments(pieces) = &mut plans[part].source {
                pieces.push((i, piece));
            }
        }
    }
    plans
}

/// Whether an organ is a blade that nobody drew, one of many alike.
fn is_copy(organ: &Organ) -> bool {
    matches!(&organ.shape, Shape::Blade(blade) if blade.template.is_some()) && organ.stroke.is_none()
}

/// The part that carries this one and that nothing carries.
fn root(plans: &[Plan], mut part: usize) -> usize {
    while let Some(carrier) = plans[part].parent {
        part = carrier;
    }
    part
}

/// One part for every branch; gives the part of each.
fn plan_branches(plant: &Plant, specimens: &Specimens, plans: &mut Vec<Plan>) -> Vec<usize> {
    let part = |i: usize| wood(plant, specimens, i, plant.branches[i].parent, format!("branch_{i}"));
    plans.extend((0..plant.branches.len()).map(part));
    (0..plant.branches.len()).collect()
}

/// One part for all branches that grow on one another; gives the part of each branch.
fn plan_wood(plant: &Plant, specimens: &Specimens, plans: &mut Vec<Plan>) -> Vec<usize> {
    let mut part_of = Vec::with_capacity(plant.branches.len());
    let mut place_of = Vec::with_capacity(plant.branches.len());
    for (i, branch) in plant.branches.iter().enumerate() {
        let part = branch.parent.map_or(plans.len(), |parent| part_of[parent]);
        part_of.push(part);
        if branch.parent.is_none() {
            plans.push(wood(plant, specimens, i, None, numbered("wood", part)));
            place_of.push(0);
        } else {
            let coat = plans[part].coat(branch.material);
            let Source::Wood(limbs) = &mut plans[part].source else { continue };
            place_of.push(limbs.len());
            limbs.push(Limb { branch: i, parent: branch.parent.map(|parent| place_of[parent]), coat });
        }
    }
    part_of
}

/// A name for the first of its kind, and with numbers for those after it.
fn numbered(name: &str, number: usize) -> String {
    if number == 0 { name.to_owned() } else { format!("{name}_{number}") }
}

fn wood(plant: &Plant, specimens: &Specimens, i: usize, parent: Option<usize>, name: String) -> Plan {
    let branch = &plant.branches[i];
    Plan {
        name,
        kind: PartKind::Wood,
        parent,
        specimen: specimens.of_branch[i],
        pivot: branch.points.first().copied().unwrap_or(Vec3::ZERO),
        material: branch.material,
        more_materials: Vec::new(),
        source: Source::Wood(vec![Limb { branch: i, parent: None, coat: 0 }]),
    }
}

/// The branch that carries an organ, its own or its flower's.
fn carrier(plant: &Plant, organ: &Organ) -> Option<usize> {
    organ.branch.or_else(|| organ.flower.and_then(|f| plant.flowers[f].branch))
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
        if organ.kind != OrganKind::Pot {
            return self.lone;
        }
        let away =
            |i: usize| plant.branches[i].points.first().map_or(f32::INFINITY, |p| p.distance(organ.base()));
        let trunks = (0..plant.branches.len()).filter(|&i| plant.branches[i].parent.is_none());
        let held = trunks.min_by(|a, b| away(*a).total_cmp(&away(*b)));
        held.map_or(self.lone, |trunk| self.of_branch[trunk])
    }
}

/// Counts what has been named so far.
#[derive(Default)]
struct Names {
    singles: BTreeMap<(Option<usize>, OrganKind), usize>,
    gathered: BTreeMap<String, usize>,
    foliage: BTreeMap<OrganKind, usize>,
    lone_filaments: BTreeMap<OrganKind, usize>,
}

impl Names {
    fn single(&mut self, organ: &Organ) -> String {
        let number = next(self.singles.entry((organ.flower, organ.kind)).or_default());
        let kind = kind_name(organ.kind);
        organ.flower.map_or_else(|| format!("{kind}_{number}"), |flower| format!("{kind}_{flower}_{number}"))
    }

    /// A part of many blades.
    fn foliage(&mut self, kind: OrganKind) -> String {
        let number = next(self.foliage.entry(kind).or_default());
        let kind =
            if kind == OrganKind::Leaf { "leaves".to_owned() } else { format!("{}s", kind_name(kind)) };
        numbered(&kind, number)
    }

    fn gathered(&mut self, organ: &Organ, piece: Piece) -> String {
        let what = match (organ.kind, piece) {
            (OrganKind::Stamen, Piece::Head) => "anthers".to_owned(),
            (OrganKind::Pistil, Piece::Head) => "stigmas".to_owned(),
            (kind, Piece::Thread) => format!("{}s", kind_name(kind)),
            (kind, Piece::Head) => format!("{}_heads", kind_name(kind)),
        };
        let mut name = match organ.flower {
            Some(flower) => format!("{what}_{flower}"),
            None => format!("{what}_lone_{}", next(self.lone_filaments.entry(organ.kind).or_default())),
        };
        let twin = next(self.gathered.entry(name.clone()).or_default());
        if twin > 0 {
            // Writing to a string cannot fail.
            let _ = write!(name, "_{twin}");
        }
        name
    }
}

fn next(counter: &mut usize) -> usize {
    *counter += 1;
    *counter - 1
}

fn kind_name(kind: OrganKind) -> &'static str {
    match kind {
        OrganKind::Leaf => "leaf",
        OrganKind::Bud => "bud",
        OrganKind::Petal => "petal",
        OrganKind::Sepal => "sepal",
        OrganKind::Receptacle => "receptacle",
        OrganKind::Stamen => "stamen",
        OrganKind::Pistil => "pistil",
        OrganKind::Fruit => "fruit",
        OrganKind::Thorn => "thorn",
        OrganKind::Pot => "pot",
    }
}
