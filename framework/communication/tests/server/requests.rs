//! Everything that is asked once.

use framework::launch::Listening;
use hulkgen_communication::Limits;
use serde_json::{Value, json};

use crate::zoo::{Client, Zoo, eventually};

const CYCLES: &str = "Control.main_outputs.cycles";
/// Where its counter starts.
const COUNTS_FROM: u64 = 100;

fn paths(client: &mut Client, below: &str, depth: u32) -> Vec<Value> {
    let ok = client.ok(json!({ "paths": { "below": below, "depth": depth } }));
    ok["paths"].as_array().expect("a list").clone()
}

fn names(entries: &[Value]) -> Vec<&str> {
    let paths = entries.iter().map(|entry| entry["path"].as_str());
    paths.map(|path| path.expect("a text")).collect()
}

#[test]
fn the_robot_says_who_it_is() {
    let zoo = Zoo::new();
    let client = zoo.client();
    let expected = json!({
        "version": 1, "robot": "zoo", "target": "loud", "can_write": true, "needs_token": false,
        "instances": ["VisionTop", "VisionBottom", "Hearing", "Control", "Reflexes", "Lights"],
    });
    for (key, value) in expected.as_object().expect("an object") {
        assert_eq!(client.welcome[key], *value, "{key}");
    }
}

#[test]
fn every_connection_to_a_run_has_its_id_and_the_next_run_another_one() {
    let run = |client: Client| {
        let welcome: protocol::Welcome = serde_json::from_value(client.welcome).expect("it is one");
        assert_eq!(welcome.run.as_deref().map(str::len), Some(32));
        welcome
    };
    let zoo = Zoo::new();
    let (first, second) = (run(zoo.client()), run(zoo.client()));
    assert_eq!(first.is_same_run(&second), Some(true));
    let next = Zoo::new();
    assert_eq!(first.is_same_run(&run(next.client())), Some(false));
    let earlier = protocol::Welcome {
        run: None,
        ..second
    };
    assert_eq!(first.is_same_run(&earlier), Some(false), "another program");
    assert_eq!(earlier.is_same_run(&earlier), None);
}

#[test]
fn everything_has_a_path() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let root = paths(&mut client, "", 1);
    assert_eq!(names(&root).last(), Some(&"framework"));
    assert!(names(&root).contains(&"Control") && names(&root).contains(&"parameters"));
    let control = paths(&mut client, "Control", 1);
    let expected = [
        "Control.main_outputs",
        "Control.additional_outputs",
        "Control.procedures",
    ];
    assert_eq!(names(&control), expected);
    let pose = paths(&mut client, "Control.main_outputs.pose", 2);
    let expected = ["position", "position.x", "position.y", "heading"]
        .map(|name| format!("Control.main_outputs.pose.{name}"));
    assert_eq!(names(&pose), expected);
    assert_eq!(pose[1]["type"], "f32");
    assert_eq!(pose[1]["kind"], "main_output");
    assert_eq!(
        (&pose[0]["has_children"], &pose[1]["has_children"]),
        (&json!(true), &json!(false))
    );
    // Names with dots are folders.
    let debug = paths(&mut client, "Control.additional_outputs", 3);
    let additional = |name| format!("Control.additional_outputs.{name}");
    let expected = [
        "debug",
        "debug.certainty",
        "debug.watcher",
        "debug.watcher.seen",
    ]
    .map(additional);
    assert_eq!(names(&debug), expected);
    let kinds: Vec<_> = debug.iter().map(|entry| &entry["kind"]).collect();
    let additional = "additional_output";
    assert_eq!(kinds, ["folder", additional, "folder", additional]);
    assert_eq!(
        names(&paths(&mut client, "parameters.gait", 1)),
        ["parameters.gait.period"]
    );
    let all = paths(&mut client, "", 255);
    let procedures: Vec<_> = (all.iter())
        .filter(|entry| entry["kind"] == json!("procedure"))
        .map(|entry| ["path", "request", "response"].map(|key| entry[key].as_str()))
        .collect();
    let rearm = ["framework.procedures.rearm", "()", "()"].map(Some);
    assert!(
        procedures.len() > 1 && procedures.contains(&rearm),
        "{procedures:?}"
    );
    assert!(
        procedures.iter().flatten().all(Option::is_some),
        "{procedures:?}"
    );
    let read: Vec<_> = all
        .iter()
        .filter(|entry| entry["type"].is_string())
        .collect();
    for entry in read.iter().take(300) {
        let path = entry["path"].as_str().expect("a text");
        client.ok(json!({ "schema": { "path": path } }));
    }
    for (below, expected) in [
        ("Cotnrol", "Control"),
        ("Control.main_outputs.pose.z", "heading"),
    ] {
        let error = client.error(json!({ "paths": { "below": below } }));
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn procedures_tell_what_they_are_asked_and_answer() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let messages = paths(&mut client, "Control.procedures.walk", 2);
    let expected = ["request", "request.speed", "response"]
        .map(|name| format!("Control.procedures.walk.{name}"));
    assert_eq!(names(&messages), expected);
    assert!(
        messages
            .iter()
            .all(|entry| entry["kind"] == json!("message"))
    );
    let mut schema =
        |path: &str| client.ok(json!({ "schema": { "path": path } }))["schema"].clone();
    let request = schema("Control.procedures.walk.request");
    assert_eq!(request["required"], json!(["speed"]), "{request}");
    let part = schema("Control.procedures.walk.request.speed");
    assert_eq!(part["type"], "number", "{part}");
    assert_eq!(schema("Control.procedures.stop.request")["type"], "null");
    assert_eq!(
        schema("Control.procedures.stop.response")["type"],
        "boolean"
    );
    let wrong = json!({ "schema": { "path": "Control.procedures.walk.request.sped" } });
    let error = client.error(wrong);
    assert!(error.contains("speed"), "{error}");
    // They have no value.
    client.error(json!({ "read": { "path": "Control.procedures.walk.request" } }));
}

