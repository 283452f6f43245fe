//! Layers of parameters: which value wins, and what an error says.

use std::fs;

use framework::Reflect;
use framework::parameters::{Layers, Origin, from_table, from_text};
use serde::{Deserialize, Serialize};
use tempfile::TempDir;

#[derive(Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    ball: Ball,
    #[serde(default)]
    name: Option<String>,
    kick: Kick,
    offsets: Vec<i32>,
}

#[derive(Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
struct Ball {
    radius: f32,
    mass: f32,
}

#[derive(Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
enum Kick {
    None,
    Straight(f32),
    Turned { angle: f32, strength: u8 },
}

const DEFAULT: &str = "\
kick = \"None\"
offsets = [1, 2, 3]

[ball]
radius = 0.05
mass = 0.044

[hardware.simulated]
port = 1
";

fn layers(files: &[(&str, &str)]) -> (TempDir, Layers) {
    let directory = tempfile::tempdir().expect("a temporary directory");
    for (file, text) in files {
        let path = directory.path().join(file);
        fs::create_dir_all(path.parent().expect("has a parent")).expect("can be created");
        fs::write(path, text).expect("can be written");
    }
    let layers = Layers {
        directory: directory.path().to_owned(),
        ..Layers::default()
    };
    (directory, layers)
}

fn pairs(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
    pairs
        .iter()
        .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
        .collect()
}

fn error(files: &[(&str, &str)], change: impl FnOnce(&mut Layers)) -> String {
    let (directory, mut layers) = layers(files);
    change(&mut layers);
    let result = layers
        .load()
        .and_then(|parameters| parameters.deserialize::<Parameters>());
    let message = result.expect_err("something is wrong").to_string();
    message.replace(&format!("{}/", directory.path().display()), "")
}

#[test]
fn later_layers_win_field_by_field() {
    let (_directory, mut layers) = layers(&[
        ("default.toml", DEFAULT),
        (
            "lab/default.toml",
            "name = \"lab\"\nkick = { Straight = 1 }\n[ball]\nradius = 1.0\n",
        ),
        ("body.17.toml", "offsets = [4]\n[ball]\nradius = 2.0\n"),
        ("head.3.toml", "[ball]\nradius = 3.0\n"),
        (
            "lab/body.17.toml",
            "name = \"body in the lab\"\n[ball]\nradius = 4.0\n",
        ),
        ("body.18.toml", "broken"),
    ]);
    let mut radius = |change: &dyn Fn(&mut Layers)| {
        change(&mut layers);
        layers
            .load()
            .and_then(|parameters| parameters.deserialize::<Parameters>())
            .expect("valid")
    };
    let default = radius(&|_| ());
    assert_eq!(
        default.ball,
        Ball {
            radius: 0.05,
            mass: 0.044
        }
    );
    assert_eq!(
        (default.name, default.kick, default.offsets),
        (None, Kick::None, vec![1, 2, 3])
    );
    let lab = radius(&|layers| layers.location = Some("lab".to_owned()));
    assert_eq!(
        (lab.ball.radius, lab.ball.mass, lab.kick),
        (1.0, 0.044, Kick::Straight(1.0))
    );
    let body = radius(&|layers| layers.identities = pairs(&[("body", "17"), ("head", "3")]));
    assert_eq!(
        (body.ball.radius, body.offsets, body.name.as_deref()),
        (4.0, vec![4], Some("body in the lab"))
    );
    let environment = pairs(&[
        ("HULK_PARAMETERS__ball__radius", "5.0"),
        ("PATH", "x"),
        ("HULK_PARAMETERS__name", "cup"),
    ]);
    let environment = radius(&|layers| layers.environment = environment.clone());
    assert_eq!(
        (environment.ball.radius, environment.name.as_deref()),
        (5.0, Some("cup"))
    );
    let settings = pairs(&[
        ("ball.radius", "6"),
        ("kick", "{ Turned = { angle = 0.5, strength = 3 } }"),
    ]);
    let set = radius(&|layers| layers.settings = settings.clone());
    assert_eq!(
        (set.ball.radius, set.kick),
        (
            6.0,
            Kick::Turned {
                angle: 0.5,
                strength: 3
            }
        )
    );
}

