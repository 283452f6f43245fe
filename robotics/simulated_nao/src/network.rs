//! The simulated network: the referee's computer and a team mate, with real UDP sockets on the
//! loopback interface.
//!
//! With a wall clock whatever is sent simply arrives. With a stepped clock the network keeps in mind
//! what arrived at the robot and when, so that each datagram is one event and is read by the cycle
//! that it belongs to.

mod game;
mod mate;
mod referee;
mod rhythm;
mod truth;

#[cfg(test)]
mod tests;

use std::collections::VecDeque;
use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::sync::Arc;
use std::time::Duration;

use framework::{Result, Timestamp};
use links::sockets::{RobotSockets, reachable};
use spl_messages::control_data;
use types::game::GameControllerMessage;
use types::network::{Channel, Endpoint};

use self::mate::Mate;
use self::referee::Referee;
pub use self::truth::{NetworkTruth, Received};
use crate::ground_truth::GroundTruth;
use crate::settings::Settings;

/// From a robot's own broadcast to its return.
const ECHO_LATENCY: Duration = Duration::from_millis(1);
/// How long our referee's computer says nothing after another one: it speaks twice a second.
const RESPECT: Duration = Duration::from_secs(3);
/// More than any buffer of a socket keeps is lost, as it is on every computer.
const MOST_UNREAD: usize = 128;

/// Everybody on the network but the robot's own program.
pub(crate) struct Network {
    pub(crate) referee: Option<Referee>,
    pub(crate) mate: Option<Mate>,
    /// Who sends what nobody should.
    stranger: UdpSocket,
    robot: Option<Arc<RobotSockets>>,
    /// Where datagrams for each channel go.
    destinations: [Option<SocketAddr>; 2],
    return_port: u16,
    nominal_ports: [u16; 3],
    is_stepped: bool,
    /// Another referee's computer is on the network.
    quiet_until: Timestamp,
    /// What is on its way to the robot, with a stepped clock, first arrival first.
    flights: VecDeque<Flight>,
    /// What has arrived at the robot and was not read, with a stepped clock, oldest first.
    unread: VecDeque<Arrival>,
}

/// Who sends.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
enum Sender {
    Referee,
    Mate,
    /// The robot hears its own broadcasts.
    Robot,
    /// Another one of its team, with its own program.
    OtherRobot,
    Stranger,
}

/// A datagram that will arrive.
struct Flight {
    arrives_at: Timestamp,
    sender: Sender,
    channel: Channel,
    bytes: Vec<u8>,
}

/// A datagram that waits in one of the robot's sockets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arrival {
    pub(crate) at: Timestamp,
    pub(crate) channel: Channel,
    /// Which of the datagrams in the socket it is.
    pub(crate) sender: SocketAddr,
    /// The sender as nodes see it: free ports differ from run to run, this does not.
    pub(crate) endpoint: Endpoint,
}

impl Network {
    /// The network around the robot's sockets; without them others may listen at the chosen ports.
    ///
    /// # Errors
    /// Names the port that is in use.
    pub(crate) fn new(
        settings: &Settings,
        robot: Option<Arc<RobotSockets>>,
        is_stepped: bool,
    ) -> Result<Self> {
        let chosen = |port: u16| (port != 0).then(|| loopback(port));
        let destinations = match &robot {
            Some(robot) => [robot.control_address()?, robot.team_address()?].map(Some),
            None => [
                chosen(settings.network.control_port),
                chosen(settings.network.team_port),
            ],
        };
        let team_port = 10_000 + u16::from(settings.team());
        Ok(Self {
            referee: settings
                .network
                .referee
                .then(|| Referee::new(settings))
                .transpose()?,
            mate: settings
                .network
                .mate
                .then(|| Mate::new(settings))
                .transpose()?,
            stranger: UdpSocket::bind(loopback(0))?,
            robot,
            destinations,
            return_port: settings.network.return_port,
            nominal_ports: [3939, team_port, 9],
            is_stepped,
            quiet_until: Timestamp::ZERO,
            flights: VecDeque::new(),
            unread: VecDeque::new(),
        })
    }

    /// Where the robot's answers to the referee's computer go: to ours, or to whoever listens at the
    /// chosen port; 0 where nobody can.
    pub(crate) fn return_port(&self) -> Result<u16> {
        match &self.referee {
            Some(referee) => Ok(referee.address()?.port()),
            None => Ok(self.return_port),
        }
    }

    /// Where the robot's broadcasts go beside the robot itself.
    pub(crate) fn mate_address(&self) -> Result<Option<SocketAddr>> {
        self.mate.as_ref().map(Mate::address).transpose()
    }

    /// When the referee's computer speaks next.
    pub(crate) fn referee_due(&self) -> Timestamp {
        self.referee
            .as_ref()
            .map_or(Timestamp::NEVER, |referee| referee.rhythm.due())
    }

    /// When the team mate speaks next.
    pub(crate) fn mate_due(&self) -> Timestamp {
        self.mate
            .as_ref()
            .map_or(Timestamp::NEVER, |mate| mate.rhythm.due())
    }

    /// When the next of all other datagrams arrives.
    pub(crate) fn flight_due(&self) -> Timestamp {
        self.flights
            .front()
            .map_or(Timestamp::NEVER, |flight| flight.arrives_at)
    }

    /// Lets the referee's computer speak, which has heard so many messages of each team; whether something arrived at the robot.
    pub(crate) fn referee_speaks(
        &mut self,
        now: Timestamp,
        played: Option<GameControllerMessage>,
        sent: [u32; 2],
    ) -> Result<bool> {
        let Some(referee) = &mut self.referee else {
            return Ok(false);
        };
        let bytes = referee.speak(now, played, sent);
        if now < self.quiet_until {
            return Ok(false);
        }
        self.deliver(now, Sender::Referee, Channel::GameController, &bytes)
    }

