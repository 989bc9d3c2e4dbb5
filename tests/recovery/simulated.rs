//! A file system that can fail at any operation, and that can say what a disk would hold had the power gone at any moment.
//!
//! Everything is done to real files below a folder, so that the program reads what it wrote. Beside that every operation is
//! noted. [`Simulated::after_crash`] plays the notes up to a moment, and writes what a [`Loss`] leaves of it into another
//! folder: content of files and names in folders are kept apart, and each is safe only once it was flushed.

use penstemon::file_system::{Access, FileSystem, System, WrittenFile};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard};

/// What a crash takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Loss {
    /// The program was killed: nothing.
    Nothing,
    /// The power went: everything that was not flushed.
    Everything,
    /// Content that was not flushed, while names are there: a journaling file system.
    Content,
    /// Names that were not flushed.
    Names,
    /// Half of the content that was not flushed.
    Half,
    /// Content that was not flushed, in whose place there are zeros.
    Zeros,
}

impl Loss {
    pub(crate) const ALL: [Self; 6] =
        [Self::Nothing, Self::Everything, Self::Content, Self::Names, Self::Half, Self::Zeros];
}

/// How one operation goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    /// Nothing is done.
    Fails,
    /// Half of a write is done.
    CutShort,
}

impl Fault {
    pub(crate) const ALL: [Self; 2] = [Self::Fails, Self::CutShort];
}

type Inode = usize;

const ROOT: Inode = 0;

#[derive(Clone, Debug)]
enum Note {
    Created {
        folder: Inode,
        name: OsString,
        inode: Inode,
        is_folder: bool,
    },
    Wrote {
        inode: Inode,
        bytes: Vec<u8>,
    },
    Flushed {
        inode: Inode,
    },
    /// A flush failed: what was not on the disk by then never gets there.
    Forgot {
        inode: Inode,
    },
    Renamed {
        from: (Inode, OsString),
        to: (Inode, OsString),
    },
    Removed {
        folder: Inode,
        name: OsString,
    },
    /// The program said of something that it is safe.
    Promised(usize),
}

/// A folder's names or a file's bytes.
#[derive(Clone, Debug, Default)]
struct Node {
    is_folder: bool,
    now: BTreeMap<OsString, Inode>,
    flushed: BTreeMap<OsString, Inode>,
    content: Vec<u8>,
    /// For every byte whether it is on the disk: runs of bytes, and whether they are.
    runs: Vec<(usize, Safety)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Safety {
    Flushed,
    Pending,
    Forgotten,
}

#[derive(Debug, Default)]
struct State {
    nodes: Vec<Node>,
    notes: Vec<Note>,
    operations: usize,
    fault: Option<(usize, Fault)>,
}

/// The file system.
#[derive(Debug)]
pub(crate) struct Simulated {
    root: PathBuf,
    state: Mutex<State>,
}

#[derive(Debug)]
struct SimulatedFile {
    files: Arc<Simulated>,
    inode: Inode,
    real: Arc<dyn WrittenFile>,
}

/// [`FileSystem`] needs the file system shared with its files.
#[derive(Clone, Debug)]
pub(crate) struct Disk(pub(crate) Arc<Simulated>);

impl Disk {
    /// A disk below an existing folder. Its operation of the number in `fault`, from 0, goes wrong.
    pub(crate) fn new(root: &Path, fault: Option<(usize, Fault)>) -> Self {
        let root_node = Node { is_folder: true, ..Node::default() };
        let state = State { nodes: vec![root_node], fault, ..State::default() };
        Self(Arc::new(Simulated { root: fs::canonicalize(root).unwrap(), state: Mutex::new(state) }))
    }

    /// Notes that from now on something must not be lost.
    pub(crate) fn promise(&self, what: usize) {
        self.0.lock().notes.push(Note::Promised(what));
    }

    /// How often the disk was asked for anything.
    pub(crate) fn operations(&self) -> usize {
        self.0.lock().operations
    }

