//! Who commands the motors: the nodes, or the hardware itself to let the robot down.

use std::time::Duration;

use framework::Timestamp;
use types::joints::Joints;
use types::motor_commands::MotorCommands;

/// How long stiffness takes to fade.
const RAMP: Duration = Duration::from_millis(500);

/// The commander, and what it said last.
#[derive(Debug, Default)]
pub struct Safety {
    last: MotorCommands,
    phase: Phase,
    /// The nodes have lost the motors and have not read of it: what they command belongs to a body that is not so any more.
    is_news: bool,
    /// The chest button, when somebody looked last.
    was_down: bool,
}

#[derive(Debug, Default)]
enum Phase {
    /// The nodes command.
    #[default]
    Armed,
    /// Since the first step after this the hardware commands.
    Entered,
    /// Fading since then, from these stiffnesses.
    Fading(Timestamp, Joints<f32>),
}

impl Safety {
    /// Takes the motors away from the nodes.
    pub fn enter(&mut self) {
        if matches!(self.phase, Phase::Armed) {
            self.phase = Phase::Entered;
            self.is_news = true;
        }
    }

    /// For the nodes, with the next sample of the sensors: whether their commands are dropped, now or at any time since the
    /// last sample.
    pub fn tell(&mut self) -> bool {
        let is_news = std::mem::take(&mut self.is_news);
        is_news || !matches!(self.phase, Phase::Armed)
    }

    /// Gives the motors back, as soon as the nodes know that they had lost them.
    pub fn rearm(&mut self) {
        self.phase = Phase::Armed;
    }

    /// Whether the chest button, which is down or not now, was pressed to give the motors back: not while the robot is being
    /// let down, nor while the nodes have them.
    pub fn is_rearm_wanted(&mut self, is_down: bool, now: Timestamp) -> bool {
        let is_pressed = is_down && !self.was_down;
        self.was_down = is_down;
        is_pressed && !matches!(self.phase, Phase::Armed) && !self.is_fading(now)
    }

    /// Remembers a command of the nodes; whether it may be sent.
    pub fn permits(&mut self, commands: &MotorCommands) -> bool {
        let permitted = matches!(self.phase, Phase::Armed) && !self.is_news;
        if permitted {
            self.last = *commands;
        }
        permitted
    }

    /// What the hardware commands now: the last positions with fading stiffness.
    pub fn command(&mut self, now: Timestamp) -> Option<MotorCommands> {
        let (since, from) = match self.phase {
            Phase::Armed => return None,
            Phase::Entered => (now, self.last.stiffnesses),
            Phase::Fading(since, from) => (since, from),
        };
        self.phase = Phase::Fading(since, from);
        let left = 1.0 - ((now - since).as_secs_f32() / RAMP.as_secs_f32()).min(1.0);
        // Kept: who is let down again before the nodes have commanded does not become stiff for that.
        self.last.stiffnesses = from.map(|stiffness| stiffness * left);
        Some(self.last)
    }

    /// Whether the robot is about to be let down.
    pub fn is_fading(&self, now: Timestamp) -> bool {
        match self.phase {
            Phase::Armed => false,
            Phase::Entered => true,
            Phase::Fading(since, _) => now - since < RAMP,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(milliseconds: u64) -> Timestamp {
        Timestamp::from_nanos(milliseconds * 1_000_000)
    }

    #[test]
    fn the_chest_button_counts_once_when_the_robot_is_down() {
        let mut safety = Safety::default();
        assert!(
            !safety.is_rearm_wanted(true, at(0)),
            "the nodes have the motors"
        );
        safety.is_rearm_wanted(false, at(10));
        safety.enter();
        safety.command(at(20));
        assert!(
            !safety.is_rearm_wanted(true, at(30)),
            "it is being let down"
        );
        assert!(
            !safety.is_rearm_wanted(true, at(600)),
            "it is still the same press"
        );
        safety.is_rearm_wanted(false, at(610));
        assert!(safety.is_rearm_wanted(true, at(620)));
        assert!(!safety.is_rearm_wanted(true, at(630)));
    }

    #[test]
    fn stiffness_fades_while_the_nodes_are_ignored() {
        let mut safety = Safety::default();
        let stiff = MotorCommands {
            positions: Joints::filled(0.3),
            stiffnesses: Joints::filled(0.8),
        };
        assert!(safety.permits(&stiff));
        assert_eq!(safety.command(at(0)), None);
        safety.enter();
        assert!(!safety.permits(&MotorCommands::default()));
        let stiffness = |safety: &mut Safety, time| {
            let command = safety.command(at(time)).unwrap();
            assert_eq!(command.positions, stiff.positions);
            command.stiffnesses.head_yaw
        };
        assert_eq!(stiffness(&mut safety, 100), 0.8);
        assert!((stiffness(&mut safety, 350) - 0.4).abs() < 1e-6);
        assert!(safety.is_fading(at(350)));
        assert_eq!(stiffness(&mut safety, 600), 0.0);
        assert!(!safety.is_fading(at(600)));
        assert!(safety.tell());
        safety.rearm();
        assert!(safety.permits(&stiff));
    }

    #[test]
    fn nodes_that_have_not_read_of_it_do_not_get_the_motors_back() {
        let mut safety = Safety::default();
        let stiff = MotorCommands::holding(Joints::filled(0.3), 0.8);
        assert!(!safety.tell());
        safety.enter();
        safety.command(at(0));
        safety.rearm();
        assert!(!safety.permits(&stiff), "of a cycle that began before");
        assert_eq!(safety.command(at(12)), None);
        assert!(safety.tell());
        assert!(safety.permits(&stiff));
        assert!(!safety.tell());
        safety.enter();
        assert!(safety.tell() && safety.tell(), "for as long as it lasts");
        safety.rearm();
        assert!(safety.permits(&stiff) && !safety.tell());
    }

    #[test]
    fn a_limp_body_that_is_let_down_again_does_not_become_stiff_for_that() {
        let mut safety = Safety::default();
        safety.permits(&MotorCommands::holding(Joints::filled(0.3), 0.8));
        safety.enter();
        safety.command(at(0));
        safety.command(at(600));
        safety.rearm();
        safety.enter();
        let limp = safety.command(at(700)).unwrap().stiffnesses;
        assert_eq!(limp, Joints::filled(0.0));
    }
}
