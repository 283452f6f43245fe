//! What `hulkgen recording` says of small recordings, written here.

mod damaged;

use camino::{Utf8Path, Utf8PathBuf};
use hulkgen_mcap::layout::{Layout, Layouts, Part, PartKind, Struct};
use hulkgen_mcap::{
    Attachment, Channel, Description, MESSAGE_HEAD, Metadata, RecordingFile, Writer, opcode,
};
use serde_json::{Value, json};

use super::{Export, Found, Selection, Span, cat, export, info, list, look_at, recover};
use crate::outcome::Outcome;

/// Cycles of the recording below.
const CYCLES: u32 = 40;

fn message(channel: u16, cycle: u32, data: &[u8]) -> Vec<u8> {
    let mut record = vec![opcode::MESSAGE];
    record.extend(((MESSAGE_HEAD + data.len()) as u64).to_le_bytes());
    record.extend(channel.to_le_bytes());
    record.extend(cycle.to_le_bytes());
    let time = u64::from(cycle) * 10_000_000;
    record.extend(time.to_le_bytes());
    record.extend(time.to_le_bytes());
    record.extend_from_slice(data);
    record
}

fn layouts() -> Layouts {
    let structure = |name: &str, fields: &[(&str, Layout)]| {
        let fields = fields.iter();
        Layout::Struct(Struct {
            name: name.to_owned(),
            fields: fields
                .map(|(name, layout)| ((*name).to_owned(), layout.clone()))
                .collect(),
        })
    };
    let position = Layout::Tuple(vec![Layout::Float(32), Layout::Float(32)]);
    let ball = structure("Ball", &[("position", position), ("name", Layout::Text)]);
    let gray = |bytes: Layout| {
        let number = Layout::Unsigned(32);
        let fields = [
            ("width", number.clone()),
            ("height", number),
            ("data", bytes),
        ];
        Layout::Option(Box::new(structure("Gray", &fields)))
    };
    let part = |name: &str, kind, layout| Part {
        name: name.to_owned(),
        kind,
        layout,
    };
    let bytes = Layout::List(Box::new(Layout::Unsigned(8)));
    Layouts {
        frames: [
            (
                "0123".to_owned(),
                vec![
                    part("head", PartKind::Other, Layout::Unsigned(64)),
                    part("control::walk", PartKind::Node, bytes.clone()),
                    part("image", PartKind::Output, Layout::Unsigned(16)),
                ],
            ),
            (
                "4567".to_owned(),
                vec![part("image", PartKind::Output, gray(bytes))],
            ),
        ]
        .into(),
        values: [(
            "Control".to_owned(),
            structure("SharedOutputs", &[("ball", Layout::Option(Box::new(ball)))]),
        )]
        .into(),
        digests: [(
            "Control".to_owned(),
            ["ball", "fall_state"]
                .map(|output| ("control::walk".to_owned(), output.to_owned()))
                .into(),
        )]
        .into(),
        images: [("Eye.main_outputs.image".to_owned(), "gray".to_owned())].into(),
    }
}

/// What a robot writes in a cycle.
fn add_cycle(writer: &mut Writer, cycle: u32) {
    // Twice, as chunks of two readers have it.
    let position = [cycle as f32, 0.5].map(f32::to_le_bytes).concat();
    let ball = [&[1][..], &position, &[2], b"a,"].concat();
    writer.add(&message(
        2,
        cycle,
        if cycle.is_multiple_of(2) { &ball } else { &[0] },
    ));
    writer.add(&message(
        2,
        cycle,
        if cycle.is_multiple_of(2) { &ball } else { &[0] },
    ));
    let state = vec![7; cycle as usize];
    let frame = [&[0, cycle as u8, cycle as u8][..], &state, &[9]].concat();
    writer.add(&message(1, cycle, &frame));
    writer.add(&message(1, cycle, &[1, 0, 0, 0, 0, 0, 0, 0, 0]));
    let image = json!({"width": 1, "height": 1, "step": 3, "encoding": "rgb8", "data": "AQID"});
    writer.add(&message(3, cycle, image.to_string().as_bytes()));
    // Two pixels, in every fourth cycle.
    let gray: &[u8] = match cycle % 4 {
        0 => &[0, 1, 2, 1, 2, 50, 60],
        _ => &[0, 0],
    };
    writer.add(&message(4, cycle, gray));
}

