//! Robots made by hand, and what the model decides about them.

mod builder;

use super::*;
use crate::diagnostics::Diagnostics;
use crate::schedule;
use builder::NodeBuilder;
pub(crate) use builder::{node, perception, real_time, robot};

/// A robot with everything that most robots have: two cameras and a body.
pub(crate) fn walker() -> Robot {
    robot(vec![
        perception("Vision", &["Top", "Bottom"])
            .setup(
                node("vision::image_receiver")
                    .new_parameter(
                        "position",
                        "types::CameraPosition",
                        "$cycler_instance.position",
                    )
                    .hardware(&[("hardware::CameraInterface", true)])
                    .in_place("image", "types::Image")
                    .capture_time("captured_at"),
            )
            .node(
                node("vision::ball_detection")
                    .input("image", "types::Image", "image")
                    .required(
                        "camera_matrix",
                        "Option<types::CameraMatrix>",
                        "camera_matrix?",
                    )
                    .parameter("ball_radius", "f32", "field_dimensions.ball_radius")
                    .additional("candidates", "Vec<types::Ball>", "ball_candidates")
                    .output("balls", "Vec<types::Ball>")
                    .on_failure(OnFailure::Skip),
            )
            .node(
                node("vision::camera_matrix_extractor")
                    .required_of("pitch", "f32", "Control", "head_pitch")
                    .output("camera_matrix", "Option<types::CameraMatrix>"),
            ),
        real_time("Control")
            .setup(
                node("control::sensor_data_receiver")
                    .hardware(&[("hardware::SensorInterface", true)])
                    .output("sensor_data", "types::SensorData"),
            )
            .node(
                node("control::ball_filter")
                    .perception("balls", "Vec<types::Ball>", "Vision", "balls")
                    .historic("pose", "types::Pose", "pose")
                    .previous("last", "Option<types::Ball>", "ball?")
                    .output("ball", "Option<types::Ball>")
                    .on_failure(OnFailure::Hold),
            )
            .node(
                node("control::odometry")
                    .cycle_time("cycle_time")
                    .input("sensor_data", "types::SensorData", "sensor_data")
                    .state("walked", "f32", "walked")
                    .output("pose", "types::Pose"),
            )
            .node(
                node("control::motion")
                    .input("ball", "Option<types::Ball>", "ball?")
                    .procedure("walk", "types::Walk", "f32", "walk")
                    .hardware(&[("hardware::ActuatorInterface", false)])
                    .output("head_pitch", "f32"),
            ),
    ])
}

/// The model of a robot without mistakes.
pub(crate) fn model_of(robot: &Robot) -> RuntimeModel {
    let mut diagnostics = Diagnostics::new();
    let schedule = schedule::schedule(robot, &mut diagnostics).expect("the robot has no ring");
    describe(robot, &schedule)
}

fn frame_of(cycler: &CyclerModel) -> Vec<&str> {
    cycler.frame.iter().map(frame::FrameField::name).collect()
}

#[test]
fn a_frame_has_only_what_some_node_needs() {
    let model = model_of(&robot(vec![
        real_time("Control").setup(node("control::a").output("a", "f32")),
    ]));
    assert_eq!(frame_of(&model.cyclers[0]), ["cycle", "injections", "own"]);
    let model = model_of(&walker());
    assert_eq!(
        frame_of(&model.cyclers[1]),
        [
            "cycle",
            "cycler_state",
            "hardware_interface",
            "historic",
            "injections",
            "own",
            "perception",
            "previous",
            "procedures",
            "shared",
        ]
    );
}

#[test]
fn what_new_asks_for_is_in_the_frame_only_if_a_node_is_renewed_there() {
    let legs = || {
        node("control::legs")
            .new_state("phase", "f32", "phase")
            .new_hardware(&[("hardware::SensorInterface", true)])
            .restores()
            .input_of("x", "f32", "Vision", "x")
    };
    let with = |legs: NodeBuilder| {
        model_of(&robot(vec![
            perception("Vision", &[]).setup(node("vision::a").output("x", "f32")),
            real_time("Control").node(legs),
        ]))
    };
    let stopping = with(legs());
    assert_eq!(frame_of(&stopping.cyclers[1]), ["cycle", "latest"]);
    assert!(!stopping.cyclers[1].renews);
    let skipping = with(legs().on_failure(OnFailure::Skip));
    assert_eq!(
        frame_of(&skipping.cyclers[1]),
        ["cycle", "cycler_state", "hardware_interface", "latest"]
    );
    assert!(skipping.cyclers[1].renews);
}

