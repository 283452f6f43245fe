//! Numbers, where they stand.

use super::robot;

#[test]
fn numbers_lie_within_the_range_of_their_field() {
    let types = "
        #[derive(Deserialize, Reflect, Serialize)]
        pub struct Filter {
            #[reflect(range = 0.0..=1.0)]
            pub gain: f32,
            #[reflect(range = 0..10)]
            pub axes: Axes,
            #[reflect(range = 0..10)]
            pub wait: std::time::Duration,
            pub steps: Vec<Step>,
        }
        #[derive(Deserialize, Reflect, Serialize)]
        pub struct Axes { pub x: f32, #[reflect(range = ..=20.5)] pub y: Option<f32> }
        #[derive(Deserialize, Reflect, Serialize)]
        pub enum Step { One(Axes), #[allow(unused)] Two { #[reflect(range = 1..)] count: u8 } }
    ";
    let robot = |gain: &str, axes: &str, steps: &str| {
        robot("a: Parameter<types::filter::Filter, \"filter\">,", "")
            .file("crates/types/src/lib.rs", "pub mod filter;")
            .file("crates/types/src/filter.rs", types)
            .file(
                "parameters/default.toml",
                &format!(
                    "[filter]\ngain = {gain}\naxes = {axes}\nwait = {{ secs = 3, nanos = 500 }}\nsteps = [{steps}]\n"
                ),
            )
    };
    robot(
        "1",
        "{ x = 9.9, y = 20.5 }",
        "{ Two = { count = 1 } }, { One = { x = 100 } }",
    )
    .robot();
    for (gain, axes, steps, message) in [
        (
            "1.01",
            "{ x = 1 }",
            "",
            "`filter.gain` is 1.01, not within 0..=1",
        ),
        (
            "-1",
            "{ x = 1 }",
            "",
            "`filter.gain` is -1, not within 0..=1",
        ),
        (
            "1",
            "{ x = 10 }",
            "",
            "`filter.axes.x` is 10, not within 0..10",
        ),
        (
            "1",
            "{ x = 1, y = 20.6 }",
            "",
            "`filter.axes.y` is 20.6, not within ..=20.5",
        ),
        (
            "1",
            "{ x = 1 }",
            "{ Two = { count = 0 } }",
            "`filter.steps` is 0, not within 1..",
        ),
    ] {
        robot(gain, axes, steps).expect("mistyped-parameter", &[message]);
    }
}

#[test]
fn what_stands_in_the_file_is_judged_where_a_type_is_made_of_another() {
    let types = "
        #[derive(Deserialize)]
        #[serde(try_from = \"Unchecked\")]
        pub struct Motion { frames: Vec<Frame> }
        #[derive(Deserialize)]
        struct Unchecked { frames: Vec<Frame> }
        #[derive(Deserialize)]
        pub struct Frame { #[reflect(range = 0.0..=5.0)] pub duration: f32, pub leg: Leg }
        #[derive(Deserialize)]
        pub struct Leg {
            #[reflect(range = -1.0..=0.5)]
            pub hip: f32,
            #[serde(default)]
            #[reflect(range = 0.0..)]
            pub knee: f32,
        }
        #[derive(Deserialize)]
        #[serde(from = \"Degrees\")]
        pub enum Angle { Some(f32) }
        pub type Degrees = f64;
        #[derive(Deserialize)]
        #[serde(from = \"Round\")]
        pub struct Round { pub value: f32 }
        #[derive(Deserialize)]
        pub struct Pair { pub one: f32, pub other: Option<f32> }
    ";
    let robot = |frame: &str, angle: &str, pair: &str| {
        let fields = "a: Parameter<motion::Motion, \"motion\">, b: Parameter<motion::Angle, \"angle\">, c: Parameter<motion::Round, \"round\">, d: Parameter<motion::Pair, \"pair\">,";
        let file =
            format!("angle = {angle}\nround = 1\npair = {pair}\n[[motion.frames]]\n{frame}\n");
        robot(fields, "")
            .file("crates/types/src/lib.rs", "pub mod motion;")
            .file("crates/types/src/motion.rs", types)
            .file("parameters/default.toml", &file)
    };
    for leg in ["[-1.0, 0.0]", "[0.5]", "{ hip = 0.1 }"] {
        robot(
            &format!("duration = 5.0\nleg = {leg}"),
            "90.0",
            "{ one = 1 }",
        )
        .robot();
    }
    for (duration, leg, angle, message) in [
        ("6", "[0, 0]", "1", "`motion.frames` is 6, not within 0..=5"),
        (
            "\"6\"",
            "[0, 0]",
            "1",
            "`motion.frames` is a string, not a number",
        ),
        (
            "1",
            "[0.6, 0]",
            "1",
            "`motion.frames` is 0.6, not within -1..=0.5",
        ),
        ("1", "[0, -1]", "1", "`motion.frames` is -1, not within 0.."),
        ("1", "[]", "1", "`motion.frames` has 0 elements, not 2"),
        (
            "1",
            "[0, 0, 0]",
            "1",
            "`motion.frames` has 3 elements, not 2",
        ),
        (
            "1",
            "{ knee = 1 }",
            "1",
            "`motion.frames` has a table without `hip`",
        ),
        (
            "1",
            "[0, 0]",
            "{ Some = 1.0 }",
            "`angle` is a table, not a number",
        ),
    ] {
        let frame = format!("duration = {duration}\nleg = {leg}");
        robot(&frame, angle, "[1, 2]").expect("mistyped-parameter", &[message]);
    }
    // serde takes an array that ends early for one whose last fields have defaults, which an `Option` has not.
    robot("duration = 1\nleg = [0, 0]", "1", "[1]")
        .expect("mistyped-parameter", &["`pair` has 1 element, not 2"]);
}