/// A recording as a robot writes it; `with_end`: of a run that ended.
pub(crate) fn record(path: &Utf8Path, with_end: bool) {
    let channel = |topic: &str, encoding: &str, metadata: &[(&str, &str)]| Channel {
        topic: topic.to_owned(),
        schema: None,
        encoding: encoding.to_owned(),
        metadata: metadata
            .iter()
            .map(|(key, value)| ((*key).to_owned(), (*value).to_owned()))
            .collect(),
        once_per_chunk: false,
    };
    let metadata = |name: &str, entries: &[(&str, &str)]| Metadata {
        name: name.to_owned(),
        entries: entries
            .iter()
            .map(|(key, value)| ((*key).to_owned(), (*value).to_owned()))
            .collect(),
    };
    let description = Description {
        library: "test".to_owned(),
        channels: vec![
            channel("frames/Control", "hulkgen-frames", &[("types", "0123")]),
            channel("values/Control", "hulkgen-values", &[]),
            channel("Camera.main_outputs.image", "json", &[]),
            channel("frames/Eye", "hulkgen-frames", &[("types", "4567")]),
        ],
        metadata: vec![
            metadata(
                "run",
                &[
                    ("run", "1-2"),
                    ("robot", "test"),
                    ("target", "simulated"),
                    ("started", "17"),
                ],
            ),
            metadata("record", &[("Control", "on")]),
        ],
        attachments: vec![Attachment {
            name: "types.json".to_owned(),
            media_type: "application/json".to_owned(),
            data: json!(layouts()).to_string().into_bytes(),
        }],
        ..Description::default()
    };
    let mut writer = Writer::create(path.as_std_path(), description, u64::MAX).expect("it is new");
    for cycle in 0..CYCLES {
        add_cycle(&mut writer, cycle);
        if cycle % 8 == 7 {
            writer.close_chunk().expect("there is room");
        }
    }
    if with_end {
        let entries = [
            ("state", "COMPLETE"),
            ("Control.dropped", "3"),
            ("Control.overwritten", "5"),
        ];
        writer
            .write_metadata(&metadata("end", &entries))
            .expect("there is room");
    }
    writer.finish().expect("there is room");
}

pub(crate) fn folder() -> (tempfile::TempDir, Utf8PathBuf) {
    let folder = tempfile::tempdir().expect("there is room");
    let path = Utf8PathBuf::try_from(folder.path().to_owned()).expect("UTF-8");
    (folder, path)
}

fn found(path: &Utf8Path, selection: &Selection) -> Vec<Found> {
    let file = RecordingFile::open(path.as_std_path()).expect("it can be read");
    let mut all = Vec::new();
    let shown = cat(&file, selection, &mut |found| {
        all.push(found);
        Ok(true)
    });
    shown
        .and_then(|shown| shown.complete(None))
        .expect("it has these values");
    all
}

fn of(paths: &[&str]) -> Selection {
    Selection {
        paths: paths.iter().map(|path| (*path).to_owned()).collect(),
        span: Span::default(),
    }
}

#[test]
fn what_a_recording_is_needs_no_types() {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    record(&path, true);
    let info = info(&path).expect("it can be read");
    assert_eq!(
        (info.state, info.chunks, info.duration_s),
        ("COMPLETE", 5, 0.39)
    );
    let control = &info.instances[0];
    assert_eq!((control.frames, control.dropped), (u64::from(CYCLES), 3));
    let parts = control.parts.iter();
    let parts: Vec<_> = parts
        .map(|part| (&*part.name, part.bytes_per_cycle, part.most_bytes))
        .collect();
    // The state is as long as the cycle's number, behind a byte that says how long it is.
    let walk = ("control::walk", 20.5, u64::from(CYCLES));
    assert_eq!(parts, [walk, ("head", 1.0, 1), ("image", 1.0, 1)]);
    // With a byte that says what kind of message it is.
    assert_eq!(control.bytes_per_cycle, 23.5);
    let largest = &info.largest_states[0];
    assert_eq!(
        (&*largest.node, largest.bytes),
        ("control::walk", u64::from(CYCLES))
    );
    assert_eq!(info.channels[1].messages, 2 * u64::from(CYCLES));
    assert_eq!(info.run["robot"], "test");
}

