pub mod clock;
pub mod planner;
pub mod sender;

use framework::Result;

pub struct Hardware;

pub trait Beats {
    fn wait(&self) -> Result<u32>;
}

pub trait Motors {
    fn write(&self, speed: f32) -> Result<()>;
}

impl Beats for Hardware {
    fn wait(&self) -> Result<u32> {
        Ok(1)
    }
}

impl Motors for Hardware {
    fn write(&self, _speed: f32) -> Result<()> {
        Ok(())
    }
}

impl framework::Hardware for Hardware {}
