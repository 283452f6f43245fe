//! What a function asks of the hardware interface.

use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{
    BoundLifetimes, GenericArgument, GenericParam, Ident, ImplItemFn, Lifetime, LifetimeParam,
    Path, PathArguments, PathSegment, Token, Type, TypeParamBound, WherePredicate,
};

use super::check::{Expected, last_segment};
use crate::field::{peel, written};
use crate::mistake::Mistake;

/// Traits asked of the parameter of a context: `CycleContext<impl A + B>`, or a type parameter with its bounds.
pub(super) fn read_bounds(
    expected: &Expected<'_>,
    method: &ImplItemFn,
    context: &PathSegment,
    mistakes: &mut Vec<Mistake>,
) -> Bounds {
    let mut bounds = Bounds::default();
    let interface = interface_argument(context);
    let parameter = interface.and_then(|interface| parameter_name(method, interface));
    mistakes.extend(agreement_mistake(expected, context, interface));
    mistakes.extend(stray_parameter(expected, method, parameter));
    match (interface.map(peel), parameter) {
        (None, _) => {}
        (Some(Type::ImplTrait(interface)), _) => bounds.extend(&interface.bounds),
        (Some(_), Some(parameter)) => {
            bounds.extend_from_generics(method, parameter);
            mistakes.extend(lost_predicate(expected, method, parameter));
        }
        (Some(other), None) => {
            let message = format!(
                "`{}` asks for the hardware `{}`: a node works with any that has the traits it names",
                expected.function,
                written(other)
            );
            mistakes.push(expected.mistake(other.span(), message));
        }
    }
    let strangers = bounds.traits.iter();
    let mistake = |bound| stranger_in_bound(expected, bound, parameter, &bounds.of_for);
    mistakes.extend(strangers.filter_map(mistake));
    bounds
}

/// What is asked of the hardware.
#[derive(Default)]
pub(super) struct Bounds {
    pub(super) traits: Vec<Path>,
    /// Lifetimes that a `for<…>` before a trait introduces.
    of_for: Vec<Lifetime>,
    pub(super) is_static: bool,
}

impl Bounds {
    fn extend(&mut self, bounds: &Punctuated<TypeParamBound, Token![+]>) {
        for bound in bounds {
            // `?Sized` and lifetimes of the function ask nothing of the platform.
            match bound {
                TypeParamBound::Lifetime(lifetime) => self.is_static |= lifetime.ident == "static",
                TypeParamBound::Trait(bound) => {
                    self.note(bound.lifetimes.as_ref());
                    let plain = matches!(bound.modifier, syn::TraitBoundModifier::None);
                    if plain && !self.traits.contains(&bound.path) {
                        self.traits.push(bound.path.clone());
                    }
                }
                _ => {}
            }
        }
    }

    fn note(&mut self, lifetimes: Option<&BoundLifetimes>) {
        let names = Names::in_tree(|names| {
            lifetimes
                .into_iter()
                .for_each(|one| names.visit_bound_lifetimes(one));
        });
        self.of_for.extend(names.introduced);
    }

    fn extend_from_generics(&mut self, method: &ImplItemFn, parameter: &Ident) {
        for declared in method.sig.generics.type_params() {
            if declared.ident == *parameter {
                self.extend(&declared.bounds);
            }
        }
        let clause = method.sig.generics.where_clause.iter();
        for predicate in clause.flat_map(|clause| &clause.predicates) {
            if let WherePredicate::Type(predicate) = predicate
                && is_parameter(&predicate.bounded_ty, parameter)
            {
                self.note(predicate.lifetimes.as_ref());
                self.extend(&predicate.bounds);
            }
        }
    }
}

/// What a bound names that stands in the signature alone: generated code has the bound and not the signature.
fn stranger_in_bound(
    expected: &Expected<'_>,
    bound: &Path,
    parameter: Option<&Ident>,
    of_for: &[Lifetime],
) -> Option<Mistake> {
    let names = Names::in_tree(|names| names.visit_path(bound));
    if let Some(lifetime) = names.stranger()
        && of_for.contains(lifetime)
    {
        let message = format!(
            "`{}` asks for a trait with every `{lifetime}`, which generated code cannot do: declare it at methods of the trait",
            expected.function
        );
        return Some(expected.mistake(lifetime.span(), message));
    }
    let (what, span) = match (names.stranger(), parameter) {
        (Some(lifetime), _) => (lifetime.to_string(), lifetime.span()),
        (None, Some(parameter)) if names.identifiers.contains(parameter) => {
            (parameter.to_string(), bound.span())
        }
        _ => return None,
    };
    let message = format!(
        "`{}` asks for a trait with `{what}`, which only its signature knows",
        expected.function
    );
    Some(expected.mistake(span, message))
}

