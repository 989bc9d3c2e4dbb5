//! The individuals of a garden, of which its plants are copies: made by a species, from a drawing, or finished models.
//!
//! The individuals of a species have the seeds that follow each other from the kind's first one, so each is also to be had by itself:
//! `penstemon grow rose --seed 2`. A finished model has one.
//!
//! What may lose foliage keeps to a budget of triangles, what may not becomes coarser ([`super::triangle_budget`]). For wide gardens their
//! foliage may be cards, or each of them two crossing pictures ([`Form`]).
//!
//! Limits: a wide garden has plants of few triangles; how many is a share of what all may have ([`triangles_of_each`]).

use super::levels::{self, Level, levels};
use super::setup::Params;
use super::source::{Bloom, Seed, Source};
use super::{Built, build, triangle_budget};
use crate::garden::{BeforeWall, Grown, Views};
use crate::model::Model;
use crate::sketch::{Remark, Sketch, Warning};
use crate::species::Species;
use rayon::prelude::*;

/// Triangles that the plants of a garden have together where nobody says otherwise, and its individuals.
const TRIANGLES_OF_ALL: (usize, usize) = (20_000_000, 500_000);
/// Most triangles that each has then.
const MOST_TRIANGLES: usize = 40_000;
/// How many times its triangles an inflorescence may have at its coarsest; one of more that has many small flowers is made of cards.
const TOO_FINE: f32 = 2.0;
/// How many flowers are many, and how far each reaches at most, share of the plant's height: nobody looks at one of them.
const SMALL_FLOWERS: (usize, f32) = (20, 0.05);
/// Fewest triangles that it becomes coarser for; it may have more at its coarsest.
pub const FEWEST_TRIANGLES: u32 = 2000;

/// How many triangles a plant should have of which there are so many, copies of so many individuals.
pub fn triangles_of_each(plants: usize, individuals: usize) -> u32 {
    let share = (TRIANGLES_OF_ALL.0 / plants.max(1)).min(TRIANGLES_OF_ALL.1 / individuals.max(1));
    share.clamp(FEWEST_TRIANGLES as usize, MOST_TRIANGLES) as u32
}

/// What individuals are made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// Wood, leaves and flowers.
    #[default]
    Whole,
    /// Wood, and cards of leaves, flowers and thin twigs.
    Cards,
    /// Two crossing pictures of the plant.
    Billboards,
}

/// What makes the individuals of a kind.
#[derive(Clone, Debug)]
pub enum Grower {
    /// A species that makes itself.
    Species {
        /// The species.
        species: Box<Species>,
        /// Its parameters.
        params: Box<Params>,
        /// Age in years, where it grows.
        age: Option<f32>,
        /// Seed of the first individual.
        first_seed: u64,
        /// What they are made of.
        form: Form,
        /// What each has beside it, and where it grows; nothing of plants that are copied.
        before: Option<BeforeWall>,
    },
    /// A drawing.
    Drawing {
        /// The drawing; the first individual has its own seed.
        sketch: Box<Sketch>,
        /// Its species.
        species: Box<Species>,
        /// Its parameters.
        params: Box<Params>,
        /// What the individuals are made of.
        form: Form,
    },
    /// A finished model.
    Model(Box<Model>),
}

impl Grower {
    /// Makes individuals of at most about so many triangles, or of as many as its parameters say. Flowers and leaves of roses and
    /// blooms all stay, so there may be more; blooms of many small flowers with more than twice as many are made of cards. Trees, drawings
    /// and cards lose foliage where they must, as `model.budget.triangles` says.
    pub fn fit(&mut self, usual: u32) {
        let (species, params, form) = match self {
            Self::Species { species, params, form, .. } => (Some(species), params, *form),
            Self::Drawing { params, form, .. } => (None, params, *form),
            Self::Model(_) => return,
        };
        params.cards.used |= form == Form::Cards;
        let may_thin = params.cards.used || species.is_none_or(|species| species.growth.is_some());
        let asked = std::mem::take(&mut params.model.budget.triangles);
        let wanted = if asked > 0 { asked } else { usual };
        if form == Form::Billboards {
            return;
        }
        let has_more = |built: &Built, than: f32| built.model.triangle_count() as f32 > than;
        let Some(built) = self.built(0).filter(|built| has_more(built, wanted as f32)) else { return };
        let (Self::Species { params, .. } | Self::Drawing { params, .. }) = self else { return };
        if may_thin {
            let whole = || built.model.triangle_count() as u64;
            params.cards.used |=
                triangle_budget::is_small(&built.plant, whole, u64::from(wanted), params.cards.below);
            params.model.budget.triangles = wanted;
            return;
        }
        params.model = triangle_budget::coarsened(&built.plant, &params.model, u64::from(wanted));
        let is_rose = params.rose.is_some();
        let too_many = TOO_FINE * wanted as f32;
        // Roses are looked at for each of their flowers.
        let is_too_fine = |built: &Built| !is_rose && has_more(built, too_many) && has_small_flowers(built);
        if self.built(0).is_some_and(|built| is_too_fine(&built)) {
            let (Self::Species { params, .. } | Self::Drawing { params, .. }) = self else { return };
            params.cards.used = true;
            params.model.budget.triangles = wanted;
        }
    }

