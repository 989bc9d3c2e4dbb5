//! A journal being written: records go to the file at once, and are flushed by whoever is asked to.
//!
//! What was written survives the end of the program; what was flushed survives the end of the machine.

use super::record::{self, HEADER, Kind};
use super::session::{Folder, Meta};
use crate::atomic::WriteError;
use crate::file_system::{Access, WrittenFile};
use crate::sketch::{GardenDrawing, Picture, Sketch, Step, garden, json};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// Length and sum of a snapshot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Sum {
    /// Number of the generation.
    pub(super) snapshot: u64,
    bytes: u64,
    crc32: u32,
}

impl Sum {
    pub(super) fn of(snapshot: u64, bytes: &[u8]) -> Self {
        Self { snapshot, bytes: bytes.len() as u64, crc32: crc32fast::hash(bytes) }
    }

    /// Length of the snapshot in bytes.
    pub(super) fn bytes(&self) -> u64 {
        self.bytes
    }
}

/// What the drawing is called, and whether its file holds it as it is.
#[derive(Clone, Debug)]
pub(super) struct Identity {
    pub(super) meta: Meta,
    pub(super) is_saved: bool,
}

/// The journal that is being written.
#[derive(Debug)]
pub(super) struct Journal {
    file: Arc<dyn WrittenFile>,
    path: PathBuf,
    bytes: u64,
    /// Hashes of the pictures that are in it or in its snapshot.
    pictures: BTreeSet<u64>,
    /// The same of drawings that the garden has plants of.
    drawings: BTreeSet<u64>,
    /// When the first step was written that the newest snapshot does not have.
    pub(super) unsnapshotted_since: Option<Instant>,
}

impl Journal {
    /// Begins the journal of a generation, whose snapshot holds `sketch`.
    pub(super) fn create(
        folder: &Folder,
        generation: u64,
        sketch: &Sketch,
        identity: &Identity,
    ) -> Result<Self, WriteError> {
        let path = folder.journal(generation);
        let create = || {
            let file = folder.files.create_new(&path, &Access::Owner)?;
            let pictures = sketch.pictures().map(Picture::hash).collect();
            let drawings = garden::drawings_of(&sketch.garden).map(GardenDrawing::hash).collect();
            let path = path.clone();
            let mut journal = Self { file, path, bytes: 0, pictures, drawings, unsnapshotted_since: None };
            let mut start = HEADER.as_bytes().to_vec();
            append_identity(&mut start, identity)?;
            journal.write(&start)?;
            Ok(journal)
        };
        create().map_err(|error| WriteError::of(&path, error))
    }

    /// The file, for whoever waits for the disk.
    pub(super) fn file(&self) -> (Arc<dyn WrittenFile>, PathBuf) {
        (self.file.clone(), self.path.clone())
    }

    /// Length of the file in bytes.
    pub(super) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Writes steps behind each other.
    pub(super) fn append_steps(&mut self, steps: &[Arc<Step>]) -> io::Result<()> {
        let mut records = Vec::new();
        for step in steps {
            for picture in step.after.pictures() {
                if self.pictures.insert(picture.hash()) {
                    record::append(&mut records, Kind::Picture, picture.bytes())?;
                }
            }
            for drawing in step.after.garden_drawings() {
                if self.drawings.insert(drawing.hash()) {
                    let mut text = String::new();
                    json::push_garden_drawings(&mut text, [drawing]);
                    record::append(&mut records, Kind::Drawing, text.as_bytes())?;
                }
            }
            record::append(&mut records, Kind::Step, json::step::write(step).as_bytes())?;
        }
        self.write(&records)?;
        // A file that was removed takes bytes as gladly as any other.
        if !self.path.exists() {
            return Err(io::ErrorKind::NotFound.into());
        }
        self.unsnapshotted_since.get_or_insert_with(Instant::now);
        Ok(())
    }

    /// Writes what the drawing is called from here on, and whether it is saved.
    pub(super) fn append_identity(&mut self, identity: &Identity) -> io::Result<()> {
        let mut records = Vec::new();
        append_identity(&mut records, identity)?;
        self.write(&records)
    }

    /// Writes how a snapshot can be told from a damaged one.
    pub(super) fn append_sum(&mut self, sum: &Sum) -> io::Result<()> {
        let mut records = Vec::new();
        record::append(&mut records, Kind::Sum, &serde_json::to_vec(sum)?)?;
        self.write(&records)
    }

    fn write(&mut self, records: &[u8]) -> io::Result<()> {
        self.file.append(records)?;
        self.bytes += records.len() as u64;
        Ok(())
    }

    #[cfg(test)]
    pub(super) fn pretend_long(&mut self, bytes: u64) {
        self.bytes = bytes;
    }
}

fn append_identity(out: &mut Vec<u8>, identity: &Identity) -> io::Result<()> {
    let Identity { meta, is_saved } = identity;
    // A path that JSON cannot hold is left out; the title still tells which drawing it is.
    let text =
        serde_json::to_vec(meta).or_else(|_| serde_json::to_vec(&Meta { path: None, ..meta.clone() }))?;
    record::append(out, if *is_saved { Kind::Saved } else { Kind::Named }, &text)
}
