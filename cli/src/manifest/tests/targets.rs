//! What targets say of machines, robots and files.

use super::*;

/// Codes in order and the whole text of a robot with these lines in its target, among files of its workspace.
fn told(target: &str, cargo: &str) -> (Vec<&'static str>, String) {
    let manifest =
        format!("{ROBOT}[[target]]\nname = \"board\"\nhardware = \"h::Hardware\"\n{target}\n");
    let workspace = Workspace::in_memory([
        ("hulk.toml", manifest.as_str()),
        ("Cargo.toml", cargo),
        (
            ".cargo/config.toml",
            "[profile.local]\ninherits = \"dev\"\n",
        ),
        ("motions/wave.toml", ""),
        ("system/robot.service", ""),
        ("ssh.config", ""),
    ]);
    let mut diagnostics = Diagnostics::new();
    let _ = load(&workspace, &mut diagnostics);
    let sorted = diagnostics.sorted();
    let codes = sorted.iter().map(|one| one.code.name()).collect();
    (codes, render(&diagnostics, &workspace, false))
}

fn deployed(lines: &str) -> (Vec<&'static str>, String) {
    told(
        &format!("[target.deploy]\n{lines}"),
        "[workspace]\nmembers = []\n",
    )
}

const FOLDER: &str = "folder = \"/home/nao/robot\"\n";

#[test]
fn what_a_robot_can_be_deployed_with_is_no_mistake() {
    let (codes, text) = deployed(&format!(
        "{FOLDER}hosts = {{ a = \"nao@10.1.24.22\", b = \"b\" }}\nfiles = [\"motions\", \"./motions/wave.toml\", \".\"]\n\
         unit = \"system/robot.service\"\nssh_config = \"ssh.config\"\nsystemctl = \"sudo systemctl\"\n\
         wlan = \"nmcli connection up {{name}}\""
    ));
    assert!(codes.is_empty(), "{text}");
    let (codes, text) = deployed(&format!(
        "{FOLDER}wlan = \"\"\"echo \\\\\" '\"'{{name}}'\"' \"it's\" {{name}}\"\"\""
    ));
    assert!(codes.is_empty(), "{text}");
    // Another shell takes the quoted word apart again.
    let inner = "wlan = 'sh -c \"rfkill unblock wifi && nmcli connection up {name}\"'";
    let (codes, text) = deployed(&format!("{FOLDER}{inner}"));
    assert!(codes.is_empty(), "{text}");
}

#[test]
fn what_no_robot_could_do_is_an_error_at_its_value() {
    for (lines, part, place) in [
        (
            "folder = \"robot\"",
            "`robot` is no whole path",
            "hulk.toml:7:10",
        ),
        (
            "folder = \"~/robot\"",
            "what `~` stands for",
            "hulk.toml:7:10",
        ),
        (
            "folder = \"/r\"\nwlan = \"nmcli up\"",
            "write `{name}` in its place",
            "hulk.toml:8:8",
        ),
        (
            "folder = \"/r\"\nwlan = 'wpa_cli set_network 0 ssid \"{name}\"'",
            "leave the quotes out",
            "hulk.toml:8:8",
        ),
        (
            "folder = \"/r\"\nwlan = \"echo \\\"it's\\\" ; join '{name}'\"",
            "leave the quotes out",
            "hulk.toml:8:8",
        ),
        (
            "folder = \"/r\"\nsystemctl = \"\"",
            "leave it out for `systemctl --user`",
            "hulk.toml:8:13",
        ),
        (
            "folder = \"/r\"\n[target.deploy.hosts]\na = \"a\"\nb = \"\"",
            "`` is no destination",
            "hulk.toml:10:5",
        ),
        (
            "folder = \"/r\"\nfiles = [\"motions\", \"../motions\"]",
            "`../motions` is no plain path",
            "hulk.toml:8:21",
        ),
        (
            "folder = \"/r\"\nunit = \"/etc/systemd/system/robot.service\"",
            "`/etc/systemd/system/robot.service` is no plain path",
            "hulk.toml:8:8",
        ),
    ] {
        let (codes, text) = deployed(lines);
        assert_eq!(codes, ["invalid-value"], "{lines}\n{text}");
        assert!(
            text.contains(part) && text.contains(place),
            "{lines}\n{text}"
        );
    }
}

