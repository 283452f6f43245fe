//! The connection to a running robot: finding it, asking it, and hearing what it says by itself.

use std::collections::VecDeque;
use std::env;
use std::io::ErrorKind;
use std::net::{SocketAddr, TcpStream, ToSocketAddrs as _};
use std::time::{Duration, Instant};

use protocol::{
    Ask, BINARY_HEADER, BINARY_MAGIC, Good, Message, Outcome, PORT, Request, SOCKET, VERSION,
    Welcome,
};
use tungstenite::{Error, WebSocket};

use crate::arguments::Running;
use crate::outcome::Refusal;

/// A robot in the same network that does not answer within this time is not there.
const PATIENCE: Duration = Duration::from_secs(5);

/// Names the token where the command line does not: others on this machine can read command lines.
const TOKEN: &str = "HULKGEN_TOKEN";

/// A running robot.
pub(super) struct Connection {
    socket: WebSocket<TcpStream>,
    address: String,
    next_id: u32,
    /// What came while an answer was awaited.
    waiting: VecDeque<Heard>,
    pub(super) welcome: Welcome,
}

/// What a robot says without being asked anew.
pub(super) enum Heard {
    Message(Message),
    /// The head of a binary frame.
    Frame(Frame),
}

/// A value of a subscription in bytes, without the bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Frame {
    pub(super) subscription: u32,
    pub(super) cycle: u64,
    /// In nanoseconds of the robot's clock.
    pub(super) time: u64,
}

impl Connection {
    /// Finds the robot, hears its welcome, and shows the token if there is one.
    pub(super) fn open(running: &Running) -> Result<Self, Refusal> {
        let address = complete(running.host.as_deref().unwrap_or("127.0.0.1"));
        let stream = connect(&address)?;
        let set_up = stream
            .set_read_timeout(Some(PATIENCE))
            .and_then(|()| stream.set_nodelay(true));
        set_up.map_err(|error| lost(&address, &error.to_string()))?;
        let (socket, _) = tungstenite::client(format!("ws://{address}{SOCKET}"), stream)
            .map_err(|error| no_robot(&address, &error.to_string()))?;
        let mut connection = Self {
            socket,
            address,
            next_id: 1,
            waiting: VecDeque::new(),
            welcome: Welcome {
                version: VERSION,
                robot: String::new(),
                target: String::new(),
                instances: Vec::new(),
                can_write: false,
                needs_token: false,
                time: 0,
            },
        };
        connection.hear_welcome()?;
        let token = running.token.clone().or_else(|| env::var(TOKEN).ok());
        if let Some(token) = token {
            connection.ask(Ask::Authenticate { token })?;
        }
        Ok(connection)
    }

    fn hear_welcome(&mut self) -> Result<(), Refusal> {
        match self.hear_until(Some(Instant::now() + PATIENCE))? {
            Some(Heard::Message(Message::Welcome(welcome))) if welcome.version == VERSION => {
                self.welcome = welcome;
                Ok(())
            }
            Some(Heard::Message(Message::Welcome(welcome))) => Err(Refusal::bad(format!(
                "the robot speaks version {} of the protocol, this hulkgen {VERSION}",
                welcome.version
            ))
            .help("use the hulkgen that the robot was generated with")),
            _ => Err(self.confused()),
        }
    }

    /// Asks and waits for the answer.
    pub(super) fn ask(&mut self, ask: Ask) -> Result<Good, Refusal> {
        self.ask_for(ask, Duration::ZERO)
    }

    /// Asks for something that may take the robot so long.
    pub(super) fn ask_for(&mut self, ask: Ask, duration: Duration) -> Result<Good, Refusal> {
        let id = self.next_id;
        self.next_id += 1;
        let needs_token = self.welcome.needs_token;
        let text = serde_json::to_string(&Request { id, ask }).expect("requests are JSON");
        let sent = self.socket.send(tungstenite::Message::text(text));
        sent.map_err(|error| lost(&self.address, &error.to_string()))?;
        let deadline = Instant::now() + PATIENCE + duration;
        loop {
            match self.hear_until(Some(deadline))? {
                Some(Heard::Message(Message::Answer(answer))) if answer.id == Some(id) => {
                    return match answer.outcome {
                        Outcome::Ok(good) => Ok(*good),
                        Outcome::Error(failure) => Err(refused(&failure, needs_token)),
                    };
                }
                Some(Heard::Message(Message::Answer(answer))) if answer.id.is_none() => {
                    return match answer.outcome {
                        Outcome::Error(failure) => Err(refused(&failure, needs_token)),
                        Outcome::Ok(_) => Err(self.confused()),
                    };
                }
                Some(heard) => self.waiting.push_back(heard),
                None => {
                    return Err(Refusal::bad(format!(
                        "the robot at {} does not answer",
                        self.address
                    )));
                }
            }
        }
    }

    /// What the robot says next, however long that takes.
    pub(super) fn hear(&mut self) -> Result<Heard, Refusal> {
        match self.waiting.pop_front() {
            Some(heard) => Ok(heard),
            None => Ok(self
                .hear_until(None)?
                .expect("without an end it does not end")),
        }
    }

