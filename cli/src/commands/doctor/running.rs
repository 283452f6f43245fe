//! A robot that runs meanwhile: what the system granted its threads.

use super::Finding;
use crate::commands::running;

/// Nothing where none runs.
pub(super) fn look(address: Option<&str>) -> Vec<Finding> {
    let Ok(threads) = running::threads(address) else {
        return Vec::new();
    };
    let granted = threads.granted.into_iter();
    let granted =
        granted.map(|(instance, text, is_real_time)| thread(&instance, &text, is_real_time));
    let mut findings = vec![Finding::ok("running", threads.robot)];
    findings.extend(granted);
    findings
}

fn thread(instance: &str, text: &str, is_real_time: bool) -> Finding {
    let about = "thread";
    let message = format!("`{instance}` has {text}");
    if is_real_time {
        return Finding::ok(about, message);
    }
    let help = "if the manifest asks for a policy: grant it as `real-time` above says, and start the robot again";
    Finding::warning(about, message, help)
}

#[cfg(test)]
mod tests {
    use super::thread;
    use crate::commands::doctor::State;

    #[test]
    fn a_thread_without_real_time_is_a_warning() {
        assert_eq!(thread("Control", "fifo 80, core 0", true).state, State::Ok);
        let finding = thread("Control", "no real time, cores 0 1", false);
        assert_eq!(finding.state, State::Warning);
        assert_eq!(finding.message, "`Control` has no real time, cores 0 1");
    }
}
