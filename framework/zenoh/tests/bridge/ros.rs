//! A machine that knows ROS 2's messages and what rmw_zenoh says, beside the zoo.

use std::fs::{self, File};

use super::*;

#[test]
fn ros_2_sees_hears_and_calls_the_robot() {
    const TEST: &str = "ros_2_sees_hears_and_calls_the_robot";
    if !python_has("rosbags.typesys, xxhash, zenoh") {
        return skip(TEST, "python3 -m pip install eclipse-zenoh rosbags xxhash");
    }
    let program = match robots() {
        Ok(parts) => parts.zoo,
        Err(what) => return skip(TEST, what),
    };
    let folder = std::env::temp_dir().join(format!("hulkgen-ros-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("there is room");
    let (robot_at, zenoh_at) = (free_address(), free_address());
    let here = Place(None);
    let robot = here.robot(&program, robot_at, &folder.join("run"));
    wait_until_reached(robot_at);
    let packages = folder.join("packages");
    let keys = write_messages(robot_at, &packages);
    for topic in ["0/pose/", "0/walking_speed/", "0/walk/", "0/stop/"] {
        assert!(keys.contains(&format!("key = \"{topic}")), "{keys}");
    }
    let log = folder.join("log");
    let mut bridge = Command::new(env!("CARGO_BIN_EXE_hulkgen-zenoh"));
    let (host, zenoh) = (robot_at.to_string(), format!("tcp/{zenoh_at}"));
    bridge.args(["--host", &host, "--listen", &zenoh]);
    let stderr = File::create(&log).expect("there is room");
    bridge.stdout(Stdio::null()).stderr(stderr);
    let bridge = Running(bridge.spawn().expect("the program can be started"));
    let mut client = here.script("ros.py", zenoh_at);
    client.arg(&packages);
    client.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut client = Running(client.spawn().expect("python3 was there a moment ago"));
    let stdout = client.0.stdout.take().expect("it is piped");
    let mut said = Vec::new();
    for line in BufReader::new(stdout).lines() {
        let line = line.expect("the client writes text");
        println!("{line}");
        let is_over = line == "waits";
        said.push(line);
        if is_over {
            break;
        }
    }
    assert_eq!(said.last().map(String::as_str), Some("waits"), "{said:?}");
    drop(bridge);
    let status = client.0.wait().expect("it was started");
    assert!(status.success(), "what the bridge announced is still there");
    let log = fs::read_to_string(&log).expect("the bridge wrote it");
    let warned: Vec<_> = log.lines().filter(|line| line.contains("hash")).collect();
    let [warned] = warned.as_slice() else {
        panic!("one hash is wrong: {log}");
    };
    let stop = keys.lines().find(|line| line.contains("0/stop/"));
    let stop = stop.and_then(|line| line.split('"').nth(1));
    assert!(warned.contains("`Control.procedures.stop`"), "{warned}");
    assert!(warned.contains(stop.expect("it is mapped")), "{warned}");
    drop(robot);
    let _ = fs::remove_dir_all(&folder);
}

/// Gives what is printed.
fn write_messages(robot: SocketAddr, folder: &Path) -> String {
    let mut program = Command::new(env!("CARGO_BIN_EXE_hulkgen-zenoh"));
    let program = program.args(["--host", &robot.to_string(), "--messages"]);
    let output = program.arg(folder).output().expect("it can be started");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{stderr}");
    assert!(stderr.contains("zoo_interfaces"), "{stderr}");
    assert!(!folder.join("std_msgs").exists(), "it comes with ROS 2");
    String::from_utf8(output.stdout).expect("it is text")
}

fn wait_until_reached(address: SocketAddr) {
    let begin = Instant::now();
    while TcpStream::connect(address).is_err() {
        assert!(begin.elapsed() < PATIENCE, "nobody is at {address}");
        thread::sleep(Duration::from_millis(50));
    }
}
