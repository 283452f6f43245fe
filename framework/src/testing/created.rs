//! A robot as its program creates it, for tests of the whole.

use std::sync::Arc;

use crate::clock::Clock;
use crate::data::ParameterData;
use crate::error::Result;
use crate::hardware::{Hardware, HardwareContext};
use crate::parameters::Layers;
use crate::report::tell_test;
use crate::robot::{Robot, Start};
use crate::stop::Stop;

/// The hardware of `target` with these options, and the robot that `create` makes on it, with the parameters of `layers`. What
/// this process tells of robots from here on, `cargo test` shows where a test fails.
///
/// # Panics
/// If a parameter is missing or does not fit, or hardware or robot cannot be created.
pub fn created<H: Hardware, P: ParameterData>(
    layers: &Layers,
    target: &str,
    options: &[&str],
    clock: &Clock,
    stop: &Stop,
    create: impl FnOnce(&Arc<H>, Start<P>) -> Result<Robot<P>>,
) -> (Arc<H>, Robot<P>) {
    tell_test();
    let parameters = layers.load().expect("the parameters are complete");
    let hardware = H::new(HardwareContext {
        options: options.iter().copied().map(str::to_owned).collect(),
        table: parameters.hardware(target).expect("a table or nothing"),
        run_folder: std::env::temp_dir(),
        clock: clock.clone(),
        stop: stop.clone(),
    });
    let hardware = Arc::new(hardware.expect("the hardware is there"));
    let start = Start {
        clock: clock.clone(),
        stop: stop.clone(),
        parameters: parameters.deserialize().expect("they fit the nodes"),
    };
    let robot = create(&hardware, start).expect("every node can be created");
    (hardware, robot)
}
