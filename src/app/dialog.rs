//! Dialogs above everything, and what they ask for.

use crate::plant::OrganKind;
use std::path::PathBuf;

/// A dialog above everything.
#[derive(Clone, Debug, PartialEq)]
pub enum Dialog {
    /// Save before going on?
    Unsaved,
    /// Drawings found again.
    Recovery(Vec<Recovered>),
    /// Format, parts and textures of an export.
    Export,
    /// A file, where the system has no dialog of its own.
    Path(PathRequest),
    /// Replace the file that the system's dialog did not ask about?
    Replace {
        /// What is written.
        purpose: PathPurpose,
        /// Over which file.
        path: PathBuf,
    },
    /// The species of a plant beside the drawn one: of a new one, or of that at this place in the list.
    PlantSpecies(Option<usize>),
    /// The species of plants that are painted in the garden.
    GardenSpecies,
    /// Pen and tablet.
    Pen,
    /// What the program is, first steps and keys.
    About,
}

impl Dialog {
    /// Its name in the log.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Unsaved => "unsaved",
            Self::Recovery(_) => "recovery",
            Self::Export => "export",
            Self::Path(_) => "path",
            Self::Replace { .. } => "replace",
            Self::PlantSpecies(_) => "plant species",
            Self::GardenSpecies => "garden species",
            Self::Pen => "pen",
            Self::About => "about",
        }
    }
}

/// A drawing found again.
#[derive(Clone, Debug, PartialEq)]
pub struct Recovered {
    /// The recovery file.
    pub path: PathBuf,
    /// The drawing's name.
    pub name: String,
    /// Number of strokes.
    pub strokes: usize,
    /// When it was drawn, as the artist's locale says it.
    pub when: String,
    /// A picture of it.
    pub thumbnail: Option<egui::TextureId>,
}

/// What a path is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PathPurpose {
    /// Open a drawing.
    OpenDrawing,
    /// Save the drawing.
    SaveDrawing,
    /// Plant the plant of a drawing in the garden.
    GardenDrawing,
    /// Export the plant or the drawing.
    Export,
    /// A texture; `None` means branches.
    Texture(Option<OrganKind>),
    /// A photograph from which a texture is cut; `None` means bark.
    Photograph(Option<OrganKind>),
    /// A species file.
    Species,
    /// A reference picture.
    Reference,
}

impl PathPurpose {
    /// Under what the folder is remembered in which such files were chosen last.
    pub fn shelf(self) -> &'static str {
        match self {
            Self::OpenDrawing | Self::SaveDrawing | Self::GardenDrawing => "drawings",
            Self::Export => "exports",
            Self::Texture(_) | Self::Photograph(_) | Self::Reference => "pictures",
            Self::Species => "species",
        }
    }
}

/// A question for a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathRequest {
    /// What for.
    pub purpose: PathPurpose,
    /// Folder to begin in.
    pub folder: PathBuf,
    /// Name to begin with, for files that are written.
    pub name: String,
    /// Extensions without dot that are shown, in lower case; empty shows all.
    pub extensions: Vec<&'static str>,
}
