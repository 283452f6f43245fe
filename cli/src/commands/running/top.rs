//! `top`: how long cycles and nodes of a running robot take.

use std::thread;
use std::time::{Duration, Instant};

use protocol::{
    Ask, Durations, Good, Granted, InstanceTimings, NodeTimings, RecordingCounts, RemoteTimings,
    Timings,
};
use serde_json::json;

use super::connection::Connection;
use super::{again, text};
use crate::arguments::{TextOrJson, Top};
use crate::commands::terminal::Terminal;
use crate::outcome::{Outcome, Refusal};

/// Makes a terminal empty and begins at its top.
const CLEAR: &str = "\x1b[H\x1b[2J";

/// A robot times every cycle for 10 s after it was asked.
const AGAIN: Duration = Duration::from_secs(5);

pub(in crate::commands) fn top(terminal: &Terminal, top: &Top) -> Result<Outcome, Refusal> {
    let mut connection = Connection::open(&top.running)?;
    if let Some(seconds) = top.trace {
        return trace(terminal, &mut connection, seconds);
    }
    let mut before: Option<Timings> = None;
    again(top.count, Some(top.every), || {
        let Good::Timings(timings) = connection.ask(Ask::Timings {})? else {
            return Err(connection.confused());
        };
        let said = match top.running.format {
            TextOrJson::Json => format!("{}\n", json!(timings)),
            TextOrJson::Text => {
                let welcome = connection.welcome();
                let time = text::seconds(timings.time);
                let head = format!(
                    "{} ({}), {time}, times in µs",
                    welcome.robot, welcome.target
                );
                let clear = if terminal.is_watched() { CLEAR } else { "" };
                format!("{clear}{head}\n{}", table(&timings, before.as_ref()))
            }
        };
        before = Some(timings);
        terminal.more_data(&said)
    })
}

/// A trace is of what was: it is asked for once before, so that every cycle is timed from then on.
fn trace(
    terminal: &Terminal,
    connection: &mut Connection,
    seconds: f64,
) -> Result<Outcome, Refusal> {
    let mut ask = |seconds| match connection.ask(Ask::Trace { seconds })? {
        Good::Trace(trace) => Ok(trace),
        _ => Err(connection.confused()),
    };
    ask(0.0)?;
    let end = Instant::now() + Duration::from_secs_f64(seconds);
    loop {
        let left = end.saturating_duration_since(Instant::now());
        if left.is_zero() {
            break;
        }
        thread::sleep(left.min(AGAIN));
        // The robot looks less closely when nobody has asked for a while.
        ask(0.0)?;
    }
    terminal.data(&format!("{}\n", ask(seconds)?))?;
    Ok(Outcome::Good)
}

fn table(timings: &Timings, before: Option<&Timings>) -> String {
    let head = [
        "", "rate", "p50", "p99", "max", "runs", "skipped", "failed", "overruns",
    ];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for instance in &timings.instances {
        rows.push(instance_row(instance, rate(instance, timings, before)));
        rows.extend(part_row("  (late)", instance.lateness.as_ref()));
        rows.extend(instance.nodes.iter().map(node_row));
        rows.extend(part_row("  (framework)", instance.framework.as_ref()));
    }
    let threads = timings.instances.iter().filter_map(|instance| {
        let granted = instance.scheduling.as_ref()?;
        Some(format!("{}: {}\n", instance.name, thread_text(granted)))
    });
    let remotes = timings.remotes.iter().map(remote_line);
    text::columns(&rows, true)
        + &threads.chain(remotes).collect::<String>()
        + &recording_table(&timings.recording)
}

/// What became of the frames of a recording, of those that have any.
fn recording_table(recording: &[RecordingCounts]) -> String {
    let rows: Vec<_> = recording.iter().filter_map(recording_row).collect();
    if rows.is_empty() {
        return String::new();
    }
    let head = "recording recorded dropped failed lost overwritten";
    let head: Vec<_> = head.split(' ').map(str::to_owned).collect();
    text::columns(&[vec![head], rows].concat(), true)
}

/// It ends with an exclamation mark where frames are missing.
fn recording_row(of: &RecordingCounts) -> Option<Vec<String>> {
    let counts = [of.recorded, of.dropped, of.failed, of.lost, of.overwritten];
    if counts.iter().all(|count| *count == 0) {
        return None;
    }
    let mut row = vec![of.of.clone()];
    row.extend(counts.iter().map(u64::to_string));
    row.extend((of.missing() > 0).then(|| "!".to_owned()));
    Some(row)
}

/// What came of an instance that another machine runs.
fn remote_line(remote: &RemoteTimings) -> String {
    let fed = if remote.is_fed {
        "fed by another machine"
    } else {
        "fed by nobody"
    };
    format!(
        "{}: {fed}; {} completed, {} of them unannounced, {} abandoned, {} refused\n",
        remote.name, remote.completed, remote.unannounced, remote.abandoned, remote.refused
    )
}

/// What holds for a thread: `fifo 80, core 0, memory locked`.
pub(super) fn thread_text(granted: &Granted) -> String {
    let cores: Vec<_> = granted.cores.iter().map(u32::to_string).collect();
    let plural = if cores.len() == 1 { "" } else { "s" };
    let mut text = match granted.policy.as_deref() {
        None => "a policy of its own".to_owned(),
        Some("other") => "no real time".to_owned(),
        Some(policy) => format!("{policy} {}", granted.priority),
    };
    text += &format!(", core{plural} {}", cores.join(" "));
    if granted.memory_locked {
        text += ", memory locked";
    }
    text
}

