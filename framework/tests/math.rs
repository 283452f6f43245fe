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
        sin, ComplexField => "6bf420292e90f302";
        cos, ComplexField => "4935913dce095257";
        tan, ComplexField => "10f94504b2dab3c7";
        asin, ComplexField => "4f7f0721b950cf02";
        acos, ComplexField => "507988b55f7f0256";
        atan, ComplexField => "9d22cc99dbf022d5";
        atan2, RealField, x => "054435bf2052ff09";
        sinh, ComplexField => "7a31d30cef2a7151";
        cosh, ComplexField => "ff51805f2297e856";
        tanh, ComplexField => "1da6badfcec64acc";
        exp, ComplexField => "469502d7304c9965";
        exp2, ComplexField => "c0dac9b493c448d5";
        exp_m1, ComplexField => "629806460217cc16";
        ln, ComplexField => "8c4fe54b92599ce7";
        ln_1p, ComplexField => "6d1e2d37f343234d";
        log2, ComplexField => "26847418bf7e16c6";
        log10, ComplexField => "23e6f30a2d6c5f59";
        powf, ComplexField, exponent => "2c898d7feda16310";
        cbrt, ComplexField => "1a906ceea957abed";
        hypot, ComplexField, y => "a1d9fe52aff48b55";
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
