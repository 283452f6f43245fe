//! Storing into a layer.

use serde_json::{Value, json};

use super::{DEFAULT, Robot, told};

#[test]
fn comments_and_everything_else_stay() {
    let robot = Robot::new(&[]);
    robot
        .live
        .change(&[
            ("lamp.radius", json!(0.1)),
            ("offsets.1", json!(2.5)),
            ("motion", json!({"Walk": {"speed": 0.3}})),
        ])
        .expect("valid");
    let stored = robot
        .live
        .store::<&str>("default", &[])
        .expect("it can be stored");
    assert_eq!(stored.paths, ["lamp.radius", "motion", "offsets"]);
    assert_eq!(stored.warnings, Vec::<String>::new());
    let expected = DEFAULT
        .replace("radius = 0.25", "radius = 0.1")
        .replace("[0.5, 1.5]", "[0.5, 2.5]")
        .replace("\"Stand\"", "{ Walk = { speed = 0.3 } }");
    assert_eq!(robot.text("default.toml"), expected);
    assert!(robot.live.changed_not_stored().is_empty());
    assert!(robot.live.poll().is_none(), "it was the robot itself");
    assert_eq!(robot.after_restart().lamp.radius, 0.1);
    let names: Vec<_> = std::fs::read_dir(robot.folder.path())
        .expect("it is there")
        .map(|entry| entry.expect("it is there").file_name())
        .collect();
    assert_eq!(names.len(), 2, "nothing is left beside them: {names:?}");
}

#[test]
fn a_new_layer_gets_only_what_was_asked_for() {
    let mut robot = Robot::new(&[]);
    assert_eq!(
        robot.live.layers(),
        ["default", "home/default", "body.b1", "home/body.b1"]
    );
    robot
        .live
        .change(&[("lamp.radius", json!(0.125)), ("steps", json!(6))])
        .expect("valid");
    robot
        .live
        .store("home/body.b1.toml", &["lamp.radius"])
        .expect("it can be stored");
    assert_eq!(robot.text("home/body.b1.toml"), "[lamp]\nradius = 0.125\n");
    assert_eq!(robot.text("default.toml"), DEFAULT);
    let left = robot.live.changed_not_stored();
    assert_eq!(left.len(), 1);
    assert_eq!(left[0].path, "steps");
    let after = robot.after_restart();
    assert_eq!((after.lamp.radius, after.steps), (0.125, 5));
    assert_eq!(robot.seen().steps, 6);
}

#[test]
fn what_a_later_layer_gives_too_is_told() {
    let robot = Robot::with(&[("body.b1.toml", "[lamp]\nbrightness = 9\n")], |layers| {
        layers.settings = vec![("steps".into(), "4".into())];
    });
    robot
        .live
        .change(&[
            ("lamp", json!({"radius": 0.5, "brightness": 1})),
            ("steps", json!(3)),
        ])
        .expect("valid");
    let stored = robot
        .live
        .store::<&str>("default", &[])
        .expect("it can be stored");
    let file = robot.path("body.b1.toml").display().to_string();
    assert_eq!(
        stored.warnings,
        [
            format!("`lamp.brightness` has no effect at the next start: {file}:2 comes later"),
            "`steps` has no effect at the next start: --set steps=4 comes later".to_owned(),
        ]
    );
    // It would be gone after a restart, so it still counts as not stored.
    let left = robot.live.changed_not_stored().into_iter();
    let left: Vec<_> = left.map(|one| (one.path, one.stored)).collect();
    assert_eq!(
        left,
        [
            ("lamp".to_owned(), json!({"radius": 0.5, "brightness": 9})),
            ("steps".to_owned(), json!(4)),
        ]
    );
}

#[test]
fn what_is_absent_now_is_taken_away() {
    let robot = Robot::new(&[]);
    robot
        .live
        .change(&[
            ("name", Value::Null),
            ("rooms", json!({"attic": {"width": 2.5}})),
        ])
        .expect("valid");
    robot
        .live
        .store::<&str>("body.b1", &[])
        .expect("it can be stored");
    let after = robot.after_restart();
    assert_eq!(
        (after.name, after.rooms.len()),
        (None, 1),
        "{}",
        robot.text("body.b1.toml")
    );
    assert_eq!(after.rooms["attic"].width, 2.5);
    // In the only layer that has it, it just goes.
    robot
        .live
        .store("default", &["name", "rooms"])
        .expect("it can be stored");
    assert!(!robot.text("default.toml").contains("nobody"));
    assert!(!robot.text("default.toml").contains("hall"));
}

