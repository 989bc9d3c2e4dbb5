//! What keeps a picture from being made.

use thiserror::Error;

/// A picture that could not be made.
#[derive(Debug, Error)]
pub enum RenderError {
    /// The machine has neither a graphics driver nor a software one.
    #[error(
        "no graphics driver was found; install a software one (Debian, Ubuntu: `apt install mesa-vulkan-drivers`, \
         Fedora: `dnf install mesa-vulkan-drivers`, Arch: `pacman -S vulkan-swrast`) and try again [{reason}]"
    )]
    NoAdapter {
        /// What was looked for.
        reason: String,
    },
    /// The driver is there but would not work for us.
    #[error("the graphics driver {adapter} refused to start: {reason}; a newer driver may help")]
    Device {
        /// The driver's name.
        adapter: String,
        /// Its reason.
        reason: String,
    },
    /// Width or height is zero or more than can be drawn.
    #[error(
        "a picture of {width}×{height} pixels cannot be made: each side must be 1 to {limit}, and all pixels at most {pixels}"
    )]
    Size {
        /// Asked width in pixels.
        width: u32,
        /// Asked height in pixels.
        height: u32,
        /// Longest possible side in pixels.
        limit: u32,
        /// Most pixels.
        pixels: u32,
    },
    /// There is nothing to draw.
    #[error("there is nothing to draw: {what} is empty")]
    Empty {
        /// The empty thing.
        what: &'static str,
    },
    /// The model contradicts itself.
    #[error("part `{part}` of the model cannot be drawn: {reason}")]
    Model {
        /// Name of the part.
        part: String,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A material's picture is missing or unreadable.
    #[error("texture {name} cannot be used: {reason}")]
    Texture {
        /// File name or built-in name.
        name: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The model or the picture needs more memory than there is.
    #[error(
        "the graphics driver {adapter} is out of memory; a model of fewer triangles (a younger plant, fewer leaves) or a \
         smaller picture may fit"
    )]
    OutOfMemory {
        /// The driver's name.
        adapter: String,
    },
    /// A part of the picture took too long.
    #[error(
        "the graphics driver {adapter} was not done after {seconds} s; a model of fewer triangles (a younger plant, fewer \
         leaves) or a smaller picture is drawn faster"
    )]
    TooSlow {
        /// The driver's name.
        adapter: String,
        /// How long it was waited for.
        seconds: u64,
    },
    /// The driver failed while drawing: a lost device, a refused command.
    #[error("the graphics driver {adapter} failed: {reason}")]
    Gpu {
        /// The driver's name.
        adapter: String,
        /// What it said.
        reason: String,
    },
    /// The picture could not be encoded.
    #[error("the picture could not be encoded as PNG: {0}")]
    Png(#[from] png::EncodingError),
}

impl RenderError {
    /// A part that contradicts itself.
    pub(super) fn model(part: &str, reason: &'static str) -> Self {
        Self::Model { part: part.to_owned(), reason }
    }
}
