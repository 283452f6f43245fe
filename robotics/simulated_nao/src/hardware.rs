//! The simulated NAO as the framework's hardware, for both drivers.
//!
//! With a wall clock a thread of its own turns the world. With a stepped clock
//! `next_event` does, and nothing waits. Either way sensors and commands travel
//! through LoLA's socket with the client that the real robot uses, and messages through UDP sockets.

mod network;
mod scenario;
mod sound;
mod truth;

use std::net::SocketAddr;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use framework::{
    Clock, Error, Event, HardwareContext, Leased, NoEvent, Pool, Result, Stop, Timestamp, blocking,
};
use hardware::{ActuatorInterface, CameraInterface, MOST_BLOCKS, MOST_IMAGES, SensorInterface};
use links::sockets::RobotSockets;
use lola::{Client, Safety};
use types::audio::AudioBlock;
use types::camera::CameraPosition;
use types::image::YuyvImage;
use types::leds::Leds;
use types::motor_commands::MotorCommands;
use types::sensor_data::SensorData;

use crate::camera::{self, Exposure};
use crate::field::Field;
use crate::per_camera::PerCamera;
use crate::photograph::{self, Photograph};
use crate::settings::{OPTIONS, Settings};
use crate::simulator::{Shared, Simulator};
use crate::stage::Stage;

/// How long a reader waits before it looks whether the robot stops.
const PATIENCE: Duration = Duration::from_millis(50);

/// The simulated NAO.
pub struct Hardware {
    // Before the rest, so that its thread has ended when that goes.
    thread: Option<Simulator>,
    shared: Arc<Shared>,
    client: Arc<Client>,
    safety: Arc<Mutex<Safety>>,
    identities: Vec<(String, String)>,
    /// Parameters that follow from who it is in a scenario.
    player: Vec<(String, String)>,
    field: Arc<Field>,
    images: PerCamera<Mutex<Pool<YuyvImage>>>,
    blocks: Mutex<Pool<AudioBlock>>,
    /// In place of what the cameras would see; nothing else happens then.
    photograph: Option<Photograph>,
    sockets: Arc<RobotSockets>,
    /// Where the referee's computer hears answers; 0 where there is none.
    return_port: u16,
    mate: Option<SocketAddr>,
    clock: Clock,
    stop: Stop,
}

impl framework::Hardware for Hardware {
    fn new(context: HardwareContext) -> Result<Self> {
        let settings = Settings::of(&context)?;
        let stage = Arc::new(Stage::new(&settings));
        Self::on(stage, 0, &settings, context)
    }

    fn check_parameters(context: &HardwareContext) -> Result<()> {
        Settings::of(context).map(drop)
    }

    fn join(&self, context: HardwareContext) -> Result<Self> {
        if !context.clock.is_stepped() {
            return Err(Error::new("robots can only share a world in lockstep"));
        }
        let mut settings = Settings::of(&context)?;
        let stage = Arc::clone(&self.shared.stage);
        let place = {
            let mut scene = stage.lock();
            settings.number_body(scene.world.robot_count());
            scene.join(&settings)?
        };
        Self::on(stage, place, &settings, context)
    }

    fn settings(&self) -> Vec<(String, String)> {
        self.player.clone()
    }

    fn advance(&self) -> Result<Timestamp> {
        self.shared.stage.lock().advance()
    }

    fn identities(&self) -> Vec<(String, String)> {
        self.identities.clone()
    }

    fn stop(&self) {
        self.stop.request();
        self.shared.stepped.notify_all();
    }

    fn enter_safe_state(&self) {
        lock(&self.safety).enter();
    }

    fn rearm(&self) {
        lock(&self.safety).rearm();
    }

    fn is_rearm_wanted(&self) -> bool {
        let (is_down, now) = {
            let simulation = self.shared.lock();
            let world = &simulation.scene().world;
            (world.touch(simulation.robot()).chest_button, world.now())
        };
        lock(&self.safety).is_rearm_wanted(is_down, now)
    }

    fn is_simulated(&self) -> bool {
        true
    }

