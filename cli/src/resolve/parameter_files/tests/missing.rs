//! What no file gives: where it is asked for, and what has to be there.

use super::robot;
use crate::scan::fixture::cycler;

#[test]
fn a_missing_file_is_asked_for_where_the_manifest_names_its_folder() {
    let fixture = |line: &str| {
        let manifest = format!(
            "# The parameters are elsewhere.\n[robot]\nname = \"test\"\n{line}{}",
            cycler("Control", "real-time", "", &[], &["a"])
        );
        robot("a: Parameter<f32, \"a\">,", "").file("hulk.toml", &manifest)
    };
    for (line, place) in [
        ("parameters = \"tuned\"\n", "hulk.toml:4:14"),
        ("", "hulk.toml:2:1"),
    ] {
        fixture(line).expect("missing-parameter-file", &[place]);
    }
}

#[test]
fn an_option_that_a_function_reads_has_to_be_there() {
    let types = |attributes: &str| {
        format!("#[derive(Deserialize)]\npub struct Odd {{ {attributes} pub speed: Option<f32> }}")
    };
    let answer = |attributes: &str| {
        robot("a: Parameter<odd::Odd, \"odd\">,", "")
            .file("crates/types/src/lib.rs", "pub mod odd;")
            .file("crates/types/src/odd.rs", &types(attributes))
            .file("parameters/default.toml", "[odd]\n")
    };
    for function in ["with = \"by\"", "deserialize_with = \"by\""] {
        answer(&format!("#[serde({function})]")).expect("missing-parameter", &["odd.speed"]);
        for attributes in [
            format!("#[serde(default, {function})]"),
            format!("#[serde({function})] #[serde(default)]"),
        ] {
            answer(&attributes).robot();
        }
    }
    answer("").robot();
}
