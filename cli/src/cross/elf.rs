//! Reads what a program of Linux needs to start: its machine, its libraries, the versions of glibc that it asks for.
//!
//! Little-endian ELF of 64 bits, by its program headers (System V ABI, and the GNU symbol versioning of the Linux Standard
//! Base). Invariant: whatever the bytes are, reading them ends with an answer or an error.

use std::fmt;

/// What a program needs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Elf {
    /// `e_machine`: 62 is x86_64, 183 is aarch64.
    pub machine: u16,
    /// The program that loads it; none where it is static.
    pub interpreter: Option<String>,
    /// Libraries that must be there.
    pub libraries: Vec<String>,
    /// The newest version of glibc that it asks for.
    pub glibc: Option<Version>,
}

/// A version of glibc.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Version {
    pub major: u32,
    pub minor: u32,
}

impl Version {
    /// Reads `2.28`, also where a patch level follows.
    pub fn parse(text: &str) -> Option<Self> {
        let mut numbers = text.split('.').map(str::parse);
        let (major, minor) = (numbers.next()?.ok()?, numbers.next()?.ok()?);
        Some(Self { major, minor })
    }
}

impl fmt::Display for Version {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}.{}", self.major, self.minor)
    }
}

const LOAD: u32 = 1;
const DYNAMIC: u32 = 2;
const INTERPRETER: u32 = 3;

const NEEDED: u64 = 1;
const STRINGS: u64 = 5;
const VERSIONS: u64 = 0x6fff_fffe;
const VERSION_COUNT: u64 = 0x6fff_ffff;

/// A part of the file.
#[derive(Clone, Copy)]
struct Segment {
    kind: u32,
    offset: usize,
    address: u64,
    length: usize,
}

impl Elf {
    /// # Errors
    /// Says what is wrong with the bytes.
    pub fn read(bytes: &[u8]) -> Result<Self, &'static str> {
        // 64 bits, little-endian.
        if bytes.get(..6) != Some(b"\x7fELF\x02\x01") {
            return Err("it is no little-endian ELF file of 64 bits");
        }
        let segments = segments(bytes).ok_or("its program headers are cut off")?;
        let mut elf = Self {
            machine: half(bytes, 18).ok_or("its header is cut off")?,
            ..Self::default()
        };
        let part = |kind| segments.iter().find(|segment| segment.kind == kind);
        if let Some(segment) = part(INTERPRETER) {
            elf.interpreter = text(bytes, segment.offset).map(str::to_owned);
        }
        if let Some(segment) = part(DYNAMIC) {
            elf.read_dynamic(bytes, &segments, segment)
                .ok_or("what it says about its libraries is garbled")?;
        }
        Ok(elf)
    }

    fn read_dynamic(&mut self, bytes: &[u8], all: &[Segment], dynamic: &Segment) -> Option<()> {
        let end = dynamic.offset.checked_add(dynamic.length)?;
        let entries: Vec<(u64, u64)> = bytes
            .get(dynamic.offset..end)?
            .chunks_exact(16)
            .filter_map(|entry| Some((long(entry, 0)?, long(entry, 8)?)))
            .take_while(|(tag, _)| *tag != 0)
            .collect();
        let value = |wanted| {
            entries
                .iter()
                .find(|(tag, _)| *tag == wanted)
                .map(|it| it.1)
        };
        let strings = place(all, value(STRINGS)?)?;
        let name = |offset: u64| text(bytes, strings.checked_add(usize::try_from(offset).ok()?)?);
        for (_, offset) in entries.iter().filter(|(tag, _)| *tag == NEEDED) {
            self.libraries.push(name(*offset)?.to_owned());
        }
        let Some(versions) = value(VERSIONS) else {
            return Some(());
        };
        let mut at = place(all, versions)?;
        for _ in 0..value(VERSION_COUNT)? {
            let mut entry = at.checked_add(word(bytes, at + 8)? as usize)?;
            for _ in 0..half(bytes, at + 2)? {
                let version = name(word(bytes, entry + 8)?.into())?;
                let glibc = version.strip_prefix("GLIBC_").and_then(Version::parse);
                self.glibc = self.glibc.max(glibc);
                entry = entry.checked_add(word(bytes, entry + 12)? as usize)?;
            }
            match word(bytes, at + 12)? as usize {
                0 => break,
                next => at = at.checked_add(next)?,
            }
        }
        Some(())
    }
}

