//! What tells one run of a robot from every other one.

use std::hash::{BuildHasher, RandomState};
use std::process;
use std::time::{SystemTime, UNIX_EPOCH};

/// 128 bits as hexadecimal digits. Keys of std's hashes are the system's random numbers, which a robot that has just
/// been switched on may have too few of: with its time and process no two runs are alike even then.
pub(crate) fn new_run_id() -> String {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    let seed = (process::id(), now.unwrap_or_default());
    let half = || RandomState::new().hash_one(seed);
    format!("{:016x}{:016x}", half(), half())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::new_run_id;

    #[test]
    fn every_run_has_its_own() {
        let all: BTreeSet<_> = (0..1000).map(|_| new_run_id()).collect();
        assert_eq!(all.len(), 1000);
        assert!(all.iter().all(|id| id.len() == 32));
        let halves: BTreeSet<_> = all.iter().flat_map(|id| [&id[..16], &id[16..]]).collect();
        assert_eq!(halves.len(), 2000, "both halves are random");
    }
}
