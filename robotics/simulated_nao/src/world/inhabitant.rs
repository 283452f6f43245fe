//! What belongs to one robot of the world beside its body: its motors, its sensors, what it sees of the others.

use std::sync::Arc;

use framework::Timestamp;
use types::joints::Joints;
use types::motor_commands::MotorCommands;
use types::sensor_data::{RobotConfiguration, SensorData, Sonar};

use super::contacts::Contacts;
use super::imperfections::Imperfections;
use super::inertial::InertialUnit;
use super::motor_boards::MotorBoards;
use super::power::{self, Power};
use super::progress::Progress;
use super::stillness::Stillness;
use super::way::Way;
use super::{sensors, touch};
use crate::physics::Body;
use crate::posture;
use crate::scene::{ImageSettings, Robot, Team};
use crate::settings::{Press, Settings};

/// One robot's.
pub(super) struct Inhabitant {
    pub(super) way: Way,
    pub(super) progress: Progress,
    pub(super) stillness: Stillness,
    pub(super) contacts: Contacts,
    pub(super) inertial: InertialUnit,
    imperfections: Imperfections,
    pub(super) motors: MotorBoards,
    pub(super) power: Power,
    pub(super) presses: Vec<Press>,
    configuration: RobotConfiguration,
    pub(super) images: ImageSettings,
    pub(super) team: Team,
    pub(super) number: u8,
    /// Everybody else, where they are now.
    pub(super) others: Arc<[Robot]>,
}

impl Inhabitant {
    pub(super) fn new(settings: &Settings, body: &Body, others: Arc<[Robot]>) -> Self {
        Self {
            way: Way::new(body),
            progress: Progress::default(),
            stillness: Stillness::default(),
            contacts: Contacts::default(),
            inertial: InertialUnit::default(),
            imperfections: Imperfections::new(&settings.imperfections),
            motors: MotorBoards::new(&posture::sitting()),
            power: Power::new(),
            presses: settings.buttons.clone(),
            configuration: settings.configuration(),
            images: settings.images,
            team: settings.side(),
            number: settings.game.player_number,
            others,
        }
    }

    /// Where its motors push its joints at a time.
    pub(super) fn push(&self, body: &Body, time: Timestamp) -> MotorCommands {
        let mut commands = self.motors.at(time);
        self.imperfections.push(&mut commands, &body.joints);
        commands
    }

    /// Tells its motors what to do from now on.
    pub(super) fn command(
        &mut self,
        commands: MotorCommands,
        joints: &Joints<f64>,
        now: Timestamp,
    ) {
        if let Some(commands) = self.imperfections.delay(commands) {
            self.motors.command(commands, joints, now);
        }
    }

    /// Reads all its sensors.
    pub(super) fn sample(&mut self, body: &Body, sonar: Sonar, now: Timestamp) -> SensorData {
        let inertial = self.inertial.take(body);
        let commands = self.motors.commands();
        let stiffnesses = commands.stiffnesses;
        let mut sensors = SensorData {
            currents: power::currents(&body.joints, commands),
            temperatures: self.power.temperatures(),
            status: self.power.status(),
            touch: touch::touch(&self.presses, now),
            sonar,
            battery: self.power.battery(&stiffnesses),
            ..sensors::sample(body, inertial, stiffnesses, self.configuration)
        };
        self.imperfections.spoil(&mut sensors);
        sensors
    }

    /// How the others see it.
    pub(super) fn figure(&self, body: &Body) -> Robot {
        Robot::posed(self.team, self.number, &body.joints, &body.torso_to_field)
    }
}
