//! Keys, dials and rings of tablets that are read directly: what the artist lets them do.
//!
//! Uses are kept for each tablet by name, with the other settings of its pen.

use serde::{Deserialize, Serialize};

/// Keys that can be given a use; those of tablets with more come first to last.
pub const KEYS: usize = 12;

/// What a key does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum KeyUse {
    /// Nothing.
    #[default]
    Nothing,
    /// Takes the last change back.
    Undo,
    /// Does again what was taken back.
    Redo,
    /// Shows the paper larger.
    ZoomIn,
    /// Shows the paper smaller.
    ZoomOut,
    /// Shows the whole drawing.
    Fit,
    /// Takes up the tool that classifies strokes by itself.
    Draw,
    /// Takes up the eraser of whole strokes.
    Erase,
    /// Takes up the eraser of what is touched.
    ErasePartly,
    /// Takes up the lasso.
    Select,
    /// Takes up the tool that moves the paper.
    Pan,
    /// Saves the drawing.
    Save,
}

impl KeyUse {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Nothing,
        Self::Undo,
        Self::Redo,
        Self::ZoomIn,
        Self::ZoomOut,
        Self::Fit,
        Self::Draw,
        Self::Erase,
        Self::ErasePartly,
        Self::Select,
        Self::Pan,
        Self::Save,
    ];
}

/// What dials and rings do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum WheelUse {
    /// Shows the paper larger and smaller.
    #[default]
    Zoom,
    /// Takes changes back and does them again.
    History,
    /// Nothing.
    Nothing,
}

/// What the artist lets the keys and wheels of a tablet do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TabletKeys {
    /// Each key, the first of the tablet first.
    pub keys: [KeyUse; KEYS],
    /// Dials and rings.
    pub wheel: WheelUse,
}

impl Default for TabletKeys {
    fn default() -> Self {
        use KeyUse::{Draw, Erase, Fit, Nothing, Redo, Select, Undo, ZoomIn, ZoomOut};
        let keys =
            [Undo, Redo, Draw, Erase, ZoomIn, ZoomOut, Select, Fit, Nothing, Nothing, Nothing, Nothing];
        Self { keys, wheel: WheelUse::Zoom }
    }
}
