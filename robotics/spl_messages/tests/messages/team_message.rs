//! Team messages: their own layout, their size, refusals.

use nalgebra::{Complex, Isometry2, Point2, UnitComplex, Vector2};
use proptest::prelude::*;
use spl_messages::EncodeError;
use spl_messages::team_message::{GREATEST_LENGTH, PERMITTED_LENGTH, decode, encode};
use types::team::{TeamBall, TeamMessage};

use crate::values::any_team_message;

fn message() -> TeamMessage {
    TeamMessage {
        player_number: 5,
        is_fallen: false,
        plays_ball: false,
        ground_to_field: Some(Isometry2::new(Vector2::new(-1.5, 0.25), 0.0)),
        ball: Some(TeamBall {
            position: Point2::new(2.0, -0.125),
            age: 1.5,
        }),
    }
}

fn encoded(message: &TeamMessage) -> Result<Vec<u8>, EncodeError> {
    encode(message, &mut [0xff; GREATEST_LENGTH]).map(<[u8]>::to_vec)
}

#[test]
fn the_layout_is_the_documented_one() {
    let bytes = encoded(&message()).unwrap();
    assert_eq!(bytes[..7], *b"HGtm\x01\x05\x06");
    let floats: Vec<_> = bytes[7..]
        .chunks(4)
        .map(|float| f32::from_le_bytes(float.try_into().unwrap()))
        .collect();
    assert_eq!(floats, [-1.5, 0.25, 1.0, 0.0, 2.0, -0.125, 1.5]);
    assert_eq!(bytes.len(), GREATEST_LENGTH);
    let least = TeamMessage {
        player_number: 20,
        is_fallen: true,
        ..TeamMessage::default()
    };
    assert_eq!(encoded(&least).unwrap(), *b"HGtm\x01\x14\x01");
    let plays = TeamMessage {
        plays_ball: true,
        ..least
    };
    assert_eq!(encoded(&plays).unwrap(), *b"HGtm\x01\x14\x09");
}

#[test]
fn a_refusal_says_what_was_expected_and_what_came() {
    let bytes = encoded(&message()).unwrap();
    for (place, value, expected) in [
        (0, b'R', "the header is \"RGtm\" instead of \"HGtm\""),
        (4, 2, "the version is 2 instead of 1"),
        (
            5,
            0,
            "`player number` is 0 instead of a shirt's number from 1 to 20",
        ),
        (6, 0x16, "`flags` is 22 instead of 0 to 15"),
        (6, 2, "the message has 35 bytes instead of 23"),
        (
            18,
            0x40,
            "`heading` is 4 instead of the cosine or sine of an angle",
        ),
    ] {
        let mut wrong = bytes.clone();
        wrong[place] = value;
        assert_eq!(decode(&wrong).unwrap_err().to_string(), expected);
    }
}

#[test]
fn numbers_that_are_none_and_balls_from_the_future_are_neither_sent_nor_taken() {
    let bytes = encoded(&message()).unwrap();
    for place in (7..GREATEST_LENGTH).step_by(4) {
        for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let mut wrong = bytes.clone();
            wrong[place..place + 4].copy_from_slice(&value.to_le_bytes());
            assert!(decode(&wrong).is_err(), "{value} at {place}");
        }
    }
    let mut early = bytes;
    early[31..].copy_from_slice(&(-1.0_f32).to_le_bytes());
    let complaint = decode(&early).unwrap_err().to_string();
    assert_eq!(complaint, "`age` is -1 instead of a number of seconds");

    let with = |change: fn(&mut TeamMessage)| {
        let mut message = message();
        change(&mut message);
        encoded(&message)
    };
    let turn = |re, im| UnitComplex::new_unchecked(Complex::new(re, im));
    let lost = |x, rotation| Some(Isometry2::from_parts(Vector2::new(x, 0.0).into(), rotation));
    assert!(
        encoded(&TeamMessage {
            ground_to_field: lost(f32::NAN, turn(1.0, 0.0)),
            ..message()
        })
        .is_err()
    );
    assert!(
        encoded(&TeamMessage {
            ground_to_field: lost(0.0, turn(f32::NAN, 0.0)),
            ..message()
        })
        .is_err()
    );
    assert!(
        encoded(&TeamMessage {
            ground_to_field: lost(0.0, turn(0.0, 0.0)),
            ..message()
        })
        .is_err()
    );
    assert!(with(|message| message.player_number = 21).is_err());
    assert!(with(|message| message.ball.as_mut().unwrap().age = f32::NAN).is_err());
    assert!(with(|message| message.ball.as_mut().unwrap().age = -0.1).is_err());
    assert!(with(|message| message.ball.as_mut().unwrap().position.y = f32::INFINITY).is_err());
}

proptest! {
    #[test]
    fn what_is_encoded_is_decoded_again_and_the_rules_permit_its_size(
        message in any_team_message()
    ) {
        let bytes = encoded(&message).unwrap();
        prop_assert!(bytes.len() <= PERMITTED_LENGTH);
        prop_assert_eq!(decode(&bytes), Ok(message));
    }
}
