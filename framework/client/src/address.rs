//! Where a robot is.

use std::net::{SocketAddr, TcpStream, ToSocketAddrs as _};

use protocol::PORT;

use crate::PATIENCE;

/// The address with a port.
pub(crate) fn complete(host: &str) -> String {
    let host = host.strip_prefix("ws://").unwrap_or(host);
    let host = host.trim_end_matches('/');
    let is_bare_v6 = host.matches(':').count() > 1 && !host.starts_with('[');
    let has_port = host
        .rsplit_once(':')
        .is_some_and(|(before, port)| port.parse::<u16>().is_ok() && !before.is_empty());
    match (is_bare_v6, has_port) {
        (true, _) => format!("[{host}]:{PORT}"),
        (false, true) => host.to_owned(),
        (false, false) => format!("{host}:{PORT}"),
    }
}

/// To the first of the host's addresses that somebody listens at; the reason where nobody does.
pub(crate) fn reach(host: &str) -> Result<TcpStream, String> {
    let addresses: Vec<SocketAddr> = host
        .to_socket_addrs()
        .map_err(|error| error.to_string())?
        .collect();
    let mut reason = "it has no address".to_owned();
    for address in addresses {
        match TcpStream::connect_timeout(&address, PATIENCE) {
            Ok(stream) => return Ok(stream),
            Err(error) => reason = error.to_string(),
        }
    }
    Err(reason)
}

#[cfg(test)]
mod tests {
    use super::complete;

    #[test]
    fn an_address_needs_no_port() {
        for (host, expected) in [
            ("127.0.0.1", "127.0.0.1:4857"),
            ("nao:5000", "nao:5000"),
            ("nao.local", "nao.local:4857"),
            ("::1", "[::1]:4857"),
            ("[::1]", "[::1]:4857"),
            ("[::1]:80", "[::1]:80"),
            ("ws://nao/", "nao:4857"),
        ] {
            assert_eq!(complete(host), expected);
        }
    }
}
