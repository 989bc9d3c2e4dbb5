//! A session's files to the drawing that they hold.
//!
//! The newest whole snapshot is taken, and every journal since is replayed on it. A snapshot is whole if it reads as a drawing
//! and has the sum that a journal says. Where a record is damaged, or a step does not fit, the rest is still read: steps
//! then find their strokes by name, so that what is missing is what was damaged and no more.

use super::error::{Gap, JournalError};
use super::file::Sum;
use super::record::{self, Header, Kind, Next};
use super::session::{Folder, GenerationFile, META, Meta};
use crate::file_system::read_regular;
use crate::sketch::error::Fault;
use crate::sketch::json::step::{self, Fit, Known};
use crate::sketch::{Picture, Sketch, editable_from_bytes, json, limits};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A drawing as a recovery copy has it.
#[derive(Debug)]
pub struct Restored {
    /// The drawing.
    pub sketch: Sketch,
    /// What could not be read of it.
    pub gaps: Vec<Gap>,
    /// Files of which a part could not be read. They are kept when the drawing is drawn on, in [`Recovery::damaged_files`](super::Recovery::damaged_files).
    pub(super) damaged: Vec<PathBuf>,
}

/// Longest journal that is read; a longer one would have made room for a snapshot.
const MAX_JOURNAL_BYTES: u64 = 4 * limits::MAX_FILE_BYTES;

/// Longest file with title and path.
const MAX_META_BYTES: u64 = 1 << 20;

/// Everything that a session's files say.
pub(super) struct Found {
    pub(super) meta: Meta,
    /// The drawing; `None` if nothing in it is only here.
    pub(super) content: Result<Option<Restored>, JournalError>,
}

/// Reads a session.
pub(super) fn restore(folder: &Folder) -> Found {
    let mut meta = read_regular(&folder.path.join(META), MAX_META_BYTES)
        .ok()
        .and_then(|text| serde_json::from_slice(&text).ok())
        .unwrap_or_default();
    let content = load(folder).and_then(|(snapshots, journals)| {
        let journals: Vec<Journal<'_>> =
            journals.iter().map(|(file, bytes)| Journal::of(file, bytes)).collect();
        if let Some(newest) = journals.iter().rev().find_map(Journal::meta) {
            meta = newest;
        }
        restored(&snapshots, &journals)
    });
    Found { meta, content }
}

/// Snapshots, and journals with what is in them, both ascending.
type Loaded = (Vec<GenerationFile>, Vec<(GenerationFile, Vec<u8>)>);

fn load(folder: &Folder) -> Result<Loaded, JournalError> {
    let generations = folder.generations();
    let generations =
        generations.map_err(|source| JournalError::Read { path: folder.path.clone(), source })?;
    let (journals, snapshots): (Vec<_>, Vec<_>) = generations.into_iter().partition(|file| file.is_journal);
    let load = |file: GenerationFile| match read_regular(&file.path, MAX_JOURNAL_BYTES) {
        Ok(bytes) => Ok((file, bytes)),
        Err(source) => Err(JournalError::Read { path: file.path, source }),
    };
    Ok((snapshots, journals.into_iter().map(load).collect::<Result<_, _>>()?))
}

/// A journal taken apart.
struct Journal<'a> {
    number: u64,
    path: &'a Path,
    header: Header,
    items: Vec<Next<'a>>,
}

impl<'a> Journal<'a> {
    fn of(file: &'a GenerationFile, bytes: &'a [u8]) -> Self {
        let (header, records) = record::read(bytes);
        Self { number: file.number, path: &file.path, header, items: records.collect() }
    }

    fn records(&self) -> impl DoubleEndedIterator<Item = (Kind, &'a [u8])> {
        self.items.iter().filter_map(|item| match item {
            Next::Record(kind, body) => Some((*kind, *body)),
            Next::Damaged | Next::Unfinished => None,
        })
    }

    /// What the drawing was called last.
    fn meta(&self) -> Option<Meta> {
        let mut names = self.records().rev().filter(|(kind, _)| matches!(kind, Kind::Named | Kind::Saved));
        names.find_map(|(_, text)| serde_json::from_slice(text).ok())
    }

    fn holds_work(&self) -> bool {
        let is_work = |item: &Next<'_>| matches!(item, Next::Record(Kind::Step, _) | Next::Damaged);
        self.items.iter().any(is_work)
    }

    /// Whether the drawing's file holds it as it is at the end; `None` if nothing here says so or otherwise.
    fn is_saved(&self) -> Option<bool> {
        self.items.iter().rev().find_map(|item| match item {
            Next::Record(Kind::Saved, _) => Some(true),
            Next::Record(Kind::Named | Kind::Step, _) | Next::Damaged => Some(false),
            Next::Record(Kind::Picture | Kind::Drawing | Kind::Sum, _) | Next::Unfinished => None,
        })
    }
}

