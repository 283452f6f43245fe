//! The file of a recording, whose disk may fail while the robot runs: that is told once, when it happens.

use std::fs::File;
use std::io::{self, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use hulkgen_recording::{Description, Recorder, Rewrites, Settings, Storage, Track, Writer};

use crate::report::tell;

/// As [`Recorder::start_rewriting`], with a disk that tells its first error.
pub(super) fn start(
    path: &Path,
    description: Description,
    tracks: &[&str],
    settings: Settings,
    rewrites: Rewrites,
) -> io::Result<(Recorder, Vec<Track>)> {
    let file = File::options().write(true).create_new(true).open(path)?;
    let is_begun = Arc::new(AtomicBool::new(false));
    let disk = Disk {
        storage: file,
        path: path.to_owned(),
        tell: |path, error| tell(format_args!("{}", text(path, error))),
        is_begun: is_begun.clone(),
        is_told: false,
    };
    let writer = Writer::onto(Box::new(disk), description, settings.budget)?;
    // Relaxed: the thread that writes is begun behind it.
    is_begun.store(true, Ordering::Relaxed);
    Recorder::start_writing(path, writer, tracks, settings, rewrites)
}

/// What is told of it.
fn text(path: &Path, error: &io::Error) -> String {
    let room = match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "where the file system can give back their place, the oldest cycles of the recording make room for new ones, down to half of them; "
        }
        _ => "",
    };
    let path = path.display();
    format!(
        "recording {path}: {error}; {room}what the disk does not take is lost, the robot goes on"
    )
}

/// A file whose first error is told, by the thread that writes.
#[derive(Debug)]
struct Disk<S> {
    storage: S,
    path: PathBuf,
    tell: fn(&Path, &io::Error),
    /// Until then whoever starts the recording gets the error.
    is_begun: Arc<AtomicBool>,
    is_told: bool,
}

impl<S> Disk<S> {
    fn told<T>(&mut self, result: io::Result<T>) -> io::Result<T> {
        if let Err(error) = &result
            && error.kind() != ErrorKind::Interrupted
            && !self.is_told
            && self.is_begun.load(Ordering::Relaxed)
        {
            self.is_told = true;
            (self.tell)(&self.path, error);
        }
        result
    }
}

impl<S: Storage> Write for Disk<S> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.storage.write(bytes);
        self.told(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let flushed = self.storage.flush();
        self.told(flushed)
    }
}

impl<S: Storage> Seek for Disk<S> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let sought = self.storage.seek(to);
        self.told(sought)
    }
}

impl<S: Storage> Storage for Disk<S> {
    fn set_len(&mut self, length: u64) -> io::Result<()> {
        let set = self.storage.set_len(length);
        self.told(set)
    }

    fn sync_all(&mut self) -> io::Result<()> {
        let synced = self.storage.sync_all();
        self.told(synced)
    }

    fn give_back(&mut self, offset: u64, bytes: u64) -> bool {
        self.storage.give_back(offset, bytes)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicUsize;

    use super::*;

    static TOLD: AtomicUsize = AtomicUsize::new(0);

    /// No byte has room.
    #[derive(Debug)]
    struct Full;

    impl Write for Full {
        fn write(&mut self, _bytes: &[u8]) -> io::Result<usize> {
            Err(ErrorKind::StorageFull.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    impl Seek for Full {
        fn seek(&mut self, _to: SeekFrom) -> io::Result<u64> {
            Ok(0)
        }
    }

    impl Storage for Full {
        fn set_len(&mut self, _length: u64) -> io::Result<()> {
            Ok(())
        }

        fn sync_all(&mut self) -> io::Result<()> {
            Ok(())
        }

        fn give_back(&mut self, _offset: u64, _bytes: u64) -> bool {
            false
        }
    }

    #[test]
    fn the_first_error_of_the_disk_is_told_and_no_other() {
        let mut disk = Disk {
            storage: Full,
            path: PathBuf::from("run.mcap"),
            tell: |path, error| {
                assert_eq!(path, Path::new("run.mcap"));
                assert_eq!(error.kind(), ErrorKind::StorageFull);
                TOLD.fetch_add(1, Ordering::Relaxed);
            },
            is_begun: Arc::default(),
            is_told: false,
        };
        disk.write_all(b"head").expect_err("there is no room");
        assert_eq!(TOLD.load(Ordering::Relaxed), 0, "it is not begun");
        disk.is_begun.store(true, Ordering::Relaxed);
        disk.set_len(0).expect("it does nothing");
        assert_eq!(TOLD.load(Ordering::Relaxed), 0);
        for _ in 0..3 {
            disk.write_all(b"frame").expect_err("there is no room");
            assert_eq!(TOLD.load(Ordering::Relaxed), 1);
        }
    }

    #[test]
    fn a_full_disk_is_not_told_that_everything_makes_room() {
        let told = |kind: ErrorKind| text(Path::new("run.mcap"), &kind.into());
        for full in [ErrorKind::StorageFull, ErrorKind::QuotaExceeded] {
            let told = told(full);
            let condition = "where the file system can give back their place, the oldest cycles";
            assert!(told.contains(condition), "{told}");
        }
        let broken = told(ErrorKind::Other);
        assert!(!broken.contains("make room"), "{broken}");
    }
}
