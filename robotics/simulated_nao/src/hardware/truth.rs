//! What tests may know and do beside the robot's own senses.

use framework::{Result, Timestamp};
use types::audio::Tone;
use types::camera::CameraPosition;
use types::leds::Leds;
use types::motor_commands::MotorCommands;
use types::network::Channel;

use super::Hardware;
use crate::ground_truth::{BodyTruth, GroundTruth, ImageTruth};
use crate::network::{NetworkTruth, Received};
use crate::physics::Disturbance;
use crate::sound::WhistleTruth;

impl Hardware {
    /// What is really the case, for tests.
    pub fn ground_truth(&self) -> GroundTruth {
        self.shared.lock().ground_truth()
    }

    /// Does to the world what no motor does, for tests and scenarios.
    pub fn disturb(&self, disturbance: &Disturbance) {
        self.shared.stage.lock().world.disturb(disturbance);
    }

    /// The body at each of LoLA's last 512 states, oldest first, for tests.
    pub fn body_truths(&self) -> Vec<BodyTruth> {
        self.shared.lock().bodies()
    }

    /// The last 512 commands for motors that came over LoLA's socket, oldest first, numbered from 0, for tests.
    pub fn received_commands(&self) -> Vec<(u64, MotorCommands)> {
        self.shared.lock().server().commands()
    }

    /// Where the camera was at one of its last 512 exposures and what it saw, for tests.
    pub fn image_truth(
        &self,
        position: CameraPosition,
        captured_at: Timestamp,
    ) -> Option<ImageTruth> {
        self.shared.lock().image_truth(position, captured_at)
    }

    /// What the referee's computer and the team mate have said and heard, for tests.
    pub fn network_truth(&self) -> NetworkTruth {
        let mut simulation = self.shared.lock();
        if self.thread.is_some() {
            simulation.network.collect(self.clock.now());
        }
        simulation.network.truth()
    }

    /// The whistles that have begun to sound until now, for tests.
    pub fn whistles(&self) -> Vec<WhistleTruth> {
        let now = (self.clock.now() - Timestamp::ZERO).as_secs_f64();
        let whistles = self.shared.sound_settings.whistles();
        whistles
            .take_while(|whistle| whistle.begins_at <= now)
            .collect()
    }

    /// The last 512 tones that the robot has begun to play, for tests.
    pub fn tones(&self) -> Vec<Received<Tone>> {
        self.shared.lock().tones()
    }

    /// The lights as LoLA shows them since the last state, for tests.
    pub fn leds(&self) -> Leds {
        self.shared.lock().server().command().leds
    }

    /// Makes the next image that is read from one camera arrive garbled, for tests.
    pub fn garble_next_image(&self, position: CameraPosition) {
        *self.shared.lock().garble_image.of_mut(position) = true;
    }

    /// Makes the next state that LoLA sends arrive garbled, for tests.
    pub fn garble_next_state(&self) {
        self.shared.lock().garble_state = true;
    }

    /// Sends anything to the port where the robot hears the referee's computer, for tests.
    ///
    /// # Errors
    /// Where there are no sockets at all.
    pub fn send_to_control_port(&self, bytes: &[u8]) -> Result<()> {
        self.send(Channel::GameController, bytes)
    }

    /// Sends anything to the port where the robot hears its team, for tests.
    ///
    /// # Errors
    /// Where there are no sockets at all.
    pub fn send_to_team_port(&self, bytes: &[u8]) -> Result<()> {
        self.send(Channel::Team, bytes)
    }

    /// The ports at which the robot hears the referee's computer and its team, and the one at which
    /// the referee's computer hears the robot (0 without one), for tests.
    ///
    /// # Errors
    /// Where there are no sockets at all.
    pub fn ports(&self) -> Result<[u16; 3]> {
        Ok([
            self.sockets.control_address()?.port(),
            self.sockets.team_address()?.port(),
            self.return_port,
        ])
    }

    /// What the client counted on its connection to LoLA.
    pub fn counts(&self) -> lola::Counts {
        self.client.counts()
    }

    /// How often LoLA received something that is no command.
    pub fn rejected_commands(&self) -> u64 {
        self.shared.lock().server().rejected()
    }

    fn send(&self, channel: Channel, bytes: &[u8]) -> Result<()> {
        let now = self.clock.now();
        let network = &mut self.shared.lock().network;
        network.stranger_speaks(now, channel, bytes)
    }
}
