//! Same events, same bits: of every main output of every cycle of every instance.
//!
//! That a node which reads the wall clock, or iterates a hash map, breaks it is asserted in `tests/tests/failures.rs`, which
//! compiles such nodes into a copy of the zoo.

use std::collections::{BTreeMap, BTreeSet};

use framework::{Digest, Given, Instance, Lockstep, Timestamp};
use serde_json::json;

use crate::Zoo;

/// Of one run: the number of cycles of every instance, and digests of all values of every output.
#[derive(Debug, Default, PartialEq, Eq)]
struct Run {
    cycles: BTreeMap<&'static str, u64>,
    digests: BTreeMap<(&'static str, &'static str), Vec<u64>>,
}

const SECONDS: u64 = 3;

impl Run {
    fn of(mut zoo: Zoo, seed: Option<u64>) -> Self {
        let mut run = Self::default();
        let mut lockstep = Lockstep::new(&mut zoo.robot, &*zoo.hardware);
        if let Some(seed) = seed {
            lockstep = lockstep.chaotic(seed);
        }
        let end = Timestamp::from_nanos(SECONDS * 1_000_000_000);
        let ran = lockstep.run_until(end, |instance| run.add(instance));
        ran.expect("the zoo does not stop");
        run
    }

    fn add(&mut self, instance: &dyn Instance) {
        let name = instance.description().name;
        *self.cycles.entry(name).or_default() += 1;
        for output in instance.main_outputs() {
            let value = instance.main_output(output).expect("it has one");
            let mut digest = Digest::new();
            let added = digest.add(value.as_serialize());
            added.expect("outputs serialise");
            let values = self.digests.entry((name, output)).or_default();
            values.push(digest.value());
        }
    }
}

#[test]
fn the_same_events_give_the_same_bits() {
    let first = Run::of(Zoo::new(), None);
    let cycles = [
        ("Control", 250),
        ("Hearing", 149),
        ("Lights", 30),
        ("Reflexes", 300),
        ("VisionBottom", 89),
        ("VisionTop", 90),
    ];
    assert_eq!(first.cycles, BTreeMap::from(cycles));
    // An output that never changes would be equal whatever went wrong.
    let constant = |values: &Vec<u64>| values.iter().collect::<BTreeSet<_>>().len() == 1;
    let constant = first.digests.iter().filter(|(_, values)| constant(values));
    let constant: Vec<_> = constant.map(|(output, _)| *output).collect();
    assert_eq!(constant, CONSTANT);
    assert_eq!(first, Run::of(Zoo::new(), None));
}

/// How many forms of a path agree; what nobody calls the procedure for; what follows from parameters alone.
const CONSTANT: [(&str, &str); 3] = [
    ("Control", "seen"),
    ("Control", "speed"),
    ("Reflexes", "sum"),
];

#[test]
fn one_seed_gives_the_same_bits_and_another_one_others() {
    let first = Run::of(Zoo::new(), Some(1));
    assert_eq!(first, Run::of(Zoo::new(), Some(1)));
    assert_ne!(first.digests, Run::of(Zoo::new(), Some(2)).digests);
    assert_ne!(first.digests, Run::of(Zoo::new(), None).digests);
}

#[test]
fn an_injected_output_shows_in_the_bits() {
    let mut zoo = Zoo::new();
    let access = zoo.robot.access("Control").expect("it is an instance");
    let spot = json!({ "x": 7.0, "brightness": 1.0 });
    let injected = access.injector.inject("target", &Given::from(&spot));
    injected.expect("the value fits");
    assert_ne!(Run::of(Zoo::new(), None), Run::of(zoo, None));
}
