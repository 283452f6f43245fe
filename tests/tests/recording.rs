//! The whole NAO recorded in lockstep, and every cycle of it recomputed.

use framework::recorded::{About, Recording, Settings};
use framework::replay::verify;
use framework::{Lockstep, Record, Timestamp};
use hulkgen_recording::Recording as File;
use nao_runtime::recording;
use support::nao::Nao;

/// Room for two cameras in a world that does not run at the pace of the clock.
const LARGE: usize = 256;

#[test]
fn every_cycle_of_the_nao_is_recomputed_bit_for_bit() {
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let path = folder.path().join("nao.mcap");
    let mut nao = Nao::new(&["--pose", "2.0,0.0,0.0", "--ball", "2.9,0.3"], &[]);
    let settings = Settings {
        blocks: LARGE,
        ..Settings::default()
    };
    let mut tape = Recording::start_with(&path, &nao.robot, About::default(), settings, |_| {
        Record::On
    })
    .expect("the folder is empty");
    let hardware = nao.hardware.clone();
    let mut lockstep =
        Lockstep::new(&mut nao.robot, &*hardware).observed(|instance| tape.observer(instance));
    lockstep
        .run_until(Timestamp::from_nanos(2_000_000_000), |_| {})
        .expect("no node fails");
    drop(lockstep);
    let report = tape.end();
    assert!(report.ended.is_complete, "{report}");
    let file = File::open(&path).expect("it was written");
    let verification = verify(&file, recording::INSTANCES).expect("it is of this robot");
    println!("{verification}");
    assert_eq!(verification.divergence, None, "{verification}");
    assert_eq!(verification.unknown, Vec::<String>::new());
    for one in &verification.instances {
        assert_eq!(one.unreadable, None, "{verification}");
        assert_eq!((one.diverged, one.dropped), (0, 0), "{verification}");
    }
    for name in ["VisionTop", "VisionBottom", "Control", "Audio"] {
        let mut all = verification.instances.iter();
        let one = all.find(|one| one.instance == name);
        let one = one.expect("it is an instance of the NAO");
        assert!(
            one.verified > 20 && one.outputs >= one.verified,
            "{verification}"
        );
    }
}
