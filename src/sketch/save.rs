//! Opening a drawing to draw on in it, and saving it: whole or not at all, and never over somebody else's work.
//!
//! Whoever opens a file gets a [`FileStamp`] of what was in it and shows it again when saving. If the file holds
//! something else by then (another window or program saved there), nothing is written. The look at the file and the
//! renaming of the new one happen under a lock on the folder, so that two windows saving at the same moment do not both
//! find the old file. Bytes are compared, not times: a file that was only touched has not changed.
//!
//! Limits: programs that do not lock folders can still slip into the microseconds between look and rename; a file system
//! without locks leaves the same gap between windows.

use super::limits;
use super::{Sketch, SketchError, Warning, editable_from_bytes, json, read, species_file};
use crate::atomic::{WriteError, folder_of, write_atomically_if};
use crate::file_system::{FileSystem, System};
use crate::picture::content_hash;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;
use thiserror::Error;

/// How often, and how long apart, a folder that another window is saving in is asked for.
const LOCK_ATTEMPTS: u32 = 100;
const LOCK_PAUSE: Duration = Duration::from_millis(20);

/// What a file held when it was last read or written here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileStamp {
    length: u64,
    hash: u64,
}

impl FileStamp {
    /// The stamp of these bytes.
    pub fn of_bytes(bytes: &[u8]) -> Self {
        Self { length: bytes.len() as u64, hash: content_hash(bytes) }
    }

    /// Whether the file still holds what it held. A file that is gone does not.
    ///
    /// # Errors
    /// A file that is there but cannot be read.
    pub fn matches(&self, path: &Path) -> io::Result<bool> {
        match fs::metadata(path) {
            Ok(there) if there.len() != self.length => Ok(false),
            Ok(_) => Ok(Self::of_bytes(&fs::read(path)?) == *self),
            Err(gone) if gone.kind() == io::ErrorKind::NotFound => Ok(false),
            Err(error) => Err(error),
        }
    }
}

