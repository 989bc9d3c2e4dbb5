//! The maker of drawn plants: strokes are understood, stood up in space, and grow on where they may.

use super::bare_stems;
use super::clock::Clock;
use super::setup::Params;
use super::source::Produced;
use super::{brushing, growing, placing, proposed_species};
use crate::anatomy::conventions::{ConventionParams, Habit};
use crate::anatomy::{self, Anatomy};
use crate::depth::{self, Given};
use crate::growth::overlay::{Spot, Wanted};
use crate::growth::{KeptObstacles, Memory, PlantAtAge, brush};
use crate::learned_depth;
use crate::modelling::{self, DrawnWood, PartNames};
use crate::plant::{Branch, Continued, Plant, Provenance};
use crate::sketch::{PartPose, Sketch, Warning};
use crate::species::Species;
use glam::Vec3;

/// What is kept of a drawing from one build to the next.
#[derive(Debug, Default)]
pub struct DrawingMemory {
    anatomy: anatomy::Cache,
    learned: learned_depth::Memory,
    depth: depth::Cache,
    modelling: modelling::Cache,
    growth: Memory,
    brushes: brush::Memory,
    obstacles: KeptObstacles,
}

impl DrawingMemory {
    /// For a single build, of which nothing is kept.
    pub(super) fn for_one_build() -> Self {
        let (anatomy, depth) = (anatomy::Cache::for_one_build(), depth::Cache::for_one_build());
        Self { anatomy, depth, modelling: modelling::Cache::for_one_build(), ..Self::default() }
    }

    /// What kind of plant a drawing shows.
    pub(super) fn habit(&mut self, sketch: &Sketch, params: &ConventionParams) -> Option<Habit> {
        self.anatomy.habit(sketch, params)
    }

    /// What growth looks like from inside, at an age that the plant has lived through.
    pub(super) fn overlay(&self, age: f32, wanted: Wanted) -> Vec<Spot> {
        self.growth.overlay(age, wanted)
    }
}

/// Makes the plant of a drawing; nothing if `stop` said yes.
pub(super) fn produce(
    memory: &mut DrawingMemory,
    sketch: &Sketch,
    (species, params): (&Species, &Params),
    clock: &mut Clock,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Produced> {
    let mut anatomy = clock
        .time("anatomy", || anatomy::analyse_with(&mut memory.anatomy, sketch, &params.anatomy, stop))?;
    let mut remarks = std::mem::take(&mut anatomy.warnings);
    remarks.extend(growing::fineness_unused(&anatomy, species, params));
    let field = clock.time("learned depth", || {
        let (learned, trunk) = (&params.depth.learned, params.depth.world.trunk);
        depth::learned::field_of(&mut memory.learned, &anatomy, Some(&species.name), trunk, learned)
    });
    let (mut plant, mut provenance) = clock.time("depth", || {
        let given = Given { seed: sketch.seed, petal_shapes: &sketch.petal_shapes, field: field.as_deref() };
        depth::recover_with(&mut memory.depth, &anatomy, given, &params.depth)
    });
    // What of them finds its part is taken out.
    let mut poses = sketch.part_poses.to_vec();
    let mut wood = clock.time("modelling", || {
        let drawn = (&anatomy, &mut plant, &mut provenance);
        modelled(&mut memory.modelling, sketch, drawn, (params, &mut poses), &mut remarks)
    });
    if stop() {
        return None;
    }
    remarks.extend(proposed_species::proposal(sketch, &anatomy, &plant));
    let obstacles = memory.obstacles.beside(&params.obstacle, foot(&plant.branches));
    let has_brushes = sketch.brush_strokes().next().is_some();
    let grows = growing::grows(&anatomy, species, params);
    if grows || has_brushes {
        wood.before_growth = Some(plant.branches.clone());
    }
    let (names, scale) = (PartNames::new(&provenance), provenance.world_from_canvas.scale);
    let (mut made, growth, continued) = if grows {
        let grown = clock.time("growth", || {
            growing::grow_on(
                &mut memory.growth,
                (plant, &provenance),
                (&anatomy, field.as_ref()),
                (species, params),
                (sketch, obstacles.clone()),
                &mut remarks,
                stop,
            )
        });
        let growing::GrownDrawing { made, ages, continued } = grown?;
        (made, Some(ages), continued)
    } else {
        memory.growth.clear();
        remarks.extend(brushing::lights_nothing(sketch));
        let buds = bare_stems::furnish((&mut plant, &provenance), (species, params), sketch.seed);
        (PlantAtAge { plant, buds }, None, Vec::new())
    };
    let mut pose_grown = |made: &mut PlantAtAge, continued: &[Continued]| {
        let (of, by) = ((&mut made.plant, &mut made.buds), (&names, &mut poses, scale));
        modelling::pose_grown_wood(of, continued, by, &mut wood.posed);
    };
    pose_grown(&mut made, &continued);
    if has_brushes {
        let habit = memory.growth.habit().cloned();
        let (provenance, obstacles) = (&provenance, obstacles.clone());
        let given = brushing::Given { sketch, provenance, habit, obstacles };
        let with = (species, params);
        let brushed =
            clock.time("brushes", || brushing::brush(&mut memory.brushes, &mut made, given, with, stop))?;
        remarks.extend(brushed);
        pose_grown(&mut made, &[]);
    } else {
        memory.brushes.truncate(0);
    }
    let PlantAtAge { plant, buds } = made;
    let made =
        Produced { plant, buds, provenance, remarks, anatomy, growth, obstacles, ..Produced::default() };
    Some(Produced { wood, poses, ..made })
}

/// Where the first trunk of some wood stands, metres.
fn foot(wood: &[Branch]) -> Vec3 {
    let trunk = wood.iter().find(|branch| branch.parent.is_none());
    trunk.and_then(|trunk| trunk.points.first()).copied().unwrap_or(Vec3::ZERO)
}

/// Adds branches that are drawn in space, and poses drawn wood.
fn modelled(
    memory: &mut modelling::Cache,
    sketch: &Sketch,
    (anatomy, plant, provenance): (&Anatomy, &mut Plant, &mut Provenance),
    (params, poses): (&Params, &mut Vec<PartPose>),
    remarks: &mut Vec<Warning>,
) -> DrawnWood {
    let in_space: Vec<_> = sketch.in_space().collect();
    let stands_on_sheet = in_space.is_empty() && sketch.brush_strokes().next().is_none();
    if stands_on_sheet && poses.is_empty() {
        memory.forget();
        return DrawnWood::default();
    }
    let diagonal = yardstick(sketch, anatomy, (plant, provenance), params);
    let radii = &params.depth.radii;
    remarks.extend(modelling::add_branches(memory, (plant, provenance), &in_space, diagonal, radii));
    let (names, scale) = (PartNames::new(provenance), provenance.world_from_canvas.scale);
    DrawnWood { posed: modelling::pose_wood(plant, &names, poses, scale), ..DrawnWood::default() }
}

/// The yardstick of what is drawn in space, canvas pixels. A drawing of nothing else has the world of its sheet.
fn yardstick(
    sketch: &Sketch,
    anatomy: &Anatomy,
    (plant, provenance): (&Plant, &mut Provenance),
    params: &Params,
) -> f32 {
    if !(plant.branches.is_empty() && plant.organs.is_empty()) {
        return anatomy.diagonal;
    }
    provenance.world_from_canvas = placing::world_of_sheet(sketch.canvas, params.depth.world.height);
    sketch.canvas.height
}
