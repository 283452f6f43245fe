//! Shows people what the robot believes: about the game, the ball, the ground, and whom it hears.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use types::game::{GameControllerState, KickingTeam, PrimaryState};
use types::leds::{ChestColors, Color, Leds};
use types::world_state::WorldState;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct LedStatus {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    world_state: Input<WorldState, "world_state">,
    game_controller_state: Input<Option<GameControllerState>, "game_controller_state?">,
    cycle_time: CycleTime,

    /// The chest in every state of the game.
    chest: Parameter<ChestColors, "led_status.chest">,
    /// The chest of a limp robot is lit half of this time.
    #[reflect(unit = "s", range = 0.0..)]
    blink_period: Parameter<f32, "led_status.blink_period">,
    /// The left eye while the ball is known.
    ball_known: Parameter<Color, "led_status.ball_known">,
    /// The left eye while it is not.
    ball_unknown: Parameter<Color, "led_status.ball_unknown">,
    /// The right eye while the robot stands.
    on_ground: Parameter<Color, "led_status.on_ground">,
    /// The right eye while it does not.
    in_the_air: Parameter<Color, "led_status.in_the_air">,
    /// The left foot.
    team_color: Parameter<Color, "led_status.team_color">,
    /// The right foot while the own team kicks first.
    own_kick_off: Parameter<Color, "led_status.own_kick_off">,
    /// The ears where they are lit.
    #[reflect(range = 0.0..=1.0)]
    ear_brightness: Parameter<f32, "led_status.ear_brightness">,
}

#[context]
pub struct MainOutputs {
    /// `None` only where this node failed: the lights stay as they are.
    leds: MainOutput<Option<Leds>>,
}

impl LedStatus {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Chooses the colours.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let world_state = context.world_state;
        let left_eye = match world_state.ball {
            Some(_) => context.ball_known,
            None => context.ball_unknown,
        };
        let right_eye = match world_state.has_ground_contact {
            true => context.on_ground,
            false => context.in_the_air,
        };
        let right_foot = match world_state.kicking_team {
            KickingTeam::Own => *context.own_kick_off,
            KickingTeam::Opponent | KickingTeam::Nobody => Color::OFF,
        };
        let teammates = world_state.teammates.len();
        let referee = context.game_controller_state.map_or(0, |_| usize::MAX);
        let leds = Leds {
            left_eye: [*left_eye; 8],
            right_eye: [*right_eye; 8],
            left_ear: ear(teammates, *context.ear_brightness),
            right_ear: ear(referee, *context.ear_brightness),
            chest: context.chest_color(),
            left_foot: *context.team_color,
            right_foot,
            ..Leds::default()
        };
        Ok(MainOutputs {
            leds: Some(leds).into(),
        })
    }
}

impl CycleContext<'_> {
    fn chest_color(&self) -> Color {
        let chest = self.chest;
        match self.world_state.primary_state {
            PrimaryState::Unstiff if self.is_dark() => Color::OFF,
            PrimaryState::Unstiff => chest.unstiff,
            PrimaryState::Initial => chest.initial,
            PrimaryState::Standby => chest.standby,
            PrimaryState::Ready => chest.ready,
            PrimaryState::Set => chest.set,
            PrimaryState::Playing => chest.playing,
            PrimaryState::Penalized => chest.penalized,
            PrimaryState::Finished => chest.finished,
        }
    }

    /// Whether what blinks is dark: at first it is lit. A period that is none does not blink.
    fn is_dark(&self) -> bool {
        let period = f64::from(*self.blink_period);
        let since_start = self.cycle_time.start.as_nanos() as f64 / 1e9;
        since_start % period >= period / 2.0
    }
}

