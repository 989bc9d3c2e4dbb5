//! Model files: [`mod@write`] makes them, [`read`] opens them again, and neither knows the other.
//!
//! | format | written | read |
//! | --- | --- | --- |
//! | OBJ with MTL | yes | yes |
//! | glTF 2.0, binary (GLB) | yes | yes |
//! | the plant as JSON | yes | no |
//!
//! Both share `gltf_extensions`, the material extensions of glTF, and [`textures`], where the bytes of pictures come from.

mod gltf_extensions;
pub mod read;
pub mod textures;
pub mod write;
