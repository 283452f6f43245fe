//! What stands between the angle brackets of a kind.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, ExprLit, GenericArgument, Lit, LitStr, PathArguments, PathSegment, Type};

use super::written;
use crate::kind::Kind;
use crate::mistake::{Mistake, Rule};

/// How many arguments a kind takes.
#[derive(Clone, Copy)]
pub(super) struct Arity {
    pub(super) types: usize,
    pub(super) fewest_literals: usize,
    pub(super) most_literals: usize,
}

/// Types and strings of a kind, in their order.
pub(super) struct Arguments {
    pub(super) types: Vec<Type>,
    pub(super) literals: Vec<LitStr>,
}

impl Arity {
    pub(super) fn of(kind: Kind) -> Self {
        let (types, fewest_literals, most_literals) = match kind {
            Kind::CaptureTime | Kind::CycleTime | Kind::HardwareInterface => (0, 0, 0),
            Kind::MainOutput => (1, 0, 0),
            Kind::Input | Kind::RequiredInput => (1, 1, 2),
            Kind::LatestInput | Kind::PerceptionInput => (1, 2, 2),
            Kind::Procedure => (2, 1, 1),
            Kind::AdditionalOutput
            | Kind::CyclerState
            | Kind::HistoricInput
            | Kind::Parameter
            | Kind::PreviousInput => (1, 1, 1),
        };
        Self {
            types,
            fewest_literals,
            most_literals,
        }
    }
}

impl Arguments {
    /// Reads them; an argument that is neither a type nor a string is left out and told.
    pub(super) fn read(
        kind: Kind,
        segment: &PathSegment,
        whole: Span,
        mistakes: &mut Vec<Mistake>,
    ) -> Self {
        let mut arguments = Self {
            types: Vec::new(),
            literals: Vec::new(),
        };
        let before = mistakes.len();
        match &segment.arguments {
            PathArguments::None => {}
            PathArguments::AngleBracketed(bracketed) => {
                for argument in &bracketed.args {
                    mistakes.extend(arguments.take(kind, argument));
                }
            }
            PathArguments::Parenthesized(parenthesized) => {
                mistakes.push(unexpected(kind, parenthesized.span(), "`(…)`"));
            }
        }
        if mistakes.len() == before {
            mistakes.extend(arguments.count(kind, whole));
        }
        arguments
    }

    fn take(&mut self, kind: Kind, argument: &GenericArgument) -> Option<Mistake> {
        match argument {
            GenericArgument::Type(data) if self.literals.is_empty() => {
                self.types.push(data.clone())
            }
            GenericArgument::Type(data) => {
                let what = format!("`{}` behind a string", written(data));
                return Some(unexpected(kind, data.span(), &what));
            }
            GenericArgument::Const(expression) => match string(expression) {
                Some(literal) => self.literals.push(literal),
                None => {
                    let what = format!("`{}`, which is no string", written(expression));
                    return Some(unexpected(kind, expression.span(), &what));
                }
            },
            other => {
                let what = format!("`{}`", written(other));
                return Some(unexpected(kind, other.span(), &what));
            }
        }
        None
    }

    fn count(&self, kind: Kind, whole: Span) -> Option<Mistake> {
        let arity = Arity::of(kind);
        let (types, literals) = (self.types.len(), self.literals.len());
        let what = if types < arity.types {
            "lacks a type"
        } else if types > arity.types {
            "has too many types"
        } else if literals < arity.fewest_literals {
            match kind {
                Kind::LatestInput | Kind::PerceptionInput if literals == 1 => {
                    "needs an instance and a path"
                }
                Kind::Procedure => "lacks its name",
                _ => "lacks its path",
            }
        } else if literals > arity.most_literals {
            "has too many strings"
        } else {
            return None;
        };
        let message = format!("`{}` {what}: expected {}", kind.name(), kind.form());
        Some(Mistake::new(Rule::InvalidField, whole, message))
    }
}

fn unexpected(kind: Kind, span: Span, what: &str) -> Mistake {
    let message = format!("unexpected {what}: expected {}", kind.form());
    Mistake::new(Rule::InvalidField, span, message)
}

fn string(expression: &Expr) -> Option<LitStr> {
    match expression {
        Expr::Lit(ExprLit {
            lit: Lit::Str(literal),
            ..
        }) => Some(literal.clone()),
        Expr::Group(group) => string(&group.expr),
        Expr::Paren(paren) => string(&paren.expr),
        _ => None,
    }
}
