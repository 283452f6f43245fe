//! Against what ROS 2 itself says: hashes that its packages have, and rosbags, a reader from PyPI that knows .msg files, their
//! hashes and CDR.

use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use super::announce::gid;
use super::interface::{Interface, key, objection};
use super::key::{Group, Key};
use super::names;
use super::packages::Packages;
use crate::edges::{Direction, Edge, Encoding, Kind};
use crate::forms::Form;
use crate::layout::Layout;
use crate::random::{Random, Written};

fn layout(root: &Value) -> Layout {
    Layout::read(json!({ "root": root })).expect("CDR has a form for it")
}

fn kind(kind: &str, bits: u32) -> Value {
    json!({ "kind": kind, "bits": bits })
}

fn structure(fields: &[(&str, Value)]) -> Value {
    let fields = fields.iter();
    let fields = fields.map(|(name, layout)| json!({ "name": name, "layout": layout }));
    json!({ "kind": "struct", "fields": fields.collect::<Vec<_>>() })
}

/// Of a message of this type.
fn hash(full_type: &str, root: &Value) -> String {
    let key = Key::read(&format!("0/a/{full_type}/0")).expect("it is a key of ROS 2");
    let form = Form::Value(layout(root));
    Interface::new(&key, &form).expect("it is a message").hash()
}

fn edge(path: &str, kind: Kind, key: &str) -> Edge {
    Edge {
        path: path.to_owned(),
        kind,
        key: key.to_owned(),
        direction: Some(Direction::Out),
        encoding: Encoding::Cdr,
        rate: None,
    }
}

/// As ROS 2's own packages tell them.
#[test]
fn types_have_the_hashes_that_ros_2_gives_them() {
    let text = json!({ "kind": "text" });
    assert_eq!(
        hash("std_msgs::msg::dds_::String_", &text),
        "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
    );
    let number = kind("signed", 64);
    let form = Form::Call {
        request: layout(&structure(&[("a", number.clone()), ("b", number.clone())])),
        response: layout(&structure(&[("sum", number)])),
    };
    let key = "2/add_two_ints/example_interfaces::srv::dds_::AddTwoInts_/0";
    let key = Key::read(key).expect("it is a key of ROS 2");
    assert_eq!(
        Interface::new(&key, &form).expect("it is a service").hash(),
        "RIHS01_e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a"
    );
}

#[test]
fn a_key_is_of_ros_2_or_of_somebody_else() {
    let hash = "RIHS01_00";
    let read = |key: &str| Key::read(&format!("{key}/{hash}"));
    let key = read("7/robot/pose/zoo_interfaces::msg::dds_::Pose_").expect("it is one");
    assert_eq!((key.domain, key.name.as_str()), (7, "robot/pose"));
    assert_eq!((key.group, key.hash.as_str()), (Group::Message, hash));
    assert_eq!(key.full_name(), "zoo_interfaces/msg/Pose");
    assert_eq!(
        key.with_hash("RIHS01_ff"),
        "7/robot/pose/zoo_interfaces::msg::dds_::Pose_/RIHS01_ff"
    );
    for other in [
        "zoo/pose",
        "0/zoo_interfaces::msg::dds_::Pose_",
        "zoo/pose/zoo_interfaces::msg::dds_::Pose_",
        "+1/pose/zoo_interfaces::msg::dds_::Pose_",
        "99999999999/pose/zoo_interfaces::msg::dds_::Pose_",
        "0/po-se/zoo_interfaces::msg::dds_::Pose_",
        "0/2d/zoo_interfaces::msg::dds_::Pose_",
        "0/pose/zoo__interfaces::msg::dds_::Pose_",
        "0/pose/Zoo::msg::dds_::Pose_",
        "0/pose/zoo_interfaces::msg::dds_::Pose",
        "0/pose/zoo_interfaces::msg::dds_::pose_",
        "0/pose/zoo_interfaces::action::dds_::Pose_",
        "0/pose/zoo_interfaces::msg::Pose_",
    ] {
        assert_eq!(read(other), None, "{other}");
    }
}

