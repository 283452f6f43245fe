//! Keeps the connection to the controller: looks for it, reads its lines, and sends it the newest command.
//!
//! Invariant: nothing that the controller says or leaves out ends this, and no node waits for it to listen.

use std::io::{BufRead as _, BufReader, ErrorKind, Read as _, Write as _};
use std::net::{TcpStream, ToSocketAddrs as _};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use framework::Clock;

use crate::inbox::Inbox;
use crate::line::{self, LONGEST};

/// How long one read may block: the end is noticed after at most this time.
const MOMENT: Duration = Duration::from_millis(50);

/// How long a command may block; a controller that does not listen so long is connected to anew.
const IMPATIENCE: Duration = Duration::from_millis(5);

/// Without a line for so long the controller is gone.
const SILENCE: Duration = Duration::from_secs(1);

/// For an attempt to connect, and between two.
const BACK_OFF: Duration = Duration::from_millis(250);

/// Lines in a row that make no sense: the other end is no controller, or one that lost its place.
const REFUSED_IN_A_ROW: u32 = 10;

/// What came from the controller since the start.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub struct Counts {
    /// How often it answered.
    pub connections: u64,
    /// Lines that made sense.
    pub lines: u64,
    /// Those that did not, or were too long.
    pub refused: u64,
    /// Commands that it did not get.
    pub lost: u64,
}

/// A connection that mends itself.
#[derive(Debug)]
pub(crate) struct Connection {
    address: String,
    clock: Clock,
    pub(crate) inbox: Inbox,
    writing: Mutex<Writing>,
    is_over: AtomicBool,
    connections: AtomicU64,
    lines: AtomicU64,
    refused: AtomicU64,
    lost: AtomicU64,
}

#[derive(Debug, Default)]
struct Writing {
    stream: Option<TcpStream>,
    /// In safe state nobody may command it.
    is_safe: bool,
}

impl Connection {
    pub(crate) fn new(address: String, clock: Clock) -> Self {
        Self {
            address,
            clock,
            inbox: Inbox::new(),
            writing: Mutex::default(),
            is_over: AtomicBool::new(false),
            connections: AtomicU64::new(0),
            lines: AtomicU64::new(0),
            refused: AtomicU64::new(0),
            lost: AtomicU64::new(0),
        }
    }

    // Each counter stands for itself and the flag guards nothing: `Relaxed` everywhere.

    pub(crate) fn counts(&self) -> Counts {
        Counts {
            connections: self.connections.load(Ordering::Relaxed),
            lines: self.lines.load(Ordering::Relaxed),
            refused: self.refused.load(Ordering::Relaxed),
            lost: self.lost.load(Ordering::Relaxed),
        }
    }

    pub(crate) fn end(&self) {
        self.is_over.store(true, Ordering::Relaxed);
    }

    fn is_over(&self) -> bool {
        self.is_over.load(Ordering::Relaxed)
    }

    /// Until [`Connection::end`].
    pub(crate) fn keep(&self) {
        while !self.is_over() {
            let ended = match self.reach() {
                Ok(stream) => {
                    self.connections.fetch_add(1, Ordering::Relaxed);
                    self.listen(stream)
                }
                Err(error) => format!("does not answer: {error}"),
            };
            self.lock().stream = None;
            let address = &self.address;
            let trouble = format!("the base at {address} {ended}");
            self.inbox.tell_trouble(trouble);
            let begin = Instant::now();
            while begin.elapsed() < BACK_OFF && !self.is_over() {
                std::thread::sleep(MOMENT);
            }
        }
    }

    fn reach(&self) -> std::io::Result<TcpStream> {
        let mut addresses = self.address.to_socket_addrs()?;
        let address = addresses.next().ok_or(ErrorKind::AddrNotAvailable)?;
        let stream = TcpStream::connect_timeout(&address, BACK_OFF)?;
        stream.set_nodelay(true)?;
        stream.set_read_timeout(Some(MOMENT))?;
        stream.set_write_timeout(Some(IMPATIENCE))?;
        self.lock().stream = Some(stream.try_clone()?);
        Ok(stream)
    }

    /// Says why there is nothing more to hear.
    fn listen(&self, stream: TcpStream) -> String {
        let mut stream = BufReader::new(stream);
        let (mut bytes, mut heard, mut refused) = (Vec::new(), Instant::now(), 0);
        while !self.is_over() {
            let left = LONGEST - bytes.len();
            // What came before a time-out stays.
            let read = stream
                .by_ref()
                .take(left as u64)
                .read_until(b'\n', &mut bytes);
            match read {
                Ok(0) => return "closed the connection".to_owned(),
                Ok(_) if bytes.ends_with(b"\n") => {
                    heard = Instant::now();
                    refused = if self.take(&bytes) { 0 } else { refused + 1 };
                    bytes.clear();
                    if refused == REFUSED_IN_A_ROW {
                        return "says what no controller says".to_owned();
                    }
                }
                Ok(_) if bytes.len() == LONGEST => {
                    self.refused.fetch_add(1, Ordering::Relaxed);
                    return format!("says lines of more than {LONGEST} bytes");
                }
                Ok(_) => {}
                Err(error) if is_time_out(&error) => {}
                Err(error) => return format!("is gone: {error}"),
            }
            if heard.elapsed() > SILENCE {
                return "is silent".to_owned();
            }
        }
        "was left".to_owned()
    }

    /// One line; whether it made sense.
    fn take(&self, bytes: &[u8]) -> bool {
        let line = line::read(bytes);
        let makes_sense = line.is_some();
        let counter = match makes_sense {
            true => &self.lines,
            false => &self.refused,
        };
        counter.fetch_add(1, Ordering::Relaxed);
        if let Some(line) = line {
            self.inbox.put(self.clock.now(), line);
        }
        makes_sense
    }

    /// Sends a command unless nobody may; what does not go through is lost, and the next is newer.
    pub(crate) fn command(&self, line: &str) {
        let mut writing = self.lock();
        if !writing.is_safe {
            self.send(&mut writing, line);
        }
    }

    /// From here on commands are dropped, or no longer.
    pub(crate) fn set_safe(&self, is_safe: bool) {
        let mut writing = self.lock();
        writing.is_safe = is_safe;
        if is_safe {
            self.send(&mut writing, line::STOP);
        }
    }

    fn send(&self, writing: &mut Writing, line: &str) {
        let sent = writing.stream.as_mut();
        let sent = sent.is_some_and(|stream| stream.write_all(line.as_bytes()).is_ok());
        if !sent {
            self.lost.fetch_add(1, Ordering::Relaxed);
            // Half a line may have gone: the thread that listens connects anew.
            if let Some(stream) = writing.stream.take() {
                let _ = stream.shutdown(std::net::Shutdown::Both);
            }
        }
    }

    /// Nothing behind the lock can be half done.
    fn lock(&self) -> MutexGuard<'_, Writing> {
        self.writing.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn is_time_out(error: &std::io::Error) -> bool {
    use ErrorKind::{Interrupted, TimedOut, WouldBlock};
    matches!(error.kind(), Interrupted | TimedOut | WouldBlock)
}
