//! Writing files whole or not at all.
//!
//! Each file goes to a temporary one in the same folder, is flushed to the disk (fsync), and takes its final name by
//! rename; then the folder is flushed, so that the name survives a power cut. A group of files is staged completely
//! before the first is renamed, and renamed in order: what fails early (missing folder, full disk, a folder in the
//! place of a file) leaves everything as it was. Temporary files vanish on every way out but a killed process; what killed
//! processes left is removed a day later, when the next file is written into the folder.
//!
//! Limits: between the renames of a group lies a moment in which the first are new and the last is old. Where flushing the
//! folder fails, which is an error, the file has its new content but may have its old one after a power cut.

use crate::file_system::{Access, FileSystem, System, WrittenFile};
use std::ffi::OsStr;
use std::fs;
use std::hash::{BuildHasher, RandomState};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use thiserror::Error;

/// What names of temporary files begin and end with.
const TEMPORARY: (&str, &str) = (".penstemon-", ".tmp");

/// How old a temporary file is before nobody can be writing it any more.
const LEFT_BEHIND_AFTER: Duration = Duration::from_secs(24 * 60 * 60);

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
    write_group_atomically(&System, &[(path.to_owned(), bytes)])
}

/// As [`write_atomically`], on any file system, but asks `permit` about the target, symbolic links resolved, when all but
/// the renaming is done.
///
/// # Errors
/// [`WriteError`] or what `permit` says, with what was there before left as it was.
pub fn write_atomically_if<E: From<WriteError>>(
    files: &dyn FileSystem,
    path: &Path,
    bytes: &[u8],
    permit: impl FnOnce(&Path) -> Result<(), E>,
) -> Result<(), E> {
    let staged = Staged::flushed(files, path, bytes)?;
    permit(&staged.target)?;
    Ok(staged.commit()?)
}

/// Writes several files: all are staged before the first takes its name, and they take their names in order.
///
/// Staged from last to first: the last is the one that was asked for, so a missing folder is reported of it.
///
/// # Errors
/// [`WriteError`] of the first file that cannot be written; nothing has changed unless a rename itself failed.
pub fn write_group_atomically(files: &dyn FileSystem, group: &[(PathBuf, &[u8])]) -> Result<(), WriteError> {
    let staged: Vec<Staged> = group
        .iter()
        .rev()
        .map(|(path, bytes)| Staged::flushed(files, path, bytes))
        .collect::<Result<_, _>>()?;
    staged.into_iter().rev().try_for_each(Staged::commit)
}

/// A file written under a temporary name, which goes with it unless it takes its place.
pub(crate) struct Staged<'f> {
    files: &'f dyn FileSystem,
    file: Arc<dyn WrittenFile>,
    temporary: Option<PathBuf>,
    target: PathBuf,
}

impl Drop for Staged<'_> {
    fn drop(&mut self) {
        if let Some(temporary) = self.temporary.take() {
            let _ = self.files.remove_file(&temporary);
        }
    }
}

impl<'f> Staged<'f> {
    /// Writes a file that only the user may read, and does not wait for the disk.
    pub(crate) fn private(files: &'f dyn FileSystem, path: &Path, bytes: &[u8]) -> Result<Self, WriteError> {
        Self::new(files, path.to_owned(), bytes, &Access::Owner)
    }

    /// Writes a file and waits until it is on the disk. Who could read the old one can read it, and nobody else.
    fn flushed(files: &'f dyn FileSystem, path: &Path, bytes: &[u8]) -> Result<Self, WriteError> {
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        refuse_occupied(&target)?;
        let access = fs::metadata(&target).map_or(Access::Usual, |there| Access::Like(there.permissions()));
        let staged = Self::new(files, target, bytes, &access)?;
        staged.flush()?;
        Ok(staged)
    }

    fn new(
        files: &'f dyn FileSystem,
        target: PathBuf,
        bytes: &[u8],
        access: &Access,
    ) -> Result<Self, WriteError> {
        let explain = |error| WriteError::of(&target, error);
        let temporary = folder_of(&target).join(unused_name());
        let file = files.create_new(&temporary, access).map_err(explain)?;
        let staged = Self { files, file, temporary: Some(temporary), target };
        staged.file.append(bytes).map_err(|error| WriteError::of(&staged.target, error))?;
        Ok(staged)
    }

    /// Waits until the content is on the disk.
    pub(crate) fn flush(&self) -> Result<(), WriteError> {
        self.file.flush().map_err(|error| WriteError::of(&self.target, error))
    }

    /// Gives it its name, and does not wait for the disk. The file, for whoever wants to flush it.
    pub(crate) fn place(&mut self) -> Result<Arc<dyn WrittenFile>, WriteError> {
        if let Some(temporary) = &self.temporary {
            let placed = self.files.rename(temporary, &self.target);
            placed.map_err(|error| WriteError::of(&self.target, error))?;
            self.temporary = None;
        }
        Ok(self.file.clone())
    }

    fn commit(mut self) -> Result<(), WriteError> {
        self.place()?;
        let folder = folder_of(&self.target);
        self.files.flush_folder(folder).map_err(|error| WriteError::of(&self.target, error))?;
        sweep(self.files, &self.target);
        Ok(())
    }
}

