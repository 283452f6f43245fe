//! Numbers and structures of the kernel's interfaces, as C lays them out on 64-bit machines.

use std::time::Duration;

use rustix::ioctl::{Opcode, opcode};

pub(super) const VIDIOC_S_FMT: Opcode = opcode::read_write::<Format>(b'V', 5);
pub(super) const VIDIOC_REQBUFS: Opcode = opcode::read_write::<RequestBuffers>(b'V', 8);
pub(super) const VIDIOC_QBUF: Opcode = opcode::read_write::<Buffer>(b'V', 15);
pub(super) const VIDIOC_DQBUF: Opcode = opcode::read_write::<Buffer>(b'V', 17);
pub(super) const VIDIOC_STREAMON: Opcode = opcode::write::<u32>(b'V', 18);
pub(super) const VIDIOC_STREAMOFF: Opcode = opcode::write::<u32>(b'V', 19);
pub(super) const VIDIOC_S_PARM: Opcode = opcode::read_write::<Capture>(b'V', 22);
pub(super) const VIDIOC_S_CTRL: Opcode = opcode::read_write::<Control>(b'V', 28);
pub(super) const UVCIOC_CTRL_QUERY: Opcode = opcode::read_write::<ExtensionQuery>(b'u', 0x21);
pub(super) const I2C_SLAVE: Opcode = 0x0703;
pub(super) const I2C_SMBUS: Opcode = 0x0720;

/// V4L2_BUF_TYPE_VIDEO_CAPTURE.
pub(super) const CAPTURE: u32 = 1;
/// V4L2_MEMORY_USERPTR.
const OF_USERS: u32 = 2;
/// V4L2_FIELD_NONE: whole images.
const PROGRESSIVE: u32 = 1;
/// V4L2_PIX_FMT_YUYV.
const YUYV: u32 = u32::from_le_bytes(*b"YUYV");
/// V4L2_BUF_FLAG_TIMESTAMP_MASK, and its value for CLOCK_MONOTONIC.
const CLOCK_MASK: u32 = 0xe000;
const CLOCK_IS_MONOTONIC: u32 = 0x2000;
/// The extension unit of the NAO's cameras.
const EXTENSION_UNIT: u8 = 3;

/// Controls by their numbers (`linux/v4l2-controls.h`).
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
#[repr(u32)]
pub(crate) enum CameraControl {
    Brightness = 0x0098_0900,
    Contrast = 0x0098_0901,
    Saturation = 0x0098_0902,
    Hue = 0x0098_0903,
    AutoWhiteBalance = 0x0098_090c,
    Gain = 0x0098_0913,
    WhiteBalanceTemperature = 0x0098_091a,
    Sharpness = 0x0098_091b,
    ExposureMode = 0x009a_0901,
    Exposure = 0x009a_0902,
    Focus = 0x009a_090a,
    AutoFocus = 0x009a_090c,
}

/// UVC_SET_CUR and UVC_GET_CUR.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
#[repr(u8)]
pub(crate) enum ExtensionRequest {
    Set = 0x01,
}

/// `v4l2_format` with `v4l2_pix_format`.
#[repr(C, align(8))]
pub(super) struct Format {
    kind: u32,
    _gap: u32,
    width: u32,
    height: u32,
    pixel_format: u32,
    field: u32,
    _rest: [u32; 46],
}

impl Format {
    pub(super) fn yuyv(width: u32, height: u32) -> Self {
        Self {
            kind: CAPTURE,
            _gap: 0,
            width,
            height,
            pixel_format: YUYV,
            field: PROGRESSIVE,
            _rest: [0; 46],
        }
    }

    pub(super) fn is_yuyv(&self, width: u32, height: u32) -> bool {
        (self.width, self.height, self.pixel_format) == (width, height, YUYV)
    }
}

/// `v4l2_streamparm` with `v4l2_captureparm`.
#[repr(C)]
pub(super) struct Capture {
    kind: u32,
    _capability: u32,
    _mode: u32,
    seconds: u32,
    per: u32,
    _rest: [u32; 46],
}

impl Capture {
    pub(super) fn every(seconds: u32, per: u32) -> Self {
        Self {
            kind: CAPTURE,
            _capability: 0,
            _mode: 0,
            seconds,
            per,
            _rest: [0; 46],
        }
    }
}

/// `v4l2_control`.
#[repr(C)]
pub(super) struct Control {
    pub(super) id: u32,
    pub(super) value: i32,
}

/// `v4l2_requestbuffers`.
#[repr(C)]
pub(super) struct RequestBuffers {
    pub(super) count: u32,
    kind: u32,
    memory: u32,
    _rest: [u32; 2],
}

impl RequestBuffers {
    pub(super) fn of_users(count: u32) -> Self {
        Self {
            count,
            kind: CAPTURE,
            memory: OF_USERS,
            _rest: [0; 2],
        }
    }
}

