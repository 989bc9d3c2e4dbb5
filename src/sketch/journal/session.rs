//! The folder of one open drawing: names of its files, its lock, and what may be removed of it.
//!
//! Only files that a session itself writes are ever removed. Whatever else lies in its folder stays, and the folder with it.

use crate::atomic::{WriteError, folder_of, is_temporary, random_name};
use crate::file_system::{Access, FileSystem};
use crate::sketch::save::FileStamp;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How folders of sessions are called.
pub(super) const PREFIX: &str = "session-";

/// The folder beside them that keeps what was damaged.
pub(super) const DAMAGED: &str = "damaged";

const LOCK: &str = "lock";
/// How often a new folder is made where other windows take it away; each of them looks once, at its start.
const ATTEMPTS: usize = 8;
/// What old versions wrote beside snapshots and journals.
pub(super) const META: &str = "meta.json";
const SNAPSHOT: (&str, &str) = ("snapshot-", ".penstemon");
const JOURNAL: (&str, &str) = ("journal-", "");

/// What a recovery list shows of a drawing beside its strokes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Meta {
    /// The drawing's name, as the window's title has it.
    pub title: String,
    /// Its file; `None` if it was never saved (or its path is no Unicode text).
    #[serde(default)]
    pub path: Option<PathBuf>,
    /// What the file held when it was last read or saved here, to be shown when the recovered drawing is saved.
    #[serde(default)]
    pub stamp: Option<FileStamp>,
}

/// The files of a session: snapshots and journals, each with the number of its generation.
#[derive(Clone, Debug)]
pub(super) struct Folder {
    pub(super) files: Arc<dyn FileSystem>,
    pub(super) path: PathBuf,
}

/// A file of a generation.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct GenerationFile {
    /// Journals come after snapshots, and what is removed goes from the end: what is left fits together at any moment.
    pub(super) is_journal: bool,
    pub(super) number: u64,
    pub(super) path: PathBuf,
}

impl Folder {
    pub(super) fn snapshot(&self, generation: u64) -> PathBuf {
        self.path.join(format!("{}{generation}{}", SNAPSHOT.0, SNAPSHOT.1))
    }

    pub(super) fn journal(&self, generation: u64) -> PathBuf {
        self.path.join(format!("{}{generation}", JOURNAL.0))
    }

    /// Snapshots, then journals, ascending.
    pub(super) fn generations(&self) -> io::Result<Vec<GenerationFile>> {
        let mut found = Vec::new();
        for entry in fs::read_dir(&self.path)? {
            let path = entry?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let number =
                |(start, end): (&str, &str)| name.strip_prefix(start)?.strip_suffix(end)?.parse().ok();
            let (snapshot, journal): (Option<u64>, Option<u64>) = (number(SNAPSHOT), number(JOURNAL));
            if let Some(number) = snapshot.or(journal) {
                found.push(GenerationFile { is_journal: snapshot.is_none(), number, path });
            }
        }
        found.sort();
        Ok(found)
    }

    /// The largest number in use.
    pub(super) fn newest(&self) -> u64 {
        self.generations().into_iter().flatten().map(|file| file.number).max().unwrap_or(0)
    }

    /// Removes all but the two newest snapshots and the journals that go on from them; what cannot be removed does no harm.
    pub(super) fn keep_two(&self) {
        let there = self.generations().unwrap_or_default();
        let Some(second) = there.iter().filter(|file| !file.is_journal).nth_back(1) else { return };
        for old in there.iter().rev().filter(|file| file.number < second.number) {
            let _ = self.files.remove_file(&old.path);
        }
    }

