//! Decides from what the microphones heard lately whether the referee whistles.
//!
//! A single microphone that is broken or near to something loud must not start a game, nor must a
//! squeaking shoe: several microphones agree in several blocks of a short time. Blocks that nothing
//! older can overtake any more are remembered; younger ones only refine this cycle's answer.

use std::time::Duration;

use framework::{
    AdditionalOutput, CycleTime, MainOutput, Parameter, PerceptionInput, Result, RollBack,
    Timestamp, context,
};
use serde::{Deserialize, Serialize};
use types::audio::{MICROPHONE_COUNT, Whistle, WhistleEvidence};

/// How many blocks with a whistle are remembered at most; 0.7 s of 46 ms each.
pub const REMEMBERED_BLOCKS: usize = 16;

/// What was heard lately.
#[derive(Debug, Deserialize, Serialize)]
pub struct WhistleFilter {
    heard: RollBack<Heard>,
}

/// The blocks that voted for a whistle, and what follows.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
struct Heard {
    /// When the newest of them ended, newest first.
    votes: [Option<Timestamp>; REMEMBERED_BLOCKS],
    whistle: Whistle,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    whistle_evidence: PerceptionInput<WhistleEvidence, "Audio", "whistle_evidence">,
    cycle_time: CycleTime,

    /// A block votes for a whistle where so many of the four microphones heard one; at least 1.
    least_microphones: Parameter<u32, "whistle_filter.least_microphones">,
    /// So many votes within `window` are a whistle; from 1 to 16.
    #[reflect(range = 1..=16)]
    least_blocks: Parameter<u32, "whistle_filter.least_blocks">,
    /// Older votes do not count; a whistle that is so long without a vote is over.
    #[reflect(unit = "s", range = 0.0..)]
    window: Parameter<f32, "whistle_filter.window">,

    /// How many blocks vote for a whistle in this cycle.
    votes: AdditionalOutput<u32, "whistle_filter.votes">,
}

#[context]
pub struct MainOutputs {
    /// Begins with the end of the first block that voted for it.
    whistle: MainOutput<Whistle>,
}

impl WhistleFilter {
    /// Heard nothing.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            heard: RollBack::default(),
        })
    }

    /// Learns from what is settled, then listens to what is not.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let now = context.cycle_time.start;
        // A window that is no time at all holds nothing.
        let window = Duration::try_from_secs_f32(*context.window).unwrap_or_default();
        let learn = |heard: &mut Heard, timestamp, evidence: &WhistleEvidence| {
            // After a gap in the sound the vote belongs to another whistle.
            heard.forget(timestamp, window);
            heard.decide(*context.least_blocks);
            if is_vote(evidence, *context.least_microphones) {
                heard.vote(timestamp);
                heard.decide(*context.least_blocks);
            }
        };

        let evidence = context.whistle_evidence;
        self.heard.settle(evidence.persistent, learn);
        let mut newest = self.heard.with_transient(evidence.transient, learn);
        // Microphones that fell silent whistle no more.
        newest.forget(now, window);
        newest.decide(*context.least_blocks);
        context.votes.fill_if_subscribed(|| newest.count());
        Ok(MainOutputs {
            whistle: newest.whistle.into(),
        })
    }
}

/// Whether enough microphones heard a whistle.
fn is_vote(evidence: &WhistleEvidence, least_microphones: u32) -> bool {
    let heard = evidence.is_heard.iter().filter(|&&is_heard| is_heard);
    let least = (least_microphones as usize).clamp(1, MICROPHONE_COUNT);
    heard.count() >= least
}

impl Heard {
    /// Forgets the votes that are too old at `now`.
    fn forget(&mut self, now: Timestamp, window: Duration) {
        for vote in &mut self.votes {
            *vote = vote.filter(|&ended_at| now - ended_at < window);
        }
    }

    /// Remembers a vote in place of the oldest.
    fn vote(&mut self, ended_at: Timestamp) {
        self.votes.rotate_right(1);
        self.votes[0] = Some(ended_at);
    }

    /// A whistle begins with enough votes and ends without any.
    fn decide(&mut self, least_blocks: u32) {
        let count = self.count();
        let is_heard = if self.whistle.is_heard {
            count > 0
        } else {
            count >= least_blocks.clamp(1, REMEMBERED_BLOCKS as u32)
        };
        if is_heard && !self.whistle.is_heard {
            self.whistle.last_began_at = self.votes.iter().flatten().min().copied();
        }
        self.whistle.is_heard = is_heard;
    }

    fn count(&self) -> u32 {
        self.votes.iter().flatten().count() as u32
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::{AdditionalProbe, at_millis, perception};

    use super::*;

    type Blocks<'a> = Vec<(Timestamp, &'a WhistleEvidence)>;

    const NONE: WhistleEvidence = WhistleEvidence {
        is_heard: [false; MICROPHONE_COUNT],
    };
    const ONE: WhistleEvidence = WhistleEvidence {
        is_heard: [false, true, false, false],
    };
    const TWO: WhistleEvidence = WhistleEvidence {
        is_heard: [false, true, false, true],
    };

    fn node() -> WhistleFilter {
        WhistleFilter::new(CreationContext {}).unwrap()
    }

