//! Attributes and derives of which it is known that they write no `impl` of a robot's trait.

use syn::punctuated::Punctuated;
use syn::{Attribute, Meta, Token};

/// Derives of the standard library, serde and the framework implement no trait of a robot.
pub(in crate::scan) fn derives_nothing_unknown(attributes: &[Attribute]) -> bool {
    const KNOWN: &[&str] = &[
        "Clear",
        "Clone",
        "Copy",
        "Debug",
        "Default",
        "Deserialize",
        "Eq",
        "Hash",
        "Ord",
        "PartialEq",
        "PartialOrd",
        "Reflect",
        "Serialize",
    ];
    let mut all = true;
    for attribute in attributes
        .iter()
        .filter(|one| one.path().is_ident("derive"))
    {
        let parsed = attribute.parse_nested_meta(|meta| {
            let last = meta.path.segments.last();
            all &= last.is_some_and(|last| KNOWN.contains(&last.ident.to_string().as_str()));
            Ok(())
        });
        all &= parsed.is_ok();
    }
    all
}

/// Attributes of rustc, and two that only change what they stand at.
const WRITING_NOTHING: &[&str] = &[
    "allow",
    "automatically_derived",
    "cfg",
    "cold",
    "context",
    "deny",
    "deprecated",
    "derive",
    "doc",
    "expect",
    "forbid",
    "global_allocator",
    "ignore",
    "inline",
    "link",
    "link_name",
    "link_section",
    "macro_export",
    "macro_use",
    "must_use",
    "no_mangle",
    "non_exhaustive",
    "repr",
    "serde",
    "should_panic",
    "target_feature",
    "test",
    "track_caller",
    "unsafe",
    "used",
    "warn",
];

/// Attributes with these in front are for tools.
const TOOLS: &[&str] = &["clippy", "diagnostic", "rust_analyzer", "rustfmt"];

/// Whether an attribute of an item certainly adds no other item.
pub(in crate::scan) fn writes_nothing(attribute: &Attribute) -> bool {
    match &attribute.meta {
        Meta::List(list) if list.path.is_ident("cfg_attr") => {
            let conditional = Punctuated::<Meta, Token![,]>::parse_terminated;
            list.parse_args_with(conditional)
                .is_ok_and(|metas| metas.iter().skip(1).all(|meta| is_known(meta.path())))
        }
        meta => meta.path().is_ident("path") || is_known(meta.path()),
    }
}

fn is_known(path: &syn::Path) -> bool {
    let Some(first) = path.segments.first() else {
        return false;
    };
    let known = match path.segments.len() {
        1 => WRITING_NOTHING,
        _ => TOOLS,
    };
    known.contains(&first.ident.to_string().as_str())
}
