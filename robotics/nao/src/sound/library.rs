//! ALSA's library, opened while the program runs: building needs neither its headers nor the library, and a machine without
//! sound needs nothing.
//!
//! Signatures are those of `alsa/pcm.h` of alsa-lib 1.x.
#![expect(
    unsafe_code,
    reason = "a library of C is called; each call is argued where it stands"
)]

use std::ffi::{CStr, CString, c_char, c_int, c_long, c_uint, c_ulong, c_void};
use std::path::Path;
use std::ptr::NonNull;
use std::sync::Arc;
use std::time::Duration;

use framework::{Error, Result};

/// SND_PCM_STREAM_PLAYBACK and SND_PCM_STREAM_CAPTURE.
const PLAYBACK: c_int = 0;
const CAPTURE: c_int = 1;
/// SND_PCM_FORMAT_FLOAT_LE.
const FLOAT: c_int = 14;
/// SND_PCM_ACCESS_RW_INTERLEAVED.
const INTERLEAVED: c_int = 3;
/// SND_PCM_STATE_PREPARED.
const PREPARED: c_int = 2;
/// How much sound the device keeps, in µs: a second, so that nothing is lost while the machine is busy.
const LATENCY: c_uint = 1_000_000;
/// How often a device that records gives what it has, in µs: twice per block of 2048 samples at 44.1 kHz. Asked for a latency
/// alone, ALSA would take a fourth of it.
const PERIOD: c_uint = 23_220;

type Open = unsafe extern "C" fn(*mut *mut c_void, *const c_char, c_int, c_int) -> c_int;
type SetParameters =
    unsafe extern "C" fn(*mut c_void, c_int, c_int, c_uint, c_uint, c_int, c_uint) -> c_int;
type Allocate = unsafe extern "C" fn(*mut *mut c_void) -> c_int;
type Free = unsafe extern "C" fn(*mut c_void);
type WithDevice = unsafe extern "C" fn(*mut c_void, *mut c_void) -> c_int;
type ChooseKind = unsafe extern "C" fn(*mut c_void, *mut c_void, c_int) -> c_int;
type ChooseNumber = unsafe extern "C" fn(*mut c_void, *mut c_void, c_uint) -> c_int;
type ChooseExactly = unsafe extern "C" fn(*mut c_void, *mut c_void, c_uint, c_int) -> c_int;
type ChooseNear = unsafe extern "C" fn(*mut c_void, *mut c_void, *mut c_uint, *mut c_int) -> c_int;
type Read = unsafe extern "C" fn(*mut c_void, *mut c_void, c_ulong) -> c_long;
type Write = unsafe extern "C" fn(*mut c_void, *const c_void, c_ulong) -> c_long;
type Recover = unsafe extern "C" fn(*mut c_void, c_int, c_int) -> c_int;
type Wait = unsafe extern "C" fn(*mut c_void, c_int) -> c_int;
type Simple = unsafe extern "C" fn(*mut c_void) -> c_int;
type Count = unsafe extern "C" fn(*mut c_void) -> c_long;
type Describe = unsafe extern "C" fn(c_int) -> *const c_char;

/// The library. Invariant: its functions are not called once `library` is gone, which every [`Pcm`] keeps.
pub(super) struct Library {
    open: Open,
    set_parameters: SetParameters,
    choices: Choices,
    state: Simple,
    start: Simple,
    wait: Wait,
    available: Count,
    read: Read,
    write: Write,
    recover: Recover,
    drain: Simple,
    close: Simple,
    describe: Describe,
    /// Keeps the functions where they are.
    _library: libloading::Library,
}

/// What chooses how a device records, one by one.
struct Choices {
    allocate: Allocate,
    free: Free,
    any: WithDevice,
    resampling: ChooseNumber,
    access: ChooseKind,
    format: ChooseKind,
    channels: ChooseNumber,
    rate: ChooseExactly,
    period: ChooseNear,
    buffer: ChooseNear,
    apply: WithDevice,
}

/// A device that is open. ALSA's handles may go from thread to thread, one at a time.
struct Pcm {
    handle: NonNull<c_void>,
    channels: usize,
    library: Arc<Library>,
}

// SAFETY: alsa-lib ties a handle to no thread, and `&mut self` lets one thread use it at a time.
unsafe impl Send for Pcm {}

/// A device that records.
pub(super) struct Recording(Pcm);

/// A device that plays.
pub(super) struct Playing(Pcm);

