//! Clients that watch a scenario: each of its robots is served at a port of its own.

use std::net::{SocketAddr, ToSocketAddrs as _};
use std::path::PathBuf;

use crate::error::{Error, Result};
use crate::launch::{Listening, Serve};

/// Who serves the robots, and where.
pub(crate) struct Audience {
    /// Starts a server.
    pub(crate) serve: Serve,
    /// What the server of the first robot is told; those of the others have the ports behind its.
    pub(crate) listening: Listening,
    /// Of the scenario: those beside it may be chosen in place of it.
    pub(crate) file: PathBuf,
}

impl Audience {
    /// As [`Self::seats`], with their sockets open.
    ///
    /// # Errors
    /// Where somebody else has one of the ports, too.
    pub(crate) fn open(&self, robots: usize) -> Result<Vec<Listening>> {
        let seats = self.seats(robots)?.into_iter();
        let opened: Result<_> = seats.map(Listening::opened).collect();
        opened.map_err(|error| error.context("cannot serve clients"))
    }

    /// What the servers of so many robots are told: where they listen, and that the others belong to them.
    ///
    /// # Errors
    /// Where the others could not be found by this address.
    fn seats(&self, robots: usize) -> Result<Vec<Listening>> {
        let written = self.listening.address.as_deref().unwrap_or_default();
        let wrong = |why: &str| {
            Error::new(format!(
                "--listen {written}: {why}; each robot of a scenario has a port of its own, the first one this, \
                 as in 127.0.0.1:4857"
            ))
        };
        let addresses: Vec<_> = written
            .to_socket_addrs()
            .map_err(|error| wrong(&error.to_string()))?
            .collect();
        let is_alone = robots == 1 && self.listening.peers.is_empty();
        // A page cannot name robots at addresses of IPv6, see `--peer`.
        let first = addresses.iter().find(|one| is_alone || one.is_ipv4());
        let first = first.ok_or_else(|| wrong("expected an address of IPv4"))?;
        if first.ip().is_unspecified() || first.port() == 0 {
            return Err(wrong(
                "expected one address and port that browsers can open",
            ));
        }
        let ports = first.port()..=u16::MAX;
        let seats: Vec<_> = ports
            .take(robots)
            .map(|port| SocketAddr::new(first.ip(), port).to_string())
            .collect();
        if seats.len() < robots {
            return Err(wrong("there are not so many ports behind it"));
        }
        let listening = |own: &String| {
            let others = seats.iter().filter(|seat| *seat != own).cloned();
            Listening {
                address: Some(own.clone()),
                peers: self.listening.peers.iter().cloned().chain(others).collect(),
                ..self.listening.clone()
            }
        };
        Ok(seats.iter().map(listening).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::launch::nobody;

    fn audience(address: &str) -> Audience {
        Audience {
            serve: nobody,
            listening: Listening {
                address: Some(address.to_owned()),
                token: Some("secret".to_owned()),
                peers: vec!["nao22.local:4857".to_owned()],
                ..Listening::default()
            },
            file: PathBuf::new(),
        }
    }

    #[test]
    fn every_robot_has_a_port_and_knows_the_others() {
        let seats = audience("127.0.0.1:4857").seats(3).expect("three ports");
        let addresses: Vec<_> = seats
            .iter()
            .filter_map(|seat| seat.address.as_deref())
            .collect();
        assert_eq!(
            addresses,
            ["127.0.0.1:4857", "127.0.0.1:4858", "127.0.0.1:4859"]
        );
        assert_eq!(
            seats[1].peers,
            ["nao22.local:4857", "127.0.0.1:4857", "127.0.0.1:4859"]
        );
        assert!(
            seats
                .iter()
                .all(|seat| seat.token.as_deref() == Some("secret"))
        );
        let mut alone = audience("[::1]:1");
        alone.listening.peers.clear();
        let seats = alone.seats(1).expect("one port");
        assert_eq!(seats[0].address.as_deref(), Some("[::1]:1"));
        assert!(seats[0].peers.is_empty());
    }

    #[test]
    fn an_address_that_no_browser_can_open_is_refused() {
        for wrong in [
            "0.0.0.0:4857",
            "[::]:4857",
            "[::1]:4857",
            "127.0.0.1:0",
            "127.0.0.1:65535",
            "4857",
            "",
        ] {
            let error = audience(wrong)
                .seats(2)
                .map(drop)
                .expect_err(wrong)
                .to_string();
            assert!(
                error.contains("--listen") && error.contains("127.0.0.1:4857"),
                "{error}"
            );
        }
    }
}
