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
use framework::Stub;
use framework::Subscriptions;
use framework::Swap;
use framework::buffer;
use framework::buffer_of;
use framework::procedure;
use zoo_nodes::interfaces::BodyInterface;
use zoo_nodes::interfaces::LegInterface;

use crate::cyclers;
use crate::databases;
use crate::parameters::Parameters;

pub mod control;

/// What stands in for the instances that are left out and read: until one is fed nobody has
/// written it.
pub struct Stubs {
    /// Read in order of time by `Control`.
    pub vision_top: Stub<databases::vision::SharedOutputs>,
    /// Read in order of time by `Control`.
    pub vision_bottom: Stub<databases::vision::SharedOutputs>,
    /// Read in order of time by `Control`.
    pub hearing: Stub<databases::hearing::SharedOutputs>,
}

/// All instances in manifest order, connected and ready for a driver, and the stubs of what
/// is left out.
pub fn create<Hardware>(
    hardware: &Arc<Hardware>,
    start: Start<Parameters>,
) -> Result<(Robot<Parameters>, Stubs)>
where
    Hardware: BodyInterface + LegInterface + Send + Sync + 'static,
{
    // Readers of the newest cycle on the left, queues of consumers on the right.
    let (vision_top_writer, [], [vision_top_queue_for_control]) = buffer([8]);
    let (vision_bottom_writer, [], [vision_bottom_queue_for_control]) = buffer([8]);
    let (hearing_writer, [], [hearing_queue_for_control]) = buffer([32]);
    let (control_writer, [], []) = buffer([]);
    let (parameters, [parameters_for_control], []) = buffer_of(
        || start.parameters.clone(),
        [],
    );

    // What clients write, listen to and call.
    let (control_injections, [control_injected], []) = buffer([]);
    let control_subscriptions = Subscriptions::new(control::ADDITIONAL_OUTPUTS);
    let (control_stop, control_stop_answerer) = procedure();
    let (control_walk, control_walk_answerer) = procedure();

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

    let stubs = Stubs {
        vision_top: Stub::new("VisionTop", vision_top_writer, start.clock.clone()),
        vision_bottom: Stub::new(
            "VisionBottom",
            vision_bottom_writer,
            start.clock.clone(),
        ),
        hearing: Stub::new("Hearing", hearing_writer, start.clock.clone()),
    };

    Ok((
        Robot {
            name: "zoo",
            clock: start.clock.clone(),
            instances: vec![Box::new(control)],
            access: vec![
                Access {
                    instance: "Control",
                    subscriptions: control_subscriptions,
                    injector: Box::new(Injector::new(control_injections)),
                    procedures: vec![
                        ("stop", Box::new(control_stop)),
                        ("walk", Box::new(control_walk)),
                    ],
                },
            ],
            left_out: &["VisionTop", "VisionBottom", "Hearing", "Reflexes", "Lights"],
            remotes: Vec::new(),
            parameters: LiveParameters::new(parameters, start.parameters, start.clock),
        },
        stubs,
    ))
}
