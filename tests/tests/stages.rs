//! The fixture robots after each stage, as `hulkgen show` prints them.

use hulkgen::commands::show;
use hulkgen::diagnostics::{self, Diagnostics};
use hulkgen::pipeline;
use support::{FIXTURES, fixture, purpose, root};

#[test]
fn every_fixture_robot_after_every_stage() {
    for name in FIXTURES {
        let workspace = fixture(name);
        let mut diagnostics = Diagnostics::new();
        let understood = pipeline::understand(&workspace, &mut diagnostics)
            .unwrap_or_else(|_| panic!("{}", diagnostics::render(&diagnostics, &workspace, false)));
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path(root().join("snapshots/stages"));
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.set_description(purpose(name));
        settings.bind(|| {
            insta::assert_snapshot!(
                format!("{name}__robot"),
                show::robot::text(&understood.robot)
            );
            insta::assert_snapshot!(
                format!("{name}__schedule"),
                show::schedule::text(&understood.robot, &understood.schedule)
            );
        });
    }
}
