//! A plant of as many triangles as were asked for, give or take three of a hundred.
//!
//! Fewer are asked for: a plant without much foliage becomes coarser. Foliage is leaves and flowers that nobody drew. A plant with
//! leaves and small flowers, as a tree, gives wood two fifths of the triangles, or what foliage leaves of them: it becomes coarser,
//! and if that is not enough its thinnest twigs go. Foliage has the rest: leaves and petals get fewer corners, flowers lose their
//! stamens and most of their discs' sides, then some of both go, evenly over the crown, and those that stay are larger, so that they
//! cover about what all did.
//!
//! A plant with large flowers, as a rose, first has coarser flowers, then coarser leaves and wood. Then whole flowers go, and with
//! them the same share of leaves; leaves fill up what a flower more would be too much for. One flower always stays, and so does its
//! stem; other twigs go last. More are asked for: everything becomes finer.
//!
//! Before anything else fruits go until those that stay have no more than their share or what the rest leaves over, and then, of a
//! plant with cards, thorns.
//!
//! How many triangles there are is counted on models, of which one or two dozen are built, so the number is exact.
//!
//! Limits: all these builds come again with every sample where a drawing has such a number in the window, though a newer drawing
//! ends them. Leaves of a tree's twigs that went stay where they were. Drawn parts never go, nor does a single flower lose any: a
//! plant of many has more than it should, as a daisy at its coarsest; flowers of umbels, as of a dandelion, go one by one. A plant
//! at its finest may have fewer, as one with cards for foliage. The plant's list of flowers keeps those that went.

use super::thinning::{Foliage, OnTwigs, thinned, with_fruits, with_thorns, without_stamens, without_twigs};
use crate::cards;
use crate::geom::simple_loop::{area, hull_area};
use crate::model::{self, ModelParams};
use crate::plant::{Detail, FinishedPlant, Organ, OrganKind, Shape, Template};

/// Share of the triangles that fruits may have.
const FRUITS: f32 = 0.15;
/// Times that their number is found at most.
const FRUIT_ROUNDS: usize = 4;
/// Accepted difference, share of the triangles asked for.
const NEAR: f32 = 0.03;
/// Foliage has its own share of the triangles from so many pieces on.
const FOLIAGE: usize = 50;
/// Share of wood among the triangles of a plant with foliage.
const WOOD: f32 = 0.4;
/// The largest such share, or what is left when foliage that is few triangles, as cards, loses this share of them.
const MOST_WOOD: f32 = 0.8;
const LOST: f32 = 0.15;
/// Corners of leaves and petals of which less than such a share would stay with more.
const FEWER_CORNERS: (f32, u32) = (0.5, 6);
/// Sides and rows of the discs of flowers where foliage has few corners.
const SIMPLE_DISC: (u32, u32) = (10, 1);
/// Leaves that fill less than this share of their convex hull, as sprays of needles do, keep their corners.
const SPIKY: f32 = 0.6;
/// How much finer a plant becomes at most.
const FINEST: f32 = 16.0;
/// Halvings of an interval that is searched.
const HALVINGS: u32 = 7;

/// Whether a plant may become finer than its parameters say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Finer {
    May,
    Never,
}

