//! How well vision sees lines, border, robots and the other features of the field under the conditions of docs/vision.md, and balls
//! without anything learnt, in both halves.
//!
//! `HULKGEN_VISION_IMAGES=1000 cargo test -p simulated_nao --test features_under_conditions -- --nocapture` prints the table of
//! the page.

#[path = "support/conditions.rs"]
mod conditions;
#[path = "support/field.rs"]
mod field;
#[path = "support/scene.rs"]
#[expect(dead_code, reason = "the conditions have scenes of their own")]
mod scene;
#[path = "support/score.rs"]
mod score;

use std::fmt;

use conditions::Half;
use field::{
    distance_to_line, edge, is_border, is_wide, on_field, points_between, posts, shows_feet,
    straight_lines, to_ground,
};
use framework::testing::ParameterFile;
use nalgebra::{Point2, Point3};
use scene::{Sight, Vision};
use score::{Balls, scenes};
use simulated_nao::camera::Exposure;
use simulated_nao::field::{LENGTH, WIDTH};
use simulated_nao::ground_truth::{ImageTruth, RobotTruth};

/// Without the variable.
const IMAGES: u64 = 250;

/// So many of all.
#[derive(Clone, Copy, Debug, Default)]
struct Share {
    right: u32,
    all: u32,
}

/// What came of many images.
#[derive(Debug, Default)]
struct Score {
    images: u32,
    /// Points of segments within 4 m that lie on a line.
    on_lines: Share,
    /// Pieces of 5 cm of straight lines within 3 m that are found.
    lines: Share,
    /// Places of the edge of the carpet in whose column the border has the right row.
    border: Share,
    /// Images without the edge in which no border is found.
    borderless: Share,
    /// Robots that show their feet from 0.7 to 3 m away and are found.
    robots: Share,
    /// Obstacles within 4 m that are robots or goal posts.
    obstacles: Share,
    /// Those of the others that are the ball.
    ball_obstacles: u32,
    circles: Share,
    wrong_circles: u32,
    marks: Share,
    wrong_marks: u32,
    balls: Balls,
}

impl Share {
    fn add(&mut self, is_right: bool) {
        self.right += u32::from(is_right);
        self.all += 1;
    }

    fn assert_at_least(self, least: f32, what: &str) {
        assert!(self.all > 0, "{what}: none was shown");
        let share = self.right as f32 / self.all as f32;
        assert!(share >= least, "{what}: {self}, {least} are needed");
    }
}

impl fmt::Display for Share {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { right, all } = self;
        let percent = 100.0 * f64::from(*right) / f64::from(*all);
        write!(formatter, "{right} of {all} ({percent:.1} %)")
    }
}

impl Score {
    fn add(&mut self, exposure: &Exposure, sight: &Sight) {
        let truth = ImageTruth::from(exposure);
        self.images += 1;
        self.add_segments(exposure, sight);
        self.add_lines(exposure, &truth, sight);
        self.add_border(&truth, sight);
        self.add_robots(exposure, &truth, sight);
        self.add_circle(exposure, &truth, sight);
        self.add_mark(exposure, &truth, sight);
        self.balls.add(exposure, &truth, &sight.balls);
    }

    fn add_segments(&mut self, exposure: &Exposure, sight: &Sight) {
        for line in &sight.lines {
            for point in points_between(line.start, line.end) {
                let distance = point.coords.norm();
                if distance <= 4.0 {
                    let off = distance_to_line(on_field(exposure, point));
                    self.on_lines.add(off <= 0.05 + 0.05 * distance);
                }
            }
        }
    }

    fn add_lines(&mut self, exposure: &Exposure, truth: &ImageTruth, sight: &Sight) {
        for [start, end] in straight_lines() {
            for point in points_between(start, end) {
                let ground = to_ground(exposure, point);
                let distance = ground.coords.norm();
                if distance > 3.0 || !is_clear(truth, point) {
                    continue;
                }
                let allowed = 0.05 + 0.05 * distance;
                let mut lines = sight.lines.iter();
                self.lines
                    .add(lines.any(|line| line.distance_to(ground) <= allowed));
            }
        }
    }

    fn add_border(&mut self, truth: &ImageTruth, sight: &Sight) {
        let edge = edge(truth);
        if edge.is_empty() {
            self.borderless.add(sight.border.lines.is_empty());
        }
        let is_seen = |pixel: &Point2<f32>| !truth.covers(*pixel);
        let seen: Vec<_> = edge.into_iter().filter(is_seen).collect();
        if is_wide(&seen) {
            for pixel in seen {
                self.border.add(is_border(&sight.border, &pixel));
            }
        }
    }

    fn add_robots(&mut self, exposure: &Exposure, truth: &ImageTruth, sight: &Sight) {
        let robots: Vec<_> = truth.robots().collect();
        let posts = posts(exposure);
        for robot in &robots {
            let distance = robot.position.coords.norm();
            if (0.7..=3.0).contains(&distance)
                && is_on_field(exposure, robot)
                && shows_feet(robot, &robots)
            {
                let allowed = 0.2 + 0.1 * distance;
                self.robots.add((sight.obstacles.iter()).any(|obstacle| {
                    nalgebra::distance(&obstacle.position, &robot.position) <= allowed
                }));
            }
        }
        let ball = (exposure.ball).map(|ball| to_ground(exposure, ball.xy()));
        for obstacle in &sight.obstacles {
            let is_at = |place: Point2<f32>, allowed: f32| {
                nalgebra::distance(&place, &obstacle.position) <= allowed
            };
            if obstacle.position.coords.norm() <= 4.0 {
                let robots = robots.iter().map(|robot| robot.position);
                let is_real = robots.chain(posts).any(|real| is_at(real, 0.5));
                let is_ball = ball.is_some_and(|ball| is_at(ball, 0.15));
                self.obstacles.add(is_real);
                self.ball_obstacles += u32::from(!is_real && is_ball);
            }
        }
    }

