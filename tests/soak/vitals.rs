//! What the system says of the robot's process.

use std::fs;

/// Memory and open files over time.
pub(crate) struct Vitals {
    process: u32,
    /// Resident memory in KiB, and open files, at each look.
    pub(crate) looks: Vec<(u64, u64)>,
}

impl Vitals {
    pub(crate) fn of(process: u32) -> Self {
        Self {
            process,
            looks: Vec::new(),
        }
    }

    /// Looks once; a process that is gone is none to look at.
    pub(crate) fn look(&mut self) {
        let status = fs::read_to_string(format!("/proc/{}/status", self.process));
        let files = fs::read_dir(format!("/proc/{}/fd", self.process));
        if let (Ok(status), Ok(files)) = (status, files)
            && let Some(memory) = resident(&status)
        {
            self.looks.push((memory, files.count() as u64));
        }
    }

    /// The greatest of each, of the looks from one share of all to another, in percent.
    pub(crate) fn most(&self, from: usize, to: usize) -> (u64, u64) {
        let count = self.looks.len();
        let part = &self.looks[count * from / 100..count * to / 100];
        let memory = part.iter().map(|(memory, _)| *memory).max();
        let files = part.iter().map(|(_, files)| *files).max();
        (memory.unwrap_or(0), files.unwrap_or(0))
    }
}

fn resident(status: &str) -> Option<u64> {
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().trim_end_matches(" kB").parse().ok()
}
