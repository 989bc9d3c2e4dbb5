//! Whole plants from photographs (001 §3.1 and §3.4): found in front of their surroundings, outlined as crowns to grow into, with
//! trunk and colours.
//!
//! | file | what |
//! | --- | --- |
//! | `marks` | what the artist marked: a loose outline, lines on the plant and around it |
//! | `mixture`, `rows`, `min_cut`, `segment` | colours of both sides, surroundings by height, the cheapest border, all in turns |
//! | `regions`, `loops` | the plant that is meant, its outlines and holes |
//! | `parts` | crown and trunk |
//! | `edges`, `snap` | lines in the picture; a drawn trunk moved onto them |
//! | `tint` | colours of foliage and bark, and textures that have them |
//! | `plant_photo` | all of it in a row |
//! | `plant_drawing` | a drawing with crowns and trunk over the photograph |
//!
//! Where we depart: the thesis takes Canny's edges of a photograph as the outline itself and lets the artist draw the trunk; here the
//! outline comes from colours, because edges of foliage are everywhere within a crown.

mod edges;
mod loops;
mod marks;
mod min_cut;
mod mixture;
mod parts;
mod plant_drawing;
mod plant_photo;
mod regions;
mod rows;
#[cfg(test)]
mod scene;
mod segment;
mod snap;
mod tint;

pub use loops::Loop;
pub use marks::Marks;
pub use parts::TrunkLine;
pub use plant_drawing::{TRUNK_RADIUS, trunk_radius};
pub use plant_photo::{PlantPhoto, PlantPicture};
pub use snap::SnapParams;
pub use tint::{PlantColours, tinted_textures};

crate::parameters! {
    /// How a plant is found in its surroundings.
    pub struct PlantParams {
        /// Longest side at which the plant is searched; larger photographs are scaled down.
        side: u32 = 512, 64..=1024, "pixels";
        /// Most rounds of fitting colours and cutting.
        rounds: u32 = 4, 1..=12, "";
        /// Width of the border that shows the surroundings where no outline is drawn.
        border: f32 = 0.03, 0.002..=0.2, "of the shorter side";
        /// How smooth the plant's border is; more lets fewer twigs and gaps stand out.
        smoothness: f32 = 20.0, 0.0..=200.0, "";
        /// Least hole that stays open.
        hole: f32 = 0.004, 0.0..=0.2, "of the plant's area";
        /// How far an outline may leave the contour.
        tolerance: f32 = 0.004, 0.0005..=0.05, "of the plant's size";
        /// Widest trunk.
        trunk: f32 = 0.3, 0.02..=0.8, "of the crown's width";
    }
}