    /// Makes the folder and locks it. `None` if another window found it before it was locked and took it for an abandoned
    /// one, which it then removes.
    fn lock_new(&self) -> io::Result<Option<File>> {
        let lock = self.path.join(LOCK);
        self.files.create_folder(&self.path)?;
        let opened = self
            .files
            .create_new(&lock, &Access::Owner)
            .and_then(|_| File::options().write(true).open(&lock));
        let file = match opened {
            Err(error) if matches!(error.kind(), io::ErrorKind::AlreadyExists | io::ErrorKind::NotFound) => {
                return Ok(None);
            }
            opened => opened?,
        };
        // Where the file system knows no locks, a running window's files are offered as well.
        let is_taken = matches!(file.try_lock(), Err(TryLockError::WouldBlock));
        Ok((!is_taken && lock.exists()).then_some(file))
    }

    /// Removes every snapshot and journal.
    pub(super) fn clear(&self) -> io::Result<()> {
        for file in self.generations()?.iter().rev() {
            there_no_more(self.files.remove_file(&file.path))?;
        }
        Ok(())
    }

    /// Moves damaged files out of the session's way, to where nothing is ever removed.
    pub(super) fn set_aside(&self, damaged: &[PathBuf]) {
        let kept = folder_of(&self.path).join(DAMAGED);
        let session = self.path.file_name().unwrap_or_default().to_string_lossy();
        for file in damaged {
            let _ = self.files.create_folder(&kept);
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            let _ = self.files.rename(file, &kept.join(format!("{session}-{name}")));
        }
    }

    /// Removes the session's own files, and the folder if nothing else is in it.
    pub(super) fn remove(&self) -> io::Result<()> {
        match self.clear() {
            Err(gone) if gone.kind() == io::ErrorKind::NotFound => return Ok(()),
            done => done?,
        }
        for entry in fs::read_dir(&self.path)?.flatten() {
            let name = entry.file_name();
            if name == META || name == LOCK || is_temporary(&name) {
                there_no_more(self.files.remove_file(&entry.path()))?;
            }
        }
        match self.files.remove_folder(&self.path) {
            Err(error) if error.kind() == io::ErrorKind::DirectoryNotEmpty => Ok(()),
            done => there_no_more(done),
        }
    }
}

/// Nobody minds that a file is gone that was to go.
fn there_no_more(removed: io::Result<()>) -> io::Result<()> {
    removed.or_else(|error| if error.kind() == io::ErrorKind::NotFound { Ok(()) } else { Err(error) })
}

/// A session's folder, locked as long as this lives.
#[derive(Debug)]
pub(super) struct Session {
    pub(super) folder: Folder,
    lock: Option<File>,
}

impl Drop for Session {
    /// Closing the file would not be enough: a process that is just being started may still hold a copy of it.
    fn drop(&mut self) {
        let _ = self.lock.as_ref().map(File::unlock);
    }
}

impl Session {
    /// Makes a new folder below `state` and locks it, under its final name: Windows renames no folder in which a file is open.
    /// Does not wait for the disk: `above` gets the folders in which names are new, also where it fails.
    pub(super) fn create(
        files: &Arc<dyn FileSystem>,
        state: &Path,
        above: &mut BTreeSet<PathBuf>,
    ) -> Result<Self, WriteError> {
        let explain = |error| WriteError::of(&state.join("session"), error);
        make_folders(&**files, state, above).map_err(explain)?;
        make_private(state);
        for _ in 0..ATTEMPTS {
            let path = state.join(format!("{PREFIX}{}", random_name()));
            let folder = Folder { files: files.clone(), path };
            match folder.lock_new() {
                Ok(Some(lock)) => return Ok(Self { folder, lock: Some(lock) }),
                Ok(None) => {}
                Err(error) => {
                    let _ = folder.remove();
                    return Err(explain(error));
                }
            }
        }
        Err(explain(io::ErrorKind::ResourceBusy.into()))
    }

    /// Takes over an abandoned folder; `None` if its window still runs, or if it is no session's folder.
    pub(super) fn claim(files: &Arc<dyn FileSystem>, path: PathBuf) -> Option<Self> {
        let there = |path: &Path| fs::symlink_metadata(path).ok();
        if !there(&path)?.is_dir() || there(&path.join(LOCK)).is_some_and(|lock| !lock.is_file()) {
            return None;
        }
        make_private(&path);
        let lock = File::options().write(true).create(true).truncate(false).open(path.join(LOCK)).ok();
        match lock.as_ref().map(File::try_lock) {
            Some(Err(TryLockError::WouldBlock)) => None,
            _ => Some(Self { folder: Folder { files: files.clone(), path }, lock }),
        }
    }

