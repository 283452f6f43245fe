//! From a field as an author wrote it to its kind.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Type, TypePath};

use super::arguments::{Arguments, Arity};
use super::{
    CycleField, FromInstance, FromOutput, Pathed, Place, ProcedureName, StatePath, peel, rules,
    written,
};
use crate::context::ContextKind;
use crate::kind::Kind;
use crate::mistake::{Mistake, Rule};
use crate::path::{DataPath, Name};

/// A field before it is asked whether its kind has a meaning in its struct.
#[derive(Clone, Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "a file has a handful; boxes would be in every match"
)]
pub enum AnyField {
    Cycle(CycleField),
    CaptureTime,
}

/// A field as far as it could be read, so that a macro can still make something of it.
#[derive(Clone, Debug)]
pub struct ReadField {
    /// Kind and its path without arguments; `None` if the field's type is no kind or lacks its types. With mistakes,
    /// paths may be empty or cut short.
    pub kind: Option<(AnyField, syn::Path)>,
    pub mistakes: Vec<Mistake>,
}

/// Reads one field of a struct.
pub fn read_field(field: &syn::Field, context: ContextKind) -> ReadField {
    let mut mistakes = Vec::new();
    mistakes.extend(rules::attribute_mistake(field));
    let Some((kind, written_kind)) = kind_of(&field.ty) else {
        mistakes.push(rules::unknown(&field.ty, context));
        return ReadField {
            kind: None,
            mistakes,
        };
    };
    mistakes.extend(rules::keyword_mistake(kind, field));
    mistakes.extend(rules::hint_mistake(kind, field));
    let mut content_mistakes = Vec::new();
    let read = read_kind(kind, written_kind, &mut content_mistakes);
    if kind.contexts().contains(&context) {
        mistakes.extend(content_mistakes);
    } else {
        mistakes.push(rules::misplaced(kind, written_kind, context));
    }
    ReadField {
        kind: read.map(|read| (read, without_arguments(written_kind))),
        mistakes,
    }
}

impl ReadField {
    pub(crate) fn place<K: Place>(self) -> Option<(K, syn::Path)> {
        let (field, path) = self.kind.filter(|_| self.mistakes.is_empty())?;
        Some((K::place(field)?, path))
    }
}

fn kind_of(data: &Type) -> Option<(Kind, &TypePath)> {
    match peel(data) {
        Type::Path(path) if path.qself.is_none() => {
            let last = path.path.segments.last()?;
            Some((Kind::from_name(&last.ident.to_string())?, path))
        }
        _ => None,
    }
}

fn without_arguments(path: &TypePath) -> syn::Path {
    let mut bare = path.path.clone();
    if let Some(last) = bare.segments.last_mut() {
        last.arguments = syn::PathArguments::None;
    }
    bare
}

/// `None` if a type is missing.
fn read_kind(kind: Kind, path: &TypePath, mistakes: &mut Vec<Mistake>) -> Option<AnyField> {
    let segment = path.path.segments.last()?;
    let arguments = Arguments::read(kind, segment, path.span(), mistakes);
    let reader = Reader {
        kind,
        arguments,
        span: path.span(),
    };
    Some(AnyField::Cycle(match kind {
        Kind::CaptureTime => return Some(AnyField::CaptureTime),
        Kind::CycleTime => CycleField::CycleTime,
        Kind::HardwareInterface => CycleField::HardwareInterface,
        Kind::MainOutput => CycleField::MainOutput(reader.data(mistakes)?),
        Kind::Input => CycleField::Input(reader.output(mistakes)?),
        Kind::RequiredInput => CycleField::RequiredInput(reader.output(mistakes)?),
        Kind::LatestInput => CycleField::LatestInput(reader.output_of_instance(mistakes)?),
        Kind::PerceptionInput => CycleField::PerceptionInput(reader.output_of_instance(mistakes)?),
        Kind::PreviousInput => CycleField::PreviousInput(reader.pathed(mistakes)?),
        Kind::HistoricInput => CycleField::HistoricInput(reader.pathed(mistakes)?),
        Kind::Parameter => CycleField::Parameter(reader.pathed(mistakes)?),
        Kind::AdditionalOutput => CycleField::AdditionalOutput(reader.pathed(mistakes)?),
        Kind::CyclerState => CycleField::CyclerState(reader.state(mistakes)?),
        Kind::Procedure => CycleField::Procedure(reader.procedure(mistakes)?),
    }))
}

/// The arguments of a kind, being given their meaning.
struct Reader {
    kind: Kind,
    arguments: Arguments,
    /// The whole type.
    span: Span,
}

impl Reader {
    fn data(&self, mistakes: &mut Vec<Mistake>) -> Option<Type> {
        let data = self.arguments.types.first()?;
        Some(self.owned(data, mistakes))
    }

