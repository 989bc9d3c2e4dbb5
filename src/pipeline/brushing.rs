//! The stage between growth and species: strokes of brushes, one after the other, fill and empty parts of the plant.
//!
//! A light brush works on growth itself, which comes before: see [`lamps`].
//!
//! A species that does not say how it grows fills them like an ordinary tree, with a remark. All strokes of a drawing together grow
//! no more than a drawn crown may.

use super::setup::Params;
use crate::growth::brush::{Furnish, Memory, PAINTED_AGE, Paint, Painted, prune};
use crate::growth::{Habit, Lamp, Limits, Obstacles, PlantAtAge, Swept, drawing};
use crate::plant::{Provenance, WorldFromCanvas};
use crate::quote;
use crate::random::{Choice, mix};
use crate::sketch::{Brush, Remark, Sketch, Stroke, Tool, Warning};
use crate::species::Species;
use glam::Vec3;
use std::sync::Arc;

/// What brushes are given beside a plant.
pub(super) struct Given<'a> {
    /// The drawing whose strokes they are.
    pub(super) sketch: &'a Sketch,
    /// What the drawing knows of the plant.
    pub(super) provenance: &'a Provenance,
    /// How the plant grew, if it did.
    pub(super) habit: Option<Habit>,
    /// What stands in the way.
    pub(super) obstacles: Option<Arc<Obstacles>>,
}

/// Lets the strokes of a drawing's brushes work on its plant, and remarks what is odd about them; nothing if `stop` said yes.
pub(super) fn brush(
    memory: &mut Memory,
    plant: &mut PlantAtAge,
    Given { sketch, provenance, habit, obstacles }: Given<'_>,
    (species, params): (&Species, &Params),
    stop: &dyn Fn() -> bool,
) -> Option<Vec<Warning>> {
    let (own, world) = (&params.habit, &provenance.world_from_canvas);
    let habit = habit.unwrap_or_else(|| own.scaled(params.depth.world.height / own.height));
    let mut remarks = Vec::new();
    let (mut painted, internodes) = (0, drawing::LIMITS.internodes);
    for stroke in sketch.brush_strokes() {
        let Some(brush) = stroke.brush.filter(|_| stroke.tool != Tool::LightBrush) else { continue };
        let remark = |remark: Remark| Warning { stroke: Some(stroke.id), remark };
        let Some(swept) = Swept::new(&way(stroke, &brush, world), brush.guide) else { continue };
        if stroke.tool == Tool::PruningBrush {
            let cuts = prune(plant, &swept);
            remarks.extend((!cuts).then(|| remark(Remark::BrushCutsNothing)));
            continue;
        }
        let radius = brush.radius * world.scale;
        let seed = mix(Choice::BRUSH.key(sketch.seed), stroke.id);
        if let Tool::LeafBrush | Tool::FlowerBrush = stroke.tool {
            let most = limits(plant).leaves;
            let furnish = Furnish { swept: &swept, density: brush.density, habit: &habit, seed, most };
            let odd = match stroke.tool {
                Tool::LeafBrush => leaves(furnish, plant, provenance),
                _ => flowers(furnish, plant, provenance, flower_of(species, params, &habit)),
            };
            remarks.extend(odd.map(remark));
            continue;
        }
        let obstacles = obstacles.clone();
        let paint = Paint { swept: Arc::new(swept), obstacles, radius, density: brush.density, seed };
        let with = (&habit, limits(plant));
        let how = paint.grow((plant, provenance), (memory, painted), with, stop);
        painted += 1;
        if species.growth.is_none() && painted == 1 {
            let (species, known) = (quote::name(&species.name), Species::growing().join(", "));
            remarks.push(remark(Remark::DoesNotGrow { species, known }));
        }
        match how {
            Painted::Stopped => return None,
            Painted::OutOfReach => remarks.push(remark(Remark::BrushOutOfReach)),
            Painted::Capped => remarks.push(remark(Remark::GrowthCapped { internodes })),
            Painted::Filled => {}
        }
    }
    memory.truncate(painted);
    Some(remarks)
}

/// Paints leaves, and says what is odd about that.
fn leaves(furnish: Furnish<'_>, plant: &mut PlantAtAge, provenance: &Provenance) -> Option<Remark> {
    if furnish.most == 0 {
        return Some(Remark::PaintsNoMore { most: drawing::LIMITS.leaves });
    }
    (!furnish.leaves(plant, provenance)).then_some(Remark::BrushOutOfReach)
}

/// Paints flowers, and says what is odd about that; those of the species, if it has any, open from buds of a size, metres, and look.
fn flowers(
    furnish: Furnish<'_>,
    plant: &mut PlantAtAge,
    provenance: &Provenance,
    of_species: Option<(f32, usize)>,
) -> Option<Remark> {
    let of_drawn =
        || plant.plant.organs.iter().any(|organ| organ.flower.is_some() && organ.origin.is_drawn());
    if of_species.is_none() && !of_drawn() {
        return Some(Remark::NoFlowerToPaint);
    }
    let most = limits(plant).flower_buds.saturating_sub(plant.plant.flowers.len());
    let furnish = Furnish { most, ..furnish };
    if furnish.most == 0 {
        return Some(Remark::PaintsNoMore { most: drawing::LIMITS.flower_buds });
    }
    (!furnish.flowers(plant, provenance, of_species.unwrap_or_default())).then_some(Remark::BrushOutOfReach)
}

/// Size, metres, and look of a bud that the species opens; none where it opens none.
fn flower_of(species: &Species, params: &Params, habit: &Habit) -> Option<(f32, usize)> {
    if species.blossom.is_some() {
        return Some((habit.leaf.at(PAINTED_AGE).length, 0));
    }
    let mut looks = species.looks_of_drawn().into_iter();
    let look = looks.find(|look| species.flowers[*look].layers.is_some())?;
    Some((params.flower.bloom.reach, look))
}

/// The light that a drawing's brushes paint, for all of its growth but that of other brushes.
pub(super) fn lamps(sketch: &Sketch, world: &WorldFromCanvas) -> Vec<Lamp> {
    let lamp = |stroke: &Arc<Stroke>| {
        let brush = stroke.brush.filter(|_| stroke.tool == Tool::LightBrush)?;
        Lamp::new(&way(stroke, &brush, world), brush.guide)
    };
    sketch.brush_strokes().filter_map(lamp).collect()
}

/// The remark that light is painted where nothing grows.
pub(super) fn lights_nothing(sketch: &Sketch) -> Option<Warning> {
    let lit = sketch.brush_strokes().find(|stroke| stroke.tool == Tool::LightBrush)?;
    Some(Warning { stroke: Some(lit.id), remark: Remark::LightsNothing })
}

/// Where the middle of a brush went, and its radius there, metres.
fn way(stroke: &Stroke, brush: &Brush, world: &WorldFromCanvas) -> Vec<(Vec3, f32)> {
    let points = stroke.points.iter();
    let place = points.map(|p| {
        let radius = brush.radius_at(p.pressure) * world.scale;
        (world.point_in_space(p.position, p.depth), radius)
    });
    place.collect()
}

/// What one more stroke may grow on a plant: what a drawn crown may, less what the plant has.
fn limits(plant: &PlantAtAge) -> Limits {
    let most = drawing::LIMITS;
    let nodes: usize = plant.plant.branches.iter().map(|branch| branch.points.len()).sum();
    Limits {
        internodes: most.internodes.saturating_sub(nodes),
        leaves: most.leaves.saturating_sub(plant.plant.organs.len()),
        flower_buds: most.flower_buds.saturating_sub(plant.buds.buds.len()),
        ..most
    }
}
