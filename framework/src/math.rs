//! Elementary functions that give the same bits on every machine.
//!
//! std's `f32::sin` and its like call the system's library, which chooses other code for a processor with fused
//! multiply-add than for one without: a recording of the robot would not verify on a laptop. These are compiled into the
//! program (the crate `libm`), as are those behind nalgebra (its feature `libm-force`).
//!
//! What IEEE 754 gives one result for is not here, since std's is the same everywhere: `+ - * /`, `sqrt`, `mul_add`, `%`,
//! `abs`, `floor`, `ceil`, `round`, `trunc`, `min`, `max`, and what is made of these, as `to_radians`.
//!
//! ```
//! use framework::math;
//!
//! let (ahead, left) = (3.0_f32, 4.0_f32);
//! assert_eq!(math::hypot(ahead, left), 5.0);
//! assert_eq!(math::atan2(0.0_f64, 1.0), 0.0);
//! ```
//!
//! Invariant: which operations are done, in which order, depends on the arguments alone, never on the processor.

/// `f32` or `f64`.
pub trait Float: private::Functions {}

impl Float for f32 {}
impl Float for f64 {}

macro_rules! functions {
    ($($(#[$documentation:meta])+ $name:ident($($argument:ident),+) = $narrow:ident, $wide:ident;)+) => {
        $(
            $(#[$documentation])+
            #[inline]
            #[must_use]
            pub fn $name<T: Float>($($argument: T),+) -> T {
                T::$name($($argument),+)
            }
        )+

        mod private {
            use std::ops::{Div, Mul};

            /// Has no path from outside, so that nobody else implements [`super::Float`].
            pub trait Functions: Copy + From<u8> + Mul<Output = Self> + Div<Output = Self> {
                $(fn $name($($argument: Self),+) -> Self;)+
            }

            impl Functions for f32 {
                $(
                    #[inline]
                    fn $name($($argument: Self),+) -> Self {
                        libm::$narrow($($argument),+)
                    }
                )+
            }

            impl Functions for f64 {
                $(
                    #[inline]
                    fn $name($($argument: Self),+) -> Self {
                        libm::$wide($($argument),+)
                    }
                )+
            }
        }
    };
}

functions! {
    /// The sine of an angle in radians.
    sin(angle) = sinf, sin;
    /// The cosine of an angle in radians.
    cos(angle) = cosf, cos;
    /// The tangent of an angle in radians.
    tan(angle) = tanf, tan;
    /// The angle in -π/2..=π/2 with this sine; NaN where there is none.
    asin(sine) = asinf, asin;
    /// The angle in 0..=π with this cosine; NaN where there is none.
    acos(cosine) = acosf, acos;
    /// The angle in -π/2..=π/2 with this tangent.
    atan(tangent) = atanf, atan;
    /// The angle in -π..=π of the direction (`x`, `y`). `y` comes first, as in std.
    atan2(y, x) = atan2f, atan2;
    /// The hyperbolic sine.
    sinh(value) = sinhf, sinh;
    /// The hyperbolic cosine.
    cosh(value) = coshf, cosh;
    /// The hyperbolic tangent.
    tanh(value) = tanhf, tanh;
    /// e to the power of `exponent`.
    exp(exponent) = expf, exp;
    /// 2 to the power of `exponent`.
    exp2(exponent) = exp2f, exp2;
    /// `exp(exponent) - 1`, exact near 0.
    exp_m1(exponent) = expm1f, expm1;
    /// The logarithm to base e; NaN below 0.
    ln(value) = logf, log;
    /// `ln(1 + value)`, exact near 0.
    ln_1p(value) = log1pf, log1p;
    /// The logarithm to base 2; NaN below 0.
    log2(value) = log2f, log2;
    /// The logarithm to base 10; NaN below 0.
    log10(value) = log10f, log10;
    /// `base` to the power of `exponent`; [`powi`] is faster where that is a small integer.
    powf(base, exponent) = powf, pow;
    /// The number whose cube is `value`.
    cbrt(value) = cbrtf, cbrt;
    /// The length of (`x`, `y`), without overflow on the way.
    hypot(x, y) = hypotf, hypot;
}

/// Sine and cosine of an angle in radians.
#[inline]
#[must_use]
pub fn sin_cos<T: Float>(angle: T) -> (T, T) {
    (sin(angle), cos(angle))
}

/// `base` to the power of `exponent`, by repeated squaring: `powi(x, 2)` is `x * x`.
///
/// The order in which std multiplies is not specified.
#[inline]
#[must_use]
pub fn powi<T: Float>(base: T, exponent: i32) -> T {
    let one = T::from(1_u8);
    let mut left = exponent.unsigned_abs();
    let mut square = base;
    let mut power = if left & 1 == 1 { base } else { one };
    while left > 1 {
        left >>= 1;
        square = square * square;
        if left & 1 == 1 {
            power = power * square;
        }
    }
    if exponent < 0 { one / power } else { power }
}
