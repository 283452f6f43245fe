//! Games of a few moments.

use nalgebra::{Point2, Point3};

use simulated_nao::referee::{Player, Referee, Ruling, message};
use simulated_nao::scene::Team;
use simulated_nao::settings::{GameSettings, PlaySettings};
use types::game::{GameControllerMessage, GameState, Penalty, SetPlay, TeamState};

const QUICK: PlaySettings = PlaySettings {
    initial: 1.0,
    ready: 2.0,
    set: 1.0,
    half: 100.0,
    halves: 2,
    pause: 10.0,
    delay: 3.0,
    kick_off: 10.0,
    free_kick: 30.0,
    removal: 45.0,
    fallen: 20.0,
    penalties: true,
};

struct Game {
    referee: Referee,
    now: f64,
    ball: Point3<f64>,
    players: Vec<Player>,
    whistles: usize,
}

impl Game {
    fn new() -> Self {
        Self {
            referee: Referee::new(QUICK),
            now: 0.0,
            ball: Point3::new(0.0, 0.0, 0.05),
            players: vec![
                player(Team::Own, 1, [-1.0, 0.0, 0.0]),
                player(Team::Opponent, 1, [1.0, 0.0, std::f64::consts::PI]),
            ],
            whistles: 0,
        }
    }

    fn playing() -> Self {
        let mut game = Self::new();
        game.run_until(4.5);
        assert_eq!(game.referee.state, GameState::Playing);
        game
    }

    fn run_until(&mut self, end: f64) {
        while self.now < end {
            self.now += 0.012;
            for ruling in self.referee.look(self.now, Some(self.ball), &self.players) {
                match ruling {
                    Ruling::Whistle => self.whistles += 1,
                    Ruling::PlaceBall([x, y]) => self.ball = Point3::new(x, y, 0.05),
                    Ruling::Carry(place, pose) => self.move_player(place, pose),
                }
            }
        }
    }

    fn move_player(&mut self, place: usize, pose: [f64; 3]) {
        let old = self.players[place];
        self.players[place] = player(old.team, old.number, pose);
    }

    fn said(&self) -> GameControllerMessage {
        message(
            &self.referee,
            &GameSettings::default(),
            self.now,
            &self.players,
        )
    }
}

fn player(team: Team, number: u8, pose: [f64; 3]) -> Player {
    Player {
        team,
        number,
        pose,
        tilt: 0.0,
        feet: [0.05, -0.05].map(|aside| Point2::new(pose[0], pose[1] + aside)),
    }
}

#[test]
fn the_game_begins_and_the_computer_tells_of_the_whistle_late() {
    let mut game = Game::new();
    for (time, really, said) in [
        (0.9, GameState::Initial, GameState::Initial),
        (1.1, GameState::Ready, GameState::Ready),
        (3.1, GameState::Set, GameState::Set),
        (4.1, GameState::Playing, GameState::Set),
        (6.9, GameState::Playing, GameState::Set),
        (7.2, GameState::Playing, GameState::Playing),
        (104.2, GameState::Finished, GameState::Finished),
    ] {
        game.run_until(time);
        assert_eq!(game.referee.state, really, "at {time} s");
        assert_eq!(game.said().game_state, said, "at {time} s");
    }
    assert_eq!(game.whistles, 2, "kick-off and end");
}

#[test]
fn the_computer_names_the_goalkeepers_and_knows_a_mate_that_only_speaks() {
    let game = Game::new();
    let settings = GameSettings {
        goalkeepers: [4, 0],
        mate: Some(2),
        ..GameSettings::default()
    };
    let [own, other] = message(&game.referee, &settings, 0.0, &game.players).teams;
    assert_eq!((own.goalkeeper, other.goalkeeper), (4, 0));
    let penalties = |team: TeamState| [0, 1, 2].map(|index: usize| team.players[index].penalty);
    let (plays, sits) = (Penalty::None, Penalty::Substitute);
    assert_eq!(penalties(own), [plays, plays, sits]);
    assert_eq!(penalties(other), [plays, sits, sits]);
    let [own, other] = game.said().teams;
    assert_eq!((own.goalkeeper, other.goalkeeper), (1, 1));
    assert_eq!(penalties(own), [plays, sits, sits]);
}

