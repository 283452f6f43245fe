//! What images show, at the places where the truth projects it.

use framework::math;
use nalgebra::Point3;
use types::camera::CameraPosition;

use super::*;
use crate::ground_truth::ImageTruth;
use crate::scene::{ImageSettings, RobotSettings, Team};
use crate::settings::{BallSettings, Settings};
use crate::world::World;

/// A robot between the middle of the field and a goal, without a ball.
fn settings() -> Settings {
    Settings {
        robot_pose: [2.0, 0.0, 0.0],
        ball: BallSettings {
            present: false,
            ..BallSettings::default()
        },
        ..Settings::default()
    }
}

fn robot(position: [f64; 2], team: Team) -> RobotSettings {
    RobotSettings {
        position,
        heading: std::f64::consts::PI,
        team,
        number: 2,
    }
}

fn shot(settings: &Settings, number: u64) -> (YuyvImage, ImageTruth) {
    let world = World::new(settings);
    let exposure = world.expose(0, CameraPosition::Top, number);
    let mut image = YuyvImage::default();
    render(&exposure, &world.field, &mut image);
    (image, ImageTruth::from(&exposure))
}

fn color(image: &YuyvImage, pixel: Point2<f32>) -> types::image::Yuv {
    image
        .yuv(pixel.x.round() as u32, pixel.y.round() as u32)
        .expect("the truth projects into the image")
}

fn mean_luminance(image: &YuyvImage) -> f64 {
    let luminances = image.data.iter().step_by(2);
    luminances
        .map(|&luminance| f64::from(luminance))
        .sum::<f64>()
        / (WIDTH * HEIGHT) as f64
}

#[test]
fn the_same_exposure_gives_the_same_bits() {
    let settings = Settings {
        robots: vec![robot([3.5, 0.2], Team::Own)],
        ..settings()
    };
    let image = |number| shot(&settings, number).0;
    let once = image(3);
    assert!(once.is_complete());
    assert!(once == image(3));
    assert!(once != image(4), "every image has its own noise");
    let moved = Settings {
        robot_pose: [2.001, 0.0, 0.0],
        ..settings.clone()
    };
    assert!(once != shot(&moved, 3).0);
    let seeded = Settings {
        images: ImageSettings {
            seed: 1,
            ..ImageSettings::default()
        },
        ..settings
    };
    assert!(once != shot(&seeded, 3).0);
}

#[test]
fn an_image_is_made_in_the_heap_that_is_there() {
    let world = World::new(&settings());
    let mut image = YuyvImage::default();
    render(
        &world.expose(0, CameraPosition::Top, 0),
        &world.field,
        &mut image,
    );
    let heap = image.data.as_ptr();
    render(
        &world.expose(0, CameraPosition::Bottom, 0),
        &world.field,
        &mut image,
    );
    assert_eq!(image.data.as_ptr(), heap);
}

#[test]
fn the_penalty_mark_is_white_where_the_truth_projects_it() {
    let settings = Settings {
        robot_pose: [1.6, 0.0, 0.0],
        ..settings()
    };
    let (image, truth) = shot(&settings, 0);
    let mark = truth.project(ImageTruth::penalty_marks()[0]);
    let seen = color(&image, mark.expect("the mark lies ahead"));
    assert!(seen.y > 150, "{seen:?}");
}

#[test]
fn goal_posts_are_white_where_the_truth_projects_them() {
    let (image, truth) = shot(&settings(), 0);
    let posts: Vec<_> = truth.goal_posts().collect();
    assert_eq!(posts.len(), 2);
    for post in posts {
        assert!((post.position.x - 2.525).abs() < 0.05, "{post:?}");
        let middle = Point3::new(post.position.x + 2.0, post.position.y, 0.4);
        let middle = truth
            .project(middle)
            .expect("it is above a foot in the image");
        assert!(truth.covers(middle));
        let seen = color(&image, middle);
        assert!(seen.y > 130 && seen.u.abs_diff(128) < 8, "{seen:?}");
    }
}

