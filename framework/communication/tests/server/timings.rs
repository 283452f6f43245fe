//! What instances tell of themselves, to whoever asks and however many ask.

use std::collections::BTreeSet;
use std::thread;
use std::time::Duration;

use framework::launch::{Listening, Served as _};
use framework::parameters::Layers;
use framework::testing::created;
use framework::{Clock, Lockstep, Rearm, Stop};
use hulkgen_communication::{Limits, Server};
use serde_json::{Value, json};
use zoo_hardware::Hardware;
use zoo_runtime::parameters::Parameters;
use zoo_runtime::runtime;

use crate::zoo::{Client, Zoo, copy_of_parameters};

fn instances(ok: &Value) -> &[Value] {
    let instances = ok["timings"]["instances"].as_array();
    instances.unwrap_or_else(|| panic!("no timings: {ok}"))
}

fn control(ok: &Value) -> &Value {
    let control = instances(ok).iter().find(|one| one["name"] == "Control");
    control.expect("it is an instance")
}

fn has_nodes(instance: &Value) -> bool {
    !instance["nodes"].as_array().expect("a list").is_empty()
}

#[test]
fn they_tell_what_nodes_did() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    client.ok(json!({ "read": { "path": "Control.main_outputs.cycles" } }));
    let timings = client.ok(json!({ "timings": {} }));
    let control = control(&timings);
    assert!(control["cycles"].as_u64() > Some(0));
    let nodes = control["nodes"].as_array().expect("a list");
    assert!(
        nodes
            .iter()
            .any(|node| node["node"] == "zoo_nodes::control::gait")
    );
    assert_eq!(control["deadline"], json!(12_000.0));
}

#[test]
fn who_asks_takes_nothing_from_who_waits() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    // Slower instances have not answered one when the next one comes.
    let asked: Vec<u32> = (0..40)
        .map(|_| {
            thread::sleep(Duration::from_millis(2));
            client.ask_later(&json!({ "timings": {} }))
        })
        .collect();
    let mut calls = 0;
    for id in asked {
        let answer = client.answer(Some(id));
        let control = control(&answer["ok"]);
        assert!(has_nodes(control), "{control}");
        let counted = control["nodes"][0]["calls"].as_u64().expect("a number");
        assert!(counted >= calls, "they tell nothing older than before");
        calls = counted;
    }
}

#[test]
fn who_does_nothing_more_is_told_as_before() {
    let folder = copy_of_parameters();
    let layers = Layers {
        directory: folder.path().to_owned(),
        ..Layers::default()
    };
    let (clock, stop) = (Clock::stepped(), Stop::default());
    let (hardware, mut robot) =
        created::<Hardware, Parameters>(&layers, "loud", &[], &clock, &stop, runtime::create);
    let listening = Listening {
        target: "loud",
        address: Some("127.0.0.1:0".to_owned()),
        ..Listening::default()
    };
    let link = robot.link(&stop, Rearm::default());
    let server = Server::start(link, listening, Limits::default()).expect("a free port");
    let mut client = Client::connect(server.address()).expect("the server lets it in");
    let mut lockstep = Lockstep::new(&mut robot, &*hardware);

    // Somebody asks before each step, so that each instance tells of its last cycle.
    let mut ran = BTreeSet::new();
    for _ in 0..40 {
        client.ask_later(&json!({ "timings": {} }));
        client.ok(json!({ "paths": { "below": "", "depth": 0 } }));
        let stepped = lockstep.step().expect("the zoo does not stop");
        ran.extend(stepped.map(|stepped| stepped.instance));
    }
    assert!(
        ran.contains("VisionTop") && ran.contains("Control"),
        "{ran:?}"
    );
    let told = client.ok(json!({ "timings": {} }));
    for instance in instances(&told) {
        let has_run = instance["name"]
            .as_str()
            .is_some_and(|name| ran.contains(name));
        assert_eq!(has_nodes(instance), has_run, "{instance}");
    }
}
