//! The world together with what it offers: LoLA every 12 ms, images of both cameras at 30 Hz, blocks
//! of sound every 46 ms, and whatever comes over the network.
//!
//! Whoever owns it turns it step by step, in real time or as fast as lockstep goes.

use std::collections::{BTreeSet, VecDeque};
use std::sync::{Arc, MutexGuard};
use std::time::Duration;

use framework::{Error, Event, Result, Timestamp};
use types::audio::Tone;
use types::camera::CameraPosition;

use crate::camera::Exposure;
use crate::ground_truth::{BodyTruth, GroundTruth, ImageTruth};
use crate::network::{Network, Received};
use crate::per_camera::PerCamera;
use crate::scene::Team;
use crate::server::LolaServer;
use crate::settings::{CAMERA_RATE, Settings};
use crate::silence::Silence;
use crate::sound::{BLOCK_LENGTH, SAMPLE_RATE};
use crate::stage::{Broadcast, Scene, Stage};
use crate::world::{IMAGE_LATENCY, NO_ECHO};

/// LoLA's cycle.
pub(crate) const TICK: Duration = Duration::from_millis(12);
/// 30 images a second; slower cameras leave some of them out.
const IMAGE_PERIOD: Duration = Duration::from_nanos(33_333_333);
/// The first exposures; the cameras take turns.
const FIRST_EXPOSURE: PerCamera<Duration> = PerCamera {
    top: Duration::from_millis(5),
    bottom: Duration::from_nanos(21_666_667),
};
/// How long to wait for the first client.
const PATIENCE: Duration = Duration::from_millis(500);
/// How many ticks and images are remembered for comparisons with the truth.
const REMEMBERED: usize = 512;
/// How many blocks of sound wait for a reader before the oldest is lost.
const WAITING_BLOCKS: usize = 4;

/// What happens next.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
enum Step {
    Expose(CameraPosition),
    ImageReady(CameraPosition),
    RefereeSpeaks,
    MateSpeaks,
    DatagramArrives,
    BlockReady,
    Tick,
}

/// At equal times in this order: whoever reads at that time sees what was exposed, and instances
/// come as manifests name them, perception first.
const STEPS: [Step; 9] = [
    Step::Expose(CameraPosition::Top),
    Step::Expose(CameraPosition::Bottom),
    Step::ImageReady(CameraPosition::Top),
    Step::ImageReady(CameraPosition::Bottom),
    Step::RefereeSpeaks,
    Step::MateSpeaks,
    Step::DatagramArrives,
    Step::BlockReady,
    Step::Tick,
];

/// One robot's LoLA, cameras, microphones and network at one moment, in a world that may have others.
pub(crate) struct Simulation {
    stage: Arc<Stage>,
    /// Its place in the world.
    robot: usize,
    team: u8,
    side: Team,
    /// How many of the others' broadcasts are on their way.
    heard: usize,
    server: LolaServer,
    pub(crate) network: Network,
    has_cameras: bool,
    /// Between two images of a camera.
    image_period: Duration,
    has_microphones: bool,
    /// The time of the last step.
    now: Timestamp,
    state: Vec<u8>,
    ticks: u64,
    blocks: u64,
    /// Numbers of the blocks of sound that nobody has read, oldest first.
    waiting_blocks: VecDeque<u64>,
    exposures: PerCamera<u64>,
    images: PerCamera<u64>,
    /// Images that nobody has read, oldest first.
    waiting: PerCamera<VecDeque<Exposure>>,
    /// When the states that nobody has read were sent.
    unread: VecDeque<Timestamp>,
    bodies: VecDeque<BodyTruth>,
    /// What the images of the last exposures show, read or not.
    exposed: PerCamera<VecDeque<Exposure>>,
    tones: VecDeque<Received<Tone>>,
    /// Instances that have more to read than they had events, since their cycles took too long.
    pub(crate) is_behind: BTreeSet<&'static str>,
    pub(crate) garble_state: bool,
    pub(crate) garble_image: PerCamera<bool>,
    pub(crate) silence: Silence,
}

