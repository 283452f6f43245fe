//! A recording tells of which types it is.

use framework::recorded::Settings;
use framework::replay::verify;
use hulkgen_recording::Recording as File;
use hulkgen_recording::layout::{Layout, Layouts, PartKind, Values};
use zoo_runtime::recording;

use crate::{Tape, as_it_is, on, record_in_lockstep};

/// As if the second node of this instance had another state; gives the node's path.
pub(crate) fn with_another_node(file: &mut File, instance: &str) -> String {
    let mut layouts = Layouts::of(&file.attachments);
    let topic = format!("frames/{instance}");
    let mut channels = file.channels.iter_mut();
    let (_, channel) = channels
        .find(|(_, channel)| channel.topic == topic)
        .expect("it is recorded");
    let types = &mut channel.metadata[1].1;
    let mut parts = layouts.frames[types].clone();
    let mut nodes = parts.iter_mut().filter(|part| part.kind == PartKind::Node);
    let node = nodes.nth(1).expect("it has two");
    node.layout = Layout::Tuple(vec![Layout::Text]);
    let name = node.name.clone();
    *types = format!("{:016x}", Layout::digest(&parts));
    layouts.frames.insert(types.clone(), parts);
    write(file, &layouts);
    name
}

fn write(file: &mut File, layouts: &Layouts) {
    let mut attachments = file.attachments.iter_mut();
    let attachment = attachments.find(|one| one.name == "types.json");
    attachment.expect("it is there").data = serde_json::to_vec(layouts).expect("names alone");
}

#[test]
fn every_frame_and_value_can_be_read_without_its_type() {
    let tape = Tape::new();
    record_in_lockstep(&tape.path, Settings::default(), on, &as_it_is);
    let file = tape.read();
    let layouts = Layouts::of(&file.attachments);
    // Both cameras', and nothing else.
    let images = ["VisionBottom", "VisionTop"].map(|camera| {
        let path = format!("{camera}.main_outputs.image");
        (path, "gray".to_owned())
    });
    assert_eq!(layouts.images, images.into());
    let (mut frames, mut values) = (0, 0);
    for message in file.chunks.iter().flat_map(|chunk| chunk.messages()) {
        let mut channels = file.channels.iter();
        let (_, channel) = channels
            .find(|(number, _)| *number == message.channel)
            .expect("it has a channel");
        // All but what was said.
        let Some((kind, instance)) = channel.topic.split_once('/') else {
            continue;
        };
        if kind == "values" {
            let layout = &layouts.values[instance];
            let mut read = Values::new(message.data);
            read.take(layout).expect("it is of this layout");
            assert!(read.is_empty(), "{instance}");
            values += 1;
            continue;
        }
        let mut metadata = channel.metadata.iter();
        let (_, types) = metadata
            .find(|(key, _)| key == "types")
            .expect("it tells its types");
        let Some((0, frame)) = message.data.split_first() else {
            continue;
        };
        let mut read = Values::new(frame);
        for part in &layouts.frames[types] {
            let value = read.take(&part.layout);
            value.unwrap_or_else(|error| panic!("{instance} {}: {error}", part.name));
        }
        assert!(read.is_empty(), "{instance} has more than its parts");
        frames += 1;
    }
    assert!(frames > 400 && values > 100, "{frames} {values}");
}

#[test]
fn a_recording_of_other_types_is_refused_with_what_changed() {
    let tape = Tape::new();
    record_in_lockstep(&tape.path, Settings::default(), on, &as_it_is);
    let mut file = tape.read();
    let name = with_another_node(&mut file, "Control");
    let verification = verify(&file, recording::INSTANCES).expect("it is of this robot");
    for one in &verification.instances {
        match &one.unreadable {
            Some(error) => {
                assert_eq!(one.instance, "Control");
                assert!(error.contains("of other types"), "{error}");
                assert!(error.contains(&format!("`{name}`")), "{error}");
            }
            None => assert_ne!(one.instance, "Control"),
        }
    }
    assert!(!verification.is_good());
}

#[test]
fn whoever_reads_what_is_of_another_type_does_not_fit() {
    let tape = Tape::new();
    record_in_lockstep(&tape.path, Settings::default(), on, &as_it_is);
    for (name, readers) in [
        ("Hearing", &["Control"][..]),
        (
            "parameters",
            &["VisionTop", "VisionBottom", "Control", "Reflexes"],
        ),
    ] {
        let mut file = tape.read();
        let mut layouts = Layouts::of(&file.attachments);
        let layout = layouts.values.get_mut(name).expect("somebody reads it");
        let Layout::Struct(layout) = layout else {
            panic!("{layout}");
        };
        layout.fields.push(("old".to_owned(), Layout::Bool));
        write(&mut file, &layouts);
        let verification = verify(&file, recording::INSTANCES).expect("it is of this robot");
        let unfit = verification.instances.iter().filter_map(|one| {
            let error = one.unreadable.as_ref()?;
            assert!(
                error.contains(&format!("the field `old` of `{name}` is gone")),
                "{error}"
            );
            Some(&*one.instance)
        });
        assert_eq!(unfit.collect::<Vec<_>>(), readers, "{verification}");
    }
}
