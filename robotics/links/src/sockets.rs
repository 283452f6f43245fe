//! The robot's own UDP sockets: one for the referee's computer, one for the team.

use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use framework::{Error, Result, Stop};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;
use spl_messages::team_message::PERMITTED_LENGTH;
use types::network::{Channel, Datagram, Endpoint};

/// A byte longer than every message, so that what is longer is noticed.
pub const BUFFER_LENGTH: usize = PERMITTED_LENGTH + 1;
/// How long a datagram may need across the loopback interface: the kernel hands it over within the call
/// that sends it, or on a busy computer soon after.
pub const LONGEST_FLIGHT: Duration = Duration::from_secs(1);
/// How long a reader waits before it looks whether the robot stops.
const PATIENCE: Duration = Duration::from_millis(50);

/// Where a robot listens; port 0 takes a free one.
#[derive(Clone, Copy, Debug)]
pub struct Ports<'a> {
    /// The parameters that say so, for messages: `hardware.nao.network`.
    pub table: &'a str,
    /// At which of this machine's addresses it listens; 0.0.0.0: all, and the only one that hears broadcasts.
    pub address: Ipv4Addr,
    /// Where the referee's computer speaks to it.
    pub control: u16,
    /// Where its team speaks to it.
    pub team: u16,
}

/// What the robot's program hears and speaks through.
#[derive(Debug)]
pub struct RobotSockets {
    control: UdpSocket,
    team: UdpSocket,
    /// Whose turn it is where both have something, so that neither drowns the other.
    is_teams_turn: AtomicBool,
}

impl RobotSockets {
    /// Listens; the keys of the ports are `control_port` and `team_port`.
    ///
    /// # Errors
    /// Names the port that is in use, or the address that this machine does not have.
    pub fn new(ports: &Ports<'_>) -> Result<Self> {
        Ok(Self {
            control: bind(ports.table, ports.address, ports.control, "control_port")?,
            team: bind(ports.table, ports.address, ports.team, "team_port")?,
            is_teams_turn: AtomicBool::new(false),
        })
    }

    /// The socket for the referee's computer.
    pub fn control(&self) -> &UdpSocket {
        &self.control
    }

    /// The socket for the team.
    pub fn team(&self) -> &UdpSocket {
        &self.team
    }

    /// Where this machine reaches the socket for the referee's computer.
    pub fn control_address(&self) -> Result<SocketAddr> {
        reachable(&self.control)
    }

    /// Where this machine reaches the socket for the team.
    pub fn team_address(&self) -> Result<SocketAddr> {
        reachable(&self.team)
    }

    /// Waits for the next datagram on any socket; whether one came in time.
    ///
    /// # Errors
    /// Where the system does not let it wait.
    pub fn receive(&self, datagram: &mut Datagram, patience: Duration) -> Result<bool> {
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

    /// Takes the datagram that `sender` has sent to a channel; whatever foreign programs have sent
    /// to the same port is passed over. Whether it was there: after [`LONGEST_FLIGHT`] it is lost.
    ///
    /// # Errors
    /// `Stopped` once the robot stops.
    pub fn receive_arrival(
        &self,
        channel: Channel,
        sender: SocketAddr,
        datagram: &mut Datagram,
        stop: &Stop,
    ) -> Result<bool> {
        let socket = self.of(channel);
        let begun = Instant::now();
        while begun.elapsed() < LONGEST_FLIGHT {
            stop.check()?;
            if wait_for([socket], PATIENCE)? && self.take(channel, datagram)? == Some(sender) {
                datagram.sender = endpoint(sender);
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

/// A socket that does not block, at a port that the parameter `key` of `table` names.
///
/// # Errors
/// Names the port that is in use, or the address that this machine does not have.
pub fn bind(table: &str, address: Ipv4Addr, port: u16, key: &str) -> Result<UdpSocket> {
    let socket = UdpSocket::bind((address, port)).map_err(|error| {
        let is_foreign = error.kind() == std::io::ErrorKind::AddrNotAvailable;
        Error::from(error).context(if is_foreign {
            format!(
                "this machine does not have the address {address} \
                 ({table}.address); 0.0.0.0 is all that it has"
            )
        } else {
            format!(
                "cannot use UDP port {port} ({table}.{key}); end the robot or program \
                 that does, choose another one, or take free ones by `-- --free-ports`"
            )
        })
    })?;
    socket.set_nonblocking(true)?;
    Ok(socket)
}

/// Where this machine reaches a socket: who listens everywhere is reached on the loopback interface, too.
///
/// # Errors
/// Where the system does not say.
pub fn reachable(socket: &UdpSocket) -> Result<SocketAddr> {
    let address = socket.local_addr()?;
    Ok(if address.ip().is_unspecified() {
        SocketAddr::from((Ipv4Addr::LOCALHOST, address.port()))
    } else {
        address
    })
}

/// Takes one datagram, if there is one. What went wrong with an earlier one is nobody's concern.
pub fn receive_from(socket: &UdpSocket, bytes: &mut [u8]) -> Option<(usize, SocketAddr)> {
    socket.recv_from(bytes).ok()
}

/// Whether a datagram was sent. Somebody who is not there, or a network that is gone for a while, is no error.
///
/// # Errors
/// Everything else that the system has against it.
pub fn tolerate_absence(sent: std::io::Result<usize>) -> Result<bool> {
    use std::io::ErrorKind::{
        ConnectionRefused, HostUnreachable, NetworkDown, NetworkUnreachable, WouldBlock,
    };
    match sent {
        Ok(_) => Ok(true),
        Err(error) => match error.kind() {
            ConnectionRefused | HostUnreachable | NetworkDown | NetworkUnreachable | WouldBlock => {
                Ok(false)
            }
            _ => Err(error.into()),
        },
    }
}

/// Waits until one of the sockets has something; whether one has.
fn wait_for<const SOCKETS: usize>(
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sockets_look_for_a_stop_more_often_than_every_100_ms() {
        assert!(PATIENCE < Duration::from_millis(100));
    }
}
