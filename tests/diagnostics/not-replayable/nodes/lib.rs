pub mod planner;
pub mod sender;

use framework::Result;

pub struct Hardware;

impl framework::Hardware for Hardware {}

pub trait Motors: Brakes {
    fn write(&self, speed: f32) -> Result<()>;
}

pub trait Brakes {
    fn brake(&self) -> Result<()>;
}

pub trait Sensors {
    fn read(&self) -> Result<f32>;
}

impl Sensors for Hardware {
    fn read(&self) -> Result<f32> {
        Ok(0.2)
    }
}

impl Brakes for Hardware {
    fn brake(&self) -> Result<()> {
        Ok(())
    }
}

impl Motors for Hardware {
    fn write(&self, _speed: f32) -> Result<()> {
        Ok(())
    }
}
