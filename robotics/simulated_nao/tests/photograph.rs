//! The tool `vision` on files: what it finds in an image of the simulated cameras is what is there.

#[path = "support/scene.rs"]
#[expect(dead_code, reason = "photographs need a part of it")]
mod scene;

use std::fs::File;
use std::path::{Path, PathBuf};

use framework::Target;
use framework::launch::{self, nobody};
use nalgebra::{Point2, Point3};
use nao_runtime::runtime;
use scene::Look;
use serde_json::Value;
use simulated_nao::Hardware;
use simulated_nao::camera::{Exposure, render};
use simulated_nao::field::Field;
use simulated_nao::ground_truth::ImageTruth;
use types::camera::CameraPosition;
use types::image::YuyvImage;

const TARGET: Target = Target {
    robot: "nao",
    name: "simulated",
    location: Some("simulated"),
    ..framework::testing::TARGET
};

/// A ball 1.2 m ahead on the field of the other half.
fn exposure() -> (Exposure, Point2<f32>) {
    let look = Look {
        robot: [1.0, 0.5, 0.0],
        yaw: 0.0,
        pitch: 0.1,
        camera: CameraPosition::Top,
    };
    let exposure = look.expose(0, Some(Point3::new(2.2, 0.6, 0.05)));
    (exposure, Point2::new(1.2, 0.1))
}

/// Its image as a file, as colours or as what YCbCr calls them.
fn photograph(folder: &Path, is_ycbcr: bool) -> PathBuf {
    let mut image = YuyvImage::default();
    render(&exposure().0, &Field::default(), &mut image);
    let places =
        (0..image.height).flat_map(|row| (0..image.width).map(move |column| (column, row)));
    let bytes = places.flat_map(|(column, row)| {
        let color = image.yuv(column, row).unwrap();
        if is_ycbcr {
            [color.y, color.u, color.v]
        } else {
            color.to_rgb()
        }
    });
    let path = folder.join(if is_ycbcr { "ycbcr.png" } else { "rgb.png" });
    let mut encoder = png::Encoder::new(File::create(&path).unwrap(), image.width, image.height);
    encoder.set_color(png::ColorType::Rgb);
    let bytes: Vec<u8> = bytes.collect();
    encoder
        .write_header()
        .unwrap()
        .write_image_data(&bytes)
        .unwrap();
    path
}

/// `X,Y,Z,ROLL,PITCH,YAW` of the camera.
fn pose() -> String {
    let camera_to_ground = ImageTruth::from(&exposure().0)
        .camera_matrix
        .ground_to_camera
        .inverse();
    let optical_to_camera = kinematics::cameras::optical_to_camera::<f32>();
    let (roll, pitch, yaw) =
        (camera_to_ground.rotation * optical_to_camera.inverse()).euler_angles();
    let place = camera_to_ground.translation;
    format!("{},{},{},{roll},{pitch},{yaw}", place.x, place.y, place.z)
}

/// Exit status, and what was said.
fn vision(arguments: &[&str]) -> (u8, String) {
    vision_with(&[], arguments)
}

/// Likewise, with other parameters.
fn vision_with(set: &[&str], arguments: &[&str]) -> (u8, String) {
    let parameters = concat!(env!("CARGO_MANIFEST_DIR"), "/../parameters");
    let program = ["--tool", "vision", "--parameters", parameters];
    let set = set.iter().flat_map(|assignment| ["--set", assignment]);
    let arguments = program
        .into_iter()
        .chain(set)
        .chain(["--"])
        .chain(arguments.iter().copied())
        .map(Into::into);
    let mut output = Vec::new();
    let status =
        launch::run::<Hardware, _>(TARGET, arguments, &mut output, runtime::create, nobody);
    (status, String::from_utf8(output).unwrap())
}

#[test]
fn a_ball_is_found_where_it_is_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let overlay = folder.path().join("seen");
    let pose = pose();
    for is_ycbcr in [false, true] {
        let path = photograph(folder.path(), is_ycbcr);
        let mut arguments = vec![
            path.to_str().unwrap(),
            "--camera-pose",
            &pose,
            "--json",
            "--overlay",
        ];
        arguments.push(overlay.to_str().unwrap());
        arguments.extend(is_ycbcr.then_some("--ycbcr"));
        let (status, output) = vision(&arguments);
        assert_eq!(status, 0, "{output}");
        let answer: Value = serde_json::from_str(&output).unwrap();
        let balls = answer["seen"]["balls"].as_array().unwrap();
        assert_eq!(balls.len(), 1, "{answer}");
        let position: Point2<f32> = serde_json::from_value(balls[0]["position"].clone()).unwrap();
        let off = nalgebra::distance(&position, &exposure().1);
        assert!(off < 0.05 + 0.05 * 1.2, "{position}");
        assert!(
            !answer["seen"]["lines"].as_array().unwrap().is_empty(),
            "{answer}"
        );
        assert!(answer["seen"].get("image").is_none());
    }
    let drawn = File::open(overlay.join("rgb.seen.png")).unwrap();
    let reader = png::Decoder::new(std::io::BufReader::new(drawn))
        .read_info()
        .unwrap();
    assert_eq!((reader.info().width, reader.info().height), (640, 480));
}

/// Where a ball lies, m.
fn ball(output: &str) -> Point2<f32> {
    let answer: Value = serde_json::from_str(output).unwrap();
    serde_json::from_value(answer["seen"]["balls"][0]["position"].clone()).unwrap()
}

#[test]
fn the_calibration_is_that_of_the_parameters() {
    let folder = tempfile::tempdir().unwrap();
    let path = photograph(folder.path(), false);
    let path = path.to_str().unwrap();
    let pose = pose();
    let arguments = [path, "--camera-pose", &pose, "--json"];
    let usual = ball(&vision(&arguments).1);
    // The optical axis meets the image further to the right: all that is seen lies further to the left.
    let (status, output) = vision_with(&["cameras.top.center_x=0.55"], &arguments);
    assert_eq!(status, 0, "{output}");
    let moved = 0.05 / 0.95 * usual.x;
    let off = ball(&output).y - usual.y - moved;
    assert!(off.abs() < 0.02, "{usual} and {output}");
    // The other camera's calibration says nothing.
    let (status, output) = vision_with(&["cameras.bottom.center_x=0.55"], &arguments);
    assert_eq!((status, ball(&output)), (0, usual));
    for wrong in ["cameras.top.height=360.0", "cameras.top.focal_x=0.0"] {
        assert_eq!(vision_with(&[wrong], &arguments).0, 1, "{wrong}");
    }
}

#[test]
fn text_says_how_many_there_are() {
    let folder = tempfile::tempdir().unwrap();
    let path = photograph(folder.path(), false);
    let (status, output) = vision(&[path.to_str().unwrap(), "--camera-pose", &pose()]);
    assert_eq!(status, 0);
    assert!(
        output.contains("\n  balls: 1\n") && output.contains("penalty_mark: "),
        "{output}"
    );
}

#[test]
fn what_is_no_image_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cut.png");
    let whole = std::fs::read(photograph(folder.path(), false)).unwrap();
    for bytes in [&b"no image"[..], &whole[..whole.len() / 2], b""] {
        std::fs::write(&path, bytes).unwrap();
        assert_eq!(
            vision(&[path.to_str().unwrap(), "--camera-pose", "0.5,0.3"]).0,
            1
        );
    }
    assert_eq!(vision(&["missing.png", "--camera-pose", "0.5,0.3"]).0, 1);
    assert_eq!(vision(&[path.to_str().unwrap()]).0, 1);
}
