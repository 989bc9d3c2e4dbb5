//! Volumes that a plant may fill: simple bodies, crowns of species, closed meshes, drawn outlines made round, lobes together, and what a brush sweeps.

mod envelope;
mod guide;
mod inflated;
mod lobes;
mod solid;
mod swept;

pub use envelope::{Crown, Envelope};
pub use inflated::Inflated;
pub use lobes::Lobes;
pub(super) use lobes::Part;
pub use solid::{MAX_BYTES, Solid, SolidError};
pub use swept::{Ball, Swept};

#[cfg(test)]
pub(crate) use lobes::tests::ball;
#[cfg(test)]
pub(crate) use solid::tests::flipped;
