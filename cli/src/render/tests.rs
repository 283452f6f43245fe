//! What is rendered for the walker, and what holds for every robot.

use super::*;
use crate::model::DO_NOT_EDIT;
use crate::model::tests::{model_of, node, perception, real_time, robot, walker};

/// Compares a file of the walker with what was reviewed.
fn assert_reviewed(path: &str) {
    let files = render(&model_of(&walker()));
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../snapshots/render/walker"
    ));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        insta::assert_snapshot!(
            path.replace('/', "__"),
            files[&Utf8PathBuf::from("generated").join(path)]
        );
    });
}

#[test]
fn the_package_inherits_and_hides_hardware_behind_features() {
    assert_reviewed("Cargo.toml");
}

#[test]
fn the_data_flow_is_one_line_per_fact() {
    assert_reviewed("DATAFLOW.md");
}

#[test]
fn parameters_are_one_tree_of_structs() {
    assert_reviewed("src/parameters.rs");
}

#[test]
fn a_database_has_only_what_its_cycler_uses() {
    assert_reviewed("src/databases/vision.rs");
    assert_reviewed("src/databases/control.rs");
}

#[test]
fn nodes_have_one_function_each() {
    assert_reviewed("src/cyclers/vision.rs");
    assert_reviewed("src/cyclers/control.rs");
}

#[test]
fn a_body_stands_between_buffers_and_nodes() {
    assert_reviewed("src/runtime/vision.rs");
    assert_reviewed("src/runtime/control.rs");
}

#[test]
fn the_runtime_connects_all_instances() {
    assert_reviewed("src/runtime.rs");
    assert_reviewed("src/bin/nao.rs");
}

#[test]
fn every_file_names_its_origin_and_every_source_parses() {
    for (path, text) in render(&model_of(&walker())) {
        assert!(
            text.contains(DO_NOT_EDIT),
            "{path} does not say where it comes from"
        );
        assert!(
            text.ends_with('\n') && !text.ends_with("\n\n"),
            "{path} ends oddly"
        );
        assert!(
            text.lines().all(|line| line == line.trim_end()),
            "{path} has trailing spaces"
        );
        if path.extension() == Some("rs") {
            syn::parse_file(&text).unwrap_or_else(|error| panic!("{path}: {error}"));
        }
        if path.extension() == Some("toml") {
            text.parse::<toml::Table>()
                .unwrap_or_else(|error| panic!("{path}: {error}"));
        }
    }
}

#[test]
fn the_same_robot_gives_the_same_bytes() {
    assert_eq!(render(&model_of(&walker())), render(&model_of(&walker())));
}

#[test]
fn another_node_adds_lines_and_changes_none() {
    let with = |more: bool| {
        let mut cycler = real_time("Control")
            .setup(node("control::a").output("a", "f32"))
            .node(node("control::b").input("a", "f32", "a").output("b", "f32"));
        if more {
            cycler = cycler.node(node("control::c").input("b", "f32", "b").output("c", "f32"));
        }
        let files = render(&model_of(&robot(vec![cycler])));
        files[&Utf8PathBuf::from("generated/src/cyclers/control.rs")].clone()
    };
    let (before, after) = (with(false), with(true));
    let diff = similar::TextDiff::from_lines(&before, &after);
    let removed = diff
        .iter_all_changes()
        .filter(|change| change.tag() == similar::ChangeTag::Delete);
    assert_eq!(removed.count(), 0);
}

#[test]
fn a_robot_of_one_node_without_any_field_is_still_a_robot() {
    let files = render(&model_of(&robot(vec![
        real_time("Control").node(node("control::a")),
    ])));
    let database = &files[&Utf8PathBuf::from("generated/src/databases/control.rs")];
    assert!(
        database.contains("pub struct Frame {\n    pub cycle: Cycle,\n}"),
        "{database}"
    );
    assert!(!database.contains("OwnOutputs"), "{database}");
}

#[test]
fn keywords_are_names_like_others() {
    let files = render(&model_of(&robot(vec![
        perception("Type", &[])
            .setup(node("vision::r#match").output("r#in", "f32"))
            .node(node("vision::b").input("r#in", "f32", "r#in")),
    ])));
    assert!(files.contains_key(&Utf8PathBuf::from("generated/src/databases/type.rs")));
    let nodes = &files[&Utf8PathBuf::from("generated/src/cyclers/type.rs")];
    assert!(nodes.contains("r#in: &frame.own.r#in"), "{nodes}");
    let database = &files[&Utf8PathBuf::from("generated/src/databases/type.rs")];
    assert!(
        database.contains("\"in\" => Some(&mut self.r#in)"),
        "{database}"
    );
}

#[test]
fn a_keyword_of_the_latest_edition_is_a_name_of_older_crates() {
    let files = render(&model_of(&robot(vec![
        real_time("Control")
            .node(node("control::a").output("a", "types::gen::Wide"))
            .node(node("control::b").input("gen", "types::gen::Wide", "a")),
    ])));
    let text = |path: &str| &files[&Utf8PathBuf::from("generated/src").join(path)];
    let database = text("databases/control.rs");
    assert!(database.contains("use types::r#gen::Wide;"), "{database}");
    let nodes = text("cyclers/control.rs");
    assert!(nodes.contains("r#gen: &frame.own.a"), "{nodes}");
}

