//! The table of written types and paths: who reads what as what.

use super::{with_field, writes};
use crate::diagnostics::Diagnostics;
use crate::scan::fixture::{Fixture, Node};

/// Codes for a node that reads the output `x` of this type by this field.
fn answer(output: &str, field: &str) -> (Vec<&'static str>, String) {
    let output = format!("x: MainOutput<{output}>,");
    let fixture = Fixture::control(&["a", "b"]).node("a", writes(&output));
    let answer = with_field(fixture, "b", &format!("y: {field}")).answer();
    let codes = answer
        .codes
        .into_iter()
        .filter(|code| *code != "unread-outputs" && *code != "actuator-takes-default");
    (codes.collect(), answer.text)
}

#[test]
fn written_type_and_path_agree_by_the_contract() {
    for (output, field, code) in [
        ("u8", "Input<u8, \"x\">", None),
        ("Option<u8>", "Input<Option<u8>, \"x\">", None),
        ("Option<u8>", "Input<Option<u8>, \"x?\">", None),
        ("Option<u8>", "RequiredInput<Option<u8>, \"x?\">", None),
        ("Ball", "Input<f32, \"x.x\">", None),
        ("Ball", "Input<Option<Point>, \"x.position\">", None),
        ("Ball", "Input<Option<Point>, \"x.position?\">", None),
        ("Ball", "Input<Option<f32>, \"x.position?.x\">", None),
        ("Option<Ball>", "Input<Option<f32>, \"x?.x\">", None),
        (
            "Option<Ball>",
            "Input<Option<Point>, \"x?.position?\">",
            None,
        ),
        (
            "Option<Ball>",
            "Input<Option<Option<Point>>, \"x?.position\">",
            None,
        ),
        (
            "Option<Ball>",
            "Input<Option<f32>, \"x?.position?.x\">",
            None,
        ),
        (
            "Wrapper<Option<u8>>",
            "Input<Option<u8>, \"x.value?\">",
            None,
        ),
        ("nalgebra::Point2<f32>", "Input<f32, \"x.x\">", None),
        ("Box<Ball>", "Input<f32, \"x.x\">", None),
        ("Box<Ball>", "Input<f32, \"x.y\">", Some("unknown-output")),
        ("(f32, f32)", "Input<f32, \"x.x\">", Some("unknown-output")),
        ("[f32; 2]", "Input<f32, \"x.x\">", Some("unknown-output")),
        (
            "std::time::Duration",
            "Input<u64, \"x.secs\">",
            Some("unknown-output"),
        ),
        ("std::ops::Range<f32>", "Input<f32, \"x.end\">", None),
        (
            "std::ops::Range<f32>",
            "Input<f32, \"x.begin\">",
            Some("unknown-output"),
        ),
        ("ordered_float::NotNan<f32>", "Input<f32, \"x.y\">", None),
        ("Option<u8>", "Input<u8, \"x\">", Some("option-mismatch")),
        ("u8", "Input<Option<u8>, \"x\">", Some("option-mismatch")),
        ("u8", "Input<Option<u8>, \"x?\">", Some("option-mismatch")),
        (
            "Ball",
            "Input<f32, \"x.position.x\">",
            Some("option-mismatch"),
        ),
        (
            "Option<Ball>",
            "Input<Option<Point>, \"x?.position\">",
            Some("option-mismatch"),
        ),
        (
            "Option<Ball>",
            "Input<f32, \"x.x\">",
            Some("option-mismatch"),
        ),
        ("u8", "Input<u16, \"x\">", Some("type-mismatch")),
        (
            "Option<u8>",
            "Input<Option<u16>, \"x?\">",
            Some("type-mismatch"),
        ),
        ("Ball", "Input<u8, \"x.x\">", Some("type-mismatch")),
        (
            "nalgebra::Point2<f32>",
            "Input<f32, \"x\">",
            Some("type-mismatch"),
        ),
        (
            "[f32; 2]",
            "Input<nalgebra::Vector2<f32>, \"x\">",
            Some("type-mismatch"),
        ),
        (
            "Option<nalgebra::Point2<f32>>",
            "RequiredInput<Option<f32>, \"x?\">",
            Some("type-mismatch"),
        ),
        ("ordered_float::NotNan<f32>", "Input<f32, \"x\">", None),
        ("Ball", "Input<f32, \"x.y\">", Some("unknown-output")),
        ("u8", "Input<f32, \"x.y\">", Some("unknown-output")),
        ("Side", "Input<f32, \"x.y\">", Some("unknown-output")),
        ("Ball", "Input<u8, \"x.secret\">", Some("not-public")),
    ] {
        let (codes, text) = answer(output, field);
        assert_eq!(codes, Vec::from_iter(code), "{output} {field}\n{text}");
    }
}

