//! Every type that nodes exchange can be read, written, described and sent: in JSON, and in bytes for readers in any language.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{fs, io};

use framework::reflect::binary::{Layout, decode, encode};
use framework::reflect::{Content, FieldShape, Leaf, Shape, VariantContent, at, at_mut};
use framework::testing::skip;
use framework::{Given, Reflect};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};
use types::audio::{AudioBlock, Tone, Whistle, WhistleEvidence};
use types::ball::{Ball, BallCandidate, BallView, LearntImage};
use types::behavior::{Activity, Plan, Role};
use types::buttons::Buttons;
use types::camera::{CameraCalibration, CameraMatrices, CameraMatrix, CameraPosition, Intrinsics};
use types::fall_state::{Facing, FallDirection, FallState};
use types::feet::{Feet, Side};
use types::field_features::{
    CenterCircle, CornerKind, FieldBorder, ImageLine, LineCorner, LineSegment, PenaltyMark,
};
use types::field_markings::FieldMarkings;
use types::game::{
    CompetitionPhase, CompetitionType, GameControllerMessage, GameControllerPacket,
    GameControllerState, GamePhase, GameState, KickingTeam, Penalty, Player, PlayerState,
    PrimaryState, SetPlay, TeamColor, TeamState, WhoseBall,
};
use types::head::{HeadAngles, HeadCommand, HeadRequest};
use types::image::YuyvImage;
use types::joints::{JointName, Joints};
use types::leds::{ChestColors, Color, Leds};
use types::limbs::{LimbMask, LimbOutline};
use types::motion::{
    BodyMotion, ClientWish, HeadMotion, MotionCommand, MotionRequest, MotionSelection, SafeExits,
    Script, Step,
};
use types::motor_commands::MotorCommands;
use types::network::{Channel, Datagram, Endpoint, PacketCounts};
use types::obstacles::{Obstacle, ObstacleCandidate, ObstacleKind};
use types::odometry::Odometry;
use types::projection_noise::ProjectionNoise;
use types::robot_kinematics::{Hands, RobotKinematics};
use types::sensor_data::{
    Battery, InertialMeasurement, RobotConfiguration, SensorData, Sonar, Touch,
};
use types::sonar::SonarDistances;
use types::team::{TeamBall, TeamMessage, Teammate};
use types::world_state::WorldState;

/// Random values of each type.
const VALUES: usize = 8;

/// Lists have so many elements, at most.
const LONGEST: usize = 3;

/// A type, as what is to be done with it.
struct Kind {
    name: &'static str,
    /// Adds its values to the corpus of the readers.
    check: fn(&'static str, &mut Draw, &mut String),
}

macro_rules! kinds {
    ($($name:ident $(<$argument:ty>)?),* $(,)?) => {
        &[$(Kind { name: stringify!($name), check: check::<$name$(<$argument>)?> }),*]
    };
}

const KINDS: &[Kind] = kinds![
    AudioBlock,
    WhistleEvidence,
    Whistle,
    Tone,
    Activity,
    Plan,
    Role,
    BallCandidate,
    BallView,
    LearntImage,
    Ball,
    Buttons,
    CameraPosition,
    Intrinsics,
    CameraCalibration,
    CameraMatrix,
    CameraMatrices,
    FallState,
    FallDirection,
    Facing,
    Side,
    Feet<f32>,
    FieldBorder,
    ImageLine,
    LineSegment,
    CenterCircle,
    LineCorner,
    CornerKind,
    PenaltyMark,
    FieldMarkings,
    GameControllerMessage,
    GameControllerPacket,
    TeamState,
    PlayerState,
    CompetitionPhase,
    CompetitionType,
    GamePhase,
    GameState,
    SetPlay,
    Penalty,
    TeamColor,
    Player,
    GameControllerState,
    KickingTeam,
    WhoseBall,
    PrimaryState,
    HeadAngles,
    HeadCommand,
    HeadRequest,
    YuyvImage,
    Joints<f32>,
    JointName,
    Leds,
    Color,
    ChestColors,
    LimbMask,
    LimbOutline,
    ProjectionNoise,
    MotionCommand,
    BodyMotion,
    Script,
    Step,
    HeadMotion,
    MotionSelection,
    SafeExits,
    MotionRequest,
    ClientWish,
    MotorCommands,
    Datagram,
    Channel,
    Endpoint,
    PacketCounts,
    ObstacleCandidate,
    Obstacle,
    ObstacleKind,
    Odometry,
    RobotKinematics,
    Hands<f32>,
    SensorData,
    InertialMeasurement,
    Touch,
    Sonar,
    Battery,
    RobotConfiguration,
    SonarDistances,
    TeamMessage,
    TeamBall,
    Teammate,
    WorldState,
];

/// Numbers that are the same in every run.
struct Draw(u64);

impl Draw {
    fn below(&mut self, end: usize) -> usize {
        // Knuth's generator, whose upper bits are good.
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % end
    }

