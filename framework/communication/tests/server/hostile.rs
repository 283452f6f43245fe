//! Clients that want to do harm, and one that counts meanwhile.

use std::io::Write;
use std::net::{SocketAddr, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use serde_json::{Value, json};
use tungstenite::Message;

use crate::zoo::{Client, Zoo, stream};

const CYCLES: &str = "Control.main_outputs.cycles";

/// A WebSocket that speaks by itself.
pub(crate) fn upgraded(address: SocketAddr) -> TcpStream {
    let mut stream = stream(address);
    let request = format!(
        "GET /socket HTTP/1.1\r\nHost: {address}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\
         Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
    );
    let _ = stream.write_all(request.as_bytes());
    stream
}

fn oversize_frames(address: SocketAddr) {
    // A text of 2⁶⁰ bytes, of which a megabyte comes.
    let mut frame = vec![0x81, 0xFF, 0x10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    frame.resize(1 << 20, b'x');
    let _ = upgraded(address).write_all(&frame);
}

fn invalid_text(address: SocketAddr) {
    let _ = upgraded(address).write_all(&[0x81, 0x84, 0, 0, 0, 0, 0xFF, 0xFE, 0xC0, 0x80]);
    // Reserved bits, a continuation of nothing, a close frame with one byte.
    for frame in [
        [0xF1, 0x80, 0, 0, 0, 0, 0],
        [0x80, 0x80, 0, 0, 0, 0, 0],
        [0x88, 0x81, 0, 0, 0, 0, 1],
    ] {
        let _ = upgraded(address).write_all(&frame);
    }
}

fn many_subscriptions(address: SocketAddr) {
    let Ok(mut client) = Client::connect(address) else {
        return;
    };
    for id in 0..100_000_u32 {
        let text = json!({ "id": id, "ask": { "subscribe": { "path": CYCLES } } }).to_string();
        if client.socket().write(Message::text(text)).is_err() {
            return;
        }
        if id % 500 == 499 {
            let _ = client.socket().flush();
            // Reads some: else the server listens no more.
            (0..500).for_each(|_| drop(client.try_receive()));
        }
    }
}

fn deep_json(address: SocketAddr) {
    if let Ok(mut client) = Client::connect(address) {
        for deep in ["[".repeat(100_000), "{\"a\":".repeat(100_000)] {
            let text =
                format!("{{\"id\":1,\"ask\":{{\"call\":{{\"path\":\"a\",\"argument\":{deep}");
            client.send(&text);
            let _ = client.try_receive();
        }
    }
}

fn long_paths(address: SocketAddr) {
    if let Ok(mut client) = Client::connect(address) {
        for path in [
            "a".repeat(1 << 20),
            "a.".repeat(1 << 19),
            ".".repeat(1 << 20),
        ] {
            for ask in ["read", "subscribe", "schema", "layout"] {
                client.send(&json!({ "id": 1, "ask": { ask: { "path": path } } }).to_string());
                let _ = client.try_receive();
            }
            client.send(&json!({ "id": 1, "ask": { "paths": { "below": path } } }).to_string());
            let _ = client.try_receive();
        }
    }
}

/// Ends the attacks when it is dropped.
struct Over<'attacks>(&'attacks AtomicBool);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// A machine that others keep busy may stand still for longer than updates can wait; what attacks the server does so all the time.
const GAPS: usize = 3;

#[test]
fn a_good_client_has_no_gap_whatever_others_do() {
    let zoo = Zoo::new();
    let address = zoo.address();
    let mut good = zoo.client();
    let cycles = good.subscribe(CYCLES);
    let mut last = good.update(cycles)["cycle"].as_u64().expect("a number");
    let mut gaps = 0;
    let is_over = AtomicBool::new(false);
    thread::scope(|scope| {
        // Also where this fails: else its scope waits for them forever.
        let over = Over(&is_over);
        for attack in [
            oversize_frames,
            invalid_text,
            deep_json,
            long_paths,
            many_subscriptions,
        ] {
            let is_over = &is_over;
            scope.spawn(move || {
                while !is_over.load(Ordering::Relaxed) {
                    attack(address);
                    thread::sleep(Duration::from_millis(5));
                }
            });
        }
        // Connected and silent, half a request, and subscribed without ever reading.
        let mut open: Vec<_> = (0..5).map(|_| stream(address)).collect();
        for half in &mut open[..3] {
            let _ = half.write_all(b"GET /socket HTTP/1.1\r\nHost:");
        }
        let mut silent = Client::connect(address).expect("there is a place");
        for path in [
            "VisionTop.main_outputs.image",
            "Control.main_outputs.report",
        ] {
            let ask = json!({ "subscribe": { "path": path } });
            for _ in 0..100 {
                silent.ask_later(&ask);
            }
        }
        let mut in_a_row = 0;
        while in_a_row < 400 {
            let cycle = good.update(cycles)["cycle"].as_u64().expect("a number");
            assert!(cycle > last, "{cycle} comes behind {last}");
            in_a_row += 1;
            if cycle > last + 1 {
                (gaps, in_a_row) = (gaps + 1, 0);
                assert!(
                    gaps <= GAPS,
                    "{gaps} gaps, the last one from {last} to {cycle}"
                );
            }
            last = cycle;
            if cycle.is_multiple_of(100) {
                good.ok(json!({ "read": { "path": "Control.main_outputs.pose" } }));
            }
        }
        drop(over);
    });
    let is_lost = |message: &&Value| message.get("lost").is_some();
    let lost = good.waiting.iter().filter(is_lost).count();
    assert!(lost <= gaps, "{lost} times something was lost, {gaps} gaps");
}
