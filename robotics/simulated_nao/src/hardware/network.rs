//! The robot's end of the network.

use std::net::{Ipv4Addr, SocketAddr};
use std::time::{Duration, Instant};

use framework::{NoEvent, Result, Timestamp, blocking};
use hardware::{MessageInterface, NetworkInterface};
use links::sockets::{LONGEST_FLIGHT, tolerate_absence};
use types::network::{Channel, Datagram, Endpoint};

use super::{Hardware, PATIENCE};
use crate::network::Network;

/// After so long without any datagram the caller hears about it.
const SILENCE: Duration = Duration::from_secs(1);
/// How long the others leave the world alone before they look again for what the robot has sent.
const GLANCE: Duration = Duration::from_millis(1);

impl NetworkInterface for Hardware {
    /// Its parameters say where it listens: others are told, too.
    fn join_team(&self, _team: u8) -> Result<()> {
        Ok(())
    }

    fn read_datagram(&self, datagram: &mut Datagram) -> Result<Timestamp> {
        if self.thread.is_none() {
            return self.read_arrival(datagram);
        }
        let begun = Instant::now();
        while begun.elapsed() < SILENCE {
            self.stop.check()?;
            if blocking(|| self.sockets.receive(datagram, PATIENCE))? {
                if datagram.channel == Channel::GameController {
                    let network = &mut self.shared.lock().network;
                    network.overheard(self.clock.now(), &datagram.sender, &datagram.bytes);
                }
                return Ok(self.clock.now());
            }
        }
        Err(NoEvent("the network is silent".to_owned()).into())
    }
}

impl MessageInterface for Hardware {
    fn send_to_game_controller(&self, to: Endpoint, bytes: &[u8]) -> Result<()> {
        let address = Ipv4Addr::from(to.address);
        if self.return_port == 0 {
            return Ok(());
        }
        let destination = SocketAddr::from((address, self.return_port));
        let sent = tolerate_absence(self.sockets.control().send_to(bytes, destination))?;
        if sent && self.thread.is_none() && address == Ipv4Addr::LOCALHOST {
            let now = self.clock.now();
            self.await_hearing(|network| {
                let referee = network.referee.as_mut();
                referee.is_none_or(|referee| referee.collect_one(now))
            })?;
        }
        Ok(())
    }

    fn send_to_team(&self, bytes: &[u8]) -> Result<()> {
        let is_stepped = self.thread.is_none();
        if let Some(mate) = self.mate {
            let sent = tolerate_absence(self.sockets.team().send_to(bytes, mate))?;
            if sent && is_stepped {
                let now = self.clock.now();
                self.await_hearing(|network| {
                    let mate = network.mate.as_mut();
                    mate.is_none_or(|mate| mate.collect_one(now))
                })?;
            }
        }
        // Who broadcasts hears it, too.
        if is_stepped {
            let now = self.clock.now();
            self.shared.lock().broadcast(now, bytes);
            return Ok(());
        }
        self.shared.lock().count_message();
        let own = self.sockets.team_address()?;
        tolerate_absence(self.sockets.team().send_to(bytes, own)).map(drop)
    }
}

impl Hardware {
    fn read_arrival(&self, datagram: &mut Datagram) -> Result<Timestamp> {
        self.stop.check()?;
        let now = self.clock.now();
        let arrival = self.shared.lock().network.take_arrival(now);
        let (arrival, is_behind) =
            arrival.ok_or_else(|| NoEvent("no datagram has come since the last".to_owned()))?;
        if is_behind {
            self.shared.lock().is_behind.insert("SplNetwork");
        }
        let (channel, sender) = (arrival.channel, arrival.sender);
        let receive = || {
            self.sockets
                .receive_arrival(channel, sender, datagram, &self.stop)
        };
        if blocking(receive)? {
            datagram.sender = arrival.endpoint;
            Ok(arrival.at)
        } else {
            Err(NoEvent("a datagram was lost on the loopback interface".to_owned()).into())
        }
    }

    /// With a stepped clock: lets somebody hear what the robot has just sent, or lose it. Nobody who
    /// needs the world waits meanwhile.
    fn await_hearing(&self, mut hears: impl FnMut(&mut Network) -> bool) -> Result<()> {
        let begun = Instant::now();
        while !hears(&mut self.shared.lock().network) {
            if begun.elapsed() > LONGEST_FLIGHT {
                break;
            }
            self.stop.wait(GLANCE)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use framework::{Clock, Hardware as _, HardwareContext, Stop};

    use super::*;

    fn create(stop: &Stop) -> Hardware {
        Hardware::new(HardwareContext {
            options: vec!["--no-cameras".to_owned(), "--free-ports".to_owned()],
            table: Default::default(),
            run_folder: std::env::temp_dir(),
            clock: Clock::stepped(),
            stop: stop.clone(),
        })
        .unwrap()
    }

    /// Lets a datagram arrive, and takes it away.
    fn lose_a_datagram(hardware: &Hardware) {
        hardware.send_to_control_port(b"lost").unwrap();
        let next = || hardware.next_event().unwrap().unwrap().instance;
        while next() != "SplNetwork" {}
        let mut datagram = Datagram::default();
        assert!(hardware.sockets.receive(&mut datagram, SILENCE).unwrap());
    }

    #[test]
    fn a_lost_datagram_is_no_event() {
        let hardware = create(&Stop::new());
        lose_a_datagram(&hardware);
        let error = hardware
            .read_datagram(&mut Datagram::default())
            .unwrap_err();
        assert!(error.is_no_event(), "{error}");
    }

    #[test]
    fn a_stop_ends_the_waiting_for_a_lost_datagram() {
        let stop = Stop::new();
        let hardware = create(&stop);
        lose_a_datagram(&hardware);
        std::thread::scope(|scope| {
            let read = scope.spawn(|| hardware.read_datagram(&mut Datagram::default()));
            std::thread::sleep(Duration::from_millis(20));
            stop.request();
            assert!(read.join().unwrap().unwrap_err().is_stopped());
        });
    }

    #[test]
    fn nobody_waits_for_what_was_never_sent_with_the_world_locked() {
        let stop = Stop::new();
        let hardware = create(&stop);
        std::thread::scope(|scope| {
            let waiting = scope.spawn(|| hardware.await_hearing(|_| false));
            std::thread::sleep(Duration::from_millis(20));
            hardware.ground_truth();
            assert!(!waiting.is_finished());
            stop.request();
            assert!(waiting.join().unwrap().unwrap_err().is_stopped());
        });
    }

    /// The tests with threads allow for a busy machine; what is promised is held by this.
    #[test]
    fn readers_look_for_a_stop_more_often_than_every_100_ms() {
        assert!(PATIENCE < Duration::from_millis(100));
        assert!(GLANCE < Duration::from_millis(100));
    }
}
