//! A bed for five minutes of virtual time.

use std::path::Path;
use std::sync::Arc;

use framework::parameters::Layers;
use framework::testing::created;
use framework::{Clock, Hardware as _, Lockstep, Stop, Timestamp};
use sprinkler_garden::Hardware;
use sprinkler_runtime::runtime;

#[test]
fn the_bed_is_neither_dust_nor_mud() {
    let layers = Layers {
        directory: Path::new(env!("CARGO_MANIFEST_DIR")).join("../parameters"),
        ..Layers::default()
    };
    let (clock, stop) = (Clock::stepped(), Stop::new());
    let (hardware, mut robot): (Arc<Hardware>, _) =
        created(&layers, "bed", &[], &clock, &stop, runtime::create);
    let (mut opened, mut was_open) = (0, false);
    Lockstep::new(&mut robot, &*hardware)
        .run_until(Timestamp::from_nanos(300_000_000_000), |_| {
            let truth = hardware.truth();
            let is_open = truth["is_open"] == true;
            opened += u32::from(is_open && !was_open);
            was_open = is_open;
            let moisture = truth["moisture"].as_f64().expect("it is a number");
            // It begins at 0.3; a shower gives 0.15 that nobody asked for.
            assert!((0.29..0.7).contains(&moisture), "{truth}");
        })
        .expect("nothing ends it");
    // With every shower it stays closed for long, between them it opens and closes.
    assert!(
        (5..100).contains(&opened),
        "the valve opened {opened} times"
    );
}