#[test]
fn a_later_layer_replaces_the_whole_value_of_an_enum() {
    let kick = |earlier: &str, later: &str| {
        let default = DEFAULT.replace("\"None\"", earlier);
        let (_directory, mut layers) = layers(&[("default.toml", &default)]);
        layers.settings = pairs(&[("kick", later)]);
        layers
            .load()
            .and_then(|parameters| parameters.deserialize::<Parameters>())
            .map(|parameters| parameters.kick)
    };
    let turned = "{ Turned = { angle = 0.5, strength = 3 } }";
    assert_eq!(
        kick(turned, "{ Straight = 2 }").expect("valid"),
        Kick::Straight(2.0)
    );
    assert_eq!(kick(turned, "None").expect("valid"), Kick::None);
    let halfway = kick(turned, "{ Turned = { angle = 1.0 } }").expect_err("not a whole value");
    assert!(
        halfway
            .to_string()
            .contains("`kick.Turned.strength`: is missing"),
        "{halfway}"
    );
}

#[test]
fn the_directory_may_choose_the_location() {
    let (_directory, mut layers) = layers(&[
        ("default.toml", DEFAULT),
        ("parameters.toml", "location = \"lab\"\n"),
        ("lab/default.toml", "name = \"lab\"\n"),
        ("cup/default.toml", "name = \"cup\"\n"),
    ]);
    let name = |layers: &Layers| {
        layers
            .load()
            .and_then(|parameters| parameters.deserialize::<Parameters>())
            .expect("valid")
            .name
    };
    assert_eq!(name(&layers).as_deref(), Some("lab"));
    layers.location = Some("cup".to_owned());
    assert_eq!(name(&layers).as_deref(), Some("cup"));
}

#[test]
fn a_location_that_is_not_there_is_an_error_with_those_that_are() {
    let files = [
        ("default.toml", DEFAULT),
        ("lab/default.toml", ""),
        ("cup/default.toml", ""),
    ];
    let message = error(&files, |layers| layers.location = Some("lap".to_owned()));
    assert!(
        message.ends_with("has no location `lap`: there are cup, lab; did you mean `lab`?"),
        "{message}"
    );
    let chosen = [
        ("default.toml", DEFAULT),
        ("parameters.toml", "location = \"outside\"\n"),
    ];
    let message = error(&chosen, |_| ());
    assert!(
        message.ends_with("has no location `outside`: it has none"),
        "{message}"
    );
}

#[test]
fn every_value_knows_its_place() {
    let (directory, mut layers) = layers(&[("default.toml", DEFAULT)]);
    layers.settings = pairs(&[("ball.mass", "1")]);
    let parameters = layers.load().expect("valid");
    let path = directory.path().join("default.toml").display().to_string();
    let at = |line| {
        Some(Origin::File {
            path: path.as_str().into(),
            line,
        })
    };
    assert_eq!(parameters.origin("ball.radius").cloned(), at(5));
    assert_eq!(parameters.origin("offsets.1").cloned(), at(2));
    assert_eq!(
        parameters
            .origin("ball.mass")
            .map(ToString::to_string)
            .as_deref(),
        Some("--set ball.mass=1")
    );
    assert_eq!(parameters.origin("ball.colour"), None);
    assert_eq!(parameters.files(), [directory.path().join("default.toml")]);
}

#[test]
fn the_hardware_table_is_apart() {
    let (_directory, layers) = layers(&[("default.toml", DEFAULT)]);
    let parameters = layers.load().expect("valid");
    parameters
        .deserialize::<Parameters>()
        .expect("`hardware` is nobody else's");
    assert_eq!(
        parameters
            .hardware("simulated")
            .expect("a table")
            .to_string()
            .trim(),
        "port = 1"
    );
    assert!(
        parameters
            .hardware("nao")
            .expect("none is an empty one")
            .is_empty()
    );
}

#[test]
fn a_missing_file_is_named() {
    let message = error(&[("lab/default.toml", "")], |_| ());
    assert_eq!(
        message,
        "default.toml is missing: it holds the default of every parameter"
    );
}

#[test]
fn wrong_values_are_named_with_file_line_and_key() {
    let with = |text: &str| {
        error(
            &[("default.toml", DEFAULT), ("lab/default.toml", text)],
            |layers| {
                layers.location = Some("lab".to_owned());
            },
        )
    };
    let cases = [
        (
            "\n[ball]\nradius = \"small\"\n",
            "lab/default.toml:3: `ball.radius`: expected f32, found string \"small\"",
        ),
        (
            "\n[ball]\nradios = 1.0\n",
            "lab/default.toml:3: `ball.radios`: nothing reads it; did you mean `radius`?",
        ),
        (
            "whistle = 1\n",
            "lab/default.toml:1: `whistle`: nothing reads it; expected are ball, name, kick, offsets",
        ),
        (
            "offsets = [\n  1,\n  2.5,\n]\n",
            "lab/default.toml:3: `offsets.1`: expected i32, found floating point `2.5`",
        ),
        (
            "ball = 1\n",
            "lab/default.toml:1: `ball`: expected struct Ball, found integer `1`",
        ),
        (
            "kick = \"Strait\"\n",
            "lab/default.toml:1: `kick`: no variant `Strait`; did you mean `Straight`?",
        ),
        (
            "kick = { Turned = { angle = 1.0, strength = 300 } }\n",
            "lab/default.toml:1: `kick.Turned.strength`: invalid value: integer `300`, expected u8",
        ),
        (
            "kick = { Turned = { angle = 1.0 } }\n",
            "lab/default.toml:1: `kick.Turned.strength`: is missing: no layer has it",
        ),
        (
            "kick = \"Straight\"\n",
            "lab/default.toml:1: `kick`: variant `Straight` has a value: { Straight = … }",
        ),
        (
            "kick = 1\n",
            "lab/default.toml:1: `kick`: expected a variant's name, found an integer",
        ),
        ("a = 1\na = 2\n", "lab/default.toml:2: duplicate key"),
    ];
    for (text, expected) in cases {
        let message = with(text);
        assert!(message.ends_with(expected), "{text}\n{message}\n{expected}");
    }
}

