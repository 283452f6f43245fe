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

/// What `std::env` has and answers with something of the machine.
const OF_ENV: &[&str] = &[
    "args",
    "args_os",
    "current_dir",
    "current_exe",
    "home_dir",
    "join_paths",
    "remove_var",
    "set_current_dir",
    "set_var",
    "split_paths",
    "temp_dir",
    "var",
    "var_os",
    "vars",
    "vars_os",
];

/// What `std::fs` has.
const OF_FS: &[&str] = &[
    "DirBuilder",
    "File",
    "OpenOptions",
    "canonicalize",
    "copy",
    "create_dir",
    "create_dir_all",
    "exists",
    "hard_link",
    "metadata",
    "read",
    "read_dir",
    "read_link",
    "read_to_string",
    "remove_dir",
    "remove_dir_all",
    "remove_file",
    "rename",
    "set_permissions",
    "symlink_metadata",
    "write",
];

/// What `std::thread` has.
const OF_THREAD: &[&str] = &[
    "Builder",
    "JoinHandle",
    "Scope",
    "ScopedJoinHandle",
    "Thread",
    "ThreadId",
    "available_parallelism",
    "current",
    "park",
    "park_timeout",
    "scope",
    "sleep",
    "sleep_until",
    "spawn",
    "yield_now",
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

    /// Of a name that a glob of a module of `std` may bring in, or another glob, or none: only what the module really has
    /// is meant.
    pub(super) fn by_glob(module: &[String], names: &[String]) -> Option<Self> {
        let known = match module {
            [module] if module == "env" => OF_ENV,
            [module] if module == "fs" => OF_FS,
            [module] if module == "thread" => OF_THREAD,
            _ => return Self::of_standard(&[module, names].concat()),
        };
        let is_there = known.contains(&names.first()?.as_str());
        Self::of_standard(&[module, names].concat()).filter(|_| is_there)
    }

    /// The same with a glob of another crate: of those that are unseeded as a whole nothing can be told.
    pub(super) fn by_foreign_glob(module: &[String], names: &[String]) -> Option<Self> {
        let is_listed = GENERATORS.contains(&module.first()?.as_str());
        Self::of_foreign(&[module, names].concat()).filter(|_| is_listed)
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
            | "make_rng"
            | "random"
            | "random_bool"
            | "random_iter"
            | "random_range"
            | "random_ratio"
            | "rng"
            | "thread_rng"]
            // No version has `rng` there, and many a node a variable called so.
            | ["prelude", "random" | "thread_rng"]
    )
}
