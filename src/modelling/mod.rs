//! What the artist makes in the view of the plant: branches drawn in space, and parts that are turned, bent, straightened, moved,
//! grafted, made larger, replaced and taken away (001 chapter 4).
//!
//! The stage stands between depth and growth: what is drawn in space joins the wood that the sheet gave, and both grow on
//! as one. Wood that grew is posed after that, and leaves, flowers and all else when the species has given them their looks. It is pure: strokes, poses and a plant in, the plant with them out.

mod branches;
mod carried;
mod contact;
mod curve;
mod cut_off;
mod drawn_wood;
mod foothold;
mod graft;
mod joint;
mod organ_group;
mod organ_poses;
mod part_names;
mod poses;
mod replace;
mod slide;
mod straighten;
mod thickness;

pub use branches::{Cache, add_branches};
pub use contact::{OnContact, Surroundings};
pub use drawn_wood::DrawnWood;
pub use foothold::{Foothold, GROUND_REACH};
pub use organ_group::OrganGroup;
pub use organ_poses::pose_organs;
pub use part_names::PartNames;
pub use poses::{PartFrame, Posed, pose_grown_wood, pose_wood, poses_at_rest};
pub use replace::is_replaceable;
