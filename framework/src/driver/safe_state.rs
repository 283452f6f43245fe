//! When the actuators are taken away from the nodes, and when the nodes get them back.

use std::collections::BTreeSet;
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::cycler::{InstanceDescription, Kind};
use crate::guarded::contain;
use crate::hardware::Hardware;
use crate::rearm::Rearm;
use crate::report::tell;

/// Calls [`Hardware::enter_safe_state`] at most once until it is re-armed, whoever asks.
pub struct SafeState<'hardware> {
    hardware: &'hardware dyn Hardware,
    causes: Mutex<Causes>,
}

/// Why the actuators are taken away.
#[derive(Debug, Default)]
pub(super) struct Causes {
    /// Real-time instances that restart; ends by itself with the first cycle that they finish.
    restarting: BTreeSet<&'static str>,
    /// Stop or watchdog: ends only when somebody re-arms.
    lasting: bool,
    entered: bool,
}

impl<'hardware> SafeState<'hardware> {
    /// The nodes have the actuators.
    pub fn new(hardware: &'hardware dyn Hardware) -> Self {
        Self {
            hardware,
            causes: Mutex::default(),
        }
    }

    /// What another one knew about the same hardware.
    pub(super) fn set_causes(&mut self, causes: Causes) {
        *self.causes() = causes;
    }

    pub(super) fn take_causes(&mut self) -> Causes {
        std::mem::take(&mut *self.causes())
    }

    /// Takes the actuators away until somebody re-arms: stop or watchdog.
    pub fn enter(&self) {
        let mut causes = self.causes();
        causes.lasting = true;
        self.apply(&mut causes);
    }

    /// Takes the actuators away until the real-time instance has finished a cycle; perception does not command any.
    pub fn enter_while_restarting(&self, instance: &InstanceDescription) {
        if instance.kind == Kind::RealTime {
            let mut causes = self.causes();
            causes.restarting.insert(instance.name);
            self.apply(&mut causes);
        }
    }

    /// The instance has finished its first cycle after a restart.
    pub fn leave_after_restart(&self, instance: &InstanceDescription) {
        let mut causes = self.causes();
        causes.restarting.remove(instance.name);
        self.apply(&mut causes);
    }

    /// [`SafeState::rearm`] where a client or the hardware's own button asked for it.
    pub(super) fn rearm_if_wanted(&self, rearm: &Rearm) {
        let button = contain("Hardware::is_rearm_wanted", || {
            Ok(self.hardware.is_rearm_wanted())
        });
        let button = button.unwrap_or_else(|error| {
            tell(format_args!("{error}"));
            false
        });
        if rearm.take() | button {
            self.rearm();
        }
    }

    /// Somebody wants the nodes to have the actuators again.
    pub fn rearm(&self) {
        let mut causes = self.causes();
        causes.lasting = false;
        self.apply(&mut causes);
    }

    fn causes(&self) -> MutexGuard<'_, Causes> {
        self.causes.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn apply(&self, causes: &mut Causes) {
        let wanted = causes.lasting || !causes.restarting.is_empty();
        if wanted == causes.entered {
            return;
        }
        causes.entered = wanted;
        let (name, change): (_, fn(&dyn Hardware)) = if wanted {
            ("Hardware::enter_safe_state", |hardware| {
                hardware.enter_safe_state()
            })
        } else {
            ("Hardware::rearm", |hardware| hardware.rearm())
        };
        let changed = contain(name, || {
            change(self.hardware);
            Ok(())
        });
        if let Err(error) = changed {
            tell(format_args!("{name}: {error}"));
        }
    }
}
