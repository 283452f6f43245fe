//! How far away a ship is: half the way of its horn's echo.

use framework::{Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

use crate::types::{Echo, Ship};

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct RangeFinder {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    echo: Input<Echo, "echo">,
    #[reflect(unit = "m/s", range = 1.0..)]
    speed_of_sound: Parameter<f32, "range_finder.speed_of_sound">,
}

#[context]
pub struct MainOutputs {
    ship: MainOutput<Ship>,
}

impl RangeFinder {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// One ship for each horn.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let ship = Ship {
            number: context.echo.number,
            distance: context.echo.delay / 2.0 * *context.speed_of_sound,
        };
        Ok(MainOutputs { ship: ship.into() })
    }
}
