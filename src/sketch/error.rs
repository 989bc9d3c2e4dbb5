//! Why a drawing could not be read.
//!
//! A [`SketchError`] reads `FILE: PLACE: what is wrong; what to do`. What is wrong is a [`Fault`], where is a [`Place`].

use super::limits;
use super::reference::ReferenceError;
use crate::picture::PictureError;
use std::fmt;
use thiserror::Error;

/// A drawing that cannot be read: what is wrong, where, and what to do.
#[derive(Debug, Error)]
#[error("{file}: {place}{fault}")]
pub struct SketchError {
    /// The file, as the user named it.
    pub file: String,
    /// Where in the file.
    pub place: Box<Place>,
    /// What is wrong.
    pub fault: Fault,
}

/// Where in a drawing file; whatever is unknown stays `None`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Position of the stroke in the file, from 1.
    pub stroke: Option<usize>,
    /// The stroke's id (JSON) or the element's id (SVG).
    pub id: Option<String>,
    /// Position of the sample in the stroke, from 1.
    pub point: Option<usize>,
    /// Line from 1 and column from 1, counted in characters for SVG and in bytes for JSON.
    pub line_column: Option<(usize, usize)>,
}

impl Place {
    /// A place known by line and column only.
    pub fn at(line: usize, column: usize) -> Self {
        Self { line_column: Some((line, column)), ..Self::default() }
    }

    fn is_nowhere(&self) -> bool {
        *self == Self::default()
    }
}

impl fmt::Display for Place {
    /// Comma-separated, closed by `: `; nothing at all when nothing is known.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_nowhere() {
            return Ok(());
        }
        let id = self.id.as_deref().map(|id| format!("`{id}`"));
        let stroke = match (self.stroke, id) {
            (Some(n), Some(id)) => Some(format!("stroke {n} (id {id})")),
            (Some(n), None) => Some(format!("stroke {n}")),
            (None, Some(id)) => Some(format!("element {id}")),
            (None, None) => None,
        };
        let point = self.point.map(|n| format!("point {n}"));
        let line = self.line_column.map(|(line, column)| format!("line {line}, column {column}"));
        let known: Vec<String> = [stroke, point, line].into_iter().flatten().collect();
        write!(f, "{}: ", known.join(", "))
    }
}

/// What is wrong with a drawing file, and the remedy.
#[derive(Debug, Error)]
pub enum Fault {
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}; check the name and the permissions")]
    Io(#[from] std::io::Error),
    /// More than [`limits::MAX_FILE_BYTES`].
    #[error("is larger than {} MiB; a drawing this big holds something else than strokes", limits::MAX_FILE_BYTES >> 20)]
    FileTooLarge,
    /// No content.
    #[error("is empty; open a drawing that was saved by Penstemon (.penstemon) or as SVG")]
    Empty,
    /// Neither JSON nor SVG.
    #[error("is not a drawing ({found}); open a .penstemon file or a plain SVG")]
    NotADrawing {
        /// What it looks like instead.
        found: &'static str,
    },
    /// Bytes that are no text.
    #[error(
        "byte {offset} is not valid UTF-8; the file is damaged or was saved in another encoding, save it as UTF-8"
    )]
    NotUtf8 {
        /// Offset of the first bad byte, from 0.
        offset: usize,
    },
    /// The text stops too early.
    #[error("the file ends too early; it was cut off while it was saved or copied, restore it from a backup")]
    Truncated,
    /// JSON of some other program.
    #[error("the `format` is {found}, not \"penstemon-sketch\"; this is not a drawing of this program")]
    WrongFormat {
        /// The `format` field in quotes, or that it is missing.
        found: String,
    },
    /// A version that this program does not know.
    #[error("the file has version {found}, this program reads versions 1 to {newest}; {}", version_remedy(*.found, *.newest))]
    WrongVersion {
        /// The `version` field.
        found: f64,
        /// The newest version that this program knows.
        newest: u32,
    },
    /// Text that is not JSON or not XML, or a value of the wrong kind.
    #[error("{0}")]
    Malformed(String),
    /// Nested deeper than any drawing.
    #[error("values are nested too deeply; a drawing nests strokes, points and numbers, nothing deeper")]
    TooDeep,
    /// A number that overflows, or NaN.
    #[error("`{found}` is no finite number; every coordinate must be one, draw or export the stroke again")]
    NotFinite {
        /// The number as written or computed.
        found: String,
    },
    /// A coordinate beyond [`limits::MAX_COORDINATE`].
    #[error(
        "coordinate {found} lies beyond ±{:e} pixels; move or scale the drawing toward the origin",
        limits::MAX_COORDINATE
    )]
    CoordinateTooLarge {
        /// The coordinate in canvas pixels.
        found: String,
    },
    /// Two strokes of one name.
    #[error("id {id} already names stroke {first}; give every stroke its own id, or leave ids out")]
    DuplicateId {
        /// The id.
        id: u64,
        /// Position of the stroke that had it first, from 1.
        first: usize,
    },
    /// A tool that does not exist.
    #[error("unknown tool `{name}`; the tools are {}", tool_names())]
    UnknownTool {
        /// The name as written.
        name: String,
    },
    /// A picture for textures.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A picture that cannot lie under the drawing.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// Nothing to build from.
    #[error("there is no stroke in the drawing; draw at least one line")]
    NoStrokes,
    /// An SVG in which nothing is to be seen.
    #[error(
        "no path or shape of the SVG can be seen: all {count} have neither stroke nor fill; give them a stroke"
    )]
    NothingPainted {
        /// How many there are.
        count: usize,
    },
    /// Strokes, but every one of them stands still.
    #[error("every stroke is a mere dot; draw at least one line")]
    OnlyDots,
    /// More than a limit of [`limits`].
    #[error("the drawing has more than {limit} {what}; split it or thin it out")]
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// The limit.
        limit: usize,
    },
}

impl Fault {
    /// The error for this fault somewhere in `file`.
    pub fn at(self, place: Place, file: &str) -> SketchError {
        SketchError { file: file.to_owned(), place: Box::new(place), fault: self }
    }
}

fn version_remedy(found: f64, newest: u32) -> &'static str {
    if found > f64::from(newest) {
        "it was saved by a newer Penstemon, install that one"
    } else {
        "no Penstemon ever wrote that version, set it to the newest of these"
    }
}

/// The names of all tools, as a sentence lists them.
fn tool_names() -> String {
    super::Tool::ALL.map(super::Tool::name).join(", ")
}
