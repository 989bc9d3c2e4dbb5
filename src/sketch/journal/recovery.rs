//! What windows that are gone have left, and where new ones keep their journals.

use super::error::{Gap, JournalError};
use super::replay;
use super::session::{Meta, PREFIX, Session};
use super::writer::JournalWriter;
use crate::sketch::Sketch;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// The state folder in which every window keeps a folder of its own.
#[derive(Clone, Debug)]
pub struct Recovery {
    state: PathBuf,
}

/// A drawing as a recovery copy has it.
#[derive(Debug)]
pub struct Restored {
    /// The drawing.
    pub sketch: Sketch,
    /// What could not be read of it.
    pub gaps: Vec<Gap>,
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
        &self.session.folder
    }

    /// Number of strokes, 0 if the drawing cannot be had.
    pub fn strokes(&self) -> usize {
        self.content.as_ref().map_or(0, |restored| restored.sketch.strokes.len())
    }
}

impl Recovery {
    /// Recovery copies below this folder, which is made when the first is written.
    pub fn at(state: impl Into<PathBuf>) -> Self {
        Self { state: state.into() }
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
            if entry.file_name().to_string_lossy().starts_with(PREFIX) {
                found.extend(Session::claim(entry.path()).and_then(recoverable));
            }
        }
        found.sort_by(|a, b| (b.modified, &b.session.folder).cmp(&(a.modified, &a.session.folder)));
        Ok(found)
    }

    /// Removes what a window left, for good.
    ///
    /// # Errors
    /// The files cannot be removed.
    pub fn discard(&self, what: Recoverable) -> Result<(), JournalError> {
        let path = what.session.folder.clone();
        what.session.remove().map_err(|source| JournalError::Remove { path, source })
    }

    /// Begins to keep a journal of a drawing that was opened or is new. Nothing is written before the first step,
    /// unless the drawing `is_saved` nowhere (an import).
    ///
    /// # Errors
    /// No thread; what goes wrong later is told by [`JournalWriter::state`].
    pub fn start(&self, sketch: &Sketch, meta: Meta, is_saved: bool) -> Result<JournalWriter, JournalError> {
        JournalWriter::spawn(self.state.clone(), None, sketch.clone(), meta, is_saved)
    }

    /// Opens what a window left and goes on in the same folder: until it is saved, it stays recoverable.
    ///
    /// # Errors
    /// The drawing cannot be had, or no thread.
    pub fn resume(&self, what: Recoverable) -> Result<(Restored, Meta, JournalWriter), JournalError> {
        let Recoverable { meta, content, session, .. } = what;
        let restored = content?;
        let sketch = restored.sketch.clone();
        let writer = JournalWriter::spawn(self.state.clone(), Some(session), sketch, meta.clone(), true)?;
        Ok((restored, meta, writer))
    }
}

/// What a claimed session holds; one that never wrote anything is swept away.
fn recoverable(session: Session) -> Option<Recoverable> {
    let content = match replay::restore(&session) {
        Ok(Some(restored)) => Ok(restored),
        Ok(None) => {
            // Nothing of the artist's is in it; what cannot be removed is looked at again next time.
            let _ = session.remove();
            return None;
        }
        Err(error) => Err(error),
    };
    Some(Recoverable { meta: session.read_meta(), modified: last_written(&session), content, session })
}

fn last_written(session: &Session) -> SystemTime {
    let files = fs::read_dir(&session.folder).into_iter().flatten().flatten();
    let times = files.filter_map(|file| file.metadata().ok()?.modified().ok());
    times.max().unwrap_or(SystemTime::UNIX_EPOCH)
}
