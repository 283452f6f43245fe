//! The NAO as the framework's hardware: body, identities, safe state.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use framework::{Clock, Error, HardwareContext, Result, Stop, Timestamp};
use hardware::{ActuatorInterface, SensorInterface};
use lola::Client;
use types::leds::Leds;
use types::motor_commands::MotorCommands;
use types::sensor_data::SensorData;

use crate::body::Body;
use crate::cameras::Cameras;
use crate::network::Network;
use crate::settings::Settings;
use crate::sound::{Microphones, Speaker};
use crate::supervisor::Supervisor;

/// A NAO V6.
pub struct Hardware {
    // Before the rest: it lets the robot down when it goes.
    body: Body,
    client: Arc<Client>,
    pub(crate) cameras: Cameras,
    pub(crate) microphones: Microphones,
    pub(crate) speaker: Speaker,
    pub(crate) network: Network,
    supervisor: Supervisor,
    identities: Vec<(String, String)>,
    /// The chest button, in the newest state.
    is_chest_down: AtomicBool,
    pub(crate) clock: Clock,
    pub(crate) stop: Stop,
}

impl framework::Hardware for Hardware {
    /// Waits for LoLA, which needs tens of seconds after the robot was switched on.
    fn new(context: HardwareContext) -> Result<Self> {
        let HardwareContext { clock, stop, .. } = &context;
        if clock.is_stepped() {
            return Err(Error::new(
                "a NAO has its own time, which no lockstep can turn: use the target `simulated`",
            ));
        }
        let settings = Settings::of(&context)?;
        let supervisor = Supervisor::of_environment();
        let network = Network::new(settings.network)?;
        let client = Client::connect(&settings.lola, clock.clone(), stop.clone());
        let client = Arc::new(client);
        let first = wait_for_lola(&client, &settings, &supervisor)?;
        let identifiers = first.configuration;
        let sound = crate::sound::open(&settings, clock, stop)?;
        let body = Body::new(Arc::clone(&client), clock.clone())?;
        supervisor.is_ready();
        supervisor.status("running");
        Ok(Self {
            body,
            client,
            cameras: Cameras::new(&settings, clock, stop),
            microphones: sound.0,
            speaker: sound.1,
            network,
            supervisor,
            identities: vec![
                ("body".to_owned(), identifiers.body_id.to_string()),
                ("head".to_owned(), identifiers.head_id.to_string()),
            ],
            is_chest_down: AtomicBool::new(first.touch.chest_button),
            clock: clock.clone(),
            stop: stop.clone(),
        })
    }

    fn check_parameters(context: &HardwareContext) -> Result<()> {
        Settings::of(context).map(drop)
    }

    fn identities(&self) -> Vec<(String, String)> {
        self.identities.clone()
    }

    fn stop(&self) {
        self.supervisor.is_stopping();
        self.stop.request();
    }

    fn enter_safe_state(&self) {
        self.supervisor.status("in safe state");
        self.body.enter_safe_state();
    }

    fn rearm(&self) {
        self.supervisor.status("running");
        self.body.rearm();
    }

    fn is_rearm_wanted(&self) -> bool {
        // Relaxed: nothing else depends on it.
        let is_down = self.is_chest_down.load(Ordering::Relaxed);
        self.body.is_rearm_wanted(is_down)
    }
}

impl SensorInterface for Hardware {
    fn read_sensors(&self) -> Result<(Timestamp, SensorData)> {
        self.supervisor.lives();
        let (at, mut sensors) = self.client.read_state()?;
        sensors.is_in_safe_state = self.body.tell();
        let is_down = sensors.touch.chest_button;
        self.is_chest_down.store(is_down, Ordering::Relaxed);
        Ok((at, sensors))
    }
}

impl ActuatorInterface for Hardware {
    fn write_command(&self, motors: &MotorCommands, leds: &Leds) -> Result<()> {
        if self.body.permits(motors) {
            self.client.write_command(motors, leds)?;
        }
        Ok(())
    }
}

/// The first state, which says who this robot is.
fn wait_for_lola(
    client: &Client,
    settings: &Settings,
    supervisor: &Supervisor,
) -> Result<SensorData> {
    let mut has_told = false;
    loop {
        match client.read_state() {
            Ok((_, sensors)) => return Ok(sensors),
            Err(error) if error.is_no_event() => {
                if !std::mem::replace(&mut has_told, true) {
                    eprintln!("waiting for LoLA at {}: {error}", settings.lola.display());
                    supervisor.status("waiting for LoLA");
                }
            }
            Err(error) => return Err(error),
        }
    }
}
