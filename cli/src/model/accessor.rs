//! How a value is reached: fields, and options that are looked into.

use serde::Serialize;

use crate::resolve::robot::Segment;

/// `frame.own.pose.as_ref().map(|pose| &pose.position)`, or simply `&frame.own.pose`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Accessor {
    /// Names from a local variable to the value or to the first option that is looked into.
    pub place: Vec<String>,
    /// The place is a reference already.
    pub reference: bool,
    /// The place is an option that is looked into.
    pub optional: bool,
    /// What follows inside of options.
    pub looks: Vec<Look>,
}

/// A look into an option: `.map(|name| &name.fields)`, optional `.and_then(|name| name.fields.as_ref())`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Look {
    /// What the content of the option before is called.
    pub name: String,
    pub fields: Vec<String>,
    /// It ends in another option that is looked into.
    pub optional: bool,
}

impl Accessor {
    /// Reaches a path below a base, which is no value itself: `frame.own` and `pose.position`.
    pub fn below(base: &[&str], segments: &[Segment]) -> Self {
        let base = base.iter().map(|name| (*name).to_owned()).collect();
        Self::new(base, segments, segments.is_empty())
    }

    /// Reaches a path in a variable that is a reference to its first segment.
    pub fn in_variable(segments: &[Segment]) -> Self {
        Self::new(Vec::new(), segments, segments.len() == 1)
    }

    /// Whether there is an option on the way, so that the value may be absent.
    pub fn may_be_absent(&self) -> bool {
        self.optional
    }

    fn new(mut place: Vec<String>, segments: &[Segment], reference: bool) -> Self {
        let mut parts = segments.split_inclusive(|segment| segment.optional);
        let first = parts.next().unwrap_or_default();
        place.extend(names(first));
        let mut before = first.last();
        let looks = parts
            .map(|part| {
                let name = before.map_or_else(String::new, |segment| variable(&segment.name));
                before = part.last();
                Look {
                    name,
                    fields: names(part),
                    optional: ends_optional(part),
                }
            })
            .collect();
        Self {
            place,
            reference,
            optional: ends_optional(first),
            looks,
        }
    }
}

fn names(segments: &[Segment]) -> Vec<String> {
    segments
        .iter()
        .map(|segment| segment.name.clone())
        .collect()
}

fn ends_optional(segments: &[Segment]) -> bool {
    segments.last().is_some_and(|segment| segment.optional)
}

/// A name for the content of a field; tuple fields are called `value`.
fn variable(field: &str) -> String {
    if field.starts_with(|first: char| first.is_ascii_digit()) {
        "value".to_owned()
    } else {
        field.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segments(path: &str) -> Vec<Segment> {
        let segment = |text: &str| Segment {
            name: text.trim_end_matches('?').to_owned(),
            optional: text.ends_with('?'),
            instance: false,
        };
        path.split('.').map(segment).collect()
    }

    fn look(name: &str, fields: &[&str], optional: bool) -> Look {
        let fields = fields.iter().map(|field| (*field).to_owned()).collect();
        Look {
            name: name.to_owned(),
            fields,
            optional,
        }
    }

    #[test]
    fn paths_end_at_options_that_are_looked_into() {
        let cases: [(&str, &[&str], bool, Vec<Look>); 6] = [
            ("a", &["frame", "a"], false, vec![]),
            ("a.b", &["frame", "a", "b"], false, vec![]),
            ("a?", &["frame", "a"], true, vec![]),
            (
                "a.b?.c.d",
                &["frame", "a", "b"],
                true,
                vec![look("b", &["c", "d"], false)],
            ),
            (
                "a?.b?",
                &["frame", "a"],
                true,
                vec![look("a", &["b"], true)],
            ),
            (
                "a?.b.c?.0",
                &["frame", "a"],
                true,
                vec![look("a", &["b", "c"], true), look("c", &["0"], false)],
            ),
        ];
        for (path, place, optional, looks) in cases {
            let accessor = Accessor::below(&["frame"], &segments(path));
            assert_eq!(accessor.place, place, "{path}");
            assert_eq!(
                (accessor.optional, accessor.looks),
                (optional, looks),
                "{path}"
            );
            assert!(!accessor.reference, "{path}");
        }
    }

    #[test]
    fn what_a_variable_refers_to_is_no_reference_to_a_reference() {
        assert!(Accessor::in_variable(&segments("pose")).reference);
        assert!(!Accessor::in_variable(&segments("pose.position")).reference);
        assert!(Accessor::below(&["frame", "instance_parameters"], &[]).reference);
    }
}
