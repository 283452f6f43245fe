//! Cameras and microphones of another process: the reading end of [`links::senses`].
//!
//! Their clock is not ours. A message counts as taken when it was taken, by their clock, plus the least time that any
//! message of the last second seems to have been on its way; so jitter of the way is no jitter of the times.

use std::io::{ErrorKind, Read};
use std::os::unix::net::UnixStream;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use framework::{Clock, NoEvent, Result, Stop, Timestamp, blocking};
use links::senses::{HEADER_LENGTH, Header, Kind};

/// How long one read may block: a stop is noticed after at most this time.
const PATIENCE: Duration = Duration::from_millis(50);
/// After so much silence the caller hears about it.
const SILENCE: Duration = Duration::from_secs(1);
/// Between attempts to connect.
const BACK_OFF: Duration = Duration::from_millis(500);
/// How long a message counts at least for how the clocks differ, and twice as long at most: 15 images, or 10 blocks of sound.
const SPAN: Duration = Duration::from_millis(500);
/// No message is longer: an image of 1280 by 960.
const LONGEST: u32 = 1280 * 960 * 2;

/// A connection that mends itself.
pub(crate) struct Remote {
    path: PathBuf,
    kind: Kind,
    connection: Option<Connection>,
    next_attempt: Instant,
}

struct Connection {
    stream: UnixStream,
    header: [u8; HEADER_LENGTH],
    /// Bytes of the header that have come.
    received: usize,
    /// Bytes of what follows it that have come.
    followed: usize,
    offset: Offset,
}

/// Our clock less theirs, in ns, as the quickest message of late saw it.
///
/// Older ones do not count: a world that waits for the answers of its program has a slower clock than ours.
struct Offset {
    since: Timestamp,
    least: i128,
    /// The least of the span that ended at `since`.
    before: i128,
}

impl Remote {
    /// Connects as soon as somebody reads.
    pub(crate) fn new(path: PathBuf, kind: Kind) -> Self {
        Self {
            path,
            kind,
            connection: None,
            next_attempt: Instant::now(),
        }
    }

    /// Waits for the next message: when it was taken, and its size; `bytes` is what it brings.
    ///
    /// # Errors
    /// `Stopped` within 100 ms of a stop; `NoEvent` where nobody is there, nothing comes, or it is garbled: ask again.
    pub(crate) fn read(
        &mut self,
        bytes: &mut Vec<u8>,
        clock: &Clock,
        stop: &Stop,
    ) -> Result<(Timestamp, [u32; 2])> {
        self.connect(stop)?;
        let begun = Instant::now();
        while begun.elapsed() < SILENCE {
            stop.check()?;
            let Some(connection) = &mut self.connection else {
                break;
            };
            match blocking(|| connection.receive(self.kind, bytes)) {
                Ok(Some(header)) => return Ok((connection.time(&header, clock), header.size)),
                Ok(None) => {}
                Err(reason) => {
                    self.connection = None;
                    return Err(self.trouble(&reason));
                }
            }
        }
        Err(self.trouble("nothing comes"))
    }

    fn connect(&mut self, stop: &Stop) -> Result<()> {
        if self.connection.is_some() {
            return Ok(());
        }
        let left = self.next_attempt.saturating_duration_since(Instant::now());
        blocking(|| stop.wait(left))?;
        self.next_attempt = Instant::now() + BACK_OFF;
        let connected = UnixStream::connect(&self.path).and_then(|stream| {
            stream.set_read_timeout(Some(PATIENCE))?;
            Ok(stream)
        });
        match connected {
            Ok(stream) => {
                self.connection = Some(Connection {
                    stream,
                    header: [0; HEADER_LENGTH],
                    received: 0,
                    followed: 0,
                    offset: Offset::new(),
                });
                Ok(())
            }
            Err(error) => Err(self.trouble(&error.to_string())),
        }
    }

    fn trouble(&self, what: &str) -> framework::Error {
        NoEvent(format!("{}: {what}", self.path.display())).into()
    }
}

impl Connection {
    /// Takes what has come, waiting for at most [`PATIENCE`]; the header of a message that is whole.
    fn receive(&mut self, kind: Kind, bytes: &mut Vec<u8>) -> Result<Option<Header>, String> {
        if self.received < HEADER_LENGTH {
            self.received += read(&mut self.stream, &mut self.header[self.received..])?;
            if self.received < HEADER_LENGTH {
                return Ok(None);
            }
        }
        let header = Header::decode(&self.header)
            .filter(|header| header.kind == kind && header.length <= LONGEST)
            .ok_or("what comes is not what was expected")?;
        let length = header.length as usize;
        bytes.resize(length, 0);
        self.followed += read(&mut self.stream, &mut bytes[self.followed..])?;
        if self.followed < length {
            return Ok(None);
        }
        (self.received, self.followed) = (0, 0);
        Ok(Some(header))
    }

