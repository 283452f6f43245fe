pub mod planner;
pub mod sender;

use framework::Result;

pub struct Hardware;

pub trait Motors {
    fn write(&self, speed: f32) -> Result<()>;
}

impl Motors for Hardware {
    fn write(&self, _speed: f32) -> Result<()> {
        Ok(())
    }
}

impl framework::Hardware for Hardware {}
