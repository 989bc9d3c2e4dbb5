//! Textures that are cut out of photographs, on their way from the thread that does it.

use crate::photo::{PhotoError, PhotoRemark};
use crate::picture::{Picture, PictureError};
use thiserror::Error;

/// A texture from a photograph.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureCut {
    /// The texture.
    pub picture: Picture,
    /// What was odd about the photograph.
    pub remarks: Vec<PhotoRemark>,
}

/// Why there is none.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CutError {
    /// The picture itself.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// What is on it.
    #[error(transparent)]
    Photo(#[from] PhotoError),
}