#[test]
fn nodes_that_end_in_the_same_name_are_called_by_their_whole_path() {
    let model = model_of(&robot(vec![
        real_time("Control")
            .node(node("control::filter"))
            .node(node("vision::filter"))
            .node(node("vision::cycle"))
            .node(node("vision::pose")),
    ]));
    let names: Vec<&str> = model.cyclers[0]
        .nodes
        .iter()
        .map(|node| node.name.as_str())
        .collect();
    assert_eq!(
        names,
        ["control_filter", "vision_filter", "cycle_node", "pose"]
    );
}

#[test]
fn functions_of_one_node_are_not_those_of_another() {
    let names_of = |paths: &[&str]| -> Vec<String> {
        let cycler = paths
            .iter()
            .fold(real_time("Control"), |cycler, path| cycler.node(node(path)));
        let model = model_of(&robot(vec![cycler]));
        let nodes = model.cyclers[0].nodes.iter();
        nodes.map(|node| node.name.clone()).collect()
    };
    assert_eq!(
        names_of(&["control::create", "control::node"]),
        ["create_node2", "node"]
    );
    assert_eq!(
        names_of(&["control::pose", "control::create_pose"]),
        ["pose", "create_pose_node"]
    );
    assert_eq!(
        names_of(&["control::cycle", "control::cycle_node"]),
        ["cycle_node", "cycle_node_node"]
    );
    assert_eq!(
        names_of(&["control::create_cycle_node", "control::cycle"]),
        ["create_cycle_node", "cycle_node2"]
    );
}

#[test]
fn structs_of_trees_do_not_hide_the_prelude() {
    let model = model_of(&robot(vec![
        real_time("Control").node(
            node("control::a")
                .parameter("a", "u8", "self_.x")
                .parameter("b", "Option<String>", "option.x")
                .parameter("c", "Vec<u8>", "vec.x")
                .parameter("d", "f32", "reflect.x"),
        ),
    ]));
    let names = model.parameters.structs.iter().map(|one| one.name.as_str());
    assert_eq!(
        names.collect::<Vec<_>>(),
        ["Parameters", "Option2", "Reflect2", "Self2", "Vec2"]
    );
}

#[test]
fn a_cycler_called_like_the_prelude_has_a_body_that_is_not() {
    let body = |name: &str| {
        let model = model_of(&robot(vec![real_time(name).node(node("control::a"))]));
        model.cyclers[0].body.clone()
    };
    assert_eq!(body("Control"), "Control");
    assert_eq!(body("Option"), "Option2");
    assert_eq!(body("Hardware"), "Hardware2");
}

#[test]
fn prefixes_that_join_to_one_name_have_fields_of_their_own() {
    let parts = |prefixes: [&str; 2]| -> Vec<(String, String)> {
        let model = model_of(&robot(vec![
            real_time("Control").node(
                node("control::a")
                    .parameter("a", "u8", &format!("{}$cycler_instance.x", prefixes[0]))
                    .parameter("b", "f32", &format!("{}$cycler_instance.y", prefixes[1])),
            ),
        ]));
        let parts = model.cyclers[0].instance_parameters.iter();
        parts
            .map(|part| (part.field.clone(), part.select.clone()))
            .collect()
    };
    let pairs = |pairs: [(&str, &str); 2]| {
        pairs.map(|(field, select)| (field.to_owned(), select.to_owned()))
    };
    assert_eq!(
        parts(["a.b.", "a_b."]),
        pairs([
            ("instance_a_b", "select_a_b"),
            ("instance_a_b2", "select_a_b2")
        ])
    );
    assert_eq!(
        parts(["", "parameters."]),
        pairs([
            ("instance_parameters", "select"),
            ("instance_parameters2", "select_parameters")
        ])
    );
}

#[test]
fn a_reader_is_not_called_like_what_selects_parameters() {
    let model = model_of(&robot(vec![
        perception("SelectA", &[]).setup(node("vision::a").output("a", "f32")),
        real_time("Control").node(
            node("control::b")
                .latest("a", "f32", "SelectA", "a")
                .parameter("x", "u8", "a.$cycler_instance.x")
                .parameter("y", "u8", "b.$cycler_instance.y"),
        ),
    ]));
    assert_eq!(model.cyclers[1].instance_parameters[0].select, "select_a");
    assert_eq!(model.cyclers[1].latest[0].reader, "select_a2");
}

