//! Ctrl-C: it ends hulkgen at once, unless a program that hulkgen started has to answer first.
//!
//! A terminal sends it to both; the program's last words would otherwise come after the prompt, or never.

use std::process::ExitStatus;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};

use signal_hook::consts::SIGINT;
use signal_hook::flag;

/// The exit status after Ctrl-C, as shells expect it.
pub const STATUS: u8 = 130;

// Handlers run on whichever of the threads the system picks: every access is `SeqCst`, as signal-hook's own are.
static ENDS_HULKGEN: LazyLock<Arc<AtomicBool>> = LazyLock::new(|| Arc::new(AtomicBool::new(true)));
static CAME: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// From now on Ctrl-C ends hulkgen with status 130; a robot that `run` started handles it itself.
pub fn end_hulkgen() {
    // Without the handlers Ctrl-C still ends hulkgen, only with another status and before what it waits for.
    let _ = flag::register_conditional_shutdown(SIGINT, STATUS.into(), ENDS_HULKGEN.clone());
    let _ = flag::register(SIGINT, CAME.clone());
}

/// How a program ended that hulkgen waited for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ended {
    /// `None`: by a signal.
    ByItself(Option<i32>),
    ByInterrupt,
}

/// Runs a program to its end; until then Ctrl-C is the program's alone.
pub(crate) fn wait_for<E>(program: impl FnOnce() -> Result<ExitStatus, E>) -> Result<Ended, E> {
    ENDS_HULKGEN.store(false, Ordering::SeqCst);
    let ended = program();
    ENDS_HULKGEN.store(true, Ordering::SeqCst);
    // It says so itself if somebody interrupted it alone.
    let status = ended?.code();
    let is_interrupted = CAME.load(Ordering::SeqCst) || status == Some(STATUS.into());
    Ok(match is_interrupted {
        true => Ended::ByInterrupt,
        false => Ended::ByItself(status),
    })
}