    /// A value of this shape in JSON, that every width of number has exactly.
    fn value(&mut self, shape: &Shape) -> Value {
        match &shape.content {
            Content::Leaf(leaf) => self.leaf(*leaf),
            Content::Option(_) if self.below(3) == 0 => Value::Null,
            Content::Option(inner) => self.value(inner),
            // A rotation or a direction has length one.
            Content::List {
                length: Some(length),
                ..
            } if shape.type_name.contains("::Unit<") => {
                let one = self.below(*length);
                (0..*length)
                    .map(|index| json!(f64::from(u8::from(index == one))))
                    .collect()
            }
            Content::List { item, length, .. } => {
                let length = length.unwrap_or_else(|| self.below(LONGEST + 1));
                (0..length).map(|_| self.value(item)).collect()
            }
            Content::Set(item) => json!([self.value(item)]),
            Content::Map(item) => json!({ "1": self.value(item) }),
            Content::Struct(_) | Content::Tuple(_) => self.fields(&shape.content),
            Content::Enum(variants) => {
                let variant = &variants[self.below(variants.len())];
                let content = match &variant.content {
                    VariantContent::Unit => return json!(variant.name),
                    VariantContent::Value(inner) => self.value(inner),
                    VariantContent::Fields(content) => self.fields(content),
                };
                json!({ variant.name: content })
            }
            Content::Recursive(_) => Value::Null,
        }
    }

    fn fields(&mut self, content: &Content) -> Value {
        match content {
            Content::Struct(fields) => {
                let entries = fields.iter();
                let entries = entries.map(|it| (it.name.to_owned(), self.field(it)));
                Value::Object(entries.collect::<Map<_, _>>())
            }
            Content::Tuple(items) => items.iter().map(|item| self.value(item)).collect(),
            _ => Value::Null,
        }
    }

    /// Drawn again until it lies in the field's range; a value that has none never does.
    fn field(&mut self, field: &FieldShape) -> Value {
        let lies_in_range = |value: &Value| {
            field.range.is_none_or(|range| {
                let number = value
                    .as_f64()
                    .expect("ranges of types are those of numbers");
                range.contains(number)
            })
        };
        let mut values = std::iter::repeat_with(|| self.value(&field.shape));
        let found = values.by_ref().take(100).find(lies_in_range);
        found.expect("numbers from -4 to 4 reach into the range")
    }

