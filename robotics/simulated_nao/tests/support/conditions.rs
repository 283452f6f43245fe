//! The conditions of docs/vision.md: light, cameras and carpets, in two halves, and scenes in them.
//!
//! The ball's network was trained in the one half, in which the default palette lies, too; detectors are scored in both. No
//! condition is in both.

use framework::math;
use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};
use simulated_nao::camera::{Exposure, HEIGHT, WIDTH};
use simulated_nao::ground_truth::ImageTruth;
use simulated_nao::scene::{ImageSettings, Robot, RobotSettings, Team};
use types::camera::CameraPosition;

use super::scene::Look;

/// Which half of every range.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(crate) enum Half {
    /// Where the ball's network was trained, and at whose edge other thresholds were chosen: dim, warm, quiet, sharp.
    Tuned,
    /// Where nobody looked: bright, cool, noisy, smeared.
    Other,
}

/// On the floor, lx; cameras are set for the middle.
const LIGHT: [f32; 3] = [300.0, 550.0, 1000.0];
/// Colour temperature, K; cameras are balanced for the middle.
const TEMPERATURE: [f32; 3] = [3000.0, 4500.0, 6500.0];
/// Standard deviation of the luminance.
const NOISE: [f32; 3] = [1.0, 3.0, 5.0];
/// Standard deviation, px.
const BLUR: [f32; 3] = [0.0, 0.75, 1.5];
/// Red, green and blue of carpets in each half.
const CARPETS: [[[f32; 3]; 3]; 2] = [
    [
        [38.0, 128.0, 52.0],
        [60.0, 118.0, 62.0],
        [46.0, 105.0, 70.0],
    ],
    [
        [30.0, 110.0, 62.0],
        [78.0, 130.0, 58.0],
        [70.0, 112.0, 74.0],
    ],
];

/// Bytes grow with the light as BT.709's camera curve says: nearly with this power.
const GAMMA: f32 = 0.45;
/// Wavelengths that red, green and blue stand for, m.
const WAVELENGTHS: [f32; 3] = [610e-9, 540e-9, 460e-9];
/// Planck's second radiation constant, m K.
const SECOND_RADIATION: f32 = 1.438_777e-2;

/// Numbers without a pattern, the same in every run.
pub(crate) struct Draw(u64);

impl Draw {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// From 0 to 1 (SplitMix64, Steele et al. 2014).
    pub(crate) fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        (bits ^ bits >> 31 >> 40) as u32 as f32 / u32::MAX as f32
    }

    pub(crate) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.next()
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        ((self.next() * count as f32) as usize).min(count - 1)
    }
}

impl Half {
    fn of(self, [low, middle, high]: [f32; 3], draw: &mut Draw) -> f32 {
        match self {
            Self::Tuned => draw.between(low, middle),
            Self::Other => draw.between(middle, high),
        }
    }

    /// A camera under some of its conditions.
    pub(crate) fn images(self, draw: &mut Draw) -> ImageSettings {
        let light = self.of(LIGHT, draw);
        let temperature = self.of(TEMPERATURE, draw);
        let carpets = CARPETS[self as usize];
        ImageSettings {
            noise: self.of(NOISE, draw),
            exposure: math::powf(light / LIGHT[1], GAMMA),
            white_balance: balance(temperature),
            blur: self.of(BLUR, draw),
            carpet: carpets[draw.below(carpets.len())],
            seed: (draw.next() * 1e6) as u32,
        }
    }
}

/// What light of a colour temperature does to red, green and blue of a camera that is balanced for another, green unchanged:
/// Planck's law in Wien's approximation.
fn balance(temperature: f32) -> [f32; 3] {
    let difference = temperature.recip() - TEMPERATURE[1].recip();
    let gain = |wavelength: f32| math::exp(-SECOND_RADIATION / wavelength * difference);
    WAVELENGTHS.map(|wavelength| math::powf(gain(wavelength) / gain(WAVELENGTHS[1]), GAMMA))
}

/// Nearly, rad: the weights were learnt from images that were drawn with it.
#[expect(clippy::approx_constant, reason = "another value draws other images")]
const HALF_TURN: f32 = 3.14;

/// A robot somewhere among others, under some conditions; three of four times with a ball before it.
pub(crate) fn scene(half: Half, number: u64, draw: &mut Draw) -> (Look, Exposure) {
    let is_top = draw.next() < 0.7;
    let look = Look {
        robot: [
            f64::from(draw.between(-4.2, 4.2)),
            f64::from(draw.between(-2.8, 2.8)),
            f64::from(draw.between(-HALF_TURN, HALF_TURN)),
        ],
        yaw: f64::from(draw.between(-0.9, 0.9)),
        pitch: f64::from(draw.between(-0.1, 0.45)),
        camera: if is_top {
            CameraPosition::Top
        } else {
            CameraPosition::Bottom
        },
    };
    let ball = (draw.next() < 0.75)
        .then(|| ball_before(&look, draw))
        .flatten();
    let robots = robots_before(&look, ball, draw);
    let mut exposure = look.expose_among(number, ball, &robots);
    exposure.images = half.images(draw);
    exposure.ball_turn = UnitQuaternion::from_scaled_axis(Vector3::new(
        draw.between(-3.0, 3.0),
        draw.between(-3.0, 3.0),
        draw.between(-3.0, 3.0),
    ));
    (look, exposure)
}

/// A ball that the image shows, equally often at every distance up to 4.3 m.
fn ball_before(look: &Look, draw: &mut Draw) -> Option<Point3<f32>> {
    let truth = ImageTruth::from(&look.expose(0, None));
    let to_field = truth.ground_to_field;
    (0..30).find_map(|_| {
        let (distance, bearing) = (draw.between(0.15, 4.3), draw.between(-1.4, 1.4));
        let place = Point3::new(
            distance * math::cos(bearing),
            distance * math::sin(bearing),
            0.05,
        );
        let pixel = truth.camera_matrix.ground_to_pixel(place)?;
        let is_seen = (8.0..WIDTH as f32 - 8.0).contains(&pixel.x)
            && (8.0..HEIGHT as f32 - 8.0).contains(&pixel.y);
        let ball = to_field * place;
        let is_on_field = ball.x.abs() < 5.0 && ball.y.abs() < 3.5;
        (is_seen && is_on_field).then_some(ball)
    })
}

/// Up to four robots, none on the ball.
fn robots_before(look: &Look, ball: Option<Point3<f32>>, draw: &mut Draw) -> Vec<Robot> {
    let [x, y, heading] = look.robot;
    let ahead = (heading + look.yaw) as f32;
    let count = draw.below(5);
    let robots = (0..count).filter_map(|_| {
        let (distance, bearing) = (draw.between(0.5, 4.0), ahead + draw.between(-0.6, 0.6));
        let place = Point2::new(
            x as f32 + distance * math::cos(bearing),
            y as f32 + distance * math::sin(bearing),
        );
        let heading = draw.between(-3.1, 3.1);
        let team = if draw.next() < 0.5 {
            Team::Own
        } else {
            Team::Opponent
        };
        let is_free = ball.is_none_or(|ball| nalgebra::distance(&ball.xy(), &place) > 0.2);
        is_free.then(|| {
            Robot::from(&RobotSettings {
                position: [f64::from(place.x), f64::from(place.y)],
                heading: f64::from(heading),
                team,
                number: 2,
            })
        })
    });
    robots.collect()
}
