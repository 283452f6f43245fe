//! What can be chosen about the robot's hardware: the parameters' `[hardware.nao]`, then the options after `--`.
//!
//! | option | does |
//! |---|---|
//! | `--lola PATH` | speaks with the LoLA there |
//! | `--simulator PATH` | speaks with `nao_simulator --socket PATH`: LoLA, cameras and microphones there, the network of this machine alone, no loudspeakers |
//! | `--wav FILE` | plays a file to the microphones, in its own time |
//! | `--no-cameras` | takes the cameras away: no cycle of `Vision` |
//! | `--no-sound` | takes microphones and loudspeakers away |
//! | `--free-ports` | takes free UDP ports of this machine alone |

use std::net::Ipv4Addr;
use std::path::{Path, PathBuf};

use framework::{Error, HardwareContext, Result};
use serde::Deserialize;
use types::camera::CameraPosition;

/// The choices; every key may be left out.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Where LoLA listens.
    pub lola: PathBuf,
    /// The camera in the forehead.
    pub top: CameraSettings,
    /// The camera in the mouth.
    pub bottom: CameraSettings,
    /// The bus to the cameras' reset lines.
    pub reset_bus: PathBuf,
    /// What the microphones are.
    pub microphones: Microphones,
    /// What the loudspeakers are.
    pub speaker: Speaker,
    /// The library of ALSA: a name that the system looks up, or a path.
    pub alsa: PathBuf,
    /// Addresses and ports.
    pub network: NetworkSettings,
}

/// One camera.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct CameraSettings {
    /// Where its images come from.
    pub source: CameraSource,
    /// Whether its images stand on their head: the top camera is mounted so.
    pub is_flipped: bool,
    /// What its sensor is told.
    pub controls: Controls,
}

/// Where images come from.
#[derive(Clone, Debug, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum CameraSource {
    /// A device of the system: `/dev/video-top`.
    Device(PathBuf),
    /// The socket of another process (`links::senses`).
    Socket(PathBuf),
    /// There are none.
    Off,
}

/// Controls of V4L2, as the driver counts them; the values are in use on NAOs.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct Controls {
    /// Added to the luminance, -255 to 255.
    pub brightness: i32,
    /// 0 to 255.
    pub contrast: i32,
    /// 0 to 255.
    pub saturation: i32,
    /// Turns colours.
    pub hue: i32,
    /// 0 to 9.
    pub sharpness: i32,
    /// 0 to 1023.
    pub gain: i32,
    /// The colour of the light in K; left out: the camera finds it.
    pub white_balance_temperature: Option<i32>,
    /// How long it exposes, in the driver's unit (0 to 1048575); left out: the camera finds it.
    pub exposure: Option<i32>,
    /// Where it is sharp; 0 is far.
    pub focus: i32,
    /// How much the sixteen parts of the image, in rows from the upper left, count for its exposure: 0 to 15 each.
    pub exposure_weights: [u8; 16],
}

/// What the microphones are.
#[derive(Clone, Debug, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum Microphones {
    /// A device of ALSA with four channels.
    Device(String),
    /// The socket of another process (`links::senses`).
    Socket(PathBuf),
    /// A file, heard in its own time: 44.1 kHz, one to four channels, 16-bit integers or 32-bit floats.
    Wav(PathBuf),
    /// There are none.
    Off,
}

/// What the loudspeakers are.
#[derive(Clone, Debug, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum Speaker {
    /// A device of ALSA.
    Device(String),
    /// There are none.
    Off,
}

/// The robot's addresses and UDP ports; port 0 takes a free one.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct NetworkSettings {
    /// Where it listens; 0.0.0.0: everywhere, 127.0.0.1: on this machine alone. A socket of another address would hear nothing
    /// that is sent to everybody, as referee and team do.
    pub address: Ipv4Addr,
    /// Where it hears the referee's computer: 3838.
    pub control_port: u16,
    /// Where the referee's computer hears answers: 3939.
    pub return_port: u16,
    /// Where it hears its team, and tells it; left out: 10000 and the team's number.
    pub team_port: Option<u16>,
    /// Whom the team is told through: the broadcast address of the field's network.
    pub broadcast: Ipv4Addr,
}