    /// How many moments there are at which it could have crashed.
    pub(crate) fn moments(&self) -> usize {
        self.0.lock().notes.len() + 1
    }

    /// Writes into `folder` what is left after a crash at a moment; what was promised by then.
    pub(crate) fn after_crash(&self, moment: usize, loss: Loss, folder: &Path) -> usize {
        let notes = self.0.lock().notes[..moment].to_vec();
        let mut nodes = vec![Node { is_folder: true, ..Node::default() }];
        let mut promised = 0;
        for note in &notes {
            play(note, &mut nodes);
            if let Note::Promised(what) = note {
                promised = promised.max(*what);
            }
        }
        write_out(&nodes, ROOT, loss, folder);
        promised
    }
}

/// Does what a note says.
fn play(note: &Note, nodes: &mut Vec<Node>) {
    match note.clone() {
        Note::Created { folder, name, inode, is_folder } => {
            assert_eq!(nodes.len(), inode);
            nodes.push(Node { is_folder, ..Node::default() });
            nodes[folder].now.insert(name, inode);
        }
        Note::Wrote { inode, bytes } => {
            nodes[inode].runs.push((bytes.len(), Safety::Pending));
            nodes[inode].content.extend(bytes);
        }
        Note::Flushed { inode } => nodes[inode].settle(Safety::Flushed),
        Note::Forgot { inode } => nodes[inode].settle(Safety::Forgotten),
        Note::Renamed { from, to } => {
            if let Some(inode) = nodes[from.0].now.remove(&from.1) {
                nodes[to.0].now.insert(to.1, inode);
            }
        }
        Note::Removed { folder, name } => drop(nodes[folder].now.remove(&name)),
        Note::Promised(_) => {}
    }
}

impl Node {
    fn settle(&mut self, as_what: Safety) {
        let pending = self.runs.iter_mut().filter(|(_, safety)| *safety == Safety::Pending);
        pending.for_each(|(_, safety)| *safety = as_what);
        if as_what == Safety::Flushed {
            self.flushed.clone_from(&self.now);
        }
    }

    fn left(&self, loss: Loss) -> Vec<u8> {
        let (mut left, mut at) = (Vec::new(), 0);
        for (length, safety) in &self.runs {
            let bytes = &self.content[at..at + length];
            at += length;
            match loss {
                _ if *safety == Safety::Flushed => left.extend(bytes),
                Loss::Nothing => left.extend(bytes),
                Loss::Names if *safety == Safety::Pending => left.extend(bytes),
                // The disk holds nothing of this, nor of what comes behind it unless that was flushed.
                Loss::Everything | Loss::Content | Loss::Names => left.extend(vec![0; *length]),
                Loss::Half => {
                    left.extend(&bytes[..length / 2]);
                    left.extend(vec![0; length - length / 2]);
                }
                Loss::Zeros => left.extend(vec![0; *length]),
            }
        }
        if matches!(loss, Loss::Everything | Loss::Content | Loss::Half) {
            // Nothing was ever written behind the last byte that is on the disk.
            let is_kept = |safety: Safety| safety == Safety::Flushed;
            let cut = self.runs.iter().rposition(|(_, safety)| is_kept(*safety));
            let flushed: usize = self.runs[..cut.map_or(0, |last| last + 1)].iter().map(|run| run.0).sum();
            let half = self.runs.get(cut.map_or(0, |last| last + 1)).map_or(0, |run| run.0 / 2);
            left.truncate(flushed + if loss == Loss::Half { half } else { 0 });
        }
        left
    }
}

fn write_out(nodes: &[Node], folder: Inode, loss: Loss, path: &Path) {
    let keeps_names = !matches!(loss, Loss::Everything | Loss::Names);
    let names = if keeps_names { &nodes[folder].now } else { &nodes[folder].flushed };
    for (name, inode) in names {
        let path = path.join(name);
        if nodes[*inode].is_folder {
            fs::create_dir(&path).unwrap();
            write_out(nodes, *inode, loss, &path);
        } else {
            fs::write(&path, nodes[*inode].left(loss)).unwrap();
        }
    }
}

impl Simulated {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap()
    }
}