    fn truth(&self) -> serde_json::Value {
        scenario::truth(&self.ground_truth())
    }

    fn disturb(&self, deed: &toml::Table) -> Result<()> {
        scenario::Deed::read(deed)?.happen(&mut self.shared.lock())
    }

    fn next_event(&self) -> Result<Option<Event>> {
        if self.thread.is_some() {
            return Err(Error::new(
                "with a wall clock the simulated NAO turns itself",
            ));
        }
        if let Some(photograph) = &self.photograph {
            return Ok(photograph.event());
        }
        let mut simulation = self.shared.lock();
        // Whoever has missed an event reads again at once.
        if let Some(instance) = simulation.is_behind.pop_first() {
            let at = self.clock.now();
            return Ok(Some(Event { at, instance }));
        }
        while simulation.can_step() {
            if simulation.next_is_tick() {
                let_down(
                    &mut lock(&self.safety),
                    &self.client,
                    simulation.next_time(),
                );
            }
            if let Some(event) = simulation.step()? {
                return Ok(Some(event));
            }
        }
        Ok(None)
    }

    fn options() -> &'static str {
        OPTIONS
    }

    fn tools() -> &'static [&'static str] {
        &[photograph::TOOL]
    }

    fn tool(
        _name: &str,
        context: HardwareContext,
        bench: &mut dyn framework::tool::Bench<Self>,
        output: &mut dyn std::io::Write,
    ) -> Result<()> {
        photograph::look(&context, bench, output)
    }
}

impl Hardware {
    /// A robot that sees a photograph and nothing else.
    pub(crate) fn of_photograph(photograph: Photograph, context: HardwareContext) -> Result<Self> {
        let mut settings = Settings::of(&context)?;
        let alone = [
            "--physics",
            "kinematic",
            "--no-referee",
            "--no-mate",
            "--free-ports",
        ];
        settings.apply(&alone.map(str::to_owned))?;
        let mut hardware = Self::on(Arc::new(Stage::new(&settings)), 0, &settings, context)?;
        hardware.photograph = Some(photograph);
        Ok(hardware)
    }

    /// The robot with that place in a world.
    fn on(
        stage: Arc<Stage>,
        place: usize,
        settings: &Settings,
        context: HardwareContext,
    ) -> Result<Self> {
        let clock = context.clock;
        let sockets = Arc::new(RobotSockets::new(&settings.network.ports())?);
        let is_stepped = clock.is_stepped();
        let shared = Shared::on(
            stage,
            place,
            settings,
            Some(Arc::clone(&sockets)),
            is_stepped,
        )?;
        let shared = Arc::new(shared);
        let client = Arc::new(Client::connect(
            shared.socket(),
            clock.clone(),
            context.stop.clone(),
        ));
        let safety = Arc::new(Mutex::new(Safety::default()));
        let first = connect(&shared, &client)?;
        let thread = if clock.is_stepped() {
            None
        } else {
            shared.lock().skip_to(clock.now());
            let (client, safety) = (Arc::clone(&client), Arc::clone(&safety));
            let let_down = move |now| let_down(&mut lock(&safety), &client, now);
            Some(Simulator::run(
                Arc::clone(&shared),
                clock.clone(),
                let_down,
            )?)
        };
        let configuration = first.configuration;
        let (field, return_port, mate) = {
            let simulation = shared.lock();
            let network = &simulation.network;
            let field = Arc::clone(&simulation.scene().world.field);
            (field, network.return_port()?, network.mate_address()?)
        };
        Ok(Self {
            thread,
            client,
            safety,
            identities: vec![
                ("body".to_owned(), configuration.body_id.to_string()),
                ("head".to_owned(), configuration.head_id.to_string()),
            ],
            player: settings.player_parameters(),
            field,
            images: PerCamera::each(|| Mutex::new(Pool::new(MOST_IMAGES, YuyvImage::default))),
            blocks: Mutex::new(Pool::new(MOST_BLOCKS, AudioBlock::default)),
            photograph: None,
            sockets,
            return_port,
            mate,
            shared,
            clock,
            stop: context.stop,
        })
    }
}

