//! The brushes, as the panel over the plant shows them.

use crate::app::brush_settings::BrushSettings;
use crate::sketch::Tool;

/// Which brush is in hand, and how brushes are set.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BrushState {
    /// The brush in hand, one of those that [`Tool::is_brush`].
    pub tool: Option<Tool>,
    /// How brushes are set.
    pub settings: BrushSettings,
}
