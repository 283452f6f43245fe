//! What users of the framework and of the schema rely on: a change of it is to be seen in a review.

use support::api::public_api;
use support::root;

#[test]
fn the_public_interface_changes_only_on_purpose() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(root().join("snapshots/api"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        for (name, folder) in [("framework", "framework/src"), ("schema", "schema/src")] {
            insta::assert_snapshot!(name, public_api(folder));
        }
    });
}
