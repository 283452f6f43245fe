//! The network of `vision::ball_detection` with its gradients, in the same layout.

use vision::ball_detection::patch::SIDE;

const FIRST: usize = 8;
const SECOND: usize = 16;
const DENSE: usize = 16;
const KERNEL: usize = 9;
const POOLED: usize = (SIDE - 2) / 2;
const FLAT: usize = (POOLED - 2) / 2 * ((POOLED - 2) / 2) * SECOND;

/// A convolution with ReLU and the maximum of each 2 x 2.
#[derive(Clone, Copy)]
struct Convolution {
    /// Where its weights begin.
    offset: usize,
    inputs: usize,
    outputs: usize,
    /// Of its input.
    side: usize,
}

const CONVOLUTIONS: [Convolution; 2] = [
    Convolution {
        offset: 0,
        inputs: 1,
        outputs: FIRST,
        side: SIDE,
    },
    Convolution {
        offset: KERNEL * FIRST + FIRST,
        inputs: FIRST,
        outputs: SECOND,
        side: POOLED,
    },
];
const DENSE_AT: usize = KERNEL * FIRST + FIRST + KERNEL * FIRST * SECOND + SECOND;
const LAST_AT: usize = DENSE_AT + FLAT * DENSE + DENSE;
/// How many weights there are.
pub(crate) const COUNT: usize = LAST_AT + DENSE + 1;

/// What a convolution gave, and which of the four pixels it came from; none where ReLU said 0.
struct Pooled {
    values: Vec<f32>,
    from: Vec<Option<usize>>,
}

impl Convolution {
    fn pooled(&self) -> usize {
        (self.side - 2) / 2
    }

    fn weight(&self, place: usize, input: usize, output: usize) -> usize {
        self.offset + (place * self.inputs + input) * self.outputs + output
    }

    fn bias(&self, output: usize) -> usize {
        self.weight(KERNEL, 0, output)
    }

    /// The pixel of the input below a place of the kernel, if that is at this place of the image.
    fn pixel(&self, at: usize, place: usize) -> usize {
        at + place / 3 * self.side + place % 3
    }

    /// Where the kernel is for one of the four of a pooled pixel.
    fn corner(&self, index: usize, which: usize) -> usize {
        let (row, column) = (index / self.pooled() * 2, index % self.pooled() * 2);
        (row + which / 2) * self.side + column + which % 2
    }

    fn forward(&self, weights: &[f32], image: &[f32]) -> Pooled {
        let count = self.pooled() * self.pooled();
        let mut pooled = Pooled {
            values: vec![0.0; count * self.outputs],
            from: vec![None; count * self.outputs],
        };
        let mut sums = vec![0.0; self.outputs];
        for index in 0..count {
            for which in 0..4 {
                let at = self.corner(index, which);
                sums.copy_from_slice(&weights[self.bias(0)..self.bias(0) + self.outputs]);
                for place in 0..KERNEL {
                    for input in 0..self.inputs {
                        let value = image[self.pixel(at, place) * self.inputs + input];
                        let kernel = &weights[self.weight(place, input, 0)..][..self.outputs];
                        for (sum, weight) in sums.iter_mut().zip(kernel) {
                            *sum += value * weight;
                        }
                    }
                }
                for (output, sum) in sums.iter().enumerate() {
                    let cell = index * self.outputs + output;
                    if *sum > pooled.values[cell] {
                        (pooled.values[cell], pooled.from[cell]) = (*sum, Some(at));
                    }
                }
            }
        }
        pooled
    }

    /// Adds to the gradients of the weights; gives that of the image.
    fn backward(
        &self,
        weights: &[f32],
        image: &[f32],
        pooled: &Pooled,
        by: &[f32],
        gradient: &mut [f32],
    ) -> Vec<f32> {
        let mut by_image = vec![0.0; image.len()];
        for (cell, (by, from)) in by.iter().zip(&pooled.from).enumerate() {
            let (Some(at), output) = (from, cell % self.outputs) else {
                continue;
            };
            gradient[self.bias(output)] += by;
            for place in 0..KERNEL {
                for input in 0..self.inputs {
                    let pixel = self.pixel(*at, place) * self.inputs + input;
                    let weight = self.weight(place, input, output);
                    gradient[weight] += by * image[pixel];
                    by_image[pixel] += by * weights[weight];
                }
            }
        }
        by_image
    }
}

/// The logarithm of the odds of a ball, and what `gradient_of` multiplies to its derivative, added to `gradient`.
pub(crate) fn learn(
    weights: &[f32],
    image: &[f32],
    gradient_of: impl Fn(f32) -> f32,
    gradient: &mut [f32],
) -> f32 {
    let [one, two] = CONVOLUTIONS;
    let first = one.forward(weights, image);
    let second = two.forward(weights, &first.values);
    let mut neurons = weights[DENSE_AT + FLAT * DENSE..LAST_AT].to_vec();
    for (index, value) in second.values.iter().enumerate() {
        let kernel = &weights[DENSE_AT + index * DENSE..][..DENSE];
        for (neuron, weight) in neurons.iter_mut().zip(kernel) {
            *neuron += value * weight;
        }
    }
    neurons
        .iter_mut()
        .for_each(|neuron| *neuron = neuron.max(0.0));
    let last = &weights[LAST_AT..LAST_AT + DENSE];
    let odds = neurons
        .iter()
        .zip(last)
        .map(|(neuron, weight)| neuron * weight);
    let odds = weights[LAST_AT + DENSE] + odds.sum::<f32>();
    let by = gradient_of(odds);
    if by == 0.0 {
        return odds;
    }
    gradient[LAST_AT + DENSE] += by;
    let mut by_flat = vec![0.0; FLAT];
    for neuron in 0..DENSE {
        gradient[LAST_AT + neuron] += by * neurons[neuron];
        if neurons[neuron] == 0.0 {
            continue;
        }
        let by_neuron = by * weights[LAST_AT + neuron];
        gradient[DENSE_AT + FLAT * DENSE + neuron] += by_neuron;
        for (index, by_flat) in by_flat.iter_mut().enumerate() {
            let weight = DENSE_AT + index * DENSE + neuron;
            gradient[weight] += by_neuron * second.values[index];
            *by_flat += by_neuron * weights[weight];
        }
    }
    let by_first = two.backward(weights, &first.values, &second, &by_flat, gradient);
    one.backward(weights, image, &first, &by_first, gradient);
    odds
}

/// Small and of both signs, as He et al. (2015) choose them; biases are 0.
pub(crate) fn beginning(mut normal: impl FnMut() -> f32) -> Vec<f32> {
    let mut weights = vec![0.0; COUNT];
    for convolution in CONVOLUTIONS {
        let fan_in = KERNEL * convolution.inputs;
        let scale = (2.0 / fan_in as f32).sqrt();
        weights[convolution.offset..convolution.bias(0)].fill_with(|| scale * normal());
    }
    let scale = (2.0 / FLAT as f32).sqrt();
    weights[DENSE_AT..DENSE_AT + FLAT * DENSE].fill_with(|| scale * normal());
    let scale = (1.0 / DENSE as f32).sqrt();
    weights[LAST_AT..LAST_AT + DENSE].fill_with(|| scale * normal());
    weights
}
