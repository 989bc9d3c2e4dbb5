//! Volumes that a plant may fill: simple bodies, crowns of species, closed meshes, drawn outlines made round, lobes together, what a brush sweeps; and light that one paints.

mod envelope;
mod guide;
mod inflated;
mod lamp;
mod lobes;
pub(super) mod mesh_text;
mod solid;
mod swept;

pub use envelope::{Crown, Envelope};
pub use inflated::Inflated;
pub use lamp::Lamp;
pub use lobes::Lobes;
pub(super) use lobes::Part;
pub use mesh_text::{MAX_BYTES, MeshError};
pub use solid::Solid;
pub use swept::{Ball, Swept};

#[cfg(test)]
pub(crate) use lobes::tests::ball;
#[cfg(test)]
pub(crate) use solid::tests::flipped;
