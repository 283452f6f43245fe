//! What comes when with a stepped clock.

use std::time::Instant;

use framework::Stop;
use links::sockets::LONGEST_FLIGHT;
use nalgebra::{Isometry2, Vector2};
use spl_messages::{control_data, team_message};
use types::game::GameState;
use types::network::Datagram;

use super::*;
use crate::scene::{RobotSettings, Team};
use crate::settings::{NetworkSettings, PhysicsChoice, Settings};
use crate::simulator::Shared;

struct Lockstep {
    shared: Shared,
    sockets: Arc<RobotSockets>,
}

impl Lockstep {
    fn new(options: &[&str]) -> Self {
        Self::with(&settings(options))
    }

    fn with(settings: &Settings) -> Self {
        let sockets = Arc::new(RobotSockets::new(&settings.network.ports()).unwrap());
        let shared = Shared::new(settings, Some(Arc::clone(&sockets)), true).unwrap();
        Self { shared, sockets }
    }

    /// When the next datagram arrives.
    fn next(&self) -> Timestamp {
        loop {
            let event = self.shared.lock().step().unwrap();
            if let Some(event) = event.filter(|event| event.instance == "SplNetwork") {
                return event.at;
            }
        }
    }

    fn read(&self, now: Timestamp) -> Option<(Timestamp, bool, Datagram)> {
        let (arrival, is_behind) = self.shared.lock().network.take_arrival(now)?;
        let mut datagram = Datagram::default();
        let is_there = self.sockets.receive_arrival(
            arrival.channel,
            arrival.sender,
            &mut datagram,
            &Stop::new(),
        );
        assert!(is_there.unwrap());
        datagram.sender = arrival.endpoint;
        Some((arrival.at, is_behind, datagram))
    }
}

/// With a team mate on the field.
fn settings(options: &[&str]) -> Settings {
    let options: Vec<_> = options.iter().map(|&option| option.to_owned()).collect();
    let mut settings = Settings {
        // Nobody looks at the bodies.
        physics: PhysicsChoice::Kinematic,
        ..Settings::default()
    };
    settings.apply(&options).unwrap();
    settings.robots = vec![robot(Team::Own, 2, 3.0)];
    settings
}

fn robot(team: Team, number: u8, x: f64) -> RobotSettings {
    RobotSettings {
        position: [x, -1.0],
        heading: 0.5,
        team,
        number,
    }
}

/// Everything that comes in 30 s.
fn datagrams(options: &[&str]) -> Vec<(Timestamp, Datagram)> {
    all_datagrams(&Lockstep::new(options))
}

fn all_datagrams(lockstep: &Lockstep) -> Vec<(Timestamp, Datagram)> {
    let mut datagrams = Vec::new();
    loop {
        let now = lockstep.next();
        if now > Timestamp::ZERO + Duration::from_secs(30) {
            return datagrams;
        }
        let (at, is_behind, datagram) = lockstep.read(now).unwrap();
        assert_eq!((at, is_behind), (now, false));
        assert!(lockstep.read(now).is_none());
        datagrams.push((at, datagram));
    }
}

#[test]
fn datagrams_come_in_order_and_at_their_times() {
    let datagrams = datagrams(&["--no-cameras"]);
    let millis = |channel| {
        let of_channel = datagrams
            .iter()
            .filter(move |(_, datagram)| datagram.channel == channel);
        of_channel.map(|(at, _)| at.as_nanos() / 1_000_000)
    };
    let referee: Vec<_> = (0..60).map(|number| 100 + 500 * number).collect();
    assert_eq!(millis(Channel::GameController).collect::<Vec<_>>(), referee);
    let mate: Vec<_> = (0..30).map(|number| 650 + 1000 * number).collect();
    assert_eq!(millis(Channel::Team).collect::<Vec<_>>(), mate);
    assert!(datagrams.is_sorted_by_key(|(at, _)| *at));

    let mut states = Vec::new();
    let mut packets = 0;
    for (at, datagram) in &datagrams {
        if datagram.channel == Channel::Team {
            team_message::decode(&datagram.bytes).unwrap();
            continue;
        }
        let message = control_data::decode(&datagram.bytes).unwrap();
        assert_eq!(message.packet_number, packets);
        packets += 1;
        if states
            .last()
            .is_none_or(|(_, state)| *state != message.game_state)
        {
            states.push((at.as_nanos() / 1_000_000, message.game_state));
        }
    }
    let expected = [
        (100, GameState::Initial),
        (3100, GameState::Ready),
        (8100, GameState::Set),
        (27_100, GameState::Playing),
    ];
    assert_eq!(states, expected);
}

