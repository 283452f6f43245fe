//! What a target's processor can do, as rustc knows it.
//!
//! The instructions of a program tell nothing: libraries carry those of newer processors and ask the processor before they
//! use them. What the compiler was allowed to use everywhere tells.

use std::collections::BTreeSet;
use std::process::Command;

use camino::Utf8Path;

use crate::outcome::Refusal;

/// The processor of a target.
#[derive(Clone, Copy, Debug)]
pub struct Processor<'a> {
    /// The robot's folder: a `rust-toolchain.toml` there chooses among compilers.
    pub folder: &'a Utf8Path,
    /// rustc's triple, without a version of glibc; this machine's if left out.
    pub triple: Option<&'a str>,
    /// As in `-C target-cpu`.
    pub cpu: &'a str,
}

impl Processor<'_> {
    /// Features that rustc may use with these flags before its own, but that the processor lacks, in order.
    ///
    /// # Errors
    /// If rustc cannot be asked, or understands neither the triple nor the flags.
    pub fn lacks(&self, flags: &[String]) -> Result<Vec<String>, Refusal> {
        if flags.is_empty() {
            return Ok(Vec::new());
        }
        let there = self.features(&[])?;
        let used = self.features(flags)?;
        Ok(used.difference(&there).cloned().collect())
    }

    /// The triple that rustc compiles for.
    ///
    /// # Errors
    /// If rustc cannot be asked.
    pub fn compiled_for(&self) -> Result<String, Refusal> {
        match self.triple {
            Some(triple) => Ok(triple.to_owned()),
            None => Ok(self.ask("host-tuple", &[])?.trim().to_owned()),
        }
    }

    fn features(&self, flags: &[String]) -> Result<BTreeSet<String>, Refusal> {
        let mut all = flags.to_vec();
        all.push(format!("-Ctarget-cpu={}", self.cpu));
        if let Some(triple) = self.triple {
            all.extend(["--target", triple].map(str::to_owned));
        }
        let said = self.ask("cfg", &all)?;
        let feature = |line: &str| {
            let name = line.strip_prefix("target_feature=\"")?.strip_suffix('"')?;
            Some(name.to_owned())
        };
        Ok(said.lines().filter_map(feature).collect())
    }

    fn ask(&self, what: &str, flags: &[String]) -> Result<String, Refusal> {
        let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let mut command = Command::new(rustc);
        command.current_dir(self.folder);
        command.args(["--print", what]).args(flags);
        let answer = command.output().map_err(|error| {
            Refusal::bad(format!(
                "cannot ask rustc what `{}` can do: {error}",
                self.cpu
            ))
            .help("install Rust from rustup.rs, or name rustc in the variable RUSTC")
        })?;
        if !answer.status.success() {
            let said = String::from_utf8_lossy(&answer.stderr);
            let reason = said.lines().next().unwrap_or("it does not say why");
            return Err(Refusal::bad(format!(
                "rustc does not say what `{}` can do: {reason}",
                self.cpu
            )));
        }
        Ok(String::from_utf8_lossy(&answer.stdout).into_owned())
    }
}

#[cfg(test)]
mod tests {
    use camino::Utf8Path;

    use super::Processor;

    fn nao() -> Processor<'static> {
        Processor {
            folder: Utf8Path::new("."),
            triple: Some("x86_64-unknown-linux-gnu"),
            cpu: "silvermont",
        }
    }

    fn words(flags: &[&str]) -> Vec<String> {
        flags.iter().map(|flag| (*flag).to_owned()).collect()
    }

    #[test]
    fn what_a_processor_lacks_is_named() {
        let lacks = |flags: &[&str]| nao().lacks(&words(flags)).expect("rustc understands it");
        assert!(lacks(&[]).is_empty());
        assert!(lacks(&["-Copt-level=1", "-Ctarget-feature=+sse4.2"]).is_empty());
        assert_eq!(
            lacks(&["-Copt-level=1", "-Ctarget-feature=+avx2"]),
            ["avx", "avx2"]
        );
        // The target's own word comes behind it and counts.
        assert!(lacks(&["-Ctarget-cpu=haswell"]).is_empty());
        let newer = Processor {
            cpu: "x86-64-v3",
            ..nao()
        };
        let lacks = newer.lacks(&words(&["-Ctarget-feature=+avx2"]));
        assert!(lacks.expect("rustc understands it").is_empty());
    }

    #[test]
    fn what_rustc_does_not_understand_is_refused_with_its_words() {
        let nowhere = Processor {
            triple: Some("z80-unknown-cpm"),
            ..nao()
        };
        let refusal = nowhere.lacks(&words(&["-Copt-level=1"]));
        let refusal = refusal.expect_err("nobody has it");
        assert!(refusal.message.contains("z80-unknown-cpm"), "{refusal:?}");
    }
}
