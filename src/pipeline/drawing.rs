//! The maker of drawn plants: strokes are understood, stood up in space, and grow on where they may.

use super::clock::Clock;
use super::growing;
use super::setup::Params;
use super::source::Produced;
use crate::anatomy;
use crate::depth;
use crate::growth::Memory;
use crate::sketch::Sketch;
use crate::species::Species;

/// Makes the plant of a drawing; nothing if `stop` said yes.
pub(super) fn produce(
    memory: &mut Memory,
    sketch: &Sketch,
    (species, params): (&Species, &Params),
    clock: &mut Clock,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Produced> {
    let mut anatomy = clock.time("anatomy", || anatomy::analyse_unless(sketch, &params.anatomy, stop))?;
    let mut remarks = std::mem::take(&mut anatomy.warnings);
    remarks.extend(growing::fineness_unused(&anatomy, species, params));
    let (plant, provenance) = clock.time("depth", || depth::recover(&anatomy, sketch.seed, &params.depth));
    if stop() {
        return None;
    }
    if !growing::grows(&anatomy, species, params) {
        memory.clear();
        return Some(Produced { plant, provenance, remarks, anatomy, growth: None, may_flower: true });
    }
    let grown = clock.time("growth", || {
        growing::grow_on(
            memory,
            (plant, &provenance),
            &anatomy,
            (species, params),
            sketch.seed,
            &mut remarks,
            stop,
        )
    });
    let (plant, ages) = grown?;
    Some(Produced { plant, provenance, remarks, anatomy, growth: Some(ages), may_flower: true })
}