impl SensorInterface for Hardware {
    fn read_sensors(&self) -> Result<(Timestamp, SensorData)> {
        let (at, mut sensors) = self.newest_state()?;
        sensors.is_in_safe_state = lock(&self.safety).tell();
        Ok((at, sensors))
    }
}

impl ActuatorInterface for Hardware {
    fn write_command(&self, motors: &MotorCommands, leds: &Leds) -> Result<()> {
        if lock(&self.safety).permits(motors) {
            self.client.write_command(motors, leds)?;
        }
        Ok(())
    }
}

impl Hardware {
    fn newest_state(&self) -> Result<(Timestamp, SensorData)> {
        if let Some(simulator) = &self.thread {
            if !simulator.is_running() {
                return Err(Error::new(
                    "the world of the simulated NAO has ended, and nothing comes any more",
                ));
            }
            return self.client.read_state();
        }
        self.stop.check()?;
        let states = self.shared.lock().take_states(self.clock.now());
        // The newest counts, as with images: older ones belong to cycles that were missed.
        let mut newest = Err(NoEvent("LoLA has sent no state since the last".to_owned()).into());
        for _ in 0..states {
            newest = self.client.read_state();
        }
        newest
    }
}

impl CameraInterface for Hardware {
    fn read_image(&self, position: CameraPosition) -> Result<(Timestamp, Leased<YuyvImage>)> {
        if let Some(photograph) = &self.photograph {
            return photograph.read(position);
        }
        // Drawing stands for the camera's own work, so it counts as waiting for the hardware.
        blocking(|| {
            let exposure = self.next_exposure(position)?;
            let mut images = lock(self.images.of(position));
            let mut image = images.free()?;
            camera::render(&exposure, &self.field, &mut image);
            self.clock.wait_until(exposure.ready_at, &self.stop)?;
            let garble = std::mem::take(self.shared.lock().garble_image.of_mut(position));
            if garble {
                let half = image.data.len() / 2;
                image.data.truncate(half);
            }
            if image.is_complete() {
                Ok((exposure.captured_at, image.lease()))
            } else {
                Err(NoEvent(format!("the image of camera {position:?} is garbled")).into())
            }
        })
    }
}

impl Hardware {
    fn next_exposure(&self, position: CameraPosition) -> Result<Exposure> {
        let mut simulation = self.shared.lock();
        if self.thread.is_none() {
            self.stop.check()?;
            let missing = || NoEvent(format!("camera {position:?} has no new image")).into();
            return simulation
                .take_ready_image(position, self.clock.now())
                .ok_or_else(missing);
        }
        loop {
            self.stop.check()?;
            if let Some(exposure) = simulation.take_image(position, self.clock.now()) {
                return Ok(exposure);
            }
            let waited = self.shared.stepped.wait_timeout(simulation, PATIENCE);
            simulation = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

impl Drop for Hardware {
    /// Lets the robot down to the end before the world goes.
    fn drop(&mut self) {
        let never = Stop::new();
        let turns = || self.thread.as_ref().is_some_and(Simulator::is_running);
        while turns() && lock(&self.safety).is_fading(self.clock.now()) {
            if never.wait(crate::simulation::TICK).is_err() {
                break;
            }
        }
    }
}

/// Connects the client and reads what kind of robot this is; the world stands still meanwhile.
fn connect(shared: &Shared, client: &Client) -> Result<SensorData> {
    std::thread::scope(|scope| {
        // The client connects when it reads, so somebody else has to serve.
        let serving = scope.spawn(|| shared.lock().greet());
        let read = client.read_state();
        let served = serving
            .join()
            .map_err(|_| Error::new("the simulated NAO does not start"))?;
        served.and(read.map(|(_, sensors)| sensors))
    })
}

/// In safe state: sends what the hardware commands.
fn let_down(safety: &mut Safety, client: &Client, now: Timestamp) {
    if let Some(motors) = safety.command(now)
        && let Err(error) = client.write_command(&motors, &Leds::default())
    {
        eprintln!("the simulated NAO cannot let itself down: {error}");
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // No safety can be half done, and what is half drawn or half heard is not leased.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