impl Default for Settings {
    fn default() -> Self {
        // The upper half of the top image is not the field (weights in use on NAOs).
        let weights = [0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 5, 5, 1];
        let mut top = CameraSettings {
            source: CameraSource::Device("/dev/video-top".into()),
            is_flipped: true,
            ..CameraSettings::default()
        };
        top.controls.exposure_weights = weights;
        Self {
            lola: lola::SOCKET.into(),
            top,
            bottom: CameraSettings::default(),
            reset_bus: "/dev/i2c-head".into(),
            microphones: Microphones::Device("default".to_owned()),
            speaker: Speaker::Device("default".to_owned()),
            alsa: "libasound.so.2".into(),
            network: NetworkSettings::default(),
        }
    }
}

impl Default for CameraSettings {
    fn default() -> Self {
        Self {
            source: CameraSource::Device("/dev/video-bottom".into()),
            is_flipped: false,
            controls: Controls::default(),
        }
    }
}

impl Default for Controls {
    fn default() -> Self {
        Self {
            brightness: 0,
            contrast: 32,
            saturation: 64,
            hue: 0,
            sharpness: 4,
            gain: 16,
            white_balance_temperature: None,
            exposure: None,
            focus: 0,
            exposure_weights: [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0],
        }
    }
}

impl Default for NetworkSettings {
    fn default() -> Self {
        Self {
            address: Ipv4Addr::UNSPECIFIED,
            control_port: 3838,
            return_port: 3939,
            team_port: None,
            broadcast: Ipv4Addr::BROADCAST,
        }
    }
}

impl Settings {
    /// The parameters, and then the command line.
    ///
    /// # Errors
    /// Names the key or the option that cannot be understood, or the address at which the robot would be deaf.
    pub fn of(context: &HardwareContext) -> Result<Self> {
        let mut settings: Self = context.parameters()?;
        settings.apply(&context.options)?;
        settings.network.check()?;
        Ok(settings)
    }

    /// Obeys the command line.
    ///
    /// # Errors
    /// Names the option that is unknown or lacks its value.
    pub fn apply(&mut self, options: &[String]) -> Result<()> {
        let mut options = options.iter();
        while let Some(option) = options.next() {
            let mut value = || {
                let missing = || Error::new(format!("option `{option}` of the NAO needs a value"));
                options.next().map(PathBuf::from).ok_or_else(missing)
            };
            match option.as_str() {
                "--lola" => self.lola = value()?,
                "--simulator" => self.take_simulator(&value()?),
                "--wav" => self.microphones = Microphones::Wav(value()?),
                "--no-cameras" => {
                    self.top.source = CameraSource::Off;
                    self.bottom.source = CameraSource::Off;
                }
                "--no-sound" => {
                    self.microphones = Microphones::Off;
                    self.speaker = Speaker::Off;
                }
                "--free-ports" => self.network.stay_here(),
                _ => {
                    return Err(Error::new(format!(
                        "unknown option `{option}` of the NAO; it knows --lola PATH, --simulator PATH, --wav FILE, \
                         --no-cameras, --no-sound, --free-ports"
                    )));
                }
            }
        }
        Ok(())
    }

    /// One camera.
    pub fn camera(&self, position: CameraPosition) -> &CameraSettings {
        match position {
            CameraPosition::Top => &self.top,
            CameraPosition::Bottom => &self.bottom,
        }
    }

    fn take_simulator(&mut self, lola: &Path) {
        let beside = |name: &str| {
            let mut path = lola.as_os_str().to_owned();
            path.push(name);
            PathBuf::from(path)
        };
        self.top.source = CameraSource::Socket(beside(".top"));
        self.bottom.source = CameraSource::Socket(beside(".bottom"));
        self.microphones = Microphones::Socket(beside(".microphones"));
        self.speaker = Speaker::Off;
        self.network.stay_here();
        self.lola = lola.to_owned();
    }
}