/// Removes what killed processes left in the folder of a file that was just written: files of temporary names that belong to
/// the same user and are a day old. Everything else stays, whatever it is.
fn sweep(files: &dyn FileSystem, written: &Path) {
    let Ok(ours) = fs::symlink_metadata(written) else { return };
    for entry in fs::read_dir(folder_of(written)).into_iter().flatten().flatten() {
        let is_left_behind = is_temporary(&entry.file_name())
            && entry.metadata().is_ok_and(|m| m.is_file() && owner(&m) == owner(&ours) && is_old(&m));
        if is_left_behind {
            let _ = files.remove_file(&entry.path());
        }
    }
}

/// Whether something is so old that nobody can be writing it any more.
pub(crate) fn is_old(there: &fs::Metadata) -> bool {
    there.modified().ok().and_then(|at| at.elapsed().ok()) >= Some(LEFT_BEHIND_AFTER)
}

#[cfg(unix)]
fn owner(file: &fs::Metadata) -> u32 {
    std::os::unix::fs::MetadataExt::uid(file)
}

/// Without owners, whoever can write a folder owns what is in it.
#[cfg(not(unix))]
fn owner(_: &fs::Metadata) -> u32 {
    0
}

/// Whether temporary files are called so.
pub(crate) fn is_temporary(name: &OsStr) -> bool {
    let middle = name.to_str().and_then(|name| name.strip_prefix(TEMPORARY.0)?.strip_suffix(TEMPORARY.1));
    middle.is_some_and(|m| (6..=16).contains(&m.len()) && m.bytes().all(|byte| byte.is_ascii_alphanumeric()))
}

fn unused_name() -> String {
    format!("{}{}{}", TEMPORARY.0, random_name(), TEMPORARY.1)
}

/// Sixteen characters that no name had before.
pub(crate) fn random_name() -> String {
    format!("{:016x}", RandomState::new().hash_one(0))
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

    /// A disk with room for so many bytes more.
    #[derive(Debug)]
    struct Room(usize);

    impl FileSystem for Room {
        fn create_new(&self, path: &Path, access: &Access) -> io::Result<Arc<dyn WrittenFile>> {
            Ok(Arc::new(Full(self.0, System.create_new(path, access)?)))
        }

        fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
            System.rename(from, to)
        }

        fn remove_file(&self, path: &Path) -> io::Result<()> {
            System.remove_file(path)
        }

        fn create_folder(&self, path: &Path) -> io::Result<()> {
            System.create_folder(path)
        }

        fn remove_folder(&self, path: &Path) -> io::Result<()> {
            System.remove_folder(path)
        }

        fn flush_folder(&self, path: &Path) -> io::Result<()> {
            System.flush_folder(path)
        }
    }

    #[derive(Debug)]
    struct Full(usize, Arc<dyn WrittenFile>);

    impl WrittenFile for Full {
        fn append(&self, bytes: &[u8]) -> io::Result<()> {
            self.1.append(&bytes[..self.0.min(bytes.len())])?;
            if bytes.len() > self.0 { Err(io::ErrorKind::StorageFull.into()) } else { Ok(()) }
        }

        fn flush(&self) -> io::Result<()> {
            self.1.flush()
        }
    }

    #[test]
    fn a_full_disk_leaves_the_old_file_and_no_other() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plant.obj");
        write_atomically(&path, b"old").unwrap();
        let error = write_group_atomically(&Room(9), &[(path.clone(), b"more than nine bytes")]).unwrap_err();
        assert!(error.to_string().contains("plant.obj: the disk is full"), "{error}");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["plant.obj"]);
    }

    #[test]
    fn what_killed_processes_left_goes_after_a_day_and_nothing_else_does() {
        let folder = tempfile::tempdir().unwrap();
        let old = std::time::SystemTime::now() - LEFT_BEHIND_AFTER - Duration::from_secs(60);
        let left = [".penstemon-a1B2c3.tmp", ".penstemon-0123456789abcdef.tmp"];
        let foreign =
            [".penstemon-.tmp", ".penstemon-my notes.tmp", "penstemon-a1B2c3.tmp", ".penstemon-a1B2c3"];
        for name in left.iter().chain(&foreign) {
            fs::File::create(folder.path().join(name)).unwrap().set_modified(old).unwrap();
        }
        let young = ".penstemon-ffffffff.tmp";
        fs::write(folder.path().join(young), b"being written").unwrap();
        fs::create_dir(folder.path().join(".penstemon-folder.tmp")).unwrap();
        write_atomically(&folder.path().join("plant.obj"), b"x").unwrap();
        let mut expected = foreign.map(str::to_owned).to_vec();
        expected.extend([young, ".penstemon-folder.tmp", "plant.obj"].map(str::to_owned));
        expected.sort();
        assert_eq!(names(folder.path()), expected);
    }

    #[test]
    fn a_group_with_an_impossible_member_changes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let (first, last) = (folder.path().join("plant.mtl"), folder.path().join("plant.obj"));
        fs::create_dir(&last).unwrap();
        let error = write_group_atomically(&System, &[(first, b"new"), (last, b"new")]).unwrap_err();
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
