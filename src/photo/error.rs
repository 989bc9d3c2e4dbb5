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
    /// Too little has the colours of a plant before its surroundings.
    #[error(
        "no plant was found on the photograph ({share:.1} % of it, at least {least:.0} % are needed); draw a loose outline around \
         the plant, and a line on it"
    )]
    NoPlant {
        /// Share of the photograph that was found, percent.
        share: f32,
        /// What is needed.
        least: f32,
    },
    /// Everything has.
    #[error(
        "{share:.0} % of the photograph were taken for plant, more than {most:.0} %, so that nothing of its surroundings is \
         left; draw a loose outline around the plant, or a line on what is around it"
    )]
    AllPlant {
        /// Share of the photograph that was found, percent.
        share: f32,
        /// What is believed.
        most: f32,
    },
    /// Nothing tells the plant's colours from those around it.
    #[error(
        "the middle of the photograph has the colours of its border, so no plant stands out; draw a loose outline around the \
         plant, and lines on it and around it"
    )]
    SameColours,
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
    /// More than one plant.
    #[error(
        "{count} plants were found on the photograph; the largest was taken, a line on another one takes that"
    )]
    SeveralPlants {
        /// How many of comparable size.
        count: usize,
    },
    /// A trunk whose sides no edges show.
    #[error("the two sides of the drawn trunk are not seen on the photograph; it stays as it was drawn")]
    TrunkAsDrawn,
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