impl Simulation {
    pub(crate) fn new(
        settings: &Settings,
        stage: Arc<Stage>,
        robot: usize,
        network: Network,
        server: LolaServer,
    ) -> Self {
        Self {
            server,
            stage,
            robot,
            team: settings.team(),
            side: settings.side(),
            heard: 0,
            network,
            has_cameras: settings.cameras,
            image_period: IMAGE_PERIOD * (CAMERA_RATE / settings.camera_rate.max(1)),
            has_microphones: settings.microphones,
            now: Timestamp::ZERO,
            state: Vec::new(),
            ticks: 0,
            blocks: 0,
            waiting_blocks: VecDeque::new(),
            exposures: PerCamera::default(),
            images: PerCamera::default(),
            waiting: PerCamera::default(),
            unread: VecDeque::new(),
            bodies: VecDeque::new(),
            exposed: PerCamera::default(),
            tones: VecDeque::new(),
            is_behind: BTreeSet::new(),
            garble_state: false,
            garble_image: PerCamera::default(),
            silence: Silence::default(),
        }
    }

    /// The world and everybody in it.
    pub(crate) fn scene(&self) -> MutexGuard<'_, Scene> {
        self.stage.lock()
    }

    /// Its place in the world.
    pub(crate) fn robot(&self) -> usize {
        self.robot
    }

    /// Whether the world has come to the next step: with others in it, somebody else lets it go on.
    pub(crate) fn can_step(&mut self) -> bool {
        let scene = self.stage.lock();
        for broadcast in scene.aired(self.heard) {
            self.heard += 1;
            if broadcast.team == self.team && broadcast.robot != self.robot {
                self.network
                    .mate_has_broadcast(broadcast.at, &broadcast.bytes);
            }
        }
        let can = |time| scene.has_come_to(time);
        can(self.next_time())
    }

    /// Tells the others of its team something.
    pub(crate) fn broadcast(&mut self, at: Timestamp, bytes: &[u8]) {
        self.network.robot_has_broadcast(at, bytes);
        self.stage.lock().speak(Broadcast {
            at,
            robot: self.robot,
            team: self.team,
            side: self.side,
            bytes: bytes.to_vec(),
        });
    }

    /// The robot or the mate that only speaks has told the team something that the referee's computer hears.
    pub(crate) fn count_message(&self) {
        self.stage.lock().world.count_message(self.side);
    }

    pub(crate) fn server(&self) -> &LolaServer {
        &self.server
    }

    pub(crate) fn server_mut(&mut self) -> &mut LolaServer {
        &mut self.server
    }

    /// Waits for a client and sends it a state before time begins.
    ///
    /// # Errors
    /// Where nobody connects.
    pub(crate) fn greet(&mut self) -> Result<()> {
        let sensors = self.stage.lock().world.sample(self.robot);
        lola::state::encode(&sensors, &mut self.state).map_err(Error::from)?;
        self.server.wait_for_client(PATIENCE)?;
        self.server.send(&self.state);
        Ok(())
    }

    /// The time of the last step.
    pub(crate) fn now(&self) -> Timestamp {
        self.now
    }

    /// When the next step is due.
    pub(crate) fn next_time(&self) -> Timestamp {
        self.next().0
    }

    /// Whether the next step sends a state and obeys commands.
    pub(crate) fn next_is_tick(&self) -> bool {
        self.next().1 == Step::Tick
    }

    fn next(&self) -> (Timestamp, Step) {
        let due = STEPS.map(|step| (self.due(step), step));
        let first = |one: (Timestamp, Step), other: (Timestamp, Step)| {
            if other.0 < one.0 { other } else { one }
        };
        due.into_iter().fold((Timestamp::NEVER, Step::Tick), first)
    }

    fn due(&self, step: Step) -> Timestamp {
        let exposure = |camera, number| {
            Timestamp::ZERO + *FIRST_EXPOSURE.of(camera) + times(self.image_period, number)
        };
        match step {
            Step::Expose(_) | Step::ImageReady(_) if !self.has_cameras => Timestamp::NEVER,
            Step::Expose(camera) => exposure(camera, *self.exposures.of(camera)),
            Step::ImageReady(camera) => exposure(camera, *self.images.of(camera)) + IMAGE_LATENCY,
            Step::RefereeSpeaks => self.network.referee_due(),
            Step::MateSpeaks => self.network.mate_due(),
            // Somebody may have sent it between two steps.
            Step::DatagramArrives => self.network.flight_due().max(self.now),
            Step::BlockReady if !self.has_microphones => Timestamp::NEVER,
            Step::BlockReady => block_time(self.blocks),
            Step::Tick => Timestamp::ZERO + times(TICK, self.ticks + 1),
        }
    }

    /// Does the next step; the event it means for an instance.
    ///
    /// # Errors
    /// Where the state cannot be encoded.
    pub(crate) fn step(&mut self) -> Result<Option<Event>> {
        let (at, step) = self.next();
        self.now = at;
        let instance = match step {
            Step::Expose(camera) => {
                self.stage.lock().world.advance_to(at);
                self.expose(camera);
                None
            }
            Step::ImageReady(camera) => {
                *self.images.of_mut(camera) += 1;
                let name = match camera {
                    CameraPosition::Top => "VisionTop",
                    CameraPosition::Bottom => "VisionBottom",
                };
                let is_silent = self.silence.covers_image(camera, at);
                (!is_silent).then_some(name)
            }
            Step::RefereeSpeaks => {
                let (played, sent) = {
                    let world = &self.stage.lock().world;
                    (world.game_message(), world.messages())
                };
                let has_arrived = self.network.referee_speaks(at, played, sent)?;
                has_arrived.then_some("SplNetwork")
            }
            Step::MateSpeaks => {
                let truth = || {
                    let harmful = self.server.harmful();
                    GroundTruth::new(&self.stage.lock().world, self.robot, harmful)
                };
                let has_arrived = self.network.mate_speaks(at, truth)?;
                self.count_message();
                has_arrived.then_some("SplNetwork")
            }
            Step::DatagramArrives => self.network.datagram_arrives(at)?.then_some("SplNetwork"),
            Step::BlockReady => {
                self.record_block();
                Some("Audio")
            }
            Step::Tick => {
                self.stage.lock().world.advance_to(at);
                self.tick()?;
                (!self.silence.covers_tick(at)).then_some("Control")
            }
        };
        Ok(instance.map(|instance| Event { at, instance }))
    }

    /// Leaves out what should have happened while nobody turned the simulation.
    pub(crate) fn skip_to(&mut self, now: Timestamp) {
        let passed = now - Timestamp::ZERO;
        self.ticks = self.ticks.max(count(passed, TICK));
        self.stage.lock().world.skip_to(now);
        self.network.skip_to(now);
        while block_time(self.blocks) <= now {
            self.blocks += 1;
        }
        for camera in [CameraPosition::Top, CameraPosition::Bottom] {
            let exposed = count(
                passed.saturating_sub(*FIRST_EXPOSURE.of(camera)),
                self.image_period,
            );
            let images = self.images.of_mut(camera);
            *images = exposed.max(*images);
            let exposures = self.exposures.of_mut(camera);
            *exposures = exposed.max(*exposures);
        }
    }

    fn tick(&mut self) -> Result<()> {
        self.ticks += 1;
        let mut scene = self.stage.lock();
        let now = scene.world.now();
        self.network.collect(now);
        let mut sensors = scene.world.sample(self.robot);
        let commands = self.server.receive();
        if self.silence.covers_tick(self.now) {
            return Ok(());
        }
        scene.world.command(self.robot, commands);
        drop(scene);
        // A sonar that does not send hears nothing.
        let [left, right] = self.server.command().sonars;
        if !left {
            sensors.sonar.left = NO_ECHO;
        }
        if !right {
            sensors.sonar.right = NO_ECHO;
        }
        lola::state::encode(&sensors, &mut self.state).map_err(Error::from)?;
        if std::mem::take(&mut self.garble_state) {
            self.state.fill(0xc1);
        }
        if self.server.send(&self.state) {
            self.unread.push_back(now);
        } else {
            self.unread.clear();
        }
        remember(
            &mut self.bodies,
            BodyTruth {
                at: now,
                positions: sensors.positions,
                commands,
            },
        );
        // In real time nobody counts what the client has read.
        self.unread.truncate(REMEMBERED);
        Ok(())
    }

    fn expose(&mut self, camera: CameraPosition) {
        let number = self.exposures.of_mut(camera);
        if self.silence.covers_exposure(camera, self.now) {
            *number += 1;
            return;
        }
        let exposure = self.stage.lock().world.expose(self.robot, camera, *number);
        *number += 1;
        remember(self.exposed.of_mut(camera), exposure.clone());
        let waiting = self.waiting.of_mut(camera);
        waiting.push_back(exposure);
        // A camera has two buffers; the older image is lost.
        if waiting.len() > 2 {
            waiting.pop_front();
        }
    }

    /// The newest image that is ready at `now`, or else the one that will be ready next.
    pub(crate) fn take_image(
        &mut self,
        camera: CameraPosition,
        now: Timestamp,
    ) -> Option<Exposure> {
        let waiting = self.waiting.of_mut(camera);
        let ready = waiting
            .iter()
            .take_while(|exposure| exposure.ready_at <= now)
            .count();
        waiting.drain(..ready.saturating_sub(1));
        waiting.pop_front()
    }

    /// The newest image, if it is ready at `now`.
    pub(crate) fn take_ready_image(
        &mut self,
        camera: CameraPosition,
        now: Timestamp,
    ) -> Option<Exposure> {
        let is_ready = self
            .waiting
            .of(camera)
            .front()
            .is_some_and(|first| first.ready_at <= now);
        is_ready.then(|| self.take_image(camera, now)).flatten()
    }

    fn record_block(&mut self) {
        if self.waiting_blocks.len() == WAITING_BLOCKS {
            self.waiting_blocks.pop_front();
        }
        self.waiting_blocks.push_back(self.blocks);
        self.blocks += 1;
    }

    /// The number of the oldest block of sound that was ready at `now` and not read; and whether the
    /// one after it should have been read before `now` already.
    pub(crate) fn take_block(&mut self, now: Timestamp) -> Option<(u64, bool)> {
        let number = self
            .waiting_blocks
            .pop_front_if(|number| block_time(*number) <= now)?;
        let next = self.waiting_blocks.front();
        let is_behind = next.is_some_and(|number| block_time(*number) < now);
        Some((number, is_behind))
    }

    pub(crate) fn play(&mut self, at: Timestamp, message: Tone) {
        remember(&mut self.tones, Received { at, message });
    }

    pub(crate) fn tones(&self) -> Vec<Received<Tone>> {
        self.tones.iter().copied().collect()
    }

    /// How many states that were sent until `now` wait in the socket; they count as read.
    pub(crate) fn take_states(&mut self, now: Timestamp) -> usize {
        let states = self.unread.iter().take_while(|at| **at <= now).count();
        self.unread.drain(..states);
        states
    }

    pub(crate) fn ground_truth(&self) -> GroundTruth {
        let harmful = self.server.harmful();
        GroundTruth::new(&self.stage.lock().world, self.robot, harmful)
    }

    pub(crate) fn bodies(&self) -> Vec<BodyTruth> {
        self.bodies.iter().copied().collect()
    }

    pub(crate) fn image_truth(
        &self,
        camera: CameraPosition,
        captured_at: Timestamp,
    ) -> Option<ImageTruth> {
        let exposed = self.exposed.of(camera);
        exposed
            .iter()
            .rfind(|exposure| exposure.captured_at == captured_at)
            .map(ImageTruth::from)
    }
}

