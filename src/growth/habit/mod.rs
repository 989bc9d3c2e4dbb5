//! What a species file says of growth: its keys, numbers that change with age, and the leaves.

mod arrangement;
mod keys;
pub(super) mod leaf;
mod schedule;

pub use arrangement::Arrangement;
pub use keys::{ClimbHabit, Control, CrownHabit, Habit, LightHabit, Profile, Resource, SpaceHabit, Toward};
pub use leaf::{LeafHabit, LeafPose, LeafShape};
pub use schedule::Schedule;
