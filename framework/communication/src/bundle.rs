//! What is sent in one message: one thing, or several for a client that asked for it. A message costs a browser more than what
//! stands in it.

use axum::extract::ws::Message;

/// A text of the protocol, or a binary frame.
#[derive(Debug)]
pub(crate) enum Piece {
    Text(String),
    Frame(Vec<u8>),
}

/// Pieces that are sent together, in the order in which they came.
#[derive(Debug, Default)]
pub(crate) struct Bundle {
    texts: Vec<String>,
    frames: Vec<Vec<u8>>,
    /// In bytes, without what stands between them.
    length: usize,
}

impl Bundle {
    pub(crate) fn length(&self) -> usize {
        self.length
    }

    pub(crate) fn add(&mut self, piece: Piece) {
        match piece {
            Piece::Text(text) => {
                self.length += text.len();
                self.texts.push(text);
            }
            Piece::Frame(bytes) => {
                self.length += bytes.len();
                self.frames.push(bytes);
            }
        }
    }

    /// Texts, and behind them frames: nothing that a text says is about a frame before it.
    pub(crate) fn messages(self) -> [Option<Message>; 2] {
        [text(self.texts), binary(self.frames)]
    }
}

/// One alone as it is; several as [`protocol::Ask::Bundle`] says.
fn text(mut texts: Vec<String>) -> Option<Message> {
    match texts.len() {
        0 | 1 => texts.pop().map(Message::text),
        _ => Some(Message::text(format!("[{}]", texts.join(",")))),
    }
}

/// As [`text`], of frames.
fn binary(mut frames: Vec<Vec<u8>>) -> Option<Message> {
    if frames.len() < 2 {
        return frames.pop().map(Message::binary);
    }
    let room: usize = frames.iter().map(|frame| frame.len() + 4).sum();
    let mut bytes = Vec::with_capacity(protocol::BUNDLE_MAGIC.len() + room);
    bytes.extend_from_slice(&protocol::BUNDLE_MAGIC);
    for frame in frames {
        // None is longer: less than that waits at a time.
        let length = u32::try_from(frame.len()).unwrap_or(u32::MAX);
        bytes.extend_from_slice(&length.to_le_bytes());
        bytes.extend_from_slice(&frame);
    }
    Some(Message::binary(bytes))
}
