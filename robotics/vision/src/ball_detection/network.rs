//! A small convolutional network (LeCun et al. 1998) that tells balls from everything else that is round.
//!
//! ```text
//! 16 x 16 -> 3 x 3 convolution, 8 channels, ReLU -> 14 x 14 -> maximum of 2 x 2 -> 7 x 7
//!         -> 3 x 3 convolution, 16 channels, ReLU -> 5 x 5 -> maximum of 2 x 2 -> 2 x 2
//!         -> 16 neurons, ReLU -> the logarithm of the odds of a ball
//! ```
//! `network.txt` holds the weights in this order, each layer's biases behind its weights, the channel that is computed varying
//! fastest; each line is the bits of one `f32` in hexadecimal digits, so that the file is
//! exact and still text. `network.toml` says what made them.
//!
//! Invariant: no heap, and sums in a fixed order: the same patch gives the same bits everywhere.

use framework::math;

use super::patch::{Patch, SIDE, normalized};

/// Channels of the first convolution.
const FIRST: usize = 8;
/// Channels of the second one.
const SECOND: usize = 16;
/// Neurons of the layer that sees everything.
const DENSE: usize = 16;
/// Pixels below a kernel.
const KERNEL: usize = 9;
/// Sides of what the layers give.
const CONVOLVED: usize = SIDE - 2;
const POOLED: usize = CONVOLVED / 2;
const CONVOLVED_AGAIN: usize = POOLED - 2;
const POOLED_AGAIN: usize = CONVOLVED_AGAIN / 2;
const FLAT: usize = POOLED_AGAIN * POOLED_AGAIN * SECOND;

const COUNT: usize =
    KERNEL * FIRST + FIRST + KERNEL * FIRST * SECOND + SECOND + FLAT * DENSE + DENSE + DENSE + 1;

/// Bytes of a line of the file: eight digits and its end.
const LINE: usize = 9;

static WEIGHTS: [f32; COUNT] = numbers(include_bytes!("network.txt"));

/// The probability that a patch shows a ball, 0 to 1.
pub(super) fn confidence(patch: &Patch) -> f32 {
    let image = normalized(patch);
    let mut weights = Weights(&WEIGHTS);
    let seen: [[f32; FIRST]; POOLED * POOLED] =
        layer(&image.map(|value| [value]), SIDE, &mut weights);
    let seen: [[f32; SECOND]; POOLED_AGAIN * POOLED_AGAIN] = layer(&seen, POOLED, &mut weights);
    let kernel: &[[f32; DENSE]] = weights.take(FLAT);
    let [mut neurons] = *weights.take::<DENSE>(1) else {
        unreachable!("one was taken")
    };
    let mut sums = [0.0; DENSE];
    for (value, kernel) in seen.as_flattened().iter().zip(kernel) {
        for (sum, weight) in sums.iter_mut().zip(kernel) {
            *sum += value * weight;
        }
    }
    for (neuron, sum) in neurons.iter_mut().zip(sums) {
        *neuron = (*neuron + sum).max(0.0);
    }
    let kernel: &[[f32; 1]] = weights.take(DENSE);
    let odds = neurons
        .iter()
        .zip(kernel)
        .map(|(neuron, [weight])| neuron * weight);
    let bias = weights.take::<1>(1)[0][0];
    let odds = odds.fold(bias, |sum, part| sum + part);
    1.0 / (1.0 + math::exp(-odds))
}

/// Convolution, ReLU and the maximum of each 2 x 2 of them.
fn layer<const INPUTS: usize, const OUTPUTS: usize, const PIXELS: usize>(
    image: &[[f32; INPUTS]],
    side: usize,
    weights: &mut Weights<'_>,
) -> [[f32; OUTPUTS]; PIXELS] {
    let kernel: &[[f32; OUTPUTS]] = weights.take(KERNEL * INPUTS);
    let biases = weights.take::<OUTPUTS>(1)[0];
    let pooled = (side - 2) / 2;
    let convolved = |row: usize, column: usize| {
        let mut sums = biases;
        for place in 0..KERNEL {
            let pixel = &image[(row + place / 3) * side + column + place % 3];
            let kernel = &kernel[place * INPUTS..(place + 1) * INPUTS];
            for (value, kernel) in pixel.iter().zip(kernel) {
                for (sum, weight) in sums.iter_mut().zip(kernel) {
                    *sum += value * weight;
                }
            }
        }
        sums
    };
    std::array::from_fn(|index| {
        let (row, column) = (index / pooled * 2, index % pooled * 2);
        let mut greatest = [0.0_f32; OUTPUTS];
        for (down, right) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let sums = convolved(row + down, column + right);
            for (greatest, sum) in greatest.iter_mut().zip(sums) {
                *greatest = greatest.max(sum);
            }
        }
        greatest
    })
}

/// What has not been used yet.
struct Weights<'a>(&'a [f32]);

impl<'a> Weights<'a> {
    /// The next rows of that many numbers.
    fn take<const N: usize>(&mut self, rows: usize) -> &'a [[f32; N]] {
        let (taken, left) = self.0.split_at(rows * N);
        self.0 = left;
        taken.as_chunks().0
    }
}

/// At compile time: a file of another length is no network.
const fn numbers(bytes: &[u8]) -> [f32; COUNT] {
    assert!(
        bytes.len() == LINE * COUNT,
        "network.txt has another length"
    );
    let mut numbers = [0.0; COUNT];
    let mut index = 0;
    while index < COUNT {
        let (mut bits, mut at) = (0, LINE * index);
        while at < LINE * (index + 1) - 1 {
            bits = bits << 4 | digit(bytes[at]);
            at += 1;
        }
        assert!(bytes[at] == b'\n', "network.txt has one number per line");
        numbers[index] = f32::from_bits(bits);
        index += 1;
    }
    numbers
}

const fn digit(character: u8) -> u32 {
    match character {
        b'0'..=b'9' => (character - b'0') as u32,
        b'a'..=b'f' => (character - b'a' + 10) as u32,
        _ => panic!("network.txt has hexadecimal digits"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_layer_convolves_and_takes_the_greatest() {
        // A kernel that sees its middle alone, with a weight of 2 and a bias of -1.
        let mut numbers = [0.0; KERNEL + 1];
        numbers[4] = 2.0;
        numbers[KERNEL] = -1.0;
        let image: [[f32; 1]; 36] = std::array::from_fn(|index| [index as f32]);
        let pooled: [[f32; 1]; 4] = layer(&image, 6, &mut Weights(&numbers));
        // The lower right of each 2 x 2 is the greatest: pixels 14, 16, 26 and 28.
        assert_eq!(pooled, [[27.0], [31.0], [51.0], [55.0]]);
        numbers[KERNEL] = -1000.0;
        let pooled: [[f32; 1]; 4] = layer(&image, 6, &mut Weights(&numbers));
        assert_eq!(pooled, [[0.0]; 4]);
    }

    #[test]
    fn weights_are_numbers_and_plain_grey_is_no_ball() {
        assert!(WEIGHTS.iter().all(|weight| weight.is_finite()));
        assert!(confidence(&[90; SIDE * SIDE]) < 0.5);
    }
}