#[test]
fn layouts_of_everything_are_told() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let subscribe = json!({ "path": "Control.main_outputs.pose", "encoding": "binary" });
    let subscribed = client.ok(json!({ "subscribe": subscribe }));
    let mut layout =
        |path: &str| client.ok(json!({ "layout": { "path": path } }))["layout"].clone();
    assert_eq!(
        layout("Control.main_outputs.pose"),
        subscribed["subscribed"]["layout"]
    );
    let float = json!({ "kind": "float", "bits": 32 });
    assert_eq!(layout("parameters.gait.period"), json!({ "root": float }));
    let request = layout("Control.procedures.walk.request");
    assert_eq!(
        request["root"]["fields"],
        json!([{ "name": "speed", "layout": float }])
    );
    assert_eq!(
        layout("Control.procedures.stop.request"),
        json!({ "root": { "kind": "unit" } })
    );
    let error = client.error(json!({ "layout": { "path": "Control.main_outputs.pos" } }));
    assert!(error.contains("pose"), "{error}");
}

#[test]
fn values_are_read_once() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let value = client.ok(json!({ "read": { "path": CYCLES } }));
    let again = client.ok(json!({ "read": { "path": CYCLES } }));
    let counted = value["value"]["cycle"]
        .as_u64()
        .map(|cycle| cycle + COUNTS_FROM);
    assert_eq!(counted, value["value"]["value"].as_u64());
    assert!(again["value"]["cycle"].as_u64() > value["value"]["cycle"].as_u64());
    let joint = client.ok(json!({ "read": { "path": "Control.main_outputs.joints.0" } }));
    assert!(joint["value"]["value"].is_f64());
    let seen = "Control.additional_outputs.debug.watcher.seen";
    let seen = client.ok(json!({ "read": { "path": seen } }));
    assert!(seen["value"]["value"].is_array(), "{seen}");
    let period = client.ok(json!({ "read": { "path": "parameters.gait.period" } }));
    assert_eq!(period["value"]["value"], json!(0.5));
    let schema = client.ok(json!({ "schema": { "path": "Control.main_outputs.pose" } }));
    assert_eq!(schema["schema"]["type"], "object");
}