    /// Whether the folder is still there.
    pub(super) fn exists(&self) -> bool {
        self.folder.path.join(LOCK).exists()
    }
}

/// Makes a folder and those above it; `above` gets the folders whose names in them are new.
fn make_folders(files: &dyn FileSystem, folder: &Path, above: &mut BTreeSet<PathBuf>) -> io::Result<()> {
    above.insert(folder.to_owned());
    if folder.is_dir() {
        return Ok(());
    }
    let parent = folder_of(folder);
    if parent != folder {
        make_folders(files, parent, above)?;
    }
    match files.create_folder(folder) {
        // Another window was faster, or a file is in the way.
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
            if folder.is_dir() {
                Ok(())
            } else {
                Err(io::ErrorKind::NotADirectory.into())
            }
        }
        made => made,
    }
}

/// Folders of old versions could be entered by anybody.
#[cfg(unix)]
fn make_private(folder: &Path) {
    use std::os::unix::fs::PermissionsExt;
    let is_open = fs::metadata(folder).is_ok_and(|there| there.permissions().mode() & 0o077 != 0);
    if is_open {
        let _ = fs::set_permissions(folder, fs::Permissions::from_mode(0o700));
    }
}

#[cfg(not(unix))]
fn make_private(_: &Path) {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file_system::{System, WrittenFile};
    use crate::sketch::journal::Recovery;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Another window starts after one of the operations on files. Renames no folder, as Windows does where a file in it is
    /// open.
    #[derive(Debug)]
    struct Crowded {
        state: PathBuf,
        operations_before: AtomicUsize,
    }

    impl Crowded {
        fn then<T>(&self, done: io::Result<T>) -> io::Result<T> {
            if self.operations_before.fetch_sub(1, Ordering::Relaxed) == 1 {
                let offered = Recovery::at(&self.state).list().unwrap();
                assert!(offered.is_empty(), "{offered:?}");
            }
            done
        }
    }

    impl FileSystem for Crowded {
        fn create_new(&self, path: &Path, access: &Access) -> io::Result<Arc<dyn WrittenFile>> {
            self.then(System.create_new(path, access))
        }

        fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
            if from.is_dir() { Err(io::ErrorKind::PermissionDenied.into()) } else { System.rename(from, to) }
        }

        fn remove_file(&self, path: &Path) -> io::Result<()> {
            self.then(System.remove_file(path))
        }

        fn create_folder(&self, path: &Path) -> io::Result<()> {
            self.then(System.create_folder(path))
        }

        fn remove_folder(&self, path: &Path) -> io::Result<()> {
            self.then(System.remove_folder(path))
        }

        fn flush_folder(&self, path: &Path) -> io::Result<()> {
            System.flush_folder(path)
        }
    }

    #[test]
    fn a_new_session_is_locked_whenever_another_window_starts() {
        for operations_before in 0..6 {
            let state = tempfile::tempdir().unwrap();
            let crowded =
                Crowded { state: state.path().to_owned(), operations_before: operations_before.into() };
            let files: Arc<dyn FileSystem> = Arc::new(crowded);
            let session = Session::create(&files, state.path(), &mut BTreeSet::new()).unwrap();
            assert!(session.exists());
            let folders: Vec<PathBuf> =
                fs::read_dir(state.path()).unwrap().map(|e| e.unwrap().path()).collect();
            assert_eq!(folders, std::slice::from_ref(&session.folder.path), "after {operations_before}");
            assert!(Session::claim(&files, folders[0].clone()).is_none(), "it is locked");
            drop(session);
            assert!(Session::claim(&files, folders[0].clone()).is_some(), "and is left to others");
        }
    }
}
