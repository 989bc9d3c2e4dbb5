//! Parameters with which a plant's surfaces stay within a number of triangles.
//!
//! The triangles are counted before any is made: exactly for blades that are copies of a few, from above for the others
//! and for wood, whose rings are found where the number of its points alone says too much. While there are too many,
//! first what is finer than the defaults comes down to them step by step, then everything becomes coarser.
//!
//! Limits: what is left at the coarsest is not made less; the budgets of leaves, flowers and wood bound it.

use super::build::size_of;
use super::card;
use super::fineness::{Finenesses, SolidParams};
use super::flat::{self, BladeMeshParams, FlatScratch};
use super::params::ModelParams;
use super::spike;
use super::spine::{self, SpineScratch};
use super::tube::{self, TubeParams};
use crate::plant::{Branch, Detail, Organ, Plant, Shape, Template};
use rayon::prelude::*;
use std::borrow::Cow;

/// Share of its fineness that is left of a parameter with each step.
const STEP: f32 = 0.75;
/// Steps in which what is finer than the defaults comes down to them, and those after which nothing becomes coarser.
const TO_DEFAULTS: f32 = 8.0;
const COARSEST: f32 = 16.0;
/// Templates that are triangulated to be counted; of more each is taken for what it is at most.
const COUNTED: usize = 64;
/// Edges into which a blade's outline is divided for each of its rows, at most.
const EDGES_A_ROW: u64 = 2;

/// The parameters, or coarser ones with which the plant has at most so many triangles; borrowed where they stay.
pub fn affordable<'a>(plant: &Plant, params: &'a ModelParams, most: u64) -> Cow<'a, ModelParams> {
    let size = size_of(plant);
    let fits = |params: &ModelParams| {
        let organs = of_organs(plant, params);
        organs <= most
            && (organs + of_wood(plant, &params.tube, size, &rings_at_most) <= most
                || organs + of_wood(plant, &params.tube, size, &rings) <= most)
    };
    if fits(params) {
        return Cow::Borrowed(params);
    }
    let mut coarser = (1..COARSEST as u32).map(|step| coarsened(params, step as f32));
    Cow::Owned(coarser.find(fits).unwrap_or_else(|| coarsened(params, COARSEST)))
}

/// The parameters so many steps coarser, up to [`COARSEST`]: in the first [`TO_DEFAULTS`] no coarser than the defaults.
fn coarsened(params: &ModelParams, step: f32) -> ModelParams {
    let ModelParams { blade, tube, solid, budget } = params;
    let defaults = ModelParams::default();
    let toward = STEP.powf(step);
    let beyond = STEP.powf((step - TO_DEFAULTS).max(0.0));
    let less = |own: f32, default: f32, least: f32| {
        let usual = own.min(default);
        let less = if step < TO_DEFAULTS { (own * toward).max(usual) } else { (usual * beyond).max(least) };
        less.min(own)
    };
    let fewer =
        |own: u32, default: u32, least: u32| less(own as f32, default as f32, least as f32).ceil() as u32;
    let wider = |own: f32, default: f32, most: f32| {
        let usual = own.max(default);
        let wider = if step < TO_DEFAULTS { (own / toward).min(usual) } else { (usual / beyond).min(most) };
        wider.max(own)
    };
    let (b, t, s) = (&defaults.blade, &defaults.tube, &defaults.solid);
    ModelParams {
        blade: BladeMeshParams {
            outline_tolerance: wider(blade.outline_tolerance, b.outline_tolerance, 0.03),
            rows: fewer(blade.rows, b.rows, 0),
            columns: fewer(blade.columns, b.columns, 0),
            template_tolerance: wider(blade.template_tolerance, b.template_tolerance, 0.1),
            template_outline_points: fewer(blade.template_outline_points, b.template_outline_points, 4),
            petal_tolerance: wider(blade.petal_tolerance, b.petal_tolerance, 0.1),
            petal_outline_points: fewer(blade.petal_outline_points, b.petal_outline_points, 4),
            petal_rows: fewer(blade.petal_rows, b.petal_rows, 1),
            petal_columns: fewer(blade.petal_columns, b.petal_columns, 0),
            template_rows: fewer(blade.template_rows, b.template_rows, 0),
            template_columns: fewer(blade.template_columns, b.template_columns, 0),
            ..blade.clone()
        },
        tube: TubeParams {
            quality: less(tube.quality, t.quality, 0.25),
            sides: fewer(tube.sides, t.sides, 3),
            fewest_sides: fewer(tube.fewest_sides, t.fewest_sides, 3),
            most_sides: fewer(tube.most_sides, t.most_sides, 3),
            tolerance: wider(tube.tolerance, t.tolerance, 1.0),
            ..tube.clone()
        },
        solid: SolidParams {
            sides: fewer(solid.sides, s.sides, 3),
            dome_rows: fewer(solid.dome_rows, s.dome_rows, 1),
            filament_sides: fewer(solid.filament_sides, s.filament_sides, 3),
            head_sides: fewer(solid.head_sides, s.head_sides, 3),
            head_rows: fewer(solid.head_rows, s.head_rows, 2),
        },
        budget: budget.clone(),
    }
}

