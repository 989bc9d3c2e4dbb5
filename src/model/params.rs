//! How finely a plant is modelled: the parameters of all stages together.

use super::fineness::SolidParams;
use super::flat::BladeMeshParams;
use super::tube::TubeParams;

crate::parameters! {
    /// How many triangles a plant has.
    pub struct TriangleParams {
        /// Triangles that the plant should have, give or take three of a hundred; 0 for as many as its fineness makes.
        triangles: u32 = 0, 0..=10_000_000, "";
    }
}

crate::parameter_groups! {
    /// How finely a plant is modelled.
    pub struct ModelParams {
        /// Petals, leaves and sepals.
        blade: BladeMeshParams;
        /// Branches and stems.
        tube: TubeParams;
        /// Receptacles, fruits and pots.
        solid: SolidParams;
        /// How much there may be of all.
        budget: TriangleParams;
    }
}
