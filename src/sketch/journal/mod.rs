//! Nothing lost: every step of a drawing is in a file before the next begins, and is found again after any crash.
//!
//! Each open drawing has a [`JournalWriter`], a thread of its own that never keeps the window waiting. It keeps a folder
//! below the state folder, which only the user can enter, from the moment when the drawing is opened:
//!
//! ```text
//! STATE/session-x7Kq2a/lock                   held while the window runs
//!                      snapshot-3.penstemon   the drawing at some time
//!                      journal-3              its title and file, and every step since
//! STATE/damaged/session-x7Kq2a-journal-2      a file of which a part could not be read
//! ```
//!
//! A step is written at once, which is enough for a crash of the program, and flushed by a second thread, which a power
//! cut asks for; a slow disk delays only what is reported as safe.
//!
//! A *generation* is a snapshot and the journal that goes on from it. For a new one the next journal is begun, the
//! snapshot is written beside the running drawing, and only then the generation before the last goes; so at any moment
//! two snapshots and the journals since give the drawing, and either snapshot may be damaged. A journal may end in half a
//! record: that step was not finished. After any failure to write (disk full, folder gone) the writer keeps a copy of the
//! drawing in memory and tries again with a whole new generation.
//!
//! [`Recovery`] lists what windows that are gone have left. Nothing is removed but by [`Recovery::discard`], or by the
//! window itself once the drawing is saved or given up; and never a file that is not a session's own.

mod error;
mod file;
mod flusher;
mod journal_thread;
mod record;
pub mod recovery;
mod replay;
mod session;
mod shared;
pub mod writer;

pub use error::{Gap, JournalError};
pub use recovery::{Recoverable, Recovery};
pub use replay::Restored;
pub use session::Meta;
pub use writer::{Closing, JournalState, JournalWriter};
