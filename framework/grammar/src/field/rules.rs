//! What a field may not say, each rule with its message.

use syn::ext::IdentExt;
use syn::spanned::Spanned;
use syn::{Ident, Type, TypePath};

use super::{option_argument, peel, written};
use crate::context::ContextKind;
use crate::hints::{Hints, is_hint_attribute};
use crate::kind::Kind;
use crate::mistake::{Mistake, Rule};
use crate::path::{DataPath, LATEST_KEYWORD, SegmentName};

/// An attribute that generated code cannot know about.
pub(super) fn attribute_mistake(field: &syn::Field) -> Option<Mistake> {
    let conditional = field.attrs.iter().find(|attribute| {
        attribute.path().is_ident("cfg") || attribute.path().is_ident("cfg_attr")
    })?;
    let message = "a field of a context cannot be conditional: generated code fills it always";
    Some(Mistake::new(
        Rule::InvalidField,
        conditional.span(),
        message,
    ))
}

/// A `#[reflect(…)]` that cannot be read, or says what a context's field cannot.
pub(super) fn hint_mistake(kind: Kind, field: &syn::Field) -> Option<Mistake> {
    let attribute = field.attrs.iter().find(|one| is_hint_attribute(one))?;
    let mistake = |span, message: String| Mistake::new(Rule::InvalidField, span, message);
    let hints = match Hints::read(&field.attrs) {
        Ok(hints) => hints,
        Err(error) => return Some(mistake(error.span(), error.to_string())),
    };
    if kind != Kind::Parameter {
        let message = format!(
            "`{}` has no unit and no range: its type says them",
            kind.name()
        );
        return Some(mistake(field.ty.span(), message).help("remove `#[reflect(…)]`"));
    }
    if hints.skip || hints.creation_only {
        let message = "a field of a context says `unit` and `range`: a parameter that only `new` reads is known to be";
        return Some(mistake(attribute.span(), message.to_owned()));
    }
    None
}

/// A name that no path can have; only an output's name is one that paths begin with.
pub(super) fn keyword_mistake(kind: Kind, field: &syn::Field) -> Option<Mistake> {
    let name = field.ident.as_ref()?;
    let plain = name.unraw();
    let is_keyword =
        plain == LATEST_KEYWORD || syn::parse_str::<Ident>(&plain.to_string()).is_err();
    (kind == Kind::MainOutput && is_keyword).then(|| {
        let message = format!("`{name}` is a keyword, and no path can name it");
        Mistake::new(Rule::InvalidName, name.span(), message)
    })
}

/// A kind where it has no meaning.
pub(super) fn misplaced(kind: Kind, path: &TypePath, context: ContextKind) -> Mistake {
    let name = kind.name();
    let places: Vec<_> = kind
        .contexts()
        .iter()
        .map(|context| format!("`{}`", context.name()))
        .collect();
    let message = format!("`{name}` has no meaning in `{}`", context.name());
    let help = format!("`{name}` is allowed in {}", places.join(" and "));
    let span = path
        .path
        .segments
        .last()
        .map_or(path.span(), |last| last.ident.span());
    Mistake::new(Rule::MisplacedKind, span, message).help(help)
}

/// A type that is no kind.
pub(super) fn unknown(data: &Type, context: ContextKind) -> Mistake {
    let (name, span) = match peel(data) {
        Type::Path(path) => match path.path.segments.last() {
            Some(last) => (last.ident.to_string(), last.ident.span()),
            None => (written(data), data.span()),
        },
        _ => (written(data), data.span()),
    };
    let message = format!("`{name}` is no kind of field");
    let help = match Kind::nearest(&name, context) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => {
            let kinds: Vec<_> = Kind::of(context).map(|kind| format!("`{kind}`")).collect();
            format!("`{}` may have {}", context.name(), kinds.join(", "))
        }
    };
    Mistake::new(Rule::UnknownKind, span, message).help(help)
}

/// `$cycler_instance` where it has no meaning, or more than once.
pub(super) fn instance_mistake(kind: Kind, path: &DataPath) -> Option<Mistake> {
    let allowed = matches!(kind, Kind::AdditionalOutput | Kind::Parameter);
    let message = match path.cycler_instances() {
        0 => return None,
        1 if allowed => return None,
        _ if allowed => format!("`{path}` names `$cycler_instance` more than once"),
        _ => format!(
            "`$cycler_instance` has no meaning in `{}`, only in `AdditionalOutput` and `Parameter`",
            kind.name()
        ),
    };
    Some(Mistake::new(Rule::InvalidPath, path.span, message))
}

/// A parameter where the files hold what the hardware of targets reads.
pub(super) fn hardware_mistake(kind: Kind, path: &DataPath) -> Option<Mistake> {
    let SegmentName::Field(first) = &path.segments.first()?.name else {
        return None;
    };
    (kind == Kind::Parameter && first == "hardware").then(|| {
        let message =
            format!("`{path}` is no path of a parameter: `hardware` belongs to the targets");
        Mistake::new(Rule::InvalidPath, path.span, message)
            .help("begin the path with another name: only a target's hardware reads `[hardware.…]`")
    })
}

/// `?` and the written type disagree; `one_literal` says that no instance is named.
pub(super) fn option_mistake(
    kind: Kind,
    data: &Type,
    path: &DataPath,
    one_literal: bool,
) -> Option<Mistake> {
    let mistake = |span, message| Some(Mistake::new(Rule::OptionMismatch, span, message));
    let name = kind.name();
    match (kind, path.is_optional()) {
        (Kind::AdditionalOutput | Kind::CyclerState, true) => mistake(
            path.span,
            format!("the path `{path}` of `{name}` has a `?`: it names what is there always"),
        ),
        (Kind::RequiredInput, false) if one_literal => {
            let mistake = mistake(
                path.span,
                format!(
                    "`{path}` is never absent: `RequiredInput` needs a `?` or another instance"
                ),
            );
            mistake.map(|mistake| {
                mistake
                    .help("write `?` behind the segment that may be absent, or make it an `Input`")
            })
        }
        (_, true) if option_argument(data).is_none() => {
            let data_text = written(data);
            let message = format!(
                "`{path}` may be absent, so the type is written `Option<…>`, not `{data_text}`"
            );
            let help = format!("write `{name}<Option<{data_text}>, …>`, or leave the `?` out");
            mistake(data.span(), message).map(|mistake| mistake.help(help))
        }
        _ => None,
    }
}
