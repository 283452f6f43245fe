//! The zoo on its own threads with a server, and clients on real sockets.

use std::collections::VecDeque;
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use framework::launch::{Listening, Served};
use framework::parameters::Layers;
use framework::{Clock, Hardware as _, HardwareContext, Robot, Start, Stop, Threads};
use hulkgen_communication::{Limits, Server};
use serde_json::{Value, json};
use tempfile::TempDir;
use tungstenite::{Message, WebSocket};
use zoo_hardware::Hardware;
use zoo_runtime::parameters::Parameters;
use zoo_runtime::runtime;

/// Whoever waits longer waits for something that does not come.
pub(crate) const PATIENCE: Duration = Duration::from_secs(20);

/// A zoo that runs until it is dropped.
pub(crate) struct Zoo {
    server: Option<Server>,
    stop: Stop,
    runs: Option<JoinHandle<framework::Result<()>>>,
    /// Its parameters.
    pub(crate) folder: TempDir,
}

pub(crate) struct Client {
    socket: WebSocket<TcpStream>,
    next: u32,
    /// Messages that came while another was waited for.
    pub(crate) waiting: Vec<Value>,
    /// The rest of the last message, where it had several in it.
    pieces: VecDeque<Message>,
    pub(crate) welcome: Value,
}

/// Parameters of the repository, as files that may be changed.
pub(crate) fn copy_of_parameters() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let from = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/robots/zoo/parameters/default.toml"
    );
    std::fs::copy(from, folder.path().join("default.toml")).expect("the file is there");
    folder
}

impl Zoo {
    pub(crate) fn new() -> Self {
        Self::with(Listening::default(), Limits::default())
    }

    pub(crate) fn with(listening: Listening, limits: Limits) -> Self {
        let folder = copy_of_parameters();
        let layers = Layers {
            directory: folder.path().to_owned(),
            ..Layers::default()
        };
        let loaded = layers.load().expect("the file is there");
        let (clock, stop) = (Clock::wall(), Stop::new());
        let hardware = Hardware::new(HardwareContext {
            options: Vec::new(),
            table: loaded.hardware("loud").expect("there is a table"),
            run_folder: std::env::temp_dir(),
            clock: clock.clone(),
            stop: stop.clone(),
        });
        let hardware = Arc::new(hardware.expect("the zoo needs nothing"));
        let start = Start {
            clock: clock.clone(),
            stop: stop.clone(),
            parameters: loaded.deserialize().expect("the parameters fit"),
        };
        let mut robot: Robot<Parameters> =
            runtime::create(&hardware, start).expect("every node can be created");
        robot
            .parameters
            .came_from(layers, loaded)
            .expect("the files are there");
        let link = robot.link(&stop, framework::Rearm::default());
        let listening = Listening {
            target: "loud",
            address: listening
                .address
                .clone()
                .or_else(|| Some("127.0.0.1:0".to_owned())),
            ..listening
        };
        let server = Server::start(link, listening, limits).expect("a free port");
        let of_thread = stop.clone();
        let runs = thread::spawn(move || {
            Threads::new(&clock, hardware.as_ref(), &of_thread).run(&mut robot.instances)
        });
        Self {
            server: Some(server),
            stop,
            runs: Some(runs),
            folder,
        }
    }

    pub(crate) fn address(&self) -> SocketAddr {
        self.server.as_ref().expect("it runs").address()
    }

    pub(crate) fn client(&self) -> Client {
        Client::connect(self.address()).expect("the server lets it in")
    }

    /// Ends the server alone.
    pub(crate) fn stop_serving(&mut self) {
        self.server = None;
    }
}

impl Drop for Zoo {
    fn drop(&mut self) {
        self.stop.request();
        let ended = self.runs.take().map(JoinHandle::join);
        if !thread::panicking() {
            ended
                .expect("it ran")
                .expect("no thread panics")
                .expect("the robot does not fail");
        }
    }
}

pub(crate) fn stream(address: SocketAddr) -> TcpStream {
    let stream = TcpStream::connect(address).expect("the server listens");
    stream.set_read_timeout(Some(PATIENCE)).expect("a time-out");
    stream
        .set_write_timeout(Some(PATIENCE))
        .expect("a time-out");
    stream
}

impl Client {
    pub(crate) fn connect(address: SocketAddr) -> Result<Self, String> {
        let uri = format!("ws://{address}/socket");
        let connected = tungstenite::client(uri, stream(address));
        let (socket, _) = connected.map_err(|error| error.to_string())?;
        let mut client = Self {
            socket,
            next: 1,
            waiting: Vec::new(),
            pieces: VecDeque::new(),
            welcome: Value::Null,
        };
        client.welcome = client.receive()["welcome"].clone();
        Ok(client)
    }

    pub(crate) fn socket(&mut self) -> &mut WebSocket<TcpStream> {
        &mut self.socket
    }

    /// The next message of the robot; binary ones as their first bytes.
    pub(crate) fn receive(&mut self) -> Value {
        self.try_receive().expect("the robot speaks")
    }

