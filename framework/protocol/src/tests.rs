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

/// One of each kind that a robot says, and some that a client does.
const HONEST: &[&str] = &[
    r#"{"welcome":{"version":1,"robot":"lamp","target":"desk","instances":["A"],"can_write":true,"needs_token":false,"time":5}}"#,
    r#"{"welcome":{"version":1,"robot":"lamp","target":"desk","instances":[],"can_write":false,"needs_token":true,"time":5,"run":"8c5e","peers":["10.1.24.22:4857"]}}"#,
    r#"{"answer":{"id":7,"ok":{"subscribed":{"subscription":3,"encoding":{"jpeg":{"quality":70}}}}}}"#,
    r#"{"answer":{"id":null,"error":{"message":"no","refusals":[{"path":"a","message":"b"}]}}}"#,
    r#"{"answer":{"id":2,"ok":{"paths":[{"path":"A","kind":"folder","has_children":true,"range":{"maximum":1.5}}]}}}"#,
    r#"{"answer":{"id":2,"ok":{"value":{"cycle":3,"time":9,"value":[1,null,"é"],"injected":true}}}}"#,
    r#"{"update":{"subscription":3,"cycle":812,"time":9744000000,"value":0.5}}"#,
    r#"{"lost":{"subscription":3,"updates":2}}"#,
    r#"{"log":{"number":1,"time":2,"level":"warn","message":"x","fields":{"a":1}}}"#,
    r#"{"parameters_changed":{"version":4}}"#,
    r#"{"id":1,"ask":{"subscribe":{"path":"a.b","rate":0.5,"encoding":"binary"}}}"#,
    r#"{"id":1,"ask":{"write":{"changes":[{"path":"a","value":{"b":[1]}}]}}}"#,
    r#"{"id":1,"ask":{"trace":{"seconds":1e3}}}"#,
    r#"{"id":1,"ask":{"complete":{"instance":"A","time":9,"outputs":{"b":[1]}}}}"#,
    r#"{"answer":{"id":2,"ok":{"timings":{"time":1,"instances":[],"remotes":[{"name":"A","is_fed":true,"completed":5,"unannounced":1,"abandoned":2,"refused":3}]}}}}"#,
    r#"{"answer":{"id":2,"ok":{"timings":{"time":1,"instances":[],"recording":[{"of":"A","recorded":9,"dropped":4,"failed":3,"lost":2,"overwritten":1}]}}}}"#,
];

/// What was read, written and read again; whether it was a message at all.
fn is_stable<T>(text: &str) -> bool
where
    T: serde::de::DeserializeOwned + serde::Serialize + PartialEq + std::fmt::Debug,
{
    let Ok(message) = serde_json::from_str::<T>(text) else {
        return false;
    };
    let again = serde_json::to_string(&message).expect("messages are JSON");
    assert_eq!(
        serde_json::from_str::<T>(&again).ok(),
        Some(message),
        "{text}"
    );
    true
}

/// Every character gone, and every character replaced by each of those that mean something.
#[test]
fn messages_that_are_nearly_right_are_read_as_they_are_written_or_not_at_all() {
    let instead = [
        "", "\"", "{", "}", "[", ",", ":", "9", "-", "e", "\\", "é", "\0",
    ];
    let (mut read, mut refused) = (0, 0);
    for honest in HONEST {
        assert!(
            is_stable::<Message>(honest) || is_stable::<Request>(honest),
            "{honest}"
        );
        for (at, character) in honest.char_indices() {
            for piece in instead {
                let (before, after) = (&honest[..at], &honest[at + character.len_utf8()..]);
                let text = format!("{before}{piece}{after}");
                let is_read = is_stable::<Message>(&text) || is_stable::<Request>(&text);
                read += u32::from(is_read);
                refused += u32::from(!is_read);
            }
        }
    }
    assert!(read > 0 && refused > read, "{read} read, {refused} refused");
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
