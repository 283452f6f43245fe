//! Each limit holds, and it is the limit that holds: without it the same goes through.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use framework::launch::Listening;
use hulkgen_communication::Limits;
use serde_json::{Value, json};
use tungstenite::Message;
use tungstenite::protocol::frame::Frame;
use tungstenite::protocol::frame::coding::{Data, OpCode};

use crate::zoo::{Client, PATIENCE, Zoo, eventually, stream};

const CYCLES: &str = "Control.main_outputs.cycles";

pub(crate) fn zoo(limits: Limits) -> Zoo {
    Zoo::with(Listening::default(), limits)
}

/// Whether what the limit forbids goes through, with the limit and without it.
pub(crate) fn with_and_without(limited: Limits, goes_through: impl Fn(&Zoo) -> bool) {
    assert!(!goes_through(&zoo(limited)), "the limit does not hold");
    assert!(goes_through(&zoo(unlimited())), "something else forbids it");
}

pub(crate) fn unlimited() -> Limits {
    Limits {
        connections: usize::MAX,
        head: Duration::from_secs(1000),
        silence: Duration::from_secs(1000),
        taking: Duration::from_secs(1000),
        message_bytes: usize::MAX,
        stranger_bytes: usize::MAX,
        arriving_bytes: usize::MAX,
        nesting: usize::MAX,
        path_bytes: usize::MAX,
        subscriptions: usize::MAX,
        jpegs: usize::MAX,
        jpegs_of_client: usize::MAX,
        waiting: usize::MAX,
        queued_updates: usize::MAX,
        queued_bytes: usize::MAX,
        passed_over_bytes: usize::MAX,
        wrong_tokens: u32::MAX,
        entries: usize::MAX,
        spans: usize::MAX,
        logs_per_second: usize::MAX,
        kept_logs: usize::MAX,
    }
}

/// Whether the robot does it.
fn is_ok(client: &mut Client, ask: Value) -> bool {
    client.ask(ask).get("ok").is_some()
}

#[test]
fn messages_have_a_greatest_length() {
    let limited = Limits {
        message_bytes: 1000,
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        let mut client = zoo.client();
        let long = format!(
            "{{\"id\":1,\"ask\":{{\"timings\":{}{{}}}}}}",
            " ".repeat(2000)
        );
        client.send(&long);
        client.try_receive().is_ok()
    });
}

#[test]
fn of_values_that_others_took_the_place_of_so_much_is_kept() {
    let limited = Limits {
        passed_over_bytes: 4,
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        let mut watching = zoo.client();
        let speed = watching.subscribe("Control.main_outputs.speed");
        let [_first, second, third] = [1.5, 2.5, 3.5].map(|value| {
            let mut client = zoo.client();
            let path = "Control.main_outputs.speed";
            client.ok(json!({ "inject": { "path": path, "value": value } }));
            client
        });
        drop(third);
        eventually("the one before counts", || {
            watching.update(speed)["value"] == json!(2.5)
        });
        drop(second);
        let mut after = json!(2.5);
        eventually("it counts no more", || {
            after = watching.update(speed)["value"].clone();
            after != json!(2.5)
        });
        assert!([json!(1.5), json!(0.0)].contains(&after), "{after}");
        after == json!(1.5)
    });
}

#[test]
fn messages_nest_only_so_deep() {
    let limited = Limits {
        nesting: 20,
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        let deep = format!("{}{}", "[".repeat(40), "]".repeat(40));
        let deep: Value = serde_json::from_str(&deep).expect("JSON");
        let ask = json!({ "call": { "path": "framework.procedures.rearm", "argument": deep } });
        let mut client = zoo.client();
        client.ask_later(&ask);
        let answer = client.receive();
        answer["answer"].get("ok").is_some()
    });
}

#[test]
fn paths_have_a_greatest_length() {
    let limited = Limits {
        path_bytes: 10,
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        is_ok(&mut zoo.client(), json!({ "read": { "path": CYCLES } }))
    });
}

