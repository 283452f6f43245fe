//! `#[reflect(…)]` of a field: what people and clients should know about its value.

use std::fmt;
use std::str::FromStr;

use syn::spanned::Spanned;
use syn::{Attribute, Expr, ExprLit, Lit, LitStr, Meta, RangeLimits, UnOp};

/// What `#[reflect(…)]` of one field says.
#[derive(Clone, Debug, Default)]
pub struct Hints {
    /// `unit = "m/s"`
    pub unit: Option<LitStr>,
    /// `range = 0.0..=1.0`
    pub range: Option<Range>,
    /// `skip`
    pub skip: bool,
    /// `creation_only`
    pub creation_only: bool,
}

/// Where numbers must lie; at least one bound is there, and they are in order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub minimum: Option<f64>,
    pub maximum: Option<f64>,
    /// Whether the maximum itself is outside: `..` instead of `..=`.
    pub is_half_open: bool,
}

impl Hints {
    /// Reads all `#[reflect(…)]` among the attributes of a field.
    pub fn read(attributes: &[Attribute]) -> syn::Result<Self> {
        let mut hints = Self::default();
        let own = attributes
            .iter()
            .filter(|attribute| is_hint_attribute(attribute));
        for attribute in own {
            attribute.parse_nested_meta(|meta| {
                if meta.path.is_ident("unit") {
                    hints.unit = Some(meta.value()?.parse()?);
                } else if meta.path.is_ident("range") {
                    hints.range = Some(Range::read(&meta.value()?.parse()?)?);
                } else if meta.path.is_ident("skip") {
                    hints.skip = true;
                } else if meta.path.is_ident("creation_only") {
                    hints.creation_only = true;
                } else {
                    return Err(meta.error(
                        "expected `unit = \"…\"`, `range = 0.0..=1.0`, `skip` or `creation_only`",
                    ));
                }
                Ok(())
            })?;
        }
        Ok(hints)
    }
}

/// Whether it is a `#[reflect(…)]`.
pub fn is_hint_attribute(attribute: &Attribute) -> bool {
    attribute.path().is_ident("reflect")
}

impl Range {
    /// Whether a number lies in it; of an `f32`, whose bounds are rounded as it is, that cannot be told more exactly.
    pub fn contains(&self, number: f64) -> bool {
        #[expect(clippy::cast_possible_truncation, reason = "that is what is wanted")]
        let round = |number: f64| f64::from(number as f32);
        let is_below =
            |number: f64, maximum: f64| number < maximum || number == maximum && !self.is_half_open;
        let is_above_minimum = (self.minimum)
            .is_none_or(|minimum| number >= minimum || round(number) >= round(minimum));
        let is_below_maximum = self.maximum.is_none_or(|maximum| {
            is_below(number, maximum) || is_below(round(number), round(maximum))
        });
        is_above_minimum && is_below_maximum
    }

    fn read(expression: &Expr) -> syn::Result<Self> {
        const EXPECTED: &str = "expected a range of numbers: `0.0..=1.0`, `1..` or `..100`";
        let wrong = || syn::Error::new(expression.span(), EXPECTED);
        let Expr::Range(range) = expression else {
            return Err(wrong());
        };
        let bound = |bound: &Option<Box<Expr>>| match bound {
            Some(bound) => number(bound).ok_or_else(wrong).map(Some),
            None => Ok(None),
        };
        let read = Self {
            minimum: bound(&range.start)?,
            maximum: bound(&range.end)?,
            is_half_open: matches!(range.limits, RangeLimits::HalfOpen(_)),
        };
        match (read.minimum, read.maximum) {
            (None, None) => Err(wrong()),
            (Some(minimum), Some(maximum)) if minimum > maximum => {
                Err(syn::Error::new(expression.span(), "the range is empty"))
            }
            (Some(minimum), Some(maximum)) if minimum == maximum && read.is_half_open => {
                Err(syn::Error::new(expression.span(), "the range is empty"))
            }
            _ => Ok(read),
        }
    }
}

