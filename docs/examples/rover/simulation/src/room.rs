//! What stands still: four walls and posts. Metres, as seen from the rover's start.

use serde::Deserialize;

/// From where to where the room is.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Walls {
    /// The wall behind, the wall in front.
    pub x: [f64; 2],
    /// The wall on the right, the wall on the left.
    pub y: [f64; 2],
}

/// Something round: x, y and radius.
#[derive(Clone, Copy, Debug, Deserialize)]
pub struct Post(pub f64, pub f64, pub f64);

/// A room.
#[derive(Clone, Debug)]
pub struct Room {
    /// Around everything.
    pub walls: Walls,
    /// Within.
    pub posts: Vec<Post>,
}

impl Room {
    /// Metres from a place to what is there in this direction.
    pub fn range(&self, [x, y]: [f64; 2], angle: f64) -> f64 {
        let (sine, cosine) = angle.sin_cos();
        let wall = |place: f64, step: f64, [low, high]: [f64; 2]| match step {
            step if step > 0.0 => (high - place) / step,
            step if step < 0.0 => (low - place) / step,
            _ => f64::INFINITY,
        };
        let walls = wall(x, cosine, self.walls.x).min(wall(y, sine, self.walls.y));
        let posts = self.posts.iter().filter_map(|Post(at, beside, radius)| {
            let (ahead, aside) = (
                (at - x) * cosine + (beside - y) * sine,
                (beside - y) * cosine - (at - x) * sine,
            );
            let chord = radius * radius - aside * aside;
            (chord > 0.0 && ahead > 0.0).then(|| ahead - chord.sqrt())
        });
        posts.fold(walls, f64::min).max(0.0)
    }

    /// Metres from a place to what is nearest.
    pub fn nearest(&self, [x, y]: [f64; 2]) -> f64 {
        let Walls {
            x: [back, front],
            y: [right, left],
        } = self.walls;
        let walls = (x - back).min(front - x).min(y - right).min(left - y);
        let posts = self.posts.iter();
        let posts = posts.map(|Post(at, beside, radius)| (at - x).hypot(beside - y) - radius);
        posts.fold(walls, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    #[test]
    fn rays_end_at_walls_and_posts() {
        let room = Room {
            walls: Walls {
                x: [-1.0, 4.0],
                y: [-2.0, 2.0],
            },
            posts: vec![Post(2.0, 0.1, 0.5)],
        };
        let near = |is: f64, expected: f64| assert!((is - expected).abs() < 1e-9, "{is}");
        near(room.range([0.0, 0.1], 0.0), 1.5);
        near(room.range([0.0, 1.0], 0.0), 4.0);
        near(room.range([0.0, 0.1], FRAC_PI_2), 1.9);
        near(room.range([0.0, 0.1], 2.0 * FRAC_PI_2), 1.0);
        near(room.nearest([1.0, 0.1]), 0.5);
    }
}
