//! Messages whose CDR is that of a value.
//!
//! A struct is a message; what is none is a message with the one field `data`. What ROS 2 cannot put into a field (a list of
//! lists, tuples) is a message of its own, which adds no byte.

use super::names;
use crate::Result;
use crate::layout::{Field as LayoutField, Layout, Part};

/// A message.
#[derive(Clone, Debug, Eq, PartialEq)]
pub(crate) struct Message {
    /// `zoo_interfaces/msg/Pose`.
    pub(crate) name: String,
    pub(crate) constants: Vec<Constant>,
    pub(crate) fields: Vec<Field>,
}

/// A variant of an enum.
#[derive(Clone, Debug, Eq, PartialEq)]
pub(crate) struct Constant {
    pub(crate) name: String,
    pub(crate) value: usize,
}

#[derive(Clone, Debug, Eq, PartialEq)]
pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) kind: Kind,
    pub(crate) many: Many,
}

#[derive(Clone, Debug, Eq, PartialEq)]
pub(crate) enum Kind {
    /// As .msg files write it.
    Base(&'static str),
    /// Full name of a message.
    Message(String),
}

#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(crate) enum Many {
    One,
    Array(usize),
    AtMost(usize),
    Any,
}

/// A message with all that it is made of, in the order in which they were found.
#[derive(Clone, Debug, Eq, PartialEq)]
pub(crate) struct Definition {
    pub(crate) root: Message,
    pub(crate) nested: Vec<Message>,
}

impl Definition {
    /// Of values of this layout: `name` is the message's full name, `stem` begins the names of those that it is made of.
    ///
    /// # Errors
    /// If the value contains its own type.
    pub(crate) fn new(layout: &Layout, name: &str, stem: &str) -> Result<Self> {
        let package = name.split('/').next().unwrap_or_default();
        let mut builder = Builder {
            package,
            taken: vec![stem.to_owned()],
            nested: Vec::new(),
        };
        let root = builder.message(name.to_owned(), stem, &layout.root)?;
        Ok(Self {
            root,
            nested: builder.nested,
        })
    }
}

struct Builder<'name> {
    package: &'name str,
    /// Names of messages, without their package.
    taken: Vec<String>,
    nested: Vec<Message>,
}

impl Builder<'_> {
    fn message(&mut self, name: String, stem: &str, part: &Part) -> Result<Message> {
        let mut message = Message {
            name,
            constants: Vec::new(),
            fields: Vec::new(),
        };
        match part {
            part if part.is_empty() => {}
            Part::Struct { fields } => {
                for LayoutField {
                    name,
                    layout,
                    optional,
                } in fields
                {
                    self.field(&mut message, stem, name, layout, *optional)?;
                }
            }
            Part::Tuple { items } => {
                for (index, item) in items.iter().enumerate() {
                    self.field(&mut message, stem, &format!("item{index}"), item, false)?;
                }
            }
            part => self.field(&mut message, stem, "data", part, false)?,
        }
        Ok(message)
    }

    fn field(
        &mut self,
        message: &mut Message,
        stem: &str,
        name: &str,
        part: &Part,
        is_optional: bool,
    ) -> Result<()> {
        let taken: Vec<&str> = message.fields.iter().map(|it| it.name.as_str()).collect();
        let name = names::field(name, &taken);
        let below = format!("{stem}{}", names::camel(&name));
        let (part, many) = match part {
            part if is_optional => (part, Many::AtMost(1)),
            Part::Option { content } => (&**content, Many::AtMost(1)),
            Part::List { item } => (&**item, Many::Any),
            Part::Array { item, length } if *length > 0 => (&**item, Many::Array(*length)),
            part => (part, Many::One),
        };
        let kind = self.kind(&mut message.constants, &name, &below, part)?;
        message.fields.push(Field { name, kind, many });
        Ok(())
    }

    fn kind(
        &mut self,
        constants: &mut Vec<Constant>,
        field: &str,
        below: &str,
        part: &Part,
    ) -> Result<Kind> {
        if !part.is_empty()
            && let Some(base) = base(part)
        {
            if let Part::Enum { variants } = part {
                for (value, variant) in variants.iter().enumerate() {
                    let taken: Vec<&str> = constants.iter().map(|it| it.name.as_str()).collect();
                    let name = names::constant(field, &variant.name, &taken);
                    constants.push(Constant { name, value });
                }
            }
            return Ok(Kind::Base(base));
        }
        if matches!(part, Part::Reference { .. }) {
            return Err(format!(
                "`{field}` contains its own type, which no message of ROS 2 can: name a part of it, or write `encoding = \"json\"`"
            ));
        }
        let taken: Vec<&str> = self.taken.iter().map(String::as_str).collect();
        let stem = names::message(below, &taken);
        self.taken.push(stem.clone());
        let name = format!("{}/msg/{stem}", self.package);
        let message = self.message(name.clone(), &stem, part)?;
        self.nested.push(message);
        Ok(Kind::Message(name))
    }
}

/// The name of a kind of values that has no parts.
fn base(part: &Part) -> Option<&'static str> {
    Some(match part {
        Part::Bool => "bool",
        Part::Float { bits: 32 } => "float32",
        Part::Float { .. } => "float64",
        Part::Signed { bits: 8 } => "int8",
        Part::Signed { bits: 16 } => "int16",
        Part::Signed { bits: 32 } => "int32",
        Part::Signed { .. } => "int64",
        Part::Unsigned { bits: 8 } => "uint8",
        Part::Unsigned { bits: 16 } => "uint16",
        Part::Unsigned { bits: 32 } => "uint32",
        Part::Unsigned { .. } => "uint64",
        Part::Text => "string",
        Part::Enum { .. } => "uint32",
        _ => return None,
    })
}
