//! Waits for the next datagram from the referee's computer or the own team: this cycle is about it.

use framework::{CaptureTime, HardwareInterface, MainOutput, Parameter, Result, context};
use hardware::NetworkInterface;
use serde::{Deserialize, Serialize};
use types::network::Datagram;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct MessageReceiver {}

#[context]
pub struct CreationContext {
    hardware_interface: HardwareInterface,
    team: Parameter<u8, "player.team">,
}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    /// What came, from whom, and for whom.
    datagram: MainOutput<Datagram>,
}

#[context]
pub struct MainOutputs {
    /// When it arrived.
    captured_at: CaptureTime,
}

impl MessageReceiver {
    /// Listens to the own team.
    pub fn new(context: CreationContext<impl NetworkInterface>) -> Result<Self> {
        context.hardware_interface.join_team(*context.team)?;
        Ok(Self {})
    }

    /// Blocks until something came, whatever it is: others say whether it can be understood.
    pub fn cycle(&mut self, context: CycleContext<impl NetworkInterface>) -> Result<MainOutputs> {
        let captured_at = context.hardware_interface.read_datagram(context.datagram)?;
        Ok(MainOutputs {
            captured_at: captured_at.into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicU8, Ordering};

    use framework::testing::at_millis;
    use framework::{NoEvent, Timestamp};
    use types::network::Channel;

    use super::*;

    /// Has one datagram, or none.
    #[derive(Default)]
    struct Network {
        bytes: Option<&'static [u8]>,
        team: AtomicU8,
    }

    impl NetworkInterface for Network {
        fn join_team(&self, team: u8) -> Result<()> {
            // Relaxed: the test has one thread.
            self.team.store(team, Ordering::Relaxed);
            Ok(())
        }

        fn read_datagram(&self, datagram: &mut Datagram) -> Result<Timestamp> {
            let silence = || NoEvent("nothing came".to_owned());
            datagram.channel = Channel::Team;
            datagram.bytes.clear();
            datagram
                .bytes
                .extend_from_slice(self.bytes.ok_or_else(silence)?);
            Ok(at_millis(70))
        }
    }

    fn node(network: &Arc<Network>, team: u8) -> MessageReceiver {
        let context = CreationContext {
            hardware_interface: network,
            team: &team,
        };
        MessageReceiver::new(context).unwrap()
    }

    fn cycle(network: Network, datagram: &mut Datagram) -> Result<MainOutputs> {
        let network = Arc::new(network);
        node(&network, 77).cycle(CycleContext {
            hardware_interface: &network,
            datagram,
        })
    }

    #[test]
    fn the_robot_listens_to_its_own_team() {
        let network = Arc::new(Network::default());
        node(&network, 24);
        assert_eq!(network.team.load(Ordering::Relaxed), 24);
    }

    #[test]
    fn the_cycle_is_about_the_arrival_of_the_datagram() {
        let mut datagram = Datagram::default();
        let bytes = Some(&b"hello"[..]);
        let network = Network {
            bytes,
            ..Network::default()
        };
        let outputs = cycle(network, &mut datagram).unwrap();
        assert_eq!(outputs.captured_at, CaptureTime(at_millis(70)));
        assert_eq!(datagram.channel, Channel::Team);
        assert_eq!(datagram.bytes, b"hello");
    }

    #[test]
    fn silence_is_no_event() {
        let error = cycle(Network::default(), &mut Datagram::default())
            .err()
            .unwrap();
        assert!(error.is_no_event());
    }
}
