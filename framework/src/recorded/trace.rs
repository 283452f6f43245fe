//! How a type is laid out, by asking what its own `Deserialize` asks for.
//!
//! A type is read again and again out of nothing. Each time tells what was not known before: another variant of an enum, what
//! stands behind a part that contains itself. Where a field of a struct refuses all that it is offered, those behind it are read
//! alone.

mod access;
#[cfg(test)]
mod tests;

use std::cell::Cell;
use std::fmt;

use hulkgen_mcap::Layout;
use hulkgen_mcap::layout::{Enum, Struct};
use serde::de::{DeserializeOwned, Deserializer, Visitor};

use crate::guarded::contain;

use access::{Elements, Entries, Fields, Variant, visit_fields};

/// How often nothing new may come of it before it is given up: types that refuse some values are offered others, and where
/// several parts are not known each has its turn. Two values times the turns of some parts inside of each other.
const PATIENCE: usize = 64;

/// How often at all: variants inside of variants.
const PASSES: usize = 4096;

/// How values of a type lie in a recording; parts of it are unknown where the type refuses what it is offered.
pub(crate) fn layout_of<T: DeserializeOwned>() -> Layout {
    let mut layout = Layout::Unknown;
    let mut numbers = 0..PASSES;
    for alone in [false, true] {
        let mut idle = 0;
        while idle <= PATIENCE && !layout.is_known() {
            let Some(number) = numbers.next() else {
                return layout;
            };
            let pass = Pass {
                is_odd: !number.is_multiple_of(2),
                turns: Cell::new(number / 2),
                alone,
                learned: Cell::new(false),
            };
            let tracer = Tracer {
                layout: &mut layout,
                pass: &pass,
                around: None,
            };
            // A type's own `Deserialize` may refuse what it is offered by a panic; that is its author's, and no robot ends by it.
            let _ = contain("a type's layout", || Ok(T::deserialize(tracer).is_ok()));
            idle = if pass.learned.get() { 0 } else { idle + 1 };
        }
    }
    layout
}

/// One time that the type is read.
struct Pass {
    /// What numbers are now: some types refuse 0.
    is_odd: bool,
    /// Of this number each choice takes its share, so that no choice goes with another one for ever.
    turns: Cell<usize>,
    /// Whether structs that are not known whole read one of their fields alone.
    alone: bool,
    /// Whether it told anything.
    learned: Cell<bool>,
}

impl Pass {
    /// Whose turn it is of so many, which is 0 if there are none.
    fn turn(&self, of: usize) -> usize {
        let (turns, of) = (self.turns.get(), of.max(1));
        self.turns.set(turns / of);
        turns % of
    }
}

/// The place of one part.
struct Tracer<'t> {
    layout: &'t mut Layout,
    pass: &'t Pass,
    around: Option<&'t Around<'t>>,
}

/// A struct or enum around a part: its name, and those of its fields or variants.
struct Around<'t> {
    name: &'static str,
    members: &'static [&'static str],
    around: Option<&'t Around<'t>>,
}

impl<'t> Tracer<'t> {
    /// What is known of the part; `first` if that is nothing.
    fn learn(self, first: impl FnOnce() -> Layout) -> (&'t mut Layout, &'t Pass) {
        if *self.layout == Layout::Unknown {
            *self.layout = first();
            self.pass.learned.set(true);
        }
        (self.layout, self.pass)
    }

    /// A part without parts.
    fn leaf(self, layout: Layout) -> bool {
        self.learn(|| layout).1.is_odd
    }

    /// How far up the same struct or enum stands.
    fn again(&self, name: &str, members: &'static [&'static str]) -> Option<usize> {
        let mut next = self.around;
        for up in 1.. {
            let around = next?;
            // Most types have their own list of names; a type parameter alone may make a difference that is not seen.
            if around.name == name && std::ptr::eq(around.members, members) && !members.is_empty() {
                return Some(up);
            }
            next = around.around;
        }
        None
    }
}

/// Why a part cannot be read out of nothing.
#[derive(Debug)]
struct Refused;

impl fmt::Display for Refused {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("there is nothing")
    }
}

impl std::error::Error for Refused {}

impl serde::de::Error for Refused {
    fn custom<T: fmt::Display>(_: T) -> Self {
        Self
    }
}

macro_rules! numbers {
    ($($function:ident $visit:ident $layout:expr, $type:ty;)*) => {
        $(fn $function<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
            let one = self.leaf($layout);
            visitor.$visit(<$type>::from(u8::from(one)))
        })*
    };
}