    /// What the robot says before that time, if anything.
    pub(super) fn hear_before(&mut self, end: Instant) -> Result<Option<Heard>, Refusal> {
        match self.waiting.pop_front() {
            Some(heard) => Ok(Some(heard)),
            None => self.hear_until(Some(end)),
        }
    }

    fn hear_until(&mut self, end: Option<Instant>) -> Result<Option<Heard>, Refusal> {
        loop {
            let left = end.map(|end| end.saturating_duration_since(Instant::now()));
            if left == Some(Duration::ZERO) {
                return Ok(None);
            }
            let set = self.socket.get_ref().set_read_timeout(left);
            set.map_err(|error| lost(&self.address, &error.to_string()))?;
            match self.socket.read() {
                Ok(tungstenite::Message::Text(text)) => {
                    match serde_json::from_str(text.as_str()) {
                        Ok(message) => return Ok(Some(Heard::Message(message))),
                        // A robot of a later version may say what we do not know; an answer is none of that.
                        Err(_) if !text.as_str().contains("\"answer\"") => {}
                        Err(_) => return Err(self.confused()),
                    }
                }
                Ok(tungstenite::Message::Binary(bytes)) => match Frame::read(&bytes) {
                    Some(frame) => return Ok(Some(Heard::Frame(frame))),
                    None => return Err(self.confused()),
                },
                // Pings are answered by the library.
                Ok(_) => {}
                Err(Error::Io(error))
                    if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
                Err(error) => return Err(lost(&self.address, &error.to_string())),
            }
        }
    }

    /// What the robot said makes no sense here.
    pub(super) fn confused(&self) -> Refusal {
        Refusal::bad(format!(
            "what answers at {} is no robot that this hulkgen understands",
            self.address
        ))
        .help("use the hulkgen that the robot was generated with")
    }
}

impl Drop for Connection {
    /// Says goodbye, so that the robot need not find out; a robot that went away needs none.
    fn drop(&mut self) {
        let _ = self.socket.close(None);
        let _ = self.socket.flush();
    }
}

impl Frame {
    fn read(bytes: &[u8]) -> Option<Self> {
        let (head, _) = bytes.split_at_checked(BINARY_HEADER)?;
        let (magic, rest) = head.split_first_chunk()?;
        let (subscription, rest) = rest.split_first_chunk()?;
        let (cycle, rest) = rest.split_first_chunk()?;
        let (time, _) = rest.split_first_chunk()?;
        (*magic == BINARY_MAGIC).then(|| Self {
            subscription: u32::from_le_bytes(*subscription),
            cycle: u64::from_le_bytes(*cycle),
            time: u64::from_le_bytes(*time),
        })
    }
}

/// The address with a port.
fn complete(host: &str) -> String {
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

/// To the first of the host's addresses that somebody listens at.
fn connect(address: &str) -> Result<TcpStream, Refusal> {
    let addresses: Vec<SocketAddr> = address
        .to_socket_addrs()
        .map_err(|error| no_robot(address, &error.to_string()))?
        .collect();
    let mut reason = "it has no address".to_owned();
    for one in addresses {
        match TcpStream::connect_timeout(&one, PATIENCE) {
            Ok(stream) => return Ok(stream),
            Err(error) => reason = error.to_string(),
        }
    }
    Err(no_robot(address, &reason))
}

fn no_robot(address: &str, reason: &str) -> Refusal {
    Refusal::bad(format!("no robot answers at {address}: {reason}"))
        .help("start one with `hulkgen run`, or say where it is with `--host ADDRESS`")
}

fn lost(address: &str, reason: &str) -> Refusal {
    Refusal::bad(format!("the robot at {address} went away: {reason}"))
}

fn refused(failure: &protocol::Failure, needs_token: bool) -> Refusal {
    let each = failure
        .refusals
        .iter()
        .map(|refusal| match refusal.path.as_str() {
            "" => refusal.message.clone(),
            path => format!("`{path}`: {}", refusal.message),
        });
    let each: Vec<_> = each.collect();
    // The message says the same in one line.
    let refusal = Refusal::bad(match each.is_empty() {
        true => failure.message.clone(),
        false => each.join("\n  "),
    });
    if needs_token {
        return refusal.help(format!(
            "writing needs the robot's token: `--token TOKEN`, or {TOKEN} in the environment"
        ));
    }
    refusal
}

#[cfg(test)]
mod tests {
    use super::{Frame, complete};

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

    #[test]
    fn the_head_of_a_frame_is_read_and_others_are_not() {
        let mut bytes = b"HKG1".to_vec();
        bytes.extend(7_u32.to_le_bytes());
        bytes.extend(812_u64.to_le_bytes());
        bytes.extend(9_744_000_000_u64.to_le_bytes());
        let frame = Frame {
            subscription: 7,
            cycle: 812,
            time: 9_744_000_000,
        };
        assert_eq!(Frame::read(&bytes), Some(frame));
        assert_eq!(Frame::read(&bytes[..23]), None);
        bytes[0] = b'X';
        assert_eq!(Frame::read(&bytes), None);
    }
}
