//! Cameras and microphones for a program in another process, over Unix stream sockets beside LoLA's.
//!
//! | socket | what comes |
//! |---|---|
//! | `<lola>.top`, `<lola>.bottom` | images of a camera: 640x480, YUYV, 30 a second |
//! | `<lola>.microphones` | blocks of sound: 2048 samples of 4 channels, 44.1 kHz, interleaved 32-bit floats |
//!
//! [`links::senses`] says what stands before each message; times are those of the simulator's clock.
//!
//! Up to [`MOST_CLIENTS`] programs may listen at each. One that does not read for [`PATIENCE`] is told of and dropped: the world does not
//! wait for it, and reading again means connecting again, as with LoLA.

use std::io::{ErrorKind, Write};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use framework::{Clock, Error, Result, Stop, Timestamp};
use links::senses::{Header, Kind};
use types::audio::{AudioBlock, MICROPHONE_COUNT};
use types::camera::CameraPosition;
use types::image::YuyvImage;

use crate::camera::{self, HEIGHT, WIDTH};
use crate::server::listen;
use crate::simulation::{Simulation, block_time};
use crate::simulator::Shared;
use crate::sound::BLOCK_LENGTH;

/// How long one program may keep the others of its socket from the next message.
const PATIENCE: Duration = Duration::from_millis(200);
/// So many programs at one socket; whoever comes then is sent away.
const MOST_CLIENTS: usize = 8;
/// How long to wait before looking whether the simulator ends, or somebody has connected.
const GLANCE: Duration = Duration::from_millis(50);

/// The sockets and their threads; both end with it.
pub(crate) struct Senses {
    closing: Stop,
    paths: Vec<PathBuf>,
    threads: Vec<JoinHandle<()>>,
}

/// Programs that listen at one socket.
struct Audience {
    listener: UnixListener,
    name: &'static str,
    clients: Vec<UnixStream>,
}

impl Senses {
    /// Serves what the world of `shared` gives, beside LoLA's socket; without a clock as soon as it is there.
    ///
    /// # Errors
    /// Names the socket that is in use or cannot be made.
    pub(crate) fn serve(shared: &Arc<Shared>, clock: Option<&Clock>) -> Result<Self> {
        let mut senses = Self {
            closing: Stop::new(),
            paths: Vec::new(),
            threads: Vec::new(),
        };
        let lola = shared.socket();
        for (name, camera) in [
            ("top", CameraPosition::Top),
            ("bottom", CameraPosition::Bottom),
        ] {
            let audience = senses.listen(&lola, name)?;
            let (shared, clock) = (Arc::clone(shared), clock.cloned());
            senses.spawn(name, move |closing| {
                show(&shared, clock.as_ref(), camera, audience, closing);
            })?;
        }
        let audience = senses.listen(&lola, "microphones")?;
        let (shared, clock) = (Arc::clone(shared), clock.cloned());
        senses.spawn("microphones", move |closing| {
            sound(&shared, clock.as_ref(), audience, closing);
        })?;
        Ok(senses)
    }

    fn listen(&mut self, lola: &Path, name: &'static str) -> Result<Audience> {
        let mut path = lola.as_os_str().to_owned();
        path.push(format!(".{name}"));
        let path = PathBuf::from(path);
        let listener = listen(&path).map_err(|error| {
            Error::from(error).context(format!("cannot serve {name} at {}", path.display()))
        })?;
        self.paths.push(path);
        Ok(Audience {
            listener,
            name,
            clients: Vec::new(),
        })
    }

    fn spawn(&mut self, name: &str, serve: impl FnOnce(&Stop) + Send + 'static) -> Result<()> {
        let closing = self.closing.clone();
        let thread = std::thread::Builder::new().name(format!("simulated_nao.{name}"));
        self.threads.push(thread.spawn(move || serve(&closing))?);
        Ok(())
    }
}

