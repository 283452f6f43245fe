//! Names of the standard library, and of crates that everybody uses, that give another answer in every run.

/// What makes two runs differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Chance {
    Clock,
    Disk,
    Environment,
    HashedMap,
    HashedSet,
    Random,
    /// A static that can change, or one for each thread.
    Static,
    Thread,
}

/// Crates whose functions and types draw from a generator that nobody seeded.
const GENERATORS: &[&str] = &[
    "rand",
    "rand_chacha",
    "rand_core",
    "rand_pcg",
    "rand_xoshiro",
];

impl Chance {
    /// What to know about the place.
    pub fn label(self) -> &'static str {
        match self {
            Self::Clock => "another time in a replay",
            Self::Disk => "another file in a replay, perhaps",
            Self::Environment => "another environment in a replay, perhaps",
            Self::HashedMap | Self::HashedSet => "another order in every run",
            Self::Random => "other numbers in every run",
            Self::Static => "kept between cycles and not recorded",
            Self::Thread => "threads run in another order in every run",
        }
    }

    /// What to do instead.
    pub fn deed(self) -> &'static str {
        match self {
            Self::Clock => "take the time of the cycle with `CycleTime`",
            Self::Disk => "make it a parameter, or let a setup node read it from the hardware",
            Self::Environment => "make it a parameter",
            Self::HashedMap => "write `BTreeMap`",
            Self::HashedSet => "write `BTreeSet`",
            Self::Random => "keep a generator with a fixed seed in the node's struct",
            Self::Static => "make it a field of the node's struct, or a `CyclerState`",
            Self::Thread => "compute it in the node, or let the hardware have the thread",
        }
    }

    /// Of a path below `std`, without that name.
    pub(super) fn of_standard(path: &[String]) -> Option<Self> {
        let names: Vec<&str> = path.iter().map(String::as_str).collect();
        match names.as_slice() {
            ["time", "SystemTime", "UNIX_EPOCH"] => None,
            ["time", "SystemTime" | "Instant", ..] => Some(Self::Clock),
            // With these the hasher is written somewhere else, and judged there.
            [
                "collections",
                ..,
                "default" | "from_iter" | "with_hasher" | "with_capacity_and_hasher",
            ] => None,
            ["collections", "HashMap", ..] | ["collections", "hash_map", "HashMap", ..] => {
                Some(Self::HashedMap)
            }
            ["collections", "HashSet", ..] | ["collections", "hash_set", "HashSet", ..] => {
                Some(Self::HashedSet)
            }
            ["hash" | "collections", .., "RandomState"]
            | ["hash" | "collections", .., "RandomState", _] => Some(Self::Random),
            ["env", "consts" | "VarError", ..] => None,
            ["env", _, ..] => Some(Self::Environment),
            ["fs", _, ..] => Some(Self::Disk),
            ["thread_local"] => Some(Self::Static),
            ["thread", "Result" | "panicking", ..] => None,
            ["thread", _, ..] => Some(Self::Thread),
            _ => None,
        }
    }

    /// Of an absolute path below another crate.
    pub(super) fn of_foreign(path: &[String]) -> Option<Self> {
        let (library, rest) = path.split_first()?;
        let names: Vec<&str> = rest.iter().map(String::as_str).collect();
        let unseeded = match (library.as_str(), names.as_slice()) {
            ("fastrand", ["Rng", "with_seed"] | ["Rng"] | ["seed"]) => false,
            ("fastrand" | "getrandom", [_, ..]) => true,
            (generator, names) if GENERATORS.contains(&generator) => {
                draws_unseeded(names)
                    || names
                        .iter()
                        .any(|name| matches!(*name, "OsRng" | "SysRng" | "ThreadRng"))
                    || matches!(names.last(), Some(&("from_entropy" | "from_os_rng")))
            }
            _ => false,
        };
        unseeded.then_some(Self::Random)
    }
}

/// The free functions of `rand`, which ask the generator of the thread.
fn draws_unseeded(names: &[&str]) -> bool {
    matches!(
        names,
        ["fill"
            | "random"
            | "random_bool"
            | "random_iter"
            | "random_range"
            | "random_ratio"
            | "rng"
            | "thread_rng"]
            | ["prelude", "random" | "thread_rng"]
            | ["rngs" | "prelude", "thread" | "rng"]
    )
}
