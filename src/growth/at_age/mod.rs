//! The plant of one age: its wood as chains of nodes, cut where there is no room, with leaves and flower buds.

pub mod bloom;
pub(super) mod chains;
pub(super) mod diameter;
pub mod foliage;
mod insertion;
mod pruning;
mod rubbing;
mod stem_base;
pub(super) mod to_plant;
pub(super) mod wood_at_age;

pub use to_plant::plant_at;
