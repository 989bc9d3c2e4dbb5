//! What is said of a lobe that was made, and why one cannot be made.

use std::fmt;
use thiserror::Error;

/// Something to know of a lobe that was made. Strokes are counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remark {
    /// A stroke without length.
    NoLength {
        /// The stroke.
        stroke: usize,
    },
    /// A loop that crossed itself.
    Cut {
        /// The stroke.
        stroke: usize,
    },
    /// A stroke that has no place between the others.
    LeftOut {
        /// The stroke.
        stroke: usize,
    },
    /// The surface crossed itself.
    Untangled,
    /// Its triangles could not be made even.
    Uneven,
    /// Offsets of vertices that are no longer there.
    LostOffsets {
        /// How many.
        count: usize,
    },
    /// The lobe reached below the ground.
    Clipped,
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoLength { stroke } => write!(f, "stroke {stroke} is a single spot and is left out"),
            Self::Cut { stroke } => {
                write!(f, "stroke {stroke} crosses itself; its larger loop is kept")
            }
            Self::LeftOut { stroke } => write!(
                f,
                "stroke {stroke} is open, but both ends of the lobe are closed already, so it is left out"
            ),
            Self::Untangled => write!(
                f,
                "the surface between the strokes crosses itself; the surface of all that it encloses is taken, edges are rounded"
            ),
            Self::Uneven => write!(f, "its triangles could not be made even and stay as they are"),
            Self::LostOffsets { count } => write!(
                f,
                "{count} entries of `deform` belong to vertices that no longer exist and are left out; deform the surface again"
            ),
            Self::Clipped => write!(f, "what is below the ground is cut off"),
        }
    }
}

/// A lobe that cannot be made: the reason and what to do.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum Fault {
    /// There is nothing.
    #[error("it has no stroke with any length; draw loops around the lobe, or its outline")]
    NoStrokes,
    /// One open stroke is no body.
    #[error("it has only one stroke, which is open; draw a second one, or close it")]
    OneOpenStroke,
    /// Profiles are two open strokes.
    #[error("`form` is turned, which needs two open strokes, its profiles; draw these, or leave out `form`")]
    NoProfiles,
    /// More than anybody draws.
    #[error("it has {count} strokes, more than the {most} of a lobe; divide it into several lobes")]
    TooManyStrokes {
        /// How many.
        count: usize,
        /// The limit.
        most: usize,
    },
    /// Nothing is enclosed.
    #[error("it is flat: its strokes enclose nothing; move them apart, or draw one that bulges")]
    Flat,
    /// All of it is below the ground.
    #[error("all of it is below the ground; move it up")]
    Buried,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_remark_is_a_sentence() {
        let remarks = [
            Remark::NoLength { stroke: 1 },
            Remark::Cut { stroke: 2 },
            Remark::LeftOut { stroke: 3 },
            Remark::Untangled,
            Remark::Uneven,
            Remark::LostOffsets { count: 4 },
            Remark::Clipped,
        ];
        assert!(remarks.iter().all(|remark| remark.to_string().len() > 20));
    }
}