impl Library {
    /// Opens the library.
    ///
    /// # Errors
    /// Names the library that is not there, or the function that it lacks, and the deed.
    pub(super) fn load(path: &Path) -> Result<Self> {
        let told = |error: libloading::Error| {
            use std::error::Error as _;
            let reason = error
                .source()
                .map_or_else(|| error.to_string(), ToString::to_string);
            Error::new(format!(
                "{reason}; install ALSA's library (libasound2), or name it as `hardware.nao.alsa` ({} is named now), or go \
                 without by --no-sound",
                path.display()
            ))
        };
        // SAFETY: a library may run anything when it is opened; which one it is is the choice of whoever runs the robot,
        // and ALSA's does nothing that matters here.
        let library = unsafe { libloading::Library::new(path) }.map_err(told)?;
        macro_rules! function {
            ($name:literal, $type:ty) => {
                // SAFETY: ALSA's headers give this function this type.
                *unsafe { library.get::<$type>($name) }.map_err(told)?
            };
        }
        Ok(Self {
            open: function!(b"snd_pcm_open\0", Open),
            set_parameters: function!(b"snd_pcm_set_params\0", SetParameters),
            choices: Choices {
                allocate: function!(b"snd_pcm_hw_params_malloc\0", Allocate),
                free: function!(b"snd_pcm_hw_params_free\0", Free),
                any: function!(b"snd_pcm_hw_params_any\0", WithDevice),
                resampling: function!(b"snd_pcm_hw_params_set_rate_resample\0", ChooseNumber),
                access: function!(b"snd_pcm_hw_params_set_access\0", ChooseKind),
                format: function!(b"snd_pcm_hw_params_set_format\0", ChooseKind),
                channels: function!(b"snd_pcm_hw_params_set_channels\0", ChooseNumber),
                rate: function!(b"snd_pcm_hw_params_set_rate\0", ChooseExactly),
                period: function!(b"snd_pcm_hw_params_set_period_time_near\0", ChooseNear),
                buffer: function!(b"snd_pcm_hw_params_set_buffer_time_near\0", ChooseNear),
                apply: function!(b"snd_pcm_hw_params\0", WithDevice),
            },
            state: function!(b"snd_pcm_state\0", Simple),
            start: function!(b"snd_pcm_start\0", Simple),
            wait: function!(b"snd_pcm_wait\0", Wait),
            available: function!(b"snd_pcm_avail\0", Count),
            read: function!(b"snd_pcm_readi\0", Read),
            write: function!(b"snd_pcm_writei\0", Write),
            recover: function!(b"snd_pcm_recover\0", Recover),
            drain: function!(b"snd_pcm_drain\0", Simple),
            close: function!(b"snd_pcm_close\0", Simple),
            describe: function!(b"snd_strerror\0", Describe),
            _library: library,
        })
    }

    /// Begins to record interleaved floats.
    ///
    /// # Errors
    /// What ALSA says.
    pub(super) fn record(
        self: &Arc<Self>,
        device: &str,
        channels: usize,
        rate: u32,
    ) -> Result<Recording> {
        let pcm = self.open(device, CAPTURE, channels)?;
        self.choose(&pcm, rate)?;
        // SAFETY: the handle is open.
        let started = unsafe { (self.start)(pcm.handle.as_ptr()) };
        self.check(c_long::from(started))?;
        Ok(Recording(pcm))
    }

    /// Makes a device ready to play interleaved floats.
    ///
    /// # Errors
    /// What ALSA says.
    pub(super) fn play(
        self: &Arc<Self>,
        device: &str,
        channels: usize,
        rate: u32,
    ) -> Result<Playing> {
        let pcm = self.open(device, PLAYBACK, channels)?;
        let may_resample = 1;
        // SAFETY: the handle is open.
        let set = unsafe {
            (self.set_parameters)(
                pcm.handle.as_ptr(),
                FLOAT,
                INTERLEAVED,
                channels as c_uint,
                rate,
                may_resample,
                LATENCY,
            )
        };
        self.check(c_long::from(set))?;
        Ok(Playing(pcm))
    }

    fn open(self: &Arc<Self>, device: &str, direction: c_int, channels: usize) -> Result<Pcm> {
        let name = CString::new(device)?;
        let mut handle = std::ptr::null_mut();
        // SAFETY: `handle` can be written, `name` ends with a zero; both live until after the call.
        let opened = unsafe { (self.open)(&raw mut handle, name.as_ptr(), direction, 0) };
        self.check(c_long::from(opened))?;
        let handle = NonNull::new(handle).ok_or_else(|| Error::new("ALSA gave no handle"))?;
        Ok(Pcm {
            handle,
            channels,
            library: Arc::clone(self),
        })
    }

    /// Interleaved floats at this rate, as often as [`PERIOD`] says; which times these become is the device's.
    fn choose(&self, pcm: &Pcm, rate: u32) -> Result<()> {
        let mut parameters = std::ptr::null_mut();
        // SAFETY: `parameters` can be written.
        let allocated = unsafe { (self.choices.allocate)(&raw mut parameters) };
        self.check(c_long::from(allocated))?;
        let chosen = self.choose_in(parameters, pcm, rate);
        // SAFETY: they were allocated above, and nobody uses them after this.
        unsafe { (self.choices.free)(parameters) };
        chosen
    }

