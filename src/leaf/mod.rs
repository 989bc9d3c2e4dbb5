//! Leaves that nobody drew: outlines from numbers, and compound leaves, leaflets along a rachis (004 §2, §3.2.3).
//!
//! | file | what |
//! | --- | --- |
//! | [`outline`] | outlines of leaves and leaflets, smooth or with teeth |
//! | [`compound`] | where the leaflets of a compound leaf stand |

pub mod compound;
pub mod outline;

pub use compound::{Compound, CompoundLeaf};
pub use outline::LeafOutline;
