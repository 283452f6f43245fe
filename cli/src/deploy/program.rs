//! For which machine a program was built.

use std::fs::File;
use std::io::Read as _;

use camino::Utf8Path;

use crate::outcome::Refusal;

/// `e_machine` at byte 18 of an ELF header (elf(5)), and what `uname -m` calls these machines.
const MACHINES: &[(u16, &[&str])] = &[
    (3, &["i386", "i486", "i586", "i686"]),
    (40, &["armv6l", "armv7l", "armv8l", "arm"]),
    (62, &["x86_64"]),
    (183, &["aarch64"]),
    (243, &["riscv64"]),
];

/// What `uname -m` may say on a machine that can start the program: the first is its name.
pub(super) fn machines(program: &Utf8Path) -> Result<&'static [&'static str], Refusal> {
    let mut head = [0; 20];
    File::open(program)
        .and_then(|mut file| file.read_exact(&mut head))
        .map_err(|error| Refusal::bad(format!("cannot read `{program}`: {error}")))?;
    of_header(&head).ok_or_else(|| {
        Refusal::bad(format!(
            "`{program}` is no program for a Linux machine that hulkgen knows"
        ))
        .help("give the file that `hulkgen build` or `cargo build` wrote")
    })
}

fn of_header(head: &[u8; 20]) -> Option<&'static [&'static str]> {
    if !head.starts_with(b"\x7fELF") {
        return None;
    }
    let bytes = [head[18], head[19]];
    // Byte 5 is the order of the others: 2 is the great end first.
    let machine = if head[5] == 2 {
        u16::from_be_bytes(bytes)
    } else {
        u16::from_le_bytes(bytes)
    };
    let known = MACHINES.iter().find(|(number, _)| *number == machine)?;
    Some(known.1)
}

#[cfg(test)]
mod tests {
    use super::of_header;

    fn header(machine: u8) -> [u8; 20] {
        let mut head = [0; 20];
        head[..6].copy_from_slice(b"\x7fELF\x02\x01");
        head[18] = machine;
        head
    }

    #[test]
    fn the_machine_stands_in_the_header() {
        assert_eq!(of_header(&header(62)), Some(&["x86_64"][..]));
        assert_eq!(of_header(&header(183)), Some(&["aarch64"][..]));
        assert_eq!(of_header(&header(99)), None);
        assert_eq!(of_header(&[0; 20]), None);
    }
}
