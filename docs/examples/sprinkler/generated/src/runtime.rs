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
use sprinkler_nodes::RainGauge;
use sprinkler_nodes::SoilProbe;
use sprinkler_nodes::Valve;

use crate::cyclers;
use crate::parameters::Parameters;

pub mod garden;
pub mod weather;

/// All instances in manifest order, connected and ready for a driver.
pub fn create<Hardware>(
    hardware: &Arc<Hardware>,
    start: Start<Parameters>,
) -> Result<Robot<Parameters>>
where
    Hardware: RainGauge + SoilProbe + Valve + Send + Sync + 'static,
{
    // Readers of the newest cycle on the left, queues of consumers on the right.
    let (weather_writer, [weather_for_garden], []) = buffer([]);
    let (garden_writer, [], []) = buffer([]);
    let (parameters, [parameters_for_weather, parameters_for_garden], []) = buffer_of(
        || start.parameters.clone(),
        [],
    );

    // What clients write, listen to and call.
    let (weather_injections, [weather_injected], []) = buffer([]);
    let (garden_injections, [garden_injected], []) = buffer([]);

    let weather = Cycler::new(
        weather::WEATHER,
        weather::Weather {
            nodes: cyclers::weather::Nodes::new()?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: weather_injected,
            own: Swap::default(),
            parameters: parameters_for_weather,
        },
        weather_writer,
        start.clock.clone(),
    );

    let garden = Cycler::new(
        garden::GARDEN,
        garden::Garden {
            nodes: cyclers::garden::Nodes::new()?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: garden_injected,
            own: Swap::default(),
            parameters: parameters_for_garden,
            weather: weather_for_garden,
        },
        garden_writer,
        start.clock.clone(),
    );

    Ok(Robot {
        name: "sprinkler",
        clock: start.clock.clone(),
        instances: vec![Box::new(weather), Box::new(garden)],
        access: vec![
            Access {
                instance: "Weather",
                subscriptions: Subscriptions::new(&[]),
                injector: Box::new(Injector::new(weather_injections)),
                procedures: Vec::new(),
            },
            Access {
                instance: "Garden",
                subscriptions: Subscriptions::new(&[]),
                injector: Box::new(Injector::new(garden_injections)),
                procedures: Vec::new(),
            },
        ],
        left_out: &[],
        remotes: Vec::new(),
        parameters: LiveParameters::new(parameters, start.parameters, start.clock),
    })
}
