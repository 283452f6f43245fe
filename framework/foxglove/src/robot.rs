//! The connection to the robot, as docs/protocol.md describes it.

use std::collections::VecDeque;
use std::io::ErrorKind;
use std::net::TcpStream;
use std::time::{Duration, Instant};

use protocol::{
    Ask, BINARY_HEADER, BINARY_MAGIC, Good, Message, Outcome, Request, SOCKET, Welcome,
};
use tungstenite::{Error, WebSocket};

use crate::Result;

/// A robot that does not answer within this time is not there.
const PATIENCE: Duration = Duration::from_secs(10);

/// How long the robot is listened to before something else is looked at.
const MOMENT: Duration = Duration::from_millis(5);

/// A running robot.
pub(crate) struct Robot {
    socket: WebSocket<TcpStream>,
    next_id: u32,
    /// What came while an answer was awaited.
    waiting: VecDeque<Heard>,
    pub(crate) welcome: Welcome,
}

/// What a robot says without being asked anew.
pub(crate) enum Heard {
    Message(Message),
    Frame(Frame),
}

/// A value in bytes.
pub(crate) struct Frame {
    pub(crate) subscription: u32,
    /// In nanoseconds of the robot's clock.
    pub(crate) time: u64,
    pub(crate) value: Vec<u8>,
}

impl Robot {
    pub(crate) fn connect(host: &str, token: Option<&str>) -> Result<Self> {
        let absent = |error: String| {
            format!(
                "no robot answers at {host}: {error}; start one with `hulkgen run`, or say where it is with `--host ADDRESS:PORT`"
            )
        };
        let stream = TcpStream::connect(host).map_err(|error| absent(error.to_string()))?;
        let set = stream.set_read_timeout(Some(PATIENCE));
        set.and_then(|()| stream.set_nodelay(true))
            .map_err(|error| absent(error.to_string()))?;
        let (mut socket, _) = tungstenite::client(format!("ws://{host}{SOCKET}"), stream)
            .map_err(|error| absent(error.to_string()))?;
        let welcome = match read(&mut socket)? {
            Some(Heard::Message(Message::Welcome(welcome))) => welcome,
            _ => return Err(absent("what answers is no robot".to_owned())),
        };
        let set = socket.get_ref().set_read_timeout(Some(MOMENT));
        set.map_err(|error| absent(error.to_string()))?;
        let mut robot = Self {
            socket,
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

    /// The answer, or the robot's own words why there is none.
    pub(crate) fn ask(&mut self, ask: Ask) -> Result<Good> {
        let id = self.next_id;
        self.next_id = self.next_id.wrapping_add(1);
        let request = Request { id, ask };
        let text = serde_json::to_string(&request).map_err(|error| error.to_string())?;
        let sent = self.socket.send(tungstenite::Message::text(text));
        sent.map_err(|error| gone(&error))?;
        let end = Instant::now() + PATIENCE;
        while Instant::now() < end {
            match read(&mut self.socket)? {
                Some(Heard::Message(Message::Answer(answer))) if answer.id == Some(id) => {
                    return match answer.outcome {
                        Outcome::Ok(good) => Ok(*good),
                        Outcome::Error(failure) => Err(failure.message),
                    };
                }
                Some(heard) => self.waiting.push_back(heard),
                None => {}
            }
        }
        Err("the robot does not answer".to_owned())
    }

    /// What the robot says next, if it says something at the moment.
    pub(crate) fn hear(&mut self) -> Result<Option<Heard>> {
        match self.waiting.pop_front() {
            Some(heard) => Ok(Some(heard)),
            None => read(&mut self.socket),
        }
    }
}

fn read(socket: &mut WebSocket<TcpStream>) -> Result<Option<Heard>> {
    match socket.read() {
        // A robot of a later version may say what we do not know.
        Ok(tungstenite::Message::Text(text)) => {
            Ok(serde_json::from_str(text.as_str()).ok().map(Heard::Message))
        }
        Ok(tungstenite::Message::Binary(bytes)) => Ok(Frame::read(&bytes).map(Heard::Frame)),
        Ok(_) => Ok(None),
        Err(Error::Io(error))
            if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) =>
        {
            Ok(None)
        }
        Err(error) => Err(gone(&error)),
    }
}

fn gone(error: &Error) -> String {
    format!("the robot went away: {error}")
}

impl Frame {
    fn read(bytes: &[u8]) -> Option<Self> {
        let (head, value) = bytes.split_at_checked(BINARY_HEADER)?;
        let (magic, rest) = head.split_first_chunk()?;
        let (subscription, rest) = rest.split_first_chunk()?;
        let (_cycle, rest) = rest.split_first_chunk::<8>()?;
        let (time, _) = rest.split_first_chunk()?;
        (*magic == BINARY_MAGIC).then(|| Self {
            subscription: u32::from_le_bytes(*subscription),
            time: u64::from_le_bytes(*time),
            value: value.to_vec(),
        })
    }
}
