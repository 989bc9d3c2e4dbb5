//! What the mesh of a part depends on, written down: two parts with equal recipes have equal meshes.
//!
//! A recipe is a row of words: what kind of part it is, then the bits of every number that its meshing reads, lists with
//! their lengths first. Names, parents, materials and places in a list are left out, for they do not shape a mesh; nor
//! are parameters in it, for they are the same for the whole plant. Structures are taken apart by all their fields, so
//! that the compiler asks about a new one. A template of reduced detail is known by the name of its triangulation, any
//! other by its address, for stages before keep what they made, too. Whoever keeps a recipe holds these templates, so that
//! nothing else comes to lie there.

use super::fineness::Fineness;
use super::limbs::WoodBranch;
use super::piece::Piece;
use super::solids::{Proportion, Proportions};
use crate::plant::{
    Blade, Branch, Cone, Detail, FinishedPlant, Organ, ResolvedBlade, RestSurface, Role, Shape, Template,
};
use crate::random::mix;
use glam::{Vec2, Vec3};
use std::sync::Arc;

/// What a recipe knows a template by.
#[derive(Clone, Copy)]
pub(super) enum TemplateName<'a> {
    /// The name of its triangulation.
    Flat(u64),
    /// Its address.
    Address(&'a Arc<Template>),
}

/// The shape of an organ for a recipe.
pub(super) enum RecipeShape<'a> {
    /// A blade with its template.
    Blade(&'a Blade, TemplateName<'a>),
    /// Any other shape, and how finely it is made.
    Solid(&'a Shape, Fineness),
}

/// A row of words, used again for every part.
#[derive(Debug, Default)]
pub(super) struct Recipe<'a> {
    words: Vec<u32>,
    /// Templates that are known by their addresses.
    templates: Vec<&'a Arc<Template>>,
}

/// What all surfaces of a plant depend on but parameters and what its materials look like: everything of its branches and organs, its
/// templates, and which of them are of one material.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PlantRecipe(Box<[u32]>);

impl PlantRecipe {
    /// That of a plant.
    pub fn of(plant: &FinishedPlant) -> Self {
        let mut recipe = Recipe::default();
        recipe.plant(plant);
        Self(recipe.words.into())
    }
}

/// A recipe that is kept.
#[derive(Debug)]
pub(super) struct WrittenRecipe {
    words: Box<[u32]>,
    _templates: Box<[Arc<Template>]>,
}

impl PartialEq for WrittenRecipe {
    fn eq(&self, other: &Self) -> bool {
        self.words == other.words
    }
}

impl<'a> Recipe<'a> {
    /// Begins anew with the kind of part.
    fn begin(&mut self, kind: u32) -> &mut Self {
        self.words.clear();
        self.templates.clear();
        self.word(kind)
    }

