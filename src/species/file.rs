//! Reading species files: TOML, every key known, every number in range, every name and picture there.
//!
//! A texture is looked for beside the species file first, then among the built-in ones.

use super::builtin_textures::{builtin_texture, texture_names};
use super::looks::{FlowerLook, Species};
use super::places::Places;
use crate::picture::{Picture, PictureError};
use crate::plant::{PlantPart, Texture};
use crate::suggest::{did_you_mean, nearest};
use crate::{input, quote};
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Largest species file that is read, bytes.
pub const MAX_BYTES: u64 = 1 << 20;

/// A species that cannot be used.
#[derive(Debug, Error)]
pub enum SpeciesError {
    /// No built-in species has that name.
    #[error(
        "there is no species `{name}`{}; built in are {known}; for one of your own give the path of its .toml file",
        did_you_mean(.nearest)
    )]
    Unknown {
        /// The name as it was given.
        name: String,
        /// The built-in name that looks most like it.
        nearest: Option<String>,
        /// All built-in names.
        known: String,
    },
    /// The file cannot be read.
    #[error("cannot read the species file {}: {source}", .file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The file is too large to be a species.
    #[error("the species file {} is larger than {MAX_BYTES} bytes; is it really a species?", .file.display())]
    TooLarge {
        /// The file.
        file: PathBuf,
    },
    /// Not TOML, an unknown key, a wrong type or a number out of range.
    #[error("{file}, line {line}, `{text}`: {reason}")]
    Invalid {
        /// The file.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// What stands in that line.
        text: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A material's name would be ambiguous in exported files.
    #[error("{file}, line {line}: the material name `{name}` may hold only letters, digits and _; rename it")]
    MaterialName {
        /// The file.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// The refused name.
        name: String,
    },
    /// A section refers to a material that is not there.
    #[error("{file}, line {line}: {key}: there is no material `{name}`{}; add a section [materials.{name}]", did_you_mean(.nearest))]
    NoMaterial {
        /// The file.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// The key that refers to it.
        key: String,
        /// The missing material.
        name: String,
        /// The material that looks most like it.
        nearest: Option<String>,
    },
    /// A material's texture is neither beside the file nor built in.
    #[error(
        "{file}, line {line}: materials.{material}.texture: `{texture}` is neither a file beside the species file nor a built-in \
         texture{}; write the path of a PNG or JPEG relative to the species file",
        did_you_mean(.nearest)
    )]
    NoTexture {
        /// The species file.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// The material.
        material: String,
        /// The missing texture.
        texture: String,
        /// The built-in texture that looks most like it.
        nearest: Option<String>,
    },
    /// A plant has no such part.
    #[error("there is no part `{name}`{}; parts are {}", did_you_mean(.nearest), part_names())]
    NoPart {
        /// The name as it was given.
        name: String,
        /// The part that looks most like it.
        nearest: Option<String>,
    },
    /// The artist's picture for a part is missing or cannot be shown.
    #[error("{} for `{part}`: {fault}", .file.display())]
    OwnPicture {
        /// The part.
        part: &'static str,
        /// The picture.
        file: PathBuf,
        /// What is wrong with it.
        fault: PictureError,
    },
}

fn part_names() -> String {
    PlantPart::all().map(PlantPart::name).collect::<Vec<_>>().join(", ")
}

impl Species {
    /// Reads a species file.
    ///
    /// # Errors
    /// An unreadable or too large file, invalid TOML, an unknown key, a value out of range, a material or texture
    /// that is not there.
    pub fn read(path: &Path) -> Result<Self, SpeciesError> {
        let file = || path.to_owned();
        let bytes = input::read(path, MAX_BYTES).map_err(|source| match source.kind() {
            io::ErrorKind::FileTooLarge => SpeciesError::TooLarge { file: file() },
            _ => SpeciesError::Unreadable { file: file(), source },
        })?;
        let no_text = |error| SpeciesError::Unreadable { file: file(), source: io::Error::other(error) };
        let text = String::from_utf8(bytes).map_err(no_text)?;
        parse(&text, &path.display().to_string(), Some(path.parent().unwrap_or(Path::new(""))))
    }

    /// Reads a species from text; `name` stands for the file in messages. Its textures must be built-in ones.
    ///
    /// # Errors
    /// As [`Species::read`], less the system's own.
    pub fn from_toml(text: &str, name: &str) -> Result<Self, SpeciesError> {
        parse(text, name, None)
    }

    /// Gives every material of a part the artist's own picture.
    ///
    /// # Errors
    /// A part that no plant has (the message lists all, see [`PlantPart`]), or a picture that is missing or cannot be shown.
    pub fn set_texture(&mut self, part: &str, picture: &Path) -> Result<(), SpeciesError> {
        let part = PlantPart::from_name(part).map_err(|nearest| SpeciesError::NoPart {
            name: quote::name(part),
            nearest: nearest.map(str::to_owned),
        })?;
        let refused = |fault| SpeciesError::OwnPicture { part: part.name(), file: picture.to_owned(), fault };
        self.pictures.insert(part, Picture::read(picture).map_err(refused)?);
        Ok(())
    }