#[test]
fn a_hash_that_is_wrong_is_told_with_the_right_key() {
    let path = "Control.main_outputs.speed";
    let form = Form::Value(layout(&kind("float", 32)));
    let right = hash("std_msgs::msg::dds_::Float32_", &kind("float", 32));
    let right = format!("0/speed/std_msgs::msg::dds_::Float32_/{right}");
    let wrong = "0/speed/std_msgs::msg::dds_::Float32_/RIHS01_00";
    let told = objection(&edge(path, Kind::MainOutput, wrong), &form).expect("it is wrong");
    assert!(told.contains(&right), "{told}");
    let of = |kind, key: &str| objection(&edge(path, kind, key), &form);
    assert_eq!(of(Kind::MainOutput, &right), None);
    assert_eq!(of(Kind::MainOutput, "zoo/speed"), None);
    let service = "0/speed/std_srvs::srv::dds_::Empty_/RIHS01_00";
    let told = of(Kind::MainOutput, service).expect("an output is no service");
    assert!(told.contains("::msg::"), "{told}");
    assert_eq!(key(&edge(path, Kind::MainOutput, service)), None);
    let mut json = edge(path, Kind::MainOutput, &right);
    json.encoding = Encoding::Json;
    assert_eq!(key(&json), None, "ROS 2 reads no JSON");
}

#[test]
fn a_value_that_contains_its_own_type_has_no_message() {
    let tree = json!({
        "root": { "kind": "reference", "name": "Tree" },
        "definitions": { "Tree": { "kind": "list", "item": { "kind": "reference", "name": "Tree" } } }
    });
    let form = Form::Value(Layout::read(tree).expect("CDR has a form for it"));
    let key = Key::read("0/tree/zoo::msg::dds_::Tree_/0").expect("it is a key of ROS 2");
    let refused = Interface::new(&key, &form).err().expect("it never ends");
    assert!(refused.contains("its own type"), "{refused}");
}

#[test]
fn names_follow_the_rules_of_ros_2() {
    for (name, expected) in [
        ("x", "x"),
        ("ballSeen", "ball_seen"),
        ("BALL_SEEN", "ball_seen"),
        ("__odd__name_", "odd_name"),
        ("9lives", "field_9lives"),
        ("class", "class_value"),
        ("é", "field"),
        ("taken", "taken_2"),
    ] {
        assert_eq!(names::field(name, &["taken"]), expected, "{name}");
    }
    assert_eq!(names::constant("mode", "OnAir", &[]), "MODE_ON_AIR");
    assert_eq!(
        names::constant("mode", "on-air", &["MODE_ON_AIR"]),
        "MODE_ON_AIR_2"
    );
    assert_eq!(names::camel("ball_seen2"), "BallSeen2");
    assert_eq!(names::message("PoseXy", &["PoseXY"]), "PoseXy2");
    for (name, expected) in [
        ("zoo", "zoo"),
        ("k1-left", "k1_left"),
        ("9", "robot_9"),
        ("", "robot"),
    ] {
        assert_eq!(names::node(name), expected);
    }
}

/// Of the examples in rmw_zenoh's design.md, by xxHash itself.
#[test]
fn who_made_a_message_is_the_hash_of_its_token() {
    let node = "@ros2_lv/0/8b20917502ee955ac4476e0266340d5c/0/10/MP/%/%/talker";
    let chatter = "%chatter/std_msgs::msg::dds_::String_/RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18/::,7:,:,:,,";
    for (token, expected) in [
        (node.to_owned(), "7ae68938b35b13570b8a59add406f06c"),
        (
            format!("{node}/{chatter}"),
            "62d00a8901458a44dc46783b88fa85eb",
        ),
    ] {
        let bytes = gid(&token).into_iter().rev();
        let hash: String = bytes.map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(hash, expected);
    }
}

