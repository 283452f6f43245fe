//! What can be chosen about the simulation, and where the choices come from.
//!
//! First the parameters' `[hardware.simulated]`, then the options after `--`: [`OPTIONS`] says what each does.

mod buttons;
mod game;
mod imperfections;
mod network;
mod options;
mod play;
mod player;

use std::path::PathBuf;
use std::str::FromStr;

use framework::{Error, Result};
use serde::Deserialize;
use types::identifier::{IDENTIFIER_LENGTH, Identifier};
use types::sensor_data::RobotConfiguration;

pub use self::buttons::{Button, Press};
pub(crate) use self::game::PLAYERS_PER_TEAM;
pub use self::game::{Announcement, GameSettings};
pub use self::imperfections::{Imperfections, SensorErrors};
pub use self::network::NetworkSettings;
pub use self::options::OPTIONS;
pub use self::play::PlaySettings;
pub use self::player::PlayerSettings;
use crate::scene::{self, ImageSettings, RobotSettings};
pub use crate::sound::SoundSettings;

/// Images a second of a NAO's camera.
pub const CAMERA_RATE: u32 = 30;

/// The choices; every key may be left out.
#[derive(Clone, Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Where LoLA is served; left out: in a fresh temporary folder.
    pub socket: Option<PathBuf>,
    /// What moves robots and ball.
    pub physics: PhysicsChoice,
    /// What is wrong with the robot's body.
    pub imperfections: Imperfections,
    /// Who the robot is among several of a scenario: its `[[robot]]`.
    pub robot: Option<PlayerSettings>,
    /// Where the robot starts in the field frame: x and y in m, heading in rad.
    pub robot_pose: [f64; 3],
    /// The ball.
    pub ball: BallSettings,
    /// Friction of everything on the carpet, as a share of what each thing usually has there.
    pub carpet_friction: f64,
    /// The other robots.
    pub robots: Vec<RobotSettings>,
    /// How the cameras take it all.
    pub images: ImageSettings,
    /// Serial number of the body, 20 characters.
    pub body_id: String,
    /// Serial number of the head, 20 characters.
    pub head_id: String,
    /// Ports, and who is on the network.
    pub network: NetworkSettings,
    /// Who plays, and how the game goes.
    pub game: GameSettings,
    /// When somebody presses a button.
    pub buttons: Vec<Press>,
    /// What there is to be heard.
    pub sound: SoundSettings,
    /// Whether the cameras give images.
    pub cameras: bool,
    /// How many images each of them gives in a second: 30 as a NAO's, or a divisor of that.
    pub camera_rate: u32,
    /// Whether the microphones give sound.
    pub microphones: bool,
}

/// What moves robots and ball.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum PhysicsChoice {
    /// Masses, torques and contacts: robots fall, balls roll.
    #[default]
    Dynamic,
    /// Joints turn as they are told and robots never fall: the cheap choice.
    Kinematic,
}

impl FromStr for PhysicsChoice {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        match name {
            "dynamic" => Ok(Self::Dynamic),
            "kinematic" => Ok(Self::Kinematic),
            _ => Err(Error::new(format!(
                "no physics is called `{name}`; there are `dynamic` and `kinematic`"
            ))),
        }
    }
}

/// The ball of the world.
#[derive(Clone, Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BallSettings {
    /// Whether there is one.
    pub present: bool,
    /// Where it lies in the field frame, m.
    pub position: [f64; 2],
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            socket: None,
            physics: PhysicsChoice::default(),
            imperfections: Imperfections::default(),
            robot: None,
            robot_pose: [2.0, 0.0, 0.0],
            ball: BallSettings::default(),
            carpet_friction: 1.0,
            robots: Vec::new(),
            images: ImageSettings::default(),
            body_id: "SIMULATED-BODY-00001".to_owned(),
            head_id: "SIMULATED-HEAD-00001".to_owned(),
            network: NetworkSettings::default(),
            game: GameSettings::default(),
            buttons: Press::usual(),
            sound: SoundSettings::default(),
            cameras: true,
            camera_rate: CAMERA_RATE,
            microphones: true,
        }
    }
}

impl Default for BallSettings {
    fn default() -> Self {
        Self {
            present: true,
            position: [3.4, 0.4],
        }
    }
}