impl NetworkSettings {
    /// Where they stand among the parameters.
    pub(crate) const TABLE: &'static str = "hardware.nao.network";

    /// Linux gives broadcasts to sockets of every address and of the one they go to, and says nothing about it.
    fn check(&self) -> Result<()> {
        let address = self.address;
        if address.is_unspecified() || address.is_loopback() || address == self.broadcast {
            return Ok(());
        }
        let (table, broadcast) = (Self::TABLE, self.broadcast);
        Err(Error::new(format!(
            "a socket at {address} ({table}.address) hears nothing that is sent to {broadcast} ({table}.broadcast), neither referee \
             nor team; write \"0.0.0.0\", and choose its network by {table}.broadcast"
        )))
    }

    /// Free ports, and nobody beyond this machine.
    fn stay_here(&mut self) {
        *self = Self {
            address: Ipv4Addr::LOCALHOST,
            control_port: 0,
            return_port: 0,
            team_port: Some(0),
            broadcast: Ipv4Addr::LOCALHOST,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apply(options: &[&str]) -> Result<Settings> {
        let options: Vec<_> = options.iter().map(|&option| option.to_owned()).collect();
        let mut settings = Settings::default();
        settings.apply(&options)?;
        Ok(settings)
    }

    #[test]
    fn a_simulator_takes_the_place_of_everything_that_a_robot_has() {
        let settings = apply(&["--simulator", "/tmp/sim"]).unwrap();
        assert_eq!(settings.lola, Path::new("/tmp/sim"));
        let CameraSource::Socket(path) = &settings.top.source else {
            panic!("{settings:?}");
        };
        assert_eq!(path, Path::new("/tmp/sim.top"));
        assert_eq!(settings.speaker, Speaker::Off);
        assert_eq!(settings.network.address, Ipv4Addr::LOCALHOST);
    }

    #[test]
    fn options_that_are_no_options_are_named() {
        let message = |options| apply(options).unwrap_err().to_string();
        assert!(message(&["--fast"]).contains("`--fast`"));
        assert!(message(&["--lola"]).contains("`--lola` of the NAO needs a value"));
    }

    #[test]
    fn the_parameters_of_the_robot_fit() {
        let text = include_str!("../../parameters/nao/default.toml");
        let parameters: toml::Table = toml::from_str(text).unwrap();
        let table = parameters["hardware"]["nao"].clone();
        let settings: Settings = table.try_into().unwrap();
        assert_eq!(
            settings.network.team_port, None,
            "as the team's number says"
        );
        assert_eq!(settings.lola, Path::new("/tmp/robocup"));
    }

    #[test]
    fn an_address_that_no_broadcast_reaches_is_refused() {
        let of = |address: &str, options: &[&str]| {
            let broadcast = "10.0.255.255";
            let table =
                format!("network = {{ address = \"{address}\", broadcast = \"{broadcast}\" }}");
            Settings::of(&HardwareContext {
                options: options.iter().map(|&option| option.to_owned()).collect(),
                table: toml::from_str(&table).unwrap(),
                run_folder: PathBuf::new(),
                clock: framework::Clock::wall(),
                stop: framework::Stop::new(),
            })
        };
        for address in ["10.0.24.22", "10.1.255.255"] {
            let message = of(address, &[]).unwrap_err().to_string();
            assert!(message.contains(address), "{message}");
            assert!(
                message.contains("hardware.nao.network.address"),
                "{message}"
            );
        }
        of("0.0.0.0", &[]).unwrap();
        of("127.0.0.1", &[]).unwrap();
        of("10.0.255.255", &[]).unwrap();
        of("10.0.24.22", &["--free-ports"]).unwrap();
    }

    #[test]
    fn an_unknown_key_is_named() {
        let error = toml::from_str::<Settings>("[top]\ncontrol = 1").unwrap_err();
        assert!(
            error.to_string().contains("unknown field `control`"),
            "{error}"
        );
    }
}
