//! The codec against MessagePack as `rmp-serde` writes it, and against bytes that nobody meant.

use crate::wire::{WireCommand, WireState, sample_command, sample_state};
use lola::{COMMAND_BYTES, Command, DecodeError, STATE_BYTES, command, state};
use proptest::prelude::*;
use types::joints::Joints;

fn encoded_state() -> Vec<u8> {
    let mut bytes = Vec::new();
    state::encode(&sample_state(), &mut bytes).unwrap();
    bytes
}

fn encoded_command() -> Vec<u8> {
    let mut bytes = Vec::new();
    command::encode(&sample_command(), &mut bytes);
    bytes
}

/// The state with its keys in another order.
fn rotated(entries: &[(String, Vec<u8>)], by: usize) -> Vec<u8> {
    let mut bytes = vec![0x80 | entries.len() as u8];
    for place in 0..entries.len() {
        let (key, value) = &entries[(place + by) % entries.len()];
        bytes.extend(rmp_serde::to_vec(key).unwrap());
        bytes.extend(value);
    }
    bytes
}

#[test]
fn a_state_has_the_bytes_that_another_library_writes() {
    let bytes = encoded_state();
    assert_eq!(bytes.len(), STATE_BYTES);
    let expected = rmp_serde::to_vec_named(&WireState::from(&sample_state())).unwrap();
    assert_eq!(bytes, expected);
}

#[test]
fn a_state_survives_the_way_there_and_back() {
    assert_eq!(state::decode(&encoded_state()), Ok(sample_state()));
}

#[test]
fn the_acceleration_on_the_wire_is_negated() {
    let wire: WireState = rmp_serde::from_slice(&encoded_state()).unwrap();
    assert_eq!(sample_state().inertial.accelerometer.z, 9.75);
    assert_eq!(wire.accelerometer[2], -9.75);
}

#[test]
fn keys_may_stand_in_any_order() {
    let entries = WireState::from(&sample_state()).entries();
    for by in 0..entries.len() {
        assert_eq!(state::decode(&rotated(&entries, by)), Ok(sample_state()));
    }
}

#[test]
fn unknown_keys_are_skipped_whatever_they_hold() {
    let mut entries = WireState::from(&sample_state()).entries();
    let nested = rmp_serde::to_vec_named(&vec![WireState::from(&sample_state())]).unwrap();
    entries.insert(3, ("Future".to_owned(), nested));
    let deep = [vec![0x91; 5000], vec![0xc0]].concat();
    entries.push(("Deep".to_owned(), deep));
    assert_eq!(state::decode(&rotated(&entries, 0)), Ok(sample_state()));
}

#[test]
fn integers_and_doubles_are_numbers_too() {
    let mut entries = WireState::from(&sample_state()).entries();
    entries[2].1 = rmp_serde::to_vec(&(0.25_f64, -3)).unwrap();
    let state = state::decode(&rotated(&entries, 0)).unwrap();
    assert_eq!((state.inertial.roll, state.inertial.pitch), (0.25, -3.0));
}

#[test]
fn a_state_that_is_cut_anywhere_is_an_error() {
    let bytes = encoded_state();
    for end in 0..bytes.len() {
        assert_eq!(
            state::decode(&bytes[..end]),
            Err(DecodeError::Truncated { at: end })
        );
    }
}

#[test]
fn a_state_that_goes_on_is_an_error() {
    let mut bytes = encoded_state();
    bytes.push(0);
    assert_eq!(
        state::decode(&bytes),
        Err(DecodeError::Trailing { bytes: 1 })
    );
}

#[test]
fn missing_and_repeated_keys_are_errors() {
    let mut entries = WireState::from(&sample_state()).entries();
    let gyroscope = entries.remove(6);
    let missing = state::decode(&rotated(&entries, 0));
    assert_eq!(missing, Err(DecodeError::Missing { key: "Gyroscope" }));
    entries.extend([gyroscope.clone(), gyroscope]);
    let repeated = state::decode(&rotated(&entries, 0));
    assert_eq!(repeated, Err(DecodeError::Duplicate { key: "Gyroscope" }));
}

#[test]
fn arrays_of_another_length_are_errors() {
    let mut entries = WireState::from(&sample_state()).entries();
    entries[7].1 = rmp_serde::to_vec(&vec![0.0_f32; 24]).unwrap();
    let expected = DecodeError::WrongLength {
        key: "Position",
        expected: 25,
        found: 24,
    };
    assert_eq!(state::decode(&rotated(&entries, 0)), Err(expected));
}

