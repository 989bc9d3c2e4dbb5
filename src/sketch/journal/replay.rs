//! A session's files to the drawing that they hold.

use super::error::{Gap, JournalError};
use super::record::{self, Header, Kind, Next};
use super::recovery::Restored;
use super::session::Session;
use crate::sketch::error::Fault;
use crate::sketch::json::step::{self, Pictures};
use crate::sketch::{Picture, Sketch, editable_from_bytes, read};
use std::fs::File;
use std::io::{self, BufReader};
use std::path::Path;

/// The drawing as the newest whole snapshot and the journals since have it; `None` if nothing was ever written.
///
/// # Errors
/// Files that cannot be read, that a newer program wrote, or of which no snapshot is whole.
pub(super) fn restore(session: &Session) -> Result<Option<Restored>, JournalError> {
    let read_error = |source| JournalError::Read { path: session.folder.clone(), source };
    let mut gaps = Vec::new();
    for number in session.snapshots().map_err(read_error)?.into_iter().rev() {
        match read_snapshot(&session.snapshot(number)) {
            Ok(sketch) => {
                let sketch = replay_all(session, number, sketch, &mut gaps)?;
                return Ok(Some(Restored { sketch, gaps }));
            }
            Err(newer @ JournalError::NewerVersion { .. }) => return Err(newer),
            Err(error) => gaps.push(Gap::OlderCopy(error)),
        }
    }
    let newest = gaps.into_iter().find_map(|gap| match gap {
        Gap::OlderCopy(error) => Some(error),
        Gap::LeftOut { .. } => None,
    });
    newest.map_or(Ok(None), Err)
}

fn read_snapshot(path: &Path) -> Result<Sketch, JournalError> {
    let read = || {
        let bytes = read::load(path)?;
        editable_from_bytes(&bytes, &path.display().to_string())
    };
    read().map(|(sketch, _)| sketch).map_err(|error| match error.fault {
        Fault::WrongVersion { found } => JournalError::NewerVersion { path: path.to_owned(), version: found },
        Fault::Io(source) => JournalError::Read { path: path.to_owned(), source },
        fault => JournalError::Damaged { path: path.to_owned(), what: fault.to_string() },
    })
}

/// Lays the journals from `number` on over the snapshot.
fn replay_all(
    session: &Session,
    number: u64,
    mut sketch: Sketch,
    gaps: &mut Vec<Gap>,
) -> Result<Sketch, JournalError> {
    let mut pictures: Pictures = sketch.pictures().map(|picture| (picture.hash(), picture.clone())).collect();
    for number in number.. {
        let path = session.journal(number);
        let file = match File::open(&path) {
            Ok(file) => file,
            Err(none) if none.kind() == io::ErrorKind::NotFound => break,
            Err(source) => return Err(JournalError::Read { path, source }),
        };
        if !replay_one(&path, file, &mut sketch, &mut pictures, gaps)? {
            break;
        }
    }
    match sketch.check_invariants() {
        Ok(()) => Ok(sketch),
        Err(what) => Err(JournalError::Damaged { path: session.folder.clone(), what }),
    }
}

/// Carries out the steps of one journal; whether it was whole, so that the next one goes on from it.
fn replay_one(
    path: &Path,
    file: File,
    sketch: &mut Sketch,
    pictures: &mut Pictures,
    gaps: &mut Vec<Gap>,
) -> Result<bool, JournalError> {
    let read_error = |source| JournalError::Read { path: path.to_owned(), source };
    let mut file = BufReader::new(file);
    match record::read_header(&mut file).map_err(read_error)? {
        Header::Known => {}
        Header::Newer(version) => {
            return Err(JournalError::NewerVersion { path: path.to_owned(), version: version as f64 });
        }
        Header::Broken => return Ok(false),
    }
    for count in 1_usize.. {
        let done = match record::read_next(&mut file).map_err(read_error)? {
            Next::Record(Kind::Step, text) => step::replay(&text, sketch, pictures),
            Next::Record(Kind::Picture, bytes) => Picture::new(bytes)
                .map(|picture| drop(pictures.insert(picture.hash(), picture)))
                .map_err(|fault| fault.to_string()),
            Next::End => return Ok(true),
            // The moment of the crash; what was not finished was not promised either.
            Next::Torn => return Ok(false),
        };
        if let Err(what) = done {
            gaps.push(Gap::LeftOut { path: path.to_owned(), record: count, what });
            return Ok(false);
        }
    }
    Ok(true)
}
