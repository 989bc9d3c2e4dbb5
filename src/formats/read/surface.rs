//! A surface as a model file defines it.

use crate::model::Mesh;
use crate::model::quality::Attributes;

/// A connected space of points: one mesh of a GLB file, everything in an OBJ file.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The mesh's name, empty for an OBJ file.
    pub name: String,
    /// The surface; indices are as the file says and may be out of range.
    pub mesh: Mesh,
    /// What the file gives for every vertex; the rest is zero in `mesh`.
    pub has: Attributes,
    /// How often the file shows it; 1 for what it does not show.
    pub copies: usize,
}
