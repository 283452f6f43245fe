//! What can be chosen about the simulation, and where the choices come from.
//!
//! First the parameters' `[hardware.simulated]`, then the options after `--`:
//!
//! | option | does |
//! |---|---|
//! | `--socket PATH` | serves LoLA there instead of in a fresh folder |
//! | `--pose X,Y,HEADING` | puts the robot there (m, m, rad) |
//! | `--ball X,Y` | puts the ball there (m) |
//! | `--no-ball` | takes the ball away |

use std::path::PathBuf;
use std::str::FromStr;

use framework::{Error, Result};
use serde::Deserialize;
use types::identifier::{IDENTIFIER_LENGTH, Identifier};
use types::sensor_data::RobotConfiguration;

/// The choices; every key may be left out.
#[derive(Clone, Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Where LoLA is served; left out: in a fresh temporary folder.
    pub socket: Option<PathBuf>,
    /// Where the robot starts in the field frame: x and y in m, heading in rad.
    pub robot_pose: [f64; 3],
    /// The ball.
    pub ball: BallSettings,
    /// Serial number of the body, 20 characters.
    pub body_id: String,
    /// Serial number of the head, 20 characters.
    pub head_id: String,
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
            robot_pose: [2.0, 0.0, 0.0],
            ball: BallSettings::default(),
            body_id: "SIMULATED-BODY-00001".to_owned(),
            head_id: "SIMULATED-HEAD-00001".to_owned(),
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
    /// Obeys the command line.
    ///
    /// # Errors
    /// Names the option that is unknown, lacks its value, or has one that cannot be read.
    pub fn apply(&mut self, options: &[String]) -> Result<()> {
        let mut options = options.iter();
        while let Some(option) = options.next() {
            let mut value = || {
                let missing = || {
                    Error::new(format!(
                        "option `{option}` of the simulated NAO needs a value"
                    ))
                };
                options.next().ok_or_else(missing)
            };
            match option.as_str() {
                "--socket" => self.socket = Some(value()?.into()),
                "--pose" => self.robot_pose = numbers(option, value()?)?,
                "--ball" => {
                    self.ball = BallSettings {
                        present: true,
                        position: numbers(option, value()?)?,
                    };
                }
                "--no-ball" => self.ball.present = false,
                _ => {
                    return Err(Error::new(format!(
                        "unknown option `{option}` of the simulated NAO; it knows --socket PATH, \
                         --pose X,Y,HEADING, --ball X,Y, --no-ball"
                    )));
                }
            }
        }
        Ok(())
    }

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
        Ok(())
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

/// `1.5,-2` as numbers.
fn numbers<const N: usize>(option: &str, text: &str) -> Result<[f64; N]> {
    let numbers: Option<Vec<f64>> = text
        .split(',')
        .map(|part| part.trim().parse().ok())
        .collect();
    numbers
        .and_then(|numbers| <[f64; N]>::try_from(numbers).ok())
        .ok_or_else(|| {
            Error::new(format!(
                "option `{option}` needs {N} numbers joined by commas, not `{text}`"
            ))
        })
}

#[cfg(test)]
mod tests {
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
        ] {
            let message = apply(options).unwrap_err().to_string();
            assert!(message.contains(expected), "{message}");
        }
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
