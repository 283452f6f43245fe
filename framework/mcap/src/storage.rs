//! What a recording is written onto.

use std::fmt::Debug;
use std::fs::File;
use std::io::{self, Seek, Write};

use rustix::fs::{FallocateFlags, fallocate};

/// A file, or what does as a file does: a slow one for tests, one that is copied elsewhere meanwhile.
pub trait Storage: Write + Seek + Debug + Send {
    /// Ends it there.
    ///
    /// # Errors
    /// Those of the file.
    fn set_len(&mut self, length: u64) -> io::Result<()>;

    /// Waits until everything is on the disk.
    ///
    /// # Errors
    /// Those of the file.
    fn sync_all(&mut self) -> io::Result<()>;

    /// Gives so many bytes from there on back to the disk, where it can: they are zeros, or what they were. Whether it could;
    /// that is asked of bytes behind the end, too, of which there are none.
    fn give_back(&mut self, offset: u64, bytes: u64) -> bool;
}

/// Whether the disk, or what of it one may have, is full: it takes more where some is given back.
pub(crate) fn is_full(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded
    )
}

impl Storage for File {
    fn set_len(&mut self, length: u64) -> io::Result<()> {
        Self::set_len(self, length)
    }

    fn sync_all(&mut self) -> io::Result<()> {
        Self::sync_all(self)
    }

    fn give_back(&mut self, offset: u64, bytes: u64) -> bool {
        let hole = FallocateFlags::PUNCH_HOLE | FallocateFlags::KEEP_SIZE;
        // Where a file system cannot punch holes, the file grows on: what is in it stays right.
        fallocate(&*self, hole, offset, bytes).is_ok()
    }
}