/// A drawing that could not be saved. It is still open; every message says how to get it onto a disk.
#[derive(Debug, Error)]
pub enum SaveError {
    /// Another window or program wrote the file.
    #[error("{} was changed by another window or program since it was opened here; save this drawing under another name, or open the file again to see what changed", .path.display())]
    ChangedByOthers {
        /// The file.
        path: PathBuf,
    },
    /// Saving would throw away what a newer program put there.
    #[error("{} was saved by a newer Penstemon (version {version}), and saving over it would lose what only that one knows; save this drawing under another name", .path.display())]
    NewerVersion {
        /// The file.
        path: PathBuf,
        /// The version that the file says it has.
        version: f64,
    },
    /// The file is write-protected.
    #[error("{} is read-only; save under another name, or remove the protection", .path.display())]
    ReadOnly {
        /// The file.
        path: PathBuf,
    },
    /// More than can be read back.
    #[error("the drawing takes {} MiB, more than the {} MiB that can be opened again; remove the reference picture or split the drawing", .bytes >> 20, limits::MAX_FILE_BYTES >> 20)]
    TooLarge {
        /// Size of the file if it were written.
        bytes: u64,
    },
    /// The disk is full, the folder is gone or not writable.
    #[error("{0} (or save the drawing elsewhere; it stays open until then)")]
    Write(#[from] WriteError),
}

/// A drawing that was opened to draw on in it.
#[derive(Debug)]
pub struct Opened {
    /// The drawing.
    pub sketch: Sketch,
    /// Remarks on what was odd in it.
    pub warnings: Vec<Warning>,
    /// What to show when saving; `None` for an SVG, which is imported and has no place to be saved to yet.
    pub stamp: Option<FileStamp>,
}

/// Opens a `.penstemon` or SVG file. Other than [`read()`](super::read()) it takes an empty sheet as well.
///
/// # Errors
/// As [`read()`](super::read()).
pub fn open(path: &Path) -> Result<Opened, SketchError> {
    let bytes = read::load(path)?;
    let (sketch, warnings) = editable_from_bytes(&bytes, &path.display().to_string())?;
    let is_svg = bytes.iter().find(|b| !b.is_ascii_whitespace() && b.is_ascii()) == Some(&b'<');
    let stamp = (!is_svg).then(|| FileStamp::of_bytes(&bytes));
    Ok(Opened { sketch, warnings, stamp })
}

/// Saves the drawing as a `.penstemon` file.
///
/// `expected` is the stamp of the file as it was last seen here. `None` says that the artist has agreed to replace
/// whatever is there (a file dialog asks); what a newer program wrote is not replaced even then. A file that has
/// vanished is written again.
///
/// # Errors
/// [`SaveError`], with the file left as it was.
pub fn save(path: &Path, sketch: &Sketch, expected: Option<&FileStamp>) -> Result<FileStamp, SaveError> {
    save_on(&System, path, sketch, expected)
}

/// As [`save`], on any file system.
///
/// # Errors
/// As [`save`].
pub fn save_on(
    files: &dyn FileSystem,
    path: &Path,
    sketch: &Sketch,
    expected: Option<&FileStamp>,
) -> Result<FileStamp, SaveError> {
    let text = json::write(&travelling(sketch, path));
    let bytes = text.len() as u64;
    if bytes > limits::MAX_FILE_BYTES {
        return Err(SaveError::TooLarge { bytes });
    }
    // Held until the new file has its name.
    let mut folder_lock = None;
    let written = write_atomically_if(files, path, text.as_bytes(), |target| {
        folder_lock = locked_folder(target);
        check_target(target, expected)
    });
    // Closing it would not be enough: a process that is just being started may still hold a copy.
    let _ = folder_lock.as_ref().map(File::unlock);
    written?;
    Ok(FileStamp::of_bytes(text.as_bytes()))
}

/// The drawing as its file has it: without folders of this machine.
fn travelling<'a>(sketch: &'a Sketch, path: &Path) -> Cow<'a, Sketch> {
    match &sketch.species {
        Some(species) if species_file::is_file(species) => {
            let species = Some(species_file::portable(species, folder_of(path)));
            Cow::Owned(Sketch { species, ..sketch.clone() })
        }
        _ => Cow::Borrowed(sketch),
    }
}

/// A lock on the folder of `target`, where the system can lock folders.
fn locked_folder(target: &Path) -> Option<File> {
    let folder = File::open(folder_of(target)).ok()?;
    for _ in 0..LOCK_ATTEMPTS {
        match folder.try_lock() {
            Ok(()) => return Some(folder),
            Err(TryLockError::WouldBlock) => thread::sleep(LOCK_PAUSE),
            Err(TryLockError::Error(_)) => return None,
        }
    }
    // Some other program sits on it; nobody should have to wait for that with a drawing to save.
    None
}

/// Whether what is there may be replaced.
fn check_target(target: &Path, expected: Option<&FileStamp>) -> Result<(), SaveError> {
    let path = || target.to_owned();
    let explain = |error| SaveError::Write(WriteError::of(target, error));
    let there = match fs::metadata(target) {
        Ok(there) => there,
        Err(gone) if gone.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(explain(error)),
    };
    if there.permissions().readonly() {
        return Err(SaveError::ReadOnly { path: path() });
    }
    if expected.map_or(Ok(false), |stamp| stamp.matches(target)).map_err(explain)? {
        return Ok(());
    }
    if there.len() <= limits::MAX_FILE_BYTES {
        let bytes = fs::read(target).map_err(explain)?;
        if let Some(version) = json::newer_version(&bytes) {
            return Err(SaveError::NewerVersion { path: path(), version });
        }
    }
    match expected {
        Some(_) => Err(SaveError::ChangedByOthers { path: path() }),
        None => Ok(()),
    }
}
