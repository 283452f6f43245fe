//! Data paths below a value: what lies at their end, and whether a written type agrees with it.

use std::ops::Range;

use camino::Utf8PathBuf;
use grammar::{DataPath, Segment as GrammarSegment, SegmentName};

use super::robot::{Access, Segment};
use crate::diagnostics::Diagnostic;
use crate::scan::Library;
use crate::scan::compare::{Comparison, compare};
use crate::scan::components::{Component, component};
use crate::scan::module::is_conditional;
use crate::scan::nalgebra::Geometry;
use crate::scan::types::{Definition, Resolved, Shape};

/// What comparing a reader's type with the value at the end of its path shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Agreement {
    Same,
    /// Names lead out of what can be seen: left to rustc.
    Unknown,
    /// The type at the end is another.
    Type {
        expected: String,
    },
    /// `?` and `Option` disagree.
    Option {
        message: String,
        help: String,
    },
    /// A segment names no field.
    Field {
        message: String,
        names: Vec<String>,
        wrong: String,
    },
    /// A segment names a field that generated code cannot reach.
    Private {
        structure: String,
        field: String,
        /// Of the field's name.
        file: Utf8PathBuf,
        range: Range<usize>,
    },
}

impl Agreement {
    /// An error, first at the field that has to be made public, if that is the mistake.
    pub(super) fn begin(&self, error: Diagnostic) -> Diagnostic {
        match self {
            Self::Private { file, range, .. } => {
                error.at(file, range.clone(), "not visible for the generated crate")
            }
            _ => error,
        }
    }
}

impl Access {
    /// The written path of a grammar field.
    pub(super) fn of(path: &DataPath) -> Self {
        let segments = path.segments.iter().map(|segment| Segment {
            name: name(segment).to_owned(),
            optional: segment.optional,
            instance: segment.name == SegmentName::CyclerInstance,
        });
        Self {
            segments: segments.collect(),
            written: path.to_string(),
        }
    }

    /// Whether a `?` stands anywhere in it.
    pub fn is_optional(&self) -> bool {
        self.segments.iter().any(|segment| segment.optional)
    }
}

fn name(segment: &GrammarSegment) -> &str {
    match &segment.name {
        SegmentName::Field(name) => name,
        SegmentName::CyclerInstance => "cycler_instance",
    }
}

/// Whether `written` is right for a path whose first segment is a value of type `start`.
pub(super) fn check(
    library: &Library<'_>,
    start: &Resolved,
    segments: &[Segment],
    written: &Resolved,
) -> Agreement {
    let end = match walk(library, start, segments) {
        Ok(end) => end,
        Err(disagreement) => return disagreement,
    };
    let last = segments.last().map_or("", |segment| segment.name.as_str());
    let has_mark = segments.last().is_some_and(|segment| segment.optional);
    if !segments.iter().any(|segment| segment.optional) {
        return without_mark(&end, written, last);
    }
    // The grammar has seen to it that a path with `?` has a type `Option<…>`.
    let Some(inner) = written.option_argument() else {
        return Agreement::Unknown;
    };
    match compare(inner, &end) {
        Comparison::Same => Agreement::Same,
        Comparison::Unknown => Agreement::Unknown,
        Comparison::Different if is_option_of(&end, inner) => Agreement::Option {
            message: match has_mark {
                true => format!("`{last}?` is `{}`", end.text),
                false => format!("`{last}` is `{}`", end.text),
            },
            help: match has_mark {
                true => format!("write `Option<{}>`: one `?` removes one `Option`", end.text),
                false => format!("write `?` behind `{last}`, too"),
            },
        },
        Comparison::Different => Agreement::Type {
            expected: format!("Option<{}>", end.text),
        },
    }
}

/// The segment before the end of a path, and its type, that is read by part but changed only as a whole.
pub(super) fn only_whole(
    library: &Library<'_>,
    start: &Resolved,
    segments: &[Segment],
) -> Option<(String, String)> {
    (1..segments.len()).find_map(|end| {
        let owner = walk(library, start, &segments[..end]).ok()?;
        let is_unit = matches!(Geometry::of(&owner), Some(Geometry::Unit(_)));
        is_unit.then(|| (segments[end - 1].name.clone(), owner.text))
    })
}

/// How many segments lead to the first value that is borrowed as a whole by whoever borrows what lies at the end: one whose
/// next field is behind `Deref`.
pub(super) fn borrowed_whole(
    library: &Library<'_>,
    start: &Resolved,
    segments: &[Segment],
) -> Option<usize> {
    (1..segments.len()).find(|end| {
        let owner = walk(library, start, &segments[..*end]);
        let geometry = owner.ok().and_then(|owner| Geometry::of(&owner));
        geometry.is_some_and(|geometry| geometry.dereferences_for(&segments[*end].name))
    })
}

