//! Elementary functions: the same bits wherever this test runs, and right.

use framework::Digest;
use framework::math::{self, Float};
use nalgebra::{ComplexField, RealField};

/// Numbers that functions take: both signs, small and large, whole and in between.
fn numbers() -> impl Iterator<Item = f64> {
    (-400..=400).map(|step: i32| {
        let near = f64::from(step) * 0.0173;
        near * (1.0 + near * near)
    })
}

/// Of one function of one or two numbers, in both widths.
struct Function {
    name: &'static str,
    narrow: fn(f32, f32) -> f32,
    wide: fn(f64, f64) -> f64,
    of_std: fn(f64, f64) -> f64,
    of_nalgebra: fn(f64, f64) -> f64,
    digest: &'static str,
}

macro_rules! functions {
    ($($name:ident, $trait:ident $(, $second:ident)? => $digest:literal;)+) => {
        [$(Function {
            name: stringify!($name),
            #[allow(
                unused_variables,
                clippy::allow_attributes,
                reason = "half of the functions have no second argument"
            )]
            narrow: |one, other| math::$name(one $(, { let $second = other; $second })?),
            #[allow(
                unused_variables,
                clippy::allow_attributes,
                reason = "half of the functions have no second argument"
            )]
            wide: |one, other| math::$name(one $(, { let $second = other; $second })?),
            #[allow(
                unused_variables,
                clippy::allow_attributes,
                reason = "half of the functions have no second argument"
            )]
            of_std: |one, other| f64::$name(one $(, { let $second = other; $second })?),
            #[allow(
                unused_variables,
                clippy::allow_attributes,
                reason = "half of the functions have no second argument"
            )]
            of_nalgebra: |one, other| <f64 as $trait>::$name(one $(, { let $second = other; $second })?),
            digest: $digest,
        }),+]
    };
}

/// Digests are those of a processor with fused multiply-add and of an emulated one without.
fn functions() -> [Function; 20] {
    functions! {
        sin, ComplexField => "19da71df74308a15";
        cos, ComplexField => "a2e9477ceee7888d";
        tan, ComplexField => "de32fe7cb23eb361";
        asin, ComplexField => "c0c6e5dc2d30ace5";
        acos, ComplexField => "d295bd3f4b730353";
        atan, ComplexField => "611e4448b69496b1";
        atan2, RealField, x => "6b31261183c5ff9d";
        sinh, ComplexField => "4871b5276ee25bcd";
        cosh, ComplexField => "c0331be06c4bb6a5";
        tanh, ComplexField => "46f2efd219812ee1";
        exp, ComplexField => "9e043a1a57d22e0c";
        exp2, ComplexField => "9841ced0265da304";
        exp_m1, ComplexField => "ea7cb93c975ef392";
        ln, ComplexField => "846fa084b53fc7fc";
        ln_1p, ComplexField => "42f795f37471e0e7";
        log2, ComplexField => "3ae37afd8bb22851";
        log10, ComplexField => "06c103c675e94e8b";
        powf, ComplexField, exponent => "7d52f63b9cf59bf1";
        cbrt, ComplexField => "76fa29e8b5f307c1";
        hypot, ComplexField, y => "bde197fae7d599b8";
    }
}

#[test]
fn results_are_the_bits_that_stand_here_on_every_machine() {
    let found: Vec<_> = functions()
        .iter()
        .map(|function| {
            let mut digest = Digest::new();
            for number in numbers() {
                let narrow = (function.narrow)(number as f32, 1.7);
                let wide = (function.wide)(number, 1.7);
                // Which of its bits a NaN has is left open by IEEE 754.
                let narrow = if narrow.is_nan() { f32::NAN } else { narrow };
                let wide = if wide.is_nan() { f64::NAN } else { wide };
                digest.add(&(narrow, wide)).unwrap();
            }
            (function.name, digest.to_string())
        })
        .collect();
    let expected: Vec<_> = functions()
        .iter()
        .map(|function| (function.name, function.digest.to_owned()))
        .collect();
    assert_eq!(found, expected, "{found:#?}");
}

#[test]
fn results_are_near_those_of_std() {
    for function in functions() {
        for number in numbers() {
            let (ours, theirs) = ((function.wide)(number, 1.7), (function.of_std)(number, 1.7));
            let is_near = ours == theirs
                || ours.is_nan() && theirs.is_nan()
                || (ours - theirs).abs() <= 1e-14 * theirs.abs();
            assert!(
                is_near,
                "{}({number}) is {ours}, std says {theirs}",
                function.name
            );
            // The narrow one takes the number as it can have it.
            let number = number as f32;
            let theirs = (function.of_std)(f64::from(number), f64::from(1.7_f32)) as f32;
            let ours = (function.narrow)(number, 1.7);
            let is_near = ours == theirs
                || ours.is_nan() && theirs.is_nan()
                || (ours - theirs).abs() <= 5e-7 * theirs.abs();
            assert!(
                is_near,
                "{}({number}) is {ours}, std says {theirs}",
                function.name
            );
        }
    }
}

#[test]
fn nalgebra_computes_with_the_same_functions() {
    for function in functions() {
        for number in numbers() {
            let ours = (function.wide)(number, 1.7);
            let theirs = (function.of_nalgebra)(number, 1.7);
            let is_same = ours.to_bits() == theirs.to_bits() || ours.is_nan() && theirs.is_nan();
            assert!(is_same, "{}({number}): {ours}, {theirs}", function.name);
        }
    }
}

#[test]
fn whole_exponents_multiply() {
    fn check<T: Float + PartialEq + std::fmt::Debug>(base: T) {
        let one = T::from(1_u8);
        let square = base * base;
        assert_eq!(math::powi(base, 0), one);
        assert_eq!(math::powi(base, 1), base);
        assert_eq!(math::powi(base, 2), square);
        assert_eq!(math::powi(base, 3), base * square);
        assert_eq!(math::powi(base, 6), square * (square * square));
        assert_eq!(math::powi(base, -1), one / base);
        assert_eq!(math::powi(base, -2), one / square);
    }
    check(1.37_f32);
    check(-0.123_456_789_f64);
    assert_eq!(math::powi(1.0_f64, i32::MIN), 1.0);
    assert_eq!(math::powi(2.0_f64, i32::MIN), 0.0);
    assert_eq!(math::powi(2.0_f64, 1023), 2.0_f64.powi(1023));
}

#[test]
fn sine_and_cosine_come_together() {
    for number in numbers() {
        assert_eq!(
            math::sin_cos(number),
            (math::sin(number), math::cos(number))
        );
    }
}