#[test]
fn a_goal_counts_and_the_others_kick_off() {
    let mut game = Game::playing();
    game.run_until(10.0);
    game.ball.x = 4.57;
    game.run_until(10.1);
    assert_eq!(
        game.referee.score,
        [0, 0],
        "not all of it is behind the line"
    );
    game.ball.x = 4.58;
    game.run_until(10.2);
    assert_eq!(game.referee.score, [1, 0]);
    assert_eq!(game.referee.state, GameState::Ready);
    let said = game.said();
    assert_eq!(
        (said.game_state, said.teams[0].score),
        (GameState::Playing, 0)
    );
    game.run_until(13.3);
    let said = game.said();
    assert_eq!((said.teams[0].score, said.kicking_team), (1, Some(6)));
    game.run_until(14.0);
    game.ball = Point3::new(-4.7, -0.3, 0.05);
    game.run_until(16.0);
    assert_eq!(
        game.referee.score,
        [1, 1],
        "an own goal or theirs is theirs"
    );
}

#[test]
fn whoever_touched_it_last_gives_the_ball_away() {
    for (touched_by, place, set_play, kicks, ball) in [
        (0, [1.0, 3.2], SetPlay::KickIn, Team::Opponent, [1.0, 3.0]),
        (1, [1.0, -3.2], SetPlay::KickIn, Team::Own, [1.0, -3.0]),
        (0, [4.7, 2.0], SetPlay::GoalKick, Team::Opponent, [3.9, 1.1]),
        (1, [4.7, -2.0], SetPlay::CornerKick, Team::Own, [4.5, -3.0]),
        (1, [-4.7, 2.0], SetPlay::GoalKick, Team::Own, [-3.9, 1.1]),
        (
            0,
            [-4.7, 2.0],
            SetPlay::CornerKick,
            Team::Opponent,
            [-4.5, 3.0],
        ),
    ] {
        let mut game = Game::playing();
        let [x, y, _] = game.players[touched_by].pose;
        game.ball = Point3::new(x + 0.1, y, 0.05);
        game.run_until(game.now + 0.1);
        game.ball = Point3::new(place[0], place[1], 0.05);
        game.run_until(game.now + 0.02);
        let referee = &game.referee;
        assert_eq!(
            (referee.set_play, referee.kicking),
            (set_play, kicks),
            "{place:?}"
        );
        let is = game.ball.xy();
        assert!(
            (is.x - ball[0]).abs() + (is.y - ball[1]).abs() < 1e-6,
            "{is}"
        );
        game.run_until(game.now + 30.1);
        assert_eq!(
            game.referee.set_play,
            SetPlay::None,
            "the ball is free in the end"
        );
    }
}

#[test]
fn robots_are_removed_and_come_back() {
    let mut game = Game::playing();
    game.players[0].tilt = 1.5;
    game.run_until(24.0);
    assert_eq!(game.said().teams[0].players[0].penalty, Penalty::None);
    assert!(game.referee.plays(0));
    game.run_until(25.0);
    let state = game.said().teams[0].players[0];
    assert_eq!(state.penalty, Penalty::InactivePlayer);
    assert_eq!(state.seconds_till_unpenalized, 45);
    let [x, y, _] = game.players[0].pose;
    assert!(
        x < -1.0 && (y - 3.5).abs() < 1e-9,
        "it stands beside its own half"
    );
    assert_eq!(game.said().teams[1].players[1].penalty, Penalty::Substitute);
    game.move_player(1, [2.0, 4.0, 0.0]);
    game.run_until(26.0);
    assert_eq!(
        game.said().teams[1].players[0].penalty,
        Penalty::LeavingTheField
    );
    game.move_player(1, [2.0, 3.2, 0.0]);
    game.run_until(63.0);
    assert_ne!(game.said().teams[0].players[0].penalty, Penalty::None);
    assert!(!game.referee.plays(0));
    game.run_until(72.0);
    assert_eq!(game.said().teams[0].players[0].penalty, Penalty::None);
    assert!(game.referee.plays(0));
}

