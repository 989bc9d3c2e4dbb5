//! From the flat drawing to the plant in space (000 ch. 4, 002 §5).

pub mod branch_depth;
mod cone_fit;
pub mod cone_pose;
#[cfg(test)]
mod cone_pose_tests;
mod petal_tip;
