//! The connection of a program to a running robot, as docs/protocol.md describes it.
//!
//! Invariant: nothing waits for the robot without an end, and what is kept of what it says is bounded.

#![warn(missing_docs)]

mod address;
mod error;
mod frame;

use std::collections::VecDeque;
use std::io::ErrorKind;
use std::net::TcpStream;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use protocol::{Answer, Ask, Good, Message, Outcome, Request, SOCKET, VERSION, Welcome};
use tungstenite::WebSocket;
use tungstenite::error::CapacityError;
use tungstenite::protocol::WebSocketConfig;

pub use self::error::{Error, Why};
pub use self::frame::Frame;

/// A robot that does not answer within this time is not there.
const PATIENCE: Duration = Duration::from_secs(10);

/// How long the robot is listened to before something else is looked at.
const MOMENT: Duration = Duration::from_millis(5);

/// A robot pings every 20 s; one that says nothing for so long has gone without a word.
const SILENCE: Duration = Duration::from_secs(60);

/// No answer is awaited longer: a day.
const LONGEST: Duration = Duration::from_secs(86_400);

/// Messages that are kept while an answer is awaited; of more the oldest are lost.
const KEPT: usize = 4096;

/// Bytes of what a robot says at once: the answer to a `read` is as long as the value.
const LARGEST: usize = 64 << 20;

/// A running robot.
pub struct Robot {
    socket: WebSocket<TcpStream>,
    address: String,
    /// When it said something last.
    heard: Instant,
    /// When its clock began, in nanoseconds since 1970.
    start: u64,
    next_id: u32,
    /// What came while an answer was awaited.
    waiting: VecDeque<Heard>,
    /// Its first words.
    pub welcome: Welcome,
}

/// What a robot says without being waited for.
#[derive(Debug)]
pub enum Heard {
    /// In JSON.
    Message(Message),
    /// In bytes.
    Frame(Frame),
}

