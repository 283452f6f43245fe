//! What a file looks like after lists were stored into it.

use serde_json::{Value, json};

use super::{DEFAULT, Robot};

/// Stores poses into a file that ends with `text`, and gives what it ends with then.
fn stored(text: &str, poses: Value) -> String {
    let before = format!("{DEFAULT}{text}");
    let robot = Robot::new(&[("default.toml", &before)]);
    let changes = [("extra.poses", poses.clone())];
    robot.live.change(&changes).expect("they are valid");
    robot
        .live
        .store("default", &["extra.poses"])
        .expect("valid");
    let after = robot.text("default.toml");
    let after_restart = serde_json::to_value(robot.after_restart().extra.poses);
    assert_eq!(
        after_restart.expect("it has a form"),
        robot.value("extra.poses"),
        "{after}"
    );
    match after.strip_prefix(DEFAULT) {
        Some(end) => end.to_owned(),
        None => panic!("the beginning is another:\n{after}"),
    }
}

fn pose(x: f32) -> Value {
    json!({ "x": x })
}

const LINES: &str = "\
poses = [  # m, by number
    # first
    { x = 1.0, y = 2.5 }, # one
    {x=2.0},   # two
    # third
    {x=3.0},   # three
    # end
] # behind
";

#[test]
fn lines_of_a_list_keep_their_comments() {
    let same = json!([{ "x": 1.0, "y": 2.5 }, pose(2.0), pose(3.0)]);
    assert_eq!(stored(LINES, same), LINES);
    let others = json!([{ "x": 1.5, "y": 2.5 }, { "x": 2.5, "y": 1.0 }, pose(3.0)]);
    let expected = LINES
        .replace("x = 1.0", "x = 1.5")
        .replace("{x=2.0}", "{x=2.5, y = 1.0 }");
    assert_eq!(stored(LINES, others).replace("1.0}", "1.0 }"), expected);
    let without_y = json!([pose(1.0), pose(2.0), pose(3.0)]);
    assert_eq!(stored(LINES, without_y), LINES.replace(", y = 2.5", ""));
}

#[test]
fn surplus_lines_go_and_new_ones_are_like_the_last() {
    let fewer = json!([{ "x": 1.0, "y": 2.5 }, pose(2.0)]);
    let expected = LINES.replace("    # third\n    {x=3.0},   # three\n", "");
    assert_eq!(stored(LINES, fewer), expected);
    let more = json!([{ "x": 1.0, "y": 2.5 }, pose(2.0), pose(3.0), pose(4.0)]);
    let expected = LINES.replace("# three\n", "# three\n    {x=4.0},\n");
    assert_eq!(stored(LINES, more), expected);
    let expected = "poses = [  # m, by number\n    # end\n] # behind\n";
    assert_eq!(stored(LINES, json!([])), expected);
    let expected = "poses = [  # m, by number\n    { x = 5.0 },\n    # end\n] # behind\n";
    let empty = "poses = [  # m, by number\n    # end\n] # behind\n";
    assert_eq!(stored(empty, json!([pose(5.0)])), expected);
}

#[test]
fn a_list_without_a_last_comma_keeps_its_lines() {
    let text = "poses = [\n  {x = 1.0}, # one\n  {x = 2.0} # two\n]\n";
    let expected = "poses = [\n  {x = 1.5} # one\n]\n";
    assert_eq!(stored(text, json!([pose(1.5)])), expected);
    let expected = "poses = [\n  {x = 1.0}, # one\n  {x = 2.0}, # two\n  {x = 3.0}\n]\n";
    assert_eq!(
        stored(text, json!([pose(1.0), pose(2.0), pose(3.0)])),
        expected
    );
    let text = "poses = [ {x = 1.0} ] # one\n";
    let expected = "poses = [ {x = 1.0}, {x = 2.0} ] # one\n";
    assert_eq!(stored(text, json!([pose(1.0), pose(2.0)])), expected);
}

#[test]
fn the_bracket_never_gets_into_a_comment() {
    let text = "poses = [{x = 1.0}, # one\n  {x = 2.0}]\n";
    let expected = "poses = [{x = 1.5} # one\n]\n";
    assert_eq!(stored(text, json!([pose(1.5)])), expected);
    let grown = "poses = [{x = 1.5}, # one\n    {x = 2.5}\n]\n";
    assert_eq!(stored(expected, json!([pose(1.5), pose(2.5)])), grown);
    let text = "poses = [{x = 1.0}, # one\n  {x = 2.0},]\n";
    let expected = "poses = [{x = 1.0}, # one\n]\n";
    assert_eq!(stored(text, json!([pose(1.0)])), expected);
    let text = "poses = [ # note\n {x = 1.0} ]\n";
    let expected = "poses = [ # note\n]\n";
    assert_eq!(stored(text, json!([])), expected);
    let grown = "poses = [ # note\n    { x = 1.5 },\n]\n";
    assert_eq!(stored(expected, json!([pose(1.5)])), grown);
    // Without a comment it stays in the line.
    let text = "poses = [\n  {x = 1.0},\n  {x = 2.0} ]\n";
    let expected = "poses = [\n  {x = 1.0} ]\n";
    assert_eq!(stored(text, json!([pose(1.0)])), expected);
}

/// As many poses, in every layout.
fn in_every_layout(length: u8) -> Vec<String> {
    let mut texts = Vec::new();
    for head in ["", "\n  ", " # head\n  "] {
        for between in [
            ", ",
            ", # behind\n  ",
            " # inside\n  , ",
            ",\n  # before\n  ",
        ] {
            let items: Vec<String> = (1..=length).map(|x| format!("{{x = {x}.0}}")).collect();
            let items = items.join(between);
            for comma in ["", ","] {
                let comma = if length == 0 { "" } else { comma };
                for end in [" ", "\n", " # end\n"] {
                    texts.push(format!("poses = [{head}{items}{comma}{end}]\n"));
                }
            }
        }
    }
    texts.sort();
    texts.dedup();
    texts
}

