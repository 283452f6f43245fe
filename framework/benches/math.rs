//! What it costs that [`framework::math`] gives the same bits on every machine, beside std's functions.
//!
//! `cargo bench -p hulkgen-framework --bench math`. Rows in turns, medians of many rounds.

use std::hint::black_box;
use std::time::Instant;

use framework::math;

const ROUNDS: usize = 301;
/// Angles, shares and lengths of a robot: calls of a function per round.
const NUMBERS: usize = 1024;

/// One function, twice.
struct Pair {
    name: &'static str,
    of_std: fn(&[f32]) -> f32,
    ours: fn(&[f32]) -> f32,
}

macro_rules! pairs {
    ($($name:literal: |$number:ident| $of_std:expr, $ours:expr;)+) => {
        [$(Pair {
            name: $name,
            of_std: |numbers| numbers.iter().map(|&$number| $of_std).sum(),
            ours: |numbers| numbers.iter().map(|&$number| $ours).sum(),
        }),+]
    };
}

fn pairs() -> [Pair; 10] {
    pairs! {
        "sin": |number| number.sin(), math::sin(number);
        "sin and cos": |number| { let (sine, cosine) = number.sin_cos(); sine + cosine },
            { let (sine, cosine) = math::sin_cos(number); sine + cosine };
        "atan2": |number| number.atan2(0.7), math::atan2(number, 0.7);
        "asin": |number| (number * 0.3).asin(), math::asin(number * 0.3);
        "acos": |number| (number * 0.3).acos(), math::acos(number * 0.3);
        "exp": |number| (-number.abs()).exp(), math::exp(-number.abs());
        "powf": |number| number.abs().powf(1.5), math::powf(number.abs(), 1.5);
        "hypot": |number| number.hypot(0.7), math::hypot(number, 0.7);
        "sin, f64": |number| f64::from(number).sin() as f32, math::sin(f64::from(number)) as f32;
        "mix": |number| mix_of_std(number), mix(number);
    }
}

/// What a leg takes per cycle: six joints turned, its inverse, and a share of the filters around it.
fn mix_of_std(number: f32) -> f32 {
    let mut sum = 0.0;
    for joint in 0..6_u8 {
        let (sine, cosine) = (number + f32::from(joint)).sin_cos();
        sum += 0.1 * sine + 0.2 * cosine;
    }
    let reach = number.hypot(0.2).sqrt();
    sum += number.atan2(0.3) + (0.1 * reach).atan2(0.5) + (0.3 * number).atan2(0.2);
    sum += (0.2 * number).asin() + (0.3 * number).acos() + (0.1 * number).acos();
    sum + (-reach).exp()
}

fn mix(number: f32) -> f32 {
    let mut sum = 0.0;
    for joint in 0..6_u8 {
        let (sine, cosine) = math::sin_cos(number + f32::from(joint));
        sum += 0.1 * sine + 0.2 * cosine;
    }
    let reach = math::hypot(number, 0.2).sqrt();
    sum +=
        math::atan2(number, 0.3) + math::atan2(0.1 * reach, 0.5) + math::atan2(0.3 * number, 0.2);
    sum += math::asin(0.2 * number) + math::acos(0.3 * number) + math::acos(0.1 * number);
    sum + math::exp(-reach)
}

fn nanoseconds(function: fn(&[f32]) -> f32, numbers: &[f32]) -> f64 {
    let start = Instant::now();
    black_box(function(black_box(numbers)));
    start.elapsed().as_nanos() as f64 / numbers.len() as f64
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn main() {
    // Between the ends of a joint, in no order that a processor could foresee.
    let numbers: Vec<f32> = (0..NUMBERS)
        .map(|index| (index * 7919 % NUMBERS) as f32 / NUMBERS as f32 * 4.0 - 2.0)
        .collect();
    println!("{:12} {:>8} {:>8} {:>8}", "ns", "std", "math", "ratio");
    let pairs = pairs();
    let mut times = vec![(Vec::new(), Vec::new()); pairs.len()];
    for _ in 0..ROUNDS {
        for (pair, (of_std, ours)) in pairs.iter().zip(&mut times) {
            of_std.push(nanoseconds(pair.of_std, &numbers));
            ours.push(nanoseconds(pair.ours, &numbers));
        }
    }
    for (pair, (of_std, ours)) in pairs.iter().zip(times) {
        let (of_std, ours) = (median(of_std), median(ours));
        println!(
            "{:12} {of_std:8.2} {ours:8.2} {:8.2}",
            pair.name,
            ours / of_std
        );
    }
}
