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
use framework::LiveParameters;
use framework::Result;
use framework::Robot;
use framework::Start;
use framework::Subscriptions;
use framework::Swap;
use framework::buffer;
use framework::buffer_of;
use rover_nodes::interfaces::Encoders;
use rover_nodes::interfaces::Lidar;
use rover_nodes::interfaces::Motors;

use crate::cyclers;
use crate::databases;
use crate::parameters::Parameters;

pub mod drive;
pub mod lidar;

/// All instances in manifest order, connected and ready for a driver.
pub fn create<Hardware>(
    hardware: &Arc<Hardware>,
    start: Start<Parameters>,
) -> Result<Robot<Parameters>>
where
    Hardware: Encoders + Lidar + Motors + Send + Sync + 'static,
{
    // Readers of the newest cycle on the left, queues of consumers on the right.
    let (lidar_writer, [], [lidar_queue_for_drive]) = buffer([32]);
    let (drive_writer, [], []) = buffer([]);
    let (parameters, [parameters_for_lidar, parameters_for_drive], []) = buffer_of(
        || start.parameters.clone(),
        [],
    );

    // What clients write, listen to and call.
    let (lidar_injections, [lidar_injected], []) = buffer([]);
    let (drive_injections, [drive_injected], []) = buffer([]);

    let lidar = Cycler::new(
        lidar::LIDAR,
        lidar::Lidar {
            nodes: cyclers::lidar::Nodes::new()?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: lidar_injected,
            own: Swap::default(),
            parameters: parameters_for_lidar,
        },
        lidar_writer,
        start.clock.clone(),
    );

    let drive = Cycler::new(
        drive::DRIVE,
        drive::Drive {
            nodes: cyclers::drive::Nodes::new()?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            historic: databases::drive::Historic {
                pose: History::new(Duration::from_secs(1)),
            },
            injections: drive_injected,
            own: Swap::default(),
            parameters: parameters_for_drive,
            perception: databases::drive::Perception {
                horizon: Horizon::new(),
                lidar: Consumer::new(lidar_queue_for_drive, Duration::from_secs(1)),
            },
        },
        drive_writer,
        start.clock.clone(),
    );

    Ok(Robot {
        name: "rover",
        clock: start.clock.clone(),
        instances: vec![Box::new(lidar), Box::new(drive)],
        access: vec![
            Access {
                instance: "Lidar",
                subscriptions: Subscriptions::new(&[]),
                injector: Box::new(Injector::new(lidar_injections)),
                procedures: Vec::new(),
            },
            Access {
                instance: "Drive",
                subscriptions: Subscriptions::new(&[]),
                injector: Box::new(Injector::new(drive_injections)),
                procedures: Vec::new(),
            },
        ],
        left_out: &[],
        remotes: Vec::new(),
        parameters: LiveParameters::new(parameters, start.parameters, start.clock),
    })
}
