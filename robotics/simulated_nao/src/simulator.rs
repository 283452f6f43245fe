//! A simulation that several threads share, and the thread that turns it in real time.

use std::path::PathBuf;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use framework::{Clock, Error, Result, Stop, Timestamp};
use links::sockets::RobotSockets;
use tempfile::TempDir;

use crate::ground_truth::GroundTruth;
use crate::network::{Network, NetworkTruth};
use crate::pacing;
use crate::physics::Disturbance;
use crate::senses::Senses;
use crate::server::{Exchange, LolaServer};
use crate::settings::Settings;
use crate::simulation::Simulation;
use crate::sound::{Sound, SoundSettings};
use crate::stage::Stage;

/// Later than this the simulation leaves out what it has missed instead of catching up.
const GREATEST_DELAY: Duration = Duration::from_millis(60);

/// A simulation behind a lock.
pub(crate) struct Shared {
    /// The world, which others may be in.
    pub(crate) stage: Arc<Stage>,
    simulation: Mutex<Simulation>,
    pub(crate) sound: Sound,
    pub(crate) sound_settings: SoundSettings,
    /// Wakes who waits for the next exposure or block of sound.
    pub(crate) stepped: Condvar,
    /// The folder of the socket, if it is ours.
    _folder: Option<TempDir>,
}

impl Shared {
    /// Around the robot's sockets; without them others may listen at the chosen ports.
    pub(crate) fn new(
        settings: &Settings,
        robot: Option<Arc<RobotSockets>>,
        is_stepped: bool,
    ) -> Result<Self> {
        settings.check()?;
        let stage = Arc::new(Stage::new(settings));
        Self::on(stage, 0, settings, robot, is_stepped)
    }

    /// The robot with that place in a world.
    pub(crate) fn on(
        stage: Arc<Stage>,
        place: usize,
        settings: &Settings,
        robot: Option<Arc<RobotSockets>>,
        is_stepped: bool,
    ) -> Result<Self> {
        let network = Network::new(settings, robot, is_stepped)?;
        let (socket, folder) = match &settings.socket {
            Some(path) => (path.clone(), None),
            None => {
                let folder = tempfile::Builder::new()
                    .prefix("simulated_nao-")
                    .tempdir()?;
                (folder.path().join("lola"), Some(folder))
            }
        };
        let server = LolaServer::new(socket, *stage.lock().world.commands(place))?;
        let simulation = Simulation::new(settings, Arc::clone(&stage), place, network, server);
        Ok(Self {
            stage,
            simulation: Mutex::new(simulation),
            sound: Sound::new(&settings.sound),
            sound_settings: settings.sound.clone(),
            stepped: Condvar::new(),
            _folder: folder,
        })
    }

    pub(crate) fn lock(&self) -> MutexGuard<'_, Simulation> {
        // A step that panicked left the world before or after it; both are worlds.
        self.simulation
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    pub(crate) fn socket(&self) -> PathBuf {
        self.lock().server().path().to_owned()
    }
}

/// A thread that turns a simulation with the wall clock until it is dropped.
///
/// Serves LoLA to whatever client connects: [`crate::Hardware`] is one, other programs may be.
pub struct Simulator {
    // Before the rest, so that its threads have ended when that goes.
    senses: Option<Senses>,
    shared: Arc<Shared>,
    closing: Stop,
    thread: Option<JoinHandle<()>>,
}

impl Simulator {
    /// A world with its LoLA server; the clock must be a wall clock.
    ///
    /// The referee's computer and the team mate send to the chosen ports, if they are not 0.
    ///
    /// # Errors
    /// Names the setting that cannot be, or the socket that is in use.
    pub fn start(settings: &Settings, clock: Clock) -> Result<Self> {
        Self::run(Arc::new(Shared::new(settings, None, false)?), clock, |_| {})
    }

