//! Other parameters over many cycles: each goes on with what the one before it left.

use framework::replay::{Comparison, OtherParameters, Players, Shelf, compare, with_settings};
use framework::{Record, recorded::Settings};
use hulkgen_recording::Recording as File;
use zoo_runtime::parameters::Parameters;
use zoo_runtime::recording;

use super::asked::{GRAPH, recorded};
use super::{Tape, as_it_is, record_in_lockstep};

/// What this setting changes, or none where there is no setting.
fn carried(file: &File, setting: Option<(&str, &str)>) -> Comparison {
    let shelf = Shelf::of(file).expect("it is of this version");
    let settings: Vec<_> = setting
        .map(|(path, value)| (path.to_owned(), value.to_owned()))
        .into_iter()
        .collect();
    let other = OtherParameters::new(&shelf, &mut |recorded| {
        with_settings::<Parameters>(recorded, &settings)
    });
    let other = other.expect("it is a parameter");
    let players = || Players::new(&shelf, recording::INSTANCES).expect("it fits");
    let after = players().under(&other).carrying(GRAPH);
    let mut after = after.expect("it is the graph of the zoo");
    compare(&mut players(), &mut after, None).expect("both answer")
}

#[test]
fn without_another_parameter_nothing_changes() {
    let tape = recorded();
    let comparison = carried(&tape.read(), None);
    assert_eq!(comparison.changes, [], "{comparison}");
    for one in &comparison.instances {
        assert_eq!(one.unfit, None, "{comparison}");
        // But the first, and those after a restart or one that needed hardware.
        let carried = one.carried.expect("it was asked for");
        assert!(carried > one.cycles / 2, "{comparison}");
    }
    let control = &comparison.instances[3];
    assert_eq!(control.carried, Some(control.cycles - 1), "{comparison}");
}

#[test]
fn what_a_parameter_did_to_a_state_stays() {
    let tape = recorded();
    let comparison = carried(&tape.read(), Some(("walking_speed", "0.9")));
    let plan = comparison.changes.iter().find(|one| one.output == "plan");
    let plan = plan.expect("the gait reads it until there is a target");
    // From recorded states five cycles change; the phase that these leave behind is another one for good.
    assert_eq!(plan.cycle, 1, "{comparison}");
    assert!(plan.cycles > 100, "{comparison}");
}

#[test]
fn where_cycles_are_missing_it_begins_with_what_was_recorded() {
    let tape = Tape::new();
    record_in_lockstep(
        &tape.path,
        Settings::default(),
        |_| Record::Every(2),
        &as_it_is,
    );
    let comparison = carried(&tape.read(), None);
    assert_eq!(comparison.changes, [], "{comparison}");
    let control = &comparison.instances[3];
    assert_eq!(control.carried, Some(0), "{comparison}");
    assert!(control.cycles > 50, "{comparison}");
}
