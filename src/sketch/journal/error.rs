//! Why a recovery copy could not be written or read.

use crate::atomic::WriteError;
use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// A recovery copy that cannot be written or read.
#[derive(Debug, Error)]
pub enum JournalError {
    /// The disk is full, the folder cannot be written or is gone.
    #[error("no recovery copy can be kept: {0}; you can go on drawing, but save soon")]
    Write(#[from] WriteError),
    /// The system gives no thread.
    #[error(
        "no recovery copy can be kept: no thread to write it ({0}); save often, or close other programs and restart"
    )]
    NoThread(io::Error),
    /// The folder or a file in it cannot be read.
    #[error("the recovery copy {} cannot be read: {source}; check the permissions", .path.display())]
    Read {
        /// File or folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Written by a newer program.
    #[error("the recovery copy {} was written by a newer Penstemon (version {version}); open it with that one", .path.display())]
    NewerVersion {
        /// The file.
        path: PathBuf,
        /// Its version.
        version: f64,
    },
    /// Not what was once written.
    #[error("the recovery copy {} is damaged: {what}; keep the folder if the drawing matters, a part of it may be read by hand", .path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        what: String,
    },
    /// It could not be removed.
    #[error("the recovery copy {} cannot be removed: {source}; remove the folder by hand", .path.display())]
    Remove {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// What a recovered drawing may lack.
#[derive(Debug, Error)]
pub enum Gap {
    /// The newest copy is damaged.
    #[error("{0}; an older copy was used, and the journal since")]
    OlderCopy(JournalError),
    /// No copy of the whole drawing is there.
    #[error("{}: the copy of the drawing that these steps go on from is missing or damaged; only what was drawn since is here", .path.display())]
    StepsOnly {
        /// The first journal.
        path: PathBuf,
    },
    /// A part of the journal is damaged.
    #[error("{}: records that cannot be read: {count}, the first is number {record} ({what}); what comes after was read", .path.display())]
    LeftOut {
        /// The journal.
        path: PathBuf,
        /// Number of the first record that is missing, from 1.
        record: usize,
        /// How many places of the journal are missing.
        count: usize,
        /// What is wrong with the first.
        what: String,
    },
}
