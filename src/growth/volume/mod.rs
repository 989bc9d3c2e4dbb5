//! Volumes that a plant may fill: simple bodies, crowns of species, closed meshes and drawn outlines made round.

mod envelope;
mod inflated;
mod solid;

pub use envelope::{Crown, Envelope};
pub use inflated::Inflated;
pub use solid::{MAX_BYTES, Solid, SolidError};

#[cfg(test)]
pub(crate) use solid::tests::flipped;
