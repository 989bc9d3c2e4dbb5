//! Everything the artist can ask for, whichever button, key, gesture or menu says it.
//!
//! Panels and keys produce [`Action`]s and change nothing themselves; the application carries them out in one place.
//! So a panel is tested without a window, and a key and a button cannot drift apart.

use crate::plant::OrganKind;
use crate::sketch::Tool;
use serde_json::Value;
use std::path::PathBuf;

/// What the pen does on the canvas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CanvasTool {
    /// Draws a stroke of this kind.
    Draw(Tool),
    /// Removes what it touches: whole strokes, or only the part touched.
    Erase {
        /// Only the part touched.
        partial: bool,
    },
    /// Selects strokes with a lasso and changes them.
    Select,
    /// Moves the canvas.
    Pan,
}

/// One wish.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Start an empty drawing.
    New,
    /// Ask for a drawing and open it.
    Open,
    /// Open this drawing.
    OpenPath(PathBuf),
    /// Save under its name, asking for one where it has none.
    Save,
    /// Ask for a name and save.
    SaveAs,
    /// Show the export dialog.
    ShowExport,
    /// Take back the last change.
    Undo,
    /// Do again what was taken back.
    Redo,
    /// Take up a tool.
    SetTool(CanvasTool),
    /// Change what selected strokes are.
    SetPart(Tool),
    /// Remove the selected strokes.
    DeleteSelected,
    /// Copy the selected strokes beside themselves.
    DuplicateSelected,
    /// Select every stroke.
    SelectAll,
    /// Show the whole drawing.
    FitCanvas,
    /// Look at the plant from the front, as it was drawn, all of it.
    FrontView,
    /// Choose a species by name or file.
    SetSpecies(String),
    /// Choose the seed.
    SetSeed(u64),
    /// Set one parameter by its path; `None` returns to the default.
    SetParam {
        /// Dotted path.
        path: String,
        /// The new value.
        value: Option<Value>,
    },
    /// Set every parameter of the drawing at once, as a preset does.
    SetParams(serde_json::Map<String, Value>),
    /// Choose the texture of a kind of part: a built-in name or a picture file; `None` returns to the species' own.
    SetTexture {
        /// Which organs; `None` means branches.
        organ: Option<OrganKind>,
        /// Built-in name or file.
        texture: Option<String>,
    },
    /// Ask for a reference picture and put it under the drawing.
    OpenReference,
    /// Close the window, asking about unsaved changes.
    Quit,
}
