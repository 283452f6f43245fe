//! `tests/drift.rs`.

use camino::Utf8Path;
use quote::quote;

use super::layout;

/// The test that fails when the crate in this folder is not current.
///
/// `options` are those of the `hulkgen generate` that writes it.
pub(super) fn render_drift_test(folder: &Utf8Path, options: &[String]) -> String {
    let way = "/..".repeat(folder.components().count());
    let root = quote!(concat!(env!("CARGO_MANIFEST_DIR"), #way));
    let assertion = if options.is_empty() {
        quote!(::framework::testing::assert_generated(#root))
    } else {
        quote!(::framework::testing::assert_generated_with(#root, &[#(#options),*]))
    };
    let items = quote! {
        #[test]
        fn the_generated_crate_is_current() {
            #assertion;
        }
    };
    let title = "This crate is what hulkgen would write now.";
    layout::rust_file(title, &["framework::testing".to_owned()], items)
}
