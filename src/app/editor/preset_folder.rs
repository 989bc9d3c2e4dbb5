//! The artist's folder of presets, read again when something may have changed in it and not with every frame.

use crate::app::presets::{self, Listed, Preset, PresetError};
use std::path::{Path, PathBuf};

/// The folder, and what was found in it last.
pub(super) struct PresetFolder {
    path: PathBuf,
    listed: Vec<Listed>,
}

impl PresetFolder {
    pub(super) fn at(path: PathBuf) -> Self {
        let listed = presets::list(&path);
        Self { path, listed }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn listed(&self) -> &[Listed] {
        &self.listed
    }

    pub(super) fn save(&mut self, preset: &Preset) -> Result<(), PresetError> {
        let saved = presets::save(&self.path, preset);
        self.listed = presets::list(&self.path);
        saved.map(drop)
    }

    pub(super) fn remove(&mut self, preset: &Path) -> Result<(), PresetError> {
        let removed = presets::remove(preset);
        self.listed = presets::list(&self.path);
        removed
    }
}
