//! Images as JPEG files: baseline, YCbCr 4:2:2 or gray, as ITU-T T.81 and JFIF describe them.
//!
//! Written here, because the small crates that do it have a licence that this workspace does not take.

mod tables;

use std::f32::consts::{FRAC_1_SQRT_2, PI};

use framework::reflect::{Image, Pixels};

use tables::{AC, CHROMINANCE, DC, HuffmanTable, LUMINANCE, ZIGZAG};

/// Pixels in a row and rows of a block.
const SIDE: usize = 8;

/// The last AC coefficients of a block are zero.
const END_OF_BLOCK: u8 = 0x00;

/// Sixteen zeros, and more to come.
const SIXTEEN_ZEROS: u8 = 0xf0;

/// What rounding adds to it has no code.
const LARGEST: i32 = 1023;

/// Samples, or their coefficients, row after row.
type Block = [f32; SIDE * SIDE];

/// A whole file; `None` for an image with more pixels in a row or more rows than a file can say.
///
/// `quality` from 1 (small) to 100 (good), as the tables of T.81 Annex K are commonly scaled.
pub(crate) fn encode(image: &Image, quality: u8) -> Option<Vec<u8>> {
    let width = u16::try_from(image.width).ok()?;
    let height = u16::try_from(image.height).ok()?;
    let planes = Planes::new(image);
    let tables = [scale(&LUMINANCE, quality), scale(&CHROMINANCE, quality)];
    let mut file = Vec::with_capacity(image.bytes.len() / 8);
    write_head(&mut file, width, height, planes.has_colour(), &tables);
    let mut scan = Scan::new(file, &tables);
    // Two blocks of luminance and one of each chrominance cover the same pixels; gray has single blocks.
    let step = if planes.has_colour() { 2 * SIDE } else { SIDE };
    for y in (0..image.height).step_by(SIDE) {
        for x in (0..image.width).step_by(step) {
            scan.block(&planes.luminance.block(x, y), 0);
            if let Some([blue, red]) = &planes.chrominance {
                scan.block(&planes.luminance.block(x + SIDE, y), 0);
                scan.block(&blue.block(x / 2, y), 1);
                scan.block(&red.block(x / 2, y), 2);
            }
        }
    }
    Some(scan.finish())
}

/// The components of an image.
struct Planes {
    luminance: Plane,
    /// Blue and red, half as many in a row.
    chrominance: Option<[Plane; 2]>,
}

/// One component.
struct Plane {
    width: usize,
    height: usize,
    samples: Vec<u8>,
}

impl Planes {
    fn new(image: &Image) -> Self {
        let plane = |width: usize, samples: Vec<u8>| Plane {
            width,
            height: image.height,
            samples,
        };
        let every = |offset, step| -> Vec<u8> {
            let samples = image.bytes.iter().skip(offset).step_by(step);
            samples.copied().collect()
        };
        match image.pixels {
            Pixels::Gray => Self {
                luminance: plane(image.width, image.bytes.clone()),
                chrominance: None,
            },
            Pixels::Yuyv => Self {
                luminance: plane(image.width, every(0, 2)),
                chrominance: Some([1, 3].map(|offset| plane(image.width / 2, every(offset, 4)))),
            },
            Pixels::Rgb => {
                let width = image.width.div_ceil(2);
                let [mut luminance, mut blue, mut red] = [(); 3].map(|()| Vec::new());
                for row in image.bytes.chunks_exact(3 * image.width) {
                    for pair in row.chunks(6) {
                        let (pixels, _) = pair.as_chunks::<3>();
                        let colours: Vec<_> = pixels.iter().map(|rgb| ycbcr(*rgb)).collect();
                        luminance.extend(colours.iter().map(|[y, ..]| clamp(*y)));
                        let mean = |component: usize| {
                            let sum: f32 = colours.iter().map(|colour| colour[component]).sum();
                            clamp(sum / colours.len() as f32)
                        };
                        blue.push(mean(1));
                        red.push(mean(2));
                    }
                }
                Self {
                    luminance: plane(image.width, luminance),
                    chrominance: Some([plane(width, blue), plane(width, red)]),
                }
            }
        }
    }

    fn has_colour(&self) -> bool {
        self.chrominance.is_some()
    }
}

