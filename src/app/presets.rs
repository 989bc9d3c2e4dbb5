//! Presets: the look of a plant under a name, one TOML file each in a folder.
//!
//! A preset is species, textures and parameters, not strokes and not the seed. Pictures of the artist's own are in it, as
//! in a drawing. File names are made of the preset's name and never overwrite another preset.
//!
//! Limits: files that are no presets are not listed; those above [`MAX_BYTES`] are refused. For the list only the lines
//! before the first section are read, where the name stands: pictures can be large.

use crate::atomic::{WriteError, write_atomically};
use crate::picture::Picture;
use crate::sketch::limits;
use crate::sketch::textures::{self, ChoiceText, Textures};
use crate::{input, quote};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fs;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Largest preset that is read, bytes: room for all pictures that a drawing may have as base64.
pub const MAX_BYTES: u64 = (limits::MAX_TEXTURE_BYTES as u64).div_ceil(3) * 4 + (1 << 20);
/// Most bytes before a preset's first section.
const MAX_HEAD_BYTES: u64 = 64 << 10;
/// Longest name, characters.
pub const MAX_NAME: usize = 60;
const EXTENSION: &str = "toml";

/// The look of a plant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Preset {
    /// What the artist calls it.
    pub name: String,
    /// Built-in species or species file; `None` leaves that of the drawing.
    pub species: Option<String>,
    /// Textures by kind of part.
    pub textures: Textures,
    /// Parameters by path.
    pub params: Map<String, Value>,
}

/// A preset as its file has it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PresetText {
    name: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    species: Option<String>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    textures: BTreeMap<String, ChoiceText>,
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    params: Map<String, Value>,
    /// Pictures that textures name, in base64.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pictures: BTreeMap<String, String>,
}

/// What stands before the first section.
#[derive(Deserialize)]
struct Head {
    name: String,
}

impl Preset {
    fn text(&self, name: String) -> PresetText {
        let Self { name: _, species, textures, params } = self.clone();
        let (textures, pictures) = textures::named(&textures);
        let pictures = pictures.into_iter().map(|(name, picture)| (name, picture.to_base64())).collect();
        PresetText { name, species, textures, params, pictures }
    }

    /// # Errors
    /// Pictures that are damaged or missing, in words.
    fn of_text(text: PresetText) -> Result<Self, String> {
        let PresetText { name, species, textures, params, pictures } = text;
        let read = |(name, text): (String, String)| match Picture::from_base64(&text) {
            Ok(picture) => Ok((name, picture)),
            Err(fault) => Err(fault.to_string()),
        };
        let pictures = pictures.into_iter().map(read).collect::<Result<BTreeMap<_, _>, _>>()?;
        let textures = textures::resolved(textures, |name| pictures.get(name).cloned())?;
        Ok(Self { name, species, textures, params })
    }
}

/// A preset in the folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listed {
    /// What the artist calls it.
    pub name: String,
    /// Its file.
    pub path: PathBuf,
}

/// A preset that cannot be used or kept.
#[derive(Debug, Error)]
pub enum PresetError {
    /// No letters in the name.
    #[error("a preset needs a name; write one and save again")]
    NoName,
    /// The file cannot be read.
    #[error("cannot read the preset {}: {reason}; save it again or delete it", .path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The file cannot be removed.
    #[error("cannot delete the preset {}: {source}", .path.display())]
    Remove {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
}

/// The presets in a folder by name; a folder that does not exist holds none.
pub fn list(folder: &Path) -> Vec<Listed> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let presets = entries.filter(|path| path.extension().is_some_and(|e| e == EXTENSION));
    let mut out: Vec<Listed> =
        presets.filter_map(|path| Some(Listed { name: name_of(&path)?, path })).collect();
    out.sort_by(|a, b| (a.name.to_lowercase(), &a.path).cmp(&(b.name.to_lowercase(), &b.path)));
    out
}

/// The name of the preset in a file, if there is one.
fn name_of(path: &Path) -> Option<String> {
    let mut head = Vec::new();
    let file =
        fs::metadata(path).ok().filter(fs::Metadata::is_file).and_then(|_| fs::File::open(path).ok())?;
    file.take(MAX_HEAD_BYTES).read_to_end(&mut head).ok()?;
    let head = String::from_utf8_lossy(&head);
    let end = head.find("\n[").unwrap_or(head.len());
    toml::from_str(&head[..end]).ok().map(|Head { name }| name)
}

