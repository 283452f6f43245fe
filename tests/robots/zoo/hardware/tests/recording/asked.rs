//! What else a recording can be asked: other parameters, one node, another machine, another graph, another build.

use std::io::Cursor;

use framework::recorded::Settings;
use framework::replay::{
    Comparison, How, Needed, OtherParameters, Played, Players, Shelf, Source, answer, compare,
    verify_how, with_settings,
};
use hulkgen_recording::Recording as File;
use zoo_runtime::parameters::Parameters;
use zoo_runtime::recording;

use super::{Tape, as_it_is, on, record_in_lockstep};

pub(crate) const GRAPH: &str = include_str!("../../../generated/graph.json");

pub(crate) fn recorded() -> Tape {
    let tape = Tape::new();
    record_in_lockstep(&tape.path, Settings::default(), on, &as_it_is);
    tape
}

fn setting(text: &str) -> Vec<(String, String)> {
    let (path, value) = text.split_once('=').expect("a path and a value");
    vec![(path.to_owned(), value.to_owned())]
}

fn under(file: &File, text: &str, node: Option<&str>) -> framework::Result<Comparison> {
    let shelf = Shelf::of(file)?;
    let settings = setting(text);
    let other = OtherParameters::new(&shelf, &mut |recorded| {
        with_settings::<Parameters>(recorded, &settings)
    })?;
    let needed = node.map(|name| Needed::new(name, GRAPH)).transpose()?;
    let players = || {
        let players = Players::new(&shelf, recording::INSTANCES).expect("it fits");
        match &needed {
            Some(needed) => players.only(needed),
            None => players,
        }
    };
    let mut after = players().under(&other);
    compare(&mut players(), &mut after, needed.as_ref())
}

#[test]
fn other_parameters_say_which_outputs_change_and_where_first() {
    let tape = recorded();
    let comparison = under(&tape.read(), "walking_speed=0.9", None).expect("it is a parameter");
    let changed: Vec<_> = comparison
        .changes
        .iter()
        .map(|change| (&*change.instance, &*change.node, &*change.output))
        .collect();
    assert_eq!(
        changed,
        [("Control", "zoo_nodes::control::gait", "plan")],
        "{comparison}"
    );
    let change = &comparison.changes[0];
    // Until there is a target.
    assert_eq!((change.cycle, change.cycles), (1, 5), "{comparison}");
    // The first of the angles is always 0.
    assert_eq!(change.path, "1", "{comparison}");
    assert_ne!(change.before, change.after);
    let control = &comparison.instances[3];
    assert_eq!(control.changed, change.cycles);
    assert!(control.cycles > 150 && control.outputs > control.cycles);
    let unchanged = under(&tape.read(), "vec.numbers=[1, 2, 40]", None).expect("it is a parameter");
    let outputs: Vec<_> = unchanged.changes.iter().map(|one| &*one.output).collect();
    assert_eq!(outputs, ["sum"], "{unchanged}");
}

#[test]
fn what_is_no_parameter_is_refused_with_what_would_be_right() {
    let tape = recorded();
    for (text, message) in [
        ("walking_sped=0.9", "walking_speed"),
        ("walking_speed=fast", "walking_speed"),
    ] {
        let error = under(&tape.read(), text, None).expect_err("it is none");
        assert!(error.to_string().contains(message), "{error}");
    }
}

