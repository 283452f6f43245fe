//! What rustc is told of a target's processor.
//!
//! Invariant: every program of a target is compiled with the same flags, whichever command asks for it: all of them write the
//! same file, and what cargo has compiled with others it keeps beside.

use camino::Utf8Path;

use super::Request;
use crate::cross::{ENCODED, Flags, Processor};
use crate::outcome::Refusal;

/// Flags for a target that names its processor, behind those of the environment.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::commands) struct ForProcessor(Option<String>);

impl ForProcessor {
    /// `triple` has no version of glibc; without one the program is for this machine.
    ///
    /// # Errors
    /// If flags of the environment let the program use what the processor lacks.
    pub(in crate::commands) fn of(
        folder: &Utf8Path,
        triple: Option<&str>,
        cpu: Option<&str>,
    ) -> Result<Self, Refusal> {
        let Some(cpu) = cpu else {
            return Ok(Self(None));
        };
        let processor = Processor {
            folder,
            triple,
            cpu,
        };
        let own = Flags::of(&processor.compiled_for()?, |name| std::env::var(name).ok());
        refuse_lacking(&processor, &own)?;
        Ok(Self(Some(own.encoded(cpu))))
    }

    /// Lets cargo compile with them.
    pub(in crate::commands) fn apply(&self, request: &mut Request<'_>) {
        if let Self(Some(flags)) = self {
            request.set(ENCODED, flags.into());
        }
    }
}

/// Nothing is built with flags of the environment that let the program use what the processor lacks.
fn refuse_lacking(processor: &Processor<'_>, own: &Flags) -> Result<(), Refusal> {
    let features = processor.lacks(&own.words)?;
    if features.is_empty() {
        return Ok(());
    }
    let (names, cpu, variable) = (features.join(", "), processor.cpu, &own.variable);
    let message = format!("{variable} lets the program use {names}, which `{cpu}` lacks");
    Err(Refusal::bad(message).help(format!(
        "take it out of {variable}, or name a newer processor as the target's `cpu`"
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_that_the_processor_cannot_keep_are_refused() {
        let processor = Processor {
            folder: Utf8Path::new("."),
            triple: Some("x86_64-unknown-linux-gnu"),
            cpu: "silvermont",
        };
        let refused = |flag: &str| {
            let own = Flags {
                variable: "RUSTFLAGS".to_owned(),
                words: vec![flag.to_owned()],
            };
            refuse_lacking(&processor, &own)
        };
        assert_eq!(refused("-Cdebuginfo=0"), Ok(()));
        assert_eq!(refuse_lacking(&processor, &Flags::default()), Ok(()));
        let refusal = refused("-Ctarget-feature=+avx2").expect_err("the robot has no AVX");
        let message = "RUSTFLAGS lets the program use avx, avx2, which `silvermont` lacks";
        assert_eq!(refusal.message, message);
    }
}
