//! What keeps a photograph from being used, and what is odd about one that is.

use thiserror::Error;

/// Why nothing comes of a photograph.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PhotoError {
    /// Fewer pixels than anything can be recognised by.
    #[error("the photograph has {width}×{height} pixels; at least {least} each way are needed")]
    TooSmall {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// What is needed.
        least: u32,
    },
    /// Nothing differs from the background.
    #[error(
        "nothing on the photograph stands out from its background (colours differ by {contrast:.1}, {least:.1} are needed); lay \
         it on a plain ground of another colour"
    )]
    OneColour {
        /// How far the colours are apart, ΔE.
        contrast: f32,
        /// What is needed.
        least: f32,
    },
    /// The largest thing is a speck.
    #[error("nothing on the photograph is large enough to be a petal or a leaf; photograph it from nearer")]
    NothingThere,
    /// What is there goes on beyond the edge.
    #[error(
        "what is on the photograph goes on beyond its edge ({share:.0} % of the outline lies there); photograph all of it, \
         with ground around it"
    )]
    CutOff {
        /// Share of the outline that lies along the edge, percent.
        share: f32,
    },
    /// Base and tip that were given are no two places in the picture.
    #[error(
        "base and tip must be two places within the photograph's {width}×{height} pixels, apart from each other"
    )]
    BadEnds {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// Outline without area.
    #[error("the outline encloses nothing; draw it around the petal or leaf")]
    NoOutline,
    /// A traced outline that does not lie over the picture.
    #[error("the stroke does not lie over the picture; move one of them")]
    BesidePicture,
    /// The finished texture cannot be encoded.
    #[error("the texture cannot be written as a picture: {0}")]
    Encoding(String),
}

/// What is odd about a photograph that can be used.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum PhotoRemark {
    /// More than one thing lies there.
    #[error("{count} things lie on the photograph; the largest was taken")]
    Several {
        /// How many of comparable size.
        count: usize,
    },
    /// A part reaches the edge of the picture.
    #[error("what was cut out touches the photograph's edge and ends there")]
    TouchesEdge,
    /// A part of a traced outline lies beside the picture.
    #[error("{share:.0} % of the outline lies beside the picture; the nearest colour was taken there")]
    PartlyBeside {
        /// Share of the area, percent.
        share: f32,
    },
}
