//! Whatever is wished for, feet and joints move as legs can.

mod parameters;

use framework::Reflect;
use kinematics::limits;
use proptest::prelude::*;
use types::feet::{Feet, Side};
use types::joints::{JointName, Joints};
use types::motion::Step;
use walking::{Engine, Parameters, Senses};

use parameters::parameters;

const CYCLE: f32 = 0.012;

/// A floor: feet feel it once their stride has come down.
fn pressures(engine: &Engine, floor_at: f32) -> Feet<f32> {
    let Some(stride) = engine.stride() else {
        return Feet {
            left: 0.5,
            right: 0.5,
        };
    };
    let touches = stride.duration * floor_at;
    let swing = |elapsed: f32| if elapsed >= touches { 0.5 } else { 0.0 };
    let swing = swing(engine.elapsed());
    match stride.support {
        Side::Left => Feet {
            left: 1.0 - swing,
            right: swing,
        },
        Side::Right => Feet {
            left: swing,
            right: 1.0 - swing,
        },
    }
}

fn cycle(engine: &mut Engine, wanted: Option<Step>, floor_at: f32) -> Joints<f32> {
    let senses = Senses {
        since_last: CYCLE,
        angular_velocity: [0.0; 2],
        heading: f32::NAN,
        pressures: pressures(engine, floor_at),
    };
    engine.cycle(wanted, &senses, &parameters()).positions
}

fn wish() -> impl Strategy<Value = Option<Step>> {
    let any = (-0.2..0.2_f32, -0.2..0.2_f32, -2.0..2.0_f32);
    prop::option::weighted(0.8, any).prop_map(|wish| {
        wish.map(|(forward, left, turn)| Step {
            forward,
            left,
            turn,
        })
    })
}

