//! What is held of messages that are not whole.

use std::io::{Read, Write};
use std::net::TcpStream;

use framework::launch::Listening;
use hulkgen_communication::Limits;
use serde_json::json;
use tungstenite::Message;
use tungstenite::protocol::frame::Frame;
use tungstenite::protocol::frame::coding::{Data, OpCode};

use crate::hostile::upgraded;
use crate::limits::{unlimited, with_and_without};
use crate::zoo::{Client, Zoo, eventually};

const CYCLES: &str = "Control.main_outputs.cycles";

/// What a client without the token may say at a time.
const STRANGER: usize = 64 << 10;

/// The head of a text of 8 MiB, which is all that comes. Its mask looks like the end of a request.
const ANNOUNCED: [u8; 14] = *b"\x81\xFF\0\0\0\0\0\x80\0\0\r\n\r\n";

fn with_token(limits: Limits) -> Zoo {
    let listening = Listening {
        token: Some("secret".to_owned()),
        ..Listening::default()
    };
    Zoo::with(listening, limits)
}

/// A text that does not end here.
fn begin(bytes: usize) -> Message {
    let begin = Frame::message("x".repeat(bytes), OpCode::Data(Data::Text), false);
    Message::Frame(begin)
}

/// Whether a client may send so much of a message, and what it is told if not.
fn sends_half(client: &mut Client, bytes: usize) -> Result<(), String> {
    for message in [begin(bytes), Message::Ping("here".into())] {
        // The server may have hung up amid it.
        let _ = client.socket().send(message);
    }
    is_alive(client)
}

/// Whether a sign of life is answered, or what the client is told in its place.
fn is_alive(client: &mut Client) -> Result<(), String> {
    loop {
        match client.socket().read().expect("the server says why") {
            Message::Pong(_) => return Ok(()),
            Message::Close(why) => return Err(why.expect("a reason").to_string()),
            _ => {}
        }
    }
}

/// All that comes until the server hangs up, or for as long as a test waits.
fn heard(mut stream: TcpStream) -> String {
    let mut bytes = Vec::new();
    let _ = stream.read_to_end(&mut bytes);
    String::from_utf8_lossy(&bytes).into_owned()
}

#[test]
fn a_client_that_may_change_nothing_is_held_little_of() {
    let zoo = with_token(Limits::default());
    let told = sends_half(&mut zoo.client(), STRANGER + 1).expect_err("the limit holds");
    assert!(told.contains("authenticate first"), "{told}");
    assert_eq!(sends_half(&mut zoo.client(), STRANGER), Ok(()));
    let mut trusted = zoo.client();
    trusted.ok(json!({ "authenticate": { "token": "secret" } }));
    assert_eq!(sends_half(&mut trusted, 1_000_000), Ok(()));
    // Where a token changes nothing nobody is asked for one.
    let listening = Listening {
        is_read_only: true,
        ..Listening::default()
    };
    let read_only = Zoo::with(listening, Limits::default());
    let told = sends_half(&mut read_only.client(), STRANGER + 1).expect_err("the limit holds");
    assert!(told.contains("may only be read"), "{told}");
    let zoo = with_token(unlimited());
    assert_eq!(sends_half(&mut zoo.client(), 2 * STRANGER), Ok(()));
}

#[test]
fn what_is_whole_is_held_no_longer() {
    let zoo = with_token(Limits::default());
    let mut client = zoo.client();
    let text = |bytes: usize| {
        let message = format!("{{\"id\":1{}}}", " ".repeat(bytes));
        message[message.len() - bytes..].to_owned()
    };
    for _ in 0..3 {
        client.ok(json!({ "read": { "path": CYCLES } }));
        client.send(&text(STRANGER));
        client.receive();
    }
    client.send(&text(STRANGER + 1));
    assert!(client.try_receive().is_err(), "no whole one is longer");
    // Nor are signs of life amid a message, however many.
    let mut client = zoo.client();
    client.socket().send(begin(STRANGER)).expect("it listens");
    for _ in 0..1000 {
        let ping = Message::Ping(vec![0; 100].into());
        client.socket().send(ping).expect("it listens");
        assert_eq!(is_alive(&mut client), Ok(()));
    }
}

#[test]
fn who_has_said_the_token_is_known_at_once() {
    let zoo = with_token(Limits::default());
    let mut client = zoo.client();
    let token = json!({ "id": 1, "ask": { "authenticate": { "token": "secret" } } });
    let messages = [Message::text(token.to_string()), begin(1_000_000)];
    for message in messages {
        client.socket().write(message).expect("it listens");
    }
    let ping = Message::Ping("here".into());
    client.socket().send(ping).expect("it listens");
    assert_eq!(is_alive(&mut client), Ok(()));
}

#[test]
fn what_a_frame_announces_counts_before_it_comes() {
    let zoo = with_token(Limits::default());
    let mut in_time = zoo.client();
    let stream = in_time.socket().get_mut();
    stream.write_all(&ANNOUNCED).expect("it listens");
    let told = is_alive(&mut in_time).expect_err("refused at once");
    assert!(told.contains("authenticate first"), "{told}");
    // Together with the request, or before its answer was there.
    let mut too_early = upgraded(zoo.address());
    too_early.write_all(&ANNOUNCED).expect("it listens");
    let told = heard(too_early);
    assert!(told.contains("authenticate first"), "{told}");
}

#[test]
fn who_is_refused_hears_why_whatever_else_it_said() {
    let zoo = with_token(Limits::default());
    for _ in 0..10 {
        let mut stream = upgraded(zoo.address());
        stream.write_all(&ANNOUNCED).expect("it listens");
        // More than the server reads before it has hung up.
        let _ = stream.write_all(&[0; 200_000]);
        let mut bytes = Vec::new();
        let end = stream.read_to_end(&mut bytes);
        assert!(end.is_ok(), "{end:?}");
        let told = String::from_utf8_lossy(&bytes);
        assert!(told.contains("authenticate first"), "{told}");
    }
}

#[test]
fn a_connection_has_one_request() {
    let zoo = with_token(Limits::default());
    let mut stream = crate::zoo::stream(zoo.address());
    let host = zoo.address();
    let request = format!("GET /nothing HTTP/1.1\r\nHost: {host}\r\n\r\n");
    let both = request.repeat(2);
    stream.write_all(both.as_bytes()).expect("it listens");
    let told = heard(stream).to_lowercase();
    assert_eq!(told.matches("http/1.1").count(), 1, "{told}");
    assert!(told.contains("connection: close"), "{told}");
}

#[test]
fn all_clients_together_are_held_only_so_much_of() {
    let limited = Limits {
        arriving_bytes: 3 << 20,
        ..Limits::default()
    };
    with_and_without(limited, |zoo| {
        let (mut first, mut second) = (zoo.client(), zoo.client());
        sends_half(&mut first, 2 << 20).expect("there is room");
        let goes_through = sends_half(&mut second, 2 << 20);
        if let Err(told) = &goes_through {
            assert!(told.contains("say it again later"), "{told}");
            // Short ones have their place.
            zoo.client().ok(json!({ "read": { "path": CYCLES } }));
        }
        drop(first);
        eventually("there is room again", || {
            sends_half(&mut zoo.client(), 2 << 20).is_ok()
        });
        goes_through.is_ok()
    });
}
