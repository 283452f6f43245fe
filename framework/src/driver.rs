//! Two ways to turn the same instances: [`threads`] in the real world, [`lockstep`] on a virtual clock.

mod chaos;
pub mod lockstep;
pub mod observer;
mod overdue;
pub mod safe_state;
pub mod threads;

pub use lockstep::{Lockstep, Paused, Together};
pub use observer::Observer;
pub use safe_state::SafeState;
pub use threads::Threads;