/// The plant and the parameters with which its model has about so many triangles. Once `stop` says yes they are of no use, and come
/// soon.
pub(super) fn fit(
    plant: FinishedPlant,
    params: &ModelParams,
    (wanted, finer): (u64, Finer),
    stop: &(dyn Fn() -> bool + Sync),
) -> (FinishedPlant, ModelParams) {
    let budget = Budget { wanted, stop };
    let now = budget.count(&plant, params);
    if budget.is_met(now) || (now < wanted && finer == Finer::Never) {
        return (plant, params.clone());
    }
    if now < wanted {
        let finer = |by: [f32; 3]| model::refined(params, by.map(|by| FINEST.powf(by)));
        let by = largest_each(|by| budget.has_room(&plant, &finer(by)), |_| false);
        return (plant, finer(by));
    }
    let (plant, now) = with_few_fruits(plant, params, now, &budget);
    let (plant, now) = match cards::are_in(&plant) {
        true => {
            let plant = with_few_thorns(plant, params, &budget);
            let now = budget.count(&plant, params);
            (plant, now)
        }
        false => (plant, now),
    };
    if now <= wanted || budget.is_met(now) {
        return (plant, params.clone());
    }
    let foliage = Foliage::of(&plant);
    let is_leafy = foliage.leaves + foliage.flowers >= FOLIAGE;
    if (is_leafy || foliage.flowers > 1) && are_large(&plant, &foliage) {
        return with_flowers(plant, params, &budget);
    }
    if !is_leafy {
        let params = coarse(&plant, params, &budget);
        return (plant, params);
    }
    with_foliage(plant, params, now, &budget)
}

/// The parameters with which a plant has at most about so many triangles without losing anything: as coarse as it takes, so that one
/// which is too many at its coarsest keeps more.
pub fn coarsened(plant: &FinishedPlant, params: &ModelParams, wanted: u64) -> ModelParams {
    let budget = Budget { wanted, stop: &|| false };
    if budget.count(plant, params) <= wanted {
        return params.clone();
    }
    if has_large_flowers(plant) {
        flowers_coarser(params, 1.0 - finest_flowers(plant, params, &budget))
    } else {
        coarse(plant, params, &budget)
    }
}

/// The parameters that are coarser until a plant fits, each of them as fine as the others let it.
fn coarse(plant: &FinishedPlant, params: &ModelParams, budget: &Budget<'_>) -> ModelParams {
    let coarser = |fine: [f32; 4]| model::coarser_each(params, fine.map(|fine| 1.0 - fine));
    let is_near = |fine| budget.is_met(budget.count(plant, &coarser(fine)));
    coarser(largest_each(|fine| budget.has_room(plant, &coarser(fine)), is_near))
}

/// How many of so many triangles are for foliage.
pub(super) fn of_foliage(wanted: u64) -> u64 {
    ((1.0 - WOOD) * wanted as f32) as u64
}

/// How many triangles are asked for.
struct Budget<'a> {
    wanted: u64,
    /// Whether to give up.
    stop: &'a (dyn Fn() -> bool + Sync),
}

impl Budget<'_> {
    fn count(&self, plant: &FinishedPlant, params: &ModelParams) -> u64 {
        count(plant, params, self.stop)
    }

    fn has_room(&self, plant: &FinishedPlant, params: &ModelParams) -> bool {
        self.count(plant, params) <= (self.wanted as f32 * (1.0 + NEAR)) as u64
    }

    fn is_met(&self, count: u64) -> bool {
        is_near(count, self.wanted)
    }
}

/// Triangles of a plant's model; 0 once `stop` says yes.
pub(super) fn count(plant: &FinishedPlant, params: &ModelParams, stop: &(dyn Fn() -> bool + Sync)) -> u64 {
    let model = model::rebuild(plant, params, &mut model::Cache::for_one_build(), stop);
    model.map_or(0, |model| model.triangle_count() as u64)
}

/// Whether a number of triangles is as good as the one that was asked for.
pub(super) fn is_near(count: u64, wanted: u64) -> bool {
    (count as f32 / wanted as f32 - 1.0).abs() <= NEAR
}