    fn leaf(&mut self, leaf: Leaf) -> Value {
        match leaf {
            Leaf::Bool => json!(self.below(2) == 1),
            Leaf::Character => json!("é"),
            Leaf::Duration => json!({ "secs": self.below(9), "nanos": self.below(1_000_000_000) }),
            Leaf::Float { .. } => json!(self.below(64) as f64 / 8.0 - 4.0),
            Leaf::Opaque | Leaf::Unit => Value::Null,
            Leaf::Signed { .. } => json!(self.below(200) as i64 - 100),
            Leaf::Text => json!(["", "é𝄞", "two words"][self.below(3)]),
            Leaf::Unsigned { .. } => json!(self.below(200)),
        }
    }
}

fn json_of(value: &dyn Reflect) -> Value {
    serde_json::to_value(value.as_serialize()).expect("it has a serde form")
}

fn check<T: Reflect + DeserializeOwned>(name: &'static str, draw: &mut Draw, corpus: &mut String) {
    let shape = T::shape();
    assert!(!shape.is_opaque(), "{name} tells nothing of itself");
    let schema = shape.json_schema();
    let layout = serde_json::to_value(shape.layout()).expect("it is plain");
    let layout: Layout = serde_json::from_value(layout).expect("it is its own");
    let mut made = 0;
    for _ in 0..20 * VALUES {
        // What a type refuses (a quaternion without a direction) is drawn again.
        let Ok(mut value) = serde_json::from_value::<T>(draw.value(&shape)) else {
            continue;
        };
        let whole = json_of(&value);
        let mut bytes = Vec::new();
        encode(&value, &mut bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(decode(&layout, &bytes), Ok(whole.clone()), "{name}");
        write_every_part(name, &mut value, &whole);
        assert_eq!(json_of(&value), whole, "{name}");
        let mut text = String::new();
        for byte in &bytes {
            write!(text, "{byte:02x}").expect("texts take everything");
        }
        let line = json!({ "layout": layout, "bytes": text, "value": whole, "schema": schema });
        writeln!(corpus, "{line}").expect("texts take everything");
        made += 1;
        if made == VALUES {
            return;
        }
    }
    assert!(made > 0, "no value of {name} could be made");
}

/// Reads every part, tells its place in the shape, and writes it again where it may be written.
fn write_every_part(name: &str, value: &mut dyn Reflect, whole: &Value) {
    let mut paths: Vec<(String, &Value)> = vec![(String::new(), whole)];
    while let Some((path, expected)) = paths.pop() {
        if !path.is_empty() {
            let parsed = path
                .parse()
                .unwrap_or_else(|error| panic!("{name}.{path}: {error}"));
            // What a type writes in a form of its own has no parts.
            let Ok(part) = at(value, &parsed) else {
                continue;
            };
            assert_eq!(json_of(part), *expected, "{name}.{path}");
            if let Ok(part) = at_mut(value, &parsed) {
                let written = part.deserialize_from(&Given::from(expected));
                written.unwrap_or_else(|error| panic!("{name}.{path}: {error}"));
            }
        }
        let below = |name: &str| match path.as_str() {
            "" => name.to_owned(),
            path => format!("{path}.{name}"),
        };
        match expected {
            Value::Object(entries) => {
                paths.extend(entries.iter().map(|(name, value)| (below(name), value)));
            }
            Value::Array(items) => {
                let items = items.iter().enumerate();
                paths.extend(items.map(|(index, value)| (below(&index.to_string()), value)));
            }
            _ => {}
        }
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Names of all types below a folder that derive `Reflect`, as their source says.
fn reflected(folder: &Path, names: &mut Vec<String>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            reflected(&path, names)?;
            continue;
        }
        let text = fs::read_to_string(&path)?;
        let mut is_reflected = false;
        for line in text.lines() {
            is_reflected |= line.contains("Reflect") && !line.starts_with("use ");
            let name = ["pub struct ", "pub enum "]
                .iter()
                .find_map(|kind| line.strip_prefix(kind));
            if let Some(name) = name {
                let end = name.find(|character: char| !character.is_alphanumeric());
                if std::mem::take(&mut is_reflected) {
                    names.push(name[..end.unwrap_or(name.len())].to_owned());
                }
            }
        }
    }
    Ok(())
}

#[test]
fn no_type_is_forgotten() {
    let mut names = Vec::new();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    reflected(&folder, &mut names).expect("the sources are there");
    let mut known: Vec<_> = KINDS.iter().map(|kind| kind.name).collect();
    names.sort();
    known.sort_unstable();
    assert_eq!(names, known);
}

#[test]
fn every_type_is_read_written_and_sent() {
    let mut corpus = String::new();
    let mut draw = Draw(1);
    for kind in KINDS {
        (kind.check)(kind.name, &mut draw, &mut corpus);
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("corpus");
    fs::write(&file, &corpus).expect("the folder is ours");
    let all = corpus.lines().count();
    let read = |command: &mut Command| {
        let output = command
            .arg(&file)
            .output()
            .expect("it was there a moment ago");
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(
            output.status.success(),
            "{said}{}",
            String::from_utf8_lossy(&output.stderr)
        );
        assert_eq!(said.trim(), format!("{all} read"));
    };
    let test = "every_type_is_read_written_and_sent";
    let mut python = Command::new("python3");
    let imports = ["-c", "import jsonschema, websockets.sync.client"];
    let has = python.args(imports).stderr(Stdio::null()).status();
    if has.is_ok_and(|status| status.success()) {
        read(Command::new("python3").arg(root().join("docs/clients/test_hulk.py")));
        let validate = "import json, sys, jsonschema\n\
            lines = [json.loads(line) for line in open(sys.argv[1])]\n\
            [jsonschema.Draft7Validator(line['schema']).validate(line['value']) for line in lines]\n\
            print(len(lines), 'read')";
        read(Command::new("python3").args(["-c", validate]));
    } else {
        skip(test, "python3 -m pip install jsonschema websockets");
    }
    if root().join("web/page/node_modules/rolldown").is_dir() {
        read(Command::new("node").arg(root().join("web/page/test/decode.mjs")));
    } else {
        skip(test, "node 20 and `npm ci` in web/page");
    }
}
