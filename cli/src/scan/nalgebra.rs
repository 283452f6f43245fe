//! What values of nalgebra consist of, as far as the name of their type tells their size.
//!
//! Everything else of nalgebra, and what other crates export under names of their own, is unknown here. Fields that a value
//! has by `Deref` (`point.x`) count as its own.

use super::types::{Definition, Resolved, Shape, named};

/// A value of nalgebra whose parts are known.
#[derive(Clone, Debug)]
pub enum Geometry {
    /// Also a vector: of one column.
    Matrix {
        rows: usize,
        columns: usize,
        element: Resolved,
    },
    Point {
        dimension: usize,
        element: Resolved,
    },
    /// A translation or a scaling of each axis.
    Shift {
        dimension: usize,
        element: Resolved,
    },
    /// As a matrix that nobody may look into.
    Rotation {
        dimension: usize,
        element: Resolved,
    },
    Quaternion {
        element: Resolved,
    },
    Complex {
        element: Resolved,
    },
    Isometry {
        rotation: Resolved,
        translation: Resolved,
    },
    Similarity {
        isometry: Resolved,
        scaling: Resolved,
    },
    /// A value of this type whose length is one.
    Unit(Resolved),
}

/// Names of coordinates; more dimensions have none.
const AXES: [&str; 6] = ["x", "y", "z", "w", "a", "b"];

impl Geometry {
    /// `None` for every type about which nothing is known.
    pub fn of(data: &Resolved) -> Option<Self> {
        let Shape::Named {
            definition: Definition::Foreign { path, .. },
            arguments,
        } = &data.shape
        else {
            return None;
        };
        let name = path.strip_prefix("nalgebra::")?;
        match (name, arguments.as_slice()) {
            ("Quaternion", [element]) => Some(Self::Quaternion {
                element: element.clone(),
            }),
            ("Complex", [element]) => Some(Self::Complex {
                element: element.clone(),
            }),
            ("UnitQuaternion", [element]) => Some(Self::Unit(typed("Quaternion", element))),
            ("UnitComplex", [element]) => Some(Self::Unit(typed("Complex", element))),
            ("Unit", [inner]) => Some(Self::Unit(inner.clone())),
            ("SMatrix", [element, rows, columns]) => Some(Self::Matrix {
                rows: constant(rows)?,
                columns: constant(columns)?,
                element: element.clone(),
            }),
            ("SVector", [element, size]) => Self::sized("Vector", constant(size)?, element),
            (kind, [element, size]) => Self::sized(kind, constant(size)?, element),
            (name, [element]) => {
                let (kind, size) = name.split_at(name.find(|one: char| one.is_ascii_digit())?);
                if let ("Matrix", Some((rows, columns))) = (kind, size.split_once('x')) {
                    return Some(Self::Matrix {
                        rows: rows.parse().ok()?,
                        columns: columns.parse().ok()?,
                        element: element.clone(),
                    });
                }
                match (kind, size.parse().ok()?) {
                    ("Isometry", 2) => Some(Self::isometry("UnitComplex", 2, element)),
                    ("Isometry", 3) => Some(Self::isometry("UnitQuaternion", 3, element)),
                    ("IsometryMatrix", size @ 2..=3) => {
                        Some(Self::isometry(&format!("Rotation{size}"), size, element))
                    }
                    ("Similarity", size @ 2..=3) => Some(Self::Similarity {
                        isometry: typed(&format!("Isometry{size}"), element),
                        scaling: element.clone(),
                    }),
                    ("UnitVector", size @ 1..=6) => {
                        Some(Self::Unit(typed(&format!("Vector{size}"), element)))
                    }
                    (kind, size @ 1..=6) => Self::sized(kind, size, element),
                    _ => None,
                }
            }
            _ => None,
        }
    }