/// The parameters on the way from what they are, 0, to the coarsest, 1; what is finer than the defaults comes down to them at once.
pub fn coarser(params: &ModelParams, share: f32) -> Cow<'_, ModelParams> {
    if share <= 0.0 {
        return Cow::Borrowed(params);
    }
    Cow::Owned(coarsened(params, TO_DEFAULTS + share * (COARSEST - TO_DEFAULTS)))
}

/// The same for petals, for leaves and drawn blades, for wood and for solids, each with a share of its own.
pub fn coarser_each(params: &ModelParams, shares: [f32; 4]) -> ModelParams {
    let [petals, leaves, wood, solids] = shares.map(|share| coarser(params, share).into_owned());
    let (of_petals, of_leaves) = (petals.blade, leaves.blade);
    ModelParams {
        blade: BladeMeshParams {
            petal_tolerance: of_petals.petal_tolerance,
            petal_outline_points: of_petals.petal_outline_points,
            petal_rows: of_petals.petal_rows,
            petal_columns: of_petals.petal_columns,
            ..of_leaves
        },
        tube: wood.tube,
        solid: solids.solid,
        budget: leaves.budget,
    }
}

/// The parameters with so many times the rows, columns and sides of blades, wood and solids, as far as their ranges go.
pub fn refined(params: &ModelParams, [of_blades, of_wood, of_solids]: [f32; 3]) -> ModelParams {
    let ModelParams { blade, tube, solid, budget } = params;
    let times =
        |by: f32| move |own: u32, most: u32| ((own.max(1) as f32 * by).round() as u32).min(most).max(own);
    let closer = |own: f32, least: f32| (own / (of_blades * of_blades)).max(least).min(own);
    let (more, more_sides, more_of_solids) = (times(of_blades), times(of_wood), times(of_solids));
    ModelParams {
        blade: BladeMeshParams {
            outline_tolerance: closer(blade.outline_tolerance, 0.0001),
            rows: more(blade.rows, 64),
            columns: more(blade.columns, 32),
            template_tolerance: closer(blade.template_tolerance, 0.0001),
            template_outline_points: more(blade.template_outline_points, 200),
            template_rows: more(blade.template_rows, 64),
            petal_tolerance: closer(blade.petal_tolerance, 0.0001),
            petal_outline_points: more(blade.petal_outline_points, 400),
            petal_rows: more(blade.petal_rows, 64),
            petal_columns: more(blade.petal_columns, 32),
            ..blade.clone()
        },
        tube: TubeParams {
            quality: (tube.quality * of_wood).min(4.0).max(tube.quality),
            sides: more_sides(tube.sides, 64),
            fewest_sides: more_sides(tube.fewest_sides, 64),
            most_sides: more_sides(tube.most_sides, 64),
            ..tube.clone()
        },
        solid: SolidParams {
            sides: more_of_solids(solid.sides, 128),
            dome_rows: more_of_solids(solid.dome_rows, 64),
            filament_sides: more_of_solids(solid.filament_sides, 16),
            head_sides: more_of_solids(solid.head_sides, 32),
            head_rows: more_of_solids(solid.head_rows, 32),
        },
        budget: budget.clone(),
    }
}

/// How a branch's rings are counted.
type Rings = dyn Fn(&Branch, spine::Detail, &mut SpineScratch) -> usize + Sync;

fn rings_at_most(branch: &Branch, _: spine::Detail, _: &mut SpineScratch) -> usize {
    branch.points.len()
}

fn rings(branch: &Branch, detail: spine::Detail, scratch: &mut SpineScratch) -> usize {
    let mut rings = Vec::new();
    let skeleton = branch.points.iter().copied().zip(branch.radii.iter().copied());
    spine::rings(skeleton, detail, scratch, &mut rings);
    rings.len()
}

fn of_wood(plant: &Plant, params: &TubeParams, size: f32, rings: &Rings) -> u64 {
    let of_branch = |scratch: &mut SpineScratch, branch: &Branch| {
        let look = tube::look(branch, params, size);
        let rings = rings(branch, look.detail, scratch) as u64;
        // A branch's foot is joined by a strip and some rings of its parent.
        2 * u64::from(look.sides) * (rings + 3)
    };
    plant.branches.par_iter().with_min_len(256).map_init(SpineScratch::default, of_branch).sum()
}

fn of_organs(plant: &Plant, params: &ModelParams) -> u64 {
    let counted = counted_templates(plant, &params.blade);
    let solid = &params.solid;
    let finenesses = Finenesses::of(plant);
    let sides = |organ: &Organ| u64::from(finenesses.at(organ).sides(solid));
    let rows = |organ: &Organ| u64::from(finenesses.at(organ).dome_rows(solid));
    let of_organ = |organ: &Organ| match &organ.shape {
        Shape::Blade(blade) => {
            let counted = counted[blade.template.index()];
            counted.unwrap_or_else(|| blade_at_most(&plant.templates[blade.template], &params.blade))
        }
        Shape::Dome { .. } => 2 * sides(organ) * (rows(organ) + 1),
        Shape::Card { .. } => card::TRIANGLES,
        Shape::Spike { .. } => spike::TRIANGLES,
        Shape::Lathe { profile, .. } => 2 * sides(organ) * profile.len() as u64,
        Shape::Filament { points, head, .. } => {
            let [around, along] = finenesses.at(organ).head(solid).map(u64::from);
            let head = if head.x > 0.0 { around * along } else { 0 };
            2 * (u64::from(solid.filament_sides) * (points.len() as u64 + 1) + head)
        }
    };
    plant.organs.par_iter().with_min_len(1024).map(of_organ).sum()
}