impl Settings {
    /// Refuses values that no robot has.
    ///
    /// # Errors
    /// Names the key.
    pub fn check(&self) -> Result<()> {
        for (key, id) in [("body_id", &self.body_id), ("head_id", &self.head_id)] {
            if id.len() != IDENTIFIER_LENGTH || !id.is_ascii() {
                return Err(Error::new(format!(
                    "hardware.simulated.{key}: a serial number has {IDENTIFIER_LENGTH} characters, \
                     `{id}` has not"
                )));
            }
        }
        let numbers = self.robot_pose.iter().chain(&self.ball.position);
        if let Some(number) = numbers.into_iter().find(|number| !number.is_finite()) {
            return Err(Error::new(format!(
                "hardware.simulated: {number} is no place on the field"
            )));
        }
        if self.camera_rate == 0 || !CAMERA_RATE.is_multiple_of(self.camera_rate) {
            return Err(Error::new(format!(
                "hardware.simulated.camera_rate: {CAMERA_RATE} images a second cannot be thinned to {}; take a divisor",
                self.camera_rate
            )));
        }
        let friction = self.carpet_friction;
        if !(friction > 0.0 && friction.is_finite()) {
            return Err(Error::new(format!(
                "hardware.simulated.carpet_friction: {friction} is no share of the usual friction"
            )));
        }
        self.imperfections.check()?;
        self.network.check()?;
        self.game.check()?;
        self.sound.check()?;
        scene::check(&self.robots, &self.images)?;
        self.buttons.iter().try_for_each(Press::check)
    }

    pub(crate) fn ball_position(&self) -> Option<[f64; 2]> {
        self.ball.present.then_some(self.ball.position)
    }

    pub(crate) fn configuration(&self) -> RobotConfiguration {
        let identifier = |text: &str| Identifier::from_str(text).unwrap_or_default();
        RobotConfiguration {
            body_id: identifier(&self.body_id),
            body_version: identifier("6.0.0"),
            head_id: identifier(&self.head_id),
            head_version: identifier("6.0.0"),
        }
    }
}

#[cfg(test)]
mod tests {
    use types::game::{GameState, KickingTeam, Penalty, SetPlay};

    use super::*;

    fn apply(options: &[&str]) -> Result<Settings> {
        let options: Vec<_> = options.iter().map(|&option| option.to_owned()).collect();
        let mut settings = Settings::default();
        settings.apply(&options)?;
        settings.check()?;
        Ok(settings)
    }

    #[test]
    fn options_change_the_settings() {
        let settings = apply(&[
            "--pose",
            "1,-2,0.5",
            "--ball",
            "0.5,1",
            "--socket",
            "/tmp/lola",
        ])
        .unwrap();
        assert_eq!(settings.robot_pose, [1.0, -2.0, 0.5]);
        assert_eq!(settings.ball_position(), Some([0.5, 1.0]));
        assert_eq!(settings.socket, Some(PathBuf::from("/tmp/lola")));
        assert_eq!(apply(&["--no-ball"]).unwrap().ball_position(), None);
    }

    #[test]
    fn a_wrong_option_is_named() {
        for (options, expected) in [
            (&["--bal", "1,2"][..], "`--bal`"),
            (&["--ball"], "`--ball` of the simulated NAO needs a value"),
            (&["--ball", "1"], "2 numbers"),
            (&["--pose", "1,2,north"], "`1,2,north`"),
            (
                &["--imperfect", "very"],
                "`--imperfect` needs a seed, a whole number, not `very`",
            ),
        ] {
            let message = apply(options).unwrap_err().to_string();
            assert!(message.contains(expected), "{message}");
        }
    }

    #[test]
    fn options_take_parts_of_the_world_away() {
        let settings = apply(&[
            "--no-referee",
            "--no-mate",
            "--no-buttons",
            "--no-cameras",
            "--no-sound",
        ])
        .unwrap();
        assert!(!settings.network.referee && !settings.network.mate);
        assert!(settings.buttons.is_empty());
        assert!(!settings.cameras && !settings.microphones);
    }

    #[test]
    fn one_state_can_be_held() {
        let settings = apply(&["--game", "Playing"]).unwrap();
        assert_eq!(
            settings.game.schedule,
            [Announcement::of(0.0, GameState::Playing)]
        );
        let message = apply(&["--game", "Play"]).unwrap_err().to_string();
        assert!(
            message.contains("option `--game`: unknown variant `Play`"),
            "{message}"
        );
        assert!(message.contains("`Playing`"), "{message}");
    }

