//! The robot's end of the game's network.

use std::net::SocketAddr;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use framework::{Error, NoEvent, Result, Timestamp, blocking};
use hardware::{MessageInterface, NetworkInterface};
use links::sockets::{Ports, RobotSockets, tolerate_absence};
use types::network::{Datagram, Endpoint};

use crate::hardware::Hardware;
use crate::settings::NetworkSettings;

/// After so long without any datagram the caller hears about it.
const SILENCE: Duration = Duration::from_secs(1);
/// How long a reader waits before it looks whether the robot stops.
const PATIENCE: Duration = Duration::from_millis(50);

/// The sockets of a robot that may tell everybody.
pub(crate) struct Network {
    settings: NetworkSettings,
    /// None before the robot knows its team, where no port is chosen for that.
    sockets: OnceLock<RobotSockets>,
}

impl Network {
    /// Listens where the port for the team is chosen.
    ///
    /// # Errors
    /// Names the port that is in use, or the address that the robot does not have.
    pub(crate) fn new(settings: NetworkSettings) -> Result<Self> {
        let network = Self {
            settings,
            sockets: OnceLock::new(),
        };
        if let Some(port) = settings.team_port {
            network.listen(port)?;
        }
        Ok(network)
    }

    /// RoboCup SPL rules 2025: a team talks at 10000 and its number.
    fn join_team(&self, team: u8) -> Result<()> {
        match self.sockets.get() {
            Some(_) => Ok(()),
            None => self.listen(10_000 + u16::from(team)),
        }
    }

    fn listen(&self, team_port: u16) -> Result<()> {
        let sockets = RobotSockets::new(&Ports {
            table: NetworkSettings::TABLE,
            address: self.settings.address,
            control: self.settings.control_port,
            team: team_port,
        })?;
        sockets.team().set_broadcast(true)?;
        self.sockets.get_or_init(|| sockets);
        Ok(())
    }

    fn sockets(&self) -> Result<&RobotSockets> {
        self.sockets.get().ok_or_else(|| {
            Error::new(format!(
                "no node has said which team is this robot's; choose {}.team_port",
                NetworkSettings::TABLE
            ))
        })
    }
}

impl NetworkInterface for Hardware {
    fn join_team(&self, team: u8) -> Result<()> {
        self.network.join_team(team)
    }

    fn read_datagram(&self, datagram: &mut Datagram) -> Result<Timestamp> {
        let sockets = self.network.sockets()?;
        let begun = Instant::now();
        while begun.elapsed() < SILENCE {
            self.stop.check()?;
            if blocking(|| sockets.receive(datagram, PATIENCE))? {
                return Ok(self.clock.now());
            }
        }
        Err(NoEvent("the network is silent".to_owned()).into())
    }
}

impl MessageInterface for Hardware {
    fn send_to_game_controller(&self, to: Endpoint, bytes: &[u8]) -> Result<()> {
        let port = self.network.settings.return_port;
        if port == 0 {
            return Ok(());
        }
        let address = SocketAddr::from((to.address, port));
        tolerate_absence(self.network.sockets()?.control().send_to(bytes, address)).map(drop)
    }

    fn send_to_team(&self, bytes: &[u8]) -> Result<()> {
        let socket = self.network.sockets()?.team();
        let port = socket.local_addr()?.port();
        let team = SocketAddr::from((self.network.settings.broadcast, port));
        tolerate_absence(socket.send_to(bytes, team)).map(drop)
    }
}

#[cfg(test)]
mod tests {
    use std::net::Ipv4Addr;

    use super::*;

    /// Listens at an address of the loopback interface that is this test's own, so that all its ports are free.
    fn network(last: u8, team_port: Option<u16>) -> Network {
        let [.., high, low] = std::process::id().to_be_bytes();
        let settings = NetworkSettings {
            address: Ipv4Addr::new(127, high, low, last),
            control_port: 0,
            team_port,
            ..NetworkSettings::default()
        };
        Network::new(settings).unwrap()
    }

    fn team_port(network: &Network) -> u16 {
        let team = network.sockets().unwrap().team();
        team.local_addr().unwrap().port()
    }

    #[test]
    fn the_port_of_the_team_follows_its_number_unless_one_is_chosen() {
        let robot = network(1, None);
        robot.join_team(24).unwrap();
        assert_eq!(team_port(&robot), 10_024);
        robot.join_team(24).unwrap();
        assert_eq!(team_port(&robot), 10_024, "a node that begins anew");
        let robot = network(2, Some(10_077));
        robot.join_team(24).unwrap();
        assert_eq!(team_port(&robot), 10_077);
    }

    #[test]
    fn a_robot_that_knows_of_no_team_says_what_to_choose() {
        let error = network(3, None).sockets().unwrap_err().to_string();
        assert!(error.contains("hardware.nao.network.team_port"), "{error}");
    }

    #[test]
    fn readers_look_for_a_stop_more_often_than_every_100_ms() {
        assert!(PATIENCE < Duration::from_millis(100));
    }
}
