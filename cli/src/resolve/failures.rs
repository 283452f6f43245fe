//! Whether what the functions of nodes return where they fail becomes the framework's error, where that can be known.

use syn::spanned::Spanned;

use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::scan::failure::Failure;
use crate::scan::{NodeSource, Sources, range};

/// Adds an error for each result whose error surely does not convert; the number of those that are left to rustc.
pub(super) fn check<'a>(
    nodes: impl Iterator<Item = &'a NodeSource>,
    sources: &Sources<'_>,
    diagnostics: &mut Diagnostics,
) -> usize {
    let mut unknown = 0;
    for node in nodes {
        let signatures = &node.signatures;
        let functions = [
            ("new", Some(&signatures.new)),
            ("cycle", Some(&signatures.cycle)),
            ("restore", signatures.restore.as_ref()),
        ];
        for (function, signature) in functions {
            let Some(signature) = signature else { continue };
            let place = range(signature.returns.span());
            let found = sources.library.failure(&node.module, &signature.returns);
            let error = match found {
                Failure::Converts => continue,
                Failure::Unknown => {
                    unknown += 1;
                    continue;
                }
                Failure::Never(error) => {
                    let message =
                        format!("`{error}`, with which `{function}` may fail, is no error");
                    Diagnostic::new(Code::InvalidSignature, message)
                        .at(node.file(), place, "generated code turns it into `framework::Error`")
                        .help("return `framework::Result`, or a result whose error implements `std::error::Error`")
                }
                Failure::Private(item) => {
                    let message = format!("`{}` is private", item.path());
                    let defined = sources.library.name_range(&item);
                    Diagnostic::new(Code::NotPublic, message)
                        .at(
                            &item.module.file,
                            defined,
                            "not visible for the generated crate",
                        )
                        .at(node.file(), place, format!("`{function}` may fail with it"))
                        .help(format!("write `pub` at `{}`", item.name))
                }
            };
            diagnostics.add(error);
        }
    }
    unknown
}
