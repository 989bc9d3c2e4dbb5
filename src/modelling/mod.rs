//! What the artist makes in the view of the plant: branches drawn in space, and wood that is turned and bent (001
//! chapter 4).
//!
//! The stage stands between depth and growth: what is drawn in space joins the wood that the sheet gave, and both grow on
//! as one. It is pure: strokes and a plant in, the plant with their branches out.

mod branches;
mod curve;
mod drawn_wood;
mod foothold;
mod poses;

pub use branches::{Cache, add_branches};
pub use drawn_wood::DrawnWood;
pub use foothold::{Foothold, GROUND_REACH};
pub use poses::{Posed, pose_wood};
