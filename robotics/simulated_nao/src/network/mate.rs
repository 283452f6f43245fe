//! A team mate: it tells the robot where it is and where the ball is, and keeps what the robot says.
//!
//! It is the own robot of that number that the cameras see; where there is none, it is lost.

use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::time::Duration;

use framework::{Result, Timestamp};
use links::sockets::{BUFFER_LENGTH, bind, receive_from};
use nalgebra::Isometry2;
use spl_messages::team_message;
use types::team::{TeamBall, TeamMessage};

use super::rhythm::Rhythm;
use super::truth::Inbox;
use crate::ground_truth::GroundTruth;
use crate::scene::{Robot, Team};
use crate::settings::{NetworkSettings, Settings};

const PERIOD: Duration = Duration::from_secs(1);
const FIRST: Duration = Duration::from_millis(650);

/// A team mate that stands somewhere and knows where the ball is.
pub(crate) struct Mate {
    socket: UdpSocket,
    number: u8,
    pub(super) rhythm: Rhythm,
    pub(super) inbox: Inbox<TeamMessage>,
}

impl Mate {
    pub(super) fn new(settings: &Settings) -> Result<Self> {
        Ok(Self {
            socket: bind(
                NetworkSettings::TABLE,
                Ipv4Addr::LOCALHOST,
                settings.network.mate_port,
                "mate_port",
            )?,
            number: settings.game.mate_number(),
            rhythm: Rhythm::new(FIRST, PERIOD),
            inbox: Inbox::default(),
        })
    }

    pub(super) fn socket(&self) -> &UdpSocket {
        &self.socket
    }

    pub(super) fn address(&self) -> Result<SocketAddr> {
        Ok(self.socket.local_addr()?)
    }

    pub(super) fn speak(&mut self, truth: &GroundTruth) -> Result<Vec<u8>> {
        self.rhythm.advance();
        let is_self = |robot: &&Robot| robot.team == Team::Own && robot.number == self.number;
        let ground_to_field = truth.robots.iter().find(is_self).map(pose);
        let ball = ground_to_field.zip(truth.ball);
        let message = TeamMessage {
            player_number: self.number,
            is_fallen: false,
            plays_ball: false,
            ground_to_field,
            ball: ball.map(|(pose, ball)| TeamBall {
                position: pose.inverse_transform_point(&ball.xy()),
                age: 0.0,
            }),
        };
        let mut room = [0; team_message::GREATEST_LENGTH];
        Ok(team_message::encode(&message, &mut room)?.to_vec())
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

    fn keep(&mut self, at: Timestamp, bytes: &[u8]) {
        self.inbox.keep(at, team_message::decode(bytes).ok());
    }
}

fn pose(robot: &Robot) -> Isometry2<f32> {
    Isometry2::new(robot.position.coords, robot.heading).cast()
}