#[test]
fn a_parameter_without_an_argument_is_what_its_default_says() {
    let head = "use types::*;
        pub struct Wrap<T = f32, U = Option<T>> { pub value: T, pub maybe: U, pub same: Around }
        pub struct Around<const N: usize = 2> { pub all: [u8; N] }";
    for (output, field, code) in [
        ("Wrap", "Input<f32, \"x.value\">", None),
        ("Wrap", "Input<u8, \"x.value\">", Some("type-mismatch")),
        ("Wrap", "Input<f32, \"x.valeu\">", Some("unknown-output")),
        ("Wrap", "Input<Option<f32>, \"x.maybe?\">", None),
        ("Wrap<u8>", "Input<u8, \"x.value\">", None),
        ("Wrap<u8>", "Input<Option<u8>, \"x.maybe?\">", None),
        (
            "Wrap<u8>",
            "Input<Option<f32>, \"x.maybe?\">",
            Some("type-mismatch"),
        ),
        ("Wrap", "Input<[u8; 2], \"x.same.all\">", None),
        (
            "Wrap",
            "Input<[u8; 3], \"x.same.all\">",
            Some("type-mismatch"),
        ),
    ] {
        let output = format!("x: MainOutput<{output}>,");
        let node = Node {
            head,
            ..writes(&output)
        };
        let fixture = Fixture::control(&["a", "b"]).node("a", node);
        let answer = with_field(fixture, "b", &format!("y: {field}")).answer();
        let mut codes = answer.codes.clone();
        codes.retain(|code| *code != "unread-outputs" && *code != "actuator-takes-default");
        assert_eq!(
            codes,
            Vec::from_iter(code),
            "{output} {field}\n{}",
            answer.text
        );
        if code.is_none() {
            let robot = answer.robot.expect("nothing is wrong");
            let nodes = robot.cyclers[0].nodes.iter();
            let mut reads = nodes
                .flat_map(|node| &node.cycle)
                .filter_map(|one| one.binding.read());
            assert!(reads.all(|read| read.checked), "{output} {field}");
        }
    }
}

#[test]
fn defaults_that_double_are_not_followed_to_their_end() {
    let doubling = (1..28).map(|index| {
        let before = index - 1;
        format!(", P{index} = (P{before}, P{before})")
    });
    let doubling: String = doubling.collect();
    let head = format!(
        "pub struct Wide<P0 = u8{doubling}> {{ pub first: P0, pub last: Option<P27> }}
         pub type Same<P0{doubling}> = (P0, P27);"
    );
    for output in ["Wide", "Same<u8>"] {
        let output = format!("x: MainOutput<{output}>,");
        let node = Node {
            head: &head,
            ..writes(&output)
        };
        let fixture = Fixture::control(&["a", "b"]).node("a", node);
        let answer = with_field(fixture, "b", "y: Input<u8, \"x.first\">").answer();
        let robot = answer.robot.expect("nobody can tell what is wrong");
        let nodes = robot.cyclers[0].nodes.iter();
        let mut reads = nodes
            .flat_map(|node| &node.cycle)
            .filter_map(|one| one.binding.read());
        assert!(reads.all(|read| !read.checked), "{output}");
    }
}

#[test]
fn a_hidden_field_is_told_where_it_is_made_public() {
    let (_, text) = answer("Ball", "Input<u8, \"x.secret\">");
    let place = "--> crates/types/src/lib.rs:10:64";
    assert!(text.contains(place), "{text}");
    assert!(text.contains("write `pub secret`"), "{text}");
}

#[test]
fn one_mark_removes_one_option() {
    let (codes, text) = answer("Option<Option<u8>>", "Input<Option<u8>, \"x?\">");
    assert_eq!(codes, ["option-mismatch"], "{text}");
    assert!(text.contains("`x?` is `Option<u8>`"), "{text}");
    let help = "write `Option<Option<u8>>`: one `?` removes one `Option`";
    assert!(text.contains(help), "{text}");
    let (codes, text) = answer("Option<Option<u8>>", "Input<Option<Option<u8>>, \"x?\">");
    assert!(codes.is_empty(), "{text}");
}