#[test]
fn every_layout_survives_every_length() {
    let poses = |length: u8| -> Vec<Value> { (1..=length).map(|x| pose(f32::from(x))).collect() };
    for old in 0..=3 {
        for text in in_every_layout(old) {
            for new in 0..=3 {
                let after = stored(&text, json!(poses(new)));
                let back = stored(&after, json!(poses(old)));
                // What stands in front of all of them belongs to none.
                let has_head = text.contains("# head");
                assert_eq!(back.contains("# head"), has_head, "{text}{after}{back}");
            }
        }
    }
}

const TABLES: &str = "
# before all

# the first
[[extra.poses]] # one
# inside
x = 1.0 # m
y = 2.5

# between

[[extra.poses]]
x = 2.0 # two
# free

# the end
";

#[test]
fn tables_of_a_list_stay_tables() {
    let others = json!([{ "x": 1.5, "y": 2.5 }, pose(2.5)]);
    let expected = TABLES.replace("1.0", "1.5").replace("2.0", "2.5");
    assert_eq!(stored(TABLES, others), expected);
    let more = json!([{ "x": 1.0, "y": 2.5 }, pose(2.0), { "x": 3.0, "y": 1.0 }]);
    let new = "\n[[extra.poses]]\nx = 3.0\ny = 1.0\n# free";
    assert_eq!(stored(TABLES, more), TABLES.replace("# free", new));
    let fewer = json!([{ "x": 1.0, "y": 2.5 }]);
    let expected = TABLES.replace("\n# between\n\n[[extra.poses]]\nx = 2.0 # two\n", "");
    assert_eq!(stored(TABLES, fewer), expected);
}

#[test]
fn without_tables_the_list_is_a_value() {
    let text = format!("{DEFAULT}{TABLES}");
    let robot = Robot::new(&[("default.toml", &text)]);
    let changes = [("extra.poses", json!([]))];
    robot.live.change(&changes).expect("it is valid");
    robot
        .live
        .store("default", &["extra.poses"])
        .expect("valid");
    let after = robot.text("default.toml");
    assert!(after.contains("limit = 2.0\nposes = []\n"), "{after}");
}

#[test]
fn line_ends_stay() {
    let before = format!("{DEFAULT}{LINES}").replace('\n', "\r\n");
    let robot = Robot::new(&[("default.toml", &before)]);
    robot
        .live
        .change(&[("lamp.radius", json!(0.5)), ("extra.poses.1.x", json!(2.5))])
        .expect("valid");
    robot.live.store::<&str>("default", &[]).expect("valid");
    let expected = before.replace("= 0.25", "= 0.5").replace("x=2.0", "x=2.5");
    assert_eq!(robot.text("default.toml"), expected);
    robot
        .live
        .change(&[("extra.poses", json!([pose(1.0)]))])
        .expect("valid");
    robot.live.store::<&str>("default", &[]).expect("valid");
    let text = robot.text("default.toml");
    assert_eq!(text.matches("\r\n").count(), text.matches('\n').count());
    assert!(!text.contains("\r\r"), "{text:?}");
    for text in ["two\nlines", "two\r\nlines"] {
        let changes = [("name", json!(text))];
        robot.live.change(&changes).expect("it is a text");
        robot.live.store::<&str>("default", &[]).expect("valid");
        let restarted = robot.after_restart().name;
        assert_eq!(restarted.as_deref(), Some(text));
    }
    let before = format!("\u{feff}{DEFAULT}");
    let robot = Robot::new(&[("default.toml", &before)]);
    robot.live.change(&[("steps", json!(8))]).expect("valid");
    robot.live.store::<&str>("default", &[]).expect("valid");
    let expected = before.replace("steps = 5", "steps = 8");
    assert_eq!(robot.text("default.toml"), expected);
}

#[test]
fn numbers_that_stay_are_written_as_they_were() {
    let text = "poses = [{ x = 1, y = 2e1 }, { x = 3, y = 1_0.0 }]\n";
    let same = json!([{ "x": 1.0, "y": 20.0 }, { "x": 2.5, "y": 10.0 }]);
    assert_eq!(stored(text, same), text.replace("x = 3", "x = 2.5"));
}

#[test]
fn an_enum_stays_the_table_that_it_was() {
    let text = DEFAULT.replace("motion = \"Stand\"\n", "");
    let text = format!("{text}\n# how it moves\n[motion.Walk] # slowly\nspeed = 0.25 # m/s\n");
    let robot = Robot::new(&[("default.toml", &text)]);
    let changes = [("motion.Walk.speed", json!(0.5))];
    robot.live.change(&changes).expect("valid");
    robot.live.store::<&str>("default", &[]).expect("valid");
    let expected = text.replace("speed = 0.25", "speed = 0.5");
    assert_eq!(robot.text("default.toml"), expected);
    let changes = [("motion", json!({ "Turn": { "angle": 0.5 } }))];
    robot.live.change(&changes).expect("valid");
    robot.live.store::<&str>("default", &[]).expect("valid");
    assert_eq!(
        serde_json::to_value(robot.after_restart().motion).expect("it has a form"),
        json!({ "Turn": { "angle": 0.5 } }),
        "{}",
        robot.text("default.toml")
    );
    robot
        .live
        .change(&[("motion", json!("Stand"))])
        .expect("valid");
    robot.live.store::<&str>("default", &[]).expect("valid");
    let after = robot.text("default.toml");
    assert!(after.contains("\nmotion = \"Stand\"\n"), "{after}");
}