/// With the bytes of values in them.
#[test]
fn rosbags_reads_the_messages_and_the_values() {
    const TEST: &str = "rosbags_reads_the_messages_and_the_values";
    let known = Command::new("python3")
        .args(["-c", "import rosbags.typesys"])
        .stderr(Stdio::null())
        .status();
    if !known.is_ok_and(|status| status.success()) {
        let required = std::env::var_os("HULKGEN_REQUIRE_ALL").is_some_and(|value| value == "1");
        assert!(!required, "needs: python3 -m pip install rosbags");
        println!("SKIPPED {TEST}: python3 -m pip install rosbags");
        return;
    }
    let folder = std::env::temp_dir().join(format!("hulkgen-messages-{}", std::process::id()));
    let mut random = Random(7);
    let mut cases = Vec::new();
    let mut packages = Packages::default();
    for number in 0..300 {
        let described = random.layout(3);
        let layout = Layout::read(described.clone()).expect("CDR has a form for it");
        let key = format!("0/a/zoo_interfaces::msg::dds_::Value{number}x_/0");
        let key = Key::read(&key).expect("it is a key of ROS 2");
        let mut written = Written::default();
        let value = random.value(&described["root"], &mut written);
        let cdr = layout.to_cdr(&written.bytes).expect("it is laid out so");
        let interface = Interface::new(&key, &Form::Value(layout)).expect("it is a message");
        packages
            .add("a", &key, &interface)
            .expect("each has a name of its own");
        let cdr: String = cdr.iter().map(|byte| format!("{byte:02x}")).collect();
        cases.push(json!({
            "type": key.full_name(), "hash": interface.hash(), "cdr": cdr,
            "leaves": written.leaves, "value": value
        }));
    }
    let names = packages
        .write(&folder, "zoo")
        .expect("the folder can be written");
    assert_eq!(names, ["zoo_interfaces"]);
    let again = packages.write(&folder, "zoo");
    again.expect("what was written is written over");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/messages.py");
    let mut python = Command::new("python3");
    let python = python.arg("-B").arg(script).arg(&folder);
    let python = python.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut python = python.spawn().expect("python3 was there a moment ago");
    let mut stdin = python.stdin.take().expect("it is piped");
    stdin
        .write_all(Value::from(cases).to_string().as_bytes())
        .expect("it listens");
    drop(stdin);
    let output = python.wait_with_output().expect("it was started");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("300 messages"), "{said}");
    let _ = std::fs::remove_dir_all(&folder);
}

#[test]
fn packages_of_others_are_left_alone() {
    let folder = std::env::temp_dir().join(format!("hulkgen-packages-{}", std::process::id()));
    let form = Form::Value(layout(&kind("float", 32)));
    let add = |packages: &mut Packages, package: &str, form: &Form| {
        let key = format!("0/a/{package}::msg::dds_::Speed_/0");
        let key = Key::read(&key).expect("it is a key of ROS 2");
        let interface = Interface::new(&key, form).expect("it is a message");
        packages.add("parameters.speed", &key, &interface)
    };
    let mut packages = Packages::default();
    add(&mut packages, "std_msgs", &form).expect("it is ROS 2's own");
    add(&mut packages, "zoo", &form).expect("it is the first");
    add(&mut packages, "zoo", &form).expect("it is the same");
    let other = Form::Value(layout(&kind("float", 64)));
    let refused = add(&mut packages, "zoo", &other).expect_err("it has other fields");
    assert!(refused.contains("msg/Speed.msg"), "{refused}");
    std::fs::create_dir_all(folder.join("zoo")).expect("there is room");
    let refused = packages
        .write(&folder, "zoo")
        .expect_err("somebody made it");
    assert!(refused.contains("not of `--messages`"), "{refused}");
    let _ = std::fs::remove_dir_all(&folder);
}
