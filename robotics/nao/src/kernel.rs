//! What the kernel is asked about cameras and their bus: every `ioctl` of this crate, and the memory that drivers write into.
//!
//! Numbers and layouts are those of `linux/videodev2.h`, `linux/uvcvideo.h` and `linux/i2c.h` on 64-bit machines.
//!
//! Invariant: memory that a driver may write into belongs to a [`Stream`] and is neither moved nor freed nor looked at until
//! the driver has given it back.
#![expect(
    unsafe_code,
    reason = "the kernel is asked through pointers; each request is argued where it stands"
)]

mod layout;

use std::fs::File;
use std::io;
use std::os::fd::AsFd;
use std::time::Duration;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;
use rustix::ioctl::{IntegerSetter, Setter, Updater, ioctl};
use rustix::time::{ClockId, clock_gettime};

use self::layout::{
    Buffer, Capture, Control, ExtensionQuery, Format, I2C_SLAVE, I2C_SMBUS, RequestBuffers, SmBus,
    UVCIOC_CTRL_QUERY, VIDIOC_DQBUF, VIDIOC_QBUF, VIDIOC_REQBUFS, VIDIOC_S_CTRL, VIDIOC_S_FMT,
    VIDIOC_S_PARM, VIDIOC_STREAMOFF, VIDIOC_STREAMON,
};
pub(crate) use self::layout::{CameraControl, ExtensionRequest};

/// Asks for YUYV images of a size.
///
/// # Errors
/// Where the driver gives another format or size, or is no camera.
pub(crate) fn set_format(camera: &File, width: u32, height: u32) -> io::Result<()> {
    let mut format = Format::yuyv(width, height);
    // SAFETY: VIDIOC_S_FMT reads and writes a `v4l2_format`, whose layout `Format` has; it holds no pointer for this type.
    unsafe { ioctl(camera, Updater::<VIDIOC_S_FMT, Format>::new(&mut format)) }?;
    if format.is_yuyv(width, height) {
        Ok(())
    } else {
        Err(io::Error::other(format!(
            "the camera does not give YUYV images of {width} x {height}"
        )))
    }
}

/// Asks for so many images a second.
///
/// # Errors
/// What the driver says.
pub(crate) fn set_rate(camera: &File, images_per_second: u32) -> io::Result<()> {
    let mut capture = Capture::every(1, images_per_second);
    // SAFETY: VIDIOC_S_PARM reads and writes a `v4l2_streamparm`, whose layout `Capture` has; it holds no pointer.
    Ok(unsafe { ioctl(camera, Updater::<VIDIOC_S_PARM, Capture>::new(&mut capture)) }?)
}

/// Sets one control.
///
/// # Errors
/// What the driver says.
pub(crate) fn set_control(camera: &File, control: CameraControl, value: i32) -> io::Result<()> {
    let mut control = Control {
        id: control as u32,
        value,
    };
    // SAFETY: VIDIOC_S_CTRL reads and writes a `v4l2_control`, whose layout `Control` has; it holds no pointer.
    Ok(unsafe { ioctl(camera, Updater::<VIDIOC_S_CTRL, Control>::new(&mut control)) }?)
}

/// Asks or tells something of a camera's own: the extension unit 3 of these cameras.
///
/// # Errors
/// What the driver says.
pub(crate) fn ask_extension(
    camera: &File,
    selector: u8,
    request: ExtensionRequest,
    data: &mut [u8],
) -> io::Result<()> {
    let size = u16::try_from(data.len()).map_err(io::Error::other)?;
    let mut query = ExtensionQuery::new(selector, request, size, data.as_mut_ptr());
    // SAFETY: UVCIOC_CTRL_QUERY reads a `uvc_xu_control_query`, whose layout `ExtensionQuery` has, and reads or writes `size` bytes at its
    // pointer, during the call alone; `data` has that many and is borrowed until after it.
    Ok(unsafe { ioctl(camera, Updater::<UVCIOC_CTRL_QUERY, _>::new(&mut query)) }?)
}

