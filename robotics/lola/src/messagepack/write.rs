//! Owns writing: every value in its shortest form, floats in single precision.

/// Appends values to bytes, whose heap is kept by who owns them.
pub(crate) struct Writer<'a> {
    bytes: &'a mut Vec<u8>,
}

impl<'a> Writer<'a> {
    /// Starts a map of at most 15 keys in place of what `bytes` held.
    pub(crate) fn map(bytes: &'a mut Vec<u8>, keys: u8) -> Self {
        debug_assert!(keys < 16, "a map with more keys has another marker");
        bytes.clear();
        bytes.push(0x80 | keys);
        Self { bytes }
    }

    /// A text of at most 31 bytes.
    pub(crate) fn text(&mut self, text: &str) {
        debug_assert!(text.len() < 32, "a longer text has another marker");
        self.bytes.push(0xa0 | text.len() as u8);
        self.bytes.extend_from_slice(text.as_bytes());
    }

    /// A key with the head of its array; the values follow.
    pub(crate) fn array(&mut self, key: &str, values: u16) {
        self.text(key);
        match u8::try_from(values) {
            Ok(short @ 0..16) => self.bytes.push(0x90 | short),
            _ => {
                self.bytes.push(0xdc);
                self.bytes.extend_from_slice(&values.to_be_bytes());
            }
        }
    }

    /// A key with an array of floats.
    pub(crate) fn floats<const VALUES: usize>(&mut self, key: &str, values: [f32; VALUES]) {
        self.array(key, VALUES as u16);
        for value in values {
            self.bytes.push(0xca);
            self.bytes.extend_from_slice(&value.to_be_bytes());
        }
    }

    /// A number from 0 to 127; greater ones take one byte more.
    pub(crate) fn byte(&mut self, value: u8) {
        if value > 0x7f {
            self.bytes.push(0xcc);
        }
        self.bytes.push(value);
    }

    pub(crate) fn boolean(&mut self, value: bool) {
        self.bytes.push(0xc2 | u8::from(value));
    }
}
