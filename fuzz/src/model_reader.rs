//! Any bytes as a model file: the readers of OBJ and GLB and the judge of meshes must come to an end without a panic, and so must
//! the search for faces that cross.
//!
//! The first byte chooses the format (even: OBJ, odd: GLB), the rest is the file.

use penstemon::formats::read::{ReadFormat, from_bytes};
use penstemon::model::crossing::crossing_faces;
use penstemon::model::quality::judge;

/// Fails where what the head of this file says does not hold of these bytes.
pub fn check(bytes: &[u8]) {
    let Some((choice, file)) = bytes.split_first() else { return };
    let format = if choice % 2 == 0 { ReadFormat::Obj } else { ReadFormat::Glb };
    for surface in from_bytes(format, file).unwrap_or_default() {
        judge(&surface.mesh, surface.has);
        crossing_faces(&surface.mesh);
    }
}
