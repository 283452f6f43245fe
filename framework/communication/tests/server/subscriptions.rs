//! Values again and again.

use std::collections::BTreeMap;
use std::thread;
use std::time::Duration;

use serde_json::{Value, json};
use tungstenite::Message;
use tungstenite::protocol::frame::coding::CloseCode;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;

use crate::zoo::{Zoo, eventually, number, pieces};

#[test]
fn every_cycle_comes_once_in_order() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let cycles = client.subscribe("Control.main_outputs.cycles");
    let heading = client.subscribe("Control.main_outputs.pose.heading");
    let first = client.update(cycles);
    let (mut cycle, mut time) = (first["cycle"].as_u64(), first["time"].as_u64());
    for _ in 0..100 {
        let update = client.update(cycles);
        assert_eq!(update["cycle"].as_u64(), cycle.map(|cycle| cycle + 1));
        assert!(update["time"].as_u64() > time, "{update}");
        // It counts its own cycles, from 100.
        let counted = update["cycle"].as_u64().map(|cycle| cycle + 100);
        assert_eq!(update["value"].as_u64(), counted);
        (cycle, time) = (update["cycle"].as_u64(), update["time"].as_u64());
    }
    assert!(client.update(heading)["value"].is_f64());
}

#[test]
fn a_client_that_stops_reading_for_a_while_has_no_gap() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let cycles = client.subscribe("Control.main_outputs.cycles");
    let mut expected = client.update(cycles)["cycle"].as_u64().expect("a number");
    for pause in [0, 200, 0, 100, 0] {
        thread::sleep(Duration::from_millis(pause));
        for _ in 0..20 {
            expected += 1;
            assert_eq!(client.update(cycles)["cycle"], json!(expected));
        }
    }
}

#[test]
fn a_rate_is_not_exceeded() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let ask = json!({ "subscribe": { "path": "Control.main_outputs.cycles", "rate": 20 } });
    let slow = number(&client.ok(ask)["subscribed"]["subscription"]);
    let times: Vec<u64> = (0..10)
        .map(|_| client.update(slow)["time"].as_u64().expect("a number"))
        .collect();
    // In step with 20 Hz: where the robot stalls, an update is late and the next in time, but half a period lies between.
    let shortest = times.windows(2).map(|pair| pair[1] - pair[0]).min();
    assert!(shortest >= Some(25_000_000), "{times:?}");
    assert!(
        times[9] - times[0] >= 9 * 50_000_000 - 25_000_000,
        "{times:?}"
    );
}

#[test]
fn wrong_rates_and_paths_are_refused_with_what_would_be_right() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    for rate in [json!(0), json!(-1), json!(-1e300)] {
        let error = client
            .error(json!({ "subscribe": { "path": "Control.main_outputs.cycles", "rate": rate } }));
        assert!(error.contains("rate"), "{error}");
    }
    let wrong = |client: &mut crate::zoo::Client, path: &str| {
        client.error(json!({ "subscribe": { "path": path } }))
    };
    let error = wrong(&mut client, "Control.main_outputs.pose.haeding");
    assert!(error.contains("heading"), "{error}");
    for (path, meant) in [
        (
            "Control.main_outputs.cycle",
            "`Control.main_outputs.cycles`",
        ),
        (
            "Control.main_output.cycles",
            "`Control.main_outputs.cycles`",
        ),
        (
            "Contrl.main_outputs.cycles",
            "`Control.main_outputs.cycles`",
        ),
        ("Control.cycles", "`Control.main_outputs.cycles`"),
        ("Control.pose.x", "`Control.main_outputs.pose.x`"),
        ("gait.period", "`parameters.gait.period`"),
    ] {
        let error = wrong(&mut client, path);
        assert!(error.contains(&format!("did you mean {meant}?")), "{error}");
    }
    let error = wrong(&mut client, "Control.main_outputs.none");
    assert!(error.contains("`hulkgen topic list`"), "{error}");
    assert!(wrong(&mut client, "Control.main_outputs.pose..x").contains("path"));
    assert!(wrong(&mut client, "").contains("no ``"));
}

#[test]
fn an_additional_output_is_computed_while_somebody_wants_it() {
    let zoo = Zoo::new();
    let (mut one, mut other) = (zoo.client(), zoo.client());
    let path = "Control.additional_outputs.debug.watcher.seen";
    let first = one.subscribe(path);
    assert_eq!(one.update(first)["value"].as_array().map(Vec::len), Some(3));
    let second = other.subscribe(path);
    other.update(second);
    one.ok(json!({ "unsubscribe": { "subscription": first } }));
    // The other one still has it.
    other.update(second);
    drop(one);
    other.update(second);
    let width = other.subscribe("VisionTop.additional_outputs.vision_top.width");
    assert_eq!(other.update(width)["value"], json!(16));
}

#[test]
fn a_part_that_is_not_there_is_null() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let x = client.subscribe("VisionTop.main_outputs.best.x");
    let values: Vec<Value> = (0..40).map(|_| client.update(x)["value"].clone()).collect();
    // Every tenth image is dark.
    assert!(values.iter().any(Value::is_null), "{values:?}");
    assert!(values.iter().any(Value::is_f64), "{values:?}");
}