#[test]
fn parameters_change_together_and_can_be_stored() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let write = |client: &mut Client, changes: Value| {
        client.ask(json!({ "write": { "changes": changes } }))
    };
    let refused = write(
        &mut client,
        json!([{ "path": "gait.period", "value": 2.0 }, { "path": "gait.perid", "value": 1 }]),
    );
    let refusals = refused["error"]["refusals"].as_array().expect("a list");
    assert_eq!(refusals.len(), 1);
    assert_eq!(refusals[0]["path"], "gait.perid");
    let reading = client.ok(json!({ "parameters": { "path": "gait" } }));
    let reading = &reading["parameters"];
    assert_eq!(
        reading["value"],
        json!({ "period": 0.5 }),
        "nothing of it was done"
    );
    assert_eq!(reading["leaves"][0]["provenance"]["from"], "file");
    let written = write(
        &mut client,
        json!([{ "path": "gait.period", "value": 2.0 }, { "path": "walking_speed", "value": 0.25 }]),
    );
    assert_eq!(written["ok"]["written"]["version"], json!(1));
    let unstored = client.ok(json!({ "unstored": {} }));
    assert_eq!(
        unstored["unstored"]["changes"].as_array().map(Vec::len),
        Some(2)
    );
    assert_eq!(unstored["unstored"]["layers"][0], "default");
    let stored = client.ok(json!({ "store": { "layer": "default", "paths": ["gait.period"] } }));
    assert_eq!(stored["stored"]["paths"], json!(["gait.period"]));
    let file = std::fs::read_to_string(zoo.folder.path().join("default.toml")).expect("there");
    assert!(file.contains("period = 2.0"), "{file}");
    client.ok(json!({ "reload": {} }));
    let speed = client.ok(json!({ "read": { "path": "parameters.walking_speed" } }));
    assert_eq!(
        speed["value"]["value"],
        json!(0.2),
        "what was not stored is gone"
    );
}

#[test]
fn an_output_is_replaced_until_it_is_released_or_its_client_leaves() {
    let zoo = Zoo::new();
    let mut watching = zoo.client();
    let speed = watching.subscribe("Control.main_outputs.speed");
    let inject = json!({ "inject": { "path": "Control.main_outputs.speed", "value": 7.5 } });
    let mut injecting = zoo.client();
    injecting.ok(inject.clone());
    eventually("it is replaced", || {
        watching.update(speed)["value"] == json!(7.5)
    });
    injecting.ok(json!({ "release": { "path": "Control.main_outputs.speed" } }));
    eventually("it is released", || {
        watching.update(speed)["value"] == json!(0.0)
    });
    injecting.ok(inject);
    eventually("it is replaced", || {
        watching.update(speed)["value"] == json!(7.5)
    });
    drop(injecting);
    eventually("it is released", || {
        watching.update(speed)["value"] == json!(0.0)
    });
    // What a setup node wrote is replaced before any node reads it.
    let image = json!({ "width": 3, "height": 1, "data": [1, 2, 3] });
    watching.ok(json!({ "inject": { "path": "VisionTop.main_outputs.image", "value": image } }));
    eventually("the image is replaced", || {
        let image = watching.ok(json!({ "read": { "path": "VisionTop.main_outputs.image" } }));
        image["value"]["value"]["width"] == json!(3)
    });
    for (path, value, expected) in [
        ("Control.main_outputs.speed", json!("fast"), "speed"),
        ("Control.main_outputs.pose.heading", json!(1.0), "whole"),
        (
            "Control.additional_outputs.debug.certainty",
            json!(1.0),
            "whole",
        ),
        ("Control.main_outputs.none", json!(1.0), "none"),
    ] {
        let error = watching.error(json!({ "inject": { "path": path, "value": value } }));
        assert!(error.contains(expected), "{error}");
    }
    let error = watching.error(json!({ "release": { "path": "Control.main_outputs.plan" } }));
    assert!(error.contains("nobody"), "{error}");
}

#[test]
fn who_leaves_gives_an_output_back_to_whoever_replaced_it_before() {
    let zoo = Zoo::new();
    let mut watching = zoo.client();
    let speed = watching.subscribe("Control.main_outputs.speed");
    let inject = |client: &mut Client, value: f32| {
        client.ok(json!({ "inject": { "path": "Control.main_outputs.speed", "value": value } }));
    };
    let mut clients = [(); 4].map(|()| zoo.client());
    for (client, value) in clients.iter_mut().zip([1.0, 2.0, 3.0, 4.0]) {
        inject(client, value);
    }
    let [mut first, second, third, fourth] = clients;
    // Who does it again is the last.
    inject(&mut first, 5.0);
    drop(third);
    let mut becomes = |value: f32| {
        let what = format!("it is {value}");
        eventually(&what, || watching.update(speed)["value"] == json!(value));
        (0..10).for_each(|_| assert_eq!(watching.update(speed)["value"], json!(value)));
    };
    becomes(5.0);
    drop(first);
    becomes(4.0);
    drop(fourth);
    becomes(2.0);
    drop(second);
    becomes(0.0);
    // It is released for all.
    let mut clients = [(); 2].map(|()| zoo.client());
    inject(&mut clients[0], 1.0);
    inject(&mut clients[1], 2.0);
    becomes(2.0);
    clients[1].ok(json!({ "release": { "path": "Control.main_outputs.speed" } }));
    becomes(0.0);
}

