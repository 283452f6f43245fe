//! The zoo, the bridge, and a machine that knows Zenoh and CDR alone: each a process of its own, on one machine and behind a
//! network that loses and delays.

mod feeder;
mod ros;

use std::io::{BufRead as _, BufReader, Write as _};
use std::net::{SocketAddr, TcpListener, TcpStream};
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

fn skip(test: &str, what: &str) {
    let required = std::env::var_os("HULKGEN_REQUIRE_ALL").is_some_and(|value| value == "1");
    assert!(!required, "needs: {what}");
    println!("SKIPPED {test}: {what}");
}

/// Programs of the zoo and of the outpost.
struct Parts {
    zoo: PathBuf,
    outpost: PathBuf,
}

/// Or what is missing.
fn robots() -> Result<Parts, &'static str> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let given = std::env::var_os("HULKGEN_ROBOT").map(PathBuf::from);
    let zoo = given.unwrap_or_else(|| root.join("target/debug/loud"));
    let outpost = zoo.with_file_name("tower");
    if !zoo.is_file() || !outpost.is_file() {
        return Err(
            "`cargo build -p zoo_runtime -p outpost_runtime` in the repository, or HULKGEN_ROBOT",
        );
    }
    Ok(Parts { zoo, outpost })
}

/// As [`robots`], where python has what the clients import.
fn parts() -> Result<Parts, &'static str> {
    if !python_has("pycdr2, zenoh") {
        return Err("python3 -m pip install eclipse-zenoh pycdr2");
    }
    robots()
}

fn python_has(modules: &str) -> bool {
    let mut python = Command::new("python3");
    let python = python.args(["-c", &format!("import {modules}")]);
    let python = python.stderr(Stdio::null()).status();
    python.is_ok_and(|status| status.success())
}

fn free_address() -> SocketAddr {
    let listener = TcpListener::bind("127.0.0.1:0").expect("this machine has a free port");
    listener.local_addr().expect("it is bound")
}

/// Where processes run: this machine, or a network namespace of it.
struct Place(Option<String>);

impl Place {
    fn command(&self, program: &Path) -> Command {
        let Some(namespace) = &self.0 else {
            return Command::new(program);
        };
        let mut command = Command::new("ip");
        command.args(["netns", "exec", namespace]).arg(program);
        command
    }

    fn robot(&self, program: &Path, at: SocketAddr, folder: &Path) -> Running {
        let name = if program.ends_with("tower") {
            "outpost"
        } else {
            "zoo"
        };
        let robots = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/robots");
        let mut robot = self.command(program);
        let at = at.to_string();
        robot.args([
            "--headless",
            "--record",
            "off",
            "--listen",
            &at,
            "--run-folder",
        ]);
        robot.arg(folder).current_dir(robots.join(name));
        quiet(&mut robot)
    }

    fn bridge(&self, robot: SocketAddr, zenoh: SocketAddr) -> Running {
        let mut bridge = self.command(Path::new(env!("CARGO_BIN_EXE_hulkgen-zenoh")));
        let zenoh = format!("tcp/{zenoh}");
        quiet(bridge.args(["--host", &robot.to_string(), "--listen", &zenoh]))
    }

    fn client(&self, zenoh: SocketAddr, what: &str) -> Command {
        let mut client = self.script("client.py", zenoh);
        client.arg(what);
        client
    }

    fn script(&self, name: &str, zenoh: SocketAddr) -> Command {
        let script = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("tests")
            .join(name);
        let mut python = self.command(Path::new("python3"));
        // Without files of bytecode among the sources.
        python.arg("-B").arg(script).arg(format!("tcp/{zenoh}"));
        python
    }

    /// The machine that runs the outpost's lookouts, until it has seen everything in the book.
    fn look_out(&self, zenoh: SocketAddr) {
        let output = self.script("lookouts.py", zenoh).output();
        let output = output.expect("python3 was there a moment ago");
        let said = String::from_utf8_lossy(&output.stdout);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{said}{stderr}");
        assert!(said.contains("20 ships in order"), "{said}");
        println!("{said}");
    }
}

fn quiet(command: &mut Command) -> Running {
    let command = command.stdout(Stdio::null()).stderr(Stdio::null());
    Running(command.spawn().expect("the program can be started"))
}

