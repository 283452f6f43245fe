//! Owns the numbers that stand for the words of the game.

use types::game::{
    CompetitionPhase, CompetitionType, GamePhase, GameState, Penalty, SetPlay, TeamColor,
};

/// A word that is sent as a number.
pub(super) trait Numbered: Sized {
    /// The field as the published layout calls it.
    const FIELD: &'static str;
    /// The numbers that there are.
    const EXPECTED: &'static str;

    fn number(self) -> u8;

    fn from_number(number: u8) -> Option<Self>;
}

macro_rules! number {
    ($name:ident, $field:literal, $expected:literal, { $($number:literal: $word:ident),* $(,)? }) => {
        impl Numbered for $name {
            const FIELD: &'static str = $field;
            const EXPECTED: &'static str = $expected;

            fn number(self) -> u8 {
                match self {
                    $(Self::$word => $number),*
                }
            }

            fn from_number(number: u8) -> Option<Self> {
                match number {
                    $($number => Some(Self::$word),)*
                    _ => None,
                }
            }
        }
    };
}

number!(CompetitionPhase, "competitionPhase", "0 or 1", {
    0: RoundRobin,
    1: Playoff,
});

number!(CompetitionType, "competitionType", "0 or 1", {
    0: Normal,
    1: MostPasses,
});

number!(GamePhase, "gamePhase", "0 to 3", {
    0: Normal,
    1: PenaltyShootout,
    2: Overtime,
    3: Timeout,
});

number!(GameState, "state", "0 to 5", {
    0: Initial,
    1: Ready,
    2: Set,
    3: Playing,
    4: Finished,
    5: Standby,
});

number!(SetPlay, "setPlay", "0 to 5", {
    0: None,
    1: GoalKick,
    2: PushingFreeKick,
    3: CornerKick,
    4: KickIn,
    5: PenaltyKick,
});

number!(TeamColor, "a team's colour", "0 to 9", {
    0: Blue,
    1: Red,
    2: Yellow,
    3: Black,
    4: White,
    5: Green,
    6: Orange,
    7: Purple,
    8: Brown,
    9: Gray,
});

number!(Penalty, "penalty", "0 to 11, 14 or 15", {
    0: None,
    1: IllegalBallContact,
    2: PlayerPushing,
    3: IllegalMotionInSet,
    4: InactivePlayer,
    5: IllegalPosition,
    6: LeavingTheField,
    7: RequestForPickup,
    8: LocalGameStuck,
    9: IllegalPositionInSet,
    10: PlayerStance,
    11: IllegalMotionInStandby,
    14: Substitute,
    15: Manual,
});
