//! F: what 60 nodes cost at least, as calls of functions that write where the value stays.

use std::hint::black_box;

type Block = [f32; 16];

/// 61 blocks; the first is given, each other one is written from two before it.
pub(crate) struct Floor {
    biases: [f32; 61],
    blocks: Box<[Block; 61]>,
}

/// What a trivial node does; a copy for each, so that they are as far apart as nodes are.
#[inline(never)]
fn node<const INDEX: usize>(bias: &mut f32, left: &Block, right: &Block, block: &mut Block) {
    // Something of its own, else the linker makes one function of all.
    let bias = *bias + INDEX as f32 * 1.0e-6;
    for (index, value) in block.iter_mut().enumerate() {
        *value = 0.5 * left[index] + 0.25 * right[index] + bias;
    }
}

macro_rules! calls {
    ($floor:ident: $($index:literal)*) => {
        $({
            let (before, behind) = $floor.blocks.split_at_mut($index);
            node::<$index>(
                &mut $floor.biases[$index],
                &before[$index - 1],
                &before[$index / 2],
                &mut behind[0],
            );
        })*
    };
}

impl Floor {
    pub(crate) fn new() -> Self {
        Self {
            biases: std::array::from_fn(|index| 0.01 * index as f32),
            blocks: Box::new([[0.25; 16]; 61]),
        }
    }

    /// 60 calls.
    #[inline(never)]
    pub(crate) fn cycle(&mut self) {
        calls!(self: 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30
            31 32 33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59 60);
        black_box(&mut self.blocks);
    }
}
