//! The robot's end of the game's network.

use std::net::SocketAddr;
use std::time::{Duration, Instant};

use framework::{NoEvent, Result, Timestamp, blocking};
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
///
/// # Errors
/// Names the port that is in use, or the address that the robot does not have.
pub(crate) fn listen(settings: &NetworkSettings) -> Result<RobotSockets> {
    let sockets = RobotSockets::new(&Ports {
        table: NetworkSettings::TABLE,
        address: settings.address,
        control: settings.control_port,
        team: settings.team_port,
    })?;
    sockets.team().set_broadcast(true)?;
    Ok(sockets)
}

impl NetworkInterface for Hardware {
    fn read_datagram(&self, datagram: &mut Datagram) -> Result<Timestamp> {
        let begun = Instant::now();
        while begun.elapsed() < SILENCE {
            self.stop.check()?;
            if blocking(|| self.sockets.receive(datagram, PATIENCE))? {
                return Ok(self.clock.now());
            }
        }
        Err(NoEvent("the network is silent".to_owned()).into())
    }
}

impl MessageInterface for Hardware {
    fn send_to_game_controller(&self, to: Endpoint, bytes: &[u8]) -> Result<()> {
        if self.network.return_port == 0 {
            return Ok(());
        }
        let address = SocketAddr::from((to.address, self.network.return_port));
        tolerate_absence(self.sockets.control().send_to(bytes, address)).map(drop)
    }

    fn send_to_team(&self, bytes: &[u8]) -> Result<()> {
        let port = self.sockets.team().local_addr()?.port();
        let team = SocketAddr::from((self.network.broadcast, port));
        tolerate_absence(self.sockets.team().send_to(bytes, team)).map(drop)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readers_look_for_a_stop_more_often_than_every_100_ms() {
        assert!(PATIENCE < Duration::from_millis(100));
    }
}
