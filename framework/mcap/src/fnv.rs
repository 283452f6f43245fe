//! A number that stands for bytes: FNV-1a of 64 bits (<http://www.isthe.com/chongo/tech/comp/fnv>).

/// The number, as far as bytes were added. It tells accidents from each other, not attempts to deceive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fnv(u64);

const BASIS: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0000_0100_0000_01b3;

impl Default for Fnv {
    fn default() -> Self {
        Self(BASIS)
    }
}

impl Fnv {
    /// Of these bytes alone.
    pub fn of(bytes: &[u8]) -> u64 {
        let mut all = Self::default();
        all.add(bytes);
        all.value()
    }

    /// Adds bytes behind those that were added before.
    #[inline]
    pub fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(PRIME);
        }
    }

    #[inline]
    pub fn value(self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::Fnv;

    #[test]
    fn it_is_what_its_authors_say() {
        assert_eq!(Fnv::of(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(Fnv::of(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(Fnv::of(b"foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn it_does_not_matter_in_how_many_parts_bytes_come() {
        let mut all = Fnv::default();
        all.add(b"foo");
        all.add(b"bar");
        assert_eq!(all.value(), Fnv::of(b"foobar"));
    }
}