/// Reads a preset.
///
/// # Errors
/// A file that is missing, too large or no preset.
pub fn load(path: &Path) -> Result<Preset, PresetError> {
    let unreadable = |reason: String| PresetError::Unreadable { path: path.to_owned(), reason };
    let bytes = input::read(path, MAX_BYTES).map_err(|e| unreadable(e.to_string()))?;
    let text: PresetText = toml::from_slice(&bytes).map_err(|e| unreadable(quote::message(e.message())))?;
    Preset::of_text(text).map_err(unreadable)
}

/// Keeps a preset in a folder and returns its file. A preset of the same name is replaced.
///
/// # Errors
/// A name without letters or digits, or a folder that cannot be written.
pub fn save(folder: &Path, preset: &Preset) -> Result<PathBuf, PresetError> {
    let name: String = preset.name.trim().chars().take(MAX_NAME).collect();
    let stem = file_stem(&name).ok_or(PresetError::NoName)?;
    let path = free_path(folder, &stem, &name);
    let io = |source| WriteError::Io { path: path.clone(), source };
    fs::create_dir_all(folder).map_err(io)?;
    let text = toml::to_string_pretty(&preset.text(name));
    let text = text.map_err(|e| io(std::io::Error::other(e)))?;
    write_atomically(&path, text.as_bytes())?;
    Ok(path)
}

/// Removes a preset.
///
/// # Errors
/// What the system says.
pub fn remove(path: &Path) -> Result<(), PresetError> {
    fs::remove_file(path).map_err(|source| PresetError::Remove { path: path.to_owned(), source })
}

/// Letters and digits of any script, everything else a hyphen, so that no name leaves the folder.
fn file_stem(name: &str) -> Option<String> {
    let letter = |c: char| if c.is_alphanumeric() { c } else { '-' };
    let stem: String = name.to_lowercase().chars().map(letter).collect();
    let stem = stem.trim_matches('-');
    (!stem.is_empty()).then(|| stem.to_owned())
}

/// The file of this name's preset, or the first free one beside those of other names.
fn free_path(folder: &Path, stem: &str, name: &str) -> PathBuf {
    let ends = std::iter::once(String::new()).chain((2..).map(|n| format!("-{n}")));
    let paths = ends.map(|end| folder.join(format!("{stem}{end}.{EXTENSION}")));
    let usable = |path: &PathBuf| !path.exists() || name_of(path).is_some_and(|known| known == name);
    let mut paths = paths.filter(usable);
    paths.next().unwrap_or_else(|| folder.join(stem).with_extension(EXTENSION))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::TextureChoice;

    fn own() -> TextureChoice {
        let bytes = include_bytes!("../../tests/fixtures/reference/small.png");
        TextureChoice::Own(Picture::new(&bytes[..]).unwrap())
    }

    fn preset(name: &str) -> Preset {
        let params = serde_json::json!({"depth.world.height": 2.5, "depth.cone.flip": true});
        Preset {
            name: name.to_owned(),
            species: Some("rose".into()),
            textures: BTreeMap::from([
                ("petal".into(), TextureChoice::Named("petal_soft.png".into())),
                ("leaf".into(), own()),
                ("branch".into(), own()),
            ]),
            params: params.as_object().unwrap().clone(),
        }
    }

    #[test]
    fn presets_come_back_as_they_were_saved() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path().join("presets");
        assert!(list(&folder).is_empty());
        let path = save(&folder, &preset("Abendrot 夕阳")).unwrap();
        assert_eq!(load(&path).unwrap(), preset("Abendrot 夕阳"));
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(text.matches("iVBORw0K").count(), 1, "a picture of two parts stands once");
        assert_eq!(list(&folder), [Listed { name: "Abendrot 夕阳".into(), path: path.clone() }]);
        remove(&path).unwrap();
        assert!(list(&folder).is_empty() && remove(&path).is_err());
    }

    #[test]
    fn no_name_leaves_the_folder_or_takes_anothers_file() {
        let folder = tempfile::tempdir().unwrap();
        let first = save(folder.path(), &preset("../../etc/x")).unwrap();
        assert_eq!(first.parent(), Some(folder.path()));
        let second = save(folder.path(), &preset("..-..-etc-x")).unwrap();
        assert_ne!(first, second);
        assert_eq!(save(folder.path(), &preset("../../etc/x")).unwrap(), first);
        assert_eq!(list(folder.path()).len(), 2);
        assert!(matches!(save(folder.path(), &preset(" . ")), Err(PresetError::NoName)));
    }

    #[test]
    fn other_files_are_no_presets() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("note.toml"), "hello = 1").unwrap();
        fs::write(folder.path().join("picture.png"), [0xff]).unwrap();
        assert!(list(folder.path()).is_empty());
        assert!(load(&folder.path().join("note.toml")).unwrap_err().to_string().contains("note.toml"));
    }
}