impl Robot {
    /// Finds the robot, hears its welcome, and shows the token if there is one. A host without a port has the robot's own.
    ///
    /// # Errors
    /// If nobody answers there, no robot, one of another version, or the token is wrong.
    pub fn connect(host: &str, token: Option<&str>) -> Result<Self, Error> {
        let address = address::complete(host);
        let wrong = |why| Error {
            address: address.clone(),
            why,
        };
        let absent = |reason: String| wrong(Why::Absent(reason));
        let stream = address::reach(&address).map_err(absent)?;
        stream
            .set_read_timeout(Some(PATIENCE))
            .and_then(|()| stream.set_write_timeout(Some(PATIENCE)))
            .and_then(|()| stream.set_nodelay(true))
            .map_err(|error| absent(error.to_string()))?;
        let uri = format!("ws://{address}{SOCKET}");
        let sizes = WebSocketConfig::default()
            .max_message_size(Some(LARGEST))
            .max_frame_size(Some(LARGEST));
        let (mut socket, _) = tungstenite::client::client_with_config(uri, stream, Some(sizes))
            .map_err(|error| absent(error.to_string()))?;
        let mut heard = Instant::now();
        let first = hear(&mut socket, &mut heard, Instant::now() + PATIENCE).map_err(wrong)?;
        let welcome = match first {
            Some(Heard::Message(Message::Welcome(welcome))) if welcome.version == VERSION => {
                welcome
            }
            Some(Heard::Message(Message::Welcome(welcome))) => {
                return Err(wrong(Why::Foreign(welcome.version)));
            }
            Some(_) => return Err(wrong(Why::Confused)),
            None => return Err(wrong(Why::Silent)),
        };
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        let now = now.map_or(0, |now| u64::try_from(now.as_nanos()).unwrap_or_default());
        let mut robot = Self {
            socket,
            address,
            heard,
            start: now.saturating_sub(welcome.time),
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

    /// A time in nanoseconds since 1970 on the robot's clock, as [`Robot::since_1970`]; `None`: it had not started then.
    pub fn since_start(&self, since_1970: u64) -> Option<u64> {
        since_1970.checked_sub(self.start)
    }

    /// What the robot says makes no sense to the caller.
    pub fn confused(&self) -> Error {
        self.error(Why::Confused)
    }

    /// Asks without waiting; the answer comes with this number, see [`Robot::hear`].
    ///
    /// # Errors
    /// If the robot went away.
    pub fn send(&mut self, ask: Ask) -> Result<u32, Error> {
        let id = self.next_id;
        self.next_id = self.next_id.wrapping_add(1);
        let text = serde_json::to_string(&Request { id, ask }).expect("requests are JSON");
        let sent = self.socket.send(tungstenite::Message::text(text));
        sent.map_err(|error| self.error(gone(&error)))?;
        Ok(id)
    }

    /// The answer, or the robot's own words why there is none.
    ///
    /// # Errors
    /// If the robot refuses, does not answer or went away.
    pub fn ask(&mut self, ask: Ask) -> Result<Good, Error> {
        self.ask_for(ask, Duration::ZERO)
    }

    /// As [`Robot::ask`], for what may take the robot so long.
    ///
    /// # Errors
    /// As [`Robot::ask`].
    pub fn ask_for(&mut self, ask: Ask, duration: Duration) -> Result<Good, Error> {
        let id = self.send(ask)?;
        let end = Instant::now() + PATIENCE + duration.min(LONGEST);
        loop {
            match self.hear_new(end)? {
                // What is so wrong that its number cannot be read is refused without one.
                Some(Heard::Message(Message::Answer(Answer {
                    id: own,
                    outcome: Outcome::Error(failure),
                }))) if own.is_none_or(|own| own == id) => {
                    return Err(self.error(Why::Refused(failure)));
                }
                Some(Heard::Message(Message::Answer(Answer {
                    id: Some(own),
                    outcome: Outcome::Ok(good),
                }))) if own == id => return Ok(*good),
                Some(heard) => {
                    if self.waiting.len() == KEPT {
                        self.waiting.pop_front();
                    }
                    self.waiting.push_back(heard);
                }
                None => return Err(self.error(Why::Silent)),
            }
        }
    }

    /// What the robot says next, if it says something at the moment.
    ///
    /// # Errors
    /// If the robot went away, or says what makes no sense.
    pub fn hear(&mut self) -> Result<Option<Heard>, Error> {
        self.hear_before(Instant::now() + MOMENT)
    }

    /// What the robot says next, if it says something before that time.
    ///
    /// # Errors
    /// As [`Robot::hear`].
    pub fn hear_before(&mut self, end: Instant) -> Result<Option<Heard>, Error> {
        match self.waiting.pop_front() {
            Some(heard) => Ok(Some(heard)),
            None => self.hear_new(end),
        }
    }

    fn hear_new(&mut self, end: Instant) -> Result<Option<Heard>, Error> {
        hear(&mut self.socket, &mut self.heard, end).map_err(|why| self.error(why))
    }

    fn error(&self, why: Why) -> Error {
        Error {
            address: self.address.clone(),
            why,
        }
    }
}

impl Drop for Robot {
    /// Says goodbye, so that the robot need not find out; one that went away needs none.
    fn drop(&mut self) {
        let _ = self.socket.close(None);
        let _ = self.socket.flush();
    }
}

/// What comes before that time and is known; `heard` is when anything came.
fn hear(
    socket: &mut WebSocket<TcpStream>,
    heard: &mut Instant,
    end: Instant,
) -> Result<Option<Heard>, Why> {
    loop {
        let left = end.saturating_duration_since(Instant::now()).min(SILENCE);
        if left.is_zero() {
            return Ok(None);
        }
        let set = socket.get_ref().set_read_timeout(Some(left));
        set.map_err(|error| Why::Gone(error.to_string()))?;
        let message = match socket.read() {
            Ok(message) => message,
            Err(tungstenite::Error::Io(error))
                if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) =>
            {
                if heard.elapsed() > SILENCE {
                    let seconds = SILENCE.as_secs();
                    return Err(Why::Gone(format!("it said nothing for {seconds} s")));
                }
                continue;
            }
            Err(error) => return Err(gone(&error)),
        };
        *heard = Instant::now();
        match message {
            tungstenite::Message::Text(text) => match serde_json::from_str(text.as_str()) {
                Ok(message) => return Ok(Some(Heard::Message(message))),
                // A robot of a later version may say what we do not know; an answer is none of that.
                Err(_) if !text.as_str().contains("\"answer\"") => {}
                Err(_) => return Err(Why::Confused),
            },
            tungstenite::Message::Binary(bytes) => {
                let frame = Frame::read(&bytes).ok_or(Why::Confused)?;
                return Ok(Some(Heard::Frame(frame)));
            }
            // Pings are answered by the library.
            _ => {}
        }
    }
}

fn gone(error: &tungstenite::Error) -> Why {
    Why::Gone(match error {
        tungstenite::Error::Capacity(CapacityError::MessageTooLong { size, max_size }) => format!(
            "it said {size} bytes at once, of which this program takes {max_size}: ask for a part of the value"
        ),
        error => error.to_string(),
    })
}

#[cfg(test)]
mod tests {
    use std::io::Write;
    use std::net::{TcpListener, TcpStream};
    use std::time::{Duration, Instant};

