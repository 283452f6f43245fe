//! What a verification makes of the counts of an instance.

use framework::replay::{InstanceVerified, Verification};

#[test]
fn what_has_nothing_to_verify_is_good_and_what_misses_its_frames_is_not() {
    let verified = |wanted, overwritten, dropped| InstanceVerified {
        instance: "Legs".to_owned(),
        record: "on".to_owned(),
        wanted,
        overwritten,
        dropped,
        ..InstanceVerified::default()
    };
    let other = InstanceVerified {
        wanted: Some(7),
        frames: 7,
        verified: 7,
        ..verified(None, 0, 0)
    };
    for (one, is_good, remark) in [
        (verified(Some(0), 0, 0), true, "it had no cycle"),
        (
            verified(Some(9), 9, 0),
            true,
            "nothing left in the file, 9 older",
        ),
        (verified(Some(9), 8, 1), true, "nothing left in the file"),
        (verified(Some(9), 0, 0), false, "nothing verified"),
        (verified(Some(9), 8, 0), false, "nothing verified"),
        (verified(Some(9), 0, 9), false, "nothing verified"),
        // It breaks off.
        (verified(None, 0, 0), false, "nothing verified"),
    ] {
        assert_eq!(one.is_good(), is_good, "{one:?}");
        let alone = Verification {
            instances: vec![one],
            ..Verification::default()
        };
        assert!(!alone.is_good(), "nothing at all was verified: {alone}");
        let mut both = alone;
        both.instances.push(other.clone());
        assert_eq!(both.is_good(), is_good, "{both}");
        assert!(both.to_string().contains(remark), "{both}");
    }
    let unfinished = InstanceVerified {
        frames: 3,
        unfinished: 3,
        ..verified(Some(9), 9, 0)
    };
    assert!(!unfinished.is_good());
}