    #[test]
    fn the_parameters_of_the_robot_fit_and_name_the_ports_of_a_real_field() {
        let text = include_str!("../../parameters/simulated/default.toml");
        let parameters: toml::Table = toml::from_str(text).unwrap();
        let table = parameters["hardware"]["simulated"].clone();
        let settings: Settings = table.try_into().unwrap();
        settings.check().unwrap();
        let network = &settings.network;
        assert_eq!((network.control_port, network.return_port), (3838, 3939));
        assert_eq!(network.team_port, 10_000 + u16::from(settings.game.team));
        // Without Ready, in which the robot would walk away from the ball, but the same game after it.
        let (schedule, usual) = (settings.game.schedule, GameSettings::default().schedule);
        assert_eq!(schedule.first(), usual.first());
        assert_eq!(schedule.last(), usual.last());
        assert_eq!(settings.buttons, Press::usual());
    }

    #[test]
    fn free_ports_replace_chosen_ones() {
        let mut settings: Settings = toml::from_str("[network]\ncontrol_port = 3838").unwrap();
        settings.apply(&["--free-ports".to_owned()]).unwrap();
        assert_eq!(settings.network.control_port, 0);
    }

    #[test]
    fn what_cannot_be_is_refused_with_its_key() {
        for (table, expected) in [
            (
                "[network]\nteam_port = 9\nmate_port = 9",
                "network.mate_port: 9 is `team_port` already",
            ),
            (
                "[game]\nteam = 3\nopponent = 3",
                "game.opponent: both teams have number 3",
            ),
            (
                "[imperfections.noise]\ngyroscope = [0, -1, 0]",
                "imperfections.noise.gyroscope: -1 is no deviation",
            ),
            (
                "[imperfections]\ncommand_delay = 84",
                "imperfections.command_delay: 84 cycles are more than 83",
            ),
            (
                "camera_rate = 20",
                "camera_rate: 30 images a second cannot be thinned to 20; take a divisor",
            ),
            ("camera_rate = 0", "camera_rate: 30 images"),
            (
                "carpet_friction = 0",
                "carpet_friction: 0 is no share of the usual friction",
            ),
            (
                "[game]\nplay = { halves = 3 }",
                "game.play.halves: a game has 1 or 2, not 3",
            ),
            ("[game]\nteam = 255", "game.team: no team has number 255"),
            (
                "[game]\nplayer_number = 21",
                "game.player_number: shirts have numbers from 1 to 20, not 21",
            ),
            (
                "[game]\ngoalkeepers = [0, 21]",
                "game.goalkeepers: shirts have numbers from 1 to 20, not 21",
            ),
            (
                "[game]\nschedule = [{ at = 3, state = 'Set' }, { at = 2, state = 'Playing' }]",
                "game.schedule: Playing at 2 s does not come after 3 s",
            ),
            (
                "[game]\nschedule = [{ at = nan, state = 'Set' }]",
                "game.schedule: Set at NaN s",
            ),
            (
                "buttons = [{ at = 1, button = 'chest', lasts = 0 }]",
                "buttons: nobody can press Chest",
            ),
        ] {
            let settings: Settings = toml::from_str(table).unwrap();
            let message = settings.check().unwrap_err().to_string();
            assert!(message.contains(expected), "{message}");
        }
    }

    #[test]
    fn announcements_say_more_than_the_state() {
        let table = "schedule = [{ at = 1, state = 'Ready', penalty = 'Manual', \
                     kicking_team = 'Opponent', set_play = 'PenaltyKick', score = [2, 1] }]";
        let game: GameSettings = toml::from_str(table).unwrap();
        let announcement = &game.schedule[0];
        assert_eq!(announcement.penalty, Penalty::Manual);
        assert_eq!(announcement.kicking_team, KickingTeam::Opponent);
        assert_eq!(announcement.set_play, SetPlay::PenaltyKick);
        assert_eq!(announcement.score, [2, 1]);
    }

    #[test]
    fn an_unknown_key_is_named() {
        let message = toml::from_str::<Settings>("bal = 1")
            .unwrap_err()
            .to_string();
        assert!(message.contains("unknown field `bal`"), "{message}");
    }

    #[test]
    fn a_serial_number_of_another_length_is_refused() {
        let settings = Settings {
            head_id: "short".to_owned(),
            ..Settings::default()
        };
        assert!(
            settings
                .check()
                .unwrap_err()
                .to_string()
                .contains("head_id")
        );
    }
}
