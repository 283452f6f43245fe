//! `deploy`, `robots`, `logs` and `recording pull` against a real sshd, with real keys and rsync.

mod field;
#[path = "../../../framework/src/testing/skipped.rs"]
#[expect(unreachable_pub, reason = "it is public where it stands")]
mod skipped;

use std::fs;
use std::os::unix::fs::MetadataExt as _;
use std::process::Command;
use std::sync::atomic::Ordering;

use field::Field;
use serde_json::Value;

#[test]
fn a_version_arrives_is_started_and_can_be_taken_back() {
    let Some(field) = Field::open("a_version_arrives_is_started_and_can_be_taken_back") else {
        return;
    };
    let (status, answer, said) =
        field.deploy("a --set a:speed=2 --set name=it's --wlan HALL --location hall --format json");
    assert_eq!(status, 0, "{answer}{said}");
    let answer: Value = serde_json::from_str(&answer).expect("it is JSON");
    let robot = &answer["robots"][0];
    assert_eq!(
        (
            robot["host"].as_str(),
            robot["is_done"].as_bool(),
            robot["state"].as_str()
        ),
        (Some("a"), Some(true), Some("runs"))
    );
    let first = field.current().expect("there is a version");
    assert_eq!(
        Some(first.as_str()),
        robot["version"]
            .as_str()
            .map(|it| format!("versions/{it}"))
            .as_deref()
    );
    for (file, text) in [
        ("parameters/default.toml", "speed = 1\n"),
        ("motions/wave.toml", "wave\n"),
    ] {
        assert_eq!(field.read(&format!("disk/current/{file}")), text);
    }
    // The unit is enabled where every version has it, and started after the switch.
    let expected = format!(
        "enable --force {}/lamp.service {first}\ndaemon-reload {first}\nrestart lamp.service {first}\n",
        field.path("disk/current").display()
    );
    assert_eq!(field.read("systemctl.log"), expected);
    assert_eq!(field.read("wlan.log"), "joined HALL\n");
    let started = Command::new(field.path("disk/current/start"))
        .arg("--more")
        .output()
        .expect("it starts");
    let started = String::from_utf8_lossy(&started.stdout).into_owned();
    let words = r#"["--location", "hall", "--set", "speed=2", "--set", "name=it's", "--more"]"#;
    assert!(started.starts_with(words), "{started}");

    // Names of versions are seconds.
    std::thread::sleep(std::time::Duration::from_millis(1100));
    field.write("robot/motions/wave.toml", "wave twice\n");
    assert_eq!(field.deploy("a").0, 0);
    let second = field.current().expect("there is a version");
    assert!(second > first, "{second} {first}");
    assert_eq!(field.read("disk/current/motions/wave.toml"), "wave twice\n");
    field.write("disk/current/parameters/default.toml", "speed = 3\n");
    let (status, answer, said) = field.hulkgen("deploy a --rollback");
    assert_eq!(status, 0, "{answer}{said}");
    let warning = format!(
        "warning: `parameters/default.toml` was changed in {}, which does not count now",
        second.trim_start_matches("versions/")
    );
    assert!(said.contains(&warning), "{said}");
    assert_eq!(field.current().as_ref(), Some(&first));
    assert_eq!(field.read("disk/current/motions/wave.toml"), "wave\n");
    assert!(
        field
            .read("systemctl.log")
            .ends_with(&format!("restart lamp.service {first}\n"))
    );
    // And forth again.
    assert_eq!(field.hulkgen("deploy a --rollback").0, 0);
    assert_eq!(field.current(), Some(second));
}