#[test]
fn angles_that_are_no_number_are_errors() {
    for value in [f32::NAN, f32::INFINITY] {
        let mut state = sample_state();
        state.positions.left_ankle_roll = value;
        let mut bytes = Vec::new();
        state::encode(&state, &mut bytes).unwrap();
        assert_eq!(
            state::decode(&bytes),
            Err(DecodeError::OutOfRange { key: "Position" })
        );
    }
}

#[test]
fn a_state_with_another_kind_of_identifier_is_not_written() {
    let mut state = sample_state();
    state.configuration.head_version = "6.0.12".parse().unwrap();
    let error = state::encode(&state, &mut Vec::new()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the head's version must have 5 characters, not 6"
    );
}

#[test]
fn a_command_has_the_bytes_that_another_library_writes() {
    let bytes = encoded_command();
    assert_eq!(bytes.len(), COMMAND_BYTES);
    let expected = rmp_serde::to_vec_named(&WireCommand::from(&sample_command())).unwrap();
    assert_eq!(bytes, expected);
}

#[test]
fn a_command_survives_the_way_there_and_back() {
    let mut command = Command::default();
    assert_eq!(
        command::decode(&encoded_command(), &mut command),
        Ok(COMMAND_BYTES)
    );
    assert_eq!(command, sample_command());
}

#[test]
fn a_command_that_is_cut_waits_for_more_and_changes_nothing() {
    let bytes = encoded_command();
    for end in 0..bytes.len() {
        let mut command = Command::default();
        let cut = command::decode(&bytes[..end], &mut command);
        assert_eq!(cut, Err(DecodeError::Truncated { at: end }));
        assert_eq!(command, Command::default());
    }
}

#[test]
fn two_commands_in_one_read_are_taken_one_by_one() {
    let bytes = [encoded_command(), vec![0x80]].concat();
    let mut command = Command::default();
    let first = command::decode(&bytes, &mut command).unwrap();
    assert_eq!(command::decode(&bytes[first..], &mut command), Ok(1));
}

#[test]
fn keys_that_a_command_lacks_keep_their_values() {
    let mut bytes = vec![0x81];
    bytes.extend(rmp_serde::to_vec("Chest").unwrap());
    bytes.extend(rmp_serde::to_vec(&[1.0_f32, 0.5, 0.25]).unwrap());
    let mut command = sample_command();
    command::decode(&bytes, &mut command).unwrap();
    assert_eq!(command.leds.chest.green, 0.5);
    assert_eq!(command.motors, sample_command().motors);
}

#[test]
fn a_float_keeps_its_bits() {
    let mut state = sample_state();
    state.temperatures = Joints::from_fn(|joint| f32::from_bits(0x3f80_0001 + joint as u32));
    let mut bytes = Vec::new();
    state::encode(&state, &mut bytes).unwrap();
    assert_eq!(state::decode(&bytes), Ok(state));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn arbitrary_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..1024)) {
        let _ = state::decode(&bytes);
        let _ = command::decode(&bytes, &mut Command::default());
    }

    #[test]
    fn a_state_with_changed_bytes_never_panics(
        changes in proptest::collection::vec((0..STATE_BYTES, any::<u8>()), 1..8),
    ) {
        let mut bytes = encoded_state();
        for (place, byte) in changes {
            bytes[place] = byte;
        }
        if let Ok(state) = state::decode(&bytes) {
            prop_assert!(state.positions.to_array().iter().all(|angle| angle.is_finite()));
        }
    }

    #[test]
    fn a_command_with_changed_bytes_never_panics(
        changes in proptest::collection::vec((0..COMMAND_BYTES, any::<u8>()), 1..8),
    ) {
        let mut bytes = encoded_command();
        for (place, byte) in changes {
            bytes[place] = byte;
        }
        let _ = command::decode(&bytes, &mut Command::default());
    }

    #[test]
    fn hostile_values_behind_an_unknown_key_never_panic(
        value in proptest::collection::vec(any::<u8>(), 0..64),
    ) {
        let bytes = [vec![0x8d, 0xa1, b'x'], value].concat();
        prop_assert!(state::decode(&bytes).is_err());
    }
}
