//! `topic echo --images`: an image of a running robot again and again, as files.

use camino::Utf8Path;
use client::Heard;
use protocol::{Encoding, Message};
use serde_json::json;

use super::again;
use super::connection::Connection;
use super::topic::{subscribe, tell_lost};
use crate::arguments::TextOrJson;
use crate::commands::terminal::Terminal;
use crate::outcome::{Outcome, Refusal};
use crate::recording::Images;

/// Good enough to look at, and a tenth of the image.
const QUALITY: u8 = 90;

/// Which images, and where they go.
pub(super) struct Wanted<'a> {
    pub(super) path: &'a str,
    pub(super) rate: Option<f64>,
    pub(super) count: Option<u64>,
    pub(super) folder: &'a Utf8Path,
    pub(super) format: TextOrJson,
}

/// Prints the file of each. What the robot calls no image, it refuses itself.
pub(super) fn save(
    terminal: &Terminal,
    connection: &mut Connection,
    wanted: &Wanted<'_>,
) -> Result<Outcome, Refusal> {
    let encoding = Encoding::Jpeg { quality: QUALITY };
    let subscription = subscribe(connection, wanted.path, wanted.rate, encoding)?;
    let images = Images::into(wanted.folder)?;
    again(wanted.count, None, || {
        loop {
            match connection.hear()? {
                // Nothing: there is no image in this cycle.
                Heard::Frame(frame)
                    if frame.subscription == subscription && !frame.value.is_empty() =>
                {
                    let file = images.keep(frame.cycle, &frame.value)?;
                    return terminal.more_data(&match wanted.format {
                        TextOrJson::Text => format!("{file}\n"),
                        TextOrJson::Json => {
                            let (cycle, time) = (frame.cycle, frame.time);
                            let line = json!({ "cycle": cycle, "time": time, "file": file });
                            format!("{line}\n")
                        }
                    });
                }
                Heard::Message(Message::Lost(lost)) => tell_lost(terminal, lost),
                _ => {}
            }
        }
    })
}
