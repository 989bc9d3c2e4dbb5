//! Organs to meshes: blades, solids and filaments, one of them or many in one part.
//!
//! Blades of one template are triangulated once, before any part is made, and what has one shape is made once. Where a part
//! has many copies of few shapes they stay copies; what is left is appended in its order. Where a part has several
//! materials its triangles are ordered by them.

use super::blade::{self, BladeScratch};
use super::cache::{Cache, FlatTemplate};
use super::card;
use super::copies::{Copies, Placement};
use super::filaments;
use super::fineness::Finenesses;
use super::flat::{self, FlatScratch};
use super::mesh::Mesh;
use super::params::ModelParams;
use super::piece::Piece;
use super::recipe::{Recipe, RecipeShape, TemplateName};
use super::shapes::{self, CopyShape, Original, ShapesInCommon};
use super::solids;
use super::spike;
use super::tube::TubeScratch;

use crate::plant::{Blade, Plant, Shape, Template, TemplateId};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Shapes that one thread makes at a time.
const BATCH: usize = 8;
/// Fewest organs of a part that are kept as copies, and fewest for each shape: fewer are no less as triangles, and each
/// shape is a call to the graphics card.
const FEWEST_COPIES: usize = 16;
const FEWEST_OF_A_SHAPE: usize = 4;

/// Memory that is used again for every part.
#[derive(Default)]
pub(super) struct OrganScratch {
    flat: FlatScratch,
    blade: BladeScratch,
    tube: TubeScratch,
}

/// What the organs of one plant have in common.
pub(super) struct OrganWorkshop<'a> {
    plant: &'a Plant,
    params: &'a ModelParams,
    finenesses: Finenesses,
    /// For each template whose blades share one its triangulation.
    templates: Vec<Option<FlatTemplate>>,
    /// For each organ the number of its shape, for a filament of that of its head.
    shape_of: Vec<Option<u32>>,
    /// None where a shape has no area.
    shapes: Vec<Option<CopyShape>>,
}

impl<'a> OrganWorkshop<'a> {
    pub(super) fn new(plant: &'a Plant, params: &'a ModelParams, cache: &mut Cache) -> Self {
        let templates = templates(plant, params, cache);
        let finenesses = Finenesses::of(plant);
        let ShapesInCommon { of_organ: shape_of, originals } = ShapesInCommon::of(plant, &finenesses);
        let shapes = shapes(&originals, &templates, params, cache);
        Self { plant, params, finenesses, templates, shape_of, shapes }
    }