#[test]
fn parameters_from_elsewhere_are_an_error_where_they_are_sent() {
    let told = |parameters: &str, target: &str| {
        let manifest = format!(
            "{ROBOT}parameters = \"{parameters}\"\n[[target]]\nname = \"board\"\nhardware = \"h::Hardware\"\n{target}\n"
        );
        let workspace = Workspace::in_memory([("hulk.toml", manifest.as_str())]);
        let mut diagnostics = Diagnostics::new();
        let _ = load(&workspace, &mut diagnostics);
        render(&diagnostics, &workspace, false)
    };
    let deployed = "[target.deploy]\nfolder = \"/r\"";
    for parameters in ["../shared", "/shared"] {
        let text = told(parameters, deployed);
        let expected = format!("`{parameters}` is no plain path below the workspace root");
        assert!(
            text.contains(&expected) && text.contains("hulk.toml:3:14"),
            "{text}"
        );
        assert_eq!(told(parameters, ""), "", "nothing is sent");
    }
    assert_eq!(told("./values", deployed), "");
}

#[test]
fn a_program_lies_in_no_others_place_on_the_robot() {
    for (name, is_taken) in [
        ("runs", true),
        ("start", true),
        ("parameters", true),
        ("motions", true),
        ("system", true),
        ("motion", false),
    ] {
        let manifest = format!(
            "{ROBOT}[[target]]\nname = \"{name}\"\nhardware = \"h::Hardware\"\n[target.deploy]\n{FOLDER}\
             files = [\"./motions/wave.toml\"]\nunit = \"system/robot.service\"\n"
        );
        let workspace = Workspace::in_memory([
            ("hulk.toml", manifest.as_str()),
            ("motions/wave.toml", ""),
            ("system/robot.service", ""),
        ]);
        let mut diagnostics = Diagnostics::new();
        let _ = load(&workspace, &mut diagnostics);
        let text = render(&diagnostics, &workspace, false);
        let is_told = text.contains(&format!("the program `{name}` would lie in the place"))
            && text.contains("hulk.toml:4:8");
        assert_eq!((is_told, text.is_empty()), (is_taken, !is_taken), "{text}");
    }
}

#[test]
fn a_file_that_is_not_there_is_warned_of_where_it_is_named() {
    for (line, part, place) in [
        (
            "files = [\"motions\", \"motion\"]",
            "did you mean `motions`?",
            "hulk.toml:8:21",
        ),
        (
            "files = [\"elsewhere\"]",
            "`elsewhere` is not there",
            "hulk.toml:8:10",
        ),
        (
            "unit = \"system/robt.service\"",
            "did you mean `system/robot.service`?",
            "hulk.toml:8:8",
        ),
        // A folder is no unit file.
        (
            "unit = \"system\"",
            "`system` is not there",
            "hulk.toml:8:8",
        ),
        (
            "ssh_config = \"/none/ssh.config\"",
            "`--ssh-config` names another",
            "hulk.toml:8:14",
        ),
    ] {
        let (codes, text) = deployed(&format!("{FOLDER}{line}"));
        assert_eq!(codes, ["missing-file"], "{line}\n{text}");
        assert!(
            text.contains(part) && text.contains(place),
            "{line}\n{text}"
        );
    }
}

#[test]
fn a_profile_is_cargos_or_the_workspaces() {
    let cargo = "[workspace]\nmembers = []\n[profile.robot]\ninherits = \"release\"\n";
    for known in ["dev", "release", "robot", "local"] {
        let (codes, text) = told(&format!("profile = \"{known}\""), cargo);
        assert!(codes.is_empty(), "{text}");
    }
    for (unknown, help) in [
        ("robt", "did you mean `robot`?"),
        ("fastest", "add `[profile.fastest]` with `inherits"),
    ] {
        let (codes, text) = told(&format!("profile = \"{unknown}\""), cargo);
        assert_eq!(codes, ["unknown-profile"], "{text}");
        assert!(
            text.contains(help) && text.contains("hulk.toml:6:11"),
            "{text}"
        );
    }
    // Who cannot read Cargo.toml is told elsewhere.
    assert!(told("profile = \"robt\"", "[workspace").0.is_empty());
}

#[test]
fn a_triple_may_end_with_a_version_of_glibc_and_nothing_else() {
    for known in ["x86_64-unknown-linux-gnu", "x86_64-unknown-linux-gnu.2.28"] {
        assert!(told(&format!("triple = \"{known}\""), "").0.is_empty());
    }
    let (codes, text) = told("triple = \"x86_64-unknown-linux-gnu.new\"", "");
    assert_eq!(codes, ["invalid-value"], "{text}");
    assert!(text.contains("hulk.toml:6:10"), "{text}");
}
