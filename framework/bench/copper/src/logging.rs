//! With its log, in memory-mapped files of a temporary folder.

use cu29::prelude::*;

use crate::tasks::{Block, Node, Sink, Source};

/// Large enough for all iterations that are measured.
const LOG_BYTES: usize = 1 << 30;

#[copper_runtime(config = "logging.ron")]
struct App {}

/// One iteration of the graph, again and again.
pub struct Logging(Box<dyn FnMut() -> bool>);

impl Logging {
    /// The graph, started; what went wrong otherwise.
    pub fn start() -> Result<Self, String> {
        let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
        let app = App::builder()
            .with_clock(RobotClock::new())
            .with_log_path(folder.path().join("bench.copper"), Some(LOG_BYTES))
            .and_then(|builder| builder.build());
        let app = app.map_err(|error| error.to_string())?;
        let mut running = app.start().map_err(|error| error.to_string())?;
        Ok(Self(Box::new(move || {
            // As long as the files are written.
            let _folder = &folder;
            running.run_one_iteration().is_ok()
        })))
    }

    /// Whether it succeeded.
    #[inline]
    pub fn iterate(&mut self) -> bool {
        (self.0)()
    }
}