/// Reads a register of a device on a bus.
///
/// # Errors
/// What the driver says.
pub(crate) fn read_register(bus: &File, address: u8, register: u8) -> io::Result<u8> {
    let mut data = [0_u8; 34];
    access_register(bus, address, &mut SmBus::read(register, data.as_mut_ptr()))?;
    Ok(data[0])
}

/// Writes a register of a device on a bus.
///
/// # Errors
/// What the driver says.
pub(crate) fn write_register(bus: &File, address: u8, register: u8, value: u8) -> io::Result<()> {
    let mut data = [0_u8; 34];
    data[0] = value;
    access_register(bus, address, &mut SmBus::write(register, data.as_mut_ptr()))
}

fn access_register(bus: &File, address: u8, request: &mut SmBus) -> io::Result<()> {
    // SAFETY: I2C_SLAVE takes the address as an integer.
    unsafe {
        ioctl(
            bus,
            IntegerSetter::<I2C_SLAVE>::new_usize(usize::from(address)),
        )
    }?;
    // SAFETY: I2C_SMBUS reads an `i2c_smbus_ioctl_data`, whose layout `SmBus` has, and reads or writes one `i2c_smbus_data` at its
    // pointer, during the call alone; that has 34 bytes, as the arrays of both callers do, which live until after it.
    Ok(unsafe { ioctl(bus, Updater::<I2C_SMBUS, SmBus>::new(request)) }?)
}

/// A camera that streams into memory of ours. Images are handed on by exchanging memory: nothing is copied.
#[derive(Debug)]
pub(crate) struct Stream {
    camera: File,
    /// The driver writes into those that are queued.
    buffers: Vec<Slot>,
    /// Bytes of an image.
    length: usize,
}

#[derive(Debug)]
struct Slot {
    bytes: Vec<u8>,
    is_queued: bool,
}

impl Stream {
    /// Begins to stream images of `length` bytes into so many buffers; the format was set before.
    ///
    /// # Errors
    /// What the driver says.
    pub(crate) fn start(camera: File, length: usize, buffers: u32) -> io::Result<Self> {
        let mut request = RequestBuffers::of_users(buffers);
        // SAFETY: VIDIOC_REQBUFS reads and writes a `v4l2_requestbuffers`, whose layout `RequestBuffers` has; it holds no pointer.
        unsafe { ioctl(&camera, Updater::<VIDIOC_REQBUFS, _>::new(&mut request)) }?;
        if request.count == 0 {
            return Err(io::Error::other(
                "the camera does not write into memory of programs",
            ));
        }
        let slot = || Slot {
            bytes: vec![0; length],
            is_queued: false,
        };
        let mut stream = Self {
            camera,
            buffers: std::iter::repeat_with(slot)
                .take(request.count as usize)
                .collect(),
            length,
        };
        for index in 0..stream.buffers.len() {
            stream.queue(index)?;
        }
        // SAFETY: VIDIOC_STREAMON reads an int, the type of buffers.
        unsafe {
            ioctl(
                &stream.camera,
                Setter::<VIDIOC_STREAMON, u32>::new(layout::CAPTURE),
            )
        }?;
        Ok(stream)
    }

    /// Waits for an image, for at most `patience`, and exchanges the newest with `image`; its age. `None` where none came.
    ///
    /// # Errors
    /// What the driver says; then this stream is over.
    pub(crate) fn take(
        &mut self,
        patience: Duration,
        image: &mut Vec<u8>,
    ) -> io::Result<Option<Duration>> {
        if !self.wait(patience)? {
            return Ok(None);
        }
        let mut newest = None;
        while let Some(buffer) = self.dequeue()? {
            if let Some((older, _)) = newest.replace((buffer.index as usize, buffer)) {
                self.queue(older)?;
            }
        }
        let Some((index, buffer)) = newest else {
            return Ok(None);
        };
        let slot = &mut self.buffers[index];
        slot.bytes.truncate(buffer.bytes_used as usize);
        std::mem::swap(&mut slot.bytes, image);
        self.queue(index)?;
        Ok(Some(age(&buffer)))
    }

