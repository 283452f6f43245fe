//! What scenarios do to the world, and what they may know of it.

use framework::{Error, Result, Timestamp, math};
use nalgebra::{Isometry3, Point3, Vector3};
use serde::Deserialize;
use serde_json::{Value, json};
use types::camera::CameraPosition;
use types::game::Penalty;

use crate::ground_truth::GroundTruth;
use crate::physics::{Disturbance, heading};
use crate::scene::Team;
use crate::settings::{Button, Press};
use crate::silence::DropOut;
use crate::simulation::Simulation;

/// What happens is not farther, faster and harder: physics stays finite. Ten fields long, and for the robot's 5 kg 20 m/s.
const GREATEST: f64 = 100.0;

/// One `[[event]]`: everything in it happens at once.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Deed {
    /// At the torso: forward, to the left, upwards as the robot faces, in N s.
    push: Option<[f64; 3]>,
    /// Where the ball lies from now on, m.
    ball: Option<[f64; 2]>,
    /// How fast it rolls, m/s; it stays where it is unless `ball` says otherwise.
    ball_velocity: Option<[f64; 2]>,
    /// Where somebody puts the robot: x and y in m, heading in rad.
    kidnap: Option<[f64; 3]>,
    /// What somebody presses, as in `buttons`, for so many seconds.
    press: Option<Pressed>,
    /// The referee takes the robot out for that; where a game is played.
    penalise: Option<Penalty>,
    /// Somebody whistles.
    whistle: bool,
    /// The camera whose next image arrives garbled.
    garble_image: Option<CameraPosition>,
    /// The next state that LoLA sends arrives garbled.
    garble_state: bool,
    /// The camera that takes no images for so many seconds.
    camera_drop_out: Option<DropOut>,
    /// For so many seconds LoLA sends no states, and motors keep what they were told last.
    lola_stall: Option<f64>,
}

#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct Pressed {
    button: Button,
    lasts: f64,
}

impl Deed {
    /// Reads an event.
    ///
    /// # Errors
    /// Names what is not understood.
    pub(super) fn read(deed: &toml::Table) -> Result<Self> {
        let read: Self = deed.clone().try_into()?;
        match read
            .numbers()
            .find(|number| number.is_nan() || number.abs() > GREATEST)
        {
            Some(number) => Err(Error::new(format!(
                "{number} is no place, speed or impulse of this world: they are at most {GREATEST} m, m/s, rad and N s"
            ))),
            None => Ok(read),
        }
    }

    fn numbers(&self) -> impl Iterator<Item = f64> + use<> {
        let vectors = [self.push, self.kidnap].into_iter().flatten().flatten();
        let planar = [self.ball, self.ball_velocity];
        vectors.chain(planar.into_iter().flatten().flatten())
    }

    /// Does it.
    pub(super) fn happen(&self, simulation: &mut Simulation) -> Result<()> {
        let truth = simulation.ground_truth();
        let robot = simulation.robot();
        let mut scene = simulation.scene();
        for disturbance in self.disturbances(robot, &truth)? {
            scene.world.disturb(&disturbance);
        }
        if let Some(Pressed { button, lasts }) = self.press {
            let press = Press {
                at: (truth.now - Timestamp::ZERO).as_secs_f64(),
                button,
                lasts,
            };
            press.check()?;
            scene.world.press(robot, press);
        }
        if let Some(penalty) = self.penalise
            && !scene.world.penalise(robot, penalty)
        {
            return Err(Error::new(
                "nobody can be penalised: there is no referee (hardware.simulated.game.play)",
            ));
        }
        if self.whistle {
            scene.world.whistle();
        }
        drop(scene);
        if let Some(camera) = self.garble_image {
            *simulation.garble_image.of_mut(camera) = true;
        }
        simulation.garble_state |= self.garble_state;
        if let Some(drop_out) = self.camera_drop_out {
            simulation.silence.drop_out(truth.now, drop_out)?;
        }
        if let Some(lasts) = self.lola_stall {
            simulation.silence.stall(truth.now, lasts)?;
        }
        Ok(())
    }

    fn disturbances(&self, robot: usize, truth: &GroundTruth) -> Result<Vec<Disturbance>> {
        let mut all = Vec::new();
        if let Some(impulse) = self.push {
            let ground: Isometry3<f64> = truth.ground_to_field.cast();
            all.push(Disturbance::Push {
                robot,
                impulse: ground.rotation * Vector3::from(impulse),
            });
        }
        if self.ball.is_some() || self.ball_velocity.is_some() {
            let now: Point3<f64> = truth
                .ball
                .ok_or_else(|| Error::new("there is no ball on this field"))?
                .cast();
            let [x, y] = self.ball.unwrap_or([now.x, now.y]);
            let [along, across] = self.ball_velocity.unwrap_or_default();
            all.push(Disturbance::MoveBall {
                position: Point3::new(x, y, now.z),
                velocity: Vector3::new(along, across, 0.0),
            });
        }
        if let Some(pose) = self.kidnap {
            all.push(Disturbance::Kidnap { robot, pose });
        }
        Ok(all)
    }
}

