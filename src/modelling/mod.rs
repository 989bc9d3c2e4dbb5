//! What the artist makes in the view of the plant: branches drawn in space (001 chapter 4).
//!
//! The stage stands between depth and growth: what is drawn in space joins the wood that the sheet gave, and both grow on
//! as one. It is pure: strokes and a plant in, the plant with their branches out.

mod branches;
mod curve;
mod foothold;

pub use branches::add_branches;
pub use foothold::{Foothold, GROUND_REACH};
