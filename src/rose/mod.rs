//! Roses from measured form: the stems of a plant, its leaves by the golden angle, flowers at the ends (004 §3.1, §3.2).
//!
//! ```text
//! RoseHabit, seed ──► stems ──► places of branches ──► leaves, flower buds
//! numbers             units, splines   weights, golden section
//! ```
//!
//! | file | what |
//! | --- | --- |
//! | [`habit`] | the numbers of the section `[rose]` |
//! | [`stems`] | stems of five units, and where branches leave them |
//! | [`mod@shrub`] | all of them with leaves and buds |
//! | [`mod@on_stems`] | leaves, flowers and side shoots on stems that were drawn |
//!
//! Where 004 contradicts itself, and what is done instead: `docs/papers.md`.

pub mod habit;
pub mod on_stems;
pub mod shrub;
pub mod stems;

pub use habit::{RoseHabit, Season};
pub use on_stems::{DrawnStem, on_stems};
pub use shrub::{Leaf, RoseBud, Shrub, shrub};
pub use stems::Stem;