impl State {
    fn place(&self, root: &Path, path: &Path) -> (Inode, OsString) {
        let below =
            path.strip_prefix(root).unwrap_or_else(|_| panic!("{} is not on this disk", path.display()));
        let parent = below.parent().map_or(ROOT, |parent| self.inode(parent));
        (parent, below.file_name().unwrap_or_default().to_owned())
    }

    fn inode(&self, below: &Path) -> Inode {
        below.iter().fold(ROOT, |folder, name| self.nodes[folder].now[name])
    }

    /// Counts an operation; how it goes wrong, if it does.
    fn begin(&mut self) -> Option<Fault> {
        self.operations += 1;
        let number = self.operations - 1;
        self.fault.filter(|(faulty, _)| *faulty == number).map(|(_, fault)| fault)
    }

    fn note(&mut self, note: Note) {
        play(&note, &mut self.nodes);
        self.notes.push(note);
    }
}

fn failure() -> io::Error {
    io::ErrorKind::StorageFull.into()
}

impl FileSystem for Disk {
    fn create_new(&self, path: &Path, access: &Access) -> io::Result<Arc<dyn WrittenFile>> {
        let mut state = self.0.lock();
        if state.begin().is_some() {
            return Err(failure());
        }
        let real = System.create_new(path, access)?;
        let (folder, name) = state.place(&self.0.root, path);
        let inode = state.nodes.len();
        state.note(Note::Created { folder, name, inode, is_folder: false });
        Ok(Arc::new(SimulatedFile { files: self.0.clone(), inode, real }))
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        let mut state = self.0.lock();
        if state.begin().is_some() {
            return Err(failure());
        }
        System.rename(from, to)?;
        let (from, to) = (state.place(&self.0.root, from), state.place(&self.0.root, to));
        state.note(Note::Renamed { from, to });
        Ok(())
    }

    fn remove_file(&self, path: &Path) -> io::Result<()> {
        let mut state = self.0.lock();
        if state.begin().is_some() {
            return Err(failure());
        }
        System.remove_file(path)?;
        let (folder, name) = state.place(&self.0.root, path);
        state.note(Note::Removed { folder, name });
        Ok(())
    }

    fn create_folder(&self, path: &Path) -> io::Result<()> {
        let mut state = self.0.lock();
        if state.begin().is_some() {
            return Err(failure());
        }
        System.create_folder(path)?;
        let (folder, name) = state.place(&self.0.root, path);
        let inode = state.nodes.len();
        state.note(Note::Created { folder, name, inode, is_folder: true });
        Ok(())
    }

    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        let mut state = self.0.lock();
        if state.begin().is_some() {
            return Err(failure());
        }
        System.remove_folder(path)?;
        let (folder, name) = state.place(&self.0.root, path);
        state.note(Note::Removed { folder, name });
        Ok(())
    }

    fn flush_folder(&self, path: &Path) -> io::Result<()> {
        let mut state = self.0.lock();
        if state.begin().is_some() {
            return Err(failure());
        }
        let inode = state.inode(path.strip_prefix(&self.0.root).unwrap());
        state.note(Note::Flushed { inode });
        Ok(())
    }
}

impl WrittenFile for SimulatedFile {
    fn append(&self, bytes: &[u8]) -> io::Result<()> {
        let mut state = self.files.lock();
        let (bytes, result) = match state.begin() {
            None => (bytes, Ok(())),
            Some(Fault::CutShort) => (&bytes[..bytes.len() / 2], Err(failure())),
            Some(Fault::Fails) => return Err(failure()),
        };
        self.real.append(bytes)?;
        state.note(Note::Wrote { inode: self.inode, bytes: bytes.to_vec() });
        result
    }

    fn flush(&self) -> io::Result<()> {
        let mut state = self.files.lock();
        if state.begin().is_some() {
            state.note(Note::Forgot { inode: self.inode });
            return Err(failure());
        }
        state.note(Note::Flushed { inode: self.inode });
        Ok(())
    }
}
