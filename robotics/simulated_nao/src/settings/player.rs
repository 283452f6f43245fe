//! Who a robot is where a scenario has several.

use framework::{HardwareContext, Result};
use serde::Deserialize;

use super::Settings;
use crate::scene::Team;

/// A `[[robot]]` of a scenario.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct PlayerSettings {
    /// Whose it is: `own` are those of `game.team`, in blue; `opponent` those of `game.opponent`, in red.
    pub team: Team,
    /// Number of its shirt.
    pub number: u8,
    /// Where it starts in the field frame: x and y in m, heading in rad. Blue plays towards positive x.
    pub pose: [f64; 3],
}

impl Settings {
    /// The choices of a run.
    ///
    /// # Errors
    /// Names the key or option.
    pub(crate) fn of(context: &HardwareContext) -> Result<Self> {
        let mut settings: Self = context.parameters()?;
        settings.apply(&context.options)?;
        settings.take_part();
        settings.game.mate = settings.network.mate.then(|| settings.game.mate_number());
        // Lockstep is there to be repeated, beside others of its kind, too: nobody but this robot's world speaks to it,
        // unless its scenario opens it to a network.
        if context.clock.is_stepped() && settings.network.address.is_loopback() {
            settings.network.free_ports();
        }
        settings.check()?;
        Ok(settings)
    }

    /// One of several has a place of its own; none can have the ports of a real field, and real mates stand for the one
    /// that only speaks.
    fn take_part(&mut self) {
        let Some(player) = self.robot else { return };
        self.robot_pose = player.pose;
        self.game.player_number = player.number;
        self.game.is_opponent = player.team == Team::Opponent;
        self.network.free_ports();
        self.network.mate = false;
    }

    /// Whose the robot is.
    pub(crate) fn side(&self) -> Team {
        self.robot.map_or(Team::Own, |player| player.team)
    }

    /// The number of the robot's team.
    pub(crate) fn team(&self) -> u8 {
        self.game.team_of(self.side())
    }

    /// Gives the body and the head of a further robot serial numbers of their own.
    pub(crate) fn number_body(&mut self, place: usize) {
        let number = place + 1;
        self.body_id = format!("SIMULATED-BODY-{number:05}");
        self.head_id = format!("SIMULATED-HEAD-{number:05}");
    }

    /// What the robot's program has to know of this.
    pub(crate) fn player_parameters(&self) -> Vec<(String, String)> {
        let parameters = self.robot.map(|player| {
            [
                ("player.number".to_owned(), player.number.to_string()),
                ("player.team".to_owned(), self.team().to_string()),
            ]
        });
        parameters.into_iter().flatten().collect()
    }
}
