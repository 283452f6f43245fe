//! What the referee's computer and the team mate have said and heard, for tests.

use std::collections::VecDeque;

use framework::Timestamp;
use spl_messages::ReturnData;
use types::game::GameControllerMessage;
use types::network::PacketCounts;
use types::team::TeamMessage;

use super::Network;
use super::mate::Mate;
use super::referee::Referee;

/// How many messages of a kind are kept.
const REMEMBERED: usize = 4096;

/// What has been said and heard until now.
#[derive(Clone, Debug, Default)]
pub struct NetworkTruth {
    /// What the referee's computer said last.
    pub game_message: Option<GameControllerMessage>,
    /// The robot's answers to the referee's computer, the last 4096, oldest first.
    pub return_data: Vec<Received<ReturnData>>,
    /// How many answers the referee's computer took, and how many were none of this robot.
    pub return_data_counts: PacketCounts,
    /// What the robot has told its team, the last 4096, oldest first.
    pub team_messages: Vec<Received<TeamMessage>>,
    /// How many messages the team mate understood, and how many it did not.
    pub team_message_counts: PacketCounts,
}

/// A message and when it came.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Received<T> {
    /// When.
    pub at: Timestamp,
    /// What.
    pub message: T,
}

/// What somebody has heard.
pub(super) struct Inbox<T> {
    counts: PacketCounts,
    messages: VecDeque<Received<T>>,
}

impl<T> Default for Inbox<T> {
    fn default() -> Self {
        Self {
            counts: PacketCounts::default(),
            messages: VecDeque::new(),
        }
    }
}

impl<T: Clone> Inbox<T> {
    /// Counts a message, or something that is none.
    pub(super) fn keep(&mut self, at: Timestamp, message: Option<T>) {
        let Some(message) = message else {
            self.counts.rejected += 1;
            return;
        };
        self.counts.accepted += 1;
        if self.messages.len() == REMEMBERED {
            self.messages.pop_front();
        }
        self.messages.push_back(Received { at, message });
    }

    fn messages(&self) -> Vec<Received<T>> {
        self.messages.iter().cloned().collect()
    }
}

impl Network {
    /// What has been said and heard until now.
    pub(crate) fn truth(&self) -> NetworkTruth {
        let mut truth = NetworkTruth::default();
        if let Some(referee) = &self.referee {
            truth.game_message = Referee::message(referee);
            truth.return_data = referee.inbox.messages();
            truth.return_data_counts = referee.inbox.counts;
        }
        if let Some(Mate { inbox, .. }) = &self.mate {
            truth.team_messages = inbox.messages();
            truth.team_message_counts = inbox.counts;
        }
        truth
    }
}
