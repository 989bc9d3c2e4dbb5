//! The files of textures, for the graphics card and for exporters.

use crate::plant::Texture;
use std::borrow::Cow;
use std::error::Error;

/// The bytes of a texture's file: the program's own or the artist's.
pub fn texture(texture: &Texture) -> Result<Cow<'static, [u8]>, Box<dyn Error + Send + Sync>> {
    Ok(crate::formats::textures::fetch(texture, &built_in_texture)?)
}

/// The program's own textures, for the exporters.
pub(super) fn built_in_texture(name: &str) -> Option<Cow<'static, [u8]>> {
    crate::species::builtin_texture(name).map(Cow::Borrowed)
}
