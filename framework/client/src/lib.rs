//! The connection of a bridge to a running robot, as docs/protocol.md describes it.
//!
//! Invariant: nothing waits for the robot without an end, and what is kept of what it says is bounded.

#![warn(missing_docs)]

use std::collections::VecDeque;
use std::io::ErrorKind;
use std::net::{SocketAddr, TcpStream, ToSocketAddrs as _};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use protocol::{
    Answer, Ask, BINARY_HEADER, BINARY_MAGIC, Good, Message, Outcome, PORT, Request, SOCKET,
    VERSION, Welcome,
};
use tungstenite::{Error, WebSocket};

/// Failures are told to people.
pub type Result<T> = std::result::Result<T, String>;

/// A robot that does not answer within this time is not there.
const PATIENCE: Duration = Duration::from_secs(10);

/// A robot says something every 20 s, if only a ping: one that says nothing for so long disappeared.
const SILENCE: Duration = Duration::from_secs(60);

/// How long the robot is listened to before something else is looked at.
const MOMENT: Duration = Duration::from_millis(5);

/// Messages that are kept while an answer is awaited; of more the oldest are lost.
const KEPT: usize = 4096;

/// A running robot.
pub struct Robot {
    socket: WebSocket<TcpStream>,
    /// When it last said anything.
    heard: Instant,
    /// Nanoseconds from 1970 to the start of its clock.
    start: u64,
    next_id: u32,
    /// What came while an answer was awaited.
    waiting: VecDeque<Heard>,
    /// Its first words.
    pub welcome: Welcome,
}

/// What a robot says without being waited for.
pub enum Heard {
    /// In JSON.
    Message(Message),
    /// In bytes.
    Frame(Frame),
}

/// A value in bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// As the answer to `subscribe` said.
    pub subscription: u32,
    /// Number of the cycle that wrote it.
    pub cycle: u64,
    /// In nanoseconds of the robot's clock.
    pub time: u64,
    /// Empty: the part is not there in this cycle.
    pub value: Vec<u8>,
}

impl Robot {
    /// Finds the robot, hears its welcome, and shows the token if there is one. A host without a port has the robot's own.
    ///
    /// # Errors
    /// If nobody answers there, no robot, one of another version, or the token is wrong.
    pub fn connect(host: &str, token: Option<&str>) -> Result<Self> {
        let host = complete(host);
        let absent = |error: String| {
            format!(
                "no robot answers at {host}: {error}; start one with `hulkgen run`, or say where it is with `--host ADDRESS:PORT`"
            )
        };
        let stream = reach(&host).map_err(absent)?;
        let set = stream.set_read_timeout(Some(PATIENCE));
        set.and_then(|()| stream.set_write_timeout(Some(PATIENCE)))
            .and_then(|()| stream.set_nodelay(true))
            .map_err(|error| absent(error.to_string()))?;
        let (mut socket, _) = tungstenite::client(format!("ws://{host}{SOCKET}"), stream)
            .map_err(|error| absent(error.to_string()))?;
        let mut heard = Instant::now();
        let welcome = match read(&mut socket, &mut heard)? {
            Some(Heard::Message(Message::Welcome(welcome))) => welcome,
            _ => return Err(absent("what answers is no robot".to_owned())),
        };
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        let now = now.map_or(0, |now| u64::try_from(now.as_nanos()).unwrap_or_default());
        let start = now.saturating_sub(welcome.time);
        if welcome.version != VERSION {
            return Err(format!(
                "the robot at {host} speaks version {} of the protocol, this bridge {VERSION}; build both from one revision",
                welcome.version
            ));
        }
        let set = socket.get_ref().set_read_timeout(Some(MOMENT));
        set.map_err(|error| absent(error.to_string()))?;
        let mut robot = Self {
            socket,
            heard,
            start,
            next_id: 1,
            waiting: VecDeque::new(),
            welcome,
        };
        if let Some(token) = token {
            let token = token.to_owned();
            robot.ask(Ask::Authenticate { token })?;
        }
        Ok(robot)
    }

    /// A time of the robot's clock as nanoseconds since 1970: its welcome is taken to have come without delay.
    pub fn since_1970(&self, time: u64) -> u64 {
        self.start.saturating_add(time)
    }

    /// Asks without waiting; the answer comes with this number, see [`Robot::hear`].
    ///
    /// # Errors
    /// If the robot went away.
    pub fn send(&mut self, ask: Ask) -> Result<u32> {
        let id = self.next_id;
        self.next_id = self.next_id.wrapping_add(1);
        let request = Request { id, ask };
        let text = serde_json::to_string(&request).map_err(|error| error.to_string())?;
        let sent = self.socket.send(tungstenite::Message::text(text));
        sent.map_err(|error| gone(&error))?;
        Ok(id)
    }