/// All that the client is there for.
fn exchange(client: &mut Command) {
    let output = client.output().expect("python3 was there a moment ago");
    let said = String::from_utf8_lossy(&output.stdout);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}{stderr}");
    for part in [
        "speeds in order",
        "same in both forms",
        "come in",
        "answer and refuse",
    ] {
        assert!(said.contains(part), "{said}");
    }
    println!("{said}");
}

#[test]
fn three_processes_exchange_everything() {
    let program = match parts() {
        Ok(parts) => parts.zoo,
        Err(what) => return skip("three_processes_exchange_everything", what),
    };
    let folder = std::env::temp_dir().join(format!("hulkgen-zenoh-{}", std::process::id()));
    let (robot_at, zenoh_at) = (free_address(), free_address());
    let here = Place(None);
    // In the wrong order: the bridge waits for the robot.
    let _bridge = here.bridge(robot_at, zenoh_at);
    let _robot = here.robot(&program, robot_at, &folder);
    exchange(&mut here.client(zenoh_at, "exchanges"));
    let _ = std::fs::remove_dir_all(&folder);
}

#[test]
fn another_machine_feeds_a_robot_with_what_it_sees() {
    const TEST: &str = "another_machine_feeds_a_robot_with_what_it_sees";
    let program = match parts() {
        Ok(parts) => parts.outpost,
        Err(what) => return skip(TEST, what),
    };
    let folder = std::env::temp_dir().join(format!("hulkgen-outpost-{}", std::process::id()));
    let (robot_at, zenoh_at) = (free_address(), free_address());
    let here = Place(None);
    let _robot = here.robot(&program, robot_at, &folder);
    let _bridge = here.bridge(robot_at, zenoh_at);
    here.look_out(zenoh_at);
    let _ = std::fs::remove_dir_all(&folder);
}

#[test]
fn a_robot_and_a_bridge_that_went_away_are_found_again() {
    let program = match parts() {
        Ok(parts) => parts.zoo,
        Err(what) => return skip("a_robot_and_a_bridge_that_went_away_are_found_again", what),
    };
    let folder = std::env::temp_dir().join(format!("hulkgen-zenoh-again-{}", std::process::id()));
    let (robot_at, zenoh_at) = (free_address(), free_address());
    let here = Place(None);
    let mut bridge = here.bridge(robot_at, zenoh_at);
    let mut robot = here.robot(&program, robot_at, &folder);
    let mut client = here.client(zenoh_at, "misses");
    client.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut client = Running(client.spawn().expect("python3 was there a moment ago"));
    let mut stdin = client.0.stdin.take().expect("it is piped");
    let stdout = client.0.stdout.take().expect("it is piped");
    let mut lines = BufReader::new(stdout).lines();
    let mut next = || {
        let line = lines.next().expect("the client goes on");
        line.expect("the client writes text")
    };
    assert_eq!(next(), "hears");
    drop(robot);
    writeln!(stdin, "the robot is gone").expect("the client listens");
    let line = next();
    assert!(
        line.starts_with("misses: ") && line.contains("robot"),
        "{line}"
    );
    wait_until_free(robot_at);
    robot = here.robot(&program, robot_at, &folder);
    assert_eq!(next(), "hears");
    drop(bridge);
    writeln!(stdin, "the bridge is gone").expect("the client listens");
    assert!(next().starts_with("misses: "));
    bridge = here.bridge(robot_at, zenoh_at);
    assert_eq!(next(), "hears again");
    let status = client.0.wait().expect("it was started");
    assert!(status.success());
    drop((robot, bridge));
    let _ = std::fs::remove_dir_all(&folder);
}

/// As soon as nobody listens there any more.
fn wait_until_free(address: SocketAddr) {
    let begin = Instant::now();
    while TcpStream::connect(address).is_ok() {
        assert!(begin.elapsed() < PATIENCE, "{address} is not free");
        thread::sleep(Duration::from_millis(50));
    }
}

/// Longer payloads of the client queue in it and get lost.
const NARROW: &str = "tbf rate 2mbit burst 2kb latency 30ms";

/// Two namespaces with a cable between them, gone with this.
struct Network {
    near: String,
    far: String,
}

