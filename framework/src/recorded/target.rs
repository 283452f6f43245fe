//! Where the messages of a frame go.

use hulkgen_recording::{ChannelId, Frame};

use super::capture::Channels;
#[cfg(feature = "yardstick")]
use super::yardstick::Slice;
use super::{SaveError, Saving};

/// The frame of a recording, or in a bench what stands for it.
pub(crate) enum Target<'a, 'block> {
    Frame {
        frame: &'a mut Frame<'block>,
        /// Of the frame's instance.
        own: ChannelId,
        channels: &'a Channels,
    },
    #[cfg(feature = "yardstick")]
    Slice(&'a mut Slice<'block>),
}

impl<'block> Target<'_, 'block> {
    /// For a part of it.
    pub(crate) fn again(&mut self) -> Target<'_, 'block> {
        match self {
            Self::Frame {
                frame,
                own,
                channels,
            } => Target::Frame {
                frame,
                own: *own,
                channels,
            },
            #[cfg(feature = "yardstick")]
            Self::Slice(slice) => Target::Slice(slice),
        }
    }

    /// Whether it must not refer to what stands before it.
    pub(crate) fn is_first(&self) -> bool {
        match self {
            Self::Frame { frame, .. } => frame.is_first(),
            #[cfg(feature = "yardstick")]
            Self::Slice(slice) => slice.is_first,
        }
    }

    /// One message, on the channel of values of another instance or on the own one.
    ///
    /// # Errors
    /// If there is no room, a value cannot be serialised, or the other instance has no such channel.
    pub(crate) fn message(
        &mut self,
        other: Option<&str>,
        (sequence, time): (u32, u64),
        save: impl FnOnce(&mut Saving<'_, '_>),
    ) -> Result<(), SaveError> {
        match self {
            Self::Frame {
                frame,
                own,
                channels,
            } => {
                let channel = match other {
                    None => *own,
                    Some(name) => channel_of(name, channels)?,
                };
                frame.message(channel, sequence, time, |writing| {
                    let mut saving = Saving::new(writing);
                    save(&mut saving);
                    saving.end()
                })
            }
            #[cfg(feature = "yardstick")]
            Self::Slice(slice) => {
                let mut saving = Saving::by_postcard(slice);
                save(&mut saving);
                saving.end()
            }
        }
    }
}

fn channel_of(name: &str, channels: &Channels) -> Result<ChannelId, SaveError> {
    let found = channels.iter().find(|(known, _)| *known == name);
    let (_, channel) =
        found.ok_or_else(|| SaveError::value(format!("`{name}` has no channel of values")))?;
    Ok(*channel)
}