fn without_mark(end: &Resolved, written: &Resolved, last: &str) -> Agreement {
    match compare(written, end) {
        Comparison::Same => Agreement::Same,
        Comparison::Unknown => Agreement::Unknown,
        Comparison::Different if is_option_of(end, written) => Agreement::Option {
            message: format!("`{last}` is `{}`, not `{}`", end.text, written.text),
            help: format!(
                "write `{0}` for `&{0}`, or `{0}` and `?` behind `{last}` for `Option<&{1}>`",
                end.text, written.text
            ),
        },
        Comparison::Different if is_option_of(written, end) => Agreement::Option {
            message: format!("`{last}` is `{}`, not `{}`", end.text, written.text),
            help: format!("write `{}`", end.text),
        },
        Comparison::Different => Agreement::Type {
            expected: end.text.clone(),
        },
    }
}

fn is_option_of(option: &Resolved, inner: &Resolved) -> bool {
    option
        .option_argument()
        .is_some_and(|argument| compare(argument, inner) == Comparison::Same)
}

/// The type at the end of a path, behind its last `?` if it has one.
fn walk(
    library: &Library<'_>,
    start: &Resolved,
    segments: &[Segment],
) -> Result<Resolved, Agreement> {
    let mut current = start.clone();
    for (index, segment) in segments.iter().enumerate() {
        if index > 0 {
            let owner = &segments[index - 1];
            current = enter(library, &current, owner, segment)?;
        }
        if segment.optional {
            current = look_into(&current, segment)?;
        }
        // A type that doubles with every step has no end that anybody could write.
        if current.is_huge() {
            return Err(Agreement::Unknown);
        }
    }
    Ok(current)
}

fn look_into(data: &Resolved, segment: &Segment) -> Result<Resolved, Agreement> {
    if let Some(inner) = data.option_argument() {
        return Ok(inner.clone());
    }
    Err(if may_hide(data) {
        Agreement::Unknown
    } else {
        Agreement::Option {
            message: format!("`{}` is `{}`, no `Option`", segment.name, data.text),
            help: format!("remove the `?` behind `{}`", segment.name),
        }
    })
}

/// Whether a name may stand for anything.
fn may_hide(data: &Resolved) -> bool {
    match &data.shape {
        Shape::Unknown => true,
        Shape::Named { definition, .. } => {
            matches!(
                definition,
                Definition::Foreign { .. } | Definition::Standard(_)
            )
        }
        _ => false,
    }
}

/// The type of a field.
fn enter(
    library: &Library<'_>,
    data: &Resolved,
    owner: &Segment,
    segment: &Segment,
) -> Result<Resolved, Agreement> {
    let field = &segment.name;
    if data.option_argument().is_some() {
        return Err(Agreement::Option {
            message: format!(
                "`{}` is `{}`, so `{field}` may be absent",
                owner.name, data.text
            ),
            help: format!("write `?` behind `{}`", owner.name),
        });
    }
    if let Some(inner) = data.boxed() {
        return enter(library, inner, owner, segment);
    }
    let Some(structure) = library.fields(data) else {
        return enter_other(library, data, field);
    };
    match structure.fields.iter().find(|one| one.name == *field) {
        Some(found) if is_conditional(&found.attributes) => Err(Agreement::Unknown),
        Some(found) if found.public => Ok(found.data.clone()),
        Some(found) => Err(Agreement::Private {
            structure: structure.path,
            field: field.clone(),
            file: structure.file,
            range: found.range.clone(),
        }),
        None if structure.dereferences => Err(Agreement::Unknown),
        None => {
            let names = structure.fields.into_iter().map(|one| one.name);
            Err(no_field(data, field, names.collect()))
        }
    }
}

/// A field of what is no struct of the workspace; only what certainly has no such field is an error.
fn enter_other(library: &Library<'_>, data: &Resolved, field: &str) -> Result<Resolved, Agreement> {
    match component(data, field) {
        Component::Field(data) => Ok(data),
        Component::Absent(names) => Err(no_field(data, field, names)),
        Component::Unknown if library.is_without_fields(data) => {
            Err(no_field(data, field, Vec::new()))
        }
        Component::Unknown => Err(Agreement::Unknown),
    }
}

fn no_field(data: &Resolved, field: &str, names: Vec<String>) -> Agreement {
    Agreement::Field {
        message: format!("`{}` has no field `{field}`", data.text),
        names,
        wrong: field.to_owned(),
    }
}
