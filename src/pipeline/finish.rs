//! The way that all plants go, whoever made them: the species gives them their looks, the artist's own pictures lie over
//! those, and they become surfaces, as fine as the budget of triangles allows.

use super::clock::Clock;
use super::placing::{BuiltBeside, Placing};
use super::setup::Params;
use super::source::{Ages, MayBear, Produced};
use super::triangle_budget::{self, Finer};
use super::usual_species::DEFAULT_SPECIES;
use crate::anatomy::Anatomy;
use crate::budget::Budget;
use crate::cards::{self, CardParams};
use crate::garden::Garden;
use crate::growth::Obstacles;
use crate::growth::overlay::Spot;
use crate::model::{self, Model, ModelParams};
use crate::modelling::{self, DrawnWood, PartNames};
use crate::plant::{FinishedPlant, FlowerBuds, Plant, Provenance};
use crate::sketch::{Remark, Textures, Warning};
use crate::species::{self, Applied, Species};
use std::borrow::Cow;
use std::sync::{Arc, LazyLock};
use std::time::Duration;

/// A plant with everything that is known of it.
#[derive(Clone, Debug)]
pub struct Built {
    /// What the strokes mean; empty where there are none. Its remarks are in [`Built::remarks`].
    pub anatomy: Anatomy,
    /// What was odd about the source, and what the plant lacks: the strokes', then growth's, then the species' and the
    /// surfaces'.
    pub remarks: Vec<Warning>,
    /// How old the plant is, where it grew.
    pub growth: Option<Ages>,
    /// The plant in space, and behind it those that stand beside it.
    pub plant: FinishedPlant,
    /// What only its drawing knows of the plant.
    pub provenance: Provenance,
    /// What its parts are known by.
    pub names: PartNames,
    /// What stands beside it: seen in pictures, no part of its files.
    pub obstacles: Option<Arc<Obstacles>>,
    /// Its drawn wood, as it was modelled: where branches that are drawn in space can begin.
    pub wood: DrawnWood,
    /// The plants beside the drawn one, in the order of the drawing; none for what was left out.
    pub beside: Vec<Option<BuiltBeside>>,
    /// The garden around the plant.
    pub garden: Option<Arc<Garden>>,
    /// The plant as surfaces.
    pub model: Model,
    /// What growth looks like from inside; empty until [`Cache::look_inside`](super::Cache::look_inside).
    pub overlay: Vec<Spot>,
    /// Time that each stage took, in order.
    pub stages: Vec<(&'static str, Duration)>,
}

/// How a plant is finished.
pub(super) struct Finish<'a> {
    /// Decides what the species leaves to chance.
    pub(super) seed: u64,
    /// The artist's own pictures.
    pub(super) pictures: &'a Textures,
    /// What the plant may cost.
    pub(super) budget: Budget,
    /// Size and place that it is given once it has its looks; none where it is made in its place.
    pub(super) placing: Option<&'a Placing>,
}

/// Gives a plant its looks and its surfaces; nothing if `stop` said yes.
pub(super) fn finish(
    (cache, cards): (&mut model::Cache, &mut cards::Cache),
    produced: Produced,
    (species, params): (&Species, &Params),
    &Finish { seed, pictures, budget, placing }: &Finish<'_>,
    clock: &mut Clock,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Built> {
    let Produced { plant, buds, provenance, mut remarks, anatomy, growth, obstacles, mut wood, .. } =
        produced;
    let (mut poses, may_bear) = (produced.poses, produced.may_bear);
    let mut remark = |remark| remarks.push(Warning { stroke: None, remark });
    let names = PartNames::new(&provenance);
    let plant = clock.time("species", || {
        let looks = looks(species, params, (may_bear, !plant.flowers.is_empty()));
        // Outside of its time of blossom a tree shows nothing of its flower buds.
        let buds =
            if looks.blossom.is_some() == species.blossom.is_some() { buds } else { FlowerBuds::default() };
        let Applied { mut plant, is_blossom_thinned } =
            species::apply_within(plant, &buds, &provenance, &looks, seed, &budget);
        if is_blossom_thinned {
            remark(Remark::BlossomThinned { flowers: plant.flowers.len() });
        }
        species::textures::lay_over(&mut plant, pictures);
        let by = (&names, &mut poses, provenance.world_from_canvas.scale);
        plant.reshape(|plant| modelling::pose_organs(plant, by, &mut wood.posed));
        placing.iter().for_each(|placing| placing.place(&mut plant));
        debug_assert_eq!(plant.check_invariants(), Ok(()));
        debug_assert_eq!(provenance.check_invariants(&plant), Ok(()));
        plant
    });
    modelling::poses_at_rest(&poses, &wood.posed).into_iter().for_each(&mut remark);
    let wanted = u64::from(params.model.budget.triangles).min(budget.triangles);
    let plant = clock.time("cards", || with_cards(plant, params, wanted, cards, stop))?;
    if !params.cards.used && cards::are_in(&plant) {
        remark(Remark::FoliageAsCards { triangles: wanted });
    }
    let (plant, fitted) = match wanted {
        0 => (plant, None),
        _ => clock.time("budget", || {
            let (plant, fitted) = triangle_budget::fit(plant, &params.model, (wanted, Finer::May), stop);
            (plant, Some(fitted))
        }),
    };
    let requested = fitted.as_ref().unwrap_or(&params.model);
    let fineness = affordable(&plant, requested, budget.triangles, growth.is_some());
    if fineness.is_coarser {
        remark(Remark::Coarser { triangles: budget.triangles });
    }
    let model = clock.time("model", || model::rebuild(&plant, &fineness.params, cache, stop))?;
    budget_missed(&model, wanted).into_iter().for_each(&mut remark);
    let (beside, overlay, stages) = (Vec::new(), Vec::new(), clock.take());
    Some(Built {
        anatomy,
        remarks,
        growth,
        plant,
        provenance,
        names,
        obstacles,
        wood,
        beside,
        garden: None,
        model,
        overlay,
        stages,
    })
}

/// What flowers look like that are drawn for a species without any.
static USUAL_FLOWERS: LazyLock<Option<Species>> = LazyLock::new(|| Species::built_in(DEFAULT_SPECIES).ok());

/// The looks of a species with the artist's flowers at the time of the year, without what the plant may not bear; one without flowers has
/// the usual ones where some are drawn.
fn looks<'a>(
    species: &'a Species,
    params: &Params,
    (may_bear, has_flowers): (MayBear, bool),
) -> Cow<'a, Species> {
    let mut looks = params.flower.applied(species);
    if has_flowers
        && looks.flowers.is_empty()
        && let Some(usual) = USUAL_FLOWERS.as_ref()
    {
        looks.to_mut().take_flowers_of(usual);
    }
    // Leaves of roses are made for their season.
    if species.rose.is_none() && params.season.time != looks.season.time {
        looks.to_mut().season.time = params.season.time;
    }
    let fruits = if may_bear.fruits { params.season.fruits } else { 0.0 };
    if fruits != 1.0
        && let Some(set) = looks.to_mut().fruit.as_mut().and_then(|fruit| fruit.set.as_mut())
    {
        set.share = (set.share * fruits).min(1.0);
    }
    if looks.blossom.is_some() && !(may_bear.flowers && looks.is_in_blossom()) {
        looks.to_mut().blossom = None;
    }
    looks
}

