//! The file system as drawings, recovery copies and exports are written to it.
//!
//! Every byte that has to survive a crash goes through [`FileSystem`]. [`System`] is the machine's own. A test puts another in
//! its place: one that fails, cuts a write short, is slow, or forgets what was not flushed, as a power cut does.
//!
//! Reading needs no such place: what was written is there. [`read_regular`] reads files that nobody has named on purpose, so
//! that a pipe or a device among them ends in an error and not in a wait without end.

use std::fmt::Debug;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::Path;
use std::sync::Arc;

/// Who may read and write a new file.
#[derive(Clone, Debug)]
pub enum Access {
    /// Whoever the user lets read new files.
    Usual,
    /// Nobody but the user.
    Owner,
    /// The same as another file.
    Like(fs::Permissions),
}

/// What is done to files and folders. Names are not durable before their folder is flushed.
pub trait FileSystem: Debug + Send + Sync {
    /// Makes a file that must not be there yet.
    ///
    /// # Errors
    /// What the system says, [`io::ErrorKind::AlreadyExists`] for a name in use.
    fn create_new(&self, path: &Path, access: &Access) -> io::Result<Arc<dyn WrittenFile>>;

    /// Gives a file or folder another name; a file of that name is replaced in one step.
    ///
    /// # Errors
    /// What the system says.
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()>;

    /// Removes a file.
    ///
    /// # Errors
    /// What the system says.
    fn remove_file(&self, path: &Path) -> io::Result<()>;

    /// Makes a folder that only the user can enter. Its parent must be there.
    ///
    /// # Errors
    /// What the system says.
    fn create_folder(&self, path: &Path) -> io::Result<()>;

    /// Removes an empty folder.
    ///
    /// # Errors
    /// What the system says.
    fn remove_folder(&self, path: &Path) -> io::Result<()>;

    /// Returns when the names in a folder are on the disk, or at once where the file system cannot promise that.
    ///
    /// # Errors
    /// What the system says.
    fn flush_folder(&self, path: &Path) -> io::Result<()>;
}

/// A file being written, from its beginning to its end. Threads may share it: one writes while another waits for the disk.
pub trait WrittenFile: Debug + Send + Sync {
    /// Appends bytes; a failure may leave some of them there.
    ///
    /// # Errors
    /// What the system says.
    fn append(&self, bytes: &[u8]) -> io::Result<()>;

    /// Returns when everything appended before is on the disk. After a failure nothing is known of it.
    ///
    /// # Errors
    /// What the system says.
    fn flush(&self) -> io::Result<()>;
}

/// The machine's file system.
#[derive(Clone, Copy, Debug, Default)]
pub struct System;

impl FileSystem for System {
    fn create_new(&self, path: &Path, access: &Access) -> io::Result<Arc<dyn WrittenFile>> {
        let mut options = File::options();
        options.write(true).create_new(true);
        #[cfg(unix)]
        if matches!(access, Access::Owner) {
            std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        }
        let file = options.open(path)?;
        if let Access::Like(permissions) = access {
            // Where the system refuses, the usual permissions stay.
            let _ = file.set_permissions(permissions.clone());
        }
        Ok(Arc::new(file))
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        fs::rename(from, to)
    }

    fn remove_file(&self, path: &Path) -> io::Result<()> {
        fs::remove_file(path)
    }

    fn create_folder(&self, path: &Path) -> io::Result<()> {
        #[cfg(unix)]
        return std::os::unix::fs::DirBuilderExt::mode(&mut fs::DirBuilder::new(), 0o700).create(path);
        // In the user's own folders other users have no rights.
        #[cfg(not(unix))]
        fs::create_dir(path)
    }

    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        fs::remove_dir(path)
    }

    fn flush_folder(&self, path: &Path) -> io::Result<()> {
        match File::open(path).and_then(|folder| folder.sync_all()) {
            // Folders that cannot be opened or flushed: other systems, network disks, a folder without the right to list it.
            Err(error) if is_refusal(error.kind()) => Ok(()),
            flushed => flushed,
        }
    }
}

fn is_refusal(kind: io::ErrorKind) -> bool {
    use io::ErrorKind::{InvalidInput, PermissionDenied, Unsupported};
    matches!(kind, InvalidInput | PermissionDenied | Unsupported)
}

impl WrittenFile for File {
    fn append(&self, bytes: &[u8]) -> io::Result<()> {
        (&mut &*self).write_all(bytes)
    }

    fn flush(&self) -> io::Result<()> {
        self.sync_all()
    }
}

/// The bytes of a regular file of at most `limit` bytes.
///
/// # Errors
/// A folder, pipe or device; more than `limit` bytes ([`io::ErrorKind::FileTooLarge`]); what the system says.
pub fn read_regular(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let refuse =
        |is_file: bool| is_file.then_some(()).ok_or_else(|| io::Error::other("it is no regular file"));
    // Opening a pipe would already wait for whoever writes into it.
    refuse(fs::metadata(path)?.is_file())?;
    let file = File::open(path)?;
    let there = file.metadata()?;
    refuse(there.is_file())?;
    let mut bytes = Vec::with_capacity(there.len().min(limit) as usize);
    file.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        return Err(io::ErrorKind::FileTooLarge.into());
    }
    Ok(bytes)
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn pipes_devices_and_large_files_end_in_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let (pipe, file) = (folder.path().join("pipe"), folder.path().join("file"));
        let made = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
        assert!(made.success());
        for path in [&*pipe, folder.path(), Path::new("/dev/zero")] {
            let error = read_regular(path, 10).unwrap_err().to_string();
            assert!(error.contains("no regular file"), "{error}");
        }
        fs::write(&file, b"0123456789").unwrap();
        assert_eq!(read_regular(&file, 10).unwrap(), b"0123456789");
        assert_eq!(read_regular(&file, 9).unwrap_err().kind(), io::ErrorKind::FileTooLarge);
    }

    #[test]
    fn private_files_and_folders_are_the_users_alone() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
        let (inner, file) = (folder.path().join("inner"), folder.path().join("inner/file"));
        System.create_folder(&inner).unwrap();
        System.create_new(&file, &Access::Owner).unwrap().append(b"x").unwrap();
        assert_eq!((mode(&inner), mode(&file)), (0o700, 0o600));
        let like = Access::Like(fs::Permissions::from_mode(0o640));
        System.create_new(&inner.join("like"), &like).unwrap();
        assert_eq!(mode(&inner.join("like")), 0o640);
        assert_eq!(System.create_new(&file, &like).unwrap_err().kind(), io::ErrorKind::AlreadyExists);
    }
}
