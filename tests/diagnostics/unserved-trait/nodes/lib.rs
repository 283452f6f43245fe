pub mod planner;
pub mod sender;

use framework::Result;

pub struct Hardware;

pub trait Motors {
    fn write(&self, speed: f32) -> Result<()>;
}

impl framework::Hardware for Hardware {}