fn segments(bytes: &[u8]) -> Option<Vec<Segment>> {
    let start = usize::try_from(long(bytes, 32)?).ok()?;
    let (size, count) = (usize::from(half(bytes, 54)?), usize::from(half(bytes, 56)?));
    let segment = |number: usize| {
        let at = start.checked_add(number * size)?;
        Some(Segment {
            kind: word(bytes, at)?,
            offset: usize::try_from(long(bytes, at.checked_add(8)?)?).ok()?,
            address: long(bytes, at + 16)?,
            length: usize::try_from(long(bytes, at + 32)?).ok()?,
        })
    };
    (0..count).map(segment).collect()
}

/// Where in the file that stands which the program finds at an address.
fn place(segments: &[Segment], address: u64) -> Option<usize> {
    let is_in = |segment: &&Segment| {
        let into = address.checked_sub(segment.address);
        segment.kind == LOAD && into.is_some_and(|into| into < segment.length as u64)
    };
    let segment = segments.iter().find(is_in)?;
    let into = usize::try_from(address - segment.address).ok()?;
    segment.offset.checked_add(into)
}

fn text(bytes: &[u8], at: usize) -> Option<&str> {
    let rest = bytes.get(at..)?;
    let length = rest.iter().position(|byte| *byte == 0)?;
    std::str::from_utf8(&rest[..length]).ok()
}

fn number<const BYTES: usize>(bytes: &[u8], at: usize) -> Option<[u8; BYTES]> {
    bytes.get(at..at.checked_add(BYTES)?)?.try_into().ok()
}

fn half(bytes: &[u8], at: usize) -> Option<u16> {
    number(bytes, at).map(u16::from_le_bytes)
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    number(bytes, at).map(u32::from_le_bytes)
}

fn long(bytes: &[u8], at: usize) -> Option<u64> {
    number(bytes, at).map(u64::from_le_bytes)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// This program, as the linker made it.
    fn own() -> Vec<u8> {
        let path = std::env::current_exe().expect("it runs");
        std::fs::read(path).expect("it is there")
    }

    #[test]
    fn a_program_says_what_it_needs() {
        let elf = Elf::read(&own()).expect("it is a program");
        assert_eq!(elf.machine, 62);
        let interpreter = elf.interpreter.expect("it is not static");
        assert!(interpreter.starts_with("/lib64/ld-linux"), "{interpreter}");
        assert!(
            elf.libraries.contains(&"libc.so.6".to_owned()),
            "{:?}",
            elf.libraries
        );
        let glibc = elf.glibc.expect("std is linked to glibc");
        assert!(
            glibc
                >= Version {
                    major: 2,
                    minor: 17
                },
            "{glibc}"
        );
    }

    #[test]
    fn whatever_the_bytes_are_reading_ends() {
        let mut bytes = own();
        for length in (0..2000).chain([bytes.len() / 2, bytes.len() - 1]) {
            let _ = Elf::read(&bytes[..length]);
        }
        // The headers, byte by byte.
        for at in 0..1200 {
            bytes[at] ^= 0xff;
            let _ = Elf::read(&bytes);
            bytes[at] ^= 0xff;
        }
        assert!(Elf::read(b"#!/bin/sh\n").is_err());
    }

    #[test]
    fn versions_are_numbers_and_no_texts() {
        let version = |text| Version::parse(text).expect("it is one");
        assert!(version("2.9") < version("2.28"));
        assert_eq!(version("2.2.5"), Version { major: 2, minor: 2 });
        assert_eq!(Version::parse("PRIVATE"), None);
    }
}
