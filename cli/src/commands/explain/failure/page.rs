//! A failure and what follows from it, as text.

use super::{Answer, Becomes, Effect, Failure, Fate};
use crate::resolve::robot::OnFailure;

/// A section for each cycler that has the node.
pub(in crate::commands::explain) fn text(answer: &Answer) -> String {
    let failures = answer.failures.iter().map(failure);
    failures.collect::<Vec<_>>().join("\n")
}

fn failure(failure: &Failure) -> String {
    let kind = if failure.setup { "setup node" } else { "node" };
    let (node, cycler, policy) = (&failure.node, &failure.cycler, failure.on_failure.name());
    let mut text = format!("{node}: {kind} of {cycler}, on failure {policy}\n");
    for sentence in sentences(failure) {
        text.push_str(&format!("  {sentence}\n"));
    }
    if !failure.not_run.is_empty() {
        let nodes = failure.not_run.join(", ");
        text.push_str(&format!("  not run in this cycle: {nodes}\n"));
    }
    for name in &failure.refused {
        text.push_str(&format!("  a call of {name} is refused\n"));
    }
    if failure.effects.is_empty() && failure.cycle != Fate::Completed {
        text.push_str("  no other cycler reads what it writes\n");
    } else if failure.effects.is_empty() {
        text.push_str("  no node sees a difference\n");
    }
    text.extend(failure.effects.iter().map(effect));
    text
}

/// What happens to the cycle and its instance.
fn sentences(failure: &Failure) -> Vec<String> {
    let mut sentences = Vec::new();
    let outputs = match failure.outputs.as_slice() {
        [] => "it has no outputs".to_owned(),
        outputs => format!("its outputs are defaults: {}", outputs.join(", ")),
    };
    match (failure.on_failure, failure.cycle) {
        (OnFailure::Stop, _) => {
            sentences.push("the cycle is abandoned".to_owned());
            sentences.push(
                "the robot stops, in order, and the hardware goes into its safe state".to_owned(),
            );
        }
        (OnFailure::Restart, _) => {
            sentences.push(
                "the cycle is abandoned; nodes and states of this instance are created anew, \
                 after 0.1 s, doubling to 5 s"
                    .to_owned(),
            );
            if failure.real_time {
                sentences.push("meanwhile the hardware is in its safe state".to_owned());
            }
            sentences.push("five restarts in a minute stop the robot".to_owned());
        }
        (OnFailure::Skip | OnFailure::Hold, Fate::NotBegun) => {
            sentences.push("no cycle begins; setup starts over, after at least 10 ms".to_owned());
        }
        (OnFailure::Hold, Fate::Completed | Fate::Abandoned) => {
            sentences
                .push("the cycle goes on with its last good outputs for at most 100 ms".to_owned());
            sentences.push(format!("after that {outputs}"));
        }
        (OnFailure::Skip, Fate::Completed | Fate::Abandoned) => {
            sentences.push("the cycle goes on".to_owned());
            sentences.push(outputs);
        }
    }
    sentences
}

fn effect(effect: &Effect) -> String {
    let Effect {
        cycler,
        node,
        field,
        kind,
        from,
        output,
        ..
    } = effect;
    let becomes = match effect.becomes {
        Becomes::Absent if effect.skipped => {
            "is absent: the node is skipped, its outputs are defaults"
        }
        Becomes::Absent => "has no entry",
        Becomes::PerhapsAbsent => {
            "is absent if the default has none: then the node is skipped, its outputs are defaults"
        }
        Becomes::Default if *kind == "PerceptionInput" => "has entries with the default",
        Becomes::Default if *kind == "PreviousInput" => "is the default, a cycle later",
        Becomes::Default if *kind == "HistoricInput" => "has the default at this time",
        Becomes::Default => "is the default",
        Becomes::Held => "stays what it was",
        Becomes::Abandoned => "never gets this cycle's entry",
        Becomes::Stopped => "gets nothing new: the robot stops",
    };
    format!("  {cycler} {node}: {field} ({kind} of {from}.{output}) {becomes}\n")
}
