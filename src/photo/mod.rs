//! Photographs to outlines and textures: petals, leaves and bark (003 §2.1 to §2.3).
//!
//! A petal or leaf is cut out along its contour, stood upright in a blade's plane, cleaned, and painted into a picture in which
//! that blade's own UV holds, so that no rectangle is stretched over it. Bark becomes a tile without seams. Everything works on
//! pixels in memory; the same photograph gives the same bytes.
//!
//! | file | what |
//! | --- | --- |
//! | `shrink`, `raster`, `windows`, `lab` | pixels: fewer of them, on a grid, with those around them, as the eye tells colours apart |
//! | `background`, `mask`, `coverage` | what is not background: split, the largest region, how much of each pixel |
//! | `contour`, `ends`, `polygon` | its outline, base and tip; which pixels lie within an outline |
//! | `clean`, `crease` | creases, contrast, noise |
//! | `texture` | the picture in the blade's UV, its colour led on outward |
//! | `blade_photo`, `bark` | all of it in a row |
//! | `drawing` | a drawing that shows what came of it |
//! | `plant` | whole plants before their surroundings, as crowns to grow into |
//! | `error` | what keeps a photograph from being used, and what is odd about it |
//!
//! Where we depart: the paper does the cleaning by hand in an image editor.
//!
//! Limits, but for `plant`: one colour of background, one petal or leaf at a time; a side of at least 16 pixels, and as many pixels as
//! `picture::decode` takes; work is done on at most `cutout.side` pixels a side.

mod background;
mod bark;
mod blade_photo;
mod clean;
mod contour;
mod coverage;
mod crease;
mod drawing;
mod ends;
mod error;
mod lab;
mod mask;
pub mod plant;
mod polygon;
mod raster;
mod shrink;
mod texture;
mod windows;

pub use background::CutoutParams;
pub use bark::{BarkParams, BarkPhoto};
pub use blade_photo::{BladePhoto, Traced};
pub use clean::{CleanParams, Cleaned};
pub use drawing::{BladeKind, picture_of};
pub use error::{PhotoError, PhotoRemark};
pub use plant::{PlantParams, SnapParams};
pub use texture::TextureParams;

crate::parameter_groups! {
    /// All that can be set of how photographs are used.
    pub struct PhotoParams {
        /// Telling it from the background.
        cutout: CutoutParams;
        /// Cleaning it.
        clean: CleanParams;
        /// The texture.
        texture: TextureParams;
        /// Bark.
        bark: BarkParams;
        /// Finding a whole plant.
        plant: PlantParams;
        /// Moving a drawn trunk onto the edges of the photograph.
        snap: SnapParams;
    }
}

impl PhotoParams {
    /// Those for leaves: midribs and veins, which look like creases, stay.
    pub fn for_leaves() -> Self {
        let clean = CleanParams { creases: false, ..CleanParams::default() };
        Self { clean, ..Self::default() }
    }
}
