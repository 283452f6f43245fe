//! What a machine beside a robot needs, in Rust: it runs a perception cycler and feeds the robot with what it sees, through
//! the bridge that this package also is (docs/zenoh.md).
//!
//! ```no_run
//! use std::time::SystemTime;
//!
//! use hulkgen_zenoh::Robot;
//! use serde::Serialize;
//!
//! /// A field for each main output of the cycler that the robot reads.
//! #[derive(Serialize)]
//! struct Outputs {
//!     balls: Vec<[f32; 2]>,
//! }
//!
//! fn main() -> Result<(), hulkgen_zenoh::Error> {
//!     let robot = Robot::connect("tcp/10.1.24.5:7447", "")?;
//!     let mut vision = robot.feeder("robot/vision_top")?;
//!     loop {
//!         // At once, with the time at which the data were taken: who reads in order of time waits for this cycle.
//!         let cycle = vision.announce(SystemTime::now())?;
//!         let balls = vec![[1.5, 0.2]];
//!         cycle.complete(&Outputs { balls })?;
//!         for refusal in vision.refusals() {
//!             eprintln!("warning: {refusal}");
//!         }
//!     }
//! }
//! ```
//! Invariant: the robot is the judge. What it refuses is told, and nothing here waits for its answers unless it is asked to.

#![warn(missing_docs)]

mod error;
mod feeder;
mod robot;
mod said;
mod session;

pub use error::Error;
pub use feeder::{Counts, Cycle, Feeder, Refusal};
pub use robot::{Newest, Robot, Watched};
pub use said::Said;
pub use session::open;
