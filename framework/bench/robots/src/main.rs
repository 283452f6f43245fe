//! Writes the robots that are measured into `framework/bench/written`; `hulkgen generate` then writes their runtimes.

use std::fs;
use std::process::ExitCode;

fn main() -> ExitCode {
    for (path, text) in bench_robots::files() {
        let folder = path.parent().expect("every file lies in a folder");
        let written = fs::create_dir_all(folder).and_then(|()| fs::write(&path, text));
        if let Err(error) = written {
            eprintln!("cannot write {}: {error}", path.display());
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}
