//! The species that are part of the program.

use super::builtin_textures::names;
use super::file::{self, SpeciesError};
use super::looks::Species;
use crate::quote;
use crate::suggest::nearest;
use include_dir::{Dir, include_dir};
use std::sync::OnceLock;

static SPECIES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets/species");
static TREES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets/growth");

impl Species {
    /// Names of all built-in species, sorted.
    pub fn names() -> Vec<&'static str> {
        names(&SPECIES).iter().filter_map(|name| name.strip_suffix(".toml")).collect()
    }

    /// Names of all built-in species that grow by themselves, sorted.
    pub fn growing() -> Vec<&'static str> {
        static GROWING: OnceLock<Vec<&'static str>> = OnceLock::new();
        GROWING.get_or_init(Self::find_growing).clone()
    }

    fn find_growing() -> Vec<&'static str> {
        let trees = names(&TREES).into_iter().filter_map(|name| name.strip_suffix(".toml"));
        let mut names: Vec<_> = Self::names().into_iter().chain(trees).collect();
        names.retain(|name| Self::built_in(name).is_ok_and(|species| species.growth.is_some()));
        names.sort_unstable();
        names
    }

    /// Names of all built-in species of which plants are made without a drawing, sorted.
    pub fn by_themselves() -> Vec<&'static str> {
        static NAMES: OnceLock<Vec<&'static str>> = OnceLock::new();
        let find = || {
            let mut names = Self::all();
            names.retain(|name| Self::built_in(name).is_ok_and(|species| species.makes_itself()));
            names
        };
        NAMES.get_or_init(find).clone()
    }

    /// Names of all built-in species that grow by themselves, and of roses, sorted.
    pub fn growing_or_roses() -> Vec<&'static str> {
        let mut names = Self::by_themselves();
        names.retain(|name| {
            Self::built_in(name).is_ok_and(|species| species.growth.is_some() || species.rose.is_some())
        });
        names
    }

    /// Names of all built-in species with flowers that are made without a drawing, sorted.
    pub fn blooming() -> Vec<&'static str> {
        let mut names = Self::all();
        names.retain(|name| Self::built_in(name).is_ok_and(|species| species.blooms()));
        names
    }

    /// Names of all built-in species, those that only grow among them, sorted.
    pub fn all() -> Vec<&'static str> {
        let mut names = [Self::names(), Self::growing()].concat();
        names.sort_unstable();
        names.dedup();
        names
    }

    /// The built-in species of that name; case, spaces and hyphens do not matter: `Red hepatica` is `hepatica_red`.
    ///
    /// # Errors
    /// An unknown name, with the nearest known one and all others.
    pub fn built_in(name: &str) -> Result<Self, SpeciesError> {
        let plain = name.trim().to_lowercase().replace([' ', '-'], "_");
        let path = format!("{plain}.toml");
        let file = SPECIES.get_file(&path).or_else(|| TREES.get_file(&path));
        let Some(text) = file.and_then(|file| file.contents_utf8()) else {
            let known = Self::all();
            let nearest = nearest(&plain, known.iter().copied()).map(str::to_owned);
            return Err(SpeciesError::Unknown { name: quote::name(name), nearest, known: known.join(", ") });
        };
        file::parse(text, &path, None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_species_is_read_and_named_as_its_file() {
        let names = Species::names();
        assert!(names.len() >= 17, "{names:?}");
        for name in names {
            let species = Species::built_in(name).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(species.name, name);
            assert!(species.params["depth"]["world"]["height"].as_f64().unwrap() > 0.0);
        }
    }

    #[test]
    fn every_species_that_grows_is_read() {
        let names = Species::growing();
        assert!(names.len() >= 12, "{names:?}");
        for name in names {
            let species = Species::built_in(name).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(species.name, name);
            assert!(species.growth.is_some());
        }
    }

    #[test]
    fn an_unknown_name_brings_the_nearest() {
        let error = Species::built_in("dasiy").unwrap_err().to_string();
        assert!(error.contains("did you mean `daisy`?") && error.contains("sunflower"), "{error}");
        assert_eq!(Species::built_in("Hepatica Red").unwrap().name, "hepatica_red");
    }
}
