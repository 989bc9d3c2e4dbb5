//! Any bytes as a model file: the readers of OBJ and GLB and the judge of meshes must come to an end without a panic, and so must
//! the search for faces that cross.
//!
//! The first byte chooses the format (even: OBJ, odd: GLB), the rest is the file.

#![no_main]

use libfuzzer_sys::fuzz_target;
use penstemon::formats::read::{ReadFormat, from_bytes};
use penstemon::model::crossing::crossing_faces;
use penstemon::model::quality::judge;

fuzz_target!(|bytes: &[u8]| {
    let Some((choice, file)) = bytes.split_first() else { return };
    let format = if choice % 2 == 0 { ReadFormat::Obj } else { ReadFormat::Glb };
    for surface in from_bytes(format, file).unwrap_or_default() {
        judge(&surface.mesh, surface.has);
        crossing_faces(&surface.mesh);
    }
});
