//! A node of the NAO hangs for a second: what the body is told meanwhile, from the first packet to the last.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use framework::parameters::Layers;
use framework::testing::created;
use framework::{Clock, HardwareContext, Leased, Result, Stop, Threads, Timestamp};
use hardware::{
    ActuatorInterface, CameraInterface, MessageInterface, MicrophoneInterface, NetworkInterface,
    SensorInterface, SpeakerInterface,
};
use nao_runtime::runtime;
use simulated_nao::Hardware;
use support::root;
use types::audio::{AudioBlock, Tone};
use types::camera::CameraPosition;
use types::image::YuyvImage;
use types::leds::Leds;
use types::motor_commands::MotorCommands;
use types::network::{Datagram, Endpoint};
use types::sensor_data::SensorData;

/// A busy machine may take so long for anything.
const PATIENCE: Duration = Duration::from_secs(60);

/// The simulated NAO, whose actuators can be made to block the node that writes to them.
struct Blocking {
    inner: Hardware,
    blocks: AtomicBool,
    has_blocked: AtomicBool,
}

impl framework::Hardware for Blocking {
    fn new(context: HardwareContext) -> Result<Self> {
        Ok(Self {
            inner: Hardware::new(context)?,
            blocks: AtomicBool::new(false),
            has_blocked: AtomicBool::new(false),
        })
    }

    fn stop(&self) {
        self.inner.stop();
    }

    fn enter_safe_state(&self) {
        self.inner.enter_safe_state();
    }

    fn rearm(&self) {
        self.inner.rearm();
    }
}

impl ActuatorInterface for Blocking {
    fn write_command(&self, motors: &MotorCommands, leds: &Leds) -> Result<()> {
        if self.blocks.swap(false, Ordering::SeqCst) {
            std::thread::sleep(Duration::from_secs(1));
            self.has_blocked.store(true, Ordering::SeqCst);
        }
        self.inner.write_command(motors, leds)
    }
}

impl SensorInterface for Blocking {
    fn read_sensors(&self) -> Result<(Timestamp, SensorData)> {
        self.inner.read_sensors()
    }
}

impl CameraInterface for Blocking {
    fn read_image(&self, position: CameraPosition) -> Result<(Timestamp, Leased<YuyvImage>)> {
        self.inner.read_image(position)
    }
}

impl MicrophoneInterface for Blocking {
    fn read_audio(&self) -> Result<(Timestamp, Leased<AudioBlock>)> {
        self.inner.read_audio()
    }
}

impl SpeakerInterface for Blocking {
    fn play_tone(&self, tone: &Tone) -> Result<()> {
        self.inner.play_tone(tone)
    }
}

impl NetworkInterface for Blocking {
    fn join_team(&self, team: u8) -> Result<()> {
        self.inner.join_team(team)
    }

    fn read_datagram(&self, datagram: &mut Datagram) -> Result<Timestamp> {
        self.inner.read_datagram(datagram)
    }
}

impl MessageInterface for Blocking {
    fn send_to_game_controller(&self, to: Endpoint, bytes: &[u8]) -> Result<()> {
        self.inner.send_to_game_controller(to, bytes)
    }

    fn send_to_team(&self, bytes: &[u8]) -> Result<()> {
        self.inner.send_to_team(bytes)
    }
}

/// The greatest stiffness of any joint in each of the commands that came over LoLA's socket, oldest first.
#[derive(Default)]
struct Commands {
    stiffnesses: Vec<f32>,
    next: u64,
}

impl Commands {
    /// The simulation keeps the newest only, so this is asked often.
    fn collect(&mut self, hardware: &Blocking) {
        for (number, commands) in hardware.inner.received_commands() {
            if number >= self.next {
                assert_eq!(number, self.next, "commands were overlooked");
                let stiffnesses = commands.stiffnesses.to_array().into_iter();
                self.stiffnesses.push(stiffnesses.fold(0.0, f32::max));
                self.next += 1;
            }
        }
    }

    fn until(&mut self, hardware: &Blocking, mut is_so: impl FnMut(&[f32]) -> bool) {
        let begun = Instant::now();
        loop {
            self.collect(hardware);
            if is_so(&self.stiffnesses) {
                return;
            }
            assert!(begun.elapsed() < PATIENCE, "it never is so");
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

#[test]
fn a_node_that_hangs_loses_the_actuators_in_one_sequence_until_somebody_rearms() {
    let layers = Layers {
        directory: root().join("robotics/parameters"),
        location: Some("simulated".to_owned()),
        ..Layers::default()
    };
    let (clock, stop) = (Clock::wall(), Stop::default());
    let options = ["--free-ports", "--physics", "kinematic"];
    let (hardware, mut robot): (Arc<Blocking>, _) = created(
        &layers,
        "simulated",
        &options,
        &clock,
        &stop,
        runtime::create,
    );
    // The cameras cost most of the time, and have no part in this.
    robot
        .instances
        .retain(|instance| !instance.description().name.starts_with("Vision"));

    let threads = Threads::new(&clock, &*hardware, &stop);
    let rearm = threads.rearming();
    let is_stiff = |stiffnesses: &[f32]| stiffnesses.last().is_some_and(|last| *last > 0.0);
    let mut commands = Commands::default();
    let rearmed_at = std::thread::scope(|scope| {
        let running = scope.spawn(|| threads.run(&mut robot.instances));
        commands.until(&hardware, is_stiff);
        hardware.blocks.store(true, Ordering::SeqCst);
        commands.until(&hardware, |_| hardware.has_blocked.load(Ordering::SeqCst));
        // The node runs again; the body stays with the hardware.
        let count = commands.stiffnesses.len();
        commands.until(&hardware, |all| all.len() > count + 50);
        let rearmed_at = commands.stiffnesses.len();
        rearm.request();
        commands.until(&hardware, is_stiff);
        stop.request();
        let result = running.join().expect("no panic");
        result.expect("a hanging node is no error");
        rearmed_at
    });

    let all = &commands.stiffnesses[..rearmed_at];
    let by_nodes = all.iter().copied().find(|stiffness| *stiffness > 0.0);
    let by_nodes = by_nodes.expect("the nodes held the body");
    let told = all
        .iter()
        .position(|stiffness| *stiffness == by_nodes)
        .unwrap_or(0);
    // What the hardware says first is what the nodes said last.
    let last = all
        .iter()
        .rposition(|stiffness| *stiffness == by_nodes)
        .unwrap_or(0);
    let limp = all[last..].iter().position(|stiffness| *stiffness == 0.0);
    let limp = last + limp.expect("it was let down");
    let (before, sequence, after) = (&all[told..=last], &all[last + 1..limp], &all[limp..]);
    println!(
        "{} commands of nodes, {} of one sequence, {} that leave it limp",
        before.len(),
        sequence.len(),
        after.len()
    );
    assert!(
        before.iter().all(|stiffness| *stiffness == by_nodes),
        "{before:?}"
    );
    assert!(
        sequence.is_sorted_by(|earlier, later| earlier > later),
        "{sequence:?}"
    );
    // 0.5 s of 12 ms each; a busy machine leaves some out.
    assert!((2..=45).contains(&sequence.len()), "{sequence:?}");
    assert!(
        after.len() >= 50 && after.iter().all(|stiffness| *stiffness == 0.0),
        "{after:?}"
    );
}
