//! Instances, what connects them, and how to create them.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;
use std::time::Duration;

use framework::Access;
use framework::Consumer;
use framework::Cycler;
use framework::History;
use framework::Horizon;
use framework::Injector;
use framework::Interleaving;
use framework::LiveParameters;
use framework::Result;
use framework::Robot;
use framework::Start;
use framework::Subscriptions;
use framework::Swap;
use framework::buffer;
use framework::buffer_of;
use framework::procedure;
use hardware::ActuatorInterface;
use hardware::CameraInterface;
use hardware::MessageInterface;
use hardware::MicrophoneInterface;
use hardware::NetworkInterface;
use hardware::SensorInterface;
use hardware::SpeakerInterface;

use crate::cyclers;
use crate::databases;
use crate::parameters::Parameters;

pub mod audio;
pub mod control;
pub mod spl_network;
pub mod vision;

/// All instances in manifest order, connected and ready for a driver.
pub fn create<Hardware>(
    hardware: &Arc<Hardware>,
    start: Start<Parameters>,
) -> Result<Robot<Parameters>>
where
    Hardware: ActuatorInterface + CameraInterface + MessageInterface
        + MicrophoneInterface + NetworkInterface + SensorInterface + SpeakerInterface
        + Send + Sync + 'static,
{
    // Readers of the newest cycle on the left, queues of consumers on the right.
    let (vision_top_writer, [], [vision_top_queue_for_control]) = buffer([32]);
    let (vision_bottom_writer, [], [vision_bottom_queue_for_control]) = buffer([32]);
    let (spl_network_writer, [], [spl_network_queue_for_control]) = buffer([32]);
    let (audio_writer, [], [audio_queue_for_control]) = buffer([32]);
    let (control_writer, [control_for_vision_top, control_for_vision_bottom], []) = buffer([]);
    let (
        parameters,
        [
            parameters_for_vision_top,
            parameters_for_vision_bottom,
            parameters_for_spl_network,
            parameters_for_audio,
            parameters_for_control,
        ],
        [],
    ) = buffer_of(|| start.parameters.clone(), []);

    // What clients write, listen to and call.
    let (vision_top_injections, [vision_top_injected], []) = buffer([]);
    let vision_top_subscriptions = Subscriptions::new(vision::ADDITIONAL_OUTPUTS);
    let (vision_bottom_injections, [vision_bottom_injected], []) = buffer([]);
    let vision_bottom_subscriptions = Subscriptions::new(vision::ADDITIONAL_OUTPUTS);
    let (spl_network_injections, [spl_network_injected], []) = buffer([]);
    let spl_network_subscriptions = Subscriptions::new(spl_network::ADDITIONAL_OUTPUTS);
    let (audio_injections, [audio_injected], []) = buffer([]);
    let audio_subscriptions = Subscriptions::new(audio::ADDITIONAL_OUTPUTS);
    let (control_injections, [control_injected], []) = buffer([]);
    let control_subscriptions = Subscriptions::new(control::ADDITIONAL_OUTPUTS);
    let (control_look_at, control_look_at_answerer) = procedure();
    let (control_motion, control_motion_answerer) = procedure();
    let (control_walk, control_walk_answerer) = procedure();

    let vision_top = Cycler::new(
        vision::VISION_TOP,
        vision::Vision {
            nodes: cyclers::vision::Nodes::new()?,
            additional_outputs: databases::vision::AdditionalOutputs::default(),
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: vision_top_injected,
            own: Swap::default(),
            parameters: parameters_for_vision_top,
            subscribed: databases::vision::Subscribed::default(),
            subscriptions: vision_top_subscriptions.clone(),
            control: control_for_vision_top,
            select: |parameters| &parameters.vision_top,
        },
        vision_top_writer,
        start.clock.clone(),
    );

    let vision_bottom = Cycler::new(
        vision::VISION_BOTTOM,
        vision::Vision {
            nodes: cyclers::vision::Nodes::new()?,
            additional_outputs: databases::vision::AdditionalOutputs::default(),
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: vision_bottom_injected,
            own: Swap::default(),
            parameters: parameters_for_vision_bottom,
            subscribed: databases::vision::Subscribed::default(),
            subscriptions: vision_bottom_subscriptions.clone(),
            control: control_for_vision_bottom,
            select: |parameters| &parameters.vision_bottom,
        },
        vision_bottom_writer,
        start.clock.clone(),
    );

    let mut creation = databases::spl_network::Creation {
        hardware_interface: hardware,
        parameters: &start.parameters,
    };
    let spl_network = Cycler::new(
        spl_network::SPL_NETWORK,
        spl_network::SplNetwork {
            nodes: cyclers::spl_network::Nodes::new(&mut creation)?,
            additional_outputs: databases::spl_network::AdditionalOutputs::default(),
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: spl_network_injected,
            own: Swap::default(),
            parameters: parameters_for_spl_network,
            subscribed: databases::spl_network::Subscribed::default(),
            subscriptions: spl_network_subscriptions.clone(),
        },
        spl_network_writer,
        start.clock.clone(),
    );

    let audio = Cycler::new(
        audio::AUDIO,
        audio::Audio {
            nodes: cyclers::audio::Nodes::new()?,
            additional_outputs: databases::audio::AdditionalOutputs::default(),
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: audio_injected,
            own: Swap::default(),
            parameters: parameters_for_audio,
            subscribed: databases::audio::Subscribed::default(),
            subscriptions: audio_subscriptions.clone(),
        },
        audio_writer,
        start.clock.clone(),
    );

    let control = Cycler::new(
        control::CONTROL,
        control::Control {
            nodes: cyclers::control::Nodes::new()?,
            additional_outputs: databases::control::AdditionalOutputs::default(),
            capture_time: None,
            cycler_state: databases::control::CyclerState::default(),
            hardware_interface: hardware.clone(),
            historic: databases::control::Historic {
                odometry: History::new(Duration::from_secs(1)),
            },
            injections: control_injected,
            own: Swap::default(),
            parameters: parameters_for_control,
            perception: databases::control::Perception {
                horizon: Horizon::new(),
                vision: Interleaving::new(),
                vision_top: Consumer::new(
                    vision_top_queue_for_control,
                    Duration::from_secs(1),
                ),
                vision_bottom: Consumer::new(
                    vision_bottom_queue_for_control,
                    Duration::from_secs(1),
                ),
                spl_network: Consumer::new(
                    spl_network_queue_for_control,
                    Duration::from_secs(1),
                ),
                audio: Consumer::new(audio_queue_for_control, Duration::from_secs(1)),
            },
            procedures: databases::control::Procedures {
                look_at: control_look_at_answerer,
                motion: control_motion_answerer,
                walk: control_walk_answerer,
            },
            subscribed: databases::control::Subscribed::default(),
            subscriptions: control_subscriptions.clone(),
        },
        control_writer,
        start.clock.clone(),
    );

    Ok(Robot {
        name: "nao",
        clock: start.clock.clone(),
        instances: vec![
            Box::new(vision_top),
            Box::new(vision_bottom),
            Box::new(spl_network),
            Box::new(audio),
            Box::new(control),
        ],
        access: vec![
            Access {
                instance: "VisionTop",
                subscriptions: vision_top_subscriptions,
                injector: Box::new(Injector::new(vision_top_injections)),
                procedures: Vec::new(),
            },
            Access {
                instance: "VisionBottom",
                subscriptions: vision_bottom_subscriptions,
                injector: Box::new(Injector::new(vision_bottom_injections)),
                procedures: Vec::new(),
            },
            Access {
                instance: "SplNetwork",
                subscriptions: spl_network_subscriptions,
                injector: Box::new(Injector::new(spl_network_injections)),
                procedures: Vec::new(),
            },
            Access {
                instance: "Audio",
                subscriptions: audio_subscriptions,
                injector: Box::new(Injector::new(audio_injections)),
                procedures: Vec::new(),
            },
            Access {
                instance: "Control",
                subscriptions: control_subscriptions,
                injector: Box::new(Injector::new(control_injections)),
                procedures: vec![
                    ("look_at", Box::new(control_look_at)),
                    ("motion", Box::new(control_motion)),
                    ("walk", Box::new(control_walk)),
                ],
            },
        ],
        left_out: &[],
        remotes: Vec::new(),
        parameters: LiveParameters::new(parameters, start.parameters, start.clock),
    })
}
