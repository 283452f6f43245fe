//! One frame on its way into a recording, and out of it.
//!
//! ```text
//! message on the channel of an instance:  0, head, states of nodes, what the cycle took        where it begins
//!                                         1, one digest after the other                        where it ends
//! message on a channel of values:         one value; its sequence number is the cycle's        before the first frame that names it
//! ```

use std::time::Duration;

use hulkgen_recording::ChannelId;
use serde::{Deserialize, Serialize};

use super::target::Target;
use super::{Foreign, Outputs, SaveError, Saving};
use crate::buffer::Reader;
use crate::time::Timestamp;

/// Version of all that [`Capture`] writes; a reader of another version says so.
pub const VERSION: u32 = 2;

/// What [`Values::parameters`] are listed under among the instances.
pub const PARAMETERS: &str = "parameters";

/// Which kind of message.
pub(crate) const BEGUN: u8 = 0;
pub(crate) const FINISHED: u8 = 1;

/// How a frame begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Head {
    /// The cycle's number.
    pub number: u64,
    pub start: Timestamp,
    pub since_last: Duration,
    /// Whether it is the first cycle after a restart.
    pub restarted: bool,
    /// Whether no frame before it is needed.
    pub whole: bool,
}

/// Channels of values by the instance that wrote them, [`PARAMETERS`] among them.
pub(crate) type Channels = [(&'static str, ChannelId)];

/// Which cycle of each input stands in the block, in the order of the calls of [`Values`].
#[derive(Clone, Debug, Default)]
pub(crate) struct Written(Vec<Newest>);

/// The newest cycle of one input that stands in the block.
#[derive(Clone, Copy, Debug, Default)]
struct Newest {
    kept: Option<u64>,
    /// With the frame that is being written.
    next: Option<u64>,
}

impl Written {
    pub(crate) fn begin(&mut self, is_first: bool) {
        for input in &mut self.0 {
            input.next = input.kept.filter(|_| !is_first);
        }
    }

    pub(crate) fn keep(&mut self) {
        for input in &mut self.0 {
            input.kept = input.next;
        }
    }
}

/// What an instance writes one frame into.
pub struct Capture<'a, 'block> {
    pub(crate) target: Target<'a, 'block>,
    pub(crate) written: &'a mut Written,
    /// Of the last frame, for histories.
    pub(crate) since: Option<Timestamp>,
}

/// What values of other instances are written into.
pub struct Values<'a, 'block> {
    target: Target<'a, 'block>,
    written: &'a mut Written,
    time: Timestamp,
    /// How many inputs there were.
    position: usize,
}

impl<'block> Capture<'_, 'block> {
    /// For what the cycle that started at this time sees of other instances; before [`Capture::frame`].
    pub fn values(&mut self, start: Timestamp) -> Values<'_, 'block> {
        self.written.begin(self.target.is_first());
        Values {
            target: self.target.again(),
            written: self.written,
            time: start,
            position: 0,
        }
    }

    /// Writes the frame itself.
    ///
    /// # Errors
    /// If there is no room, or a value cannot be serialised.
    pub fn frame(
        &mut self,
        mut head: Head,
        save: impl FnOnce(Option<Timestamp>, &mut Saving<'_, '_>),
    ) -> Result<(), SaveError> {
        head.whole = self.target.is_first();
        let since = self.since.filter(|_| !head.whole);
        let (sequence, time) = (head.number as u32, head.start.as_nanos());
        self.target.message(None, (sequence, time), |out| {
            out.add([BEGUN]);
            out.put_here(&head);
            save(since, out);
        })
    }
}

impl Values<'_, '_> {
    /// Every cycle of an instance that this input shows and the block does not have yet.
    ///
    /// # Errors
    /// If there is no room, or a value cannot be serialised.
    pub fn of<T: Outputs>(
        &mut self,
        instance: &str,
        input: &impl Foreign<T>,
    ) -> Result<(), SaveError> {
        let before = self.before();
        input
            .values(&mut |cycle, timestamp, value| {
                // Cycles of an instance come in order.
                if before.is_none_or(|before| cycle > before) {
                    self.put(instance, (cycle, timestamp), |out| value.save(out))?;
                }
                Ok(())
            })
            .map(|()| self.position += 1)
    }

    /// The parameters, if the block does not have this version.
    ///
    /// # Errors
    /// If there is no room, or a value cannot be serialised.
    pub fn parameters<P: Serialize>(&mut self, parameters: &Reader<P>) -> Result<(), SaveError> {
        let view = parameters.view();
        if self.before() != Some(view.cycle()) {
            self.put(PARAMETERS, (view.cycle(), self.time), |out| {
                out.put(view.value())
            })?;
        }
        self.position += 1;
        Ok(())
    }

    fn before(&mut self) -> Option<u64> {
        let Written(inputs) = &mut *self.written;
        if inputs.len() <= self.position {
            inputs.resize(self.position + 1, Newest::default());
        }
        inputs[self.position].next
    }

    fn put(
        &mut self,
        name: &str,
        (cycle, timestamp): (u64, Timestamp),
        save: impl FnOnce(&mut Saving<'_, '_>),
    ) -> Result<(), SaveError> {
        self.written.0[self.position].next = Some(cycle);
        let place = (cycle as u32, timestamp.as_nanos());
        self.target.message(Some(name), place, save)
    }
}

#[cfg(test)]
mod tests {
    use hulkgen_recording::{Channel, Description, Recorded, Recorder, Recording, Settings};
    use serde::ser::Serializer;

    use super::super::{Loading, Outputs};
    use super::*;
    use crate::Reflect;
    use crate::buffer::buffer;
    use crate::injection::{
        Inject as _, Injected, Injection, InjectionCell, InjectionTable, Injector,
    };
    use crate::parameters::Given;
    use crate::pool::Leased;

    const OWN: ChannelId = ChannelId(0);
    const CAMERA: ChannelId = ChannelId(1);

    /// Large: a cycler that writes it has lost.
    #[derive(Clone, Debug, Default, Deserialize, PartialEq, Reflect)]
    struct Image {
        pixels: Vec<u8>,
    }

    impl Serialize for Image {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            let writer = std::thread::current().name() == Some("recording");
            assert!(writer, "it is for the thread that owns the file");
            self.pixels.serialize(serializer)
        }
    }

    #[derive(Clone, Debug, Default, Deserialize, Outputs, PartialEq, Reflect, Serialize)]
    struct CameraOutputs {
        count: u16,
        image: Option<Leased<Image>>,
        is_dark: bool,
    }

    fn channel(topic: &str) -> Channel {
        Channel {
            topic: topic.to_owned(),
            schema: None,
            encoding: "test".to_owned(),
            metadata: Vec::new(),
            once_per_chunk: false,
        }
    }

    #[test]
    fn a_handle_that_another_instance_wrote_is_left_to_the_recording() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("run.mcap");
        let description = Description {
            channels: vec![channel("frames"), channel("values")],
            ..Description::default()
        };
        let started = Recorder::start(&path, description, &["Control"], Settings::default());
        let (recorder, mut tracks) = started.expect("it is new");
        let (mut camera, [mut reader], []) = buffer::<CameraOutputs, 1, 0>([]);
        let mut written = Written::default();
        for cycle in 1..=3_u64 {
            // In the last cycle nothing is new.
            if cycle < 3 {
                *camera.slots().0 = CameraOutputs {
                    count: 300,
                    image: (cycle == 1).then(|| Leased::of(Image { pixels: vec![7; 3] })),
                    is_dark: true,
                };
                camera.complete(cycle, Timestamp::from_nanos(cycle));
            }
            reader.take();
            let recorded = tracks[0].frame(cycle, 0, |frame| {
                let mut capture = Capture {
                    target: Target::Frame {
                        frame,
                        own: OWN,
                        channels: &[("Camera", CAMERA)],
                    },
                    written: &mut written,
                    since: None,
                };
                let mut values = capture.values(Timestamp::from_nanos(cycle));
                values.of("Camera", &reader)
            });
            assert_eq!(recorded, Recorded::Whole);
            written.keep();
        }
        drop(tracks);
        assert!(recorder.end().is_complete);
        let recording = Recording::open(&path).expect("it can be read");
        let messages: Vec<_> = recording
            .chunks
            .iter()
            .flat_map(|chunk| chunk.messages())
            .collect();
        let data: Vec<_> = messages
            .iter()
            .map(|one| (one.sequence, one.data))
            .collect();
        let [first, second] = [&[0xac, 2, 1, 3, 7, 7, 7, 1][..], &[0xac, 2, 0, 1]];
        assert_eq!(data, [(1, first), (2, second)]);
        let read: CameraOutputs = Loading::new(first).take().expect("as serde writes it");
        assert_eq!((read.count, read.is_dark), (300, true));
        assert_eq!(
            read.image.map(|image| image.pixels.clone()),
            Some(vec![7; 3])
        );
    }
    #[derive(Clone, Default, Deserialize, Outputs, Serialize)]
    struct Injections {
        count: Injection<u16>,
        image: Injection<Option<Leased<Image>>>,
        is_dark: Injection<bool>,
    }

    impl InjectionTable for Injections {
        fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell> {
            match output {
                "count" => Some(&mut self.count),
                "image" => Some(&mut self.image),
                _ => Some(&mut self.is_dark),
            }
        }
    }

    #[test]
    fn a_handle_that_a_client_put_there_is_left_to_the_recording() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("run.mcap");
        let description = Description {
            channels: vec![channel("frames")],
            ..Description::default()
        };
        let started = Recorder::start(&path, description, &["Control"], Settings::default());
        let (recorder, mut tracks) = started.expect("it is new");
        let (writer, [mut reader], []) = buffer::<Injected<Injections>, 1, 0>([]);
        let mut injector = Injector::new(writer);
        let mut inject = |output: &str, json: serde_json::Value| {
            injector
                .inject(output, &Given::from(&json))
                .expect("it fits");
        };
        for cycle in 1..=3_u64 {
            match cycle {
                2 => inject("count", 300.into()),
                3 => inject("image", serde_json::json!({ "pixels": [7, 7, 7] })),
                _ => {}
            }
            reader.take();
            let recorded = tracks[0].frame(cycle, 0, |frame| {
                frame.message(OWN, cycle as u32, cycle, |writing| {
                    let mut saving = Saving::new(writing);
                    reader.save_injected(&mut saving);
                    saving.end()
                })
            });
            assert_eq!(recorded, Recorded::Whole);
        }
        drop(tracks);
        assert!(recorder.end().is_complete);
        let recording = Recording::open(&path).expect("it can be read");
        let chunks = recording.chunks.iter();
        let messages = chunks.flat_map(|chunk| chunk.messages());
        let data: Vec<_> = messages.map(|one| one.data).collect();
        let last = &[1, 1, 0xac, 2, 1, 1, 3, 7, 7, 7, 0][..];
        assert_eq!(data, [&[0][..], &[1, 1, 0xac, 2, 0, 0], last]);
        let read: Option<Injections> = Loading::new(last).take().expect("as serde writes it");
        let image = read.and_then(|read| read.image.value().cloned().flatten());
        assert_eq!(image.expect("there is one").pixels, [7; 3]);
    }
}
