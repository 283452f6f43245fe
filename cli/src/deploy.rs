//! Robots that are reached by ssh: what is sent there, how it gets there, and what they are asked.
//!
//! The system's own ssh and rsync do the work, so that keys, jump hosts and options are those that the team has anyway.
//! This module is a door: it makes a temporary folder of what is sent, and folders for what is fetched.
//!
//! On the robot a version is a folder, and the running one is a link to it, which is replaced in one step:
//!
//! ```text
//! <folder>/versions/20261122-201500-deb288d/   the program, `start`, parameters, files, unit, SUMS
//! <folder>/current  -> versions/…
//! <folder>/previous -> versions/…
//! <folder>/runs/                               recordings, of all versions
//! ```

mod destination;
mod package;
mod program;
mod remote;
pub(crate) mod script;

pub(crate) use destination::Destination;
pub(crate) use package::{BESIDE, Contents, ForRobot, Package};
pub(crate) use program::{Fit, fit_of_triple};
pub(crate) use remote::{Failed, Remote};
