//! The folder with the answers: a file for each, the oldest make room for new ones.

use std::fs;
use std::io::{self, Write as _};
use std::time::SystemTime;

use camino::{Utf8Path, Utf8PathBuf};

/// Answers that are kept; one is some ten kilobytes.
const MOST: usize = 64;

/// Bytes; no answer is larger.
const LARGEST: u64 = 64 << 20;

/// How the name of every file in the folder begins.
const PREFIX: &str = "answer-";

/// A folder that may not exist yet.
#[derive(Clone, Debug)]
pub(super) struct Folder(Utf8PathBuf);

impl Folder {
    pub(super) fn new(folder: Utf8PathBuf) -> Self {
        Self(folder)
    }

    /// The text of a file, if there is one that can be read.
    pub(super) fn read(&self, name: &str) -> Option<String> {
        let path = self.path(name);
        // Asked before it is opened: a pipe would wait for somebody who writes.
        let about = fs::metadata(&path).ok()?;
        let plain = about.is_file() && about.len() <= LARGEST;
        plain.then(|| fs::read_to_string(path).ok())?
    }

    /// Writes a file whole or not at all; what cannot be written is not kept.
    pub(super) fn write(&self, name: &str, text: &str) {
        if self.try_write(name, text).is_ok() {
            self.make_room();
        }
    }

    fn try_write(&self, name: &str, text: &str) -> io::Result<()> {
        create(&self.0)?;
        let mut file = tempfile::Builder::new()
            .prefix(PREFIX)
            .tempfile_in(&self.0)?;
        file.write_all(text.as_bytes())?;
        file.persist(self.path(name)).map_err(|error| error.error)?;
        Ok(())
    }

    /// Removes the oldest answers beyond [`MOST`], and what was left half-written long ago.
    fn make_room(&self) {
        let Ok(entries) = self.0.read_dir_utf8() else {
            return;
        };
        let own = entries
            .flatten()
            .filter(|entry| entry.file_name().starts_with(PREFIX));
        let mut files: Vec<(SystemTime, Utf8PathBuf)> = own
            .filter_map(|entry| Some((entry.metadata().ok()?.modified().ok()?, entry.into_path())))
            .collect();
        files.sort();
        let old = files.len().saturating_sub(MOST);
        for (_, path) in &files[..old] {
            // Somebody else may have been faster.
            let _ = fs::remove_file(path);
        }
    }

    fn path(&self, name: &str) -> Utf8PathBuf {
        self.0.join(format!("{PREFIX}{name}"))
    }
}

/// Creates a folder that is its owner's alone: nobody else shall give answers.
fn create(folder: &Utf8Path) -> io::Result<()> {
    use std::os::unix::fs::DirBuilderExt as _;
    fs::DirBuilder::new()
        .recursive(true)
        .mode(0o700)
        .create(folder)
}
