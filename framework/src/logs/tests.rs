//! Who hears what: levels, rates, robots, what has no room.

use super::*;

fn rules(others: &[(&str, Option<&str>, Level)]) -> Arc<Sink> {
    let sink = Sink::new(Clock::stepped());
    for (instance, module, level) in others {
        sink.set_level(Some((instance, *module)), *level);
    }
    sink
}

#[test]
fn the_rule_that_says_most_holds() {
    let sink = rules(&[
        ("Control", None, Level::WARN),
        ("Control", Some("walk::step"), Level::TRACE),
    ]);
    for (level, module, instance, expected) in [
        (Level::INFO, "walk", "Control", false),
        (Level::WARN, "walk", "Control", true),
        (Level::TRACE, "walk::step", "Control", true),
        (Level::TRACE, "walk::step::foot", "Control", true),
        (Level::TRACE, "walk::steps", "Control", false),
        (Level::INFO, "walk", "Vision", true),
        (Level::DEBUG, "walk::step", "Vision", false),
    ] {
        let wanted = sink.wants(level, module, Some(instance));
        assert_eq!(wanted, expected, "{level} {module} {instance}");
    }
    assert!(!sink.wants(Level::DEBUG, "anything", None));
    sink.set_level(None, Level::DEBUG);
    assert!(sink.wants(Level::DEBUG, "walk", Some("Control")));
}

#[test]
fn a_module_says_so_many_messages_in_a_second() {
    let mut rates = Rates::default();
    let record = |module: &'static str, milliseconds: u64| Record {
        // Of a recording, in which no time passes between them.
        time: Timestamp::ZERO,
        heard: Timestamp::from_nanos(milliseconds * 1_000_000),
        level: Level::INFO,
        module: module.into(),
        instance: None,
        cycle: None,
        message: String::new(),
        fields: Map::new(),
    };
    let mut is_allowed = |module, milliseconds| rates.is_allowed(&record(module, milliseconds), 2);
    assert!(is_allowed("walk", 0) && is_allowed("walk", 998));
    assert!(!is_allowed("walk", 999));
    assert!(is_allowed("see", 999) && is_allowed("walk", 1000));
}

#[test]
fn a_message_knows_where_it_was_said_and_what_with() {
    let sink = Sink::new(Clock::stepped());
    let said = std::thread::spawn(|| {
        enter("Test", 7);
        tracing::warn!(target: "test::said", depth = 3, name = "x", "it {} deep", "is");
        tracing::debug!(target: "test::said", "nobody wants it");
    });
    said.join().expect("it only says something");
    let records: Vec<_> = std::iter::from_fn(|| sink.take())
        .filter(|record| record.module == "test::said")
        .collect();
    let [record] = &records[..] else {
        panic!("one message: {records:?}")
    };
    assert_eq!(
        (record.instance.as_deref(), record.cycle),
        (Some("Test"), Some(7))
    );
    assert_eq!(
        (record.level, record.message.as_str()),
        (Level::WARN, "it is deep")
    );
    assert_eq!(
        Value::from(record.fields.clone()),
        serde_json::json!({ "depth": 3, "name": "x" })
    );
}

#[test]
fn robots_hear_themselves_and_what_is_said_between() {
    let clocks = [Clock::stepped(), Clock::stepped(), Clock::wall()];
    let sinks = clocks.clone().map(Sink::new);
    let say = |what: &str| record(Level::WARN, "test::robots", format_args!("{what}"));
    {
        let _outer = within(&clocks[0]);
        say("first");
        {
            let _inner = within(&clocks[1].clone());
            say("second");
        }
        say("first again");
    }
    say("between");
    let heard = |sink: &Sink| -> Vec<String> {
        let records = std::iter::from_fn(|| sink.take());
        let own = records.filter(|record| record.module == "test::robots");
        own.map(|record| record.message).collect()
    };
    assert_eq!(heard(&sinks[0]), ["first", "first again", "between"]);
    assert_eq!(heard(&sinks[1]), ["second", "between"]);
    let all = ["first", "second", "first again", "between"];
    assert_eq!(heard(&sinks[2]), all);
}

#[test]
fn in_a_replay_messages_have_the_time_that_is_shown_and_rates_the_systems() {
    let [late, early] = [5_000_000_000, 7].map(Timestamp::from_nanos);
    let clock = Clock::shown(late);
    let sink = Sink::new(clock.clone());
    record(Level::WARN, "test::shown", format_args!("late"));
    clock.show(early);
    record(Level::WARN, "test::shown", format_args!("early"));
    let kept = std::iter::from_fn(|| sink.take()).filter(|record| record.module == "test::shown");
    let kept: Vec<_> = kept.map(|record| (record.time, record.heard)).collect();
    let [(first, heard), (second, heard_then)] = kept[..] else {
        panic!("two: {kept:?}");
    };
    assert_eq!((first, second), (late, early));
    assert!(heard <= heard_then && heard_then < late, "{kept:?}");
}

#[test]
fn what_finds_no_place_is_counted_and_long_texts_are_cut() {
    let clock = Clock::stepped();
    let sink = Sink::new(clock.clone());
    // Other tests have sinks of their own that would be full as well.
    let _within = within(&clock);
    let long = "ä".repeat(LONGEST);
    for _ in 0..WAITING + 5 {
        record(Level::ERROR, "test::full", format_args!("{long}"));
    }
    assert!(sink.left_out() >= 5);
    // Once; what other tests say between robots comes here, too.
    assert!(sink.left_out() < 5);
    assert!(
        sink.take()
            .is_some_and(|record| record.message.len() <= LONGEST + 3)
    );
}

#[test]
fn a_cycle_that_runs_again_says_what_the_recording_does_not_have_and_once() {
    let clock = Clock::stepped();
    let sink = Sink::new(clock.clone());
    let _within = within(&clock);
    let at = Timestamp::from_nanos(7);
    let recorded = Record {
        time: Timestamp::from_nanos(8),
        heard: Timestamp::ZERO,
        level: Level::WARN,
        module: "test::again".into(),
        instance: Some("Test".into()),
        cycle: Some(3),
        message: "it is dark".to_owned(),
        fields: Map::new(),
    };
    let known = vec![recorded.clone()];
    let say = || {
        enter("Test", 3);
        for message in ["it is dark", "it is bright"] {
            tracing::warn!(target: "test::again", "{message}");
        }
        tracing::error!(target: "test::again", "it is dark");
    };
    say_again(&recorded);
    {
        let _again = again(Again::Apart { at, known });
        say();
    }
    {
        let _again = again(Again::Silent);
        say();
    }
    enter("Test", 4);
    tracing::warn!(target: "test::again", "it is dark");
    let heard = std::iter::from_fn(|| sink.take()).filter(|record| record.module == "test::again");
    let heard = heard.map(|record| (record.time.as_nanos(), record.cycle, record.message));
    let heard: Vec<_> = heard.collect();
    let expected = [
        (8, Some(3), "it is dark"),
        // What the recording does not have, or not so.
        (7, Some(3), "it is bright"),
        (7, Some(3), "it is dark"),
        (0, Some(4), "it is dark"),
    ];
    let expected = expected.map(|(time, cycle, message)| (time, cycle, message.to_owned()));
    assert_eq!(heard, expected);
}