/// Cycles per second of the robot's clock since the look before, else since its start.
fn rate(instance: &InstanceTimings, now: &Timings, before: Option<&Timings>) -> Option<f64> {
    let (cycles, time) = match before {
        None => (0, 0),
        Some(before) => {
            let same = |other: &&InstanceTimings| other.name == instance.name;
            (before.instances.iter().find(same)?.cycles, before.time)
        }
    };
    let elapsed = now.time.checked_sub(time)? as f64 / 1e9;
    (elapsed > 0.0).then(|| instance.cycles.saturating_sub(cycles) as f64 / elapsed)
}

fn instance_row(instance: &InstanceTimings, rate: Option<f64>) -> Vec<String> {
    let mut row = vec![instance.name.clone()];
    row.push(rate.map(|rate| format!("{rate:.1} Hz")).unwrap_or_default());
    row.extend(durations(instance.cycle.as_ref()));
    row.push(instance.cycles.to_string());
    row.push(String::new());
    row.extend([instance.failures, instance.overruns].map(|number| number.to_string()));
    row
}

/// What is neither a cycle nor a node, if it was timed.
fn part_row(name: &str, part: Option<&Durations>) -> Option<Vec<String>> {
    let mut row = vec![name.to_owned(), String::new()];
    row.extend(durations(Some(part?)));
    Some(row)
}

fn node_row(node: &NodeTimings) -> Vec<String> {
    let mut row = vec![format!("  {}", node.node), String::new()];
    row.extend(durations(node.durations.as_ref()));
    row.extend([node.calls, node.skipped, node.failures].map(|number| number.to_string()));
    row
}

fn durations(durations: Option<&Durations>) -> [String; 3] {
    match durations {
        None => Default::default(),
        Some(Durations { p50, p99, max }) => [p50, p99, max].map(|time| format!("{time:.1}")),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::table;

    #[test]
    fn the_table_has_instances_and_their_nodes() {
        let at = |time: u64, cycles: u64| {
            let timings = json!({ "time": time, "instances": [{
                "name": "Control", "cycles": cycles, "overruns": 1, "failures": 0, "deadline": 12000.0,
                "cycle": { "p50": 900.0, "p99": 1500.25, "max": 2000.0 },
                "nodes": [{ "node": "control::walk", "calls": cycles, "skipped": 2, "failures": 3 }],
                "queues": [],
            }] });
            serde_json::from_value(timings).expect("these are timings")
        };
        let shown = table(&at(2_000_000_000, 183), Some(&at(1_000_000_000, 100)));
        let expected = "                    rate    p50     p99     max  runs  skipped  failed  overruns\n\
                        Control          83.0 Hz  900.0  1500.2  2000.0   183                0         1\n  \
                        control::walk                                   183        2       3\n";
        assert_eq!(shown, expected);
    }

    #[test]
    fn what_other_machines_feed_stands_below_the_table() {
        let timings = json!({ "time": 1, "instances": [], "remotes": [{
            "name": "Lookout", "is_fed": true, "completed": 5, "unannounced": 1, "abandoned": 2, "refused": 3,
        }] });
        let timings = serde_json::from_value(timings).expect("these are timings");
        let table = table(&timings, None);
        assert_eq!(
            table.lines().last(),
            Some(
                "Lookout: fed by another machine; 5 completed, 1 of them unannounced, 2 abandoned, 3 refused"
            )
        );
    }

    #[test]
    fn what_became_of_a_recording_stands_below_the_table() {
        let of = |of: &str, [recorded, dropped, overwritten]: [u64; 3]| {
            json!({
                "of": of, "recorded": recorded, "dropped": dropped, "failed": 0, "lost": 0,
                "overwritten": overwritten,
            })
        };
        let shown = |recording: serde_json::Value| {
            let timings = json!({ "time": 1, "instances": [], "recording": recording });
            let timings = serde_json::from_value(timings).expect("these are timings");
            let table = table(&timings, None);
            let (_, below) = table.split_once('\n').expect("the table has a head");
            below.to_owned()
        };
        let some = json!([
            of("Control", [183, 0, 20]),
            of("Vision", [7, 12, 0]),
            of("Hearing", [0; 3]),
            of("logs", [1, 0, 0]),
        ]);
        let expected = "recording  recorded  dropped  failed  lost  overwritten\n\
                        Control         183        0       0     0           20\n\
                        Vision            7       12       0     0            0  !\n\
                        logs              1        0       0     0            0\n";
        assert_eq!(shown(some), expected);
        assert_eq!(shown(json!([of("Control", [0; 3])])), "");
        assert_eq!(shown(json!([])), "");
    }

    #[test]
    fn what_a_thread_was_granted_stands_below_the_table() {
        let shown = |granted: serde_json::Value| {
            let timings = json!({ "time": 1, "instances": [{
                "name": "Control", "cycles": 0, "overruns": 0, "failures": 0, "nodes": [], "queues": [],
                "scheduling": granted,
            }] });
            let timings = serde_json::from_value(timings).expect("these are timings");
            let table = table(&timings, None);
            table.lines().last().unwrap_or_default().to_owned()
        };
        let granted =
            json!({ "policy": "fifo", "priority": 80, "cores": [0], "memory_locked": true });
        assert_eq!(shown(granted), "Control: fifo 80, core 0, memory locked");
        let refused =
            json!({ "policy": "other", "priority": 0, "cores": [0, 1], "memory_locked": false });
        assert_eq!(shown(refused), "Control: no real time, cores 0 1");
    }
}