#[test]
fn who_names_no_recording_hears_where_they_are() {
    let refusal = info("runs/absent.mcap".into()).expect_err("there is none");
    assert_eq!(refusal.outcome, Outcome::Bad);
    assert_eq!(refusal.message, "there is no recording `runs/absent.mcap`");
    assert!(
        refusal
            .help
            .is_some_and(|help| help.contains("`hulkgen recording list`"))
    );
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = Utf8Path::from_path(folder.path()).expect("it is UTF-8");
    let refusal = info(folder).expect_err("it is a folder");
    assert!(
        refusal.message.starts_with("cannot read"),
        "{}",
        refusal.message
    );
}

#[test]
fn what_is_no_recording_is_seen_before_a_robot_is_built() {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    record(&path, false);
    look_at(&path).expect("it breaks off, and is a recording");
    for text in ["[robot]\nname = \"nao\"\n", ""] {
        let path = folder.join("hulk.toml");
        std::fs::write(&path, text).expect("the folder is ours");
        let refusal = look_at(&path).expect_err("it is something else");
        assert!(
            refusal.message.ends_with(": it is no MCAP file"),
            "{refusal:?}"
        );
    }
    let refusal = look_at(&folder).expect_err("it is a folder");
    assert!(refusal.message.starts_with("there is no recording"));
}

#[test]
fn values_are_shown_by_path_and_once() {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    record(&path, true);
    let balls = found(&path, &of(&["Control.main_outputs.ball"]));
    assert_eq!(balls.len(), CYCLES as usize, "each cycle once");
    assert_eq!(
        balls[2].value,
        json!({"position": [2.0, 0.5], "name": "a,"})
    );
    assert_eq!((balls[2].cycle, balls[2].time), (2, 20_000_000));
    assert_eq!(balls[3].value, Value::Null);
    let x = found(&path, &of(&["Control.main_outputs.ball.position.0"]));
    assert_eq!(
        x.len(),
        CYCLES as usize / 2,
        "absent balls have no position"
    );
    assert_eq!(x[1].value, json!(2.0));
    let states = found(&path, &of(&["Control.states.control::walk"]));
    assert_eq!(states[3].value, json!([7, 7, 7]));
    let mut span = of(&["Control.main_outputs.image"]);
    span.span.times = Some(100_000_000..150_000_000);
    assert_eq!(found(&path, &span).len(), 5);
    span.span = Span {
        cycles: Some(38..99),
        times: None,
    };
    assert_eq!(found(&path, &span).len(), 2);
    let all = found(&path, &Selection::default());
    assert_eq!(all.len(), 4 * CYCLES as usize, "outputs without states");
}

#[test]
fn what_is_not_recorded_is_refused_with_what_is() {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    record(&path, true);
    let file = super::open(&path).expect("it can be read");
    let refused = cat(&file, &of(&["Control.main_outputs.bal"]), &mut |_| Ok(true));
    let refusal = refused.expect_err("there is no such output");
    assert!(refusal.message.contains("`Control.main_outputs.bal`"));
    assert!(
        refusal
            .help
            .is_some_and(|help| help.contains("`Control.main_outputs.ball`"))
    );
    let computed = of(&["Control.main_outputs.fall_state.Lying"]);
    let refused = cat(&file, &computed, &mut |_| Ok(true));
    let help = refused.expect_err("it has a digest alone").help;
    let help = help.unwrap_or_default();
    assert!(help.contains("`hulkgen replay FILE`"), "{help}");
    assert!(
        help.contains("`hulkgen run --record-output PATH`"),
        "{help}"
    );
    let misspelt = of(&["Control.main_outputs.ball.positoin.x"]);
    let refused = cat(&file, &misspelt, &mut |_| Ok(true));
    let refusal = refused.expect_err("a ball has no such part");
    let help = refusal.help.unwrap_or_default();
    assert!(
        help.contains("`Control.main_outputs.ball.position`"),
        "{help}"
    );
}

#[test]
fn paths_without_a_value_are_named() {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    record(&path, true);
    let file = super::open(&path).expect("it can be read");
    let mut absent = of(&[
        "Control.main_outputs.ball.name",
        "Control.main_outputs.image",
    ]);
    // The third ball is absent.
    absent.span.cycles = Some(3..4);
    let silent = |wanted: &Selection| {
        let shown = cat(&file, wanted, &mut |_| Ok(true)).expect("both are recorded");
        shown.complete(None).expect("nothing is damaged")
    };
    assert_eq!(silent(&absent), ["Control.main_outputs.ball.name"]);
    absent.span.cycles = Some(2..4);
    assert_eq!(silent(&absent), [""; 0]);
}