/// `v4l2_buffer`.
#[repr(C)]
pub(super) struct Buffer {
    pub(super) index: u32,
    kind: u32,
    pub(super) bytes_used: u32,
    flags: u32,
    _field: u32,
    _gap: u32,
    seconds: i64,
    microseconds: i64,
    _timecode: [u32; 4],
    _sequence: u32,
    memory: u32,
    bytes: *mut u8,
    length: u32,
    _rest: [u32; 3],
}

impl Buffer {
    pub(super) fn any() -> Self {
        Self::of_user(0, std::ptr::null_mut(), 0)
    }

    pub(super) fn of_user(index: u32, bytes: *mut u8, length: u32) -> Self {
        Self {
            index,
            kind: CAPTURE,
            bytes_used: 0,
            flags: 0,
            _field: 0,
            _gap: 0,
            seconds: 0,
            microseconds: 0,
            _timecode: [0; 4],
            _sequence: 0,
            memory: OF_USERS,
            bytes,
            length,
            _rest: [0; 3],
        }
    }

    /// When the image was taken by the monotonic clock; `None` where the driver has another one.
    pub(super) fn taken_at(&self) -> Option<Duration> {
        let seconds = u64::try_from(self.seconds).ok()?;
        let microseconds = u32::try_from(self.microseconds).ok()?;
        let nanoseconds = microseconds.checked_mul(1000)?;
        let is_monotonic = self.flags & CLOCK_MASK == CLOCK_IS_MONOTONIC;
        is_monotonic
            .then(|| Duration::from_secs(seconds) + Duration::from_nanos(nanoseconds.into()))
    }
}

/// `uvc_xu_control_query`.
#[repr(C)]
pub(super) struct ExtensionQuery {
    unit: u8,
    selector: u8,
    request: u8,
    size: u16,
    data: *mut u8,
}

impl ExtensionQuery {
    pub(super) fn new(selector: u8, request: ExtensionRequest, size: u16, data: *mut u8) -> Self {
        Self {
            unit: EXTENSION_UNIT,
            selector,
            request: request as u8,
            size,
            data,
        }
    }
}

/// `i2c_smbus_ioctl_data`, for one byte (I2C_SMBUS_BYTE_DATA).
#[repr(C)]
pub(super) struct SmBus {
    direction: u8,
    register: u8,
    size: u32,
    data: *mut u8,
}

impl SmBus {
    pub(super) fn read(register: u8, data: *mut u8) -> Self {
        Self {
            direction: 1,
            register,
            size: 2,
            data,
        }
    }

    pub(super) fn write(register: u8, data: *mut u8) -> Self {
        Self {
            direction: 0,
            ..Self::read(register, data)
        }
    }
}

#[cfg(test)]
mod tests {
    use std::mem::offset_of;

    use super::*;

    /// As the C compiler has them from the kernel's headers on x86_64.
    #[test]
    fn requests_have_the_numbers_of_the_kernels_headers() {
        assert_eq!(VIDIOC_S_FMT, 0xc0d0_5605);
        assert_eq!(VIDIOC_REQBUFS, 0xc014_5608);
        assert_eq!(VIDIOC_QBUF, 0xc058_560f);
        assert_eq!(VIDIOC_DQBUF, 0xc058_5611);
        assert_eq!(VIDIOC_STREAMON, 0x4004_5612);
        assert_eq!(VIDIOC_STREAMOFF, 0x4004_5613);
        assert_eq!(VIDIOC_S_PARM, 0xc0cc_5616);
        assert_eq!(VIDIOC_S_CTRL, 0xc008_561c);
        assert_eq!(UVCIOC_CTRL_QUERY, 0xc010_7521);
    }

    #[test]
    fn fields_stand_where_c_puts_them() {
        assert_eq!(offset_of!(Format, width), 8);
        assert_eq!(offset_of!(Capture, seconds), 12);
        assert_eq!(offset_of!(Buffer, seconds), 24);
        assert_eq!(offset_of!(Buffer, memory), 60);
        assert_eq!(offset_of!(Buffer, bytes), 64);
        assert_eq!(offset_of!(Buffer, length), 72);
        assert_eq!(offset_of!(ExtensionQuery, size), 4);
        assert_eq!(offset_of!(ExtensionQuery, data), 8);
        assert_eq!(offset_of!(SmBus, size), 4);
        assert_eq!((offset_of!(SmBus, data), size_of::<SmBus>()), (8, 16));
    }

    #[test]
    fn only_the_monotonic_clock_says_when_an_image_was_taken() {
        let mut buffer = Buffer::any();
        (buffer.seconds, buffer.microseconds) = (3, 500_000);
        assert_eq!(buffer.taken_at(), None);
        buffer.flags = CLOCK_IS_MONOTONIC;
        assert_eq!(buffer.taken_at(), Some(Duration::from_millis(3500)));
        buffer.seconds = -1;
        assert_eq!(buffer.taken_at(), None);
    }
}