/// What is really the case: lengths in m, angles in rad, in the field frame unless it says otherwise.
///
/// `x`, `y`, `heading` of the robot, `own.place` (x and y) and `own.direction` (cosine and sine) as its team sees the field,
/// how far it `walked`, `tilt` and `height` of its torso; `stuck`, for how many seconds it has lain or moved its legs without
/// getting anywhere; `still`, for how many it has stayed within 0.05 m and 0.15 rad; `harmful_commands`, how many wanted a joint
/// beyond its limits; `ball.x`, `ball.y`, from the robot `ball.ahead`, `ball.aside`, `ball.seen` (both), `ball.distance`, and
/// `ball_contacts` of all robots;
/// `robots` are the others: `x`, `y`, `heading`, from the robot `seen` (ahead and aside), `team` (`own` or `opponent`), `number`;
/// `removed`, how often the referee has taken the robot out, and `misplaced`, how often for where it stood or walked; `plays`,
/// whether it is not taken out now;
/// `score.blue`, `score.red`, and where a game is played `game.state`, `game.set_play`, `game.kicking` (`blue` or `red`).
pub(super) fn truth(truth: &GroundTruth) -> Value {
    let ground: Isometry3<f64> = truth.ground_to_field.cast();
    let torso: Isometry3<f64> = truth.torso_to_field.cast();
    let up = torso.rotation * Vector3::z();
    let ball = truth.ball.map(|ball| {
        let ball: Point3<f64> = ball.cast();
        let seen = ground.inverse() * ball;
        json!({
            "x": ball.x, "y": ball.y,
            "ahead": seen.x, "aside": seen.y, "seen": [seen.x, seen.y],
            "distance": seen.coords.xy().norm(),
        })
    });
    let robots = truth.robots.iter().map(|robot| {
        let team = match robot.team {
            Team::Own => "own",
            Team::Opponent => "opponent",
        };
        let place = Point3::new(robot.position.x, robot.position.y, 0.0);
        let seen = ground.inverse() * place;
        json!({
            "x": robot.position.x, "y": robot.position.y, "heading": robot.heading,
            "seen": [seen.x, seen.y], "team": team, "number": robot.number,
        })
    });
    let robots: Vec<Value> = robots.collect();
    let score = truth.game.map_or([0; 2], |game| game.score);
    let game = truth.game.map(|game| {
        let kicking = match game.kicking {
            Team::Own => "blue",
            Team::Opponent => "red",
        };
        json!({ "state": game.state, "set_play": game.set_play, "kicking": kicking })
    });
    // Blue plays towards positive x, and every team says that it does.
    let ahead = match truth.team {
        Team::Own => 1.0,
        Team::Opponent => -1.0,
    };
    let heading = heading(&torso);
    json!({
        "own": {
            "place": [ahead * ground.translation.x, ahead * ground.translation.y],
            "direction": [ahead * math::cos(heading), ahead * math::sin(heading)],
        },
        "x": ground.translation.x,
        "y": ground.translation.y,
        "heading": heading,
        "walked": truth.walked,
        "stuck": truth.stuck,
        "still": truth.still,
        "ball_contacts": truth.ball_contacts,
        "harmful_commands": truth.harmful_commands,
        "tilt": math::acos(up.z.clamp(-1.0, 1.0)),
        "height": torso.translation.z,
        "ball": ball,
        "robots": robots,
        "removed": truth.game.map_or(0, |game| game.removed),
        "misplaced": truth.game.map_or(0, |game| game.misplaced),
        "plays": truth.game.is_none_or(|game| game.plays),
        "score": { "blue": score[0], "red": score[1] },
        "game": game,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        let deed: toml::Table = toml::from_str(text).expect("it is TOML");
        Deed::read(&deed).expect_err("it has a mistake").to_string()
    }

    #[test]
    fn what_is_not_understood_is_named() {
        assert!(message("psh = [1, 0, 0]").contains("unknown field `psh`"));
        assert!(message("push = [1, 0]").contains("push"));
        assert!(message("ball = [nan, 0]").contains("NaN is no place"));
        let far = message("push = [0, -1e38, 0]");
        assert!(far.contains("at most 100 m, m/s, rad and N s"), "{far}");
    }
}
