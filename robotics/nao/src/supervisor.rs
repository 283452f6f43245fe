//! What the service manager is told: that the robot's program is ready, that it lives, that it ends (sd_notify(3)).
//!
//! The sign of life follows the body's cycles and the waiting for them: a program whose Control hangs is killed and started
//! again, one whose LoLA is away is not.

use std::ffi::OsString;
use std::os::linux::net::SocketAddrExt;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::net::{SocketAddr, UnixDatagram};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The service manager, if there is one.
#[derive(Debug, Default)]
pub(crate) struct Supervisor {
    manager: Option<(UnixDatagram, SocketAddr)>,
    /// How often it wants a sign of life, and when it had the last.
    watchdog: Option<(Duration, Mutex<Instant>)>,
}

impl Supervisor {
    /// The one that started this program.
    pub(crate) fn of_environment() -> Self {
        Self::new(
            std::env::var_os("NOTIFY_SOCKET"),
            std::env::var("WATCHDOG_USEC").ok(),
        )
    }

    fn new(socket: Option<OsString>, watchdog: Option<String>) -> Self {
        let manager = socket.and_then(|path| {
            let address = match path.as_bytes() {
                [b'@', name @ ..] => SocketAddr::from_abstract_name(name),
                _ => SocketAddr::from_pathname(&path),
            };
            let socket = UnixDatagram::unbound().ok()?;
            // A manager that does not listen must not hold up the body.
            socket.set_nonblocking(true).ok()?;
            Some((socket, address.ok()?))
        });
        let microseconds = watchdog.and_then(|text| text.parse().ok());
        let period = microseconds.map(|number| Duration::from_micros(number) / 4);
        Self {
            manager,
            watchdog: period.map(|period| (period, Mutex::new(Instant::now()))),
        }
    }

    /// The hardware is there.
    pub(crate) fn is_ready(&self) {
        self.tell("READY=1");
    }

    /// What the program is doing, for people.
    pub(crate) fn status(&self, what: &str) {
        self.tell(&format!("STATUS={what}"));
    }

    /// The program ends in order.
    pub(crate) fn is_stopping(&self) {
        self.tell("STOPPING=1");
    }

    /// The body's cycles go on; may be said at any rate.
    pub(crate) fn lives(&self) {
        let Some((period, last)) = &self.watchdog else {
            return;
        };
        let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
        if last.elapsed() >= *period {
            *last = Instant::now();
            self.tell("WATCHDOG=1");
        }
    }

    fn tell(&self, what: &str) {
        if let Some((socket, address)) = &self.manager {
            // Nothing can be done about a manager that has gone.
            let _ = socket.send_to_addr(what.as_bytes(), address);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heard(manager: &UnixDatagram) -> Option<String> {
        let mut bytes = [0; 64];
        manager.set_nonblocking(true).unwrap();
        let length = manager.recv(&mut bytes).ok()?;
        Some(String::from_utf8_lossy(&bytes[..length]).into_owned())
    }

    #[test]
    fn the_manager_hears_of_start_life_and_end() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("notify");
        let manager = UnixDatagram::bind(&path).unwrap();
        let supervisor = Supervisor::new(Some(path.into()), Some("40000".to_owned()));
        supervisor.is_ready();
        assert_eq!(heard(&manager).as_deref(), Some("READY=1"));
        supervisor.lives();
        assert_eq!(
            heard(&manager),
            None,
            "a quarter of the time has not passed"
        );
        std::thread::sleep(Duration::from_millis(10));
        supervisor.lives();
        assert_eq!(heard(&manager).as_deref(), Some("WATCHDOG=1"));
        supervisor.is_stopping();
        assert_eq!(heard(&manager).as_deref(), Some("STOPPING=1"));
    }

    #[test]
    fn a_manager_in_the_abstract_name_space_is_reached() {
        let name = format!("nao-supervisor-{}", std::process::id());
        let address = SocketAddr::from_abstract_name(&name).unwrap();
        let manager = UnixDatagram::bind_addr(&address).unwrap();
        Supervisor::new(Some(format!("@{name}").into()), None).is_ready();
        assert_eq!(heard(&manager).as_deref(), Some("READY=1"));
    }

    #[test]
    fn without_a_manager_nothing_happens() {
        let supervisor = Supervisor::new(None, Some("soon".to_owned()));
        supervisor.is_ready();
        supervisor.lives();
    }
}