#[test]
fn robots_wear_the_shirt_of_their_team_where_the_truth_projects_them() {
    for (team, is_right) in [
        (
            Team::Own,
            (|seen| seen.u > 160) as fn(types::image::Yuv) -> bool,
        ),
        (Team::Opponent, |seen| seen.v > 160),
    ] {
        let place = [4.0, 0.3];
        let settings = Settings {
            robots: vec![robot(place, team)],
            ..settings()
        };
        let (image, truth) = shot(&settings, 0);
        // The middle of a standing NAO's chest is 0.33 m above the floor; the button is beside.
        let chest = truth.project(Point3::new(4.0, 0.33, 0.33));
        let chest = chest.expect("the robot stands ahead");
        assert!(is_right(color(&image, chest)), "{:?}", color(&image, chest));
        assert!(truth.covers(chest));
        let robot = truth.robots().next().expect("there is one");
        assert!((robot.position - Point2::new(2.0, 0.3)).norm() < 0.05);
        for foot in [robot.feet.left, robot.feet.right] {
            let foot = foot.expect("they are in the image");
            let above = Point2::new(foot.x, foot.y - 6.0);
            assert!(
                truth.covers(above) && color(&image, above).y > 110,
                "{foot}"
            );
            let below = Point2::new(foot.x, foot.y + 25.0);
            assert!(
                !truth.covers(below) && color(&image, below).v < 110,
                "{foot}"
            );
        }
    }
}

#[test]
fn what_is_nearer_hides_what_is_farther() {
    let red_before_blue = [
        robot([4.2, 0.0], Team::Own),
        robot([3.4, 0.0], Team::Opponent),
    ];
    let mut settings = settings();
    for turn in 0..2 {
        settings.robots = red_before_blue.to_vec();
        settings.robots.rotate_left(turn);
        let (image, truth) = shot(&settings, 0);
        let chest = truth.project(Point3::new(3.4, 0.04, 0.33));
        let seen = color(&image, chest.expect("the robot stands ahead"));
        assert!(seen.v > 160, "{seen:?}");
    }
}

#[test]
fn a_ball_behind_a_robot_is_hidden_and_one_before_it_is_whole() {
    for (x, is_whole) in [(4.2, false), (3.4, true)] {
        let settings = Settings {
            ball: BallSettings {
                present: true,
                position: [x, 0.0],
            },
            // One of its legs stands in the way.
            robots: vec![robot([3.8, 0.05], Team::Opponent)],
            ..settings()
        };
        let (image, truth) = shot(&settings, 0);
        let ball = truth.ball.expect("it lies ahead");
        assert_eq!(ball.is_whole, is_whole, "{ball:?}");
        let bare = shot(
            &Settings {
                robots: Vec::new(),
                ..settings
            },
            0,
        );
        let seen = [&image, &bare.0].map(|image| color(image, ball.center));
        assert_eq!(seen[0] == seen[1], is_whole, "{seen:?}");
    }
}

#[test]
fn exposure_multiplies_the_luminance() {
    let mean = |exposure| {
        let images = ImageSettings {
            exposure,
            ..ImageSettings::default()
        };
        mean_luminance(
            &shot(
                &Settings {
                    images,
                    ..settings()
                },
                0,
            )
            .0,
        )
    };
    let ratio = mean(0.5) / mean(1.0);
    assert!((ratio - 0.5).abs() < 0.005, "{ratio}");
}

#[test]
fn white_balance_tints_what_is_grey() {
    let images = ImageSettings {
        white_balance: [1.2, 1.0, 0.8],
        ..ImageSettings::default()
    };
    let settings = Settings {
        images,
        ..settings()
    };
    let (image, truth) = shot(&settings, 0);
    let post = truth.project(Point3::new(4.525, 0.8, 0.4));
    let [red, green, blue] = color(&image, post.expect("it stands ahead")).to_rgb();
    assert!(
        red > green + 15 && green > blue + 15,
        "{red} {green} {blue}"
    );
}

#[test]
fn noise_has_the_standard_deviation_that_was_asked_for() {
    for noise in [2.0, 6.0] {
        let image = |noise| {
            let images = ImageSettings {
                noise,
                ..ImageSettings::default()
            };
            shot(
                &Settings {
                    images,
                    ..settings()
                },
                0,
            )
            .0
        };
        let (clean, noisy) = (image(0.0), image(noise));
        let pairs = clean.data.iter().zip(&noisy.data).step_by(2);
        let squares =
            pairs.map(|(&clean, &noisy)| math::powi(f64::from(noisy) - f64::from(clean), 2));
        let deviation = (squares.sum::<f64>() / (WIDTH * HEIGHT) as f64).sqrt();
        assert!(
            (deviation / f64::from(noise) - 1.0).abs() < 0.05,
            "{deviation} instead of {noise}"
        );
    }
}
