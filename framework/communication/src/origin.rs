//! Whether a browser may come here: only with a page of this server, or of a robot that this one was told of.
//!
//! A page of another site can open a WebSocket to this machine without asking anybody. Browsers say where a page is from
//! (`Origin`), and to whom they believe they talk (`Host`); what is no browser says nothing.

use std::net::{IpAddr, SocketAddr};

use axum::http::HeaderMap;
use axum::http::header::{HOST, ORIGIN};

/// `Err` says why not. `address` is where this server listens; `peers` are hosts with ports, in lower case.
pub(crate) fn check(
    headers: &HeaderMap,
    address: SocketAddr,
    peers: &[String],
) -> Result<(), &'static str> {
    let host = headers.get(HOST).and_then(|host| host.to_str().ok());
    let host = host.ok_or("the header `Host` is missing")?;
    // A name of another site may lead to this machine.
    if address.ip().is_loopback() && !is_this_machine(host) {
        return Err("this server is for this machine alone: open it by its address");
    }
    let Some(origin) = headers.get(ORIGIN) else {
        return Ok(());
    };
    let origin = origin.to_str().unwrap_or_default();
    let is_welcome = origin.split_once("://").is_some_and(|(scheme, site)| {
        site.eq_ignore_ascii_case(host) || is_peer(scheme, site, peers)
    });
    if is_welcome {
        Ok(())
    } else {
        Err("pages of other sites may not come here; a robot names other robots with --peer")
    }
}

/// Whether a page of one of these robots comes. Browsers leave out port 80 of `http`.
fn is_peer(scheme: &str, site: &str, peers: &[String]) -> bool {
    let is = |peer: &String| {
        site.eq_ignore_ascii_case(peer)
            || (peer.strip_suffix(":80")).is_some_and(|host| site.eq_ignore_ascii_case(host))
    };
    scheme == "http" && peers.iter().any(is)
}

fn is_this_machine(host: &str) -> bool {
    let name = match host.rsplit_once(':') {
        // An IPv6 address alone is in brackets.
        Some((name, port)) if port.bytes().all(|byte| byte.is_ascii_digit()) => name,
        _ => host,
    };
    let address = name.trim_start_matches('[').trim_end_matches(']');
    let address = address.parse::<IpAddr>();
    name.eq_ignore_ascii_case("localhost") || address.is_ok_and(|address| address.is_loopback())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checked(host: Option<&str>, origin: Option<&str>, address: &str) -> bool {
        let mut headers = HeaderMap::new();
        for (name, value) in [(HOST, host), (ORIGIN, origin)] {
            if let Some(value) = value {
                headers.insert(name, value.parse().expect("a header"));
            }
        }
        let peers = [
            "nao23.local:4857".to_owned(),
            "127.0.0.1:4858".to_owned(),
            "10.1.24.5:80".to_owned(),
        ];
        check(&headers, address.parse().expect("an address"), &peers).is_ok()
    }

    #[test]
    fn only_pages_of_this_server_come_in() {
        let local = "127.0.0.1:4857";
        for (host, origin, expected) in [
            (None, None, false),
            (Some(local), None, true),
            (Some("localhost:4857"), Some("http://localhost:4857"), true),
            (Some("[::1]:4857"), None, true),
            (Some(local), Some("http://127.0.0.1:4857"), true),
            (Some(local), Some("http://127.0.0.1:80"), false),
            (Some(local), Some("https://evil.example"), false),
            (Some(local), Some("null"), false),
            // The name of another site that leads here.
            (Some("evil.example:4857"), None, false),
            (
                Some("evil.example:4857"),
                Some("http://evil.example:4857"),
                false,
            ),
            (Some("127.0.0.1.evil.example"), None, false),
        ] {
            assert_eq!(
                checked(host, origin, local),
                expected,
                "{host:?} {origin:?}"
            );
        }
        for (origin, expected) in [
            ("http://127.0.0.1:4858", true),
            ("http://NAO23.local:4857", true),
            ("http://10.1.24.5", true),
            // Another server of a machine with a robot is no robot.
            ("http://127.0.0.1:4859", false),
            ("http://nao23.local", false),
            ("http://nao23.local:4857.evil.example", false),
            ("http://evil.example/127.0.0.1:4858", false),
            ("https://127.0.0.1:4858", false),
            ("127.0.0.1:4858", false),
        ] {
            assert_eq!(
                checked(Some(local), Some(origin), local),
                expected,
                "{origin}"
            );
        }
        let everywhere = "0.0.0.0:4857";
        let robot = Some("nao22.local:4857");
        assert!(checked(robot, Some("http://nao22.local:4857"), everywhere));
        assert!(!checked(robot, Some("http://evil.example"), everywhere));
    }
}
