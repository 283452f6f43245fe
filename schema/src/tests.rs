//! What a manifest may say, and the JSON schema that says it.

use std::time::Duration as Time;

use super::*;

/// The manifest of the documentation, with every key.
const WHOLE: &str = r#"
    [robot]
    name = "nao"
    generated = "generated"
    parameters = "robotics/parameters"
    identities = ["body", "head"]
    recording_budget = "512MiB"

    [[cycler]]
    name = "Vision"
    kind = "perception"
    instances = ["Top", { name = "Bottom", scheduling = { cores = [2] }, deadline = "40ms", record = "off" }]
    setup_nodes = ["vision::image_receiver"]
    nodes = ["vision::camera_matrix_extractor", { node = "vision::ball_detection", on_failure = "skip" }]
    deadline = "33ms"
    pending_timeout = "1s"
    queue = 32
    on_failure = "restart"
    lockstep_duration = "10ms"
    record = { every = 5 }

    [[cycler]]
    name = "Control"
    kind = "real-time"
    setup_nodes = ["control::sensor_data_receiver"]
    nodes = ["control::orientation_filter", "control::command_sender"]
    deadline = "12ms"
    watchdog = "300ms"
    history = "1s"
    scheduling = { policy = "fifo", priority = 80, cores = [0] }
    record = { while = "game_state.playing" }

    [[target]]
    name = "simulated"
    hardware = "simulated_nao::Hardware"

    [[target]]
    name = "nao"
    hardware = "nao::Hardware"
    triple = "x86_64-unknown-linux-gnu.2.28"
    cpu = "silvermont"
    profile = "nao"
    location = "nao"

    [[bridge]]
    path = "parameters.walking.speed"
    key = "nao/walking_speed"
    direction = "both"
"#;

#[test]
fn the_whole_manifest_is_read() {
    let manifest: Manifest = toml::from_str(WHOLE).unwrap();
    let vision = &manifest.cycler[0];
    let names: Vec<String> = vision
        .instance_names()
        .iter()
        .map(InstanceName::to_string)
        .collect();
    assert_eq!(names, ["VisionTop", "VisionBottom"]);
    assert_eq!(vision.deadline.unwrap().get(), Time::from_millis(33));
    assert_eq!(vision.nodes[1].on_failure(), Some(OnFailure::Skip));
    assert_eq!(manifest.cycler[1].instance_names()[0].as_str(), "Control");
    assert_eq!(manifest.robot.recording_budget.bytes(), 512 << 20);
    assert_eq!(manifest.target[1].location.as_deref(), Some("nao"));
    let bridge = &manifest.bridge[0];
    assert_eq!(bridge.key.as_str(), "nao/walking_speed");
    assert_eq!(bridge.direction, Some(Direction::Both));
    assert_eq!((bridge.encoding, bridge.rate), (BridgeEncoding::Json, None));
}

#[test]
fn the_smallest_manifest_has_defaults() {
    let manifest: Manifest = toml::from_str("[robot]\nname = \"x\"").unwrap();
    assert_eq!(manifest.robot.generated, "generated");
    assert_eq!(manifest.robot.recording_budget, Size::from_gibibytes(2));
    assert!(manifest.cycler.is_empty());
}

#[test]
fn what_means_nothing_is_an_error() {
    for (text, part) in [
        ("[robot]\nname = \"x\"\nnmae = 1", "unknown field `nmae`"),
        ("[robot]\nname = \"Nao\"", "snake_case"),
        (
            "[robot]\nname = \"x\"\n[[cycler]]\nname = \"vision\"\nkind = \"perception\"",
            "UpperCamelCase",
        ),
        (
            "[robot]\nname = \"x\"\n[[cycler]]\nname = \"Loop\"\nkind = \"perception\"",
            "keyword",
        ),
        (
            "[robot]\nname = \"x\"\n[[cycler]]\nname = \"A\"\nkind = \"fast\"",
            "unknown variant `fast`",
        ),
        (
            "[robot]\nname = \"x\"\n[[cycler]]\nname = \"A\"\nkind = \"perception\"\nnodes = [\"a\"]",
            "write `crate::module::path`",
        ),
        (
            "[robot]\nname = \"x\"\n[[cycler]]\nname = \"A\"\nkind = \"perception\"\nnodes = [{ node = \"a::b\", x = 1 }]",
            "unknown field `x`",
        ),
        (
            "[robot]\nname = \"x\"\n[[cycler]]\nname = \"A\"\nkind = \"perception\"\ndeadline = \"12\"",
            "length of time",
        ),
    ] {
        let error = toml::from_str::<Manifest>(text).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn lengths_are_read_exactly_and_printed_shortest() {
    for (text, nanoseconds, printed) in [
        ("33ms", 33_000_000, "33ms"),
        ("1.5s", 1_500_000_000, "1500ms"),
        ("2 min", 120_000_000_000, "2min"),
        ("2m", 120_000_000_000, "2min"),
        ("1h", 3_600_000_000_000, "60min"),
        ("250µs", 250_000, "250us"),
    ] {
        let duration: Duration = text.parse().unwrap();
        assert_eq!(duration.get(), Time::from_nanos(nanoseconds));
        assert_eq!(duration.to_string(), printed);
    }
    for wrong in [
        "",
        "ms",
        "12",
        "1.ms",
        "-1ms",
        "0s",
        "1d",
        "0.5ns",
        "99999999999999999999s",
        "1 .5s",
    ] {
        assert!(wrong.parse::<Duration>().is_err(), "{wrong}");
    }
    assert_eq!("2GiB".parse::<Size>().unwrap().to_string(), "2GiB");
}

#[test]
fn names_in_snake_case_keep_their_words() {
    for (name, snake) in [
        ("Vision", "vision"),
        ("VisionTop", "vision_top"),
        ("HSLNetwork2", "hsl_network2"),
        ("SplNetwork", "spl_network"),
        ("vision_top", "vision_top"),
    ] {
        assert_eq!(snake_case(name), snake);
    }
}

#[test]
fn words_of_fields_become_types() {
    for (name, camel) in [
        ("field_dimensions", "FieldDimensions"),
        ("vision_top", "VisionTop"),
        ("ball_2_filter_", "Ball2Filter"),
    ] {
        assert_eq!(upper_camel_case(name), camel);
    }
}

/// `HULKGEN_WRITE=1 cargo test -p hulkgen-schema` writes the file anew.
#[test]
fn the_schema_beside_the_crate_is_current() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/hulk.schema.json");
    if std::env::var_os("HULKGEN_WRITE").is_some() {
        std::fs::write(file, json_schema()).unwrap();
    }
    let checked_in = std::fs::read_to_string(file).unwrap_or_default();
    assert_eq!(checked_in, json_schema(), "write it with HULKGEN_WRITE=1");
}