    /// The type of a value; with a message if it is written as a reference.
    fn owned(&self, data: &Type, mistakes: &mut Vec<Mistake>) -> Type {
        let Type::Reference(reference) = peel(data) else {
            return data.clone();
        };
        let owned = &*reference.elem;
        let message = format!(
            "`{}` takes the type of the value, not of a reference to it",
            self.kind.name()
        );
        let help = match owned {
            Type::Path(path) if path.path.is_ident("str") => "write `String`".to_owned(),
            Type::Slice(slice) => format!("write `Vec<{}>`", written(&slice.elem)),
            _ => format!("write `{}` without `&`", written(owned)),
        };
        mistakes.push(Mistake::new(Rule::InvalidField, data.span(), message).help(help));
        owned.clone()
    }

    fn pathed(&self, mistakes: &mut Vec<Mistake>) -> Option<Pathed> {
        let data = self.data(mistakes)?;
        let path = self.path(&data, mistakes);
        Some(Pathed { data, path })
    }

    fn output(&self, mistakes: &mut Vec<Mistake>) -> Option<FromOutput> {
        let data = self.data(mistakes)?;
        let instance = self.instance(mistakes);
        let path = self.path(&data, mistakes);
        Some(FromOutput {
            data,
            instance,
            path,
        })
    }

    fn output_of_instance(&self, mistakes: &mut Vec<Mistake>) -> Option<FromInstance> {
        let data = self.data(mistakes)?;
        let instance = self.instance(mistakes).unwrap_or_else(|| self.no_name());
        let path = self.path(&data, mistakes);
        Some(FromInstance {
            data,
            instance,
            path,
        })
    }

    fn state(&self, mistakes: &mut Vec<Mistake>) -> Option<StatePath> {
        let written_data = self.arguments.types.first()?;
        let (data, shared) = match peel(written_data) {
            Type::Reference(reference)
                if reference.mutability.is_none() && reference.lifetime.is_none() =>
            {
                ((*reference.elem).clone(), true)
            }
            Type::Reference(reference) => {
                let message = format!("unexpected reference: expected {}", self.kind.form());
                let help = "`&` is the reader's form; the lifetime is added by `#[context]`";
                mistakes.push(
                    Mistake::new(Rule::InvalidField, written_data.span(), message).help(help),
                );
                ((*reference.elem).clone(), reference.mutability.is_none())
            }
            _ => (written_data.clone(), false),
        };
        let path = self.path(&data, mistakes);
        Some(StatePath { data, shared, path })
    }

    fn procedure(&self, mistakes: &mut Vec<Mistake>) -> Option<ProcedureName> {
        let [request, response, ..] = &self.arguments.types[..] else {
            return None;
        };
        let name = match self.arguments.literals.last() {
            Some(literal) => Name::read(literal, "a procedure", mistakes),
            None => self.no_name(),
        };
        Some(ProcedureName {
            request: self.owned(request, mistakes),
            response: self.owned(response, mistakes),
            name,
        })
    }

    /// The first of two literals, where the kind takes two.
    fn instance(&self, mistakes: &mut Vec<Mistake>) -> Option<Name> {
        if Arity::of(self.kind).most_literals < 2 {
            return None;
        }
        let [instance, path] = &self.arguments.literals[..] else {
            return None;
        };
        if starts_upper(&path.value()) && !starts_upper(&instance.value()) {
            let message = format!(
                "the path `{}` stands before the instance `{}`",
                instance.value(),
                path.value()
            );
            let help = format!("expected {}", self.kind.form());
            mistakes.push(Mistake::new(Rule::InvalidField, instance.span(), message).help(help));
            return Some(self.no_name());
        }
        Some(Name::read(instance, "an instance", mistakes))
    }

    fn path(&self, data: &Type, mistakes: &mut Vec<Mistake>) -> DataPath {
        let Some(literal) = self.arguments.literals.last() else {
            return DataPath {
                segments: Vec::new(),
                span: self.span,
            };
        };
        let before = mistakes.len();
        let path = DataPath::read(literal, mistakes);
        if mistakes.len() == before {
            mistakes.extend(rules::instance_mistake(self.kind, &path));
            mistakes.extend(rules::hardware_mistake(self.kind, &path));
            let one_literal = self.arguments.literals.len() == 1;
            mistakes.extend(rules::option_mistake(self.kind, data, &path, one_literal));
        }
        path
    }

    fn no_name(&self) -> Name {
        Name {
            text: String::new(),
            span: self.span,
        }
    }
}

fn starts_upper(text: &str) -> bool {
    text.chars().next().is_some_and(char::is_uppercase)
}