#[test]
fn procedures_answer_refuse_and_take_their_time() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let call = |name: &str, argument: Value| json!({ "call": { "path": format!("Control.procedures.{name}"), "argument": argument } });
    let called = client.ok(call("walk", json!({ "speed": 0.75 })));
    assert_eq!(called["called"], json!(0.75));
    let refused = client.error(call("stop", Value::Null));
    assert!(refused.contains("it never stops"), "{refused}");
    let wrong = client.error(call("walk", json!({ "sped": 1 })));
    assert!(wrong.contains("speed"), "{wrong}");
    let unknown = client.error(call("fly", Value::Null));
    assert!(unknown.contains("no procedure"), "{unknown}");
    for named in ["walk", "Control.walk", "wlak", "Control.procedures.wlk"] {
        let unknown = client.error(json!({ "call": { "path": named, "argument": null } }));
        let meant = "did you mean `Control.procedures.walk`?";
        assert!(unknown.ends_with(meant), "{unknown}");
    }
    let late = json!({ "call": {
        "path": "Control.procedures.walk", "argument": { "speed": 0.5 }, "timeout": 0.0,
    } });
    // Whether a cycle came in between or not, there is one answer.
    client.ask(late);
    let rearmed = client.ok(json!({ "call": { "path": "framework.procedures.rearm" } }));
    assert_eq!(rearmed["called"], Value::Null);
}

/// What a trace calls a thread, and the events of that thread.
fn events<'trace>(trace: &'trace Value, phase: &str) -> Vec<&'trace Value> {
    let events = trace["traceEvents"].as_array().expect("a list");
    events
        .iter()
        .filter(|event| event["ph"] == json!(phase))
        .collect()
}

#[test]
fn a_trace_has_the_nodes_within_their_cycles() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let cycles = client.subscribe("Control.main_outputs.cycles");
    // From here on every cycle is timed.
    client.ok(json!({ "trace": { "seconds": 1 } }));
    let first = client.update(cycles)["cycle"].as_u64().expect("a number") + 2;
    let last = (0..40)
        .map(|_| client.update(cycles)["cycle"].as_u64())
        .last();
    let last = last.flatten().expect("a number");
    let trace = client.ok(json!({ "trace": { "seconds": 60 } }))["trace"].clone();

    let timings = client.ok(json!({ "timings": {} }));
    let instances = timings["timings"]["instances"].as_array().expect("a list");
    let threads = events(&trace, "M");
    // The process has a name, too.
    assert_eq!(threads.len(), instances.len() + 1);
    let spans = events(&trace, "X");
    let mut spans_in_cycles = 0;
    for instance in instances {
        let name = &instance["name"];
        let thread = threads
            .iter()
            .find(|thread| thread["args"]["name"] == *name);
        let thread = &thread.expect("each has a thread")["tid"];
        let nodes = instance["nodes"].as_array().expect("a list");
        let mut open: Vec<(f64, &Value)> = Vec::new();
        let mut cycles = 0;
        for span in spans.iter().filter(|span| span["tid"] == *thread) {
            let is_cycle = span["name"] == *name;
            assert!(
                is_cycle || nodes.iter().any(|node| node["node"] == span["name"]),
                "{span}"
            );
            let begins = span["ts"].as_f64().expect("a number");
            let ends = begins + span["dur"].as_f64().expect("a number");
            // Nanoseconds in microseconds are rounded.
            open.retain(|(end, _)| *end > begins + 5e-4);
            if let Some((end, outer)) = open.last() {
                assert!(ends <= end + 1e-3, "{span} ends behind {outer}");
                assert_eq!(
                    span["args"]["cycle"], outer["args"]["cycle"],
                    "{span} {outer}"
                );
                assert!(!is_cycle);
            }
            open.push((ends, span));
            cycles += u64::from(is_cycle);
            spans_in_cycles += usize::from(open.len() > 1);
        }
        // At least every 16th cycle is timed, whatever other robots of this process want.
        assert!(
            *name != json!("Control") || cycles >= (last - first) / 16,
            "{trace}"
        );
    }
    assert!(spans_in_cycles > 0);
    let error = client.error(json!({ "trace": { "seconds": -1 } }));
    assert!(error.contains("a number of seconds"), "{error}");
}

fn log(client: &mut Client) -> Value {
    let is_log = |message: &Value| message.get("log").is_some();
    loop {
        if let Some(position) = client.waiting.iter().position(is_log) {
            return client.waiting.remove(position)["log"].clone();
        }
        let message = client.receive();
        client.waiting.push(message);
    }
}

