//! Flags of rustc that somebody has set in the environment, where cargo looks for them.

/// The variable that cargo prefers to all others; a flag may hold spaces there.
pub const ENCODED: &str = "CARGO_ENCODED_RUSTFLAGS";

/// What stands between two flags there.
const SEPARATOR: char = '\u{1f}';

/// Flags, and where they stand.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Flags {
    /// The variable; empty: nobody has set any.
    pub variable: String,
    pub words: Vec<String>,
}

impl Flags {
    /// For this triple, of the only variable that cargo would take, in its order
    /// (<https://doc.rust-lang.org/cargo/reference/config.html#buildrustflags>).
    pub fn of(triple: &str, variable: impl Fn(&str) -> Option<String>) -> Self {
        if let Some(encoded) = variable(ENCODED) {
            let words = encoded.split(SEPARATOR).filter(|word| !word.is_empty());
            return Self::new(ENCODED, words);
        }
        let plain = "RUSTFLAGS";
        if let Some(flags) = variable(plain) {
            return Self::new(plain, flags.split_whitespace());
        }
        let triple = triple.replace(['-', '.'], "_").to_uppercase();
        let names = [
            format!("CARGO_TARGET_{triple}_RUSTFLAGS"),
            "CARGO_BUILD_RUSTFLAGS".to_owned(),
        ];
        // An empty one of these hides nothing.
        let found = names.iter().find_map(|name| {
            let flags = variable(name)?;
            let flags = Self::new(name, flags.split_whitespace());
            (!flags.words.is_empty()).then_some(flags)
        });
        found.unwrap_or_default()
    }

    fn new<'a>(variable: &str, words: impl Iterator<Item = &'a str>) -> Self {
        Self {
            variable: variable.to_owned(),
            words: words.map(str::to_owned).collect(),
        }
    }

    /// With the target's processor, as [`ENCODED`] holds them.
    pub fn encoded(mut self, cpu: &str) -> String {
        self.words.push(format!("-Ctarget-cpu={cpu}"));
        self.words.join(&SEPARATOR.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::{ENCODED, Flags};

    const OF_TARGET: &str = "CARGO_TARGET_X86_64_UNKNOWN_LINUX_GNU_RUSTFLAGS";

    fn flags(variables: &[(&str, &str)]) -> Flags {
        Flags::of("x86_64-unknown-linux-gnu", |name| {
            let found = variables.iter().find(|(known, _)| *known == name);
            found.map(|(_, value)| (*value).to_owned())
        })
    }

    #[test]
    fn one_variable_holds_in_the_order_of_cargo() {
        let all = [
            (ENCODED, "-Ca=1 2\u{1f}-Cb"),
            ("RUSTFLAGS", "-Cc  -Cd"),
            (OF_TARGET, "-Ce"),
            ("CARGO_BUILD_RUSTFLAGS", "-Cf -Cg"),
        ];
        let expected: [(&str, &[&str]); 5] = [
            (ENCODED, &["-Ca=1 2", "-Cb"]),
            ("RUSTFLAGS", &["-Cc", "-Cd"]),
            (OF_TARGET, &["-Ce"]),
            ("CARGO_BUILD_RUSTFLAGS", &["-Cf", "-Cg"]),
            ("", &[]),
        ];
        for (first, (variable, words)) in expected.into_iter().enumerate() {
            let found = flags(&all[first..]);
            assert_eq!(found.variable, variable);
            assert_eq!(found.words, words);
        }
    }

    #[test]
    fn the_first_two_hide_the_others_even_if_they_are_empty() {
        let last = ("CARGO_BUILD_RUSTFLAGS", "-Cf");
        for name in [ENCODED, "RUSTFLAGS"] {
            assert!(flags(&[(name, ""), last]).words.is_empty(), "{name}");
        }
        assert_eq!(flags(&[(OF_TARGET, ""), last]).words, ["-Cf"]);
    }

    #[test]
    fn the_processor_stands_behind_them() {
        assert_eq!(flags(&[]).encoded("silvermont"), "-Ctarget-cpu=silvermont");
        let own = flags(&[("RUSTFLAGS", "-Cdebuginfo=0")]);
        assert_eq!(
            own.encoded("x86-64-v2"),
            "-Cdebuginfo=0\u{1f}-Ctarget-cpu=x86-64-v2"
        );
    }
}
