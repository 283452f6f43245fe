//! Tasks that do what the trivial nodes do.

use cu29::bincode::{Decode, Encode};
use cu29::prelude::*;
use serde::{Deserialize, Serialize};

/// What a task writes.
#[derive(Clone, Copy, Debug, Decode, Default, Deserialize, Encode, Reflect, Serialize)]
pub(crate) struct Block {
    values: [f32; 16],
}

/// Where data comes from.
#[derive(Reflect)]
pub(crate) struct Source {
    bias: f32,
}

/// One block of two.
#[derive(Reflect)]
pub(crate) struct Node {
    bias: f32,
}

/// Where data ends.
#[derive(Reflect)]
pub(crate) struct Sink {
    sum: f32,
}

impl Freezable for Source {}
impl Freezable for Node {}
impl Freezable for Sink {}

impl CuSrcTask for Source {
    type Resources<'r> = ();
    type Output<'m> = output_msg!(Block);

    fn new(_: Option<&ComponentConfig>, _: Self::Resources<'_>) -> CuResult<Self> {
        Ok(Self { bias: 0.25 })
    }

    fn process(&mut self, _: &CuContext, output: &mut Self::Output<'_>) -> CuResult<()> {
        output.set_payload(Block {
            values: [self.bias; 16],
        });
        Ok(())
    }
}

fn block(left: &CuMsg<Block>, right: &CuMsg<Block>, bias: f32) -> Option<Block> {
    let (left, right) = (left.payload()?, right.payload()?);
    let mut values = [0.0; 16];
    for (index, value) in values.iter_mut().enumerate() {
        *value = 0.5 * left.values[index] + 0.25 * right.values[index] + bias;
    }
    Some(Block { values })
}

impl CuTask for Node {
    type Resources<'r> = ();
    type Input<'m> = input_msg!('m, Block, Block);
    type Output<'m> = output_msg!(Block);

    fn new(_: Option<&ComponentConfig>, _: Self::Resources<'_>) -> CuResult<Self> {
        Ok(Self { bias: 0.01 })
    }

    fn process(
        &mut self,
        _: &CuContext,
        (left, right): &Self::Input<'_>,
        output: &mut Self::Output<'_>,
    ) -> CuResult<()> {
        let block = block(left, right, self.bias).ok_or("a block is missing")?;
        output.set_payload(block);
        Ok(())
    }
}

impl CuSinkTask for Sink {
    type Resources<'r> = ();
    type Input<'m> = input_msg!('m, Block, Block);

    fn new(_: Option<&ComponentConfig>, _: Self::Resources<'_>) -> CuResult<Self> {
        Ok(Self { sum: 0.0 })
    }

    fn process(&mut self, _: &CuContext, (left, right): &Self::Input<'_>) -> CuResult<()> {
        let block = block(left, right, 0.01).ok_or("a block is missing")?;
        self.sum = block.values[0];
        Ok(())
    }
}
