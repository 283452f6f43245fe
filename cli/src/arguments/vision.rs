//! What may stand behind `hulkgen vision`.

use camino::Utf8PathBuf;
use clap::Args;

use super::{Build, TextOrJson};

/// Run the vision nodes of the robot on photographs
///
/// Every image is one cycle of an instance, with parameters as they would be on the robot and with the pose of the camera that
/// is given. Text says how many there are of each output; JSON has one line for each image, with all main outputs.
/// The hardware of the target has to have the tool `vision`, as that of the simulated NAO has.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit status: 0 every image was looked at, 1 one cannot be read or the robot cannot be built, 2 wrong usage,
             130 Ctrl-C.

Examples:
  hulkgen vision photograph.png --camera-pose 0.5,0.3 --instance VisionTop
  hulkgen vision *.png --camera-pose 0,0,0.5,0.02,0.3,0 --format json
  hulkgen vision raw.png --ycbcr --camera-pose 0.45,0.7 --instance VisionBottom --overlay seen")]
pub struct Vision {
    /// PNG files
    #[arg(required = true, value_name = "IMAGE")]
    pub images: Vec<Utf8PathBuf>,
    /// Where the camera was over the ground: height and pitch (down is positive), height, pitch and roll, or x, y, z, roll,
    /// pitch and yaw; m and rad, joined by commas
    #[arg(long, value_name = "POSE", value_parser = pose, allow_hyphen_values = true)]
    pub camera_pose: String,
    /// The instance that looks at them
    #[arg(long, value_name = "NAME", default_value = "VisionTop")]
    pub instance: String,
    /// The files hold Y, Cb and Cr in place of red, green and blue
    #[arg(long)]
    pub ycbcr: bool,
    /// Folder for images with what was found drawn into them
    #[arg(long, value_name = "FOLDER")]
    pub overlay: Option<Utf8PathBuf>,
    /// The target [default: the first of hulk.toml]
    #[arg(long, value_name = "NAME")]
    pub target: Option<String>,
    /// Form of the answer
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
    /// Set a parameter, for example `ball_detection.least_radius=3`; may be repeated
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    #[command(flatten)]
    pub build: Build,
}

/// 2, 3 or 6 finite numbers.
fn pose(text: &str) -> Result<String, String> {
    let numbers: Option<Vec<f64>> = text
        .split(',')
        .map(|part| {
            part.trim()
                .parse()
                .ok()
                .filter(|number: &f64| number.is_finite())
        })
        .collect();
    match numbers.as_deref().map(<[f64]>::len) {
        Some(2 | 3 | 6) => Ok(text.to_owned()),
        _ => Err("expected 2, 3 or 6 numbers joined by commas, for example `0.5,0.3`".to_owned()),
    }
}
