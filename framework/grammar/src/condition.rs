//! What stands under a `#[cfg(…)]`.

use syn::punctuated::Punctuated;
use syn::{Attribute, Meta, Token};

/// Whether a `#[cfg(…)]` decides about what these stand at.
#[must_use]
pub fn is_conditional(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|one| one.path().is_ident("cfg"))
}

/// `#[cfg(test)]`, also among other conditions that all have to hold.
#[must_use]
pub fn only_for_tests(attributes: &[Attribute]) -> bool {
    let conditions = attributes.iter().filter(|one| one.path().is_ident("cfg"));
    conditions
        .filter_map(|one| one.parse_args().ok())
        .any(|condition| is_test(&condition))
}

/// A `#[cfg_attr(test, …)]`: whatever it writes is not there in a robot.
#[must_use]
pub fn is_written_for_tests(attribute: &Attribute) -> bool {
    if !attribute.path().is_ident("cfg_attr") {
        return false;
    }
    let parts = attribute.parse_args_with(Punctuated::<Meta, Token![,]>::parse_terminated);
    parts.is_ok_and(|parts| parts.first().is_some_and(is_test))
}

fn is_test(condition: &Meta) -> bool {
    match condition {
        Meta::Path(path) => path.is_ident("test"),
        Meta::List(list) if list.path.is_ident("all") => list
            .tokens
            .clone()
            .into_iter()
            .any(|token| token.to_string() == "test"),
        _ => false,
    }
}
