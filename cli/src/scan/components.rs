//! Fields of values whose types are not the workspace's: what a path may lead into, and what certainly has no field.

use super::nalgebra::Geometry;
use super::types::{Definition, Resolved, Shape};

/// What lies under a name in a value.
#[derive(Clone, Debug)]
pub enum Component {
    Field(Resolved),
    /// There is no such field, but there are these.
    Absent(Vec<String>),
    /// Left to rustc.
    Unknown,
}

/// Types of `std` that people see no field of, neither of their own nor by `Deref`.
const WITHOUT_FIELDS: &[&str] = &[
    "BTreeMap",
    "BTreeSet",
    "BinaryHeap",
    "Duration",
    "HashMap",
    "HashSet",
    "Instant",
    "IpAddr",
    "Ipv4Addr",
    "Ipv6Addr",
    "LinkedList",
    "NonZero",
    "PathBuf",
    "RangeInclusive",
    "SocketAddr",
    "SocketAddrV4",
    "SocketAddrV6",
    "SystemTime",
    "VecDeque",
];

/// The field of this name in a value that is no struct or enum of the workspace.
pub fn component(data: &Resolved, name: &str) -> Component {
    let fields = match &data.shape {
        Shape::Named {
            definition: Definition::Prelude(prelude),
            ..
        } if prelude != "Box" => Some(Vec::new()),
        Shape::Named {
            definition: Definition::Standard(path),
            arguments,
        } => of_standard(path, arguments),
        Shape::Named {
            definition: Definition::Foreign { .. },
            ..
        } => Geometry::of(data).and_then(|geometry| geometry.fields()),
        // A path has no names for their parts.
        Shape::Tuple(_) | Shape::Array(..) | Shape::Slice(_) => Some(Vec::new()),
        _ => None,
    };
    let Some(fields) = fields else {
        return Component::Unknown;
    };
    match fields.iter().find(|(field, _)| field == name) {
        Some((_, data)) => Component::Field(data.clone()),
        None => Component::Absent(fields.into_iter().map(|(field, _)| field).collect()),
    }
}

fn of_standard(path: &str, arguments: &[Resolved]) -> Option<Vec<(String, Resolved)>> {
    let field = |name: &str, data: &Resolved| (name.to_owned(), data.clone());
    match (path, arguments) {
        ("ops::Range", [bound]) => Some(vec![field("start", bound), field("end", bound)]),
        ("ops::RangeFrom", [bound]) => Some(vec![field("start", bound)]),
        ("ops::RangeTo" | "ops::RangeToInclusive", [bound]) => Some(vec![field("end", bound)]),
        _ => {
            let name = path.rsplit("::").next()?;
            let name = if name.starts_with("NonZero") {
                "NonZero"
            } else {
                name
            };
            WITHOUT_FIELDS.contains(&name).then(Vec::new)
        }
    }
}
