//! Which maker makes a plant without a drawing: its species grows, is a rose, or has flowers of its own.

use super::bloom;
use super::clock::Clock;
use super::rose;
use super::seed::{self, SeedMemory};
use super::setup::Params;
use super::source::{Bloom, Produced, Seed};
use crate::species::Species;

/// Makes the plant of a seed; nothing if `stop` said yes. A species that says nothing of how it grows grows like an ordinary tree.
pub(super) fn produce(
    memory: &mut SeedMemory,
    seed: &Seed,
    (species, params): (&Species, &Params),
    clock: &mut Clock,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Produced> {
    let with = (species, params);
    if let Some(habit) = &params.rose {
        return Some(clock.time("rose", || rose::produce(seed, habit, with)));
    }
    if species.growth.is_none() && species.blooms() {
        return Some(clock.time("bloom", || bloom::produce(&Bloom { number: seed.number }, with)));
    }
    seed::produce(memory, seed, with, clock, stop)
}