/// Every line was compiled against nalgebra 0.35.
#[test]
fn paths_lead_into_values_of_nalgebra() {
    for (output, read, path, is_right) in [
        ("Point2<f32>", "f32", "y", true),
        ("Point2<f32>", "f64", "y", false),
        ("Point2<f32>", "f32", "z", false),
        ("Point2<f32>", "nalgebra::Vector2<f32>", "coords", true),
        ("Point2<f32>", "nalgebra::Vector3<f32>", "coords", false),
        ("Point2<f32>", "f32", "coords.y", true),
        ("Point2<f32>", "f32", "cords.y", false),
        ("Point2<f32>", "f32", "coords.z", false),
        ("Point<f32, 3>", "f32", "z", true),
        ("SVector<f32, 4>", "f32", "w", true),
        ("Vector6<f32>", "f32", "b", true),
        ("RowVector2<f32>", "f32", "y", true),
        ("Vector3<f32>", "f32", "coords", false),
        ("Matrix3<f32>", "f32", "m12", true),
        ("Matrix3<f32>", "f32", "m14", false),
        ("Matrix3x4<f32>", "f32", "m14", true),
        ("SMatrix<f32, 2, 2>", "f32", "m22", true),
        ("SMatrix<f32, 9, 9>", "f32", "m22", false),
        (
            "Translation3<f32>",
            "nalgebra::Vector3<f32>",
            "vector",
            true,
        ),
        ("Rotation3<f32>", "f32", "matrix", false),
        ("Quaternion<f32>", "f32", "k", true),
        ("UnitQuaternion<f32>", "f32", "i", true),
        ("UnitQuaternion<f32>", "f32", "x", false),
        ("UnitQuaternion<f32>", "f32", "coords.x", true),
        ("UnitComplex<f32>", "f32", "re", true),
        ("UnitVector3<f32>", "f32", "z", true),
        ("Unit<nalgebra::Vector3<f32>>", "f32", "z", true),
        ("Unit<nalgebra::Vector3<f32>>", "f32", "w", false),
        ("Isometry3<f32>", "f32", "translation.z", true),
        (
            "Isometry3<f32>",
            "nalgebra::UnitQuaternion<f32>",
            "rotation",
            true,
        ),
        ("Isometry2<f32>", "f32", "rotation.im", true),
        ("Isometry2<f32>", "f32", "rotation.i", false),
        ("Isometry2<f32>", "f32", "translation.z", false),
        (
            "IsometryMatrix3<f32>",
            "nalgebra::Rotation3<f32>",
            "rotation",
            true,
        ),
        ("Similarity3<f32>", "f32", "isometry.translation.x", true),
        ("Similarity3<f32>", "f32", "scaling", false),
        // What the type of the data is, and what has no size in its name, is left to rustc.
        ("Vector3<f32>", "f32", "data", true),
        ("DVector<f32>", "f32", "x", true),
        ("OPoint<f32, nalgebra::Const<2>>", "f32", "x", true),
    ] {
        let (codes, text) = answer(
            &format!("nalgebra::{output}"),
            &format!("Input<{read}, \"x.{path}\">"),
        );
        assert_eq!(codes.is_empty(), is_right, "{output} {path}\n{text}");
    }
    let (codes, text) = answer("nalgebra::Point2<f32>", "Input<f32, \"x.cords.y\">");
    assert_eq!(codes, ["unknown-output"]);
    assert!(text.contains("did you mean `coords`?"), "{text}");
}

