//! What a Linux machine says of itself in /proc, /sys and /etc: whether it is fit for real time, and free for a robot.
//!
//! Invariant: nothing but files is asked, so the same sentences hold for this machine, for a robot whose files came over
//! the network, and for a test's.

use camino::Utf8Path;
use protocol::PORT;

use super::Finding;
use crate::diagnostics::listed;
use crate::workspace::Workspace;

/// What [`look`] reads, as a shell writes it; a robot is asked for these.
pub(super) const FILES: &[&str] = &[
    "etc/os-release",
    "proc/net/tcp",
    "proc/net/tcp6",
    "proc/self/limits",
    "proc/self/status",
    "proc/sys/kernel/osrelease",
    "sys/class/net/*/operstate",
    "sys/devices/system/clocksource/clocksource0/available_clocksource",
    "sys/devices/system/clocksource/clocksource0/current_clocksource",
    "sys/devices/system/cpu/cpu*/cpufreq/scaling_governor",
    "sys/kernel/realtime",
];

/// `CAP_IPC_LOCK` and `CAP_SYS_NICE` in `CapEff` (linux/capability.h).
const IPC_LOCK: u32 = 14;
const SYS_NICE: u32 = 23;

/// State of a socket that listens (include/net/tcp_states.h).
const LISTEN: &str = "0A";

/// Clock sources that cost a system call or a slow register at every look.
const SLOW_CLOCKS: &[&str] = &["acpi_pm", "hpet", "jiffies", "pit", "refined-jiffies"];

/// The answers of the machine whose files these are; `limits_of` says whose limits they are.
pub(super) fn look(files: &Workspace, limits_of: &str) -> Vec<Finding> {
    let read = |path: &str| files.read(Utf8Path::new(path)).ok();
    let capabilities = read("proc/self/status");
    let capabilities = capabilities.as_deref().map_or(0, effective);
    let mut findings = vec![system(
        read("etc/os-release").as_deref(),
        read("proc/sys/kernel/osrelease").as_deref(),
        read("sys/kernel/realtime").is_some_and(|text| text.trim() == "1"),
    )];
    if let Some(limits) = read("proc/self/limits") {
        findings.push(real_time(&limits, capabilities, limits_of));
        findings.push(memory_lock(&limits, capabilities, limits_of));
    }
    findings.push(governor(files));
    let source = |name: &str| {
        read(&format!(
            "sys/devices/system/clocksource/clocksource0/{name}"
        ))
        .map(|text| text.trim().to_owned())
    };
    findings.extend(source("current_clocksource").map(|it| clock_source(&it)));
    findings.push(port(
        [read("proc/net/tcp"), read("proc/net/tcp6")]
            .iter()
            .flatten(),
    ));
    findings.push(network(files));
    findings
}

fn effective(status: &str) -> u64 {
    let line = status.lines().find_map(|line| line.strip_prefix("CapEff:"));
    line.and_then(|text| u64::from_str_radix(text.trim(), 16).ok())
        .unwrap_or(0)
}

fn has(capabilities: u64, capability: u32) -> bool {
    capabilities & (1 << capability) != 0
}

fn system(release: Option<&str>, kernel: Option<&str>, is_real_time: bool) -> Finding {
    let pretty = release.and_then(|text| {
        let line = text.lines().find_map(|it| it.strip_prefix("PRETTY_NAME="));
        line.map(|name| name.trim_matches('"'))
    });
    let kernel = kernel.map_or("unknown", str::trim);
    let kind = if is_real_time {
        "with PREEMPT_RT"
    } else {
        "without PREEMPT_RT"
    };
    let pretty = pretty.unwrap_or("an unknown system");
    Finding::ok("system", format!("{pretty}, Linux {kernel} {kind}"))
}

/// The soft limit of a line of /proc/self/limits.
fn soft_limit<'l>(limits: &'l str, name: &str) -> Option<&'l str> {
    let line = limits.lines().find_map(|line| line.strip_prefix(name))?;
    line.split_whitespace().next()
}

/// The soft limit, as `ulimit -r` prints it.
fn real_time(limits: &str, capabilities: u64, limits_of: &str) -> Finding {
    let about = "real-time";
    if has(capabilities, SYS_NICE) {
        return Finding::ok(about, "all priorities, by the capability CAP_SYS_NICE");
    }
    match soft_limit(limits, "Max realtime priority") {
        None | Some("0") => Finding::warning(
            about,
            format!(
                "{limits_of} has no permission for real-time priorities; robots run without them"
            ),
            "`AmbientCapabilities=CAP_SYS_NICE CAP_IPC_LOCK` in the unit, `sudo setcap cap_sys_nice,cap_ipc_lock=ep \
             PROGRAM`, or `@realtime - rtprio 99` in /etc/security/limits.conf",
        ),
        Some("99" | "unlimited") => Finding::ok(about, "priorities up to 99"),
        Some(limit) => Finding::ok(about, format!("priorities up to {limit}")),
    }
}