    /// As [`Simulator::start`], with cameras and microphones on sockets beside LoLA's (`src/senses.rs` says how), and
    /// with a report on stderr of who comes, goes, stalls or floods.
    ///
    /// # Errors
    /// As [`Simulator::start`].
    pub fn serve(settings: &Settings, clock: Clock) -> Result<Self> {
        let shared = Arc::new(Shared::new(settings, None, false)?);
        shared.lock().server_mut().report();
        let senses = Senses::serve(&shared, Some(&clock))?;
        let mut simulator = Self::run(shared, clock, |_| {})?;
        simulator.senses = Some(senses);
        Ok(simulator)
    }

    /// As [`Simulator::serve`], but the world turns as fast as the program answers, and stands still once so many states were
    /// answered.
    ///
    /// # Errors
    /// As [`Simulator::start`].
    pub fn paced(settings: &Settings, answers: u64) -> Result<Self> {
        let shared = Arc::new(Shared::new(settings, None, false)?);
        shared.lock().server_mut().report();
        let senses = Senses::serve(&shared, None)?;
        let closing = Stop::new();
        let thread = std::thread::Builder::new()
            .name("simulated_nao".to_owned())
            .spawn({
                let (shared, closing) = (Arc::clone(&shared), closing.clone());
                move || {
                    if let Err(error) = pacing::turn(&shared, &closing, answers) {
                        eprintln!("the simulated NAO stands still: {error}");
                    }
                }
            })?;
        Ok(Self {
            senses: Some(senses),
            shared,
            closing,
            thread: Some(thread),
        })
    }

    /// What went through LoLA's socket.
    pub fn exchange(&self) -> Exchange {
        self.shared.lock().server().exchange()
    }

    /// Whether the world still turns.
    pub fn is_running(&self) -> bool {
        self.thread
            .as_ref()
            .is_some_and(|thread| !thread.is_finished())
    }

    /// How often a program that had connected to LoLA was dropped because it did not read or flooded, for tests.
    pub fn dropped_clients(&self) -> u64 {
        self.shared.lock().server().dropped()
    }

    /// Where LoLA is served.
    pub fn socket(&self) -> PathBuf {
        self.shared.socket()
    }

    /// What is really the case, for tests.
    pub fn ground_truth(&self) -> GroundTruth {
        self.shared.lock().ground_truth()
    }

    /// Does to the world what no motor does, for tests and scenarios.
    pub fn disturb(&self, disturbance: &Disturbance) {
        self.shared.stage.lock().world.disturb(disturbance);
    }

    /// What the referee's computer and the team mate have said and heard, for tests.
    pub fn network_truth(&self) -> NetworkTruth {
        self.shared.lock().network.truth()
    }

    /// Calls `before_tick` ahead of every state that LoLA sends.
    pub(crate) fn run(
        shared: Arc<Shared>,
        clock: Clock,
        before_tick: impl FnMut(Timestamp) + Send + 'static,
    ) -> Result<Self> {
        if clock.is_stepped() {
            return Err(Error::new(
                "a simulator with its own thread needs a wall clock",
            ));
        }
        let closing = Stop::new();
        let thread = std::thread::Builder::new()
            .name("simulated_nao".to_owned())
            .spawn({
                let (shared, closing) = (Arc::clone(&shared), closing.clone());
                move || turn(&shared, &clock, &closing, before_tick)
            })?;
        Ok(Self {
            senses: None,
            shared,
            closing,
            thread: Some(thread),
        })
    }
}

impl Drop for Simulator {
    fn drop(&mut self) {
        self.senses = None;
        self.closing.request();
        if let Some(thread) = self.thread.take() {
            // A panic of the thread has been printed; the world simply stands still since.
            let _ = thread.join();
        }
    }
}

fn turn(shared: &Shared, clock: &Clock, closing: &Stop, mut before_tick: impl FnMut(Timestamp)) {
    loop {
        let due = shared.lock().next_time();
        if clock.wait_until(due, closing).is_err() {
            return;
        }
        let mut simulation = shared.lock();
        let now = clock.now();
        if now - simulation.next_time() > GREATEST_DELAY {
            simulation.skip_to(now);
            continue;
        }
        if simulation.next_is_tick() {
            before_tick(now);
        }
        if let Err(error) = simulation.step() {
            eprintln!("the simulated NAO cannot send its state: {error}");
            return;
        }
        drop(simulation);
        shared.stepped.notify_all();
    }
}
