//! Files that are read: whole, within a limit, and only if they are files.
//!
//! A pipe may never end and a device may act when it is opened, so what a name stands for is asked before anything is
//! opened. [`Sources`] remembers which files something is made from, by what they are on the disk rather than by name, so
//! that nothing that is written replaces one of them, through links either.

use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Reads a file of at most `most` bytes.
///
/// # Errors
/// What the system says; [`io::ErrorKind::FileTooLarge`] for more bytes; [`io::ErrorKind::InvalidInput`] for a folder, a
/// pipe or a device.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let (file, length) = open(path)?;
    if length > most {
        return Err(too_large(most));
    }
    let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0).saturating_add(1));
    // It may grow while it is read.
    file.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(too_large(most)) } else { Ok(bytes) }
}

/// Opens a file that is one, and tells its length in bytes.
///
/// # Errors
/// What the system says; [`io::ErrorKind::InvalidInput`] for a folder, a pipe or a device.
pub fn open(path: &Path) -> io::Result<(File, u64)> {
    refuse_strange(&fs::metadata(path)?)?;
    let file = File::open(path)?;
    // It may have been replaced since.
    let opened = file.metadata()?;
    refuse_strange(&opened)?;
    Ok((file, opened.len()))
}

fn refuse_strange(found: &Metadata) -> io::Result<()> {
    if found.is_file() {
        return Ok(());
    }
    let what = if found.is_dir() { "a folder" } else { "a pipe or a device" };
    Err(io::Error::new(io::ErrorKind::InvalidInput, format!("it is {what}; only files are read")))
}

fn too_large(most: u64) -> io::Error {
    let (number, unit) = if most < 1 << 20 { (most >> 10, "KiB") } else { (most >> 20, "MiB") };
    io::Error::new(
        io::ErrorKind::FileTooLarge,
        format!("it is larger than the {number} {unit} that are read"),
    )
}

/// The files that something is made from.
#[derive(Clone, Debug, Default)]
pub struct Sources(Vec<(PathBuf, Identity)>);

/// A file that would be written over one that is needed to make it.
#[derive(Debug, Error)]
#[error(
    "cannot write {}: it is the same file as {}, from which it is made; choose another name", .output.display(), .source_file.display()
)]
pub struct Overwrites {
    /// What would be written.
    pub output: PathBuf,
    /// What is read.
    pub source_file: PathBuf,
}

impl Sources {
    /// Adds a file; one that is not there is nothing that could be lost.
    pub fn add(&mut self, path: &Path) {
        if let Some(identity) = identity(path) {
            self.0.push((path.to_owned(), identity));
        }
    }

    /// Whether all of these may be written.
    ///
    /// # Errors
    /// The first of them that is one of the sources.
    pub fn spare<'a>(&self, outputs: impl IntoIterator<Item = &'a Path>) -> Result<(), Overwrites> {
        for output in outputs {
            let Some(there) = identity(output) else { continue };
            if let Some((source, _)) = self.0.iter().find(|(_, identity)| *identity == there) {
                return Err(Overwrites { output: output.to_owned(), source_file: source.clone() });
            }
        }
        Ok(())
    }
}

/// What a file is on its disk: device and inode.
#[cfg(unix)]
type Identity = (u64, u64);

#[cfg(unix)]
fn identity(path: &Path) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt as _;
    let found = fs::metadata(path).ok()?;
    Some((found.dev(), found.ino()))
}

/// Where a file lies when all links are followed; hard links are not known to be one file.
#[cfg(not(unix))]
type Identity = PathBuf;

#[cfg(not(unix))]
fn identity(path: &Path) -> Option<Identity> {
    fs::canonicalize(path).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_read_up_to_their_limit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        fs::write(&path, b"0123456789").unwrap();
        assert_eq!(read(&path, 10).unwrap(), b"0123456789");
        let error = read(&path, 9).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::FileTooLarge);
        assert_eq!(read(folder.path(), 9).unwrap_err().kind(), io::ErrorKind::InvalidInput);
        assert_eq!(read(&folder.path().join("none"), 9).unwrap_err().kind(), io::ErrorKind::NotFound);
    }

    #[cfg(unix)]
    #[test]
    fn pipes_and_devices_are_not_opened() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
        assert!(made.success());
        for strange in [&pipe, Path::new("/dev/zero"), Path::new("/dev/null")] {
            let error = read(strange, 100).unwrap_err();
            assert!(error.to_string().contains("a pipe or a device"), "{}: {error}", strange.display());
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_source_is_known_by_every_name() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for name in ["drawing", "other"] {
            fs::write(at(name), b"x").unwrap();
        }
        std::os::unix::fs::symlink(at("drawing"), at("link")).unwrap();
        fs::hard_link(at("drawing"), at("twin")).unwrap();
        let mut sources = Sources::default();
        sources.add(&at("drawing"));
        sources.add(&at("missing"));
        for same in ["drawing", "link", "twin", "../drawing"] {
            let path = if same.starts_with("..") { folder.path().join("x/../drawing") } else { at(same) };
            if same.starts_with("..") {
                fs::create_dir(at("x")).unwrap();
            }
            let error = sources.spare([path.as_path()]).unwrap_err().to_string();
            assert!(error.contains("the same file as") && error.contains("drawing"), "{error}");
        }
        assert!(sources.spare([at("other").as_path(), at("missing").as_path()]).is_ok());
    }
}
