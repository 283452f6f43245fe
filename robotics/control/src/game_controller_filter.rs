//! Knows what the referee's computer says about the own team, and when it began to say so.
//!
//! Its packets come twice a second, over a network that loses some and lets others overtake. The
//! newest counts at once; only what nothing older can overtake any more is learnt. Whoever else says
//! that it is the referee's computer is ignored until the first one has fallen silent.

use std::time::Duration;

use framework::{
    CycleTime, MainOutput, Parameter, PerceptionInput, Result, RollBack, Timestamp, context,
};
use serde::{Deserialize, Serialize};
use types::game::{
    GameControllerPacket, GameControllerState, GamePhase, KickingTeam, Penalty, Player, SetPlay,
    TeamState,
};

/// What was heard so far.
#[derive(Debug, Deserialize, Serialize)]
pub struct GameControllerFilter {
    heard: RollBack<Option<Referee>>,
}

/// The referee's computer that is listened to.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
struct Referee {
    state: GameControllerState,
    /// Of its newest packet; 0 comes after 255.
    packet_number: u8,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    packets: PerceptionInput<Option<GameControllerPacket>, "SplNetwork", "game_controller_packet">,
    cycle_time: CycleTime,

    /// Who this robot is in the game.
    player: Parameter<Player, "player">,
    /// A referee's computer that is silent for so long is not there, and another one may speak.
    #[reflect(unit = "s", range = 0.0..)]
    forget_after: Parameter<f32, "game_controller_filter.forget_after">,
}

#[context]
pub struct MainOutputs {
    /// What the referee's computer said last; `None` while none is heard that knows the own team.
    game_controller_state: MainOutput<Option<GameControllerState>>,
}

impl GameControllerFilter {
    /// Has heard nothing.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            heard: RollBack::default(),
        })
    }

    /// Learns from what is settled, then listens to what is not.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let (player, forget_after) = (*context.player, *context.forget_after);
        let hear =
            |referee: &mut Option<Referee>, timestamp, packet: &Option<GameControllerPacket>| {
                let is_there =
                    |referee: &Referee| lasts(timestamp - referee.state.received_at, forget_after);
                let first = referee.filter(is_there);
                let Some(packet) = packet
                    .filter(|packet| first.is_none_or(|referee| referee.continues_with(packet)))
                else {
                    return;
                };
                let known = referee.map(|referee| referee.state);
                if let Some(state) = after(&packet, timestamp, player, known) {
                    *referee = Some(Referee {
                        state,
                        packet_number: packet.message.packet_number,
                    });
                }
            };
        self.heard.settle(context.packets.persistent, hear);
        let newest = self.heard.with_transient(context.packets.transient, hear);

        let now = context.cycle_time.start;
        let is_recent = |state: &GameControllerState| lasts(now - state.received_at, forget_after);
        Ok(MainOutputs {
            game_controller_state: newest.map(|referee| referee.state).filter(is_recent).into(),
        })
    }
}

impl Referee {
    /// Whether the packet is from it, and not older than what is known.
    fn continues_with(&self, packet: &GameControllerPacket) -> bool {
        let behind = self
            .packet_number
            .wrapping_sub(packet.message.packet_number);
        let is_overtaken = (1..=i8::MAX as u8).contains(&behind);
        packet.sender == self.state.sender && !is_overtaken
    }
}

fn lasts(silence: Duration, forget_after: f32) -> bool {
    silence.as_secs_f32() <= forget_after
}

/// What is known after a packet; `None` where it is about other teams.
fn after(
    packet: &GameControllerPacket,
    timestamp: Timestamp,
    player: Player,
    known: Option<GameControllerState>,
) -> Option<GameControllerState> {
    let message = &packet.message;
    let [first, second] = &message.teams;
    let (own, opponent) = match player.team {
        team if team == first.number => (first, second),
        team if team == second.number => (second, first),
        _ => return None,
    };
    let since = known
        .filter(|known| known.sender == packet.sender && known.game_state == message.game_state)
        .map_or(timestamp, |known| known.game_state_since);
    let own_penalties = own.players.map(|player| player.penalty);
    let state = GameControllerState {
        game_phase: message.game_phase,
        game_state: message.game_state,
        game_state_since: since,
        set_play: match message.game_phase {
            GamePhase::PenaltyShootout => SetPlay::PenaltyKick,
            _ => message.set_play,
        },
        kicking_team: kicking_team(message.kicking_team, own, opponent),
        is_first_half: message.is_first_half,
        seconds_remaining: message.seconds_remaining,
        penalty: Penalty::None,
        goalkeeper: own.goalkeeper,
        own_penalties,
        own_score: own.score,
        opponent_score: opponent.score,
        message_budget: own.message_budget,
        received_at: timestamp,
        sender: packet.sender,
    };
    Some(GameControllerState {
        penalty: state.penalty_of(player.number),
        ..state
    })
}

