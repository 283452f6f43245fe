//! Digests of what a cycle wrote, as a frame ends with them.

use hulkgen_recording::Writing;
use serde::Serialize;

use super::digest;
use crate::digest::DigestError;

/// Bytes of one digest.
pub(crate) const DIGEST: usize = 8;

/// Digests on their way into a frame. What goes wrong is told once, by [`Self::end`].
#[derive(Debug)]
pub struct Digests<'a, 'block> {
    writing: &'a mut Writing<'block>,
    refused: Option<DigestError>,
}

impl<'a, 'block> Digests<'a, 'block> {
    /// Into this message.
    pub fn new(writing: &'a mut Writing<'block>) -> Self {
        Self {
            writing,
            refused: None,
        }
    }

    /// Appends the digest of an output.
    // One call for each output, of which many are of one type: all of it comes out of cold caches.
    #[inline(never)]
    pub fn add(&mut self, output: &impl Serialize) {
        match digest(output) {
            Ok(digest) => self.add_digest(digest),
            Err(error) => self.refuse(error),
        }
    }

    /// Appends what was digested before.
    #[inline]
    pub fn add_digest(&mut self, digest: u64) {
        self.writing.add(digest.to_le_bytes());
    }

    #[cold]
    #[inline(never)]
    fn refuse(&mut self, error: DigestError) {
        self.refused.get_or_insert(error);
    }

    /// Whether all outputs had a digest; whether all digests had room, the message tells.
    ///
    /// # Errors
    /// If a value's own `Serialize` failed.
    pub fn end(self) -> Result<(), DigestError> {
        self.refused.map_or(Ok(()), Err)
    }
}

#[cfg(test)]
mod tests {
    use serde::ser::{Error as _, Serializer};

    use super::*;

    struct Refusing;

    impl Serialize for Refusing {
        fn serialize<S: Serializer>(&self, _: S) -> Result<S::Ok, S::Error> {
            Err(S::Error::custom("not today"))
        }
    }

    #[test]
    fn digests_stand_one_after_the_other_and_the_first_refusal_is_told() {
        let mut bytes = [0; 2 * DIGEST];
        let mut writing = Writing::new(&mut bytes);
        let mut digests = Digests::new(&mut writing);
        digests.add(&[1.0_f32, 2.0]);
        digests.add_digest(7);
        assert!(digests.end().is_ok());
        let expected = digest(&[1.0_f32, 2.0]).expect("numbers have one");
        let (whole, _) = bytes.as_chunks();
        let whole: Vec<_> = whole.iter().copied().map(u64::from_le_bytes).collect();
        assert_eq!(whole, [expected, 7]);

        let mut writing = Writing::new(&mut bytes);
        let mut digests = Digests::new(&mut writing);
        digests.add(&Refusing);
        digests.add(&3_u8);
        let error = digests.end().unwrap_err().to_string();
        assert_eq!(error, "not today");
    }
}