impl Drop for Senses {
    fn drop(&mut self) {
        self.closing.request();
        for thread in self.threads.drain(..) {
            // A panic of the thread has been printed.
            let _ = thread.join();
        }
        for path in &self.paths {
            // Somebody may have removed it already; nothing is left to do then.
            let _ = std::fs::remove_file(path);
        }
    }
}

impl Audience {
    /// Takes in whoever has come; whether anybody is there.
    fn is_there(&mut self) -> bool {
        while let Ok((client, _)) = self.listener.accept() {
            let is_usable = client.set_nonblocking(false).is_ok()
                && client.set_write_timeout(Some(PATIENCE)).is_ok();
            if is_usable && self.clients.len() < MOST_CLIENTS {
                self.clients.push(client);
            }
        }
        !self.clients.is_empty()
    }

    /// Sends a message to everybody; who does not take it is dropped.
    fn tell(&mut self, message: &[u8]) {
        let name = self.name;
        self.clients
            .retain_mut(|client| match client.write_all(message) {
                Ok(()) => true,
                Err(error) => {
                    if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) {
                        eprintln!("a program does not read what {name} sends; it is dropped");
                    }
                    false
                }
            });
    }
}

fn show(
    shared: &Shared,
    clock: Option<&Clock>,
    camera: CameraPosition,
    mut audience: Audience,
    closing: &Stop,
) {
    let field = Arc::clone(&shared.stage.lock().world.field);
    let mut image = YuyvImage::default();
    let mut message = Vec::new();
    while closing.check().is_ok() {
        let exposure = wait(shared, |simulation| {
            simulation.take_image(camera, now(simulation, clock))
        });
        let (Some(exposure), true) = (exposure, audience.is_there()) else {
            continue;
        };
        camera::render(&exposure, &field, &mut image);
        let waited = clock.map(|clock| clock.wait_until(exposure.ready_at, closing));
        if waited.is_some_and(|waited| waited.is_err()) {
            return;
        }
        let size = [WIDTH as u32, HEIGHT as u32];
        begin(&mut message, Kind::Image, exposure.captured_at, size);
        message.extend_from_slice(&image.data);
        audience.tell(&message);
    }
}

fn sound(shared: &Shared, clock: Option<&Clock>, mut audience: Audience, closing: &Stop) {
    let mut block = AudioBlock::default();
    let mut message = Vec::new();
    while closing.check().is_ok() {
        let taken = wait(shared, |simulation| {
            simulation.take_block(now(simulation, clock))
        });
        let (Some((number, _)), true) = (taken, audience.is_there()) else {
            continue;
        };
        let called = shared.stage.lock().world.whistles().to_vec();
        shared.sound.record(number, &called, &mut block);
        let size = [BLOCK_LENGTH as u32, MICROPHONE_COUNT as u32];
        begin(&mut message, Kind::Sound, block_time(number), size);
        for index in 0..BLOCK_LENGTH {
            for channel in &block.channels {
                let sample = channel.get(index).copied().unwrap_or_default();
                message.extend_from_slice(&sample.to_le_bytes());
            }
        }
        audience.tell(&message);
    }
}

fn now(simulation: &Simulation, clock: Option<&Clock>) -> Timestamp {
    clock.map_or_else(|| simulation.now(), Clock::now)
}

/// What there is to take, or nothing after a while.
fn wait<T>(shared: &Shared, mut take: impl FnMut(&mut Simulation) -> Option<T>) -> Option<T> {
    let mut simulation = shared.lock();
    if let Some(taken) = take(&mut simulation) {
        return Some(taken);
    }
    let waited = shared.stepped.wait_timeout(simulation, GLANCE);
    take(&mut waited.unwrap_or_else(PoisonError::into_inner).0)
}

fn begin(message: &mut Vec<u8>, kind: Kind, at: Timestamp, size: [u32; 2]) {
    message.clear();
    message.extend_from_slice(&Header::new(kind, at.as_nanos(), size).encode());
}
