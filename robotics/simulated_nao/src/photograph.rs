//! The tool `vision`: photographs in place of what the cameras would see, for the nodes of one instance of Vision.

mod arguments;
mod calibration;
mod file;
mod overlay;

use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use framework::tool::{Bench, Trial};
use framework::{Clock, Error, Event, HardwareContext, Leased, Result, Timestamp};
use types::camera::{CameraMatrix, CameraPosition};
use types::image::YuyvImage;

use self::arguments::Arguments;
use crate::hardware::Hardware;

/// As parameters call it.
pub(crate) const TOOL: &str = "vision";
/// When it was taken, as far as the nodes know.
const TAKEN_AT: Timestamp = Timestamp::from_nanos(100_000_000);

/// An image that a camera gives once.
#[derive(Debug)]
pub(crate) struct Photograph {
    instance: &'static str,
    camera: CameraPosition,
    image: Leased<YuyvImage>,
    is_told: AtomicBool,
}

impl Photograph {
    /// The only event of a world of photographs.
    pub(crate) fn event(&self) -> Option<Event> {
        // One thread asks; the order among others does not matter.
        (!self.is_told.swap(true, Ordering::Relaxed)).then_some(Event {
            at: TAKEN_AT,
            instance: self.instance,
        })
    }

    /// Gives the image, if it is of that camera.
    pub(crate) fn read(&self, camera: CameraPosition) -> Result<(Timestamp, Leased<YuyvImage>)> {
        if camera != self.camera {
            return Err(Error::new(format!(
                "the photograph is of camera {:?}",
                self.camera
            )));
        }
        Ok((TAKEN_AT, self.image.clone()))
    }
}

/// Lets the nodes look at every image of the command line.
///
/// # Errors
/// Where an option or an image cannot be understood, or the nodes fail.
pub(crate) fn look(
    context: &HardwareContext,
    bench: &mut dyn Bench<Hardware>,
    output: &mut dyn Write,
) -> Result<()> {
    let arguments = Arguments::read(&context.options)?;
    for path in &arguments.images {
        let image = file::read(path, arguments.is_ycbcr)?;
        let size = [image.width as f32, image.height as f32];
        let drawing = arguments
            .overlay
            .as_ref()
            .map(|folder| (folder, file::Rgb::of(&image)));
        let photograph = Photograph {
            instance: arguments.instance,
            camera: arguments.camera,
            image: Leased::of(image),
            is_told: AtomicBool::new(false),
        };
        let clock = Clock::stepped();
        let context = HardwareContext {
            options: Vec::new(),
            clock: clock.clone(),
            ..context.clone()
        };
        let hardware = Hardware::of_photograph(photograph, context)?;
        let named = |error: Error| error.context(path.display().to_string());
        let matrix = CameraMatrix {
            ground_to_camera: arguments.camera_to_ground.inverse(),
            intrinsics: calibration::of(bench, &hardware, arguments.camera, size)
                .map_err(named)?
                .intrinsics(),
        };
        let trial = Trial {
            hardware: Arc::new(hardware),
            clock,
            instance: arguments.instance,
            injected: vec![("camera_matrix", serde_json::to_value(Some(matrix))?)],
            left_out: &["image", "image_segments", "camera_matrix"],
        };
        let seen = bench.try_out(&trial).map_err(named)?;
        if arguments.is_json {
            let line =
                serde_json::json!({ "image": path, "instance": arguments.instance, "seen": seen });
            writeln!(output, "{line}")?;
        } else {
            write!(output, "{}", text(path, &seen))?;
        }
        if let Some((folder, mut colors)) = drawing {
            overlay::draw(&seen, &matrix, &mut colors)?;
            file::write(folder, path, &colors)?;
        }
    }
    Ok(())
}

/// One line for the image, and one for each thing in it.
fn text(
    path: &std::path::Path,
    seen: &std::collections::BTreeMap<String, serde_json::Value>,
) -> String {
    use std::fmt::Write as _;

    let mut text = format!("{}\n", path.display());
    for (output, value) in seen {
        // Writing to a text cannot fail.
        let _ = match value {
            serde_json::Value::Array(list) => {
                let _ = writeln!(text, "  {output}: {}", list.len());
                list.iter()
                    .try_for_each(|entry| writeln!(text, "    {entry}"))
            }
            serde_json::Value::Null => writeln!(text, "  {output}: none"),
            value => writeln!(text, "  {output}: {value}"),
        };
    }
    text
}
