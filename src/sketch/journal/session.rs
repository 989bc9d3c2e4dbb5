//! The folder of one open drawing: names of its files, its lock, and what a recovery list shows of it.

use crate::atomic::{WriteError, flush_folder, write_atomically};
use crate::sketch::save::FileStamp;
use serde::{Deserialize, Serialize};
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// How folders of sessions are called.
pub(super) const PREFIX: &str = "session-";

/// How they are called until they are locked.
const UNFINISHED: &str = ".new-";

const LOCK: &str = "lock";
const META: &str = "meta.json";
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

/// A session's folder, locked as long as this lives.
#[derive(Debug)]
pub(super) struct Session {
    pub(super) folder: PathBuf,
    lock: Option<File>,
}

impl Drop for Session {
    /// Closing the file would not be enough: a process that is just being started may still hold a copy of it.
    fn drop(&mut self) {
        let _ = self.lock.as_ref().map(File::unlock);
    }
}

impl Session {
    /// Makes a new folder below `state`. It gets its name when it is locked, so that nobody takes it for an abandoned one.
    pub(super) fn create(state: &Path, meta: &Meta) -> Result<Self, WriteError> {
        let explain = |error| WriteError::of(&state.join("session"), error);
        fs::create_dir_all(state).map_err(explain)?;
        let unfinished = tempfile::Builder::new().prefix(UNFINISHED).tempdir_in(state).map_err(explain)?;
        let lock = File::create_new(unfinished.path().join(LOCK)).map_err(explain)?;
        // Where the file system knows no locks, a running window's files are offered as well.
        let _ = lock.try_lock();
        let name = unfinished
            .path()
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .replacen(UNFINISHED, PREFIX, 1);
        let folder = state.join(name);
        fs::rename(unfinished.path(), &folder).map_err(explain)?;
        // It no longer exists under the old name, so nothing is removed.
        drop(unfinished);
        let session = Self { folder, lock: Some(lock) };
        session.write_meta(meta)?;
        flush_folder(state);
        Ok(session)
    }

    /// Takes over an abandoned folder; `None` if its window still runs.
    pub(super) fn claim(folder: PathBuf) -> Option<Self> {
        let lock = File::options().write(true).create(true).truncate(false).open(folder.join(LOCK)).ok();
        match lock.as_ref().map(File::try_lock) {
            Some(Err(TryLockError::WouldBlock)) => None,
            _ => Some(Self { folder, lock }),
        }
    }

    /// Whether the folder is still there.
    pub(super) fn exists(&self) -> bool {
        self.folder.join(LOCK).exists()
    }

    pub(super) fn write_meta(&self, meta: &Meta) -> Result<(), WriteError> {
        let path = self.folder.join(META);
        // A path that JSON cannot hold is left out; the title still tells which drawing it is.
        let text = serde_json::to_string_pretty(meta)
            .or_else(|_| serde_json::to_string_pretty(&Meta { path: None, ..meta.clone() }));
        let text = text.map_err(|error| WriteError::of(&path, error.into()))?;
        write_atomically(&path, text.as_bytes())
    }

    /// What [`Session::write_meta`] wrote; nothing where that cannot be read, for the drawing matters more.
    pub(super) fn read_meta(&self) -> Meta {
        let text = fs::read(self.folder.join(META)).unwrap_or_default();
        serde_json::from_slice(&text).unwrap_or_default()
    }

    pub(super) fn snapshot(&self, generation: u64) -> PathBuf {
        self.folder.join(format!("{}{generation}{}", SNAPSHOT.0, SNAPSHOT.1))
    }

    pub(super) fn journal(&self, generation: u64) -> PathBuf {
        self.folder.join(format!("{}{generation}", JOURNAL.0))
    }

    /// Numbers of the snapshots there are, ascending.
    pub(super) fn snapshots(&self) -> io::Result<Vec<u64>> {
        let mut numbers: Vec<u64> =
            self.generations()?.into_iter().filter(|g| g.is_snapshot).map(|g| g.number).collect();
        numbers.sort_unstable();
        Ok(numbers)
    }

    /// The largest number in use.
    pub(super) fn newest(&self) -> u64 {
        self.generations().into_iter().flatten().map(|g| g.number).max().unwrap_or(0)
    }

    /// Removes every snapshot and journal before `generation`; what cannot be removed does no harm.
    pub(super) fn remove_before(&self, generation: u64) {
        for old in self.generations().into_iter().flatten().filter(|g| g.number < generation) {
            let _ = fs::remove_file(old.path);
        }
    }

    fn generations(&self) -> io::Result<Vec<GenerationFile>> {
        let mut found = Vec::new();
        for entry in fs::read_dir(&self.folder)? {
            let path = entry?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let number =
                |(start, end): (&str, &str)| name.strip_prefix(start)?.strip_suffix(end)?.parse().ok();
            let (snapshot, journal): (Option<u64>, Option<u64>) = (number(SNAPSHOT), number(JOURNAL));
            if let Some(number) = snapshot.or(journal) {
                found.push(GenerationFile { number, is_snapshot: snapshot.is_some(), path });
            }
        }
        Ok(found)
    }

    /// Removes the folder and everything in it.
    pub(super) fn remove(&self) -> io::Result<()> {
        match fs::remove_dir_all(&self.folder) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }
}

struct GenerationFile {
    number: u64,
    is_snapshot: bool,
    path: PathBuf,
}
