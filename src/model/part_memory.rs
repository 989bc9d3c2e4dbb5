//! Meshes of the last model's parts by the recipes that they were made from, in the order of the parts.
//!
//! From one model to the next most parts are the same and in the same order. So a part is first held against the one in its
//! place, counted from the first part or from the last: what is compared then lies side by side in memory. Only what is
//! elsewhere or new is looked for by its hash.
//!
//! Limits: of parts with equal recipes, which are made at once, each may have a mesh of its own.

use super::mesh::Mesh;
use super::recipe::{Recipe, WrittenRecipe};
use crate::kept::NameHasher;
use std::collections::HashMap;
use std::hash::BuildHasherDefault;
use std::sync::{Arc, OnceLock};

/// The parts of the last model; none where one has the mesh of a part before it.
#[derive(Debug, Default)]
pub(super) struct PartMemory(Vec<Option<Held>>);

/// A mesh that is kept.
#[derive(Debug)]
pub(super) struct Held {
    hash: u64,
    recipe: WrittenRecipe,
    mesh: Arc<Mesh>,
}

/// The mesh of a part, on its way into the memory.
pub(super) enum Made {
    /// It is known, at this place.
    Known(usize, Arc<Mesh>),
    /// It is new.
    New(Held),
}

impl Made {
    /// A new mesh and what it was made from.
    pub(super) fn new(recipe: &Recipe<'_>, mesh: Arc<Mesh>) -> Self {
        Self::New(Held { hash: recipe.hash(), recipe: recipe.written(), mesh })
    }
}

impl PartMemory {
    /// How many meshes are kept.
    pub(super) fn len(&self) -> usize {
        self.0.iter().flatten().count()
    }

    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    /// A search for the parts of a model that has so many.
    pub(super) fn search(&self, parts: usize) -> Search<'_> {
        Search { held: &self.0, parts, by_hash: OnceLock::new() }
    }

    /// Keeps the parts of a whole model, and nothing else; gives their meshes.
    pub(super) fn keep(&mut self, made: Vec<Option<Made>>) -> Vec<Arc<Mesh>> {
        let mut meshes = Vec::with_capacity(made.len());
        let mut old = std::mem::replace(&mut self.0, Vec::with_capacity(made.len()));
        for made in made.into_iter().flatten() {
            let (held, mesh) = match made {
                Made::Known(place, mesh) => (old[place].take(), mesh),
                Made::New(held) => {
                    let mesh = Arc::clone(&held.mesh);
                    (Some(held), mesh)
                }
            };
            self.0.push(held);
            meshes.push(mesh);
        }
        meshes
    }

    /// Keeps the parts of a model that was not finished, beside those of the last one.
    pub(super) fn add(&mut self, made: Vec<Option<Made>>) {
        self.0.extend(made.into_iter().flatten().filter_map(|made| match made {
            Made::Known(..) => None,
            Made::New(held) => Some(Some(held)),
        }));
    }
}

/// Looks for the parts of a model among those of the last one, from any thread.
pub(super) struct Search<'a> {
    held: &'a [Option<Held>],
    parts: usize,
    /// Made when a part is not in its place.
    by_hash: OnceLock<HashMap<u64, usize, BuildHasherDefault<NameHasher>>>,
}

impl Search<'_> {
    /// The mesh with this recipe, which belongs to the part of this number.
    pub(super) fn find(&self, part: usize, recipe: &Recipe<'_>) -> Option<Made> {
        let from_last = (part + self.held.len()).checked_sub(self.parts);
        let mut in_place = [Some(part), from_last].into_iter().flatten();
        in_place.find_map(|place| self.known(place, recipe)).or_else(|| {
            let by_hash = self.by_hash.get_or_init(|| {
                let named = |(place, held): (usize, &Option<Held>)| Some((held.as_ref()?.hash, place));
                self.held.iter().enumerate().filter_map(named).collect()
            });
            self.known(*by_hash.get(&recipe.hash())?, recipe)
        })
    }

    fn known(&self, place: usize, recipe: &Recipe<'_>) -> Option<Made> {
        let held = self.held.get(place)?.as_ref().filter(|held| recipe.is(&held.recipe))?;
        Some(Made::Known(place, Arc::clone(&held.mesh)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::fineness::Fineness;
    use super::super::solids::Proportion;
    use super::*;

    /// Looks for parts that are told apart by numbers; gives them and the numbers of those that were made.
    fn found(memory: &PartMemory, numbers: &[u8]) -> (Vec<Option<Made>>, Vec<u8>) {
        let search = memory.search(numbers.len());
        let (mut recipe, mut new) = (Recipe::default(), Vec::new());
        let mut part = |(part, number): (usize, &u8)| {
            recipe.dome_shape(Proportion::of(1.0, f32::from(*number)).unwrap(), Fineness::Whole);
            let made = search.find(part, &recipe).unwrap_or_else(|| {
                new.push(*number);
                Made::new(&recipe, Arc::default())
            });
            Some(made)
        };
        (numbers.iter().enumerate().map(&mut part).collect(), new)
    }

    /// The same, kept as a whole model.
    fn kept(memory: &mut PartMemory, numbers: &[u8]) -> (Vec<Arc<Mesh>>, Vec<u8>) {
        let (made, new) = found(memory, numbers);
        (memory.keep(made), new)
    }

    #[test]
    fn parts_are_found_wherever_they_stand() {
        let mut memory = PartMemory::default();
        let (first, new) = kept(&mut memory, &[1, 2, 3, 4]);
        assert_eq!(new, [1, 2, 3, 4]);
        let (second, new) = kept(&mut memory, &[1, 5, 2, 4, 3]);
        assert_eq!(new, [5]);
        for (old, new) in [(0, 0), (1, 2), (2, 4), (3, 3)] {
            assert!(Arc::ptr_eq(&first[old], &second[new]));
        }
        let (third, new) = kept(&mut memory, &[4, 1]);
        assert!(new.is_empty() && Arc::ptr_eq(&third[1], &first[0]));
        assert_eq!((kept(&mut memory, &[2]).1, memory.len()), (vec![2], 1));
    }

    #[test]
    fn twins_are_found_again() {
        let mut memory = PartMemory::default();
        kept(&mut memory, &[1, 2]);
        for _ in 0..3 {
            let (meshes, new) = kept(&mut memory, &[1, 2, 1, 1]);
            assert!(new.is_empty() && Arc::ptr_eq(&meshes[0], &meshes[3]));
        }
        assert_eq!(memory.len(), 2);
    }

    #[test]
    fn the_work_of_a_stopped_build_is_not_lost() {
        let mut memory = PartMemory::default();
        kept(&mut memory, &[1, 2]);
        let (mut made, _) = found(&memory, &[3, 1, 4]);
        made.push(None);
        memory.add(made);
        assert!(kept(&mut memory, &[1, 2, 3, 4]).1.is_empty());
    }
}
