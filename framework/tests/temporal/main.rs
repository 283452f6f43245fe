//! Cycles of several instances in one order of time: against a model, and case by case.

mod cases;
mod model;
mod system;

use proptest::prelude::*;

use self::system::{Operation, System};

const STEPS: [Operation; 10] = [
    Operation::Announce(0, 0),
    Operation::Announce(0, 5),
    Operation::Announce(1, 0),
    Operation::Announce(1, 5),
    Operation::Complete(0),
    Operation::Complete(1),
    Operation::Abandon(0),
    Operation::Abandon(1),
    Operation::Consume(0),
    Operation::Consume(3),
];

#[test]
fn every_interleaving_of_eight_steps_is_as_the_model_says() {
    let instances = [(16, u64::MAX), (16, u64::MAX)];
    let runs = explore(instances, &mut Vec::new(), 8);
    assert!(runs > 100_000, "{runs}");
}

#[test]
fn every_interleaving_with_small_windows_and_a_timeout_is_as_the_model_says() {
    let runs = explore([(1, 3), (2, u64::MAX)], &mut Vec::new(), 8);
    assert!(runs > 100_000, "{runs}");
}

/// Runs all sequences of steps that apply, followed by one more look; their number.
fn explore(instances: [(usize, u64); 2], steps: &mut Vec<Operation>, left: usize) -> u64 {
    if left == 0 {
        let mut system = System::new(instances);
        steps.iter().for_each(|step| system.apply(*step));
        system.apply(Operation::Consume(0));
        return 1;
    }
    let mut runs = 0;
    for step in STEPS {
        if applies(step, steps) {
            steps.push(step);
            runs += explore(instances, steps, left - 1);
            steps.pop();
        }
    }
    runs
}

fn applies(step: Operation, before: &[Operation]) -> bool {
    let mut is_announced = [false; 2];
    for operation in before {
        match *operation {
            Operation::Announce(instance, _) => is_announced[instance] = true,
            Operation::Complete(instance) | Operation::Abandon(instance) => {
                is_announced[instance] = false;
            }
            Operation::Consume(_) => {}
        }
    }
    match step {
        Operation::Announce(instance, _) => !is_announced[instance],
        Operation::Complete(instance) | Operation::Abandon(instance) => is_announced[instance],
        Operation::Consume(_) => !matches!(before.last(), Some(Operation::Consume(_))),
    }
}

fn operation() -> impl Strategy<Value = Operation> {
    prop_oneof![
        4 => (0..3_usize, 0..=10_u64).prop_map(|(instance, age)| Operation::Announce(instance, age)),
        4 => (0..3_usize).prop_map(Operation::Complete),
        1 => (0..3_usize).prop_map(Operation::Abandon),
        3 => (0..6_u64).prop_map(Operation::Consume),
    ]
}

fn instance() -> impl Strategy<Value = (usize, u64)> {
    (1..6_usize, prop_oneof![3 => 2..40_u64, 1 => Just(u64::MAX)])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn long_random_runs_are_as_the_model_says(
        instances in [instance(), instance(), instance()],
        operations in prop::collection::vec(operation(), 1..400),
    ) {
        let mut system = System::new(instances);
        operations.into_iter().for_each(|operation| system.apply(operation));
        system.apply(Operation::Consume(0));
    }
}
