//! What files of other machines say.

use super::{FILES, look};
use crate::commands::doctor::{Finding, State};
use crate::workspace::Workspace;

const CLOCK: &str = "sys/devices/system/clocksource/clocksource0/current_clocksource";
const GOVERNOR: &str = "sys/devices/system/cpu/cpu0/cpufreq/scaling_governor";
/// `0.0.0.0:4857`, listening, and a connection to it.
const TAKEN: &str = "  sl  local_address rem_address   st tx_queue\n   \
    0: 00000000:12F9 00000000:0000 0A 00000000:00000000\n";
const CONNECTED: &str = "   1: 0100007F:12F9 0100007F:9C40 01 00000000:00000000\n";

/// A machine that is fit for real time, but for these files.
fn machine(changes: &[(&str, &str)]) -> Vec<Finding> {
    let good = [
        ("etc/os-release", "NAME=x\nPRETTY_NAME=\"Robot OS 9\"\n"),
        (
            "proc/self/limits",
            "Limit Soft Hard\nMax locked memory         unlimited unlimited bytes\n\
             Max realtime priority     65        65\n",
        ),
        (
            "proc/self/status",
            "Name:\tcat\nCapEff:\t0000000000000000\n",
        ),
        ("proc/sys/kernel/osrelease", "6.1.0-rt\n"),
        ("proc/net/tcp", CONNECTED),
        ("sys/class/net/lo/operstate", "unknown\n"),
        ("sys/class/net/wlan0/operstate", "up\n"),
        ("sys/class/net/eth0/operstate", "down\n"),
        (CLOCK, "tsc\n"),
        (GOVERNOR, "performance\n"),
        ("sys/devices/system/cpu/cpufreq/boost", "1\n"),
        ("sys/kernel/realtime", "1\n"),
    ];
    let others = |(path, _): &&(&str, &str)| changes.iter().all(|(changed, _)| changed != path);
    let files = good.iter().filter(others).chain(changes);
    look(&Workspace::in_memory(files.copied()), "this user")
}

#[track_caller]
fn about(findings: &[Finding], about: &str) -> (State, String) {
    let mut all = findings.iter().filter(|finding| finding.about == about);
    let finding = all
        .next()
        .unwrap_or_else(|| panic!("nothing about {about}: {findings:#?}"));
    assert_eq!(finding.help.is_none(), finding.state == State::Ok);
    (finding.state, finding.message.clone())
}

#[test]
fn a_fit_machine_is_ok() {
    let findings = machine(&[]);
    for (subject, message) in [
        ("system", "Robot OS 9, Linux 6.1.0-rt with PREEMPT_RT"),
        ("real-time", "priorities up to 65"),
        ("memory", "may be locked"),
        ("governor", "`performance` on all cores"),
        ("clock", "the clock source is `tsc`"),
        ("port", "4857 is free"),
        ("network", "`wlan0` is up"),
    ] {
        assert_eq!(about(&findings, subject), (State::Ok, message.to_owned()));
    }
}

#[test]
fn what_is_not_fit_is_a_warning_with_its_reason() {
    for (subject, path, text, message) in [
        (
            "memory",
            "proc/self/limits",
            "Max locked memory 8388608 8388608 bytes\n",
            "this user may lock 8 MiB",
        ),
        (
            "real-time",
            "proc/self/limits",
            "Max realtime priority 0 99\n",
            "this user has no permission",
        ),
        (
            "real-time",
            "proc/self/limits",
            "",
            "this user has no permission",
        ),
        ("governor", GOVERNOR, "powersave\n", "`powersave` on `cpu0`"),
        ("clock", CLOCK, "hpet\n", "the clock source is `hpet`"),
        ("port", "proc/net/tcp6", TAKEN, "4857 is taken"),
        (
            "network",
            "sys/class/net/wlan0/operstate",
            "dormant\n",
            "no interface",
        ),
    ] {
        let (state, said) = about(&machine(&[(path, text)]), subject);
        assert_eq!(state, State::Warning, "{said}");
        assert!(said.starts_with(message), "{said}");
    }
}

#[test]
fn capabilities_are_permissions() {
    let limits = "Max locked memory 0 0 bytes\nMax realtime priority 0 0\n";
    let findings = machine(&[
        ("proc/self/limits", limits),
        ("proc/self/status", "CapEff:\t0000000000804000\n"),
    ]);
    assert_eq!(about(&findings, "real-time").0, State::Ok);
    assert_eq!(about(&findings, "memory").0, State::Ok);
    let findings = machine(&[
        ("proc/self/limits", limits),
        ("proc/self/status", "CapEff:\t0000000000004000\n"),
    ]);
    assert_eq!(about(&findings, "real-time").0, State::Warning);
    assert_eq!(about(&findings, "memory").0, State::Ok);
}

#[test]
fn a_machine_that_says_nothing_is_no_panic() {
    let findings = look(&Workspace::in_memory([("etc/os-release", "")]), "this user");
    assert_eq!(about(&findings, "network").0, State::Warning);
    assert_eq!(about(&findings, "port").0, State::Ok);
}

#[test]
fn the_files_of_this_machine_can_be_read() {
    let findings = look(&Workspace::at_root("/".into()), "this user");
    let (_, system) = about(&findings, "system");
    assert!(!system.contains("unknown"), "{system}");
    about(&findings, "real-time");
    about(&findings, "memory");
    assert!(FILES.iter().all(|path| !path.starts_with('/')));
}
