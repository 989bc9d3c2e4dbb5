//! What no plant may exceed, and how growth ended.
//!
//! Every parameter of a species may be set so that a plant grows without measure; caps on internodes, markers, memory and
//! time end its growth with a message instead.
//!
//! Limits: how many years fit into the time depends on the machine and on what else it does, so a plant that
//! [`Outcome::TooSlow`] ended may be another one elsewhere; its message says so. All else is the same everywhere.

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
    /// Longest time that its years may take together, seconds.
    pub seconds: u32,
}

impl Default for Limits {
    fn default() -> Self {
        let Budget { internodes, markers, voxels, .. } = Budget::PLANT;
        Self { internodes, markers, voxels, seconds: 300 }
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
    /// Its years have taken this many seconds; the one that was running did not happen.
    TooSlow(u32),
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
            Self::TooSlow(most) => write!(
                f,
                "growth ended after {most} seconds, the most that are allowed; how far a plant comes in that time \
                 depends on the machine, so it may be another one elsewhere; choose a lower age, longer internodes or \
                 fewer markers"
            ),
            Self::TooOld(most) => {
                write!(f, "growth ended at the age of {most} years, the most that are counted")
            }
        }
    }
}