impl fmt::Display for Range {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(minimum) = self.minimum {
            write!(formatter, "{minimum}")?;
        }
        formatter.write_str("..")?;
        if let Some(maximum) = self.maximum {
            let equal = if self.is_half_open { "" } else { "=" };
            write!(formatter, "{equal}{maximum}")?;
        }
        Ok(())
    }
}

/// As `Display` writes it.
impl FromStr for Range {
    type Err = syn::Error;

    fn from_str(text: &str) -> syn::Result<Self> {
        Self::read(&syn::parse_str(text)?)
    }
}

fn number(expression: &Expr) -> Option<f64> {
    match expression {
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => number(&unary.expr).map(|it| -it),
        Expr::Lit(ExprLit { lit, .. }) => match lit {
            Lit::Int(number) => number.base10_parse::<f64>().ok(),
            Lit::Float(number) => number.base10_parse::<f64>().ok(),
            _ => None,
        },
        Expr::Group(group) => number(&group.expr),
        _ => None,
    }
    .filter(|number| number.is_finite())
}

/// Lines of documentation, as written behind `///`, joined; empty without any.
pub fn documentation(attributes: &[Attribute]) -> String {
    let lines = attributes
        .iter()
        .filter_map(|attribute| match &attribute.meta {
            Meta::NameValue(meta) if meta.path.is_ident("doc") => match &meta.value {
                Expr::Lit(ExprLit {
                    lit: Lit::Str(text),
                    ..
                }) => Some(text.value()),
                _ => None,
            },
            _ => None,
        });
    let lines: Vec<_> = lines.map(|line| line.trim().to_owned()).collect();
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::Hints;

    fn read(attribute: &str) -> Result<Hints, String> {
        let item = format!("struct S {{ #[reflect({attribute})] a: f32 }}");
        let item: syn::ItemStruct = syn::parse_str(&item).expect("it is a struct");
        let field = item.fields.iter().next().expect("it has a field");
        Hints::read(&field.attrs).map_err(|error| error.to_string())
    }

    #[test]
    fn ranges_are_those_of_rust() {
        for (text, minimum, maximum, is_half_open) in [
            ("range = 0.0..=1.0", Some(0.0), Some(1.0), false),
            ("range = -0.5..2", Some(-0.5), Some(2.0), true),
            ("range = 1..", Some(1.0), None, true),
            ("unit = \"m\", range = ..=1e3", None, Some(1000.0), false),
        ] {
            let range = read(text).expect(text).range.expect("it has a range");
            assert_eq!(
                (range.minimum, range.maximum, range.is_half_open),
                (minimum, maximum, is_half_open),
                "{text}"
            );
        }
    }

    #[test]
    fn numbers_at_the_bounds_are_judged_as_the_robot_does() {
        for (text, inside, outside) in [
            (
                "range = 0.1..=0.3",
                &[0.1, 0.3, f64::from(0.1_f32)][..],
                &[0.099, 0.301][..],
            ),
            ("range = 0..1", &[0.0, 0.999], &[1.0, -0.001, f64::NAN]),
            ("range = 1..", &[1.0, 1e300], &[0.999]),
        ] {
            let range = read(text).expect(text).range.expect("it has a range");
            assert_eq!(format!("range = {range}"), text);
            assert_eq!(range.to_string().parse::<super::Range>().ok(), Some(range));
            assert!(inside.iter().all(|it| range.contains(*it)), "{text}");
            assert!(!outside.iter().any(|it| range.contains(*it)), "{text}");
        }
    }

    #[test]
    fn what_is_no_range_is_told() {
        let no_range = "expected a range of numbers: `0.0..=1.0`, `1..` or `..100`";
        for (text, message) in [
            ("range = 1.0", no_range),
            ("range = ..", no_range),
            ("range = \"0.0..1.0\"", no_range),
            ("range = a..b", no_range),
            ("range = 0..=1e999", no_range),
            ("range = 2..=1", "the range is empty"),
            ("range = 1..1", "the range is empty"),
            (
                "units = \"m\"",
                "expected `unit = \"…\"`, `range = 0.0..=1.0`, `skip` or `creation_only`",
            ),
        ] {
            assert_eq!(read(text).expect_err(text), message, "{text}");
        }
    }
}
