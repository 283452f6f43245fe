//! What stands inside of lists, maps, structs and enums.

use hulkgen_mcap::Layout;
use hulkgen_mcap::layout::Struct;
use serde::de::value::{U32Deserializer, U64Deserializer};
use serde::de::{DeserializeSeed, EnumAccess, MapAccess, SeqAccess, VariantAccess, Visitor};
use serde::de::{Deserializer as _, IntoDeserializer as _};

use super::{Around, Pass, Refused, Tracer, unknown};

/// Some elements that are all alike.
pub(super) struct Elements<'t> {
    pub(super) item: &'t mut Layout,
    pub(super) left: usize,
    pub(super) pass: &'t Pass,
    pub(super) around: Option<&'t Around<'t>>,
}

/// Some keys and values.
pub(super) struct Entries<'t> {
    pub(super) both: &'t mut (Layout, Layout),
    pub(super) left: usize,
    pub(super) pass: &'t Pass,
    pub(super) around: Option<&'t Around<'t>>,
}

/// As many parts as there are layouts.
pub(super) struct Fields<'t, I> {
    pub(super) layouts: I,
    pub(super) pass: &'t Pass,
    pub(super) around: Option<&'t Around<'t>>,
}

/// One field of a struct, by its number.
struct Alone<'t> {
    number: u64,
    layout: Option<&'t mut Layout>,
    pass: &'t Pass,
    around: Option<&'t Around<'t>>,
}

/// One variant and its content.
pub(super) struct Variant<'t> {
    pub(super) number: usize,
    pub(super) layout: &'t mut Layout,
    pub(super) pass: &'t Pass,
    pub(super) around: Option<&'t Around<'t>>,
}

/// Lets a struct read its fields: all in their order, or one alone that is not known yet.
pub(super) fn visit_fields<'de, V: Visitor<'de>>(
    fields: &mut [(String, Layout)],
    pass: &Pass,
    around: &Around<'_>,
    visitor: V,
) -> Result<V::Value, Refused> {
    let unknown = (0..fields.len()).filter(|number| pass.alone && !fields[*number].1.is_known());
    let unknown: Vec<_> = unknown.collect();
    let around = Some(around);
    match unknown.get(pass.turn(unknown.len())).copied() {
        Some(number) => visitor.visit_map(Alone {
            number: number as u64,
            layout: Some(&mut fields[number].1),
            pass,
            around,
        }),
        None => visitor.visit_seq(Fields {
            layouts: fields.iter_mut().map(|(_, layout)| layout),
            pass,
            around,
        }),
    }
}

impl<'de> SeqAccess<'de> for Elements<'_> {
    type Error = Refused;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Refused> {
        if self.left == 0 {
            return Ok(None);
        }
        self.left -= 1;
        let tracer = Tracer {
            layout: self.item,
            pass: self.pass,
            around: self.around,
        };
        seed.deserialize(tracer).map(Some)
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.left)
    }
}

impl<'de> MapAccess<'de> for Entries<'_> {
    type Error = Refused;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Refused> {
        if self.left == 0 {
            return Ok(None);
        }
        self.left -= 1;
        let tracer = Tracer {
            layout: &mut self.both.0,
            pass: self.pass,
            around: self.around,
        };
        seed.deserialize(tracer).map(Some)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Refused> {
        seed.deserialize(Tracer {
            layout: &mut self.both.1,
            pass: self.pass,
            around: self.around,
        })
    }
}

impl<'de, 't, I: Iterator<Item = &'t mut Layout>> SeqAccess<'de> for Fields<'t, I> {
    type Error = Refused;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Refused> {
        let Some(layout) = self.layouts.next() else {
            return Ok(None);
        };
        let tracer = Tracer {
            layout,
            pass: self.pass,
            around: self.around,
        };
        seed.deserialize(tracer).map(Some)
    }
}

impl<'de> MapAccess<'de> for Alone<'_> {
    type Error = Refused;

    // A number: what comes in bytes has the same order, and a field may have several names.
    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Refused> {
        if self.layout.is_none() {
            return Ok(None);
        }
        let number: U64Deserializer<Refused> = self.number.into_deserializer();
        seed.deserialize(number).map(Some)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Refused> {
        seed.deserialize(Tracer {
            layout: self.layout.take().ok_or(Refused)?,
            pass: self.pass,
            around: self.around,
        })
    }
}

impl<'de> EnumAccess<'de> for Variant<'_> {
    type Error = Refused;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Refused> {
        let number: U32Deserializer<Refused> = (self.number as u32).into_deserializer();
        seed.deserialize(number).map(|value| (value, self))
    }
}

impl<'t> Variant<'t> {
    fn content(self) -> Tracer<'t> {
        Tracer {
            layout: self.layout,
            pass: self.pass,
            around: self.around,
        }
    }
}

impl<'de> VariantAccess<'de> for Variant<'_> {
    type Error = Refused;

    fn unit_variant(self) -> Result<(), Refused> {
        self.content().leaf(Layout::Unit);
        Ok(())
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Refused> {
        seed.deserialize(self.content())
    }

    fn tuple_variant<V: Visitor<'de>>(
        self,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, Refused> {
        self.content().deserialize_tuple(length, visitor)
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refused> {
        let around = Around {
            name: "",
            members: fields,
            around: self.around,
        };
        let first = || {
            Layout::Struct(Struct {
                name: String::new(),
                fields: unknown(fields),
            })
        };
        match self.content().learn(first) {
            (Layout::Struct(Struct { fields, .. }), pass) => {
                visit_fields(fields, pass, &around, visitor)
            }
            _ => Err(Refused),
        }
    }
}
