//! Whether a program would start on the machine of its target.

use super::elf::{Elf, Version};

/// Every machine with glibc has these: its own, and the unwinder of its compiler.
const EVERYWHERE: [&str; 8] = [
    "ld-linux-aarch64.so.1",
    "ld-linux-x86-64.so.2",
    "libc.so.6",
    "libdl.so.2",
    "libgcc_s.so.1",
    "libm.so.6",
    "libpthread.so.0",
    "librt.so.1",
];

/// A target's triple, taken apart: `x86_64-unknown-linux-gnu.2.28`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// As rustc knows it.
    pub triple: String,
    /// The oldest glibc that must do.
    pub glibc: Option<Version>,
}

/// A triple behind which no version stands.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the target's triple `{triple}` ends with no version of glibc")]
pub struct WrongTriple {
    pub triple: String,
}

impl WrongTriple {
    /// The deed that mends it.
    pub const HELP: &str = "write it like `x86_64-unknown-linux-gnu.2.28`";
}

impl Wanted {
    /// Takes a triple apart.
    ///
    /// # Errors
    /// If what stands behind it is no version.
    pub fn parse(written: &str) -> Result<Self, WrongTriple> {
        let (triple, version) = match written.split_once('.') {
            Some((triple, version)) => (triple, Some(version)),
            None => (written, None),
        };
        let wrong = || WrongTriple {
            triple: written.to_owned(),
        };
        let glibc = version.map(|version| Version::parse(version).ok_or_else(wrong));
        Ok(Self {
            triple: triple.to_owned(),
            glibc: glibc.transpose()?,
        })
    }

    /// What the first word of the triple is in an ELF file; `None` where nobody knows.
    fn machine(&self) -> Option<u16> {
        match self.triple.split('-').next()? {
            "x86_64" => Some(62),
            "aarch64" => Some(183),
            _ => None,
        }
    }
}

/// Why the program would not start there; empty where it would.
pub fn objections(elf: &Elf, wanted: &Wanted) -> Vec<String> {
    let mut objections = Vec::new();
    if wanted
        .machine()
        .is_some_and(|machine| machine != elf.machine)
    {
        objections.push(format!(
            "it is for another processor than {}",
            wanted.triple
        ));
    }
    if let (Some(asked), Some(there)) = (elf.glibc, wanted.glibc)
        && asked > there
    {
        objections.push(format!("it asks for glibc {asked}, the target has {there}"));
    }
    for library in &elf.libraries {
        if !EVERYWHERE.contains(&library.as_str()) {
            objections.push(format!("it needs {library}, which the target may not have"));
        }
    }
    objections
}

#[cfg(test)]
mod tests {
    use super::*;

    fn program() -> Elf {
        Elf {
            machine: 62,
            interpreter: Some("/lib64/ld-linux-x86-64.so.2".to_owned()),
            libraries: vec!["libc.so.6".to_owned(), "libm.so.6".to_owned()],
            glibc: Version::parse("2.28"),
        }
    }

    fn nao() -> Wanted {
        Wanted::parse("x86_64-unknown-linux-gnu.2.28").expect("it is a triple")
    }

    #[test]
    fn a_triple_ends_with_its_glibc() {
        assert_eq!(nao().triple, "x86_64-unknown-linux-gnu");
        assert_eq!(nao().glibc, Version::parse("2.28"));
        let plain = Wanted::parse("aarch64-unknown-linux-gnu").expect("it is a triple");
        assert_eq!((plain.glibc, plain.machine()), (None, Some(183)));
        for behind in [".", ".new"] {
            let wrong = Wanted::parse(&format!("x86_64-unknown-linux-gnu{behind}"));
            let message = wrong.expect_err("it is no version").to_string();
            assert!(message.contains("no version of glibc"), "{message}");
        }
    }

    #[test]
    fn what_would_not_start_is_refused_with_the_reason() {
        assert_eq!(objections(&program(), &nao()), Vec::<String>::new());
        let mut elf = program();
        elf.glibc = Version::parse("2.34");
        elf.libraries.push("libasound.so.2".to_owned());
        elf.machine = 183;
        let found = objections(&elf, &nao());
        assert_eq!(found.len(), 3, "{found:?}");
        assert!(found[0].contains("another processor"), "{found:?}");
        assert!(
            found[1].contains("glibc 2.34, the target has 2.28"),
            "{found:?}"
        );
        assert!(found[2].contains("libasound.so.2"), "{found:?}");
    }
}
