//! How the types of the standard library, and of crates that are known, come by a marker.

use super::Marker;

/// How a type of the standard library comes by a marker.
pub(super) enum Rule {
    Always,
    Never,
    /// If all its arguments have it.
    AsArguments,
    /// If all its arguments have both.
    NeedsBoth,
    /// If all its arguments have this one.
    Needs(Marker),
    Unknown,
}

/// Below `std`: neither can be sent nor shared.
const TIED: &[&str] = &[
    "cell::Ref",
    "cell::RefMut",
    "ptr::NonNull",
    "rc::Rc",
    "rc::Weak",
];

/// Below `std`: what is locked is unlocked where it was locked.
const GUARDS: &[&str] = &[
    "io::StderrLock",
    "io::StdinLock",
    "io::StdoutLock",
    "sync::MutexGuard",
    "sync::RwLockReadGuard",
    "sync::RwLockWriteGuard",
];

/// Below `std`: can be sent if what is inside can, and never be shared.
const CELLS: &[&str] = &[
    "cell::Cell",
    "cell::OnceCell",
    "cell::RefCell",
    "cell::UnsafeCell",
    "sync::mpsc::Receiver",
];

/// Below `std` or everywhere: as what is inside.
const CONTAINERS: &[&str] = &[
    "Box",
    "Option",
    "Result",
    "Vec",
    "boxed::Box",
    "cmp::Reverse",
    "collections::BTreeMap",
    "collections::BTreeSet",
    "collections::BinaryHeap",
    "collections::HashMap",
    "collections::HashSet",
    "collections::LinkedList",
    "collections::VecDeque",
    "marker::PhantomData",
    "mem::ManuallyDrop",
    "mem::MaybeUninit",
    "num::Wrapping",
    "option::Option",
    "pin::Pin",
    "result::Result",
    "vec::Vec",
];

/// Below `std` or everywhere: plain data, and handles that any thread may use.
const FREE: &[&str] = &[
    "String",
    "any::TypeId",
    "bool",
    "char",
    "f32",
    "f64",
    "ffi::CString",
    "ffi::OsString",
    "fs::File",
    "i128",
    "i16",
    "i32",
    "i64",
    "i8",
    "io::Error",
    "io::Stderr",
    "io::Stdin",
    "io::Stdout",
    "isize",
    "marker::PhantomPinned",
    "net::IpAddr",
    "net::Ipv4Addr",
    "net::Ipv6Addr",
    "net::SocketAddr",
    "net::TcpListener",
    "net::TcpStream",
    "net::UdpSocket",
    "path::PathBuf",
    "process::Child",
    "str",
    "string::String",
    "sync::Barrier",
    "sync::Condvar",
    "time::Duration",
    "time::Instant",
    "time::SystemTime",
    "u128",
    "u16",
    "u32",
    "u64",
    "u8",
    "usize",
];

impl Rule {
    pub(super) fn of(path: &str, marker: Marker) -> Self {
        match (path, marker) {
            (path, _) if FREE.contains(&path) || path.starts_with("sync::atomic::") => Self::Always,
            (path, _) if TIED.contains(&path) => Self::Never,
            (path, Marker::Send) if GUARDS.contains(&path) => Self::Never,
            (path, Marker::Sync) if CELLS.contains(&path) => Self::Never,
            (path, Marker::Send) if CELLS.contains(&path) => Self::AsArguments,
            (path, _) if CONTAINERS.contains(&path) => Self::AsArguments,
            ("sync::Arc" | "sync::Weak", _) => Self::NeedsBoth,
            ("sync::Mutex" | "sync::mpsc::Sender", _) => Self::Needs(Marker::Send),
            ("sync::OnceLock" | "sync::RwLock", Marker::Send) => Self::Needs(Marker::Send),
            ("sync::OnceLock" | "sync::RwLock", Marker::Sync) => Self::NeedsBoth,
            _ => Self::Unknown,
        }
    }

    /// Of a crate outside of the workspace: data that has what its arguments have.
    pub(super) fn of_foreign(path: &[String]) -> Self {
        const OF_FRAMEWORK: &[&str] = &["Error", "History", "Horizon", "Past", "Timestamp"];
        let last = path.last().map(String::as_str).unwrap_or_default();
        match path.first().map(String::as_str) {
            Some("nalgebra") => Self::AsArguments,
            Some("framework") if OF_FRAMEWORK.contains(&last) => Self::AsArguments,
            _ => Self::Unknown,
        }
    }
}
