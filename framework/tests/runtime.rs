//! Instances with hand-written bodies under both drivers.

#[path = "runtime/body.rs"]
mod body;
#[path = "runtime/clients.rs"]
mod clients;
#[path = "runtime/elsewhere.rs"]
mod elsewhere;
#[path = "runtime/failures.rs"]
mod failures;
#[path = "runtime/lockstep.rs"]
mod lockstep;
#[path = "runtime/observer.rs"]
mod observer;
#[path = "runtime/process.rs"]
mod process;
#[path = "runtime/replayed.rs"]
mod replayed;
#[path = "runtime/reports.rs"]
mod reports;
#[path = "runtime/scenario.rs"]
mod scenario;
#[path = "runtime/scheduling.rs"]
mod scheduling;
#[path = "runtime/scripted.rs"]
mod scripted;
#[path = "runtime/tap.rs"]
mod tap;
#[path = "runtime/threads.rs"]
mod threads;
#[path = "runtime/together.rs"]
mod together;
#[path = "runtime/unbegun.rs"]
mod unbegun;
#[path = "runtime/verified.rs"]
mod verified;
#[path = "runtime/wake_up.rs"]
mod wake_up;