    /// The answer, or the robot's own words why there is none.
    ///
    /// # Errors
    /// If the robot refuses, does not answer or went away.
    pub fn ask(&mut self, ask: Ask) -> Result<Good> {
        let id = self.send(ask)?;
        let end = Instant::now() + PATIENCE;
        while Instant::now() < end {
            match read(&mut self.socket, &mut self.heard)? {
                Some(Heard::Message(Message::Answer(answer))) if answer.id == Some(id) => {
                    return match answer.outcome {
                        Outcome::Ok(good) => Ok(*good),
                        Outcome::Error(failure) => Err(failure.message),
                    };
                }
                // What is so wrong that its number cannot be read is refused without one.
                Some(Heard::Message(Message::Answer(Answer {
                    id: None,
                    outcome: Outcome::Error(failure),
                }))) => return Err(failure.message),
                Some(heard) => {
                    if self.waiting.len() == KEPT {
                        self.waiting.pop_front();
                    }
                    self.waiting.push_back(heard);
                }
                None => {}
            }
        }
        Err("the robot does not answer".to_owned())
    }

    /// What the robot says next, if it says something at the moment.
    ///
    /// # Errors
    /// If the robot went away.
    pub fn hear(&mut self) -> Result<Option<Heard>> {
        match self.waiting.pop_front() {
            Some(heard) => Ok(Some(heard)),
            None => read(&mut self.socket, &mut self.heard),
        }
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
fn reach(host: &str) -> Result<TcpStream> {
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

/// What comes next, if it comes at the moment and is known; `heard` is when anything came.
fn read(socket: &mut WebSocket<TcpStream>, heard: &mut Instant) -> Result<Option<Heard>> {
    let message = match socket.read() {
        Ok(message) => message,
        Err(Error::Io(error))
            if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) =>
        {
            if heard.elapsed() > SILENCE {
                let seconds = SILENCE.as_secs();
                return Err(format!(
                    "the robot went away: it said nothing for {seconds} s"
                ));
            }
            return Ok(None);
        }
        Err(error) => return Err(gone(&error)),
    };
    *heard = Instant::now();
    Ok(match message {
        // A robot of a later version may say what we do not know.
        tungstenite::Message::Text(text) => {
            let message = serde_json::from_str(text.as_str());
            message.ok().map(Heard::Message)
        }
        tungstenite::Message::Binary(bytes) => Frame::read(&bytes).map(Heard::Frame),
        _ => None,
    })
}

fn gone(error: &Error) -> String {
    format!("the robot went away: {error}")
}

impl Frame {
    /// A binary message of a robot; `None` for anything else.
    pub fn read(bytes: &[u8]) -> Option<Self> {
        let (head, value) = bytes.split_at_checked(BINARY_HEADER)?;
        let (magic, rest) = head.split_first_chunk()?;
        let (subscription, rest) = rest.split_first_chunk()?;
        let (cycle, rest) = rest.split_first_chunk()?;
        let (time, _) = rest.split_first_chunk()?;
        (*magic == BINARY_MAGIC).then(|| Self {
            subscription: u32::from_le_bytes(*subscription),
            cycle: u64::from_le_bytes(*cycle),
            time: u64::from_le_bytes(*time),
            value: value.to_vec(),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::net::{TcpListener, TcpStream};
    use std::time::{Duration, Instant};

    use tungstenite::protocol::Role;
    use tungstenite::{Message, WebSocket};

    use super::{Frame, SILENCE, complete, read};

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
    fn a_silent_robot_is_gone_and_a_ping_is_a_word() {
        let listener = TcpListener::bind("127.0.0.1:0").expect("there is a free port");
        let address = listener.local_addr().expect("it is bound");
        let stream = TcpStream::connect(address).expect("it is listened to");
        let moment = Some(Duration::from_millis(5));
        stream.set_read_timeout(moment).expect("it is open");
        let mut socket = WebSocket::from_raw_socket(stream, Role::Client, None);
        let (robot, _) = listener.accept().expect("somebody connected");
        let mut robot = WebSocket::from_raw_socket(robot, Role::Server, None);
        let long_ago = Instant::now().checked_sub(SILENCE + Duration::from_secs(1));
        let long_ago = long_ago.expect("this machine runs for a minute");

        let mut heard = Instant::now();
        assert!(read(&mut socket, &mut heard).is_ok());
        heard = long_ago;
        let silent = read(&mut socket, &mut heard).err();
        assert!(silent.is_some_and(|message| message.contains("nothing for 60 s")));
        let ping = Message::Ping(Vec::new().into());
        robot.send(ping).expect("the other end is open");
        let begin = Instant::now();
        while read(&mut socket, &mut heard).is_err() {
            assert!(begin.elapsed() < SILENCE, "the ping does not come");
        }
        assert!(heard > long_ago);
    }

    #[test]
    fn a_frame_is_read_and_others_are_not() {
        let mut bytes = b"HKG1".to_vec();
        bytes.extend(7_u32.to_le_bytes());
        bytes.extend(812_u64.to_le_bytes());
        bytes.extend(9_744_000_000_u64.to_le_bytes());
        bytes.push(1);
        let frame = Frame {
            subscription: 7,
            cycle: 812,
            time: 9_744_000_000,
            value: vec![1],
        };
        assert_eq!(Frame::read(&bytes), Some(frame));
        assert_eq!(Frame::read(&bytes[..23]), None);
        bytes[0] = b'X';
        assert_eq!(Frame::read(&bytes), None);
    }
}