fn kicking_team(number: Option<u8>, own: &TeamState, opponent: &TeamState) -> KickingTeam {
    match number {
        Some(number) if number == own.number => KickingTeam::Own,
        Some(number) if number == opponent.number => KickingTeam::Opponent,
        _ => KickingTeam::Nobody,
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::{at_millis, cycle_time, perception};
    use types::game::{GameControllerMessage, GameState};
    use types::network::Endpoint;

    use super::*;

    type Heard<'a> = Vec<(Timestamp, &'a Option<GameControllerPacket>)>;

    const PLAYER: Player = Player {
        number: 3,
        team: 77,
    };

    fn packet(game_state: GameState, own_team: u8) -> GameControllerPacket {
        let mut message = GameControllerMessage {
            game_state,
            kicking_team: Some(own_team),
            ..GameControllerMessage::default()
        };
        message.teams[0].number = 12;
        message.teams[0].score = 1;
        message.teams[1].number = own_team;
        message.teams[1].message_budget = 900;
        message.teams[0].goalkeeper = 7;
        message.teams[1].goalkeeper = 5;
        message.teams[1].players[2].penalty = Penalty::PlayerPushing;
        message.teams[1].players[19].penalty = Penalty::Substitute;
        GameControllerPacket {
            message,
            ..GameControllerPacket::default()
        }
    }

    fn node() -> GameControllerFilter {
        GameControllerFilter::new(CreationContext {}).unwrap()
    }

    fn cycle(
        node: &mut GameControllerFilter,
        now: u64,
        player: Player,
        persistent: Heard<'_>,
        transient: Heard<'_>,
    ) -> Option<GameControllerState> {
        let context = CycleContext {
            packets: perception(&persistent, &transient),
            cycle_time: cycle_time(now, 12),
            player: &player,
            forget_after: &4.0,
        };
        node.cycle(context).unwrap().game_controller_state.value
    }

    #[test]
    fn a_packet_is_seen_from_the_own_side() {
        let ready = Some(packet(GameState::Ready, 77));
        let heard = vec![(at_millis(90), &ready)];
        let state = cycle(&mut node(), 100, PLAYER, heard, vec![]).unwrap();
        assert_eq!(state.game_state, GameState::Ready);
        assert_eq!(state.kicking_team, KickingTeam::Own);
        assert_eq!(state.penalty, Penalty::PlayerPushing);
        assert_eq!(state.goalkeeper, 5);
        for (number, penalty) in [
            (0, Penalty::None),
            (1, Penalty::None),
            (3, Penalty::PlayerPushing),
            (20, Penalty::Substitute),
            (21, Penalty::None),
        ] {
            assert_eq!(state.penalty_of(number), penalty, "{number}");
        }
        assert_eq!((state.own_score, state.opponent_score), (0, 1));
        assert_eq!(state.message_budget, 900);
        assert_eq!(state.received_at, at_millis(90));
    }

    #[test]
    fn a_shot_of_a_shoot_out_is_a_penalty_kick_whose_team_is_known() {
        for (phase, set_play, shot_of) in [
            (
                GamePhase::PenaltyShootout,
                SetPlay::PenaltyKick,
                Some(KickingTeam::Own),
            ),
            (GamePhase::Normal, SetPlay::CornerKick, None),
            (GamePhase::Overtime, SetPlay::CornerKick, None),
        ] {
            let mut shot = packet(GameState::Playing, 77);
            shot.message.game_phase = phase;
            shot.message.set_play = match phase {
                GamePhase::PenaltyShootout => SetPlay::None,
                _ => SetPlay::CornerKick,
            };
            let shot = Some(shot);
            let heard = vec![(at_millis(90), &shot)];
            let state = cycle(&mut node(), 100, PLAYER, heard, vec![]).unwrap();
            assert_eq!(
                (state.set_play, state.whose_ball().shot_of()),
                (set_play, shot_of)
            );
        }
    }

    #[test]
    fn a_state_began_with_the_packet_that_changed_it() {
        let (ready, set) = (
            Some(packet(GameState::Ready, 77)),
            Some(packet(GameState::Set, 77)),
        );
        let mut node = node();
        let heard = vec![(at_millis(10), &ready), (at_millis(20), &set)];
        cycle(&mut node, 30, PLAYER, heard, vec![]);
        let state = cycle(&mut node, 60, PLAYER, vec![(at_millis(50), &set)], vec![]).unwrap();
        assert_eq!(state.game_state_since, at_millis(20));
        assert_eq!(state.received_at, at_millis(50));
    }

    #[test]
    fn transient_packets_answer_but_are_not_learnt() {
        let (ready, set) = (
            Some(packet(GameState::Ready, 77)),
            Some(packet(GameState::Set, 77)),
        );
        let mut node = node();
        let (settled, ahead) = (vec![(at_millis(10), &ready)], vec![(at_millis(20), &set)]);
        let state = cycle(&mut node, 30, PLAYER, settled, ahead).unwrap();
        assert_eq!(state.game_state, GameState::Set);
        let state = cycle(&mut node, 40, PLAYER, vec![], vec![]).unwrap();
        assert_eq!(state.game_state, GameState::Ready);
    }

    #[test]
    fn packets_about_other_teams_and_no_packets_are_ignored() {
        let (foreign, nothing) = (Some(packet(GameState::Set, 78)), None);
        let heard = vec![(at_millis(10), &foreign), (at_millis(20), &nothing)];
        assert_eq!(cycle(&mut node(), 30, PLAYER, heard, vec![]), None);
    }

    #[test]
    fn a_silent_referee_is_forgotten() {
        let ready = Some(packet(GameState::Ready, 77));
        let mut node = node();
        cycle(&mut node, 20, PLAYER, vec![(at_millis(10), &ready)], vec![]);
        assert!(cycle(&mut node, 4000, PLAYER, vec![], vec![]).is_some());
        assert_eq!(cycle(&mut node, 4020, PLAYER, vec![], vec![]), None);
    }

    fn packet_of(
        host: u8,
        packet_number: u8,
        game_state: GameState,
    ) -> Option<GameControllerPacket> {
        let mut packet = packet(game_state, 77);
        packet.message.packet_number = packet_number;
        packet.sender = Endpoint {
            address: [10, 0, 0, host],
            port: 3939,
        };
        Some(packet)
    }

    #[test]
    fn whoever_spoke_first_is_listened_to_until_it_is_silent() {
        let first = packet_of(1, 7, GameState::Ready);
        let other = packet_of(2, 0, GameState::Finished);
        let mut node = node();
        let heard = vec![(at_millis(10), &first), (at_millis(20), &other)];
        let state = cycle(&mut node, 30, PLAYER, heard, vec![]).unwrap();
        assert_eq!(state.game_state, GameState::Ready);
        assert_eq!(state.sender.address, [10, 0, 0, 1]);
        // What is ignored does not keep the first one alive.
        let heard = vec![(at_millis(4005), &other)];
        let state = cycle(&mut node, 4006, PLAYER, heard, vec![]).unwrap();
        assert_eq!(state.received_at, at_millis(10));
        let ahead = vec![(at_millis(4020), &other)];
        let state = cycle(&mut node, 4030, PLAYER, vec![], ahead).unwrap();
        assert_eq!(state.game_state, GameState::Finished);
        let heard = vec![(at_millis(4020), &other), (at_millis(4040), &first)];
        let state = cycle(&mut node, 4050, PLAYER, heard, vec![]).unwrap();
        assert_eq!(state.sender.address, [10, 0, 0, 2]);
    }

    #[test]
    fn a_state_of_another_computer_begins_with_that_computer() {
        let (first, other) = (
            packet_of(1, 7, GameState::Ready),
            packet_of(2, 0, GameState::Ready),
        );
        let mut node = node();
        let heard = vec![(at_millis(10), &first), (at_millis(4020), &other)];
        let state = cycle(&mut node, 4030, PLAYER, heard, vec![]).unwrap();
        assert_eq!(state.sender.address, [10, 0, 0, 2]);
        assert_eq!(state.game_state_since, at_millis(4020));
        let again = packet_of(2, 1, GameState::Ready);
        let heard = vec![(at_millis(4500), &again)];
        let state = cycle(&mut node, 4510, PLAYER, heard, vec![]).unwrap();
        assert_eq!(state.game_state_since, at_millis(4020));
    }

    #[test]
    fn a_packet_that_was_overtaken_is_ignored() {
        let cases = [
            (7, 8, GameState::Set),
            (7, 7, GameState::Set),
            (7, 6, GameState::Ready),
            (255, 0, GameState::Set),
            (0, 255, GameState::Ready),
            (0, 128, GameState::Set),
            (0, 129, GameState::Ready),
        ];
        for (before, after, expected) in cases {
            let ready = packet_of(1, before, GameState::Ready);
            let set = packet_of(1, after, GameState::Set);
            let heard = vec![(at_millis(10), &ready), (at_millis(20), &set)];
            let state = cycle(&mut node(), 30, PLAYER, heard, vec![]).unwrap();
            assert_eq!(state.game_state, expected, "{before}, then {after}");
        }
    }

    #[test]
    fn a_referee_that_begins_to_count_again_is_heard_after_a_silence() {
        let old = packet_of(1, 100, GameState::Playing);
        let new = packet_of(1, 0, GameState::Initial);
        let mut node = node();
        let heard = vec![(at_millis(10), &old), (at_millis(1000), &new)];
        let state = cycle(&mut node, 1010, PLAYER, heard, vec![]).unwrap();
        assert_eq!(state.game_state, GameState::Playing);
        let heard = vec![(at_millis(4500), &new)];
        let state = cycle(&mut node, 4510, PLAYER, heard, vec![]).unwrap();
        assert_eq!(state.game_state, GameState::Initial);
    }

    #[test]
    fn a_player_whom_the_referee_does_not_know_has_no_penalty() {
        let ready = Some(packet(GameState::Ready, 77));
        for number in [0, 21] {
            let player = Player { number, team: 77 };
            let heard = vec![(at_millis(10), &ready)];
            let state = cycle(&mut node(), 20, player, heard, vec![]).unwrap();
            assert_eq!(state.penalty, Penalty::None);
        }
    }
}
