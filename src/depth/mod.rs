//! From the flat drawing to the plant in space (000 ch. 4, 002 §5).
//!
//! Flowers get the cone that their petals project from, branches the depths that spread them best, leaves the pose that
//! seeks the light. Seen from the front, branches and petals cover the strokes that drew them.

pub mod branch_depth;
mod cone_fit;
pub mod cone_pose;
#[cfg(test)]
mod cone_pose_tests;
pub mod crowns;
pub mod flower_stem;
pub mod flowers;
mod fruits;
mod hidden_petals;
pub mod learned;
mod least_squares;
pub mod leaves;
pub mod outline;
pub mod petal_shapes;
mod petal_tip;
pub mod petals;
mod pots;
pub mod radii;
pub mod recover;
mod whorl_fit;
mod whorls;

pub use crowns::{crowns, thin_spots};
pub use recover::{Cache, DepthParams, Given, recover, recover_with};