/// When some robot looks at the world next after a time: all ticks and all exposures fall together.
pub(crate) fn next_beat(after: Timestamp) -> Timestamp {
    let next = |first: Duration, period: Duration| {
        let passed = (after - Timestamp::ZERO).checked_sub(first);
        let number = passed.map_or(0, |passed| count(passed, period) + 1);
        Timestamp::ZERO + first + times(period, number)
    };
    let tick = next(TICK, TICK);
    [FIRST_EXPOSURE.top, FIRST_EXPOSURE.bottom]
        .into_iter()
        .map(|first| next(first, IMAGE_PERIOD))
        .fold(tick, Timestamp::min)
}

/// When the last sample of a block of sound is taken.
pub(crate) fn block_time(number: u64) -> Timestamp {
    let samples = u128::from(number + 1) * BLOCK_LENGTH as u128;
    let nanos = samples * 1_000_000_000 / u128::from(SAMPLE_RATE);
    Timestamp::from_nanos(nanos as u64)
}

fn remember<T>(values: &mut VecDeque<T>, value: T) {
    if values.len() == REMEMBERED {
        values.pop_front();
    }
    values.push_back(value);
}

fn times(period: Duration, count: u64) -> Duration {
    Duration::from_nanos(period.as_nanos() as u64 * count)
}

/// How many periods have passed.
fn count(passed: Duration, period: Duration) -> u64 {
    (passed.as_nanos() / period.as_nanos()) as u64
}