#[test]
fn a_mismatch_shows_both_places() {
    let (_, text) = answer("Vec<Ball>", "PreviousInput<Vec<Point>, \"x\">");
    for part in [
        "error[type-mismatch]: `x` is `Vec<types::Ball>`, but is read as `Vec<types::Point>`",
        "crates/nodes/src/b.rs:15:4",
        "`nodes::b` reads it as `Vec<types::Point>`",
        "crates/nodes/src/a.rs:19:4",
        "`nodes::a` writes it as `Vec<types::Ball>`",
        "help: write `Vec<types::Ball>` here",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

#[test]
fn a_type_of_the_own_crate_is_told_as_that_crate_writes_it() {
    let writer = Node {
        head: "pub struct Own;\npub struct Of<T> { t: T }",
        outputs: "x: MainOutput<Of<(Own, types::Ball)>>,",
        ..writes("")
    };
    let fixture = Fixture::control(&["a", "b"]).node("a", writer);
    let text = with_field(fixture, "b", "y: Input<u8, \"x\">")
        .answer()
        .text;
    for part in [
        "`x` is `nodes::a::Of<(nodes::a::Own, types::Ball)>`, but is read as `u8`",
        "write `crate::a::Of<(crate::a::Own, types::Ball)>` here",
    ] {
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn what_cannot_be_seen_is_counted_and_left_to_rustc() {
    let fixture =
        Fixture::control(&["a", "b"]).node("a", writes("x: MainOutput<nalgebra::Vector3<f32>>,"));
    let fixture = with_field(
        fixture,
        "b",
        "y: PreviousInput<nalgebra::SVector<f32, 3>, \"x\">",
    );
    let robot = fixture.answer().robot.expect("no error");
    assert_eq!(robot.left_to_rustc, 1);
    let read = robot.cyclers[0].nodes[1].cycle[0]
        .binding
        .read()
        .expect("it reads");
    assert!(!read.checked);
}

#[test]
fn a_crate_beside_the_workspace_may_show_a_type_of_its_members() {
    let manifest = "[package]\nname = \"nodes\"\n[dependencies]\nserde = \"1\"\nheapless = \"0.8\"\n\
         framework = { path = \"../../elsewhere\" }\ntypes = { path = \"../types\" }\n\
         extras = { path = \"../../vendor/extras\" }\n";
    let root = "[workspace]\nmembers = [\"crates/*\"]\nexclude = [\"vendor\"]\n";
    let answer = |data: &str| {
        let fixture = Fixture::control(&["a", "b"])
            .node("a", writes("x: MainOutput<types::Ball>,"))
            .file("crates/nodes/Cargo.toml", manifest)
            .file("Cargo.toml", root);
        with_field(fixture, "b", &format!("y: Input<{data}, \"x\">")).answer()
    };
    for unknown in ["extras::Ball", "heapless::Id<types::Ball>"] {
        let answer = answer(unknown);
        let robot = answer.robot.unwrap_or_else(|| panic!("{}", answer.text));
        assert_eq!(robot.left_to_rustc, 1, "{unknown}");
    }
    for other in [
        "heapless::Ball",
        "heapless::Id<u8>",
        "framework::Timeline<types::Ball>",
    ] {
        let answer = answer(other);
        assert!(answer.codes.contains(&"type-mismatch"), "{}", answer.text);
    }
}

#[test]
fn a_crate_is_the_same_by_whatever_name_its_users_know_it() {
    let renamed = "forms = { package = \"types\", path = \"../types\" }";
    let shared = "forms = { package = \"types\", path = \"crates/types\" }";
    for (root, line) in [("", renamed), (shared, "forms.workspace = true")] {
        let fixture =
            Fixture::control(&["a", "b"]).node("a", writes("x: MainOutput<forms::Ball>,"));
        let fixture = with_field(fixture, "b", "y: Input<types::Ball, \"x\">");
        let packages = fixture.text("crates/nodes/Cargo.toml");
        let packages = format!("{packages}{line}\n");
        let workspace = fixture.text("Cargo.toml");
        let workspace = format!("{workspace}[workspace.dependencies]\n{root}\n");
        let answer = fixture
            .file("crates/nodes/Cargo.toml", &packages)
            .file("Cargo.toml", &workspace)
            .answer();
        assert_eq!(answer.codes, ["actuator-takes-default"], "{}", answer.text);
        let robot = answer.robot.expect("there are no errors");
        assert_eq!(robot.cyclers[0].outputs[0].data.text, "types::Ball");
        let found = robot.crates.iter().find(|one| one.name == "types");
        let line = found.map(|one| (one.key.as_str(), one.requirement.as_str()));
        assert_eq!(line, Some(("types", "{ path = \"../crates/types\" }")));
    }
}

#[test]
fn a_crate_that_only_types_know_comes_with_their_dependency() {
    let robot = Fixture::control(&["a", "b"])
        .node("a", writes("x: MainOutput<types::Placed>,"))
        .file("crates/types/src/lib.rs", "pub type Placed = linear::Point;")
        .file(
            "crates/types/Cargo.toml",
            "[package]\nname = \"types\"\n[dependencies]\nlinear = { package = \"linear-algebra\", version = \"0.3\" }\n",
        );
    let answer = with_field(robot, "b", "y: Input<types::Placed, \"x\">").answer();
    assert_eq!(answer.codes, ["actuator-takes-default"], "{}", answer.text);
    let robot = answer.robot.expect("there are no errors");
    assert_eq!(robot.cyclers[0].outputs[0].data.text, "linear::Point");
    let found = robot.crates.iter().find(|one| one.name == "linear");
    let line = found.map(|one| (one.key.as_str(), one.requirement.as_str()));
    let expected = "{ package = \"linear-algebra\", version = \"0.3\" }";
    assert_eq!(line, Some(("linear", expected)));
}

#[test]
fn a_library_that_is_not_called_as_its_package_is_named_by_its_user() {
    let robot = |line: &str| {
        let output = writes("x: MainOutput<Md5>,");
        let head = "use md5::Md5;";
        let robot = Fixture::control(&["a"]).node("a", Node { head, ..output });
        let packages = format!("{}{line}\n", robot.text("crates/nodes/Cargo.toml"));
        robot.file("crates/nodes/Cargo.toml", &packages)
    };
    let place = [
        "`Md5` cannot be followed",
        "needs its own name in Cargo.toml",
    ];
    let unknown = robot("md-5 = \"0.10\"").answer();
    unknown.expect_error("invalid-field", &place);
    let named = robot("md5 = { package = \"md-5\", version = \"0.10\" }").answer();
    let named = named.robot.expect("there are no errors");
    assert_eq!(named.cyclers[0].outputs[0].data.text, "md5::Md5");
}

#[test]
fn a_type_of_which_nobody_can_tell_what_it_is_is_told_at_its_field() {
    for (head, written) in [
        (
            "use nalgebra::*; use ordered_float::*;",
            "Vec<Vector3<f32>>",
        ),
        ("", "[u8; Self::COUNT]"),
        ("use types::*;", "Lost"),
    ] {
        let output = format!("x: MainOutput<{written}>,");
        let fixture = Fixture::control(&["a", "b"]).node(
            "a",
            Node {
                head,
                ..writes(&output)
            },
        );
        let answer = with_field(fixture, "b", &format!("y: Input<{written}, \"x\">")).answer();
        answer.expect_error(
            "invalid-field",
            &["cannot be followed", "crates/nodes/src/a.rs", "help: "],
        );
    }
}

#[test]
fn a_hardware_trait_keeps_its_arguments() {
    let hardware = "pub struct Hardware; pub struct Arm;
        pub trait Drives<T, const N: usize>: Send { fn drive(&self, value: T) -> Result<()>; }";
    let node = |asks| Node {
        head: "use hardware::{Arm, Drives};",
        cycle: "hardware: HardwareInterface,",
        asks,
        ..Node::default()
    };
    let robot = Fixture::control(&["a"])
        .node("a", node("Drives<Vec<Arm>, 3> + Drives<u8, 3>"))
        .file("crates/hardware/src/lib.rs", hardware)
        .expect(
            "not-replayable",
            &["hardware::Drives<Vec<hardware::Arm>, 3>"],
        )
        .robot
        .expect("it is a warning");
    let bounds = &robot.cyclers[0].nodes[0].cycle_bounds;
    let paths: Vec<&str> = bounds.iter().map(|bound| bound.path.as_str()).collect();
    assert_eq!(
        paths,
        [
            "hardware::Drives<Vec<hardware::Arm>, 3>",
            "hardware::Drives<u8, 3>"
        ]
    );
    let schedule =
        crate::schedule::schedule(&robot, &mut Diagnostics::new()).expect("it has an order");
    let files = crate::render::render(&crate::model::describe(&robot, &schedule));
    let text = &files[camino::Utf8Path::new("generated/src/runtime.rs")];
    for bound in ["Drives<Vec<Arm>, 3>", "Drives<u8, 3>"] {
        assert!(text.contains(bound), "{text}");
    }
}

#[test]
fn generated_functions_ask_for_what_every_hardware_is_where_a_node_does() {
    let node = Node {
        cycle: "hardware: HardwareInterface,",
        asks: "hardware::Motors",
        ..Node::default()
    };
    for (asks, function, body) in [
        (
            "hardware::Motors",
            "impl Motors>",
            "Hardware: Motors + Send + Sync",
        ),
        (
            "hardware::Motors + Sync + std::marker::Send + Sized",
            "impl Motors + Send + Sync>",
            "Hardware: Motors + Send + Sync",
        ),
        (
            "hardware::Motors + 'static",
            "impl Motors + 'static>",
            "Hardware: Motors + Send + Sync + 'static",
        ),
    ] {
        let robot = Fixture::control(&["a", "b"])
            .node("a", Node { asks, ..node })
            .node("b", node)
            .robot();
        let schedule =
            crate::schedule::schedule(&robot, &mut Diagnostics::new()).expect("it has an order");
        let files = crate::render::render(&crate::model::describe(&robot, &schedule));
        let text = |path: &str| &files[camino::Utf8Path::new(path)];
        let nodes = text("generated/src/cyclers/control.rs");
        let own = format!("fn a(&mut self, frame: &mut Frame<'_, {function}");
        assert!(nodes.contains(&own), "{nodes}");
        let other = "fn b(&mut self, frame: &mut Frame<'_, impl Motors>";
        assert!(nodes.contains(other), "{nodes}");
        let runtime = text("generated/src/runtime/control.rs");
        assert!(runtime.contains(body), "{runtime}");
        assert!(
            files
                .keys()
                .any(|path| path.ends_with("recording/control.rs"))
        );
    }
}
