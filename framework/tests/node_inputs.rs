//! How the inputs look where they are made and where they are used.

use std::time::Duration;

use framework::{
    Consumer, HistoricInput, History, Horizon, Interleaved, Interleaving, Latest, PerceptionInput,
    Stored, Timestamp, Writer, buffer, interleave, testing,
};

#[derive(Default)]
struct VisionOutputs {
    balls: Vec<u32>,
    line: Option<u32>,
}

#[derive(Default)]
struct AudioOutputs {
    whistle: bool,
}

/// As a node's context after `#[context]`.
struct CycleContext<'context> {
    balls: PerceptionInput<'context, &'context Vec<u32>>,
    line: PerceptionInput<'context, Option<&'context u32>>,
    whistle: PerceptionInput<'context, &'context bool>,
    pose: HistoricInput<'context, &'context u32>,
    sensor: Option<Latest<&'context u32>>,
}

fn cycle(context: CycleContext<'_>) -> (u32, usize) {
    let mut sum = 0;
    for (timestamp, balls) in context.balls.persistent {
        sum += balls.iter().sum::<u32>() * context.pose.get(timestamp).copied().unwrap_or(1);
    }
    for (_, balls) in &context.balls.transient {
        sum += balls.len() as u32;
    }
    let lines = context
        .line
        .persistent
        .iter()
        .rev()
        .filter_map(|(_, line)| line);
    sum += lines.sum::<u32>() + context.sensor.map_or(0, |sensor| *sensor.value);
    (sum, context.whistle.persistent.len())
}

fn time(nanos: u64) -> Timestamp {
    Timestamp::from_nanos(nanos)
}

fn see(writer: &mut Writer<VisionOutputs>, timestamp: u64, balls: &[u32], line: Option<u32>) {
    writer.announce(time(timestamp));
    let (outputs, _) = writer.slots();
    outputs.balls.clear();
    outputs.balls.extend(balls);
    outputs.line = line;
    writer.complete(1, time(timestamp));
}

#[test]
fn inputs_are_made_in_place_where_a_node_is_called() {
    let (mut top, [mut reader], [for_top]) = buffer::<VisionOutputs, 1, 1>([4]);
    let (mut bottom, [], [for_bottom]) = buffer::<VisionOutputs, 0, 1>([4]);
    let (mut audio, [], [for_audio]) = buffer::<AudioOutputs, 0, 1>([4]);
    let mut for_top = Consumer::new(for_top, Duration::MAX);
    let mut for_bottom = Consumer::new(for_bottom, Duration::MAX);
    let mut for_audio = Consumer::new(for_audio, Duration::MAX);
    let (mut horizon, mut vision) = (Horizon::new(), Interleaving::new());
    let mut historic = History::new(Duration::from_secs(1));
    historic.push(time(9), &10);
    see(&mut top, 10, &[1, 2], Some(5));
    see(&mut bottom, 11, &[3], None);
    audio.announce(time(12));
    audio.slots().0.whistle = true;
    see(&mut top, 12, &[4, 4], None);
    reader.take();
    horizon.consume(time(20), [&mut for_top, &mut for_bottom, &mut for_audio]);
    vision.merge([&for_top, &for_bottom]);
    let outputs = cycle(CycleContext {
        balls: PerceptionInput::new(&Interleaved {
            order: &vision,
            instances: [
                &for_top.project(|outputs| &outputs.balls),
                &for_bottom.project(|outputs| &outputs.balls),
            ],
        }),
        line: PerceptionInput::new(&for_top.project(|outputs| outputs.line.as_ref())),
        whistle: PerceptionInput::new(&for_audio.project(|outputs| &outputs.whistle)),
        pose: HistoricInput::new(
            &Stored {
                history: &historic,
                path: |pose| pose,
            },
            time(20),
            &30,
        ),
        sensor: reader.view().latest(time(20), |outputs| &outputs.balls[0]),
    });
    assert_eq!(outputs, (10 * (1 + 2 + 3) + 2 + 5 + 4, 0));
}

#[test]
fn a_test_of_a_node_makes_its_inputs_of_its_own_values() {
    let outputs = cycle(CycleContext {
        balls: testing::perception(
            &[(time(10), &vec![1, 2]), (time(11), &vec![3])],
            &[(time(12), &vec![4, 4])],
        ),
        line: testing::perception(&[(time(10), Some(&5)), (time(12), None)], &[]),
        whistle: testing::perception(&[], &[]),
        pose: testing::history(&[(time(9), &10)], time(20), &30),
        sensor: testing::latest(time(12), &4, time(20)),
    });
    assert_eq!(outputs, (10 * (1 + 2 + 3) + 2 + 5 + 4, 0));
}

#[test]
fn timelines_can_be_asked_without_iterating() {
    let persistent = vec![(time(1), 10), (time(3), 30)];
    let transient = vec![(time(2), 20)];
    let input = testing::perception(&persistent, &transient);
    assert_eq!(
        (input.persistent.len(), input.persistent.is_empty()),
        (2, false)
    );
    assert_eq!(input.persistent.last(), Some((time(3), 30)));
    assert_eq!(testing::perception::<u8>(&[], &[]).transient.last(), None);
    let item = input.persistent.items().next_back().expect("two items");
    assert_eq!(
        (item.timestamp, item.order, item.cycle, item.value),
        (time(3), time(3), 2, 30)
    );
    let all: Vec<_> = interleave([input.persistent, input.transient]).collect();
    assert_eq!(all, [(time(1), 10), (time(2), 20), (time(3), 30)]);
    let list = format!("{:?}", input.transient);
    assert!(list.contains("20"), "{list}");
}

#[test]
fn a_latest_input_of_a_test_is_new_and_as_old_as_its_timestamps_say() {
    let latest = testing::latest(time(12), 4, time(20)).expect("always there");
    assert_eq!(
        (latest.value, latest.age, latest.is_new),
        (4, Duration::from_nanos(8), true)
    );
}