    /// The pictures beside its file that the species names.
    pub fn picture_files(&self) -> impl Iterator<Item = &Path> {
        let textures = self.materials.values().filter_map(|look| look.texture.as_ref());
        textures.filter_map(|texture| match texture {
            Texture::File(path) => Some(path.as_path()),
            Texture::BuiltIn(_) | Texture::Own(_) => None,
        })
    }

    /// Every material name that a section refers to, with the key that does.
    fn references(&self) -> Vec<(String, &str)> {
        let mut out: Vec<(String, &str)> = vec![("stem.material".into(), &self.stem.material)];
        out.extend(self.stem.twig.iter().map(|m| ("stem.twig".into(), m.as_str())));
        out.extend(self.leaf.materials.0.iter().map(|m| ("leaf.materials".into(), m.as_str())));
        out.extend(self.leaf.young.iter().map(|m| ("leaf.young".into(), m.as_str())));
        out.extend(self.leaf.autumn.iter().map(|m| ("leaf.autumn".into(), m.as_str())));
        let drawn = self.leaf.drawn.iter().flat_map(|names| &names.0);
        out.extend(drawn.map(|m| ("leaf.drawn".into(), m.as_str())));
        out.extend(self.fruit.iter().map(|fruit| ("fruit.material".into(), fruit.material.as_str())));
        if let Some(fruit) = &self.fruit {
            let more = [("underside", &fruit.underside), ("unripe", &fruit.unripe), ("stalk", &fruit.stalk)];
            out.extend(more.iter().filter_map(|(key, m)| Some((format!("fruit.{key}"), m.as_deref()?))));
        }
        out.extend(self.thorns.iter().map(|t| ("thorns.material".into(), t.material.as_str())));
        if let Some(pot) = &self.pot {
            out.extend([
                ("pot.material".into(), pot.material.as_str()),
                ("pot.soil".into(), pot.soil.as_str()),
            ]);
        }
        for (i, flower) in self.flowers.iter().enumerate() {
            flower_references(flower, |key, name| out.push((format!("flowers[{i}].{key}"), name)));
        }
        out
    }
}

fn flower_references<'a>(look: &'a FlowerLook, mut add: impl FnMut(&str, &'a str)) {
    look.petals.materials.0.iter().for_each(|m| add("petals.materials", m));
    look.sepals.iter().for_each(|s| add("sepals.material", &s.material));
    look.cup.iter().for_each(|c| add("cup.material", &c.material));
    add("disc.material", &look.disc.material);
    for (group, filaments) in [("stamens", &look.stamens), ("pistils", &look.pistils)] {
        for filament in filaments {
            add(&format!("{group}.material"), &filament.material);
            filament.head_material.iter().for_each(|m| add(&format!("{group}.head_material"), m));
        }
    }
}

/// Reads a species from text. `file` is its name in messages, `beside` the folder in which its pictures are looked for.
pub(super) fn parse(text: &str, file: &str, beside: Option<&Path>) -> Result<Species, SpeciesError> {
    let mut species: Species = toml::from_str(text).map_err(|error| invalid(text, file, &error))?;
    for (name, look) in &mut species.materials {
        if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
            let line = Places::of(text).line(&format!("materials.{name}"), None);
            return Err(SpeciesError::MaterialName { file: file.to_owned(), line, name: quote::name(name) });
        }
        if let Some(Texture::BuiltIn(texture)) = &look.texture {
            let found = resolve(texture, beside).ok_or_else(|| SpeciesError::NoTexture {
                file: file.to_owned(),
                line: Places::of(text).line(&format!("materials.{name}.texture"), None),
                material: quote::name(name),
                texture: quote::name(texture),
                nearest: nearest(texture, texture_names()).map(str::to_owned),
            })?;
            look.texture = Some(found);
        }
    }
    for (key, name) in species.references() {
        if !species.materials.contains_key(name) {
            let known = species.materials.keys().map(String::as_str);
            let nearest = nearest(name, known).map(str::to_owned);
            return Err(SpeciesError::NoMaterial {
                file: file.to_owned(),
                line: Places::of(text).line(&key, Some(name)),
                key,
                name: quote::name(name),
                nearest,
            });
        }
    }
    file.clone_into(&mut species.written.file);
    if !species.params.is_empty() {
        species.written.params = Places::of(text).below("params");
    }
    Ok(species)
}

/// The picture of that name beside the file or among the built-in ones.
fn resolve(texture: &str, beside: Option<&Path>) -> Option<Texture> {
    if let Some(path) = beside.map(|folder| folder.join(texture)).filter(|path| path.is_file()) {
        return Some(Texture::File(path));
    }
    builtin_texture(texture).is_some().then(|| Texture::BuiltIn(texture.to_owned()))
}

fn invalid(text: &str, file: &str, error: &toml::de::Error) -> SpeciesError {
    let (line, there) = quote::line_at(text, error.span().map_or(0, |span| span.start));
    SpeciesError::Invalid {
        file: file.to_owned(),
        line,
        text: there,
        reason: quote::message(error.message()),
    }
}

#[cfg(test)]
#[path = "file_tests.rs"]
mod tests;
