//! The walk on legs with masses.

#[path = "../../walking/tests/walking/parameters.rs"]
mod parameters;

use simulated_nao::physics::{Body, Dynamic, Physics, Situation, Start, weight};
use simulated_nao::posture;
use types::feet::Feet;
use types::motion::Step;
use walking::{Engine, Senses};

use parameters::parameters;

const CYCLE: f32 = 0.012;
const STEPS_PER_CYCLE: usize = 4;

fn pressures(body: &Body) -> Feet<f32> {
    let Feet { left, right } = body.contact_forces;
    let share = |forces: [f64; 4]| (forces.iter().sum::<f64>() / weight()) as f32;
    Feet {
        left: share(left),
        right: share(right),
    }
}

fn heading(body: &Body) -> f32 {
    let (.., heading) = body.torso_to_field.rotation.euler_angles();
    heading as f32
}

/// One robot that walks over an empty field.
struct Walk {
    physics: Dynamic,
    engine: Engine,
}

impl Walk {
    fn new(pose: [f64; 3]) -> Self {
        let joints = posture::standing();
        Self {
            physics: Dynamic::new(&Situation {
                robots: vec![Start { joints, pose }],
                ..Situation::default()
            }),
            engine: Engine::new(),
        }
    }

    /// So many seconds with this wish; the robot must not fall meanwhile.
    fn go(&mut self, seconds: f32, wanted: Option<Step>) -> Body {
        for _ in 0..(seconds / CYCLE) as usize {
            let body = self.physics.bodies()[0];
            let velocity = body.angular_velocity;
            let senses = Senses {
                since_last: CYCLE,
                angular_velocity: [velocity.x as f32, velocity.y as f32],
                heading: heading(&body),
                pressures: pressures(&body),
            };
            let commands = [self.engine.cycle(wanted, &senses, &parameters())];
            for _ in 0..STEPS_PER_CYCLE {
                self.physics.step(&commands);
            }
            let body = self.physics.bodies()[0];
            assert!(body.tilt() < 0.4, "it falls at {}", body.torso_to_field);
        }
        self.physics.bodies()[0]
    }

    /// Where it is after so many seconds from the middle of the field: x, y in m, heading in rad.
    fn way(seconds: f32, wish: Step) -> [f64; 3] {
        let mut walk = Self::new([0.0; 3]);
        walk.go(1.0, None);
        let body = walk.go(seconds, Some(wish));
        let ground = body.ground_to_field();
        let heading = f64::from(heading(&body));
        [ground.translation.x, ground.translation.y, heading]
    }
}

/// Only these of forward, left and turn.
fn step(forward: f32, left: f32, turn: f32) -> Step {
    Step {
        forward,
        left,
        turn,
    }
}

#[test]
fn it_goes_where_it_shall() {
    let [x, y, heading] = Walk::way(8.0, step(0.06, 0.0, 0.0));
    assert!(
        x > 1.1 && y.abs() < 0.2 && heading.abs() < 0.2,
        "{x} {y} {heading}"
    );
    let [x, y, heading] = Walk::way(6.0, step(-0.04, 0.0, 0.0));
    assert!(
        x < -0.5 && y.abs() < 0.2 && heading.abs() < 0.2,
        "{x} {y} {heading}"
    );
    for side in [1.0, -1.0] {
        let [x, y, heading] = Walk::way(6.0, step(0.0, side * 0.06, 0.0));
        let y = y * f64::from(side);
        assert!(
            x.abs() < 0.2 && y > 0.35 && heading.abs() < 0.2,
            "{x} {y} {heading}"
        );
        // 16 steps of 0.25 s are 1.6 rad.
        let [x, y, heading] = Walk::way(4.0, step(0.0, 0.0, side * 0.1));
        let heading = heading * f64::from(side);
        assert!(
            x.abs() < 0.2 && y.abs() < 0.2 && (heading - 1.5).abs() < 0.3,
            "{x} {y} {heading}"
        );
    }
}

#[test]
fn it_stops_and_stands() {
    let mut walk = Walk::new([0.0; 3]);
    walk.go(4.0, Some(step(0.06, 0.0, 0.0)));
    walk.go(2.0, None);
    assert!(walk.engine.is_standing());
    let before = walk.physics.bodies()[0].torso_to_field.translation.vector;
    let after = walk.go(1.0, None).torso_to_field.translation.vector;
    assert!((after - before).norm() < 0.005, "{}", after - before);
}

#[test]
fn it_does_not_fall_whatever_is_wished_for() {
    let wishes = [
        step(0.2, 0.0, 0.0),
        step(-0.2, 0.0, 0.0),
        step(0.06, 0.0, 1.0),
        step(0.0, -0.2, 0.0),
        step(0.0, 0.2, -1.0),
        step(-0.1, 0.1, 0.5),
        step(0.1, -0.1, -0.5),
    ];
    let mut walk = Walk::new([0.0; 3]);
    for wish in wishes {
        walk.go(2.0, Some(wish));
    }
}

#[test]
fn same_wishes_same_bits() {
    let [one, same, other] = [0.05, 0.05, 0.050_01].map(|forward| {
        let mut walk = Walk::new([0.5, 0.5, 1.0]);
        walk.go(2.0, Some(step(forward, 0.02, 0.2)))
    });
    assert_eq!(one, same);
    assert_ne!(one, other);
}
