//! Which parameters the cycles took that are shown.

use super::Moment;
use crate::parameters::{Live, Version};
use crate::recorded::PARAMETERS;
use crate::replay::events::reads_parameters;
use crate::replay::shelf::Place;
use crate::replay::{Players, Shelf};
use crate::report::tell;

/// The parameters that clients see, and what the recording has of them.
pub(super) struct RecordedParameters<'r> {
    live: Live,
    recording: &'r Shelf,
    /// In order of time, and of the versions; empty: they stay as they are.
    changes: Vec<Change>,
    /// Which of the changes is shown.
    shown: Option<usize>,
}

/// A version that was there from a cycle on.
struct Change {
    /// How many moments have been once it is there.
    passed: usize,
    version: Version,
    place: Place,
}

impl<'r> RecordedParameters<'r> {
    /// Those that stay as they are.
    pub(super) fn fixed(live: Live, recording: &'r Shelf) -> Self {
        live.freeze();
        Self {
            live,
            recording,
            changes: Vec::new(),
            shown: None,
        }
    }

    /// From now on they are what the newest of these cycles took.
    pub(super) fn follow(&mut self, players: &Players<'_>, moments: &[Moment]) {
        let Some(channel) = self.recording.channel(PARAMETERS) else {
            return;
        };
        let readers: Vec<_> = players.players.iter().map(reads_parameters).collect();
        let moments = moments.iter().enumerate();
        for (index, moment) in moments.filter(|(_, moment)| readers[moment.instance]) {
            let player = &players.players[moment.instance];
            let Some(version) = player.parameters_version(moment.position) else {
                continue;
            };
            // A cycle that began earlier, and came here later, has older ones.
            if self
                .changes
                .last()
                .is_some_and(|last| version <= last.version.0)
            {
                continue;
            }
            let chunk = player.chunk_of(moment.position);
            let recorded = self.recording.index();
            if let Some(place) = recorded.value(chunk, (channel, version as u32)) {
                self.changes.push(Change {
                    passed: index + 1,
                    version: Version(version),
                    place,
                });
            }
        }
    }

    /// Shows those of the time at which so many moments have been.
    pub(super) fn show(&mut self, passed: usize) {
        let been = self
            .changes
            .partition_point(|change| change.passed <= passed);
        // Before the first that is known it is the best guess.
        let wanted = been.saturating_sub(1);
        let Some(change) = self.changes.get(wanted) else {
            return;
        };
        if self.shown.replace(wanted) == Some(wanted) {
            return;
        }
        let bytes = self.recording.bytes(change.place);
        let shown = bytes.and_then(|bytes| self.live.show(change.version, &bytes));
        if let Err(error) = shown {
            let Version(version) = change.version;
            tell(format_args!(
                "version {version} of the parameters cannot be shown: {error}"
            ));
        }
    }
}
