//! Scenarios: a simulated robot lives through what a file says, in lockstep, and is judged by what the file asserts.
//!
//! ```toml
//! about = "A robot that is pushed while it walks stays upright."
//! ends = 20.0                                # s
//! passes = 0.8                               # of the seeds; all of them where it is left out
//! parameters = { filter.gain = 0.5 }         # above all layers
//! durations = { Camera = "100ms" }            # of cycles of this instance; left out: as the manifest says
//! world = { robot_pose = [0.0, 0.0, 0.0] }   # over the parameters' [hardware.<target>]
//! random = { robot_pose = [0.1, 0.1, 0.5] }  # drawn from the seed, up to so much more or less
//!
//! [[robot]]                                  # one for each robot, if there are several
//! place = "left"                             # the key `robot` of its hardware's table, in the hardware's own words
//! parameters = { name = "a" }                # above those of the scenario; `durations` likewise
//! random = { pose = [0.1, 0.1, 0.5] }        # as above, of the numbers that stand here
//!
//! [[event]]
//! robot = 2                                  # which robot it happens to, or whose hardware is told; 1 where it is left out
//! at = 5.0                                   # s
//! within = 0.5                               # s: a seed moves it by up to so much, both ways; 0 where it is left out
//! push = [0.0, 0.5, 0.0]                     # what the hardware understands
//!
//! # A call and an assertion say `robot = 2` likewise.
//! [[call]]                                   # what a client asks, every 0.5 s unless `every` says otherwise
//! path = "Control.procedures.walk"
//! argument = { forward = 0.05 }
//! from = 4.0                                 # s
//! until = 20.0
//!
//! [[assertion]]
//! what = "it stays upright"
//! value = "truth.tilt"                       # `truth.…` of the hardware, or an output: `Control.main_outputs.…`
//! below = 0.5                                # or `above`, `equals`, `is_not`, `is_there`
//! from = 1.0                                 # s; always from there on, unless `before = 9.0` or `at_end = true`
//! while = "truth.plays"                      # only where this truth is `true`; left out: at every moment
//! ```
//! What the robot's world is, what can happen to it and what is true in it is the hardware's:
//! [`Hardware::disturb`](crate::Hardware::disturb) and [`Hardware::truth`](crate::Hardware::truth).

mod assertion;
mod audience;
mod choice;
mod draw;
mod durations;
mod ensemble;
mod file;
mod judge;
mod pace;
mod play;
mod report;
mod words;

pub use assertion::{Assertion, Condition, Window};
pub(crate) use audience::Audience;
pub use durations::Durations;
pub use file::{Call, Event, Participant, Scenario};
pub use judge::{Judge, Verdict};
pub(crate) use play::{Cast, Manner, play};
pub use report::{Outcome, Played};
pub(crate) use words::misspelt;