    use protocol::{BINARY_HEADER, BINARY_MAGIC, VERSION, Welcome};
    use tungstenite::protocol::Role;
    use tungstenite::{Message, WebSocket};

    use super::{Heard, LARGEST, MOMENT, PATIENCE, Robot, SILENCE, Why, hear};

    #[test]
    fn a_silent_robot_is_gone_and_a_ping_is_a_word() {
        let listener = TcpListener::bind("127.0.0.1:0").expect("there is a free port");
        let address = listener.local_addr().expect("it is bound");
        let stream = TcpStream::connect(address).expect("it is listened to");
        let mut socket = WebSocket::from_raw_socket(stream, Role::Client, None);
        let (robot, _) = listener.accept().expect("somebody connected");
        let mut robot = WebSocket::from_raw_socket(robot, Role::Server, None);
        let long_ago = Instant::now().checked_sub(SILENCE + Duration::from_secs(1));
        let long_ago = long_ago.expect("this machine runs for a minute");
        let mut listen = |heard: &mut Instant| hear(&mut socket, heard, Instant::now() + MOMENT);

        let mut heard = Instant::now();
        assert!(listen(&mut heard).is_ok());
        heard = long_ago;
        let silent = listen(&mut heard).err();
        assert!(matches!(silent, Some(Why::Gone(reason)) if reason.contains("nothing for 60 s")));
        let ping = Message::Ping(Vec::new().into());
        robot.send(ping).expect("the other end is open");
        let begin = Instant::now();
        while listen(&mut heard).is_err() {
            assert!(begin.elapsed() < SILENCE, "the ping does not come");
        }
        assert!(heard > long_ago);
    }

    /// Says that it is a robot, a frame with so long a value, and the head of one that is too long.
    fn says_long_frames(listener: &TcpListener, value: usize) {
        let (stream, _) = listener.accept().expect("somebody connected");
        let mut socket = tungstenite::accept(stream).expect("it speaks our protocol");
        let welcome = protocol::Message::Welcome(Welcome {
            version: VERSION,
            robot: "lamp".to_owned(),
            target: "desk".to_owned(),
            instances: Vec::new(),
            can_write: true,
            needs_token: false,
            time: 0,
            run: None,
            peers: Vec::new(),
        });
        let welcome = serde_json::to_string(&welcome).expect("it is JSON");
        let mut frame = BINARY_MAGIC.to_vec();
        frame.resize(BINARY_HEADER + value, 0);
        for message in [Message::text(welcome), Message::binary(frame)] {
            socket.send(message).expect("the other end is open");
        }
        let mut head = vec![0x82, 127];
        head.extend_from_slice(&(LARGEST as u64 + 1).to_be_bytes());
        let written = socket.get_mut().write_all(&head);
        written.expect("the other end is open");
        // It stays until the other end has gone.
        let _ = socket.read();
    }

    #[test]
    fn long_messages_come_and_of_too_long_ones_the_size_is_told() {
        let listener = TcpListener::bind("127.0.0.1:0").expect("there is a free port");
        let address = listener.local_addr().expect("it is bound").to_string();
        // Longer than the library would take by itself.
        let value = 17 << 20;
        let said = std::thread::spawn(move || says_long_frames(&listener, value));
        let mut robot = Robot::connect(&address, None).expect("it is a robot");
        let frame = robot.hear_before(Instant::now() + PATIENCE);
        let frame = frame.expect("the robot is there").expect("it comes");
        assert!(matches!(frame, Heard::Frame(frame) if frame.value.len() == value));
        let error = robot.hear_before(Instant::now() + PATIENCE);
        let error = error.expect_err("it is too long").to_string();
        assert!(error.contains("said 67108865 bytes at once"), "{error}");
        drop(robot);
        said.join().expect("it said everything");
    }
}