#[test]
fn no_instance_is_called_like_what_create_has_of_another() {
    let variables = |names: &[&str]| {
        let cyclers = names.iter().enumerate().map(|(index, name)| {
            let path = format!("nodes::n{index}");
            perception(name, &[]).node(node(&path).output("a", "f32"))
        });
        let model = model_of(&robot(cyclers.collect()));
        let instances = model.runtime.instances.into_iter();
        instances.map(|one| one.variable).collect::<Vec<_>>()
    };
    for (names, expected) in [
        (
            &["Control", "ControlInjections"][..],
            &["control", "control_injections2"][..],
        ),
        (&["LogWriter", "Log"], &["log_writer", "log2"]),
        (
            &["Log", "ParametersForLog"],
            &["log", "parameters_for_log2"],
        ),
        (
            &["Eye", "Hand", "EyeForHand", "HandQueueForEye"],
            &["eye", "hand", "eye_for_hand2", "hand_queue_for_eye2"],
        ),
        (&["Eye", "EyeQueue", "Hand"], &["eye", "eye_queue2", "hand"]),
        (&["Eye", "EyeTop"], &["eye", "eye_top"]),
    ] {
        assert_eq!(variables(names), expected);
    }
}

#[test]
fn variables_of_procedures_are_snake_case_and_their_own() {
    let model = model_of(&robot(vec![
        real_time("Control").node(
            node("control::a")
                .procedure("a", "u8", "u8", "injections")
                .procedure("b", "u8", "u8", "type")
                .procedure("c", "u8", "u8", "type_"),
        ),
    ]));
    let procedures = model.runtime.instances[0].procedures.iter();
    let variables: Vec<&str> = procedures
        .flat_map(|ends| [ends.caller.as_str(), ends.answerer.as_str()])
        .collect();
    assert_eq!(
        variables,
        [
            "control_injections2",
            "control_injections2_answerer",
            "control_type",
            "control_type_answerer",
            "control_type2",
            "control_type2_answerer",
        ]
    );
}

#[test]
fn an_instance_called_like_a_field_of_the_body_gets_another_field() {
    let model = model_of(&robot(vec![
        perception("Perception", &[]).setup(node("vision::a").output("a", "f32")),
        real_time("Control").node(node("control::b").latest("a", "f32", "Perception", "a")),
    ]));
    let reader = &model.cyclers[1].latest[0];
    assert_eq!(
        (reader.field.as_str(), reader.reader.as_str()),
        ("perception", "perception2")
    );
}

#[test]
fn instances_of_one_cycler_share_the_struct_of_their_parameters() {
    let model = model_of(&walker());
    let names: Vec<&str> = model
        .parameters
        .structs
        .iter()
        .map(|one| one.name.as_str())
        .collect();
    assert_eq!(names, ["Parameters", "FieldDimensions", "VisionInstance"]);
    let selects: Vec<&str> = model.cyclers[0]
        .instance_parameters
        .iter()
        .map(|part| part.select.as_str())
        .collect();
    assert_eq!(selects, ["select"]);
}

#[test]
fn a_node_is_called_after_the_nodes_it_reads() {
    let model = model_of(&walker());
    assert_eq!(
        model.cyclers[0].cycle.nodes,
        ["camera_matrix_extractor", "ball_detection"]
    );
    assert_eq!(
        model.cyclers[1].cycle.nodes,
        ["odometry", "ball_filter", "motion"]
    );
}

#[test]
fn flows_name_what_is_read_and_written() {
    let model = model_of(&walker());
    let nodes = model.cyclers.iter().flat_map(|one| &one.nodes);
    let flows: Vec<&str> = nodes.map(|node| node.step.flow.as_str()).collect();
    assert_eq!(
        flows,
        [
            "hardware -> image",
            "image, camera_matrix (required) -> balls; when subscribed: ball_candidates",
            "latest Control.head_pitch (required) -> camera_matrix",
            "hardware -> sensor_data",
            "perception Vision.balls, historic pose, previous ball -> ball",
            "sensor_data, state walked -> pose",
            "ball, procedure walk -> head_pitch, hardware",
        ]
    );
}

#[test]
fn a_value_of_the_instance_below_a_struct_that_is_read_whole_is_selected_by_its_whole_path() {
    let model = model_of(&robot(vec![
        real_time("Control").node(
            node("control::a")
                .parameter("whole", "types::Arms", "p")
                .parameter("other", "types::Hands", "q")
                .parameter("through", "f32", "p.$cycler_instance.x")
                .parameter("own", "f32", "p.$cycler_instance")
                .parameter("below", "Option<u8>", "q.$cycler_instance.grip?"),
        ),
    ]));
    let parts: Vec<(&str, String, bool)> = model.cyclers[0]
        .instance_parameters
        .iter()
        .map(|part| {
            let place = part.of_instance(&["parameters"], "Control").place.join(".");
            (part.field.as_str(), place, part.may_be_absent())
        })
        .collect();
    assert_eq!(
        parts,
        [
            ("instance_p", "parameters.p.control".to_owned(), false),
            (
                "instance_q_grip",
                "parameters.q.control.grip".to_owned(),
                true
            ),
        ]
    );
}
