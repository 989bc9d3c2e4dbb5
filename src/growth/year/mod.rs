//! What one year of growth decides: the fate of buds, the directions of shoots, the branches that are shed.

pub(super) mod climbing;
pub(super) mod direction;
pub(super) mod fate;
pub(super) mod shedding;