    /// The recipe of branches that are one surface and whose tolerances are shares of `unit` metres.
    pub(super) fn wood<'b>(&mut self, branches: impl Iterator<Item = WoodBranch<&'b Branch>>, unit: f32) {
        self.begin(0).real(unit);
        for WoodBranch { branch, parent, slot } in branches {
            self.word(parent.map_or(u32::MAX, |parent| parent as u32)).length(slot).limb(branch);
        }
    }

    /// The recipe of a template.
    pub(super) fn template(&mut self, template: &Template) {
        self.begin(1).outline(template);
    }

    /// The recipe of the shape of a blade that stands at the origin, by the name of its triangulation.
    pub(super) fn shape(&mut self, upright: &ResolvedBlade<'_>, flat: u64) {
        self.begin(3).blade(upright, TemplateName::Flat(flat));
    }

    /// The recipe of the shape of a dome of these proportions.
    pub(super) fn dome_shape(&mut self, proportion: Proportion, fineness: Fineness) {
        self.begin(4).real(proportion.height()).word(fineness as u32);
    }

    /// The recipe of the shape of a head of these proportions.
    pub(super) fn head_shape(&mut self, proportion: Proportion, fineness: Fineness) {
        self.begin(5).real(proportion.height()).word(fineness as u32);
    }

    /// The recipe of the shape of a lathed body of these proportions.
    pub(super) fn lathe_shape(&mut self, proportions: &Proportions, fineness: Fineness) {
        self.begin(8).plane(&proportions.profile()).word(fineness as u32);
    }

    /// The recipe of the shape of cards with this window.
    pub(super) fn card_shape(&mut self, window: &[Vec2; 2], is_whole: bool) {
        self.begin(6).plane(window).word(u32::from(is_whole));
    }

    /// The recipe of pieces of organs that are one part, a group for each material; blades come with what
    /// their template is known by.
    pub(super) fn organs<Group>(&mut self, groups: impl Iterator<Item = Group>)
    where
        Group: Iterator<Item = (RecipeShape<'a>, Piece)>,
    {
        self.begin(2);
        let mut slots = 0;
        for (slot, pieces) in groups.enumerate() {
            slots = slot + 1;
            for (shape, piece) in pieces {
                self.length(slot).word(u32::from(piece == Piece::Head));
                match shape {
                    RecipeShape::Blade(blade, template) => self.blade(blade, template),
                    RecipeShape::Solid(solid, fineness) => self.word(fineness as u32).solid(solid),
                };
            }
        }
        // A mesh tells where each material begins, also of those that only copies have.
        self.length(slots);
    }

    /// The recipe of a whole plant, its templates by what they are.
    fn plant(&mut self, plant: &FinishedPlant) {
        self.begin(7).length(plant.templates.len());
        for template in plant.templates.iter() {
            self.outline(template);
        }
        self.length(plant.branches.len());
        for branch in &plant.branches {
            let Branch { origin, parent, level, points: _, radii: _, role } = branch;
            let Role { part, look, variant } = role;
            self.word(u32::from(origin.is_drawn())).place(*parent).word(*level);
            self.word(*part as u32).word(*look).word(*variant).length(plant.material(*role)).limb(branch);
        }
        for Organ { role, origin, branch, flower, shape } in &plant.organs {
            let Role { part, look, variant } = role;
            self.word(u32::from(origin.is_drawn())).place(*branch).place(*flower);
            self.word(*part as u32).word(*look).word(*variant).length(plant.material(*role));
            self.length(plant.material(role.of_head()));
            match shape {
                Shape::Blade(blade) => self.blade(blade, TemplateName::Flat(blade.template.index() as u64)),
                solid => self.solid(solid),
            };
        }
    }

    /// The recipe, to be kept.
    pub(super) fn written(&self) -> WrittenRecipe {
        WrittenRecipe {
            words: self.words.as_slice().into(),
            _templates: self.templates.iter().map(|template| Arc::clone(template)).collect(),
        }
    }

    /// Whether a recipe that is kept says the same.
    pub(super) fn is(&self, kept: &WrittenRecipe) -> bool {
        *self.words == *kept.words
    }

    /// A number that tells nearly all recipes apart.
    pub(super) fn hash(&self) -> u64 {
        // Four rows of words side by side: the next of one does not wait for the last of another.
        let mut rows = [self.words.len() as u64, 1, 2, 3];
        let mut eights = self.words.chunks_exact(8);
        for eight in eights.by_ref() {
            for (row, pair) in rows.iter_mut().zip(eight.chunks_exact(2)) {
                *row = mix(*row, u64::from(pair[0]) << 32 | u64::from(pair[1]));
            }
        }
        let rest = eights.remainder().iter().map(|word| u64::from(*word));
        rest.chain(rows).fold(0, mix)
    }

    fn limb(&mut self, branch: &Branch) -> &mut Self {
        let Branch { origin: _, parent: _, level: _, points, radii, role: _ } = branch;
        self.points(points).length(radii.len());
        self.words.extend_from_slice(bytemuck::cast_slice(radii));
        self
    }

    fn outline(&mut self, template: &Template) -> &mut Self {
        let (outline, curl) = (template.outline(), template.curl());
        let detail = match template.detail() {
            Detail::Full => 0,
            Detail::Reduced => 1,
            Detail::Moderate => 2,
        };
        self.word(detail).real(template.length()).plane(outline).length(curl.len());
        self.words.extend_from_slice(bytemuck::cast_slice(curl));
        self
    }

    fn name(&mut self, name: u64) -> &mut Self {
        self.word(name as u32).word((name >> 32) as u32)
    }

    fn blade<T>(&mut self, blade: &Blade<T>, template: TemplateName<'a>) -> &mut Self {
        let Blade { template: _, base, u, v, rest, form } = blade;
        match template {
            TemplateName::Flat(name) => self.word(4).name(name),
            TemplateName::Address(template) => {
                self.templates.push(template);
                self.word(5).name(Arc::as_ptr(template).addr() as u64)
            }
        };
        self.point(*base).point(*u).point(*v);
        match rest {
            RestSurface::Plane => self.word(0),
            RestSurface::Cone { cone, hint, sight } => {
                let Cone { apex, axis, opening_rad, height } = cone;
                self.word(1)
                    .point(*apex)
                    .point(*axis)
                    .real(*opening_rad)
                    .real(*height)
                    .real(*hint)
                    .point(*sight)
            }
            RestSurface::Shaped { cone, hint, sight, ways } => {
                let Cone { apex, axis, opening_rad, height } = cone;
                self.word(4)
                    .point(*apex)
                    .point(*axis)
                    .real(*opening_rad)
                    .real(*height)
                    .real(*hint)
                    .point(*sight);
                self.words.extend(ways.words().map(f32::to_bits));
                &mut *self
            }
            RestSurface::Patch(patch) => {
                self.word(2).words.extend(patch.words().map(f32::to_bits));
                &mut *self
            }
            RestSurface::Ring(sheet) => {
                self.word(3).words.extend(sheet.words().map(f32::to_bits));
                &mut *self
            }
        };
        self.words.extend(form.to_row().map(f32::to_bits));
        self
    }

    fn solid(&mut self, shape: &Shape) -> &mut Self {
        match shape {
            // A blade needs its template.
            Shape::Blade(_) => self.word(0),
            Shape::Dome { base, axis, radius, height } => {
                self.word(1).point(*base).point(*axis).real(*radius).real(*height)
            }
            Shape::Filament { points, radius, head } => {
                self.word(2).points(points).real(*radius).real(head.x).real(head.y)
            }
            Shape::Card { base, u, v, window, is_whole } => {
                self.word(5).point(*base).point(*u).point(*v).plane(window).word(u32::from(*is_whole))
            }
            Shape::Spike { base, tip, side, foot, hook } => {
                self.word(4).point(*base).point(*tip).point(*side).real(foot.x).real(foot.y).point(*hook)
            }
            Shape::Lathe { base, axis, profile } => self.word(3).point(*base).point(*axis).plane(profile),
        }
    }

    fn word(&mut self, word: u32) -> &mut Self {
        self.words.push(word);
        self
    }

    fn place(&mut self, place: Option<usize>) -> &mut Self {
        self.word(place.map_or(u32::MAX, |place| place as u32))
    }

    fn length(&mut self, count: usize) -> &mut Self {
        self.word(count as u32)
    }

    fn real(&mut self, value: f32) -> &mut Self {
        self.word(value.to_bits())
    }

    fn point(&mut self, point: Vec3) -> &mut Self {
        self.words.extend(point.to_array().map(f32::to_bits));
        self
    }

    fn points(&mut self, points: &[Vec3]) -> &mut Self {
        self.length(points.len());
        self.words.extend_from_slice(bytemuck::cast_slice(points));
        self
    }

    fn plane(&mut self, points: &[Vec2]) -> &mut Self {
        self.length(points.len());
        self.words.extend_from_slice(bytemuck::cast_slice(points));
        self
    }
}
