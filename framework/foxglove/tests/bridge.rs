//! The simulated robot of this repository, the bridge, and a client of Foxglove's protocol that knows neither.

use std::io::{BufRead as _, BufReader, Write as _};
use std::net::{SocketAddr, TcpListener};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// A busy machine may take so long for anything.
const PATIENCE: Duration = Duration::from_secs(60);

/// Ends with the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn skip(what: &str) {
    let required = std::env::var_os("HULKGEN_REQUIRE_ALL").is_some_and(|value| value == "1");
    assert!(!required, "needs: {what}");
    println!("SKIPPED the_bridge_shows_the_robot: {what}");
}

fn free_address() -> SocketAddr {
    let listener = TcpListener::bind("127.0.0.1:0").expect("this machine has a free port");
    listener.local_addr().expect("it is bound")
}

/// As soon as somebody listens there.
fn wait_for(address: SocketAddr) {
    let begin = Instant::now();
    while std::net::TcpStream::connect(address).is_err() {
        assert!(begin.elapsed() < PATIENCE, "nobody listens at {address}");
        thread::sleep(Duration::from_millis(100));
    }
}

#[test]
fn the_bridge_shows_the_robot() {
    let given = std::env::var_os("HULKGEN_ROBOT").map(PathBuf::from);
    let program = given.unwrap_or_else(|| root().join("target/debug/simulated"));
    if !program.is_file() {
        return skip("`cargo build -p nao_runtime` in the repository, or HULKGEN_ROBOT");
    }
    let imports = ["-c", "import jsonschema, websockets.sync.client"];
    let mut python = Command::new("python3");
    let python = python.args(imports).stderr(Stdio::null()).status();
    if !python.is_ok_and(|status| status.success()) {
        return skip("python3 -m pip install websockets jsonschema");
    }
    let folder = std::env::temp_dir().join(format!("hulkgen-foxglove-{}", std::process::id()));
    let (robot_at, bridge_at) = (free_address(), free_address());
    let start = || {
        let mut robot = Command::new(&program);
        robot.args(["--headless", "--listen", &robot_at.to_string()]);
        robot.arg("--run-folder").arg(&folder);
        robot.args(["--", "--free-ports"]).current_dir(root());
        robot.stdout(Stdio::null()).stderr(Stdio::null());
        let robot = Running(robot.spawn().expect("the robot can be started"));
        wait_for(robot_at);
        robot
    };
    let robot = start();
    let mut bridge = Command::new(env!("CARGO_BIN_EXE_hulkgen-foxglove"));
    bridge.args(["--host", &robot_at.to_string()]);
    bridge.args(["--listen", &bridge_at.to_string()]);
    let _bridge = Running(bridge.spawn().expect("the bridge can be started"));
    wait_for(bridge_at);
    let client = || {
        let mut client = Command::new("python3");
        client.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/client.py"));
        client.arg(format!("ws://{bridge_at}"));
        client
    };
    let look = || {
        let looked = client().output().expect("python3 was there a moment ago");
        let said = String::from_utf8_lossy(&looked.stdout);
        let stderr = String::from_utf8_lossy(&looked.stderr);
        assert!(looked.status.success(), "{said}{stderr}");
        assert!(said.contains("channels"), "{said}");
        println!("{said}");
    };
    look();

    // A robot that is started anew is shown again, also to those who look meanwhile.
    let mut staying = client();
    staying.arg("stay").stdin(Stdio::piped());
    let staying = staying.stdout(Stdio::piped()).spawn();
    let mut staying = Running(staying.expect("python3 was there a moment ago"));
    let said = staying.0.stdout.take().expect("it is piped");
    let mut lines = BufReader::new(said).lines().map_while(Result::ok);
    assert_eq!(lines.next().as_deref(), Some("watching"));
    drop(robot);
    let _robot = start();
    let mut told = staying.0.stdin.take().expect("it is piped");
    writeln!(told, "the robot is back").expect("it reads");
    assert_eq!(lines.next().as_deref(), Some("watched on"));
    look();
    let _ = std::fs::remove_dir_all(&folder);
}