fn memory_lock(limits: &str, capabilities: u64, limits_of: &str) -> Finding {
    let about = "memory";
    if has(capabilities, IPC_LOCK) {
        return Finding::ok(about, "may be locked, by the capability CAP_IPC_LOCK");
    }
    match soft_limit(limits, "Max locked memory") {
        Some("unlimited") => Finding::ok(about, "may be locked"),
        limit => {
            let bytes = limit
                .and_then(|limit| limit.parse::<u64>().ok())
                .unwrap_or(0);
            let mebibytes = bytes >> 20;
            Finding::warning(
                about,
                format!(
                    "{limits_of} may lock {mebibytes} MiB: a page that is not there costs a real-time thread milliseconds"
                ),
                "`LimitMEMLOCK=infinity` in the unit, or `@realtime - memlock unlimited` in /etc/security/limits.conf",
            )
        }
    }
}

fn governor(files: &Workspace) -> Finding {
    let about = "governor";
    let folder = Utf8Path::new("sys/devices/system/cpu");
    let mut all: Vec<(String, String)> = Vec::new();
    for cpu in files.list(folder) {
        let name = cpu.file_name().unwrap_or_default();
        let is_core = (name.strip_prefix("cpu")).is_some_and(|number| {
            !number.is_empty() && number.bytes().all(|it| it.is_ascii_digit())
        });
        if is_core && let Ok(text) = files.read(&cpu.join("cpufreq/scaling_governor")) {
            all.push((name.to_owned(), text.trim().to_owned()));
        }
    }
    if all.is_empty() {
        return Finding::ok(about, "the system cannot change the pace of its cores");
    }
    let slow = |(_, governor): &&(String, String)| governor != "performance";
    let cores: Vec<_> = all
        .iter()
        .filter(slow)
        .map(|(name, _)| name.as_str())
        .collect();
    match all.iter().find(slow) {
        None => Finding::ok(about, "`performance` on all cores"),
        Some((_, governor)) => Finding::warning(
            about,
            format!("`{governor}` on {}: cores wake up slowly", listed(cores)),
            "`echo performance | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor`",
        ),
    }
}

fn clock_source(current: &str) -> Finding {
    let about = "clock";
    if SLOW_CLOCKS.contains(&current) {
        return Finding::warning(
            about,
            format!(
                "the clock source is `{current}`: every look at the time takes a microsecond or more"
            ),
            "`cat /sys/devices/system/clocksource/clocksource0/available_clocksource` names others; `tsc` is chosen by \
             booting with `clocksource=tsc tsc=reliable`",
        );
    }
    Finding::ok(about, format!("the clock source is `{current}`"))
}

/// Whether a robot's program finds its port free.
fn port<'t>(tables: impl Iterator<Item = &'t std::sync::Arc<str>>) -> Finding {
    let about = "port";
    let is_taken = tables.flat_map(|table| table.lines()).any(|line| {
        let mut words = line.split_whitespace().skip(1);
        let port = words.next().and_then(|address| address.rsplit(':').next());
        let port = port.and_then(|port| u16::from_str_radix(port, 16).ok());
        port == Some(PORT) && words.nth(1) == Some(LISTEN)
    });
    if is_taken {
        return Finding::warning(
            about,
            format!("{PORT} is taken: a program listens there, perhaps a robot"),
            format!(
                "`hulkgen top` shows the robot, `ss -lptn sport = :{PORT}` the program; another robot takes a free port"
            ),
        );
    }
    Finding::ok(about, format!("{PORT} is free"))
}

fn network(files: &Workspace) -> Finding {
    let about = "network";
    let mut up = Vec::new();
    for interface in files.list(Utf8Path::new("sys/class/net")) {
        let name = interface.file_name().unwrap_or_default().to_owned();
        let state = files.read(&interface.join("operstate"));
        if name != "lo" && state.is_ok_and(|state| state.trim() == "up") {
            up.push(name);
        }
    }
    if up.is_empty() {
        let message = "no interface but that of this machine itself is up";
        let help = "plug in a cable or join a wireless network; `ip address` shows interfaces";
        return Finding::warning(about, message, help);
    }
    let verb = if up.len() == 1 { "is" } else { "are" };
    Finding::ok(
        about,
        format!("{} {verb} up", listed(up.iter().map(String::as_str))),
    )
}

#[cfg(test)]
mod tests;