fn restored(
    snapshots: &[GenerationFile],
    journals: &[Journal<'_>],
) -> Result<Option<Restored>, JournalError> {
    for journal in journals {
        if let Header::Newer(version) = journal.header {
            let path = journal.path.to_owned();
            return Err(JournalError::NewerVersion { path, version: version as f64 });
        }
    }
    let is_saved = journals.iter().rev().find_map(Journal::is_saved);
    let holds_work = journals.iter().any(Journal::holds_work);
    if is_saved == Some(true) || (snapshots.is_empty() && !holds_work) {
        return Ok(None);
    }
    let sums = journals.iter().flat_map(Journal::records).filter(|(kind, _)| *kind == Kind::Sum);
    let sums = sums.filter_map(|(_, text)| serde_json::from_slice(text).ok());
    let sums: BTreeMap<u64, Sum> = sums.map(|sum: Sum| (sum.snapshot, sum)).collect();
    let mut damaged: Vec<(PathBuf, JournalError)> = Vec::new();
    for file in snapshots.iter().rev() {
        match read_snapshot(file, sums.get(&file.number)) {
            Ok(Some(sketch)) => {
                let (files, errors): (Vec<_>, Vec<_>) = damaged.into_iter().unzip();
                let gaps = errors.into_iter().map(Gap::OlderCopy).collect();
                let replay = Replay { gaps, damaged: files, ..Replay::of(sketch) };
                return replay.on(file.number, journals).map(Some);
            }
            Ok(None) => {}
            Err(newer @ JournalError::NewerVersion { .. }) => return Err(newer),
            Err(error) => damaged.push((file.path.clone(), error)),
        }
    }
    if !holds_work {
        return damaged.into_iter().next().map_or(Ok(None), |(_, error)| Err(error));
    }
    let (number, path) =
        journals.first().map_or((0, PathBuf::new()), |journal| (journal.number, journal.path.to_owned()));
    let files = damaged.into_iter().map(|(file, _)| file).collect();
    let gaps = vec![Gap::StepsOnly { path }];
    let replay = Replay { gaps, damaged: files, is_off: true, ..Replay::of(Sketch::empty()) };
    replay.on(number, journals).map(Some)
}

/// The drawing of a snapshot; `None` where its content never reached the disk.
fn read_snapshot(file: &GenerationFile, sum: Option<&Sum>) -> Result<Option<Sketch>, JournalError> {
    let path = file.path.clone();
    let damaged = |what: String| JournalError::Damaged { path: file.path.clone(), what };
    let bytes = match read_regular(&path, limits::MAX_FILE_BYTES) {
        Ok(bytes) => bytes,
        Err(source) => return Err(JournalError::Read { path, source }),
    };
    if bytes.iter().all(|byte| *byte == 0) {
        return Ok(None);
    }
    match editable_from_bytes(&bytes, &path.display().to_string()) {
        Ok((sketch, _)) if sum.is_none_or(|sum| *sum == Sum::of(file.number, &bytes)) => Ok(Some(sketch)),
        Ok(_) => Err(damaged("its checksum is wrong".to_owned())),
        Err(error) => Err(match error.fault {
            Fault::WrongVersion { found, .. } => JournalError::NewerVersion { path, version: found },
            fault => damaged(fault.to_string()),
        }),
    }
}

/// A drawing on which journals are replayed.
struct Replay {
    sketch: Sketch,
    known: Known,
    /// Something before was left out.
    is_off: bool,
    gaps: Vec<Gap>,
    /// Files of which a part could not be read.
    damaged: Vec<PathBuf>,
}

impl Replay {
    fn of(sketch: Sketch) -> Self {
        let known = Known::of(&sketch);
        Self { sketch, known, is_off: false, gaps: Vec::new(), damaged: Vec::new() }
    }

    /// Carries out all journals from a generation on.
    fn on(mut self, first: u64, journals: &[Journal<'_>]) -> Result<Restored, JournalError> {
        let mut expected = first;
        let journals: Vec<_> = journals.iter().filter(|journal| journal.number >= first).collect();
        for (place, journal) in journals.iter().enumerate() {
            if journal.number != expected {
                self.leave_out(journal, 1, "the journal before it is missing".to_owned());
            }
            expected = journal.number + 1;
            self.carry_out(journal, place + 1 == journals.len());
        }
        let Self { sketch, gaps, damaged, .. } = self;
        match sketch.check_invariants() {
            Ok(()) => Ok(Restored { sketch, gaps, damaged }),
            Err(what) => {
                let path = journals.first().map_or_else(PathBuf::new, |journal| journal.path.to_owned());
                Err(JournalError::Damaged { path, what })
            }
        }
    }

    fn carry_out(&mut self, journal: &Journal<'_>, is_last: bool) {
        for (item, record) in journal.items.iter().zip(1..) {
            let done = match item {
                Next::Record(Kind::Step, text) => self.step(text),
                Next::Record(Kind::Picture, bytes) => Picture::new(bytes.to_vec())
                    .map(|picture| self.known.add_picture(picture))
                    .map_err(|fault| fault.to_string()),
                Next::Record(Kind::Drawing, text) => json::garden_drawings(text).map(|drawings| {
                    drawings.into_values().for_each(|drawing| self.known.add_drawing(drawing));
                }),
                Next::Record(Kind::Named | Kind::Saved | Kind::Sum, _) => Ok(()),
                Next::Damaged => Err("its checksum is wrong".to_owned()),
                // The moment of the crash; what was not finished was not promised either.
                Next::Unfinished if is_last => Ok(()),
                Next::Unfinished => Err("it is cut off".to_owned()),
            };
            if let Err(what) = done {
                self.leave_out(journal, record, what);
            }
        }
    }

    fn step(&mut self, text: &[u8]) -> Result<(), String> {
        let fit = if self.is_off { Fit::ByName } else { Fit::Exact };
        let done = step::replay(text, &mut self.sketch, &self.known, fit);
        if done.is_err() && fit == Fit::Exact {
            // Perhaps it can be carried out in part; that it does not fit is said all the same.
            let _ = step::replay(text, &mut self.sketch, &self.known, Fit::ByName);
        }
        done
    }

    fn leave_out(&mut self, journal: &Journal<'_>, record: usize, what: String) {
        self.is_off = true;
        match self.gaps.last_mut() {
            Some(Gap::LeftOut { path, count, .. }) if path == journal.path => *count += 1,
            _ => {
                let path = journal.path.to_owned();
                self.damaged.push(path.clone());
                self.gaps.push(Gap::LeftOut { path, record, count: 1, what });
            }
        }
    }
}