#[test]
fn subscriptions_of_a_client_are_counted() {
    let limited = Limits {
        subscriptions: 3,
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        let mut client = zoo.client();
        let subscribe = json!({ "subscribe": { "path": CYCLES } });
        let first = client.subscribe(CYCLES);
        let all = (0..4).all(|_| is_ok(&mut client, subscribe.clone()));
        // What is given back can be had again.
        assert!(is_ok(
            &mut client,
            json!({ "unsubscribe": { "subscription": first } })
        ));
        assert!(is_ok(&mut client, subscribe));
        all
    });
}

#[test]
fn images_that_are_compressed_are_counted() {
    let limited = Limits {
        jpegs: 2,
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        let (mut client, mut other) = (zoo.client(), zoo.client());
        let all = (1..4).all(|quality| is_ok(&mut client, jpeg(quality)));
        // What is made already is for everybody.
        assert!(is_ok(&mut other, jpeg(2)));
        all
    });
}

#[test]
fn one_client_leaves_compressed_images_for_others() {
    let limited = Limits {
        jpegs_of_client: 2,
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        let (mut client, mut other) = (zoo.client(), zoo.client());
        let all = (1..4).all(|quality| is_ok(&mut client, jpeg(quality)));
        assert!(is_ok(&mut other, jpeg(10)));
        all
    });
}

fn jpeg(quality: u8) -> Value {
    json!({ "subscribe": {
        "path": "VisionTop.main_outputs.image", "encoding": { "jpeg": { "quality": quality } },
    } })
}

#[test]
fn connections_are_counted() {
    let limited = Limits {
        connections: 2,
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        let mut first = zoo.client();
        let _second = zoo.client();
        let third = Client::connect(zoo.address()).is_ok();
        first.ok(json!({ "read": { "path": CYCLES } }));
        drop(first);
        eventually("there is a place again", || {
            Client::connect(zoo.address()).is_ok()
        });
        third
    });
}

#[test]
fn requests_that_wait_are_counted() {
    let limited = Limits {
        waiting: 2,
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        let mut client = zoo.client();
        // Lights have no outputs, and nobody hears a whistle within these milliseconds.
        let ids: Vec<_> = (0..20)
            .map(|_| client.ask_later(&json!({ "read": { "path": CYCLES } })))
            .collect();
        let answers: Vec<_> = ids.iter().map(|_| client.receive()).collect();
        answers
            .iter()
            .all(|answer| answer["answer"].get("ok").is_some())
    });
}

#[test]
fn lists_of_paths_have_a_greatest_length() {
    let limited = Limits {
        entries: 5,
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        is_ok(
            &mut zoo.client(),
            json!({ "paths": { "below": "", "depth": 5 } }),
        )
    });
}

#[test]
fn traces_have_a_greatest_length() {
    let limited = Limits {
        spans: 10,
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        let mut client = zoo.client();
        client.ok(json!({ "trace": { "seconds": 0 } }));
        let cycles = client.subscribe(CYCLES);
        (0..40).for_each(|_| drop(client.update(cycles)));
        let trace = client.ok(json!({ "trace": { "seconds": 60 } }));
        let events = trace["trace"]["traceEvents"].as_array().expect("a list");
        let spans = events.iter().filter(|event| event["ph"] == json!("X"));
        spans.count() > 10
    });
}

#[test]
fn who_guesses_tokens_has_to_connect_again() {
    let goes_on = |limits: Limits| {
        let listening = Listening {
            token: Some("secret".to_owned()),
            ..Listening::default()
        };
        let zoo = Zoo::with(listening, limits);
        let mut client = zoo.client();
        (0..10).all(|guess| {
            client.ask_later(&json!({ "authenticate": { "token": guess.to_string() } }));
            client.try_receive().is_ok()
        })
    };
    assert!(!goes_on(Limits::default()));
    assert!(goes_on(unlimited()));
}