/// A predicate that says more of the hardware than which traits it has.
fn lost_predicate(
    expected: &Expected<'_>,
    method: &ImplItemFn,
    parameter: &Ident,
) -> Option<Mistake> {
    let clause = method.sig.generics.where_clause.iter();
    let lost =
        clause
            .flat_map(|clause| &clause.predicates)
            .find_map(|predicate| match predicate {
                WherePredicate::Type(predicate)
                    if !is_parameter(&predicate.bounded_ty, parameter) =>
                {
                    let bounded = &predicate.bounded_ty;
                    let names = Names::in_tree(|names| names.visit_type(bounded));
                    names.identifiers.contains(parameter).then_some(bounded)
                }
                _ => None,
            })?;
    let message = format!(
        "`{}` asks for traits of `{}`: only those of `{parameter}` itself can be asked for",
        expected.function,
        written(lost)
    );
    Some(expected.mistake(lost.span(), message))
}

fn is_parameter(data: &Type, parameter: &Ident) -> bool {
    matches!(peel(data), Type::Path(path) if path.qself.is_none() && path.path.is_ident(parameter))
}

/// Names in a part of a signature.
#[derive(Default)]
struct Names {
    /// With which paths begin.
    identifiers: Vec<Ident>,
    lifetimes: Vec<Lifetime>,
    /// Lifetimes that a `for<…>` in it introduces.
    introduced: Vec<Lifetime>,
}

impl Names {
    fn in_tree(visit: impl FnOnce(&mut Self)) -> Self {
        let mut names = Self::default();
        visit(&mut names);
        names
    }

    /// A lifetime that comes from outside.
    fn stranger(&self) -> Option<&Lifetime> {
        let mut lifetimes = self.lifetimes.iter();
        lifetimes.find(|one| one.ident != "static" && !self.introduced.contains(one))
    }
}

impl<'ast> Visit<'ast> for Names {
    fn visit_path(&mut self, path: &'ast Path) {
        let first = path.segments.first().map(|first| first.ident.clone());
        self.identifiers.extend(first);
        visit::visit_path(self, path);
    }

    fn visit_lifetime(&mut self, lifetime: &'ast Lifetime) {
        self.lifetimes.push(lifetime.clone());
    }

    fn visit_lifetime_param(&mut self, parameter: &'ast LifetimeParam) {
        self.introduced.push(parameter.lifetime.clone());
    }
}

/// The type that a context is given; lifetimes do not count.
fn interface_argument(context: &PathSegment) -> Option<&Type> {
    let PathArguments::AngleBracketed(arguments) = &context.arguments else {
        return None;
    };
    arguments.args.iter().find_map(|argument| match argument {
        GenericArgument::Type(Type::Infer(_)) => None,
        GenericArgument::Type(data) => Some(data),
        _ => None,
    })
}

fn parameter_name<'method>(method: &'method ImplItemFn, data: &Type) -> Option<&'method Ident> {
    let written = last_segment(data)?;
    let mut parameters = method.sig.generics.type_params();
    parameters
        .find(|parameter| parameter.ident == written.ident)
        .map(|parameter| &parameter.ident)
}

/// The struct has an `Interface` exactly where it has a field `HardwareInterface`.
fn agreement_mistake(
    expected: &Expected<'_>,
    context: &PathSegment,
    interface: Option<&Type>,
) -> Option<Mistake> {
    let (function, name) = (expected.function, expected.context.name());
    match (expected.hardware?, interface) {
        (true, None) => {
            let message = format!(
                "`{function}` does not name the hardware traits of the `HardwareInterface` in `{name}`"
            );
            Some(expected.mistake(context.ident.span(), message))
        }
        (false, Some(interface)) => {
            let message = format!("`{name}` has no field `HardwareInterface`");
            Some(expected.mistake(interface.span(), message))
        }
        _ => None,
    }
}

/// A type or const parameter that no argument gives a meaning.
fn stray_parameter(
    expected: &Expected<'_>,
    method: &ImplItemFn,
    interface: Option<&Ident>,
) -> Option<Mistake> {
    let stray = method
        .sig
        .generics
        .params
        .iter()
        .find_map(|parameter| match parameter {
            GenericParam::Lifetime(_) => None,
            GenericParam::Type(parameter) => {
                (Some(&parameter.ident) != interface).then_some(&parameter.ident)
            }
            GenericParam::Const(parameter) => Some(&parameter.ident),
        })?;
    let message = format!("nothing tells what `{stray}` of `{}` is", expected.function);
    Some(expected.mistake(stray.span(), message))
}