    /// Everything that [`Self::mesh`] reads but the parameters.
    pub(super) fn write_recipe<Pieces>(&self, slots: &[Pieces], recipe: &mut Recipe<'a>)
    where
        Pieces: AsRef<[(usize, Piece)]>,
    {
        let described = |&(organ, piece): &(usize, Piece)| {
            let shape = match self.shape(organ) {
                Shape::Blade(blade) => {
                    let name = match &self.templates[blade.template.index()] {
                        Some(shared) => TemplateName::Flat(shared.name),
                        None => TemplateName::Address(self.plant.templates.shared(blade.template)),
                    };
                    RecipeShape::Blade(blade, name)
                }
                solid => RecipeShape::Solid(solid, self.finenesses.at(&self.plant.organs[organ])),
            };
            (shape, piece)
        };
        recipe.organs(slots.iter().map(|pieces| pieces.as_ref().iter().map(described)));
    }

    /// The mesh of pieces of organs, a list for each material.
    pub(super) fn mesh<Pieces>(&self, slots: &[Pieces], scratch: &mut OrganScratch) -> Mesh
    where
        Pieces: AsRef<[(usize, Piece)]>,
    {
        let mut mesh = Mesh::default();
        for (slot, pieces) in slots.iter().enumerate() {
            if slot > 0 {
                mesh.breaks.push(mesh.triangles.len() as u32);
            }
            for run in pieces.as_ref().chunk_by(|a, b| self.is_stalk(*a) == self.is_stalk(*b)) {
                if self.is_stalk(run[0]) {
                    let stalk = |&(organ, _): &(usize, Piece)| {
                        let organ = &self.plant.organs[organ];
                        (&organ.shape, self.finenesses.at(organ))
                    };
                    let stalks = run.iter().map(stalk);
                    filaments::append(&mut mesh, stalks, &self.params.solid, &mut scratch.tube);
                } else {
                    self.append_bodies(run, &mut mesh, scratch);
                }
            }
        }
        mesh
    }

    /// Takes what is a copy of few shapes out of a part's pieces.
    pub(super) fn take_copies(&self, slots: &mut [Vec<(usize, Piece)>]) -> Option<Copies> {
        if slots.iter().map(Vec::len).sum::<usize>() < FEWEST_COPIES {
            return None;
        }
        // The part's own number of each shape, which has the order of the plant's.
        let mut own: BTreeMap<u32, u32> = BTreeMap::new();
        let mut placements: Vec<Placement> = Vec::new();
        let mut others: Vec<Vec<(usize, Piece)>> = vec![Vec::new(); slots.len()];
        for ((pieces, others), slot) in slots.iter().zip(&mut others).zip(0..) {
            for &(organ, piece) in pieces {
                let Some((shape, placement)) = self.placement((organ, piece)) else {
                    others.push((organ, piece));
                    continue;
                };
                own.insert(shape, 0);
                placements.push(Placement { shape, slot, ..placement });
            }
        }
        if placements.len() < FEWEST_COPIES.max(FEWEST_OF_A_SHAPE * own.len()) {
            return None;
        }
        slots.iter_mut().zip(others).for_each(|(pieces, others)| *pieces = others);
        own.values_mut().zip(0..).for_each(|(number, next)| *number = next);
        placements.iter_mut().for_each(|placement| placement.shape = own[&placement.shape]);
        let shapes = own.keys().filter_map(|&shape| self.shapes[shape as usize].as_ref());
        Some(Copies { shapes: shapes.map(|shape| shape.mesh.clone()).collect(), placements })
    }

    /// The number of the shape of which a piece is a copy, and where the copy stands.
    fn placement(&self, (organ, piece): (usize, Piece)) -> Option<(u32, Placement)> {
        if self.is_stalk((organ, piece)) {
            return None;
        }
        let number = self.shape_of[organ]?;
        let placement = self.shapes[number as usize].as_ref()?.placement(self.shape(organ))?;
        Some((number, placement))
    }

    fn shape(&self, organ: usize) -> &'a Shape {
        &self.plant.organs[organ].shape
    }

    fn is_stalk(&self, (organ, piece): (usize, Piece)) -> bool {
        piece == Piece::Body && matches!(self.shape(organ), Shape::Filament { .. })
    }

    /// Appends blades, solids and heads.
    fn append_bodies(&self, run: &[(usize, Piece)], mesh: &mut Mesh, scratch: &mut OrganScratch) {
        for (done, &piece) in run.iter().enumerate() {
            let before = mesh.counts();
            if let Some((number, placement)) = self.placement(piece) {
                if let Some(shape) = &self.shapes[number as usize] {
                    placement.append(&shape.mesh, mesh);
                }
            } else {
                self.append_own(self.shape(piece.0), mesh, scratch);
            }
            if done == 0 {
                mesh.reserve_more(before, run.len() - 1);
            }
        }
    }

    /// Appends what is no copy to an empty mesh or to other organs.
    fn append_own(&self, shape: &Shape, mesh: &mut Mesh, scratch: &mut OrganScratch) {
        match shape {
            Shape::Blade(blade) => take_in(mesh, self.own_blade(blade, scratch)),
            Shape::Spike { .. } => take_in(mesh, spike::mesh(shape)),
            // What of these is no copy encloses nothing.
            Shape::Dome { .. } | Shape::Filament { .. } | Shape::Lathe { .. } | Shape::Card { .. } => {}
        }
    }

