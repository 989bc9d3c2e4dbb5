//! Writing files whole or not at all.
//!
//! Each file goes to a temporary one in the same folder, is flushed to the disk (fsync), and takes its final name by
//! rename; then the folder is flushed, so that the name survives a power cut. A group of files is staged completely
//! before the first is renamed, and renamed in order: what fails early (missing folder, full disk, a folder in the
//! place of a file) leaves everything as it was. Temporary files vanish on every way out but a killed process.
//!
//! Limits: between the renames of a group lies a moment in which the first are new and the last is old.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;
use thiserror::Error;

/// A file that could not be written.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The folder does not exist.
    #[error("cannot write {}: there is no folder {}; create it first", .path.display(), .folder.display())]
    NoFolder {
        /// The file.
        path: PathBuf,
        /// The folder that should hold it.
        folder: PathBuf,
    },
    /// The path names a folder, a device or a pipe.
    #[error("cannot write {}: there is {what} of this name; choose another name", .path.display())]
    Occupied {
        /// The file.
        path: PathBuf,
        /// What stands in its place.
        what: &'static str,
    },
    /// No right to create files there.
    #[error("cannot write {}: no permission to create files in {}; choose another folder", .path.display(), .folder.display())]
    Denied {
        /// The file.
        path: PathBuf,
        /// The folder that should hold it.
        folder: PathBuf,
    },
    /// No space.
    #[error("cannot write {}: the disk is full; free some space and try again", .path.display())]
    DiskFull {
        /// The file.
        path: PathBuf,
    },
    /// Anything else the system says.
    #[error("cannot write {}: {source}", .path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

impl WriteError {
    /// What the system's `source` means for writing `target`.
    pub fn of(target: &Path, source: io::Error) -> Self {
        let (path, folder) = (target.to_owned(), folder_of(target).to_owned());
        match source.kind() {
            io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => Self::NoFolder { path, folder },
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
                Self::Denied { path, folder }
            }
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded | io::ErrorKind::FileTooLarge => {
                Self::DiskFull { path }
            }
            _ => Self::Io { path, source },
        }
    }
}

/// Writes one file, whole or not at all. An existing file is replaced; a symbolic link keeps its place and its target
/// is replaced.
///
/// # Errors
/// [`WriteError`], with what was there before left as it was.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    write_group_atomically(&[(path.to_owned(), bytes)])
}

/// As [`write_atomically`], but asks `permit` about the target, symbolic links resolved, when all but the renaming is
/// done.
///
/// # Errors
/// [`WriteError`] or what `permit` says, with what was there before left as it was.
pub fn write_atomically_if<E: From<WriteError>>(
    path: &Path,
    bytes: &[u8],
    permit: impl FnOnce(&Path) -> Result<(), E>,
) -> Result<(), E> {
    let staged = Staged::new(path, |file| file.write_all(bytes))?;
    permit(&staged.target)?;
    Ok(staged.commit()?)
}

/// Writes several files: all are staged before the first takes its name, and they take their names in order.
///
/// Staged from last to first: the last is the one that was asked for, so a missing folder is reported of it.
///
/// # Errors
/// [`WriteError`] of the first file that cannot be written; nothing has changed unless a rename itself failed.
pub fn write_group_atomically(files: &[(PathBuf, &[u8])]) -> Result<(), WriteError> {
    let staged: Vec<Staged> = files
        .iter()
        .rev()
        .map(|(path, bytes)| Staged::new(path, |file| file.write_all(bytes)))
        .collect::<Result<_, _>>()?;
    staged.into_iter().rev().try_for_each(Staged::commit)
}

/// A file written under a temporary name.
struct Staged {
    temporary: NamedTempFile,
    target: PathBuf,
}

impl Staged {
    fn new(path: &Path, write: impl FnOnce(&mut File) -> io::Result<()>) -> Result<Self, WriteError> {
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        refuse_occupied(&target)?;
        let explain = |error| WriteError::of(&target, error);
        let mut temporary = temporary_beside(&target).map_err(explain)?;
        // Who could read the old file can read the new one, and nobody else.
        if let Ok(there) = fs::metadata(&target) {
            let _ = temporary.as_file().set_permissions(there.permissions());
        }
        write(temporary.as_file_mut()).map_err(explain)?;
        temporary.as_file().sync_all().map_err(explain)?;
        Ok(Self { temporary, target })
    }

    fn commit(self) -> Result<(), WriteError> {
        let folder = folder_of(&self.target);
        self.temporary.persist(&self.target).map_err(|failed| WriteError::of(&self.target, failed.error))?;
        flush_folder(folder);
        Ok(())
    }
}

/// Flushes the names in a folder to the disk. Some file systems cannot; the files themselves are safe without.
pub fn flush_folder(folder: &Path) {
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
}

fn refuse_occupied(target: &Path) -> Result<(), WriteError> {
    let occupied = |what| Err(WriteError::Occupied { path: target.to_owned(), what });
    match fs::metadata(target) {
        Ok(there) if there.is_dir() => occupied("a folder"),
        Ok(there) if !there.is_file() => occupied("a device or pipe"),
        _ if target.file_name().is_none() => occupied("a folder"),
        _ => Ok(()),
    }
}

/// A temporary file whose access rights are those of any new file, not the private ones of temporary files.
fn temporary_beside(target: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".penstemon-").suffix(".tmp");
    #[cfg(unix)]
    let rights = <fs::Permissions as std::os::unix::fs::PermissionsExt>::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(rights);
    builder.tempfile_in(folder_of(target))
}

/// The folder that holds `target`.
pub fn folder_of(target: &Path) -> &Path {
    match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_full_disk_leaves_the_old_file_and_no_other() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plant.obj");
        write_atomically(&path, b"old").unwrap();
        let error = Staged::new(&path, |file| {
            file.write_all(b"half a fi")?;
            Err(io::ErrorKind::StorageFull.into())
        })
        .err()
        .unwrap();
        assert!(error.to_string().contains("plant.obj: the disk is full"), "{error}");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["plant.obj"]);
    }

    #[test]
    fn a_group_with_an_impossible_member_changes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let (first, last) = (folder.path().join("plant.mtl"), folder.path().join("plant.obj"));
        fs::create_dir(&last).unwrap();
        let error = write_group_atomically(&[(first, b"new"), (last, b"new")]).unwrap_err();
        assert!(error.to_string().contains("there is a folder of this name"), "{error}");
        assert_eq!(names(folder.path()), ["plant.obj"]);
    }

    #[test]
    fn missing_folders_are_named() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("file"), b"").unwrap();
        for below in ["nowhere/plant.glb", "file/plant.glb"] {
            let error = write_atomically(&folder.path().join(below), b"x").unwrap_err().to_string();
            assert!(error.contains("there is no folder"), "{error}");
        }
        assert_eq!(names(folder.path()), ["file"]);
    }

    #[cfg(unix)]
    #[test]
    fn devices_are_not_replaced_and_links_are_followed() {
        let error = write_atomically(Path::new("/dev/null"), b"x").unwrap_err().to_string();
        assert!(error.contains("a device or pipe"), "{error}");
        let folder = tempfile::tempdir().unwrap();
        let (real, link) = (folder.path().join("real"), folder.path().join("link"));
        fs::write(&real, b"old").unwrap();
        std::os::unix::fs::symlink(&real, &link).unwrap();
        write_atomically(&link, b"new").unwrap();
        assert_eq!(fs::read(&real).unwrap(), b"new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }
}
