//! What stands after `--` on the command line.

use framework::{Error, Result};

use super::{BallSettings, Imperfections, Settings};

/// What each of them does, for `-- --help`.
pub const OPTIONS: &str = "\
--socket PATH          serves LoLA there instead of in a fresh folder
--physics NAME         dynamic (masses, torques and contacts) or kinematic (cheap; robots never fall)
--imperfect SEED       gives the body the play, the late commands and the noise of a real one
--pose X,Y,HEADING     puts the robot there (m, m, rad in the field frame)
--ball X,Y             puts the ball there (m)
--no-ball              takes the ball away
--game STATE           lets the referee's computer say one state for the whole run: Initial, Ready, Set, Playing, Finished, Standby
--no-referee           takes the referee's computer off the network
--no-mate              takes the team mate off the network
--free-ports           takes free UDP ports instead of those of [hardware.simulated.network]
--no-buttons           lets nobody press a button
--no-cameras           takes the cameras away: no cycle of Vision
--camera-rate NUMBER   takes so many images a second: 30, or a divisor
--no-sound             takes the microphones away: no cycle of Audio
";

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
                "--physics" => self.physics = value()?.parse()?,
                "--imperfect" => {
                    let seed = value()?;
                    let seed = seed.parse().map_err(|_| {
                        Error::new(format!(
                            "option `{option}` needs a seed, a whole number, not `{seed}`"
                        ))
                    })?;
                    self.imperfections = Imperfections::of_a_nao(seed);
                }
                "--pose" => self.robot_pose = numbers(option, value()?)?,
                "--ball" => {
                    self.ball = BallSettings {
                        present: true,
                        position: numbers(option, value()?)?,
                    };
                }
                "--no-ball" => self.ball.present = false,
                "--game" => self.game.hold(option, value()?)?,
                "--no-referee" => self.network.referee = false,
                "--no-mate" => self.network.mate = false,
                "--free-ports" => self.network.free_ports(),
                "--no-buttons" => self.buttons.clear(),
                "--no-cameras" => self.cameras = false,
                "--camera-rate" => {
                    let number = value()?;
                    self.camera_rate = number.parse().map_err(|_| {
                        Error::new(format!(
                            "option `{option}` needs a whole number, not `{number}`"
                        ))
                    })?;
                }
                "--no-sound" => self.microphones = false,
                _ => return Err(unknown(option)),
            }
        }
        Ok(())
    }
}

fn unknown(option: &str) -> Error {
    Error::new(format!(
        "unknown option `{option}` of the simulated NAO; it knows --socket PATH, --physics NAME, --imperfect SEED, --pose X,Y,HEADING, \
         --ball X,Y, --no-ball, --game STATE, --no-referee, --no-mate, --free-ports, --no-buttons, \
         --no-cameras, --camera-rate NUMBER, --no-sound"
    ))
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
    use super::{OPTIONS, Settings};

    #[test]
    fn every_option_that_is_told_is_known() {
        for line in OPTIONS.lines() {
            let option = line.split(' ').next().unwrap();
            let mut settings = Settings::default();
            // Whatever becomes of it without its value.
            if let Err(error) = settings.apply(&[option.to_owned()]) {
                let error = error.to_string();
                assert!(error.contains("needs a value"), "{error}");
            }
        }
        let unknown = Settings::default().apply(&["--fast".to_owned()]);
        let unknown = unknown.unwrap_err().to_string();
        let told = OPTIONS.lines().map(|line| line.split("  ").next().unwrap());
        for option in told {
            assert!(
                unknown.contains(option),
                "`{option}` is missing in: {unknown}"
            );
        }
    }
}
