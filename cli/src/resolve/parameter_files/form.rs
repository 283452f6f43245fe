//! How serde reads the values of a type: the one truth for what is checked in files, and for what is left to the robot's
//! program.

use super::expected::{Child, Children};
use super::variants::{Variant, variants};
use super::{expected, keys};
use crate::scan::Sources;
use crate::scan::nalgebra::Geometry;
use crate::scan::types::{Definition, Resolved, Shape};

/// What a file writes for a value of a type.
#[derive(Clone, Debug)]
pub(super) enum Form {
    Boolean,
    Number {
        name: &'static str,
    },
    Whole {
        /// Of the type: `u8`.
        name: String,
        least: i128,
        greatest: i128,
        /// Whether it may be 0.
        zero: bool,
    },
    Text,
    Letter,
    /// A text that this function reads: an address.
    Address(fn(&str) -> bool),
    /// Any number of elements.
    List(Resolved),
    Repeated {
        element: Resolved,
        length: usize,
    },
    Several(Vec<Resolved>),
    /// A table with a value of this type under every key.
    Map(Resolved),
    /// A table with these keys.
    Fields {
        children: Children<'static>,
        /// An array of these does as well.
        order: Vec<Child<'static>>,
    },
    Variants(Vec<Variant>),
    /// Only serde knows.
    Unknown,
}

/// Types may contain themselves without a struct between; no honest type is deeper.
const DEEPEST: usize = 32;

impl Form {
    pub(super) fn of(data: &Resolved, sources: &Sources<'_>) -> Self {
        let mut data = bare(data).clone();
        for _ in 0..DEEPEST {
            match stand_in(&data, sources) {
                Some(found) => data = bare(&found.data).clone(),
                None => return Self::of_itself(&data, sources),
            }
        }
        Self::Unknown
    }

    /// Whatever else serde may read in its place.
    pub(super) fn of_itself(data: &Resolved, sources: &Sources<'_>) -> Self {
        match &data.shape {
            Shape::Named {
                definition: Definition::Prelude(name),
                arguments,
            } => of_prelude(name, arguments),
            Shape::Named {
                definition: Definition::Standard(path),
                arguments,
            } => of_standard(path, arguments),
            Shape::Named {
                definition: Definition::Foreign { .. },
                ..
            } => {
                Geometry::of(data).map_or(Self::Unknown, |geometry| of_geometry(geometry, sources))
            }
            Shape::Named {
                definition: Definition::Workspace(_),
                ..
            } => of_workspace(data, sources),
            Shape::Array(element, length) => match length_of(length) {
                Some(length) => Self::Repeated {
                    element: (**element).clone(),
                    length,
                },
                None => Self::Unknown,
            },
            Shape::Slice(element) => Self::List((**element).clone()),
            Shape::Tuple(parts) if !parts.is_empty() => Self::Several(parts.clone()),
            _ => Self::Unknown,
        }
    }
}

/// What serde reads in place of a type.
struct StandIn {
    data: Resolved,
    /// Not every value of it will do.
    may_refuse: bool,
}

/// As `#[serde(from = "…")]` or `#[serde(try_from = "…")]` says.
fn stand_in(data: &Resolved, sources: &Sources<'_>) -> Option<StandIn> {
    let attributes = sources.library.attributes(data)?;
    let items = keys::serde_items(attributes)?;
    let found = items
        .iter()
        .find_map(|item| match keys::name(item).as_str() {
            "from" => Some((keys::text(item)?, false)),
            "try_from" => Some((keys::text(item)?, true)),
            _ => None,
        });
    let (written, may_refuse) = found?;
    let data = sources
        .library
        .resolve_beside(data, &syn::parse_str(&written).ok()?)?;
    Some(StandIn { data, may_refuse })
}

/// Whether a function of the author's may refuse what has the right form.
pub(super) fn may_refuse(data: &Resolved, sources: &Sources<'_>) -> bool {
    let mut data = bare(data).clone();
    for _ in 0..DEEPEST {
        match stand_in(&data, sources) {
            Some(found) if found.may_refuse => return true,
            Some(found) => data = bare(&found.data).clone(),
            None => return false,
        }
    }
    true
}

/// Whether serde takes it for absent where a table does not have it.
pub(super) fn is_optional(data: &Resolved) -> bool {
    data.option_argument().is_some() || data.boxed().is_some_and(is_optional)
}

/// Whether it is a span of time, or may be one.
pub(super) fn is_duration(data: &Resolved) -> bool {
    matches!(
        &bare(data).shape,
        Shape::Named { definition: Definition::Standard(path), .. } if last(path) == "Duration"
    )
}

/// The type without what serde reads as if it were not there.
pub(super) fn bare(data: &Resolved) -> &Resolved {
    let mut data = data;
    for _ in 0..DEEPEST {
        data = match &data.shape {
            Shape::Named {
                definition: Definition::Prelude(name),
                arguments,
            } if matches!(name.as_str(), "Option" | "Box") => match arguments.as_slice() {
                [inner] => inner,
                _ => return data,
            },
            Shape::Named {
                definition: Definition::Standard(path),
                arguments,
            } if matches!(last(path), "Wrapping" | "Reverse") => match arguments.as_slice() {
                [inner] => inner,
                _ => return data,
            },
            _ => return data,
        };
    }
    data
}