#[test]
fn set_has_rules_of_its_own() {
    let mut game = Game::new();
    game.move_player(1, [-0.5, 2.0, 0.0]);
    game.run_until(3.2);
    let penalty = |game: &Game, team: usize| game.said().teams[team].players[0].penalty;
    assert_eq!(
        game.said().teams[1].players[0].penalty,
        Penalty::IllegalPositionInSet
    );
    assert_eq!(penalty(&game, 0), Penalty::None);
    let removals = |player| game.referee.removals(player).collect::<Vec<_>>();
    assert_eq!(removals(1), [Penalty::IllegalPositionInSet]);
    assert_eq!(removals(0), []);
    game.move_player(0, [-1.3, 0.0, 0.0]);
    game.run_until(3.4);
    assert_eq!(penalty(&game, 0), Penalty::IllegalMotionInSet);
    assert_eq!(
        game.players[0].pose,
        [-1.3, 0.0, 0.0],
        "it stays where it is"
    );
    game.run_until(18.0);
    assert_ne!(penalty(&game, 0), Penalty::None, "time stands still in Set");
    game.run_until(20.0);
    assert_eq!(penalty(&game, 0), Penalty::None);
}

#[test]
fn after_the_break_the_others_kick_off_the_second_half() {
    let mut game = Game::playing();
    game.move_player(0, [2.0, 1.0, 1.0]);
    game.run_until(80.0);
    let rulings = game
        .referee
        .penalise(1, Penalty::RequestForPickup, &game.players);
    assert_eq!(rulings.len(), 1);
    game.run_until(104.2);
    assert_eq!(
        game.said().teams[1].players[0].penalty,
        Penalty::RequestForPickup
    );
    let said = game.said();
    assert_eq!(said.game_state, GameState::Finished);
    assert!(said.is_first_half);
    for (time, state) in [
        (113.9, GameState::Finished),
        (114.3, GameState::Initial),
        (116.0, GameState::Ready),
        (119.0, GameState::Playing),
    ] {
        game.run_until(time);
        assert_eq!(game.referee.state, state, "at {time} s");
    }
    // Somebody put both to where they began, and whatever they had done is forgotten.
    assert_eq!(game.players[0].pose, [-1.0, 0.0, 0.0]);
    assert_eq!(game.players[1].pose, [1.0, 0.0, std::f64::consts::PI]);
    assert_eq!(game.said().teams[1].players[0].penalty, Penalty::None);
    let said = game.said();
    assert!(!said.is_first_half);
    assert_eq!(said.kicking_team, Some(6));
    assert!((98..=100).contains(&said.seconds_remaining));
    // There is no third one.
    game.run_until(260.0);
    assert_eq!(game.referee.state, GameState::Finished);
}

/// Blue walks towards the middle of red at that speed, m/s, red at another one towards blue, and stands in between; the
/// penalties of both then.
fn walk_into_each_other(game: &mut Game, blue: f64, red: f64, touching: bool) -> [Penalty; 2] {
    let apart = if touching { 0.3 } else { 0.6 };
    let begun = game.now;
    while game.now < begun + 2.0 {
        let passed = game.now - begun;
        let x = -2.0 + blue * passed;
        game.move_player(0, [x, 1.0, 0.0]);
        // Who is pushed gives way.
        let away = if red > 0.0 {
            -red * passed
        } else {
            blue * passed
        };
        game.move_player(1, [-2.0 + apart + away, 1.0, 0.0]);
        game.run_until(game.now + 0.012);
        let said = game.said();
        let penalties = [0, 1].map(|team: usize| said.teams[team].players[0].penalty);
        if penalties != [Penalty::None; 2] {
            return penalties;
        }
    }
    [Penalty::None; 2]
}

#[test]
fn who_pushes_is_removed_and_who_is_pushed_is_not() {
    for (blue, red, touching, penalty) in [
        (0.15, 0.0, true, Penalty::PlayerPushing),
        (0.15, 0.0, false, Penalty::None),
        (0.0, 0.0, true, Penalty::None),
        // Both come: nobody's foul.
        (0.1, 0.1, true, Penalty::None),
    ] {
        let mut game = Game::playing();
        let seen = walk_into_each_other(&mut game, blue, red, touching);
        assert_eq!(seen, [penalty, Penalty::None], "{blue} {red} {touching}");
    }
}

#[test]
fn pushing_at_the_ball_is_a_free_kick() {
    let mut game = Game::playing();
    game.ball = Point3::new(-1.8, 1.3, 0.05);
    let seen = walk_into_each_other(&mut game, 0.1, 0.0, true);
    assert_eq!(seen, [Penalty::None; 2]);
    let referee = &game.referee;
    assert_eq!(
        (referee.set_play, referee.kicking),
        (SetPlay::PushingFreeKick, Team::Opponent)
    );
}
