//! A cycle as drivers turn it, and robots to turn.

use std::sync::Arc;

use bench_hardware::Hardware;
use framework::{
    Clock, Finished, Hardware as _, HardwareContext, Instance, Result, Robot, Start, Stop, Waited,
    parameters,
};
use serde::de::DeserializeOwned;

/// What [`framework::Threads`] does for one cycle of an instance without observers.
#[inline]
pub(crate) fn turn(instance: &mut dyn Instance) {
    let waited = instance.wait();
    assert!(matches!(waited, Ok(Waited::Ready)), "no setup node waits");
    instance.begin();
    instance.run();
    let finished = instance.finish();
    assert!(matches!(finished, Ok(Finished::Completed)), "no node fails");
}

/// The robot that a generated crate creates, with the text of its parameter file.
pub(crate) fn robot<P: DeserializeOwned>(
    create: fn(&Arc<Hardware>, Start<P>) -> Result<Robot<P>>,
    file: &str,
) -> Result<Robot<P>> {
    let mut table: toml::Table = parameters::from_text("default.toml", file)?;
    table.remove("hardware");
    let start = Start {
        clock: Clock::wall(),
        stop: Stop::new(),
        parameters: parameters::from_table(&table)?,
    };
    let hardware = Hardware::new(HardwareContext {
        options: Vec::new(),
        table: toml::Table::new(),
        run_folder: std::env::temp_dir(),
        clock: start.clock.clone(),
        stop: start.stop.clone(),
    })?;
    create(&Arc::new(hardware), start)
}

/// Takes one instance out of a robot.
pub(crate) fn take<P>(robot: &mut Robot<P>, name: &str) -> Box<dyn Instance> {
    let mut instances = robot.instances.iter();
    let index = instances.position(|instance| instance.description().name == name);
    robot
        .instances
        .remove(index.expect("the robot has such an instance"))
}
