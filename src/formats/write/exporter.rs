//! What a format that models are written in is: one trait, which each format's file implements.

use super::error::ExportError;
use super::scene::Scene;
use std::borrow::Cow;

/// An encoded model.
#[derive(Debug)]
pub struct Encoded {
    /// The file itself.
    pub bytes: Vec<u8>,
    /// Files that it refers to, by name; they belong into the same folder.
    pub companions: Vec<(String, Cow<'static, [u8]>)>,
}

/// What a format has words for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Takes {
    /// The plant itself, no surfaces.
    Plant,
    /// Surfaces.
    Triangles,
    /// Surfaces, and copies of them.
    Copies,
}

/// A file format that models are written in.
pub trait Exporter: Sync {
    /// The extension that chooses it, in lower case.
    fn extension(&self) -> &'static str;

    /// What of a scene it writes.
    fn takes(&self) -> Takes;

    /// The scene in this format.
    ///
    /// # Errors
    /// A scene that the format cannot hold.
    fn encode(&self, scene: &Scene<'_>) -> Result<Encoded, ExportError>;
}
