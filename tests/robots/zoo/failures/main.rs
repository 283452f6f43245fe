//! Every node of the zoo fails once, as an error and as a panic, in a robot whose every node has the same policy.
//!
//! Run by `tests/tests/failures.rs`, which generates the four robots and says which nodes there are. Prints a line for each
//! failure that did what the manifest says.

use std::collections::BTreeMap;
use std::sync::Arc;

use framework::parameters::Layers;
use framework::testing::created;
use framework::{
    Clock, Error, Instance, Lockstep, ParameterData, Paused, Robot, Start, Stop, Timestamp,
};
use serde_json::Value;
use zoo_hardware::Hardware;
use zoo_nodes::fault::{self, Fault};

/// One node, as hulkgen understands it.
struct Node {
    path: String,
    setup: bool,
    instances: Vec<String>,
    outputs: Vec<String>,
}

type Outputs = BTreeMap<String, Value>;

/// What came of a run.
struct Ran {
    error: Option<Error>,
    /// Finished cycles, begun ones that were not finished, restarts, of each instance.
    counts: BTreeMap<&'static str, [u64; 3]>,
    failures: u64,
    /// How often the actuators were taken away, and given back.
    safe_states: (u64, u64),
    /// Where the node failed in a cycle that finished all the same: its outputs then and in the cycle before.
    held: Option<(Outputs, Outputs)>,
    /// The node's outputs before anything ran.
    defaults: Outputs,
}

/// The run goes on for so long after the failure; restarts wait for 0.1 s at first.
const BEFORE: f64 = 0.5;
const AFTER: f64 = 1.5;

fn outputs(instance: &dyn Instance, node: &Node) -> Outputs {
    let outputs = node.outputs.iter().map(|name| {
        let output = instance.main_output(name).expect("hulkgen says it is one");
        let value = serde_json::to_value(output.as_serialize());
        (name.clone(), value.expect("outputs serialise"))
    });
    outputs.collect()
}

fn failures(instance: &dyn Instance, node: &Node) -> u64 {
    let nodes = instance.report().nodes.into_iter();
    nodes
        .filter(|report| report.node == node.path)
        .map(|report| report.failures)
        .sum()
}

fn run<P: ParameterData>(
    create: &dyn Fn(&Arc<Hardware>, Start<P>) -> framework::Result<Robot<P>>,
    node: &Node,
    panics: Option<bool>,
) -> Ran {
    let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/../parameters").into();
    let layers = Layers {
        directory,
        ..Layers::default()
    };
    let (clock, stop) = (Clock::stepped(), Stop::default());
    let (hardware, mut robot) = created(&layers, "loud", &[], &clock, &stop, create);
    let of_node = |instance: &dyn Instance| {
        node.instances
            .iter()
            .any(|name| name == instance.description().name)
    };
    let first = robot
        .instances
        .iter()
        .find(|instance| of_node(instance.as_ref()));
    let defaults = outputs(first.expect("the node stands somewhere").as_ref(), node);

    let mut before: BTreeMap<&str, (u64, Outputs)> = BTreeMap::new();
    let mut held = None;
    let mut error = None;
    let mut paused: Option<Paused> = None;
    for end in [BEFORE, BEFORE + AFTER] {
        let mut lockstep = Lockstep::new(&mut robot, &*hardware);
        if let Some(paused) = paused.take() {
            lockstep = lockstep.after(paused);
        }
        let end = Timestamp::from_nanos((end * 1e9) as u64);
        let result = lockstep.run_until(end, |instance| {
            if of_node(instance) {
                let (failed, now) = (failures(instance, node), outputs(instance, node));
                let last = before.insert(instance.description().name, (failed, now.clone()));
                if let Some((failed_before, last)) = last
                    && failed_before < failed
                {
                    held = Some((now, last));
                }
            }
        });
        if let Err(why) = result {
            error = Some(why);
            break;
        }
        paused = Some(lockstep.pause());
        if let Some(panics) = panics.filter(|_| end == Timestamp::from_nanos((BEFORE * 1e9) as u64))
        {
            fault::arm(Fault {
                node: node.path.clone(),
                panics,
            });
        }
    }
    let counts = robot.instances.iter().map(|instance| {
        let counts = instance.report().counts;
        let counts = [counts.cycles, counts.abandoned, counts.restarts];
        (instance.description().name, counts)
    });
    Ran {
        error,
        counts: counts.collect(),
        failures: robot
            .instances
            .iter()
            .map(|instance| failures(instance.as_ref(), node))
            .sum(),
        safe_states: hardware.safe_states(),
        held,
        defaults,
    }
}

