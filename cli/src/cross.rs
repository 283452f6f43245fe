//! The fourth door: what builds programs for other machines, in the user's cache folder; and the programs themselves, read to
//! tell whether they would start there.
//!
//! Invariant: tools are pinned and checked by digest; a folder of tools that is not whole is not used.

mod elf;
mod flags;
mod processor;
mod requirements;
mod tools;
mod verdict;

use camino::Utf8Path;

pub use elf::{Elf, Version};
pub use flags::{ENCODED, Flags};
pub use processor::Processor;
pub use tools::Tools;
pub(crate) use tools::python;
pub use verdict::{Wanted, WrongTriple, objections};

use crate::outcome::Refusal;

/// Reads a program that was built, and its size in bytes.
///
/// # Errors
/// If it cannot be read, or is no program that a Linux machine could load.
pub fn inspect(program: &Utf8Path) -> Result<(Elf, u64), Refusal> {
    let bytes = std::fs::read(program)
        .map_err(|error| Refusal::bad(format!("cannot read {program}: {error}")))?;
    let elf = Elf::read(&bytes)
        .map_err(|reason| Refusal::bad(format!("{program} is no program for Linux: {reason}")))?;
    Ok((elf, bytes.len() as u64))
}
