//! Ctrl-C: it ends hulkgen at once, unless a program that hulkgen started has to answer first, or files are being written.
//!
//! A terminal sends it to both; the program's last words would otherwise come after the prompt, or never. SIGTERM ends
//! hulkgen as ever, also but for what is being written; a program that runs beside hulkgen gets it first.

use std::io;
use std::process::{Child, Command, ExitStatus};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, PoisonError};
use std::thread;

use rustix::process::{Pid, Signal, kill_process};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use signal_hook::{flag, low_level};

/// The exit status after Ctrl-C, as shells expect it.
pub const STATUS: u8 = 130;

// Handlers run on whichever of the threads the system picks: every access is `SeqCst`, as signal-hook's own are.
static ENDS_HULKGEN: LazyLock<Arc<AtomicBool>> = LazyLock::new(|| Arc::new(AtomicBool::new(true)));
static CAME: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);
static TERMINATED: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// Whoever has it may be in the midst of writing: nobody else ends hulkgen.
static WRITING: Mutex<()> = Mutex::new(());

/// The program that runs beside hulkgen. Whoever ends hulkgen keeps it, so that no other program is started meanwhile.
static BESIDE: Mutex<Option<Child>> = Mutex::new(None);

/// From now on Ctrl-C ends hulkgen with status 130; a robot that `run` started handles it itself.
pub fn end_hulkgen() {
    // Without the handlers signals still end hulkgen, only with another status and before what it waits for.
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else {
        return;
    };
    let _ = flag::register(SIGINT, CAME.clone());
    let _ = flag::register(SIGTERM, TERMINATED.clone());
    // A handler could not wait for what is being written.
    thread::spawn(move || {
        for signal in signals.forever() {
            if signal == SIGTERM || ENDS_HULKGEN.load(Ordering::SeqCst) {
                let _held = writing();
                end(signal);
            }
        }
    });
}

/// Does it to its end: a signal that comes meanwhile ends hulkgen afterwards.
pub(crate) fn postpone<T>(work: impl FnOnce() -> T) -> T {
    let held = writing();
    let done = work();
    drop(held);
    // The thread may come too late: hulkgen would end as if nothing had come.
    if TERMINATED.load(Ordering::SeqCst) {
        end(SIGTERM);
    }
    if CAME.load(Ordering::SeqCst) && ENDS_HULKGEN.load(Ordering::SeqCst) {
        end(SIGINT);
    }
    done
}

fn writing() -> MutexGuard<'static, ()> {
    // Nothing is kept in it that a panic could spoil.
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}

fn beside() -> MutexGuard<'static, Option<Child>> {
    // A child is in it or not; a panic cannot leave half of it.
    BESIDE.lock().unwrap_or_else(PoisonError::into_inner)
}

fn end(signal: i32) -> ! {
    let mut beside = beside();
    if let Some(mut program) = beside.take() {
        // A terminal sends Ctrl-C to both.
        if signal == SIGTERM {
            ask_to_end(&program);
        }
        let _ = program.wait();
    }
    if signal == SIGTERM {
        // Whoever sent it sees that it did what it does.
        let _ = low_level::emulate_default_handler(signal);
    }
    low_level::exit(STATUS.into())
}

/// Ends hulkgen if Ctrl-C came and the thread has not looked at it yet: what is begun from now on knows nothing of it.
pub(crate) fn heed() {
    if CAME.load(Ordering::SeqCst) {
        end(SIGINT);
    }
}

fn ask_to_end(program: &Child) {
    // It may have ended by itself; nobody has asked it how, so that its number is still its own.
    let _ = kill_process(Pid::from_child(program), Signal::TERM);
}

/// A program that runs while hulkgen does something else. Whatever ends hulkgen, it ends first.
#[derive(Debug)]
pub(crate) struct Beside;

impl Beside {
    /// The one that there is must have ended.
    pub(crate) fn start(command: &mut Command) -> io::Result<Self> {
        heed();
        let mut beside = beside();
        let program = command.spawn()?;
        // It came before there was anybody else to get it.
        if CAME.load(Ordering::SeqCst) {
            ask_to_end(&program);
        }
        *beside = Some(program);
        Ok(Self)
    }

    /// How it ended; `None` while it runs.
    pub(crate) fn ended(&self) -> io::Result<Option<ExitStatus>> {
        let mut beside = beside();
        let Some(program) = beside.as_mut() else {
            return Ok(None);
        };
        let ended = program.try_wait()?;
        if ended.is_some() {
            *beside = None;
        }
        Ok(ended)
    }

    /// Asks it to end in order, and waits until it has.
    pub(crate) fn end(self) -> io::Result<()> {
        // Kept meanwhile: whatever ends hulkgen now waits, too.
        let mut beside = beside();
        if let Some(program) = beside.as_mut() {
            ask_to_end(program);
            program.wait()?;
        }
        *beside = None;
        Ok(())
    }
}

/// How a program ended that hulkgen waited for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ended {
    /// `None`: by a signal.
    ByItself(Option<i32>),
    ByInterrupt,
}

/// Runs a program to its end; until then Ctrl-C is the program's alone, and what ended it is answered by nobody else.
pub(crate) fn wait_for<E>(program: impl FnOnce() -> Result<ExitStatus, E>) -> Result<Ended, E> {
    ENDS_HULKGEN.store(false, Ordering::SeqCst);
    heed();
    let ended = program();
    // It says so itself if somebody interrupted it alone.
    let said = ended.as_ref().map_or(None, ExitStatus::code) == Some(STATUS.into());
    let is_interrupted = || said || CAME.load(Ordering::SeqCst);
    // The thread may come to a signal of before only now; what follows it are last words.
    if !is_interrupted() {
        ENDS_HULKGEN.store(true, Ordering::SeqCst);
    }
    let status = ended?.code();
    Ok(match is_interrupted() {
        true => Ended::ByInterrupt,
        false => Ended::ByItself(status),
    })
}
