//! What no plant may exceed, and how growth ended.
//!
//! Every parameter of a species may be set so that a plant grows without measure; caps on internodes, markers, memory and
//! work end its growth with a message instead. All of them are counts, so a plant that one of them ended is the same on
//! every machine.

use crate::budget::Budget;
use std::fmt;

/// Caps of one plant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most internodes that ever grow, shed ones counted.
    pub internodes: usize,
    /// Most markers of space; more would be thinned out evenly.
    pub markers: usize,
    /// Most voxels of the shadow grid.
    pub voxels: usize,
    /// Most elementary steps that its years may take together, about a nanosecond each.
    pub steps: u64,
    /// Most leaves.
    pub leaves: usize,
    /// Most flower buds, each of which has some thirty parts.
    pub flower_buds: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self::within(&Budget::PLANT)
    }
}

impl Limits {
    /// Those of a plant with a budget.
    pub const fn within(budget: &Budget) -> Self {
        let &Budget { internodes, markers, voxels, growth_steps: steps, leaves, flower_buds, .. } = budget;
        Self { internodes, markers, voxels, steps, leaves, flower_buds }
    }

    /// The usual ones, for a plant of at most so many internodes: a larger plant is more work, a smaller one no less.
    pub fn of_internodes(most: usize) -> Self {
        let usual = Self::default();
        let times = most.div_ceil(usual.internodes.max(1)).max(1) as u64;
        Self { internodes: most, steps: usual.steps.saturating_mul(times), ..usual }
    }
}

/// How a year, or the last of several, ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The plant may go on.
    Growing,
    /// No bud is left that could ever grow.
    Finished,
    /// It was asked to stop; the year that was running did not happen.
    Stopped,
    /// The cap on internodes is reached.
    TooManyInternodes(usize),
    /// The plant has grown beyond the space in which shadows are kept.
    TooLarge(usize),
    /// Its years would take more steps than this many; the one that did did not happen.
    TooManySteps(u64),
    /// Years are counted up to this one.
    TooOld(u16),
}

impl Outcome {
    /// Whether the plant may go on.
    pub fn may_go_on(self) -> bool {
        self == Self::Growing
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Growing => f.write_str("the plant grows"),
            Self::Finished => f.write_str("no bud is left that could grow"),
            Self::Stopped => f.write_str("growth was stopped"),
            Self::TooManyInternodes(most) => write!(
                f,
                "growth ended at {most} internodes, the most that are allowed; choose a lower age, longer internodes \
                 or less ramification"
            ),
            Self::TooLarge(most) => write!(
                f,
                "growth ended because the shadow grid would need more than {most} voxels; choose a lower age or larger \
                 voxels"
            ),
            Self::TooManySteps(most) => write!(
                f,
                "growth ended because its years would take more than {} million steps of computation; choose a lower age, \
                 longer internodes, fewer markers or shadows of less depth",
                most / 1_000_000
            ),
            Self::TooOld(most) => {
                write!(f, "growth ended at the age of {most} years, the most that are counted")
            }
        }
    }
}
