//! What a node took in one cycle, whatever kinds of fields it has.

use framework::recorded::Loading;
use framework::replay::{Call, Needed, Players, Shelf, snapshot};
use hulkgen_recording::Recording as File;
use serde_json::{Value, json};
use zoo_runtime::parameters::Parameters;
use zoo_runtime::recording;

use super::asked::{GRAPH, recorded};

fn taken(file: &File, node: &str, cycle: u64) -> framework::Result<Value> {
    let shelf = Shelf::of(file)?;
    let mut players = Players::new(&shelf, recording::INSTANCES)?;
    let call = Call {
        instance: "Control",
        cycle,
        needed: &Needed::new(node, GRAPH)?,
    };
    snapshot(&mut players, call, &|recorded| {
        let parameters: Parameters = Loading::new(recorded).take()?;
        Ok(serde_json::to_value(parameters)?)
    })
}

/// The first cycle whose snapshot is so.
fn first(file: &File, node: &str, is_so: impl Fn(&Value) -> bool) -> Value {
    let all = (1..150).filter_map(|cycle| taken(file, node, cycle).ok());
    let mut fitting = all.filter(is_so);
    fitting.next().expect("the run has such a cycle")
}

#[test]
fn a_call_is_there_with_its_answer() {
    let tape = recorded();
    let file = tape.read();
    let asked = first(&file, "gait", |one| one["calls"]["walk"].is_object());
    assert_eq!(asked["calls"], json!({ "walk": { "speed": 0.25 } }));
    assert_eq!(asked["answers"]["walk"]["value"], json!({ "Ok": 0.25 }));
    assert_eq!(asked["state_after"]["value"]["speed"], 0.25);
    // Nobody asked in the cycle after it.
    let next = asked["cycle"].as_u64().expect("a number") + 1;
    let next = taken(&file, "gait", next).expect("it is recorded");
    assert_eq!((&next["calls"], &next["answers"]), (&json!({}), &json!({})));
    assert_eq!(next["state"], asked["state_after"]["value"]);
}

#[test]
fn the_past_is_there_without_this_cycle() {
    let tape = recorded();
    let file = tape.read();
    let taken = taken(&file, "spot_filter", 100).expect("it is recorded");
    let past = taken["histories"]["pose"].as_array().expect("a list");
    // All since the start, which the two seconds of `history` reach back to.
    assert_eq!(past.len(), 99);
    let times = past.iter().map(|entry| entry["timestamp_ns"].as_u64());
    assert!(times.clone().is_sorted());
    assert!(times.max().flatten() < taken["start_ns"].as_u64());
    assert!(past[98]["value"]["heading"].is_number(), "{}", past[98]);
}

#[test]
fn commands_are_there_and_no_others() {
    let tape = recorded();
    let file = tape.read();
    let told = |one: &Value| {
        one["commands"]
            .as_array()
            .is_some_and(|all| !all.is_empty())
    };
    let moved = first(&file, "legs", told);
    let [command] = moved["commands"].as_array().expect("a list").as_slice() else {
        panic!("{}", moved["commands"]);
    };
    assert_eq!(command["command"], "LegInterface::write_angles");
    assert_eq!(command["arguments"][0]["value"], moved["own"]["plan"]);
    // What the legs were told is not what the node behind them says.
    let counter = moved["cycle"].as_u64().expect("a number");
    let counter = taken(&file, "counter", counter).expect("it is recorded");
    assert_eq!(counter["commands"], json!([]));
}
