//! The species file that a drawing names: where it is found, and how a saved drawing names it.
//!
//! While a drawing is open it names the file by its whole path. In a file it names it from the drawing's folder where it lies
//! there or below, and by its own name alone where it does not, so that no folder of the artist's machine leaves it. A
//! file is looked for by what the drawing says, then beside the drawing under its own name, for drawings travel with
//! their species.
//!
//! Limits: a species elsewhere has to be chosen again, or put beside the drawing, once the drawing is opened anew.

use std::fs;
use std::path::{Component, Path, PathBuf};

/// Whether a drawing's species is a file, not a built-in one.
pub fn is_file(species: &str) -> bool {
    species.ends_with(".toml")
}

/// The end of a path of any system: drawings travel between them.
pub fn own_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).find(|part| !part.is_empty()).unwrap_or(path)
}

/// Where the file is that a drawing in `folder` names; where it would be, if it is missing.
pub fn find(species: &str, folder: &Path) -> PathBuf {
    let named = folder.join(species);
    let beside = folder.join(own_name(species));
    if !named.exists() && beside.exists() { beside } else { named }
}

/// How a drawing that is saved in `folder` names a species file or a built-in species.
pub fn portable(species: &str, folder: &Path) -> String {
    let path = Path::new(species);
    if !is_file(species) {
        return species.to_owned();
    }
    if !path.is_absolute() {
        // What another system wrote may name its folders.
        return if species.contains('\\') { own_name(species) } else { species }.to_owned();
    }
    let whole = |path: &Path| {
        fs::canonicalize(path).or_else(|_| std::path::absolute(path)).unwrap_or_else(|_| path.to_owned())
    };
    // Also by the names as they are, for a link beside the drawing may lead elsewhere.
    let below = |path: &Path, folder: &Path| {
        let parts = path.strip_prefix(folder).ok()?.components().map(|part| match part {
            Component::Normal(name) => name.to_str(),
            _ => None,
        });
        Some(parts.collect::<Option<Vec<_>>>()?.join("/"))
    };
    below(path, folder)
        .or_else(|| below(&whole(path), &whole(folder)))
        .unwrap_or_else(|| own_name(species).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawing_names_its_species_without_the_folders_of_the_machine() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("drawings");
        fs::create_dir_all(folder.join("own")).unwrap();
        for place in ["drawings/own/weed.toml", "drawings/a.toml", "b.toml"] {
            fs::write(home.path().join(place), "").unwrap();
        }
        let name = |path: &str| portable(home.path().join(path).to_str().unwrap(), &folder);
        assert_eq!(name("drawings/own/weed.toml"), "own/weed.toml");
        assert_eq!(name("drawings/own/../a.toml"), "a.toml");
        assert_eq!((name("b.toml"), name("gone/c.toml")), ("b.toml".to_owned(), "c.toml".to_owned()));
        assert_eq!(portable("C:\\plants\\b.toml", &folder), "b.toml");
        for kept in ["daisy", "own/weed.toml", "../weed.toml"] {
            assert_eq!(portable(kept, &folder), kept);
        }
    }

    #[test]
    fn a_species_is_found_where_it_was_or_beside_the_drawing() {
        let home = tempfile::tempdir().unwrap();
        fs::create_dir(home.path().join("own")).unwrap();
        for place in ["own/a.toml", "b.toml"] {
            fs::write(home.path().join(place), "").unwrap();
        }
        let at = |name: &str| home.path().join(name);
        assert_eq!(find("own/a.toml", home.path()), at("own/a.toml"));
        for gone in ["/home/ann/b.toml", "C:\\plants\\b.toml", "old/b.toml", "b.toml"] {
            assert_eq!(find(gone, home.path()), at("b.toml"), "{gone}");
        }
        assert_eq!(find("/home/ann/c.toml", home.path()), Path::new("/home/ann/c.toml"));
    }
}
