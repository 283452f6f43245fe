//! Prints what Localization was given, and what came of it.

use framework::{HardwareInterface, RequiredInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::Console;
use crate::types::{Sets, Span};

/// In the order of [`Sets`].
const CYCLERS: [&str; 3] = ["Vision", "Odometry", "Radio"];

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct SetPrinter {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    sets: RequiredInput<Option<Sets>, "sets?">,
}

#[context]
pub struct MainOutputs {}

impl SetPrinter {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Three lines a cycle.
    pub fn cycle(&mut self, context: CycleContext<impl Console>) -> Result<MainOutputs> {
        let (console, sets) = (context.hardware_interface, context.sets);
        let (at, position) = (sets.at, sets.position);
        console.print(&format!("{at:.3} s: the robot is at {position:.3} m"))?;
        console.print(&format!("  persistent  {}", told(&sets.persistent)))?;
        console.print(&format!("  transient   {}", told(&sets.transient)))?;
        Ok(MainOutputs {})
    }
}

/// Entries by cycler: capture times, and how many they are.
fn told(spans: &[Span; 3]) -> String {
    let some = CYCLERS.iter().zip(spans).filter(|(_, span)| span.count > 0);
    let parts: Vec<String> = some
        .map(|(cycler, span)| match span.count {
            1 => format!("{cycler} {:.3}", span.first),
            count => format!("{cycler} {:.3} to {:.3} ({count})", span.first, span.last),
        })
        .collect();
    match parts.as_slice() {
        [] => "nothing".to_owned(),
        parts => parts.join(", "),
    }
}
