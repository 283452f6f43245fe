//! The page, by plain HTTP.

use std::io::{BufRead as _, BufReader, Read, Write};

use framework::launch::Listening;
use hulkgen_communication::Limits;
use serde_json::json;

use crate::zoo::{Client, Zoo, stream};

const UPGRADE: &str = "Upgrade: websocket\r\nConnection: upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

/// Status line and body.
fn get(zoo: &Zoo, path: &str, headers: &str) -> (String, String) {
    let address = zoo.address();
    let mut stream = stream(address);
    let host = if headers.contains("Host:") {
        String::new()
    } else {
        format!("Host: {address}\r\n")
    };
    let request = format!("GET {path} HTTP/1.1\r\n{host}{headers}Connection: close\r\n\r\n");
    // It may be refused before it is said whole.
    let _ = stream.write_all(request.as_bytes());
    let mut answer = Vec::new();
    let _ = stream.read_to_end(&mut answer);
    let answer = String::from_utf8_lossy(&answer).into_owned();
    let (head, body) = answer.split_once("\r\n\r\n").unwrap_or((&answer, ""));
    let status = head.lines().next().unwrap_or_default().to_owned();
    (status, body.to_owned())
}

#[test]
fn the_page_is_handed_out() {
    let zoo = Zoo::new();
    let (status, body) = get(&zoo, "/favicon.svg", "");
    assert_eq!(status, "HTTP/1.1 200 OK");
    assert!(body.contains("<svg"), "{body}");
    assert_eq!(get(&zoo, "/nothing", "").0, "HTTP/1.1 404 Not Found");
    assert_eq!(get(&zoo, "/../Cargo.toml", "").0, "HTTP/1.1 404 Not Found");
    assert_ne!(
        get(&zoo, &format!("/{}", "a".repeat(1 << 20)), "").0,
        "HTTP/1.1 200 OK"
    );
    assert_eq!(get(&zoo, "/favicon.svg", "").0, "HTTP/1.1 200 OK");
}

#[test]
fn the_page_may_come_from_a_folder() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("index.html"), "my page").expect("it is ours");
    let listening = Listening {
        web_root: Some(folder.path().to_owned()),
        ..Listening::default()
    };
    let zoo = Zoo::with(listening, Limits::default());
    assert_eq!(get(&zoo, "/", "").1, "my page");
    assert_eq!(get(&zoo, "/favicon.svg", "").0, "HTTP/1.1 404 Not Found");
}

#[test]
fn pages_of_other_sites_stay_outside() {
    let zoo = Zoo::new();
    let forbidden = "HTTP/1.1 403 Forbidden";
    let from = |origin: &str| format!("{UPGRADE}Origin: {origin}\r\n");
    assert_eq!(
        get(&zoo, "/socket", &from("http://evil.example")).0,
        forbidden
    );
    assert_eq!(get(&zoo, "/socket", &from("null")).0, forbidden);
    // The name of another site that leads here.
    let host = "Host: evil.example\r\nOrigin: http://evil.example\r\n";
    assert_eq!(get(&zoo, "/favicon.svg", host).0, forbidden);
}

#[test]
fn pages_of_robots_that_were_named_come_in_and_no_others() {
    let listening = Listening {
        peers: vec!["127.0.0.1:9".to_owned()],
        ..Listening::default()
    };
    let zoo = Zoo::with(listening, Limits::default());
    let status = |origin: &str, path: &str| {
        let address = zoo.address();
        let mut stream = stream(address);
        let head = format!("{UPGRADE}Host: {address}\r\nOrigin: {origin}\r\n");
        let asked = stream.write_all(format!("GET {path} HTTP/1.1\r\n{head}\r\n").as_bytes());
        asked.expect("it listens");
        let mut line = String::new();
        let read = BufReader::new(stream).read_line(&mut line);
        read.expect("it answers");
        line.trim_end().to_owned()
    };
    let forbidden = "HTTP/1.1 403 Forbidden";
    let welcome = "HTTP/1.1 101 Switching Protocols";
    assert_eq!(status("http://127.0.0.1:9", "/socket"), welcome);
    // Whoever else is on that machine, or on this one, is no robot.
    for origin in [
        "http://127.0.0.1:10",
        "http://127.0.0.1",
        "https://127.0.0.1:9",
        "null",
    ] {
        assert_eq!(status(origin, "/socket"), forbidden, "{origin}");
    }
    let client = Client::connect(zoo.address()).expect("programs say nothing of pages");
    assert_eq!(client.welcome["peers"], json!(["127.0.0.1:9"]));
    // Its page has files of its own.
    assert_eq!(status("http://127.0.0.1:9", "/page.js"), forbidden);
}
