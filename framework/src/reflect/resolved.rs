//! Paths that are walked in every cycle.

use super::{Content, Path, Reflect, Segment, Shape, UnknownPath};

/// A path to a part of values of one type: names of fields are looked up once, when it is made.
///
/// Only below an enum, whose active variant may be another one in every cycle, and in maps are names compared still.
#[derive(Clone, Debug)]
pub struct ResolvedPath {
    path: Path,
    steps: Vec<Step>,
    shape: Shape,
}

/// One segment.
#[derive(Clone, Debug)]
struct Step {
    /// By place, where the type has one for it.
    resolved: Segment,
    written: Segment,
}

impl ResolvedPath {
    /// The path in values of this shape.
    pub fn new(shape: &Shape, path: &Path) -> Result<Self, UnknownPath> {
        let mut steps = Vec::new();
        let mut upper = Path::WHOLE;
        let mut part = shape.clone();
        for segment in path.segments() {
            steps.push(Step {
                resolved: resolve(&part, segment),
                written: segment.clone(),
            });
            upper = upper
                .segments()
                .iter()
                .cloned()
                .chain([segment.clone()])
                .collect();
            part = shape.at(&upper).map_err(|unknown| UnknownPath {
                path: path.clone(),
                ..unknown
            })?;
        }
        Ok(Self {
            path: path.clone(),
            steps,
            shape: part,
        })
    }

    /// As it was written.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What is found there.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// The part of a value, if it is there now. Allocates nothing.
    pub fn find<'value>(&self, value: &'value dyn Reflect) -> Option<&'value dyn Reflect> {
        self.steps.iter().try_fold(value, |part, step| {
            // A type whose author wrote `Reflect` by hand may know names only.
            let found = part.child(&step.resolved);
            found.or_else(|| part.child(&step.written))
        })
    }
}

fn resolve(shape: &Shape, segment: &Segment) -> Segment {
    let opened = shape.opened();
    let shape = opened.as_deref().unwrap_or(shape);
    let resolved = match &shape.content {
        Content::Struct(fields) if shape.form.is_plain() => {
            let position = fields
                .iter()
                .position(|field| Some(field.name) == segment.name());
            position.map(Segment::Position)
        }
        Content::List { names, .. } => segment.position(names).map(Segment::Index),
        // A key that looks like an index is a text all the same.
        Content::Map(_) => Some(Segment::Field(segment.to_string())),
        _ => None,
    };
    resolved.unwrap_or_else(|| segment.clone())
}