#[test]
fn every_message_to_the_own_team_is_gone_from_its_budget() {
    let lockstep = Lockstep::new(&["--no-cameras"]);
    let (mut heard, mut compared) = (0, 0);
    while compared < 40 {
        let now = lockstep.next();
        let (_, _, datagram) = lockstep.read(now).unwrap();
        if datagram.channel == Channel::Team {
            heard += 1;
            // It hears itself; of the mate it says every third time something, too.
            if heard % 3 == 1 {
                lockstep.shared.lock().broadcast(now, b"own");
            }
            continue;
        }
        let message = control_data::decode(&datagram.bytes).unwrap();
        let budgets = message.teams.map(|team| team.message_budget);
        assert_eq!(budgets, [1200 - heard, 1200], "at {now:?}");
        compared += 1;
    }
    assert!(heard > 25, "{heard}");
}

#[test]
fn the_same_options_give_the_same_datagrams_whatever_ports_are_free() {
    let once = datagrams(&["--no-cameras"]);
    assert_eq!(once, datagrams(&["--no-cameras"]));
    assert_ne!(once, datagrams(&["--no-cameras", "--game", "Set"]));
    assert_ne!(once, datagrams(&["--no-cameras", "--ball", "1,1"]));
}

#[test]
fn a_robot_that_listens_everywhere_hears_the_same() {
    let mut settings = settings(&["--no-cameras"]);
    settings.network.address = Ipv4Addr::UNSPECIFIED;
    let lockstep = Lockstep::with(&settings);
    assert_eq!(all_datagrams(&lockstep), datagrams(&["--no-cameras"]));
    // Its own broadcast comes back.
    let now = lockstep.shared.stage.lock().world.now();
    let mut simulation = lockstep.shared.lock();
    simulation.network.robot_has_broadcast(now, b"own");
    drop(simulation);
    let heard = std::iter::from_fn(|| {
        let now = lockstep.next();
        lockstep.read(now).map(|(_, _, datagram)| datagram.bytes)
    });
    assert!(heard.take(3).any(|bytes| bytes == b"own"));
}

#[test]
fn an_address_that_the_machine_does_not_have_is_named() {
    let settings = NetworkSettings {
        address: Ipv4Addr::new(192, 0, 2, 1),
        ..NetworkSettings::default()
    };
    let error = RobotSockets::new(&settings.ports())
        .unwrap_err()
        .to_string();
    assert!(error.contains("address 192.0.2.1"), "{error}");
}

#[test]
fn the_mate_is_the_own_robot_of_its_number_and_lost_without_one() {
    let said = |settings: &Settings| {
        let datagrams = all_datagrams(&Lockstep::with(settings));
        let mut team = datagrams
            .iter()
            .filter(|(_, datagram)| datagram.channel == Channel::Team);
        team_message::decode(&team.next().unwrap().1.bytes).unwrap()
    };
    let mut settings = settings(&["--no-cameras"]);
    settings.robots.clear();
    let lost = said(&settings);
    assert_eq!((lost.ground_to_field, lost.ball), (None, None));
    settings.robots = vec![
        robot(Team::Opponent, 2, 1.0),
        robot(Team::Own, 4, 2.0),
        robot(Team::Own, 2, 3.0),
    ];
    let message = said(&settings);
    let pose = message.ground_to_field.unwrap();
    let expected = Isometry2::new(Vector2::new(3.0, -1.0), 0.5);
    assert!((pose.translation.vector - expected.translation.vector).norm() < 1e-6);
    assert!(pose.rotation.angle_to(&expected.rotation).abs() < 1e-6);
    let [x, y] = settings.ball_position().unwrap().map(|place| place as f32);
    let ball = pose * message.ball.unwrap().position;
    assert!((ball - nalgebra::Point2::new(x, y)).norm() < 1e-5, "{ball}");
}

#[test]
fn who_has_missed_events_reads_the_oldest_first_and_knows_that_there_is_more() {
    let lockstep = Lockstep::new(&["--no-cameras", "--no-mate"]);
    let times: Vec<_> = (0..4).map(|_| lockstep.next()).collect();
    let read: Vec<_> = std::iter::from_fn(|| lockstep.read(times[3]))
        .map(|(at, is_behind, _)| (at, is_behind))
        .collect();
    // The last one has an event at that time.
    let expected = [true, true, false, false];
    assert_eq!(read, times.into_iter().zip(expected).collect::<Vec<_>>());
}

