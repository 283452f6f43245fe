//! Finds what a path leads to in values of a type, without one: everything that it may, as variants differ.
//!
//! Invariant: what a value has at a path is among what is found. [`Reflect::child`](super::Reflect::child) of an enum looks for
//! the active variant's name, and else in that variant; one with fields finds itself below its name, as often as it is named.

use super::shape::UNTOLD;
use super::{Children, Content, Form, Leaf, Path, Segment, Shape, UnknownPath};
use super::{VariantContent, VariantShape};

/// What a path may lead to.
struct Place {
    part: Shape,
    /// Where the path names a variant with fields, which are parts of the enum itself: its name, and these fields.
    variant: Option<(&'static str, Shape)>,
}

/// What is searched for one segment.
struct Search<'a> {
    segment: &'a Segment,
    /// Enums, and types that lie in themselves (`true`), that were looked into.
    entered: Vec<(&'static str, bool)>,
    found: Vec<Place>,
}

impl Shape {
    /// The shape at a path, as far as a type can tell: every variant counts as active that has what the path names, every
    /// option as present, every list as long enough and every map as having the key. Where it may lead to several types
    /// it is opaque.
    pub fn at(&self, path: &Path) -> Result<Self, UnknownPath> {
        let places = self.places(path)?;
        Ok(only(places.into_iter().map(|place| place.part)))
    }

    /// Everything that the next segment of a path may be looked for in: of a variant with fields that the path names, these.
    pub fn inside(&self, path: &Path) -> Result<Vec<Self>, UnknownPath> {
        let places = self.places(path)?;
        Ok(places.into_iter().map(Place::into_inside).collect())
    }

    /// As [`Shape::at`]; nothing where values may have more than their type tells.
    pub(crate) fn known_at(&self, path: &Path) -> Option<Result<Self, UnknownPath>> {
        let found = self.at(path);
        match &found {
            Err(unknown) if self.may_have_more_at(&path.prefix(unknown.position)) => None,
            _ => Some(found),
        }
    }

    fn may_have_more_at(&self, path: &Path) -> bool {
        let places = self.places(path).unwrap_or_default();
        places
            .iter()
            .any(|place| place.part.may_have_more(&mut Vec::new()))
    }

    fn may_have_more(&self, expanded: &mut Vec<&'static str>) -> bool {
        match &self.content {
            _ if self.form == Form::Open || self.is_opaque() => true,
            Content::Option(inner) => inner.may_have_more(expanded),
            Content::Enum(variants) => variants.iter().any(|variant| match &variant.content {
                VariantContent::Value(inner) => inner.may_have_more(expanded),
                VariantContent::Unit | VariantContent::Fields(_) => false,
            }),
            Content::Recursive(expand) if !expanded.contains(&self.type_name) => {
                expanded.push(self.type_name);
                expand().may_have_more(expanded)
            }
            _ => false,
        }
    }

    fn places(&self, path: &Path) -> Result<Vec<Place>, UnknownPath> {
        let mut places = vec![Place {
            part: self.clone(),
            variant: None,
        }];
        for (position, segment) in path.segments().iter().enumerate() {
            let mut search = Search {
                segment,
                entered: Vec::new(),
                found: Vec::new(),
            };
            for place in &places {
                search.look_at(place);
            }
            if search.found.is_empty() {
                let children = places.iter().map(|place| place.inside().children());
                let valid = children.fold(Children::default(), Children::and);
                return Err(UnknownPath::new(path, position, valid));
            }
            places = search.found;
        }
        Ok(places)
    }

    fn children(&self) -> Children {
        let Some(opened) = self.opened() else {
            return Children::default();
        };
        match &opened.content {
            Content::List { length, names, .. } => Children {
                indices: length.unwrap_or_default(),
                ..Children::named(names.iter().copied())
            },
            Content::Struct(fields) => Children::named(fields.iter().map(|field| field.name)),
            Content::Tuple(items) => Children::indexed(items.len()),
            Content::Enum(variants) => {
                let parts = variants.iter().filter(|variant| !variant.is_unit());
                Children::named(parts.map(|variant| variant.name))
            }
            _ => Children::default(),
        }
    }
}

impl Place {
    fn inside(&self) -> &Shape {
        self.variant
            .as_ref()
            .map_or(&self.part, |(_, fields)| fields)
    }

