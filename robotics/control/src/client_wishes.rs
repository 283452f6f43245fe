//! Lets a client drive the robot, as long as it goes on asking.
//!
//! A wish holds for a while and then the behaviour decides again: a client that is gone, or whose connection is, must not leave
//! a robot that walks on. Whoever means it asks again, and `motion` with `Release` ends a wish at once. No wish counts against
//! a robot that is limp, penalised, falling or lying: buttons and referee come first.

use framework::{CycleTime, Input, MainOutput, Parameter, Procedure, Result, context};
use serde::{Deserialize, Serialize};
use types::fall_state::FallState;
use types::game::PrimaryState;
use types::motion::{BodyMotion, ClientWish, MotionRequest, Script, Step};
use walking::StepLimits;

/// What is wished for, and for how long still, in s.
#[derive(Debug, Deserialize, Serialize)]
pub struct ClientWishes {
    wish: Option<(ClientWish, f32)>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    primary_state: Input<PrimaryState, "primary_state">,
    fall_state: Input<FallState, "fall_state">,
    cycle_time: CycleTime,

    /// The largest steps.
    limits: Parameter<StepLimits, "walking_engine.limits">,
    /// In s: how long a walk goes on that nobody asks for again.
    walk_duration: Parameter<f32, "client_wishes.walk_duration">,
    /// In s: how long another motion goes on that nobody asks for again.
    motion_duration: Parameter<f32, "client_wishes.motion_duration">,
    /// In s: how long a kick may wait until the robot can begin it; then it is carried out once.
    kick_duration: Parameter<f32, "client_wishes.kick_duration">,

    /// Steps from now on, answered with the step that the legs can do.
    walk: Procedure<Step, Step, "walk">,
    /// A motion from now on, answered with the seconds for which it is held.
    motion: Procedure<MotionRequest, f32, "motion">,
}

#[context]
pub struct MainOutputs {
    /// What a client wants of the body; `None` where nobody does, or the robot must not listen.
    client_wish: MainOutput<Option<ClientWish>>,
}

impl ClientWishes {
    /// Nobody has asked yet.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { wish: None })
    }

    /// The newest wish that still holds.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let since_last = context.cycle_time.since_last.as_secs_f32();
        self.wish = self
            .wish
            .map(|(wish, left)| (wish, left - since_last))
            .filter(|(_, left)| *left > 0.0);
        let obstacle = obstacle(*context.primary_state, *context.fall_state);
        if let Some(call) = context.walk {
            let asked = *call.request();
            match obstacle.or_else(|| not_a_step(asked)) {
                Some(reason) => call.refuse(reason),
                None => {
                    let step = context.limits.in_volume(asked);
                    let wish = ClientWish {
                        body: BodyMotion::Walk,
                        step,
                    };
                    self.wish = Some((wish, *context.walk_duration));
                    call.answer(step);
                }
            }
        }
        if let Some(call) = context.motion {
            match (body_motion(*call.request()), obstacle) {
                (None, _) => {
                    self.wish = None;
                    call.answer(0.0);
                }
                (Some(_), Some(reason)) => call.refuse(reason),
                (Some(body), None) => {
                    let duration = match body {
                        BodyMotion::Scripted(_) => *context.kick_duration,
                        _ => *context.motion_duration,
                    };
                    let step = Step::ZERO;
                    self.wish = Some((ClientWish { body, step }, duration));
                    call.answer(duration);
                }
            }
        }
        if obstacle.is_some() {
            self.wish = None;
        }
        Ok(MainOutputs {
            client_wish: self.wish.map(|(wish, _)| wish).into(),
        })
    }
}

/// `None` releases the robot.
fn body_motion(request: MotionRequest) -> Option<BodyMotion> {
    match request {
        MotionRequest::Release => None,
        MotionRequest::Stand => Some(BodyMotion::Stand),
        MotionRequest::SitDown => Some(BodyMotion::SitDown),
        MotionRequest::KickLeft => Some(BodyMotion::Scripted(Script::KickLeft)),
        MotionRequest::KickRight => Some(BodyMotion::Scripted(Script::KickRight)),
    }
}

/// Why no client may drive the robot now.
fn obstacle(primary_state: PrimaryState, fall_state: FallState) -> Option<&'static str> {
    match (primary_state, fall_state) {
        (PrimaryState::Unstiff, _) => Some("the robot is limp; its chest button wakes it"),
        (PrimaryState::Penalized, _) => Some("the robot is penalised"),
        (_, FallState::Falling(_)) => Some("the robot falls"),
        (_, FallState::Lying(_)) => Some("the robot lies on the ground"),
        (_, FallState::Upright | FallState::Sitting) => None,
    }
}

fn not_a_step(step: Step) -> Option<&'static str> {
    let is_finite = [step.forward, step.left, step.turn]
        .into_iter()
        .all(f32::is_finite);
    (!is_finite).then_some("`forward`, `left` and `turn` must be finite numbers")
}

