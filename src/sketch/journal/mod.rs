//! Nothing lost: every step of a drawing is on disk before the next stroke begins, and is found again after any crash.
//!
//! Each open drawing has a [`JournalWriter`], a thread of its own that never keeps the window waiting. It keeps a folder
//! below the state folder:
//!
//! ```text
//! STATE/session-x7Kq2a/lock                   held while the window runs
//!                      meta.json              title, file, stamp of the file
//!                      snapshot-3.penstemon   the drawing at some time
//!                      journal-3              every step since
//! ```
//!
//! A *generation* is a snapshot and the journal that goes on from it. For a new one the next journal is begun, the
//! snapshot is written beside the running drawing, and only then the old generation goes; so at any moment the newest
//! whole snapshot and the journals from its number on give the drawing. A journal may end in half a record: that step
//! was not finished. After any failure to write (disk full, folder gone) the writer keeps a copy of the drawing
//! in memory and tries again with a whole new generation.
//!
//! [`Recovery`] lists what windows that are gone have left. Nothing is removed but by [`Recovery::discard`], or by the
//! window itself once the drawing is saved or given up.

mod error;
mod record;
pub mod recovery;
mod replay;
mod scribe;
mod session;
pub mod writer;

pub use error::{Gap, JournalError};
pub use recovery::{Recoverable, Recovery, Restored};
pub use session::Meta;
pub use writer::{JournalState, JournalWriter};
