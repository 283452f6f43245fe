//! Whether two types are one, as far as that can be known without rustc.

use super::types::{Definition, Resolved, Shape};

/// The answer of [`compare`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    Same,
    /// Certainly different types.
    Different,
    /// Names could not be followed far enough: left to rustc.
    Unknown,
}

/// Types of nalgebra that are no aliases of each other. Others may be: `Vector3<T>` is a `Matrix3x1<T>`.
const DISTINCT_IN_NALGEBRA: &[&str] = &[
    "Isometry2",
    "Isometry3",
    "Matrix2",
    "Matrix3",
    "Matrix4",
    "Point2",
    "Point3",
    "Quaternion",
    "Rotation2",
    "Rotation3",
    "Similarity2",
    "Similarity3",
    "Translation2",
    "Translation3",
    "UnitComplex",
    "UnitQuaternion",
    "Vector2",
    "Vector3",
    "Vector4",
];

/// More types of nalgebra. They may be aliases of each other and of those above, but of nothing outside of nalgebra.
const OTHERS_OF_NALGEBRA: &[&str] = &[
    "DMatrix",
    "DVector",
    "DualQuaternion",
    "Isometry",
    "Matrix",
    "Matrix1",
    "Matrix2x3",
    "Matrix2x4",
    "Matrix3x2",
    "Matrix3x4",
    "Matrix4x2",
    "Matrix4x3",
    "Matrix5",
    "Matrix6",
    "OMatrix",
    "OPoint",
    "OVector",
    "Point",
    "Point1",
    "Point4",
    "Point5",
    "Point6",
    "Rotation",
    "RowVector2",
    "RowVector3",
    "RowVector4",
    "SMatrix",
    "SVector",
    "Similarity",
    "Translation",
    "Unit",
    "UnitDualQuaternion",
    "UnitVector2",
    "UnitVector3",
    "Vector1",
    "Vector5",
    "Vector6",
];

/// Compares two types by definitions.
pub fn compare(a: &Resolved, b: &Resolved) -> Comparison {
    use Comparison::{Different, Same, Unknown};
    match (&a.shape, &b.shape) {
        (Shape::Unknown, _) | (_, Shape::Unknown) => Unknown,
        (
            Shape::Named {
                definition: a,
                arguments: of_a,
            },
            Shape::Named {
                definition: b,
                arguments: of_b,
            },
        ) => match compare_definitions(a, b) {
            Same if of_a.len() != of_b.len() => Unknown,
            Same => compare_all(of_a, of_b),
            Different if may_be_its_argument(a, of_a) || may_be_its_argument(b, of_b) => Unknown,
            answer => answer,
        },
        // A foreign name may be an alias of a tuple or an array.
        (
            Shape::Named {
                definition: Definition::Foreign { path, .. },
                ..
            },
            _,
        )
        | (
            _,
            Shape::Named {
                definition: Definition::Foreign { path, .. },
                ..
            },
        ) if !is_of_nalgebra(path) => Unknown,
        (Shape::Tuple(a), Shape::Tuple(b)) if a.len() == b.len() => compare_all(a, b),
        (Shape::Array(a, length_of_a), Shape::Array(b, length_of_b)) => {
            both(compare(a, b), compare(length_of_a, length_of_b))
        }
        (Shape::Slice(a), Shape::Slice(b)) | (Shape::Reference(a), Shape::Reference(b)) => {
            compare(a, b)
        }
        (Shape::Constant(a), Shape::Constant(b)) if a == b => Same,
        // Of lifetimes rustc knows more.
        (Shape::Constant(a), Shape::Constant(_)) if a.starts_with('\'') && !a.ends_with('\'') => {
            Unknown
        }
        _ => Different,
    }
}

fn compare_all(a: &[Resolved], b: &[Resolved]) -> Comparison {
    let parts = a.iter().zip(b).map(|(a, b)| compare(a, b));
    parts.fold(Comparison::Same, both)
}

fn both(a: Comparison, b: Comparison) -> Comparison {
    match (a, b) {
        (Comparison::Different, _) | (_, Comparison::Different) => Comparison::Different,
        (Comparison::Unknown, _) | (_, Comparison::Unknown) => Comparison::Unknown,
        _ => Comparison::Same,
    }
}

fn compare_definitions(a: &Definition, b: &Definition) -> Comparison {
    use Comparison::{Different, Same, Unknown};
    match (a, b) {
        (Definition::Workspace(a), Definition::Workspace(b)) => same(a.path() == b.path()),
        (Definition::Prelude(a), Definition::Prelude(b)) => same(a == b),
        (Definition::Standard(a), Definition::Standard(b)) if a == b => Same,
        // One type has several names in `std`, but they end in the same word.
        (Definition::Standard(a), Definition::Standard(b)) => {
            if last(a) == last(b) {
                Unknown
            } else {
                Different
            }
        }
        (Definition::Prelude(a), Definition::Standard(b))
        | (Definition::Standard(b), Definition::Prelude(a)) => {
            if a == last(b) {
                Unknown
            } else {
                Different
            }
        }
        (Definition::Foreign { path: a, .. }, Definition::Foreign { path: b, .. }) if a == b => {
            Same
        }
        (Definition::Foreign { path: a, .. }, Definition::Foreign { path: b, .. }) => {
            if is_distinct_in_nalgebra(a) && is_distinct_in_nalgebra(b) {
                Different
            } else {
                Unknown
            }
        }
        // It may be one that the crate has from there.
        (Definition::Foreign { knows_members, .. }, Definition::Workspace(_))
        | (Definition::Workspace(_), Definition::Foreign { knows_members, .. }) => {
            match knows_members {
                true => Unknown,
                false => Different,
            }
        }
        // It may be an alias of a primitive or of a type of std.
        (Definition::Foreign { path, .. }, _) | (_, Definition::Foreign { path, .. })
            if !is_of_nalgebra(path) =>
        {
            Unknown
        }
        _ => Different,
    }
}

/// Whether a foreign name with arguments may be an alias of one of them: `pub type Id<T> = T`.
fn may_be_its_argument(definition: &Definition, arguments: &[Resolved]) -> bool {
    let Definition::Foreign { path, .. } = definition else {
        return false;
    };
    let is_known = is_of_nalgebra(path) || path.starts_with("framework::");
    !is_known && arguments.iter().any(is_of_workspace)
}

fn is_of_workspace(data: &Resolved) -> bool {
    matches!(
        data.shape,
        Shape::Unknown
            | Shape::Named {
                definition: Definition::Workspace(_),
                ..
            }
    )
}

fn is_distinct_in_nalgebra(path: &str) -> bool {
    let name = path.strip_prefix("nalgebra::");
    name.is_some_and(|name| DISTINCT_IN_NALGEBRA.contains(&name))
}

/// Whether it is one of nalgebra's own structs, so that nothing outside of nalgebra is the same.
fn is_of_nalgebra(path: &str) -> bool {
    let name = path.strip_prefix("nalgebra::");
    let is_other = name.is_some_and(|name| OTHERS_OF_NALGEBRA.contains(&name));
    is_other || is_distinct_in_nalgebra(path)
}

fn same(same: bool) -> Comparison {
    if same {
        Comparison::Same
    } else {
        Comparison::Different
    }
}

fn last(path: &str) -> &str {
    path.rsplit("::").next().unwrap_or(path)
}