#[cfg(test)]
mod tests {
    use framework::procedure::{Answer, procedure};
    use framework::testing;
    use types::fall_state::{Facing, FallDirection};

    use super::*;

    const LIMITS: StepLimits = StepLimits {
        forward: 0.06,
        backward: 0.04,
        sideways: 0.08,
        turn: 0.6,
        acceleration: 0.01,
        turn_acceleration: 0.2,
    };
    const SLOWLY: Step = Step {
        forward: 0.03,
        ..Step::ZERO
    };

    struct Client {
        node: ClientWishes,
        primary_state: PrimaryState,
        fall_state: FallState,
        answers: (Option<Answer<Step>>, Option<Answer<f32>>),
    }

    impl Client {
        fn new() -> Self {
            Self {
                node: ClientWishes::new(CreationContext {}).unwrap(),
                primary_state: PrimaryState::Playing,
                fall_state: FallState::Upright,
                answers: (None, None),
            }
        }

        fn cycle(
            &mut self,
            walk: Option<Step>,
            motion: Option<MotionRequest>,
        ) -> Option<BodyMotion> {
            let (walker, mut walk_answerer) = procedure();
            let (mover, mut motion_answerer) = procedure();
            let walk = walk.map(|step| walker.call(step));
            let motion = motion.map(|request| mover.call(request));
            walk_answerer.take();
            motion_answerer.take();
            let context = CycleContext {
                primary_state: &self.primary_state,
                fall_state: &self.fall_state,
                cycle_time: testing::cycle_time(0, 12),
                limits: &LIMITS,
                walk_duration: &1.0,
                motion_duration: &10.0,
                kick_duration: &0.5,
                walk: walk_answerer.call(),
                motion: motion_answerer.call(),
            };
            let wish = self.node.cycle(context).unwrap().client_wish.value;
            self.answers = (
                walk.and_then(|pending| pending.try_answer()),
                motion.and_then(|pending| pending.try_answer()),
            );
            wish.map(|wish| wish.body)
        }
    }

    #[test]
    fn a_walk_goes_on_for_a_second_unless_it_is_asked_for_again() {
        let mut client = Client::new();
        assert_eq!(client.cycle(None, None), None);
        assert_eq!(client.cycle(Some(SLOWLY), None), Some(BodyMotion::Walk));
        assert_eq!(client.answers.0, Some(Ok(SLOWLY)));
        for _ in 0..60 {
            assert_eq!(client.cycle(None, None), Some(BodyMotion::Walk));
        }
        client.cycle(Some(SLOWLY), None);
        let lasted = (0..200).take_while(|_| client.cycle(None, None).is_some());
        // 1 s in cycles of 12 ms.
        assert_eq!(lasted.count(), 83);
    }

    #[test]
    fn a_step_is_answered_with_what_the_legs_can_do() {
        let mut client = Client::new();
        let far = Step {
            forward: 7.0,
            ..Step::ZERO
        };
        client.cycle(Some(far), None);
        let step = client.answers.0.clone().unwrap().unwrap();
        assert!((step.forward - LIMITS.forward).abs() < 1e-6, "{step:?}");
        let nowhere = Step {
            turn: f32::NAN,
            ..Step::ZERO
        };
        client.cycle(Some(nowhere), None);
        assert!(client.answers.0.as_ref().unwrap().is_err());
    }

    #[test]
    fn releasing_gives_the_robot_back_at_once() {
        let mut client = Client::new();
        client.cycle(Some(SLOWLY), None);
        assert_eq!(client.cycle(None, Some(MotionRequest::Release)), None);
        assert_eq!(client.cycle(None, None), None);
        let sit_down = Some(BodyMotion::SitDown);
        assert_eq!(client.cycle(None, Some(MotionRequest::SitDown)), sit_down);
        assert_eq!(client.answers.1, Some(Ok(10.0)));
        assert_eq!(client.cycle(None, None), sit_down);
    }

    #[test]
    fn nobody_drives_a_robot_that_is_limp_penalised_falling_or_lying() {
        for (primary_state, fall_state) in [
            (PrimaryState::Unstiff, FallState::Upright),
            (PrimaryState::Penalized, FallState::Upright),
            (
                PrimaryState::Playing,
                FallState::Falling(FallDirection::Left),
            ),
            (PrimaryState::Playing, FallState::Lying(Facing::Up)),
        ] {
            let mut client = Client::new();
            client.cycle(Some(SLOWLY), None);
            (client.primary_state, client.fall_state) = (primary_state, fall_state);
            assert_eq!(client.cycle(None, None), None);
            assert_eq!(client.cycle(Some(SLOWLY), Some(MotionRequest::Stand)), None);
            let (walk, motion) = &client.answers;
            assert!(walk.as_ref().unwrap().is_err() && motion.as_ref().unwrap().is_err());
            // And when the robot is up again the old wish is forgotten.
            (client.primary_state, client.fall_state) = (PrimaryState::Playing, FallState::Upright);
            assert_eq!(client.cycle(None, None), None);
        }
    }
}
