use framework::{MainOutput, Parameter, Reflect, Result, context};
use serde::{Deserialize, Serialize};

#[derive(Clone, Debug, Serialize, Deserialize, Reflect)]
pub struct Walking {
    #[serde(alias = "velocity")]
    pub speed: f32,
}

#[derive(Deserialize, Serialize)]
pub struct Planner;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    walking: Parameter<Walking, "walking">,
}

#[context]
pub struct MainOutputs {
    speed: MainOutput<Option<f32>>,
}

impl Planner {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs { speed: Some(context.walking.speed).into() })
    }
}
