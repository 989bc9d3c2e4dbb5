//! What windows that are gone have left, and where new ones keep their journals.

use super::error::JournalError;
use super::file::Identity;
use super::journal_thread::Subject;
use super::replay::{self, Found, Restored};
use super::session::{DAMAGED, Folder, Meta, PREFIX, Session};
use super::writer::JournalWriter;
use crate::file_system::{FileSystem, System};
use crate::sketch::Sketch;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

/// The state folder in which every window keeps a folder of its own.
#[derive(Clone, Debug)]
pub struct Recovery {
    state: PathBuf,
    files: Arc<dyn FileSystem>,
}

/// What one window left. While it is held, no other window is offered it.
#[derive(Debug)]
pub struct Recoverable {
    /// Title, file and the file's stamp.
    pub meta: Meta,
    /// When it was last written.
    pub modified: SystemTime,
    /// The drawing, or why it cannot be had.
    pub content: Result<Restored, JournalError>,
    session: Session,
}

impl Recoverable {
    /// The folder in which it lies, which names it.
    pub fn folder(&self) -> &Path {
        &self.session.folder.path
    }

    /// Number of strokes, 0 if the drawing cannot be had.
    pub fn strokes(&self) -> usize {
        self.content.as_ref().map_or(0, |restored| restored.sketch.strokes.len())
    }
}

impl Recovery {
    /// Recovery copies below this folder, which is made when the first is written.
    pub fn at(state: impl Into<PathBuf>) -> Self {
        Self::on(Arc::new(System), state)
    }

    /// The same on any file system.
    pub fn on(files: Arc<dyn FileSystem>, state: impl Into<PathBuf>) -> Self {
        Self { state: state.into(), files }
    }

    /// Where damaged files are kept when their drawing is drawn on; nothing removes them but the user.
    pub fn damaged_files(&self) -> PathBuf {
        self.state.join(DAMAGED)
    }

    /// Everything that windows left which are no longer running, newest first.
    ///
    /// # Errors
    /// The state folder is there but cannot be read.
    pub fn list(&self) -> Result<Vec<Recoverable>, JournalError> {
        let read_error = |source| JournalError::Read { path: self.state.clone(), source };
        let entries = match fs::read_dir(&self.state) {
            Ok(entries) => entries,
            Err(none) if none.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(source) => return Err(read_error(source)),
        };
        let mut found = Vec::new();
        for entry in entries {
            let entry = entry.map_err(read_error)?;
            let name = entry.file_name();
            if name.to_string_lossy().starts_with(PREFIX) {
                found.extend(Session::claim(&self.files, entry.path()).and_then(recoverable));
            }
        }
        found.sort_by(|a, b| (b.modified, b.folder()).cmp(&(a.modified, a.folder())));
        Ok(found)
    }

    /// Removes what a window left, for good. Files that the program did not write stay.
    ///
    /// # Errors
    /// The files cannot be removed.
    pub fn discard(&self, what: Recoverable) -> Result<(), JournalError> {
        let path = what.folder().to_owned();
        what.session.folder.remove().map_err(|source| JournalError::Remove { path, source })
    }

    /// Begins to keep a journal of a drawing that was opened or is new. It is there to be recovered from the first step on,
    /// or at once unless it `is_saved` (an import).
    ///
    /// # Errors
    /// No thread; what goes wrong later is reported by [`JournalWriter::state`].
    pub fn start(&self, sketch: &Sketch, meta: Meta, is_saved: bool) -> Result<JournalWriter, JournalError> {
        let identity = Identity { meta, is_saved };
        self.write(None, Subject { sketch: sketch.clone(), identity, damaged: Vec::new() })
    }

    /// Opens what a window left and goes on in the same folder: until it is saved, it stays recoverable.
    ///
    /// # Errors
    /// The drawing cannot be had, or no thread.
    pub fn resume(&self, what: Recoverable) -> Result<(Restored, Meta, JournalWriter), JournalError> {
        let Recoverable { meta, content, session, .. } = what;
        let restored = content?;
        let (sketch, damaged) = (restored.sketch.clone(), restored.damaged.clone());
        let identity = Identity { meta: meta.clone(), is_saved: false };
        let writer = self.write(Some(session), Subject { sketch, identity, damaged })?;
        Ok((restored, meta, writer))
    }

    fn write(&self, session: Option<Session>, subject: Subject) -> Result<JournalWriter, JournalError> {
        JournalWriter::spawn(self.files.clone(), self.state.clone(), session, subject)
    }
}

/// What a claimed session holds; one in which nothing is that is only there is swept away.
fn recoverable(session: Session) -> Option<Recoverable> {
    let Found { meta, content } = replay::restore(&session.folder);
    let content = match content {
        Ok(Some(restored)) => Ok(restored),
        Ok(None) => {
            // What cannot be removed is looked at again next time.
            let _ = session.folder.remove();
            return None;
        }
        Err(error) => Err(error),
    };
    Some(Recoverable { meta, modified: last_written(&session.folder), content, session })
}

fn last_written(folder: &Folder) -> SystemTime {
    let files = fs::read_dir(&folder.path).into_iter().flatten().flatten();
    let times = files.filter_map(|file| file.metadata().ok()?.modified().ok());
    times.max().unwrap_or(SystemTime::UNIX_EPOCH)
}
