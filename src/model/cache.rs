//! Meshes from one build to the next, so that a stroke more costs only the parts that it changes.
//!
//! Meshes are kept by the recipe of their part (`recipe`, `part_memory`): taken only if every word is the same. So
//! a plant built with a cache has the same bytes as one built without, and an unchanged part has the very same
//! [`Arc`], which a renderer recognises by its pointer. Wood of many branches is kept so that it is made anew only near what
//! changed (`wood_memory`). What a finished build did not use is forgotten; a stopped
//! build forgets nothing, so its work is not lost.
//!
//! Limits: a plant whose scale changes, as when the drawing grows higher, has new parts throughout; so has one built
//! with other parameters.

use super::flat::FlatBlade;
use super::params::ModelParams;
use super::part_memory::PartMemory;
use super::recipe::{Recipe, WrittenRecipe};
use super::shapes::CopyShape;
use super::wood_memory::WoodMemory;
use crate::kept::NameHasher;
use glam::Vec3;
use std::collections::HashMap;
use std::hash::BuildHasherDefault;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// What was built before.
#[derive(Debug, Default)]
pub struct Cache {
    /// Whether there is no next build, so that recipes of parts need not be written.
    pub(super) is_for_one_build: bool,
    params: ModelParams,
    pub(super) round: u64,
    pub(super) parts: PartMemory,
    pub(super) templates: Shelf<FlatTemplate>,
    pub(super) shapes: Shelf<CopyShape>,
    /// Wood of many branches.
    woods: Vec<WoodMemory>,
    names: u64,
}

/// The triangulation of a template, which its blades share; none where the outline has no area.
#[derive(Clone, Debug)]
pub(super) struct FlatTemplate {
    /// Tells it from all other triangulations that the cache ever held.
    pub(super) name: u64,
    pub(super) flat: Arc<Option<FlatBlade>>,
}

impl Cache {
    /// A cache for a single build, which keeps no meshes of parts.
    pub fn for_one_build() -> Self {
        Self { is_for_one_build: true, ..Self::default() }
    }

    /// How many meshes it holds.
    pub fn len(&self) -> usize {
        self.parts.len()
    }

    /// Whether it holds none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Begins a build with these parameters; those of a build with others are of no use.
    pub(super) fn begin(&mut self, params: &ModelParams) {
        if self.params != *params {
            self.params = params.clone();
            self.parts.clear();
            self.templates.held.clear();
            self.shapes.held.clear();
            self.woods.clear();
        }
        self.round += 1;
    }

    /// Ends a build: templates and shapes that it did not use are forgotten.
    pub(super) fn finish(&mut self) {
        self.templates.forget_before(self.round);
        self.shapes.forget_before(self.round);
    }

    /// What is known of wood that stands on this foot; it comes back by [`Self::keep_woods`].
    pub(super) fn take_wood(&mut self, foot: Vec3) -> WoodMemory {
        let known = self.woods.iter().position(|wood| wood.foot() == Some(foot));
        known.map(|place| self.woods.swap_remove(place)).unwrap_or_default()
    }

    /// Keeps what is known of wood; what is known of other wood is forgotten.
    pub(super) fn keep_woods(&mut self, woods: impl Iterator<Item = WoodMemory>) {
        self.woods.clear();
        self.woods.extend(woods);
    }

    /// The triangulation of a template with this recipe, made by `flatten` if it is new.
    pub(super) fn template(
        &mut self,
        recipe: &Recipe<'_>,
        flatten: impl FnOnce() -> Option<FlatBlade>,
    ) -> FlatTemplate {
        let hash = recipe.hash();
        let template = self.templates.get(hash, recipe, self.round).cloned().unwrap_or_else(|| {
            self.names += 1;
            FlatTemplate { name: self.names, flat: Arc::new(flatten()) }
        });
        self.templates.keep(hash, recipe.written(), template, self.round)
    }

    /// Keeps a shape in the running build.
    pub(super) fn shape(&mut self, hash: u64, recipe: WrittenRecipe, shape: CopyShape) -> CopyShape {
        self.shapes.keep(hash, recipe, shape, self.round)
    }
}

/// Things by the recipe that made them; of two recipes with one hash the later stays.
#[derive(Debug)]
pub(super) struct Shelf<T> {
    held: HashMap<u64, Held<T>, BuildHasherDefault<NameHasher>>,
}

#[derive(Debug)]
struct Held<T> {
    recipe: WrittenRecipe,
    thing: T,
    /// The last build that used it.
    round: AtomicU64,
}

impl<T> Default for Shelf<T> {
    fn default() -> Self {
        Self { held: HashMap::default() }
    }
}

impl<T: Clone> Shelf<T> {
    /// The thing with this recipe, which is used in a build from now on.
    pub(super) fn get(&self, hash: u64, recipe: &Recipe<'_>, round: u64) -> Option<&T> {
        let held = self.held.get(&hash).filter(|held| recipe.is(&held.recipe))?;
        held.round.store(round, Ordering::Relaxed);
        Some(&held.thing)
    }

    /// Keeps a thing, or the one with the same recipe that is there already; gives the one that stays.
    fn keep(&mut self, hash: u64, recipe: WrittenRecipe, thing: T, round: u64) -> T {
        let round = AtomicU64::new(round);
        if let Some(held) = self.held.get_mut(&hash).filter(|held| held.recipe == recipe) {
            held.round = round;
            return held.thing.clone();
        }
        self.held.insert(hash, Held { recipe, thing: thing.clone(), round });
        thing
    }

    fn forget_before(&mut self, round: u64) {
        self.held.retain(|_, held| *held.round.get_mut() >= round);
    }
}
