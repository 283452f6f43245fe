//! The text of messages is what clients in other languages are built on.

use serde_json::json;

use crate::{Answer, Ask, Encoding, Failure, Good, Message, Outcome, Request, Subscribed, Update};

#[test]
fn requests_read_as_documented() {
    let cases = [
        (
            json!({ "paths": {} }),
            Ask::Paths {
                below: String::new(),
                depth: None,
            },
        ),
        (
            json!({ "subscribe": { "path": "A.main_outputs.b", "rate": 10.0, "encoding": { "jpeg": { "quality": 80 } } } }),
            Ask::Subscribe {
                path: "A.main_outputs.b".to_owned(),
                rate: Some(10.0),
                encoding: Encoding::Jpeg { quality: 80 },
            },
        ),
        (
            json!({ "subscribe": { "path": "A.main_outputs.b" } }),
            Ask::Subscribe {
                path: "A.main_outputs.b".to_owned(),
                rate: None,
                encoding: Encoding::Json,
            },
        ),
        (json!({ "timings": {} }), Ask::Timings {}),
    ];
    for (text, ask) in cases {
        let request: Request =
            serde_json::from_value(json!({ "id": 7, "ask": text })).expect("documented");
        assert_eq!(request, Request { id: 7, ask });
    }
}

#[test]
fn what_is_not_documented_is_refused() {
    for wrong in [
        json!({ "id": 1, "ask": { "read": { "path": "a", "pth": "b" } } }),
        json!({ "id": 1, "ask": { "raed": { "path": "a" } } }),
        json!({ "id": 1, "ask": { "timings": { "of": "a" } } }),
        json!({ "id": 1, "ask": { "timings": {} }, "more": 1 }),
        json!({ "id": -1, "ask": { "timings": {} } }),
        json!({ "ask": { "timings": {} } }),
    ] {
        assert!(
            serde_json::from_value::<Request>(wrong.clone()).is_err(),
            "{wrong}"
        );
    }
}

#[test]
fn messages_are_written_as_documented() {
    let subscribed = Good::Subscribed(Subscribed {
        subscription: 3,
        encoding: Encoding::Json,
        layout: None,
    });
    let failure = Failure {
        message: "no".to_owned(),
        refusals: Vec::new(),
    };
    let cases = [
        (
            Message::Answer(Answer {
                id: Some(7),
                outcome: Outcome::Ok(Box::new(subscribed)),
            }),
            json!({ "answer": { "id": 7, "ok": { "subscribed": { "subscription": 3, "encoding": "json" } } } }),
        ),
        (
            Message::Answer(Answer {
                id: None,
                outcome: Outcome::Error(failure),
            }),
            json!({ "answer": { "id": null, "error": { "message": "no" } } }),
        ),
        (
            Message::Update(Update {
                subscription: 3,
                cycle: 812,
                time: 9_744_000_000,
                value: json!(0.5),
                injected: false,
            }),
            json!({ "update": { "subscription": 3, "cycle": 812, "time": 9_744_000_000_u64, "value": 0.5 } }),
        ),
    ];
    for (message, text) in cases {
        assert_eq!(
            serde_json::to_value(&message).expect("messages are JSON"),
            text
        );
        let read: Message = serde_json::from_value(text).expect("what is written can be read");
        assert_eq!(read, message);
    }
}

/// `HULKGEN_WRITE=1 cargo test -p hulkgen-protocol` writes the files anew.
#[test]
fn the_schemas_in_the_documentation_are_current() {
    let (request, message) = crate::json_schemas();
    for (name, schema) in [("request", request), ("message", message)] {
        let file = format!(
            "{}/../../docs/protocol/{name}.schema.json",
            env!("CARGO_MANIFEST_DIR")
        );
        let text = format!("{schema:#}\n");
        if std::env::var_os("HULKGEN_WRITE").is_some() {
            std::fs::write(&file, &text).expect("the folder is part of the repository");
        }
        let checked_in = std::fs::read_to_string(&file).unwrap_or_default();
        assert_eq!(checked_in, text, "write it with HULKGEN_WRITE=1");
    }
}