fn of_prelude(name: &str, arguments: &[Resolved]) -> Form {
    match (name, arguments) {
        ("Vec", [element]) => Form::List(element.clone()),
        ("bool", []) => Form::Boolean,
        ("f32", []) => Form::Number { name: "f32" },
        ("f64", []) => Form::Number { name: "f64" },
        ("String" | "str", []) => Form::Text,
        ("char", []) => Form::Letter,
        (name, []) => whole(name, true),
        _ => Form::Unknown,
    }
}

fn of_standard(path: &str, arguments: &[Resolved]) -> Form {
    let number = Resolved::prelude;
    match (last(path), arguments) {
        ("PathBuf", []) => Form::Text,
        ("IpAddr", []) => Form::Address(is::<std::net::IpAddr>),
        ("Ipv4Addr", []) => Form::Address(is::<std::net::Ipv4Addr>),
        ("Ipv6Addr", []) => Form::Address(is::<std::net::Ipv6Addr>),
        ("SocketAddr", []) => Form::Address(is::<std::net::SocketAddr>),
        ("SocketAddrV4", []) => Form::Address(is::<std::net::SocketAddrV4>),
        ("SocketAddrV6", []) => Form::Address(is::<std::net::SocketAddrV6>),
        ("Duration", []) => record([("secs", number("u64")), ("nanos", number("u32"))]),
        ("SystemTime", []) => record([
            ("secs_since_epoch", number("u64")),
            ("nanos_since_epoch", number("u32")),
        ]),
        ("Range" | "RangeInclusive", [bound]) => {
            record([("start", bound.clone()), ("end", bound.clone())])
        }
        ("RangeFrom", [bound]) => record([("start", bound.clone())]),
        ("RangeTo", [bound]) => record([("end", bound.clone())]),
        ("BTreeSet" | "BinaryHeap" | "LinkedList" | "VecDeque", [element])
        | ("HashSet", [element, ..]) => Form::List(element.clone()),
        ("BTreeMap", [key, value]) | ("HashMap", [key, value, ..]) if is_text(key) => {
            Form::Map(value.clone())
        }
        ("NonZero", [inner]) => whole(&inner.text, false),
        (name, []) => match name.strip_prefix("NonZero") {
            Some(integer) => whole(&integer.to_ascii_lowercase(), false),
            None => Form::Unknown,
        },
        _ => Form::Unknown,
    }
}

fn of_geometry(geometry: Geometry, sources: &Sources<'_>) -> Form {
    let repeated = |element, length| Form::Repeated { element, length };
    match geometry {
        Geometry::Matrix {
            rows,
            columns,
            element,
        } => repeated(element, rows * columns),
        Geometry::Point { dimension, element } | Geometry::Shift { dimension, element } => {
            repeated(element, dimension)
        }
        Geometry::Rotation { dimension, element } => repeated(element, dimension * dimension),
        Geometry::Quaternion { element } => repeated(element, 4),
        Geometry::Complex { element } => repeated(element, 2),
        Geometry::Isometry {
            rotation,
            translation,
        } => record([("rotation", rotation), ("translation", translation)]),
        Geometry::Similarity { isometry, scaling } => {
            record([("isometry", isometry), ("scaling", scaling)])
        }
        Geometry::Unit(inner) => Form::of(&inner, sources),
    }
}

fn of_workspace(data: &Resolved, sources: &Sources<'_>) -> Form {
    if let Some(structure) = sources.library.fields(data) {
        return keys::keys(structure).map_or(Form::Unknown, |keys| Form::Fields {
            order: keys.iter().map(expected::of_key).collect(),
            children: expected::children(keys),
        });
    }
    let found = sources.library.variants(data).and_then(variants);
    found.map_or(Form::Unknown, Form::Variants)
}

/// A struct that is not the workspace's.
fn record<const FIELDS: usize>(fields: [(&str, Resolved); FIELDS]) -> Form {
    let order = fields.iter().map(|(_, data)| Child::of(data.clone()));
    let order = order.collect();
    let children = fields.map(|(name, data)| (name.to_owned(), Child::of(data)));
    Form::Fields {
        children: Children::Named(children.into_iter().collect()),
        order,
    }
}

/// TOML's integers have 64 bits with a sign.
fn whole(name: &str, zero: bool) -> Form {
    let (least, greatest) = match name {
        "i8" => (i128::from(i8::MIN), i128::from(i8::MAX)),
        "i16" => (i128::from(i16::MIN), i128::from(i16::MAX)),
        "i32" => (i128::from(i32::MIN), i128::from(i32::MAX)),
        "i64" | "i128" | "isize" => (i128::from(i64::MIN), i128::from(i64::MAX)),
        "u8" => (0, i128::from(u8::MAX)),
        "u16" => (0, i128::from(u16::MAX)),
        "u32" => (0, i128::from(u32::MAX)),
        "u64" | "u128" | "usize" => (0, i128::from(i64::MAX)),
        _ => return Form::Unknown,
    };
    Form::Whole {
        name: name.to_owned(),
        least,
        greatest,
        zero,
    }
}

/// Whether keys of a map are any texts: those of TOML are nothing else.
fn is_text(key: &Resolved) -> bool {
    matches!(key.text.as_str(), "String" | "std::path::PathBuf")
}

fn is<T: std::str::FromStr>(text: &str) -> bool {
    text.parse::<T>().is_ok()
}

fn length_of(length: &Resolved) -> Option<usize> {
    match &length.shape {
        Shape::Constant(number) => number.parse().ok(),
        _ => None,
    }
}

fn last(path: &str) -> &str {
    path.rsplit("::").next().unwrap_or(path)
}