fn legs() -> impl Iterator<Item = JointName> {
    JointName::ALL
        .into_iter()
        .filter(|joint| (7..=17).contains(&(*joint as usize)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn joints_stay_within_limits_and_do_not_jump(
        wishes in prop::collection::vec((wish(), 1..60_usize, 0.8..1.2_f32), 1..12),
    ) {
        let mut engine = Engine::new();
        let mut last: Option<Joints<f32>> = None;
        for (wish, cycles, floor_at) in wishes {
            for _ in 0..cycles {
                let joints = cycle(&mut engine, wish, floor_at);
                for joint in legs() {
                    let angle = joints[joint];
                    prop_assert!((limits::clamp(joint, angle) - angle).abs() < 1e-6, "{joint:?} {angle}");
                    let before = last.map_or(angle, |last| last[joint]);
                    let speed = (angle - before).abs() / CYCLE;
                    let most = limits::of(joint).velocity as f32;
                    prop_assert!(speed <= most, "{joint:?} moves with {speed} of {most} rad/s");
                }
                last = Some(joints);
            }
        }
    }

    #[test]
    fn a_walk_that_is_not_wanted_any_more_stops(wish in wish(), cycles in 1..200_usize, floor_at in 0.8..1.2_f32) {
        let mut engine = Engine::new();
        for _ in 0..cycles {
            cycle(&mut engine, wish, floor_at);
        }
        let most = (6.0 * parameters().stride.timeout / CYCLE) as usize;
        let stopped = (0..most).any(|_| {
            cycle(&mut engine, None, floor_at);
            engine.is_standing()
        });
        prop_assert!(stopped);
        let standing = cycle(&mut engine, None, floor_at);
        prop_assert_eq!(standing, cycle(&mut Engine::new(), None, 1.0));
    }

    #[test]
    fn left_is_right_in_the_mirror(wish in wish(), cycles in 1..100_usize) {
        // Turning and stepping aside begin with the other foot; straight on begins with the left one in both.
        prop_assume!(wish.is_some_and(|wish| wish.left != 0.0));
        let mirrored = wish.map(|wish| Step { left: -wish.left, turn: -wish.turn, ..wish });
        let (mut one, mut other) = (Engine::new(), Engine::new());
        for _ in 0..cycles {
            let (one, other) = (cycle(&mut one, wish, 1.0), cycle(&mut other, mirrored, 1.0));
            prop_assert!((one.left_hip_pitch - other.right_hip_pitch).abs() < 1e-4);
            prop_assert!((one.left_hip_roll + other.right_hip_roll).abs() < 1e-4);
            prop_assert!((one.hip_yaw_pitch - other.hip_yaw_pitch).abs() < 1e-4);
            prop_assert!((one.left_shoulder_pitch - other.right_shoulder_pitch).abs() < 1e-4);
        }
    }

    #[test]
    fn no_number_breaks_it(
        forward in any::<f32>(), left in any::<f32>(), turn in any::<f32>(), gyro in any::<f32>(),
    ) {
        let mut engine = Engine::new();
        for _ in 0..100 {
            let senses = Senses {
                since_last: CYCLE,
                angular_velocity: [gyro, gyro],
                heading: gyro,
                pressures: pressures(&engine, 1.0),
            };
            let wanted = Some(Step { forward, left, turn });
            let joints = engine.cycle(wanted, &senses, &parameters()).positions;
            prop_assert!(joints.to_array().iter().all(|angle| angle.is_finite()));
        }
    }
}

#[test]
fn steps_add_up_to_the_way() {
    let mut engine = Engine::new();
    let wish = Step {
        forward: 0.05,
        left: 0.0,
        turn: 0.0,
    };
    let (mut way, mut last, mut strides) = (0.0, None, 0);
    while strides < 20 {
        cycle(&mut engine, Some(wish), 1.0);
        let stride = *engine.stride().expect("it walks");
        if last != Some(stride) {
            (last, strides) = (Some(stride), strides + 1);
        }
        // The body goes on as the support foot goes back.
        let soles = stride.soles(engine.elapsed());
        let next = stride.soles(engine.elapsed() + CYCLE);
        way += soles.on(stride.support).forward - next.on(stride.support).forward;
    }
    // 0, 1, 2, 3, 4 and then 15 of 5 cm, of which the last only begins; half of a step before it is made good by the next.
    assert!((way - 0.80).abs() < 0.05, "{way}");
}

#[test]
fn every_step_turns_the_body_by_the_same() {
    for turn in [0.1, -0.1] {
        let mut engine = Engine::new();
        let wish = Step { turn, ..Step::ZERO };
        let (mut turned, mut last, mut strides) = (0.0, None, 0);
        while strides < 22 {
            cycle(&mut engine, Some(wish), 1.0);
            let stride = *engine.stride().expect("it walks");
            if last != Some(stride) {
                (last, strides) = (Some(stride), strides + 1);
            }
            // The body turns as the support foot turns back.
            let soles = stride.soles(engine.elapsed());
            let next = stride.soles(engine.elapsed() + CYCLE);
            turned += soles.on(stride.support).yaw - next.on(stride.support).yaw;
        }
        // One on the spot, and 20 that turn, more than asked since soles slip.
        let all = 20.0 * turn / parameters().course.effect;
        assert!((turned - all).abs() < 0.1 * all.abs(), "{turned} of {all}");
    }
}

#[test]
fn a_foot_that_never_lands_is_not_waited_for_for_ever() {
    let mut engine = Engine::new();
    let wish = Some(Step {
        forward: 0.05,
        ..Step::ZERO
    });
    let supports: Vec<_> = (0..300)
        .map(|_| {
            let senses = Senses {
                since_last: CYCLE,
                ..Senses::default()
            };
            engine.cycle(wish, &senses, &parameters());
            engine.support()
        })
        .collect();
    let changes = supports
        .windows(2)
        .filter(|pair| pair[0] != pair[1])
        .count();
    // 3.6 s in strides of 0.6 s.
    assert!((5..=6).contains(&changes), "{changes}");
}

#[test]
fn a_body_that_falls_forward_turns_its_toes_down() {
    let (mut still, mut falling) = (Engine::new(), Engine::new());
    let mut ankles = (0.0, 0.0);
    for _ in 0..20 {
        let senses = |about_y| Senses {
            since_last: CYCLE,
            angular_velocity: [0.0, about_y],
            heading: 0.0,
            pressures: Feet {
                left: 0.5,
                right: 0.5,
            },
        };
        let ankle = |engine: &mut Engine, about_y| {
            engine
                .cycle(None, &senses(about_y), &parameters())
                .positions
                .left_ankle_pitch
        };
        ankles = (ankle(&mut still, 0.0), ankle(&mut falling, 1.0));
    }
    assert!((ankles.1 - ankles.0 - 0.05).abs() < 0.001, "{ankles:?}");
}

fn any_sign() -> impl Strategy<Value = f32> {
    prop_oneof![Just(-1.0_f32), Just(0.0), Just(1.0)]
}

proptest! {
    #[test]
    fn no_sign_of_a_limit_stops_the_walk(
        wish in wish(),
        signs in prop::array::uniform8(any_sign()),
        about_y in -5.0..5.0_f32,
    ) {
        let mut with_signs = parameters();
        let Parameters { limits, course, balance, .. } = &mut with_signs;
        let numbers = [
            &mut limits.forward,
            &mut limits.backward,
            &mut limits.sideways,
            &mut limits.turn,
            &mut limits.acceleration,
            &mut limits.turn_acceleration,
            &mut course.most,
            &mut balance.greatest_speed,
        ];
        for (number, sign) in numbers.into_iter().zip(signs) {
            *number *= sign;
        }
        let mut engine = Engine::new();
        for _ in 0..100 {
            let senses = Senses {
                since_last: CYCLE,
                angular_velocity: [0.0, about_y],
                heading: 0.0,
                pressures: pressures(&engine, 0.9),
            };
            let positions = engine.cycle(wish, &senses, &with_signs).positions;
            prop_assert!(positions.iter().all(|(_, angle)| angle.is_finite()));
        }
    }
}

#[test]
fn a_limit_of_the_walk_that_is_negative_is_out_of_range() {
    let shipped = serde_json::to_value(parameters()).unwrap();
    let refused = |values| {
        let outside = Parameters::shape().out_of_range(&values, None);
        outside.len()
    };
    assert_eq!(refused(shipped.clone()), 0);
    for (pointer, wrong) in [
        ("/limits/forward", 0.0),
        ("/limits/backward", -0.04),
        ("/limits/sideways", 0.0),
        ("/limits/turn", -0.3),
        ("/limits/acceleration", -0.02),
        ("/limits/turn_acceleration", -0.1),
        ("/stride/duration", 0.0),
        ("/stride/contact_threshold", 1.1),
        ("/course/effect", 0.0),
        ("/course/most", -0.4),
        ("/balance/newest", 1.1),
        ("/balance/greatest_speed", -4.0),
        ("/arms/stiffness", 1.1),
        ("/leg_stiffness", -0.1),
    ] {
        let mut values = shipped.clone();
        *values.pointer_mut(pointer).unwrap() = wrong.into();
        assert_eq!(refused(values), 1, "{pointer} = {wrong}");
    }
}
