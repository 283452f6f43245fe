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
use framework::LiveParameters;
use framework::Result;
use framework::Robot;
use framework::Start;
use framework::Subscriptions;
use framework::Swap;
use framework::buffer;
use framework::buffer_of;
use timing_nodes::interfaces::Camera;
use timing_nodes::interfaces::Console;
use timing_nodes::interfaces::Effort;
use timing_nodes::interfaces::Odometer;
use timing_nodes::interfaces::Pace;
use timing_nodes::interfaces::Radio;

use crate::cyclers;
use crate::databases;
use crate::parameters::Parameters;

pub mod localization;
pub mod odometry;
pub mod radio;
pub mod vision;

/// All instances in manifest order, connected and ready for a driver.
pub fn create<Hardware>(
    hardware: &Arc<Hardware>,
    start: Start<Parameters>,
) -> Result<Robot<Parameters>>
where
    Hardware: Camera + Console + Effort + Odometer + Pace + Radio + Send + Sync
        + 'static,
{
    // Readers of the newest cycle on the left, queues of consumers on the right.
    let (vision_writer, [], [vision_queue_for_localization]) = buffer([32]);
    let (odometry_writer, [], [odometry_queue_for_localization]) = buffer([512]);
    let (radio_writer, [], [radio_queue_for_localization]) = buffer([32]);
    let (localization_writer, [], []) = buffer([]);
    let (parameters, [parameters_for_vision, parameters_for_localization], []) = buffer_of(
        || start.parameters.clone(),
        [],
    );

    // What clients write, listen to and call.
    let (vision_injections, [vision_injected], []) = buffer([]);
    let (odometry_injections, [odometry_injected], []) = buffer([]);
    let (radio_injections, [radio_injected], []) = buffer([]);
    let (localization_injections, [localization_injected], []) = buffer([]);

    let vision = Cycler::new(
        vision::VISION,
        vision::Vision {
            nodes: cyclers::vision::Nodes::new()?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: vision_injected,
            own: Swap::default(),
            parameters: parameters_for_vision,
        },
        vision_writer,
        start.clock.clone(),
    );

    let odometry = Cycler::new(
        odometry::ODOMETRY,
        odometry::Odometry {
            nodes: cyclers::odometry::Nodes::new()?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: odometry_injected,
        },
        odometry_writer,
        start.clock.clone(),
    );

    let radio = Cycler::new(
        radio::RADIO,
        radio::Radio {
            nodes: cyclers::radio::Nodes::new()?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: radio_injected,
        },
        radio_writer,
        start.clock.clone(),
    );

    let localization = Cycler::new(
        localization::LOCALIZATION,
        localization::Localization {
            nodes: cyclers::localization::Nodes::new()?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: localization_injected,
            own: Swap::default(),
            parameters: parameters_for_localization,
            perception: databases::localization::Perception {
                horizon: Horizon::new(),
                vision: Consumer::new(
                    vision_queue_for_localization,
                    Duration::from_secs(5),
                ),
                odometry: Consumer::new(
                    odometry_queue_for_localization,
                    Duration::from_secs(1),
                ),
                radio: Consumer::new(
                    radio_queue_for_localization,
                    Duration::from_secs(1),
                ),
            },
        },
        localization_writer,
        start.clock.clone(),
    );

    Ok(Robot {
        name: "timing",
        clock: start.clock.clone(),
        instances: vec![
            Box::new(vision),
            Box::new(odometry),
            Box::new(radio),
            Box::new(localization),
        ],
        access: vec![
            Access {
                instance: "Vision",
                subscriptions: Subscriptions::new(&[]),
                injector: Box::new(Injector::new(vision_injections)),
                procedures: Vec::new(),
            },
            Access {
                instance: "Odometry",
                subscriptions: Subscriptions::new(&[]),
                injector: Box::new(Injector::new(odometry_injections)),
                procedures: Vec::new(),
            },
            Access {
                instance: "Radio",
                subscriptions: Subscriptions::new(&[]),
                injector: Box::new(Injector::new(radio_injections)),
                procedures: Vec::new(),
            },
            Access {
                instance: "Localization",
                subscriptions: Subscriptions::new(&[]),
                injector: Box::new(Injector::new(localization_injections)),
                procedures: Vec::new(),
            },
        ],
        left_out: &[],
        remotes: Vec::new(),
        parameters: LiveParameters::new(parameters, start.parameters, start.clock),
    })
}
