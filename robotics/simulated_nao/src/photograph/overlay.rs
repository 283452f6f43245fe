//! Draws what was seen into an image: border, lines, corners, centre circle, mark, balls and obstacles.

use std::collections::BTreeMap;
use std::f32::consts::TAU;

use framework::{Result, math};
use nalgebra::{Point2, Vector2};
use serde::de::DeserializeOwned;
use serde_json::Value;
use types::ball::BallCandidate;
use types::camera::CameraMatrix;
use types::field_features::{CenterCircle, FieldBorder, LineCorner, LineSegment, PenaltyMark};
use types::obstacles::ObstacleCandidate;

use super::file::Rgb;

const BORDER: [u8; 3] = [255, 255, 0];
const LINE: [u8; 3] = [255, 0, 0];
const CORNER: [u8; 3] = [0, 255, 255];
const MARK: [u8; 3] = [255, 0, 255];
const BALL: [u8; 3] = [255, 128, 0];
const OBSTACLE: [u8; 3] = [0, 128, 255];

/// Outputs that the robot does not have are left out.
///
/// # Errors
/// Where an output is of another type.
pub(super) fn draw(
    seen: &BTreeMap<String, Value>,
    matrix: &CameraMatrix,
    image: &mut Rgb,
) -> Result<()> {
    let width = image.width as f32;
    if let Some(border) = output::<FieldBorder>(seen, "field_border")? {
        let ends = |column: f32| Some(Point2::new(column, border.row_at(column)?));
        let columns = (0..image.width).map(|column| column as f32);
        for pixel in columns.filter_map(ends).filter(|pixel| pixel.x < width) {
            image.set(pixel.x, pixel.y, BORDER);
        }
    }
    for line in output::<Vec<LineSegment>>(seen, "lines")?.unwrap_or_default() {
        let pixel = |end: Point2<f32>| matrix.ground_to_pixel(end.coords.push(0.0).into());
        if let (Some(start), Some(end)) = (pixel(line.start), pixel(line.end)) {
            straight(image, start, end, LINE);
        }
    }
    for corner in output::<Vec<LineCorner>>(seen, "corners")?.unwrap_or_default() {
        cross(image, corner.center, 8.0, CORNER);
    }
    if let Some(known) = output::<Option<CenterCircle>>(seen, "center_circle")?.flatten() {
        let middle = matrix.ground_to_pixel(known.position.coords.push(0.0).into());
        if let Some(middle) = middle {
            circle(image, middle, 8.0, MARK);
        }
    }
    if let Some(mark) = output::<Option<PenaltyMark>>(seen, "penalty_mark")?.flatten() {
        cross(image, mark.center, 6.0, MARK);
    }
    for ball in output::<Vec<BallCandidate>>(seen, "balls")?.unwrap_or_default() {
        circle(image, ball.center, ball.radius, BALL);
    }
    for obstacle in output::<Vec<ObstacleCandidate>>(seen, "obstacles")?.unwrap_or_default() {
        cross(image, obstacle.foot, 10.0, OBSTACLE);
    }
    Ok(())
}

fn output<T: DeserializeOwned>(seen: &BTreeMap<String, Value>, name: &str) -> Result<Option<T>> {
    let value = seen
        .get(name)
        .map(|value| serde_json::from_value(value.clone()));
    Ok(value.transpose()?)
}

fn straight(image: &mut Rgb, start: Point2<f32>, end: Point2<f32>, color: [u8; 3]) {
    let longest = (end - start)
        .amax()
        .min(2.0 * (image.width + image.height) as f32);
    let count = longest.ceil().max(1.0) as u32;
    for step in 0..=count {
        let pixel = start + (end - start) * (step as f32 / count as f32);
        image.set(pixel.x, pixel.y, color);
    }
}

fn cross(image: &mut Rgb, center: Point2<f32>, reach: f32, color: [u8; 3]) {
    for arm in [Vector2::new(reach, 0.0), Vector2::new(0.0, reach)] {
        straight(image, center - arm, center + arm, color);
    }
}

fn circle(image: &mut Rgb, center: Point2<f32>, radius: f32, color: [u8; 3]) {
    let count = (radius.clamp(1.0, 4096.0) * TAU).ceil() as u32;
    for step in 0..count {
        let (sine, cosine) = math::sin_cos(step as f32 / count as f32 * TAU);
        image.set(center.x + radius * cosine, center.y + radius * sine, color);
    }
}