    /// A cycle at `now` in ms: two microphones, three blocks within `window`.
    fn cycle_with(
        node: &mut WhistleFilter,
        now: u64,
        persistent: Blocks<'_>,
        transient: Blocks<'_>,
        window: f32,
    ) -> Whistle {
        let mut probe = AdditionalProbe::default();
        let context = CycleContext {
            whistle_evidence: perception(&persistent, &transient),
            cycle_time: CycleTime {
                start: at_millis(now),
                since_last: Duration::from_millis(12),
            },
            least_microphones: &2,
            least_blocks: &3,
            window: &window,
            votes: probe.output(),
        };
        node.cycle(context).unwrap().whistle.value
    }

    fn cycle(node: &mut WhistleFilter, now: u64, blocks: Blocks<'_>) -> Whistle {
        cycle_with(node, now, blocks, vec![], 0.3)
    }

    /// Blocks that end at these times in ms.
    fn blocks<'a, const N: usize>(times: [u64; N], evidence: &'a WhistleEvidence) -> Blocks<'a> {
        times
            .into_iter()
            .map(|millis| (at_millis(millis), evidence))
            .collect()
    }

    #[test]
    fn a_whistle_begins_with_its_first_vote_and_ends_after_the_last() {
        let mut node = node();
        let two = cycle(&mut node, 200, blocks([100, 150], &TWO));
        assert_eq!(two, Whistle::default());
        let heard = Whistle {
            is_heard: true,
            last_began_at: Some(at_millis(100)),
        };
        assert_eq!(cycle(&mut node, 210, blocks([200], &TWO)), heard);
        assert_eq!(cycle(&mut node, 450, blocks([400], &TWO)), heard);
        let over = Whistle {
            is_heard: false,
            ..heard
        };
        assert_eq!(cycle(&mut node, 750, blocks([500, 700], &NONE)), over);
    }

    #[test]
    fn a_single_microphone_never_whistles() {
        let heard = cycle(
            &mut node(),
            300,
            blocks([50, 100, 150, 200, 250, 300], &ONE),
        );
        assert_eq!(heard, Whistle::default());
    }

    #[test]
    fn votes_too_far_apart_are_no_whistle() {
        let mut node = node();
        for millis in [100, 251, 402, 553, 704] {
            let heard = cycle(&mut node, millis, blocks([millis], &TWO));
            assert!(!heard.is_heard, "{millis} ms");
        }
    }

    #[test]
    fn transient_blocks_answer_but_are_not_learnt() {
        let mut node = node();
        let settled = blocks([100, 150], &TWO);
        let heard = cycle_with(&mut node, 210, settled, blocks([200], &TWO), 0.3);
        assert!(heard.is_heard);
        assert_eq!(heard.last_began_at, Some(at_millis(100)));
        assert_eq!(cycle(&mut node, 220, vec![]), Whistle::default());
    }

    #[test]
    fn microphones_that_fall_silent_end_the_whistle() {
        let mut node = node();
        assert!(cycle(&mut node, 200, blocks([100, 150, 200], &TWO)).is_heard);
        assert!(cycle(&mut node, 499, vec![]).is_heard);
        assert!(!cycle(&mut node, 501, vec![]).is_heard);
        // What comes late after all belongs to the whistle of its time.
        let late = cycle(&mut node, 510, blocks([250], &TWO));
        assert!(late.is_heard);
        assert_eq!(late.last_began_at, Some(at_millis(100)));
    }

    #[test]
    fn a_second_whistle_has_its_own_beginning() {
        let mut node = node();
        cycle(&mut node, 200, blocks([100, 150, 200], &TWO));
        cycle(&mut node, 1000, blocks([600, 1000], &NONE));
        let heard = cycle(&mut node, 1200, blocks([1100, 1150, 1200], &TWO));
        assert_eq!(heard.last_began_at, Some(at_millis(1100)));
    }

    #[test]
    fn a_gap_in_the_sound_ends_the_whistle_before_the_next_vote() {
        let mut node = node();
        assert!(cycle(&mut node, 200, blocks([100, 150, 200], &TWO)).is_heard);
        let one = cycle(&mut node, 2210, blocks([2200], &TWO));
        let over = Whistle {
            is_heard: false,
            last_began_at: Some(at_millis(100)),
        };
        assert_eq!(one, over);
        let heard = cycle(&mut node, 2360, blocks([2250, 2300, 2350], &TWO));
        assert!(heard.is_heard);
        assert_eq!(heard.last_began_at, Some(at_millis(2200)));
    }

    #[test]
    fn a_window_that_is_no_time_hears_nothing() {
        for window in [f32::NAN, -1.0, 0.0, f32::INFINITY] {
            let votes = blocks([100, 150, 200, 250], &TWO);
            let heard = cycle_with(&mut node(), 250, votes, vec![], window);
            assert_eq!(heard, Whistle::default(), "{window}");
        }
    }

    #[test]
    fn more_votes_than_are_remembered_are_one_whistle() {
        let mut node = node();
        for block in 1..100 {
            let end = block * 10;
            let heard = cycle(&mut node, end, blocks([end], &TWO));
            assert_eq!(heard.is_heard, block >= 3);
            assert!(heard.last_began_at.is_none_or(|at| at == at_millis(10)));
        }
    }
}
