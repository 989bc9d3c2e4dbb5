//! What happens on the disk beside the open drawing itself.

use super::export::Exports;
use super::lost_drawings::LostDrawings;
use super::preset_folder::PresetFolder;
use super::saver::Saver;

/// Everything that the editor reads and writes but the open drawing and the settings.
pub(super) struct Disk {
    pub(super) lost: LostDrawings,
    pub(super) saver: Saver,
    pub(super) presets: PresetFolder,
    pub(super) exports: Exports,
}
