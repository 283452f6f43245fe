//! What an author reads when something is wrong: fixture robots with one mistake each, whole reports.

use hulkgen::diagnostics::{self, Diagnostics};
use hulkgen::pipeline;
use hulkgen::workspace::Workspace;
use support::{fixture_files, root};

/// A mistake: the code it is reported as, and what is written instead of what in which file of which robot.
struct Mistake {
    code: &'static str,
    robot: &'static str,
    file: &'static str,
    right: &'static str,
    wrong: &'static str,
}

const MISTAKES: &[Mistake] = &[
    Mistake {
        code: "unknown-node",
        robot: "two_instances",
        file: "hulk.toml",
        right: "nodes::doubler",
        wrong: "nodes::dubler",
    },
    Mistake {
        code: "unknown-key",
        robot: "two_instances",
        file: "hulk.toml",
        right: "deadline =",
        wrong: "dead_line =",
    },
    Mistake {
        code: "unknown-output",
        robot: "two_instances",
        file: "nodes/src/doubler.rs",
        right: "\"value\"",
        wrong: "\"valve\"",
    },
    Mistake {
        code: "type-mismatch",
        robot: "two_instances",
        file: "nodes/src/doubler.rs",
        right: "Input<f32,",
        wrong: "Input<f64,",
    },
    Mistake {
        code: "option-mismatch",
        robot: "required_input",
        file: "nodes/src/maybe.rs",
        right: "MainOutput<Option<u8>>",
        wrong: "MainOutput<u8>",
    },
    Mistake {
        code: "unknown-instance",
        robot: "perception_and_real_time",
        file: "nodes/src/filter.rs",
        right: "\"Vision\"",
        wrong: "\"VisionTopp\"",
    },
    Mistake {
        code: "dependency-cycle",
        robot: "perception_and_real_time",
        file: "nodes/src/pace.rs",
        right: "    time: CycleTime,",
        wrong: "    time: CycleTime,\n    estimate: framework::Input<f32, \"estimate\">,",
    },
    Mistake {
        code: "misplaced-kind",
        robot: "two_instances",
        file: "nodes/src/doubler.rs",
        right: "pub struct CreationContext {}",
        wrong: "pub struct CreationContext {\n    value: Input<f32, \"value\">,\n}",
    },
    Mistake {
        code: "missing-parameter",
        robot: "two_instances",
        file: "parameters/default.toml",
        right: "start = 2.0",
        wrong: "",
    },
    Mistake {
        code: "missing-parameter-file",
        robot: "two_instances",
        file: "hulk.toml",
        right: "parameters = \"parameters\"",
        wrong: "parameters = \"elsewhere\"",
    },
    Mistake {
        code: "unordered-state-writers",
        robot: "cycler_state",
        file: "nodes/src/reader.rs",
        right: "CyclerState<&u64,",
        wrong: "CyclerState<u64,",
    },
    Mistake {
        code: "state-of-one-node",
        robot: "cycler_state",
        file: "hulk.toml",
        right: "\"nodes::reader\", ",
        wrong: "",
    },
];

fn report(mistake: &Mistake) -> (Vec<&'static str>, String) {
    let mut files = fixture_files(mistake.robot);
    let file = files.iter_mut().find(|(path, _)| path == mistake.file);
    let (_, text) = file.unwrap_or_else(|| panic!("{} has no {}", mistake.robot, mistake.file));
    assert!(
        text.contains(mistake.right),
        "{}: {}",
        mistake.file,
        mistake.right
    );
    *text = text.replacen(mistake.right, mistake.wrong, 1);
    let workspace = Workspace::in_memory(files);
    let mut found = Diagnostics::new();
    let _understood = pipeline::understand(&workspace, &mut found);
    let codes = found.sorted().iter().map(|one| one.code.name()).collect();
    (codes, diagnostics::render(&found, &workspace, false))
}

#[test]
fn every_mistake_is_reported_where_it_is_mended() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(root().join("snapshots/diagnostics"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    for mistake in MISTAKES {
        let (codes, text) = report(mistake);
        assert!(
            codes.contains(&mistake.code),
            "{}: {codes:?}\n{text}",
            mistake.code
        );
        let files: Vec<_> = text.lines().filter(|line| line.contains("-->")).collect();
        assert!(!files.is_empty(), "no place in {text}");
        settings.set_description(format!(
            "{}: `{}` instead of `{}` in {}",
            mistake.robot, mistake.wrong, mistake.right, mistake.file
        ));
        settings.bind(|| insta::assert_snapshot!(mistake.code, text));
    }
}

#[test]
fn the_fixture_robots_have_no_mistakes() {
    for name in support::FIXTURES {
        let workspace = support::fixture(name);
        let mut found = Diagnostics::new();
        let understood = pipeline::understand(&workspace, &mut found);
        let text = diagnostics::render(&found, &workspace, false);
        assert!(understood.is_ok() && !found.has_errors(), "{name}: {text}");
    }
}

#[test]
fn every_code_has_a_page() {
    for code in diagnostics::Code::ALL {
        assert!(
            code.title().ends_with('.'),
            "{}: {}",
            code.name(),
            code.title()
        );
        assert!(code.explanation().len() > 80, "{}", code.name());
        assert_eq!(diagnostics::Code::from_name(code.name()), Some(*code));
    }
    for mistake in MISTAKES {
        assert!(
            diagnostics::Code::from_name(mistake.code).is_some(),
            "{}",
            mistake.code
        );
    }
}
