//! What threads ask of the system: policy and priority only mean something together.

use camino::Utf8Path;

use super::{Cycler, SchedulingRanges};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::workspace::MANIFEST;

pub(super) fn check(cycler: &Cycler, diagnostics: &mut Diagnostics) {
    let of_cycler = cycler.declared.scheduling.as_ref();
    if let Some(scheduling) = of_cycler {
        diagnostics.extend(mistakes(scheduling, &cycler.scheduling_ranges, None));
    }
    for instance in &cycler.instances {
        let own = instance
            .table
            .as_ref()
            .and_then(|own| own.scheduling.as_ref());
        if let Some(own) = own {
            diagnostics.extend(mistakes(own, &instance.scheduling_ranges, of_cycler));
        }
    }
}

/// `of_cycler` is what an instance's own `scheduling` stands in place of.
fn mistakes(
    scheduling: &schema::Scheduling,
    ranges: &SchedulingRanges,
    of_cycler: Option<&schema::Scheduling>,
) -> Diagnostics {
    let mut found = Diagnostics::new();
    let file = Utf8Path::new(MANIFEST);
    if let (Some(priority), Some(range)) = (scheduling.priority, &ranges.priority) {
        if !(1..=99).contains(&priority) {
            let message = format!("`{priority}` is no priority of the system's");
            let error = Diagnostic::new(Code::InvalidValue, message);
            let error = error.at(file, range.clone(), "");
            found.add(error.help("write a `priority` from 1 (least urgent) to 99"));
        }
        if scheduling.policy.is_none() {
            let message = "`priority` has no effect: there is no `policy` beside it";
            let warning = Diagnostic::new(Code::UnusedKey, message);
            let warning = warning.at(file, range.clone(), "the system's own policy has none");
            found.add(warning.help(match of_cycler.and_then(|one| one.policy) {
                Some(_) => "write the cycler's `policy` here, too: an instance's `scheduling` counts in place of the cycler's",
                None => "add `policy = \"fifo\"` or `policy = \"round-robin\"`, or remove `priority`",
            }));
        }
    }
    if let (Some(_), None, Some(range)) = (scheduling.policy, scheduling.priority, &ranges.policy) {
        let error = Diagnostic::new(Code::MissingKey, "`priority` is missing").at(
            file,
            range.clone(),
            "the system grants it with a priority alone",
        );
        let inherits = of_cycler.and_then(|one| one.priority);
        found.add(error.help(match inherits {
            Some(priority) => format!(
                "add `priority = {priority}` here, too: an instance's `scheduling` counts in place of the cycler's"
            ),
            None => "add `priority = …`, from 1 (least urgent) to 99".to_owned(),
        }));
    }
    found
}
