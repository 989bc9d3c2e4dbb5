//! The thread that waits for the disk, so that neither the window nor the thread that writes the journal has to.
//!
//! It gets orders: files and folders to flush, and the step that is safe after that. Orders that gathered while it waited are
//! carried out together, each file once: on a slow disk many steps share one flush.
//!
//! What a failed flush leaves on the disk nobody knows (Linux forgets what it could not write). So after a failure nothing of
//! the same *epoch* is reported as safe: the thread that writes begins a new one with a whole new generation.

use super::session::Folder;
use super::shared::{Command, Shared};
use crate::atomic::WriteError;
use crate::file_system::WrittenFile;
use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::{Builder, JoinHandle};

/// Something to wait for.
#[derive(Clone, Debug)]
pub(super) enum Target {
    /// The content of a file.
    File(Arc<dyn WrittenFile>, PathBuf),
    /// The names in a folder.
    Folder(PathBuf),
}

impl Target {
    fn path(&self) -> &Path {
        match self {
            Self::File(_, path) | Self::Folder(path) => path,
        }
    }

    fn flush(&self, folder: &Folder) -> io::Result<()> {
        match self {
            Self::File(file, _) => file.flush(),
            Self::Folder(path) => folder.files.flush_folder(path),
        }
    }
}

/// What is to be flushed, and what is known then.
#[derive(Debug)]
pub(super) struct Order {
    pub(super) epoch: u64,
    pub(super) folder: Folder,
    pub(super) flush: Vec<Target>,
    /// Number of the last step that is safe then; 0 where that is not known.
    pub(super) reached: u64,
    /// Whether older generations can go then.
    pub(super) tidy: bool,
    /// Damaged files that are to be kept elsewhere then.
    pub(super) set_aside: Vec<PathBuf>,
}

#[derive(Debug)]
enum Message {
    Order(Box<Order>),
    /// Answer when everything before is done.
    Answer(Sender<()>),
}

/// The thread, and the way to it.
#[derive(Debug)]
pub(super) struct Flusher {
    orders: Option<Sender<Message>>,
    thread: Option<JoinHandle<()>>,
}

impl Drop for Flusher {
    fn drop(&mut self) {
        self.orders = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

impl Flusher {
    /// Starts the thread. It reports to `shared`, and failures as commands.
    pub(super) fn start(shared: Arc<Shared>, failures: Sender<Command>) -> io::Result<Self> {
        let (orders, inbox) = channel();
        let thread = Builder::new().name("journal-flush".to_owned()).spawn(move || {
            let mut failed = 0;
            while let Ok(first) = inbox.recv() {
                carry_out(first, &inbox, &mut failed, &shared, &failures);
            }
        })?;
        Ok(Self { orders: Some(orders), thread: Some(thread) })
    }

    pub(super) fn order(&self, order: Order) {
        self.send(Message::Order(Box::new(order)));
    }

    /// Waits until every order given so far is carried out.
    pub(super) fn wait(&self) {
        let (answer, answered) = channel();
        self.send(Message::Answer(answer));
        let _ = answered.recv();
    }

    fn send(&self, message: Message) {
        // A thread that is gone reports nothing as safe any more, which is seen.
        let _ = self.orders.as_ref().map(|orders| orders.send(message));
    }
}

/// Carries out an order and those that came after it.
fn carry_out(
    first: Message,
    inbox: &Receiver<Message>,
    failed: &mut u64,
    shared: &Shared,
    failures: &Sender<Command>,
) {
    let (mut orders, mut answers) = (Vec::new(), Vec::new());
    for message in std::iter::once(first).chain(inbox.try_iter()) {
        match message {
            Message::Order(order) => orders.push(order),
            Message::Answer(answer) => answers.push(answer),
        }
    }
    // Everything in these orders was written before the first flush, so one flush of each is enough.
    let mut done = BTreeSet::new();
    for order in orders {
        if order.epoch <= *failed {
            continue;
        }
        let Order { epoch, folder, flush, reached, tidy, set_aside } = *order;
        let mut pending = flush.iter().filter(|target| done.insert(target.path().to_owned()));
        let flushed = pending.try_for_each(|target| {
            target.flush(&folder).map_err(|error| WriteError::of(target.path(), error))
        });
        match flushed {
            Ok(()) => {
                folder.set_aside(&set_aside);
                if tidy {
                    folder.keep_two();
                }
                shared.reached(epoch, reached);
            }
            Err(error) => {
                *failed = epoch;
                done.clear();
                // A thread that is gone does not write on either.
                let _ = failures.send(Command::FlushFailed(epoch, error));
            }
        }
    }
    for answer in answers {
        // Whoever does not wait any more needs none.
        let _ = answer.send(());
    }
}