    fn into_inside(self) -> Shape {
        self.variant.map_or(self.part, |(_, fields)| fields)
    }
}

impl Search<'_> {
    fn look_at(&mut self, place: &Place) {
        match &place.variant {
            // The variant finds itself.
            Some((name, fields)) if self.segment.name() == Some(name) => {
                self.add(&place.part, Some((name, fields)));
            }
            _ => self.look(place.inside()),
        }
    }

    fn look(&mut self, shape: &Shape) {
        match &shape.content {
            Content::Leaf(_) | Content::Set(_) => {}
            Content::Option(inner) => self.look(inner),
            Content::List {
                item,
                length,
                names,
            } => {
                let index = self.segment.position(names);
                let is_there = |index| length.is_none_or(|length| index < length);
                if index.is_some_and(is_there) {
                    self.add(item, None);
                }
            }
            Content::Map(value) => self.add(value, None),
            Content::Struct(fields) => {
                let mut fields = fields.iter();
                let named = fields.find(|field| Some(field.name) == self.segment.name());
                if let Some(field) = named {
                    self.add(&field.shape, None);
                }
            }
            Content::Tuple(items) => {
                let index = self.segment.index();
                if let Some(item) = index.and_then(|index| items.get(index)) {
                    self.add(item, None);
                }
            }
            Content::Enum(variants) => {
                if self.enter(shape.type_name, false) {
                    for variant in variants {
                        self.look_at_variant(shape, variant);
                    }
                }
            }
            Content::Recursive(expand) => {
                let is_known = self.entered.contains(&(shape.type_name, false));
                if !is_known && self.enter(shape.type_name, true) {
                    self.look(&expand());
                }
            }
        }
    }

    fn look_at_variant(&mut self, whole: &Shape, variant: &VariantShape) {
        let is_named = Some(variant.name) == self.segment.name();
        match (&variant.content, is_named) {
            (VariantContent::Unit, _) => {}
            (VariantContent::Value(shape), true) => self.add(shape, None),
            (VariantContent::Value(shape), false) => self.look(shape),
            (VariantContent::Fields(content), true) => {
                self.add(whole, Some((variant.name, &fields_of(whole, content))));
            }
            (VariantContent::Fields(content), false) => self.look(&fields_of(whole, content)),
        }
    }

    // What was looked into before has nothing more for this segment.
    fn enter(&mut self, type_name: &'static str, is_expanded: bool) -> bool {
        let key = (type_name, is_expanded);
        let is_new = !self.entered.contains(&key);
        if is_new {
            self.entered.push(key);
        }
        is_new
    }

    // Each once: else what lies in itself would become more with each segment.
    fn add(&mut self, part: &Shape, variant: Option<(&'static str, &Shape)>) {
        let name = |variant: Option<(&'static str, &Shape)>| variant.map(|(name, _)| name);
        let is_there = self.found.iter().any(|place| {
            let there = place.variant.as_ref().map(|(name, _)| *name);
            there == name(variant)
                && place.part.type_name == part.type_name
                && place.part.is_opaque() == part.is_opaque()
        });
        if !is_there {
            self.found.push(Place {
                part: part.clone(),
                variant: variant.map(|(name, fields)| (name, fields.clone())),
            });
        }
    }
}

/// What is found in an enum while the variant with that content is active.
pub(super) fn fields_of(whole: &Shape, content: &Content) -> Shape {
    Shape {
        content: content.clone(),
        form: Form::Plain,
        ..*whole
    }
}

/// What they are if they are of one type.
fn only(mut shapes: impl Iterator<Item = Shape>) -> Shape {
    let untold = Shape {
        type_name: UNTOLD,
        docs: "",
        content: Content::Leaf(Leaf::Opaque),
        form: Form::Plain,
        pixels: None,
    };
    match shapes.next() {
        Some(first) if shapes.all(|other| other.type_name == first.type_name) => first,
        _ => untold,
    }
}