#[test]
fn one_node_alone_runs_what_comes_before_it_and_no_more() {
    let tape = recorded();
    let file = tape.read();
    let how = How {
        needed: Some(Needed::new("spot_filter", GRAPH).expect("it is a node")),
        ..How::default()
    };
    let shelf = Shelf::of(&file).expect("it is of this version");
    let verification = verify_how(&shelf, recording::INSTANCES, &how).expect("it is of this robot");
    assert!(verification.is_good(), "{verification}");
    let nodes = [
        "zoo_nodes::control::pose_filter",
        "zoo_nodes::control::spot_filter",
    ];
    let nodes = nodes.map(str::to_owned).to_vec();
    assert_eq!(
        verification.recomputed,
        [("Control".to_owned(), nodes)],
        "{verification}"
    );
    let [control] = verification.instances.as_slice() else {
        panic!("{verification}");
    };
    // It writes two.
    assert_eq!(control.outputs, 2 * control.verified, "{verification}");
    // What comes behind it did not run.
    let shelf = Shelf::of(&file).expect("it is of this version");
    let players = Players::new(&shelf, recording::INSTANCES).expect("it fits");
    let mut players = players.only(how.needed.as_ref().expect("it was asked for"));
    players.play("Control", 60).expect("it is here");
    let (player, _) = players.of("Control").expect("it is an instance");
    let replay = player.replay().expect("it was loaded");
    let calls = replay.instance().report().nodes.into_iter();
    let ran: Vec<_> = calls
        .filter(|node| node.calls > 0)
        .map(|node| node.node)
        .collect();
    // The call of the one that follows ended before the node itself.
    let names = ["watcher", "pose_filter", "spot_filter"];
    assert_eq!(ran, names.map(|name| format!("zoo_nodes::control::{name}")));
    let comparison = under(&file, "walking_speed=0.9", Some("watcher")).expect("it is a node");
    assert_eq!(comparison.changes, [], "{comparison}");
    let comparison = under(&file, "walking_speed=0.9", Some("gait")).expect("it is a node");
    assert_eq!(comparison.changes.len(), 1, "{comparison}");
}

#[test]
fn another_build_is_asked_line_by_line() {
    let tape = recorded();
    let file = tape.read();
    let shelf = Shelf::of(&file).expect("it is of this version");
    let mut players = Players::new(&shelf, recording::INSTANCES).expect("it fits");
    let questions = concat!(
        r#"{"play":{"instance":"Control","position":60}}"#,
        "\n",
        r#"{"value":{"instance":"Control","output":"cycles"}}"#,
        "\n",
        r#"{"play":{"instance":"Nobody","position":0}}"#,
        "\n",
        r#"{"play":{"instance":"Control","position":100000}}"#,
        "\n",
    );
    let mut answers = Vec::new();
    answer(&mut players, Cursor::new(questions), &mut answers).expect("they are questions");
    let answers = String::from_utf8(answers).expect("text");
    let [played, value, nobody, beyond] = answers.lines().collect::<Vec<_>>()[..] else {
        panic!("{answers}");
    };
    let played: Played = serde_json::from_str(played).expect("an answer");
    let Played::Outputs(outputs) = played else {
        panic!("{played:?}");
    };
    assert_eq!(outputs.len(), 7, "{outputs:?}");
    assert!(
        value.parse::<u64>().is_ok_and(|cycles| cycles > 100),
        "{value}"
    );
    for unfit in [nobody, beyond] {
        assert!(unfit.starts_with(r#"{"unfit":"#), "{unfit}");
    }
    let nonsense = answer(&mut players, Cursor::new("play\n"), &mut Vec::new());
    assert!(nonsense.is_err());
}

#[test]
fn a_recording_of_another_graph_is_replayed_as_far_as_it_fits() {
    let tape = recorded();
    let file = tape.read();
    // A robot without Hearing, in whose place there is one that the recording does not have.
    let mut other = recording::INSTANCES.to_vec();
    let hearing = other.iter().position(|one| one.instance == "Hearing");
    other[hearing.expect("it is an instance")].instance = "Seeing";
    // What Reflexes expects in a frame is not what Lights wrote into it.
    let create = |name: &str| {
        let found = recording::INSTANCES.iter().find(|one| one.instance == name);
        found.expect("it is an instance").create
    };
    let lights = other.iter().position(|one| one.instance == "Lights");
    other[lights.expect("it is an instance")].create = create("Reflexes");
    let shelf = Shelf::of(&file).expect("it is of this version");
    let verification = verify_how(&shelf, &other, &How::default()).expect("it is a recording");
    assert_eq!(verification.unknown, ["Hearing"]);
    assert!(!verification.is_good());
    for one in &verification.instances {
        let fits = !["Seeing", "Lights"].contains(&&*one.instance);
        assert_eq!(one.unreadable.is_none(), fits, "{verification}");
        assert_eq!(one.verified > 0, fits, "{verification}");
    }
    assert_eq!(verification.divergence, None, "{verification}");
}
