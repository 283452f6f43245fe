//! Turns a world as fast as a robot's program answers: the next state comes when the last one was answered.
//!
//! For programs that are slower than the world, for example under an emulator of another processor. The world's time is
//! that of its states; what its clock on the wall shows has no meaning.

use std::time::{Duration, Instant};

use framework::{Error, Result, Stop};

use crate::simulator::Shared;

/// From one state to the next at least: programs have a clock of their own, which the world must not overtake.
const PERIOD: Duration = Duration::from_millis(12);
/// Between two looks for an answer.
const GLANCE: Duration = Duration::from_micros(200);
/// A state that is not answered for so long will not be: programs read their first states before they command.
const PATIENCE: Duration = Duration::from_millis(500);
/// So many states without any answer in a row are a program that has gone: two minutes.
const GONE: u32 = 240;

/// Goes on until so many states were answered, or the simulator is closed.
///
/// # Errors
/// Where the program does not answer for two minutes.
pub(crate) fn turn(shared: &Shared, closing: &Stop, answers: u64) -> Result<()> {
    let mut unanswered = 0;
    while closing.check().is_ok() && shared.lock().server().exchange().commands < answers {
        let begun = Instant::now();
        let before = {
            let mut simulation = shared.lock();
            while !simulation.next_is_tick() {
                simulation.step()?;
            }
            let before = simulation.server().exchange();
            simulation.step()?;
            before
        };
        shared.stepped.notify_all();
        if is_answered(shared, closing, before.commands) {
            unanswered = 0;
        } else {
            unanswered += 1;
        }
        if closing
            .wait(PERIOD.saturating_sub(begun.elapsed()))
            .is_err()
        {
            break;
        }
        if unanswered == GONE {
            return Err(Error::new(format!(
                "the program has answered {} states, and none for two minutes",
                before.commands
            )));
        }
    }
    Ok(())
}

fn is_answered(shared: &Shared, closing: &Stop, commands: u64) -> bool {
    let begun = Instant::now();
    while begun.elapsed() < PATIENCE && closing.wait(GLANCE).is_ok() {
        let mut simulation = shared.lock();
        simulation.server_mut().receive();
        if simulation.server().exchange().commands > commands {
            return true;
        }
    }
    false
}
