//! Finds what a path leads to in values of a type, without one: everything that it may, as variants differ.
//!
//! Invariant: what a value has at a path is among what is found; [`Reflect::child`](super::Reflect::child) of an enum looks for
//! the active variant's name, and else in that variant.

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
    /// Enums, and types that lie in themselves, which are being looked into: a segment later they may come again.
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

    /// As [`Self::at`]; of a variant with fields that the path names, its fields: what the next segment is looked for in.
    pub fn inside(&self, path: &Path) -> Result<Self, UnknownPath> {
        let places = self.places(path)?;
        Ok(only(places.into_iter().map(Place::into_inside)))
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
                search.look(place.inside());
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
        match &self.content {
            Content::Leaf(_) | Content::Set(_) | Content::Map(_) => Children::default(),
            Content::Option(inner) => inner.children(),
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
            Content::Recursive(expand) => expand().children(),
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

    fn is_as(&self, other: &Self) -> bool {
        let key = |place: &Self| {
            let variant = place.variant.as_ref().map(|(name, _)| *name);
            (place.part.type_name, place.part.is_opaque(), variant)
        };
        key(self) == key(other)
    }
}

impl Search<'_> {
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
                    self.find(item);
                }
            }
            Content::Map(value) => self.find(value),
            Content::Struct(fields) => {
                let mut fields = fields.iter();
                let named = fields.find(|field| Some(field.name) == self.segment.name());
                if let Some(field) = named {
                    self.find(&field.shape);
                }
            }
            Content::Tuple(items) => {
                let index = self.segment.index();
                if let Some(item) = index.and_then(|index| items.get(index)) {
                    self.find(item);
                }
            }
            Content::Enum(variants) => self.enter(shape.type_name, false, |search| {
                for variant in variants {
                    search.look_at_variant(shape, variant);
                }
            }),
            Content::Recursive(expand) => self.enter(shape.type_name, true, |search| {
                search.look(&expand());
            }),
        }
    }

    fn look_at_variant(&mut self, whole: &Shape, variant: &VariantShape) {
        let is_named = Some(variant.name) == self.segment.name();
        match (&variant.content, is_named) {
            (VariantContent::Unit, _) => {}
            (VariantContent::Value(shape), true) => self.find(shape),
            (VariantContent::Value(shape), false) => self.look(shape),
            (VariantContent::Fields(content), true) => self.add(Place {
                part: whole.clone(),
                variant: Some((variant.name, fields_of(whole, content))),
            }),
            (VariantContent::Fields(content), false) => self.look(&fields_of(whole, content)),
        }
    }

    fn enter(
        &mut self,
        type_name: &'static str,
        lies_in_itself: bool,
        look: impl FnOnce(&mut Self),
    ) {
        let key = (type_name, lies_in_itself);
        if !self.entered.contains(&key) {
            self.entered.push(key);
            look(self);
            self.entered.pop();
        }
    }

    fn find(&mut self, part: &Shape) {
        self.add(Place {
            part: part.clone(),
            variant: None,
        });
    }

    // Each once: else what lies in itself would become more with each segment.
    fn add(&mut self, place: Place) {
        if !self.found.iter().any(|found| found.is_as(&place)) {
            self.found.push(place);
        }
    }
}

/// What is found in an enum while the variant with that content is active.
fn fields_of(whole: &Shape, content: &Content) -> Shape {
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