#[test]
fn a_file_that_breaks_off_is_made_whole() {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    record(&path, true);
    let bytes = std::fs::read(&path).expect("it was written");
    let file = super::open(&path).expect("it can be read");
    let last = file.contents().chunks[4].offset as usize;
    std::fs::write(&path, &bytes[..last + 30]).expect("there is room");
    let cut = info(&path).expect("its beginning is there");
    assert_eq!((cut.state, cut.chunks), ("INCOMPLETE", 4));
    assert_eq!(cut.cut_behind, Some(last as u64));
    let recovered = recover(&path, None).expect("the other file is new");
    assert_eq!((recovered.chunks, recovered.lost), (4, 30));
    let whole = info(&recovered.into).expect("it is whole");
    assert_eq!(
        (whole.cut_behind, whole.instances.clone()),
        (None, cut.instances)
    );
    assert_eq!(whole.state, "INCOMPLETE", "the run's end is lost");
    assert!(recover(&path, None).is_err(), "nothing is overwritten");
    let again = found(&recovered.into, &of(&["Control.main_outputs.ball"]));
    assert_eq!(again.len(), 32);
}

#[test]
fn recordings_are_found_in_the_folders_of_their_runs() {
    let (_keep, folder) = folder();
    for (name, with_end) in [("2", true), ("1", false)] {
        std::fs::create_dir(folder.join(name)).expect("it is new");
        record(&folder.join(name).join("recording.mcap"), with_end);
    }
    std::fs::write(folder.join("3.mcap"), "no recording").expect("there is room");
    let runs = list(&folder).expect("it can be read");
    let runs: Vec<_> = runs
        .iter()
        .map(|run| {
            (
                run.file.strip_prefix(&folder).expect("below").as_str(),
                run.state,
            )
        })
        .collect();
    assert_eq!(
        runs,
        [
            ("1/recording.mcap", "INCOMPLETE"),
            ("2/recording.mcap", "COMPLETE"),
            ("3.mcap", "UNREADABLE"),
        ]
    );
    assert!(list(&folder.join("nowhere")).is_err());
}

#[test]
fn values_become_tables_lines_and_images() {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    record(&path, true);
    let ball = of(&["Control.main_outputs.ball"]);
    let into = folder.join("ball.csv");
    export(&path, &ball, Export::Csv, &into).expect("it is new");
    let text = std::fs::read_to_string(&into).expect("it was written");
    let rows: Vec<_> = text.split("\r\n").collect();
    assert_eq!(rows[0], "cycle,time,position.0,position.1,name");
    assert_eq!(rows[3], "2,0.020000000,2.0,0.5,\"a,\"");
    assert_eq!(rows[4], "3,0.030000000,,,");
    let lines = folder.join("ball.json");
    export(&path, &ball, Export::Json, &lines).expect("it is new");
    let text = std::fs::read_to_string(&lines).expect("it was written");
    assert_eq!(text.lines().count(), CYCLES as usize);
    let images = folder.join("images");
    let camera = of(&["Camera.main_outputs.image"]);
    let exported = export(&path, &camera, Export::Png, &images).expect("it is new");
    assert_eq!(exported.files, u64::from(CYCLES));
    let image = std::fs::read(images.join("00000003.png")).expect("it was written");
    assert!(image.starts_with(b"\x89PNG"));
    assert!(image.windows(4).any(|window| window == [0, 1, 2, 3]));
    let eyes = folder.join("eyes");
    let eye = of(&["Eye.main_outputs.image"]);
    let exported = export(&path, &eye, Export::Png, &eyes).expect("its type is an image");
    assert_eq!(exported.files, u64::from(CYCLES) / 4, "others have none");
    let image = std::fs::read(eyes.join("00000004.png")).expect("it was written");
    let row = [0, 50, 50, 50, 60, 60, 60];
    assert!(image.windows(row.len()).any(|window| window == row));
    let refused = export(&path, &ball, Export::Png, &folder.join("none"));
    assert!(refused.is_err(), "a ball is no image");
    let left: Vec<_> = std::fs::read_dir(&folder)
        .expect("it is there")
        .map(|entry| entry.expect("it is there").file_name())
        .filter(|name| {
            !["a.mcap", "ball.csv", "ball.json", "eyes", "images"]
                .map(Into::into)
                .contains(name)
        })
        .collect();
    assert_eq!(left, [""; 0], "nothing is left of what was refused");
    assert!(
        export(&path, &ball, Export::Csv, &into).is_err(),
        "it exists"
    );
}
