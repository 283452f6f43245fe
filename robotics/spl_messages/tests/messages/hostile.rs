//! Bytes from anybody: nothing panics, and what is taken is exactly a message.

use proptest::prelude::*;
use spl_messages::{control_data, return_data, team_message};
use types::game::GameControllerMessage;
use types::team::TeamMessage;

use crate::values::{any_control_data, any_return_data, any_team_message};

fn team_bytes(message: &TeamMessage) -> Vec<u8> {
    let mut room = [0; team_message::GREATEST_LENGTH];
    team_message::encode(message, &mut room).unwrap().to_vec()
}

/// What is taken is encoded as the same bytes again.
fn control_data_is_exact(bytes: &[u8]) {
    if let Ok(message) = control_data::decode(bytes) {
        assert_eq!(control_data::encode(&message), bytes);
    }
}

/// What is taken is encoded as the same bytes again.
fn team_message_is_exact(bytes: &[u8]) {
    if let Ok(message) = team_message::decode(bytes) {
        assert_eq!(team_bytes(&message), bytes);
    }
}

/// What is taken is encoded as the same bytes again, but for the rounding from mm to m and back.
fn return_data_is_exact(bytes: &[u8]) {
    let Ok(data) = return_data::decode(bytes) else {
        return;
    };
    let Ok(again) = return_data::encode(&data) else {
        panic!("{data:?} was taken and cannot be sent");
    };
    assert_eq!(again[..8], bytes[..8]);
    for (one, other) in again[8..].chunks(4).zip(bytes[8..].chunks(4)) {
        let [one, other] = [one, other].map(|float| f32::from_le_bytes(float.try_into().unwrap()));
        let off = (one - other).abs();
        assert!(off <= 1e-6 * other.abs().max(1.0), "{one} {other}");
    }
}

/// Every message that is cut off or has one byte changed.
fn mistakes(bytes: &[u8], mut check: impl FnMut(&[u8])) {
    for length in 0..bytes.len() {
        check(&bytes[..length]);
    }
    for place in 0..bytes.len() {
        for change in 1..=255 {
            let mut wrong = bytes.to_vec();
            wrong[place] ^= change;
            check(&wrong);
        }
    }
}

/// Bytes of these lengths that begin like a message.
fn almost(length: impl Strategy<Value = usize>, front: Vec<u8>) -> impl Strategy<Value = Vec<u8>> {
    length
        .prop_flat_map(|length| prop::collection::vec(any::<u8>(), length))
        .prop_map(move |mut bytes| {
            let known = front.len().min(bytes.len());
            bytes[..known].copy_from_slice(&front[..known]);
            bytes
        })
}

#[test]
fn a_truncated_message_is_refused() {
    let message = encode_default();
    for length in 0..message.len() {
        assert!(control_data::decode(&message[..length]).is_err());
    }
    let data = spl_messages::ReturnData {
        player_number: 1,
        ..spl_messages::ReturnData::default()
    };
    let bytes = return_data::encode(&data).unwrap();
    for length in 0..bytes.len() {
        assert!(return_data::decode(&bytes[..length]).is_err());
    }
}

fn encode_default() -> [u8; control_data::LENGTH] {
    control_data::encode(&GameControllerMessage::default())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn no_changed_control_data_is_mistaken(message in any_control_data()) {
        mistakes(&control_data::encode(&message), control_data_is_exact);
    }

    #[test]
    fn no_changed_return_data_is_mistaken(data in any_return_data()) {
        mistakes(&return_data::encode(&data).unwrap(), return_data_is_exact);
    }

    #[test]
    fn no_changed_team_message_is_mistaken(message in any_team_message()) {
        let bytes = team_bytes(&message);
        mistakes(&bytes, team_message_is_exact);
        for length in 0..bytes.len() {
            prop_assert!(team_message::decode(&bytes[..length]).is_err());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        control_data_is_exact(&bytes);
        return_data_is_exact(&bytes);
        team_message_is_exact(&bytes);
    }

    #[test]
    fn random_control_data_is_taken_only_as_it_is(
        bytes in almost(Just(control_data::LENGTH), b"RGme\x12".to_vec())
    ) {
        control_data_is_exact(&bytes);
    }

    #[test]
    fn random_return_data_is_taken_only_as_it_is(
        bytes in almost(Just(return_data::LENGTH), b"RGrt\x04\x05\x18\x00".to_vec())
    ) {
        return_data_is_exact(&bytes);
    }

    #[test]
    fn random_team_messages_are_taken_only_as_they_are(
        bytes in almost(prop::sample::select(vec![7, 19, 23, 35]), b"HGtm\x01\x05".to_vec())
    ) {
        team_message_is_exact(&bytes);
    }
}