#[test]
fn names_of_the_prelude_are_names_like_others() {
    let files = render(&model_of(&robot(vec![
        real_time("Option").node(
            node("control::a")
                .parameter("x", "Option<u8>", "self_.x")
                .parameter("y", "u8", "option.y")
                .procedure("z", "u8", "u8", "type_"),
        ),
    ])));
    let text = |path: &str| &files[&Utf8PathBuf::from("generated/src").join(path)];
    let parameters = text("parameters.rs");
    assert!(parameters.contains("pub self_: Self2,"), "{parameters}");
    assert!(parameters.contains("pub option: Option2,"), "{parameters}");
    let body = text("runtime/option.rs");
    assert!(body.contains("impl Body for Option2 {"), "{body}");
    let runtime = text("runtime.rs");
    assert!(runtime.contains("option::Option2 {"), "{runtime}");
    assert!(
        runtime.contains("let (option_type, option_type_answerer) = procedure();"),
        "{runtime}"
    );
}

#[test]
fn instances_are_called_like_what_stands_beside_them() {
    let files = render(&model_of(&robot(vec![
        perception("Additional", &["Outputs"]).node(
            node("vision::a")
                .additional("extra", "f32", "extra")
                .output("ball", "f32"),
        ),
        perception("Horizon", &[]).node(node("vision::b").output("line", "f32")),
        real_time("Control").node(
            node("control::a")
                .perception("balls", "f32", "Additional", "ball")
                .perception("lines", "f32", "Horizon", "line"),
        ),
    ])));
    let text = |path: &str| &files[&Utf8PathBuf::from("generated/src").join(path)];
    let body = text("runtime/additional.rs");
    let constant = "pub const ADDITIONAL_OUTPUTS: InstanceDescription";
    assert!(body.contains(constant), "{body}");
    assert!(body.contains("pub const ADDITIONAL_OUTPUTS2: "), "{body}");
    let names = "additional::ADDITIONAL_OUTPUTS2";
    assert!(text("runtime.rs").contains(names), "{}", text("runtime.rs"));
    let replay = text("recording/additional.rs");
    assert!(replay.contains(names), "{replay}");
    let database = text("databases/control.rs");
    assert!(database.contains("pub horizon2: Horizon,"), "{database}");
    let body = text("runtime/control.rs");
    assert!(body.contains(".horizon2"), "{body}");
    let runtime = text("runtime.rs");
    assert!(runtime.contains("horizon2: Horizon::new()"), "{runtime}");
}

#[test]
fn a_value_of_the_instance_below_a_struct_that_is_read_whole_has_the_type_its_reader_wrote() {
    let files = render(&model_of(&robot(vec![
        real_time("Control").node(
            node("control::a")
                .parameter("whole", "types::Arms", "p")
                .parameter("other", "types::Hands", "q")
                .parameter("through", "f32", "p.$cycler_instance.x")
                .parameter("own", "f32", "p.$cycler_instance")
                .parameter("below", "Option<types::Grip>", "q.$cycler_instance.grip?"),
        ),
    ])));
    let file = |path: &str| files[&Utf8PathBuf::from("generated").join(path)].as_str();
    let all = [
        "src/databases/control.rs",
        "src/runtime/control.rs",
        "src/runtime.rs",
    ];
    let all: String = all.iter().map(|path| file(path)).collect();
    for text in [
        "pub instance_p: &'a f32,",
        "pub instance_q_grip: Option<&'a Grip>,",
        "pub select_p: fn(&Parameters) -> &f32,",
        "pub select_q_grip: fn(&Parameters) -> Option<&Grip>,",
        "select_p: |parameters| &parameters.p.control,",
        "select_q_grip: |parameters| parameters.q.control.grip.as_ref(),",
    ] {
        assert!(all.contains(text), "{text}\n{all}");
    }
}

#[test]
fn nodes_are_created_in_the_order_in_which_they_read_states() {
    let files = render(&model_of(&robot(vec![
        real_time("Control")
            .node(
                node("control::reader")
                    .new_reads_state("x", "f32", "gain")
                    .restores(),
            )
            .node(
                node("control::writer")
                    .new_state("x", "f32", "gain")
                    .restores(),
            ),
    ])));
    let nodes = &files[&Utf8PathBuf::from("generated/src/cyclers/control.rs")];
    for (first, second) in [
        ("Self::create_writer(", "Self::create_reader("),
        ("self.writer.node_mut()", "self.reader.node_mut()"),
    ] {
        let (first, second) = (nodes.find(first), nodes.find(second));
        assert!(first.is_some() && first < second, "{nodes}");
    }
}

#[test]
fn inputs_that_are_called_alike_are_variables_of_their_own() {
    let files = render(&model_of(&robot(vec![
        real_time("Control")
            .node(
                node("control::a")
                    .output("x", "Option<u8>")
                    .output("y", "Option<u8>"),
            )
            .node(
                node("control::b")
                    .required("frame", "Option<u8>", "x?")
                    .required("frame_input", "Option<u8>", "y?")
                    .historic("frame_input_input", "Option<u8>", "x"),
            ),
    ])));
    let nodes = &files[&Utf8PathBuf::from("generated/src/cyclers/control.rs")];
    for text in [
        "let Some(frame_input_input_input) = frame.own.x.as_ref()",
        "let Some(frame_input) = frame.own.y.as_ref()",
        "frame: frame_input_input_input,",
    ] {
        assert!(nodes.contains(text), "{text} is not in {nodes}");
    }
}

#[test]
fn names_of_parameters_that_begin_with_no_letter_are_names_like_others() {
    let files = render(&model_of(&robot(vec![
        real_time("Control").node(
            node("control::a")
                .parameter("x", "f32", "_1.x")
                .parameter("y", "f32", "__.y")
                .parameter("z", "f32", "__._2.z"),
        ),
    ])));
    let parameters = &files[&Utf8PathBuf::from("generated/src/parameters.rs")];
    for text in [
        "pub _1: Group1,",
        "pub struct Group1 {",
        "pub __: Group,",
        "pub _2: Group2,",
    ] {
        assert!(parameters.contains(text), "{text} is not in {parameters}");
    }
}
