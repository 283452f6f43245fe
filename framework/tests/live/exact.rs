//! Numbers that JSON has no word for, and what would be lost by a store.

use framework::parameters::{Layers, Version};
use framework::replay::with_settings;
use serde_json::{Value, json};

use super::{DEFAULT, Parameters, Robot, told};

fn set(path: &str, value: &str) -> impl FnOnce(&mut Layers) {
    let setting = (path.to_owned(), value.to_owned());
    move |layers| layers.settings = vec![setting]
}

#[test]
fn a_number_that_its_type_does_not_hold_is_refused() {
    let robot = Robot::new(&[]);
    for (path, value, refused) in [
        ("rooms.hall.width", json!(1e39), "rooms.hall.width"),
        (
            "rooms",
            json!({"hall": {"width": 1e39}}),
            "rooms.hall.width",
        ),
        ("offsets", json!([1, 1e39]), "offsets.1"),
    ] {
        assert_eq!(
            told(robot.live.change(&[(path, value)])),
            format!("`{refused}`: 1e39 is outside of what f32 holds")
        );
    }
    assert_eq!(robot.live.version(), Version(0));
    robot.write("home/default.toml", "\noffsets = [0.5, -1e39]\n");
    let error = told(robot.live.reload());
    let expected = "home/default.toml:2: `offsets.1`: -1e39 is outside of what f32 holds";
    assert!(error.ends_with(expected), "{error}");
    robot.write("home/default.toml", "\noffsets = [0.5, 1e999]\n");
    let error = told(robot.live.reload());
    let expected = "home/default.toml:2: 1e999 is outside of what f64 holds";
    assert!(error.ends_with(expected), "{error}");
}

#[test]
fn a_replay_is_set_as_a_start_is() {
    let recorded = postcard::to_stdvec(&Robot::new(&[]).after_restart()).expect("it has a form");
    let with = |path: &str, value: &str| {
        let settings = [(path.to_owned(), value.to_owned())];
        with_settings::<Parameters>(&recorded, &settings)
    };
    let changed = with("rooms.hall.width", "inf").expect("a start takes it");
    let changed: Parameters = postcard::from_bytes(&changed).expect("it is the same type");
    assert_eq!(changed.rooms["hall"].width, f32::INFINITY);
    for (path, value, expected) in [
        (
            "lamp.radius",
            "inf",
            "--set: `lamp.radius`: inf is outside of 0..=1",
        ),
        (
            "offsets",
            "[1, 1e39]",
            "--set: `offsets.1`: 1e39 is outside of what f32 holds",
        ),
        (
            "lamp",
            "{ radius = 1, brightness = \"much\" }",
            "--set: `lamp.brightness`: expected u8, found string \"much\"",
        ),
    ] {
        assert_eq!(told(with(path, value)), expected);
    }
}

#[test]
fn what_is_not_finite_is_stored_as_it_is() {
    for path in ["rooms.hall.width", "rooms"] {
        for number in ["inf", "-inf", "nan"] {
            let robot = Robot::with(&[], set("rooms.hall.width", number));
            robot.live.store("default", &[path]).expect("it has a form");
            let expected = DEFAULT.replace("width = 4.0", &format!("width = {number}"));
            assert_eq!(robot.text("default.toml"), expected, "{path}");
            assert!(robot.live.changed_not_stored().is_empty());
        }
    }
    // Also where no later layer has it.
    let text = DEFAULT.replace("width = 4.0", "width = inf");
    let robot = Robot::new(&[("default.toml", &text)]);
    let live = &robot.live;
    live.change(&[("rooms.attic", json!({"width": 1.0}))])
        .expect_err("it has no such room");
    live.store("body.b1", &["rooms"]).expect("it has a form");
    let stored = robot.text("body.b1.toml");
    assert!(stored.contains("width = inf"), "{stored}");
    assert_eq!(robot.after_restart().rooms["hall"].width, f32::INFINITY);
}

#[test]
fn a_change_beside_what_is_not_finite_stays_when_files_change() {
    let text = DEFAULT.replace("[0.5, 1.5]", "[inf, 1.5]");
    let mut robot = Robot::new(&[("default.toml", &text)]);
    let changes = [("offsets.1", json!(2.5))];
    robot.live.change(&changes).expect("valid");
    robot.write("home/default.toml", "steps = 7\n");
    let polled = robot.live.poll().expect("it is new");
    polled.expect("it is right");
    assert_eq!(robot.seen().offsets, [f32::INFINITY, 2.5]);
    robot.live.store::<&str>("default", &[]).expect("it can be");
    assert!(robot.text("default.toml").contains("[inf, 2.5]"));
    assert!(robot.live.changed_not_stored().is_empty());
}

#[test]
fn what_is_not_finite_is_named_where_it_is_out_of_range() {
    for number in ["inf", "-inf", "nan"] {
        let robot = Robot::new(&[]);
        let text = DEFAULT.replace("radius = 0.25", &format!("radius = {number}"));
        robot.write("default.toml", &text);
        let error = told(robot.live.reload());
        let expected = format!("`lamp.radius`: {number} is outside of 0..=1");
        assert!(error.ends_with(&expected), "{error}");
    }
}

#[test]
fn no_later_layer_hides_what_a_file_would_lose() {
    let robot = Robot::with(&[], set("extra.limit", "3.0"));
    let live = &robot.live;
    live.change(&[("extra.limit", Value::Null)]).expect("valid");
    let error = told(live.store("default", &["extra.limit"]));
    assert!(
        error.starts_with("with it the next start would fail: "),
        "{error}"
    );
    assert!(error.contains("`extra.limit`: is missing"), "{error}");
    assert_eq!(robot.text("default.toml"), DEFAULT);
    // It was no layer to start with before.
    robot.write("body.b1.toml", "steps = 6\n");
    live.store("body.b1", &["lamp"]).expect("it can be stored");
}

#[test]
fn what_takes_a_value_away_is_named_where_it_is_missing() {
    let missing = |robot: Robot| told(robot.live.reload());
    let robot = Robot::new(&[]);
    robot.write("home/default.toml", "\n[lamp]\nradius = { unset = true }\n");
    let error = missing(robot);
    let expected =
        "home/default.toml:3: `lamp.radius`: is missing: `unset = true` takes it away here";
    assert!(error.ends_with(expected), "{error}");
    let robot = Robot::new(&[]);
    let mut layers = robot.layers.clone();
    layers.settings = vec![("lamp".into(), "{unset=true}".into())];
    let loaded = layers.load().expect("they can be read");
    assert_eq!(
        told(loaded.deserialize::<Parameters>()),
        "--set lamp={unset=true}: `lamp`: is missing: `unset = true` takes it away here"
    );
    layers.settings = vec![
        ("lamp".into(), "{unset=true}".into()),
        ("lamp.radius".into(), "0.5".into()),
    ];
    let loaded = layers.load().expect("they can be read");
    assert_eq!(
        told(loaded.deserialize::<Parameters>()),
        "--set lamp={unset=true}: `lamp.brightness`: is missing: `unset = true` takes `lamp` away here"
    );
}

#[test]
fn no_change_is_no_version() {
    let robot = Robot::new(&[]);
    assert_eq!(robot.live.change::<&str>(&[]), Ok(Version(0)));
    robot
        .live
        .change(&[("steps", json!(6))])
        .expect("it is valid");
    assert_eq!(robot.live.change::<&str>(&[]), Ok(Version(1)));
}
