//! Leaves that nobody drew: outlines from numbers, compound leaves, leaflets along a rachis (004 §2, §3.2.3), and where leaves
//! stand along the stem of a herb.
//!
//! | file | what |
//! | --- | --- |
//! | [`outline`] | outlines of leaves and leaflets, smooth or with teeth |
//! | [`compound`] | where the leaflets of a compound leaf stand |
//! | [`on_stem`] | rosettes, and leaves at the nodes of a stem |

pub mod compound;
pub mod on_stem;
pub mod outline;

pub use compound::{Compound, CompoundLeaf};
pub use on_stem::StemLeaves;
pub use outline::LeafOutline;
