//! hulkgen: from a manifest and node crates to the crate that is the robot's runtime.
//!
//! [`pipeline`] is the list of stages; each has a type of its own, and no stage looks back behind the one before it.
//!
//! | # | Stage | Makes | In |
//! |---|---|---|---|
//! | – | door in | [`workspace::Workspace`]: every file that is read | `workspace.rs` |
//! | ① | manifest | [`manifest::Manifest`]: `hulk.toml`, every name with its place | `manifest.rs` |
//! | ② | scan | [`scan::Sources`]: node files by themselves, and the names that they use | `scan.rs` |
//! | ③ | resolve | [`resolve::robot::Robot`]: every name bound to what it means | `resolve.rs` |
//! | ④ | schedule | `Schedule`: the order of the nodes of every cycler, and why | `schedule.rs` |
//! | – | partial | a [`resolve::robot::Robot`] of some cyclers, for `generate --only` | `partial.rs` |
//! | ⑤ | describe | `RuntimeModel`: what each file will say; no decisions left | `model.rs` |
//! | ⑥ | render | `GeneratedFiles`: path → text | `render.rs` |
//! | – | door out | `Drift`: what differs on disk; written or only shown | `drift.rs` |
//! | – | third door | [`cache::Cache`]: answers of earlier runs, outside of the robot's folder | `cache.rs` |
//!
//! [`recording`] is a door of its own, to recordings: nothing of a robot is known behind it. `deploy` is one to robots behind ssh.
//!
//! What rustc finds in the generated crate is brought home by [`late`].
//!
//! Stages ① to ④ add what they find to one [`diagnostics::Diagnostics`] and stop where the next cannot go on; ⑤ and ⑥
//! cannot fail. `commands` are what people call; only they print. [`scaffold`] answers with changes to the files that
//! people write; what the robot would be after them is seen through all stages before the door out writes them.
//!
//! Invariants: only `workspace` reads files of the robot and only `drift` writes them; no stage knows the cache. The same input gives the same
//! bytes: nothing depends on hash maps, clocks, the environment or the order in which files are found.

pub mod arguments;
pub mod cache;
pub mod commands;
pub mod cross;
mod deploy;
pub mod diagnostics;
pub mod digest;
pub mod drift;
pub mod graph;
pub mod interrupt;
pub mod late;
pub mod manifest;
pub mod model;
pub mod outcome;
pub mod partial;
pub mod pipeline;
pub mod recording;
pub mod render;
pub mod resolve;
pub mod scaffold;
pub mod scan;
pub mod schedule;
pub mod workspace;