/// The triangles of a blade of each template of reduced detail, where those are few.
fn counted_templates(plant: &Plant, params: &BladeMeshParams) -> Vec<Option<u64>> {
    let is_reduced = |template: &Template| template.detail() == Detail::Reduced;
    if plant.templates.iter().filter(|template| is_reduced(template)).count() > COUNTED {
        return vec![None; plant.templates.len()];
    }
    let mut scratch = FlatScratch::default();
    let mut count = |template: &Template| {
        let flat = flat::flatten(template, None, params, &mut scratch);
        flat.map_or(0, |flat| flat.triangle_count() as u64)
    };
    plant.templates.iter().map(|template| is_reduced(template).then(|| count(template))).collect()
}

/// Triangles of both faces and the rim of a blade with so many points at the margin and inside.
fn both_sides(margin: u64, inside: u64) -> u64 {
    4 * (margin + inside)
}

fn blade_at_most(template: &Template, params: &BladeMeshParams) -> u64 {
    let drawn = template.outline().len() as u64;
    let (points, rows, columns) = match template.detail() {
        Detail::Reduced => {
            let most = u64::from(params.template_outline_points);
            (drawn.min(most), params.template_rows, params.template_columns)
        }
        Detail::Moderate => {
            let most = u64::from(params.petal_outline_points);
            (drawn.min(most), params.petal_rows, params.petal_columns)
        }
        Detail::Full => (drawn, params.rows, params.columns),
    };
    let rows = u64::from(rows);
    let (margin, inside) = (points + EDGES_A_ROW * (rows + 1), rows * (2 * u64::from(columns) + 1));
    // Without a rim every edge inside that joins two points of the margin is divided: fewer edges than there are points.
    let divided = if flat::may_be_sharp(template, params) { margin } else { 0 };
    both_sides(margin, inside + divided)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::{Limits, PlantAtAge, Simulation, plant_at};
    use crate::model::build;
    use crate::plant::{FinishedPlant, Provenance};
    use crate::species::{self, Species};

    fn cherry(age: u16) -> FinishedPlant {
        let species = Species::built_in("cherry").unwrap();
        let mut simulation = Simulation::new(species.growth.as_ref().unwrap(), 1, Limits::default());
        simulation.grow_to(age, &|| false);
        let PlantAtAge { plant, buds } = plant_at(&simulation, f32::from(age));
        species::apply(plant, &buds, &Provenance::default(), &species, 1).plant
    }

    /// The finest that may be asked for.
    fn finest() -> ModelParams {
        let mut params = ModelParams::default();
        (params.blade.rows, params.blade.columns, params.blade.outline_tolerance) = (64, 32, 0.0001);
        (params.blade.template_rows, params.blade.template_columns) = (64, 32);
        (params.blade.template_outline_points, params.blade.template_tolerance) = (200, 0.0001);
        (params.tube.quality, params.tube.sides, params.tube.fewest_sides) = (4.0, 64, 64);
        (params.solid.sides, params.solid.dome_rows, params.solid.filament_sides) = (128, 64, 16);
        (params.solid.head_sides, params.solid.head_rows) = (32, 32);
        params
    }

    fn defaults() -> ModelParams {
        ModelParams::default()
    }

    #[test]
    fn a_plant_has_no_more_triangles_than_it_may() {
        let plant = cherry(8);
        assert!(matches!(affordable(&plant, &defaults(), 10_000_000), Cow::Borrowed(_)));
        let whole = build(&plant, &defaults()).triangle_count() as u64;
        for (params, most) in [(finest(), 8 * whole), (finest(), whole), (defaults(), whole * 3 / 4)] {
            let coarser = affordable(&plant, &params, most);
            assert!(matches!(coarser, Cow::Owned(_)));
            let count = build(&plant, &coarser).triangle_count() as u64;
            // As the defaults say where one step finer is too much.
            assert!(count <= most && count >= most / 8, "{count} triangles of {most}");
        }
    }

    #[test]
    fn what_is_coarser_already_stays() {
        let mut params = ModelParams::default();
        (params.tube.quality, params.solid.sides, params.blade.rows) = (0.5, 3, 1);
        assert_eq!(coarsened(&params, TO_DEFAULTS), params);
        let coarser = coarsened(&params, COARSEST);
        assert_eq!((coarser.tube.quality, coarser.solid.sides, coarser.blade.rows), (0.25, 3, 1));
        let finer = coarsened(&finest(), TO_DEFAULTS);
        assert_eq!((finer.solid, finer.blade.rows), (defaults().solid, 5));
    }
}
