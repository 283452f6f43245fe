//! Waits for the next datagram from the referee's computer or the own team: this cycle is about it.

use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use hardware::NetworkInterface;
use serde::{Deserialize, Serialize};
use types::network::Datagram;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct MessageReceiver {}

#[context]
pub struct CreationContext {}

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
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
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

    use framework::testing::at_millis;
    use framework::{NoEvent, Timestamp};
    use types::network::Channel;

    use super::*;

    /// Has one datagram, or none.
    struct Network {
        bytes: Option<&'static [u8]>,
    }

    impl NetworkInterface for Network {
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

    fn cycle(network: Network, datagram: &mut Datagram) -> Result<MainOutputs> {
        MessageReceiver::new(CreationContext {})?.cycle(CycleContext {
            hardware_interface: &Arc::new(network),
            datagram,
        })
    }

    #[test]
    fn the_cycle_is_about_the_arrival_of_the_datagram() {
        let mut datagram = Datagram::default();
        let bytes = Some(&b"hello"[..]);
        let outputs = cycle(Network { bytes }, &mut datagram).unwrap();
        assert_eq!(outputs.captured_at, CaptureTime(at_millis(70)));
        assert_eq!(datagram.channel, Channel::Team);
        assert_eq!(datagram.bytes, b"hello");
    }

    #[test]
    fn silence_is_no_event() {
        let error = cycle(Network { bytes: None }, &mut Datagram::default())
            .err()
            .unwrap();
        assert!(error.is_no_event());
    }
}