impl Network {
    /// `None`: nobody permits it.
    fn new(test: &str) -> Option<Self> {
        let id = format!("{test}-{}", std::process::id());
        let network = Self {
            near: format!("hulkgen-near-{id}"),
            far: format!("hulkgen-far-{id}"),
        };
        let (near, far) = (network.near.as_str(), network.far.as_str());
        let lines = [
            format!("ip netns add {near}"),
            format!("ip netns add {far}"),
            format!("ip -n {near} link add cable type veth peer name cable netns {far}"),
            format!("ip -n {near} address add 10.0.0.1/24 dev cable"),
            format!("ip -n {far} address add 10.0.0.2/24 dev cable"),
            format!("ip -n {near} link set lo up"),
            format!("ip -n {near} link set cable up"),
            format!("ip -n {far} link set cable up"),
        ];
        if !lines.iter().all(|line| run(line)) {
            return None;
        }
        // A kernel without netem has a narrow cable: what waits too long for its turn is lost.
        let disturbed = ["netem delay 20ms 5ms loss 5%", NARROW];
        let disturbed = disturbed.iter().any(|how| {
            let mut ends = [near, far].into_iter();
            ends.all(|end| run(&format!("tc -n {end} qdisc replace dev cable root {how}")))
        });
        disturbed.then_some(network)
    }

    /// What the cable did at the client's end, in tc's words.
    fn told(&self) -> String {
        let mut tc = Command::new("tc");
        tc.args(["-n", &self.far, "-s", "qdisc", "show", "dev", "cable"]);
        let output = tc.output().expect("tc was there a moment ago");
        String::from_utf8_lossy(&output.stdout).into_owned()
    }
}

impl Drop for Network {
    fn drop(&mut self) {
        for namespace in [&self.near, &self.far] {
            run(&format!("ip netns delete {namespace}"));
        }
    }
}

fn run(line: &str) -> bool {
    let mut words = line.split(' ');
    let mut command = Command::new(words.next().unwrap_or_default());
    let command = command.args(words).stdout(Stdio::null());
    let status = command.stderr(Stdio::null()).status();
    status.is_ok_and(|status| status.success())
}

/// Robot and bridge behind the cable, with the other machine at its far end; `what` is done there, and something has to get
/// lost meanwhile. `None`: all is there and permitted; else what is missing.
fn at_both_ends(
    test: &str,
    program: impl Fn(Parts) -> PathBuf,
    what: impl Fn(&Place, SocketAddr),
) -> Option<&'static str> {
    let program = match parts() {
        Ok(parts) => program(parts),
        Err(what) => return Some(what),
    };
    if !run("ip -V") || !run("tc -V") {
        return Some("`ip` and `tc` (iproute2)");
    }
    let Some(network) = Network::new(test) else {
        return Some("permission for network namespaces, for example as root");
    };
    let folder = std::env::temp_dir().join(format!("hulkgen-{test}-{}", std::process::id()));
    let robot_at = SocketAddr::from(([127, 0, 0, 1], 4857));
    let zenoh_at = SocketAddr::from(([10, 0, 0, 1], 7447));
    let near = Place(Some(network.near.clone()));
    let far = Place(Some(network.far.clone()));
    let robot = near.robot(&program, robot_at, &folder);
    let bridge = near.bridge(robot_at, zenoh_at);
    what(&far, zenoh_at);
    let told = network.told();
    assert!(
        !told.contains("dropped 0,"),
        "the cable lost nothing: {told}"
    );
    println!("{told}");
    drop((robot, bridge));
    let _ = std::fs::remove_dir_all(&folder);
    None
}

#[test]
fn a_network_that_loses_and_delays_carries_everything() {
    let missing = at_both_ends(
        "exchange",
        |parts| parts.zoo,
        |far, zenoh_at| {
            exchange(&mut far.client(zenoh_at, "exchanges"));
        },
    );
    if let Some(what) = missing {
        skip("a_network_that_loses_and_delays_carries_everything", what);
    }
}

#[test]
fn ships_are_in_order_behind_a_network_that_loses_and_delays() {
    let missing = at_both_ends(
        "lookouts",
        |parts| parts.outpost,
        |far, zenoh_at| {
            far.look_out(zenoh_at);
            feeder::example(far, zenoh_at);
        },
    );
    if let Some(what) = missing {
        skip(
            "ships_are_in_order_behind_a_network_that_loses_and_delays",
            what,
        );
    }
}
