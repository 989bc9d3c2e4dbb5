//! The folder that is looked at in the dialog for files, and what the texts typed there mean.
//!
//! A folder is read when it is entered, and while a path is typed the folder that its last name lies in; not in every frame.
//! Typed paths may begin with `~`, may be relative to the folder that is looked at, and reach hidden files.

use std::fs;
use std::path::{MAIN_SEPARATOR, Path, PathBuf};

/// Most entries of a folder that are listed.
const MAX_ENTRIES: usize = 2000;

/// A folder that is looked at.
#[derive(Clone, Debug, Default)]
pub(super) struct Folder {
    pub(super) path: PathBuf,
    /// Names of the folders in it, hidden ones left out.
    pub(super) folders: Vec<String>,
    /// Names of the files in it that can be chosen.
    pub(super) files: Vec<String>,
    /// Why it cannot be read.
    pub(super) failure: Option<String>,
}

impl Folder {
    /// Reads a folder; files are those with one of these extensions, or all where there are none.
    pub(super) fn read(path: PathBuf, extensions: &[&str]) -> Self {
        let mut read = Self { path, ..Self::default() };
        match fs::read_dir(&read.path) {
            Ok(entries) => {
                for entry in entries.flatten().take(MAX_ENTRIES) {
                    let name = entry.file_name().to_string_lossy().into_owned();
                    if name.starts_with('.') {
                        continue;
                    }
                    if entry.path().is_dir() {
                        read.folders.push(name);
                    } else if fits(&name, extensions) {
                        read.files.push(name);
                    }
                }
            }
            Err(error) => read.failure = Some(error.to_string()),
        }
        read.folders.sort_by_key(|name| name.to_lowercase());
        read.files.sort_by_key(|name| name.to_lowercase());
        read
    }

    /// The path that a typed text stands for.
    pub(super) fn resolve(&self, typed: &str) -> PathBuf {
        let typed = typed.trim();
        if let (Some(rest), Ok(home)) = (typed.strip_prefix('~'), etcetera::home_dir())
            && (rest.is_empty() || rest.starts_with(std::path::is_separator))
        {
            return home.join(rest.trim_start_matches(std::path::is_separator));
        }
        // An absolute path replaces the folder.
        self.path.join(typed)
    }

    /// The folder in which a typed text wants a name completed.
    pub(super) fn parent_of_typed(&self, typed: &str) -> PathBuf {
        let end = typed.rfind(std::path::is_separator).map_or(0, |at| at + 1);
        self.resolve(typed.get(..end).unwrap_or_default())
    }

    /// What a typed text can become by the names in this folder: folders end in a separator, since more may follow.
    pub(super) fn completions(&self, typed: &str) -> Vec<String> {
        let end = typed.rfind(std::path::is_separator).map_or(0, |at| at + 1);
        let (before, begun) = typed.split_at_checked(end).unwrap_or((typed, ""));
        let begun = begun.to_lowercase();
        let continues = |name: &&String| name.to_lowercase().starts_with(&begun);
        let folders = self.folders.iter().filter(continues);
        let files = self.files.iter().filter(continues);
        let all = folders.map(|name| format!("{before}{name}{MAIN_SEPARATOR}"));
        all.chain(files.map(|name| format!("{before}{name}"))).filter(|text| text != typed).collect()
    }
}

/// Whether a file of this name is of one of these kinds.
pub(super) fn fits(name: &str, extensions: &[&str]) -> bool {
    let extension = Path::new(name).extension().map(|e| e.to_string_lossy().to_lowercase());
    extensions.is_empty() || extension.is_some_and(|e| extensions.contains(&e.as_str()))
}

/// Where a typed or chosen path leads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// A folder to look at.
    Folder(PathBuf),
    /// A file to open or to write.
    File(PathBuf),
    /// Nowhere.
    Refused(Refusal),
}

/// Why a path cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Refusal {
    /// Nothing was typed or chosen.
    NoName,
    /// A name that no file can have.
    BadName,
    /// There is no such folder to write into.
    NoFolder(PathBuf),
    /// There is no such file to open.
    NoFile(PathBuf),
    /// A file of another kind than is wanted.
    WrongKind(PathBuf),
}

impl Target {
    /// Where a text typed in a folder leads, for a file that is to be opened.
    pub(super) fn to_open(folder: &Folder, typed: &str, extensions: &[&str]) -> Self {
        Self::among(folder, typed, |path| {
            if !path.is_file() {
                return Self::Refused(Refusal::NoFile(path));
            }
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if fits(&name, extensions) { Self::File(path) } else { Self::Refused(Refusal::WrongKind(path)) }
        })
    }

    /// The same for a file that is to be written; it gets the first extension where it has none of them.
    pub(super) fn to_write(folder: &Folder, typed: &str, extensions: &[&str]) -> Self {
        Self::among(folder, typed, |path| {
            let parent = path.parent().unwrap_or(&folder.path);
            let Some(name) = path.file_name().map(|name| name.to_string_lossy().into_owned()) else {
                return Self::Refused(Refusal::BadName);
            };
            if !parent.is_dir() {
                return Self::Refused(Refusal::NoFolder(parent.to_owned()));
            }
            Self::File(match extensions.first() {
                Some(extension) if !fits(&name, extensions) => parent.join(format!("{name}.{extension}")),
                _ => path,
            })
        })
    }

