//! What hulkgen writes for the fixture robots: the answer to "what did my change to the generator do?".

use hulkgen::diagnostics::{self, Diagnostics};
use hulkgen::pipeline;
use hulkgen::render::GeneratedFiles;
use hulkgen::workspace::Workspace;
use support::{FIXTURES, fixture, fixture_files, purpose, root};

fn generate(workspace: &Workspace) -> GeneratedFiles {
    let mut diagnostics = Diagnostics::new();
    pipeline::generate(workspace, &mut diagnostics)
        .unwrap_or_else(|_| panic!("{}", diagnostics::render(&diagnostics, workspace, false)))
}

#[test]
fn every_file_of_every_fixture_robot() {
    for name in FIXTURES {
        let files = generate(&fixture(name));
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path(root().join("snapshots/generate").join(name));
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.set_description(purpose(name));
        settings.bind(|| {
            for (path, text) in &files {
                let path = path.as_str().trim_start_matches("generated/");
                insta::assert_snapshot!(path.replace('/', "__"), text);
            }
        });
    }
}

#[test]
fn the_order_in_which_files_are_given_changes_nothing() {
    for name in FIXTURES {
        let mut files = fixture_files(name);
        let forwards = generate(&Workspace::in_memory(files.clone()));
        files.reverse();
        assert_eq!(forwards, generate(&Workspace::in_memory(files)), "{name}");
    }
}

#[test]
fn what_lies_in_the_generated_folder_changes_nothing() {
    for name in FIXTURES {
        let mut files = fixture_files(name);
        let clean = generate(&Workspace::in_memory(files.clone()));
        for path in clean.keys() {
            files.push((
                path.to_string(),
                "<<<<<<< ours\n=======\n>>>>>>> theirs\n".to_owned(),
            ));
        }
        assert_eq!(clean, generate(&Workspace::in_memory(files)), "{name}");
    }
}
