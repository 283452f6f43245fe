use framework::{MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Planner;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    speed: Parameter<f32, "planner.speed">,
}

#[context]
pub struct MainOutputs {
    speed: MainOutput<Option<f32>>,
}
