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
use zoo_nodes::interfaces::BodyInterface;
use zoo_nodes::interfaces::BumperInterface;
use zoo_nodes::interfaces::EarInterface;
use zoo_nodes::interfaces::EyeInterface;
use zoo_nodes::interfaces::LampInterface;
use zoo_nodes::interfaces::LegInterface;
use zoo_nodes::interfaces::MetronomeInterface;

use crate::cyclers;
use crate::databases;
use crate::parameters::Parameters;

pub mod control;
pub mod hearing;
pub mod lights;
pub mod reflexes;
pub mod vision;

/// All instances in manifest order, connected and ready for a driver.
pub fn create<Hardware>(
    hardware: &Arc<Hardware>,
    start: Start<Parameters>,
) -> Result<Robot<Parameters>>
where
    Hardware: BodyInterface + BumperInterface + EarInterface + EyeInterface
        + LampInterface + LegInterface + MetronomeInterface + Send + Sync + 'static,
{
    // Readers of the newest cycle on the left, queues of consumers on the right.
    let (
        vision_top_writer,
        [
            vision_top_for_vision_top,
            vision_top_for_vision_bottom,
        ],
        [
            vision_top_queue_for_control,
        ],
    ) = buffer([8]);
    let (
        vision_bottom_writer,
        [
            vision_bottom_for_vision_top,
            vision_bottom_for_vision_bottom,
        ],
        [
            vision_bottom_queue_for_control,
            vision_bottom_queue_for_reflexes,
        ],
    ) = buffer([8, 8]);
    let (hearing_writer, [], [hearing_queue_for_control]) = buffer([32]);
    let (
        control_writer,
        [
            control_for_vision_top,
            control_for_vision_bottom,
            control_for_reflexes,
            control_for_lights,
        ],
        [],
    ) = buffer([]);
    let (reflexes_writer, [], []) = buffer([]);
    let (lights_writer, [], []) = buffer([]);
    let (
        parameters,
        [
            parameters_for_vision_top,
            parameters_for_vision_bottom,
            parameters_for_control,
            parameters_for_reflexes,
        ],
        [],
    ) = buffer_of(|| start.parameters.clone(), []);

    // What clients write, listen to and call.
    let (vision_top_injections, [vision_top_injected], []) = buffer([]);
    let vision_top_subscriptions = Subscriptions::new(
        &["candidates", "vision_top.width"],
    );
    let (vision_bottom_injections, [vision_bottom_injected], []) = buffer([]);
    let vision_bottom_subscriptions = Subscriptions::new(
        &["candidates", "vision_bottom.width"],
    );
    let (hearing_injections, [hearing_injected], []) = buffer([]);
    let (control_injections, [control_injected], []) = buffer([]);
    let control_subscriptions = Subscriptions::new(control::ADDITIONAL_OUTPUTS);
    let (control_stop, control_stop_answerer) = procedure();
    let (control_walk, control_walk_answerer) = procedure();
    let (reflexes_injections, [reflexes_injected], []) = buffer([]);
    let (reflexes_type, reflexes_type_answerer) = procedure();
    let (lights_injections, [], []) = buffer([]);

    let mut cycler_state = databases::vision::CyclerState::default();
    let mut creation = databases::vision::Creation {
        cycler_state: &mut cycler_state,
        instance_parameters: &start.parameters.vision_top,
        parameters: &start.parameters,
    };
    let vision_top = Cycler::new(
        vision::VISION_TOP,
        vision::Vision {
            nodes: cyclers::vision::Nodes::new(&mut creation)?,
            additional_outputs: databases::vision::AdditionalOutputs::default(),
            capture_time: None,
            cycler_state,
            hardware_interface: hardware.clone(),
            injections: vision_top_injected,
            own: Swap::default(),
            parameters: parameters_for_vision_top,
            subscribed: databases::vision::Subscribed::default(),
            subscriptions: vision_top_subscriptions.clone(),
            vision_top: vision_top_for_vision_top,
            vision_bottom: vision_bottom_for_vision_top,
            control: control_for_vision_top,
            select: |parameters| &parameters.vision_top,
            select_exposure: |parameters| &parameters.exposure.vision_top,
        },
        vision_top_writer,
        start.clock.clone(),
    );

    let mut cycler_state = databases::vision::CyclerState::default();
    let mut creation = databases::vision::Creation {
        cycler_state: &mut cycler_state,
        instance_parameters: &start.parameters.vision_bottom,
        parameters: &start.parameters,
    };
    let vision_bottom = Cycler::new(
        vision::VISION_BOTTOM,
        vision::Vision {
            nodes: cyclers::vision::Nodes::new(&mut creation)?,
            additional_outputs: databases::vision::AdditionalOutputs::default(),
            capture_time: None,
            cycler_state,
            hardware_interface: hardware.clone(),
            injections: vision_bottom_injected,
            own: Swap::default(),
            parameters: parameters_for_vision_bottom,
            subscribed: databases::vision::Subscribed::default(),
            subscriptions: vision_bottom_subscriptions.clone(),
            vision_top: vision_top_for_vision_bottom,
            vision_bottom: vision_bottom_for_vision_bottom,
            control: control_for_vision_bottom,
            select: |parameters| &parameters.vision_bottom,
            select_exposure: |parameters| &parameters.exposure.vision_bottom,
        },
        vision_bottom_writer,
        start.clock.clone(),
    );

    let hearing = Cycler::new(
        hearing::HEARING,
        hearing::Hearing {
            nodes: cyclers::hearing::Nodes::new()?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: hearing_injected,
        },
        hearing_writer,
        start.clock.clone(),
    );

    let mut cycler_state = databases::control::CyclerState::default();
    let mut creation = databases::control::Creation {
        cycler_state: &mut cycler_state,
        hardware_interface: hardware,
        parameters: &start.parameters,
    };
    let control = Cycler::new(
        control::CONTROL,
        control::Control {
            nodes: cyclers::control::Nodes::new(&mut creation)?,
            additional_outputs: databases::control::AdditionalOutputs::default(),
            capture_time: None,
            cycler_state,
            hardware_interface: hardware.clone(),
            historic: databases::control::Historic {
                pose: History::new(Duration::from_secs(2)),
            },
            injections: control_injected,
            own: Swap::default(),
            parameters: parameters_for_control,
            perception: databases::control::Perception {
                horizon: Horizon::new(),
                vision: Interleaving::new(),
                vision_top: Consumer::new(
                    vision_top_queue_for_control,
                    Duration::from_millis(500),
                ),
                vision_bottom: Consumer::new(
                    vision_bottom_queue_for_control,
                    Duration::from_millis(500),
                ),
                hearing: Consumer::new(hearing_queue_for_control, Duration::from_secs(1)),
            },
            procedures: databases::control::Procedures {
                stop: control_stop_answerer,
                walk: control_walk_answerer,
            },
            subscribed: databases::control::Subscribed::default(),
            subscriptions: control_subscriptions.clone(),
        },
        control_writer,
        start.clock.clone(),
    );

    let reflexes = Cycler::new(
        reflexes::REFLEXES,
        reflexes::Reflexes {
            nodes: cyclers::reflexes::Nodes::new()?,
            hardware_interface: hardware.clone(),
            injections: reflexes_injected,
            own: Swap::default(),
            parameters: parameters_for_reflexes,
            perception: databases::reflexes::Perception {
                horizon: Horizon::new(),
                vision_bottom: Consumer::new(
                    vision_bottom_queue_for_reflexes,
                    Duration::from_millis(500),
                ),
            },
            procedures: databases::reflexes::Procedures {
                type_: reflexes_type_answerer,
            },
            control: control_for_reflexes,
            select_a_b: |parameters| &parameters.a.b.reflexes,
            select_a_b2: |parameters| &parameters.a_b.reflexes,
        },
        reflexes_writer,
        start.clock.clone(),
    );

    let lights = Cycler::new(
        lights::LIGHTS,
        lights::Lights {
            nodes: cyclers::lights::Nodes::new()?,
            cycler_state: databases::lights::CyclerState::default(),
            hardware_interface: hardware.clone(),
            control: control_for_lights,
        },
        lights_writer,
        start.clock.clone(),
    );

    Ok(Robot {
        name: "zoo",
        clock: start.clock.clone(),
        instances: vec![
            Box::new(vision_top),
            Box::new(vision_bottom),
            Box::new(hearing),
            Box::new(control),
            Box::new(reflexes),
            Box::new(lights),
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
                instance: "Hearing",
                subscriptions: Subscriptions::new(&[]),
                injector: Box::new(Injector::new(hearing_injections)),
                procedures: Vec::new(),
            },
            Access {
                instance: "Control",
                subscriptions: control_subscriptions,
                injector: Box::new(Injector::new(control_injections)),
                procedures: vec![
                    ("stop", Box::new(control_stop)),
                    ("walk", Box::new(control_walk)),
                ],
            },
            Access {
                instance: "Reflexes",
                subscriptions: Subscriptions::new(&[]),
                injector: Box::new(Injector::new(reflexes_injections)),
                procedures: vec![("type_", Box::new(reflexes_type))],
            },
            Access {
                instance: "Lights",
                subscriptions: Subscriptions::new(&[]),
                injector: Box::new(
                    Injector::<databases::lights::Injections>::new(lights_injections),
                ),
                procedures: Vec::new(),
            },
        ],
        left_out: &[],
        remotes: Vec::new(),
        parameters: LiveParameters::new(parameters, start.parameters, start.clock),
    })
}
