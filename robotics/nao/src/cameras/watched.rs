//! Keeps a camera alive: opens it, notices when it is silent or gone, resets it, opens it again.

use std::io;
use std::time::{Duration, Instant};

use framework::{Clock, NoEvent, Result, Stop, Timestamp, blocking};

/// A camera gives 30 images a second; after so much silence it is reset.
pub(super) const SILENCE: Duration = Duration::from_secs(1);
/// How long one read may block: a stop is noticed after at most this time.
const PATIENCE: Duration = Duration::from_millis(50);
/// Between two resets of a camera that stays away.
const BACK_OFF: Duration = Duration::from_secs(5);

/// A camera that streams.
pub(super) trait Eye {
    /// Waits for at most `patience` and exchanges the newest image with `image`; its age. `None` where none came.
    fn take(&mut self, patience: Duration, image: &mut Vec<u8>) -> io::Result<Option<Duration>>;
}

/// Makes a camera stream.
pub(super) trait Maker {
    type Eye: Eye;

    /// Opens the camera and lets it stream.
    fn open(&self) -> io::Result<Self::Eye>;

    /// Switches the camera off and on; may take seconds, but no longer than 100 ms after a stop.
    fn reset(&self, stop: &Stop) -> Result<()>;

    /// What it is called, for messages.
    fn name(&self) -> String;
}

/// A camera, and how it fares.
pub(super) struct Watched<M: Maker> {
    maker: M,
    eye: Option<M::Eye>,
    last_image: Instant,
    next_reset: Instant,
}

impl<M: Maker> Watched<M> {
    pub(super) fn new(maker: M) -> Self {
        let now = Instant::now();
        Self {
            maker,
            eye: None,
            last_image: now,
            next_reset: now,
        }
    }

    /// Waits for the next image; when it was taken.
    ///
    /// # Errors
    /// `Stopped` within 100 ms of a stop; `NoEvent` where no image came, with what was done about it: ask again.
    pub(super) fn read(
        &mut self,
        image: &mut Vec<u8>,
        clock: &Clock,
        stop: &Stop,
    ) -> Result<Timestamp> {
        loop {
            stop.check()?;
            let Some(eye) = &mut self.eye else {
                self.open(stop)?;
                continue;
            };
            match blocking(|| eye.take(PATIENCE, image)) {
                Ok(Some(age)) => {
                    self.last_image = Instant::now();
                    let now = clock.now().as_nanos();
                    let age = u64::try_from(age.as_nanos()).unwrap_or(u64::MAX);
                    return Ok(Timestamp::from_nanos(now.saturating_sub(age)));
                }
                Ok(None) if self.last_image.elapsed() < SILENCE => {}
                Ok(None) => return Err(self.recover("is silent", stop)),
                Err(error) => return Err(self.recover(&error.to_string(), stop)),
            }
        }
    }

    fn open(&mut self, stop: &Stop) -> Result<()> {
        match self.maker.open() {
            Ok(eye) => {
                self.eye = Some(eye);
                self.last_image = Instant::now();
                Ok(())
            }
            Err(error) => Err(self.recover(&error.to_string(), stop)),
        }
    }

