//! Parameters of a running robot: read, changed, stored, reloaded.

mod exact;
mod layout;
mod store;

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use framework::parameters::{Layers, Live, LiveParameters, Provenance, Version};
use framework::{Clock, Reader, Reflect, buffer_of};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use tempfile::TempDir;

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Parameters {
    pub(crate) extra: Extra,
    pub(crate) lamp: Lamp,
    #[serde(default)]
    name: Option<String>,
    motion: Motion,
    offsets: Vec<f32>,
    #[serde(default)]
    pub(crate) rooms: BTreeMap<String, Room>,
    #[reflect(creation_only)]
    steps: u16,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Lamp {
    #[reflect(unit = "m", range = 0.0..=1.0)]
    pub(crate) radius: f32,
    pub(crate) brightness: u8,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Room {
    pub(crate) width: f32,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Extra {
    // Has to be there, which no file can say of what is absent.
    #[serde(deserialize_with = "Option::deserialize")]
    pub(crate) limit: Option<f32>,
    #[serde(default)]
    pub(crate) poses: Vec<Pose>,
    #[serde(default)]
    pub(crate) note: Option<String>,
    #[serde(default)]
    pub(crate) shelves: BTreeMap<String, Room>,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Pose {
    x: f32,
    #[serde(default)]
    y: Option<f32>,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
enum Motion {
    Stand,
    Walk { speed: f32 },
    Turn { angle: f32 },
}

const DEFAULT: &str = "\
# Everything that all robots share.
steps = 5
motion = \"Stand\"
name = \"nobody\"
offsets = [0.5, 1.5] # both sides

# The lamp.
[lamp]
radius = 0.25   # as measured
brightness = 7

[rooms.hall]
width = 4.0

[extra]
limit = 2.0
";

/// A robot's parameters and their files.
pub(crate) struct Robot {
    pub(crate) folder: TempDir,
    pub(crate) layers: Layers,
    pub(crate) live: Live,
    pub(crate) reader: Reader<Parameters>,
}

impl Robot {
    pub(crate) fn new(files: &[(&str, &str)]) -> Self {
        Self::with(files, |_| ())
    }

    pub(crate) fn with(files: &[(&str, &str)], change: impl FnOnce(&mut Layers)) -> Self {
        let folder = tempfile::tempdir().expect("there is room");
        fs::create_dir(folder.path().join("home")).expect("it is new");
        for (name, text) in [("default.toml", DEFAULT)].iter().chain(files) {
            fs::write(folder.path().join(name), text).expect("there is room");
        }
        let mut layers = Layers {
            directory: folder.path().to_owned(),
            location: Some("home".into()),
            identities: vec![("body".into(), "b1".into())],
            ..Layers::default()
        };
        change(&mut layers);
        let loaded = layers.load().expect("the files are right");
        let start: Parameters = loaded.deserialize().expect("the files are right");
        let (writer, [reader], []) = buffer_of(|| start.clone(), []);
        let live = LiveParameters::new(writer, start, Clock::wall()).live();
        live.came_from(layers.clone(), loaded)
            .expect("they can be read");
        Self {
            folder,
            layers,
            live,
            reader,
        }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect("it is there")
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("there is room");
    }

    pub(crate) fn value(&self, path: &str) -> Value {
        self.live.read(path).expect(path).value
    }

    /// What a cycler has after its `begin`.
    pub(crate) fn seen(&mut self) -> Parameters {
        self.reader.take();
        self.reader.view().value().clone()
    }

    /// What the next start will have.
    pub(crate) fn after_restart(&self) -> Parameters {
        let loaded = self.layers.load().expect("the files are right");
        loaded.deserialize().expect("the files are right")
    }
}

fn told<T: std::fmt::Debug>(result: Result<T, impl std::fmt::Display>) -> String {
    result.expect_err("it is refused").to_string()
}

#[test]
fn every_leaf_knows_where_it_comes_from() {
    let robot = Robot::with(&[("body.b1.toml", "[lamp]\nbrightness = 9\n")], |layers| {
        layers.settings = vec![("rooms.hall.width".into(), "5.0".into())];
    });
    robot
        .live
        .change(&[("motion", json!({"Walk": {"speed": 0.5}}))])
        .expect("it is a motion");
    let file = |name: &str, line| Provenance::File {
        file: robot.path(name).display().to_string(),
        line,
    };
    let all = robot.live.read("").expect("it is everything");
    let of = |path: &str| {
        let leaf = all.leaves.iter().find(|leaf| leaf.path == path);
        leaf.expect(path).provenance.clone()
    };
    assert_eq!(of("steps"), file("default.toml", 2));
    assert_eq!(of("lamp.radius"), file("default.toml", 9));
    assert_eq!(of("lamp.brightness"), file("body.b1.toml", 2));
    assert_eq!(of("offsets"), file("default.toml", 5));
    let setting = "rooms.hall.width=5.0".to_owned();
    assert_eq!(of("rooms.hall.width"), Provenance::Setting { setting });
    let version = Version(1);
    assert_eq!(of("motion.Walk.speed"), Provenance::Live { version });
    let one = robot.live.read("lamp.radius").expect("it is there");
    assert_eq!((one.value, one.version), (json!(0.25), version));
    assert_eq!(one.leaves.len(), 1);
    assert_eq!(
        told(robot.live.read("lamp.size")),
        "`lamp.size`: no `size`: `lamp` has `brightness`, `radius`"
    );
}

#[test]
fn several_fields_change_at_once_or_not_at_all() {
    let mut robot = Robot::new(&[]);
    let before = robot.seen();
    for (changes, refusals) in [
        (
            vec![
                ("lamp.brightness", json!(8)),
                ("lamp.radius", json!("wide")),
            ],
            "`lamp.radius`: expected f32, found string \"wide\"",
        ),
        (
            vec![("lamp.brightness", json!(8)), ("lamp.size", json!(1))],
            "`lamp.size`: no `size`: `lamp` has `brightness`, `radius`",
        ),
        (
            vec![("lamp.brightness", json!(8)), ("lamp.radius", json!(1.5))],
            "`lamp.radius`: 1.5 is outside of 0..=1",
        ),
        (
            vec![("steps", json!(-1)), ("lamp.brightness", json!(256))],
            "`steps`: invalid value: integer `-1`, expected u16\n`lamp.brightness`: invalid value: integer `256`, expected u8",
        ),
        (
            vec![("hardware.port", json!(1))],
            "`hardware.port`: is the hardware's, which reads it once, at the start: change its file and start again",
        ),
        (
            vec![("lamp..radius", json!(1))],
            "`lamp..radius`: `lamp..radius` is no path: expected names or indices joined by `.`",
        ),
    ] {
        assert_eq!(told(robot.live.change(&changes)), refusals);
        assert_eq!(robot.seen(), before);
        assert_eq!(robot.live.version(), Version(0));
    }
    let changes = [("lamp.brightness", json!(8)), ("lamp.radius", json!(1.0))];
    assert_eq!(robot.live.change(&changes), Ok(Version(1)));
    // A cycle that has begun keeps what it took.
    assert_eq!(*robot.reader.view().value(), before);
    let after = robot.seen();
    assert_eq!((after.lamp.brightness, after.lamp.radius), (8, 1.0));
    assert_eq!(robot.reader.view().cycle(), 1);
}

#[test]
fn no_reader_ever_sees_half_of_a_change() {
    let robot = Robot::new(&[]);
    let Robot {
        live, mut reader, ..
    } = robot;
    std::thread::scope(|scope| {
        scope.spawn(|| {
            for step in 0..2000_u16 {
                let even = f32::from(step % 200) / 200.0;
                let changes = [
                    ("lamp.radius", json!(even)),
                    ("lamp.brightness", json!(step % 200)),
                ];
                live.change(&changes).expect("both are valid");
            }
        });
        let mut last = 0;
        while last < 2000 {
            reader.take();
            let view = reader.view();
            let lamp = &view.value().lamp;
            if view.cycle() > 0 {
                let expected = f32::from(lamp.brightness) / 200.0;
                assert_eq!(lamp.radius, expected, "version {}", view.cycle());
            }
            assert!(view.cycle() >= last);
            last = view.cycle();
        }
    });
}

#[test]
fn what_was_changed_and_not_stored_is_listed_until_it_is_as_before() {
    let robot = Robot::new(&[]);
    let live = &robot.live;
    let paths = || -> Vec<String> {
        let all = live.changed_not_stored().into_iter();
        all.map(|one| format!("{} {} {}", one.path, one.value, one.stored))
            .collect()
    };
    live.change(&[("lamp.radius", json!(0.1))]).expect("valid");
    live.change(&[("name", Value::Null)]).expect("valid");
    assert_eq!(paths(), ["lamp.radius 0.1 0.25", "name null \"nobody\""]);
    live.change(&[("lamp", json!({"radius": 0.2, "brightness": 7}))])
        .expect("valid");
    live.change(&[("lamp.brightness", json!(1))])
        .expect("valid");
    assert_eq!(live.changed_not_stored().len(), 2);
    assert_eq!(live.changed_not_stored()[0].version, Version(4));
    live.change(&[("lamp", json!({"radius": 0.25, "brightness": 7}))])
        .expect("valid");
    assert_eq!(paths(), ["name null \"nobody\""]);
    assert_eq!(live.creation_only(), ["steps"]);
}

#[test]
fn a_reload_really_replaces() {
    let mut robot = Robot::new(&[]);
    robot
        .live
        .change(&[("lamp.brightness", json!(1)), ("steps", json!(1))])
        .expect("valid");
    robot.write(
        "default.toml",
        &DEFAULT.replace("radius = 0.25", "radius = 0.5"),
    );
    assert_eq!(robot.live.reload().expect("it is right"), Version(2));
    assert_eq!(robot.seen(), robot.after_restart());
    assert!(robot.live.changed_not_stored().is_empty());
    // The change after a reload starts from what was loaded, not from what was there before.
    robot.live.change(&[("steps", json!(6))]).expect("valid");
    let seen = robot.seen();
    assert_eq!(
        (seen.lamp.radius, seen.lamp.brightness, seen.steps),
        (0.5, 7, 6)
    );
}

#[test]
fn a_mistake_in_a_file_changes_nothing() {
    let mut robot = Robot::new(&[]);
    let before = robot.seen();
    for (text, told_text) in [
        (
            DEFAULT.replace("radius = 0.25", "radius = 1.25"),
            "default.toml:9: `lamp.radius`: 1.25 is outside of 0..=1",
        ),
        (
            DEFAULT.replace("radius = 0.25", "radius = nan"),
            "default.toml:9: `lamp.radius`: nan is outside of 0..=1",
        ),
        (
            DEFAULT.replace("steps = 5", "steps = \"many\""),
            "default.toml:2: `steps`: expected u16, found string \"many\"",
        ),
        ("steps = ".to_owned(), "default.toml:1: "),
    ] {
        robot.write("default.toml", &text);
        let error = told(robot.live.reload());
        assert!(error.contains(told_text), "{error}");
        assert_eq!(robot.seen(), before);
    }
    assert_eq!(robot.live.version(), Version(0));
}

#[test]
fn an_edited_file_is_seen_and_changes_stay_on_top() {
    let mut robot = Robot::new(&[]);
    assert!(robot.live.poll().is_none());
    robot.live.change(&[("steps", json!(9))]).expect("valid");
    assert!(robot.live.poll().is_none());
    // A layer that was not there.
    robot.write("home/body.b1.toml", "steps = 7\n[lamp]\nbrightness = 3\n");
    let polled = robot.live.poll().expect("it is new");
    assert_eq!(polled.expect("it is right"), Version(2));
    let seen = robot.seen();
    assert_eq!((seen.lamp.brightness, seen.steps), (3, 9));
    let unstored = robot.live.changed_not_stored();
    assert_eq!(
        (&unstored[0].path[..], &unstored[0].stored),
        ("steps", &json!(7))
    );
    // A mistake is told once, and the robot goes on.
    robot.write("home/body.b1.toml", "lamp = 3\n");
    let error = told(robot.live.poll().expect("it is new"));
    assert!(error.contains("body.b1.toml:1"), "{error}");
    assert!(robot.live.poll().is_none());
    assert_eq!(robot.seen().lamp.brightness, 3);
    fs::remove_file(robot.path("home/body.b1.toml")).expect("it is there");
    robot.live.poll().expect("it is gone").expect("it is right");
    assert_eq!(robot.seen().lamp.brightness, 7);
}

#[test]
fn a_change_that_no_longer_fits_holds_up_no_file() {
    let mut robot = Robot::new(&[]);
    let changes = [("rooms.hall.width", json!(5.0)), ("steps", json!(9))];
    robot.live.change(&changes).expect("valid");
    let text = DEFAULT.replace("[rooms.hall]\nwidth = 4.0\n", "");
    robot.write(
        "default.toml",
        &text.replace("brightness = 7", "brightness = 3"),
    );
    let polled = robot.live.poll().expect("it is new");
    assert_eq!(polled.expect("it is right"), Version(2));
    let seen = robot.seen();
    assert_eq!((seen.lamp.brightness, seen.steps), (3, 9));
    assert!(seen.rooms.is_empty(), "{:?}", seen.rooms);
    let unstored = robot.live.changed_not_stored().into_iter();
    let unstored: Vec<_> = unstored.map(|change| change.path).collect();
    assert_eq!(unstored, ["steps"]);
    // An editor empties a file before it writes it.
    robot.write("default.toml", DEFAULT);
    robot.live.poll().expect("it is new").expect("it is right");
    assert_eq!(robot.seen().rooms["hall"].width, 5.0);
    let unstored = robot.live.changed_not_stored().into_iter();
    let unstored: Vec<_> = unstored.map(|change| change.path).collect();
    assert_eq!(unstored, ["rooms.hall.width", "steps"]);
}

#[test]
fn a_change_without_a_place_ends_with_a_reload_and_where_another_one_comes() {
    let mut robot = Robot::new(&[]);
    let without = DEFAULT.replace("[rooms.hall]\nwidth = 4.0\n", "");
    let mut width_after = |between: &dyn Fn(&Robot)| {
        let change = [("rooms.hall.width", json!(5.0))];
        robot.live.change(&change).expect("valid");
        robot.write("default.toml", &without);
        robot.live.poll().expect("it is new").expect("it is right");
        between(&robot);
        robot.write("default.toml", DEFAULT);
        robot.live.poll().expect("it is new").expect("it is right");
        robot.seen().rooms["hall"].width
    };
    assert_eq!(width_after(&|_| ()), 5.0);
    let reload = |robot: &Robot| {
        robot.live.reload().expect("they are right");
    };
    assert_eq!(width_after(&reload), 4.0);
    let replace = |robot: &Robot| {
        let change = [("rooms", json!({ "hall": { "width": 6.0 } }))];
        robot.live.change(&change).expect("valid");
    };
    assert_eq!(width_after(&replace), 6.0);
}

#[test]
fn a_mistake_in_the_choice_of_the_location_is_told_once() {
    let mut robot = Robot::with(&[("parameters.toml", "location = \"home\"\n")], |layers| {
        layers.location = None;
    });
    assert!(robot.live.poll().is_none());
    robot.write("parameters.toml", "location = \n");
    let error = told(robot.live.poll().expect("it is new"));
    assert!(error.contains("parameters.toml:1"), "{error}");
    assert!(robot.live.poll().is_none());
    // Asked for, it is told again.
    assert_eq!(told(robot.live.reload()), error);
    assert!(robot.live.poll().is_none());
    fs::remove_file(robot.path("parameters.toml")).expect("it is there");
    fs::create_dir(robot.path("parameters.toml")).expect("its place is free");
    let error = told(robot.live.poll().expect("it is another mistake"));
    assert!(error.contains("cannot read"), "{error}");
    assert!(robot.live.poll().is_none());
    robot.write("home/default.toml", "steps = 7\n");
    fs::remove_dir(robot.path("parameters.toml")).expect("it is there");
    robot.write("parameters.toml", "location = \"home\"\n");
    robot.live.poll().expect("it is new").expect("it is right");
    assert_eq!(robot.seen().steps, 7);
}

#[test]
fn what_is_edited_while_the_robot_is_created_is_found() {
    let robot = Robot::new(&[]);
    let loaded = robot.layers.load().expect("the files are right");
    let start: Parameters = loaded.deserialize().expect("the files are right");
    robot.write("body.b1.toml", "steps = 7\n");
    let (writer, [], []) = buffer_of(|| start.clone(), []);
    let live = LiveParameters::new(writer, start, Clock::wall());
    live.came_from(robot.layers.clone(), loaded)
        .expect("they can be read");
    live.poll().expect("it is new").expect("it is right");
    assert_eq!(live.read("steps").expect("it is there").value, json!(7));
    assert!(live.poll().is_none());
}

#[test]
fn a_layer_can_take_away_what_earlier_layers_say() {
    let robot = Robot::new(&[(
        "home/default.toml",
        "name = { unset = true }\n[rooms]\nhall = { unset = true }\nattic = { width = 2.0 }\n[rooms.cellar]\nunset = true\n",
    )]);
    assert_eq!(robot.value("name"), Value::Null);
    assert_eq!(robot.value("rooms"), json!({"attic": {"width": 2.0}}));
    let robot = Robot::with(&[], |layers| {
        layers.environment = vec![("HULK_PARAMETERS__name".into(), "{ unset = true }".into())];
    });
    assert_eq!(robot.value("name"), Value::Null);
}

#[test]
fn without_files_there_is_nothing_to_store_or_reload() {
    let start = Robot::new(&[]).after_restart();
    let (writer, [], []) = buffer_of(|| start.clone(), []);
    let live = LiveParameters::new(writer, start, Clock::wall());
    live.change(&[("steps", json!(1))]).expect("valid");
    let none = "the parameters of this robot come from no files";
    assert_eq!(told(live.reload()), none);
    assert_eq!(told(live.store("default", &["steps"])), none);
    assert!(live.poll().is_none());
}