#[test]
fn binary_values_are_laid_out_as_the_answer_says() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let answer = client.ok(json!({ "subscribe": {
        "path": "Control.main_outputs.joints", "encoding": "binary",
    } }));
    let subscribed = &answer["subscribed"];
    let subscription = number(&subscribed["subscription"]);
    let layout = serde_json::from_value(subscribed["layout"].clone()).expect("a layout");
    for _ in 0..5 {
        let message = client.receive();
        let bytes: Vec<u8> = message["bytes"]
            .as_array()
            .unwrap_or_else(|| panic!("{message}"))
            .iter()
            .map(|byte| u8::try_from(byte.as_u64().expect("a byte")).expect("a byte"))
            .collect();
        let (header, value) = bytes.split_at(protocol::BINARY_HEADER);
        assert_eq!(header[..4], protocol::BINARY_MAGIC);
        assert_eq!(header[4..8], subscription.to_le_bytes());
        let cycle = u64::from_le_bytes(header[8..16].try_into().expect("eight bytes"));
        assert!(cycle > 0);
        let value = framework::reflect::binary::decode(&layout, value).expect("as laid out");
        assert_eq!(value.as_array().map(Vec::len), Some(3), "{value}");
    }
}

#[test]
fn who_asks_for_bundles_gets_a_cycle_in_one_message_of_texts_and_one_of_frames() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    client.ok(json!({ "bundle": {} }));
    let paths = ["cycles", "pose.heading", "joints"].map(|it| format!("Control.main_outputs.{it}"));
    let texts = paths.each_ref().map(|path| client.subscribe(path));
    let frames = paths.each_ref().map(|path| {
        let ask = json!({ "subscribe": { "path": path, "encoding": "binary" } });
        number(&client.ok(ask)["subscribed"]["subscription"])
    });
    let mut messages = 0;
    let mut cycles: BTreeMap<u32, Vec<u64>> = BTreeMap::new();
    while cycles.len() < 6 || cycles.values().any(|seen| seen.len() < 100) {
        let message = client.socket().read().expect("the robot speaks");
        if message.is_ping() {
            continue;
        }
        messages += 1;
        for piece in pieces(message) {
            let (subscription, cycle) = update_in(&piece);
            cycles.entry(subscription).or_default().push(cycle);
        }
    }
    for subscription in texts.into_iter().chain(frames) {
        let seen = &cycles[&subscription];
        assert!(seen.is_sorted_by(|one, next| one + 1 == *next), "{seen:?}");
    }
    // Each alone they would be 600; a robot that is held up while it hands a cycle out gives it in parts.
    assert!(messages <= 300, "{messages} messages");
}