    /// Resets the camera, unless that was done a moment ago; what to tell.
    fn recover(&mut self, trouble: &str, stop: &Stop) -> framework::Error {
        self.eye = None;
        let name = self.maker.name();
        let left = self.next_reset.saturating_duration_since(Instant::now());
        if !left.is_zero() {
            // Not the whole time at once: it may come back by itself.
            return match blocking(|| stop.wait(left.min(SILENCE))) {
                Ok(()) => NoEvent(format!("{name}: {trouble}")).into(),
                Err(stopped) => stopped.into(),
            };
        }
        let reset = blocking(|| self.maker.reset(stop));
        self.next_reset = Instant::now() + BACK_OFF;
        match reset {
            Ok(()) => NoEvent(format!("{name}: {trouble}; it was reset")).into(),
            Err(error) if error.is_stopped() => error,
            Err(error) => NoEvent(format!("{name}: {trouble}; it cannot be reset: {error}")).into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::{Cell, RefCell};
    use std::collections::VecDeque;

    use framework::Error;

    use super::*;

    /// What an emulated camera does when it is asked.
    #[derive(Clone, Copy)]
    enum Deed {
        Image(u8),
        Silence,
        Gone,
    }

    #[derive(Default)]
    struct Emulated {
        deeds: RefCell<VecDeque<Deed>>,
        opened: Cell<u32>,
        resets: Cell<u32>,
        is_missing: Cell<bool>,
    }

    struct EmulatedEye(std::rc::Rc<Emulated>);

    impl Eye for EmulatedEye {
        fn take(
            &mut self,
            patience: Duration,
            image: &mut Vec<u8>,
        ) -> io::Result<Option<Duration>> {
            match self.0.deeds.borrow_mut().pop_front() {
                Some(Deed::Image(byte)) => {
                    *image = vec![byte];
                    Ok(Some(Duration::from_millis(40)))
                }
                Some(Deed::Gone) => Err(io::Error::other("unplugged")),
                Some(Deed::Silence) | None => {
                    std::thread::sleep(patience);
                    Ok(None)
                }
            }
        }
    }

    impl Maker for std::rc::Rc<Emulated> {
        type Eye = EmulatedEye;

        fn open(&self) -> io::Result<EmulatedEye> {
            if self.is_missing.get() {
                return Err(io::Error::other("no such device"));
            }
            self.opened.set(self.opened.get() + 1);
            Ok(EmulatedEye(self.clone()))
        }

        fn reset(&self, _stop: &Stop) -> Result<()> {
            self.resets.set(self.resets.get() + 1);
            if self.is_missing.replace(false) {
                return Err(Error::new("no bus"));
            }
            Ok(())
        }

        fn name(&self) -> String {
            "emulated".to_owned()
        }
    }

    fn camera(deeds: &[Deed]) -> (std::rc::Rc<Emulated>, Watched<std::rc::Rc<Emulated>>) {
        let emulated = std::rc::Rc::new(Emulated::default());
        emulated.deeds.borrow_mut().extend(deeds);
        (emulated.clone(), Watched::new(emulated))
    }

    fn read(camera: &mut Watched<std::rc::Rc<Emulated>>) -> (Result<Timestamp>, Vec<u8>) {
        let mut image = Vec::new();
        let clock = Clock::wall();
        std::thread::sleep(Duration::from_millis(50));
        let before = clock.now();
        let read = camera.read(&mut image, &clock, &Stop::new());
        if let Ok(at) = &read {
            assert!(*at < clock.now() && *at + Duration::from_millis(40) >= before);
        }
        (read, image)
    }

    #[test]
    fn a_camera_that_is_gone_is_reset_and_opened_again() {
        let (emulated, mut camera) = camera(&[Deed::Image(1), Deed::Gone, Deed::Image(2)]);
        assert_eq!(read(&mut camera).1, [1]);
        let error = read(&mut camera).0.unwrap_err();
        assert!(error.is_no_event(), "{error}");
        assert_eq!(
            error.to_string(),
            "no event: emulated: unplugged; it was reset"
        );
        assert_eq!(read(&mut camera).1, [2]);
        assert_eq!((emulated.opened.get(), emulated.resets.get()), (2, 1));
    }

    #[test]
    fn a_silent_camera_is_reset_after_a_second() {
        let (emulated, mut camera) = camera(&[Deed::Image(1), Deed::Silence]);
        assert!(read(&mut camera).0.is_ok());
        let begun = Instant::now();
        let error = read(&mut camera).0.unwrap_err();
        assert!(begun.elapsed() >= SILENCE - PATIENCE);
        assert!(error.to_string().contains("is silent"), "{error}");
        assert_eq!(emulated.resets.get(), 1);
    }

    #[test]
    fn a_missing_camera_is_not_reset_all_the_time() {
        let (emulated, mut camera) = camera(&[Deed::Image(3)]);
        emulated.is_missing.set(true);
        let error = read(&mut camera).0.unwrap_err().to_string();
        assert_eq!(
            error,
            "no event: emulated: no such device; it cannot be reset: no bus"
        );
        emulated.is_missing.set(true);
        assert!(read(&mut camera).0.unwrap_err().is_no_event());
        assert_eq!(emulated.resets.get(), 1);
        emulated.is_missing.set(false);
        assert_eq!(read(&mut camera).1, [3]);
    }

    #[test]
    fn a_stop_is_noticed() {
        let (_emulated, mut camera) = camera(&[]);
        let stop = Stop::new();
        stop.request();
        let error = camera.read(&mut Vec::new(), &Clock::wall(), &stop);
        assert!(error.unwrap_err().is_stopped());
        assert!(PATIENCE < Duration::from_millis(100));
    }
}
