//! A number that stands for bytes: FNV-1a of 64 bits (<http://www.isthe.com/chongo/tech/comp/fnv>).

const BASIS: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0000_0100_0000_01b3;

/// FNV-1a of these bytes. It tells accidents, not attempts to deceive.
pub fn fnv(bytes: &[u8]) -> u64 {
    bytes.iter().fold(BASIS, |number, byte| {
        (number ^ u64::from(*byte)).wrapping_mul(PRIME)
    })
}

#[cfg(test)]
mod tests {
    use super::fnv;

    #[test]
    fn it_is_what_its_authors_say() {
        assert_eq!(fnv(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