/// Whose it is, and of which cycle.
fn update_in(piece: &Message) -> (u32, u64) {
    match piece {
        Message::Text(text) => {
            let message: Value = serde_json::from_str(text.as_str()).expect("JSON");
            let update = &message["update"];
            let cycle = update["cycle"].as_u64();
            (number(&update["subscription"]), cycle.expect("a number"))
        }
        Message::Binary(bytes) => {
            assert!(bytes.starts_with(&protocol::BINARY_MAGIC), "{bytes:?}");
            let subscription = bytes[4..8].try_into().expect("four bytes");
            let cycle = bytes[8..16].try_into().expect("eight bytes");
            (u32::from_le_bytes(subscription), u64::from_le_bytes(cycle))
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_image_comes_as_a_file() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let path = "VisionTop.main_outputs.image";
    let subscribe = |path: &str, quality: u32| json!({ "subscribe": { "path": path, "encoding": { "jpeg": { "quality": quality } } } });
    let answer = client.ok(subscribe(path, 80));
    assert_eq!(
        answer["subscribed"]["encoding"],
        json!({ "jpeg": { "quality": 80 } })
    );
    let number = number(&answer["subscribed"]["subscription"]);
    let (head, file) = client.frame();
    assert_eq!(head[..4], protocol::BINARY_MAGIC);
    assert_eq!(head[4..8], number.to_le_bytes());
    let mut decoder = JpegDecoder::new(ZCursor::new(&file));
    let pixels = decoder.decode().expect("a JPEG file");
    assert_eq!(decoder.dimensions(), Some((16, 1)));
    // The decoder makes colours of gray.
    assert_eq!(pixels.len(), 16 * 3);

    client.ok(
        json!({ "inject": { "path": path, "value": { "width": 16, "height": 2, "data": [1] } } }),
    );
    eventually("what is no whole image has no file", || {
        client.frame().1.is_empty()
    });

    for (path, quality, expected) in [
        ("VisionTop.main_outputs.image.data", 80, "is no image"),
        ("parameters", 80, "parameters are told as JSON alone"),
        (path, 0, "from 1 to 100"),
        (path, 101, "from 1 to 100"),
    ] {
        let message = client.error(subscribe(path, quality));
        assert!(message.contains(expected), "{message}");
    }
    let entries = client.ok(json!({ "paths": { "below": "VisionTop.main_outputs" } }));
    let entries = entries["paths"].as_array().expect("a list").clone();
    let images: Vec<_> = entries
        .iter()
        .filter(|entry| entry["image"] == json!("gray"))
        .collect();
    assert_eq!(images.len(), 1, "{entries:?}");
    assert_eq!(images[0]["path"], json!(path));
}

#[test]
fn what_nobody_wants_any_more_does_not_come() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let cycles = client.subscribe("Control.main_outputs.cycles");
    client.update(cycles);
    client.ok(json!({ "unsubscribe": { "subscription": cycles } }));
    client.waiting.clear();
    thread::sleep(Duration::from_millis(100));
    client.ok(json!({ "timings": {} }));
    assert_eq!(client.waiting, Vec::<Value>::new());
    let error = client.error(json!({ "unsubscribe": { "subscription": cycles } }));
    assert!(error.contains("no subscription"), "{error}");
}

#[test]
fn parameters_are_told_with_each_change() {
    let zoo = Zoo::new();
    let (mut one, mut other) = (zoo.client(), zoo.client());
    let speed = one.subscribe("parameters.walking_speed");
    assert_eq!(one.update(speed)["value"], json!(0.2));
    let changes = json!([{ "path": "walking_speed", "value": 0.5 }]);
    let written = other.ok(json!({ "write": { "changes": changes } }));
    // No change is no version.
    let nothing = other.ok(json!({ "write": { "changes": [] } }));
    assert_eq!(nothing, written);
    let update = one.update(speed);
    assert_eq!(
        (&update["value"], &update["cycle"]),
        (&json!(0.5), &written["written"]["version"])
    );
    let told = |client: &mut crate::zoo::Client| {
        let is_told = |message: &Value| message.get("parameters_changed").is_some();
        while !client.waiting.iter().any(is_told) {
            let message = client.receive();
            client.waiting.push(message);
        }
    };
    told(&mut one);
    told(&mut other);
    // Somebody edits the file.
    let file = zoo.folder.path().join("default.toml");
    let text = std::fs::read_to_string(&file).expect("it is there");
    let text = text.replace("threshold = 100", "threshold = 101");
    let threshold = one.subscribe("parameters.spot_finder.threshold");
    assert_eq!(one.update(threshold)["value"], json!(100));
    std::fs::write(&file, text).expect("it is ours");
    assert_eq!(one.update(threshold)["value"], json!(101));
}

#[test]
fn a_server_that_ends_leaves_the_robot_alone() {
    let mut zoo = Zoo::new();
    let mut client = zoo.client();
    let cycles = client.subscribe("Control.main_outputs.cycles");
    client.update(cycles);
    zoo.stop_serving();
    let close = loop {
        let message = client.socket().read().expect("the server says goodbye");
        if let Message::Close(close) = message {
            break close.expect("and why");
        }
    };
    assert_eq!(close.code, CloseCode::Away);
    assert_eq!(close.reason, "the robot ends");
}

#[test]
fn of_parameters_that_change_too_often_the_last_value_comes() {
    let zoo = Zoo::new();
    let (mut one, mut other) = (zoo.client(), zoo.client());
    let asked = json!({ "subscribe": { "path": "parameters.walking_speed", "rate": 4 } });
    let speed = one.ok(asked)["subscribed"]["subscription"].clone();
    let speed = speed.as_u64().expect("a number") as u32;
    assert_eq!(one.update(speed)["value"], json!(0.2));
    for value in [0.3, 0.4, 0.5] {
        let changes = json!([{ "path": "walking_speed", "value": value }]);
        other.ok(json!({ "write": { "changes": changes } }));
    }
    // A period is 250 ms; behind the answer there is nothing more to come.
    std::thread::sleep(std::time::Duration::from_secs(1));
    one.ok(json!({ "parameters": {} }));
    let mut updates = one
        .waiting
        .iter()
        .filter_map(|message| message.get("update"));
    assert_eq!(
        updates.next_back().expect("it changed")["value"],
        json!(0.5)
    );
}

/// Reads slower than updates come, so that some wait for ever.
#[test]
fn a_client_that_reads_slowly_is_heard() {
    let zoo = Zoo::new();
    let mut client = zoo.client();
    let image = json!({ "width": 300_000, "height": 1, "data": vec![1_u8; 300_000] });
    let path = "VisionTop.main_outputs.image";
    client.ok(json!({ "inject": { "path": path, "value": image } }));
    for _ in 0..16 {
        client.ask_later(&json!({ "subscribe": { "path": path, "encoding": "binary" } }));
    }
    let read = |client: &mut crate::zoo::Client| {
        std::thread::sleep(std::time::Duration::from_millis(20));
        client.receive()
    };
    let mut updates = 0;
    while updates < 60 {
        updates += usize::from(read(&mut client).get("bytes").is_some());
    }
    let asked = client.ask_later(&json!({ "parameters": {} }));
    for _ in 0..400 {
        if read(&mut client)["answer"]["id"] == json!(asked) {
            return;
        }
    }
    panic!("the robot does not hear who has updates waiting");
}
