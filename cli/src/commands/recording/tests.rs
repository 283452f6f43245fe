//! What is answered of a small recording, as it was reviewed.

use serde_json::json;

use super::{info_text, line, list_text, with_version};
use crate::recording::tests::{folder, record};
use crate::recording::{self, Export, Found, Selection, Span};

fn assert_reviewed(name: &str, answer: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../snapshots/recording"
    ));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, answer));
}

/// The outputs of some cycles.
fn some() -> Selection {
    Selection {
        paths: vec!["Control.main_outputs.ball".to_owned()],
        span: Span {
            cycles: Some(2..5),
            times: None,
        },
    }
}

#[test]
fn info_tells_what_a_recording_is_and_what_makes_it_large() {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    record(&path, true);
    let mut info = recording::info(&path).expect("it can be read");
    // What it takes on the disk is the file system's.
    info.bytes = 8192;
    assert_reviewed("info.txt", &info_text(&info));
    let pretty = serde_json::to_string_pretty(&with_version(json!(info)));
    assert_reviewed("info.json", &pretty.expect("JSON has only string keys"));
}

#[test]
fn list_tells_a_line_for_each() {
    let (_keep, folder) = folder();
    record(&folder.join("whole.mcap"), true);
    record(&folder.join("unfinished.mcap"), false);
    let mut runs = recording::list(&folder).expect("it can be read");
    for run in &mut runs {
        run.bytes = 8192;
        run.file = run.file.strip_prefix(&folder).expect("below").to_owned();
    }
    assert_reviewed("list.txt", &list_text(&runs));
    let answer = line(&json!({ "version": 1, "recordings": runs }));
    assert_reviewed("list.json", &answer);
}

#[test]
fn cat_and_export_tell_values() {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    record(&path, true);
    let file = recording::open(&path).expect("it can be read");
    let mut lines = String::new();
    let shown = recording::cat(&file, &some(), &mut |found: Found| {
        lines += &line(&found.to_json());
        Ok(true)
    });
    let silent = shown.and_then(|shown| shown.complete(None));
    assert_eq!(silent.expect("it has these"), [""; 0]);
    assert_reviewed("cat.json", &lines);
    for (kind, name) in [(Export::Csv, "export.csv"), (Export::Json, "export.json")] {
        let into = folder.join(name);
        recording::export(&path, &some(), kind, &into).expect("it is new");
        let text = std::fs::read_to_string(&into).expect("it was written");
        assert_reviewed(name, &text);
    }
}

#[test]
fn a_table_has_a_column_for_every_item_that_a_list_ever_has() {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    record(&path, true);
    let mut walk = some();
    // As many numbers as the cycle says.
    walk.paths = vec!["Control.states.control::walk".to_owned()];
    let into = folder.join("walk.csv");
    recording::export(&path, &walk, Export::Csv, &into).expect("it is new");
    let text = std::fs::read_to_string(&into).expect("it was written");
    let rows: Vec<_> = text.lines().collect();
    assert_eq!(rows[0], "cycle,time,0,1,2,3");
    assert_eq!(rows[1], "2,0.020000000,7,7,,");
    assert_eq!(rows[3], "4,0.040000000,7,7,7,7");
}

#[test]
fn a_table_of_several_outputs_is_refused_with_two_of_them() {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    record(&path, true);
    let mut several = some();
    several.paths = vec!["Control.main_outputs".to_owned()];
    let into = folder.join("several.csv");
    let refused = recording::export(&path, &several, Export::Csv, &into);
    let help = refused.expect_err("there are two").help.unwrap_or_default();
    for output in [
        "`Control.main_outputs.ball`",
        "`Control.main_outputs.image`",
    ] {
        assert!(help.contains(output), "{help}");
    }
    assert!(!into.exists());
}
