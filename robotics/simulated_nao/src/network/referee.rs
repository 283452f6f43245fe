//! The referee's computer: it tells the robot how the game stands and keeps what the robot answers.

use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::time::Duration;

use framework::{Result, Timestamp};
use links::sockets::{BUFFER_LENGTH, bind, receive_from};
use spl_messages::{ReturnData, control_data, return_data};
use types::game::GameControllerMessage;

use super::game;
use super::rhythm::Rhythm;
use super::truth::Inbox;
use crate::settings::{GameSettings, NetworkSettings, Settings};

/// As often as a real GameController speaks.
const PERIOD: Duration = Duration::from_millis(500);
const FIRST: Duration = Duration::from_millis(100);

/// The referee's computer.
pub(crate) struct Referee {
    socket: UdpSocket,
    game: GameSettings,
    pub(super) rhythm: Rhythm,
    message: Option<GameControllerMessage>,
    pub(super) inbox: Inbox<ReturnData>,
}

impl Referee {
    pub(super) fn new(settings: &Settings) -> Result<Self> {
        Ok(Self {
            socket: bind(
                NetworkSettings::TABLE,
                Ipv4Addr::LOCALHOST,
                settings.network.return_port,
                "return_port",
            )?,
            game: settings.game.clone(),
            rhythm: Rhythm::new(FIRST, PERIOD),
            message: None,
            inbox: Inbox::default(),
        })
    }

    pub(super) fn socket(&self) -> &UdpSocket {
        &self.socket
    }

    pub(super) fn address(&self) -> Result<SocketAddr> {
        Ok(self.socket.local_addr()?)
    }

    /// What it said last.
    pub(super) fn message(&self) -> Option<GameControllerMessage> {
        self.message
    }

    /// What was `played` comes before what was planned. So many messages of each team are gone from its budget, the own one first.
    pub(super) fn speak(
        &mut self,
        now: Timestamp,
        played: Option<GameControllerMessage>,
        sent: [u32; 2],
    ) -> [u8; control_data::LENGTH] {
        let planned = || game::message_at(&self.game, (now - Timestamp::ZERO).as_secs_f64());
        let mut message = played.unwrap_or_else(planned);
        for (team, sent) in message.teams.iter_mut().zip(sent) {
            let left = u32::from(team.message_budget).saturating_sub(sent);
            team.message_budget = left as u16;
        }
        let message = GameControllerMessage {
            // Counts on after 255 at 0.
            packet_number: self.rhythm.advance() as u8,
            ..message
        };
        self.message = Some(message);
        control_data::encode(&message)
    }

    /// Takes all that has come.
    pub(super) fn collect(&mut self, now: Timestamp) {
        while self.collect_one(now) {}
    }

    /// Takes what has come first; whether anything has.
    pub(crate) fn collect_one(&mut self, now: Timestamp) -> bool {
        let mut bytes = [0; BUFFER_LENGTH];
        let Some((length, _)) = receive_from(&self.socket, &mut bytes) else {
            return false;
        };
        self.keep(now, &bytes[..length]);
        true
    }

    /// Answers of other teams or players are as wrong as those that are none.
    fn keep(&mut self, at: Timestamp, bytes: &[u8]) {
        let data = return_data::decode(bytes).ok();
        let team = match self.game.is_opponent {
            false => self.game.team,
            true => self.game.opponent,
        };
        let own = (team, self.game.player_number);
        let is_own = |data: &ReturnData| (data.team_number, data.player_number) == own;
        self.inbox.keep(at, data.filter(is_own));
    }
}