#[test]
fn what_is_absent_at_any_depth_is_taken_away_in_a_new_layer_too() {
    let more =
        "note = \"old\"\n[extra.shelves.left]\nwidth = 1.0\n[extra.shelves.right]\nwidth = 2.0\n";
    for (file, before) in [
        ("body.b1", None),
        ("body.b1", Some("extra = 3\n")),
        ("body.b1", Some("[extra]\nlimit = 1.0\n")),
        ("body.b1", Some("# empty\n")),
    ] {
        let text = format!("{DEFAULT}{more}");
        let robot = Robot::new(&[("default.toml", &text)]);
        let shelves = json!({ "left": { "width": 1.5 } });
        robot
            .live
            .change(&[("extra.note", Value::Null), ("extra.shelves", shelves)])
            .expect("valid");
        if let Some(before) = before {
            robot.write(&format!("{file}.toml"), before);
        }
        let stored = robot
            .live
            .store(file, &["extra"])
            .expect("it can be stored");
        assert_eq!(stored.warnings, [""; 0], "{before:?}");
        let extra = robot.after_restart().extra;
        let text = robot.text(&format!("{file}.toml"));
        assert_eq!(extra.note, None, "{text}");
        let shelves: Vec<_> = extra.shelves.into_iter().collect();
        assert_eq!(shelves.len(), 1, "{text}");
        assert_eq!((&shelves[0].0[..], shelves[0].1.width), ("left", 1.5));
        assert!(robot.live.changed_not_stored().is_empty(), "{text}");
    }
}

#[test]
fn an_earlier_layer_is_not_told_to_come_later() {
    let text = DEFAULT.replace("\"Stand\"", "{ Turn = { angle = 1.0 } }");
    let robot = Robot::new(&[("default.toml", &text)]);
    let walk = json!({ "Walk": { "speed": 0.5 } });
    robot.live.change(&[("motion", walk)]).expect("valid");
    let stored = robot.live.store("body.b1", &["motion"]);
    assert_eq!(stored.expect("it can be stored").warnings, [""; 0]);
    assert!(robot.live.changed_not_stored().is_empty());
}

#[test]
fn what_cannot_be_stored_leaves_the_file_as_it_was() {
    let robot = Robot::new(&[]);
    let live = &robot.live;
    assert_eq!(
        told(live.store("atic/default", &["steps"])),
        "no layer `atic/default`: this robot has `default`, `home/default`, `body.b1`, `home/body.b1`"
    );
    assert_eq!(
        told(live.store("default", &["stops"])),
        "`stops`: no `stops`: the value has `extra`, `lamp`, `motion`, `name`, `offsets`, `rooms`, `steps`"
    );
    assert_eq!(
        told(live.store("default", &[""])),
        "all parameters are no value: name a part"
    );
    // Without the layer that has them, required values would be missing at the next start.
    robot.write("home/default.toml", "steps = true\n");
    live.change(&[("lamp.brightness", json!(2))])
        .expect("valid");
    let error = told(live.store("default", &["lamp.brightness"]));
    assert!(error.contains("home/default.toml:1"), "{error}");
    assert_eq!(robot.text("default.toml"), DEFAULT);
}

#[cfg(unix)]
#[test]
fn a_link_stays_a_link() {
    let robot = Robot::new(&[]);
    let shared = robot.path("shared.toml");
    std::fs::write(&shared, "# shared\n").expect("there is room");
    std::os::unix::fs::symlink(&shared, robot.path("body.b1.toml")).expect("it is new");
    robot.live.change(&[("steps", json!(8))]).expect("valid");
    robot
        .live
        .store("body.b1", &["steps"])
        .expect("it can be stored");
    assert_eq!(robot.text("shared.toml"), "# shared\nsteps = 8\n");
    assert!(robot.path("body.b1.toml").is_symlink());
}

#[test]
fn what_somebody_edits_meanwhile_is_found() {
    for (file, text) in [
        ("home/body.b1.toml", "[lamp]\nbrightness = 3\n".to_owned()),
        (
            "default.toml",
            DEFAULT.replace("brightness = 7", "brightness = 3"),
        ),
    ] {
        let mut robot = Robot::new(&[]);
        robot.write(file, &text);
        let live = &robot.live;
        live.change(&[("steps", json!(9))]).expect("valid");
        live.store("default", &["steps"]).expect("it can be stored");
        assert_eq!(robot.seen().lamp.brightness, 7, "{file}");
        let polled = robot.live.poll().expect("somebody edited a file");
        polled.expect("it is right");
        assert_eq!(robot.seen().lamp.brightness, 3, "{file}");
    }
}

#[test]
fn what_was_not_there_before_is_stored_like_all_else() {
    let without = DEFAULT.replace("\n[rooms.hall]\nwidth = 4.0\n", "");
    let robot = Robot::new(&[("default.toml", &without)]);
    let unstored = || {
        let changes = robot.live.changed_not_stored().into_iter();
        changes.map(|change| change.path).collect::<Vec<_>>()
    };
    let rooms = json!({ "hall": { "width": 5.0 }, "cellar": { "width": 3.0 } });
    let changes = [("rooms", rooms), ("lamp.radius", json!(0.5))];
    robot.live.change(&changes).expect("valid");
    assert_eq!(unstored(), ["lamp.radius", "rooms"]);
    let stored = robot
        .live
        .store("default", &["rooms.cellar", "lamp.radius"])
        .expect("it can be stored");
    assert_eq!(stored.paths, ["rooms.cellar", "lamp.radius"]);
    // The other room is not.
    assert_eq!(unstored(), ["rooms"]);
    robot
        .live
        .store("default", &["rooms.hall.width"])
        .expect("it can be stored");
    assert_eq!(unstored(), [""; 0]);
    let after = robot.after_restart();
    let rooms: Vec<_> = after.rooms.values().map(|room| room.width).collect();
    assert_eq!((after.lamp.radius, rooms), (0.5, vec![3.0, 5.0]));
}