/// An ear with so many lights on, from the first.
fn ear(lights: usize, brightness: f32) -> [f32; 10] {
    std::array::from_fn(|light| if light < lights { brightness } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use framework::testing;
    use types::ball::Ball;
    use types::team::Teammate;

    use super::*;

    const GREEN: Color = Color::new(0.0, 1.0, 0.0);
    const RED: Color = Color::new(1.0, 0.0, 0.0);
    const BLUE: Color = Color::new(0.0, 0.0, 1.0);

    /// Eight different ones.
    const CHEST: ChestColors = ChestColors {
        unstiff: BLUE,
        initial: Color::new(0.1, 0.0, 0.0),
        standby: Color::new(0.2, 0.0, 0.0),
        ready: Color::new(0.3, 0.0, 0.0),
        set: Color::new(0.4, 0.0, 0.0),
        playing: GREEN,
        penalized: RED,
        finished: Color::new(0.5, 0.0, 0.0),
    };

    fn leds_at(millis: u64, world_state: &WorldState, hears_referee: bool) -> Leds {
        let mut node = LedStatus::new(CreationContext {}).unwrap();
        let game_controller_state = GameControllerState::default();
        let context = CycleContext {
            world_state,
            game_controller_state: hears_referee.then_some(&game_controller_state),
            cycle_time: testing::cycle_time(millis, 12),
            chest: &CHEST,
            blink_period: &1.0,
            ball_known: &GREEN,
            ball_unknown: &Color::OFF,
            on_ground: &GREEN,
            in_the_air: &RED,
            team_color: &RED,
            own_kick_off: &GREEN,
            ear_brightness: &0.5,
        };
        node.cycle(context).unwrap().leds.value.unwrap()
    }

    fn leds(world_state: &WorldState) -> Leds {
        leds_at(0, world_state, false)
    }

    #[test]
    fn the_chest_tells_the_state_of_the_game() {
        let chest = |primary_state| {
            let world_state = WorldState {
                primary_state,
                ..WorldState::default()
            };
            leds(&world_state).chest
        };
        let states = [
            (PrimaryState::Unstiff, CHEST.unstiff),
            (PrimaryState::Initial, CHEST.initial),
            (PrimaryState::Standby, CHEST.standby),
            (PrimaryState::Ready, CHEST.ready),
            (PrimaryState::Set, CHEST.set),
            (PrimaryState::Playing, CHEST.playing),
            (PrimaryState::Penalized, CHEST.penalized),
            (PrimaryState::Finished, CHEST.finished),
        ];
        for (state, color) in states {
            assert_eq!(chest(state), color, "{state:?}");
        }
    }

    #[test]
    fn the_chest_of_a_limp_robot_blinks() {
        let limp = WorldState::default();
        let chest = [0, 499, 500, 999, 1000].map(|millis| leds_at(millis, &limp, false).chest);
        assert_eq!(chest, [BLUE, BLUE, Color::OFF, Color::OFF, BLUE]);
    }

    #[test]
    fn the_left_eye_tells_whether_the_ball_is_known() {
        let known = WorldState {
            ball: Some(Ball::default()),
            ..WorldState::default()
        };
        assert_eq!(leds(&known).left_eye, [GREEN; 8]);
        assert_eq!(leds(&WorldState::default()).left_eye, [Color::OFF; 8]);
    }

    #[test]
    fn the_right_eye_tells_whether_the_robot_stands() {
        let stands = WorldState {
            has_ground_contact: true,
            ..WorldState::default()
        };
        assert_eq!(leds(&stands).right_eye, [GREEN; 8]);
        assert_eq!(leds(&WorldState::default()).right_eye, [RED; 8]);
    }

    #[test]
    fn the_ears_tell_whom_the_robot_hears() {
        let world_state = WorldState {
            teammates: vec![Teammate::default(); 3],
            ..WorldState::default()
        };
        let deaf = leds_at(0, &WorldState::default(), false);
        assert_eq!((deaf.left_ear, deaf.right_ear), ([0.0; 10], [0.0; 10]));
        let hears = leds_at(0, &world_state, true);
        assert_eq!(hears.left_ear[..4], [0.5, 0.5, 0.5, 0.0]);
        assert_eq!(hears.right_ear, [0.5; 10]);
    }

    #[test]
    fn the_feet_tell_the_team_and_its_kick_off() {
        let own = WorldState {
            kicking_team: KickingTeam::Own,
            ..WorldState::default()
        };
        assert_eq!(leds(&own).left_foot, RED);
        assert_eq!(leds(&own).right_foot, GREEN);
        assert_eq!(leds(&WorldState::default()).right_foot, Color::OFF);
    }
}
