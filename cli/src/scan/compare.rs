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
            answer => answer,
        },
        // A foreign name may be an alias of anything.
        (
            Shape::Named {
                definition: Definition::Foreign(_),
                ..
            },
            _,
        )
        | (
            _,
            Shape::Named {
                definition: Definition::Foreign(_),
                ..
            },
        ) => Unknown,
        (Shape::Tuple(a), Shape::Tuple(b)) if a.len() == b.len() => compare_all(a, b),
        (Shape::Array(a, length_of_a), Shape::Array(b, length_of_b)) => {
            both(compare(a, b), compare(length_of_a, length_of_b))
        }
        (Shape::Slice(a), Shape::Slice(b)) | (Shape::Reference(a), Shape::Reference(b)) => {
            compare(a, b)
        }
        (Shape::Constant(a), Shape::Constant(b)) if a == b => Same,
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
        (Definition::Foreign(a), Definition::Foreign(b)) if a == b => Same,
        (Definition::Foreign(a), Definition::Foreign(b)) => {
            let distinct = |path: &str| {
                path.strip_prefix("nalgebra::")
                    .is_some_and(|name| DISTINCT_IN_NALGEBRA.contains(&name))
            };
            if distinct(a) && distinct(b) {
                Different
            } else {
                Unknown
            }
        }
        // No crate outside of the workspace knows the workspace's types.
        (Definition::Foreign(_), Definition::Workspace(_))
        | (Definition::Workspace(_), Definition::Foreign(_)) => Different,
        (Definition::Foreign(_), _) | (_, Definition::Foreign(_)) => Unknown,
        _ => Different,
    }
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
