//! Who commands the body when the nodes may not: a thread that lets the robot down.
//!
//! It sleeps while the nodes have the motors. In safe state it sends the commands of [`lola::Safety`] every 12 ms, and takes the states that
//! nobody reads: LoLA gives up on a client whose states pile up, and would then not hear that the robot shall be let down.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use framework::{Clock, Error, Result, Timestamp};
use lola::{Client, Safety};
use types::leds::Leds;
use types::motor_commands::MotorCommands;

/// LoLA's cycle.
const CYCLE: Duration = Duration::from_millis(12);
/// After so many cycles without a state that was read, nobody reads them: 96 ms.
const UNREAD: u32 = 8;

/// The commander of the motors, and its thread.
pub(crate) struct Body {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

struct Shared {
    client: Arc<Client>,
    clock: Clock,
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    safety: Safety,
    is_safe: bool,
    /// Stiffness 0 was commanded.
    is_released: bool,
    is_closing: bool,
}

impl Body {
    /// The nodes command first.
    ///
    /// # Errors
    /// Where the system gives no thread.
    pub(crate) fn new(client: Arc<Client>, clock: Clock) -> Result<Self> {
        let shared = Arc::new(Shared {
            client,
            clock,
            state: Mutex::default(),
            changed: Condvar::new(),
        });
        let thread = std::thread::Builder::new()
            .name("nao.body".to_owned())
            .spawn({
                let shared = Arc::clone(&shared);
                move || shared.let_down()
            })
            .map_err(|error| Error::from(error).context("cannot start the body's thread"))?;
        Ok(Self {
            shared,
            thread: Some(thread),
        })
    }

    /// Takes the motors away from the nodes.
    pub(crate) fn enter_safe_state(&self) {
        let mut state = self.shared.lock();
        state.safety.enter();
        state.is_safe = true;
        state.is_released = false;
        self.shared.changed.notify_all();
    }

    /// For the nodes, with the next sample: see [`Safety::tell`].
    pub(crate) fn tell(&self) -> bool {
        self.shared.lock().safety.tell()
    }

    /// Gives the motors back.
    pub(crate) fn rearm(&self) {
        let mut state = self.shared.lock();
        state.safety.rearm();
        state.is_safe = false;
    }

    /// Whether the chest button, which is down or not now, was pressed to give the motors back.
    pub(crate) fn is_rearm_wanted(&self, is_down: bool) -> bool {
        let now = self.shared.clock.now();
        self.shared.lock().safety.is_rearm_wanted(is_down, now)
    }

    /// Remembers a command of the nodes; whether it may be sent.
    pub(crate) fn permits(&self, motors: &MotorCommands) -> bool {
        self.shared.lock().safety.permits(motors)
    }
}

impl Drop for Body {
    /// Lets the robot down to the end before LoLA is left alone.
    fn drop(&mut self) {
        self.shared.lock().is_closing = true;
        self.shared.changed.notify_all();
        if let Some(thread) = self.thread.take() {
            // A panic of the thread has been printed.
            let _ = thread.join();
        }
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        // Nothing in it can be half done.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn let_down(&self) {
        let (mut states, mut unread) = (0, 0);
        while let Some(command) = self.next_command() {
            // An infinite angle cannot come from a command that was permitted and sent.
            let _ = self.client.write_command(&command, &Leds::default());
            let read = self.client.counts().states;
            unread = if read == states { unread + 1 } else { 0 };
            states = read;
            if unread >= UNREAD {
                self.client.discard_states();
            }
            // Whatever happened: LoLA gives up on a client that sends more than it takes.
            std::thread::sleep(CYCLE);
        }
    }

    /// Sleeps until the hardware commands; `None` at the end.
    fn next_command(&self) -> Option<MotorCommands> {
        let mut state = self.lock();
        loop {
            let now: Timestamp = self.clock.now();
            let command = state.is_safe.then(|| state.safety.command(now)).flatten();
            if state.is_closing && (command.is_none() || state.is_released) {
                return None;
            }
            if command.is_some() {
                state.is_released = !state.safety.is_fading(now);
                return command;
            }
            let woken = self.changed.wait(state);
            state = woken.unwrap_or_else(PoisonError::into_inner);
        }
    }
}