    fn wait(&self, patience: Duration) -> io::Result<bool> {
        let timeout = Timespec {
            tv_sec: patience.as_secs() as i64,
            tv_nsec: patience.subsec_nanos().into(),
        };
        let mut polled = [PollFd::from_borrowed_fd(self.camera.as_fd(), PollFlags::IN)];
        match poll(&mut polled, Some(&timeout)) {
            Ok(_)
                if polled[0]
                    .revents()
                    .intersects(PollFlags::ERR | PollFlags::HUP) =>
            {
                Err(io::Error::other("the camera has gone"))
            }
            Ok(count) => Ok(count > 0),
            // A signal says nothing about the camera.
            Err(Errno::INTR) => Ok(false),
            Err(error) => Err(error.into()),
        }
    }

    /// Lets the driver have a buffer.
    fn queue(&mut self, index: usize) -> io::Result<()> {
        let slot = &mut self.buffers[index];
        assert!(
            !slot.is_queued,
            "a buffer is queued once until it is given back"
        );
        slot.bytes.resize(self.length, 0);
        let mut buffer = Buffer::of_user(index as u32, slot.bytes.as_mut_ptr(), self.length as u32);
        // SAFETY: VIDIOC_QBUF reads and writes a `v4l2_buffer`, whose layout `Buffer` has. From then on until VIDIOC_DQBUF gives it back or the
        // stream ends the driver writes at most `length` bytes at its pointer: the slot has that many, is not touched while
        // `is_queued`, and `Drop` ends the stream before the memory goes.
        let queued = unsafe { ioctl(&self.camera, Updater::<VIDIOC_QBUF, _>::new(&mut buffer)) };
        slot.is_queued = queued.is_ok();
        Ok(queued?)
    }

    /// Takes back a buffer that the driver has filled; `None` where it has filled none.
    fn dequeue(&mut self) -> io::Result<Option<Buffer>> {
        let mut buffer = Buffer::any();
        // SAFETY: VIDIOC_DQBUF reads and writes a `v4l2_buffer`, whose layout `Buffer` has; it only tells pointers.
        match unsafe { ioctl(&self.camera, Updater::<VIDIOC_DQBUF, _>::new(&mut buffer)) } {
            Ok(()) => {}
            Err(Errno::AGAIN) => return Ok(None),
            Err(error) => return Err(error.into()),
        }
        let slot = self.buffers.get_mut(buffer.index as usize);
        let slot =
            slot.ok_or_else(|| io::Error::other("the camera gave a buffer that it never had"))?;
        slot.is_queued = false;
        Ok(Some(buffer))
    }
}

impl Drop for Stream {
    fn drop(&mut self) {
        // SAFETY: VIDIOC_STREAMOFF reads an int, the type of buffers. It gives all buffers back.
        let ended = unsafe {
            ioctl(
                &self.camera,
                Setter::<VIDIOC_STREAMOFF, u32>::new(layout::CAPTURE),
            )
        };
        if ended.is_err() {
            // A driver that does not end the stream may still write: its memory must never serve anything else.
            for slot in self.buffers.drain(..).filter(|slot| slot.is_queued) {
                std::mem::forget(slot);
            }
        }
    }
}

/// How long ago an image was taken; none where the driver's clock is another one.
fn age(buffer: &Buffer) -> Duration {
    let now = clock_gettime(ClockId::Monotonic);
    let now = Duration::new(now.tv_sec as u64, now.tv_nsec as u32);
    let taken = buffer.taken_at();
    taken.map_or(Duration::ZERO, |taken| now.saturating_sub(taken))
}