#[test]
fn a_missing_value_is_named_with_its_table_and_all_layers() {
    let files = [
        (
            "default.toml",
            "kick = \"None\"\noffsets = []\n[ball]\nradius = 1\n",
        ),
        ("lab/default.toml", ""),
    ];
    let message = error(&files, |layers| layers.location = Some("lab".to_owned()));
    assert!(
        message.contains("parameters of default.toml, lab/default.toml"),
        "{message}"
    );
    assert!(
        message.ends_with("default.toml:3: `ball.mass`: is missing: no layer has it"),
        "{message}"
    );
}

#[test]
fn settings_and_environment_are_named_in_errors() {
    let files = [("default.toml", DEFAULT)];
    let message = error(&files, |layers| {
        layers.settings = pairs(&[("ball.radius", "big")])
    });
    assert_eq!(
        message,
        "--set ball.radius=big: `ball.radius`: expected f32, found string \"big\""
    );
    let variable = "HULK_PARAMETERS__offsets";
    let message = error(&files, |layers| {
        layers.environment = pairs(&[(variable, "{}")])
    });
    assert_eq!(
        message,
        "environment HULK_PARAMETERS__offsets: `offsets`: expected a sequence, found map"
    );
}

#[test]
fn text_and_tables_are_read_alike() {
    let ball: Ball = from_text("ball.toml", "radius = 1\nmass = 2\n").expect("valid");
    assert_eq!(
        ball,
        Ball {
            radius: 1.0,
            mass: 2.0
        }
    );
    let table: toml::Table = toml::from_str("radius = 1\n").expect("valid TOML");
    let message = from_table::<Ball>(&table)
        .expect_err("`mass` is missing")
        .to_string();
    assert_eq!(message, "parameters: `mass`: is missing: no layer has it");
}

#[test]
fn parts_of_a_variant_come_from_several_variables_or_settings() {
    let (_directory, mut layers) = layers(&[("default.toml", DEFAULT)]);
    let mut kick = |environment: &[(&str, &str)], settings: &[(&str, &str)]| {
        layers.environment = pairs(environment);
        layers.settings = pairs(settings);
        let loaded = layers.load();
        let read = loaded.and_then(|parameters| parameters.deserialize::<Parameters>());
        read.map(|read| read.kick)
            .map_err(|error| error.to_string())
    };
    let turned = |angle, strength| Ok(Kick::Turned { angle, strength });
    let angle = ("HULK_PARAMETERS__kick__Turned__angle", "0.5");
    let strength = ("HULK_PARAMETERS__kick__Turned__strength", "3");
    let straight = ("HULK_PARAMETERS__kick__Straight", "1.0");
    assert_eq!(kick(&[angle, strength], &[]), turned(0.5, 3));
    // Whatever the order in which the system has them: by name.
    for environment in [[straight, angle, strength], [strength, angle, straight]] {
        assert_eq!(kick(&environment, &[]), turned(0.5, 3));
    }
    let settings = [("kick.Turned.strength", "4"), ("kick.Turned.angle", "1.5")];
    assert_eq!(kick(&[], &settings), turned(1.5, 4));
    assert_eq!(kick(&[straight], &settings), turned(1.5, 4));
    // Of two variants the later one is meant.
    let later = [settings[0], settings[1], ("kick", "{ Straight = 2.0 }")];
    assert_eq!(kick(&[], &later), Ok(Kick::Straight(2.0)));
    // A layer of its own has all of the variant.
    let error = kick(&[strength], &settings[1..]).expect_err("half of it is there");
    assert!(
        error.contains("`kick.Turned.strength`: is missing"),
        "{error}"
    );
}
