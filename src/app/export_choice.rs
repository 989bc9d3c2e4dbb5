//! What the export dialog says; kept with the settings.

use crate::pipeline::LevelSet;
use crate::plant::{OrganClass, OrganKind};
use serde::{Deserialize, Serialize};

/// What is exported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ExportFormat {
    /// Wavefront OBJ with MTL and textures.
    Obj,
    /// Binary glTF.
    #[default]
    Glb,
    /// The drawing as SVG.
    Svg,
    /// A picture of the plant.
    Png,
}

impl ExportFormat {
    /// Every format, in the order in which the dialog lists them.
    pub const ALL: [ExportFormat; 4] = [Self::Obj, Self::Glb, Self::Svg, Self::Png];

    /// The files' extension.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Glb => "glb",
            Self::Svg => "svg",
            Self::Png => "png",
        }
    }

    /// Whether it holds the plant's surfaces.
    pub fn is_model(self) -> bool {
        matches!(self, Self::Obj | Self::Glb)
    }
}

/// What the export dialog says.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct ExportChoice {
    /// File format.
    pub format: ExportFormat,
    /// With branches.
    pub branches: bool,
    /// With leaves.
    pub leaves: bool,
    /// With petals, sepals and flower centres.
    pub flowers: bool,
    /// With pot, thorns and fruits.
    pub extras: bool,
    /// With the garden that is painted around it.
    pub garden: bool,
    /// With textures.
    pub textures: bool,
    /// Leaves of one shape as copies of a mesh, in formats that have a word for it.
    pub copies: bool,
    /// Levels of detail besides the plant, in formats that have a word for them.
    pub levels: Option<LevelSet>,
    /// With them capsules around the wood, by which game engines know what is bumped into.
    pub capsules: bool,
    /// Picture without ground.
    pub transparent: bool,
    /// Width of the picture in pixels.
    pub width: u32,
    /// Height of the picture in pixels.
    pub height: u32,
    /// Number of pictures all around; 1 is the view as it stands.
    pub frames: u32,
}

impl Default for ExportChoice {
    fn default() -> Self {
        Self {
            format: ExportFormat::default(),
            branches: true,
            leaves: true,
            flowers: true,
            extras: true,
            garden: true,
            textures: true,
            copies: false,
            levels: None,
            capsules: false,
            transparent: false,
            width: 1600,
            height: 1200,
            frames: 1,
        }
    }
}

impl ExportChoice {
    /// Whether nothing would be exported.
    pub fn is_empty(&self) -> bool {
        self.format.is_model() && !(self.branches || self.leaves || self.flowers || self.extras)
    }

    /// The levels that are exported; none in other formats than GLB.
    pub fn level_set(&self) -> Option<LevelSet> {
        self.levels.filter(|_| self.format == ExportFormat::Glb)
    }

    /// The same with sizes that a picture can have.
    pub fn sane(self) -> Self {
        let side = |s: u32| s.clamp(16, 8192);
        Self { width: side(self.width), height: side(self.height), frames: self.frames.clamp(1, 360), ..self }
    }

    /// Whether an organ belongs to the export.
    pub fn has(&self, organ: OrganKind) -> bool {
        match organ.class() {
            OrganClass::Foliage => self.leaves,
            OrganClass::Flower => self.flowers,
            OrganClass::Extra => self.extras,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_export_of_nothing_is_seen() {
        let nothing = ExportChoice {
            branches: false,
            leaves: false,
            flowers: false,
            extras: false,
            ..Default::default()
        };
        assert!(nothing.is_empty());
        assert!(!ExportChoice { format: ExportFormat::Png, ..nothing }.is_empty());
        assert!(!ExportChoice::default().is_empty());
    }
}
