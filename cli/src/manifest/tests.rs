//! Manifests with one mistake each.

mod targets;

use super::load;
use crate::diagnostics::{Code, Diagnostics, render};
use crate::workspace::Workspace;

const ROBOT: &str = "[robot]\nname = \"x\"\n";

/// Codes in order, and the whole text.
fn mistakes(manifest: &str) -> (Vec<&'static str>, String) {
    let workspace = Workspace::in_memory([("hulk.toml", manifest)]);
    let mut diagnostics = Diagnostics::new();
    let loaded = load(&workspace, &mut diagnostics);
    assert_eq!(loaded.is_err(), diagnostics.has_errors());
    let codes = diagnostics
        .sorted()
        .iter()
        .map(|one| one.code.name())
        .collect();
    (codes, render(&diagnostics, &workspace, false))
}

#[test]
fn every_name_has_its_place() {
    let text = format!(
        "{ROBOT}[[cycler]]\nname = \"Vision\"\nkind = \"perception\"\n\
         instances = [\"Top\", {{ name = \"Bottom\" }}]\nsetup_nodes = [\"a::b\"]\n\
         nodes = [{{ node = \"a::c\", on_failure = \"skip\" }}]\n\
         [[target]]\nname = \"simulated\"\nhardware = \"h::Hardware\"\n"
    );
    let workspace = Workspace::in_memory([("hulk.toml", text.as_str())]);
    let mut diagnostics = Diagnostics::new();
    let manifest = load(&workspace, &mut diagnostics).unwrap();
    let at = |range: &std::ops::Range<usize>| &text[range.clone()];
    let vision = &manifest.cyclers[0];
    assert_eq!(at(&vision.name_range), "\"Vision\"");
    assert_eq!(at(&vision.instances[0].range), "\"Top\"");
    assert_eq!(at(&vision.instances[1].range), "\"Bottom\"");
    assert_eq!(vision.instances[1].name.as_str(), "VisionBottom");
    assert_eq!(at(&vision.nodes[0].range), "\"a::b\"");
    assert_eq!(at(&vision.nodes[1].range), "\"a::c\"");
    assert!(vision.nodes[0].setup && !vision.nodes[1].setup);
    assert_eq!(at(&manifest.targets[0].hardware_range), "\"h::Hardware\"");
}

