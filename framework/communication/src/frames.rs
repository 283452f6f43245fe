//! Where the head of a client's request ends, and its frames: what reads a frame makes room for all of it once its head is there.

use std::ops::ControlFlow;

/// What signs of life may have.
const SIGN_BYTES: usize = 125;

/// The first request of a connection, up to the empty line that ends its head.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Request {
    is_begun: bool,
    is_amid_line: bool,
    is_over: bool,
}

impl Request {
    pub(crate) fn is_over(&self) -> bool {
        self.is_over
    }

    /// How many of the bytes belong to it.
    pub(crate) fn follow(&mut self, bytes: &[u8]) -> usize {
        let end = bytes.iter().position(|byte| {
            match byte {
                // Empty lines in front of it mean nothing.
                b'\n' => {
                    self.is_over |= self.is_begun && !self.is_amid_line;
                    self.is_amid_line = false;
                }
                b'\r' => {}
                _ => (self.is_begun, self.is_amid_line) = (true, true),
            }
            self.is_over
        });
        end.map_or(bytes.len(), |last| last + 1)
    }
}

/// The frames of a WebSocket.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Frames {
    head: Head,
    /// What the frame announced and has not come.
    rest: usize,
    /// What the frame gives back with its last byte.
    passing: usize,
    /// What the frames of a message that is not whole announced.
    held: usize,
}

#[derive(Clone, Copy, Debug, Default)]
struct Head {
    bytes: [u8; 14],
    length: usize,
}

impl Frames {
    /// Bytes that are held of what is not whole.
    pub(crate) fn held(&self) -> usize {
        self.held
    }

    /// How many of the bytes may come: all that are in front of a head that asks for more than fits.
    pub(crate) fn follow(&mut self, bytes: &[u8], fits: impl Fn(usize) -> bool) -> usize {
        let mut at = 0;
        while at < bytes.len() {
            if self.rest > 0 {
                let come = self.rest.min(bytes.len() - at);
                at += come;
                self.rest -= come;
            } else {
                if self.push(bytes[at], &fits).is_break() {
                    return at;
                }
                at += 1;
            }
            if self.rest == 0 {
                self.held -= std::mem::take(&mut self.passing);
            }
        }
        at
    }

    /// One byte of a head, unless it is the last of one for which there is no room.
    fn push(&mut self, byte: u8, fits: impl Fn(usize) -> bool) -> ControlFlow<()> {
        let mut head = self.head;
        head.bytes[head.length] = byte;
        head.length += 1;
        let Some(announced) = head.announced() else {
            self.head = head;
            return ControlFlow::Continue(());
        };
        let is_sign = head.is_sign();
        let counted = match is_sign && announced <= SIGN_BYTES {
            true => 0,
            false => announced,
        };
        let held = self.held.saturating_add(counted);
        if !fits(held) {
            return ControlFlow::Break(());
        }
        self.passing = match (is_sign, head.is_last()) {
            (true, _) => held - self.held,
            (false, true) => held,
            (false, false) => 0,
        };
        (self.head, self.rest, self.held) = (Head::default(), announced, held);
        ControlFlow::Continue(())
    }
}

impl Head {
    /// Close frames, pings and pongs, which may come amid a message.
    fn is_sign(&self) -> bool {
        self.bytes[0] & 0x08 != 0
    }

    /// Whether its message ends with it.
    fn is_last(&self) -> bool {
        self.bytes[0] & 0x80 != 0
    }

    /// What follows it, once it is whole.
    fn announced(&self) -> Option<usize> {
        let [_, second, rest @ ..] = self.bytes;
        if self.length < 2 {
            return None;
        }
        let short = second & 0x7F;
        let of_length = match short {
            126 => 2,
            127 => 8,
            _ => 0,
        };
        let of_mask = if second & 0x80 == 0 { 0 } else { 4 };
        let is_whole = self.length == 2 + of_length + of_mask;
        is_whole.then(|| match of_length {
            0 => short.into(),
            bytes => rest[..bytes].iter().fold(0, |length: usize, byte| {
                length.saturating_mul(256).saturating_add((*byte).into())
            }),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bytes of a frame with a mask.
    fn frame(first: u8, bytes: usize) -> Vec<u8> {
        let mut frame = vec![first];
        match (u8::try_from(bytes), u16::try_from(bytes)) {
            (Ok(short @ ..=125), _) => frame.push(0x80 | short),
            (_, Ok(middle)) => {
                frame.push(0xFE);
                frame.extend(middle.to_be_bytes());
            }
            _ => {
                frame.push(0xFF);
                frame.extend((bytes as u64).to_be_bytes());
            }
        }
        frame.extend([0; 4]);
        frame.resize(frame.len() + bytes, b'x');
        frame
    }

    #[test]
    fn a_request_ends_with_its_first_empty_line() {
        for (head, behind) in [
            ("GET / HTTP/1.1\r\nHost: here\r\n\r\n", "\r\n\r\n"),
            ("\r\n\nGET / HTTP/1.1\nHost: here\n\n", "GET"),
        ] {
            let text = format!("{head}{behind}");
            assert_eq!(Request::default().follow(text.as_bytes()), head.len());
            let mut request = Request::default();
            for byte in head.bytes() {
                assert!(!request.is_over());
                assert_eq!(request.follow(&[byte]), 1);
            }
            assert!(request.is_over());
        }
    }

    #[test]
    fn what_is_announced_is_held_until_its_message_is_whole() {
        let most = |bytes| bytes <= 70_000;
        let said = [
            (frame(0x81, 100), 0),
            (frame(0x01, 300), 300),
            (frame(0x89, 125), 300),
            (frame(0x00, 69_700), 70_000),
            (frame(0x80, 0), 0),
            (frame(0x82, 70_000), 0),
            (frame(0x89, 70_000), 0),
        ];
        for piece in [1, 3, 1 << 20] {
            let mut frames = Frames::default();
            for (bytes, held) in &said {
                for piece in bytes.chunks(piece) {
                    assert_eq!(frames.follow(piece, most), piece.len());
                }
                assert_eq!(frames.held(), *held);
            }
        }
    }

    #[test]
    fn nothing_comes_of_a_head_that_asks_for_too_much() {
        let small = frame(0x81, 100);
        for (first, bytes) in [(0x81, 1001), (0x02, 70_000), (0x89, 2000)] {
            let long = frame(first, bytes);
            let head = long.len() - bytes;
            let all = [&small[..], &long].concat();
            let mut frames = Frames::default();
            let come = frames.follow(&all, |bytes| bytes <= 1000);
            assert_eq!(come, small.len() + head - 1);
            assert_eq!(frames.follow(&all[come..], |bytes| bytes <= 1000), 0);
            assert_eq!(frames.held(), 0);
            // Room may be found later.
            assert_eq!(frames.follow(&all[come..], |_| true), all.len() - come);
        }
        let endless = [
            0x81, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0, 0,
        ];
        assert_eq!(
            Frames::default().follow(&endless, |bytes| bytes < usize::MAX),
            13
        );
    }
}
