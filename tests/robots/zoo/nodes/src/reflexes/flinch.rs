//! The second consumer of an eye, and a reader of another real-time cycler.

use framework::{HardwareInterface, Input, LatestInput, PerceptionInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::LampInterface;
use crate::types::{Pose, Spot};

#[derive(Deserialize, Serialize)]
pub struct Flinch;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    pressed: Input<bool, "pressed">,
    bottom: PerceptionInput<Vec<Spot>, "VisionBottom", "spots">,
    pose: LatestInput<Pose, "Control", "pose">,
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {}

impl Flinch {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext<impl LampInterface>) -> Result<MainOutputs> {
        let dazzled = context
            .bottom
            .transient
            .iter()
            .any(|(_, spots)| spots.len() > 2);
        if *context.pressed || dazzled {
            context
                .hardware_interface
                .write_brightness(context.pose.map_or(0.0, |pose| pose.value.heading));
        }
        Ok(MainOutputs {})
    }
}
