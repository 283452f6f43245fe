//! For which machine a program was built, and which machines start it.

use std::fs::File;
use std::io::Read as _;

use camino::Utf8Path;

use crate::outcome::Refusal;

/// A kind of machine: what ELF, rustc and `uname -m` call it.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Machine {
    /// `e_machine` at byte 18 of an ELF header (elf(5)).
    elf: u16,
    /// First words of triples of rustc.
    triples: &'static [&'static str],
    /// `uname -m` of such machines: the first is its name.
    names: &'static [&'static str],
    /// `uname -m` of machines of twice as many bits, which start its programs where the system has the libraries.
    larger: &'static [&'static str],
}

/// Of machines with the same number the first runs programs of all.
const MACHINES: &[Machine] = &[
    Machine {
        elf: 3,
        triples: &["i386", "i486", "i586", "i686"],
        names: &["i386", "i486", "i586", "i686"],
        larger: &["x86_64"],
    },
    Machine {
        elf: 40,
        triples: &["arm"],
        names: &["arm", "armv6l", "armv7l", "armv8l"],
        larger: &["aarch64"],
    },
    Machine {
        elf: 40,
        triples: &["armv7", "thumbv7neon"],
        names: &["armv7l", "armv8l"],
        larger: &["aarch64"],
    },
    Machine {
        elf: 62,
        triples: &["x86_64"],
        names: &["x86_64"],
        larger: &[],
    },
    Machine {
        elf: 183,
        triples: &["aarch64"],
        names: &["aarch64"],
        larger: &[],
    },
    Machine {
        elf: 243,
        triples: &["riscv64", "riscv64a23", "riscv64gc"],
        names: &["riscv64"],
        larger: &[],
    },
];

/// Whether a machine starts a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fit {
    Starts,
    /// If its system has libraries for programs of half as many bits.
    StartsAsSmaller,
    Fails,
}

impl Machine {
    pub(crate) fn name(&self) -> &'static str {
        self.names[0]
    }

    /// What a machine of which `uname -m` says this does with its programs.
    pub(crate) fn fit(&self, said: &str) -> Fit {
        match said {
            said if self.names.contains(&said) => Fit::Starts,
            said if self.larger.contains(&said) => Fit::StartsAsSmaller,
            _ => Fit::Fails,
        }
    }
}

/// What a machine of which `uname -m` says this does with programs for a triple.
pub(crate) fn fit_of_triple(triple: &str, said: &str) -> Fit {
    let processor = triple.split('-').next().unwrap_or_default();
    let known = MACHINES.iter();
    let mut known = known.filter(|machine| machine.triples.contains(&processor));
    match known.next() {
        Some(machine) => machine.fit(said),
        // `armv5te` is `armv5tel`.
        None if said.starts_with(processor) => Fit::Starts,
        None => Fit::Fails,
    }
}

/// The machine that a program was built for.
pub(super) fn machine(program: &Utf8Path) -> Result<&'static Machine, Refusal> {
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

fn of_header(head: &[u8; 20]) -> Option<&'static Machine> {
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
    MACHINES.iter().find(|known| known.elf == machine)
}

#[cfg(test)]
mod tests {
    use super::{Fit, Machine, fit_of_triple, of_header};

    fn header(machine: u8) -> [u8; 20] {
        let mut head = [0; 20];
        head[..6].copy_from_slice(b"\x7fELF\x02\x01");
        head[18] = machine;
        head
    }

    #[test]
    fn the_machine_stands_in_the_header() {
        let name = |number| of_header(&header(number)).map(Machine::name);
        assert_eq!((name(62), name(183)), (Some("x86_64"), Some("aarch64")));
        assert_eq!((name(3), name(40)), (Some("i386"), Some("arm")));
        assert_eq!((name(99), of_header(&[0; 20])), (None, None));
    }

    #[test]
    fn a_larger_machine_may_start_a_smaller_ones_programs() {
        let fit = |number, said| of_header(&header(number)).expect("it is known").fit(said);
        for (number, said, expected) in [
            (40, "armv7l", Fit::Starts),
            (40, "aarch64", Fit::StartsAsSmaller),
            (3, "x86_64", Fit::StartsAsSmaller),
            (62, "i686", Fit::Fails),
            (183, "x86_64", Fit::Fails),
        ] {
            assert_eq!(fit(number, said), expected, "{number} on {said}");
        }
    }

    #[test]
    fn triples_and_machines_have_names_of_their_own() {
        for (triple, said, expected) in [
            ("x86_64-unknown-linux-gnu", "x86_64", Fit::Starts),
            ("i586-unknown-linux-musl", "i686", Fit::Starts),
            ("riscv64gc-unknown-linux-gnu", "riscv64", Fit::Starts),
            ("armv7-unknown-linux-gnueabihf", "armv7l", Fit::Starts),
            ("armv7-unknown-linux-gnueabihf", "armv6l", Fit::Fails),
            ("arm-unknown-linux-gnueabihf", "armv6l", Fit::Starts),
            (
                "arm-unknown-linux-gnueabihf",
                "aarch64",
                Fit::StartsAsSmaller,
            ),
            ("armv5te-unknown-linux-gnueabi", "armv5tel", Fit::Starts),
            ("loongarch64-unknown-linux-gnu", "loongarch64", Fit::Starts),
            ("x86_64-unknown-linux-gnu", "aarch64", Fit::Fails),
            ("riscv64gc-unknown-linux-gnu", "x86_64", Fit::Fails),
        ] {
            assert_eq!(fit_of_triple(triple, said), expected, "{triple} on {said}");
        }
    }
}
