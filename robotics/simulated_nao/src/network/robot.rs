//! The robot's own sockets: one for the referee's computer, one for the team.

use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use framework::{Error, Result, Stop};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;
use spl_messages::team_message::PERMITTED_LENGTH;
use types::network::{Channel, Datagram, Endpoint};

use super::{Arrival, LONGEST_FLIGHT, loopback};
use crate::settings::NetworkSettings;

/// A byte longer than every message, so that what is longer is noticed.
pub(super) const BUFFER_LENGTH: usize = PERMITTED_LENGTH + 1;
/// How long a reader waits before it looks whether the robot stops.
pub(super) const PATIENCE: Duration = Duration::from_millis(50);

/// What the robot's program hears and speaks through.
#[derive(Debug)]
pub(crate) struct RobotSockets {
    control: UdpSocket,
    team: UdpSocket,
    /// Whose turn it is where both have something, so that neither drowns the other.
    is_teams_turn: AtomicBool,
}

impl RobotSockets {
    /// # Errors
    /// Names the port that is in use, or the address that this machine does not have.
    pub(crate) fn new(settings: &NetworkSettings) -> Result<Self> {
        Ok(Self {
            control: bind(settings.address, settings.control_port, "control_port")?,
            team: bind(settings.address, settings.team_port, "team_port")?,
            is_teams_turn: AtomicBool::new(false),
        })
    }

    pub(crate) fn control(&self) -> &UdpSocket {
        &self.control
    }

    pub(crate) fn team(&self) -> &UdpSocket {
        &self.team
    }

    /// Where this machine reaches the socket for the referee's computer.
    pub(crate) fn control_address(&self) -> Result<SocketAddr> {
        reachable(&self.control)
    }

    /// Where this machine reaches the socket for the team.
    pub(crate) fn team_address(&self) -> Result<SocketAddr> {
        reachable(&self.team)
    }

    /// Waits for the next datagram on any socket; whether one came in time.
    pub(crate) fn receive(&self, datagram: &mut Datagram, patience: Duration) -> Result<bool> {
        if !wait_for([&self.control, &self.team], patience)? {
            return Ok(false);
        }
        // Relaxed: nothing but this flag depends on it.
        let is_teams_turn = self.is_teams_turn.fetch_not(Ordering::Relaxed);
        let mut channels = [Channel::GameController, Channel::Team];
        if is_teams_turn {
            channels.reverse();
        }
        for channel in channels {
            if let Some(sender) = self.take(channel, datagram)? {
                datagram.sender = endpoint(sender);
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Takes the datagram that has arrived, with a stepped clock; whatever foreign programs have sent
    /// to the same port is passed over. Whether it was there: after [`LONGEST_FLIGHT`] it is lost.
    ///
    /// # Errors
    /// `Stopped` once the robot stops.
    pub(crate) fn receive_arrival(
        &self,
        arrival: &Arrival,
        datagram: &mut Datagram,
        stop: &Stop,
    ) -> Result<bool> {
        let socket = self.of(arrival.channel);
        let begun = Instant::now();
        while begun.elapsed() < LONGEST_FLIGHT {
            stop.check()?;
            if wait_for([socket], PATIENCE)?
                && self.take(arrival.channel, datagram)? == Some(arrival.sender)
            {
                datagram.sender = arrival.endpoint;
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn of(&self, channel: Channel) -> &UdpSocket {
        match channel {
            Channel::GameController => &self.control,
            Channel::Team => &self.team,
        }
    }

    /// What waits in a socket; what is too long is cut.
    fn take(&self, channel: Channel, datagram: &mut Datagram) -> Result<Option<SocketAddr>> {
        datagram.channel = channel;
        datagram.bytes.resize(BUFFER_LENGTH, 0);
        let received = receive_from(self.of(channel), &mut datagram.bytes);
        datagram
            .bytes
            .truncate(received.map_or(0, |(length, _)| length));
        Ok(received.map(|(_, sender)| sender))
    }
}

/// A socket of the simulated network.
///
/// # Errors
/// Names the port that is in use, or the address that this machine does not have.
pub(super) fn bind(address: Ipv4Addr, port: u16, key: &str) -> Result<UdpSocket> {
    let socket = UdpSocket::bind((address, port)).map_err(|error| {
        let is_foreign = error.kind() == std::io::ErrorKind::AddrNotAvailable;
        Error::from(error).context(if is_foreign {
            format!(
                "this machine does not have the address {address} \
                 (hardware.simulated.network.address); 0.0.0.0 is all that it has"
            )
        } else {
            format!(
                "cannot use UDP port {port} (hardware.simulated.network.{key}); stop the program \
                 that does, choose another one, or use --free-ports"
            )
        })
    })?;
    socket.set_nonblocking(true)?;
    Ok(socket)
}

/// Who listens everywhere is reached on the loopback interface, too.
pub(super) fn reachable(socket: &UdpSocket) -> Result<SocketAddr> {
    let address = socket.local_addr()?;
    Ok(if address.ip().is_unspecified() {
        loopback(address.port())
    } else {
        address
    })
}

/// Takes one datagram, if there is one. What went wrong with an earlier one is nobody's concern.
pub(super) fn receive_from(socket: &UdpSocket, bytes: &mut [u8]) -> Option<(usize, SocketAddr)> {
    socket.recv_from(bytes).ok()
}

/// Waits until one of the sockets has something; whether one has.
pub(super) fn wait_for<const SOCKETS: usize>(
    sockets: [&UdpSocket; SOCKETS],
    patience: Duration,
) -> Result<bool> {
    let mut polled = sockets.map(|socket| PollFd::new(socket, PollFlags::IN));
    let begun = Instant::now();
    loop {
        let left = patience.saturating_sub(begun.elapsed());
        let timeout = Timespec {
            tv_sec: left.as_secs() as i64,
            tv_nsec: left.subsec_nanos().into(),
        };
        match poll(&mut polled, Some(&timeout)) {
            Ok(count) => return Ok(count > 0),
            // A signal says nothing about the sockets.
            Err(Errno::INTR) => {}
            Err(error) => return Err(std::io::Error::from(error).into()),
        }
    }
}

fn endpoint(address: SocketAddr) -> Endpoint {
    let ip = match address {
        SocketAddr::V4(address) => address.ip().octets(),
        // No socket of the robot has such an address.
        SocketAddr::V6(_) => [0; 4],
    };
    Endpoint {
        address: ip,
        port: address.port(),
    }
}