/// What contract section 5.6 says of a node that fails once under a policy.
fn judge(policy: &str, node: &Node, usual: &Ran, ran: &Ran) {
    let changed: Vec<_> = usual
        .counts
        .iter()
        .filter(|(name, counts)| ran.counts[*name] != **counts)
        .collect();
    assert_eq!(ran.failures, 1, "failures");
    if policy == "stop" {
        let error = ran.error.as_ref().expect("the robot stops").to_string();
        assert!(
            error.contains(&node.path) && error.contains("struck"),
            "{error}"
        );
        assert_eq!(ran.safe_states, (1, 0));
        assert_eq!(
            ran.counts
                .values()
                .map(|[_, _, restarts]| restarts)
                .sum::<u64>(),
            0
        );
        return;
    }
    assert!(ran.error.is_none(), "the robot stopped: {:?}", ran.error);
    let of_node = |name: &str| node.instances.iter().any(|instance| instance == name);
    let touched: Vec<_> = changed.iter().map(|(name, _)| **name).collect();
    assert!(
        touched.iter().all(|name| of_node(name)),
        "it touched {touched:?}"
    );
    let sum = |index: usize| -> i64 {
        let of = |ran: &Ran| {
            ran.counts
                .values()
                .map(|counts| counts[index] as i64)
                .sum::<i64>()
        };
        of(ran) - of(usual)
    };
    if policy == "restart" {
        assert_eq!(sum(2), 1, "one instance starts over");
        assert!(sum(0) < 0, "while it restarts it has no cycles");
        assert_eq!(sum(1), i64::from(!node.setup), "a begun cycle is abandoned");
        let is_real_time = !node
            .instances
            .iter()
            .any(|name| name.starts_with("Vision") || name == "Hearing");
        let shared = node.path.ends_with("shared::counter");
        assert!(
            shared || ran.safe_states == (u64::from(is_real_time), u64::from(is_real_time)),
            "the actuators: {:?}",
            ran.safe_states
        );
        return;
    }
    assert_eq!(ran.safe_states, (0, 0));
    assert_eq!(
        (sum(1), sum(2)),
        (0, 0),
        "nothing is abandoned, nothing starts over"
    );
    if node.setup {
        assert!(
            (-1..=0).contains(&sum(0)),
            "one cycle at most is not: {}",
            sum(0)
        );
        return;
    }
    assert_eq!(sum(0), 0, "every cycle finishes");
    let (outputs, before) = ran.held.as_ref().expect("the cycle finished");
    let expected = if policy == "skip" {
        &ran.defaults
    } else {
        before
    };
    assert_eq!(outputs, expected, "what others see of the node");
}

fn nodes(plan: &Value) -> Vec<Node> {
    let strings = |list: &Value| -> Vec<String> {
        let list = list.as_array().expect("a list").iter();
        list.map(|text| text.as_str().expect("a string").to_owned())
            .collect()
    };
    let nodes = plan.as_array().expect("a list").iter();
    nodes
        .map(|node| Node {
            path: node["path"].as_str().expect("a path").to_owned(),
            setup: node["setup"] == true,
            instances: strings(&node["instances"]),
            outputs: strings(&node["outputs"]),
        })
        .collect()
}

fn main() {
    let plan = std::env::args().nth(1).expect("the nodes as JSON");
    let plan: Value = serde_json::from_str(&plan).expect("JSON");
    let nodes = nodes(&plan);
    macro_rules! fail_all {
        ($($runtime:ident as $policy:literal),*) => {$(
            for node in &nodes {
                let create = |hardware: &Arc<Hardware>, start| $runtime::runtime::create(hardware, start);
                let usual = run(&create, node, None);
                assert!(usual.error.is_none(), "{}: {:?}", $policy, usual.error);
                for panics in [false, true] {
                    let kind = if panics { "panic" } else { "error" };
                    println!("{} {} {kind}", $policy, node.path);
                    let ran = run(&create, node, Some(panics));
                    assert!(!fault::is_armed(), "nobody called it");
                    judge($policy, node, &usual, &ran);
                }
            }
        )*};
    }
    fail_all!(
        stop_runtime as "stop",
        restart_runtime as "restart",
        skip_runtime as "skip",
        hold_runtime as "hold"
    );
}