/// The largest number from 0 to 1 that fits, where smaller ones fit as well; 0 if none does.
fn largest(fits: impl Fn(f32) -> bool) -> f32 {
    if fits(1.0) {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if fits(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// The same for several numbers: first for all of them together, then, while that is not `enough`, for each as far as the others
/// let it.
fn largest_each<const N: usize>(
    fits: impl Fn([f32; N]) -> bool,
    enough: impl Fn([f32; N]) -> bool,
) -> [f32; N] {
    let mut all = [largest(|same| fits([same; N])); N];
    for k in 0..N {
        if enough(all) {
            break;
        }
        let with = |more: f32| {
            let mut with = all;
            with[k] += (1.0 - with[k]) * more;
            with
        };
        all = with(largest(|more| fits(with(more))));
    }
    all
}

/// The plant with as many of the fruits that nobody drew as have room in their share of the triangles, and its triangles; `now` are
/// those of the whole.
fn with_few_fruits(
    plant: FinishedPlant,
    params: &ModelParams,
    now: u64,
    budget: &Budget<'_>,
) -> (FinishedPlant, u64) {
    if plant.organs.iter().all(|organ| organ.kind() != OrganKind::Fruit) {
        return (plant, now);
    }
    let others = budget.count(&with_fruits(&plant, 0.0), params);
    // What the rest of the plant leaves over is theirs, too.
    let room = (FRUITS * budget.wanted as f32).max(budget.wanted.saturating_sub(others) as f32);
    let mut share = room / now.saturating_sub(others).max(1) as f32;
    if share >= 1.0 {
        return (plant, now);
    }
    // Of few each is finer than of many.
    for _ in 1..FRUIT_ROUNDS {
        let now = budget.count(&with_fruits(&plant, share), params);
        let theirs = now.saturating_sub(others) as f32;
        if theirs <= room {
            break;
        }
        share *= room / theirs;
    }
    let plant = with_fruits(&plant, share);
    let now = budget.count(&plant, params);
    (plant, now)
}

/// The plant with as many of its thorns as there is room for.
fn with_few_thorns(plant: FinishedPlant, params: &ModelParams, budget: &Budget<'_>) -> FinishedPlant {
    if plant.organs.iter().all(|organ| organ.kind() != OrganKind::Thorn) {
        return plant;
    }
    let share = largest(|share| budget.count(&with_thorns(&plant, share), params) <= budget.wanted);
    with_thorns(&plant, share)
}

/// Whether so many triangles are below this share of the `whole` plant's own, so that single leaves would be lost among its wood. Roses
/// and other large flowers rather become coarser.
pub(super) fn is_small(plant: &FinishedPlant, whole: impl FnOnce() -> u64, wanted: u64, below: f32) -> bool {
    !has_large_flowers(plant) && (wanted as f32) < below * whole() as f32
}

/// Whether a plant has flowers that are more than a few triangles each.
pub(super) fn has_large_flowers(plant: &FinishedPlant) -> bool {
    are_large(plant, &Foliage::of(plant))
}

fn are_large(plant: &FinishedPlant, foliage: &Foliage) -> bool {
    let is_large = |organ: &Organ| match &organ.shape {
        Shape::Blade(blade) if organ.kind() == OrganKind::Petal => {
            plant.templates[blade.template].detail() == Detail::Moderate
        }
        _ => false,
    };
    foliage.of_flowers(plant).any(is_large)
}

/// A plant with large flowers.
fn with_flowers(
    plant: FinishedPlant,
    params: &ModelParams,
    budget: &Budget<'_>,
) -> (FinishedPlant, ModelParams) {
    let fine = finest_flowers(&plant, params, budget);
    let coarse = flowers_coarser(params, 1.0 - fine);
    let now = budget.count(&plant, &coarse);
    if budget.is_met(now) {
        return (plant, coarse);
    }
    if now > budget.wanted {
        return (with_fewer_flowers(&plant, &coarse, budget), coarse);
    }
    // Flowers become finer in steps: rather the step above, with fewer leaves, than too little of all.
    let above = flowers_coarser(params, (1.0 - fine - 0.5f32.powi(HALVINGS as i32)).max(0.0));
    let fewer = with_leaves_that_fit(&plant, &above, budget);
    if budget.is_met(budget.count(&fewer, &above)) { (fewer, above) } else { (plant, coarse) }
}

/// How far from its coarsest, 0, to its finest, 1, a plant with large flowers has room.
fn finest_flowers(plant: &FinishedPlant, params: &ModelParams, budget: &Budget<'_>) -> f32 {
    largest(|fine| budget.has_room(plant, &flowers_coarser(params, 1.0 - fine)))
}

/// Parameters so far on the way from fine, 0, to coarse, 1: flowers come to their coarsest in the first half of it, all else in the
/// second.
fn flowers_coarser(params: &ModelParams, way: f32) -> ModelParams {
    let (flowers, rest) = ((2.0 * way).min(1.0), (2.0 * way - 1.0).max(0.0));
    let mut coarser = model::coarser_each(params, [flowers, rest, rest, flowers]);
    let corners = &mut coarser.blade.template_outline_points;
    *corners = (*corners).max(FEWER_CORNERS.1.min(params.blade.template_outline_points));
    coarser
}

/// The plant with as many of its flowers and leaves as there is room for: one flower at least. Only then twigs go.
fn with_fewer_flowers(plant: &FinishedPlant, params: &ModelParams, budget: &Budget<'_>) -> FinishedPlant {
    let fits = |plant: &FinishedPlant| budget.count(plant, params) <= budget.wanted;
    let share = largest(|share| fits(&thinned(plant, [share; 2])));
    let plant = thinned(plant, [1.0, share.max(f32::MIN_POSITIVE)]);
    let bare = thinned(&plant, [0.0, 1.0]);
    let twigs = largest(|share| fits(&without_twigs(&bare, share, OnTwigs::Goes)));
    with_leaves_that_fit(&without_twigs(&plant, twigs, OnTwigs::Goes), params, budget)
}

/// The plant with as many of its leaves as there is room for.
fn with_leaves_that_fit(plant: &FinishedPlant, params: &ModelParams, budget: &Budget<'_>) -> FinishedPlant {
    let with = |leaves: f32| thinned(plant, [leaves, 1.0]);
    with(largest(|leaves| budget.count(&with(leaves), params) <= budget.wanted))
}

/// A plant with leaves or small flowers.
fn with_foliage(
    mut plant: FinishedPlant,
    params: &ModelParams,
    now: u64,
    budget: &Budget<'_>,
) -> (FinishedPlant, ModelParams) {
    let bare = thinned(&plant, [0.0; 2]);
    let (wanted, of_foliage) = (budget.wanted, now.saturating_sub(budget.count(&bare, params)));
    let for_wood = ((WOOD * wanted as f32) as u64).max(wanted.saturating_sub(of_foliage));
    let wood = |share: f32| model::coarser(params, 1.0 - share);
    let share = largest(|share| budget.count(&bare, &wood(share)) <= for_wood);
    // Wood becomes finer in steps: rather the step above, with less foliage, than too little of all.
    let above = (share + 0.5f32.powi(HALVINGS as i32)).min(1.0);
    let most_wood = (MOST_WOOD * wanted as f32).max(wanted as f32 - (1.0 - LOST) * of_foliage as f32);
    let is_room = share > 0.0 && budget.count(&bare, &wood(above)) as f32 <= most_wood;
    // Foliage as fine as it was while there is room for enough of it.
    let coarser = wood(if is_room { above } else { share }).into_owned();
    let mut params = ModelParams { blade: params.blade.clone(), ..coarser };
    if share == 0.0 {
        let twigs =
            largest(|share| budget.count(&without_twigs(&bare, share, OnTwigs::Stays), &params) <= for_wood);
        plant = without_twigs(&plant, twigs, OnTwigs::Stays);
    }
    let of_wood = budget.count(&thinned(&plant, [0.0; 2]), &params);
    let rest = wanted.saturating_sub(of_wood);
    let stays = |plant: &FinishedPlant, params: &ModelParams| {
        let all = budget.count(plant, params).saturating_sub(of_wood).max(1);
        (rest as f32 / all as f32).min(1.0)
    };
    let mut share = stays(&plant, &params);
    if share < FEWER_CORNERS.0 {
        plant = without_stamens(&plant);
        simplify(&mut params, &plant);
        share = stays(&plant, &params);
    }
    (kept(&plant, &params, (share, of_wood), budget), params)
}

/// Fewer corners of leaves and petals that are copies, fewer sides and rows of the discs of flowers.
fn simplify(params: &mut ModelParams, plant: &FinishedPlant) {
    let (corners, (sides, rows)) = (&mut params.blade.template_outline_points, SIMPLE_DISC);
    if !plant.templates.iter().any(is_spiky) {
        *corners = (*corners).min(FEWER_CORNERS.1);
    }
    (params.solid.sides, params.solid.dome_rows) =
        (params.solid.sides.min(sides), params.solid.dome_rows.min(rows));
}

/// Whether many copies of this outline would be something else with fewer corners.
fn is_spiky(template: &Template) -> bool {
    let outline = template.outline();
    template.detail() == Detail::Reduced && area(outline) < SPIKY * hull_area(outline)
}

/// The plant with about such a share of its foliage, corrected until it has the triangles that are wanted; `bare` are those
/// without foliage.
fn kept(
    plant: &FinishedPlant,
    params: &ModelParams,
    (mut share, bare): (f32, u64),
    budget: &Budget<'_>,
) -> FinishedPlant {
    const CORRECTIONS: u32 = 4;
    let wanted = budget.wanted;
    let mut best = thinned(plant, [share; 2]);
    for _ in 0..CORRECTIONS {
        let now = budget.count(&best, params);
        if budget.is_met(now) || (share >= 1.0 && now < wanted) || now <= bare || wanted <= bare {
            break;
        }
        share = (share * (wanted - bare) as f32 / (now - bare) as f32).min(1.0);
        best = thinned(plant, [share; 2]);
    }
    best
}

#[cfg(test)]
mod tests {
    use super::super::{Bloom, Seed, build, params_of_species};
    use super::*;
    use crate::sketch::Remark;
    use crate::species::Species;

    fn grown(species: &str, age: f32, triangles: u32) -> crate::pipeline::Built {
        let species = Species::built_in(species).unwrap();
        let set = [format!("model.budget.triangles={triangles}")];
        let params = params_of_species(&species, &set).unwrap();
        build(&Seed { number: 1, age: Some(age), ..Seed::default() }, &species, &params)
    }

    #[test]
    fn trees_have_the_triangles_that_are_asked_for() {
        for (species, age, wanted) in [
            ("apple", 8.0, 30_000),
            ("apple", 12.0, 20_000),
            ("spruce", 8.0, 40_000),
            ("spruce", 8.0, 12_000),
            ("oak", 12.0, 9_000),
        ] {
            let built = grown(species, age, wanted);
            let count = built.model.triangle_count() as u64;
            assert!(
                is_near(count, u64::from(wanted)),
                "{species} of {age} years: {count} triangles of {wanted}"
            );
            assert_eq!(built.plant.check_invariants(), Ok(()));
        }
    }

    /// Area that the organs of a kind cover, m².
    fn covered(built: &crate::pipeline::Built, kind: OrganKind) -> f32 {
        let of = |organ: &Organ| match &organ.shape {
            Shape::Blade(blade) if organ.kind() == kind => {
                blade.u.cross(blade.v).length() * area(built.plant.templates[blade.template].outline())
            }
            _ => 0.0,
        };
        built.plant.organs.iter().map(of).sum()
    }

    #[test]
    fn a_tree_in_blossom_stays_one_with_few_triangles() {
        let whole = grown("cherry", 12.0, 0);
        let triangles = whole.model.triangle_count() as u32;
        for share in [2, 4] {
            let fewer = grown("cherry", 12.0, triangles / share);
            for kind in [OrganKind::Petal, OrganKind::Leaf] {
                let left = covered(&fewer, kind) / covered(&whole, kind);
                assert!((0.8..1.25).contains(&left), "{left} of {kind:?} at 1/{share} of the triangles");
            }
            assert_eq!(fewer.plant.check_invariants(), Ok(()));
        }
    }

    #[test]
    fn a_plant_without_foliage_becomes_coarser_or_finer() {
        let mut bare = Species::built_in("hazel").unwrap();
        let growth = bare.growth.as_mut().unwrap();
        (growth.leaf.per_internode, growth.leaf.at_tip) = (0, 0);
        let with = |triangles: u32| {
            let params = params_of_species(&bare, &[format!("model.budget.triangles={triangles}")]).unwrap();
            build(&Seed { number: 1, age: Some(4.0), ..Seed::default() }, &bare, &params)
        };
        let whole = with(0).model.triangle_count() as u32;
        for wanted in [whole * 3 / 4, whole * 2] {
            let count = with(wanted).model.triangle_count() as f32 / wanted as f32;
            assert!((0.85..=1.03).contains(&count), "{count} of {wanted}");
        }
    }

    #[test]
    fn a_flower_stays_whole() {
        let bloom = |triangles: u32| {
            let species = Species::built_in("peony").unwrap();
            let set = [format!("model.budget.triangles={triangles}")];
            let params = params_of_species(&species, &set).unwrap();
            build(&Bloom { number: 1 }, &species, &params)
        };
        let (whole, fewer) = (bloom(0), bloom(9_000));
        assert_eq!(fewer.plant.organs.len(), whole.plant.organs.len());
        assert!(fewer.model.triangle_count() < whole.model.triangle_count());
    }

    /// How many petals there are.
    fn petals(built: &crate::pipeline::Built) -> usize {
        built.plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Petal).count()
    }

    #[test]
    fn a_rose_keeps_whole_flowers_and_its_wood() {
        let rose = |triangles: u32| {
            let species = Species::built_in("rose").unwrap();
            let set = [format!("model.budget.triangles={triangles}")];
            let params = params_of_species(&species, &set).unwrap();
            build(&Seed { number: 1, ..Seed::default() }, &species, &params)
        };
        let whole = rose(0);
        let of_flower = petals(&whole) / whole.plant.flowers.len();
        for (wanted, flowers) in [(30_000, 8), (20_000, 8), (12_000, 4), (5_000, 1)] {
            let built = rose(wanted);
            let (count, petals) = (built.model.triangle_count() as u64, petals(&built));
            assert!(is_near(count, u64::from(wanted)), "{count} triangles of {wanted}");
            assert!(petals >= flowers * of_flower && petals % of_flower == 0, "{petals} petals at {wanted}");
            assert_eq!(built.plant.branches.len(), whole.plant.branches.len());
            assert_eq!(built.plant.check_invariants(), Ok(()));
        }
        let least = rose(1_000);
        let says = |built: &crate::pipeline::Built| {
            built.remarks.iter().any(|said| matches!(said.remark, Remark::BudgetMissed { wanted: 1_000, .. }))
        };
        assert!(says(&least) && !says(&whole), "{} triangles", least.model.triangle_count());
        assert_eq!(petals(&least), of_flower);
        assert!(!least.plant.branches.is_empty());
        assert_eq!(least.plant.check_invariants(), Ok(()));
    }

    #[test]
    fn a_flower_head_stays_whole() {
        let daisy = |triangles: u32| {
            let species = Species::built_in("daisy").unwrap();
            let set = [format!("model.budget.triangles={triangles}")];
            build(&Bloom { number: 1 }, &species, &params_of_species(&species, &set).unwrap())
        };
        let (whole, fewer) = (daisy(0), daisy(4_000));
        assert_eq!(fewer.plant.organs.len(), whole.plant.organs.len());
        assert_eq!(fewer.plant.branches.len(), whole.plant.branches.len());
        assert!(fewer.model.triangle_count() < whole.model.triangle_count() / 3);
    }

    #[test]
    fn what_stood_on_twigs_that_are_gone_stands_on_what_is_left() {
        let plant = grown("apple", 8.0, 0).plant;
        let fewer = without_twigs(&plant, 0.3, OnTwigs::Stays);
        assert!(fewer.branches.len() < plant.branches.len() / 2 && fewer.organs.len() == plant.organs.len());
        assert_eq!(fewer.check_invariants(), Ok(()));
    }
}
