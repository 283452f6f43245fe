//! Instances, what connects them, and how to create them.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::Access;
use framework::Cycler;
use framework::Injector;
use framework::LiveParameters;
use framework::Result;
use framework::Robot;
use framework::Start;
use framework::Subscriptions;
use framework::Swap;
use framework::buffer;
use framework::buffer_of;
use k1_nodes::interfaces::BodyInterface;
use k1_nodes::interfaces::MotorInterface;

use crate::cyclers;
use crate::parameters::Parameters;

pub mod control;

/// All instances in manifest order, connected and ready for a driver.
pub fn create<Hardware>(
    hardware: &Arc<Hardware>,
    start: Start<Parameters>,
) -> Result<Robot<Parameters>>
where
    Hardware: BodyInterface + MotorInterface + Send + Sync + 'static,
{
    // Readers of the newest cycle on the left, queues of consumers on the right.
    let (control_writer, [], []) = buffer([]);
    let (parameters, [parameters_for_control], []) = buffer_of(
        || start.parameters.clone(),
        [],
    );

    // What clients write, listen to and call.
    let (control_injections, [control_injected], []) = buffer([]);

    let control = Cycler::new(
        control::CONTROL,
        control::Control {
            nodes: cyclers::control::Nodes::new()?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: control_injected,
            own: Swap::default(),
            parameters: parameters_for_control,
        },
        control_writer,
        start.clock.clone(),
    );

    Ok(Robot {
        name: "k1",
        clock: start.clock.clone(),
        instances: vec![Box::new(control)],
        access: vec![
            Access {
                instance: "Control",
                subscriptions: Subscriptions::new(&[]),
                injector: Box::new(Injector::new(control_injections)),
                procedures: Vec::new(),
            },
        ],
        left_out: &[],
        remotes: Vec::new(),
        parameters: LiveParameters::new(parameters, start.parameters, start.clock),
    })
}
