//! Instances, what connects them, and how to create them.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;
use std::time::Duration;

use framework::Access;
use framework::Consumer;
use framework::Cycler;
use framework::Horizon;
use framework::Injector;
use framework::Interleaving;
use framework::LiveParameters;
use framework::Remote;
use framework::Result;
use framework::Robot;
use framework::Start;
use framework::Subscriptions;
use framework::Swap;
use framework::buffer;
use framework::buffer_of;
use outpost_nodes::interfaces::ClockInterface;

use crate::cyclers;
use crate::databases;
use crate::parameters::Parameters;

pub mod keeper;

/// All instances in manifest order, connected and ready for a driver.
pub fn create<Hardware>(
    hardware: &Arc<Hardware>,
    start: Start<Parameters>,
) -> Result<Robot<Parameters>>
where
    Hardware: ClockInterface + Send + Sync + 'static,
{
    // Readers of the newest cycle on the left, queues of consumers on the right.
    let (
        lookout_north_writer,
        [
            lookout_north_for_keeper,
        ],
        [
            lookout_north_queue_for_keeper,
        ],
    ) = buffer([8]);
    let (lookout_south_writer, [], [lookout_south_queue_for_keeper]) = buffer([8]);
    let (keeper_writer, [], []) = buffer([]);
    let (parameters, [parameters_for_keeper], []) = buffer_of(
        || start.parameters.clone(),
        [],
    );

    // What clients write, listen to and call.
    let (keeper_injections, [keeper_injected], []) = buffer([]);

    let keeper = Cycler::new(
        keeper::KEEPER,
        keeper::Keeper {
            nodes: cyclers::keeper::Nodes::new()?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: keeper_injected,
            own: Swap::default(),
            parameters: parameters_for_keeper,
            perception: databases::keeper::Perception {
                horizon: Horizon::new(),
                lookout: Interleaving::new(),
                lookout_north: Consumer::new(
                    lookout_north_queue_for_keeper,
                    Duration::from_secs(5),
                ),
                lookout_south: Consumer::new(
                    lookout_south_queue_for_keeper,
                    Duration::from_secs(5),
                ),
            },
            lookout_north: lookout_north_for_keeper,
        },
        keeper_writer,
        start.clock.clone(),
    );

    Ok(Robot {
        name: "outpost",
        clock: start.clock.clone(),
        instances: vec![Box::new(keeper)],
        access: vec![
            Access {
                instance: "Keeper",
                subscriptions: Subscriptions::new(&[]),
                injector: Box::new(Injector::new(keeper_injections)),
                procedures: Vec::new(),
            },
        ],
        left_out: &["LookoutNorth", "LookoutSouth"],
        remotes: vec![
            Box::new(
                Remote::new(
                    "LookoutNorth",
                    lookout_north_writer,
                    Duration::from_secs(5),
                    start.clock.clone(),
                ),
            ),
            Box::new(
                Remote::new(
                    "LookoutSouth",
                    lookout_south_writer,
                    Duration::from_secs(5),
                    start.clock.clone(),
                ),
            ),
        ],
        parameters: LiveParameters::new(parameters, start.parameters, start.clock),
    })
}
