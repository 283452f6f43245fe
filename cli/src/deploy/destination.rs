//! A destination of ssh, taken apart: ssh, rsync and the robot's own clients each write it their way.

use std::fmt;
use std::net::Ipv6Addr;

/// Who is reached where; what is left out is ssh's to know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Destination {
    written: String,
    user: Option<String>,
    /// Without brackets.
    host: String,
    port: Option<u16>,
}

impl Destination {
    /// What may be written, for messages.
    pub(crate) const HELP: &str = "write it like `nao@10.1.24.22` or `nao@fe80::1%eth0`; a port stands in `ssh://nao@10.1.24.22:2222` or in the configuration of ssh";

    /// `None`: it is no destination.
    pub(crate) fn parse(written: &str) -> Option<Self> {
        let (rest, is_url) = match written.strip_prefix("ssh://") {
            Some(rest) => (rest.strip_suffix('/').unwrap_or(rest), true),
            None => (written, false),
        };
        let (user, place) = match rest.rsplit_once('@') {
            Some((user, place)) => (Some(user), place),
            None => (None, rest),
        };
        let (host, port) = if is_url {
            with_port(place)?
        } else {
            (place, None)
        };
        let host = match host.strip_prefix('[') {
            Some(host) => host.strip_suffix(']').filter(|host| is_v6(host))?,
            None => host,
        };
        let is_word = |word: &str| {
            let is_odd = |one: char| one.is_whitespace() || one.is_control() || "/[]".contains(one);
            !word.is_empty() && !word.starts_with('-') && !word.contains(is_odd)
        };
        let is_host = is_word(host) && (!host.contains(':') || is_v6(host));
        (is_host && user.is_none_or(is_word)).then(|| Self {
            written: written.to_owned(),
            user: user.map(str::to_owned),
            host: host.to_owned(),
            port,
        })
    }

    /// The address or name of the machine.
    pub(crate) fn host(&self) -> &str {
        &self.host
    }

    /// For `ssh -p`.
    pub(crate) fn port(&self) -> Option<u16> {
        self.port
    }

    /// As ssh takes it behind its options.
    pub(crate) fn of_ssh(&self) -> String {
        self.with_user(&self.host)
    }

    /// As rsync takes it before a colon and a path.
    pub(crate) fn of_rsync(&self) -> String {
        match self.host.contains(':') {
            true => self.with_user(&format!("[{}]", self.host)),
            false => self.of_ssh(),
        }
    }

    /// Whether both are one machine, whoever is asked for there.
    pub(crate) fn is_machine_of(&self, other: &Self) -> bool {
        self.port == other.port && self.host.eq_ignore_ascii_case(&other.host)
    }

    fn with_user(&self, host: &str) -> String {
        match &self.user {
            Some(user) => format!("{user}@{host}"),
            None => host.to_owned(),
        }
    }
}

/// As it was written.
impl fmt::Display for Destination {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.written)
    }
}

/// What stands behind the last colon of a URL's place, which is no colon of an address.
fn with_port(place: &str) -> Option<(&str, Option<u16>)> {
    if place.ends_with(']') || !place.contains(':') {
        return Some((place, None));
    }
    let (host, port) = place.rsplit_once(':')?;
    let port = port.parse().ok().filter(|port| *port > 0)?;
    (!host.contains(':') || host.ends_with(']')).then_some((host, Some(port)))
}

/// Perhaps with the interface behind it: `fe80::1%eth0`.
fn is_v6(host: &str) -> bool {
    let (address, zone) = host.split_once('%').unwrap_or((host, "any"));
    !zone.is_empty() && address.parse::<Ipv6Addr>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::Destination;

    #[test]
    fn ssh_and_rsync_each_get_it_their_way() {
        for (written, ssh, port, rsync) in [
            ("nao@10.1.24.22", "nao@10.1.24.22", None, "nao@10.1.24.22"),
            ("nao22", "nao22", None, "nao22"),
            ("root@::1", "root@::1", None, "root@[::1]"),
            ("root@[::1]", "root@::1", None, "root@[::1]"),
            ("fe80::1%eth0", "fe80::1%eth0", None, "[fe80::1%eth0]"),
            ("ssh://root@nao:2222", "root@nao", Some(2222), "root@nao"),
            ("ssh://nao/", "nao", None, "nao"),
            ("ssh://[::1]:22", "::1", Some(22), "[::1]"),
            ("a@b@nao", "a@b@nao", None, "a@b@nao"),
        ] {
            let found = Destination::parse(written).expect(written);
            assert_eq!(
                (
                    found.of_ssh().as_str(),
                    found.port(),
                    found.of_rsync().as_str()
                ),
                (ssh, port, rsync)
            );
            assert_eq!(found.to_string(), written);
        }
    }

    #[test]
    fn what_ssh_would_take_for_something_else_is_refused() {
        for written in [
            "",
            "-oProxyCommand=x",
            "nao@-x",
            "@nao",
            "nao@",
            "a b",
            "nao:22",
            "nao@10.1.24.22:22",
            "nao:/home",
            "[nao]",
            "ssh://",
            "ssh://nao:",
            "ssh://nao:0",
            "ssh://nao:70000",
            "ssh://::1:22",
            "ssh://nao/home",
            "fe80::1%",
            "http://nao",
        ] {
            assert_eq!(Destination::parse(written), None, "{written}");
        }
    }

    #[test]
    fn a_machine_is_the_same_whoever_is_asked_for() {
        let parse = |written| Destination::parse(written).expect("it is one");
        let robot = parse("nao@10.1.24.22");
        for (other, is_same) in [
            ("10.1.24.22", true),
            ("ssh://root@10.1.24.22", true),
            ("ssh://nao@10.1.24.22:2222", false),
            ("nao@10.1.24.23", false),
        ] {
            assert_eq!(robot.is_machine_of(&parse(other)), is_same, "{other}");
        }
        assert!(parse("[::1]").is_machine_of(&parse("root@::1")));
    }
}