    fn choose_in(&self, parameters: *mut c_void, pcm: &Pcm, rate: u32) -> Result<()> {
        let Choices {
            any,
            resampling,
            access,
            format,
            channels,
            rate: exactly,
            period,
            buffer,
            apply,
            ..
        } = self.choices;
        let handle = pcm.handle.as_ptr();
        let is_allowed = 1;
        let (mut every, mut kept, mut direction) = (PERIOD, LATENCY, 0);
        let check = |answer: c_int| self.check(c_long::from(answer));
        // SAFETY: the handle is open, `parameters` are allocated, and `any` gives them their first values; what is pointed to
        // can be written and lives until after the calls.
        unsafe {
            check(any(handle, parameters))?;
            check(resampling(handle, parameters, is_allowed))?;
            check(access(handle, parameters, INTERLEAVED))?;
            check(format(handle, parameters, FLOAT))?;
            check(channels(handle, parameters, pcm.channels as c_uint))?;
            check(exactly(handle, parameters, rate, 0))?;
            check(period(
                handle,
                parameters,
                &raw mut every,
                &raw mut direction,
            ))?;
            direction = 0;
            check(buffer(
                handle,
                parameters,
                &raw mut kept,
                &raw mut direction,
            ))?;
            check(apply(handle, parameters))?;
        }
        Ok(())
    }

    /// A count, or what ALSA says.
    fn check(&self, answer: c_long) -> Result<usize> {
        usize::try_from(answer).map_err(|_| {
            let number = c_int::try_from(answer).unwrap_or(c_int::MIN);
            // SAFETY: this function takes any number and gives a text that ends with a zero and is never freed.
            let text = unsafe { CStr::from_ptr((self.describe)(number)) };
            Error::new(format!("ALSA says: {}", text.to_string_lossy()))
        })
    }
}

impl Pcm {
    /// A count, or 0 after trouble that ALSA mends: an overrun, an underrun, a suspend.
    fn count(&mut self, answer: c_long) -> Result<usize> {
        if answer >= 0 {
            return self.library.check(answer);
        }
        let number = c_int::try_from(answer).unwrap_or(c_int::MIN);
        let is_silent = 1;
        // SAFETY: the handle is open.
        let mended = unsafe { (self.library.recover)(self.handle.as_ptr(), number, is_silent) };
        self.library.check(c_long::from(mended)).map(|_| 0)
    }
}

impl Recording {
    /// Takes what has come, waiting for at most `patience`; how many samples of each channel.
    ///
    /// # Errors
    /// What ALSA says; then the device has to be opened again.
    pub(super) fn read(&mut self, samples: &mut [f32], patience: Duration) -> Result<usize> {
        let pcm = &mut self.0;
        let milliseconds = c_int::try_from(patience.as_millis()).unwrap_or(c_int::MAX);
        // SAFETY: the handle is open.
        let waited = unsafe { (pcm.library.wait)(pcm.handle.as_ptr(), milliseconds) };
        if waited <= 0 {
            return self.count(c_long::from(waited));
        }
        let frames = (samples.len() / pcm.channels) as c_ulong;
        // SAFETY: the handle is open and was set to interleaved floats of so many channels: at most `frames` times that
        // many are written, which `samples` has.
        let read =
            unsafe { (pcm.library.read)(pcm.handle.as_ptr(), samples.as_mut_ptr().cast(), frames) };
        self.count(read)
    }

    /// How many samples of each channel have come since those that were read last.
    pub(super) fn unread(&mut self) -> usize {
        let pcm = &mut self.0;
        // SAFETY: the handle is open.
        let available = unsafe { (pcm.library.available)(pcm.handle.as_ptr()) };
        // Whatever is wrong with the device, the next read finds it.
        usize::try_from(available).unwrap_or(0)
    }

    /// As [`Pcm::count`]. What ALSA has mended is ready and hears nothing before it is started; after a suspend it may run already.
    fn count(&mut self, answer: c_long) -> Result<usize> {
        let pcm = &mut self.0;
        let count = pcm.count(answer)?;
        // SAFETY: the handle is open.
        if answer < 0 && unsafe { (pcm.library.state)(pcm.handle.as_ptr()) } == PREPARED {
            // SAFETY: as above.
            let started = unsafe { (pcm.library.start)(pcm.handle.as_ptr()) };
            pcm.library.check(c_long::from(started))?;
        }
        Ok(count)
    }
}

impl Playing {
    /// Plays; waits while the device has no room. How many samples of each channel it took.
    ///
    /// # Errors
    /// What ALSA says; then the device has to be opened again.
    pub(super) fn write(&mut self, samples: &[f32]) -> Result<usize> {
        let pcm = &mut self.0;
        let frames = (samples.len() / pcm.channels) as c_ulong;
        // SAFETY: the handle is open and was set to interleaved floats of so many channels: at most `frames` times that
        // many are read, which `samples` has.
        let written =
            unsafe { (pcm.library.write)(pcm.handle.as_ptr(), samples.as_ptr().cast(), frames) };
        pcm.count(written)
    }

    /// Waits until everything has been heard.
    pub(super) fn finish(&mut self) {
        // SAFETY: the handle is open. What it answers changes nothing: the device is closed next.
        unsafe { (self.0.library.drain)(self.0.handle.as_ptr()) };
    }
}

impl Drop for Pcm {
    fn drop(&mut self) {
        // SAFETY: the handle is open, and nobody uses it after this.
        unsafe { (self.library.close)(self.handle.as_ptr()) };
    }
}