#[test]
fn all_mistakes_of_keys_and_values_come_at_once() {
    let (codes, text) = mistakes(
        "[robot]\nname = \"x\"\nidentitis = [\"body\"]\n\
         [[cycler]]\nname = \"vision\"\nkind = \"perceptoin\"\n\
         nodes = [\"a\", { node = \"a::b\", on_failur = \"skip\" }]\ndeadline = \"12\"\n\
         [[cycler]]\nkind = \"real-time\"\nqueue = \"many\"\nnodes = [\"a::b\"]\n\
         [[target]]\nname = \"simulated\"\nhardwear = \"h::Hardware\"\n\
         [[bridge]]\n",
    );
    assert_eq!(
        codes,
        [
            "unknown-key",
            "invalid-name",
            "invalid-value",
            "invalid-name",
            "unknown-key",
            "invalid-value",
            "missing-key",
            "invalid-value",
            "missing-key",
            "unknown-key",
            "missing-key",
        ],
        "{text}"
    );
    for part in [
        "did you mean `identities`?",
        "did you mean `perception`?",
        "did you mean `on_failure`?",
        "did you mean `hardware`?",
        "write it in UpperCamelCase",
        "`name` is missing",
        "`path` is missing",
        "hulk.toml:3:1",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

#[test]
fn a_manifest_that_is_no_toml_shows_every_line_that_is_not() {
    let (codes, text) = mistakes("[robot\nname = \"x\"\nx = = 1\n");
    assert!(
        codes.len() >= 2 && codes.iter().all(|code| *code == "syntax"),
        "{text}"
    );
    assert!(
        text.contains("hulk.toml:1:") && text.contains("hulk.toml:3:"),
        "{text}"
    );
}

#[test]
fn names_that_stand_twice_show_both_places() {
    let cycler = |name: &str, rest: &str| {
        format!(
            "[[cycler]]\nname = \"{name}\"\nkind = \"perception\"\nnodes = [\"a::b\"]\n{rest}\n"
        )
    };
    let top = "instances = [\"Top\"]";
    let target = "[[target]]\nname = \"s\"\nhardware = \"h::H\"\n";
    for (rest, part) in [
        (
            cycler("Vision", "") + &cycler("Vision", ""),
            "cycler `Vision` stands twice",
        ),
        (
            cycler("HSLNet", "") + &cycler("HslNet", ""),
            "would both be called `hsl_net`",
        ),
        (
            cycler("Vision", top) + &cycler("VisionTop", ""),
            "instance `VisionTop` stands twice",
        ),
        (
            cycler("A", "instances = [\"B\", \"B\"]"),
            "instance `AB` stands twice",
        ),
        (
            cycler("A", "setup_nodes = [\"a::b\"]"),
            "node `a::b` stands twice",
        ),
        (target.repeat(2), "target `s` stands twice"),
    ] {
        let (codes, text) = mistakes(&format!("{ROBOT}{rest}"));
        assert_eq!(codes, [Code::DuplicateName.name()], "{text}");
        assert!(text.contains(part) && text.contains("first here"), "{text}");
    }
}

#[test]
fn keys_of_the_other_kind_are_warned_of() {
    let (codes, text) = mistakes(&format!(
        "{ROBOT}[[cycler]]\nname = \"A\"\nkind = \"perception\"\nnodes = [\"a::b\"]\nwatchdog = \"1s\"\n"
    ));
    assert_eq!(codes, ["unused-key"]);
    assert!(text.contains("remove `watchdog`"), "{text}");
}

#[test]
fn empty_lists_and_numbers_out_of_range_are_errors() {
    for (rest, part) in [
        ("instances = []", "empty list of instances"),
        ("queue = 0", "from 1 to 4096"),
        (
            "scheduling = { policy = \"fifo\", priority = 100 }",
            "from 1 (least urgent) to 99",
        ),
    ] {
        let (codes, text) = mistakes(&format!(
            "{ROBOT}[[cycler]]\nname = \"A\"\nkind = \"perception\"\nnodes = [\"a::b\"]\n{rest}\n"
        ));
        assert_eq!(codes, ["invalid-value"], "{text}");
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn policy_and_priority_of_a_thread_belong_together() {
    let cycler = |cycler: &str, instances: &str| {
        mistakes(&format!(
            "{ROBOT}[[cycler]]\nname = \"A\"\nkind = \"perception\"\nnodes = [\"a::b\"]\n{instances}\n{cycler}\n"
        ))
    };
    let fifo = "scheduling = { policy = \"fifo\", priority = 80, cores = [0] }";
    let (codes, text) = cycler(
        fifo,
        "instances = [\"B\", { name = \"C\", scheduling = { cores = [2] } }]",
    );
    assert!(codes.is_empty(), "{text}");
    for (of_cycler, instances, code, part, place) in [
        (
            "scheduling = { priority = 80 }",
            "",
            "unused-key",
            "add `policy = \"fifo\"`",
            "hulk.toml:8:27",
        ),
        (
            "[cycler.scheduling]\npolicy = \"fifo\"",
            "",
            "missing-key",
            "add `priority = …`",
            "hulk.toml:9:10",
        ),
        (
            fifo,
            "instances = [{ name = \"B\", scheduling = { priority = 70 } }]",
            "unused-key",
            "write the cycler's `policy` here, too",
            "hulk.toml:7:54",
        ),
        (
            fifo,
            "instances = [{ name = \"B\", scheduling = { policy = \"round-robin\" } }]",
            "missing-key",
            "add `priority = 80` here, too",
            "hulk.toml:7:52",
        ),
        (
            "",
            "instances = [{ name = \"B\", scheduling = { policy = \"fifo\", priority = 0 } }]",
            "invalid-value",
            "from 1 (least urgent) to 99",
            "hulk.toml:7:71",
        ),
    ] {
        let (codes, text) = cycler(of_cycler, instances);
        assert_eq!(codes, [code], "{text}");
        assert!(text.contains(part) && text.contains(place), "{text}");
    }
}

/// What the manifest says about a generated folder, in a workspace with the members `nodes` and `tools/bench`.
fn generated(folder: &str, package: &str) -> (Vec<&'static str>, String) {
    let manifest =
        format!("{ROBOT}generated = \"{folder}\"\nparameters = \"./robot/parameters\"\n");
    let root = "[workspace]\nmembers = [\"nodes\", \"tools/bench\", \"generated\"]\n";
    let workspace = Workspace::in_memory([
        ("hulk.toml", manifest.as_str()),
        ("Cargo.toml", root),
        ("nodes/Cargo.toml", "[package]\nname = \"nodes\"\n"),
        ("tools/bench/Cargo.toml", "[package]\nname = \"bench\"\n"),
        ("generated/Cargo.toml", package),
    ]);
    let mut diagnostics = Diagnostics::new();
    let _ = load(&workspace, &mut diagnostics);
    let codes = diagnostics.sorted();
    let codes = codes.iter().map(|one| one.code.name()).collect();
    (codes, render(&diagnostics, &workspace, false))
}

#[test]
fn the_generated_folder_is_nobody_elses() {
    let own = "[package]\nname = \"x_runtime\"\n";
    for (folder, part) in [
        ("", "no plain path"),
        (".", "no plain path"),
        ("/tmp/x", "no plain path"),
        ("../x", "no plain path"),
        ("a/../b", "no plain path"),
        ("robot/parameters", "it is the folder of the parameters"),
        ("robot", "it contains the folder of the parameters"),
        (
            "robot/parameters/x",
            "it lies in the folder of the parameters",
        ),
        ("nodes", "it is the package in `nodes`"),
        ("nodes/src", "it lies in the package in `nodes`"),
        ("tools", "it contains the package in `tools/bench`"),
    ] {
        let (codes, text) = generated(folder, own);
        assert_eq!(codes, ["invalid-value"], "{folder}: {text}");
        assert!(
            text.contains(part) && text.contains("hulk.toml:3:13"),
            "{folder}: {text}"
        );
    }
    let (codes, text) = generated("generated", "[package]\nname = \"mine\"\n");
    assert_eq!(codes, ["invalid-value"], "{text}");
}

#[test]
fn the_generated_package_may_be_there_or_broken_or_renamed() {
    for package in [
        "[package]\nname = \"x_runtime\"\n",
        "<<<<<<< ours\n",
        "# Written by `hulkgen generate`\n[package]\nname = \"old_runtime\"\n",
    ] {
        for folder in ["generated", "other"] {
            let (codes, text) = generated(folder, package);
            assert!(codes.is_empty(), "{text}");
        }
    }
}

#[test]
fn a_missing_manifest_is_an_error() {
    let workspace = Workspace::in_memory([("a", "")]);
    let mut diagnostics = Diagnostics::new();
    assert!(load(&workspace, &mut diagnostics).is_err());
}

#[test]
fn letters_that_no_file_is_called_by_are_told_as_such() {
    let manifest = "[robot]\nname = \"grüße\"\n\
        [[cycler]]\nname = \"Prüfung\"\nkind = \"real-time\"\n\
        nodes = [\"nodes::a\", \"nodes::größe\"]\n\
        [[target]]\nname = \"prüf\"\nhardware = \"nodes::Gehäuse\"\n";
    let (codes, text) = mistakes(manifest);
    assert_eq!(codes, ["invalid-name"; 5], "{text}");
    let deed = "; of letters only ASCII ones are taken";
    assert_eq!(text.matches(deed).count(), 5, "{text}");
    assert!(text.contains("for itself; of letters"), "{text}");
    assert!(text.contains("hulk.toml:6:22"), "{text}");
    let (_, text) = mistakes(&manifest.replace("größe", "a-b"));
    assert_eq!(text.matches(deed).count(), 4, "{text}");
}

#[test]
fn every_identity_that_is_no_name_is_told_at_its_own_place() {
    let robot = |list: &str| format!("[robot]\nname = \"x\"\nidentities = {list}\n");
    let (codes, text) = mistakes(&robot("[\"body\", \"a/b\", \"\", \"Ü\"]"));
    assert_eq!(codes, ["invalid-name"; 3], "{text}");
    for part in [
        "`a/b` is no name",
        "`` is no name",
        "`Ü` is no name",
        "hulk.toml:3:23",
        "hulk.toml:3:30",
        "hulk.toml:3:34",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let (codes, text) = mistakes(&robot("[\"body\", \"head\", \"body\"]"));
    assert_eq!(codes, ["duplicate-name"], "{text}");
    for part in [
        "hulk.toml:3:31",
        "               ------          ^^^^^^ again",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

#[test]
fn which_cycles_are_recorded_is_one_choice() {
    let record = |record: &str| {
        mistakes(&format!(
            "{ROBOT}[[cycler]]\nname = \"A\"\nkind = \"real-time\"\nnodes = [\"a::b\"]\n\
             record = {record}\n[[target]]\nname = \"t\"\nhardware = \"h::H\"\n"
        ))
    };
    for (written, code, message, place) in [
        (
            "{ every = 2, while = \"x\" }",
            "invalid-value",
            "`every` together with `while` is no choice of cycles",
            "hulk.toml:7:10",
        ),
        (
            "{ every = 0 }",
            "invalid-value",
            "`0` is no number of cycles",
            "hulk.toml:7:20",
        ),
        (
            "{ every = -1 }",
            "invalid-value",
            "`-1` is no number of cycles",
            "hulk.toml:7:20",
        ),
        (
            "{ while = 1 }",
            "invalid-value",
            "expected a string",
            "hulk.toml:7:20",
        ),
        (
            "{ evry = 1 }",
            "unknown-key",
            "did you mean `every`?",
            "hulk.toml:7:12",
        ),
        (
            "{}",
            "missing-key",
            "`every` or `while` is missing",
            "hulk.toml:7:10",
        ),
    ] {
        let (codes, text) = record(written);
        assert_eq!(codes, [code], "{written}\n{text}");
        assert!(
            text.contains(message) && text.contains(place),
            "{written}\n{text}"
        );
    }
    for written in ["{ every = 1 }", "{ while = \"x\" }", "\"off\""] {
        assert_eq!(record(written).0, [""; 0], "{written}");
    }
}

#[test]
fn what_an_empty_manifest_lacks_is_a_table() {
    let (codes, text) = mistakes("");
    assert_eq!(codes, ["missing-key"], "{text}");
    assert!(text.contains("add a table `[robot]`"), "{text}");
}
