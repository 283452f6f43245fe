//! The four cyclers in virtual time: what is given when, what the filter makes of it, and the picture of it.

#[path = "../examples/figure/drawing.rs"]
mod drawing;
#[path = "../examples/figure/story.rs"]
mod story;

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use framework::parameters::Layers;
use framework::recorded::{About, Recording, Settings};
use framework::testing::created;
use framework::{Clock, Lockstep, Robot, Stop, Threads, Timestamp};
use timing_hardware::Hardware;
use timing_nodes::types::Sets;
use timing_runtime::parameters::Parameters;
use timing_runtime::runtime;

/// Three images.
const END: Timestamp = Timestamp::from_nanos(6_000_000_000);

fn example(path: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

fn robot(clock: &Clock, stop: &Stop) -> (Arc<Hardware>, Robot<Parameters>) {
    let layers = Layers {
        directory: example("parameters"),
        ..Layers::default()
    };
    created(&layers, "rail", &[], clock, stop, runtime::create)
}

/// A run with its recording.
fn recorded() -> (Arc<Hardware>, hulkgen_recording::Recording) {
    let (hardware, mut robot) = robot(&Clock::stepped(), &Stop::new());
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let path = folder.path().join("timing.mcap");
    let manifest = std::fs::read_to_string(example("hulk.toml")).expect("it is there");
    let about = About {
        files: vec![(
            "hulk.toml".to_owned(),
            "application/toml".to_owned(),
            manifest,
        )],
        outputs: vec!["Localization.main_outputs.sets".to_owned()],
        ..About::default()
    };
    let mut recording =
        Recording::start(&path, &robot, about, Settings::default()).expect("the folder is empty");
    let mut lockstep =
        Lockstep::new(&mut robot, &*hardware).observed(|instance| recording.observer(instance));
    lockstep.run_until(END, |_| {}).expect("nothing ends it");
    drop(lockstep);
    let report = recording.end();
    assert!(report.ended.is_complete, "{report}");
    let recording = hulkgen_recording::Recording::open(&path).expect("it was just written");
    (hardware, recording)
}

#[test]
fn the_readme_says_what_is_printed() {
    let (hardware, _) = recorded();
    let printed = hardware.printed().join("\n");
    let readme = std::fs::read_to_string(example("README.md")).expect("it is there");
    let (_, block) = readme.split_once("```text\n0.5").expect("it has a block");
    let (block, _) = block.split_once("\n```").expect("it ends");
    assert!(printed.starts_with(&format!("0.5{block}")), "{printed}");
}

#[test]
fn what_is_later_than_an_unfinished_image_is_transient() {
    let (_, recording) = recorded();
    let story = story::of(&recording).expect("it has everything");
    assert_eq!(story.sets.len(), 12);
    let of = |at: f64| -> &Sets {
        let mut sets = story.sets.iter();
        sets.find(|sets| (sets.at - at).abs() < 1e-9)
            .expect("a cycle every half second")
    };
    // The image of 0.205 s is looked at until 1.705 s.
    let [vision, odometry, radio] = of(1.5).persistent;
    assert_eq!([vision.count, odometry.count, radio.count], [0, 0, 0]);
    let [vision, odometry, radio] = of(1.5).transient;
    // The sample of 1.5 s itself takes a millisecond more.
    assert_eq!([vision.count, odometry.count, radio.count], [0, 129, 2]);
    assert_eq!([odometry.first, odometry.last], [0.21, 1.49]);
    // Everything comes at once and in order, when it is known.
    let [vision, odometry, radio] = of(2.0).persistent;
    assert_eq!((vision.count, vision.first), (1, 0.205));
    assert_eq!([odometry.count, radio.count], [179, 3]);
    assert_eq!(of(2.0).transient.map(|span| span.count), [0; 3]);
    // Nothing is given for good twice, and nothing is lost.
    let persistent: u32 = story.sets.iter().map(|sets| sets.persistent[1].count).sum();
    let last = story.sets.last().expect("there are twelve");
    assert_eq!(persistent + last.transient[1].count, 599);
}

#[test]
fn the_filter_knows_where_it_is_although_images_are_late() {
    let (_, recording) = recorded();
    let story = story::of(&recording).expect("it has everything");
    for sets in story.sets {
        let t0 = Timestamp::from_nanos((sets.at * 1e9).round() as u64);
        // Wheels alone are wrong by 15 cm at the end; an image taken for the present is by 37 cm.
        let error = (f64::from(sets.position) - Hardware::position(t0)).abs();
        assert!(error < 0.09, "{error} m at {t0}");
    }
}

#[test]
fn in_threads_nobody_waits_for_the_image_either() {
    let (clock, stop) = (Clock::wall(), Stop::new());
    let (hardware, mut robot) = robot(&clock, &stop);
    let first = |hardware: &Hardware, begin: &str| {
        let printed = hardware.printed();
        printed.iter().position(|line| line.starts_with(begin))
    };
    let watcher = std::thread::spawn({
        let (hardware, stop) = (hardware.clone(), stop.clone());
        move || {
            // However slow this machine is just now.
            let end = Instant::now() + Duration::from_secs(60);
            while first(&hardware, "  persistent  Vision").is_none() && Instant::now() < end {
                std::thread::sleep(Duration::from_millis(20));
            }
            stop.request();
        }
    });
    Threads::new(&clock, &*hardware, &stop)
        .run(&mut robot.instances)
        .expect("nothing ends it before");
    watcher.join().expect("it only looks");
    let transient = first(&hardware, "  transient   Odometry").expect("it was used before");
    let persistent = first(&hardware, "  persistent  Vision").expect("it came");
    assert!(transient < persistent, "{:#?}", hardware.printed());
}

#[test]
fn the_figure_of_the_concepts_is_current() {
    let (_, recording) = recorded();
    let story = story::of(&recording).expect("it has everything");
    let picture = drawing::of(&story);
    let path = example("../../timing.svg");
    if std::env::var("INSTA_UPDATE").is_ok_and(|value| value == "always") {
        std::fs::write(&path, &picture).expect("the repository can be written");
    }
    let is = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        is == picture,
        "docs/timing.svg: `INSTA_UPDATE=always` writes it anew"
    );
}
