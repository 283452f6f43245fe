//! Answers a procedure that is called like a keyword.

use framework::{Input, Procedure, Result, context};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Node;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    sum: Input<usize, "sum">,
    add: Procedure<usize, usize, "type_">,
}

#[context]
pub struct MainOutputs {}

impl Node {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        if let Some(call) = context.add {
            let sum = *context.sum + *call.request();
            call.answer(sum);
        }
        Ok(MainOutputs {})
    }
}
