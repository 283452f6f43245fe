//! The rover and its controller over a real socket: with a simulated room behind it, and when what it says makes no sense.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

use framework::parameters::Layers;
use framework::testing::created;
use framework::{Clock, Hardware as _, HardwareContext, Robot, Stop, Threads};
use rover_base::{Counts, Hardware};
use rover_nodes::interfaces::{Encoders as _, Lidar as _, Motors as _};
use rover_nodes::types::{Scan, Speeds};
use rover_runtime::{parameters::Parameters, runtime};

/// A busy machine may take so long for anything.
const PATIENCE: Duration = Duration::from_secs(60);

/// Without a command for so long a controller brakes.
const BRAKES_AFTER: Duration = Duration::from_millis(200);

fn context(table: toml::Table) -> HardwareContext {
    HardwareContext {
        options: Vec::new(),
        table,
        run_folder: std::env::temp_dir(),
        clock: Clock::wall(),
        stop: Stop::new(),
    }
}

/// A place for a controller, and the rover that looks for it there.
fn rover() -> (TcpListener, Hardware, Stop) {
    let listener = TcpListener::bind("127.0.0.1:0").expect("there is a free port");
    let address = listener.local_addr().expect("it is bound");
    let mut table = toml::Table::new();
    table.insert("address".to_owned(), address.to_string().into());
    let context = context(table);
    let stop = context.stop.clone();
    let hardware = Hardware::new(context).expect("nobody has to answer");
    (listener, hardware, stop)
}

fn accept(listener: &TcpListener) -> TcpStream {
    let (stream, _) = listener.accept().expect("the rover comes");
    stream
        .set_read_timeout(Some(PATIENCE))
        .expect("it is a time");
    stream
}

fn eventually(what: &str, mut condition: impl FnMut() -> bool) {
    let begin = Instant::now();
    while !condition() {
        assert!(begin.elapsed() < PATIENCE, "no {what}");
        thread::sleep(Duration::from_millis(10));
    }
}

/// Lines as they come.
fn lines(stream: &TcpStream) -> Receiver<String> {
    let (sender, receiver) = channel();
    let stream = stream.try_clone().expect("the system has handles");
    thread::spawn(move || {
        let lines = BufReader::new(stream).lines();
        for line in lines.map_while(Result::ok) {
            if sender.send(line).is_err() {
                break;
            }
        }
    });
    receiver
}

fn speeds(line: &str) -> Speeds {
    let words: Vec<&str> = line.split(' ').collect();
    match words.as_slice() {
        ["drive", forward, turn] => Speeds {
            forward: forward.parse().expect("a number"),
            turn: turn.parse().expect("a number"),
        },
        ["stop"] => Speeds::default(),
        _ => panic!("{line:?} is no command"),
    }
}

/// A controller whose rover stands in a room: every 20 ms it says what the senses say, and does what it is told.
fn control(
    mut stream: TcpStream,
    room: &rover_simulation::Hardware,
    mut is_over: impl FnMut() -> bool,
) {
    let commands = lines(&stream);
    let mut commanded = Instant::now();
    for turn in 0_u64.. {
        let (_, rolled) = room.read_wheels().expect("nothing stops the room");
        let mut said = format!("wheels {} {}\n", rolled.left, rolled.right);
        if turn % 5 == 4 {
            let mut scan = Scan::default();
            room.read_scan(&mut scan).expect("nothing stops the room");
            let ranges = scan.ranges.iter().map(|range| format!(" {range}"));
            said.push_str(&format!("scan{}\n", ranges.collect::<String>()));
        }
        if is_over() || stream.write_all(said.as_bytes()).is_err() {
            break;
        }
        for line in commands.try_iter() {
            commanded = Instant::now();
            room.write_speeds(speeds(&line)).expect("they are numbers");
        }
        if commanded.elapsed() > BRAKES_AFTER {
            room.write_speeds(Speeds::default())
                .expect("they are numbers");
        }
    }
}