#[test]
fn the_last_wrong_token_is_answered_too() {
    let listening = Listening {
        token: Some("secret".to_owned()),
        ..Listening::default()
    };
    let zoo = Zoo::with(listening, Limits::default());
    let mut client = zoo.client();
    for _ in 0..5 {
        client.ask_later(&json!({ "authenticate": { "token": "guessed" } }));
    }
    for id in 1..=5 {
        let answer = client.try_receive().expect("each has an answer");
        assert_eq!(answer["answer"]["id"], json!(id));
    }
    assert!(client.try_receive().is_err(), "there is no sixth");
}

/// Whether the server still has the connection after a second.
fn is_kept(mut stream: TcpStream) -> bool {
    let timeout = Some(Duration::from_secs(1));
    stream.set_read_timeout(timeout).expect("a time-out");
    let mut byte = [0];
    match stream.read(&mut byte) {
        Ok(read) => read > 0,
        Err(error) => matches!(
            error.kind(),
            std::io::ErrorKind::WouldBlock | std::io::ErrorKind::TimedOut
        ),
    }
}

#[test]
fn a_connection_says_soon_what_it_wants() {
    let limited = Limits {
        head: Duration::from_millis(100),
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        let silent = stream(zoo.address());
        let mut half = stream(zoo.address());
        half.write_all(b"GET / HTTP/1.1\r\nHost:")
            .expect("it listens");
        let kept = (is_kept(silent), is_kept(half));
        assert_eq!(kept.0, kept.1);
        kept.0
    });
}

#[test]
fn a_client_gives_signs_of_life() {
    let limited = Limits {
        silence: Duration::from_millis(200),
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        let mut client = zoo.client();
        // It reads nothing, so it answers no ping.
        std::thread::sleep(Duration::from_millis(600));
        client.ask_later(&json!({ "timings": {} }));
        client.try_receive().is_ok()
    });
}

