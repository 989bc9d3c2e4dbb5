//! How finely a plant is modelled: the parameters of all stages together.

use super::flat::BladeMeshParams;
use super::solids::SolidParams;
use super::tube::TubeParams;

crate::parameter_groups! {
    /// How finely a plant is modelled.
    pub struct ModelParams {
        /// Petals, leaves and sepals.
        blade: BladeMeshParams;
        /// Branches and stems.
        tube: TubeParams;
        /// Receptacles, fruits and pots.
        solid: SolidParams;
    }
}
