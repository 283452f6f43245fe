//! The fixture robot, stage by stage.

use super::{manifest, model, nodes, robot, schedule};
use crate::diagnostics::Diagnostics;
use crate::graph::fixture;
use crate::schedule::{Edge, Reason};
use crate::workspace::Workspace;

#[test]
fn the_manifest_is_shown_without_defaults() {
    let text = r#"
[robot]
name = "walker"
identities = ["body", "head"]

[[cycler]]
name = "Vision"
kind = "perception"
instances = ["Top", { name = "Bottom", deadline = "40ms" }]
setup_nodes = ["vision::image_receiver"]
nodes = [{ node = "vision::ball_detection", on_failure = "skip" }]
deadline = "33ms"
queue = 8

[[target]]
name = "nao"
hardware = "nao::Hardware"
location = "nao"
"#;
    let workspace = Workspace::in_memory([("hulk.toml", text)]);
    let mut diagnostics = Diagnostics::new();
    let loaded = crate::manifest::load(&workspace, &mut diagnostics);
    insta::assert_snapshot!(manifest::text(&loaded.expect("it has no errors")), @r#"
    robot walker
      generated in generated, parameters in parameters
      identities body, head

    cycler Vision (perception): VisionTop, VisionBottom
      deadline 33ms, queue 8
      setup node vision::image_receiver
      node vision::ball_detection (on failure skip)

    target nao: nao::Hardware
      location nao
    "#);
}

#[test]
fn nodes_are_shown_as_written() {
    let node = r#"//! Finds balls. Slowly.

use framework::{Input, MainOutput, Parameter, Result, context};
use hardware::CameraInterface;
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Balls;

#[context]
pub struct CreationContext {
    radius: Parameter<f32, "ball.radius">,
}

#[context]
pub struct CycleContext {
    image: Input<
        Option<u8>,
        "image",
    >,
    hardware: framework::HardwareInterface,
}

#[context]
pub struct MainOutputs {
    pub balls: MainOutput<Vec<f32>>,
}

impl Balls {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(
        &mut self,
        _context: CycleContext<impl CameraInterface>,
    ) -> Result<MainOutputs> {
        Ok(MainOutputs { balls: Vec::new().into() })
    }
}
"#;
    let manifest = "[robot]\nname = \"walker\"\n\n[[cycler]]\nname = \"Vision\"\n\
                    kind = \"perception\"\nsetup_nodes = [\"vision::balls\"]\n\n\
                    [[target]]\nname = \"nao\"\nhardware = \"vision::Hardware\"\n";
    let package = "[package]\nname = \"vision\"\nversion = \"0.1.0\"\nedition = \"2024\"\n";
    let workspace = Workspace::in_memory([
        ("Cargo.toml", "[workspace]\nmembers = [\"vision\"]\n"),
        ("hulk.toml", manifest),
        ("vision/Cargo.toml", package),
        ("vision/src/lib.rs", "pub mod balls;\n"),
        ("vision/src/balls.rs", node),
    ]);
    let mut diagnostics = Diagnostics::new();
    let loaded = crate::manifest::load(&workspace, &mut diagnostics).expect("it has no errors");
    let sources = crate::scan::scan(&workspace, &loaded, &mut diagnostics);
    let sources = sources.expect("the node has no errors");
    insta::assert_snapshot!(nodes::text(&workspace, &loaded, &sources), @r#"
    node vision::balls: Balls in vision/src/balls.rs
      Finds balls.
      new
        radius: Parameter<f32, "ball.radius">
      cycle asks CameraInterface
        image: Input<Option<u8>, "image">
        hardware: framework::HardwareInterface
      outputs
        balls: MainOutput<Vec<f32>>
    "#);
}

#[test]
fn the_robot_is_shown_with_every_name_bound() {
    insta::assert_snapshot!(robot::text(&fixture::robot()), @r#"
    robot walker
      generated in generated, parameters in parameters
      target simulated: simulated::Hardware
      target nao: nao::Hardware

    cycler Vision (perception): VisionTop, VisionBottom
      on failure stop, pending timeout 1s, queue 32, VisionTop within 12ms, VisionBottom within 12ms
      setup node vision::image_receiver: ImageReceiver in vision/src/image_receiver.rs
        new
          hardware: HardwareInterface
        cycle asks hardware::CameraInterface (reading)
          image: MainOutput<types::Image>
          camera: Parameter<types::CameraPosition, "$cycler_instance.camera">
          hardware: HardwareInterface
        outputs
          captured_at: CaptureTime
      node vision::ball_detection: BallDetection in vision/src/ball_detection.rs
        cycle
          image: Input<types::Image, "image"> from vision::image_receiver
          matrix: RequiredInput<Option<types::CameraMatrix>, "Control", "matrix?"> from control::ball_filter
          candidates: AdditionalOutput<Vec<types::Ball>, "ball_candidates">
        outputs
          balls: MainOutput<Vec<types::Ball>>
      main outputs
        balls: Vec<types::Ball> by vision::ball_detection
        image: types::Image by vision::image_receiver
      additional outputs
        ball_candidates: Vec<types::Ball> by vision::ball_detection

    cycler Control (real-time): Control
      on failure stop, watchdog 300ms, history 1s, Control within 12ms
      setup node control::sensor_receiver: SensorReceiver in control/src/sensor_receiver.rs
        cycle asks hardware::SensorInterface (reading)
        outputs
          sensors: MainOutput<types::Sensors>
      node control::head: Head in control/src/head.rs
        cycle
          ball: Input<Option<types::Ball>, "ball"> from control::ball_filter
          last_command: PreviousInput<types::Command, "command"> from control::head
          calibration: CyclerState<&types::Calibration, "calibration"> from control::ball_filter
          walk: Procedure<types::Step, bool, "walk">
        outputs
          command: MainOutput<types::Command>
      node control::ball_filter: BallFilter in control/src/ball_filter.rs
        cycle
          sensors: HistoricInput<types::Sensors, "sensors"> from control::sensor_receiver
          balls: PerceptionInput<Vec<types::Ball>, "Vision", "balls"> from vision::ball_detection
          calibration: CyclerState<types::Calibration, "calibration">
          cycle_time: CycleTime
        outputs
          ball: MainOutput<Option<types::Ball>>
          matrix: MainOutput<Option<types::CameraMatrix>>
      node control::command_sender: CommandSender in control/src/command_sender.rs
        cycle asks hardware::ActuatorInterface (writing)
          command: Input<types::Command, "command"> from control::head
          image: LatestInput<types::Image, "VisionTop", "image"> from vision::image_receiver, type left to rustc
      main outputs
        ball: Option<types::Ball> by control::ball_filter
        command: types::Command by control::head
        matrix: Option<types::CameraMatrix> by control::ball_filter
        sensors: types::Sensors by control::sensor_receiver
      cycler state
        calibration: types::Calibration by control::ball_filter, control::head (reads)

    parameters
      vision_bottom
        camera: types::CameraPosition by vision::image_receiver
      vision_top
        camera: types::CameraPosition by vision::image_receiver

    left to rustc: 1
    "#);
}

#[test]
fn the_schedule_says_why_a_node_does_not_run_earlier() {
    let mut order = fixture::schedule();
    order.cyclers[0].edges.push(Edge {
        from: 0,
        to: 1,
        reason: Reason::Input,
        field: 0,
        path: "image".to_owned(),
    });
    insta::assert_snapshot!(schedule::text(&fixture::robot(), &order), @r#"
    Vision
      0 vision::image_receiver (setup)
      1 vision::ball_detection
          after vision::image_receiver: image (Input "image")
    Control
      0 control::sensor_receiver (setup)
      1 control::ball_filter
      2 control::head
      3 control::command_sender
    "#);
}

#[test]
fn the_model_is_shown_file_by_file() {
    let described = crate::model::describe(&fixture::robot(), &fixture::schedule());
    let text = model::text(&described);
    for part in [
        "package walker_runtime in generated\n",
        "\nparameters\n  struct Parameters\n    vision_bottom: VisionInstance\n",
        "\ncycler Vision in module vision\n",
        "\n  latest: control\n",
        "\n  procedures: walk(types::Step) -> bool\n",
        "\n  interleaved as vision: vision_top, vision_bottom\n",
        "\n  cycle: ball_filter, head, command_sender\n",
        "\nruntime\n  instance VisionTop\n    read by: ",
        "\nbinary nao: nao::Hardware\n",
    ] {
        assert!(text.contains(part), "{part:?} is missing in:\n{text}");
    }
}
