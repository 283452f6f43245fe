//! What is not as it was is named: instance, cycle, node, output.

use std::ops::RangeInclusive;
use std::sync::Arc;

use framework::cycler::{Counters, Reference};
use framework::driver::Observer;
use framework::recorded::{Capture, Digests, Forms, SaveError, Saving, Settings, Types};
use framework::reflect::Reflect;
use framework::report::InstanceReport;
use framework::tap::{Reports, Tap};
use framework::{
    Cycle, Finished, Given, Instance, InstanceDescription, Restarted, Result, State, Subscriptions,
    Timestamp, Waited,
};
use serde_json::Value;

use super::{Tape, on, record_in_lockstep};

/// The cycle that differs.
const CYCLE: u64 = 40;

/// What a recording sees of an instance one of whose outputs has one bit flipped.
struct Flipped {
    description: InstanceDescription,
    cycle: Cycle,
    report: InstanceReport,
    counters: Arc<Counters>,
    digests: Vec<u64>,
}

impl Flipped {
    fn new(instance: &dyn Instance, flipped: &str) -> Self {
        let mut digests = Vec::new();
        let visited = instance.digests(&mut |_, output, digest| {
            digests.push(digest ^ u64::from(output == flipped));
        });
        visited.expect("every output serialises");
        Self {
            description: *instance.description(),
            cycle: instance.cycle(),
            report: instance.report(),
            counters: instance.counters().clone(),
            digests,
        }
    }
}

/// Records an instance that flips one bit of one output in some cycles.
struct Flipping {
    observer: Box<dyn Observer>,
    output: &'static str,
    cycles: RangeInclusive<u64>,
}

/// Records everybody, one of them so.
pub(crate) fn record_flipping(
    tape: &Tape,
    whose: &str,
    output: &'static str,
    cycles: RangeInclusive<u64>,
) {
    record_in_lockstep(
        &tape.path,
        Settings::default(),
        on,
        &|instance, observer| match instance.name == whose {
            true => Box::new(Flipping {
                observer,
                output,
                cycles: cycles.clone(),
            }),
            false => observer,
        },
    );
}

impl Observer for Flipping {
    fn begun(&mut self, instance: &mut dyn Instance) {
        self.observer.begun(instance);
    }

    fn finished(&mut self, instance: &dyn Instance) {
        if self.cycles.contains(&instance.cycle().number) {
            self.observer.finished(&Flipped::new(instance, self.output));
        } else {
            self.observer.finished(instance);
        }
    }
}

/// Changes a state right after it was saved: as if saving had left it out.
struct Forgetting {
    observer: Box<dyn Observer>,
    state: &'static str,
    becomes: &'static str,
}

impl Observer for Forgetting {
    fn begun(&mut self, instance: &mut dyn Instance) {
        self.observer.begun(instance);
        if instance.cycle().number == CYCLE {
            instance.states(&mut |name, state| {
                if name == self.state {
                    let becomes: Value = serde_json::from_str(self.becomes).expect("JSON");
                    let loaded = state.load(&Given::from(&becomes));
                    loaded.expect("it is such a state");
                }
            });
        }
    }

    fn finished(&mut self, instance: &dyn Instance) {
        self.observer.finished(instance);
    }
}

#[test]
fn a_flipped_bit_of_any_output_is_named_with_its_node_and_cycle() {
    let outputs = [
        ("VisionTop", "zoo_nodes::vision::spot_finder", "spots"),
        ("VisionBottom", "zoo_nodes::vision::spot_finder", "best"),
        ("Hearing", "zoo_nodes::hearing::whistle", "whistle"),
        ("Control", "zoo_nodes::control::pose_filter", "pose"),
        ("Control", "zoo_nodes::control::spot_filter", "target"),
        ("Control", "zoo_nodes::control::watcher", "seen"),
        ("Control", "zoo_nodes::control::gait", "plan"),
        ("Control", "zoo_nodes::control::gait", "speed"),
        ("Control", "zoo_nodes::shared::counter", "cycles"),
    ];
    for (whose, node, output) in outputs {
        let tape = Tape::new();
        record_flipping(&tape, whose, output, CYCLE..=CYCLE);
        let verification = tape.verify();
        assert!(!verification.is_good(), "{whose} {output}");
        let diverged: u64 = verification.instances.iter().map(|one| one.diverged).sum();
        assert_eq!(diverged, 1, "{verification}");
        let divergence = verification.divergence.expect("one bit differs");
        let found = (
            divergence.instance,
            divergence.cycle,
            &*divergence.node,
            &*divergence.output,
        );
        assert_eq!(found, (whose, CYCLE, node, output));
        assert!(divergence.recomputed.is_some());
    }
}

