//! The command line of the tool.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::{Path, PathBuf};

use framework::{Error, Result};
use kinematics::cameras::optical_to_camera;
use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use types::camera::CameraPosition;

use super::file;

/// What is wanted.
#[derive(Debug, PartialEq)]
pub(super) struct Arguments {
    pub(super) images: Vec<PathBuf>,
    pub(super) instance: &'static str,
    pub(super) camera: CameraPosition,
    /// From the optical frame to the ground frame.
    pub(super) camera_to_ground: Isometry3<f32>,
    pub(super) is_ycbcr: bool,
    pub(super) is_json: bool,
    pub(super) overlay: Option<PathBuf>,
}

impl Arguments {
    /// # Errors
    /// Names the option that is unknown, missing or cannot be read, and images whose overlays would be one file.
    pub(super) fn read(options: &[String]) -> Result<Self> {
        let mut camera_to_ground = None;
        let mut arguments = Self {
            images: Vec::new(),
            instance: "VisionTop",
            camera: CameraPosition::Top,
            camera_to_ground: Isometry3::identity(),
            is_ycbcr: false,
            is_json: false,
            overlay: None,
        };
        let mut options = options.iter();
        while let Some(option) = options.next() {
            let mut value = || {
                let missing = || Error::new(format!("option `{option}` of `vision` needs a value"));
                options.next().ok_or_else(missing)
            };
            match option.as_str() {
                "--camera-pose" => camera_to_ground = Some(pose(value()?)?),
                "--instance" => (arguments.instance, arguments.camera) = instance(value()?)?,
                "--ycbcr" => arguments.is_ycbcr = true,
                "--json" => arguments.is_json = true,
                "--overlay" => arguments.overlay = Some(value()?.into()),
                _ if option.starts_with("--") => {
                    return Err(Error::new(format!(
                        "unknown option `{option}` of `vision`; it knows --camera-pose POSE, --instance NAME, --ycbcr, \
                         --json, --overlay FOLDER"
                    )));
                }
                _ => arguments.images.push(option.into()),
            }
        }
        arguments.camera_to_ground = camera_to_ground
            .ok_or_else(|| Error::new("`vision` needs `--camera-pose`, for example `0.5,0.3`"))?;
        if arguments.images.is_empty() {
            return Err(Error::new("`vision` needs an image"));
        }
        if let Some(folder) = &arguments.overlay {
            check_names(&arguments.images, folder)?;
        }
        Ok(arguments)
    }
}

/// The images with their overlays: of two with one name the later would be written over the other.
fn check_names(images: &[PathBuf], folder: &Path) -> Result<()> {
    let mut overlays = BTreeMap::new();
    for image in images {
        let overlay = file::overlay_of(folder, image);
        match overlays.entry(overlay) {
            Entry::Vacant(entry) => _ = entry.insert(image),
            Entry::Occupied(entry) => {
                return Err(Error::new(format!(
                    "the overlays of `{}` and `{}` would both be `{}`; look at them one after the other, each with a folder \
                     of its own behind `--overlay`",
                    entry.get().display(),
                    image.display(),
                    entry.key().display()
                )));
            }
        }
    }
    Ok(())
}

fn instance(name: &str) -> Result<(&'static str, CameraPosition)> {
    match name {
        "VisionTop" => Ok(("VisionTop", CameraPosition::Top)),
        "VisionBottom" => Ok(("VisionBottom", CameraPosition::Bottom)),
        _ => Err(Error::new(format!(
            "`{name}` looks at no images; `VisionTop` and `VisionBottom` do"
        ))),
    }
}

/// `Z,PITCH`, `Z,PITCH,ROLL` or `X,Y,Z,ROLL,PITCH,YAW` of a camera over the ground, its x along the optical axis.
fn pose(text: &str) -> Result<Isometry3<f32>> {
    let wrong = |why: &str| Error::new(format!("`--camera-pose {text}`: {why}"));
    let numbers: Option<Vec<f32>> = text
        .split(',')
        .map(|part| {
            part.trim()
                .parse()
                .ok()
                .filter(|number: &f32| number.is_finite())
        })
        .collect();
    let [x, y, z, roll, pitch, yaw] = match numbers.as_deref() {
        Some([z, pitch]) => [0.0, 0.0, *z, 0.0, *pitch, 0.0],
        Some([z, pitch, roll]) => [0.0, 0.0, *z, *roll, *pitch, 0.0],
        Some([x, y, z, roll, pitch, yaw]) => [*x, *y, *z, *roll, *pitch, *yaw],
        _ => {
            return Err(wrong(
                "expected height and pitch, height, pitch and roll, or x, y, z, roll, pitch and yaw in m and rad",
            ));
        }
    };
    if !(0.01..=10.0).contains(&z) {
        return Err(wrong("the camera is from 0.01 m to 10 m above the ground"));
    }
    let rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw) * optical_to_camera();
    Ok(Isometry3::from_parts(Translation3::new(x, y, z), rotation))
}

#[cfg(test)]
mod tests {
    use framework::math;
    use nalgebra::{Point3, Vector3};

    use super::*;

    fn read(line: &str) -> Result<Arguments> {
        let words: Vec<_> = line.split(' ').map(str::to_owned).collect();
        Arguments::read(&words)
    }

    #[test]
    fn a_camera_that_looks_down_looks_ahead_and_down() {
        let arguments = read("--camera-pose 0.5,0.3 a.png --instance VisionBottom").unwrap();
        let ahead = arguments.camera_to_ground * Vector3::z();
        assert!(
            (ahead - Vector3::new(math::cos(0.3_f32), 0.0, -math::sin(0.3_f32))).norm() < 1e-5,
            "{ahead}"
        );
        let place = arguments.camera_to_ground * Point3::origin();
        assert!((place - Point3::new(0.0, 0.0, 0.5)).norm() < 1e-6);
        assert_eq!(arguments.camera, CameraPosition::Bottom);
        let whole = read("--camera-pose 0,0,0.5,0,0.3,0 a.png").unwrap();
        assert_eq!(whole.camera_to_ground, arguments.camera_to_ground);
    }

    #[test]
    fn images_with_one_name_are_refused_where_their_overlays_would_be_one_file() {
        let line = "--camera-pose 0.5,0.3 half1/0001.png half1/0002.png half2/0001.png";
        read(line).unwrap();
        let message = read(&format!("{line} --overlay seen"))
            .unwrap_err()
            .to_string();
        for part in [
            "`half1/0001.png`",
            "`half2/0001.png`",
            "`seen/0001.seen.png`",
        ] {
            assert!(message.contains(part), "{message}");
        }
        read("--camera-pose 0.5,0.3 half1/0001.png half1/0002.png --overlay seen").unwrap();
    }

    #[test]
    fn what_cannot_be_understood_is_named() {
        for (line, expected) in [
            ("a.png", "needs `--camera-pose`"),
            ("--camera-pose 0.5,0.3", "needs an image"),
            ("--camera-pose 0.5 a.png", "`--camera-pose 0.5`"),
            ("--camera-pose 0.5,inf a.png", "`--camera-pose 0.5,inf`"),
            ("--camera-pose -1,0.3 a.png", "above the ground"),
            (
                "--camera-pose 0.5,0.3 --instance Control a.png",
                "`Control` looks at no images",
            ),
            ("--colour a.png", "unknown option `--colour`"),
            ("--overlay", "`--overlay` of `vision` needs a value"),
        ] {
            let message = read(line).unwrap_err().to_string();
            assert!(message.contains(expected), "{message}");
        }
    }
}
