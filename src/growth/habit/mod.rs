//! What a species file says of growth: its keys, numbers that change with age, and the leaves.

mod keys;
pub(super) mod leaf;
mod schedule;

pub use keys::{Arrangement, Control, CrownHabit, Habit, LightHabit, Profile, Resource, SpaceHabit, Toward};
pub use leaf::{LeafHabit, LeafShape};
pub use schedule::Schedule;
