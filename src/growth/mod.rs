//! Plants that grow themselves (001 ch. 2): buds compete for space or light, and the winners become branches.
//!
//! Every year each bud learns how much of the resource it has and where more is (eqs. 2.1, 2.2); the plant gathers it
//! at its root and shares it out again (eqs. 2.4 to 2.6); buds that get enough grow shoots in a direction of their own
//! (eq. 2.3), branches that earn too little are shed, and wood thickens by the pipe model (eq. 2.7). [`Simulation`] is
//! the stage; [`plant_at`] gives the [`Plant`](crate::plant::Plant) of any age. A [`Habit`] says how a species grows.
//!
//! | file | what |
//! | --- | --- |
//! | `schedule`, `table`, `species`, `leaf` | what a species file says of growth |
//! | `envelope`, `solid`, `inflated` | volumes that a plant may fill |
//! | `markers`, `competition` | space as the resource |
//! | `shadow` | light as the resource |
//! | `vigour`, `priority` | who gets how much of it |
//! | `direction`, `fate`, `shedding` | what buds and branches make of it |
//! | `tree`, `skeleton`, `setting`, `simulation`, `limits`, `effort` | the plant through the years |
//! | `diameter`, `chains`, `insertion`, `rubbing`, `pruning`, `stool`, `standing`, `foliage`, `bloom`, `to_plant` | the plant of one age |
//! | `overlay` | what growth looks like from inside |
//! | `drawing`, `lead`, `merge` | growth in a drawing: its wood goes on, its crowns are filled |
//!
//! Everything here is pure and deterministic: no files, no clocks, the same bytes on any number of threads.

#[cfg(test)]
mod age_tests;
pub mod bloom;
pub mod chains;
pub mod competition;
pub mod diameter;
pub mod direction;
pub mod drawing;
pub mod effort;
pub mod envelope;
pub mod fate;
pub mod foliage;
pub mod inflated;
pub mod insertion;
pub mod lead;
pub mod leaf;
pub mod limits;
pub mod markers;
pub mod merge;
pub mod overlay;
pub mod priority;
pub mod pruning;
pub mod rubbing;
pub mod schedule;
pub mod setting;
pub mod shadow;
pub mod shedding;
pub mod simulation;
pub mod skeleton;
pub mod solid;
pub mod species;
pub mod standing;
mod stool;
pub mod table;
#[cfg(test)]
mod tests;
pub mod to_plant;
pub mod tree;
pub mod vigour;

pub use drawing::{GrowthParams, Memory, Start};
pub use envelope::Envelope;
pub use inflated::Inflated;
pub use limits::{Limits, Outcome};
pub use schedule::Schedule;
pub use setting::Field;
pub use simulation::Simulation;
pub use solid::{Solid, SolidError};
pub use species::Habit;
pub use to_plant::plant_at;
pub use tree::Tree;