    /// How many individuals there are if so many are wanted.
    pub fn variants(&self, wanted: u32) -> u32 {
        match self {
            Self::Model(_) => 1,
            Self::Species { before: Some(before), .. } => before.feet.len() as u32,
            _ => wanted.max(1),
        }
    }

    /// A finished individual; none of a finished model.
    fn built(&self, variant: u32) -> Option<Built> {
        match self {
            Self::Species { species, params, age, first_seed, form: _, before } => {
                let number = first_seed + u64::from(variant);
                let obstacles = before.as_ref().and_then(|before| before.seen_from(variant));
                let seed = Seed { number, age: *age, obstacles, ..Seed::default() };
                let grows = species.growth.is_some() || species.rose.is_some();
                let bloom = Bloom { number };
                let source = if grows { Source::Seed(&seed) } else { Source::Bloom(&bloom) };
                Some(build(source, species, params))
            }
            Self::Drawing { sketch, species, params, form: _ } => {
                let sketch =
                    Sketch { seed: sketch.seed.wrapping_add(u64::from(variant)), ..Sketch::clone(sketch) };
                Some(build(&sketch, species, params))
            }
            Self::Model(_) => None,
        }
    }

    /// So many individuals, with coarser forms where these are wanted.
    pub fn grow_all(&self, wanted: u32, with_coarser: bool) -> Vec<Grown> {
        (0..self.variants(wanted)).into_par_iter().map(|variant| self.grow(variant, with_coarser)).collect()
    }

    /// An individual. Of a finished model there are pictures alone.
    fn grow(&self, variant: u32, with_coarser: bool) -> Grown {
        let (params, form) = match self {
            Self::Model(model) => {
                let views = if with_coarser { levels::views(model) } else { Views::default() };
                return Grown { views, ..Model::clone(model).into() };
            }
            Self::Species { params, form, .. } | Self::Drawing { params, form, .. } => (params, *form),
        };
        let Some(Built { model, plant, remarks, .. }) = self.built(variant) else { return Grown::default() };
        // How many triangles an individual may have is the garden's choice.
        let is_own = |said: &&Warning| !matches!(said.remark, Remark::BudgetMissed { .. });
        let remarks = remarks.iter().filter(is_own).map(ToString::to_string).collect();
        if form == Form::Billboards {
            let flat = levels(&plant, &model, params, &[Level::Billboards]).pop();
            return Grown { model: flat.unwrap_or_default(), remarks, ..Grown::default() };
        }
        if !with_coarser {
            return Grown { model, remarks, ..Grown::default() };
        }
        Grown { remarks, ..levels::in_forms(&plant, model, params) }
    }
}

/// Whether a plant has many flowers of which each is small.
fn has_small_flowers(built: &Built) -> bool {
    let height = built.model.bounds().map_or(0.0, |(low, high)| high.y - low.y);
    let flowers = &built.plant.flowers;
    let (many, share) = SMALL_FLOWERS;
    flowers.len() >= many && flowers.iter().all(|flower| flower.reach <= share * height)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::garden::Stock;

    #[test]
    fn triangles_are_shared_out_by_the_number_of_plants() {
        assert_eq!(
            [10, 1000, 5000, 1_000_000].map(|plants| triangles_of_each(plants, 1)),
            [40_000, 20_000, 4000, 2000]
        );
        assert_eq!(triangles_of_each(10, 50), 10_000);
    }

    #[test]
    fn individuals_become_coarser_until_they_fit_and_keep_all_their_triangles_in_a_stock() {
        let species = Box::new(Species::built_in("daisy").unwrap());
        let alone = ["flower.clump.stems=1".to_owned()];
        let params = Box::new(super::super::params_of_species(&species, &alone).unwrap());
        let mut grower =
            Grower::Species { species, params, age: None, first_seed: 1, form: Form::Whole, before: None };
        let whole = grower.grow(0, false).model.triangle_count();
        grower.fit(25_000);
        let fitted = grower.grow(0, false).model;
        assert!(whole > 30_000 && (15_000..=25_000).contains(&fitted.triangle_count()), "{whole}");
        let mut stock = Stock::default();
        stock.add("daisy", grower.grow_all(2, false), 0.0);
        stock.add("fields/daisy.toml", grower.grow_all(1, false), 0.5);
        let names: Vec<&str> = stock.kinds.iter().map(|kind| kind.name.as_str()).collect();
        assert_eq!(names, ["daisy", "daisy_2"]);
        let Grown { model, .. } = grower.grow(1, false);
        let individual = &stock.kinds[0].individuals[1];
        assert_eq!(individual.triangle_count(), model.triangle_count());
        assert!(individual.surfaces.is_sorted_by_key(|surface| surface.material));
        assert!(individual.surfaces.iter().all(|surface| surface.mesh.check_indices().is_ok()));
        assert!(individual.surfaces.len() > 2);
        assert_eq!(
            stock.materials.len(),
            model.materials.iter().filter(|m| stock.materials.contains(m)).count()
        );
        assert!((stock.kinds[1].individuals[0].height() - 0.5).abs() < 1e-4);
    }
}