    fn add_circle(&mut self, exposure: &Exposure, truth: &ImageTruth, sight: &Sight) {
        let middle = to_ground(exposure, Point2::origin());
        let distance = middle.coords.norm();
        let is_right = sight
            .center_circle
            .as_ref()
            .map(|circle| nalgebra::distance(&circle.position, &middle) <= 0.05 + 0.03 * distance);
        self.wrong_circles += u32::from(is_right == Some(false));
        let is_shown = truth
            .project(Point3::origin())
            .is_some_and(|pixel| (150.0..490.0).contains(&pixel.x));
        if is_shown && distance < 2.5 {
            self.circles.add(is_right == Some(true));
        }
    }

    fn add_mark(&mut self, exposure: &Exposure, truth: &ImageTruth, sight: &Sight) {
        let is_at = |mark: Point2<f32>| {
            let mark = to_ground(exposure, mark);
            sight.penalty_mark.as_ref().is_some_and(|seen| {
                nalgebra::distance(&seen.position, &mark) <= 0.05 + 0.1 * mark.coords.norm()
            })
        };
        let marks = ImageTruth::penalty_marks().map(|mark| mark.xy());
        self.wrong_marks +=
            u32::from(sight.penalty_mark.is_some() && !marks.iter().any(|mark| is_at(*mark)));
        for mark in marks {
            let pixel = truth.project(Point3::new(mark.x, mark.y, 0.0));
            let is_inside = pixel.is_some_and(|pixel| {
                (60.0..580.0).contains(&pixel.x) && (40.0..420.0).contains(&pixel.y)
            });
            let is_near = to_ground(exposure, mark).coords.norm() < 2.5;
            if is_inside && is_near && is_clear(truth, mark) {
                self.marks.add(is_at(mark));
            }
        }
    }

    fn print(&mut self, half: Half) {
        println!("{half:?}: {} images", self.images);
        println!("  segments on lines: {}", self.on_lines);
        println!("  pieces of lines found: {}", self.lines);
        println!("  places of the border: {}", self.border);
        println!("  no border where there is none: {}", self.borderless);
        println!("  robots found: {}", self.robots);
        println!(
            "  obstacles that are robots or goal posts: {}, the ball: {}",
            self.obstacles, self.ball_obstacles
        );
        println!("  circles: {}, wrong: {}", self.circles, self.wrong_circles);
        println!(
            "  penalty marks: {}, wrong: {}",
            self.marks, self.wrong_marks
        );
        self.balls.print(half);
    }

    /// The same in both halves.
    fn assert_good(&self) {
        self.on_lines.assert_at_least(0.98, "segments on lines");
        self.lines.assert_at_least(0.9, "pieces of lines found");
        self.border.assert_at_least(0.93, "places of the border");
        (self.borderless).assert_at_least(0.95, "no border where there is none");
        self.robots.assert_at_least(0.75, "robots found");
        self.obstacles
            .assert_at_least(0.8, "obstacles that are real");
        // Too few are shown to say how many are found; other tests look for them.
        let most_wrong = self.images / 50;
        assert!(self.wrong_circles <= most_wrong, "{self:?}");
        assert!(self.wrong_marks <= most_wrong, "{self:?}");
        self.balls.assert_good(0.85);
    }
}

/// Whether the image shows a place of the field, and nothing in front of it.
fn is_clear(truth: &ImageTruth, place: Point2<f32>) -> bool {
    let Some(pixel) = truth.project(Point3::new(place.x, place.y, 0.0)) else {
        return false;
    };
    let is_behind_ball = truth
        .ball
        .is_some_and(|ball| nalgebra::distance(&pixel, &ball.center) <= 1.1 * ball.radius);
    !is_behind_ball && !truth.covers(pixel)
}

/// Whether a robot stands within the lines around the field.
fn is_on_field(exposure: &Exposure, robot: &RobotTruth) -> bool {
    let place = on_field(exposure, robot.position);
    place.x.abs() < LENGTH / 2.0 && place.y.abs() < WIDTH / 2.0
}

/// Of images in which balls are told by their print, which changes nothing about anything else.
fn score(half: Half) -> Score {
    let parameters = include_str!("../../parameters/default.toml");
    let by_print = parameters.replace("classifier = \"Network\"", "classifier = \"Print\"");
    assert!(
        by_print != parameters,
        "the file names the classifier otherwise"
    );
    let mut vision = Vision::new();
    vision.parameters = ParameterFile::new(&by_print);
    let mut score = Score::default();
    for (look, exposure) in scenes(half, IMAGES) {
        score.add(&exposure, &vision.see(&look, &exposure));
    }
    score.print(half);
    score
}

#[test]
fn features_are_seen_under_the_conditions_that_the_default_palette_is_near_to() {
    score(Half::Tuned).assert_good();
}

#[test]
fn features_are_seen_under_conditions_that_nobody_looked_at() {
    score(Half::Other).assert_good();
}