#[test]
fn what_nodes_say_is_told_to_those_who_come_late_too() {
    let zoo = Zoo::new();
    let mut early = zoo.client();
    early.ok(json!({ "logs": {} }));
    let found = "zoo_nodes::vision::spot_finder";
    let of_finder = |client: &mut Client| loop {
        let said = log(client);
        if said["node"] == found && said["instance"] == "VisionTop" {
            return said;
        }
    };
    let first = of_finder(&mut early);
    assert_eq!(first["level"], "error");
    assert!(
        first["message"]
            .as_str()
            .is_some_and(|text| text.contains("too dark"))
    );
    assert!(first["cycle"].as_u64() > Some(0) && first["time"].as_u64() > Some(0));
    let mut late = zoo.client();
    late.ok(json!({ "logs": { "level": "error" } }));
    assert_eq!(of_finder(&mut late), first);
    for (of, level) in [
        (Value::Null, "info"),
        (json!("VisionTop"), "debug"),
        (json!("VisionTop.zoo_nodes::vision::spot_finder"), "trace"),
    ] {
        late.ok(json!({ "set_log_level": { "of": of, "level": level } }));
    }
    for (of, expected) in [("Vision", "INSTANCE"), ("VisionTop.spot", "spot_finder")] {
        let ask = json!({ "set_log_level": { "of": of, "level": "trace" } });
        let error = late.error(ask);
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn the_graph_is_that_of_the_program() {
    let with = |graph: &'static str| Listening {
        graph,
        ..Listening::default()
    };
    let zoo = Zoo::with(
        with(r#"{ "version": 1, "robot": "zoo" }"#),
        Limits::default(),
    );
    let graph = zoo.client().ok(json!({ "graph": {} }));
    assert_eq!(graph["graph"]["robot"], "zoo");
    let zoo = Zoo::with(with(""), Limits::default());
    let error = zoo.client().error(json!({ "graph": {} }));
    assert!(error.contains("without its graph"), "{error}");
}

#[test]
fn who_has_no_token_may_only_look() {
    let listening = Listening {
        token: Some("secret".to_owned()),
        ..Listening::default()
    };
    let zoo = Zoo::with(listening, Limits::default());
    let mut client = zoo.client();
    assert_eq!(client.welcome["needs_token"], json!(true));
    let writes = [
        json!({ "write": { "changes": [{ "path": "walking_speed", "value": 1.0 }] } }),
        json!({ "store": { "layer": "default" } }),
        json!({ "reload": {} }),
        json!({ "inject": { "path": "Control.main_outputs.speed", "value": 1.0 } }),
        json!({ "release": { "path": "Control.main_outputs.speed" } }),
        json!({ "call": { "path": "framework.procedures.rearm" } }),
        json!({ "set_log_level": { "level": "trace" } }),
    ];
    for ask in &writes {
        let error = client.error(ask.clone());
        assert!(error.contains("authenticate"), "{error}");
    }
    client.ok(json!({ "read": { "path": CYCLES } }));
    let error = client.error(json!({ "authenticate": { "token": "secreT" } }));
    assert!(error.contains("token"), "{error}");
    client.ok(json!({ "authenticate": { "token": "secret" } }));
    client.ok(writes[0].clone());

    let read_only = Listening {
        is_read_only: true,
        ..Listening::default()
    };
    let zoo = Zoo::with(read_only, Limits::default());
    let mut client = zoo.client();
    assert_eq!(client.welcome["can_write"], json!(false));
    for ask in writes {
        let error = client.error(ask);
        assert!(error.contains("read only"), "{error}");
    }
}

#[test]
fn what_is_no_request_is_answered() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    for (text, id) in [
        ("", None),
        ("nonsense", None),
        ("[]", None),
        (r#"{"id":7}"#, Some(7)),
        (r#"{"id":8,"ask":{"fly":{}}}"#, Some(8)),
        (r#"{"id":-1,"ask":{"timings":{}}}"#, None),
    ] {
        client.send(text);
        let answer = client.answer(id);
        assert!(answer["error"]["message"].is_string(), "{text}: {answer}");
    }
    let bytes = tungstenite::Message::binary(vec![1, 2, 3]);
    client.socket().send(bytes).expect("it is a message");
    assert!(client.answer(None)["error"]["message"].is_string());
    client.ok(json!({ "timings": {} }));
}