    pub(crate) fn try_receive(&mut self) -> Result<Value, tungstenite::Error> {
        let started = Instant::now();
        loop {
            match self.piece()? {
                Message::Text(text) => {
                    return Ok(serde_json::from_str(text.as_str()).expect("JSON"));
                }
                Message::Binary(bytes) => {
                    let begin = &bytes[..bytes.len().min(256)];
                    return Ok(json!({ "bytes": begin }));
                }
                Message::Close(_) => return Err(tungstenite::Error::ConnectionClosed),
                // It only asks whether somebody is there.
                _ => assert!(started.elapsed() < PATIENCE, "no message came"),
            }
        }
    }

    /// The next message, or the next part of one that has several.
    fn piece(&mut self) -> Result<Message, tungstenite::Error> {
        if self.pieces.is_empty() {
            let message = self.socket.read()?;
            self.pieces.extend(pieces(message));
        }
        Ok(self.pieces.pop_front().expect("a message has a part"))
    }

    /// The next binary frame, as its head and its value; others wait or are dropped.
    pub(crate) fn frame(&mut self) -> (Vec<u8>, Vec<u8>) {
        loop {
            match self.piece().expect("the robot speaks") {
                Message::Binary(bytes) => {
                    let (head, value) = bytes.split_at(protocol::BINARY_HEADER);
                    return (head.to_vec(), value.to_vec());
                }
                Message::Text(text) => {
                    let message = serde_json::from_str(text.as_str());
                    self.waiting.push(message.expect("JSON"));
                }
                _ => {}
            }
        }
    }

    pub(crate) fn send(&mut self, text: &str) {
        self.socket
            .send(Message::text(text))
            .expect("the robot listens");
    }

    /// Asks without waiting; gives the number of the request.
    pub(crate) fn ask_later(&mut self, ask: &Value) -> u32 {
        let id = self.next;
        self.next += 1;
        self.send(&json!({ "id": id, "ask": ask }).to_string());
        id
    }

    /// What is answered, without its number; what else comes meanwhile waits.
    pub(crate) fn ask(&mut self, ask: Value) -> Value {
        let id = self.ask_later(&ask);
        self.answer(Some(id))
    }

    pub(crate) fn answer(&mut self, id: Option<u32>) -> Value {
        loop {
            let mut message = self.receive();
            match message.get_mut("answer") {
                Some(answer) if answer["id"] == json!(id) => {
                    answer.as_object_mut().expect("an object").remove("id");
                    return answer.take();
                }
                _ => self.waiting.push(message),
            }
        }
    }

    pub(crate) fn ok(&mut self, ask: Value) -> Value {
        let answer = self.ask(ask.clone());
        assert!(answer.get("ok").is_some(), "{ask}: {answer}");
        answer["ok"].clone()
    }

    pub(crate) fn error(&mut self, ask: Value) -> String {
        let answer = self.ask(ask.clone());
        let message = &answer["error"]["message"];
        message
            .as_str()
            .unwrap_or_else(|| panic!("{ask}: {answer}"))
            .to_owned()
    }

    pub(crate) fn subscribe(&mut self, path: &str) -> u32 {
        let answer = self.ok(json!({ "subscribe": { "path": path } }));
        number(&answer["subscribed"]["subscription"])
    }

    /// The next update of a subscription.
    pub(crate) fn update(&mut self, subscription: u32) -> Value {
        let started = Instant::now();
        let waits = |message: &Value| message["update"]["subscription"] == json!(subscription);
        if let Some(position) = self.waiting.iter().position(waits) {
            return self.waiting.remove(position)["update"].clone();
        }
        loop {
            let message = self.receive();
            if waits(&message) {
                return message["update"].clone();
            }
            assert!(started.elapsed() < PATIENCE, "no update came");
            self.waiting.push(message);
        }
    }
}

/// What a message has in it, for a client that asked for bundles, too.
pub(crate) fn pieces(message: Message) -> Vec<Message> {
    match message {
        Message::Text(text) if text.starts_with('[') => {
            let list: Vec<Value> = serde_json::from_str(text.as_str()).expect("JSON");
            let texts = list.into_iter().map(|one| Message::text(one.to_string()));
            texts.collect()
        }
        Message::Binary(bytes) if bytes.starts_with(&protocol::BUNDLE_MAGIC) => {
            let mut rest = &bytes[4..];
            let mut frames = Vec::new();
            while let Some((length, behind)) = rest.split_first_chunk() {
                let length = usize::try_from(u32::from_le_bytes(*length)).expect("small");
                let (frame, behind) = behind.split_at(length);
                frames.push(Message::binary(frame.to_vec()));
                rest = behind;
            }
            assert!(rest.is_empty(), "{rest:?}");
            frames
        }
        other => vec![other],
    }
}

pub(crate) fn number(value: &Value) -> u32 {
    let number = value
        .as_u64()
        .unwrap_or_else(|| panic!("{value} is no number"));
    u32::try_from(number).expect("small")
}

/// The cycle number in the header of a binary frame.
pub(crate) fn cycle_of_frame(message: &Value) -> u64 {
    let bytes = message["bytes"].as_array().expect("a list");
    let number = bytes[8..16].iter().rev();
    number.fold(0, |number, byte| {
        (number << 8) | byte.as_u64().expect("a byte")
    })
}

/// Asks again until it is so.
pub(crate) fn eventually(what: &str, mut is_so: impl FnMut() -> bool) {
    let started = Instant::now();
    while !is_so() {
        assert!(started.elapsed() < PATIENCE, "{what}");
        thread::sleep(Duration::from_millis(20));
    }
}