#[test]
fn a_client_whose_message_is_on_its_way_is_not_silent() {
    let zoo = zoo(Limits {
        silence: Duration::from_secs(2),
        ..Limits::default()
    });
    let mut client = zoo.client();
    let mut say = |part: &str, data, is_last| {
        let part = Frame::message(part.to_owned(), OpCode::Data(data), is_last);
        let sent = client.socket().send(Message::Frame(part));
        sent.expect("the robot listens");
        std::thread::sleep(Duration::from_millis(200));
    };
    say(r#"{"id":1,"ask":"#, Data::Text, false);
    (0..15).for_each(|_| say(" ", Data::Continue, false));
    say(r#"{"paths":{"below":""}}}"#, Data::Continue, true);
    assert!(client.answer(Some(1)).get("ok").is_some());
}

#[test]
fn a_client_that_takes_nothing_is_let_go() {
    let limited = Limits {
        taking: Duration::from_millis(200),
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        let mut greedy = zoo.client();
        let all = json!({ "paths": { "below": "", "depth": 9 } });
        for _ in 0..400 {
            let text = json!({ "id": 1, "ask": all }).to_string();
            let sent = greedy.socket().send(tungstenite::Message::text(text));
            if sent.is_err() {
                return false;
            }
        }
        std::thread::sleep(Duration::from_millis(800));
        // What is in the buffers of the system comes still.
        (0..400).all(|_| greedy.try_receive().is_ok())
    });
}

/// Reads 512 KiB every 100 ms until the text has come; whether it has.
fn comes_slowly(stream: &mut TcpStream, text: &str) -> bool {
    let mut part = vec![0; 64 << 10];
    let (mut end, mut read) = (Vec::new(), 0);
    let started = Instant::now();
    while started.elapsed() < PATIENCE {
        let Ok(count @ 1..) = stream.read(&mut part) else {
            return false;
        };
        end.extend_from_slice(&part[..count]);
        if end.windows(text.len()).any(|it| it == text.as_bytes()) {
            return true;
        }
        end.drain(..end.len().saturating_sub(text.len()));
        read += count;
        if read > 512 << 10 {
            read = 0;
            std::thread::sleep(Duration::from_millis(100));
        }
    }
    false
}

#[test]
fn a_client_that_takes_something_is_kept_however_long_its_message_takes() {
    let limit = Duration::from_secs(2);
    for limits in [
        Limits {
            taking: limit,
            ..unlimited()
        },
        Limits {
            silence: limit,
            ..unlimited()
        },
    ] {
        let zoo = zoo(limits);
        let mut client = zoo.client();
        // More than the buffers of the system have room for.
        let text = format!("{}END", "x".repeat(32 << 20));
        let change = json!([{ "path": "option.text", "value": text }]);
        client.ok(json!({ "write": { "changes": change } }));
        client.ask_later(&json!({ "read": { "path": "parameters.option.text" } }));
        assert!(comes_slowly(client.socket().get_mut(), "END"));
        // What it does not hear while it takes the message it answers behind it.
        std::thread::sleep(Duration::from_millis(100));
        let id = client.ask_later(&json!({ "paths": { "below": "" } }));
        let answer = format!("{{\"answer\":{{\"id\":{id},");
        assert!(comes_slowly(client.socket().get_mut(), &answer));
    }
}

#[test]
fn updates_that_nobody_takes_are_lost_and_told() {
    let lost = |limits: Limits| {
        let zoo = zoo(limits);
        let mut slow = zoo.client();
        // Megabytes, so that the buffers of the system are full soon.
        let pixels = vec![0_u8; 300_000];
        let image = json!({ "width": 300_000, "height": 1, "data": pixels });
        slow.ok(json!({ "inject": { "path": "VisionTop.main_outputs.image", "value": image } }));
        let answer = slow.ok(json!({ "subscribe": {
            "path": "VisionTop.main_outputs.image", "encoding": "binary",
        } }));
        let images = &answer["subscribed"]["subscription"];
        let mut good = zoo.client();
        let cycles = good.subscribe(CYCLES);
        let mut cycle = good.update(cycles)["cycle"].as_u64();
        // On a busy machine it, too, may miss some, and is told.
        for _ in 0..250 {
            let next = good.update(cycles)["cycle"].as_u64();
            assert!(next > cycle, "{next:?} behind {cycle:?}");
            cycle = next;
        }
        let (mut lost, mut seen) = (0, 0);
        let mut before: Option<u64> = None;
        let mut gaps = 0;
        while seen < 60 {
            let message = slow.receive();
            if let Some(told) = message.get("lost") {
                assert_eq!(told["subscription"], *images);
                lost += told["updates"].as_u64().expect("a number");
            }
            if message.get("bytes").is_some() {
                let cycle = crate::zoo::cycle_of_frame(&message);
                gaps += before.map_or(0, |before| cycle - before - 1);
                before = Some(cycle);
                seen += 1;
            }
        }
        assert_eq!(gaps, lost, "what is missing was told");
        lost
    };
    assert!(
        lost(Limits {
            queued_updates: 3,
            ..Limits::default()
        }) > 0
    );
    assert!(
        lost(Limits {
            queued_bytes: 2 << 20,
            ..Limits::default()
        }) > 0
    );
    assert_eq!(lost(unlimited()), 0);
}

#[test]
fn a_call_that_is_refused_moves_nothing() {
    let zoo = zoo(Limits {
        waiting: 0,
        ..Limits::default()
    });
    let mut client = zoo.client();
    let call = json!({ "path": "Control.procedures.walk", "argument": { "speed": 0.75 } });
    let refused = client.error(json!({ "call": call }));
    assert!(refused.contains("wait already"), "{refused}");
    let speed = client.subscribe("Control.main_outputs.speed");
    for _ in 0..10 {
        assert_eq!(client.update(speed)["value"], json!(0.0));
    }
}
