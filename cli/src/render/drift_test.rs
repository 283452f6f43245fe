//! `tests/drift.rs`.

use camino::Utf8Path;
use quote::quote;

use super::layout;

/// The test that fails when the crate in this folder is not current.
pub(super) fn render_drift_test(folder: &Utf8Path) -> String {
    let way = "/..".repeat(folder.components().count());
    let items = quote! {
        #[test]
        fn the_generated_crate_is_current() {
            ::framework::testing::assert_generated(concat!(env!("CARGO_MANIFEST_DIR"), #way));
        }
    };
    let title = "This crate is what hulkgen would write now.";
    layout::rust_file(title, &["framework::testing".to_owned()], items)
}