/// The plant with cards where its parameters or so many triangles, 0 for any number, ask for them; nothing if `stop` said yes.
fn with_cards(
    plant: FinishedPlant,
    params: &Params,
    wanted: u64,
    cache: &mut cards::Cache,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<FinishedPlant> {
    if !params.cards.used && !is_small_budget(&plant, params, wanted, stop) {
        cache.clear();
        return Some(plant);
    }
    let params = CardParams { used: true, ..params.cards.clone() };
    let most = (wanted > 0).then(|| triangle_budget::of_foliage(wanted));
    cards::with_kept_cards(plant, &params, most, cache, stop)
}

/// Whether so many triangles, 0 for any number, are so few that foliage is to be cards.
fn is_small_budget(
    plant: &FinishedPlant,
    params: &Params,
    wanted: u64,
    stop: &(dyn Fn() -> bool + Sync),
) -> bool {
    let whole = || triangle_budget::count(plant, &params.model, stop);
    wanted > 0
        && params.cards.below > 0.0
        && triangle_budget::is_small(plant, whole, wanted, params.cards.below)
}

/// The remark that a model has more triangles than were asked for, 0 for any number.
fn budget_missed(model: &Model, wanted: u64) -> Option<Remark> {
    let triangles = model.triangle_count();
    let is_missed =
        wanted > 0 && triangles as u64 > wanted && !triangle_budget::is_near(triangles as u64, wanted);
    is_missed.then_some(Remark::BudgetMissed { triangles, wanted })
}

/// How fine surfaces become.
struct Fineness<'a> {
    params: Cow<'a, ModelParams>,
    /// Whether they are coarser than was asked for.
    is_coarser: bool,
}

/// As fine as asked for and of at most so many triangles; the leaves of a plant that `grew` are too many to be parts of
/// their own.
fn affordable<'a>(plant: &Plant, params: &'a ModelParams, most: u64, grew: bool) -> Fineness<'a> {
    let mut affordable = model::affordable(plant, params, most);
    let is_coarser = matches!(affordable, Cow::Owned(_));
    if grew && !affordable.blade.gathered {
        affordable.to_mut().blade.gathered = true;
    }
    Fineness { params: affordable, is_coarser }
}

#[cfg(test)]
mod tests {
    use super::super::{build, params_of};
    use super::*;
    use crate::plant::OrganKind;
    use std::path::Path;

    #[test]
    fn flowers_drawn_for_a_tree_are_no_leaves() {
        let file = format!("{}/assets/sketches/daisy.penstemon", env!("CARGO_MANIFEST_DIR"));
        let (sketch, _) = crate::sketch::read(Path::new(&file)).unwrap();
        let oak = Species::built_in("oak").unwrap();
        let params = params_of(&sketch, &oak, &[]).unwrap();
        let built = build(&sketch, &oak, &params);
        let materials = built.plant.materials();
        let petals = built.plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Petal);
        let names: Vec<&str> =
            petals.map(|petal| &*materials[built.plant.material(petal.role)].name).collect();
        assert!(names.len() > 10 && names.iter().all(|name| name.starts_with("petal")), "{names:?}");
        assert!(materials.iter().any(|material| material.name == "heart"), "and a centre");
    }
}
