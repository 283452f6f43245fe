//! What cycler `Reflexes` writes, and what its nodes see.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::Answerer;
use framework::Consumer;
use framework::Cycle;
use framework::Horizon;
use framework::Injection;
use framework::InjectionCell;
use framework::InjectionTable;
use framework::Reflect;
use framework::View;
use framework::recorded::Outputs;
use serde::Deserialize;
use serde::Serialize;

use crate::databases::control;
use crate::databases::vision;
use crate::parameters::ABReflexesInstance;
use crate::parameters::ABReflexesInstance2;
use crate::parameters::Parameters;

/// Main outputs that only nodes of `Reflexes` read: they stay with the instance.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct OwnOutputs {
    /// zoo_nodes::reflexes::bumper
    pub pressed: bool,
    /// zoo_nodes::reflexes::create
    pub sum: usize,
}

/// Values of clients in place of main outputs.
#[derive(Clone, Debug, Default, Deserialize, Outputs, Serialize)]
pub struct Injections {
    pub pressed: Injection<bool>,
    pub sum: Injection<usize>,
}

impl InjectionTable for Injections {
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
        match output {
            "pressed" => Some(&mut self.pressed),
            "sum" => Some(&mut self.sum),
            _ => None,
        }
    }
}

/// Calls that nodes answer, at most one of each in a cycle.
pub struct Procedures {
    /// zoo_nodes::reflexes::node
    pub type_: Answerer<usize, usize>,
}

/// Perception instances in one order of time.
pub struct Perception {
    pub horizon: Horizon,
    pub vision_bottom: Consumer<vision::SharedOutputs>,
}

/// The newest finished cycle of other instances.
#[derive(Clone, Copy)]
pub struct Latest<'a> {
    pub control: View<'a, control::SharedOutputs>,
}

/// Everything the nodes of one cycle may touch, borrowed.
pub struct Frame<'a, Hardware> {
    pub cycle: Cycle,
    pub hardware_interface: &'a Arc<Hardware>,
    pub injections: Option<&'a Injections>,
    pub instance_a_b: &'a ABReflexesInstance,
    pub instance_a_b2: &'a ABReflexesInstance2,
    pub latest: Latest<'a>,
    pub own: &'a mut OwnOutputs,
    pub parameters: &'a Parameters,
    pub perception: &'a Perception,
    pub procedures: &'a mut Procedures,
}