    /// The type of this kind and size: `Point` and 2 is `Point2`.
    fn sized(kind: &str, size: usize, element: &Resolved) -> Option<Self> {
        let (dimension, element) = (size, element.clone());
        let matrix = |rows, columns, element| Self::Matrix {
            rows,
            columns,
            element,
        };
        Some(match kind {
            "Vector" => matrix(size, 1, element),
            "RowVector" => matrix(1, size, element),
            "Matrix" => matrix(size, size, element),
            "Point" => Self::Point { dimension, element },
            "Translation" | "Scale" => Self::Shift { dimension, element },
            "Rotation" => Self::Rotation { dimension, element },
            _ => return None,
        })
    }

    fn isometry(rotation: &str, size: usize, element: &Resolved) -> Self {
        Self::Isometry {
            rotation: typed(rotation, element),
            translation: typed(&format!("Translation{size}"), element),
        }
    }

    /// Whether the field of this name lies behind `Deref`, so that whoever borrows it borrows the whole value.
    pub fn dereferences_for(&self, field: &str) -> bool {
        match self {
            Self::Matrix { .. } => field != "data",
            Self::Point { .. } | Self::Quaternion { .. } => field != "coords",
            Self::Shift { .. } => field != "vector",
            Self::Rotation { .. } | Self::Unit(_) => true,
            Self::Complex { .. } | Self::Isometry { .. } | Self::Similarity { .. } => false,
        }
    }

    /// Its public fields; `None` where a part of it is unknown.
    pub fn fields(&self) -> Option<Vec<(String, Resolved)>> {
        let field = |name: &str, data: Resolved| (name.to_owned(), data);
        Some(match self {
            Self::Matrix {
                rows,
                columns,
                element,
            } => {
                let mut fields = coordinates(*rows, *columns, element);
                fields.push(field("data", Resolved::opaque()));
                fields
            }
            Self::Point { dimension, element } => {
                let mut fields = coordinates(*dimension, 1, element);
                fields.push(field("coords", vector(*dimension, element)));
                fields
            }
            Self::Shift { dimension, element } => {
                let mut fields = coordinates(*dimension, 1, element);
                fields.push(field("vector", vector(*dimension, element)));
                fields
            }
            Self::Rotation { .. } => Vec::new(),
            Self::Quaternion { element } => {
                let mut fields = vec![field("coords", vector(4, element))];
                fields.extend(["i", "j", "k", "w"].map(|name| field(name, element.clone())));
                fields
            }
            Self::Complex { element } => {
                ["re", "im"].map(|name| field(name, element.clone())).into()
            }
            Self::Isometry {
                rotation,
                translation,
            } => vec![
                field("rotation", rotation.clone()),
                field("translation", translation.clone()),
            ],
            Self::Similarity { isometry, .. } => vec![field("isometry", isometry.clone())],
            Self::Unit(inner) => return Self::of(inner)?.fields(),
        })
    }
}

/// A type of nalgebra with one argument.
fn typed(name: &str, element: &Resolved) -> Resolved {
    let path = format!("nalgebra::{name}");
    named(
        path.clone(),
        Definition::Foreign {
            path,
            knows_members: false,
        },
        vec![element.clone()],
    )
}

fn vector(size: usize, element: &Resolved) -> Resolved {
    match size {
        1..=6 => typed(&format!("Vector{size}"), element),
        _ => Resolved::opaque(),
    }
}

/// What a matrix or vector up to six by six has by `Deref`.
fn coordinates(rows: usize, columns: usize, element: &Resolved) -> Vec<(String, Resolved)> {
    let names: Vec<String> = match (rows, columns) {
        (size @ 1..=6, 1) | (1, size @ 1..=6) => {
            AXES[..size].iter().map(ToString::to_string).collect()
        }
        (2..=6, 2..=6) => (1..=columns)
            .flat_map(|column| (1..=rows).map(move |row| format!("m{row}{column}")))
            .collect(),
        _ => Vec::new(),
    };
    let field = |name| (name, element.clone());
    names.into_iter().map(field).collect()
}

fn constant(data: &Resolved) -> Option<usize> {
    match &data.shape {
        Shape::Constant(number) => number.parse().ok(),
        _ => None,
    }
}
