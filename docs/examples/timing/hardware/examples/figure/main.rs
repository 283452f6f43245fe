//! Draws the recording of a run: `figure RECORDING > timing.svg`.

mod drawing;
mod story;

use std::path::Path;
use std::process::ExitCode;

use hulkgen_recording::Recording;

fn main() -> ExitCode {
    let Some(path) = std::env::args_os().nth(1) else {
        eprintln!("usage: figure RECORDING");
        return ExitCode::from(2);
    };
    let story = Recording::open(Path::new(&path))
        .map_err(|error| error.to_string())
        .and_then(|recording| story::of(&recording));
    match story {
        Ok(story) => {
            print!("{}", drawing::of(&story));
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{}: {error}", Path::new(&path).display());
            ExitCode::FAILURE
        }
    }
}