/// Full-range BT.601, as JFIF has it.
fn ycbcr(rgb: [u8; 3]) -> [f32; 3] {
    let [red, green, blue] = rgb.map(f32::from);
    let luminance = 0.299 * red + 0.587 * green + 0.114 * blue;
    [
        luminance,
        128.0 + (blue - luminance) / 1.772,
        128.0 + (red - luminance) / 1.402,
    ]
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "it saturates"
)]
fn clamp(sample: f32) -> u8 {
    sample.round() as u8
}

impl Plane {
    /// The block whose first sample this is, around zero; behind the edges the last samples go on.
    fn block(&self, x: usize, y: usize) -> Block {
        std::array::from_fn(|index| {
            let column = (x + index % SIDE).min(self.width - 1);
            let row = (y + index / SIDE).min(self.height - 1);
            let sample = self.samples.get(row * self.width + column);
            sample.map_or(0.0, |sample| f32::from(*sample) - 128.0)
        })
    }
}

/// The common scale: 50 is Annex K, 100 keeps nearly everything.
fn scale(table: &[u8; SIDE * SIDE], quality: u8) -> [u8; SIDE * SIDE] {
    let quality = u32::from(quality.clamp(1, 100));
    let percent = if quality < 50 {
        5000 / quality
    } else {
        200 - 2 * quality
    };
    table.map(|entry| {
        let scaled = (u32::from(entry) * percent + 50) / 100;
        u8::try_from(scaled.max(1)).unwrap_or(u8::MAX)
    })
}

fn write_head(
    file: &mut Vec<u8>,
    width: u16,
    height: u16,
    has_colour: bool,
    tables: &[[u8; SIDE * SIDE]; 2],
) {
    file.extend([0xff, 0xd8]);
    // JFIF 1.1, square pixels, no preview.
    segment(file, 0xe0, b"JFIF\0\x01\x01\x00\x00\x01\x00\x01\x00\x00");
    for (number, table) in (0..).zip(tables) {
        let mut content = vec![number];
        content.extend(ZIGZAG.map(|place| table[place]));
        segment(file, 0xdb, &content);
    }
    let ([high, low], [wide, narrow]) = (height.to_be_bytes(), width.to_be_bytes());
    let mut frame = vec![8, high, low, wide, narrow];
    // Number, samples in a row and in a column beside those of the others, table.
    frame.extend_from_slice(if has_colour {
        &[3, 1, 0x21, 0, 2, 0x11, 1, 3, 0x11, 1]
    } else {
        &[1, 1, 0x11, 0]
    });
    segment(file, 0xc0, &frame);
    for (class, table) in [(0x00, &DC), (0x10, &AC)] {
        let mut content = vec![class];
        content.extend(table.lengths);
        content.extend(table.symbols);
        segment(file, 0xc4, &content);
    }
    segment(
        file,
        0xda,
        if has_colour {
            &[3, 1, 0, 2, 0, 3, 0, 0, 63, 0]
        } else {
            &[1, 1, 0, 0, 63, 0]
        },
    );
}

/// With its length, of which the length itself is part.
fn segment(file: &mut Vec<u8>, marker: u8, content: &[u8]) {
    // All of them have less than 200 bytes.
    let length = (content.len() + 2) as u16;
    file.extend([0xff, marker]);
    file.extend(length.to_be_bytes());
    file.extend(content);
}

/// The coefficients, as a stream of bits.
struct Scan {
    file: Vec<u8>,
    /// Not written yet, from the lowest bit upwards.
    bits: u64,
    pending: u32,
    /// By what coefficients are multiplied, of luminance and chrominance, row after row.
    factors: [Block; 2],
    cosines: [[f32; SIDE]; SIDE],
    dc: Codes,
    ac: Codes,
    /// The last DC coefficient of each component.
    last: [i32; 3],
}

/// Bits and how many, by symbol.
type Codes = [(u16, u32); 256];

impl Scan {
    fn new(file: Vec<u8>, tables: &[[u8; SIDE * SIDE]; 2]) -> Self {
        let norm = |index: usize| if index == 0 { FRAC_1_SQRT_2 } else { 1.0 };
        let factors = tables.map(|table| {
            std::array::from_fn(|index| {
                norm(index % SIDE) * norm(index / SIDE) / (4.0 * f32::from(table[index]))
            })
        });
        let cosine = |frequency: usize, place: usize| {
            ((2 * place + 1) as f32 * frequency as f32 * PI / 16.0).cos()
        };
        Self {
            file,
            bits: 0,
            pending: 0,
            factors,
            cosines: std::array::from_fn(|frequency| {
                std::array::from_fn(|place| cosine(frequency, place))
            }),
            dc: codes(&DC),
            ac: codes(&AC),
            last: [0; 3],
        }
    }

