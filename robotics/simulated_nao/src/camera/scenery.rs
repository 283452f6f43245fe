//! Everything that stands on the field, in the order in which it is painted: far things first.

use nalgebra::{Point2, Point3};

use super::Exposure;
use super::ball::Ball;
use super::color::Color;
use super::figure::{self, Capsule, PARTS, PARTS_BELOW_HEAD};
use super::net::{Net, PANELS, panels};
use super::row::Row;
use super::sprite::{Sprite, Viewpoint};
use crate::field::{CROSSBAR_HEIGHT, GOAL_POST_RADIUS, goal_posts};
use crate::scene::MOST_ROBOTS;
use types::joints::Joints;

const FRAME: usize = 6;
const MOST_SPRITES: usize = (MOST_ROBOTS + 1) * PARTS + FRAME;

/// What an image shows of the things on the field. Lives on the stack: images are made without heap.
pub(super) struct Scenery {
    sprites: [Option<Sprite>; MOST_SPRITES],
    count: usize,
    ball: Option<Ball>,
    nets: [Option<Net>; PANELS],
}

impl Scenery {
    pub(super) fn new(exposure: &Exposure) -> Self {
        let view = Viewpoint::new(exposure);
        let mut scenery = Self {
            sprites: [None; MOST_SPRITES],
            count: 0,
            ball: exposure
                .ball_in_camera()
                .and_then(|center| Ball::new(exposure, &center)),
            nets: panels().map(|panel| Net::new(exposure, &panel)),
        };
        for robot in exposure.robots.iter().take(MOST_ROBOTS) {
            scenery.add(&view, &robot.parts);
        }
        scenery.add(&view, &frames());
        if let Some(body) = &exposure.body {
            let joints: &Joints<f32> = &body.joints;
            let poses = kinematics::forward_kinematics(joints);
            let parts = figure::parts(&poses, Color::BLUE_SHIRT);
            let parts = parts.map(|part| part.transformed(&body.torso_to_field));
            scenery.add(&view, &parts[..PARTS_BELOW_HEAD]);
        }
        let nearness = |sprite: &Option<Sprite>| sprite.map_or(0.0, |sprite| sprite.nearness());
        scenery.sprites[..scenery.count]
            .sort_unstable_by(|one, other| nearness(one).total_cmp(&nearness(other)));
        scenery
    }

    fn add(&mut self, view: &Viewpoint, capsules: &[Capsule]) {
        for sprite in capsules.iter().filter_map(|capsule| view.sprite(capsule)) {
            if let Some(free) = self.sprites.get_mut(self.count) {
                *free = Some(sprite);
                self.count += 1;
            }
        }
    }

    fn sprites(&self) -> impl Iterator<Item = &Sprite> {
        self.sprites[..self.count].iter().flatten()
    }

    /// Paints what stands in one row of the image.
    pub(super) fn paint(&self, exposure: &Exposure, number: usize, row: &mut Row) {
        let mut ball = self.ball.as_ref();
        for sprite in self.sprites() {
            if let Some(ball) = ball.take_if(|ball| ball.nearness() < sprite.nearness()) {
                ball.paint(exposure, number, row);
            }
            sprite.paint(number, row);
        }
        if let Some(ball) = ball {
            ball.paint(exposure, number, row);
        }
        for net in self.nets.iter().flatten() {
            net.paint(number, row);
        }
    }

    /// How far away along the optical axis the nearest robot, limb or goal post of a pixel is, m.
    pub(super) fn depth_at(&self, pixel: Point2<f32>) -> Option<f32> {
        let nearness = self
            .sprites()
            .filter_map(|sprite| sprite.nearness_at(pixel));
        nearness.reduce(f32::max).map(f32::recip)
    }
}

/// Posts and crossbars.
fn frames() -> [Capsule; FRAME] {
    let posts = goal_posts();
    let bar = |start: Point3<f32>, end: Point3<f32>| Capsule {
        ends: [start, end],
        radii: [GOAL_POST_RADIUS; 2],
        color: Color::GOAL,
        is_flat: false,
    };
    let top = |index: usize| Point3::new(posts[index].x, posts[index].y, CROSSBAR_HEIGHT);
    let post = |index: usize| {
        let foot = Point3::new(posts[index].x, posts[index].y, 0.0);
        Capsule {
            is_flat: true,
            ..bar(foot, top(index))
        }
    };
    [
        post(0),
        post(1),
        bar(top(0), top(1)),
        post(2),
        post(3),
        bar(top(2), top(3)),
    ]
}
