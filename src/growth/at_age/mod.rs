//! The plant of one age: its wood as chains of nodes, cut where there is no room, with leaves and flower buds.

mod aside;
mod bloom;
pub(super) mod chains;
pub(super) mod diameter;
pub mod foliage;
mod fork;
mod insertion;
pub(super) mod new_growth;
mod pruning;
mod rounding;
mod rubbing;
mod stem_base;
pub(super) mod to_plant;
pub(super) mod wood_at_age;
pub(super) mod wood_names;
pub(super) mod younger;

pub use to_plant::{PlantAtAge, plant_at};
pub use younger::Younger;
