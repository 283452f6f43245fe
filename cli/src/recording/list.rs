//! The recordings in a folder of runs.

use std::fs;

use camino::{Utf8Path, Utf8PathBuf};
use hulkgen_mcap::RecordingFile;
use serde::Serialize;

use crate::outcome::Refusal;

/// Folders inside of each other that are looked into.
const DEPTH: usize = 3;

/// One recording.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Run {
    pub file: Utf8PathBuf,
    /// `COMPLETE`, `INCOMPLETE`, or `UNREADABLE`.
    pub state: &'static str,
    /// From its first to its last message.
    pub duration_s: f64,
    /// Of the file, holes of a ring not counted.
    pub bytes: u64,
    pub robot: Option<String>,
    /// Unix seconds.
    pub started: Option<u64>,
}

/// All files `*.mcap` below a folder, by name.
pub fn list(folder: &Utf8Path) -> Result<Vec<Run>, Refusal> {
    let mut files = Vec::new();
    collect(folder, DEPTH, &mut files).map_err(|error| {
        Refusal::wrong_usage(format!("cannot read the folder `{folder}`: {error}"))
            .help("name a folder of recordings: `hulkgen recording list FOLDER`")
    })?;
    files.sort();
    Ok(files.iter().map(|file| describe(file)).collect())
}

fn collect(folder: &Utf8Path, depth: usize, files: &mut Vec<Utf8PathBuf>) -> std::io::Result<()> {
    for entry in folder.read_dir_utf8()? {
        let entry = entry?;
        let path = entry.path();
        let kind = entry.file_type()?;
        if kind.is_dir() && depth > 1 {
            // What cannot be read has no recordings for us.
            let _ = collect(path, depth - 1, files);
        } else if kind.is_file() && path.extension() == Some("mcap") {
            files.push(path.to_owned());
        }
    }
    Ok(())
}

fn describe(path: &Utf8Path) -> Run {
    let bytes = fs::metadata(path).map_or(0, |metadata| used(&metadata));
    let unreadable = Run {
        file: path.to_owned(),
        state: "UNREADABLE",
        duration_s: 0.0,
        bytes,
        robot: None,
        started: None,
    };
    let Ok(file) = RecordingFile::open(path.as_std_path()) else {
        return unreadable;
    };
    let contents = file.contents();
    let run = |key| contents.metadata("run").and_then(|run| run.get(key));
    Run {
        state: super::info::state(contents.is_complete()),
        duration_s: super::info::duration(contents),
        robot: run("robot").map(ToOwned::to_owned),
        started: run("started").and_then(|text| text.parse().ok()),
        ..unreadable
    }
}

/// Bytes on the disk.
pub(super) fn used(metadata: &fs::Metadata) -> u64 {
    use std::os::unix::fs::MetadataExt as _;
    metadata.len().min(metadata.blocks() * 512)
}
