//! Without any log: tasks and keyframes off, and a logger that drops what comes.

use cu29::prelude::*;

use crate::tasks::{Block, Node, Sink, Source};

#[copper_runtime(config = "quiet.ron")]
struct App {}

/// One iteration of the graph, again and again.
pub struct Quiet(Box<dyn FnMut() -> bool>);

impl Quiet {
    /// The graph, started; what went wrong otherwise.
    pub fn start() -> Result<Self, String> {
        let app = App::builder().with_clock(RobotClock::new()).build();
        let app = app.map_err(|error| error.to_string())?;
        let mut running = app.start().map_err(|error| error.to_string())?;
        Ok(Self(Box::new(move || running.run_one_iteration().is_ok())))
    }

    /// Whether it succeeded.
    #[inline]
    pub fn iterate(&mut self) -> bool {
        (self.0)()
    }
}