    fn block(&mut self, block: &Block, component: usize) {
        let coefficients = self.transform(block);
        let factors = &self.factors[component.min(1)];
        let quantised = ZIGZAG.map(|place| (coefficients[place] * factors[place]).round() as i32);
        let [first, others @ ..] = quantised;
        let difference = first - std::mem::replace(&mut self.last[component], first);
        let (size, rest) = magnitude(difference);
        self.code(self.dc[size as usize]);
        self.write(rest, size);
        let mut zeros = 0;
        for coefficient in others {
            if coefficient == 0 {
                zeros += 1;
                continue;
            }
            while zeros >= 16 {
                self.code(self.ac[usize::from(SIXTEEN_ZEROS)]);
                zeros -= 16;
            }
            let (size, rest) = magnitude(coefficient.clamp(-LARGEST, LARGEST));
            self.code(self.ac[zeros << 4 | size as usize]);
            self.write(rest, size);
            zeros = 0;
        }
        if zeros > 0 {
            self.code(self.ac[usize::from(END_OF_BLOCK)]);
        }
    }

    /// The discrete cosine transform, rows before columns, without its norm.
    fn transform(&self, block: &Block) -> Block {
        let mut rows = [0.0; SIDE * SIDE];
        for (row, out) in block.chunks_exact(SIDE).zip(rows.chunks_exact_mut(SIDE)) {
            self.transform_line(
                |place| row[place],
                |frequency, value| out[frequency] = value,
            );
        }
        let mut both = [0.0; SIDE * SIDE];
        for column in 0..SIDE {
            self.transform_line(
                |place| rows[place * SIDE + column],
                |frequency, value| both[frequency * SIDE + column] = value,
            );
        }
        both
    }

    /// Cosines are even or odd around the middle of the line, so that sums and differences of opposite samples will do.
    #[inline(always)]
    fn transform_line(&self, sample: impl Fn(usize) -> f32, mut set: impl FnMut(usize, f32)) {
        let sums: [f32; SIDE / 2] =
            std::array::from_fn(|place| sample(place) + sample(SIDE - 1 - place));
        let differences: [f32; SIDE / 2] =
            std::array::from_fn(|place| sample(place) - sample(SIDE - 1 - place));
        for (frequency, cosines) in self.cosines.iter().enumerate() {
            let half = if frequency % 2 == 0 {
                &sums
            } else {
                &differences
            };
            let products = half
                .iter()
                .zip(cosines)
                .map(|(value, cosine)| value * cosine);
            set(frequency, products.sum());
        }
    }

    fn code(&mut self, (bits, length): (u16, u32)) {
        self.write(u32::from(bits), length);
    }

    /// The lowest bits of a number, the highest of them first.
    fn write(&mut self, bits: u32, length: u32) {
        self.bits = self.bits << length | u64::from(bits);
        self.pending += length;
        while self.pending >= 8 {
            self.pending -= 8;
            let byte = (self.bits >> self.pending) as u8;
            self.file.push(byte);
            // Else it would begin a marker.
            if byte == 0xff {
                self.file.push(0);
            }
        }
    }

    fn finish(mut self) -> Vec<u8> {
        // The last byte is filled with ones.
        if self.pending > 0 {
            let missing = 8 - self.pending;
            self.write((1 << missing) - 1, missing);
        }
        self.file.extend([0xff, 0xd9]);
        self.file
    }
}

/// How many bits a coefficient has, and these; of a negative one, those of the number before it.
fn magnitude(coefficient: i32) -> (u32, u32) {
    let size = u32::BITS - coefficient.unsigned_abs().leading_zeros();
    let bits = if coefficient < 0 {
        coefficient - 1
    } else {
        coefficient
    };
    (size, bits as u32 & ((1 << size) - 1))
}

/// Codes of one length follow each other, and those that are longer behind them.
fn codes(table: &HuffmanTable) -> Codes {
    let mut codes = [(0, 0); 256];
    let mut symbols = table.symbols.iter();
    let mut next = 0;
    for (length, count) in (1..).zip(table.lengths) {
        for symbol in symbols.by_ref().take(usize::from(count)) {
            codes[usize::from(*symbol)] = (next, length);
            next += 1;
        }
        next <<= 1;
    }
    codes
}

#[cfg(test)]
mod tests;