/// Records an instance as if one of its outputs were not there yet.
struct Lacking(Box<dyn Observer>);

impl Observer for Lacking {
    fn begun(&mut self, instance: &mut dyn Instance) {
        self.0.begun(instance);
    }

    fn finished(&mut self, instance: &dyn Instance) {
        let mut lacking = Flipped::new(instance, "");
        lacking.digests.pop();
        self.0.finished(&lacking);
    }
}

#[test]
fn digests_of_other_outputs_are_not_compared() {
    let tape = Tape::new();
    record_in_lockstep(
        &tape.path,
        Settings::default(),
        on,
        &|instance, observer| match instance.name {
            "Control" => Box::new(Lacking(observer)),
            _ => observer,
        },
    );
    let verification = tape.verify();
    assert_eq!(verification.divergence, None, "{verification}");
    for one in &verification.instances {
        let is_other = one.instance == "Control";
        assert_eq!(one.is_good(), !is_other, "{verification}");
        assert_eq!(one.unreadable.is_some(), is_other, "{verification}");
    }
    let text = verification.to_string();
    let said = "the recording has 6 outputs of it, this robot 7: it is of another graph";
    assert!(text.contains(said), "{text}");
}

#[test]
fn what_saving_leaves_out_is_noticed() {
    for (state, becomes, node, output) in [
        (
            "cycler_state",
            r#"{"count": 7000, "filter": {"drift": {"x": 0.0, "y": 0.0}, "gain": 0.5}, "gait": {"phase": 0.5}}"#,
            "",
            "",
        ),
        (
            "zoo_nodes::control::gait",
            r#"{"speed": 12.5}"#,
            "zoo_nodes::control::gait",
            "plan",
        ),
    ] {
        let tape = Tape::new();
        record_in_lockstep(
            &tape.path,
            Settings::default(),
            on,
            &|instance, observer| {
                if instance.name == "Control" {
                    Box::new(Forgetting {
                        observer,
                        state,
                        becomes,
                    })
                } else {
                    observer
                }
            },
        );
        let verification = tape.verify();
        let divergence = verification
            .divergence
            .as_ref()
            .expect("the state was other");
        assert_eq!(
            (divergence.instance, divergence.cycle),
            ("Control", CYCLE),
            "{verification}"
        );
        if !node.is_empty() {
            assert_eq!((&*divergence.node, &*divergence.output), (node, output));
        }
    }
}

impl Instance for Flipped {
    fn save_digests(&self, digests: &mut Digests<'_, '_>) {
        self.digests
            .iter()
            .for_each(|digest| digests.add_digest(*digest));
    }

    fn digested(&self) -> &'static [(&'static str, &'static str)] {
        &[]
    }

    fn description(&self) -> &InstanceDescription {
        &self.description
    }

    fn cycle(&self) -> Cycle {
        self.cycle
    }

    fn wait(&mut self) -> Result<Waited> {
        Ok(Waited::Stopped)
    }

    fn begin(&mut self) {}

    fn run(&mut self) {}

    fn finish(&mut self) -> Result<Finished> {
        Ok(Finished::Stopped)
    }

    fn abandon(&mut self) {}

    fn restart(&mut self) -> Result<Restarted> {
        Ok(Restarted::Stopped)
    }

    fn counters(&self) -> &Arc<Counters> {
        &self.counters
    }

    fn report(&self) -> InstanceReport {
        self.report.clone()
    }

    fn tap(&mut self, _: &Subscriptions) -> (Vec<Tap>, Reports) {
        (Vec::new(), Reports::silent())
    }

    fn forms(&self, _: &mut Forms) {}

    fn types(&self) -> Types {
        Types::default()
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &[]
    }

    fn main_output(&self, _: &str) -> Option<&dyn Reflect> {
        None
    }

    fn additional_output(&self, _: &str) -> Option<&dyn Reflect> {
        None
    }

    fn references(&self, _: &mut dyn FnMut(Reference)) {}

    fn states(&mut self, _: &mut dyn FnMut(&'static str, &mut dyn State)) {}

    fn restore(&mut self) -> Result<()> {
        Ok(())
    }

    fn save(&mut self, _: &mut Capture<'_, '_>) -> std::result::Result<(), SaveError> {
        Ok(())
    }

    fn save_alone(&mut self, _: Option<Timestamp>, _: &mut Saving<'_, '_>) {}
}
