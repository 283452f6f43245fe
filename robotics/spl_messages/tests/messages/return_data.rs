//! Return data: the published offsets, units, refusals.

use nalgebra::{Isometry2, Point2, Vector2};
use proptest::prelude::*;
use spl_messages::ReturnData;
use spl_messages::return_data::{LENGTH, decode, encode};
use types::team::TeamBall;

use crate::values::any_return_data;

fn data() -> ReturnData {
    ReturnData {
        player_number: 3,
        team_number: 24,
        is_fallen: true,
        ground_to_field: Isometry2::new(Vector2::new(-1.5, 0.25), 0.5),
        ball: Some(TeamBall {
            position: Point2::new(2.0, -0.125),
            age: 1.5,
        }),
    }
}

fn with_float(place: usize, value: f32) -> Result<ReturnData, String> {
    let mut bytes = encode(&data()).unwrap();
    bytes[place..place + 4].copy_from_slice(&value.to_le_bytes());
    decode(&bytes).map_err(|error| error.to_string())
}

#[test]
fn every_field_stands_where_the_published_layout_has_it_in_its_unit() {
    let bytes = encode(&data()).unwrap();
    assert_eq!(bytes[..8], *b"RGrt\x04\x03\x18\x01");
    let floats: Vec<_> = bytes[8..]
        .chunks(4)
        .map(|float| f32::from_le_bytes(float.try_into().unwrap()))
        .collect();
    assert_eq!(floats[..2], [-1500.0, 250.0]);
    assert!((floats[2] - 0.5).abs() < 1e-6);
    assert_eq!(floats[3..], [1.5, 2000.0, -125.0]);
}

#[test]
fn a_ball_that_was_never_seen_has_age_minus_1() {
    let data = ReturnData {
        ball: None,
        ..data()
    };
    let bytes = encode(&data).unwrap();
    assert_eq!(bytes[20..24], (-1.0_f32).to_le_bytes());
    assert_eq!(bytes[24..], [0; 8]);
    assert_eq!(decode(&bytes).unwrap().ball, None);
}

#[test]
fn what_no_robot_says_is_refused() {
    for (place, value, expected) in [
        (8, f32::NAN, "`pose` is NaN instead of a finite number"),
        (
            12,
            f32::INFINITY,
            "`pose` is inf instead of a finite number",
        ),
        (16, 4.0, "`pose` is 4 instead of an angle from -pi to pi"),
        (
            20,
            -0.5,
            "`ballAge` is -0.5 instead of a number of seconds, or -1 for never",
        ),
        (
            20,
            -1.0,
            "`ball` is 2 instead of 0, since the ball was never seen",
        ),
        (
            28,
            f32::NEG_INFINITY,
            "`ball` is -inf instead of a finite number",
        ),
    ] {
        assert_eq!(with_float(place, value).unwrap_err(), expected);
    }
    let mut bytes = encode(&data()).unwrap();
    bytes[5] = 21;
    assert_eq!(
        decode(&bytes).unwrap_err().to_string(),
        "`playerNum` is 21 instead of a shirt's number from 1 to 20"
    );
}

#[test]
fn what_no_robot_may_say_is_not_sent() {
    let mut lost = data();
    lost.ground_to_field.translation.x = f32::NAN;
    let message = encode(&lost).unwrap_err().to_string();
    assert_eq!(message, "`pose` is NaN instead of a finite number");
    let mut far = data();
    far.ground_to_field.translation.x = f32::MAX;
    assert!(encode(&far).is_err(), "it is infinite in mm");
    let nobody = ReturnData {
        player_number: 0,
        ..data()
    };
    assert!(encode(&nobody).is_err());
    let mut early = data();
    early.ball = Some(TeamBall {
        age: -0.1,
        ..TeamBall::default()
    });
    assert!(encode(&early).is_err());
}

fn is_close(one: &ReturnData, other: &ReturnData) -> bool {
    let pose = one.ground_to_field.inverse() * other.ground_to_field;
    let balls_are_close = match (one.ball, other.ball) {
        (Some(one), Some(other)) => {
            one.age == other.age && (one.position - other.position).norm() < 1e-5
        }
        (None, None) => true,
        _ => false,
    };
    (one.player_number, one.team_number, one.is_fallen)
        == (other.player_number, other.team_number, other.is_fallen)
        && pose.translation.vector.norm() < 1e-4
        && pose.rotation.angle().abs() < 1e-5
        && balls_are_close
}

proptest! {
    #[test]
    fn what_is_encoded_is_decoded_again(data in any_return_data()) {
        let bytes: [u8; LENGTH] = encode(&data).unwrap();
        let decoded = decode(&bytes).unwrap();
        prop_assert!(is_close(&data, &decoded), "{:?}", decoded);
    }
}