    fn among(folder: &Folder, typed: &str, file: impl FnOnce(PathBuf) -> Self) -> Self {
        if typed.trim().is_empty() {
            return Self::Refused(Refusal::NoName);
        }
        if typed.contains(char::is_control) {
            return Self::Refused(Refusal::BadName);
        }
        let path = folder.resolve(typed);
        if path.is_dir() {
            return Self::Folder(path);
        }
        // `sub/` asks for a folder.
        if typed.trim().ends_with(std::path::is_separator) {
            return Self::Refused(Refusal::NoFolder(path));
        }
        file(path)
    }
}

/// Makes a folder of this name in another; where it is.
///
/// # Errors
/// Why not, in the system's words; [`Refusal::BadName`]'s place is taken by an error of the kind `InvalidInput`.
pub(super) fn make(folder: &Folder, name: &str) -> std::io::Result<PathBuf> {
    if name.trim().is_empty() || name.contains(char::is_control) {
        return Err(std::io::ErrorKind::InvalidInput.into());
    }
    let path = folder.resolve(name);
    fs::create_dir(&path)?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder() -> (tempfile::TempDir, Folder) {
        let home = tempfile::tempdir().unwrap();
        for name in ["b.penstemon", "A.PENSTEMON", ".hidden.penstemon", "note.txt"] {
            fs::write(home.path().join(name), "").unwrap();
        }
        for name in ["sub", "Summer"] {
            fs::create_dir(home.path().join(name)).unwrap();
        }
        let folder = Folder::read(home.path().to_owned(), &["penstemon"]);
        (home, folder)
    }

    #[test]
    fn hidden_and_other_files_are_not_listed() {
        let (home, folder) = folder();
        assert_eq!(folder.files, ["A.PENSTEMON", "b.penstemon"]);
        assert_eq!(folder.folders, ["sub", "Summer"]);
        let gone = Folder::read(home.path().join("gone"), &[]);
        assert!(gone.failure.is_some() && gone.files.is_empty());
    }

    #[test]
    fn a_name_to_write_may_be_a_path_and_gets_its_extension() {
        let (home, folder) = folder();
        let at = |name: &str| Target::File(home.path().join(name));
        let to = |typed: &str| Target::to_write(&folder, typed, &["penstemon", "svg"]);
        assert_eq!(to("daisy"), at("daisy.penstemon"));
        assert_eq!(to(" daisy.SVG "), at("daisy.SVG"));
        assert_eq!(to("v1.2"), at("v1.2.penstemon"));
        assert_eq!(to("sub/rose"), at("sub/rose.penstemon"));
        assert_eq!(to(&home.path().join("rose").display().to_string()), at("rose.penstemon"));
        assert_eq!(to("sub"), Target::Folder(home.path().join("sub")));
        assert_eq!(to("winter/rose"), Target::Refused(Refusal::NoFolder(home.path().join("winter"))));
        assert_eq!(to("winter/"), Target::Refused(Refusal::NoFolder(home.path().join("winter/"))));
        assert_eq!(to("  "), Target::Refused(Refusal::NoName));
        assert_eq!(to("a\0b"), Target::Refused(Refusal::BadName));
    }

    #[test]
    fn only_files_that_are_there_and_fit_are_opened() {
        let (home, folder) = folder();
        let to = |typed: &str| Target::to_open(&folder, typed, &["penstemon"]);
        assert_eq!(to("b.penstemon"), Target::File(home.path().join("b.penstemon")));
        assert_eq!(to("c.penstemon"), Target::Refused(Refusal::NoFile(home.path().join("c.penstemon"))));
        assert_eq!(to("note.txt"), Target::Refused(Refusal::WrongKind(home.path().join("note.txt"))));
        assert_eq!(to(".."), Target::Folder(home.path().join("..")));
    }

    #[test]
    fn typed_paths_are_completed() {
        let (home, folder) = folder();
        assert_eq!(folder.completions("su"), ["sub/", "Summer/"]);
        assert_eq!(folder.completions("./b"), ["./b.penstemon"]);
        let absolute = format!("{}/Su", home.path().display());
        assert_eq!(folder.parent_of_typed(&absolute), home.path().join(""));
        assert_eq!(
            folder.completions(&absolute),
            [format!("{}/sub/", home.path().display()), format!("{}/Summer/", home.path().display())]
        );
        assert_eq!(folder.parent_of_typed("su"), home.path().join(""));
        assert!(folder.completions("x").is_empty());
        let home_folder = etcetera::home_dir().unwrap();
        assert_eq!(folder.resolve("~/x"), home_folder.join("x"));
        assert_eq!(folder.resolve("~x"), home.path().join("~x"));
    }

    #[test]
    fn a_folder_is_made_once() {
        let (home, folder) = folder();
        assert_eq!(make(&folder, "winter").unwrap(), home.path().join("winter"));
        assert_eq!(make(&folder, "winter").unwrap_err().kind(), std::io::ErrorKind::AlreadyExists);
        assert_eq!(make(&folder, " ").unwrap_err().kind(), std::io::ErrorKind::InvalidInput);
    }
}