    /// The mesh of a blade that is no copy.
    fn own_blade(&self, blade: &Blade, scratch: &mut OrganScratch) -> Option<Mesh> {
        let params = &self.params.blade;
        let resolved = &self.plant.templates.resolve(blade);
        if let Some(FlatTemplate { flat, .. }) = &self.templates[blade.template.index()] {
            return blade::mesh(resolved, flat.as_ref().as_ref()?, params, &mut scratch.blade);
        }
        let waves = flat::waves_of(&blade.form);
        let flat = flat::flatten(resolved.template, waves, params, &mut scratch.flat)?;
        blade::mesh(resolved, &flat, params, &mut scratch.blade)
    }
}

/// Appends a mesh to another, or puts it into its place where that is empty.
fn take_in(mesh: &mut Mesh, own: Option<Mesh>) {
    let Some(own) = own else { return };
    if *mesh == Mesh::default() {
        *mesh = own;
    } else {
        mesh.append(&own);
    }
}

/// The triangulations of the templates whose blades share one.
fn templates(plant: &Plant, params: &ModelParams, cache: &mut Cache) -> Vec<Option<FlatTemplate>> {
    let (mut scratch, mut recipe) = (FlatScratch::default(), Recipe::default());
    let triangulated = |template: &Template| {
        template.detail().is_shared().then(|| {
            recipe.template(template);
            cache.template(&recipe, || flat::flatten(template, None, &params.blade, &mut scratch))
        })
    };
    plant.templates.iter().map(triangulated).collect()
}

/// The shapes that organs have in common, made on all cores.
fn shapes(
    originals: &[Original<'_>],
    templates: &[Option<FlatTemplate>],
    params: &ModelParams,
    cache: &mut Cache,
) -> Vec<Option<CopyShape>> {
    let (known, round) = (&cache.shapes, cache.round);
    let make = |(scratch, recipe): &mut (BladeScratch, Recipe<'_>), original: &Original<'_>| {
        let of_blade = |id: TemplateId| {
            let template = templates[id.index()].as_ref()?;
            Some((template.name, template.flat.as_ref().as_ref()?))
        };
        match original {
            Original::Blade(id, blade) => recipe.shape(&shapes::upright(blade), of_blade(*id)?.0),
            Original::Dome(proportion, fineness) => recipe.dome_shape(*proportion, *fineness),
            Original::Head(proportion, fineness) => recipe.head_shape(*proportion, *fineness),
            Original::Lathe(proportions, fineness) => recipe.lathe_shape(proportions, *fineness),
            Original::Card(window, is_whole) => recipe.card_shape(window, *is_whole),
        }
        let hash = recipe.hash();
        let shape = known.get(hash, recipe, round).cloned().or_else(|| match original {
            Original::Blade(id, blade) => {
                blade::shape(&shapes::upright(blade), of_blade(*id)?.1, &params.blade, scratch)
            }
            Original::Dome(proportion, fineness) => {
                CopyShape::solid(solids::dome(*proportion, *fineness, &params.solid))
            }
            Original::Head(proportion, fineness) => {
                CopyShape::solid(solids::head(*proportion, *fineness, &params.solid))
            }
            Original::Lathe(proportions, fineness) => {
                CopyShape::solid(solids::lathe(proportions, *fineness, &params.solid))
            }
            Original::Card(window, is_whole) => Some(card::shape(*window, *is_whole)),
        })?;
        Some((hash, recipe.written(), shape))
    };
    let made: Vec<_> = originals.par_iter().with_min_len(BATCH).map_init(Default::default, make).collect();
    made.into_iter().map(|made| made.map(|(hash, recipe, shape)| cache.shape(hash, recipe, shape))).collect()
}
