//! Where the robot listens on the simulated network, and who is on it.

use std::net::Ipv4Addr;

use framework::{Error, Result};
use links::sockets::Ports;
use serde::Deserialize;

/// The robot's address and UDP ports; port 0 takes a free one.
#[derive(Clone, Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NetworkSettings {
    /// Where the robot listens: 127.0.0.1 to this machine alone, 0.0.0.0 to every network that it is on.
    pub address: Ipv4Addr,
    /// Where the robot hears the referee's computer; 3838 on a real field.
    pub control_port: u16,
    /// Where the referee's computer hears answers; 3939 on a real field.
    pub return_port: u16,
    /// Where the robot hears its team; 10000 and the team's number on a real field.
    pub team_port: u16,
    /// Where the team mate hears the robot.
    pub mate_port: u16,
    /// Whether there is a referee's computer.
    pub referee: bool,
    /// Whether there is a team mate.
    pub mate: bool,
}

impl Default for NetworkSettings {
    fn default() -> Self {
        Self {
            address: Ipv4Addr::LOCALHOST,
            control_port: 0,
            return_port: 0,
            team_port: 0,
            mate_port: 0,
            referee: true,
            mate: true,
        }
    }
}

impl NetworkSettings {
    /// Where they stand among the parameters.
    pub(crate) const TABLE: &'static str = "hardware.simulated.network";

    /// Where the robot's own sockets listen.
    pub(crate) fn ports(&self) -> Ports<'static> {
        Ports {
            table: Self::TABLE,
            address: self.address,
            control: self.control_port,
            team: self.team_port,
        }
    }

    /// Takes free ports, whatever was chosen.
    pub(super) fn free_ports(&mut self) {
        self.control_port = 0;
        self.return_port = 0;
        self.team_port = 0;
        self.mate_port = 0;
    }

    /// Refuses one port for two.
    pub(super) fn check(&self) -> Result<()> {
        let ports = [
            ("control_port", self.control_port),
            ("return_port", self.return_port),
            ("team_port", self.team_port),
            ("mate_port", self.mate_port),
        ];
        for (index, (key, port)) in ports.iter().enumerate() {
            let same = ports[..index].iter().find(|(_, other)| other == port);
            if let Some((other, _)) = same
                && *port != 0
            {
                return Err(Error::new(format!(
                    "{}.{key}: {port} is `{other}` already",
                    Self::TABLE
                )));
            }
        }
        Ok(())
    }
}