    fn time(&mut self, header: &Header, clock: &Clock) -> Timestamp {
        self.offset
            .time(Timestamp::from_nanos(header.at), clock.now())
    }
}

impl Offset {
    /// Until the first message nothing is known.
    fn new() -> Self {
        Self {
            since: Timestamp::ZERO,
            least: i128::MAX,
            before: i128::MAX,
        }
    }

    /// By our clock: when something was taken that came just now and was taken `at` by theirs.
    fn time(&mut self, at: Timestamp, now: Timestamp) -> Timestamp {
        if now - self.since >= SPAN {
            self.before = std::mem::replace(&mut self.least, i128::MAX);
            self.since = now;
        }
        let at = i128::from(at.as_nanos());
        self.least = self.least.min(i128::from(now.as_nanos()) - at);
        let offset = self.least.min(self.before);
        Timestamp::from_nanos(u64::try_from(at + offset).unwrap_or(0))
    }
}

/// How much came; 0 where nothing did in time.
fn read(stream: &mut UnixStream, bytes: &mut [u8]) -> Result<usize, String> {
    if bytes.is_empty() {
        return Ok(0);
    }
    match stream.read(bytes) {
        Ok(0) => Err("the other side has gone".to_owned()),
        Ok(count) => Ok(count),
        Err(error) => match error.kind() {
            ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted => Ok(0),
            _ => Err(error.to_string()),
        },
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;
    use std::os::unix::net::UnixListener;

    use super::*;

    struct World {
        _folder: tempfile::TempDir,
        listener: UnixListener,
        remote: Remote,
        clock: Clock,
        stop: Stop,
    }

    impl World {
        fn new() -> Self {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("top");
            Self {
                listener: UnixListener::bind(&path).unwrap(),
                _folder: folder,
                remote: Remote::new(path, Kind::Image),
                clock: Clock::wall(),
                stop: Stop::new(),
            }
        }

        fn read(&mut self, bytes: &mut Vec<u8>) -> Result<(Timestamp, [u32; 2])> {
            self.remote.read(bytes, &self.clock, &self.stop)
        }
    }

    fn message(at: u64) -> Vec<u8> {
        let mut message = Header::new(Kind::Image, at, [4, 2]).encode().to_vec();
        message.extend([9; 16]);
        message
    }

    #[test]
    fn messages_come_in_pieces_and_after_a_restart_of_the_other_side() {
        let mut world = World::new();
        let mut bytes = Vec::new();
        assert!(world.remote.connect(&world.stop).is_ok());
        let (mut other, _) = world.listener.accept().unwrap();
        for piece in message(500_000_000_000).chunks(7) {
            other.write_all(piece).unwrap();
        }
        let (at, size) = world.read(&mut bytes).unwrap();
        assert_eq!((size, bytes.len()), ([4, 2], 16));
        assert!(at <= world.clock.now());
        drop(other);
        assert!(world.read(&mut bytes).unwrap_err().is_no_event());
        world.remote.connect(&world.stop).unwrap();
        let (mut other, _) = world.listener.accept().unwrap();
        other.write_all(&message(3)).unwrap();
        assert!(
            world.read(&mut bytes).unwrap().0 > at,
            "their clock began anew"
        );
    }

    fn at(milliseconds: u64) -> Timestamp {
        Timestamp::from_nanos(milliseconds * 1_000_000)
    }

    #[test]
    fn a_clock_that_is_slower_than_ours_does_not_fall_behind() {
        let mut offset = Offset::new();
        // Images of a world that takes 30 ms for 12 of its own: two and a half times as long.
        for image in 0..720 {
            let (theirs, ours) = (at(image * 34), at(image * 85));
            let late = ours - offset.time(theirs, ours);
            assert!(late <= SPAN * 2, "{image}: {late:?}");
        }
    }

    #[test]
    fn jitter_of_the_way_is_no_jitter_of_the_times() {
        let mut offset = Offset::new();
        offset.time(at(1000), at(5002));
        for image in 1..300 {
            let taken = 1000 + 33 * image;
            // One of ten is as quick as that.
            let way = 2 + image % 10 * 7;
            let time = offset.time(at(taken), at(taken + 4000 + way));
            assert_eq!(time, at(taken + 4002), "{image}");
        }
    }

    #[test]
    fn what_is_no_image_ends_the_connection() {
        let mut world = World::new();
        world.remote.connect(&world.stop).unwrap();
        let (mut other, _) = world.listener.accept().unwrap();
        let sound = Header::new(Kind::Sound, 0, [2048, 4]).encode();
        other.write_all(&sound).unwrap();
        let error = world.read(&mut Vec::new()).unwrap_err();
        assert!(error.is_no_event(), "{error}");
        assert!(world.remote.connection.is_none());
    }

    #[test]
    fn a_stop_is_noticed_within_100_ms() {
        let mut world = World::new();
        world.stop.request();
        assert!(world.read(&mut Vec::new()).unwrap_err().is_stopped());
        assert!(PATIENCE < Duration::from_millis(100));
    }
}
