//! Smears light before it becomes an image, as optics and motion do; the noise of the sensor stays sharp.

use framework::math;

use super::row::Row;
use super::{HEIGHT, WIDTH};

/// A bell curve, the same along rows and columns.
pub(super) struct Blur {
    /// Of the pixel itself and of those on each side of it.
    weights: Vec<f32>,
}

impl Blur {
    /// With a standard deviation in px; `None` where nothing is smeared.
    pub(super) fn new(deviation: f32) -> Option<Self> {
        if deviation <= 0.0 {
            return None;
        }
        let reach = (2.5 * deviation).ceil() as usize;
        let bell = |distance: usize| math::exp(-0.5 * math::powi(distance as f32 / deviation, 2));
        let mut weights: Vec<_> = (0..=reach).map(bell).collect();
        let sum = weights[0] + 2.0 * weights[1..].iter().sum::<f32>();
        weights.iter_mut().for_each(|weight| *weight /= sum);
        Some(Self { weights })
    }

    /// All rows of an image.
    pub(super) fn apply(&self, paint: impl Fn(usize, &mut Row)) -> Vec<Row> {
        let sharp: Vec<_> = (0..HEIGHT)
            .map(|number| {
                let mut row = Row::new();
                paint(number, &mut row);
                for channel in row.channels_mut() {
                    *channel = self.along(channel);
                }
                row
            })
            .collect();
        (0..HEIGHT)
            .map(|number| self.across(&sharp, number))
            .collect()
    }

    fn along(&self, light: &[f32; WIDTH]) -> [f32; WIDTH] {
        let mut smeared = light.map(|value| value * self.weights[0]);
        for (distance, weight) in self.weights.iter().enumerate().skip(1) {
            for (column, value) in smeared.iter_mut().enumerate() {
                let (left, right) = (
                    column.saturating_sub(distance),
                    (column + distance).min(WIDTH - 1),
                );
                *value += (light[left] + light[right]) * weight;
            }
        }
        smeared
    }

    fn across(&self, rows: &[Row], number: usize) -> Row {
        let mut smeared = Row::new();
        for (distance, weight) in self.weights.iter().enumerate() {
            let (above, below) = (
                number.saturating_sub(distance),
                (number + distance).min(HEIGHT - 1),
            );
            // The row itself is both.
            let weight = if distance == 0 { weight * 0.5 } else { *weight };
            let pairs = rows[above]
                .channels()
                .into_iter()
                .zip(rows[below].channels());
            for (channel, (above, below)) in smeared.channels_mut().into_iter().zip(pairs) {
                for (value, (above, below)) in channel.iter_mut().zip(above.iter().zip(below)) {
                    *value += (above + below) * weight;
                }
            }
        }
        smeared
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::color::Color;

    #[test]
    fn an_edge_becomes_as_wide_as_said_and_plain_light_stays() {
        let paint = |_: usize, row: &mut Row| {
            for column in 0..WIDTH {
                let luminance = if column < 320 { 0.0 } else { 200.0 };
                row.set(column, Color::new(luminance, 5.0, -3.0));
            }
        };
        let rows = Blur::new(1.5).unwrap().apply(paint);
        let row = &rows[HEIGHT / 2];
        assert!(
            (row.luminance[10] - 0.0).abs() < 1e-3 && (row.luminance[600] - 200.0).abs() < 1e-2
        );
        assert!((row.blue[320] - 5.0).abs() < 1e-3 && (row.red[320] + 3.0).abs() < 1e-3);
        // One standard deviation beside its middle a smeared edge has 84 % of the step.
        let beside = row.luminance[321];
        assert!((beside / 200.0 - 0.84).abs() < 0.03, "{beside}");
        assert!(Blur::new(0.0).is_none());
    }
}
