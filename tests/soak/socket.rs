//! A client's end of docs/protocol.md.

use std::net::{SocketAddr, TcpStream};
use std::time::{Duration, Instant};

use protocol::{Ask, Good, Message, Outcome, Request, SOCKET};
use tungstenite::WebSocket;

use crate::Result;

/// A robot that does not answer within this time does not answer.
const PATIENCE: Duration = Duration::from_secs(30);

/// How long one look at the socket takes.
const MOMENT: Duration = Duration::from_millis(50);

/// A connection to the robot.
pub(crate) struct Socket {
    socket: WebSocket<TcpStream>,
    next_id: u32,
    /// What came while an answer was awaited.
    waiting: Vec<Heard>,
}

/// What the robot says without being asked anew.
pub(crate) enum Heard {
    Message(Message),
    /// A binary frame, whole.
    Bytes(Vec<u8>),
}

impl Socket {
    /// Connects and is welcomed.
    pub(crate) fn open(address: SocketAddr) -> Result<Self> {
        let stream = TcpStream::connect(address).map_err(|error| error.to_string())?;
        let set = stream.set_read_timeout(Some(PATIENCE));
        set.map_err(|error| error.to_string())?;
        let url = format!("ws://{address}{SOCKET}");
        let (socket, _) =
            tungstenite::client(url, stream).map_err(|error| format!("handshake: {error}"))?;
        let set = socket.get_ref().set_read_timeout(Some(MOMENT));
        set.map_err(|error| error.to_string())?;
        let mut client = Self {
            socket,
            next_id: 1,
            waiting: Vec::new(),
        };
        let end = Instant::now() + PATIENCE;
        while Instant::now() < end {
            match client.read()? {
                Some(Heard::Message(Message::Welcome(_))) => return Ok(client),
                Some(_) => return Err("something came before the welcome".to_owned()),
                None => {}
            }
        }
        Err("no welcome".to_owned())
    }

    /// The answer, or the robot's own words why there is none.
    pub(crate) fn ask(&mut self, ask: Ask) -> Result<Good> {
        let id = self.next_id;
        self.next_id += 1;
        let text =
            serde_json::to_string(&Request { id, ask }).map_err(|error| error.to_string())?;
        let sent = self.socket.send(tungstenite::Message::text(text));
        sent.map_err(|error| format!("cannot be sent: {error}"))?;
        let end = Instant::now() + PATIENCE;
        while Instant::now() < end {
            match self.read()? {
                Some(Heard::Message(Message::Answer(answer))) if answer.id == Some(id) => {
                    return match answer.outcome {
                        Outcome::Ok(good) => Ok(*good),
                        Outcome::Error(failure) => Err(failure.message),
                    };
                }
                Some(heard) => self.waiting.push(heard),
                None => {}
            }
        }
        Err("no answer".to_owned())
    }

    /// What was said until now, waiting for a moment.
    pub(crate) fn hear(&mut self) -> Result<Vec<Heard>> {
        let mut heard = std::mem::take(&mut self.waiting);
        heard.extend(self.read()?);
        Ok(heard)
    }

    fn read(&mut self) -> Result<Option<Heard>> {
        match self.socket.read() {
            Ok(tungstenite::Message::Text(text)) => {
                let message = serde_json::from_str(text.as_str());
                Ok(Some(Heard::Message(
                    message.map_err(|error| error.to_string())?,
                )))
            }
            Ok(tungstenite::Message::Binary(bytes)) => Ok(Some(Heard::Bytes(bytes.to_vec()))),
            Ok(_) => Ok(None),
            Err(tungstenite::Error::Io(error))
                if matches!(
                    error.kind(),
                    std::io::ErrorKind::WouldBlock | std::io::ErrorKind::TimedOut
                ) =>
            {
                Ok(None)
            }
            Err(error) => Err(format!("the robot went away: {error}")),
        }
    }
}
