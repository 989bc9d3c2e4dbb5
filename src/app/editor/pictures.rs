//! Pictures that the artist chooses or pastes, and those that a drawing or a preset names.
//!
//! A chosen picture is read and decoded on a thread of its own, for a large one takes a second, and comes back as
//! [`Action::PictureRead`]. One that cannot be shown is refused then, so nothing broken gets into a drawing.

use super::Editor;
use crate::app::action::Action;
use crate::app::messages::{Localize as _, Msg};
use crate::app::panels::snapshot::{Notice, PathPurpose};
use crate::picture::{Picture, PictureError};
use crate::sketch::{Remark, TextureChoice, Textures};
use crate::species::textures::{self, key, kinds};
use std::path::{Path, PathBuf};
use std::sync::Arc;

impl Editor {
    /// Reads a picture file, to use it as `purpose` says.
    pub(super) fn read_picture(&mut self, purpose: PathPurpose, path: PathBuf) {
        let name = path.display().to_string();
        self.take_picture(purpose, name, move || Picture::read(&path));
    }

    /// Puts a pasted picture under the drawing.
    pub fn paste_picture(&mut self, bytes: Vec<u8>) {
        let name = self.prefs.messages().get(Msg::ReferencePasted).to_owned();
        self.take_picture(PathPurpose::Reference, name, move || Picture::decoded(bytes));
    }

    fn take_picture(
        &mut self,
        purpose: PathPurpose,
        name: String,
        read: impl FnOnce() -> Result<Picture, PictureError> + Send + 'static,
    ) {
        let (answers, wake) = (self.background.sender().clone(), Arc::clone(self.background.wake()));
        let work = move || {
            // A window that closed does not listen any more.
            let _ = answers.send(Action::PictureRead { purpose, name, picture: read() });
            wake();
        };
        if let Err(error) = std::thread::Builder::new().name("picture".into()).spawn(work) {
            self.notify_error(&error);
        }
    }

    /// Uses a picture that has been read.
    pub(super) fn use_picture(
        &mut self,
        purpose: PathPurpose,
        name: &str,
        picture: Result<Picture, PictureError>,
    ) {
        match (picture, purpose) {
            (Ok(picture), PathPurpose::Texture(organ)) => {
                let texture = Some(TextureChoice::Own(picture));
                self.perform(Action::SetTexture { organ, texture });
            }
            (Ok(picture), _) => self.lay(picture),
            (Err(error), _) => {
                let what = format!("{name}: {}", error.localize(self.prefs.messages()));
                self.notify(Notice { find: Some(purpose), ..Notice::error(what, "") });
            }
        }
    }

    /// Reads pictures that textures name into them, looked for from `folder`; what is missing can be chosen again.
    pub(super) fn take_in(&mut self, textures: &mut Textures, folder: &Path) {
        for warning in textures::take_in(textures, folder) {
            let find = match &warning.remark {
                Remark::PictureMissing { parts, .. } | Remark::PictureDamaged { parts, .. } => {
                    let organ = kinds().find(|organ| parts.iter().any(|part| part == key(*organ)));
                    organ.map(PathPurpose::Texture)
                }
                _ => None,
            };
            self.notify(Notice { find, ..Notice::warning(warning.localize(self.prefs.messages()), "") });
        }
    }
}

#[cfg(test)]
#[path = "pictures_tests.rs"]
mod tests;
