//! A simulated NAO for a robot's program in another process: LoLA, cameras and microphones on Unix sockets, in real time.
//!
//! ```sh
//! cargo run --release -p simulated_nao --bin nao_simulator -- --socket /tmp/robocup --pose -1,0,0
//! ```
//! `--paced ANSWERS`, in front of all other options, turns the world as fast as the program answers, until so many states were
//! answered: for programs under an emulator. `--export-mjcf FILE` writes the robot for MuJoCo, standing, and ends. All other options are those of the simulated hardware. Ctrl-C ends it; a socket that is left over is replaced at the next start.

use std::process::ExitCode;

use framework::{Clock, Result, Stop};
use simulated_nao::physics::{Start, mjcf};
use simulated_nao::settings::Settings;
use simulated_nao::{Simulator, posture};

/// Where a NAO's LoLA listens.
const LOLA: &str = "/tmp/robocup";

fn main() -> ExitCode {
    match serve() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn serve() -> Result<()> {
    let mut settings = Settings::default();
    let options: Vec<_> = std::env::args().skip(1).collect();
    if let [option, file] = &options[..]
        && option == "--export-mjcf"
    {
        let start = Start {
            joints: posture::standing(),
            pose: [0.0; 3],
        };
        return Ok(std::fs::write(file, mjcf(&start))?);
    }
    let (answers, options) = match &options[..] {
        [option, answers, rest @ ..] if option == "--paced" => (Some(answers.parse()?), rest),
        all => (None, all),
    };
    settings.apply(options)?;
    settings.socket.get_or_insert_with(|| LOLA.into());
    let simulator = match answers {
        Some(answers) => Simulator::paced(&settings, answers)?,
        None => Simulator::serve(&settings, Clock::wall())?,
    };
    let lola = simulator.socket();
    let lola = lola.display();
    eprintln!(
        "LoLA at {lola}, cameras at {lola}.top and {lola}.bottom, microphones at {lola}.microphones"
    );
    let never = Stop::new();
    while simulator.is_running() && never.wait(std::time::Duration::from_secs(1)).is_ok() {}
    Ok(())
}
