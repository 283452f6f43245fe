//! How MCAP writes records: little-endian, strings and lists behind their lengths in bytes.

/// First and last bytes of a file.
pub(crate) const MAGIC: [u8; 8] = [0x89, b'M', b'C', b'A', b'P', b'0', b'\r', b'\n'];

/// Bytes of a record before its content: opcode and length.
pub const RECORD_HEAD: usize = 9;

/// Bytes of a message before its data: channel, sequence, two times.
pub const MESSAGE_HEAD: usize = 2 + 4 + 8 + 8;

/// How chunks of ours are compressed, as readers call it.
pub(crate) const COMPRESSION: &str = "lz4";

/// Bytes of a chunk before its messages: the first and the last time, how many bytes they are and their check sum, how they are
/// compressed, and how many bytes they are then.
pub(crate) const CHUNK_HEAD: usize = 8 + 8 + 8 + 4 + (4 + COMPRESSION.len()) + 8;

/// Kinds of records.
pub mod opcode {
    pub const HEADER: u8 = 0x01;
    pub const FOOTER: u8 = 0x02;
    pub const SCHEMA: u8 = 0x03;
    pub const CHANNEL: u8 = 0x04;
    pub const MESSAGE: u8 = 0x05;
    pub const CHUNK: u8 = 0x06;
    pub const MESSAGE_INDEX: u8 = 0x07;
    pub const CHUNK_INDEX: u8 = 0x08;
    pub const ATTACHMENT: u8 = 0x09;
    pub const ATTACHMENT_INDEX: u8 = 0x0a;
    pub const STATISTICS: u8 = 0x0b;
    pub const METADATA: u8 = 0x0c;
    pub const METADATA_INDEX: u8 = 0x0d;
    pub const SUMMARY_OFFSET: u8 = 0x0e;
    pub const DATA_END: u8 = 0x0f;
    /// Ours: what was a chunk before the ring closed. Everybody skips kinds from 0x80 on.
    pub const GONE: u8 = 0x80;
}

/// Appends to a text of bytes.
pub(crate) trait Put {
    fn put_u8(&mut self, value: u8);
    fn put_u16(&mut self, value: u16);
    fn put_u32(&mut self, value: u32);
    fn put_u64(&mut self, value: u64);
    fn put_text(&mut self, value: &str);
    /// A list or map, whose length in bytes stands before it.
    fn put_list(&mut self, write: impl FnOnce(&mut Vec<u8>));
    /// A whole record.
    fn put_record(&mut self, opcode: u8, write: impl FnOnce(&mut Vec<u8>));
}

impl Put for Vec<u8> {
    fn put_u8(&mut self, value: u8) {
        self.push(value);
    }

    fn put_u16(&mut self, value: u16) {
        self.extend(value.to_le_bytes());
    }

    fn put_u32(&mut self, value: u32) {
        self.extend(value.to_le_bytes());
    }

    fn put_u64(&mut self, value: u64) {
        self.extend(value.to_le_bytes());
    }

    fn put_text(&mut self, value: &str) {
        self.put_u32(length(value.len()));
        self.extend(value.as_bytes());
    }

    fn put_list(&mut self, write: impl FnOnce(&mut Self)) {
        let start = self.len();
        self.put_u32(0);
        write(self);
        let bytes = length(self.len() - start - 4);
        self[start..start + 4].copy_from_slice(&bytes.to_le_bytes());
    }

    fn put_record(&mut self, opcode: u8, write: impl FnOnce(&mut Self)) {
        self.put_u8(opcode);
        let start = self.len();
        self.put_u64(0);
        write(self);
        let bytes = (self.len() - start - 8) as u64;
        self[start..start + 8].copy_from_slice(&bytes.to_le_bytes());
    }
}

/// Lengths are of names, maps and schemas: 4 GiB of them do not fit into memory beside the rest.
fn length(bytes: usize) -> u32 {
    u32::try_from(bytes).unwrap_or(u32::MAX)
}

/// Reads from the front; `None` where bytes are missing.
pub(crate) struct Take<'a>(pub(crate) &'a [u8]);

impl<'a> Take<'a> {
    pub(crate) fn bytes(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    pub(crate) fn u8(&mut self) -> Option<u8> {
        self.bytes(1).map(|bytes| bytes[0])
    }

    pub(crate) fn u16(&mut self) -> Option<u16> {
        Some(u16::from_le_bytes(self.bytes(2)?.try_into().ok()?))
    }

    pub(crate) fn u32(&mut self) -> Option<u32> {
        Some(u32::from_le_bytes(self.bytes(4)?.try_into().ok()?))
    }

    pub(crate) fn u64(&mut self) -> Option<u64> {
        Some(u64::from_le_bytes(self.bytes(8)?.try_into().ok()?))
    }

    pub(crate) fn text(&mut self) -> Option<&'a str> {
        let length = self.u32()?;
        std::str::from_utf8(self.bytes(length as usize)?).ok()
    }

    pub(crate) fn map(&mut self) -> Option<Vec<(String, String)>> {
        let length = self.u32()?;
        let mut entries = Take(self.bytes(length as usize)?);
        let mut map = Vec::new();
        while !entries.0.is_empty() {
            map.push((entries.text()?.to_owned(), entries.text()?.to_owned()));
        }
        Some(map)
    }

    /// The next record: its kind, its content.
    pub(crate) fn record(&mut self) -> Option<(u8, &'a [u8])> {
        let opcode = self.u8()?;
        let length = usize::try_from(self.u64()?).ok()?;
        Some((opcode, self.bytes(length)?))
    }
}

/// The first of these messages that have so many bytes together, and the others.
pub fn split_messages(messages: &[u8], bytes: usize) -> (&[u8], &[u8]) {
    let mut rest = Take(messages);
    while rest.record().is_some() {
        let end = messages.len() - rest.0.len();
        if end >= bytes {
            return messages.split_at(end);
        }
    }
    (messages, &[])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_split_behind_whole_ones() {
        let mut messages = Vec::new();
        for length in [10, 1000, 20] {
            messages.put_record(opcode::MESSAGE, |content| content.extend(vec![7; length]));
        }
        let ends = [19, 1028, 1057];
        for (bytes, end) in [
            (0, 0),
            (19, 0),
            (20, 1),
            (1028, 1),
            (1029, 2),
            (1057, 2),
            (9999, 2),
        ] {
            let split = messages.split_at(ends[end]);
            assert_eq!(split_messages(&messages, bytes), split, "{bytes}");
        }
    }

    #[test]
    fn what_is_no_whole_message_stays_with_what_is_before_it() {
        let mut messages = Vec::new();
        messages.put_record(opcode::MESSAGE, |content| content.extend([7; 10]));
        let cut = &messages[..12];
        assert_eq!(split_messages(cut, 5), (cut, &[][..]));
        assert_eq!(split_messages(&[], 5), (&[][..], &[][..]));
    }
}