#[test]
fn the_program_is_told_of_which_commit_it_is() {
    let Some(field) = Field::open("the_program_is_told_of_which_commit_it_is") else {
        return;
    };
    let git = |words: &str| {
        let mut git = Command::new("git");
        let output = git.args(words.split(' ')).current_dir(field.path("robot"));
        let output = output.output().expect("git made this checkout");
        assert!(output.status.success(), "git {words}: {output:?}");
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    };
    let told = || {
        let (status, answer, said) = field.deploy("a");
        assert_eq!(status, 0, "{answer}{said}");
        let started = Command::new(field.path("disk/current/start")).output();
        let started = started.expect("it starts");
        let told = String::from_utf8_lossy(&started.stdout).into_owned();
        // Names of versions are seconds.
        std::thread::sleep(std::time::Duration::from_millis(1100));
        told
    };
    let none = told();
    assert!(none.starts_with(r#"[] Ok("") "#), "{none}");
    git("init --quiet");
    git("add --all");
    git("-c user.name=a -c user.email=a@b commit --quiet --message first");
    let commit = git("rev-parse HEAD");
    let clean = told();
    let expected = format!("[] Ok({commit:?}) ");
    assert!(clean.starts_with(&expected), "{clean}");
    field.write("robot/motions/wave.toml", "wave twice\n");
    let changed = told();
    let expected = format!("[] Ok(\"{commit} with changes\") ");
    assert!(changed.starts_with(&expected), "{changed}");
}

#[test]
fn a_connection_that_breaks_leaves_the_old_version_running() {
    let Some(field) = Field::open("a_connection_that_breaks_leaves_the_old_version_running") else {
        return;
    };
    let cut = field.cut_connections_after(1 << 20);
    let (status, answer, _) = field.deploy("a");
    assert_eq!(status, 1, "{answer}");
    assert!(
        answer.contains("a: failed: the connection broke"),
        "{answer}"
    );
    assert_eq!(cut.load(Ordering::Relaxed), 1);
    assert_eq!(field.current(), None);

    field.mend_connections();
    assert_eq!(field.deploy("a").0, 0);
    let old = field.current();
    let log = field.read("systemctl.log");
    fs::write(
        field.path("robot/motions/large"),
        &fs::read(field.path("padding")).expect("it is there")[1..],
    )
    .expect("the folder is ours");
    let cut = field.cut_connections_after(1 << 20);
    let (status, answer, _) = field.deploy("a");
    assert_eq!((status, cut.load(Ordering::Relaxed)), (1, 1), "{answer}");
    assert_eq!(field.current(), old);
    assert_eq!(field.read("systemctl.log"), log, "nothing was restarted");
    assert!(!field.path("disk/current/motions/large").exists());
    field.mend_connections();
    std::thread::sleep(std::time::Duration::from_millis(1100));
    assert_eq!(field.deploy("a").0, 0);
    assert_ne!(field.current(), old);
}

#[test]
fn the_program_is_where_cargo_was_told_to_build() {
    let Some(field) = Field::open("the_program_is_where_cargo_was_told_to_build") else {
        return;
    };
    let folder = field.path("elsewhere");
    let (status, _, said) = field.hulkgen_built_in("deploy a", &folder);
    // Without a profile of its own it is that of hulkgen, which is this test's.
    let profile = if cfg!(debug_assertions) {
        "debug"
    } else {
        "release"
    };
    let expected = folder.join(profile).join("lamp");
    assert_eq!(status, 1, "{said}");
    assert!(said.contains(&expected.display().to_string()), "{said}");
    fs::create_dir_all(folder.join(profile)).expect("the folder is ours");
    fs::copy(field.path("lamp"), expected).expect("the folder is ours");
    let (status, answer, said) = field.hulkgen_built_in("deploy a", &folder);
    assert_eq!(status, 0, "{answer}{said}");
}

#[test]
fn what_cannot_run_there_is_refused_before_the_switch() {
    let Some(field) = Field::open("what_cannot_run_there_is_refused_before_the_switch") else {
        return;
    };
    assert_eq!(field.deploy("a").0, 0);
    let old = field.current();
    let log = field.read("systemctl.log");
    let refused = |field: &Field, reason: &str, (status, answer, said): (i32, String, String)| {
        assert_eq!(status, 1, "{answer}{said}");
        assert!(answer.contains(reason), "{answer}{said}");
        assert_eq!(field.current(), old);
        assert_eq!(field.read("systemctl.log"), log);
    };

    // The machine's number in the header: another processor's.
    let program = fs::read(field.path("lamp")).expect("it is there");
    let mut other = program.clone();
    other[18] = if other[18] == 183 { 62 } else { 183 };
    fs::write(field.path("lamp"), &other).expect("it is ours");
    refused(&field, "the program is for ", field.deploy("a"));
    fs::write(field.path("lamp"), &program).expect("it is ours");

    // Parameters that the program itself refuses, on the robot.
    field.write("robot/parameters/default.toml", "speed = \"wrong\"\n");
    refused(&field, "refuses its parameters", field.deploy("a"));
    field.write("robot/parameters/default.toml", "speed = 1\n");

    // Parameters that were stored on the robot would be lost.
    field.write("disk/current/parameters/default.toml", "speed = 3\n");
    refused(
        &field,
        "`parameters/default.toml` was changed on the robot",
        field.deploy("a"),
    );
    // The robot's destination stands in the way home.
    let (_, answer, said) = field.deploy("a");
    let fetch = format!(
        "{}/./parameters/default.toml .`",
        field.path("disk/current").display()
    );
    let told = format!("{answer}{said}");
    assert!(
        told.contains("`rsync -aR -e 'ssh -F ") && told.contains(&fetch),
        "{told}"
    );
    // So would a layer that came with them.
    field.write("disk/current/parameters/default.toml", "speed = 1\n");
    field.write("disk/current/parameters/head.P1.toml", "speed = 3\n");
    refused(
        &field,
        "`parameters/head.P1.toml` was changed on the robot",
        field.deploy("a"),
    );
    // What was removed there does not come back without a word, and cannot be brought home.
    fs::remove_file(field.path("disk/current/parameters/head.P1.toml")).expect("it is ours");
    fs::remove_file(field.path("disk/current/motions/wave.toml")).expect("it is ours");
    let (_, answer, said) = field.deploy("a");
    assert!(!answer.contains("rsync"), "{answer}{said}");
    refused(
        &field,
        "`motions/wave.toml` was removed on the robot",
        field.deploy("a"),
    );
    std::thread::sleep(std::time::Duration::from_millis(1100));
    assert_eq!(field.deploy("a --discard-changes").0, 0);
    assert_eq!(
        field.read("disk/current/parameters/default.toml"),
        "speed = 1\n"
    );
}

#[test]
fn what_the_manifest_names_is_there_before_anything_is_sent() {
    let Some(field) = Field::open("what_the_manifest_names_is_there_before_anything_is_sent")
    else {
        return;
    };
    let manifest = field.read("robot/hulk.toml");
    for (right, wrong, part) in [
        ("[\"motions\"]", "[\"motion\"]", "look at `files`"),
        ("system/lamp", "system/lmap", "look at `unit`"),
    ] {
        field.write("robot/hulk.toml", &manifest.replace(right, wrong));
        let (status, answer, said) = field.deploy("a");
        assert_eq!(status, 1, "{answer}{said}");
        assert!(said.contains(part), "{said}");
    }
    // A unit file of the system would not be copied from where it lies, but taken away.
    let own = field.path("robot/system/lamp.service");
    let elsewhere = manifest.replace("system/lamp.service", &own.display().to_string());
    field.write("robot/hulk.toml", &elsewhere);
    let (status, answer, said) = field.deploy("a");
    assert_eq!(status, 1, "{answer}{said}");
    assert!(
        said.contains("is no plain path below the workspace"),
        "{said}"
    );
    assert!(own.is_file());
    assert_eq!(field.current(), None);
}

#[test]
fn a_version_that_does_not_start_gives_way_to_the_one_before() {
    let Some(field) = Field::open("a_version_that_does_not_start_gives_way_to_the_one_before")
    else {
        return;
    };
    assert_eq!(field.deploy("a").0, 0);
    let oldest = field.current().expect("there is a version");
    std::thread::sleep(std::time::Duration::from_millis(1100));
    assert_eq!(field.deploy("a").0, 0);
    let old = field.current().expect("there is a version");
    std::thread::sleep(std::time::Duration::from_millis(1100));
    field.write("robot/motions/broken", "");
    let (status, answer, _) = field.deploy("a");
    assert_eq!(status, 1, "{answer}");
    assert!(answer.contains("the new version did not start"), "{answer}");
    assert_eq!(field.current().as_ref(), Some(&old));
    assert!(
        field
            .read("systemctl.log")
            .ends_with(&format!("restart lamp.service {old}\n"))
    );
    // Who takes that back gets the one before it.
    assert_eq!(field.hulkgen("deploy a --rollback").0, 0);
    assert_eq!(field.current(), Some(oldest));
}

#[test]
fn a_version_that_ends_soon_after_its_start_gives_way_to_the_one_before() {
    let name = "a_version_that_ends_soon_after_its_start_gives_way_to_the_one_before";
    let Some(field) = Field::open(name) else {
        return;
    };
    assert_eq!(field.deploy("a").0, 0);
    let old = field.current().expect("there is a version");
    for (how, seen) in [
        ("mortal", "after 1 s lamp.service is failed"),
        ("restless", "after 1 s lamp.service was started again"),
    ] {
        // Names of versions are seconds.
        std::thread::sleep(std::time::Duration::from_millis(1100));
        let file = format!("robot/motions/{how}");
        field.write(&file, "");
        let (status, answer, said) = field.deploy("a");
        assert_eq!(status, 1, "{answer}{said}");
        let expected = format!(
            "the new version did not start, {} runs again: {seen}\n  help: `hulkgen logs`",
            old.trim_start_matches("versions/")
        );
        assert!(answer.contains(&expected), "{answer}");
        assert_eq!(field.current().as_ref(), Some(&old));
        fs::remove_file(field.path(&file)).expect("it is ours");
    }
    // Where the version before is broken meanwhile, the new one stays.
    assert_eq!(field.deploy("a").0, 0);
    let new = field.current().expect("there is a version");
    assert_ne!(new, old);
    field.write(&format!("disk/{old}/motions/mortal"), "");
    let (status, answer, _) = field.hulkgen("deploy a --rollback");
    assert_eq!(status, 1, "{answer}");
    assert!(
        answer.contains("the version before did not start, the one that ran runs again: "),
        "{answer}"
    );
    assert_eq!(field.current().as_ref(), Some(&new));
    // And neither starts.
    field.write(&format!("disk/{new}/motions/mortal"), "");
    let (status, answer, _) = field.hulkgen("deploy a --rollback");
    assert_eq!(status, 1, "{answer}");
    assert!(answer.contains("nor does the one that ran"), "{answer}");
    assert_eq!(field.current(), Some(new));
}

#[test]
fn a_full_disk_changes_nothing() {
    let name = "a_full_disk_changes_nothing";
    let Some(field) = Field::open(name) else {
        return;
    };
    let disk = field.path("disk");
    fs::create_dir_all(&disk).expect("the folder is ours");
    let mount = |options: &str| {
        let mut mount = Command::new("mount");
        mount
            .args(["-t", "tmpfs", "-o", options, "none"])
            .arg(&disk);
        mount.output().is_ok_and(|output| output.status.success())
    };
    let unmount = || drop(Command::new("umount").arg(&disk).output());
    if !mount("size=1m") {
        skipped::skip(
            name,
            "run as root, or in a container that may mount a tmpfs",
        );
        return;
    }
    // Too small, as the robot says before anything is sent.
    let (status, answer, _) = field.deploy("a");
    unmount();
    assert_eq!(status, 1, "{answer}");
    assert!(answer.contains("no space left: "), "{answer}");
    // Large enough as it seems, but without room for more than a few names: found out on the way.
    assert!(mount("size=64m,nr_inodes=10"));
    let (status, answer, _) = field.deploy("a");
    let current = field.current();
    unmount();
    assert_eq!(status, 1, "{answer}");
    assert!(answer.contains("no space left on the robot"), "{answer}");
    assert_eq!(current, None);
    assert_eq!(field.read("systemctl.log"), "");
}

#[test]
fn a_robot_that_is_named_twice_is_refused() {
    let Some(field) = Field::open("a_robot_that_is_named_twice_is_refused") else {
        return;
    };
    for (first, second) in [
        ("a", "ssh://robot-a"),
        ("a", "somebody@robot-a"),
        ("robot@::1", "[::1]"),
    ] {
        let (status, answer, said) = field.deploy(&format!("{first} b {second}"));
        assert_eq!(status, 2, "{answer}{said}");
        let expected = format!("`{first}` and `{second}` are one robot");
        assert!(said.contains(&expected), "{said}");
    }
    assert_eq!(field.current(), None);
}

#[test]
fn a_destination_is_what_ssh_takes() {
    let Some(field) = Field::open("a_destination_is_what_ssh_takes") else {
        return;
    };
    // Not the port of ssh's configuration.
    let port = field.ignore_port();
    let user = field.user();
    let url = format!("ssh://{user}@127.0.0.1:{port}");
    let (status, answer, said) = field.deploy(&url);
    assert_eq!(status, 0, "{answer}{said}");
    assert!(field.current().is_some());
    field.write("disk/runs/1-1/recording.mcap", "first");
    let (status, answer, said) = field.hulkgen(&format!("recording pull {url}"));
    let folder = format!("runs/{user}@127.0.0.1:{port}\n");
    assert_eq!((status, answer), (0, folder), "{said}");
    // The way that a person types is the same.
    field.write("disk/current/parameters/default.toml", "speed = 3\n");
    let (status, answer, said) = field.deploy(&url);
    assert_eq!(status, 1, "{answer}{said}");
    let config = field.path("ssh_config");
    let typed = format!(
        "`rsync -aR -e 'ssh -F {} -p {port}' {user}@127.0.0.1:",
        config.display()
    );
    assert!(answer.contains(&typed), "{answer}");
    let typed = answer.split('`').find(|part| part.starts_with("rsync -aR"));
    let fetched = Command::new("sh")
        .args(["-c", typed.expect("it was found above")])
        .current_dir(field.path("robot"))
        .status();
    assert!(fetched.expect("there is a shell").success());
    assert_eq!(field.read("robot/parameters/default.toml"), "speed = 3\n");
    // What rsync would take for a path.
    let (status, _, said) = field.deploy("nao@127.0.0.1:22");
    assert_eq!(status, 2, "{said}");
    assert!(said.contains("is no destination for ssh"), "{said}");
}

#[test]
fn robots_are_served_side_by_side_and_asked() {
    let Some(field) = Field::open("robots_are_served_side_by_side_and_asked") else {
        return;
    };
    // Each has a folder of its own below the home folder's place: one manifest, two disks would be two machines here.
    field.write_manifest(&field.path("disk"), false);
    let (status, answer, said) = field.deploy("a nobody@127.0.0.9");
    // Both are this machine, so only one of them wins the folder or both put the same; neither leaves it half.
    assert!(
        answer.contains("a: ") && answer.contains("nobody@127.0.0.9: failed: "),
        "{status} {answer}{said}"
    );
    assert_eq!(status, 1);
    assert!(said.contains("a: "), "progress is told: {said}");
    let version = field.current().expect("there is a version");

    field.write_manifest(&field.path("disk"), true);
    let (status, answer, _) = field.hulkgen("robots --format json");
    assert_eq!(status, 0, "{answer}");
    let answer: Value = serde_json::from_str(&answer).expect("it is JSON");
    let names: Vec<_> = answer["robots"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|it| it["host"].clone())
        .collect();
    assert_eq!(names, ["a", "b"]);
    assert_eq!(
        format!(
            "versions/{}",
            answer["robots"][0]["version"].as_str().unwrap_or_default()
        ),
        version
    );
    assert_eq!(answer["robots"][0]["state"], "active");
    assert!(answer["robots"][0]["free_kibibytes"].as_u64().is_some());

    let (status, answer, _) = field.hulkgen("logs a --lines 7");
    assert_eq!(
        (status, answer.as_str()),
        (0, "journal of --unit lamp.service --lines 7\n")
    );
    let (status, _, said) = field.hulkgen("logs c");
    assert_eq!(status, 2, "{said}");

    field.write("disk/runs/1-1/recording.mcap", "first");
    field.write("disk/runs/1-2/recording.mcap", "a ring");
    let ring = field.path("disk/runs/1-2/recording.mcap");
    let ring = fs::File::options().write(true).open(ring);
    let ring = ring.expect("it is ours");
    ring.set_len(1 << 24).expect("a hole takes no room");
    let (status, answer, said) = field.hulkgen("recording pull a");
    assert_eq!((status, answer.as_str()), (0, "runs/a\n"), "{said}");
    assert_eq!(field.read("robot/runs/a/1-1/recording.mcap"), "first");
    let ring = fs::metadata(field.path("robot/runs/a/1-2/recording.mcap"));
    let ring = ring.expect("it came");
    assert_eq!(ring.len(), 1 << 24);
    assert!(ring.blocks() * 512 < 1 << 20, "holes stay holes");
    field.write("disk/runs/2-2/recording.mcap", "second");
    let (status, answer, said) = field.hulkgen("recording pull a --newest --into here");
    assert_eq!((status, answer.as_str()), (0, "here/2-2\n"), "{said}");
    assert_eq!(field.read("robot/here/2-2/recording.mcap"), "second");
    assert!(!field.path("robot/here/1-1").exists());
    // The run that was written last is one whose folder is older than another one without a recording.
    field.write("disk/runs/3-3/notes.txt", "nothing was recorded");
    let (status, answer, said) = field.hulkgen("recording pull a --newest --into here");
    assert_eq!((status, answer.as_str()), (0, "here/2-2\n"), "{said}");
    let (status, answer, said) = field.hulkgen_in("robot/runs", "recording pull a --newest");
    let runs = field.path("robot/runs/a/2-2");
    let whole = format!("{}\n", runs.display());
    assert_eq!((status, answer), (0, whole), "{said}");
    assert_eq!(field.read("robot/runs/a/2-2/recording.mcap"), "second");
}

#[test]
fn doctor_looks_at_a_robot() {
    let Some(field) = Field::open("doctor_looks_at_a_robot") else {
        return;
    };
    let checks = |arguments: &str| -> Vec<(String, String, String)> {
        let (status, answer, said) = field.hulkgen(&format!("doctor --format json {arguments}"));
        let answer: Value = serde_json::from_str(&answer)
            .unwrap_or_else(|error| panic!("{error} in {answer}{said}"));
        let checks: Vec<_> = answer["checks"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|check| {
                ["about", "state", "message"]
                    .map(|key| check[key].as_str().unwrap_or_default().to_owned())
            })
            .map(|[about, state, message]| (about, state, message))
            .collect();
        let is_bad = checks.iter().any(|(_, state, _)| state == "bad");
        assert_eq!(status, i32::from(is_bad), "{checks:?}");
        checks
    };
    let told = checks("--host a");
    assert!(
        told.iter().all(|(about, _, _)| about != "lingering"),
        "{told:?}"
    );
    let about = |about: &str| {
        let found = told.iter().find(|(one, _, _)| one == about);
        found.unwrap_or_else(|| panic!("nothing about {about}: {told:?}"))
    };
    assert_eq!(about("reached").2, "`a` answers at `robot-a`");
    assert!(
        about("machine").2.starts_with(std::env::consts::ARCH),
        "{told:?}"
    );
    assert!(about("system").2.contains("Linux "), "{told:?}");
    assert_eq!(about("version").1, "warning");
    for one in [
        "rsync",
        "disk",
        "real-time",
        "memory",
        "governor",
        "port",
        "network",
    ] {
        assert!(
            ["ok", "warning"].contains(&about(one).1.as_str()),
            "{told:?}"
        );
    }

    // A user's own systemd ends with the connection.
    let manifest = field.read("robot/hulk.toml");
    let user = manifest.replace("/systemctl\"", "/systemctl --user\"");
    assert_ne!(user, manifest);
    field.write("robot/hulk.toml", &user);
    let told = checks("--host a");
    let found = told.iter().find(|(about, _, _)| about == "lingering");
    let (_, state, message) = found.unwrap_or_else(|| panic!("{told:?}"));
    let lingers = format!("/var/lib/systemd/linger/{}", field.user());
    let is_there = fs::exists(lingers).expect("it can be asked");
    assert_eq!(state, if is_there { "ok" } else { "warning" });
    assert!(
        message.contains(&format!("`{}`", field.user())),
        "{message}"
    );
    field.write("robot/hulk.toml", &manifest);

    // Another machine's triple, and a robot that is not there.
    let other = if cfg!(target_arch = "x86_64") {
        "aarch64"
    } else {
        "x86_64"
    };
    let triple = format!("name = \"lamp\"\ntriple = \"{other}-unknown-linux-gnu\"\nhardware");
    field.write(
        "robot/hulk.toml",
        &manifest.replace("name = \"lamp\"\nhardware", &triple),
    );
    assert!(
        checks("--host a")
            .iter()
            .any(|(about, state, _)| (about.as_str(), state.as_str()) == ("machine", "bad"))
    );
    let told = checks("--host nobody@127.0.0.9");
    assert_eq!(
        (told.len(), told[0].0.as_str(), told[0].1.as_str()),
        (1, "reached", "bad")
    );
}