/// A post stands 1.4 m ahead of it, in the middle of its way; no body goes through it.
#[test]
fn it_drives_around_what_stands_in_its_way() {
    let listener = TcpListener::bind("127.0.0.1:0").expect("there is a free port");
    let address = listener.local_addr().expect("it is bound");
    let layers = Layers {
        directory: Path::new(env!("CARGO_MANIFEST_DIR")).join("../parameters"),
        settings: vec![("hardware.base.address".to_owned(), format!("\"{address}\""))],
        ..Layers::default()
    };
    let room = layers
        .load()
        .expect("the parameters are complete")
        .hardware("room");
    let room = context(room.expect("it is a table"));
    let room = rover_simulation::Hardware::new(room).expect("it is a room");
    let place = || {
        let truth = room.truth();
        [0, 1].map(|axis| truth["place"][axis].as_f64().expect("it is a number"))
    };

    let (clock, stop) = (Clock::wall(), Stop::new());
    let (hardware, mut robot): (Arc<Hardware>, Robot<Parameters>) =
        created(&layers, "base", &[], &clock, &stop, runtime::create);
    let mut farthest_aside = 0.0_f64;
    thread::scope(|scope| {
        scope.spawn(|| {
            let begin = Instant::now();
            let mut is_over = || {
                let [x, y] = place();
                farthest_aside = farthest_aside.max(y.abs());
                x > 2.0 || begin.elapsed() > PATIENCE
            };
            // A machine that is too busy to be a controller for a second is asked again.
            while !is_over() {
                control(accept(&listener), &room, &mut is_over);
            }
            stop.request();
        });
        Threads::new(&clock, &*hardware, &stop)
            .run(&mut robot.instances)
            .expect("nothing ends it before");
    });
    let truth = room.truth();
    assert!(place()[0] > 2.0, "{truth}");
    assert!(
        farthest_aside > 0.2,
        "{farthest_aside} m beside the straight way"
    );
    let counts = hardware.counts();
    assert!(counts.refused == 0 && counts.lines > 50, "{counts:?}");
}

#[test]
fn what_makes_no_sense_is_counted_and_the_rover_asks_again() {
    let (listener, hardware, _stop) = rover();
    let hang_up = |stream: &mut TcpStream| {
        let mut rest = Vec::new();
        // What was not read when it hung up makes it a reset.
        let _ = stream.read_to_end(&mut rest);
        assert_eq!(rest, b"");
    };
    // Another program.
    let mut stream = accept(&listener);
    let nonsense = "HTTP/1.1 400 Bad Request\n".repeat(10);
    stream.write_all(nonsense.as_bytes()).expect("it listens");
    hang_up(&mut stream);
    // A line without an end.
    let mut stream = accept(&listener);
    stream.write_all(&[b'1'; 8192]).expect("it listens");
    hang_up(&mut stream);
    // Half a line, and nothing more.
    let mut stream = accept(&listener);
    stream.write_all(b"wheels 0.1").expect("it listens");
    hang_up(&mut stream);
    // Gone at once.
    drop(accept(&listener));
    // At last what it is there for, in pieces, with something between that is none.
    let mut stream = accept(&listener);
    for piece in [
        "whe",
        "els 0.25",
        " 0.125\nwheels nan 1\nwheels ",
        "0.25 0.125\n",
    ] {
        stream.write_all(piece.as_bytes()).expect("it listens");
        thread::sleep(Duration::from_millis(20));
    }
    let expected = Counts {
        connections: 5,
        lines: 2,
        refused: 12,
        lost: 0,
    };
    eventually("two lines", || hardware.counts() == expected);
    // Nothing that rolled is lost.
    let (_, rolled) = hardware.read_wheels().expect("it is there");
    assert_eq!((rolled.left, rolled.right), (0.5, 0.25));
    stream.write_all(b"scan 1 2 inf 4\n").expect("it listens");
    let mut scan = Scan::default();
    hardware.read_scan(&mut scan).expect("it comes");
    assert_eq!(scan.ranges, [1.0, 2.0, f32::INFINITY, 4.0]);
}

#[test]
fn in_safe_state_nobody_commands_it() {
    let (listener, hardware, _stop) = rover();
    let drive = |forward| {
        let turn = 0.5;
        hardware.write_speeds(Speeds { forward, turn })
    };
    let stream = accept(&listener);
    let commands = lines(&stream);
    eventually("connection", || hardware.counts().connections == 1);
    let next = || commands.recv_timeout(PATIENCE).expect("a command");
    drive(0.2).expect("it is a speed");
    assert_eq!(next(), "drive 0.2 0.5");
    hardware.enter_safe_state();
    assert_eq!(next(), "stop");
    drive(0.3).expect("it is dropped");
    hardware.rearm();
    drive(0.4).expect("it is a speed");
    assert_eq!(next(), "drive 0.4 0.5");
    assert!(drive(f32::NAN).is_err());
    let end = stream.shutdown(std::net::Shutdown::Both);
    end.expect("it is open");
    eventually("command that is lost", || {
        drive(0.5).expect("nobody has to listen");
        hardware.counts().lost > 0
    });
}

#[test]
fn who_waits_hears_why_nothing_comes_and_a_stop() {
    let (listener, hardware, stop) = rover();
    drop(accept(&listener));
    drop(listener);
    eventually("words about it", || {
        let error = hardware.read_wheels().expect_err("nothing came");
        assert!(error.is_no_event(), "{error}");
        error.to_string().contains("does not answer")
    });
    thread::scope(|scope| {
        let waits = scope.spawn(|| hardware.read_scan(&mut Scan::default()));
        stop.request();
        let error = waits.join().expect("it does not panic");
        assert!(error.expect_err("nothing came").is_stopped());
    });
}
