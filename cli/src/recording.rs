//! What recordings say, without a robot and its types: the files tell how their values are laid out.
//!
//! Invariant: one chunk at a time is in memory, however large a file is. This is the door to recordings: only it reads them,
//! and writes what is made of them; nothing that exists is overwritten.

mod export;
mod images;
mod info;
mod list;
mod values;

#[cfg(test)]
pub(crate) mod tests;

use std::fs::File;
use std::io::Read as _;

use camino::{Utf8Path, Utf8PathBuf};
use hulkgen_mcap::RecordingFile;

use crate::outcome::{Outcome, Refusal};

pub use export::{Export, Exported, export};
pub use images::Images;
pub use info::{Info, InstanceInfo, PartInfo, info};
pub use list::{Run, list};
pub(crate) use values::part;
pub use values::{Found, Selection, Shown, Span, cat};

/// Encodings of the channels that a robot's recording has; all others are JSON or nothing that hulkgen knows.
const FRAMES: &str = "hulkgen-frames";
const VALUES: &str = "hulkgen-values";
const JSON: &str = "json";

/// The channel of what was said.
const LOGS: &str = "logs";

/// The metadata entry of a channel of frames that names their types.
const TYPES: &str = "types";

/// A file that can be read, or why it cannot.
pub fn open(path: &Utf8Path) -> Result<RecordingFile, Refusal> {
    RecordingFile::open(path.as_std_path()).map_err(|error| match path.exists() {
        true => Refusal::bad(format!("cannot read `{path}`: {error}")),
        false => Refusal {
            outcome: Outcome::Bad,
            ..missing(path)
        },
    })
}

/// What every MCAP file begins with (MCAP specification, "Magic").
const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";

/// Looks whether it can be a recording, before a robot is built that reads it.
pub fn look_at(path: &Utf8Path) -> Result<(), Refusal> {
    if !path.is_file() {
        return Err(missing(path));
    }
    let mut begin = [0; MAGIC.len()];
    let read = File::open(path).and_then(|mut file| file.read_exact(&mut begin));
    match read {
        Ok(()) if begin == MAGIC => Ok(()),
        Err(error) if error.kind() != std::io::ErrorKind::UnexpectedEof => {
            Err(Refusal::bad(format!("cannot read `{path}`: {error}")))
        }
        _ => Err(Refusal::bad(format!(
            "cannot read `{path}`: it is no MCAP file"
        ))),
    }
}

/// There is no such recording: where to look for one.
pub fn missing(path: &Utf8Path) -> Refusal {
    Refusal::wrong_usage(format!("there is no recording `{path}`")).help(
        "a run says where it records (`runs/<start>-<process>/recording.mcap`); `hulkgen recording list` names what is below `runs`",
    )
}

/// What became of a file that breaks off.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recovered {
    pub into: Utf8PathBuf,
    /// In the new file.
    pub chunks: u64,
    /// Bytes behind the last whole chunk.
    pub lost: u64,
    /// Offsets of chunks that are damaged.
    pub damaged: Vec<u64>,
    /// Offsets of metadata and attachments that are damaged.
    pub unreadable: Vec<u64>,
}

/// Writes a whole file with all whole chunks of this one.
pub fn recover(path: &Utf8Path, into: Option<&Utf8Path>) -> Result<Recovered, Refusal> {
    let into = into.map_or_else(|| path.with_extension("recovered.mcap"), Utf8Path::to_owned);
    if into.exists() {
        let refusal = Refusal::wrong_usage(format!("`{into}` exists"));
        return Err(refusal.help("name another file with `--into FILE`"));
    }
    let file = open(path)?;
    let recovered = hulkgen_mcap::recover(&file, into.as_std_path())
        .map_err(|error| Refusal::bad(format!("cannot recover `{path}` into `{into}`: {error}")))?;
    Ok(Recovered {
        into,
        chunks: recovered.chunks,
        lost: recovered.lost,
        damaged: recovered.damaged,
        unreadable: recovered.unreadable,
    })
}
