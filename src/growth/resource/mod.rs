//! The resource that buds compete for, and how the plant shares it out: what each bud earns of light or space runs down
//! to the root and up again.

pub(super) mod competition;
pub(super) mod field;
pub(super) mod markers;
pub(super) mod priority;
pub(super) mod shadow;
pub(super) mod vigour;

pub use field::Field;
