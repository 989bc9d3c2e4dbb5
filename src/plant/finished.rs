//! A plant with its materials, as a species leaves it: what models, pictures and files are made from.
//!
//! The plant says what each branch and organ is, a table what such things are made of. The plant is read only from here
//! on, so that each of its roles has a material.

use super::{Branch, Flower, Material, Organ, OrganKind, Plant, Role};
use glam::Vec3;
use std::collections::BTreeMap;
use std::ops::Deref;

/// A plant whose branches and organs all have a material.
#[derive(Clone, Debug, PartialEq)]
pub struct FinishedPlant {
    plant: Plant,
    materials: Vec<Material>,
    of_role: BTreeMap<Role, usize>,
}

impl FinishedPlant {
    /// Gives every role of a plant its material. Materials stand in the order in which they are first needed, those of
    /// the roles in `first` before all others; materials of one name are one.
    pub fn new(plant: Plant, first: &[Role], material_of: impl Fn(Role) -> Material) -> Self {
        let (mut materials, mut of_role) = (Vec::<Material>::new(), BTreeMap::new());
        for role in first.iter().copied().chain(plant.roles()) {
            of_role.entry(role).or_insert_with(|| {
                let material = material_of(role);
                let known = materials.iter().position(|known| known.name == material.name);
                known.unwrap_or_else(|| {
                    materials.push(material);
                    materials.len() - 1
                })
            });
        }
        Self { plant, materials, of_role }
    }

    /// A plant without a species: every role has a matt grey surface of its own.
    pub fn plain(plant: Plant) -> Self {
        let name = |Role { part, look, variant }: Role| format!("{}_{look}_{variant}", part.name());
        Self::new(plant, &[], |role| Material::plain(&name(role), [0.5; 3]))
    }

    /// The materials, each once.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Index among [`Self::materials`] of what a role of this plant is made of; of any other role 0.
    pub fn material(&self, role: impl Into<Role>) -> usize {
        self.of_role.get(&role.into()).copied().unwrap_or(0)
    }

    /// Changes the materials of all organs of a kind, or with `None` of all branches. What a material is for others stays
    /// as it is: then the changed one is a new one, whose name ends in `suffix`.
    pub fn change_materials(
        &mut self,
        kind: Option<OrganKind>,
        suffix: &str,
        change: impl Fn(&Material) -> Material,
    ) {
        let mut roles: Vec<Role> = self.plant.roles().collect();
        roles.sort_unstable();
        roles.dedup();
        let (mine, others): (Vec<Role>, Vec<Role>) =
            roles.into_iter().partition(|role| role.part.kind() == kind);
        let mut changing: Vec<usize> = mine.iter().map(|role| self.material(*role)).collect();
        changing.sort_unstable();
        changing.dedup();
        for old in changing {
            let mut changed = change(&self.materials[old]);
            if others.iter().all(|role| self.material(*role) != old) {
                self.materials[old] = changed;
                continue;
            }
            changed.name = self.unused_name(&format!("{}-{suffix}", changed.name));
            for role in &mine {
                if self.material(*role) == old {
                    self.of_role.insert(*role, self.materials.len());
                }
            }
            self.materials.push(changed);
        }
    }

    /// Gives a role that the plant does not have yet its material; if another material has its name it gets a new one.
    pub fn add_material(&mut self, role: Role, mut material: Material) {
        if self.materials.iter().any(|known| known.name == material.name) {
            material.name = self.unused_name(&material.name);
        }
        self.of_role.insert(role, self.materials.len());
        self.materials.push(material);
    }

    /// Some of its branches and organs, by their places in their order, with all its materials. A branch whose parent is not among
    /// them stands by itself.
    #[must_use]
    pub fn excerpt(&self, branches: &[usize], organs: &[usize]) -> Self {
        let place = |index: Option<usize>| index.and_then(|index| branches.binary_search(&index).ok());
        let mut excerpt = Plant { templates: self.plant.templates.clone(), ..Plant::default() };
        for branch in branches.iter().map(|&index| &self.plant.branches[index]) {
            let parent = place(branch.parent);
            let level = parent.map_or(0, |parent| excerpt.branches[parent].level + 1);
            excerpt.branches.push(Branch { parent, level, ..branch.clone() });
        }
        let without_branch = |flower: &Flower| Flower { branch: None, ..flower.clone() };
        excerpt.flowers = self.plant.flowers.iter().map(without_branch).collect();
        let organ = |organ: &Organ| Organ { branch: place(organ.branch), ..organ.clone() };
        excerpt.organs = organs.iter().map(|&index| organ(&self.plant.organs[index])).collect();
        excerpt.drop_unused_templates();
        Self { plant: excerpt, materials: self.materials.clone(), of_role: self.of_role.clone() }
    }

    /// Changes the plant, which must not get a role that it did not have.
    pub fn reshape(&mut self, change: impl FnOnce(&mut Plant)) {
        change(&mut self.plant);
        debug_assert!(
            self.plant.roles().all(|role| self.of_role.contains_key(&role)),
            "a role without material"
        );
    }

    /// Scales the plant about the origin and then moves it; `scale` is more than 0.
    pub fn scale_and_move(&mut self, scale: f32, by: Vec3) {
        self.plant.scale_and_move(scale, by);
    }

    /// Puts another plant behind this one. Materials that are the same in both are one; of different ones with one name
    /// the other plant's has `suffix` behind its name. Gives the index here of each of the other's materials.
    pub fn append(&mut self, other: &Self, suffix: &str) -> Vec<usize> {
        let mut place_of = |material: &Material| {
            if let Some(known) = self.materials.iter().position(|known| known == material) {
                return known;
            }
            let mut material = material.clone();
            if self.materials.iter().any(|known| known.name == material.name) {
                material.name = self.unused_name(&format!("{}-{suffix}", material.name));
            }
            self.materials.push(material);
            self.materials.len() - 1
        };
        let places: Vec<usize> = other.materials.iter().map(&mut place_of).collect();
        // Roles of two species would meet; by their variants, of which only materials depend, they are told apart.
        let variants = self.of_role.keys().map(|role| role.variant + 1).max().unwrap_or(0);
        let apart = |role: &Role| Role { variant: role.variant + variants, ..*role };
        self.of_role.extend(other.of_role.iter().map(|(role, material)| (apart(role), places[*material])));
        let mut plant = other.plant.clone();
        plant.branches.iter_mut().for_each(|branch| branch.role.variant += variants);
        plant.organs.iter_mut().for_each(|organ| organ.role.variant += variants);
        self.plant.append(plant);
        places
    }

    fn unused_name(&self, wanted: &str) -> String {
        let free = |name: &String| self.materials.iter().all(|material| material.name != *name);
        let mut names = std::iter::once(wanted.to_owned()).chain((2..).map(|n| format!("{wanted}{n}")));
        names.find(free).unwrap_or_else(|| wanted.to_owned())
    }

    /// Checks the plant, and that every role has its material.
    ///
    /// # Errors
    /// The first violation, in words.
    pub fn check_invariants(&self) -> Result<(), String> {
        self.plant.check_invariants()?;
        if let Some(role) = self.plant.roles().find(|role| !self.of_role.contains_key(role)) {
            return Err(format!("{role:?} has no material"));
        }
        match self.of_role.iter().find(|(_, material)| **material >= self.materials.len()) {
            Some((role, material)) => Err(format!("{role:?}: material {material} out of range")),
            None => Ok(()),
        }
    }
}

impl Deref for FinishedPlant {
    type Target = Plant;

    fn deref(&self) -> &Plant {
        &self.plant
    }
}