#[test]
fn what_nobody_reads_is_lost_in_the_end_and_no_more_an_event() {
    let lockstep = Lockstep::new(&["--no-cameras", "--no-sound", "--no-referee", "--no-mate"]);
    for number in 0..200_u8 {
        let mut simulation = lockstep.shared.lock();
        let network = &mut simulation.network;
        network
            .stranger_speaks(Timestamp::ZERO, Channel::Team, &[number])
            .unwrap();
    }
    let mut simulation = lockstep.shared.lock();
    let mut events = 0;
    loop {
        match simulation.step().unwrap() {
            Some(event) if event.instance == "SplNetwork" => events += 1,
            Some(_) => break,
            None => {}
        }
    }
    drop(simulation);
    assert_eq!(events, MOST_UNREAD);
    let read: Vec<_> = std::iter::from_fn(|| lockstep.read(Timestamp::ZERO))
        .map(|(_, _, datagram)| datagram.bytes[0])
        .collect();
    assert_eq!(read, (0..MOST_UNREAD as u8).collect::<Vec<_>>());
}

#[test]
fn foreign_programs_do_not_disturb_lockstep() {
    let lockstep = Lockstep::new(&["--no-cameras"]);
    let foreign = UdpSocket::bind(loopback(0)).unwrap();
    let port = lockstep.sockets.control_address().unwrap();
    for _ in 0..3 {
        foreign.send_to(b"hello", port).unwrap();
    }
    let (_, _, datagram) = lockstep.read(lockstep.next()).unwrap();
    assert_eq!(datagram.sender.port, 3939);
    assert!(control_data::decode(&datagram.bytes).is_ok());
}

#[test]
fn a_foreign_flood_does_not_keep_a_reader_waiting_for_what_is_lost() {
    let lockstep = Lockstep::new(&["--no-cameras", "--no-sound"]);
    let now = lockstep.next();
    let (arrival, _) = lockstep.shared.lock().network.take_arrival(now).unwrap();
    let mut datagram = Datagram::default();
    assert!(
        lockstep
            .sockets
            .receive(&mut datagram, LONGEST_FLIGHT)
            .unwrap()
    );
    let port = lockstep.sockets.control_address().unwrap();
    let end_of_flood = Stop::new();
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let foreign = UdpSocket::bind(loopback(0)).unwrap();
            while end_of_flood.check().is_ok() {
                foreign.send_to(b"flood", port).unwrap();
            }
        });
        let begun = Instant::now();
        let sockets = &lockstep.sockets;
        let (channel, sender) = (arrival.channel, arrival.sender);
        let is_there = sockets.receive_arrival(channel, sender, &mut datagram, &Stop::new());
        end_of_flood.request();
        assert!(!is_there.unwrap());
        assert!(begun.elapsed() < 10 * LONGEST_FLIGHT);
    });
}

#[test]
fn our_referee_is_silent_while_another_one_speaks_and_a_while_longer() {
    let lockstep = Lockstep::new(&["--no-mate"]);
    let stranger = Endpoint {
        address: [192, 168, 1, 2],
        port: 4000,
    };
    let speaks = |millis: u64| {
        let now = Timestamp::ZERO + Duration::from_millis(millis);
        let network = &mut lockstep.shared.lock().network;
        network.referee_speaks(now, None, [0; 2]).unwrap()
    };
    let overheard = |millis: u64, sender: &Endpoint, bytes: &[u8]| {
        let now = Timestamp::ZERO + Duration::from_millis(millis);
        lockstep.shared.lock().network.overheard(now, sender, bytes);
    };
    let data = control_data::encode(&GameControllerMessage::default());
    assert!(speaks(500));
    // What is no control data silences nobody, and neither does our own.
    overheard(600, &stranger, b"nonsense");
    assert!(speaks(1000));
    let own = lockstep
        .shared
        .lock()
        .network
        .referee
        .as_ref()
        .unwrap()
        .address()
        .unwrap()
        .port();
    overheard(
        1100,
        &Endpoint {
            address: [127, 0, 0, 1],
            port: own,
        },
        &data,
    );
    assert!(speaks(1500));
    for millis in [1600, 2600] {
        overheard(millis, &stranger, &data);
    }
    for millis in [2000, 3000, 5500] {
        assert!(!speaks(millis), "at {millis} ms");
    }
    assert!(speaks(5700));
}
