//! Plants that grow themselves (001 ch. 2): buds compete for space or light, and the winners become branches.
//!
//! Every year each bud learns how much of the resource it has and where more is (eqs. 2.1, 2.2); the plant gathers it
//! at its root and shares it out again (eqs. 2.4 to 2.6); buds that get enough grow shoots in a direction of their own
//! (eq. 2.3), branches that earn too little are shed, and wood thickens by the pipe model (eq. 2.7). [`Simulation`] is
//! the stage; [`plant_at`] gives the [`Plant`](crate::plant::Plant) of any age with its flower buds. A [`Habit`] says how a species grows.
//!
//! | room | what |
//! | --- | --- |
//! | `limits` | what no plant may exceed, and how growth ended |
//! | `tree` | the plant through all its years: nodes and buds |
//! | `habit` | what a species file says of growth |
//! | `volume` | volumes that a plant may fill |
//! | `obstacle` | what stands beside a plant: walls, trellises |
//! | `lead` | wood that is led into every part of a crown of lobes |
//! | `resource` | light or space, and who gets how much of it |
//! | `year` | what buds and branches make of it in one year |
//! | `simulation` | the plant through the years |
//! | `at_age` | the plant of one age |
//! | `overlay` | what growth looks like from inside |
//! | `from_drawing` | growth in a drawing: its wood goes on, its crowns are filled |
//! | `brush` | what a brush fills, or empties, in the space of a plant |
//!
//! A room uses only rooms above it.
//!
//! Everything here is pure and deterministic: no files, no clocks, the same bytes on any number of threads.

#[cfg(test)]
mod age_tests;
mod at_age;
pub mod brush;
mod from_drawing;
pub mod habit;
mod lead;
mod limits;
mod obstacle;
pub mod overlay;
mod resource;
mod simulation;
#[cfg(test)]
mod tests;
mod tree;
mod volume;
mod year;

pub use at_age::{PlantAtAge, Younger, foliage, plant_at};
pub use from_drawing::{DrawnCrowns, GrowthParams, Memory, Start, drawing, merge};
pub use habit::{Habit, Schedule};
pub use lead::lead_into;
pub use limits::{Limits, Outcome};
pub use obstacle::{Contact, KeptObstacles, ObstacleKind, ObstacleParams, Obstacles};
pub use resource::Field;
pub use simulation::Simulation;
pub use tree::Tree;
#[cfg(test)]
pub(crate) use volume::flipped;
pub use volume::{
    Ball, Crown, Envelope, Inflated, Lamp, Lobes, MAX_BYTES as MAX_MESH_BYTES, MeshError, Solid, Swept,
};