impl<'de> Deserializer<'de> for Tracer<'_> {
    type Error = Refused;

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        let one = self.leaf(Layout::Bool);
        visitor.visit_bool(one)
    }

    numbers! {
        deserialize_u8 visit_u8 Layout::Unsigned(8), u8;
        deserialize_u16 visit_u16 Layout::Unsigned(16), u16;
        deserialize_u32 visit_u32 Layout::Unsigned(32), u32;
        deserialize_u64 visit_u64 Layout::Unsigned(64), u64;
        deserialize_u128 visit_u128 Layout::Unsigned(128), u128;
        deserialize_i16 visit_i16 Layout::Signed(16), i16;
        deserialize_i32 visit_i32 Layout::Signed(32), i32;
        deserialize_i64 visit_i64 Layout::Signed(64), i64;
        deserialize_i128 visit_i128 Layout::Signed(128), i128;
        deserialize_f32 visit_f32 Layout::Float(32), f32;
        deserialize_f64 visit_f64 Layout::Float(64), f64;
    }

    fn deserialize_i8<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        let one = self.leaf(Layout::Signed(8));
        visitor.visit_i8(i8::from(one))
    }

    fn deserialize_char<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        self.leaf(Layout::Character);
        visitor.visit_char('0')
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        let one = self.leaf(Layout::Text);
        visitor.visit_str(if one { "0" } else { "" })
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        self.deserialize_str(visitor)
    }

    fn deserialize_bytes<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        self.leaf(Layout::Bytes);
        visitor.visit_bytes(&[])
    }

    fn deserialize_byte_buf<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        self.deserialize_bytes(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        let around = self.around;
        match self.learn(|| Layout::Option(Box::default())) {
            (Layout::Option(inner), pass) if !inner.is_known() => visitor.visit_some(Tracer {
                layout: inner,
                pass,
                around,
            }),
            _ => visitor.visit_none(),
        }
    }

    fn deserialize_unit<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        self.leaf(Layout::Unit);
        visitor.visit_unit()
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Refused> {
        self.deserialize_unit(visitor)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Refused> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        let around = self.around;
        match self.learn(|| Layout::List(Box::default())) {
            (Layout::List(item), pass) => visitor.visit_seq(Elements {
                left: usize::from(!item.is_known()),
                item,
                pass,
                around,
            }),
            _ => Err(Refused),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(
        self,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, Refused> {
        let around = self.around;
        match self.learn(|| Layout::Tuple(vec![Layout::Unknown; length])) {
            (Layout::Tuple(items), pass) => visitor.visit_seq(Fields {
                layouts: items.iter_mut(),
                pass,
                around,
            }),
            _ => Err(Refused),
        }
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, Refused> {
        self.deserialize_tuple(length, visitor)
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        let around = self.around;
        match self.learn(|| Layout::Map(Box::default())) {
            (Layout::Map(both), pass) => visitor.visit_map(Entries {
                left: usize::from(!(both.0.is_known() && both.1.is_known())),
                both,
                pass,
                around,
            }),
            _ => Err(Refused),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refused> {
        if let Some(up) = self.again(name, fields) {
            self.leaf(Layout::Again(up));
            return Err(Refused);
        }
        let around = Around {
            name,
            members: fields,
            around: self.around,
        };
        let first = || {
            Layout::Struct(Struct {
                name: name.to_owned(),
                fields: unknown(fields),
            })
        };
        match self.learn(first) {
            (Layout::Struct(Struct { fields, .. }), pass) => {
                visit_fields(fields, pass, &around, visitor)
            }
            _ => Err(Refused),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refused> {
        if let Some(up) = self.again(name, variants) {
            self.leaf(Layout::Again(up));
            return Err(Refused);
        }
        let around = Around {
            name,
            members: variants,
            around: self.around,
        };
        let first = || {
            Layout::Enum(Enum {
                name: name.to_owned(),
                variants: unknown(variants),
            })
        };
        let (Layout::Enum(Enum { variants, .. }), pass) = self.learn(first) else {
            return Err(Refused);
        };
        let number = chosen(variants, pass);
        let Some((_, layout)) = variants.get_mut(number) else {
            return Err(Refused);
        };
        visitor.visit_enum(Variant {
            number,
            layout,
            pass,
            around: Some(&around),
        })
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Refused> {
        Err(Refused)
    }

    fn deserialize_identifier<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Refused> {
        Err(Refused)
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Refused> {
        Err(Refused)
    }

    fn is_human_readable(&self) -> bool {
        false
    }
}

fn unknown(names: &[&str]) -> Vec<(String, Layout)> {
    let names = names.iter();
    names
        .map(|name| ((*name).to_owned(), Layout::Unknown))
        .collect()
}

/// The variant that has most to tell: one that was not seen, one that is not known whole, each at its time, or one that ends.
fn chosen(variants: &[(String, Layout)], pass: &Pass) -> usize {
    let place =
        |wanted: &dyn Fn(&Layout) -> bool| variants.iter().position(|(_, layout)| wanted(layout));
    let unknown: Vec<_> = (0..variants.len())
        .filter(|number| !variants[*number].1.is_known())
        .collect();
    place(&|layout| *layout == Layout::Unknown)
        .or_else(|| unknown.get(pass.turn(unknown.len())).copied())
        .or_else(|| place(&|layout| !layout.is_recursive()))
        .unwrap_or_default()
}
