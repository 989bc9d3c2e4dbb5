//! What the artist makes in the view of the plant: branches drawn in space, and wood that is turned, bent, made thicker and
//! cut off (001 chapter 4).
//!
//! The stage stands between depth and growth: what is drawn in space joins the wood that the sheet gave, and both grow on
//! as one. Wood that grew is posed after that. It is pure: strokes, poses and a plant in, the plant with them out.

mod branches;
mod curve;
mod cut_off;
mod drawn_wood;
mod foothold;
mod joint;
mod poses;
mod thickness;

pub use branches::{Cache, add_branches};
pub use drawn_wood::DrawnWood;
pub use foothold::{Foothold, GROUND_REACH};
pub use poses::{Posed, pose_grown_wood, pose_wood, poses_at_rest};