    /// The robot has heard something at the port for the referee's computer: where it comes from another one than ours, ours
    /// says nothing until that has been silent for a while.
    pub(crate) fn overheard(&mut self, now: Timestamp, sender: &Endpoint, bytes: &[u8]) {
        let ours = self.referee.as_ref().and_then(|own| own.address().ok());
        let is_ours = ours.is_some_and(|address| {
            address.port() == sender.port && sender.address == Ipv4Addr::LOCALHOST.octets()
        });
        if !is_ours && control_data::decode(bytes).is_ok() {
            self.quiet_until = now + RESPECT;
        }
    }

    /// Lets the team mate speak; whether something arrived at the robot.
    pub(crate) fn mate_speaks(
        &mut self,
        now: Timestamp,
        truth: impl FnOnce() -> GroundTruth,
    ) -> Result<bool> {
        let Some(mate) = &mut self.mate else {
            return Ok(false);
        };
        let bytes = mate.speak(&truth())?;
        self.deliver(now, Sender::Mate, Channel::Team, &bytes)
    }

    /// Lets the next of all other datagrams arrive; whether it did.
    pub(crate) fn datagram_arrives(&mut self, now: Timestamp) -> Result<bool> {
        let Some(flight) = self.flights.pop_front() else {
            return Ok(false);
        };
        self.deliver(now, flight.sender, flight.channel, &flight.bytes)
    }

    /// Leaves out what should have been said until `now`.
    pub(crate) fn skip_to(&mut self, now: Timestamp) {
        if let Some(referee) = &mut self.referee {
            referee.rhythm.skip_to(now);
        }
        if let Some(mate) = &mut self.mate {
            mate.rhythm.skip_to(now);
        }
    }

    /// Sends anything to one of the robot's ports, as anybody could.
    pub(crate) fn stranger_speaks(
        &mut self,
        now: Timestamp,
        channel: Channel,
        bytes: &[u8],
    ) -> Result<()> {
        if self.is_stepped {
            self.send_off(now, Sender::Stranger, channel, bytes);
            return Ok(());
        }
        self.deliver(now, Sender::Stranger, channel, bytes)
            .map(drop)
    }

    /// The robot has told its team something: with a stepped clock its broadcast comes back later.
    pub(crate) fn robot_has_broadcast(&mut self, now: Timestamp, bytes: &[u8]) {
        self.send_off(now + ECHO_LATENCY, Sender::Robot, Channel::Team, bytes);
    }

    /// Another robot of its team has told it something that arrives later, with a stepped clock.
    pub(crate) fn mate_has_broadcast(&mut self, arrives_at: Timestamp, bytes: &[u8]) {
        self.send_off(arrives_at, Sender::OtherRobot, Channel::Team, bytes);
    }

    /// Takes what the robot has sent to the referee's computer and to the team mate.
    pub(crate) fn collect(&mut self, now: Timestamp) {
        if let Some(referee) = &mut self.referee {
            referee.collect(now);
        }
        if let Some(mate) = &mut self.mate {
            mate.collect(now);
        }
    }

    /// The oldest datagram that arrived at the robot until `now` and was not read; and whether the
    /// one after it should have been read before `now` already.
    pub(crate) fn take_arrival(&mut self, now: Timestamp) -> Option<(Arrival, bool)> {
        let arrival = self.unread.pop_front_if(|arrival| arrival.at <= now)?;
        let is_behind = self.unread.front().is_some_and(|next| next.at < now);
        Some((arrival, is_behind))
    }

    fn send_off(&mut self, arrives_at: Timestamp, sender: Sender, channel: Channel, bytes: &[u8]) {
        let place = self
            .flights
            .partition_point(|flight| flight.arrives_at <= arrives_at);
        let bytes = bytes.to_vec();
        self.flights.insert(
            place,
            Flight {
                arrives_at,
                sender,
                channel,
                bytes,
            },
        );
    }

    /// Sends to the robot; whether it will be read there. A robot that is not there is no error.
    fn deliver(
        &mut self,
        now: Timestamp,
        sender: Sender,
        channel: Channel,
        bytes: &[u8],
    ) -> Result<bool> {
        let (Some(destination), Some(socket)) =
            (self.destinations[channel as usize], self.socket(sender))
        else {
            return Ok(false);
        };
        if self.is_stepped && self.unread.len() >= MOST_UNREAD {
            return Ok(false);
        }
        let sent = socket.send_to(bytes, destination).is_ok();
        let address = reachable(socket)?;
        if sent && self.is_stepped {
            self.unread.push_back(Arrival {
                at: now,
                channel,
                sender: address,
                endpoint: self.endpoint(sender),
            });
        }
        Ok(sent)
    }

    fn socket(&self, sender: Sender) -> Option<&UdpSocket> {
        match sender {
            Sender::Referee => self.referee.as_ref().map(Referee::socket),
            Sender::Mate => self.mate.as_ref().map(Mate::socket),
            Sender::Robot => self.robot.as_deref().map(RobotSockets::team),
            Sender::OtherRobot | Sender::Stranger => Some(&self.stranger),
        }
    }

    fn endpoint(&self, sender: Sender) -> Endpoint {
        let [referee, team, stranger] = self.nominal_ports;
        Endpoint {
            address: Ipv4Addr::LOCALHOST.octets(),
            port: match sender {
                Sender::Referee => referee,
                Sender::Mate | Sender::Robot | Sender::OtherRobot => team,
                Sender::Stranger => stranger,
            },
        }
    }
}

pub(crate) fn loopback(port: u16) -> SocketAddr {
    SocketAddr::from((Ipv4Addr::LOCALHOST, port))
}
